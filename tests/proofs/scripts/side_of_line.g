# Two products of rounded differences, relative to what is computed: three roundings each, and three more in what the
# comparison computes (e each), against K.
K = @factor_of_part plane_line_0_right 1@;
{ e in [0, 1b-53] -> K - e * (3 + 3 * e + e * e) * ((1 + e) * (1 + e) * (1 + e)) >= 0 }
