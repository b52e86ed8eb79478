// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: list the chains of all features one after the other, number their places, and make a constraint of each arc.
#include "rondel/constrained_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "arrangement/arc_checks.h"
#include "arrangement/ring_arrays.h"
#include "map/arc.h"
#include "map/longitudes.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/distinct.h"
#include "system/job.h"

namespace rondel {
namespace constrained {
namespace {

// A line, or a ring, whose last corner is joined to its first one.
struct ChainKind {
  Index feature;
  bool is_ring;
};

// The lines and rings of features.
struct FeatureChains {
  CompressedRows<Point> points;
  std::vector<ChainKind> kinds;  // of each row

  void append(const Point& point, std::size_t feature) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
      throw InvalidInput("feature " + std::to_string(feature) + " has a point that is not finite",
                         feature);
    }
    points.values.push_back(point);
  }
  void end_chain(std::size_t feature, bool is_ring) {
    points.end_row();
    kinds.push_back({static_cast<Index>(feature), is_ring});
  }
};

FeatureChains chains_of(const FeatureLines& lines, const CellRings& polygons) {
  FeatureChains chains;
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t i = lines.offsets[f]; i < lines.offsets[f + 1]; ++i) {
      for (const Point& point : lines.rows[i]) chains.append(point, f);
      chains.end_chain(f, false);
    }
    for (std::uint64_t r = polygons.cells[f]; r < polygons.cells[f + 1]; ++r) {
      for (const Index corner : polygons.corners_of(r)) {
        chains.append(polygons.points[corner], f);
      }
      chains.end_chain(f, true);
    }
  }
  return chains;
}

// Returns each place once, in the order in which it occurs first, and the number of each point.
system::Distinct<Point> numbered(std::span<const Point> points) {
  if (points.size() > max_sites) throw InvalidInput("features have too many places");
  return system::distinct(points);
}

void require_fit(const FeatureLines& lines, const CellRings& polygons) {
  arrangement::validate_rows(lines);
  arrangement::validate_rings(polygons);
  if (lines.size() != polygons.num_cells()) {
    throw InvalidInput("there are not as many cells as groups of lines");
  }
  if (polygons.whole.empty()) return;
  const Index feature = polygons.whole.front();
  throw InvalidInput(
      "feature " + std::to_string(feature) + " is the whole sphere, which has no sides", feature);
}

}  // namespace
}  // namespace constrained

std::vector<LonLat> short_lonlats(std::span<const Point> points, double west_deg) {
  const system::ArithmeticScope arithmetic;
  std::vector<LonLat> positions = lonlats(points);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i].lon_deg = map::longitude_in_turn(positions[i].lon_deg, west_deg);
    const LonLat shorter = map::shortened(positions[i], points[i]);
    const bool is_short = !(shorter == positions[i]);
    positions[i] = is_short ? shorter : map::with_unit_vector(positions[i], points[i]);
  }
  return positions;
}

FeatureConstraints constraints_of_features(const FeatureLines& lines, const CellRings& polygons) {
  constrained::require_fit(lines, polygons);
  const constrained::FeatureChains chains = constrained::chains_of(lines, polygons);
  FeatureConstraints made;
  auto [places, numbers] = constrained::numbered(chains.points.values);
  made.sites = std::move(places);
  for (std::size_t c = 0; c < chains.kinds.size(); ++c) {
    const auto [feature, is_ring] = chains.kinds[c];
    while (made.polygons.size() < feature) made.polygons.end_row();
    const std::uint64_t begin = chains.points.offsets[c];
    const std::uint64_t end = chains.points.offsets[c + 1];
    for (std::uint64_t k = begin; k < end; ++k) {
      const bool is_last = k + 1 == end;
      const Index from = numbers[k];
      const Index to = numbers[is_last ? begin : k + 1];
      if (from == to || (is_last && !is_ring)) continue;
      if (is_ring) made.polygons.values.push_back(static_cast<Index>(made.constraints.size()));
      made.constraints.push_back({from, to});
      made.features.push_back(feature);
    }
  }
  while (made.polygons.size() < lines.size()) made.polygons.end_row();
  return made;
}

}  // namespace rondel
