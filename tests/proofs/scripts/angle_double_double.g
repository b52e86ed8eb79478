# The difference of two squared distances in pairs of doubles (E: what it is off by, over twice the square of the
# longer one), of differences of unit vectors that are off by T, over the longer distance H. k is what the high word of
# the value exceeds; H is at least k / 2, and w is k / (2 H).
T = 1b-98;
k = sqrt(@factor angle_double_double_0_right@ * (1 - 1b-40) / (1 + 1b-53));
{ E in [0, @most 106 angle_double_double_High_100_of 3 7@] /\ H in [0, 2049b-10] /\ w in [0, 1] ->
  k * (1 - 1b-53) - (2 * E * H + T * (4 + 4 * (T / k * w))) >= 0 }
