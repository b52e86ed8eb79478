// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The areas of regions of any size and form, from their rings.
//
// in    rings of unit vectors with the region to their left
// out   steradians
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The area to the left of a ring, up to multiples of 4 pi: from -2 pi to 2 pi, with an error of at
// most `rounding`.
struct RingArea {
  double area = 0;
  double rounding = 0;

  // True if the area to the left of the ring, or that to its right, may come from rounding of the
  // corners alone.
  [[nodiscard]] bool is_nothing() const { return area <= rounding && -area <= rounding; }
};
RingArea area_of_ring(std::span<const Point> ring);

// The area of a region, from its rings. Each ring gives the area up to a multiple of 4 pi, and the
// area of a region is between 0 and 4 pi. So a sum that is certainly negative is the area minus
// that of the sphere. A sum within rounding of 0 is the area of a region that is nearly empty,
// since a ring has an inside to its left only if it is wider than rounding of its corners.
class RegionArea {
 public:
  void add(std::span<const Point> ring);
  [[nodiscard]] double value() const;

 private:
  exact::DoubleDouble sum_;
  std::vector<Point> points_;
  std::vector<std::size_t> ends_;  // where each ring ends among the points
};

}  // namespace rondel::overlay
