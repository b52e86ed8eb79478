// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Coordinates in doubles that fit a set of sites: seen from an origin, each axis scaled by the
// power of two that brings the sites into a cube of moderate size. A cloud that is flat or long
// along the axes becomes a round one; the scaling itself does not round.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "predicates/rung.h"
#include "rondel/types.h"

namespace rondel::hidden {

class Frame {
 public:
  Frame(std::span<const Point> sites, const Point& origin) {
    Point least = origin;
    Point most = origin;
    for (const Point& p : sites) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
    scale_ = {scale_of(least.x, most.x), scale_of(least.y, most.y), scale_of(least.z, most.z)};
    half_origin_ = half(origin);
  }

  // The coordinates of a site, at most 2 in size. Each is off by at most 2^-53 of itself and
  // 2^-374: half the least subnormal number for each half, times the largest scale.
  [[nodiscard]] predicates::Vector to(const Point& p) const {
    const predicates::Vector v = half(p) - half_origin_;
    return {v.x * scale_.x, v.y * scale_.y, v.z * scale_.z};
  }

  // to(q) - to(p), off by at most 2^-53 of itself and the same absolute error.
  [[nodiscard]] predicates::Vector between(const Point& p, const Point& q) const {
    const predicates::Vector v = half(q) - half(p);
    return {v.x * scale_.x, v.y * scale_.y, v.z * scale_.z};
  }

 private:
  // Halves, so that no difference overflows.
  static predicates::Vector half(const Point& p) { return {p.x / 2, p.y / 2, p.z / 2}; }

  static double scale_of(double least, double most) {
    const double extent = most / 2 - least / 2;
    constexpr int largest_exponent = 700;
    return extent > 0 ? std::ldexp(1.0, std::min(-std::ilogb(extent), largest_exponent)) : 0;
  }

  predicates::Vector scale_{};
  predicates::Vector half_origin_{};
};

}  // namespace rondel::hidden
