// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/owned_parts.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/coverage.h"
#include "arrangement/halfedges.h"
#include "arrangement/region_borders.h"
#include "arrangement/ring_arrays.h"
#include "arrangement/set_regions.h"
#include "rondel/arrangement.h"

namespace rondel::arrangement {
namespace {

// Numbers the sets of owners in the order in which they occur.
class OwnerNumbers {
 public:
  explicit OwnerNumbers(PlaceOwners rule) : rule_(rule) {}

  // Returns the number of the owners of a place that these polygons have.
  Index number(std::vector<Index> polygons) {
    if (polygons.empty()) return no_index;
    if (rule_ == PlaceOwners::first) {
      polygons = {*std::ranges::min_element(polygons)};
    } else {
      std::ranges::sort(polygons);
    }
    const auto [place, is_new] =
        numbers_.try_emplace(std::move(polygons), static_cast<Index>(numbers_.size()));
    return place->second;
  }
  // Calls visit(owners, number) for all sets, in lexicographic order.
  template <class Visit>
  void visit(const Visit& visit) const {
    for (const auto& [owners, number] : numbers_) visit(owners, number);
  }

 private:
  PlaceOwners rule_;
  std::map<std::vector<Index>, Index> numbers_;
};

// Returns the polygons that have the face beyond an edge.
std::vector<Index> beyond(std::vector<Index> polygons, std::span<const EdgeOfPolygon> edge) {
  for (const EdgeOfPolygon& side : edge) {
    const auto place = std::ranges::find(polygons, side.polygon);
    if (place == polygons.end()) {
      polygons.push_back(side.polygon);
    } else {
      polygons.erase(place);
    }
  }
  return polygons;
}

// Returns the region of each number of owners. One without a border is the whole sphere.
std::vector<Region> numbered_regions(const Sides& sides, OwnerNumbers& numbers, PlaceOwners rule,
                                     const Execution& execution) {
  const Arrangement arranged = arrange(sides.points, sides.arcs, execution);
  if (arranged.edges.empty()) {
    const Index number = numbers.number(sides.owners_without_edges()[0]);
    return number == no_index ? std::vector<Region>{} : std::vector{Region{{0, 0}, {}, true}};
  }
  const Halfedges halfedges(arranged, execution.threads);
  const CompressedRows<EdgeOfPolygon> polygons = polygons_of_edges(arranged, sides.polygons);
  Coverage coverage(halfedges, polygons, sides.operands, sides.whole, sides.known,
                    execution.threads);
  if (!sides.are_mended && !coverage.contradictory().empty()) {
    return numbered_regions(mended(sides, coverage.contradictory(), execution), numbers, rule,
                            execution);
  }
  std::vector<BorderHalfedge> border;
  coverage.visit([&](Index h, const Owners& owners) {
    const Index number = numbers.number(owners[0]);
    if (number == no_index || polygons[h / 2].empty()) return;
    // All owners differ on both sides of an edge; the first of them may be the same.
    if (rule == PlaceOwners::first &&
        numbers.number(beyond(owners[0], polygons[h / 2])) == number) {
      return;
    }
    border.push_back({{number, 0}, h});
  });
  std::ranges::sort(border);
  std::vector<Region> regions = bordered_regions(arranged, halfedges, border);
  if (regions.empty())
    numbers.visit([&](auto&&, Index n) { regions.push_back({{n, 0}, {}, true}); });
  return regions;
}

}  // namespace

OwnedParts owned_parts(const CellRings& polygons, PlaceOwners rule, const Execution& execution) {
  validate_rings(polygons);
  Sides sides;
  sides.append(polygons, 0);
  OwnerNumbers numbers(rule);
  std::vector<Region> found = numbered_regions(sides, numbers, rule, execution);
  std::vector<Region> regions;
  OwnedParts result;
  numbers.visit([&](const std::vector<Index>& owners, Index number) {
    const auto region = std::ranges::lower_bound(found, number, {},
                                                 [](const Region& one) { return one.key.first; });
    if (region == found.end() || region->key.first != number) return;
    regions.push_back(std::move(*region));
    result.owners.append(owners);
  });
  result.parts = cells_of(regions, execution.threads);
  return result;
}

}  // namespace rondel::arrangement
