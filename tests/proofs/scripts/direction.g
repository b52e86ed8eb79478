# A coordinate of a direction over that of the exact unit vector along the rounded difference: the rounding of the
# quotient, d, that of the root, e, and that of the sum of squares, G; and the direction of the rounded difference is
# off by D at most.
eta = @factor direction_error@;
{ d in [-1b-53, 1b-53] /\ e in [-1b-53, 1b-53] /\ |G| in [0, @most 53 norm_0_left@] /\ D in [0, 1025b-63] ->
  eta - D - |(1 + d) / ((1 + e) * sqrt(1 + G)) - 1| >= 0 }
