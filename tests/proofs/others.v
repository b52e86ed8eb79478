(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Stored directions themselves, doubles with exponents of their own, and pairs of doubles. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry acceptance formulas stored distances sums.
From Rondel Require certificate_direction certificate_orientation_wide certificate_plane_double_double
  certificate_circle_double_double certificate_angle_double_double.
Open Scope R_scope.

(* --- direction_error --- *)

Lemma direction_margin d e G D :
  - u <= d <= u -> - u <= e <= u -> Rabs G <= most u (count 1 1 norm_0_left) -> 0 <= D <= 1025 / 1024 * u ->
  Rabs ((1 + d) / ((1 + e) * sqrt (1 + G)) - 1) <= eta - D.
Proof.
  intros Hd He HG HD. apply Rnot_lt_le. intro N. assert (P := Rabs_pos G).
  apply (certificate_direction.l1 d e G D).
  unfold certificate_direction.s1, certificate_direction.s2, certificate_direction.s3,
    certificate_direction.s4, certificate_direction.s5, not.
  unfold eta, factor, direction_error in *. numbers. repeat split; try lra; intro; lra.
Qed.

(* The unit vector along v. *)
Definition unit_vector v := scaled (/ length v) v.

Lemma length_of_unit_vector v : 0 < length v -> length (unit_vector v) = 1.
Proof.
  intros P. unfold unit_vector. rewrite length_of_scaled by (left; apply Rinv_0_lt_compat; assumption).
  field. lra.
Qed.

(* The unit vectors along two vectors are at most as far apart as these, over the geometric mean of the lengths. *)
Lemma unit_vectors_apart v w :
  0 < length v -> 0 < length w ->
  square (difference (unit_vector v) (unit_vector w)) * (length v * length w) <= square (difference v w).
Proof.
  intros V W. unfold unit_vector. set (a := length v) in *. set (b := length w) in *.
  replace (square (difference (scaled (/ a) v) (scaled (/ b) w)))
    with (square v * (/ a * / a) + square w * (/ b * / b) - 2 * (/ a * / b) * dot v w)
    by (unfold square, dot, difference, scaled; simpl; ring).
  replace (square (difference v w)) with (square v + square w - 2 * dot v w)
    by (unfold square, dot, difference; simpl; ring).
  rewrite <- !length_square. fold a b.
  replace ((a * a * (/ a * / a) + b * b * (/ b * / b) - 2 * (/ a * / b) * dot v w) * (a * b))
    with (2 * (a * b) - 2 * dot v w) by (field; lra).
  assert (0 <= (a - b) * (a - b)) by apply Rle_0_sqr. lra.
Qed.

(* The formula of a square of three rounded differences is that of three numbers. *)
Fixpoint with_differences (t : term) : term :=
  match t with
  | Given n => Minus (Given n) (Given (n + 3))
  | Plus a b => Plus (with_differences a) (with_differences b)
  | Times a b => Times (with_differences a) (with_differences b)
  | _ => t
  end.

Lemma direction_takes_the_norm_of_differences :
  direction_Root_100_of = with_differences norm_0_left /\
  direction_Quotient_101_of = with_differences (Given 0) /\ direction_Quotient_101_by = Given 100 /\
  direction_Quotient_102_of = with_differences (Given 1) /\ direction_Quotient_102_by = Given 100 /\
  direction_Quotient_103_of = with_differences (Given 2) /\ direction_Quotient_103_by = Given 100.
Proof. repeat split. Qed.

(* direction(): env has the rounded differences w, s is the sum of their squares, l its root, q the quotients. *)
Theorem direction_is_stored v env s l q :
  let w := triple env 0 in
  0 < length v ->
  Rabs (x w - x v) <= u * Rabs (x v) -> Rabs (y w - y v) <= u * Rabs (y v) -> Rabs (z w - z v) <= u * Rabs (z v) ->
  computes u 1 1 env norm_0_left s -> Rabs (l - sqrt s) <= u * Rabs (sqrt s) ->
  Rabs (x q - x w / l) <= u * Rabs (x w / l) -> Rabs (y q - y w / l) <= u * Rabs (y w / l) ->
  Rabs (z q - z w / l) <= u * Rabs (z w / l) -> is_stored q (unit_vector v).
Proof.
  intros w V Wx Wy Wz Hs Hl Qx Qy Qz. assert (U := u_positive).
  assert (U2 : u <= / 2048) by (rewrite u_value; lra).
  split; [apply length_of_unit_vector; assumption |].
  (* The rounded difference. *)
  assert (Off : length (difference w v) <= u * length v).
  { rewrite <- (length_of_absolute v), <- (length_of_scaled u (absolute v)) by assumption.
    apply length_monotone; unfold difference, scaled, absolute; simpl; assumption. }
  assert (Low : (1 - u) * length v <= length w).
  { assert (T : length v <= length w + length (difference w v)).
    { replace v with (difference w (difference w v)) at 1
        by (destruct v, w; unfold difference; simpl; f_equal; ring). apply length_of_difference. }
    lra. }
  assert (W : 0 < length w) by nra.
  set (D := length (difference (unit_vector v) (unit_vector w))).
  assert (HD : 0 <= D <= 1025 / 1024 * u).
  { split; [apply length_positive |].
    assert (A := unit_vectors_apart v w V W). fold (length (difference (unit_vector v) (unit_vector w))) in D.
    rewrite <- (length_square (difference (unit_vector v) (unit_vector w))) in A. fold D in A.
    assert (Same : square (difference v w) = square (difference w v))
      by (unfold square, dot, difference; simpl; ring).
    rewrite Same, <- length_square in A.
    assert (O2 : length (difference w v) * length (difference w v) <= (u * length v) * (u * length v)).
    { assert (P := length_positive (difference w v)). apply Rmult_le_compat; assumption. }
    assert (Lvw : length v * ((1 - u) * length v) <= length v * length w) by (apply Rmult_le_compat_l; lra).
    assert (D2 : 0 <= D * D) by nra.
    assert (D * D * (length v * ((1 - u) * length v)) <= u * length v * (u * length v)).
    { eapply Rle_trans; [apply Rmult_le_compat_l; [assumption | exact Lvw] |]. lra. }
    assert (D * D * (1 - u) <= u * u).
    { apply Rmult_le_reg_r with (length v * length v); [nra |]. lra. }
    apply Rnot_lt_le. intro Far. assert (P : 0 <= 1025 / 1024 * u) by lra.
    assert ((1025 / 1024 * u) * (1025 / 1024 * u) <= D * D) by (apply Rmult_le_compat; lra).
    assert (Up : 0 < u) by (rewrite u_value; lra).
    assert (0 < u * u) by nra. nra. }
  (* The root. *)
  assert (Norm : exact env norm_0_left = square w) by (unfold w; lay_open; ring).
  assert (Size : size env norm_0_left = square w) by (unfold w; sizes).
  assert (E := error_of_formula u U 1 1 env norm_0_left s Hs). rewrite Norm, Size in E.
  assert (HG : 0 <= gamma u (count 1 1 norm_0_left) <= most u (count 1 1 norm_0_left)) by ranges.
  assert (S0 : 0 < square w) by (rewrite <- length_square; nra).
  set (G := s / square w - 1).
  assert (HG2 : Rabs G <= most u (count 1 1 norm_0_left)).
  { apply Rle_trans with (gamma u (count 1 1 norm_0_left)); [| apply HG].
    apply Rmult_le_reg_r with (square w); [assumption |].
    rewrite <- (Rabs_pos_eq (square w)) at 1 by lra. rewrite <- Rabs_mult.
    replace (G * square w) with (s - square w) by (unfold G; field; lra). assumption. }
  assert (G1 : most u (count 1 1 norm_0_left) < 1) by (compute_counts; unfold most; simpl; rewrite u_value; lra).
  assert (GP : 0 < 1 + G) by (apply Rabs_le_inv in HG2; lra).
  assert (Sq : sqrt s = length w * sqrt (1 + G)).
  { replace s with (square w * (1 + G)) by (unfold G; field; lra).
    rewrite sqrt_mult by lra. reflexivity. }
  assert (RG : 0 < sqrt (1 + G)) by (apply sqrt_lt_R0; assumption).
  assert (RS : 0 < sqrt s) by (rewrite Sq; apply Rmult_lt_0_compat; assumption).
  set (e := l / sqrt s - 1).
  assert (He : - u <= e <= u).
  { rewrite (Rabs_pos_eq (sqrt s)) in Hl by lra. apply Rabs_le_inv in Hl. unfold e.
    assert (I : 0 < / sqrt s) by (apply Rinv_0_lt_compat; assumption).
    assert (One : sqrt s * / sqrt s = 1) by (field; lra).
    unfold Rdiv. split; nra. }
  assert (L : l = (1 + e) * (length w * sqrt (1 + G))) by (rewrite <- Sq; unfold e; field; lra).
  assert (E1 : 0 < 1 + e) by lra.
  assert (L0 : 0 < l) by (rewrite L; repeat apply Rmult_lt_0_compat; assumption).
  (* The quotients. *)
  assert (Each : forall c p, Rabs (p - c / l) <= u * Rabs (c / l) ->
                   Rabs (/ length w * c - p) <= (eta - D) * Rabs (/ length w * c)).
  { intros c p Hp.
    destruct (Req_dec c 0) as [-> | C].
    { unfold Rdiv in Hp. rewrite Rmult_0_l, Rabs_R0, Rmult_0_r, Rminus_0_r in Hp.
      assert (p = 0) by (apply Rabs_eq_R0, Rle_antisym; [assumption | apply Rabs_pos]). subst p.
      rewrite Rmult_0_r, Rminus_0_r, Rabs_R0. lra. }
    set (d := p / (c / l) - 1).
    assert (CL : c / l <> 0) by (unfold Rdiv; apply Rmult_integral_contrapositive_currified;
      [assumption | apply Rinv_neq_0_compat; lra]).
    assert (Hd : - u <= d <= u).
    { assert (Q : Rabs d <= u).
      { apply Rmult_le_reg_r with (Rabs (c / l)); [apply Rabs_pos_lt; assumption |].
        rewrite <- Rabs_mult. replace (d * (c / l)) with (p - c / l) by (unfold d; field; lra). assumption. }
      apply Rabs_le_inv in Q. lra. }
    assert (M := direction_margin d e G D Hd He HG2 HD).
    replace (/ length w * c - p)
      with (- (((1 + d) / ((1 + e) * sqrt (1 + G)) - 1) * (/ length w * c))).
    - rewrite Rabs_Ropp, Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos | assumption].
    - replace p with (c / l * (1 + d)) by (unfold d; field; lra). rewrite L. field. lra. }
  assert (Margin0 : 0 <= eta - D).
  { assert (M := direction_margin 0 e G D ltac:(lra) He HG2 HD). eapply Rle_trans; [apply Rabs_pos | exact M]. }
  assert (Rounded : length (difference (unit_vector w) q) <= eta - D).
  { apply Rle_trans with (length (scaled (eta - D) (absolute (unit_vector w)))).
    - apply length_monotone; unfold difference, scaled, absolute, unit_vector; simpl; apply Each; assumption.
    - rewrite length_of_scaled by assumption. rewrite length_of_absolute, length_of_unit_vector by assumption. lra. }
  replace (difference (unit_vector v) q)
    with (sum (difference (unit_vector v) (unit_vector w)) (difference (unit_vector w) q))
    by (unfold sum, difference; simpl; f_equal; ring).
  eapply Rle_trans; [apply length_of_sum |]. fold D. lra.
