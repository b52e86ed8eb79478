// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "order/place_keys.h"
#include "predicates/perturbation.h"
#include "query/built.h"

namespace rondel::query {
namespace {

// Returns, for a representative, which of the sites in its place has the coordinates that count.
class RepresentativeOf {
 public:
  explicit RepresentativeOf(const Triangulation& triangulation) {
    if (triangulation.duplicates().empty()) return;
    representatives_.resize(triangulation.num_sites());
    std::iota(representatives_.begin(), representatives_.end(), Index{0});
    const Sites& sites = triangulation.sites();
    for (const auto& [site, representative] : triangulation.duplicates()) {
      Index& first_site = representatives_[representative];
      if (predicates::is_lexicographically_less(sites[site], sites[first_site])) first_site = site;
    }
  }
  Index operator()(Index name) const {
    return representatives_.empty() ? name : representatives_[name];
  }

 private:
  std::vector<Index> representatives_;
};

// Orders the indices of equal keys by what else there is to places: until here they are in the order
// of the input.
template <class RestOf>
void order_ties(order::KeyedIndices& sorted, const RestOf& rest_of) {
  const auto& keys = sorted.keys;
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t end = i + 1;
    while (end < keys.size() && keys[end] == keys[i]) ++end;
    if (end - i > 1) {
      std::ranges::sort(std::span(sorted.indices).subspan(i, end - i), {}, rest_of);
    }
    i = end;
  }
}

}  // namespace

void order_ties_by_place(const Triangulation& triangulation, order::KeyedIndices& sorted) {
  const RepresentativeOf speaker_of(triangulation);
  order_ties(sorted, [&](Index i) {
    const Point& p = triangulation.sites()[speaker_of(i)];
    return std::tuple(order::place_key(p, triangulation.model(), triangulation.sphere().center).low,
                      p.x, p.y, p.z);
  });
}

}  // namespace rondel::query
