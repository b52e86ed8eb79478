(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* What the roundings of a formula come to: a formula is a tree of operations as the program extract.cpp
   writes it. Its value in floating point differs from its exact value by at most gamma(k) times its
   size, where the size is its value with all terms positive (differences of what is given are one term), and k counts the roundings that a
   product of its expansion goes through. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core Relative Plus_error.
Open Scope R_scope.

Inductive term : Set :=
| Given (n : nat)
| Constant (m e : Z)  (* m 2^e *)
| Opposite (a : term)
| Absolute (a : term)
| Scaled (a : term) (e : Z)  (* a 2^e *)
| Largest (a b : term)
| Least (a b : term)
| Plus (a b : term)
| Minus (a b : term)
| Times (a b : term).

Definition constant (m e : Z) : R := IZR m * bpow radix2 e.

Fixpoint exact (env : nat -> R) (t : term) : R :=
  match t with
  | Given n => env n
  | Constant m e => constant m e
  | Opposite a => - exact env a
  | Absolute a => Rabs (exact env a)
  | Scaled a e => exact env a * bpow radix2 e
  | Largest a b => Rmax (exact env a) (exact env b)
  | Least a b => Rmin (exact env a) (exact env b)
  | Plus a b => exact env a + exact env b
  | Minus a b => exact env a - exact env b
  | Times a b => exact env a * exact env b
  end.

(* Numbers that are given are exact, and so is the size of the sum of two, whatever cancels. *)
Definition is_exact (t : term) : bool :=
  match t with Given _ | Constant _ _ => true | _ => false end.

Fixpoint size (env : nat -> R) (t : term) : R :=
  match t with
  | Given n => Rabs (env n)
  | Constant m e => Rabs (constant m e)
  | Opposite a => size env a
  | Absolute a => size env a
  | Scaled a e => size env a * bpow radix2 e
  | Largest a b | Least a b => Rmax (size env a) (size env b)
  | Plus a b =>
      if andb (is_exact a) (is_exact b) then Rabs (exact env a + exact env b)
      else size env a + size env b
  | Minus a b =>
      if andb (is_exact a) (is_exact b) then Rabs (exact env a - exact env b)
      else size env a + size env b
  | Times a b => size env a * size env b
  end.

(* A sum counts s roundings, a product p: 1 each for a processor's numbers, more for pairs of them. *)
Fixpoint count (s p : nat) (t : term) : nat :=
  match t with
  | Given _ | Constant _ _ => 0
  | Opposite a | Absolute a | Scaled a _ => count s p a
  | Largest a b | Least a b => Nat.max (count s p a) (count s p b)
  | Plus a b | Minus a b => Nat.max (count s p a) (count s p b) + s
  | Times a b => count s p a + count s p b + p
  end.

Definition gamma (unit : R) (k : nat) : R := (1 + unit) ^ k - 1.

(* z is what some arithmetic may compute for t, if no operation errs by more than it may. *)
Inductive computes (unit : R) (s p : nat) (env : nat -> R) : term -> R -> Prop :=
| computes_given n : computes unit s p env (Given n) (env n)
| computes_constant m e : computes unit s p env (Constant m e) (constant m e)
| computes_opposite a x : computes unit s p env a x -> computes unit s p env (Opposite a) (- x)
| computes_absolute a x : computes unit s p env a x -> computes unit s p env (Absolute a) (Rabs x)
| computes_scaled a e x :
    computes unit s p env a x -> computes unit s p env (Scaled a e) (x * bpow radix2 e)
| computes_largest a b x y :
    computes unit s p env a x -> computes unit s p env b y ->
    computes unit s p env (Largest a b) (Rmax x y)
| computes_least a b x y :
    computes unit s p env a x -> computes unit s p env b y ->
    computes unit s p env (Least a b) (Rmin x y)
| computes_plus a b x y z :
    computes unit s p env a x -> computes unit s p env b y ->
    Rabs (z - (x + y)) <= gamma unit s * Rabs (x + y) -> computes unit s p env (Plus a b) z
| computes_minus a b x y z :
    computes unit s p env a x -> computes unit s p env b y ->
    Rabs (z - (x - y)) <= gamma unit s * Rabs (x - y) -> computes unit s p env (Minus a b) z
| computes_times a b x y z :
    computes unit s p env a x -> computes unit s p env b y ->
    Rabs (z - x * y) <= gamma unit p * Rabs (x * y) -> computes unit s p env (Times a b) z.

Lemma operands_of_minus unit s p env a b z :
  computes unit s p env (Minus a b) z ->
  exists x y, computes unit s p env a x /\ computes unit s p env b y /\
    Rabs (z - (x - y)) <= gamma unit s * Rabs (x - y).
Proof. inversion 1; subst; eauto. Qed.

Section Errors.
Variable unit : R.
Hypothesis unit_positive : 0 <= unit.

Lemma gamma_positive k : 0 <= gamma unit k.
Proof. unfold gamma. assert (1 <= (1 + unit) ^ k) by (apply pow_R1_Rle; lra). lra. Qed.

Lemma gamma_monotone k n : (k <= n)%nat -> gamma unit k <= gamma unit n.
Proof. intros. unfold gamma. assert ((1 + unit) ^ k <= (1 + unit) ^ n) by (apply Rle_pow; [lra|lia]). lra. Qed.

Lemma gamma_plus k n : 1 + gamma unit (k + n) = (1 + gamma unit k) * (1 + gamma unit n).
Proof. unfold gamma. replace (1 + ((1 + unit) ^ (k + n) - 1)) with ((1 + unit) ^ (k + n)) by ring. rewrite pow_add. ring. Qed.

(* gamma(k) is k units and what is far less. *)
Lemma gamma_bound k : INR k * unit <= / 2 -> gamma unit k <= INR k * unit + (INR k * unit) ^ 2.
Proof.
  unfold gamma. induction k as [|k IH]; intros H.
  - simpl. lra.
  - rewrite S_INR in *. assert (0 <= INR k) by apply pos_INR.
    assert (INR k * unit <= / 2) by nra. specialize (IH H1). rewrite <- tech_pow_Rmult.
    set (a := INR k * unit) in *. assert (0 <= a) by (unfold a; nra).
    replace ((INR k + 1) * unit) with (a + unit) by (unfold a; ring).
    assert ((1 + unit) * (1 + unit) ^ k <= (1 + unit) * (1 + a + a ^ 2))
      by (apply Rmult_le_compat_l; lra).
    assert (a ^ 2 <= a) by (simpl; nra).
    assert (a ^ 2 * unit <= a * unit) by (apply Rmult_le_compat_r; assumption).
    assert (0 <= unit * unit) by nra.
    replace ((a + unit) ^ 2) with (a ^ 2 + 2 * (a * unit) + unit * unit) by ring. lra.
Qed.

Lemma size_positive env t : 0 <= size env t.
Proof.
  induction t; simpl; try apply Rabs_pos; try assumption; try lra;
    try (eapply Rle_trans; [| apply Rmax_l]; assumption);
    try (destruct (is_exact t1), (is_exact t2); simpl; try apply Rabs_pos; lra).
  - apply Rmult_le_pos; [assumption | apply bpow_ge_0].
  - apply Rmult_le_pos; assumption.
Qed.

Lemma Rabs_of_largest x y sx sy : Rabs x <= sx -> Rabs y <= sy -> Rabs (Rmax x y) <= Rmax sx sy.
Proof.
  intros. assert (sx <= Rmax sx sy) by apply Rmax_l. assert (sy <= Rmax sx sy) by apply Rmax_r.
  unfold Rmax at 1. destruct (Rle_dec x y); lra.
Qed.

Lemma Rmin_Rmax_opposite x y : Rmin x y = - Rmax (- x) (- y).
Proof. unfold Rmin, Rmax. destruct (Rle_dec x y), (Rle_dec (- x) (- y)); lra. Qed.

Lemma error_of_largest x y ex ey sx sy k n :
  0 <= sx -> 0 <= sy -> Rabs (x - ex) <= gamma unit k * sx -> Rabs (y - ey) <= gamma unit n * sy ->
  Rabs (Rmax x y - Rmax ex ey) <= gamma unit (Nat.max k n) * Rmax sx sy.
Proof.
  intros. set (m := Nat.max k n). set (s := Rmax sx sy).
  assert (sx <= s) by apply Rmax_l. assert (sy <= s) by apply Rmax_r.
  assert (gamma unit k <= gamma unit m) by (apply gamma_monotone; unfold m; lia).
  assert (gamma unit n <= gamma unit m) by (apply gamma_monotone; unfold m; lia).
  assert (Gk := gamma_positive k). assert (Gn := gamma_positive n).
  assert (Ex : Rabs (x - ex) <= gamma unit m * s) by nra.
  assert (Ey : Rabs (y - ey) <= gamma unit m * s) by nra.
  set (e := gamma unit m * s) in *. apply Rabs_le.
  apply Rabs_le_inv in Ex, Ey.
  unfold Rmax. destruct (Rle_dec x y), (Rle_dec ex ey); lra.
Qed.

Lemma exact_below_size env t : Rabs (exact env t) <= size env t.
Proof.
  induction t; simpl; try apply Rle_refl; try (rewrite ?Rabs_Ropp, ?Rabs_Rabsolu; assumption).
  - rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 e)) by apply bpow_ge_0.
    apply Rmult_le_compat_r; [apply bpow_ge_0 | assumption].
  - apply Rabs_of_largest; assumption.
  - rewrite Rmin_Rmax_opposite, Rabs_Ropp. apply Rabs_of_largest; rewrite Rabs_Ropp; assumption.
  - destruct (is_exact t1 && is_exact t2)%bool; [apply Rle_refl |].
    eapply Rle_trans; [apply Rabs_triang | lra].
  - destruct (is_exact t1 && is_exact t2)%bool; [apply Rle_refl |].
    unfold Rminus. eapply Rle_trans; [apply Rabs_triang | rewrite Rabs_Ropp; lra].
  - rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; assumption.
