(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Lengths of vectors of three numbers, and what determinants and permanents have to do with them. *)
From Coq Require Import Reals Psatz.
From Flocq Require Import Core.
Open Scope R_scope.

Record vector := Vector { x : R; y : R; z : R }.

Definition dot a b := x a * x b + y a * y b + z a * z b.
Definition square a := dot a a.
Definition length a := sqrt (square a).
Definition difference a b := Vector (x a - x b) (y a - y b) (z a - z b).
Definition sum a b := Vector (x a + x b) (y a + y b) (z a + z b).
Definition cross a b :=
  Vector (y a * z b - z a * y b) (z a * x b - x a * z b) (x a * y b - y a * x b).
Definition det a b c := dot a (cross b c).
Definition absolute a := Vector (Rabs (x a)) (Rabs (y a)) (Rabs (z a)).
(* The cross product with all terms positive. *)
Definition weights a b :=
  let c := absolute a in
  let d := absolute b in
  Vector (y c * z d + z c * y d) (z c * x d + x c * z d) (x c * y d + y c * x d).
Definition permanent a b c := dot (absolute a) (weights b c).

Lemma square_positive a : 0 <= square a.
Proof. destruct a. unfold square, dot; simpl. nra. Qed.

Lemma length_positive a : 0 <= length a.
Proof. apply sqrt_pos. Qed.

Lemma length_square a : length a * length a = square a.
Proof. apply sqrt_sqrt, square_positive. Qed.

(* From squares to sizes. *)
Lemma below_by_squares v l : 0 <= l -> v * v <= l * l -> Rabs v <= l.
Proof. intros. apply Rabs_le. split; nra. Qed.

Lemma cauchy a b : Rabs (dot a b) <= length a * length b.
Proof.
  assert (La := length_positive a). assert (Lb := length_positive b).
  apply below_by_squares; [nra |].
  replace (length a * length b * (length a * length b)) with (square a * square b)
    by (rewrite <- !length_square; ring).
  destruct a as [a1 a2 a3], b as [b1 b2 b3]. unfold square, dot; simpl.
  assert (0 <= (a1 * b2 - a2 * b1) * (a1 * b2 - a2 * b1)) by apply Rle_0_sqr.
  assert (0 <= (a2 * b3 - a3 * b2) * (a2 * b3 - a3 * b2)) by apply Rle_0_sqr.
  assert (0 <= (a3 * b1 - a1 * b3) * (a3 * b1 - a1 * b3)) by apply Rle_0_sqr.
  lra.
Qed.

Lemma length_of_sum a b : length (sum a b) <= length a + length b.
Proof.
  assert (C := cauchy a b). apply Rabs_le_inv in C.
  assert (La := length_positive a). assert (Lb := length_positive b).
  apply Rle_trans with (Rabs (length (sum a b))); [apply Rle_abs |].
  apply below_by_squares; [lra |]. rewrite length_square.
  replace ((length a + length b) * (length a + length b))
    with (length a * length a + length b * length b + 2 * (length a * length b)) by ring.
  rewrite !length_square.
  replace (square (sum a b)) with (square a + square b + 2 * dot a b)
    by (destruct a, b; unfold square, dot; simpl; ring). lra.
Qed.

Lemma length_of_cross a b : length (cross a b) <= length a * length b.
Proof.
  assert (La := length_positive a). assert (Lb := length_positive b).
  apply Rle_trans with (Rabs (length (cross a b))); [apply Rle_abs |].
  apply below_by_squares; [nra |]. rewrite length_square.
  replace (length a * length b * (length a * length b)) with (square a * square b)
    by (rewrite <- !length_square; ring).
  replace (square (cross a b)) with (square a * square b - dot a b * dot a b)
    by (destruct a, b; unfold square, dot; simpl; ring). nra.
Qed.

