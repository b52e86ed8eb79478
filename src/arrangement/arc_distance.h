// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How far places are from an arc.
#pragma once

#include <algorithm>

#include "arrangement/noded_arcs.h"
#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Returns the square of the sine of the distance of a place from an arc, or more if it is no less than
// 90 degrees. For arcs of at most 90 degrees the error of the sine is below 2^-47.
class ArcDistance {
 public:
  static constexpr double farther = 4;  // what is returned from 90 degrees on

  ArcDistance(const Point& a, const Point& c)
      : a_(exact::to_vector(a)), c_(exact::to_vector(c)), normal_(cross(a_, c_ - a_)) {
    after_a_ = cross(normal_, a_);
    before_c_ = cross(c_, normal_);
    squared_length_ = dot(normal_, normal_);
  }
  [[nodiscard]] double squared_sine(const Point& place) const {
    const Vec p = exact::to_vector(place);
    const Vec step = p - a_;
    if (squared_length_ > 0 && dot(after_a_, p) >= 0 && dot(before_c_, p) >= 0) {
      const double height = dot(normal_, step);
      return height * height / squared_length_;
    }
    const double chord = std::min(dot(step, step), dot(p - c_, p - c_));
    return chord < 2 ? chord * (1 - chord / 4) : farther;
  }

 private:
  Vec a_;
  Vec c_;
  Vec normal_;
  Vec after_a_{};
  Vec before_c_{};
  double squared_length_ = 0;
};

}  // namespace rondel::arrangement
