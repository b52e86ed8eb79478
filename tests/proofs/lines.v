(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Shewchuk's filter of orientation in the plane, relative to what is computed, not to what is exact: his constant is
   too small for the counts of the other filters. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core Relative Plus_error.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry acceptance formulas stored.
From Rondel Require certificate_side_of_line.
Open Scope R_scope.

#[local] Existing Instance precision_is_positive.

(* z is x rounded. *)
Definition rounds (z x : R) : Prop := Rabs (z - x) <= u * Rabs z /\ Rabs (z - x) <= u * Rabs x.

Lemma rounded_sum_rounds a b : is_double a -> is_double b -> rounds (rounded (a + b)) (a + b).
Proof.
  intros A B. split; [| apply rounded_sum; assumption].
  destruct (FLT_plus_error_N_round_ex radix2 (-1074) 53 (fun z => negb (Z.even z)) a b A B) as [e [He E]].
  unfold rounded. rewrite E at 2.
  set (z := round radix2 (FLT_exp (-1074) 53) ZnearestE (a + b)) in *.
  replace (z - z * (1 + e)) with (- e * z) by ring. rewrite Rabs_mult, Rabs_Ropp.
  apply Rmult_le_compat_r; [apply Rabs_pos |]. eapply Rle_trans; [exact He |].
  unfold u_ro. change (-53 + 1)%Z with (- (53) + 1)%Z. rewrite half_ulp_of_one. apply Rle_refl.
Qed.

Lemma rounded_product_rounds a b : is_normal (a * b) -> rounds (rounded (a * b)) (a * b).
Proof.
  intros N. split; [| apply rounded_normal; assumption]. destruct N as [-> | N].
  - unfold rounded. rewrite round_0 by apply valid_rnd_N. rewrite Rminus_0_r, Rabs_R0. lra.
  - assert (E := relative_error_N_FLT_round radix2 (-1074) 53 eq_refl (fun z => negb (Z.even z)) (a * b) N).
    eapply Rle_trans; [exact E |]. rewrite half_ulp_of_one. apply Rle_refl.
Qed.

Lemma side_of_line_margin :
  u * (3 + 3 * u + u * u) * ((1 + u) * (1 + u) * (1 + u)) <= factor (part_1 plane_line_0_right).
Proof.
  rewrite <- one_u_is. apply Rnot_lt_le. intro. apply (certificate_side_of_line.l1 one_u).
  unfold certificate_side_of_line.s1, certificate_side_of_line.s2, not, one_u in *. certify.
Qed.

(* The shape of the formulas. *)
Lemma side_of_line_shape :
  plane_line_0_left =
    Minus (Times (Minus (Given 0) (Given 4)) (Minus (Given 3) (Given 5)))
          (Times (Minus (Given 1) (Given 5)) (Minus (Given 2) (Given 4))) /\
  part_2 (part_1 plane_line_0_right) =
    Plus (Absolute (part_1 plane_line_0_left)) (Absolute (part_2 plane_line_0_left)).
Proof. split; reflexivity. Qed.

Lemma product_of_differences l p q P Q :
  rounds p P -> rounds q Q -> rounds l (p * q) -> Rabs (l - P * Q) <= u * (3 + 3 * u + u * u) * Rabs l.
Proof.
  intros [Hp _] [Hq _] [Hl _]. assert (U := u_positive).
  assert (A := Rabs_pos p). assert (B := Rabs_pos q). assert (C := Rabs_pos l).
  assert (PQ : Rabs p * Rabs q <= (1 + u) * Rabs l).
  { rewrite <- Rabs_mult. replace (p * q) with (l - (l - p * q)) by ring. unfold Rminus at 1.
    eapply Rle_trans; [apply Rabs_triang |]. rewrite Rabs_Ropp. lra. }
  assert (HP : Rabs P <= (1 + u) * Rabs p).
  { replace P with (p - (p - P)) by ring. unfold Rminus at 1.
    eapply Rle_trans; [apply Rabs_triang |]. rewrite Rabs_Ropp. lra. }
  replace (l - P * Q) with ((l - p * q) + ((p - P) * q + P * (q - Q))) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  assert (T := Rabs_triang ((p - P) * q) (P * (q - Q))). rewrite !Rabs_mult in T.
  assert (Rabs (p - P) * Rabs q <= u * Rabs p * Rabs q) by (apply Rmult_le_compat_r; assumption).
  assert (Rabs P * Rabs (q - Q) <= (1 + u) * Rabs p * (u * Rabs q))
    by (apply Rmult_le_compat; try assumption; apply Rabs_pos).
  assert (S : u * (2 + u) * (Rabs p * Rabs q) <= u * (2 + u) * ((1 + u) * Rabs l))
    by (apply Rmult_le_compat_l; [nra | assumption]).
  lra.
Qed.

(* side_of_line: k is the first term of the right side; with the second one added it is not smaller. *)
Theorem side_of_line_filter env p1 p2 q1 q2 l r t k V :
  rounds p1 (env 0%nat - env 4%nat) -> rounds p2 (env 3%nat - env 5%nat) ->
  rounds q1 (env 1%nat - env 5%nat) -> rounds q2 (env 2%nat - env 4%nat) ->
  rounds l (p1 * p2) -> rounds r (q1 * q2) -> rounds V (l - r) -> rounds t (Rabs l + Rabs r) ->
  rounds k (factor (part_1 plane_line_0_right) * t) -> 0 <= k -> k < Rabs V ->
  0 < V * ((env 0%nat - env 4%nat) * (env 3%nat - env 5%nat) - (env 1%nat - env 5%nat) * (env 2%nat - env 4%nat)).
Proof.
  intros P1 P2 Q1 Q2 Hl Hr HV Ht Hk k0 L. assert (U := u_positive). assert (U1 : u <= / 2) by (rewrite u_value; lra).
  assert (El := product_of_differences _ _ _ _ _ P1 P2 Hl).
  assert (Er := product_of_differences _ _ _ _ _ Q1 Q2 Hr).
  set (X := (env 0%nat - env 4%nat) * (env 3%nat - env 5%nat)) in *.
  set (Y := (env 1%nat - env 5%nat) * (env 2%nat - env 4%nat)) in *.
  assert (M := side_of_line_margin). set (K := factor (part_1 plane_line_0_right)) in *.
  assert (K0 : 0 <= K) by (apply constant_positive; lia).
  set (g := u * (3 + 3 * u + u * u)) in *. set (n := Rabs l + Rabs r) in *.
  assert (A := Rabs_pos l). assert (B := Rabs_pos r). assert (n0 : 0 <= n) by (unfold n; lra).
  destruct Ht as [Ht _]. destruct Hk as [Hk _]. destruct HV as [_ HV].
  assert (t0 : 0 <= t).
  { destruct (Rle_dec 0 t); [assumption |]. rewrite (Rabs_left t) in Ht by lra. apply Rabs_le_inv in Ht. nra. }
  rewrite (Rabs_pos_eq t) in Ht by assumption. rewrite (Rabs_pos_eq k) in Hk by assumption.
  apply Rabs_le_inv in Ht, Hk.
  assert (Sum : n <= (1 + u) * t) by lra. assert (Bound : K * t <= (1 + u) * k) by lra.
  assert (Value : Rabs V <= (1 + u) * Rabs (l - r)).
  { replace V with ((V - (l - r)) + (l - r)) by ring. eapply Rle_trans; [apply Rabs_triang |]. lra. }
  assert (Dp := Rabs_pos (l - r)).
  assert (Chain : K * n < (1 + u) * (1 + u) * (1 + u) * Rabs (l - r)).
  { assert (K * n <= K * ((1 + u) * t)) by (apply Rmult_le_compat_l; assumption).
    assert ((1 + u) * (K * t) <= (1 + u) * ((1 + u) * k)) by (apply Rmult_le_compat_l; lra).
    assert ((1 + u) * (1 + u) * k < (1 + u) * (1 + u) * Rabs V) by (apply Rmult_lt_compat_l; [nra | assumption]).
    assert ((1 + u) * (1 + u) * Rabs V <= (1 + u) * (1 + u) * ((1 + u) * Rabs (l - r)))
      by (apply Rmult_le_compat_l; [nra | assumption]). lra. }
  assert (C0 : 0 < (1 + u) * (1 + u) * (1 + u)) by (repeat apply Rmult_lt_0_compat; lra).
  assert (Beyond : g * n < Rabs (l - r)).
  { apply Rmult_lt_reg_l with ((1 + u) * (1 + u) * (1 + u)); [assumption |].
    assert (N := Rmult_le_compat_r n _ _ n0 M). lra. }
  assert (Sign : 0 < (l - r) * (X - Y)).
  { apply right_sign with (g * n); [| assumption].
    apply Rabs_le_inv in El, Er. apply Rabs_le. unfold n. split; lra. }
  assert (Same : 0 < (l - r) * V).
  { assert (D : 0 < Rabs (l - r)).
    { eapply Rle_lt_trans; [| exact Beyond]. apply Rmult_le_pos; [unfold g; nra | assumption]. }
    apply right_sign with (u * Rabs (l - r)); [| nra].
    replace (l - r - V) with (- (V - (l - r))) by ring. rewrite Rabs_Ropp. assumption. }
  assert (0 < (l - r) * (X - Y) * ((l - r) * V)) by (apply Rmult_lt_0_compat; assumption).
  assert (0 < (l - r) * (l - r)) by nra. nra.
Qed.
