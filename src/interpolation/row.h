// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a kernel is told of one target and what it answers. A kernel is a method of interpolation:
//
//     void operator()(const TargetPlace& place, Row& row);
//
// 1. It fills an empty row, or leaves it empty where its method has no value.
// 2. The order of a row depends on the places of the sites alone: vertices have ranks, not indices,
//    and begin with the lowest where they form a ring. So do all sums.
// 3. The weights sum up to 1, but for those of Normalization::homogeneous, which the caller makes.
// 4. It is never asked about a vertex, nor where no solid face is.
// 5. One belongs to one thread.
#pragma once

#include <concepts>
#include <vector>

#include "exact/unit_vector.h"
#include "rondel/query.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// A target on an edge or in a face.
struct TargetPlace {
  Point point;             // as given
  exact::SplitPoint unit;  // u, its direction from the center
  Location location;       // its `sites` are ranks
};

// What is taken of the value at a vertex.
struct Share {
  Index vertex = no_index;  // its rank
  double weight = 0;
};
using Row = std::vector<Share>;

// What is taken of the value at a vertex and, by a scalar product, of its tangent gradient.
struct SlopeShare {
  Index vertex = no_index;
  double weight = 0;
  Point slope{};
};
using SlopeRow = std::vector<SlopeShare>;

template <class K>
concept Kernel = requires(K& kernel, const TargetPlace& place, Row& row) {
  kernel(place, row);
};
// Works on K::group targets at once.
template <class K>
concept GroupKernel = requires(K& kernel, const TargetPlace& place) {
  kernel.begin();
  kernel.expect(K::group, place);
};
template <class K>
concept SlopeKernel = requires(K& kernel, const TargetPlace& place, SlopeRow& row) {
  kernel(place, row);
};

}  // namespace rondel::interpolation
