(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Filters of exact data: the sign of a determinant of the points as given. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Rondel Require Import rounding geometry acceptance formulas.
From Rondel Require certificate_plane certificate_orientation certificate_orientation_extended
  certificate_change.
Open Scope R_scope.

(* A value that is a determinant of three vectors, or another sum of products of three coordinates. *)
Section Determinants.
Variable unit : R.
Variable env : nat -> R.
Variables value right : term.
Variables a b c : vector.
Hypothesis unit_positive : 0 <= unit.
Variable most_size : R.
Hypothesis most_size_positive : 0 <= most_size.
Hypothesis size_bound : size env value <= most_size * (length a * length b * length c).
Hypothesis right_is : exact env right = factor right * (square a * square b * square c).
Hypothesis right_size : size env right = exact env right.
Hypothesis margin :
  most_size * gamma unit (count 1 1 value) * (most_size * gamma unit (count 1 1 value)) * (1 + unit) <=
  factor right * (1 - gamma unit (count 1 1 right)).

Lemma determinant_filter V l r :
  computes unit 1 1 env value V -> Rabs (l - V * V) <= unit * Rabs (V * V) ->
  computes unit 1 1 env right r -> r < l -> 0 < V * exact env value.
Proof.
  intros HV Hl Hr L. assert (U := unit_positive).
  assert (La := length_positive a). assert (Lb := length_positive b). assert (Lc := length_positive c).
  set (P := length a * length b * length c).
  assert (P0 : 0 <= P) by (repeat apply Rmult_le_pos; assumption).
  set (E := gamma unit (count 1 1 value)) in *. set (G := gamma unit (count 1 1 right)) in *.
  assert (E0 : 0 <= E) by (apply gamma_positive; assumption).
  assert (Q : exact env right = factor right * (P * P)).
  { rewrite right_is, <- !length_square. unfold P. ring. }
  apply beyond_square with (unit := unit) (l := l) (r := r) (E := most_size * E * P)
    (Q := exact env right) (G := G); try assumption.
  - repeat apply Rmult_le_pos; assumption.
  - eapply Rle_trans; [apply (error_of_formula unit U 1 1 env value V HV) |].
    fold E. assert (E * size env value <= E * (most_size * P)) by (apply Rmult_le_compat_l; assumption). lra.
  - apply (least_value unit 1 1 env right r U Hr right_size).
  - rewrite Q. assert (0 <= P * P) by nra.
    replace (most_size * E * P * (most_size * E * P) * (1 + unit))
      with (most_size * E * (most_size * E) * (1 + unit) * (P * P)) by ring.
    replace (factor right * (P * P) * (1 - G)) with (factor right * (1 - G) * (P * P)) by ring.
    apply Rmult_le_compat_r; assumption.
Qed.
End Determinants.

(* side_of_plane_filter: det(b - p, c - p, d - p), whose sign it turns. *)
Lemma plane_margin E G :
  0 <= E <= most u (count 1 1 plane_2_left) -> 0 <= G <= most u (count 1 1 plane_1_right) ->
  11548 / 10000 * E * (11548 / 10000 * E) * (1 + u) <= factor plane_1_right * (1 - G).
Proof.
  intros HE HG. apply Rnot_lt_le. intro N. apply (certificate_plane.l1 E G).
  unfold certificate_plane.s1, certificate_plane.s2, certificate_plane.s3, not. certify.
Qed.

Theorem plane_filter env V l r :
  let a := difference (triple env 0) (triple env 9) in
  let b := difference (triple env 3) (triple env 9) in
  let c := difference (triple env 6) (triple env 9) in
  computes u 1 1 env plane_2_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env plane_1_right r -> r < l -> 0 < V * - det a b c.
Proof.
  intros a b c HV Hl Hr L.
  assert (Value : exact env plane_2_left = - det a b c) by (unfold a, b, c; lay_open; ring).
  rewrite <- Value.
  apply determinant_filter with (unit := u) (right := plane_1_right) (a := a) (b := b) (c := c) (l := l) (r := r)
    (most_size := 11548 / 10000); try assumption.
  - apply u_positive.
  - lra.
  - apply Rle_trans with (permanent a b c); [| apply permanent_bound].
    apply Req_le. unfold a, b, c; sizes.
  - unfold a, b, c; lay_open; ring.
  - sizes.
  - apply plane_margin; ranges.
Qed.

(* The filter of orientation: det(a - o, b - a, c - a). *)
Lemma orientation_margin E G :
  0 <= E <= most u (count 1 1 orientation_2_left) -> 0 <= G <= most u (count 1 1 orientation_1_right) ->
  11548 / 10000 * E * (11548 / 10000 * E) * (1 + u) <= factor orientation_1_right * (1 - G).
Proof.
  intros HE HG. apply Rnot_lt_le. intro N. apply (certificate_orientation.l1 E G).
  unfold certificate_orientation.s1, certificate_orientation.s2, certificate_orientation.s3, not. certify.
Qed.

Theorem orientation_filter env V l r :
  let a := difference (triple env 0) (triple env 9) in
  let b := difference (triple env 3) (triple env 0) in
  let c := difference (triple env 6) (triple env 0) in
  computes u 1 1 env orientation_2_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env orientation_1_right r -> r < l -> 0 < V *  det a b c.
Proof.
  intros a b c HV Hl Hr L.
  assert (Value : exact env orientation_2_left =  det a b c) by (unfold a, b, c; lay_open; ring).
  rewrite <- Value.
  apply determinant_filter with (unit := u) (right := orientation_1_right) (a := a) (b := b) (c := c) (l := l) (r := r)
    (most_size := 11548 / 10000); try assumption.
  - apply u_positive.
  - lra.
  - apply Rle_trans with (permanent a b c); [| apply permanent_bound].
    apply Req_le. unfold a, b, c; sizes.
  - unfold a, b, c; lay_open; ring.
  - sizes.
  - apply orientation_margin; ranges.
Qed.

(* orientation_extended, with numbers of 64 bits. *)
Lemma orientation_extended_margin E G :
  0 <= E <= most v (count 1 1 orientation_extended_1_left) -> 0 <= G <= most v (count 1 1 orientation_extended_0_right) ->
  11548 / 10000 * E * (11548 / 10000 * E) * (1 + v) <= factor orientation_extended_0_right * (1 - G).
Proof.
  intros HE HG. apply Rnot_lt_le. intro N. apply (certificate_orientation_extended.l1 E G).
  unfold certificate_orientation_extended.s1, certificate_orientation_extended.s2, certificate_orientation_extended.s3, not. certify.
Qed.

Theorem orientation_extended_filter env V l r :
  let a := difference (triple env 0) (triple env 9) in
  let b := difference (triple env 3) (triple env 0) in
  let c := difference (triple env 6) (triple env 0) in
  computes v 1 1 env orientation_extended_1_left V -> Rabs (l - V * V) <= v * Rabs (V * V) ->
  computes v 1 1 env orientation_extended_0_right r -> r < l -> 0 < V *  det a b c.
Proof.
  intros a b c HV Hl Hr L.
  assert (Value : exact env orientation_extended_1_left =  det a b c) by (unfold a, b, c; lay_open; ring).
  rewrite <- Value.
  apply determinant_filter with (unit := v) (right := orientation_extended_0_right) (a := a) (b := b) (c := c) (l := l) (r := r)
    (most_size := 11548 / 10000); try assumption.
  - apply v_positive.
  - lra.
  - apply Rle_trans with (permanent a b c); [| apply permanent_bound].
    apply Req_le. unfold a, b, c; sizes.
  - unfold a, b, c; lay_open; ring.
  - sizes.
  - apply orientation_extended_margin; ranges.
Qed.

(* sign_of_change (overlay): the first coordinate of a (y.d) - d (y.a), d = b - a. *)
Lemma change_margin E G :
  0 <= E <= most u (count 1 1 change_2_left) -> 0 <= G <= most u (count 1 1 change_1_right) ->
  2 * E * (2 * E) * (1 + u) <= factor change_1_right * (1 - G).
Proof.
  intros HE HG. apply Rnot_lt_le. intro N. apply (certificate_change.l1 E G).
  unfold certificate_change.s1, certificate_change.s2, certificate_change.s3, not. certify.
Qed.

Theorem change_filter env V l r :
  let a := triple env 0 in
  let d := difference (triple env 3) a in
  let p := triple env 6 in
  computes u 1 1 env change_2_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env change_1_right r -> r < l -> 0 < V * (x a * dot p d - x d * dot p a).
Proof.
  intros a d p HV Hl Hr L.
  assert (Value : exact env change_2_left = x a * dot p d - x d * dot p a) by (unfold a, d, p; lay_open; ring).
  rewrite <- Value.
  apply determinant_filter with (unit := u) (right := change_1_right) (a := a) (b := d) (c := p) (l := l) (r := r)
    (most_size := 2); try assumption.
  - apply u_positive.
  - lra.
  - eapply Rle_trans; [| apply change_size]. apply Req_le. unfold a, d, p; sizes.
  - unfold a, d, p; lay_open; ring.
  - sizes.
  - apply change_margin; ranges.
Qed.
