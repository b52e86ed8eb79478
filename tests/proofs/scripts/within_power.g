# Per size of the scalar product: its rounding E and that of the difference, against K times a root, of which rounding (e, and
# G of its argument) and the rounding R of the right side take their part.
K = @factor within_power_3_right@;
{ E in [0, @most_of_part 53 within_power_4_left 1@] /\ R in [0, @most 53 within_power_3_right@] /\
  e in [-1b-53, 1b-53] /\ |G| in [0, @most 53 within_power_Root_102_of@] ->
  K * (1 - R) * ((1 + e) * sqrt(1 + G)) - (1b-53 * (1 + E) + E) >= 0 }
