// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A point strictly inside the convex hull of sites, from which a hull is built and seen.
//
//            d              a: the lexicographically smallest site; b: far from a;
//          / | \            c: far from the line ab; d: far from the plane abc.
//        a - |o - c         o: their centroid, rounded, if it lies strictly inside
//          \ | /            the tetrahedron, or else a neighbor of it in the grid
//            b              of doubles.
//
// Each choice is a function of the set of sites: equally far ones are told apart by their
// coordinates, and the computations in doubles depend on nothing but the candidate and earlier
// choices.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "rondel/types.h"

namespace rondel::hidden {

struct InnerPoint {
  // Strictly inside the tetrahedron of `corners`, which are sites. Where no such double is found
  // (a flat hull, or a sliver as thin as the grid of doubles) it is the lexicographically
  // smallest site instead. Without sites the origin.
  Point point{};
  bool is_inside = false;
  std::array<Point, 4> corners{};
};

InnerPoint find_inner_point(std::span<const Point> sites);

// The middle of the smallest box with edges along the axes that holds the sites, if it lies
// strictly inside the hull of those that touch the box first. Seen from there, sites on a sphere
// are about equally far, which the triangulation by blocks needs. Also a function of the set of
// sites.
std::optional<Point> find_middle(std::span<const Point> sites);

}  // namespace rondel::hidden