Qed.

(* --- orientation_wide_bound --- *)

Lemma orientation_wide_margin (shift : nat -> Z) E G :
  0 <= E <= most u (count 1 1 (orientation_wide_1_left shift)) ->
  0 <= G <= most u (count 1 1 (orientation_wide_0_right shift)) ->
  E <= factor (orientation_wide_0_right shift) * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_orientation_wide.l1 E G).
  unfold certificate_orientation_wide.s1, certificate_orientation_wide.s2, certificate_orientation_wide.s3, not.
  certify.
Qed.

(* The powers of two by which coordinates and products are multiplied: all six products get the same ones. *)
Definition is_consistent (shift : nat -> Z) (c : Z) : Prop :=
  let product i j k l := (shift i + shift j + shift k + shift l)%Z = c in
  (product 0 1 2 3 /\ product 4 1 5 6 /\ product 7 8 5 9 /\ product 10 8 11 3 /\ product 12 13 11 6 /\
   product 14 13 2 9)%nat /\
  (shift 15 = shift 0 /\ shift 16 = shift 4 /\ shift 17 = shift 7 /\ shift 18 = shift 10 /\
   shift 19 = shift 12 /\ shift 20 = shift 14)%nat.

Lemma scaled_product a b c s t r w e :
  (w + s + t + r)%Z = e ->
  a * bpow radix2 s * (b * bpow radix2 t) * (c * bpow radix2 r) * bpow radix2 w = a * b * c * bpow radix2 e.
