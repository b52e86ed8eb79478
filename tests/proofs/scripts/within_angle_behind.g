# A squared distance of stored directions (off by T), rounded (E), less an exact number, over the larger one of
# the distance and the root of the number, H. k is what the value exceeds; H is at least
# k / ((1 + u) (1 + E)), w the quotient of the two.
U = 1b-53;
k = sqrt(@factor within_angle_behind_0_right@ * (1 - G) / (1 + U));
q = T * ((1 + U) * (1 + E)) / k * w;
{ E in [0, @most_of_part 53 within_angle_behind_1_left 1@] /\ G in [0, @most 53 within_angle_behind_0_right@] /\
  T in [0, @twice direction_error@] /\ H in [0, 2049b-10] /\ w in [0, 1] ->
  k - (H * (U * (1 + E) + E) + T * (2 + q)) >= 0 }
