# A sum of products against K times the sum of the sizes of two products; E and G are what the two may be off by.
K = @factor turn_1_right@;
{ E in [0, @most 53 turn_2_left@] /\ G in [0, @most 53 turn_1_right@] -> K * (1 - G) - E >= 0 }
