// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the incremental algorithm asks of the sites: the paper's traits class. Sites are named
// by their spatial rank. The two models, ProjectedPoints (section 4.1) and
// WeightedPoints (section 4.2), differ in the conflict test.
#pragma once

#include <array>
#include <concepts>

#include "predicates/filtered.h"
#include "rondel/types.h"

namespace rondel::models {

template <class T>
concept SphereTraits = requires(const T& sites, Index a, Index b, Index c, Index p,
                                const std::array<Index, 3>& f) {
  // Whether an insertion can turn a vertex, or the new site, into a hidden site.
  { T::hides_sites } -> std::convertible_to<bool>;
  // The number of distinct sites.
  { sites.size() } -> std::same_as<Index>;
  // Coordinates and the vector from the center: in doubles, for the walk, which may guess.
  { sites.coordinates(a) } -> std::same_as<predicates::Vector>;
  { sites.from_center(a) } -> std::same_as<predicates::Vector>;
  // Exact, zero included.
  { sites.orientation(a, b, c) } -> std::same_as<Sign>;
  // Exact, ties broken: whether p is in conflict with the face (a, b, c) of a hull.
  { sites.is_in_conflict(a, b, c, p) } -> std::same_as<bool>;
  // The same for two faces.
  { sites.are_in_conflict(f, f, p) } -> std::same_as<std::array<bool, 2>>;
};

}  // namespace rondel::models
