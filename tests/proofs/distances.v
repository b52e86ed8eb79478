(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Filters of distances between stored directions: which of two is nearer, and whether one is within a
   distance. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry acceptance formulas stored.
From Rondel Require certificate_angle certificate_within_angle certificate_within_angle_behind.
Open Scope R_scope.

Lemma angle_margin E G T H w :
  0 <= E <= most u (count 1 1 (part_1 angle_1_left)) -> 0 <= G <= most u (count 1 1 angle_0_right) ->
  0 <= T <= 2 * eta -> 0 <= H <= 2049 / 1024 -> 0 <= w <= 1 ->
  let k := sqrt (factor angle_0_right * (1 - G) / (1 + one_u)) in
  let q := T * ((1 + one_u) * (1 + E)) / k * w in
  H * (one_u * (1 + E) + 2 * E) + T * (4 + 2 * q) <= k.
Proof.
  intros HE HG HT HH Hw k q.
  apply Rnot_lt_le. intro N. apply (certificate_angle.l1 E G T H w).
  unfold certificate_angle.s1, certificate_angle.s2, certificate_angle.s3, certificate_angle.s4,
    certificate_angle.s5, certificate_angle.s6, not.
  subst k q. cbv zeta in *. unfold eta, factor, direction_error, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

Lemma within_angle_margin E G T H w :
  0 <= E <= most u (count 1 1 (part_2 within_angle_1_left)) ->
  0 <= G <= most u (count 1 1 within_angle_0_right) ->
  0 <= T <= 2 * eta -> 0 <= H <= 2049 / 1024 -> 0 <= w <= 1 ->
  let k := sqrt (factor within_angle_0_right * (1 - G) / (1 + one_u)) in
  let q := T * ((1 + one_u) * (1 + E)) / k * w in
  H * (one_u * (1 + E) + E) + T * (2 + q) <= k.
Proof.
  intros HE HG HT HH Hw k q.
  apply Rnot_lt_le. intro N. apply (certificate_within_angle.l1 E G T H w).
  unfold certificate_within_angle.s1, certificate_within_angle.s2, certificate_within_angle.s3,
    certificate_within_angle.s4, certificate_within_angle.s5, certificate_within_angle.s6, not.
  subst k q. cbv zeta in *. unfold eta, factor, direction_error, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

Lemma within_angle_behind_margin E G T H w :
  0 <= E <= most u (count 1 1 (part_1 within_angle_behind_1_left)) ->
  0 <= G <= most u (count 1 1 within_angle_behind_0_right) ->
  0 <= T <= 2 * eta -> 0 <= H <= 2049 / 1024 -> 0 <= w <= 1 ->
  let k := sqrt (factor within_angle_behind_0_right * (1 - G) / (1 + one_u)) in
  let q := T * ((1 + one_u) * (1 + E)) / k * w in
  H * (one_u * (1 + E) + E) + T * (2 + q) <= k.
Proof.
  intros HE HG HT HH Hw k q.
  apply Rnot_lt_le. intro N. apply (certificate_within_angle_behind.l1 E G T H w).
  unfold certificate_within_angle_behind.s1, certificate_within_angle_behind.s2,
    certificate_within_angle_behind.s3, certificate_within_angle_behind.s4,
    certificate_within_angle_behind.s5, certificate_within_angle_behind.s6, not.
  subst k q. cbv zeta in *. unfold eta, factor, direction_error, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

(* The square of a vector that moves by at most T. *)
Lemma change_of_square a f T H :
  length a <= H -> length f <= T -> Rabs (square (sum a f) - square a) <= T * (2 * H + T).
Proof.
  intros A F. assert (La := length_positive a). assert (Lf := length_positive f).
  replace (square (sum a f) - square a) with (2 * dot a f + square f)
    by (destruct a, f; unfold square, dot, sum; simpl; ring).
  assert (C := cauchy a f). apply Rabs_le_inv in C. rewrite <- length_square.
  assert (length a * length f <= H * T) by (apply Rmult_le_compat; assumption).
  assert (length f * length f <= T * T) by (apply Rmult_le_compat; assumption).
  assert (0 <= length f * length f) by nra. apply Rabs_le. split; lra.
Qed.

(* The difference V of two numbers, x near s H^2 and y near t H^2, where s and t are not above 1. *)
Section Differences.
Variables V x y X Y l r K G E T H n : R.
Hypothesis E0 : 0 <= E.
Hypothesis T0 : 0 < T.
Hypothesis H0 : 0 <= H.
Hypothesis G1 : G < 1.
Hypothesis K0 : 0 < K.
Hypothesis n0 : 0 <= n.
Hypothesis V_is : Rabs (V - (x - y)) <= u * Rabs (x - y).
Hypothesis x_range : 0 <= x <= (1 + E) * (H * H).
Hypothesis y_range : 0 <= y <= (1 + E) * (H * H).
Hypothesis errors : Rabs ((x - y) - (X - Y)) <= n * (E * (H * H) + T * (2 * H + T)).
Hypothesis l_is : Rabs (l - V * V) <= u * Rabs (V * V).
Hypothesis r_is : K * (H * H) * (1 - G) <= r.
Hypothesis accepted_value : r < l.
Let k := sqrt (K * (1 - G) / (1 + one_u)).
Hypothesis margin :
  forall w, 0 <= w <= 1 ->
    let q := T * ((1 + one_u) * (1 + E)) / k * w in
    H * (one_u * (1 + E) + n * E) + T * (2 * n + n * q) <= k.

Lemma difference_filter : 0 < V * (X - Y).
Proof.
  assert (U := u_positive). assert (k0 : 0 < k) by (apply root_positive; assumption).
  assert (Accepted : k * H < Rabs V).
  { unfold k. rewrite one_u_is. apply accepted with (l := l) (r := r); try assumption. nra. }
  rewrite one_u_is in margin.
  assert (D : Rabs (x - y) <= (1 + E) * (H * H)) by (apply Rabs_le; split; lra).
  assert (P := Rabs_pos (x - y)).
  assert (HV2 : Rabs V <= (1 + u) * ((1 + E) * (H * H))).
  { replace V with ((V - (x - y)) + (x - y)) by ring. eapply Rle_trans; [apply Rabs_triang |]. nra. }
  assert (Hp : 0 < H).
  { destruct (Rle_lt_or_eq_dec 0 H H0) as [? | Z]; [assumption |].
    rewrite <- Z in *. rewrite Rmult_0_r in Accepted. rewrite Rmult_0_r, !Rmult_0_r in HV2. lra. }
  set (B := (1 + u) * (1 + E)) in *. assert (B0 : 0 < B) by (unfold B; nra).
  assert (Low : k <= B * H).
  { apply Rmult_le_reg_r with H; [assumption |].
    replace (B * H * H) with ((1 + u) * ((1 + E) * (H * H))) by (unfold B; ring). lra. }
  set (w := k / B / H).
  assert (Hw : 0 <= w <= 1).
  { apply quotient_range; [| | assumption].
    - unfold Rdiv. apply Rmult_le_pos; [lra |]. left. apply Rinv_0_lt_compat. assumption.
    - apply Rmult_le_reg_r with B; [assumption |].
      replace (k / B * B) with k by (field; lra). lra. }
  assert (M := margin w Hw). cbv zeta in M. set (q := T * B / k * w) in M.
  assert (Q : q * H = T) by (unfold q, w; field; repeat split; lra).
  apply right_sign with (k * H); [| assumption].
  replace (V - (X - Y)) with ((V - (x - y)) + ((x - y) - (X - Y))) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  assert (u * Rabs (x - y) <= u * ((1 + E) * (H * H))) by (apply Rmult_le_compat_l; assumption).
  assert (S : T * (2 * H + T) = T * (2 + q) * H) by (rewrite <- Q; ring).
  rewrite S in errors. assert (M' := Rmult_le_compat_r H _ _ ltac:(lra) M). lra.
Qed.
End Differences.

Lemma squared_distance_error env t y : 
  computes u 1 1 env t y -> size env t = exact env t -> 0 <= exact env t ->
  Rabs (y - exact env t) <= gamma u (count 1 1 t) * exact env t /\
  (gamma u (count 1 1 t) <= 1 -> 0 <= y <= (1 + gamma u (count 1 1 t)) * exact env t).
Proof.
  intros H S P. assert (E := error_of_formula u u_positive 1 1 env t y H). rewrite S in E. split; [exact E |].
  intro G. apply Rabs_le_inv in E. split; nra.
Qed.

Ltac below_one H := revert H; compute_counts; unfold most; simpl; rewrite u_value; lra.

(* --- angle_bound: |b-p|^2 - |a-p|^2 --- *)
Theorem angle_filter env eb ea ep V l r :
  is_stored (triple env 0) eb -> is_stored (triple env 3) ea -> is_stored (triple env 6) ep ->
  computes u 1 1 env angle_1_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env angle_0_right r -> r < l ->
  0 < V * (square (difference eb ep) - square (difference ea ep)).
Proof.
  set (sb := triple env 0). set (sa := triple env 3). set (sp := triple env 6).
  intros Sb Sa Sp HV Hl Hr L. assert (U := u_positive).
  set (b := difference sb sp). set (a := difference sa sp).
  assert (HE : 0 <= gamma u (count 1 1 (part_1 angle_1_left)) <= most u (count 1 1 (part_1 angle_1_left)))
    by ranges.
  assert (HG : 0 <= gamma u (count 1 1 angle_0_right) <= most u (count 1 1 angle_0_right)) by ranges.
  destruct (operands_of_minus _ _ _ _ _ _ _ HV) as [x [y [Hx [Hy Hz]]]]. rewrite gamma_one in Hz.
  assert (Xb : exact env (part_1 angle_1_left) = square b) by (unfold b, sb, sp; lay_open; ring).
  assert (Xa : exact env (part_2 angle_1_left) = square a) by (unfold a, sa, sp; lay_open; ring).
  assert (Pb := square_positive b). assert (Pa := square_positive a).
  destruct (squared_distance_error env (part_1 angle_1_left) x Hx) as [Ex Rx]; [sizes | lra |].
  destruct (squared_distance_error env (part_2 angle_1_left) y Hy) as [Ey Ry]; [sizes | lra |].
  change (count 1 1 (part_2 angle_1_left)) with (count 1 1 (part_1 angle_1_left)) in Ey, Ry.
  set (E := gamma u (count 1 1 (part_1 angle_1_left))) in *.
  set (G := gamma u (count 1 1 angle_0_right)) in *.
  rewrite Xb in Ex, Rx. rewrite Xa in Ey, Ry.
  assert (E1 : E <= 1) by (destruct HE as [_ HE]; below_one HE).
  assert (G1 : G < 1) by (destruct HG as [_ HG]; below_one HG).
  specialize (Rx E1). specialize (Ry E1).
  assert (Lb := length_positive b). assert (La := length_positive a).
  assert (B2 := length_of_stored_2 sb sp eb ep Sb Sp). fold b in B2.
  assert (A2 := length_of_stored_2 sa sp ea ep Sa Sp). fold a in A2.
  set (H := Rmax (length b) (length a)).
  assert (Hb : length b <= H) by apply Rmax_l. assert (Ha : length a <= H) by apply Rmax_r.
  assert (H2 : H <= 2049 / 1024) by (apply Rmax_lub; assumption).
  assert (Sqb : square b <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
  assert (Sqa : square a <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
  set (K := factor angle_0_right).
  assert (K0 : 0 < K) by (unfold K, factor, angle_0_right, constant; simpl; lra).
  assert (Right : exact env angle_0_right = K * (H * H)).
  { replace (H * H) with (Rmax (square a) (square b)).
    - unfold K, b, a, sb, sa, sp; lay_open; ring.
    - rewrite <- !length_square in *. unfold H, Rmax.
      destruct (Rle_dec (length a * length a) (length b * length b)), (Rle_dec (length b) (length a)); nra. }
  assert (Size : size env angle_0_right = exact env angle_0_right) by sizes.
  assert (R0 := least_value u 1 1 env _ r U Hr Size). fold G in R0. rewrite Right in R0.
  set (T := 2 * eta). assert (R := eta_range).
  assert (HT : 0 < T) by (unfold T, eta, factor, direction_error, constant; simpl; lra).
  apply difference_filter with (x := x) (y := y) (l := l) (r := r) (K := K) (G := G) (E := E) (T := T) (H := H)
    (n := 2); try assumption; try lra.
  - split; [apply Rx |]. eapply Rle_trans; [apply Rx |]. apply Rmult_le_compat_l; lra.
  - split; [apply Ry |]. eapply Rle_trans; [apply Ry |]. apply Rmult_le_compat_l; lra.
  - rewrite (exact_difference sb sp eb ep), (exact_difference sa sp ea ep). fold b a.
    assert (Cb := change_of_square b (off_2 sb sp eb ep) T H Hb (off_2_range _ _ _ _ Sb Sp)).
    assert (Ca := change_of_square a (off_2 sa sp ea ep) T H Ha (off_2_range _ _ _ _ Sa Sp)).
    assert (E * square b <= E * (H * H)) by (apply Rmult_le_compat_l; [apply HE | assumption]).
    assert (E * square a <= E * (H * H)) by (apply Rmult_le_compat_l; [apply HE | assumption]).
    apply Rabs_le_inv in Cb, Ca, Ex, Ey. apply Rabs_le. split; lra.
  - intros w Hw q. assert (M := angle_margin E G T H w HE HG ltac:(unfold T; lra) ltac:(lra) Hw).
    cbv zeta in M. fold K in M. unfold q. lra.
Qed.

(* --- within_angle_bound: t - |p-a|^2, and beyond 90 degrees |p+a|^2 - t --- *)

Theorem within_angle_filter env ep ea V l r :
  is_stored (triple env 0) ea -> is_stored (triple env 3) ep -> 0 <= env 6%nat <= 4 ->
  computes u 1 1 env within_angle_1_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env within_angle_0_right r -> r < l -> 0 < V * (env 6%nat - square (difference ep ea)).
Proof.
  set (sa := triple env 0). set (sp := triple env 3). set (t := env 6%nat).
  intros Sa Sp Ht HV Hl Hr L. assert (U := u_positive).
  set (a := difference sp sa).
  set (part := part_2 within_angle_1_left).
  assert (HE : 0 <= gamma u (count 1 1 part) <= most u (count 1 1 part)) by ranges.
  assert (HG : 0 <= gamma u (count 1 1 within_angle_0_right) <= most u (count 1 1 within_angle_0_right)) by ranges.
  destruct (operands_of_minus _ _ _ _ _ _ _ HV) as [x [y [Hx [Hy Hz]]]]. rewrite gamma_one in Hz.
  assert (Xa : exact env part = square a) by (unfold part, a, sa, sp; lay_open; ring).
  assert (Pa := square_positive a).
  destruct (squared_distance_error env part y Hy) as [Ey Ry]; [unfold part; sizes | lra |].
  inversion Hx; subst. fold t in Hz.
  set (E := gamma u (count 1 1 part)) in *.
  set (G := gamma u (count 1 1 within_angle_0_right)) in *.
  rewrite Xa in Ey, Ry.
  assert (E1 : E <= 1) by (destruct HE as [_ HE]; below_one HE).
  assert (G1 : G < 1) by (destruct HG as [_ HG]; below_one HG).
  specialize (Ry E1).
  assert (La := length_positive a).
  assert (A2 : length a <= 2049 / 1024) by (apply length_of_stored_2 with (e := ep) (f := ea); assumption).
  assert (Lt := sqrt_pos t). assert (Tt : sqrt t * sqrt t = t) by (apply sqrt_sqrt; lra).
  assert (T2 : sqrt t <= 2) by nra.
  set (H := Rmax (length a) (sqrt t)).
  assert (Ha : length a <= H) by apply Rmax_l. assert (Hr2 : sqrt t <= H) by apply Rmax_r.
  assert (H2 : H <= 2049 / 1024) by (apply Rmax_lub; lra).
  assert (Sqa : square a <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
  assert (Sqt : t <= H * H) by (rewrite <- Tt; apply Rmult_le_compat; assumption).
  assert (HH : 0 <= H * H) by nra.
  set (K := factor within_angle_0_right).
  assert (K0 : 0 < K) by (unfold K, factor, within_angle_0_right, constant; simpl; lra).
  assert (Right : exact env within_angle_0_right = K * (H * H)).
  { replace (H * H) with (Rmax (square a) t).
    - unfold K, a, sa, sp, t; lay_open; ring.
    - rewrite <- length_square, <- Tt at 1. unfold H, Rmax.
      destruct (Rle_dec (length a * length a) (sqrt t * sqrt t)), (Rle_dec (length a) (sqrt t)); nra. }
  assert (Size : size env within_angle_0_right = exact env within_angle_0_right).
  { unfold t in Ht. lay_open. rewrite (Rabs_pos_eq (env 6%nat)) by lra. sizes. }
  assert (R0 := least_value u 1 1 env _ r U Hr Size). fold G in R0. rewrite Right in R0.
  set (T := 2 * eta). assert (R := eta_range).
  assert (HT : 0 < T) by (unfold T, eta, factor, direction_error, constant; simpl; lra).
  assert (EH : E * square a <= E * (H * H)) by (apply Rmult_le_compat_l; [apply HE | assumption]).
  assert (EP : 0 <= E * (H * H)) by (apply Rmult_le_pos; [apply HE | assumption]).
  assert (Y2 : y <= (1 + E) * (H * H)) by lra.
  apply difference_filter with (x := t) (y := y) (l := l) (r := r) (K := K) (G := G) (E := E)
    (T := T) (H := H) (n := 1); try assumption; try lra.
  - rewrite (exact_difference sp sa ep ea). fold a.
    assert (Ca := change_of_square a (off_2 sp sa ep ea) T H Ha (off_2_range _ _ _ _ Sp Sa)).
    apply Rabs_le_inv in Ca, Ey. apply Rabs_le. split; lra.
  - intros w Hw q. assert (M := within_angle_margin E G T H w HE HG ltac:(unfold T; lra) ltac:(lra) Hw).
    cbv zeta in M. fold K in M. unfold q. lra.
Qed.

Definition off_sum (s t e f : vector) := sum (off s e) (off t f).

Lemma exact_sum s t e f : sum e f = sum (sum s t) (off_sum s t e f).
Proof. destruct s, t, e, f; unfold sum, off_sum, off, difference, sum; simpl. f_equal; ring. Qed.

Lemma off_sum_range s t e f : is_stored s e -> is_stored t f -> length (off_sum s t e f) <= 2 * eta.
Proof. intros [_ S] [_ T]. unfold off_sum. eapply Rle_trans; [apply length_of_sum |]. unfold off. lra. Qed.

Lemma length_of_stored_sum s t e f : is_stored s e -> is_stored t f -> length (sum s t) <= 2049 / 1024.
Proof.
  intros S T. assert (A := length_of_stored s e S). assert (B := length_of_stored t f T).
  assert (C := length_of_sum s t). lra.
Qed.

Theorem within_angle_behind_filter env ep ea V l r :
  is_stored (triple env 0) ea -> is_stored (triple env 3) ep -> 0 <= env 6%nat <= 4 ->
  computes u 1 1 env within_angle_behind_1_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env within_angle_behind_0_right r -> r < l -> 0 < V * (square (sum ep ea) - env 6%nat).
Proof.
  set (sa := triple env 0). set (sp := triple env 3). set (t := env 6%nat).
  intros Sa Sp Ht HV Hl Hr L. assert (U := u_positive).
  set (a := sum sp sa).
  set (part := part_1 within_angle_behind_1_left).
  assert (HE : 0 <= gamma u (count 1 1 part) <= most u (count 1 1 part)) by ranges.
  assert (HG : 0 <= gamma u (count 1 1 within_angle_behind_0_right) <= most u (count 1 1 within_angle_behind_0_right)) by ranges.
  destruct (operands_of_minus _ _ _ _ _ _ _ HV) as [x [y [Hx [Hy Hz]]]]. rewrite gamma_one in Hz.
  assert (Xa : exact env part = square a) by (unfold part, a, sa, sp; lay_open; ring).
  assert (Pa := square_positive a).
  destruct (squared_distance_error env part x Hx) as [Ey Ry]; [unfold part; sizes | lra |].
  inversion Hy; subst. fold t in Hz.
  set (E := gamma u (count 1 1 part)) in *.
  set (G := gamma u (count 1 1 within_angle_behind_0_right)) in *.
  rewrite Xa in Ey, Ry.
  assert (E1 : E <= 1) by (destruct HE as [_ HE]; below_one HE).
  assert (G1 : G < 1) by (destruct HG as [_ HG]; below_one HG).
  specialize (Ry E1).
  assert (La := length_positive a).
  assert (A2 : length a <= 2049 / 1024) by (apply length_of_stored_sum with (e := ep) (f := ea); assumption).
  assert (Lt := sqrt_pos t). assert (Tt : sqrt t * sqrt t = t) by (apply sqrt_sqrt; lra).
  assert (T2 : sqrt t <= 2) by nra.
  set (H := Rmax (length a) (sqrt t)).
  assert (Ha : length a <= H) by apply Rmax_l. assert (Hr2 : sqrt t <= H) by apply Rmax_r.
  assert (H2 : H <= 2049 / 1024) by (apply Rmax_lub; lra).
  assert (Sqa : square a <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
  assert (Sqt : t <= H * H) by (rewrite <- Tt; apply Rmult_le_compat; assumption).
  assert (HH : 0 <= H * H) by nra.
  set (K := factor within_angle_behind_0_right).
  assert (K0 : 0 < K) by (unfold K, factor, within_angle_behind_0_right, constant; simpl; lra).
  assert (Right : exact env within_angle_behind_0_right = K * (H * H)).
  { replace (H * H) with (Rmax (square a) t).
    - unfold K, a, sa, sp, t; lay_open; ring.
    - rewrite <- length_square, <- Tt at 1. unfold H, Rmax.
      destruct (Rle_dec (length a * length a) (sqrt t * sqrt t)), (Rle_dec (length a) (sqrt t)); nra. }
  assert (Size : size env within_angle_behind_0_right = exact env within_angle_behind_0_right).
  { unfold t in Ht. lay_open. rewrite (Rabs_pos_eq (env 6%nat)) by lra. sizes. }
  assert (R0 := least_value u 1 1 env _ r U Hr Size). fold G in R0. rewrite Right in R0.
  set (T := 2 * eta). assert (R := eta_range).
  assert (HT : 0 < T) by (unfold T, eta, factor, direction_error, constant; simpl; lra).
  assert (EH : E * square a <= E * (H * H)) by (apply Rmult_le_compat_l; [apply HE | assumption]).
  assert (EP : 0 <= E * (H * H)) by (apply Rmult_le_pos; [apply HE | assumption]).
  assert (Y2 : x <= (1 + E) * (H * H)) by lra.
  apply difference_filter with (x := x) (y := t) (l := l) (r := r) (K := K) (G := G) (E := E)
    (T := T) (H := H) (n := 1); try assumption; try lra.
  - rewrite (exact_sum sp sa ep ea). fold a.
    assert (Ca := change_of_square a (off_sum sp sa ep ea) T H Ha (off_sum_range _ _ _ _ Sp Sa)).
    apply Rabs_le_inv in Ca, Ey. apply Rabs_le. split; lra.
  - intros w Hw q. assert (M := within_angle_behind_margin E G T H w HE HG ltac:(unfold T; lra) ltac:(lra) Hw).
    cbv zeta in M. fold K in M. unfold q. lra.
Qed.
