// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The areas of regions by their rings, whatever their size and form.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The area to the left of a ring, but for a multiple of 4 pi: from -2 pi to 2 pi, and right to `rounding`.
struct RingArea {
  double area = 0;
  double rounding = 0;

  // Whether rounding of the corners may have made all of what is left, or right, of the ring.
  [[nodiscard]] bool is_nothing() const { return area <= rounding && -area <= rounding; }
};
RingArea area_of_ring(std::span<const Point> ring);

// Each ring gives the area but for a multiple of 4 pi, and it lies between 0 and 4 pi. So a sum that is surely negative is
// the sphere's less that of what is missing. A sum that may be rounding is that of next to nothing, as rings have an inside
// on their left only if they are wider than rounding of their corners.
class RegionArea {
 public:
  void add(std::span<const Point> ring);
  [[nodiscard]] double value() const;

 private:
  exact::DoubleDouble sum_;
  std::vector<Point> points_;
  std::vector<std::size_t> ends_;  // of the rings among the points
};

}  // namespace rondel::overlay
