// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The distance is found among the 16 nearest sites of a query in most cases. For the remaining
// queries the sites are split by each bit of their feature's number. Two different features differ
// in some bit, so the nearest site of another feature is the nearest one in a set of sites whose
// features have one value of a bit, while the query's feature has the other value.
#include "proximity/feature_distance.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rondel/delaunay.h"
#include "rondel/query.h"
#include "rondel/triangulation.h"
#include "system/parallel.h"

namespace rondel::proximity {
namespace {

constexpr double no_other = std::numeric_limits<double>::infinity();
constexpr std::size_t sites_looked_at = 16;
constexpr std::size_t queries_per_piece = 256;

// Returns 1 for each representative with a duplicate of another feature: a point of several
// features.
std::vector<std::uint8_t> shared_places(const Triangulation& triangulation,
                                        std::span<const Index> features) {
  std::vector<std::uint8_t> is_shared(features.size());
  for (const Duplicate& duplicate : triangulation.duplicates()) {
    if (features[duplicate.site] != features[duplicate.representative]) {
      is_shared[duplicate.representative] = 1;
    }
  }
  return is_shared;
}

// Returns the distance of each query to the nearest site of another feature if it is among the 16
// nearest sites, or infinity.
std::vector<double> near_others(const LabelledSites& labelled, std::span<const Point> queries,
                                std::span<const Index> features, const Execution& execution) {
  const Triangulation triangulation = delaunay(Sites::view(labelled.sites), {}, execution);
  const Locator locator(triangulation);
  const std::vector<std::uint8_t> is_shared = shared_places(triangulation, labelled.features);
  const std::vector<Index> nearest = locator.k_nearest(queries, sites_looked_at, execution);
  std::vector<double> found(queries.size(), no_other);
  system::parallel_for(execution.threads, queries.size(), queries_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t q = begin; q < end; ++q) {
                           const std::span row =
                               std::span(nearest).subspan(q * sites_looked_at, sites_looked_at);
                           const auto other = std::ranges::find_if(row, [&](Index site) {
                             return site == no_index || is_shared[site] != 0 ||
                                    labelled.features[site] != features[q];
                           });
                           if (other != row.end() && *other != no_index) {
                             found[q] = locator.distance(queries[q], *other);
                           }
                         }
                       });
  return found;
}

// True for the features whose number has this bit set, or not set.
struct ByBit {
  Index bit;
  bool is_set;

  [[nodiscard]] bool operator()(Index feature) const { return ((feature & bit) != 0) == is_set; }
};

// Lowers found[q] for each query q of `left` whose feature does not satisfy `has`, to its distance
// from the nearest site whose feature does.
void lower_by(const ByBit& has, const LabelledSites& labelled, std::span<const Point> queries,
              std::span<const Index> features, std::span<const std::size_t> left,
              std::vector<double>& found, const Execution& execution) {
  std::vector<Point> others;
  for (std::size_t i = 0; i < labelled.sites.size(); ++i) {
    if (has(labelled.features[i])) others.push_back(labelled.sites[i]);
  }
  std::vector<Point> asked;
  std::vector<std::size_t> whose;
  for (const std::size_t q : left) {
    if (has(features[q])) continue;
    asked.push_back(queries[q]);
    whose.push_back(q);
  }
  if (others.empty() || asked.empty()) return;
  const Triangulation triangulation = delaunay(std::move(others), {}, execution);
  const Locator locator(triangulation);
  const std::vector<Index> nearest = locator.nearest(asked, execution);
  for (std::size_t k = 0; k < asked.size(); ++k) {
    double& distance = found[whose[k]];
    distance = std::min(distance, locator.distance(asked[k], nearest[k]));
  }
}

}  // namespace

std::vector<double> distances_to_others(const LabelledSites& labelled,
                                        std::span<const Point> queries,
                                        std::span<const Index> features,
                                        const Execution& execution) {
  if (queries.empty()) return {};
  std::vector<double> found = near_others(labelled, queries, features, execution);
  std::vector<std::size_t> left;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    if (found[q] == no_other) left.push_back(q);
  }
  if (left.empty()) return found;
  const Index largest = *std::ranges::max_element(labelled.features);
  for (Index bit = 1; bit != 0 && bit <= largest; bit <<= 1U) {
    for (const bool is_set : {false, true}) {
      lower_by({bit, is_set}, labelled, queries, features, left, found, execution);
    }
  }
  return found;
}

}  // namespace rondel::proximity
