// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Limits the gradients of a field in its source cells, so that it reaches no new extremes: monotone slopes
// (Barth and Jespersen, AIAA paper 89-0366, 1989).
//
//     high of the cells around  ------------------+--------
//                                    gradient   /  |  .-'   limited: the same mean, and the
//                                             / .-'|        cell's corners are within the
//     mean of the cell          ------------/-'----|        values around it
//
// in    means over the sources of a remapping of order 2; NaN is missing
// out   for each source a gradient, which belongs to the moments of the remapping, and bounds
// index sources by their indices in the input; nodes: places where cells meet
//
// In cell i the field is f_i + g . (x - m), with the mean m of x over the part of the cell that targets cover.
// The gradient g is tangent at the center, and is multiplied by the largest number in [0, 1] for which the
// field stays within the smallest and the largest value of the cell and of all cells that share a node with
// it. These are more cells than those that share an edge, which have the gradient: a linear field in
// triangles would be beyond the latter at corners.
//
// A cell lies in the cone over points P: its corners, and control points of the arcs of parallels. Each x of
// the cell is s / |s| with a convex combination s of P, and |s| is at least c, the smallest p . n over P for
// the direction n of the center. So
//
//     min(0, min g . p) / c  <=  g . x  <=  max(0, max g . p) / c
//
// A cell whose c is small, such as a belt around the globe, has no gradient. Where targets cover a part of a
// cell, m is not known, but g . m has the same bounds.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/linear_weights.h"
#include "rondel/cell_set.h"
#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The smallest and the largest of some values. Without values, low is above high.
struct ValueBounds {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(const ValueBounds& other) {
    low = other.low < low ? other.low : low;
    high = other.high > high ? other.high : high;
  }
};

// Values at targets are made of these and the means.
struct LimitedSlopes {
  std::vector<Point> gradients;     // 0 at sources without a value
  std::vector<ValueBounds> bounds;  // of each source and those around it
};

// Limits one field after another, all of which lack values in the same sources.
class SlopeLimiter {
 public:
  // `has_value` is 0 for each source without a value; empty: all have one. Precondition: the remapping is of
  // order 2.
  SlopeLimiter(const Remap& remap, std::span<const std::int32_t> has_value, unsigned threads);

  // `remap` is that of the constructor, or a copy. Numbers that are no values are NaN.
  [[nodiscard]] LimitedSlopes slopes(const Remap& remap, std::span<const double> means,
                                     unsigned threads) const;

 private:
  [[nodiscard]] std::vector<ValueBounds> bounds_around(std::span<const double> means) const;

  CellSet source_;
  std::vector<Index> places_;   // of the sources in the spatial order; empty for a grid
  std::vector<bool> is_there_;  // whether a source has values
  CellGradients unlimited_;
};

}  // namespace rondel::overlay
