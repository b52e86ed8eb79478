// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/face_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "map/arc.h"
#include "map/line_troubles.h"
#include "map/settled_regions.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

constexpr double largest_tolerance_deg = 0.01;
constexpr double min_tolerance_deg = 1e-5;
constexpr std::size_t faces_per_piece = 1024;

// True if no two corners are antipodes up to rounding, so that doubles determine the arcs between
// them. A solid face has no antipodes among its corners, but they may become antipodes when they
// are rounded.
bool is_determined(const std::array<Point, 3>& ring) {
  const auto are_opposite = [](const Point& p, const Point& q) {
    return norm(p + q) <= merge_distance;
  };
  return !are_opposite(ring[0], ring[1]) && !are_opposite(ring[1], ring[2]) &&
         !are_opposite(ring[2], ring[0]);
}

}  // namespace

FaceMap::FaceMap(const Triangulation& triangulation, const Execution& execution)
    : triangulation_(triangulation),
      directions_(triangulation.num_sites()),
      positions_(triangulation.num_sites()),
      tolerances_deg_(triangulation.num_faces()) {
  constexpr std::size_t grain = 4096;
  const std::span<const Point> sites = triangulation.sites().points();
  const Point& center = triangulation.sphere().center;
  system::parallel_for(execution.threads, sites.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           directions_[i] = direction(sites[i], center);
                           positions_[i] = map_point(snapped(directions_[i])).position;
                         }
                       });
  system::parallel_for(execution.threads, tolerances_deg_.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           tolerances_deg_[i] = tolerance(static_cast<Index>(i));
                         }
                       });
  if (has_trouble(execution)) settle(execution);
}

bool FaceMap::has_trouble(const Execution& execution) const {
  std::atomic<bool> found{false};
  system::parallel_for(
      execution.threads, tolerances_deg_.size(), faces_per_piece,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !found; ++i) {
          const auto face = static_cast<Index>(i);
          if (!triangulation_.is_ghost(face) && !is_plain(face) && is_in_trouble(loops_of(face)))
            found = true;
        }
      });
  return found;
}

void FaceMap::settle(const Execution& execution) {
  std::vector<std::vector<DirectedLine>> sides(tolerances_deg_.size());
  system::parallel_for(execution.threads, sides.size(), faces_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           const auto face = static_cast<Index>(i);
                           if (!triangulation_.is_ghost(face))
                             sides[i] = sides_of_loops(loops_of(face));
                         }
                       });
  settled_ = settled_convex_regions(sides, execution.threads);
}

std::vector<Loop> FaceMap::loops_of(Index face) const {
  const auto& [a, b, c] = triangulation_.faces()[face];
  if (is_plain(face)) return {{positions_[a], positions_[b], positions_[c]}};
  const Corners corners = ring(face);
  if (!is_determined(corners)) return {};
  return lonlat_loops(corners, tolerances(face));
}

bool FaceMap::is_plain(Index face) const {
  const auto& [a, b, c] = triangulation_.faces()[face];
  const std::array<LonLat, 3> positions = {positions_[a], positions_[b], positions_[c]};
  return is_plain(ring(face), positions, tolerances(face));
}

const std::vector<LonLatPolygon>& FaceMap::polygons(Index face, Pen& pen) const {
  if (!settled_.empty()) return settled_[face];
  const auto& [a, b, c] = triangulation_.faces()[face];
  const Corners corners = ring(face);
  if (is_plain(face)) {
    pen.resize(1);
    pen.front().ring.assign({positions_[a], positions_[b], positions_[c], positions_[a]});
  } else if (is_determined(corners)) {
    pen = lonlat_polygons(corners, tolerances(face));
  } else {
    pen.clear();
  }
  return pen;
}

// True if a cheap test finds that the face is drawn as the polygon of its corners.
bool FaceMap::is_plain(const Corners& corners, std::span<const LonLat> positions,
                       const std::array<double, 3>& tolerances_deg) const {
  std::array<MapPoint, 3> ends;
  for (std::size_t i = 0; i < 3; ++i) ends[i] = {snapped(corners[i]), positions[i]};
  for (std::size_t i = 0; i < 3; ++i) {
    const MapPoint& from = ends[i];
    const MapPoint& to = ends[(i + 1) % 3];
    if (!is_surely_one_line(from, to, tolerances_deg[i] / degrees_per_radian)) return false;
  }
  return is_plain_loop(positions);
}

// Returns the corners of a face as unit vectors.
FaceMap::Corners FaceMap::ring(Index face) const {
  const auto& [a, b, c] = triangulation_.faces()[face];
  return {directions_[a], directions_[b], directions_[c]};
}

// Returns the tolerances of the edges 01, 12 and 20 in degrees: for each the smaller one of the two
// faces at the edge.
std::array<double, 3> FaceMap::tolerances(Index face) const {
  const auto& neighbors = triangulation_.neighbors()[face];
  const double own = tolerances_deg_[face];
  const auto edge = [&](std::size_t opposite) {
    const Index neighbor = neighbors[opposite];
    return triangulation_.is_ghost(neighbor) ? own : std::min(own, tolerances_deg_[neighbor]);
  };
  return {edge(2), edge(0), edge(1)};
}

double FaceMap::tolerance(Index face) const {
  const auto [a, b, c] = ring(face);
  const Point ab = b - a;
  const Point bc = c - b;
  const double longest = std::max({norm(ab), norm(bc), norm(a - c)});
  if (longest == 0) return min_tolerance_deg;  // the corners are one point after rounding
  const double height_deg = norm(cross(ab, bc)) / longest * degrees_per_radian;
  return std::clamp(height_deg / 10, min_tolerance_deg, largest_tolerance_deg);
}

}  // namespace rondel::map
