(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* The filters as they are compiled: in doubles, each operation rounded to nearest, subnormal numbers included.
   Where no product underflows and the comparison of the code holds, the sign of the value is that of the
   exact formula. The two sides of a comparison, and the value, are what extract.cpp wrote down. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Rondel Require Import rounding geometry acceptance formulas exact_data stored distances sums.
Open Scope R_scope.

Ltac constants := cbn; repeat split; apply constant_is_double; lia.

(* What was compared holds of what was computed. *)
Definition holds (env : nat -> R) (left right : term) : Prop :=
  has_normal_products env left /\ has_normal_products env right /\ floats env right < floats env left.

Section Doubles.
Variable env : nat -> R.
Hypothesis are_doubles : forall n, is_double (env n).

Ltac computed := apply floats_compute; [exact are_doubles | constants | assumption].

Ltac of_squares filter left right :=
  intros; match goal with H : holds env left right |- _ => destruct H as [[? [_ ?]] [? ?]] end;
  apply filter with (env := env) (l := floats env left) (r := floats env right); try assumption;
  [computed | apply rounded_normal; assumption | computed].

Ltac of_sizes filter right :=
  intros; match goal with H : holds env _ right |- _ => destruct H as [? [? ?]] end;
  apply filter with (env := env) (r := floats env right); try assumption; computed.

Theorem plane_in_doubles :
  holds env plane_1_left plane_1_right ->
  0 < floats env plane_2_left * - det (difference (triple env 0) (triple env 9)) (difference (triple env 3) (triple
    env 9)) (difference (triple env 6) (triple env 9)).
Proof. of_squares plane_filter plane_1_left plane_1_right. Qed.

Theorem orientation_in_doubles :
  holds env orientation_1_left orientation_1_right ->
  0 < floats env orientation_2_left * det (difference (triple env 0) (triple env 9)) (difference (triple env 3)
    (triple env 0)) (difference (triple env 6) (triple env 0)).
Proof. of_squares orientation_filter orientation_1_left orientation_1_right. Qed.

Theorem change_in_doubles :
  holds env change_1_left change_1_right ->
  0 < floats env change_2_left * (x (triple env 0) * dot (triple env 6) (difference (triple env 3) (triple env 0)) -
    x (difference (triple env 3) (triple env 0)) * dot (triple env 6) (triple env 0)).
Proof. of_squares change_filter change_1_left change_1_right. Qed.

Variables eb ec ed ep : vector.

Theorem direction_orientation_in_doubles :
  is_stored (triple env 0) eb ->
  is_stored (triple env 3) ec ->
  is_stored (triple env 6) ed ->
  holds env direction_orientation_0_left direction_orientation_0_right ->
  0 < floats env direction_orientation_1_left * det eb ec ed.
Proof. of_squares direction_orientation_filter direction_orientation_0_left direction_orientation_0_right. Qed.

Theorem circle_plane_in_doubles :
  is_stored (triple env 0) eb ->
  is_stored (triple env 3) ec ->
  is_stored (triple env 6) ed ->
  is_stored (triple env 9) ep ->
  holds env circle_plane_0_left circle_plane_0_right ->
  0 < floats env circle_plane_1_left * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof. of_squares circle_plane_filter circle_plane_0_left circle_plane_0_right. Qed.

Theorem circle_in_doubles :
  is_stored (triple env 0) eb ->
  is_stored (triple env 3) ec ->
  is_stored (triple env 6) ed ->
  is_stored (triple env 9) ep ->
  holds env circle_1_left circle_1_right ->
  0 < floats env circle_2_left * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof. of_squares circle_filter circle_1_left circle_1_right. Qed.

Theorem angle_in_doubles :
  is_stored (triple env 0) eb ->
  is_stored (triple env 3) ec ->
  is_stored (triple env 6) ep ->
  holds env angle_0_left angle_0_right ->
  0 < floats env angle_1_left * (square (difference eb ep) - square (difference ec ep)).
Proof. of_squares angle_filter angle_0_left angle_0_right. Qed.

Theorem within_angle_in_doubles :
  is_stored (triple env 0) ec ->
  is_stored (triple env 3) ep ->
  0 <= env 6%nat <= 4 ->
  holds env within_angle_0_left within_angle_0_right ->
  0 < floats env within_angle_1_left * (env 6%nat - square (difference ep ec)).
Proof. of_squares within_angle_filter within_angle_0_left within_angle_0_right. Qed.

Theorem within_angle_behind_in_doubles :
  is_stored (triple env 0) ec ->
  is_stored (triple env 3) ep ->
  0 <= env 6%nat <= 4 ->
  holds env within_angle_behind_0_left within_angle_behind_0_right ->
  0 < floats env within_angle_behind_1_left * (square (sum ep ec) - env 6%nat).
Proof. of_squares within_angle_behind_filter within_angle_behind_0_left within_angle_behind_0_right. Qed.

Theorem power_in_doubles :
  holds env power_1_left power_1_right ->
  0 < floats env power_2_left * dot (difference (triple env 6) (triple env 9)) (difference (triple env 0) (triple
    env 3)).
Proof. of_sizes power_filter power_1_right. Qed.

Theorem turn_in_doubles :
  holds env turn_1_left turn_1_right ->
  0 < floats env turn_2_left * ((env 2%nat - env 0%nat) * (env 5%nat - env 1%nat) - (env 3%nat - env 1%nat) * (env
    4%nat - env 0%nat)).
Proof. of_sizes turn_filter turn_1_right. Qed.

Theorem ray_order_in_doubles :
  holds env ray_order_3_left ray_order_3_right ->
  0 < floats env ray_order_4_left * ((env 1%nat - env 7%nat) * (env 3%nat - env 6%nat) - (env 4%nat - env 7%nat) *
    (env 0%nat - env 6%nat)).
Proof. of_sizes ray_order_filter ray_order_3_right. Qed.

Theorem line_in_doubles :
  length (triple env 0) <= 2049 / 2048 ->
  length (triple env 6) <= 2049 / 2048 ->
  holds env line_1_left line_1_right ->
  0 < floats env line_2_left * det (triple env 0) (triple env 3) (triple env 6).
Proof. of_sizes line_filter line_1_right. Qed.

Theorem edge_in_doubles :
  length (triple env 0) <= 2049 / 2048 ->
  length (triple env 6) <= 2049 / 2048 ->
  holds env edge_1_left edge_1_right ->
  0 < floats env edge_2_left * det (triple env 0) (triple env 3) (triple env 6).
Proof. of_sizes edge_filter edge_1_right. Qed.

Theorem change_at_end_in_doubles :
  length (triple env 0) <= 2049 / 2048 ->
  holds env change_at_end_3_left change_at_end_3_right ->
  0 < floats env change_at_end_4_left * (x (triple env 0) * dot (triple env 0) (difference (triple env 3) (triple
    env 0)) - x (difference (triple env 3) (triple env 0)) * dot (triple env 0) (triple env 0)).
Proof. of_sizes change_at_end_filter change_at_end_3_right. Qed.
End Doubles.
