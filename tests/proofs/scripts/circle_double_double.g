# The high word of a determinant in pairs of doubles, of differences of unit vectors that are off by T, over the square
# of the longest one, H, against K, of which rounding may take 2^-40; w is 1 / H.
K = @factor circle_double_double_1_right@;
T = 1b-99;
{ E in [0, @most 106 circle_double_double_High_109_of 3 7@] /\ H in [0, 2049b-10] /\ w in [0, 1b49] ->
  K * (1 - 1b-40) * (1 - 1b-53) - (11548/10000 * E * H + T * (3 + 3 * (T * w) + T * w * (T * w))) >= 0 }