Qed.

Lemma error_of_sum x y z ex ey sx sy k n s :
  Rabs ex <= sx -> Rabs ey <= sy -> Rabs (x - ex) <= gamma unit k * sx ->
  Rabs (y - ey) <= gamma unit n * sy -> Rabs (z - (x + y)) <= gamma unit s * Rabs (x + y) ->
  Rabs (z - (ex + ey)) <= gamma unit (Nat.max k n + s) * (sx + sy).
Proof.
  intros Hx Hy Hex Hey Hz.
  assert (0 <= sx) by (eapply Rle_trans; [apply Rabs_pos | eassumption]).
  assert (0 <= sy) by (eapply Rle_trans; [apply Rabs_pos | eassumption]).
  set (m := Nat.max k n).
  assert (Gk : gamma unit k <= gamma unit m) by (apply gamma_monotone; unfold m; lia).
  assert (Gn : gamma unit n <= gamma unit m) by (apply gamma_monotone; unfold m; lia).
  assert (Gm := gamma_positive m). assert (Gs := gamma_positive s).
  assert (Ex : Rabs (x - ex) <= gamma unit m * sx) by nra.
  assert (Ey : Rabs (y - ey) <= gamma unit m * sy) by nra.
  assert (Exy : Rabs ((x + y) - (ex + ey)) <= gamma unit m * (sx + sy)).
  { replace (x + y - (ex + ey)) with ((x - ex) + (y - ey)) by ring.
    eapply Rle_trans; [apply Rabs_triang | lra]. }
  assert (Sxy : Rabs (x + y) <= (1 + gamma unit m) * (sx + sy)).
  { replace (x + y) with (((x + y) - (ex + ey)) + (ex + ey)) by ring.
    eapply Rle_trans; [apply Rabs_triang |].
    assert (Rabs (ex + ey) <= sx + sy) by (eapply Rle_trans; [apply Rabs_triang | lra]). lra. }
  replace (z - (ex + ey)) with ((z - (x + y)) + ((x + y) - (ex + ey))) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  assert (G := gamma_plus m s).
  assert (gamma unit s * Rabs (x + y) <= gamma unit s * ((1 + gamma unit m) * (sx + sy)))
    by (apply Rmult_le_compat_l; assumption).
  replace (gamma unit (m + s)) with ((1 + gamma unit m) * (1 + gamma unit s) - 1) by lra. nra.
