# A determinant of products in units of their own against K times its size, as computed.
K = @factor orientation_wide_0_right@;
{ E in [0, @most 53 orientation_wide_1_left@] /\ G in [0, @most 53 orientation_wide_0_right@] -> K * (1 - G) - E >= 0 }
