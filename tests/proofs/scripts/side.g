# As for an edge; and what the value exceeds is more than twice the radius (R) beyond its error.
K = @factor side_1_right@;
R = @factor arrangement_radius@;
{ E in [0, @most 53 side_1_left@] /\ G in [0, @most 53 side_1_right@] /\
  A in [0, 2049b-11] /\ B in [0, 2049b-10] -> K * (1 - G) - 2 * R - 11548/10000 * E * (A * B) >= 0 }