Qed.

Lemma error_of_product x y z ex ey sx sy k n p :
  Rabs ex <= sx -> Rabs ey <= sy -> Rabs (x - ex) <= gamma unit k * sx ->
  Rabs (y - ey) <= gamma unit n * sy -> Rabs (z - x * y) <= gamma unit p * Rabs (x * y) ->
  Rabs (z - ex * ey) <= gamma unit (k + n + p) * (sx * sy).
Proof.
  intros Hx Hy Hex Hey Hz.
  assert (0 <= sx) by (eapply Rle_trans; [apply Rabs_pos | eassumption]).
  assert (0 <= sy) by (eapply Rle_trans; [apply Rabs_pos | eassumption]).
  assert (Gk := gamma_positive k). assert (Gn := gamma_positive n). assert (Gp := gamma_positive p).
  assert (G := gamma_plus k n). assert (G' := gamma_plus (k + n) p).
  assert (Sy : Rabs y <= (1 + gamma unit n) * sy).
  { replace y with ((y - ey) + ey) by ring. eapply Rle_trans; [apply Rabs_triang | lra]. }
  assert (E : Rabs (x * y - ex * ey) <= gamma unit (k + n) * (sx * sy)).
  { replace (x * y - ex * ey) with ((x - ex) * y + ex * (y - ey)) by ring.
    eapply Rle_trans; [apply Rabs_triang |]. rewrite !Rabs_mult.
    assert (Rabs (x - ex) * Rabs y <= gamma unit k * sx * ((1 + gamma unit n) * sy))
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    assert (Rabs ex * Rabs (y - ey) <= sx * (gamma unit n * sy))
      by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    replace (gamma unit (k + n)) with ((1 + gamma unit k) * (1 + gamma unit n) - 1) by lra. nra. }
  assert (S : Rabs (x * y) <= (1 + gamma unit (k + n)) * (sx * sy)).
  { replace (x * y) with ((x * y - ex * ey) + ex * ey) by ring.
    eapply Rle_trans; [apply Rabs_triang |].
    assert (Rabs (ex * ey) <= sx * sy)
      by (rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; assumption). lra. }
  replace (z - ex * ey) with ((z - x * y) + (x * y - ex * ey)) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  assert (gamma unit p * Rabs (x * y) <= gamma unit p * ((1 + gamma unit (k + n)) * (sx * sy)))
    by (apply Rmult_le_compat_l; assumption).
  replace (gamma unit (k + n + p)) with ((1 + gamma unit (k + n)) * (1 + gamma unit p) - 1) by lra.
  nra.
Qed.

Lemma exact_computes s p env t z : is_exact t = true -> computes unit s p env t z -> z = exact env t.
Proof. intros E H. destruct t; try discriminate; inversion H; reflexivity. Qed.

Lemma count_of_exact s p t : is_exact t = true -> count s p t = 0%nat.
Proof. destruct t; simpl; easy. Qed.

Theorem error_of_formula s p env t z :
  computes unit s p env t z -> Rabs (z - exact env t) <= gamma unit (count s p t) * size env t.
Proof.
  induction 1; simpl.
  - replace (env n - env n) with 0 by ring. rewrite Rabs_R0. unfold gamma; simpl. lra.
  - replace (constant m e - constant m e) with 0 by ring. rewrite Rabs_R0. unfold gamma; simpl. lra.
  - replace (- x - - exact env a) with (- (x - exact env a)) by ring. rewrite Rabs_Ropp. assumption.
  - eapply Rle_trans; [apply Rabs_triang_inv2 | assumption].
  - replace (x * bpow radix2 e - exact env a * bpow radix2 e) with ((x - exact env a) * bpow radix2 e) by ring.
    rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 e)) by apply bpow_ge_0. rewrite <- Rmult_assoc.
    apply Rmult_le_compat_r; [apply bpow_ge_0 | assumption].
  - apply error_of_largest; auto using size_positive.
  - rewrite !Rmin_Rmax_opposite. replace (- Rmax (- x) (- y) - - Rmax (- exact env a) (- exact env b))
      with (- (Rmax (- x) (- y) - Rmax (- exact env a) (- exact env b))) by ring.
    rewrite Rabs_Ropp. apply error_of_largest; auto using size_positive.
    + replace (- x - - exact env a) with (- (x - exact env a)) by ring. rewrite Rabs_Ropp. assumption.
    + replace (- y - - exact env b) with (- (y - exact env b)) by ring. rewrite Rabs_Ropp. assumption.
  - destruct (is_exact a) eqn:A, (is_exact b) eqn:B; simpl;
      try (eapply error_of_sum; eauto using exact_below_size).
    rewrite <- (exact_computes s p env a x A), <- (exact_computes s p env b y B) by assumption.
    rewrite (count_of_exact s p a A), (count_of_exact s p b B). assumption.
  - destruct (is_exact a && is_exact b)%bool eqn:AB.
    { apply Bool.andb_true_iff in AB. destruct AB as [A B].
      rewrite <- (exact_computes s p env a x A), <- (exact_computes s p env b y B) by assumption.
      rewrite (count_of_exact s p a A), (count_of_exact s p b B). assumption. }
    unfold Rminus. eapply error_of_sum with (x := x) (y := - y).
    + apply exact_below_size.
    + rewrite Rabs_Ropp. apply exact_below_size.
    + eassumption.
    + replace (- y - - exact env b) with (- (y - exact env b)) by ring. rewrite Rabs_Ropp. eassumption.
    + assumption.
  - eapply error_of_product; eauto using exact_below_size.
