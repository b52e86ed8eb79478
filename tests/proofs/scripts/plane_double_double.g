# The square of the high word of a determinant in pairs of doubles, of exact pairs, against K2 times the product of
# three squared lengths, of which rounding may take 2^-40.
K2 = @factor plane_double_double_1_right@;
{ E in [0, @most 106 plane_double_double_High_109_of 3 7@] ->
  K2 * (1 - 1b-40) * ((1 - 1b-53) * (1 - 1b-53)) - (11548/10000 * E) * (11548/10000 * E) * (1 + 1b-53) >= 0 }
