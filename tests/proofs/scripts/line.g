# The determinant of two points of lengths A and B near 1 and a step, over the length of the step, against
# K times the sum of the sizes of the coordinates of the step.
K = @factor line_1_right@;
{ E in [0, @most 53 line_2_left@] /\ G in [0, @most 53 line_1_right@] /\
  A in [0, 2049b-11] /\ B in [0, 2049b-11] -> K * (1 - G) - 11548/10000 * E * (A * B) >= 0 }
