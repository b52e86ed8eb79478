(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* From errors to signs: what a filter compares, and why the sign is then right. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry.
Open Scope R_scope.

Lemma constant_is_double m e : (Z.abs m < 2 ^ 53)%Z -> (-1074 <= e)%Z -> is_double (constant m e).
Proof.
  intros M E. apply generic_format_FLT. exists (Float radix2 m e); [reflexivity | exact M | exact E].
Qed.

(* The first factor of a product. *)
Fixpoint factor (t : term) : R :=
  match t with Constant m e => constant m e | Times a _ => factor a | _ => 0 end.

(* The operands of an operation. *)
Definition part_1 (t : term) : term := match t with Minus a _ | Plus a _ | Times a _ => a | _ => t end.
Definition part_2 (t : term) : term := match t with Minus _ b | Plus _ b | Times _ b => b | _ => t end.

(* The largest value that gamma(k) may have in the scripts: k units and what is far less. *)
Definition most (unit : R) (k : nat) : R := INR k * unit + (INR k * unit) ^ 2.

(* A value that is off by less than its size has the right sign. *)
Lemma right_sign V X E : Rabs (V - X) <= E -> E < Rabs V -> 0 < V * X.
Proof.
  intros H L. apply Rabs_le_inv in H.
  destruct (Rle_dec 0 V); [rewrite Rabs_pos_eq in L by assumption | rewrite Rabs_left in L by lra]; nra.
Qed.

(* The square l of V, as computed, exceeds r, which is at least Q (1 - G). *)
Lemma beyond_square unit V X l r E Q G :
  0 <= unit -> 0 <= E -> Rabs (V - X) <= E -> Rabs (l - V * V) <= unit * Rabs (V * V) -> Q * (1 - G) <= r ->
  r < l -> E * E * (1 + unit) <= Q * (1 - G) -> 0 < V * X.
Proof.
  intros U0 E0 EV EL ER L M. apply right_sign with E; [assumption |].
  assert (0 <= V * V) by nra. rewrite (Rabs_pos_eq (V * V)) in EL by assumption. apply Rabs_le_inv in EL.
  assert (E * E * (1 + unit) < V * V * (1 + unit)) by lra.
  assert (E * E < V * V) by nra.
  assert (A : Rabs V * Rabs V = V * V) by (rewrite <- Rabs_mult; apply Rabs_pos_eq; lra).
  assert (P := Rabs_pos V). nra.
Qed.

(* The size of V exceeds r. *)
Lemma beyond_size V X r E Q G :
  Rabs (V - X) <= E -> Q * (1 - G) <= r -> r < Rabs V -> E <= Q * (1 - G) -> 0 < V * X.
Proof. intros. apply right_sign with E; [assumption | lra]. Qed.

(* Where all terms are positive, the size is the value. *)
Lemma least_value unit s p env t r :
  0 <= unit -> computes unit s p env t r -> size env t = exact env t ->
  exact env t * (1 - gamma unit (count s p t)) <= r.
Proof.
  intros U H S. assert (E := error_of_formula unit U s p env t r H). rewrite S in E.
  apply Rabs_le_inv in E. lra.
Qed.

(* What the scripts say of gamma. *)
Lemma gamma_range unit k : 0 <= unit -> INR k * unit <= / 2 -> 0 <= gamma unit k <= most unit k.
Proof. intros. split; [apply gamma_positive | apply gamma_bound]; assumption. Qed.

(* The sizes of squares. *)
Lemma Rabs_square v : Rabs v * Rabs v = v * v.
Proof. rewrite <- Rabs_mult. apply Rabs_pos_eq. nra. Qed.

(* Numbers k, k + 1 and k + 2 of those that are given. *)
Definition triple (env : nat -> R) (k : nat) := Vector (env k) (env (S k)) (env (S (S k))).

(* 2^-64 *)
Definition v : R := bpow radix2 (-64).
Lemma v_positive : 0 <= v.
Proof. apply bpow_ge_0. Qed.
Lemma v_value : v = / 18446744073709551616.
Proof. reflexivity. Qed.

(* Turns the statement of a certificate into one about real numbers. *)
Ltac numbers :=
  unfold BND, lower, upper, float2R, F2R, Float1, most, u, v in *; simpl in *; unfold constant in *; simpl in *.
Ltac certify := numbers; repeat split; try lra; intros; lra.

Lemma constant_positive m e : (0 <= m)%Z -> 0 <= constant m e.
Proof. intros. apply Rmult_le_pos; [apply IZR_le; assumption | apply bpow_ge_0]. Qed.

(* Lays a formula open down to the numbers that are given. *)
Ltac lay_open :=
  unfold permanent, weights, absolute, det, square, dot, cross, difference, triple, factor; simpl.
Ltac sizes :=
  lay_open; rewrite ?Rabs_square;
  repeat match goal with
         | |- context [Rabs (constant ?m ?e)] =>
             rewrite (Rabs_pos_eq (constant m e)) by (apply constant_positive; lia)
         end;
  ring.

(* Counts are computed, so that gamma has a number. *)
Ltac compute_counts :=
  repeat match goal with
         | |- context [count ?s ?p ?t] =>
             let k := eval vm_compute in (count s p t) in change (count s p t) with k
         end.

Ltac ranges :=
  apply gamma_range; [apply u_positive || apply v_positive |];
  compute_counts; simpl; rewrite ?u_value, ?v_value; lra.