Qed.
End Errors.

(* Doubles: 53 bits, the smallest one 2^-1074, subnormal numbers included. *)
Definition u : R := bpow radix2 (-53).
Definition is_double : R -> Prop := generic_format radix2 (FLT_exp (-1074) 53).
Definition rounded : R -> R := round radix2 (FLT_exp (-1074) 53) ZnearestE.
(* Neither product underflows: it is zero, or as large as the smallest normal number. *)
Definition is_normal (x : R) : Prop := x = 0 \/ bpow radix2 (-1022) <= Rabs x.

Lemma u_value : u = / 9007199254740992.
Proof. reflexivity. Qed.
Lemma u_positive : 0 <= u.
Proof. apply bpow_ge_0. Qed.

#[local] Instance precision_is_positive : Prec_gt_0 53.
Proof. reflexivity. Qed.

Lemma half_ulp_of_one : / 2 * bpow radix2 (- (53) + 1) = u.
Proof. unfold u. simpl. lra. Qed.

Lemma gamma_one unit : gamma unit 1 = unit.
Proof. unfold gamma. ring. Qed.

Lemma rounded_normal x : is_normal x -> Rabs (rounded x - x) <= u * Rabs x.
Proof.
  intros [-> | H]; unfold rounded.
  - rewrite round_0 by apply valid_rnd_N. rewrite Rminus_0_r, Rabs_R0. lra.
  - assert (E := relative_error_N_FLT radix2 (-1074) 53 eq_refl (fun z => negb (Z.even z)) x H).
    eapply Rle_trans; [exact E |]. apply Req_le. rewrite half_ulp_of_one. reflexivity.