Proof. intros <-. rewrite !bpow_plus. ring. Qed.

(* The wide filter of orientation: det(a - o, b - o, c - o), with any consistent powers of two. *)
Theorem orientation_wide_filter shift e env V r :
  is_consistent shift e ->
  computes u 1 1 env (orientation_wide_1_left shift) V -> computes u 1 1 env (orientation_wide_0_right shift) r ->
  r < Rabs V ->
  0 < V * det (difference (triple env 0) (triple env 9)) (difference (triple env 3) (triple env 9))
              (difference (triple env 6) (triple env 9)).
Proof.
  intros [[C1 [C2 [C3 [C4 [C5 C6]]]]] [S1 [S2 [S3 [S4 [S5 S6]]]]]] HV Hr L.
  set (d := det _ _ _).
  assert (Value : exact env (orientation_wide_1_left shift) = d * bpow radix2 e).
  { unfold d. lay_open. rewrite !(scaled_product _ _ _ _ _ _ _ e) by lia. ring. }
  assert (Positive : 0 < V * exact env (orientation_wide_1_left shift)).
  { apply products_filter with (right := orientation_wide_0_right shift) (r := r); try assumption.
    - lay_open. repeat rewrite ?Rabs_mult, ?Rabs_Rabsolu, ?(Rabs_pos_eq (bpow radix2 _)) by apply bpow_ge_0.
      rewrite (Rabs_pos_eq (constant _ _)) by (apply constant_positive; lia). ring.
    - lay_open. rewrite ?Rabs_mult, ?(Rabs_pos_eq (bpow radix2 _)) by apply bpow_ge_0.
      rewrite S1, S2, S3, S4, S5, S6. ring.
    - apply (orientation_wide_margin shift); ranges.
    - apply constant_positive; lia. }
  rewrite Value in Positive. assert (B := bpow_gt_0 radix2 e).
  apply Rmult_lt_reg_r with (bpow radix2 e); [assumption |]. lra.
Qed.

(* --- pairs of doubles: a sum is off by 3 u^2, a product by 7 u^2 (Joldes, Muller and Popescu 2017) --- *)

Definition u2 : R := bpow radix2 (-106).
Lemma u2_positive : 0 <= u2.
Proof. apply bpow_ge_0. Qed.
Lemma u2_value : u2 = / 81129638414606681695789005144064.
Proof. reflexivity. Qed.

(* The value of both determinants, and that of the comparison of angles. *)
Definition determinant : term := Opposite plane_double_double_High_109_of.
Definition distances : term := angle_double_double_High_100_of.

Lemma circle_takes_the_determinant : circle_double_double_High_109_of = plane_double_double_High_109_of.
Proof. reflexivity. Qed.

Ltac pair_ranges :=
  apply gamma_range; [apply u2_positive | compute_counts; simpl; rewrite u2_value; lra].

Lemma plane_double_double_margin E :
  0 <= E <= most u2 (count 3 7 determinant) ->
  11548 / 10000 * E * (11548 / 10000 * E) * (1 + u) <=
  factor plane_double_double_1_right * (1 - / 1099511627776) * ((1 - u) * (1 - u)).
Proof.
  intros HE. apply Rnot_lt_le. intro. apply (certificate_plane_double_double.l1 E).
  unfold certificate_plane_double_double.s1, certificate_plane_double_double.s2, not.
  unfold factor, plane_double_double_1_right, u2 in *. certify.
Qed.

(* What is used of side_of_plane_double_double, of exact pairs: P is the product of their lengths, h the high word of V. *)
Lemma plane_double_double_limit env V h l r :
  let b := triple env 0 in
  let c := triple env 3 in
  let d := triple env 6 in
  let P := length b * length c * length d in
  computes u2 3 7 env determinant V -> Rabs (h - V) <= u * Rabs h ->
  Rabs (l - h * h) <= u * Rabs (h * h) ->
  factor plane_double_double_1_right * (P * P) * (1 - / 1099511627776) <= r -> r < l -> 0 < h * - det b c d.
