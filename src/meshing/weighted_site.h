// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weighted sites whose weights are finer than doubles. The wall between two sites moves by the
// difference of their weights over their distance, so that with a million cells the rounding of
// weights to doubles alone changes areas by 1e-10. The weight of a site is the length of its vector
// p. Changing one coordinate by its last bit changes the length by about as much as such a
// rounding; but among the short sums of such changes in all three coordinates there are many
// lengths, some much closer to the wanted one. They also turn the vector by about 2^-53, which
// moves walls by no more than the accuracy of the corners of cells.
//
// in    a point near the wanted one, a weight in twice double precision, the spacing of cells in
//       radians
// out   a point whose length is the weight
#pragma once

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::mesh {

// Returns a point near `near` times a factor that has the length `weight`, with a relative error of
// about 2^-60, or 2^-53 if two coordinates are below a fourth of the spacing times it. `spacing` is
// that of the cells. Precondition: all arguments are between 2^-500 and 2^500.
Point weighted_site(const Point& near, const exact::DoubleDouble& weight, double spacing);

}  // namespace rondel::mesh
