// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the points that are in a box, by a k-d tree (Bentley, Comm. ACM 18, 1975) that is balanced
// and has no pointers.
//
// in    points, and the indices of some of them
// out   the indices of those in a box of space
// index corners: as in `points`; begin, middle, end: positions in corners_
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

class CornerTree {
 public:
  CornerTree(std::span<const Point> points, std::vector<Index> corners)
      : points_(points), corners_(std::move(corners)) {
    build(0, corners_.size(), 0);
  }

  // Calls visit(corner) for each corner in the box from `low` to `high`, both included.
  template <class Visit>
  void visit(const Point& low, const Point& high, const Visit& visit) const {
    visit_part(0, corners_.size(), 0, low, high, visit);
  }

 private:
  static constexpr std::size_t leaf_size = 8;
  static constexpr unsigned num_axes = 3;

  static double along(unsigned axis, const Point& p) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }
  static unsigned next(unsigned axis) { return (axis + 1) % num_axes; }

  // Sorts a part so that the corners before its middle one are not above that one along the axis,
  // and the corners behind it are not below it.
  void build(std::size_t begin, std::size_t end, unsigned axis) {
    if (end - begin <= leaf_size) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) {
      return corners_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(at(begin), at(middle), at(end), [&](Index p, Index q) {
      return std::pair(along(axis, points_[p]), p) < std::pair(along(axis, points_[q]), q);
    });
    build(begin, middle, next(axis));
    build(middle + 1, end, next(axis));
  }

  template <class Visit>
  void visit_part(std::size_t begin, std::size_t end, unsigned axis, const Point& low,
                  const Point& high, const Visit& visit) const {
    const auto visit_one = [&](std::size_t k) {
      const Point& p = points_[corners_[k]];
      if (p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
          p.z <= high.z) {
        visit(corners_[k]);
      }
    };
    if (end - begin <= leaf_size) {
      for (std::size_t k = begin; k < end; ++k) visit_one(k);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const double split = along(axis, points_[corners_[middle]]);
    if (along(axis, low) <= split) visit_part(begin, middle, next(axis), low, high, visit);
    visit_one(middle);
    if (along(axis, high) >= split) visit_part(middle + 1, end, next(axis), low, high, visit);
  }

  std::span<const Point> points_;
  std::vector<Index> corners_;
};

}  // namespace rondel::overlay
