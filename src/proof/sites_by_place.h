// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which sites are duplicates of each other, decided exactly and in O(n log n).
//
// Each site is entered in every cell of a grid that may hold its place; rounding makes
// that more than one cell only near a border. Two duplicates have one place, the cell of that
// place lists both, so no pair is missed. Within a cell an exact order brings duplicates together.
#pragma once

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
  std::vector<Index> speaker;
};

SitesByPlace group_by_place(std::span<const Point> sites, Model model, const Sphere& sphere);

}  // namespace rondel::proof
