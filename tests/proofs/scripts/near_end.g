# The product of a normal, as computed (E of the length A near 1 of a point and of its step, in each component of
# the permanent), and a difference of two points (P: what the product is off by), over the lengths of step and
# difference, against K times the sums of the sizes of their coordinates.
K = @factor line_1_right@;
{ E in [0, @most_of_part 53 line_2_left 1 1 1@] /\ P in [0, @most 53 near_end_3_left@] /\
  G in [0, @most 53 line_1_right@] /\ G2 in [0, @most 53 near_end_2_right@] /\ A in [0, 2049b-11] ->
  K * (1 - G) * (1 - G2) - A * (P * (1 + 11548/10000 * E) + 11548/10000 * E) >= 0 }