Qed.

Lemma rounded_sum x y : is_double x -> is_double y -> Rabs (rounded (x + y) - (x + y)) <= u * Rabs (x + y).
Proof.
  intros Hx Hy.
  destruct (FLT_plus_error_N_ex radix2 (-1074) 53 (fun z => negb (Z.even z)) x y Hx Hy) as [e [He E]].
  unfold rounded. rewrite E. replace ((x + y) * (1 + e) - (x + y)) with (e * (x + y)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos |].
  eapply Rle_trans; [exact He |]. unfold u_ro.
  change (-53 + 1)%Z with (- (53) + 1)%Z. rewrite half_ulp_of_one.
  assert (P := u_positive). apply Rmult_le_reg_r with (1 + u); [lra |].
  unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra.
Qed.

(* Without contraction, as everything is compiled: each operation is rounded. *)
Fixpoint floats (env : nat -> R) (t : term) : R :=
  match t with
  | Given n => env n
  | Constant m e => constant m e
  | Opposite a => - floats env a
  | Absolute a => Rabs (floats env a)
  | Scaled a e => rounded (floats env a * bpow radix2 e)
  | Largest a b => Rmax (floats env a) (floats env b)
  | Least a b => Rmin (floats env a) (floats env b)
  | Plus a b => rounded (floats env a + floats env b)
  | Minus a b => rounded (floats env a - floats env b)
  | Times a b => rounded (floats env a * floats env b)
  end.

(* No product underflows, and no product with a power of two loses a digit. *)
Fixpoint has_normal_products (env : nat -> R) (t : term) : Prop :=
  match t with
  | Given _ | Constant _ _ => True
  | Opposite a | Absolute a => has_normal_products env a
  | Scaled a e =>
      has_normal_products env a /\
      rounded (floats env a * bpow radix2 e) = floats env a * bpow radix2 e
  | Largest a b | Least a b | Plus a b | Minus a b =>
      has_normal_products env a /\ has_normal_products env b
  | Times a b =>
      has_normal_products env a /\ has_normal_products env b /\
      is_normal (floats env a * floats env b)
  end.

Fixpoint has_double_constants (t : term) : Prop :=
  match t with
  | Given _ => True
  | Constant m e => is_double (constant m e)
  | Opposite a | Absolute a | Scaled a _ => has_double_constants a
  | Largest a b | Least a b | Plus a b | Minus a b | Times a b =>
      has_double_constants a /\ has_double_constants b
  end.

