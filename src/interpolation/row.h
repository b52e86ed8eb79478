// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The input and output of a kernel for one target. A kernel is a method of interpolation:
//
//     void operator()(const LocatedTarget& place, Row& row);
//
// 1. It fills an empty row, or leaves it empty where the method has no value.
// 2. The order of the entries depends only on the places of the sites: vertices are spatial ranks,
//    not sites, and a ring begins with its lowest vertex. So sums are taken in an order that
//    depends on the places alone, too.
// 3. The weights sum up to 1; for Normalization::homogeneous the caller divides them afterwards.
// 4. It is never called for a target at a vertex, nor outside of all solid faces.
// 5. Each thread has its own kernel.
//
// in    a target: its direction, and the face or edge in which it lies
// out   a row: vertices with their weights
// index spatial ranks of vertices
#pragma once

#include <concepts>
#include <vector>

#include "exact/unit_vector.h"
#include "rondel/query.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// A target on an edge or in a face.
struct LocatedTarget {
  Point point;             // as given
  exact::SplitPoint unit;  // u, its direction from the center
  Location location;       // with ranks in `sites`
};

// The weight of the value at a vertex.
struct WeightedVertex {
  Index vertex = no_index;  // spatial rank
  double weight = 0;
};
using Row = std::vector<WeightedVertex>;

// The weight of the value at a vertex and, as a vector, that of its tangent gradient: the entry
// contributes weight * value + slope . gradient.
struct GradientShare {
  Index vertex = no_index;
  double weight = 0;
  Point slope{};
};
using GradientRow = std::vector<GradientShare>;

// A kernel whose rows have weights of values only.
template <class K>
concept Kernel = requires(K& kernel, const LocatedTarget& place, Row& row) {
  kernel(place, row);
};
// A kernel that computes K::group targets at once.
template <class K>
concept GroupKernel = requires(K& kernel, const LocatedTarget& place) {
  kernel.begin();
  kernel.expect(K::group, place);
};
// A kernel whose rows have weights of gradients too.
template <class K>
concept GradientKernel = requires(K& kernel, const LocatedTarget& place, GradientRow& row) {
  kernel(place, row);
};

}  // namespace rondel::interpolation
