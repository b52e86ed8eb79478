(* SPDX-FileCopyrightText: The Rondel authors *)
(* SPDX-License-Identifier: Apache-2.0 *)

(* Filters whose bound is relative to a sum of sizes: of the products of the value, or of the coordinates
   of a step. *)
From Coq Require Import Reals Psatz ZArith.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
From Rondel Require Import rounding geometry acceptance formulas.
From Rondel Require certificate_power certificate_turn certificate_ray_order certificate_line certificate_edge
  certificate_side certificate_near_end certificate_change_at_end.
Open Scope R_scope.

(* The value exceeds K times a number that its size is at most B times as large as. *)
Lemma sum_filter env value right V r B margin :
  computes u 1 1 env value V -> computes u 1 1 env right r -> size env right = exact env right ->
  0 <= exact env right -> size env value * gamma u (count 1 1 value) <= B -> 0 <= margin ->
  B + margin <= exact env right * (1 - gamma u (count 1 1 right)) ->
  r < Rabs V -> 0 < V * exact env value /\ margin < Rabs (exact env value).
Proof.
  intros HV Hr S P HB M0 M L.
  assert (R0 := least_value u 1 1 env right r u_positive Hr S).
  assert (E := error_of_formula u u_positive 1 1 env value V HV). split.
  - apply right_sign with B; [lra |]. lra.
  - assert (T := Rabs_triang_inv V (V - exact env value)).
    replace (V - (V - exact env value)) with (exact env value) in T by ring. lra.
Qed.

(* --- the sum of the sizes of the products --- *)

Lemma power_margin E G :
  0 <= E <= most u (count 1 1 power_2_left) -> 0 <= G <= most u (count 1 1 power_1_right) ->
  E <= factor power_1_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_power.l1 E G).
  unfold certificate_power.s1, certificate_power.s2, certificate_power.s3, not. certify.
Qed.

Lemma turn_margin E G :
  0 <= E <= most u (count 1 1 turn_2_left) -> 0 <= G <= most u (count 1 1 turn_1_right) ->
  E <= factor turn_1_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_turn.l1 E G).
  unfold certificate_turn.s1, certificate_turn.s2, certificate_turn.s3, not. certify.
Qed.

Lemma ray_order_margin E G :
  0 <= E <= most u (count 1 1 ray_order_4_left) -> 0 <= G <= most u (count 1 1 ray_order_3_right) ->
  E <= factor ray_order_3_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_ray_order.l1 E G).
  unfold certificate_ray_order.s1, certificate_ray_order.s2, certificate_ray_order.s3, not. certify.
Qed.

Ltac products := lay_open; rewrite ?Rabs_mult, ?Rabs_Rabsolu; sizes.

Lemma products_filter env value right V r :
  computes u 1 1 env value V -> computes u 1 1 env right r -> size env right = exact env right ->
  exact env right = factor right * size env value ->
  gamma u (count 1 1 value) <= factor right * (1 - gamma u (count 1 1 right)) -> 0 <= factor right ->
  r < Rabs V -> 0 < V * exact env value.
Proof.
  intros HV Hr S Right M F L. assert (P := size_positive env value).
  apply sum_filter with (right := right) (r := r) (B := size env value * gamma u (count 1 1 value)) (margin := 0);
    try assumption; try lra.
  - rewrite Right. apply Rmult_le_pos; assumption.
  - rewrite Right. assert (Q := Rmult_le_compat_l _ _ _ P M). lra.
Qed.

(* compare_power_filter: (p - o).(a - b). *)
Theorem power_filter env V r :
  computes u 1 1 env power_2_left V -> computes u 1 1 env power_1_right r -> r < Rabs V ->
  0 < V * dot (difference (triple env 6) (triple env 9)) (difference (triple env 0) (triple env 3)).
Proof.
  intros. replace (dot _ _) with (exact env power_2_left) by (lay_open; ring).
  apply products_filter with (right := power_1_right) (r := r); try assumption;
    [products | products | apply power_margin; ranges | apply constant_positive; lia].
Qed.

(* The filter of turn: (p - o) x (q - o) in a plane. *)
Theorem turn_filter env V r :
  computes u 1 1 env turn_2_left V -> computes u 1 1 env turn_1_right r -> r < Rabs V ->
  0 < V * ((env 2%nat - env 0%nat) * (env 5%nat - env 1%nat) - (env 3%nat - env 1%nat) * (env 4%nat - env 0%nat)).
