# The determinant of a point of length A near 1, a step and a difference of length B of two points, over
# the length of the step, against K times the sum of the sizes of the coordinates of the step.
K = @factor edge_1_right@;
{ E in [0, @most 53 edge_2_left@] /\ G in [0, @most 53 edge_1_right@] /\
  A in [0, 2049b-11] /\ B in [0, 2049b-10] -> K * (1 - G) - 11548/10000 * E * (A * B) >= 0 }
