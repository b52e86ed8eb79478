# The square of a coordinate of the change: twice the product of three lengths, off by E, against K2 times the
# product of the squared lengths.
K2 = @factor change_1_right@;
{ E in [0, @most 53 change_2_left@] /\ G in [0, @most 53 change_1_right@] ->
  K2 * (1 - G) - (2 * E) * (2 * E) * (1 + 1b-53) >= 0 }
