// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weighted sites whose weights are finer than doubles. A wall between two sites moves by a difference of their weights over their
// distance, so of a million cells the rounding of weights to doubles alone moves areas by 1e-10. The
// weight of a site is the length of its vector p. A step of the smallest kind in one coordinate changes the
// length by as much as such a rounding; but of the short sums of such steps in all three there are many, and some of
// them meets a length much more closely. They turn the vector, too, by some 2^-53: that moves walls by no more, which is
// as far as corners of cells are known.
#pragma once

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::mesh {

// A point near `near` times a factor, with this length; its error is about 2^-60 of it, and 2^-53 where two
// coordinates are below a fourth of the spacing times it. `spacing` is that of the cells.
// Precondition: all are from 2^-500 to 2^500.
Point placed_pole(const Point& near, const exact::DoubleDouble& weight, double spacing);

}  // namespace rondel::mesh