Proof.
  intros. replace (_ - _) with (exact env turn_2_left) by (lay_open; ring).
  apply products_filter with (right := turn_1_right) (r := r); try assumption;
    [products | products | apply turn_margin; ranges | apply constant_positive; lia].
Qed.

(* compare_slopes_filter, which compare_rays asks. *)
Theorem ray_order_filter env V r :
  computes u 1 1 env ray_order_4_left V -> computes u 1 1 env ray_order_3_right r -> r < Rabs V ->
  0 < V * ((env 1%nat - env 7%nat) * (env 3%nat - env 6%nat) - (env 4%nat - env 7%nat) * (env 0%nat - env 6%nat)).
Proof.
  intros. replace (_ - _) with (exact env ray_order_4_left) by (lay_open; ring).
  apply products_filter with (right := ray_order_3_right) (r := r); try assumption;
    [products | products | apply ray_order_margin; ranges | apply constant_positive; lia].
Qed.

(* --- the sum of the sizes of the coordinates of a step --- *)

Definition sum_of_sizes a := Rabs (x a) + Rabs (y a) + Rabs (z a).

Lemma line_margin E G A B :
  0 <= E <= most u (count 1 1 line_2_left) -> 0 <= G <= most u (count 1 1 line_1_right) ->
  0 <= A <= 2049 / 2048 -> 0 <= B <= 2049 / 2048 ->
  11548 / 10000 * E * (A * B) <= factor line_1_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_line.l1 E G A B).
  unfold certificate_line.s1, certificate_line.s2, certificate_line.s3, certificate_line.s4,
    certificate_line.s5, not. certify.
Qed.

Lemma edge_margin E G A B :
  0 <= E <= most u (count 1 1 edge_2_left) -> 0 <= G <= most u (count 1 1 edge_1_right) ->
  0 <= A <= 2049 / 2048 -> 0 <= B <= 2049 / 1024 ->
  11548 / 10000 * E * (A * B) <= factor edge_1_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_edge.l1 E G A B).
  unfold certificate_edge.s1, certificate_edge.s2, certificate_edge.s3, certificate_edge.s4,
    certificate_edge.s5, not. certify.
Qed.

Lemma side_margin E G A B :
  0 <= E <= most u (count 1 1 side_1_left) -> 0 <= G <= most u (count 1 1 side_1_right) ->
  0 <= A <= 2049 / 2048 -> 0 <= B <= 2049 / 1024 ->
  11548 / 10000 * E * (A * B) + 2 * factor arrangement_radius <= factor side_1_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_side.l1 E G A B).
  unfold certificate_side.s1, certificate_side.s2, certificate_side.s3, certificate_side.s4,
    certificate_side.s5, not. unfold factor, arrangement_radius in *. certify.
Qed.

(* A determinant of two vectors and the step s, times the sizes of these. *)
Section Steps.
Variable env : nat -> R.
Variables value right : term.
Variables a s b : vector.
Variables A B margin : R.
Hypothesis a_length : length a <= A.
Hypothesis b_length : length b <= B.
Hypothesis size_is : size env value = permanent a s b.
Hypothesis right_is : exact env right = factor right * sum_of_sizes s.
Hypothesis right_size : size env right = exact env right.
Hypothesis factor_positive : 0 <= factor right.
Hypothesis margin_positive : 0 <= margin.
Hypothesis enough :
  11548 / 10000 * gamma u (count 1 1 value) * (A * B) + margin <=
  factor right * (1 - gamma u (count 1 1 right)).

Lemma step_filter V r :
  computes u 1 1 env value V -> computes u 1 1 env right r -> r < Rabs V ->
  0 < V * exact env value /\ margin * length s < Rabs (exact env value).
