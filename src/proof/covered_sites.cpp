// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "proof/convexity.h"

namespace rondel::proof {
namespace {

// Interleaves the upper 21 bits of three coordinates in [0, 1]: a space-filling order.
std::uint64_t morton_key(const std::array<double, 3>& unit) {
  std::uint64_t key = 0;
  for (int bit = 20; bit >= 0; --bit) {
    for (const double u : unit) {
      const auto cell = static_cast<std::uint64_t>(u * 0x1.fffffp20);
      key = key << 1 | (cell >> bit & 1U);
    }
  }
  return key;
}

// The candidates so that sites near in space are near in order. Only speed depends on it.
std::vector<Index> in_spatial_order(const PerturbedSites& sites,
                                    std::span<const Index> candidates) {
  using Coordinates = std::array<double, 3>;
  // Halves, because a difference of coordinates may overflow.
  const auto half = [&](Index i) {
    const Point& p = sites.point(i);
    return Coordinates{p.x / 2, p.y / 2, p.z / 2};
  };
  Coordinates low = half(candidates[0]);
  Coordinates high = low;
  for (const Index i : candidates) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], half(i)[axis]);
      high[axis] = std::max(high[axis], half(i)[axis]);
    }
  }
  std::vector<std::pair<std::uint64_t, Index>> keyed;
  keyed.reserve(candidates.size());
  for (const Index i : candidates) {
    Coordinates unit = half(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double width = high[axis] - low[axis];
      unit[axis] = width > 0 ? (unit[axis] - low[axis]) / width : 0;
    }
    keyed.emplace_back(morton_key(unit), i);
  }
  std::ranges::sort(keyed);
  std::vector<Index> order;
  order.reserve(keyed.size());
  for (const auto& [key, site] : keyed) order.push_back(site);
  return order;
}

// The halfedge of a face that has the site strictly beyond it seen from the pole, or no_index.
Index edge_towards(const Surface& surface, const PerturbedSites& sites, Index pole, Index face,
                   Index site) {
  for (Index h = 3 * face; h < 3 * face + 3; ++h) {
    if (sites.is_above(surface.origin(h), surface.target(h), site, pole)) return h;
  }
  return no_index;
}

}  // namespace

std::string find_uncovered(const Surface& surface, const PerturbedSites& sites, Index pole,
                           std::span<const Index> candidates) {
  if (candidates.empty()) return {};
  Index face = 0;
  while (contains(surface.face(face), pole)) ++face;
  for (const Index site : in_spatial_order(sites, candidates)) {
    Index above = no_index;
    for ([[maybe_unused]] std::size_t steps = 0; above == no_index; ++steps) {
      assert(steps <= surface.num_faces());
      const Index h = edge_towards(surface, sites, pole, face, site);
      if (h == no_index) {
        const auto& [a, b, c] = surface.face(face);
        if (sites.is_above(a, b, c, site)) above = face;
        break;
      }
      const Index across = surface.opposite(h) / 3;
      if (contains(surface.face(across), pole)) {
        above = across;
      } else {
        face = across;
      }
    }
    if (above != no_index) {
      return "site " + std::to_string(site) + " is no vertex, but lies above face " +
             std::to_string(above);
    }
  }
  return {};
}

}  // namespace rondel::proof
