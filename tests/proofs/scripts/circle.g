# The sheared form, over the cube of the longest difference H; a stored direction (length A) is off by eta, a
# difference by T. k is what the value exceeds; H is at least k / (3 A (1 + F)), w the quotient of the two.
U = 1b-53;
F = 11548/10000 * E;
k = sqrt(@factor circle_1_right@ * (1 - G) / (1 + U));
q = T * (3 * A * (1 + F)) / k * w;
{ E in [0, @most 53 circle_2_left@] /\ G in [0, @most 53 circle_1_right@] /\
  T in [0, @twice direction_error@] /\ eta in [0, @factor direction_error@] /\
  A in [2047b-11, 2049b-11] /\ H in [0, 2049b-10] /\ w in [0, 1] ->
  k - (3 * ((A + eta) * (T * (4 + 6 * q + 4 * (q * q) + q * q * q))) + 3 * (eta * H) + 3 * (F * (A * H))) >= 0 }
