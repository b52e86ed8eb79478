(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* The filter of power distances within an angle, whose limit is a root. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry acceptance formulas stored sums.
From Rondel Require certificate_within_power certificate_within_power_limit.
Open Scope R_scope.

Lemma within_power_margin E R e G :
  0 <= E <= most u (count 1 1 (part_1 within_power_4_left)) ->
  0 <= R <= most u (count 1 1 within_power_3_right) -> - u <= e <= u ->
  Rabs G <= most u (count 1 1 within_power_Root_102_of) ->
  one_u * (1 + E) + E <= factor within_power_3_right * (1 - R) * ((1 + e) * sqrt (1 + G)).
Proof.
  intros HE HR He HG. apply Rnot_lt_le. intro. assert (P := Rabs_pos G).
  apply (certificate_within_power.l1 E R e G).
  unfold certificate_within_power.s1, certificate_within_power.s2, certificate_within_power.s3,
    certificate_within_power.s4, certificate_within_power.s5, not.
  unfold one_u in *. certify.
Qed.

Lemma within_power_limit_margin P R e G :
  0 <= P <= most u (count 1 1 (part_2 within_power_4_left)) ->
  0 <= R <= most u (count 1 1 within_power_3_right) -> - u <= e <= u ->
  Rabs G <= most u (count 1 1 within_power_Root_101_of) ->
  let s := (1 + e) * sqrt (1 + G) in
  one_u * (1 + P) * s + P * s + Rabs (s - 1) <= factor within_power_3_right * (1 - R) * s.
Proof.
  intros HP HR He HG s. apply Rnot_lt_le. intro. assert (Q := Rabs_pos G).
  apply (certificate_within_power_limit.l1 P R e G).
  unfold certificate_within_power_limit.s1, certificate_within_power_limit.s2,
    certificate_within_power_limit.s3, certificate_within_power_limit.s4, certificate_within_power_limit.s5, not.
  subst s. unfold one_u in *. certify.
Qed.

(* A root as it is computed: of its argument m, which is near to X, and rounded itself. *)
Lemma rounded_root env t m g :
  computes u 1 1 env t m -> size env t = exact env t -> 0 < exact env t ->
  Rabs (g - sqrt m) <= u * Rabs (sqrt m) -> gamma u (count 1 1 t) < 1 ->
  exists e G, - u <= e <= u /\ Rabs G <= gamma u (count 1 1 t) /\
    g = sqrt (exact env t) * ((1 + e) * sqrt (1 + G)) /\ 0 < (1 + e) * sqrt (1 + G).
Proof.
  intros Hm S X Hg G1. assert (U := u_positive). assert (U1 : u <= / 2) by (rewrite u_value; lra).
  assert (E := error_of_formula u U 1 1 env t m Hm). rewrite S in E.
  set (G := m / exact env t - 1).
  assert (HG : Rabs G <= gamma u (count 1 1 t)).
  { apply Rmult_le_reg_r with (exact env t); [assumption |].
    rewrite <- (Rabs_pos_eq (exact env t)) at 1 by lra. rewrite <- Rabs_mult.
    replace (G * exact env t) with (m - exact env t) by (unfold G; field; lra). assumption. }
  assert (GP : 0 < 1 + G) by (apply Rabs_le_inv in HG; lra).
  assert (RG : 0 < sqrt (1 + G)) by (apply sqrt_lt_R0; assumption).
  assert (RX : 0 < sqrt (exact env t)) by (apply sqrt_lt_R0; assumption).
  assert (Sq : sqrt m = sqrt (exact env t) * sqrt (1 + G)).
  { replace m with (exact env t * (1 + G)) by (unfold G; field; lra). apply sqrt_mult; lra. }
  assert (RM : 0 < sqrt m) by (rewrite Sq; apply Rmult_lt_0_compat; assumption).
  set (e := g / sqrt m - 1).
  assert (He : - u <= e <= u).
  { rewrite (Rabs_pos_eq (sqrt m)) in Hg by lra. apply Rabs_le_inv in Hg. unfold e.
    assert (I : 0 < / sqrt m) by (apply Rinv_0_lt_compat; assumption).
    assert (One : sqrt m * / sqrt m = 1) by (field; lra). unfold Rdiv. split; nra. }
  exists e, G. repeat split; try lra; try assumption.
  - replace g with (sqrt m * (1 + e)) by (unfold e; field; lra). rewrite Sq. ring.
  - apply Rmult_lt_0_compat; lra.
Qed.

(* is_within_power_filter: (p - o).(a - o) - c |p - o| R, where c = 1 - t / 2 and R^2 is given. *)
Theorem within_power_filter env m n V r :
  let ray := difference (triple env 3) (triple env 6) in
  let v := difference (triple env 0) (triple env 6) in
  let c := 1 - env 9%nat / 2 in
  0 < env 10%nat -> 0 < length ray -> 0 < length v -> env 100%nat = env 9%nat / 2 ->
  computes u 1 1 env within_power_Root_101_of m -> Rabs (env 101%nat - sqrt m) <= u * Rabs (sqrt m) ->
  computes u 1 1 env within_power_Root_102_of n -> Rabs (env 102%nat - sqrt n) <= u * Rabs (sqrt n) ->
  computes u 1 1 env within_power_4_left V -> computes u 1 1 env within_power_3_right r -> r < Rabs V ->
  0 < V * (dot ray v - c * length ray * sqrt (env 10%nat)).
Proof.
  intros ray v c R0 Lr Lv Half Hm H101 Hn H102 HV Hr L. assert (U := u_positive).
  assert (Sr : 0 < square ray) by (rewrite <- length_square; nra).
  assert (Sv : 0 < square v) by (rewrite <- length_square; nra).
  assert (X101 : exact env within_power_Root_101_of = square ray * env 10%nat) by (unfold ray; lay_open; ring).
  assert (X102 : exact env within_power_Root_102_of = square ray * square v) by (unfold ray, v; lay_open; ring).
  assert (P101 : 0 < square ray * env 10%nat) by (apply Rmult_lt_0_compat; assumption).
  assert (P102 : 0 < square ray * square v) by (apply Rmult_lt_0_compat; assumption).
  assert (HG1 : 0 <= gamma u (count 1 1 within_power_Root_101_of) <= most u (count 1 1 within_power_Root_101_of))
    by ranges.
  assert (HG2 : 0 <= gamma u (count 1 1 within_power_Root_102_of) <= most u (count 1 1 within_power_Root_102_of))
    by ranges.
  destruct (rounded_root env within_power_Root_101_of m (env 101%nat) Hm) as [e1 [G1 [He1 [HG1' [E101 Pos1]]]]];
    [lay_open; rewrite (Rabs_pos_eq (env 10%nat)) by lra; sizes | rewrite X101; assumption | assumption
    | destruct HG1 as [_ HG1]; eapply Rle_lt_trans; [exact HG1 |]; compute_counts; unfold most; simpl;
      rewrite u_value; lra |].
  destruct (rounded_root env within_power_Root_102_of n (env 102%nat) Hn) as [e2 [G2 [He2 [HG2' [E102 Pos2]]]]];
    [sizes | rewrite X102; assumption | assumption
    | destruct HG2 as [_ HG2]; eapply Rle_lt_trans; [exact HG2 |]; compute_counts; unfold most; simpl;
      rewrite u_value; lra |].
  rewrite X101, sqrt_mult in E101 by lra. rewrite X102, sqrt_mult in E102 by lra.
  fold (length ray) in E101, E102. fold (length v) in E102.
  set (A := length ray * length v) in *. set (rho := length ray * sqrt (env 10%nat)) in *.
  set (s1 := (1 + e1) * sqrt (1 + G1)) in *. set (s2 := (1 + e2) * sqrt (1 + G2)) in *.
  assert (A0 : 0 < A) by (unfold A; apply Rmult_lt_0_compat; assumption).
  assert (rho0 : 0 < rho) by (unfold rho; apply Rmult_lt_0_compat; [assumption | apply sqrt_lt_R0; assumption]).
  destruct (operands_of_minus _ _ _ _ _ _ _ HV) as [x0 [y0 [Hx [Hy Hz]]]]. rewrite gamma_one in Hz.
  assert (Ex := error_of_formula u U 1 1 env _ x0 Hx). assert (Ey := error_of_formula u U 1 1 env _ y0 Hy).
  change (count 1 1 _) with (count 1 1 (part_1 within_power_4_left)) in Ex at 1.
  change (count 1 1 _) with (count 1 1 (part_2 within_power_4_left)) in Ey at 1.
  assert (HE : 0 <= gamma u (count 1 1 (part_1 within_power_4_left)) <= most u (count 1 1 (part_1 within_power_4_left)))
    by ranges.
  assert (HP : 0 <= gamma u (count 1 1 (part_2 within_power_4_left)) <= most u (count 1 1 (part_2 within_power_4_left)))
    by ranges.
  assert (HR : 0 <= gamma u (count 1 1 within_power_3_right) <= most u (count 1 1 within_power_3_right)) by ranges.
  set (E := gamma u (count 1 1 (part_1 within_power_4_left))) in *.
  set (P := gamma u (count 1 1 (part_2 within_power_4_left))) in *.
  set (R := gamma u (count 1 1 within_power_3_right)) in *.
  set (tx := part_1 within_power_4_left). set (ty := part_2 within_power_4_left).
  change (Rabs (x0 - exact env tx) <= E * size env tx) in Ex.
  change (Rabs (y0 - exact env ty) <= P * size env ty) in Ey.
  assert (Xx : exact env tx = dot ray v) by (unfold tx, ray, v; lay_open; ring).
  assert (Sx : size env tx <= A).
  { eapply Rle_trans; [| apply sum_of_products_bound]. apply Req_le. unfold tx, ray, v; sizes. }
  assert (One : constant 1 0 = 1) by (unfold constant; simpl; ring).
  assert (Xy : exact env ty = env 101%nat * c)
    by (unfold ty, c; lay_open; rewrite One, Half; reflexivity).
  assert (g1 : 0 < env 101%nat) by (rewrite E101; apply Rmult_lt_0_compat; assumption).
  assert (g2 : 0 < env 102%nat) by (rewrite E102; apply Rmult_lt_0_compat; assumption).
  assert (Sy : size env ty = env 101%nat * Rabs c).
  { unfold ty, c; lay_open. rewrite One, Half, (Rabs_pos_eq (env 101%nat)) by lra. reflexivity. }
  rewrite Xx in Ex. rewrite Xy, Sy in Ey.
  set (K := factor within_power_3_right) in *.
  assert (Right : exact env within_power_3_right = K * (env 102%nat + env 101%nat * Rabs c)).
  { unfold K, c; lay_open. rewrite One, Half, Rabs_mult, (Rabs_pos_eq (env 101%nat)) by lra. reflexivity. }
  assert (Size : size env within_power_3_right = exact env within_power_3_right).
  { lay_open. rewrite Rabs_mult, (Rabs_pos_eq (env 101%nat)), (Rabs_pos_eq (env 102%nat)) by lra.
    rewrite (Rabs_pos_eq (constant _ (-52))) by (apply constant_positive; lia). reflexivity. }
  assert (RR := least_value u 1 1 env _ r U Hr Size). fold R in RR. rewrite Right, E101, E102 in RR.
  assert (M1 := within_power_margin E R e2 G2 HE HR He2 ltac:(lra)).
  assert (M2 := within_power_limit_margin P R e1 G1 HP HR He1 ltac:(lra)). cbv zeta in M2.
  fold K s2 in M1. fold K s1 in M2. rewrite one_u_is in M1, M2.
  assert (C := Rabs_pos c). assert (B0 : 0 <= rho * Rabs c) by (apply Rmult_le_pos; lra).
  assert (M1' := Rmult_le_compat_r A _ _ ltac:(lra) M1).
  assert (M2' := Rmult_le_compat_r (rho * Rabs c) _ _ B0 M2).
  rewrite E101 in Ey.
  replace (c * length ray * sqrt (env 10%nat)) with (rho * c) by (unfold rho; ring).
  apply right_sign with r; [| assumption].
  assert (Dx : Rabs (x0 - dot ray v) <= E * A).
  { eapply Rle_trans; [exact Ex |]. apply Rmult_le_compat_l; [apply HE | assumption]. }
  assert (Cs := cauchy ray v). fold A in Cs.
  assert (Bx : Rabs x0 <= (1 + E) * A).
  { replace x0 with ((x0 - dot ray v) + dot ray v) by ring. eapply Rle_trans; [apply Rabs_triang |]. lra. }
  assert (Abs : Rabs (rho * s1 * c) = s1 * (rho * Rabs c)).
  { rewrite !Rabs_mult, (Rabs_pos_eq rho), (Rabs_pos_eq s1) by lra. ring. }
  assert (By : Rabs y0 <= (1 + P) * (s1 * (rho * Rabs c))).
  { replace y0 with ((y0 - rho * s1 * c) + rho * s1 * c) by ring. eapply Rle_trans; [apply Rabs_triang |].
    rewrite Abs. lra. }
  assert (Dy : Rabs (y0 - rho * c) <= P * (s1 * (rho * Rabs c)) + Rabs (s1 - 1) * (rho * Rabs c)).
  { replace (y0 - rho * c) with ((y0 - rho * s1 * c) + (s1 - 1) * (rho * c)) by ring.
    eapply Rle_trans; [apply Rabs_triang |]. rewrite (Rabs_mult (s1 - 1)), (Rabs_mult rho), (Rabs_pos_eq rho) by lra.
    lra. }
  assert (Dz : Rabs (V - (x0 - y0)) <= u * ((1 + E) * A) + u * ((1 + P) * (s1 * (rho * Rabs c)))).
  { eapply Rle_trans; [exact Hz |].
    assert (Rabs (x0 - y0) <= Rabs x0 + Rabs y0).
    { unfold Rminus. eapply Rle_trans; [apply Rabs_triang |]. rewrite Rabs_Ropp. lra. }
    assert (u * Rabs (x0 - y0) <= u * ((1 + E) * A + (1 + P) * (s1 * (rho * Rabs c))))
      by (apply Rmult_le_compat_l; lra). lra. }
  replace (V - (dot ray v - rho * c)) with ((V - (x0 - y0)) + ((x0 - dot ray v) - (y0 - rho * c))) by ring.
  apply Rabs_le_inv in Dx, Dy, Dz. apply Rabs_le. split; lra.
Qed.
