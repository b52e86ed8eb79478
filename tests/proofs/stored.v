(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Filters of stored directions: each is within direction_error of an exact unit vector, and the sign is
   that of the formula of these unit vectors. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry acceptance formulas.
From Rondel Require certificate_direction_orientation certificate_circle_plane certificate_circle.
Open Scope R_scope.

Definition eta : R := factor direction_error.

Lemma eta_range : 0 <= eta <= / 1000000.
Proof. unfold eta, factor, direction_error, constant. simpl. lra. Qed.

(* s is stored for the unit vector e. *)
Definition is_stored (s e : vector) : Prop := length e = 1 /\ length (difference e s) <= eta.

(* What a stored direction, or a difference of two, is off by. *)
Definition off (s e : vector) := difference e s.
Definition off_2 (s t e f : vector) := difference (off s e) (off t f).

Lemma exact_is_stored s e : e = sum s (off s e).
Proof. destruct s, e; unfold sum, off, difference; simpl. f_equal; ring. Qed.

Lemma exact_difference s t e f : difference e f = sum (difference s t) (off_2 s t e f).
Proof. destruct s, t, e, f; unfold sum, off_2, off, difference; simpl. f_equal; ring. Qed.

Lemma off_2_range s t e f : is_stored s e -> is_stored t f -> length (off_2 s t e f) <= 2 * eta.
Proof. intros [_ S] [_ T]. unfold off_2. eapply Rle_trans; [apply length_of_difference |]. unfold off. lra. Qed.

Lemma length_of_stored s e : is_stored s e -> 2047 / 2048 <= length s <= 2049 / 2048.
Proof.
  intros [L S]. assert (R := eta_range).
  assert (A : length s <= length e + length (difference e s)).
  { replace s with (difference e (difference e s)) at 1
      by (destruct s, e; unfold difference; simpl; f_equal; ring). apply length_of_difference. }
  assert (B : length e <= length s + length (difference e s)).
  { rewrite (exact_is_stored s e) at 1. unfold off. apply length_of_sum. }
  lra.
Qed.

Lemma length_of_stored_2 s t e f : is_stored s e -> is_stored t f -> length (difference s t) <= 2049 / 1024.
Proof.
  intros S T. destruct S as [Ls S], T as [Lt T]. assert (R := eta_range).
  assert (A : length (difference s t) <= length (difference e f) + length (off_2 s t e f)).
  { replace (difference s t) with (difference (difference e f) (off_2 s t e f))
      by (destruct s, t, e, f; unfold off_2, off, difference; simpl; f_equal; ring). apply length_of_difference. }
  assert (B := length_of_difference e f). assert (C := length_of_difference (off s e) (off t f)).
  fold (off_2 s t e f) in C. unfold off in C. lra.
Qed.

(* The value that is accepted exceeds k times a length: its square, as computed, is beyond a factor
   times the square of that length. *)
Lemma accepted unit V l r K G N :
  0 <= unit -> 0 <= N -> Rabs (l - V * V) <= unit * Rabs (V * V) -> K * (N * N) * (1 - G) <= r -> r < l ->
  0 <= K * (1 - G) -> sqrt (K * (1 - G) / (1 + unit)) * N < Rabs V.
Proof.
  intros U N0 HL HR L KG. set (k := sqrt (K * (1 - G) / (1 + unit))).
  assert (k0 : 0 <= k) by apply sqrt_pos.
  assert (kk : k * k * (1 + unit) = K * (1 - G)).
  { unfold k. rewrite sqrt_sqrt; [field; lra |]. unfold Rdiv. apply Rmult_le_pos; [assumption |].
    left. apply Rinv_0_lt_compat. lra. }
  assert (VV : 0 <= V * V) by nra. rewrite (Rabs_pos_eq (V * V)) in HL by assumption.
  apply Rabs_le_inv in HL.
  assert (S : (k * N) * (k * N) * (1 + unit) < V * V * (1 + unit)).
  { replace (k * N * (k * N) * (1 + unit)) with (k * k * (1 + unit) * (N * N)) by ring. rewrite kk. lra. }
  assert (S' : (k * N) * (k * N) < Rabs V * Rabs V) by (rewrite Rabs_square; nra).
  assert (P := Rabs_pos V). assert (0 <= k * N) by nra. nra.
Qed.

(* A quotient of a lower bound and what it bounds. *)
Lemma quotient_range low s : 0 <= low -> low <= s -> 0 < s -> 0 <= low / s <= 1.
Proof.
  intros. assert (0 < / s) by (apply Rinv_0_lt_compat; assumption). unfold Rdiv. split; [nra |].
  replace 1 with (s * / s) by (field; lra). apply Rmult_le_compat_r; lra.
Qed.

(* The unit roundoff as the scripts have it. *)
Definition one_u : R := constant 1 (-53).
Lemma one_u_is : one_u = u.
Proof. unfold one_u, constant, u. ring. Qed.

Lemma root_positive K G : 0 < K -> G < 1 -> 0 < sqrt (K * (1 - G) / (1 + one_u)).
Proof.
  intros. assert (U := u_positive). rewrite one_u_is. apply sqrt_lt_R0. unfold Rdiv.
  apply Rmult_lt_0_compat; [nra |]. apply Rinv_0_lt_compat. lra.
Qed.

(* What a determinant changes by when its vectors do. *)
Lemma change_of_det a b c f g h p q r :
  length f <= p -> length g <= q -> length h <= r ->
  Rabs (det (sum a f) (sum b g) (sum c h) - det a b c) <=
  (length a + p) * (length b + q) * (length c + r) - length a * length b * length c.
Proof.
  intros P Q S. eapply Rle_trans; [apply det_of_sums |].
  assert (A := length_positive a). assert (B := length_positive b). assert (C := length_positive c).
  assert (X := length_positive f). assert (Y := length_positive g). assert (Z := length_positive h).
  apply Rplus_le_compat_r. apply Rmult_le_compat; [nra | lra | | lra].
  apply Rmult_le_compat; lra.
Qed.

(* --- direction_orientation_bound: det(a, b - a, c - a) --- *)

Lemma direction_orientation_margin E G T e A h w :
  0 <= E <= most u (count 1 1 direction_orientation_1_left) ->
  0 <= G <= most u (count 1 1 direction_orientation_0_right) ->
  0 <= T <= 2 * eta -> 0 <= e <= eta -> 2047 / 2048 <= A <= 2049 / 2048 -> 0 <= h <= 2049 / 1024 ->
  0 <= w <= 1 ->
  let F := 11548 / 10000 * E in
  let k := sqrt (factor direction_orientation_0_right * (1 - G) / (1 + one_u)) in
  let q := T * (A * (1 + F)) / k * w in
  (A + e) * (T * (2 + q)) + e * h + F * (A * h) <= k.
Proof.
  intros HE HG HT He HA Hh Hw F k q.
  apply Rnot_lt_le. intro N. apply (certificate_direction_orientation.l1 E G T e A h w).
  unfold certificate_direction_orientation.s1, certificate_direction_orientation.s2,
    certificate_direction_orientation.s3, certificate_direction_orientation.s4,
    certificate_direction_orientation.s5, certificate_direction_orientation.s6,
    certificate_direction_orientation.s7, certificate_direction_orientation.s8, not.
  subst F k q. cbv zeta in *. unfold eta, factor, direction_error, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

Theorem direction_orientation_filter env ea eb ec V l r :
  is_stored (triple env 0) ea -> is_stored (triple env 3) eb -> is_stored (triple env 6) ec ->
  computes u 1 1 env direction_orientation_1_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env direction_orientation_0_right r -> r < l -> 0 < V * det ea eb ec.
Proof.
  set (a := triple env 0). set (sb := triple env 3). set (sc := triple env 6).
  intros Sa Sb Sc HV Hl Hr L. assert (U := u_positive).
  set (b := difference sb a). set (c := difference sc a).
  set (E := gamma u (count 1 1 direction_orientation_1_left)).
  set (G := gamma u (count 1 1 direction_orientation_0_right)).
  assert (HE : 0 <= E <= most u (count 1 1 direction_orientation_1_left)) by ranges.
  assert (HG : 0 <= G <= most u (count 1 1 direction_orientation_0_right)) by ranges.
  set (F := 11548 / 10000 * E). assert (HF : 0 <= F) by (unfold F; lra).
  set (K := factor direction_orientation_0_right).
  assert (K0 : 0 < K) by (unfold K, factor, direction_orientation_0_right, constant; simpl; lra).
  assert (G1 : G < 1).
  { destruct HG as [_ HG]. revert HG. compute_counts. unfold most. simpl. rewrite u_value. lra. }
  set (k := sqrt (K * (1 - G) / (1 + one_u))). assert (k0 : 0 < k) by (apply root_positive; assumption).
  set (A := length a). assert (HA := length_of_stored a ea Sa). fold A in HA.
  assert (Lb := length_positive b). assert (Lc := length_positive c).
  set (H := Rmax (length b) (length c)). set (h := Rmin (length b) (length c)).
  assert (Hh : length b * length c = H * h /\ length b + length c = H + h /\ 0 <= h <= H /\ h <= 2049 / 1024).
  { assert (B2 := length_of_stored_2 sb a eb ea Sb Sa). assert (C2 := length_of_stored_2 sc a ec ea Sc Sa).
    fold b in B2. fold c in C2. unfold H, h, Rmax, Rmin. destruct (Rle_dec (length b) (length c)); repeat split; lra. }
  destruct Hh as [Product [Sum [Hh h2]]].
  (* What the value exceeds. *)
  assert (Right : exact env direction_orientation_0_right = K * (H * H)).
  { replace (H * H) with (Rmax (square b) (square c)).
    - unfold K, b, c, a, sb, sc; lay_open; ring.
    - rewrite <- !length_square. unfold H, Rmax.
      destruct (Rle_dec (length b * length b) (length c * length c)), (Rle_dec (length b) (length c)); nra. }
  assert (Size : size env direction_orientation_0_right = exact env direction_orientation_0_right) by sizes.
  assert (R0 := least_value u 1 1 env _ r U Hr Size). fold G in R0. rewrite Right in R0.
  assert (Accepted : k * H < Rabs V).
  { unfold k. rewrite one_u_is. apply accepted with (l := l) (r := r); try assumption; [lra | nra]. }
  (* What it is off by. *)
  assert (Rounding : Rabs (V - det a b c) <= F * (A * (H * h))).
  { replace (det a b c) with (exact env direction_orientation_1_left)
      by (unfold b, c, a, sb, sc; lay_open; ring).
    eapply Rle_trans; [apply (error_of_formula u U 1 1 env _ V HV) |]. fold E.
    replace (size env direction_orientation_1_left) with (permanent a b c)
      by (unfold b, c, a, sb, sc; symmetry; sizes).
    assert (P := permanent_bound a b c). fold A in P. rewrite Rmult_assoc, Product in P. unfold F.
    assert (E * permanent a b c <= E * (11548 / 10000 * (A * (H * h)))) by (apply Rmult_le_compat_l; lra). lra. }
  assert (Stored : Rabs (det ea eb ec - det a b c) <=
                   (A + eta) * (H * h + 2 * eta * (H + h) + 2 * eta * (2 * eta)) - A * (H * h)).
  { replace (det ea eb ec) with (det ea (difference eb ea) (difference ec ea))
      by (destruct ea, eb, ec; unfold det, dot, cross, difference; simpl; ring).
    rewrite (exact_is_stored a ea) at 1. rewrite (exact_difference sb a eb ea), (exact_difference sc a ec ea).
    eapply Rle_trans; [apply change_of_det with (p := eta) (q := 2 * eta) (r := 2 * eta) |].
    - apply Sa.
    - apply off_2_range; assumption.
    - apply off_2_range; assumption.
    - fold b c A. apply Req_le.
      replace ((A + eta) * (length b + 2 * eta) * (length c + 2 * eta) - A * length b * length c)
        with ((A + eta) * (length b * length c + 2 * eta * (length b + length c) + 2 * eta * (2 * eta)) -
              A * (length b * length c)) by ring.
      rewrite Product, Sum. reflexivity. }
  assert (R := eta_range).
  assert (HV2 : Rabs V <= A * (H * h) * (1 + F)).
  { replace V with ((V - det a b c) + det a b c) by ring. eapply Rle_trans; [apply Rabs_triang |].
    assert (D := hadamard a b c). fold A in D. rewrite Rmult_assoc, Product in D. lra. }
  assert (H0 : 0 < H).
  { destruct (Rle_lt_or_eq_dec 0 H ltac:(lra)) as [? | Z]; [assumption |].
    rewrite <- Z in *. rewrite Rmult_0_r in Accepted. rewrite Rmult_0_l, Rmult_0_r, Rmult_0_l in HV2. lra. }
  assert (Low : k <= A * (1 + F) * h).
  { apply Rmult_le_reg_r with H; [assumption |].
    replace (A * (1 + F) * h * H) with (A * (H * h) * (1 + F)) by ring. lra. }
  assert (AF : 0 < A * (1 + F)) by nra.
  assert (h0 : 0 < h).
  { destruct (Rle_lt_or_eq_dec 0 h ltac:(lra)) as [? | Z]; [assumption |]. rewrite <- Z in Low. lra. }
  set (w := k / (A * (1 + F)) / h).
  assert (Hw : 0 <= w <= 1).
  { apply quotient_range; [| | assumption].
    - unfold Rdiv. apply Rmult_le_pos; [lra |]. left. apply Rinv_0_lt_compat. assumption.
    - apply Rmult_le_reg_r with (A * (1 + F)); [assumption |].
      replace (k / (A * (1 + F)) * (A * (1 + F))) with k by (field; lra). lra. }
  assert (M := direction_orientation_margin E G (2 * eta) eta A h w HE HG ltac:(lra) ltac:(lra) HA ltac:(lra) Hw).
  cbv zeta in M. fold F K k in M.
  set (q := 2 * eta * (A * (1 + F)) / k * w) in M.
  assert (Q : q * h = 2 * eta) by (unfold q, w; field; repeat split; lra).
  assert (q0 : 0 <= q).
  { apply Rmult_le_reg_r with h; [assumption |]. rewrite Q. lra. }
  apply right_sign with (k * H); [| assumption].
  replace (V - det ea eb ec) with ((V - det a b c) - (det ea eb ec - det a b c)) by ring.
  unfold Rminus at 1. eapply Rle_trans; [apply Rabs_triang |]. rewrite Rabs_Ropp.
  assert (2 * eta * h <= 2 * eta * H) by (apply Rmult_le_compat_l; lra).
  assert (S2 : 2 * eta * (H + h) + 2 * eta * (2 * eta) <= 2 * eta * (2 + q) * H).
  { rewrite <- Q at 3. assert (2 * eta * (q * h) <= 2 * eta * (q * H))
      by (apply Rmult_le_compat_l; [lra |]; apply Rmult_le_compat_l; lra). lra. }
  assert (S3 : (A + eta) * (2 * eta * (H + h) + 2 * eta * (2 * eta)) <= (A + eta) * (2 * eta * (2 + q) * H))
    by (apply Rmult_le_compat_l; lra).
  assert (M' := Rmult_le_compat_r H _ _ ltac:(lra) M). lra.
Qed.

(* --- circle_plane_bound: det(b - p, c - p, d - p) --- *)

Lemma circle_plane_margin E G T S w :
  0 <= E <= most u (count 1 1 circle_plane_1_left) -> 0 <= G <= most u (count 1 1 circle_plane_0_right) ->
  0 <= T <= 2 * eta -> 0 <= S <= 2049 / 1024 -> 0 <= w <= 1 ->
  let F := 11548 / 10000 * E in
  let k := sqrt (factor circle_plane_0_right * (1 - G) / (1 + one_u)) in
  let q := T * (1 + F) / k * w in
  T * (3 + 3 * q + q * q) + F * S <= k.
Proof.
  intros HE HG HT HS Hw F k q.
  apply Rnot_lt_le. intro N. apply (certificate_circle_plane.l1 E G T S w).
  unfold certificate_circle_plane.s1, certificate_circle_plane.s2, certificate_circle_plane.s3,
    certificate_circle_plane.s4, certificate_circle_plane.s5, certificate_circle_plane.s6, not.
  subst F k q. cbv zeta in *. unfold eta, factor, direction_error, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

Ltac choose := (left; ring) || (right; left; ring) || (right; right; ring).

(* Three lengths in order. *)
Lemma in_order l m s :
  0 <= l -> 0 <= m -> 0 <= s ->
  exists L M S, 0 <= S <= M /\ M <= L /\ l * m * s = L * M * S /\
    l * m + m * s + s * l = L * M + M * S + S * L /\ l + m + s = L + M + S /\
    Rmax (Rmax (l * l * (m * m)) (m * m * (s * s))) (s * s * (l * l)) = L * M * (L * M) /\
    (S = l \/ S = m \/ S = s).
Proof.
  intros Hl Hm Hs.
  assert (Order : forall L M S, 0 <= S -> S <= M -> M <= L ->
    S * S * (L * L) <= L * M * (L * M) /\ M * M * (S * S) <= L * M * (L * M)).
  { intros L M S P Q R. assert (S * L <= M * L) by nra. assert (M * S <= M * L) by nra.
    assert (0 <= S * L) by nra. assert (0 <= M * S) by nra. split; nra. }
  assert (Max : forall a b c t, a <= t -> b <= t -> c <= t -> (a = t \/ b = t \/ c = t) -> Rmax (Rmax a b) c = t).
  { intros a b c t A B C D. apply Rle_antisym.
    - apply Rmax_lub; [apply Rmax_lub; assumption | assumption].
    - destruct D as [<- | [<- | <-]].
      + eapply Rle_trans; [| apply Rmax_l]. apply Rmax_l.
      + eapply Rle_trans; [| apply Rmax_l]. apply Rmax_r.
      + apply Rmax_r. }
  destruct (Rle_dec l m), (Rle_dec m s), (Rle_dec l s); try lra.
  - exists s, m, l. destruct (Order s m l) as [O1 O2]; try lra.
    repeat split; try lra; auto; apply Max; try lra; choose.
  - exists m, s, l. destruct (Order m s l) as [O1 O2]; try lra.
    repeat split; try lra; auto; apply Max; try lra; choose.
  - exists m, l, s. destruct (Order m l s) as [O1 O2]; try lra.
    repeat split; try lra; auto; apply Max; try lra; choose.
  - exists s, l, m. destruct (Order s l m) as [O1 O2]; try lra.
    repeat split; try lra; auto; apply Max; try lra; choose.
  - exists l, s, m. destruct (Order l s m) as [O1 O2]; try lra.
    repeat split; try lra; auto; apply Max; try lra; choose.
  - exists l, m, s. destruct (Order l m s) as [O1 O2]; try lra.
    repeat split; try lra; auto; apply Max; try lra; choose.
Qed.

Theorem circle_plane_filter env eb ec ed ep V l r :
  is_stored (triple env 0) eb -> is_stored (triple env 3) ec -> is_stored (triple env 6) ed ->
  is_stored (triple env 9) ep ->
  computes u 1 1 env circle_plane_1_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env circle_plane_0_right r -> r < l ->
  0 < V * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof.
  set (sb := triple env 0). set (sc := triple env 3). set (sd := triple env 6). set (sp := triple env 9).
  intros Sb Sc Sd Sp HV Hl Hr Lt. assert (U := u_positive).
  set (b := difference sb sp). set (c := difference sc sp). set (d := difference sd sp).
  set (E := gamma u (count 1 1 circle_plane_1_left)).
  set (G := gamma u (count 1 1 circle_plane_0_right)).
  assert (HE : 0 <= E <= most u (count 1 1 circle_plane_1_left)) by ranges.
  assert (HG : 0 <= G <= most u (count 1 1 circle_plane_0_right)) by ranges.
  set (F := 11548 / 10000 * E). assert (HF : 0 <= F) by (unfold F; lra).
  set (K := factor circle_plane_0_right).
  assert (K0 : 0 < K) by (unfold K, factor, circle_plane_0_right, constant; simpl; lra).
  assert (G1 : G < 1).
  { destruct HG as [_ HG]. revert HG. compute_counts. unfold most. simpl. rewrite u_value. lra. }
  set (k := sqrt (K * (1 - G) / (1 + one_u))). assert (k0 : 0 < k) by (apply root_positive; assumption).
  assert (Lb := length_positive b). assert (Lc := length_positive c). assert (Ld := length_positive d).
  assert (B2 := length_of_stored_2 sb sp eb ep Sb Sp). fold b in B2.
  assert (C2 := length_of_stored_2 sc sp ec ep Sc Sp). fold c in C2.
  assert (D2 := length_of_stored_2 sd sp ed ep Sd Sp). fold d in D2.
  destruct (in_order (length b) (length c) (length d) Lb Lc Ld)
    as [L [M [S [HS [HM [P3 [P2 [P1 [Max Which]]]]]]]]].
  assert (S2 : S <= 2049 / 1024) by (destruct Which as [-> | [-> | ->]]; assumption).
  set (N := L * M). assert (N0 : 0 <= N) by (unfold N; nra).
  (* What the value exceeds. *)
  assert (Right : exact env circle_plane_0_right = K * (N * N)).
  { unfold N. rewrite <- Max, !length_square. unfold K, b, c, d, sb, sc, sd, sp; lay_open; ring. }
  assert (Size : size env circle_plane_0_right = exact env circle_plane_0_right) by sizes.
  assert (R0 := least_value u 1 1 env _ r U Hr Size). fold G in R0. rewrite Right in R0.
  assert (Accepted : k * N < Rabs V).
  { unfold k. rewrite one_u_is. apply accepted with (l := l) (r := r); try assumption. nra. }
  (* What it is off by. *)
  assert (Rounding : Rabs (V + det b c d) <= F * (N * S)).
  { replace (V + det b c d) with (V - - det b c d) by ring.
    replace (- det b c d) with (exact env circle_plane_1_left)
      by (unfold b, c, d, sb, sc, sd, sp; lay_open; ring).
    eapply Rle_trans; [apply (error_of_formula u U 1 1 env _ V HV) |]. fold E.
    replace (size env circle_plane_1_left) with (permanent b c d)
      by (unfold b, c, d, sb, sc, sd, sp; symmetry; sizes).
    assert (P := permanent_bound b c d). rewrite P3 in P. unfold F, N.
    assert (E * permanent b c d <= E * (11548 / 10000 * (L * M * S))) by (apply Rmult_le_compat_l; lra). lra. }
  set (T := 2 * eta). assert (R := eta_range). assert (HT : 0 < T) by (unfold T, eta, factor, direction_error, constant; simpl; lra).
  assert (Stored : Rabs (det (difference eb ep) (difference ec ep) (difference ed ep) - det b c d) <=
                   T * (L * M + M * S + S * L) + T * T * (L + M + S) + T * T * T).
  { rewrite (exact_difference sb sp eb ep), (exact_difference sc sp ec ep), (exact_difference sd sp ed ep).
    eapply Rle_trans; [apply change_of_det with (p := T) (q := T) (r := T) |];
      try (apply off_2_range; assumption).
    fold b c d. rewrite <- P2, <- P1. apply Req_le. ring. }
  assert (HV2 : Rabs V <= N * S * (1 + F)).
  { replace V with ((V + det b c d) - det b c d) by ring. unfold Rminus.
    eapply Rle_trans; [apply Rabs_triang |]. rewrite Rabs_Ropp.
    assert (D := hadamard b c d). rewrite P3 in D. fold N in D. lra. }
  assert (Np : 0 < N).
  { destruct (Rle_lt_or_eq_dec 0 N N0) as [? | Z]; [assumption |].
    rewrite <- Z in *. rewrite Rmult_0_r in Accepted. rewrite !Rmult_0_l in HV2. lra. }
  assert (Low : k <= (1 + F) * S).
  { apply Rmult_le_reg_r with N; [assumption |].
    replace ((1 + F) * S * N) with (N * S * (1 + F)) by ring. lra. }
  assert (S0 : 0 < S).
  { destruct (Rle_lt_or_eq_dec 0 S ltac:(lra)) as [? | Z]; [assumption |]. rewrite <- Z in Low. lra. }
  set (w := k / (1 + F) / S).
  assert (Hw : 0 <= w <= 1).
  { apply quotient_range; [| | assumption].
    - unfold Rdiv. apply Rmult_le_pos; [lra |]. left. apply Rinv_0_lt_compat. lra.
    - apply Rmult_le_reg_r with (1 + F); [lra |].
      replace (k / (1 + F) * (1 + F)) with k by (field; lra). lra. }
  assert (Margin := circle_plane_margin E G T S w HE HG ltac:(unfold T; lra) ltac:(lra) Hw).
  cbv zeta in Margin. fold F K k in Margin.
  set (q := T * (1 + F) / k * w) in Margin.
  assert (Q : q * S = T) by (unfold q, w; field; repeat split; lra).
  assert (q0 : 0 <= q).
  { apply Rmult_le_reg_r with S; [assumption |]. rewrite Q. lra. }
  apply right_sign with (k * N); [| assumption].
  set (e := det (difference eb ep) (difference ec ep) (difference ed ep)) in *.
  replace (V - - e) with ((V + det b c d) + (e - det b c d)) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  (* Lengths over L M: S is the shortest. *)
  assert (O1 : L * M + M * S + S * L <= 3 * N).
  { unfold N. assert (M * S <= M * L) by (apply Rmult_le_compat_l; lra).
    assert (S * L <= M * L) by (apply Rmult_le_compat_r; lra). lra. }
  assert (O2 : T * (L + M + S) <= 3 * q * N).
  { rewrite <- Q. unfold N. assert (S * L <= M * L) by (apply Rmult_le_compat_r; lra).
    assert (S * M <= L * M) by (apply Rmult_le_compat_r; lra).
    assert (S * S <= L * M) by (apply Rmult_le_compat; lra).
    replace (q * S * (L + M + S)) with (q * (S * L + S * M + S * S)) by ring.
    replace (3 * q * (L * M)) with (q * (3 * (L * M))) by ring. apply Rmult_le_compat_l; lra. }
  assert (O3 : T * T <= q * q * N).
  { rewrite <- Q. unfold N. assert (S * S <= L * M) by (apply Rmult_le_compat; lra).
    replace (q * S * (q * S)) with (q * q * (S * S)) by ring. apply Rmult_le_compat_l; [nra | assumption]. }
  assert (O1' : T * (L * M + M * S + S * L) <= T * (3 * N)) by (apply Rmult_le_compat_l; lra).
  assert (O2' : T * (T * (L + M + S)) <= T * (3 * q * N)) by (apply Rmult_le_compat_l; lra).
  assert (O3' : T * (T * T) <= T * (q * q * N)) by (apply Rmult_le_compat_l; lra).
  assert (M' := Rmult_le_compat_r N _ _ ltac:(lra) Margin). lra.
Qed.

(* sure_side_of_face: the same with b and p exchanged, and the opposite sign. *)
Fixpoint renamed (f : nat -> nat) (t : term) : term :=
  match t with
  | Given n => Given (f n)
  | Constant m e => Constant m e
  | Opposite a => Opposite (renamed f a)
  | Absolute a => Absolute (renamed f a)
  | Scaled a e => Scaled (renamed f a) e
  | Largest a b => Largest (renamed f a) (renamed f b)
  | Least a b => Least (renamed f a) (renamed f b)
  | Plus a b => Plus (renamed f a) (renamed f b)
  | Minus a b => Minus (renamed f a) (renamed f b)
  | Times a b => Times (renamed f a) (renamed f b)
  end.

Lemma computes_renamed unit s p env f t r :
  computes unit s p env (renamed f t) r -> computes unit s p (fun n => env (f n)) t r.
Proof.
  revert r. induction t; intros r H; simpl in H; inversion H; subst;
    [apply (computes_given unit s p (fun n => env (f n))) | econstructor; eauto ..].
Qed.

(* The first point and the last one. *)
Definition exchanged (n : nat) : nat := if Nat.ltb n 3 then n + 9 else if Nat.ltb n 9 then n else n - 9.

Lemma sure_side_compares_what_circle_plane_does :
  renamed exchanged circle_plane_1_left = Opposite sure_side_1_left /\
  renamed exchanged circle_plane_0_right = sure_side_0_right.
Proof. split; reflexivity. Qed.

Theorem sure_side_filter env eb ec ed ep V l r :
  is_stored (triple env 0) eb -> is_stored (triple env 3) ec -> is_stored (triple env 6) ed ->
  is_stored (triple env 9) ep ->
  computes u 1 1 env sure_side_1_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env sure_side_0_right r -> r < l ->
  0 < V * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof.
  intros Sb Sc Sd Sp HV Hl Hr L. destruct sure_side_compares_what_circle_plane_does as [Left Right].
  assert (HV' : computes u 1 1 env (renamed exchanged circle_plane_1_left) (- V))
    by (rewrite Left; apply computes_opposite; assumption).
  rewrite <- Right in Hr. apply computes_renamed in HV', Hr.
  assert (P : 0 < - V * - det (difference ep eb) (difference ec eb) (difference ed eb)).
  { apply circle_plane_filter with (env := fun n => env (exchanged n)) (l := l) (r := r); try assumption.
    replace (- V * - V) with (V * V) by ring. assumption. }
  replace (det (difference ep eb) (difference ec eb) (difference ed eb))
    with (- det (difference eb ep) (difference ec ep) (difference ed ep)) in P
    by (unfold det, dot, cross, difference; simpl; ring).
  lra.
Qed.

(* --- circle_bound: |b-p|^2 det(p, c-p, d-p) + ... --- *)

Lemma circle_margin E G T e A H w :
  0 <= E <= most u (count 1 1 circle_2_left) -> 0 <= G <= most u (count 1 1 circle_1_right) ->
  0 <= T <= 2 * eta -> 0 <= e <= eta -> 2047 / 2048 <= A <= 2049 / 2048 -> 0 <= H <= 2049 / 1024 ->
  0 <= w <= 1 ->
  let F := 11548 / 10000 * E in
  let k := sqrt (factor circle_1_right * (1 - G) / (1 + one_u)) in
  let q := T * (3 * A * (1 + F)) / k * w in
  3 * ((A + e) * (T * (4 + 6 * q + 4 * (q * q) + q * q * q))) + 3 * (e * H) + 3 * (F * (A * H)) <= k.
Proof.
  intros HE HG HT He HA HH Hw F k q.
  apply Rnot_lt_le. intro N. apply (certificate_circle.l1 E G T e A H w).
  unfold certificate_circle.s1, certificate_circle.s2, certificate_circle.s3, certificate_circle.s4,
    certificate_circle.s5, certificate_circle.s6, certificate_circle.s7, certificate_circle.s8, not.
  subst F k q. cbv zeta in *. unfold eta, factor, direction_error, one_u in *. numbers.
  repeat split; try lra; intro; lra.
Qed.

Definition sheared p b c d := square b * det p c d + square c * det p d b + square d * det p b c.

(* On the unit sphere the sheared form is -2 times the determinant. *)
Lemma sheared_is_det p b c d :
  length p = 1 -> length b = 1 -> length c = 1 -> length d = 1 ->
  sheared p (difference b p) (difference c p) (difference d p) =
  2 * - det (difference b p) (difference c p) (difference d p).
Proof.
  intros Hp Hb Hc Hd.
  assert (P : square p = 1) by (rewrite <- length_square, Hp; ring).
  assert (Tangent : forall q, length q = 1 -> square (difference q p) = -2 * dot p (difference q p)).
  { intros q Hq. assert (Q : square q = 1) by (rewrite <- length_square, Hq; ring).
    replace (square (difference q p)) with (square q + square p - 2 * dot p q)
      by (destruct p, q; unfold square, dot, difference; simpl; ring).
    replace (dot p (difference q p)) with (dot p q - square p)
      by (destruct p, q; unfold square, dot, difference; simpl; ring). rewrite P, Q. ring. }
  unfold sheared. rewrite !Tangent by assumption.
  replace (2 * - det (difference b p) (difference c p) (difference d p))
    with (-2 * (square p * det (difference b p) (difference c p) (difference d p))) by (rewrite P; ring).
  generalize (difference b p), (difference c p), (difference d p).
  intros [b1 b2 b3] [c1 c2 c3] [d1 d2 d3]. destruct p. unfold det, square, dot, cross; simpl. ring.
Qed.

Lemma change_of_product X Y X' Y' mx my dx dy :
  0 <= X <= mx -> Rabs Y <= my -> Rabs (X' - X) <= dx -> Rabs (Y' - Y) <= dy ->
  Rabs (X' * Y' - X * Y) <= (mx + dx) * (my + dy) - mx * my.
Proof.
  intros HX HY DX DY. replace (X' * Y' - X * Y) with ((X' - X) * Y + (X' - X) * (Y' - Y) + X * (Y' - Y)) by ring.
  assert (A := Rabs_pos Y). assert (B := Rabs_pos (X' - X)). assert (C := Rabs_pos (Y' - Y)).
  eapply Rle_trans; [apply Rabs_triang |].
  assert (T := Rabs_triang ((X' - X) * Y) ((X' - X) * (Y' - Y))).
  rewrite !Rabs_mult in *. rewrite (Rabs_pos_eq X) by lra.
  assert (Rabs (X' - X) * Rabs Y <= dx * my) by (apply Rmult_le_compat; assumption).
  assert (Rabs (X' - X) * Rabs (Y' - Y) <= dx * dy) by (apply Rmult_le_compat; assumption).
  assert (X * Rabs (Y' - Y) <= mx * dy) by (apply Rmult_le_compat; lra). lra.
Qed.

(* One of the three terms, whose vectors move by at most e and T. *)
Lemma change_of_term p b c d f g h i e T H :
  length b <= H -> length c <= H -> length d <= H -> length f <= e ->
  length g <= T -> length h <= T -> length i <= T ->
  Rabs (square (sum b g) * det (sum p f) (sum c h) (sum d i) - square b * det p c d) <=
  (length p + e) * ((H + T) * (H + T) * ((H + T) * (H + T))) - length p * (H * H * (H * H)).
Proof.
  intros Hb Hc Hd Hf Hg Hh Hi.
  assert (Lp := length_positive p). assert (Lb := length_positive b). assert (Lc := length_positive c).
  assert (Ld := length_positive d). assert (Lf := length_positive f). assert (Lg := length_positive g).
  assert (Lh := length_positive h). assert (Li := length_positive i).
  assert (S : Rabs (square (sum b g) - square b) <= 2 * H * T + T * T).
  { replace (square (sum b g) - square b) with (2 * dot b g + square g)
      by (destruct b, g; unfold square, dot, sum; simpl; ring).
    assert (C := cauchy b g). apply Rabs_le_inv in C. rewrite <- length_square.
    assert (length b * length g <= H * T) by (apply Rmult_le_compat; assumption).
    assert (length g * length g <= T * T) by (apply Rmult_le_compat; assumption).
    assert (0 <= length g * length g) by nra. apply Rabs_le. split; lra. }
  assert (D : Rabs (det (sum p f) (sum c h) (sum d i) - det p c d) <=
              (length p + e) * ((H + T) * (H + T)) - length p * (H * H)).
  { eapply Rle_trans; [apply change_of_det with (p := e) (q := T) (r := T); assumption |].
    replace ((length p + e) * (length c + T) * (length d + T) - length p * length c * length d)
      with (e * (length c * length d) + (length p + e) * (T * length c + T * length d + T * T)) by ring.
    replace ((length p + e) * ((H + T) * (H + T)) - length p * (H * H))
      with (e * (H * H) + (length p + e) * (T * H + T * H + T * T)) by ring.
    assert (length c * length d <= H * H) by (apply Rmult_le_compat; assumption).
    assert (T * length c <= T * H) by (apply Rmult_le_compat_l; lra).
    assert (T * length d <= T * H) by (apply Rmult_le_compat_l; lra).
    apply Rplus_le_compat; apply Rmult_le_compat_l; lra. }
  assert (B : 0 <= square b <= H * H).
  { rewrite <- length_square. split; [nra |]. apply Rmult_le_compat; assumption. }
  assert (Y : Rabs (det p c d) <= length p * (H * H)).
  { eapply Rle_trans; [apply hadamard |]. rewrite Rmult_assoc. apply Rmult_le_compat_l; [assumption |].
    apply Rmult_le_compat; assumption. }
  eapply Rle_trans; [apply (change_of_product _ _ _ _ _ _ _ _ B Y S D) |]. apply Req_le. ring.
Qed.

Lemma Rabs_sum_of_three a b c t : Rabs a <= t -> Rabs b <= t -> Rabs c <= t -> Rabs (a + b + c) <= 3 * t.
Proof.
  intros A B C. apply Rabs_le_inv in A, B, C. apply Rabs_le. split; lra.
Qed.

Theorem circle_filter env eb ec ed ep V l r :
  is_stored (triple env 0) eb -> is_stored (triple env 3) ec -> is_stored (triple env 6) ed ->
  is_stored (triple env 9) ep ->
  computes u 1 1 env circle_2_left V -> Rabs (l - V * V) <= u * Rabs (V * V) ->
  computes u 1 1 env circle_1_right r -> r < l ->
  0 < V * - det (difference eb ep) (difference ec ep) (difference ed ep).
Proof.
  set (sb := triple env 0). set (sc := triple env 3). set (sd := triple env 6). set (p := triple env 9).
  intros Sb Sc Sd Sp HV Hl Hr Lt. assert (U := u_positive).
  set (b := difference sb p). set (c := difference sc p). set (d := difference sd p).
  set (E := gamma u (count 1 1 circle_2_left)).
  set (G := gamma u (count 1 1 circle_1_right)).
  assert (HE : 0 <= E <= most u (count 1 1 circle_2_left)) by ranges.
  assert (HG : 0 <= G <= most u (count 1 1 circle_1_right)) by ranges.
  set (F := 11548 / 10000 * E). assert (HF : 0 <= F) by (unfold F; lra).
  set (K := factor circle_1_right).
  assert (K0 : 0 < K) by (unfold K, factor, circle_1_right, constant; simpl; lra).
  assert (G1 : G < 1).
  { destruct HG as [_ HG]. revert HG. compute_counts. unfold most. simpl. rewrite u_value. lra. }
  set (k := sqrt (K * (1 - G) / (1 + one_u))). assert (k0 : 0 < k) by (apply root_positive; assumption).
  set (A := length p). assert (HA := length_of_stored p ep Sp). fold A in HA.
  assert (Lb := length_positive b). assert (Lc := length_positive c). assert (Ld := length_positive d).
  assert (B2 := length_of_stored_2 sb p eb ep Sb Sp). fold b in B2.
  assert (C2 := length_of_stored_2 sc p ec ep Sc Sp). fold c in C2.
  assert (D2 := length_of_stored_2 sd p ed ep Sd Sp). fold d in D2.
  set (H := Rmax (Rmax (length b) (length c)) (length d)).
  assert (Hb : length b <= H) by (eapply Rle_trans; [| apply Rmax_l]; apply Rmax_l).
  assert (Hc : length c <= H) by (eapply Rle_trans; [| apply Rmax_l]; apply Rmax_r).
  assert (Hd : length d <= H) by apply Rmax_r.
  assert (H2 : H <= 2049 / 1024) by (apply Rmax_lub; [apply Rmax_lub |]; assumption).
  assert (Square : Rmax (Rmax (square b) (square c)) (square d) = H * H).
  { rewrite <- !length_square. apply Rle_antisym.
    - apply Rmax_lub; [apply Rmax_lub |]; apply Rmult_le_compat; assumption.
    - unfold H. destruct (Rle_dec (length b) (length c)) as [Q | Q];
        [rewrite (Rmax_right (length b)) by assumption | rewrite (Rmax_left (length b)) by lra];
        match goal with |- Rmax ?s ?t * _ <= _ => destruct (Rle_dec s t) end;
        [rewrite !(Rmax_right (length c)) by assumption | rewrite !(Rmax_left (length c)) by lra
        | rewrite !(Rmax_right (length b) (length d)) by assumption
        | rewrite !(Rmax_left (length b) (length d)) by lra];
        try apply Rmax_r; (eapply Rle_trans; [| apply Rmax_l]); (apply Rmax_r || apply Rmax_l). }
  set (N := H * H * H). assert (N0 : 0 <= N) by (unfold N; repeat apply Rmult_le_pos; lra).
  (* What the value exceeds. *)
  assert (Right : exact env circle_1_right = K * (N * N)).
  { replace (N * N) with (H * H * (H * H) * (H * H)) by (unfold N; ring). rewrite <- Square.
    unfold K, b, c, d, sb, sc, sd, p; lay_open; ring. }
  assert (Size : size env circle_1_right = exact env circle_1_right) by sizes.
  assert (R0 := least_value u 1 1 env _ r U Hr Size). fold G in R0. rewrite Right in R0.
  assert (Accepted : k * N < Rabs V).
  { unfold k. rewrite one_u_is. apply accepted with (l := l) (r := r); try assumption. nra. }
  set (H4 := H * H * (H * H)).
  (* What it is off by. *)
  assert (Rounding : Rabs (V - sheared p b c d) <= 3 * (F * (A * H4))).
  { replace (sheared p b c d) with (exact env circle_2_left)
      by (unfold sheared, b, c, d, sb, sc, sd, p; lay_open; ring).
    eapply Rle_trans; [apply (error_of_formula u U 1 1 env _ V HV) |]. fold E.
    replace (size env circle_2_left)
      with (square b * permanent p c d + square c * permanent p d b + square d * permanent p b c)
      by (unfold b, c, d, sb, sc, sd, p; symmetry; sizes).
    assert (Term : forall f g h, length f <= H -> length g <= H -> length h <= H ->
                     square f * permanent p g h <= 11548 / 10000 * (A * H4)).
    { intros f g h Qf Qg Qh. assert (P := permanent_bound p g h). fold A in P.
      assert (P0 := permanent_positive p g h).
      assert (Lf := length_positive f). assert (Lg := length_positive g). assert (Lh := length_positive h).
      assert (square f <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
      assert (length g * length h <= H * H) by (apply Rmult_le_compat; assumption).
      assert (permanent p g h <= 11548 / 10000 * (A * (H * H))).
      { eapply Rle_trans; [exact P |]. apply Rmult_le_compat_l; [lra |]. rewrite Rmult_assoc.
        apply Rmult_le_compat_l; lra. }
      replace (11548 / 10000 * (A * H4)) with (H * H * (11548 / 10000 * (A * (H * H)))) by (unfold H4; ring).
      apply Rmult_le_compat; try assumption. apply square_positive. }
    assert (T1 := Term b c d Hb Hc Hd). assert (T2 := Term c d b Hc Hd Hb). assert (T3 := Term d b c Hd Hb Hc).
    unfold F.
    assert (E * (square b * permanent p c d + square c * permanent p d b + square d * permanent p b c) <=
            E * (3 * (11548 / 10000 * (A * H4)))) by (apply Rmult_le_compat_l; lra). lra. }
  set (T := 2 * eta). assert (R := eta_range).
  assert (HT : 0 < T) by (unfold T, eta, factor, direction_error, constant; simpl; lra).
  set (e := sheared ep (difference eb ep) (difference ec ep) (difference ed ep)).
  assert (Stored : Rabs (e - sheared p b c d) <=
                   3 * ((A + eta) * ((H + T) * (H + T) * ((H + T) * (H + T))) - A * H4)).
  { unfold e. rewrite (exact_difference sb p eb ep), (exact_difference sc p ec ep), (exact_difference sd p ed ep).
    replace (sheared ep) with (sheared (sum p (off p ep))) by (rewrite <- exact_is_stored; reflexivity).
    fold b c d.
    assert (Op : length (off p ep) <= eta) by apply Sp.
    assert (Ob := off_2_range sb p eb ep Sb Sp). assert (Oc := off_2_range sc p ec ep Sc Sp).
    assert (Od := off_2_range sd p ed ep Sd Sp). fold T in Ob, Oc, Od.
    unfold sheared.
    set (b' := off_2 sb p eb ep) in *. set (c' := off_2 sc p ec ep) in *. set (d' := off_2 sd p ed ep) in *.
    set (p' := off p ep) in *.
    assert (T1 := change_of_term p b c d p' b' c' d' eta T H Hb Hc Hd Op Ob Oc Od).
    assert (T2 := change_of_term p c d b p' c' d' b' eta T H Hc Hd Hb Op Oc Od Ob).
    assert (T3 := change_of_term p d b c p' d' b' c' eta T H Hd Hb Hc Op Od Ob Oc).
    fold A H4 in T1, T2, T3. assert (S := Rabs_sum_of_three _ _ _ _ T1 T2 T3).
    eapply Rle_trans; [| exact S]. apply Req_le. f_equal. ring. }
  assert (HV2 : Rabs V <= 3 * A * H4 * (1 + F)).
  { replace V with ((V - sheared p b c d) + sheared p b c d) by ring. eapply Rle_trans; [apply Rabs_triang |].
    assert (Term : forall f g h, length f <= H -> length g <= H -> length h <= H ->
                     Rabs (square f * det p g h) <= A * H4).
    { intros f g h Qf Qg Qh. rewrite Rabs_mult, (Rabs_pos_eq (square f)) by apply square_positive.
      assert (P := hadamard p g h). fold A in P.
      assert (Lf := length_positive f). assert (Lg := length_positive g). assert (Lh := length_positive h).
      assert (square f <= H * H) by (rewrite <- length_square; apply Rmult_le_compat; assumption).
      assert (length g * length h <= H * H) by (apply Rmult_le_compat; assumption).
      assert (Rabs (det p g h) <= A * (H * H)).
      { eapply Rle_trans; [exact P |]. rewrite Rmult_assoc. apply Rmult_le_compat_l; lra. }
      replace (A * H4) with (H * H * (A * (H * H))) by (unfold H4; ring).
      apply Rmult_le_compat; try assumption; [apply square_positive | apply Rabs_pos]. }
    assert (T1 := Term b c d Hb Hc Hd). assert (T2 := Term c d b Hc Hd Hb). assert (T3 := Term d b c Hd Hb Hc).
    assert (S := Rabs_sum_of_three _ _ _ _ T1 T2 T3). fold (sheared p b c d) in S. lra. }
  assert (H4N : H4 = H * N) by (unfold H4, N; ring).
  assert (H0 : 0 <= H) by lra.
  assert (Np : 0 < N).
  { destruct (Rle_lt_or_eq_dec 0 N N0) as [? | Z]; [assumption |].
    rewrite <- Z in *. rewrite Rmult_0_r in Accepted. rewrite H4N, !Rmult_0_r, Rmult_0_l in HV2. lra. }
  assert (Hp : 0 < H).
  { destruct (Rle_lt_or_eq_dec 0 H H0) as [? | Z]; [assumption |].
    unfold N in Np. rewrite <- Z, Rmult_0_l, Rmult_0_l in Np. lra. }
  assert (AF : 0 < 3 * A * (1 + F)) by nra.
  assert (Low : k <= 3 * A * (1 + F) * H).
  { apply Rmult_le_reg_r with N; [assumption |].
    replace (3 * A * (1 + F) * H * N) with (3 * A * H4 * (1 + F)) by (rewrite H4N; ring). lra. }
  set (w := k / (3 * A * (1 + F)) / H).
  assert (Hw : 0 <= w <= 1).
  { apply quotient_range; [| | assumption].
    - unfold Rdiv. apply Rmult_le_pos; [lra |]. left. apply Rinv_0_lt_compat. assumption.
    - apply Rmult_le_reg_r with (3 * A * (1 + F)); [assumption |].
      replace (k / (3 * A * (1 + F)) * (3 * A * (1 + F))) with k by (field; lra). lra. }
  assert (Margin := circle_margin E G T eta A H w HE HG ltac:(unfold T; lra) ltac:(lra) HA ltac:(lra) Hw).
  cbv zeta in Margin. fold F K k in Margin.
  set (q := T * (3 * A * (1 + F)) / k * w) in Margin.
  assert (Q : q * H = T) by (unfold q, w; field; repeat split; lra).
  assert (Result : 0 < V * e).
  { apply right_sign with (k * N); [| assumption].
    replace (V - e) with ((V - sheared p b c d) + - (e - sheared p b c d)) by ring.
    eapply Rle_trans; [apply Rabs_triang |]. rewrite Rabs_Ropp.
    assert (Grown : (A + eta) * ((H + T) * (H + T) * ((H + T) * (H + T))) - A * H4 =
                    ((A + eta) * (T * (4 + 6 * q + 4 * (q * q) + q * q * q)) + eta * H) * N).
    { rewrite <- Q. unfold H4, N. ring. }
    rewrite Grown in Stored. rewrite H4N in Rounding.
    assert (M' := Rmult_le_compat_r N _ _ ltac:(lra) Margin). lra. }
  unfold e in Result. rewrite sheared_is_det in Result; [lra | apply Sp | apply Sb | apply Sc | apply Sd].
Qed.