Proof.
  intros HV Hr L.
  assert (La := length_positive a). assert (Lb := length_positive b). assert (Ls := length_positive s).
  assert (S := length_below_sum s). fold (sum_of_sizes s) in S.
  assert (E0 : 0 <= gamma u (count 1 1 value)) by (apply gamma_positive, u_positive).
  assert (P := permanent_bound a s b).
  assert (AB : length a * length b <= A * B) by (apply Rmult_le_compat; assumption).
  assert (AB0 : 0 <= length a * length b) by (apply Rmult_le_pos; assumption).
  apply sum_filter with (right := right) (r := r)
    (B := 11548 / 10000 * gamma u (count 1 1 value) * (A * B) * length s); try assumption.
  - rewrite right_is. apply Rmult_le_pos; [assumption | lra].
  - rewrite size_is.
    replace (11548 / 10000 * gamma u (count 1 1 value) * (A * B) * length s)
      with (11548 / 10000 * (A * B) * length s * gamma u (count 1 1 value)) by ring.
    apply Rmult_le_compat_r; [assumption |]. eapply Rle_trans; [exact P |].
    replace (11548 / 10000 * (length a * length s * length b))
      with (11548 / 10000 * (length a * length b) * length s) by ring.
    apply Rmult_le_compat_r; lra.
  - apply Rmult_le_pos; assumption.
  - rewrite right_is.
    assert (M := Rmult_le_compat_r (length s) _ _ Ls enough).
    assert (M0 : 0 <= factor right * (1 - gamma u (count 1 1 right))).
    { eapply Rle_trans; [| exact enough].
      apply Rplus_le_le_0_compat; [| assumption]. repeat apply Rmult_le_pos; lra. }
    assert (M1 := Rmult_le_compat_l _ _ _ M0 S). lra.
Qed.
End Steps.

(* TracedLine::is_left: det(p, q, y), with p and y near the unit sphere. *)
Theorem line_filter env V r :
  let p := triple env 0 in
  let q := triple env 3 in
  let y0 := triple env 6 in
  length p <= 2049 / 2048 -> length y0 <= 2049 / 2048 ->
  computes u 1 1 env line_2_left V -> computes u 1 1 env line_1_right r -> r < Rabs V ->
  0 < V * det p q y0.
Proof.
  intros p q y0 Lp Ly HV Hr L.
  replace (det p q y0) with (exact env line_2_left) by (unfold p, q, y0; lay_open; ring).
  assert (Pp := length_positive p). assert (Py := length_positive y0).
  apply (step_filter env line_2_left line_1_right p (difference q p) y0 (2049 / 2048) (2049 / 2048) 0) with (r := r);
    try assumption; try lra.
  - unfold p, q, y0; sizes.
  - unfold sum_of_sizes, p, q; products.
  - products.
  - apply constant_positive; lia.
  - rewrite Rplus_0_r. apply line_margin; try lra; ranges.
Qed.

(* CoverEdge::is_left: det(y, z, p), with the difference of p from y. *)
Theorem edge_filter env V r :
  let y0 := triple env 0 in
  let z0 := triple env 3 in
  let p := triple env 6 in
  length y0 <= 2049 / 2048 -> length p <= 2049 / 2048 ->
  computes u 1 1 env edge_2_left V -> computes u 1 1 env edge_1_right r -> r < Rabs V ->
  0 < V * det y0 z0 p.
Proof.
  intros y0 z0 p Ly Lp HV Hr L.
  replace (det y0 z0 p) with (exact env edge_2_left) by (unfold p, y0, z0; lay_open; ring).
  assert (D : length (difference p y0) <= 2049 / 1024).
  { eapply Rle_trans; [apply length_of_difference |]. lra. }
  apply (step_filter env edge_2_left edge_1_right y0 (difference z0 y0) (difference p y0) (2049 / 2048)
           (2049 / 1024) 0) with (r := r); try assumption; try lra.
  - unfold p, y0, z0; sizes.
  - unfold sum_of_sizes, y0, z0; products.
  - products.
  - apply constant_positive; lia.
  - rewrite Rplus_0_r. apply edge_margin; try lra; ranges.
Qed.

(* SidedArc::side: what is not near has the right sign, and is more than twice the radius away, which
   covers a normal that is up to twice too short. *)
Theorem side_filter env V r :
  let a := triple env 0 in
  let b := triple env 3 in
  let p := triple env 6 in
  length a <= 2049 / 2048 -> length p <= 2049 / 2048 ->
  computes u 1 1 env side_1_left V -> computes u 1 1 env side_1_right r -> r < Rabs V ->
  0 < V * det a b p /\ 2 * factor arrangement_radius * length (difference b a) < Rabs (det a b p).
