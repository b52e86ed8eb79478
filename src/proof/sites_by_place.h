// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which sites are duplicates of each other, decided exactly and in O(n log n).
//
// Each site is entered in every cell of a grid that may hold its place; rounding makes
// that more than one cell only near a border. Two duplicates have one place, the cell of that
// place lists both, so no pair is missed. Within a cell an exact order brings duplicates together.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::proof {

// The sites grouped by place.
struct SitesByPlace {
  // By site: the lowest index in its place.
  std::vector<Index> first;
  // By the lowest index of a place: the site there with the lexicographically smallest
  // coordinates, which speaks for the place in ties.
  std::vector<Index> representative;
};

SitesByPlace group_by_place(std::span<const Point> sites, Model model, const Sphere& sphere);

// Points on the axes through the center of the sphere: they turn questions about two
// sites into orientations of three.
// A point on axis 0, 1 or 2 through the center, exactly, on either side but not at the center.
inline Point axis_point(Point center, unsigned axis) {
  double& value = axis == 0 ? center.x : axis == 1 ? center.y : center.z;
  value = value >= 0 ? value - std::max(1.0, value) : value + std::max(1.0, -value);
  return center;
}

}  // namespace rondel::proof
