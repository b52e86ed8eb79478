# Per size of the limit: the rounding P of its product and that of the difference, and what its root is off by
# (e, and G of its argument), against K times the limit.
K = @factor within_power_3_right@;
s = (1 + e) * sqrt(1 + G);
{ P in [0, @most_of_part 53 within_power_4_left 2@] /\ R in [0, @most 53 within_power_3_right@] /\
  e in [-1b-53, 1b-53] /\ |G| in [0, @most 53 within_power_Root_101_of@] ->
  K * (1 - R) * s - (1b-53 * (1 + P) * s + P * s + |s - 1|) >= 0 }