Proof.
  intros a b p La Lp HV Hr L.
  replace (det a b p) with (exact env side_1_left) by (unfold a, b, p; lay_open; ring).
  assert (D : length (difference p a) <= 2049 / 1024).
  { eapply Rle_trans; [apply length_of_difference |]. lra. }
  apply (step_filter env side_1_left side_1_right a (difference b a) (difference p a) (2049 / 2048)
           (2049 / 1024)) with (r := r); try assumption; try lra.
  - unfold a, b, p; sizes.
  - unfold sum_of_sizes, a, b; products.
  - products.
  - apply constant_positive; lia.
  - unfold factor, arrangement_radius, constant; simpl; lra.
  - apply side_margin; try lra; ranges.
Qed.

(* --- near an end: the product of the normal, as it was computed for the line, and a difference --- *)

Lemma near_end_margin E P G G2 A :
  0 <= E <= most u (count 1 1 (part_1 (part_1 (part_1 line_2_left)))) ->
  0 <= P <= most u (count 1 1 near_end_3_left) ->
  0 <= G <= most u (count 1 1 line_1_right) -> 0 <= G2 <= most u (count 1 1 near_end_2_right) ->
  0 <= A <= 2049 / 2048 ->
  A * (P * (1 + 11548 / 10000 * E) + 11548 / 10000 * E) <= factor line_1_right * (1 - G) * (1 - G2).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_near_end.l1 E P G G2 A).
  unfold certificate_near_end.s1, certificate_near_end.s2, certificate_near_end.s3, certificate_near_end.s4,
    certificate_near_end.s5, certificate_near_end.s6, not. certify.
Qed.

(* The components of the normal in the value of a line. *)
Definition normal_x := part_1 (part_1 (part_1 line_2_left)).
Definition normal_y := part_1 (part_2 (part_1 line_2_left)).
Definition normal_z := part_1 (part_2 line_2_left).

(* sign_by_nearer_end: det(a, q, p), with the difference of p from f, which is a or q. *)
Theorem near_end_filter line env V r :
  let a := triple line 0 in
  let q := triple line 3 in
  let f := triple env 4 in
  let p := triple env 10 in
  length a <= 2049 / 2048 -> (f = a \/ f = q) ->
  computes u 1 1 line normal_x (env 0%nat) -> computes u 1 1 line normal_y (env 1%nat) ->
  computes u 1 1 line normal_z (env 2%nat) -> computes u 1 1 line line_1_right (env 3%nat) ->
  computes u 1 1 env near_end_3_left V -> computes u 1 1 env near_end_2_right r -> r < Rabs V ->
  0 < V * det a q p.
