# The determinant of three differences of stored directions (off by T), over the two longer ones. k is what
# the value exceeds, S the shortest one, at least k / (1 + F), w the quotient of the two.
U = 1b-53;
F = 11548/10000 * E;
k = sqrt(@factor circle_plane_0_right@ * (1 - G) / (1 + U));
q = T * (1 + F) / k * w;
{ E in [0, @most 53 circle_plane_1_left@] /\ G in [0, @most 53 circle_plane_0_right@] /\
  T in [0, @twice direction_error@] /\ S in [0, 2049b-10] /\ w in [0, 1] ->
  k - (T * (3 + 3 * q + q * q) + F * S) >= 0 }
