# The difference of two squared distances of stored directions (off by T), each rounded (E), over the longer
# distance H. k is what the value exceeds; H is at least k / ((1 + u) (1 + E)), w the quotient of the two.
U = 1b-53;
k = sqrt(@factor angle_0_right@ * (1 - G) / (1 + U));
q = T * ((1 + U) * (1 + E)) / k * w;
{ E in [0, @most_of_part 53 angle_1_left 1@] /\ G in [0, @most 53 angle_0_right@] /\
  T in [0, @twice direction_error@] /\ H in [0, 2049b-10] /\ w in [0, 1] ->
  k - (H * (U * (1 + E) + 2 * E) + T * (4 + 2 * q)) >= 0 }