Proof.
  intros b c d P HV Hh Hl Hr L. assert (U := u_positive). assert (U1 : u <= / 2) by (rewrite u_value; lra).
  assert (Value : exact env determinant = - det b c d)
    by (unfold b, c, d; lay_open; ring).
  assert (HE : 0 <= gamma u2 (count 3 7 determinant)
               <= most u2 (count 3 7 determinant)) by pair_ranges.
  assert (M := plane_double_double_margin _ HE).
  assert (E := error_of_formula u2 u2_positive 3 7 env _ V HV). rewrite Value in E.
  replace (size env determinant) with (permanent b c d) in E
    by (unfold b, c, d; symmetry; sizes).
  set (g := gamma u2 (count 3 7 determinant)) in *.
  assert (B := permanent_bound b c d). fold P in B.
  assert (P0 : 0 <= P) by (unfold P; repeat apply Rmult_le_pos; apply length_positive).
  assert (E' : Rabs (V - - det b c d) <= 11548 / 10000 * g * P).
  { eapply Rle_trans; [exact E |].
    assert (g * permanent b c d <= g * (11548 / 10000 * P)) by (apply Rmult_le_compat_l; [apply HE | assumption]). lra. }
  (* The word h has the sign of V, and nearly its size. *)
  assert (Big : (1 - u) * Rabs h <= Rabs V).
  { assert (T := Rabs_triang_inv h (h - V)). replace (h - (h - V)) with V in T by ring. lra. }
  assert (h2 : 0 <= h * h) by nra. rewrite (Rabs_pos_eq (h * h)) in Hl by assumption. apply Rabs_le_inv in Hl.
  set (K := factor plane_double_double_1_right) in *.
  assert (Square : 11548 / 10000 * g * P * (11548 / 10000 * g * P) < Rabs V * Rabs V).
  { assert (PP : 0 <= P * P) by nra.
    assert (M' := Rmult_le_compat_r (P * P) _ _ PP M).
    assert (Hu : 0 < (1 - u) * (1 - u)) by nra.
    assert (Lh : K * (P * P) * (1 - / 1099511627776) < h * h * (1 + u)) by lra.
    assert (Lh' := Rmult_lt_compat_r _ _ _ Hu Lh).
    assert (Bh : 0 <= (1 - u) * Rabs h) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
    assert (BB : (1 - u) * Rabs h * ((1 - u) * Rabs h) <= Rabs V * Rabs V) by (apply Rmult_le_compat; assumption).
    replace ((1 - u) * Rabs h * ((1 - u) * Rabs h)) with ((1 - u) * (1 - u) * (h * h)) in BB
      by (rewrite <- (Rabs_square h); ring).
    apply Rmult_lt_reg_r with (1 + u); [lra |].
    assert (BB' := Rmult_le_compat_r (1 + u) _ _ ltac:(lra) BB). lra. }
  assert (G0 : 0 <= 11548 / 10000 * g * P) 
    by (apply Rmult_le_pos; [apply Rmult_le_pos; [lra | apply HE] | assumption]).
  assert (PV := Rabs_pos V). assert (Beyond : 11548 / 10000 * g * P < Rabs V) by nra.
  assert (Sign := right_sign V _ _ E' Beyond).
  (* h and V have one sign. *)
  assert (HVs : 0 < h * V).
  { assert (H0 : h <> 0) by (intros ->; rewrite Rmult_0_l in *; assert (0 <= K * (P * P)) by
      (apply Rmult_le_pos; [apply constant_positive; lia | nra]); lra).
    assert (Hp := Rabs_pos_lt h H0). apply right_sign with (u * Rabs h); [assumption |]. nra. }
  assert (0 < h * V * (V * - det b c d)) by (apply Rmult_lt_0_compat; assumption).
  assert (0 < V * V) by nra. nra.
Qed.

(* The margin of circle_double_double_bound: the differences are off by 2^-99 at most. *)
Lemma circle_double_double_margin E H w :
  0 <= E <= most u2 (count 3 7 determinant) -> 0 <= H <= 2049 / 1024 ->
  0 <= w <= 562949953421312 ->
  let T := constant 1 (-99) in
  11548 / 10000 * E * H + T * (3 + 3 * (T * w) + T * w * (T * w)) <=
  factor circle_double_double_1_right * (1 - / 1099511627776) * (1 - u).
Proof.
  intros HE HH Hw T. apply Rnot_lt_le. intro. apply (certificate_circle_double_double.l1 E H w).
  unfold certificate_circle_double_double.s1, certificate_circle_double_double.s2,
    certificate_circle_double_double.s3, certificate_circle_double_double.s4, not.
  subst T. unfold factor, circle_double_double_1_right, u2 in *. certify.
Qed.

(* What is used of side_of_circle_double_double, of pairs that are differences of unit vectors within 2^-99: H is the longest
   one, h the high word of V. The filter refuses H^2 below a half of its bound. *)
Lemma circle_double_double_limit env eb ec ed ep V h r H :
  let b := triple env 0 in
  let c := triple env 3 in
  let d := triple env 6 in
  let T := constant 1 (-99) in
  length (difference (difference eb ep) b) <= T -> length (difference (difference ec ep) c) <= T ->
  length (difference (difference ed ep) d) <= T ->
  length b <= H -> length c <= H -> length d <= H -> / 562949953421312 <= H <= 2049 / 1024 ->
  computes u2 3 7 env determinant V -> Rabs (h - V) <= u * Rabs h ->
  factor circle_double_double_1_right * (H * H) * (1 - / 1099511627776) <= r -> r < Rabs h ->
  0 < h * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof.
  intros b c d T Tb Tc Td Hb Hc Hd HH HV Hh Hr L. assert (U := u_positive).
  assert (U1 : u <= / 2) by (rewrite u_value; lra).
  assert (Value : exact env determinant = - det b c d)
    by (unfold b, c, d; lay_open; ring).
  assert (HE : 0 <= gamma u2 (count 3 7 determinant)
               <= most u2 (count 3 7 determinant)) by pair_ranges.
  assert (E := error_of_formula u2 u2_positive 3 7 env _ V HV). rewrite Value in E.
  replace (size env determinant) with (permanent b c d) in E
    by (unfold b, c, d; symmetry; sizes).
  set (g := gamma u2 (count 3 7 determinant)) in *.
  set (w := / H).
  assert (H0 : 0 < H) by lra.
  assert (Hw : 0 <= w <= 562949953421312).
  { unfold w. split; [left; apply Rinv_0_lt_compat; assumption |].
    rewrite <- (Rinv_inv 562949953421312). apply Rinv_le; lra. }
  assert (M := circle_double_double_margin g H w HE ltac:(lra) Hw). cbv zeta in M. fold T in M.
  assert (Lb := length_positive b). assert (Lc := length_positive c). assert (Ld := length_positive d).
  assert (T0 : 0 <= T) by (unfold T; apply constant_positive; lia).
  assert (BC : length b * length c <= H * H) by (apply Rmult_le_compat; assumption).
  assert (BCD : length b * length c * length d <= H * H * H).
  { apply Rmult_le_compat; try assumption. apply Rmult_le_pos; assumption. }
  assert (Rounding : Rabs (V + det b c d) <= 11548 / 10000 * g * (H * H * H)).
  { replace (V + det b c d) with (V - - det b c d) by ring. eapply Rle_trans; [exact E |].
    assert (B := permanent_bound b c d).
    assert (g * permanent b c d <= g * (11548 / 10000 * (H * H * H)))
      by (apply Rmult_le_compat_l; [apply HE | lra]). lra. }
  set (e := det (difference eb ep) (difference ec ep) (difference ed ep)).
  assert (Stored : Rabs (e - det b c d) <= T * (3 * (H * H) + 3 * (T * H) + T * T)).
  { unfold e. assert (Move : forall p q, p = sum q (difference p q)).
    { intros [p1 p2 p3] [q1 q2 q3]. unfold sum, difference; simpl. f_equal; ring. }
    rewrite (Move (difference eb ep) b), (Move (difference ec ep) c), (Move (difference ed ep) d).
    eapply Rle_trans; [apply change_of_det with (p := T) (q := T) (r := T); assumption |].
    replace ((length b + T) * (length c + T) * (length d + T) - length b * length c * length d)
      with (T * (length b * length c + length c * length d + length d * length b +
                 T * (length b + length c + length d) + T * T)) by ring.
    apply Rmult_le_compat_l; [assumption |].
    assert (length c * length d <= H * H) by (apply Rmult_le_compat; assumption).
    assert (length d * length b <= H * H) by (apply Rmult_le_compat; assumption).
    assert (T * (length b + length c + length d) <= T * (3 * H)) by (apply Rmult_le_compat_l; lra). lra. }
  set (K := factor circle_double_double_1_right) in *.
  assert (Big : (1 - u) * Rabs h <= Rabs V).
  { assert (X := Rabs_triang_inv h (h - V)). replace (h - (h - V)) with V in X by ring. lra. }
  assert (HHp : 0 < H * H) by (apply Rmult_lt_0_compat; assumption).
  assert (M' := Rmult_le_compat_r (H * H) _ _ ltac:(lra) M).
  assert (W : T * (3 + 3 * (T * w) + T * w * (T * w)) * (H * H) = T * (3 * (H * H) + 3 * (T * H) + T * T))
    by (unfold w; field; lra).
  assert (Beyond : K * (H * H) * (1 - / 1099511627776) * (1 - u) < Rabs V).
  { assert (K * (H * H) * (1 - / 1099511627776) * (1 - u) < Rabs h * (1 - u))
      by (apply Rmult_lt_compat_r; lra). lra. }
  assert (Sign : 0 < V * - e).
  { apply right_sign with (K * (H * H) * (1 - / 1099511627776) * (1 - u)); [| assumption].
    replace (V - - e) with ((V + det b c d) + (e - det b c d)) by ring.
    eapply Rle_trans; [apply Rabs_triang |]. lra. }
  assert (HVs : 0 < h * V).
  { assert (Hp : 0 < Rabs h).
    { eapply Rle_lt_trans; [| exact L]. eapply Rle_trans; [| exact Hr].
      apply Rmult_le_pos; [| lra]. apply Rmult_le_pos; [apply constant_positive; lia | lra]. }
    apply right_sign with (u * Rabs h); [assumption |]. nra. }
  assert (0 < h * V * (V * - e)) by (apply Rmult_lt_0_compat; assumption).
  assert (0 < V * V) by nra. nra.
Qed.

Lemma angle_double_double_margin E H w :
  0 <= E <= most u2 (count 3 7 distances) -> 0 <= H <= 2049 / 1024 -> 0 <= w <= 1 ->
  let T := constant 1 (-98) in
  let k := sqrt (factor angle_double_double_0_right * (1 - constant 1 (-40)) / (1 + one_u)) in
  2 * E * H + T * (4 + 4 * (T / k * w)) <= k * (1 - one_u).
Proof.
  intros HE HH Hw T k. apply Rnot_lt_le. intro. apply (certificate_angle_double_double.l1 E H w).
  unfold certificate_angle_double_double.s1, certificate_angle_double_double.s2,
    certificate_angle_double_double.s3, certificate_angle_double_double.s4, not.
  subst T k. unfold factor, angle_double_double_0_right, u2, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

(* What is used of compare_angle_double_double, of pairs that are differences of unit vectors within 2^-98, as differences of
   pairs of doubles are: H is the longer one, h the high word of V. *)
Lemma angle_double_double_limit env eb ea ep V h l r H :
  let b := triple env 0 in
  let a := triple env 3 in
  let T := constant 1 (-98) in
  length (difference (difference eb ep) b) <= T -> length (difference (difference ea ep) a) <= T ->
  length b <= H -> length a <= H -> 0 < H <= 2049 / 1024 ->
  computes u2 3 7 env distances V -> Rabs (h - V) <= u * Rabs h ->
  Rabs (l - h * h) <= u * Rabs (h * h) ->
  factor angle_double_double_0_right * (H * H) * (1 - constant 1 (-40)) <= r -> r < l ->
  0 < h * (square (difference eb ep) - square (difference ea ep)).
Proof.
  intros b a T Tb Ta Hb Ha HH HV Hh Hl Hr L. assert (U := u_positive).
  assert (U1 : u <= / 16) by (rewrite u_value; lra).
  assert (Value : exact env distances = square b - square a)
    by (unfold b, a; lay_open; ring).
  assert (Size : size env distances = square b + square a) by (unfold b, a; sizes).
  assert (HE : 0 <= gamma u2 (count 3 7 distances)
               <= most u2 (count 3 7 distances)) by pair_ranges.
  assert (E := error_of_formula u2 u2_positive 3 7 env _ V HV). rewrite Value, Size in E.
  set (g := gamma u2 (count 3 7 distances)) in *.
  assert (g1 : g <= / 16).
  { destruct HE as [_ HE]. revert HE. compute_counts. unfold most. simpl. rewrite u2_value. lra. }
  set (K := factor angle_double_double_0_right) in *.
  set (k := sqrt (K * (1 - constant 1 (-40)) / (1 + one_u))).
  assert (K0 : 0 < K) by (unfold K, factor, angle_double_double_0_right, constant; simpl; lra).
  assert (C40 : 0 <= constant 1 (-40) <= / 2) by (unfold constant; simpl; lra).
  assert (k0 : 0 < k) by (apply root_positive; lra).
  assert (Accepted : k * H < Rabs h).
  { unfold k. rewrite one_u_is. apply accepted with (l := l) (r := r); try assumption; try lra.
    apply Rmult_le_pos; lra. }
  assert (Lb := length_positive b). assert (La := length_positive a).
  assert (Sqb : square b <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
  assert (Sqa : square a <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
  assert (Pb := square_positive b). assert (Pa := square_positive a).
  assert (HHp : 0 < H * H) by (apply Rmult_lt_0_compat; lra).
  assert (Rounding : Rabs (V - (square b - square a)) <= 2 * g * (H * H)).
  { eapply Rle_trans; [exact E |].
    assert (g * (square b + square a) <= g * (2 * (H * H))) by (apply Rmult_le_compat_l; [apply HE | lra]). lra. }
  assert (Big : (1 - u) * Rabs h <= Rabs V).
  { assert (X := Rabs_triang_inv h (h - V)). replace (h - (h - V)) with V in X by ring. lra. }
  assert (Ph := Rabs_pos h).
  assert (HV2 : Rabs V <= (1 + 2 * g) * (H * H)).
  { replace V with ((V - (square b - square a)) + (square b - square a)) by ring.
    eapply Rle_trans; [apply Rabs_triang |].
    assert (Rabs (square b - square a) <= H * H) by (apply Rabs_le; split; lra). lra. }
  assert (Low : k <= 2 * H).
  { apply Rmult_le_reg_r with H; [lra |].
    assert (Rabs h <= 2 * (H * H)).
    { assert ((1 - u) * Rabs h <= (1 + 2 * g) * (H * H)) by lra.
      assert ((1 - / 16) * Rabs h <= (1 - u) * Rabs h) by (apply Rmult_le_compat_r; lra).
      assert ((1 + 2 * g) * (H * H) <= (1 + / 8) * (H * H)) by (apply Rmult_le_compat_r; lra). lra. }
    lra. }
  set (w := k / 2 / H).
  assert (Hw : 0 <= w <= 1) by (apply quotient_range; lra).
  assert (M := angle_double_double_margin g H w HE ltac:(lra) Hw). cbv zeta in M. fold T K k in M.
  assert (W : T / k * w = T / (2 * H)) by (unfold w; field; lra). rewrite W, one_u_is in M.
  assert (T0 : 0 <= T) by (unfold T; apply constant_positive; lia).
  assert (Move : forall p q, p = sum q (difference p q)).
  { intros [p1 p2 p3] [q1 q2 q3]. unfold sum, difference; simpl. f_equal; ring. }
  assert (Cb := change_of_square b (difference (difference eb ep) b) T H Hb Tb).
  assert (Ca := change_of_square a (difference (difference ea ep) a) T H Ha Ta).
  rewrite <- Move in Cb, Ca.
  set (X := square (difference eb ep)) in *. set (Y := square (difference ea ep)) in *.
  assert (M' := Rmult_le_compat_r H _ _ ltac:(lra) M).
  assert (S : (2 * g * H + T * (4 + 4 * (T / (2 * H)))) * H = 2 * g * (H * H) + 2 * (T * (2 * H + T)))
    by (field; lra). rewrite S in M'.
  assert (Sign : 0 < V * (X - Y)).
  { apply right_sign with (k * (1 - u) * H).
    - replace (V - (X - Y)) with ((V - (square b - square a)) + ((square b - X) - (square a - Y))) by ring.
      apply Rabs_le_inv in Cb, Ca, Rounding. apply Rabs_le. split; lra.
    - assert (k * H * (1 - u) < Rabs h * (1 - u)) by (apply Rmult_lt_compat_r; lra). lra. }
  assert (HVs : 0 < h * V).
  { assert (0 <= k * H) by (apply Rmult_le_pos; lra).
    apply right_sign with (u * Rabs h); [assumption |]. nra. }
  assert (0 < h * V * (V * (X - Y))) by (apply Rmult_lt_0_compat; assumption).
  assert (0 < V * V) by nra. nra.
Qed.

(* --- what the filters of pairs compare: high words, which are numbers from 100 on --- *)

(* g is the high word of x. *)
Definition is_high g x : Prop := Rabs (g - x) <= u * Rabs g.

Lemma square_of_high g x : is_high g x -> (1 - 2 * u) * (x * x) <= g * g.
Proof.
  intros H. assert (U := u_positive). assert (U1 : u <= / 2) by (rewrite u_value; lra). unfold is_high in H.
  assert (T := Rabs_triang_inv x g). rewrite Rabs_minus_sym in T.
  assert (X : Rabs x <= (1 + u) * Rabs g) by lra.
  assert (Px := Rabs_pos x). assert (Pg := Rabs_pos g).
  assert (S : Rabs x * Rabs x <= (1 + u) * Rabs g * ((1 + u) * Rabs g)) by (apply Rmult_le_compat; lra).
  rewrite Rabs_square in S.
  replace ((1 + u) * Rabs g * ((1 + u) * Rabs g)) with ((1 + u) * (1 + u) * (Rabs g * Rabs g)) in S by ring.
  rewrite Rabs_square in S. assert (G : 0 <= g * g) by nra.
  apply Rle_trans with ((1 - 2 * u) * ((1 + u) * (1 + u) * (g * g))); [apply Rmult_le_compat_l; lra |].
  assert ((1 - 2 * u) * ((1 + u) * (1 + u)) <= 1) by nra. nra.
Qed.

(* Numbers from 100 + k on are the high words of the pairs from k on. *)
Definition are_high env k : Prop :=
  is_high (env (100 + k)%nat) (env k) /\ is_high (env (101 + k)%nat) (env (S k)) /\
  is_high (env (102 + k)%nat) (env (S (S k))).

Lemma square_of_highs env k :
  are_high env k -> (1 - 2 * u) * square (triple env k) <= square (triple env (100 + k)).
Proof.
  intros [X [Y Z]]. apply square_of_high in X, Y, Z.
  unfold square, dot, triple; simpl in *. lra.
Qed.

Lemma product_of_highs c a b d A B D :
  0 <= c -> 0 <= a -> 0 <= b -> 0 <= d -> c * a <= A -> c * b <= B -> c * d <= D ->
  c * c * c * (a * b * d) <= A * B * D.
Proof.
  intros. replace (c * c * c * (a * b * d)) with (c * a * (c * b) * (c * d)) by ring.
  repeat apply Rmult_le_compat; try assumption; repeat apply Rmult_le_pos; assumption.
Qed.

(* side_of_plane_double_double, of exact pairs: -det(b, c, d). W is the determinant in pairs. *)
Theorem plane_double_double_filter env W l r :
  let b := triple env 0 in
  let c := triple env 3 in
  let d := triple env 6 in
  let h := exact env plane_double_double_2_left in
  are_high env 0 -> are_high env 3 -> are_high env 6 ->
  computes u2 3 7 env plane_double_double_High_109_of W -> is_high (env 109%nat) W ->
  Rabs (l - h * h) <= u * Rabs (h * h) -> computes u 1 1 env plane_double_double_1_right r -> r < l ->
  0 < h * - det b c d.
Proof.
  intros b c d h B C D HW Hh Hl Hr L. assert (U := u_positive).
  assert (U1 : u <= / 2048) by (rewrite u_value; lra).
  set (P := length b * length c * length d).
  apply plane_double_double_limit with (V := - W) (l := l) (r := r); try assumption.
  - apply computes_opposite. assumption.
  - unfold is_high in Hh. unfold h. simpl. rewrite Rabs_Ropp.
    replace (- env 109%nat - - W) with (- (env 109%nat - W)) by ring. rewrite Rabs_Ropp. assumption.
  - fold b c d P. set (right := plane_double_double_1_right) in *.
    apply square_of_highs in B, C, D. fold b in B. fold c in C. fold d in D.
    assert (Right : exact env right =
      factor right * (square (triple env 100) * square (triple env 103) * square (triple env 106)))
      by (unfold right; lay_open; ring).
    assert (R0 := least_value u 1 1 env right r U Hr ltac:(unfold right; sizes)). rewrite Right in R0.
    assert (HG : 0 <= gamma u (count 1 1 right) <= most u (count 1 1 right)) by (unfold right; ranges).
    assert (G1 : most u (count 1 1 right) <= 1000 * u).
    { unfold right; compute_counts; unfold most; simpl; rewrite u_value; lra. }
    set (G := gamma u (count 1 1 right)) in *.
    assert (K0 : 0 <= factor right) by (unfold right; apply constant_positive; lia).
    set (K := factor right) in *.
    assert (Pb := square_positive b). assert (Pc := square_positive c). assert (Pd := square_positive d).
    assert (PP : P * P = square b * square c * square d) by (unfold P; rewrite <- !length_square; ring).
    assert (All := product_of_highs (1 - 2 * u) _ _ _ _ _ _ ltac:(lra) Pb Pc Pd B C D). rewrite <- PP in All.
    eapply Rle_trans; [| exact R0].
    set (Q := square (triple env 100) * square (triple env 103) * square (triple env 106)) in *.
    assert (PP0 : 0 <= P * P) by nra.
    assert (Lost : 1 - / 1099511627776 <= (1 - 2 * u) * (1 - 2 * u) * (1 - 2 * u) * (1 - G)).
    { apply Rle_trans with ((1 - 2 * u) * (1 - 2 * u) * (1 - 2 * u) * (1 - 1000 * u)).
      - rewrite u_value. lra.
      - apply Rmult_le_compat_l; [repeat apply Rmult_le_pos; lra | lra]. }
    apply Rle_trans with (K * (P * P) * ((1 - 2 * u) * (1 - 2 * u) * (1 - 2 * u) * (1 - G))).
    { apply Rmult_le_compat_l; [apply Rmult_le_pos; assumption | exact Lost]. }
    replace (K * (P * P) * ((1 - 2 * u) * (1 - 2 * u) * (1 - 2 * u) * (1 - G)))
      with (K * ((1 - 2 * u) * (1 - 2 * u) * (1 - 2 * u) * (P * P)) * (1 - G)) by ring.
    apply Rmult_le_compat_r; [lra |]. apply Rmult_le_compat_l; assumption.
Qed.

(* What is left of a limit that the rounding of high words makes smaller. *)
Lemma limit_of_highs K M Q G r c :
  0 <= K -> 0 <= M -> 0 <= G <= 1000 * u -> 1 - 2000 * u <= c -> c * M <= Q -> K * Q * (1 - G) <= r ->
  K * M * (1 - / 1099511627776) <= r.
Proof.
  intros K0 M0 HG C HQ R. assert (U := u_positive). assert (U1 : u <= / 16384) by (rewrite u_value; lra).
  apply Rle_trans with (K * Q * (1 - G)); [| assumption].
  assert (Lost : 1 - / 1099511627776 <= c * (1 - G)).
  { apply Rle_trans with ((1 - 2000 * u) * (1 - 1000 * u)); [rewrite u_value; lra |].
    apply Rmult_le_compat; lra. }
  apply Rle_trans with (K * M * (c * (1 - G))); [apply Rmult_le_compat_l; [apply Rmult_le_pos |]; assumption |].
  replace (K * M * (c * (1 - G))) with (K * (c * M) * (1 - G)) by ring.
  apply Rmult_le_compat_r; [lra |]. apply Rmult_le_compat_l; assumption.
Qed.

Lemma largest_of_highs c a b A B : 0 <= c -> c * a <= A -> c * b <= B -> c * Rmax a b <= Rmax A B.
Proof.
  intros. unfold Rmax at 1. destruct (Rle_dec a b).
  - eapply Rle_trans; [eassumption | apply Rmax_r].
  - eapply Rle_trans; [eassumption | apply Rmax_l].
Qed.

(* side_of_circle_double_double, of pairs that are differences of unit vectors within 2^-99: H is the longest
   one. The filter refuses H^2 below a half of its bound. *)
Theorem circle_double_double_filter env eb ec ed ep W r H :
  let b := triple env 0 in
  let c := triple env 3 in
  let d := triple env 6 in
  let T := constant 1 (-99) in
  let h := exact env circle_double_double_2_left in
  length (difference (difference eb ep) b) <= T -> length (difference (difference ec ep) c) <= T ->
  length (difference (difference ed ep) d) <= T ->
  H * H = Rmax (Rmax (square b) (square c)) (square d) -> / 562949953421312 <= H <= 2049 / 1024 ->
  are_high env 0 -> are_high env 3 -> are_high env 6 ->
  computes u2 3 7 env circle_double_double_High_109_of W -> is_high (env 109%nat) W ->
  computes u 1 1 env circle_double_double_1_right r -> r < Rabs h ->
  0 < h * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof.
  intros b c d T h Tb Tc Td HM HH B C D HW Hh Hr L. assert (U := u_positive).
  assert (U1 : u <= / 16384) by (rewrite u_value; lra).
  assert (Below : forall x, square x <= H * H -> length x <= H).
  { intros x S. rewrite <- length_square in S. assert (P := length_positive x).
    apply Rnot_lt_le. intro N. nra. }
  assert (Mb : square b <= H * H) by (rewrite HM; eapply Rle_trans; [apply Rmax_l | apply Rmax_l]).
  assert (Mc : square c <= H * H) by (rewrite HM; eapply Rle_trans; [apply Rmax_r | apply Rmax_l]).
  assert (Md : square d <= H * H) by (rewrite HM; apply Rmax_r).
  apply circle_double_double_limit with (env := env) (V := - W) (r := r) (H := H); try assumption;
    try (apply Below; assumption).
  - apply computes_opposite. rewrite <- circle_takes_the_determinant. assumption.
  - unfold is_high in Hh. unfold h. simpl. rewrite Rabs_Ropp.
    replace (- env 109%nat - - W) with (- (env 109%nat - W)) by ring. rewrite Rabs_Ropp. assumption.
  - set (right := circle_double_double_1_right) in *.
    apply square_of_highs in B, C, D. fold b in B. fold c in C. fold d in D.
    set (Q := Rmax (Rmax (square (triple env 100)) (square (triple env 103))) (square (triple env 106))).
    assert (Right : exact env right = factor right * Q) by (unfold right, Q; lay_open; reflexivity).
    assert (Size : size env right = exact env right).
    { unfold right. lay_open. rewrite ?Rabs_square.
      rewrite (Rabs_pos_eq (constant _ _)) by (apply constant_positive; lia). reflexivity. }
    assert (R0 := least_value u 1 1 env right r U Hr Size). rewrite Right in R0.
    assert (HG : 0 <= gamma u (count 1 1 right) <= most u (count 1 1 right)) by (unfold right; ranges).
    assert (G1 : most u (count 1 1 right) <= 1000 * u).
    { unfold right; compute_counts; unfold most; simpl; rewrite u_value; lra. }
    apply limit_of_highs with (Q := Q) (G := gamma u (count 1 1 right)) (c := 1 - 2 * u); try lra.
    + unfold right. apply constant_positive. lia.
    + nra.
    + rewrite HM. unfold Q. repeat apply largest_of_highs; try assumption; lra.
Qed.

(* The high word of a sum of squares in pairs. *)
Lemma high_of_sum g W t env :
  computes u2 3 7 env t W -> size env t = exact env t -> is_high g W -> (count 3 7 t <= 100)%nat ->
  (1 - 2000 * u) * exact env t <= g.
Proof.
  intros HW S Hg N. assert (U := u_positive). assert (U1 : u <= / 16384) by (rewrite u_value; lra).
  assert (P := size_positive env t). rewrite S in P.
  assert (E := least_value u2 3 7 env t W u2_positive HW S).
  assert (G := gamma_monotone u2 u2_positive _ _ N).
  assert (G0 : gamma u2 100 <= most u2 100)
    by (apply gamma_bound; [apply u2_positive | simpl; rewrite u2_value; lra]).
  assert (G1 : most u2 100 <= u) by (unfold most; simpl; rewrite u2_value, u_value; lra).
  assert (W0 : (1 - u) * exact env t <= W).
  { eapply Rle_trans; [| exact E]. rewrite Rmult_comm. apply Rmult_le_compat_l; lra. }
  assert (Wp : 0 <= W) by nra.
  unfold is_high in Hg. apply Rabs_le_inv in Hg.
  assert (Gp : 0 <= g).
  { apply Rnot_lt_le. intro Neg. rewrite (Rabs_left g) in Hg by assumption. nra. }
  rewrite (Rabs_pos_eq g) in Hg by assumption. nra.
Qed.

(* compare_angle_double_double, of pairs that are differences of unit vectors within 2^-98, as differences of
   pairs of doubles are: H is the longer one. *)
Theorem angle_double_double_filter env eb ea ep W Wa Wb l r H :
  let b := triple env 0 in
  let a := triple env 3 in
  let T := constant 1 (-98) in
  let h := exact env angle_double_double_1_left in
  length (difference (difference eb ep) b) <= T -> length (difference (difference ea ep) a) <= T ->
  H * H = Rmax (square a) (square b) -> 0 < H <= 2049 / 1024 ->
  computes u2 3 7 env angle_double_double_High_100_of W -> is_high (env 100%nat) W ->
  computes u2 3 7 env angle_double_double_High_101_of Wa -> is_high (env 101%nat) Wa ->
  computes u2 3 7 env angle_double_double_High_102_of Wb -> is_high (env 102%nat) Wb ->
  Rabs (l - h * h) <= u * Rabs (h * h) -> computes u 1 1 env angle_double_double_0_right r -> r < l ->
  0 < h * (square (difference eb ep) - square (difference ea ep)).
Proof.
  intros b a T h Tb Ta HM HH HW Hh HWa Ha HWb Hb Hl Hr L. assert (U := u_positive).
  assert (U1 : u <= / 16384) by (rewrite u_value; lra).
  assert (Below : forall x, square x <= H * H -> length x <= H).
  { intros x S. rewrite <- length_square in S. assert (P := length_positive x).
    apply Rnot_lt_le. intro N. nra. }
  assert (Ma : square a <= H * H) by (rewrite HM; apply Rmax_l).
  assert (Mb : square b <= H * H) by (rewrite HM; apply Rmax_r).
  apply angle_double_double_limit with (env := env) (V := W) (l := l) (r := r) (H := H); try assumption;
    try (apply Below; assumption).
  set (right := angle_double_double_0_right) in *.
  assert (A : (1 - 2000 * u) * square a <= env 101%nat).
  { replace (square a) with (exact env angle_double_double_High_101_of) by (unfold a; lay_open; ring).
    apply high_of_sum with (W := Wa); try assumption; [sizes | compute_counts; lia]. }
  assert (B : (1 - 2000 * u) * square b <= env 102%nat).
  { replace (square b) with (exact env angle_double_double_High_102_of) by (unfold b; lay_open; ring).
    apply high_of_sum with (W := Wb); try assumption; [sizes | compute_counts; lia]. }
  assert (Pa := square_positive a). assert (Pb := square_positive b).
  assert (A0 : 0 <= env 101%nat) by nra. assert (B0 : 0 <= env 102%nat) by nra.
  assert (Size : size env right = exact env right).
  { unfold right. simpl. rewrite (Rabs_pos_eq (env 101%nat)), (Rabs_pos_eq (env 102%nat)) by assumption.
    rewrite (Rabs_pos_eq (constant _ _)) by (apply constant_positive; lia). reflexivity. }
  assert (R0 := least_value u 1 1 env right r U Hr Size).
  assert (HG : 0 <= gamma u (count 1 1 right) <= most u (count 1 1 right)) by (unfold right; ranges).
  assert (G1 : most u (count 1 1 right) <= 1000 * u).
  { unfold right; compute_counts; unfold most; simpl; rewrite u_value; lra. }
  replace (constant 1 (-40)) with (/ 1099511627776) by (unfold constant; simpl; lra).
  apply limit_of_highs with (Q := Rmax (env 101%nat) (env 102%nat)) (G := gamma u (count 1 1 right))
    (c := 1 - 2000 * u); try assumption; try lra.
  - unfold right. apply constant_positive. lia.
  - rewrite HM. apply largest_of_highs; try assumption; lra.
Qed.

(* is_within_angle_double_double has a given number in place of one distance, and fewer roundings. *)
Lemma within_angle_double_double_compares :
  within_angle_double_double_0_right = Times (part_1 angle_double_double_0_right) (Largest (Given 101) (Given 0)) /\
  within_angle_double_double_1_left = Given 100 /\
  within_angle_double_double_High_100_of = Minus within_angle_double_double_High_101_of (Given 0) /\
  within_angle_behind_double_double_0_right = within_angle_double_double_0_right /\
  within_angle_behind_double_double_1_left = Given 100 /\
  within_angle_behind_double_double_High_100_of = within_angle_double_double_High_100_of /\
  forall env, exact env within_angle_double_double_High_101_of = square (triple env 1).
Proof. repeat split. Qed.