Proof.
  intros a q f p La Hf Nx Ny Nz Limit HV Hr L. assert (U := u_positive).
  set (s := difference q a). set (d := difference p f). set (n := triple env 0).
  set (normal := cross a s).
  assert (Exact : det a q p = dot normal d).
  { unfold normal, s, d. destruct Hf as [-> | ->]; unfold det, dot, cross, difference; simpl; ring. }
  rewrite Exact.
  assert (HE : 0 <= gamma u (count 1 1 normal_x) <= most u (count 1 1 normal_x)) by ranges.
  assert (HP : 0 <= gamma u (count 1 1 near_end_3_left) <= most u (count 1 1 near_end_3_left)) by ranges.
  assert (HG : 0 <= gamma u (count 1 1 line_1_right) <= most u (count 1 1 line_1_right)) by ranges.
  assert (HG2 : 0 <= gamma u (count 1 1 near_end_2_right) <= most u (count 1 1 near_end_2_right)) by ranges.
  assert (Ex := error_of_formula u U 1 1 line _ _ Nx). assert (Ey := error_of_formula u U 1 1 line _ _ Ny).
  assert (Ez := error_of_formula u U 1 1 line _ _ Nz). assert (EV := error_of_formula u U 1 1 env _ _ HV).
  change (count 1 1 normal_y) with (count 1 1 normal_x) in Ey.
  change (count 1 1 normal_z) with (count 1 1 normal_x) in Ez.
  assert (SL : size line line_1_right = exact line line_1_right) by products.
  assert (RL := least_value u 1 1 line _ _ U Limit SL).
  assert (XL : exact line line_1_right = factor line_1_right * sum_of_sizes s)
    by (unfold sum_of_sizes, s, q, a; products).
  set (E := gamma u (count 1 1 normal_x)) in *. set (P := gamma u (count 1 1 near_end_3_left)) in *.
  set (G := gamma u (count 1 1 line_1_right)) in *. set (G2 := gamma u (count 1 1 near_end_2_right)) in *.
  set (K := factor line_1_right) in *.
  assert (K0 : 0 <= K) by (apply constant_positive; lia).
  assert (G1 : G < 1).
  { destruct HG as [_ HG]. revert HG. compute_counts. unfold most. simpl. rewrite u_value. lra. }
  assert (G21 : G2 < 1).
  { destruct HG2 as [_ HG2]. revert HG2. compute_counts. unfold most. simpl. rewrite u_value. lra. }
  assert (Pa := length_positive a). assert (Ps := length_positive s). assert (Pd := length_positive d).
  assert (Ss := length_below_sum s). fold (sum_of_sizes s) in Ss.
  assert (Sd := length_below_sum d). fold (sum_of_sizes d) in Sd.
  assert (Limit0 : K * length s * (1 - G) <= env 3%nat).
  { rewrite XL in RL. assert (K * length s <= K * sum_of_sizes s) by (apply Rmult_le_compat_l; assumption).
    assert (K * length s * (1 - G) <= K * sum_of_sizes s * (1 - G)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (Limit1 : 0 <= env 3%nat).
  { eapply Rle_trans; [| exact Limit0]. assert (0 <= K * length s) by (apply Rmult_le_pos; assumption).
    apply Rmult_le_pos; lra. }
  (* The normal. *)
  set (N := length a * length s). assert (N0 : 0 <= N) by (unfold N; nra).
  assert (Off : length (difference n normal) <= 11548 / 10000 * E * N).
  { apply Rle_trans with (length (scaled E (weights a s))).
    - apply length_monotone; unfold difference, scaled, n, normal, s, a, q; simpl;
        [eapply Rle_trans; [| eapply Rle_trans; [exact Ex |]] | eapply Rle_trans; [| eapply Rle_trans; [exact Ey |]]
        | eapply Rle_trans; [| eapply Rle_trans; [exact Ez |]]];
        try (apply Req_le; f_equal; lay_open; ring); (apply Rmult_le_compat_l; [apply HE |]);
        apply Req_le; sizes.
    - rewrite length_of_scaled by apply HE. assert (W := length_of_weights a s). fold N in W.
      assert (E * length (weights a s) <= E * (11548 / 10000 * N)) by (apply Rmult_le_compat_l; [apply HE | assumption]).
      lra. }
  assert (Ln : length n <= N * (1 + 11548 / 10000 * E)).
  { replace n with (sum normal (difference n normal))
      by (destruct n, normal; unfold sum, difference; simpl; f_equal; ring).
    eapply Rle_trans; [apply length_of_sum |]. assert (C := length_of_cross a s). fold normal N in C. lra. }
  (* The product. *)
  assert (Size : size env near_end_3_left <= length n * length d).
  { eapply Rle_trans; [| apply sum_of_products_bound]. apply Req_le. unfold n, d, p, f; sizes. }
  assert (Value : exact env near_end_3_left = dot n d) by (unfold n, d, p, f; lay_open; ring).
  rewrite Value in EV.
  assert (Moved : Rabs (dot n d - dot normal d) <= 11548 / 10000 * E * N * length d).
  { replace (dot n d - dot normal d) with (dot (difference n normal) d)
      by (unfold dot, difference; simpl; ring).
    eapply Rle_trans; [apply cauchy |]. apply Rmult_le_compat_r; assumption. }
  assert (Rounded : Rabs (V - dot n d) <= P * (N * (1 + 11548 / 10000 * E) * length d)).
  { eapply Rle_trans; [exact EV |]. apply Rmult_le_compat_l; [apply HP |].
    eapply Rle_trans; [exact Size |]. apply Rmult_le_compat_r; assumption. }
  (* The limit. *)
  assert (SR : size env near_end_2_right = exact env near_end_2_right).
  { lay_open. rewrite (Rabs_pos_eq (env 3%nat)) by assumption. reflexivity. }
  assert (RR := least_value u 1 1 env _ _ U Hr SR). fold G2 in RR.
  assert (XR : exact env near_end_2_right = env 3%nat * sum_of_sizes d)
    by (unfold sum_of_sizes, d, p, f; lay_open; ring).
  rewrite XR in RR.
  assert (Least : K * (1 - G) * (1 - G2) * (length s * length d) <= r).
  { eapply Rle_trans; [| exact RR].
    replace (K * (1 - G) * (1 - G2) * (length s * length d))
      with (K * length s * (1 - G) * length d * (1 - G2)) by ring.
    apply Rmult_le_compat_r; [lra |]. assert (0 <= K * length s) by (apply Rmult_le_pos; assumption).
    apply Rmult_le_compat; try assumption. apply Rmult_le_pos; lra. }
  apply right_sign with r; [| assumption].
  replace (V - dot normal d) with ((V - dot n d) + (dot n d - dot normal d)) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  assert (M := near_end_margin E P G G2 (length a) HE HP HG HG2 ltac:(lra)). fold K in M.
  assert (SD : 0 <= length s * length d) by nra.
  assert (M' := Rmult_le_compat_r _ _ _ SD M).
  replace (length a * (P * (1 + 11548 / 10000 * E) + 11548 / 10000 * E) * (length s * length d))
    with (P * (N * (1 + 11548 / 10000 * E) * length d) + 11548 / 10000 * E * N * length d) in M'
    by (unfold N; ring). lra.
Qed.

(* --- sign_of_change_at_end --- *)

Lemma change_at_end_margin E G A B :
  0 <= E <= most u (count 1 1 change_at_end_4_left) -> 0 <= G <= most u (count 1 1 change_at_end_3_right) ->
  0 <= A <= 2049 / 2048 -> 0 <= B <= 2049 / 2048 ->
  2 * E * (A * B) <= factor change_at_end_3_right * (1 - G).
Proof.
  intros. apply Rnot_lt_le. intro. apply (certificate_change_at_end.l1 E G A B).
  unfold certificate_change_at_end.s1, certificate_change_at_end.s2, certificate_change_at_end.s3,
    certificate_change_at_end.s4, certificate_change_at_end.s5, not. certify.
Qed.

(* a (a.s) - s (a.a), its first coordinate. *)
Theorem change_at_end_filter env V r :
  let a := triple env 0 in
  let s := difference (triple env 3) a in
  length a <= 2049 / 2048 ->
  computes u 1 1 env change_at_end_4_left V -> computes u 1 1 env change_at_end_3_right r -> r < Rabs V ->
  0 < V * (x a * dot a s - x s * dot a a).
Proof.
  intros a s La HV Hr L.
  replace (x a * dot a s - x s * dot a a) with (exact env change_at_end_4_left) by (unfold s, a; lay_open; ring).
  assert (Pa := length_positive a). assert (Ps := length_positive s).
  assert (E0 : 0 <= gamma u (count 1 1 change_at_end_4_left)) by (apply gamma_positive, u_positive).
  assert (Ss := length_below_sum s). fold (sum_of_sizes s) in Ss.
  assert (Right : exact env change_at_end_3_right = factor change_at_end_3_right * sum_of_sizes s)
    by (unfold sum_of_sizes, s, a; products).
  assert (F0 : 0 <= factor change_at_end_3_right) by (apply constant_positive; lia).
  assert (M := change_at_end_margin (gamma u (count 1 1 change_at_end_4_left))
                 (gamma u (count 1 1 change_at_end_3_right)) (length a) (length a)
                 ltac:(ranges) ltac:(ranges) ltac:(lra) ltac:(lra)).
  apply sum_filter with (right := change_at_end_3_right) (r := r) (margin := 0)
    (B := 2 * gamma u (count 1 1 change_at_end_4_left) * (length a * length a) * length s); try assumption; try lra.
  - products.
  - rewrite Right. apply Rmult_le_pos; lra.
  - replace (2 * gamma u (count 1 1 change_at_end_4_left) * (length a * length a) * length s)
      with (2 * (length a * length s * length a) * gamma u (count 1 1 change_at_end_4_left)) by ring.
    apply Rmult_le_compat_r; [assumption |]. eapply Rle_trans; [| apply change_size].
    apply Req_le. unfold s, a; sizes.
  - rewrite Right, Rplus_0_r. assert (M' := Rmult_le_compat_r _ _ _ Ps M).
    assert (M0 : 0 <= factor change_at_end_3_right * (1 - gamma u (count 1 1 change_at_end_3_right))).
    { eapply Rle_trans; [| exact M]. repeat apply Rmult_le_pos; lra. }
    assert (M1 := Rmult_le_compat_l _ _ _ M0 Ss). lra.
Qed.
