# The determinant of a stored direction (length A, off by eta) and two differences of such (off by T), over the
# longer one of these. k is what the value exceeds, over the longer one; h the shorter one, at least
# k / (A (1 + F)), w the quotient of the two.
U = 1b-53;
F = 11548/10000 * E;
k = sqrt(@factor direction_orientation_0_right@ * (1 - G) / (1 + U));
q = T * (A * (1 + F)) / k * w;
{ E in [0, @most 53 direction_orientation_1_left@] /\ G in [0, @most 53 direction_orientation_0_right@] /\
  T in [0, @twice direction_error@] /\ eta in [0, @factor direction_error@] /\
  A in [2047b-11, 2049b-11] /\ h in [0, 2049b-10] /\ w in [0, 1] ->
  k - ((A + eta) * (T * (2 + q)) + eta * h + F * (A * h)) >= 0 }
