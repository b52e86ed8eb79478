# A coordinate of the change at an end of a step: twice the product of the lengths A and B near 1, over the
# length of the step.
K = @factor change_at_end_3_right@;
{ E in [0, @most 53 change_at_end_4_left@] /\ G in [0, @most 53 change_at_end_3_right@] /\
  A in [0, 2049b-11] /\ B in [0, 2049b-11] -> K * (1 - G) - 2 * E * (A * B) >= 0 }