Lemma floats_are_doubles env t :
  (forall n, is_double (env n)) -> has_double_constants t -> is_double (floats env t).
Proof.
  intros D. induction t; simpl; intros C; try (apply generic_format_round; apply FLT_exp_valid || apply valid_rnd_N; easy).
  - apply D.
  - exact C.
  - apply generic_format_opp, IHt, C.
  - apply generic_format_abs, IHt, C.
  - destruct C. unfold Rmax. destruct (Rle_dec _ _); auto.
  - destruct C. unfold Rmin. destruct (Rle_dec _ _); auto.
Qed.

Theorem floats_compute env t :
  (forall n, is_double (env n)) -> has_double_constants t -> has_normal_products env t ->
  computes u 1 1 env t (floats env t).
Proof.
  intros D. induction t; simpl; intros C N.
  - apply computes_given.
  - apply computes_constant.
  - apply computes_opposite; auto.
  - apply computes_absolute; auto.
  - destruct N as [? ->]. apply computes_scaled; auto.
  - destruct C, N. apply computes_largest; auto.
  - destruct C, N. apply computes_least; auto.
  - destruct C, N. eapply computes_plus; eauto. rewrite gamma_one.
    apply rounded_sum; apply floats_are_doubles; assumption.
  - destruct C, N. eapply computes_minus; eauto. rewrite gamma_one. unfold Rminus at 2 4.
    apply rounded_sum; [| apply generic_format_opp]; apply floats_are_doubles; assumption.
  - destruct C as [? ?], N as [? [? ?]]. eapply computes_times; eauto. rewrite gamma_one.
    apply rounded_normal; assumption.
Qed.

(* With contraction: a product may enter a sum unrounded, in any choice of products; the sum is then
   rounded once. *)
Inductive contracted (env : nat -> R) : term -> R -> Prop :=
| contracted_given n : contracted env (Given n) (env n)
| contracted_constant m e : contracted env (Constant m e) (constant m e)
| contracted_opposite a x : contracted env a x -> contracted env (Opposite a) (- x)
| contracted_absolute a x : contracted env a x -> contracted env (Absolute a) (Rabs x)
| contracted_scaled a e x : contracted env a x -> contracted env (Scaled a e) (x * bpow radix2 e)
| contracted_largest a b x y :
    contracted env a x -> contracted env b y -> contracted env (Largest a b) (Rmax x y)
| contracted_least a b x y :
    contracted env a x -> contracted env b y -> contracted env (Least a b) (Rmin x y)
| contracted_plus a b x y :
    contracted env a x -> contracted env b y ->
    is_normal (x + y) \/ (is_double x /\ is_double y) -> contracted env (Plus a b) (rounded (x + y))
| contracted_minus a b x y :
    contracted env a x -> contracted env b y ->
    is_normal (x - y) \/ (is_double x /\ is_double y) -> contracted env (Minus a b) (rounded (x - y))
| contracted_times a b x y :
    contracted env a x -> contracted env b y -> is_normal (x * y) ->
    contracted env (Times a b) (rounded (x * y))
| contracted_fused a b x y :
    contracted env a x -> contracted env b y -> contracted env (Times a b) (x * y).

Theorem contracted_computes env t z : contracted env t z -> computes u 1 1 env t z.
Proof.
  induction 1.
  - apply computes_given.
  - apply computes_constant.
  - apply computes_opposite; auto.
  - apply computes_absolute; auto.
  - apply computes_scaled; auto.
  - apply computes_largest; auto.
  - apply computes_least; auto.
  - eapply computes_plus; eauto. rewrite gamma_one.
    destruct H1 as [? | [? ?]]; [apply rounded_normal | apply rounded_sum]; assumption.
  - eapply computes_minus; eauto. rewrite gamma_one.
    destruct H1 as [? | [? ?]]; [apply rounded_normal; assumption |]. unfold Rminus at 2 4.
    apply rounded_sum; [| apply generic_format_opp]; assumption.
  - eapply computes_times; eauto. rewrite gamma_one. apply rounded_normal; assumption.
  - eapply computes_times; eauto. rewrite gamma_one, Rminus_eq_0, Rabs_R0.
    apply Rmult_le_pos; [apply u_positive | apply Rabs_pos].
Qed.
