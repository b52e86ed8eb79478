// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/fixed_sites.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/query.h"

namespace rondel::mesh {
namespace {

// KineticDelaunay accepts lengths within 3 * 2^-53 of 1; the square adds a rounding error.
bool is_unit(const Point& p) { return std::abs(dot(p, p) - 1) <= 4 * 0x1p-53; }

// Throws InvalidInput if two places have the same direction, or get the same unit vector by
// rounding.
void require_apart(std::span<const Point> places, unsigned threads) {
  if (places.size() < 2) return;
  const Triangulation triangulation =
      delaunay(Sites::view(places), {}, Execution{.threads = threads});
  if (triangulation.duplicates().empty()) return;
  const auto [second, first] = triangulation.duplicates().front();
  throw InvalidInput(
      "fixed place " + std::to_string(second) + " is where place " + std::to_string(first) + " is",
      second);
}

}  // namespace

void require_places(std::span<const Point> places, const char* what) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point& p = places[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || p == Point{}) {
      throw InvalidInput(std::string(what) + " is not finite or the center", i);
    }
  }
}

std::vector<Point> unit_places(std::span<const Point> places) {
  std::vector<Point> result;
  result.reserve(places.size());
  for (const Point& p : places) {
    result.push_back(exact::to_point(normalized(scaled(exact::to_vector(p)))));
  }
  return result;
}

std::vector<Point> kept_units(std::span<const Point> places) {
  std::vector<Point> units = unit_places(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (is_unit(places[i])) units[i] = places[i];
  }
  return units;
}

std::vector<Index> take_nearest(std::vector<Point>& sites, std::span<const Point> places,
                                unsigned threads) {
  std::vector<Index> taken;
  if (places.empty()) return taken;
  const std::vector<Point> units = kept_units(places);
  require_apart(places, threads);
  require_apart(units, threads);
  const Triangulation triangulation =
      delaunay(Sites::view(sites), {}, Execution{.threads = threads});
  const Locator locator(triangulation);
  const std::size_t num_vertices = triangulation.num_vertices();
  std::vector<char> is_taken(sites.size(), 0);
  taken.reserve(units.size());
  for (const Point& place : units) {
    // The nearest sites may be taken already, so that more of them are asked for until one is free.
    constexpr std::size_t usually_enough = 8;
    for (std::size_t k = usually_enough;; k *= 4) {
      const std::vector<Index> near = locator.k_nearest(place, std::min(k, num_vertices));
      const auto at = std::ranges::find_if(near, [&](Index site) { return is_taken[site] == 0; });
      if (at != near.end()) {
        is_taken[*at] = 1;
        taken.push_back(*at);
        break;
      }
      // The remaining sites are duplicates, which relax() refuses.
      if (k >= num_vertices) throw InvalidInput("the sites have duplicates");
    }
  }
  for (std::size_t i = 0; i < units.size(); ++i) sites[taken[i]] = units[i];
  return taken;
}

}  // namespace rondel::mesh
