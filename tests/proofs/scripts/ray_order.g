# A sum of products against K times the sum of the sizes of two products; E and G are what the two may be off by.
K = @factor ray_order_3_right@;
{ E in [0, @most 53 ray_order_4_left@] /\ G in [0, @most 53 ray_order_3_right@] -> K * (1 - G) - E >= 0 }
