# The square of a determinant of three rounded differences, K2 times the product of three squared
# lengths (G: what that may be off by). E is the error in units of the permanent.
K2 = @factor orientation_extended_0_right@;
{ E in [0, @most 64 orientation_extended_1_left@] /\ G in [0, @most 64 orientation_extended_0_right@] ->
  K2 * (1 - G) - (11548/10000 * E) * (11548/10000 * E) * (1 + 1b-64) >= 0 }
