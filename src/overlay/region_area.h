// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <numbers>
#include <span>

#include "map/ring_area.h"
#include "overlay/measure.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The area of a region by its rings, whatever its size and form. Each ring gives it but for a multiple of 4 pi, and their
// sum lies between -4 pi and 4 pi.
class RegionArea {
 public:
  void add(std::span<const Point> ring) {
    sum_ += map::area_on_left(ring);
    num_corners_ += ring.size();
  }
  // No more below 0 than by rounding.
  [[nodiscard]] double value() const {
    const double rounding = area_of_rounding(static_cast<double>(num_corners_));
    return sum_ < -rounding ? sum_ + 4 * std::numbers::pi : sum_;
  }

 private:
  double sum_ = 0;
  std::size_t num_corners_ = 0;
};

}  // namespace rondel::overlay