(* Hadamard's inequality. *)
Lemma hadamard a b c : Rabs (det a b c) <= length a * length b * length c.
Proof.
  eapply Rle_trans; [apply cauchy |]. assert (L := length_positive a).
  rewrite Rmult_assoc. apply Rmult_le_compat_l; [assumption | apply length_of_cross].
Qed.

Lemma square_of_absolute a : square (absolute a) = square a.
Proof.
  destruct a. unfold square, dot, absolute; simpl. rewrite <- !Rabs_mult, !Rabs_pos_eq; try reflexivity; nra.
Qed.

Lemma length_of_absolute a : length (absolute a) = length a.
Proof. unfold length. rewrite square_of_absolute. reflexivity. Qed.

Lemma square_of_weights a b : square (weights a b) <= 4 / 3 * (square a * square b).
Proof.
  rewrite <- (square_of_absolute a), <- (square_of_absolute b).
  unfold weights. generalize (absolute a), (absolute b). intros [a1 a2 a3] [b1 b2 b3].
  unfold square, dot; simpl.
  assert (0 <= (a1 * b2 - a2 * b1) * (a1 * b2 - a2 * b1)) by apply Rle_0_sqr.
  assert (0 <= (a2 * b3 - a3 * b2) * (a2 * b3 - a3 * b2)) by apply Rle_0_sqr.
  assert (0 <= (a3 * b1 - a1 * b3) * (a3 * b1 - a1 * b3)) by apply Rle_0_sqr.
  assert (0 <= (a1 * b1 - a2 * b2) * (a1 * b1 - a2 * b2)) by apply Rle_0_sqr.
  assert (0 <= (a2 * b2 - a3 * b3) * (a2 * b2 - a3 * b3)) by apply Rle_0_sqr.
  assert (0 <= (a3 * b3 - a1 * b1) * (a3 * b3 - a1 * b1)) by apply Rle_0_sqr.
  lra.
Qed.

(* 2 / sqrt 3 < 1.1548 *)
Lemma length_of_weights a b : length (weights a b) <= 11548 / 10000 * (length a * length b).
Proof.
  assert (La := length_positive a). assert (Lb := length_positive b).
  apply Rle_trans with (Rabs (length (weights a b))); [apply Rle_abs |].
  apply below_by_squares; [nra |]. rewrite length_square.
  assert (S := square_of_weights a b).
  replace (11548 / 10000 * (length a * length b) * (11548 / 10000 * (length a * length b)))
    with (11548 / 10000 * (11548 / 10000) * ((length a * length a) * (length b * length b))) by ring.
  rewrite !length_square. assert (0 <= square a * square b)
    by (apply Rmult_le_pos; apply square_positive). lra.
Qed.

Lemma permanent_bound a b c : permanent a b c <= 11548 / 10000 * (length a * length b * length c).
Proof.
  unfold permanent. eapply Rle_trans; [apply Rle_abs |]. eapply Rle_trans; [apply cauchy |].
  rewrite length_of_absolute. assert (W := length_of_weights b c). assert (L := length_positive a).
  assert (length a * length (weights b c) <= length a * (11548 / 10000 * (length b * length c)))
    by (apply Rmult_le_compat_l; assumption). lra.
Qed.

Lemma permanent_positive a b c : 0 <= permanent a b c.
Proof.
  unfold permanent, weights, dot, absolute; simpl.
  assert (P := Rabs_pos (x a)). assert (P1 := Rabs_pos (y a)). assert (P2 := Rabs_pos (z a)).
  assert (Q := Rabs_pos (x b)). assert (Q1 := Rabs_pos (y b)). assert (Q2 := Rabs_pos (z b)).
  assert (S := Rabs_pos (x c)). assert (S1 := Rabs_pos (y c)). assert (S2 := Rabs_pos (z c)).
  repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; try assumption;
    apply Rplus_le_le_0_compat; apply Rmult_le_pos; assumption.
Qed.

(* The length is at most the sum of the sizes of the coordinates. *)
Lemma length_below_sum a : length a <= Rabs (x a) + Rabs (y a) + Rabs (z a).
Proof.
  rewrite <- length_of_absolute. apply Rle_trans with (Rabs (length (absolute a))); [apply Rle_abs |].
  assert (P := Rabs_pos (x a)). assert (P1 := Rabs_pos (y a)). assert (P2 := Rabs_pos (z a)).
  apply below_by_squares; [lra |]. rewrite length_square. unfold square, dot, absolute; simpl. nra.
Qed.

Lemma det_of_sums a b c e f g :
  Rabs (det (sum a e) (sum b f) (sum c g) - det a b c) <=
  (length a + length e) * (length b + length f) * (length c + length g) - length a * length b * length c.
Proof.
  replace (det (sum a e) (sum b f) (sum c g) - det a b c)
    with (det e b c + det a f c + det a b g + (det e f c + det e b g + det a f g + det e f g))
    by (destruct a, b, c, e, f, g; unfold det, dot, cross, sum; simpl; ring).
  assert (H1 := hadamard e b c). assert (H2 := hadamard a f c). assert (H3 := hadamard a b g).
  assert (H4 := hadamard e f c). assert (H5 := hadamard e b g). assert (H6 := hadamard a f g).
  assert (H7 := hadamard e f g).
  apply Rabs_le_inv in H1, H2, H3, H4, H5, H6, H7.
  apply Rabs_le. split; lra.
Qed.

Definition negated a := Vector (- x a) (- y a) (- z a).

Lemma length_of_negated a : length (negated a) = length a.
Proof. unfold length, square, dot, negated; simpl. f_equal. ring. Qed.

Lemma difference_is_sum a b : difference a b = sum a (negated b).
Proof. destruct a, b; unfold difference, sum, negated; simpl. f_equal; ring. Qed.

Lemma length_of_difference a b : length (difference a b) <= length a + length b.
Proof. rewrite difference_is_sum, <- (length_of_negated b). apply length_of_sum. Qed.

Lemma coordinate_below_length a : Rabs (x a) <= length a.
Proof.
  apply below_by_squares; [apply length_positive |]. rewrite length_square. unfold square, dot.
  assert (0 <= y a * y a) by nra. assert (0 <= z a * z a) by nra. lra.
Qed.

Lemma sum_of_products_bound a b : dot (absolute a) (absolute b) <= length a * length b.
Proof.
  eapply Rle_trans; [apply Rle_abs |]. eapply Rle_trans; [apply cauchy |]. rewrite !length_of_absolute. lra.
Qed.

(* Two products of a coordinate and a scalar product. *)
Lemma change_size a d y0 :
  Rabs (x a) * dot (absolute y0) (absolute d) + Rabs (x d) * dot (absolute y0) (absolute a) <=
  2 * (length a * length d * length y0).
Proof.
  assert (A := coordinate_below_length a). assert (D := coordinate_below_length d).
  assert (P := sum_of_products_bound y0 d). assert (Q := sum_of_products_bound y0 a).
  assert (Pa := Rabs_pos (x a)). assert (Pd := Rabs_pos (x d)).
  assert (La := length_positive a). assert (Ld := length_positive d). assert (Ly := length_positive y0).
  assert (Positive : forall b c, 0 <= dot (absolute b) (absolute c)).
  { intros b c. unfold dot, absolute; simpl. rewrite <- !Rabs_mult.
    repeat apply Rplus_le_le_0_compat; apply Rabs_pos. }
  assert (Rabs (x a) * dot (absolute y0) (absolute d) <= length a * (length y0 * length d))
    by (apply Rmult_le_compat; auto).
  assert (Rabs (x d) * dot (absolute y0) (absolute a) <= length d * (length y0 * length a))
    by (apply Rmult_le_compat; auto). lra.
Qed.

Lemma length_monotone a b :
  Rabs (x a) <= x b -> Rabs (y a) <= y b -> Rabs (z a) <= z b -> length a <= length b.
Proof.
  intros X Y Z. apply Rle_trans with (Rabs (length a)); [apply Rle_abs |].
  apply below_by_squares; [apply length_positive |]. rewrite !length_square. unfold square, dot.
  assert (Square : forall v w, Rabs v <= w -> v * v <= w * w).
  { intros v w H. assert (P := Rabs_pos v). rewrite <- (Rabs_pos_eq (v * v)) by nra. rewrite Rabs_mult.
    apply Rmult_le_compat; assumption. }
  assert (A := Square _ _ X). assert (B := Square _ _ Y). assert (C := Square _ _ Z). lra.
Qed.

Definition scaled k a := Vector (k * x a) (k * y a) (k * z a).

Lemma length_of_scaled k a : 0 <= k -> length (scaled k a) = k * length a.
Proof.
  intros K. unfold length. replace (square (scaled k a)) with ((k * k) * square a)
    by (unfold square, dot, scaled; simpl; ring).
  rewrite sqrt_mult; [rewrite sqrt_square by assumption; reflexivity | nra | apply square_positive].
Qed.
