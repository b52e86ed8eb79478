// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/sound_positions.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "map/arc.h"
#include "map/longitudes.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/message_text.h"

namespace rondel::meshing {
namespace {

class PositionRepair {
 public:
  PositionRepair(const mesh::TriangleMesh& mesh, std::vector<LonLat> positions)
      : mesh_(mesh), positions_(std::move(positions)), points_(unit_vectors(positions_)) {}

  std::vector<LonLat> run() {
    std::vector<Index> bad;
    for (Index t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_positive(t)) bad.push_back(t);
    }
    if (!bad.empty()) list_stars(bad);
    // A node that has moved may let others move.
    constexpr int most_rounds = 4;
    for (int round = 0; round < most_rounds && !bad.empty(); ++round) {
      std::erase_if(bad, [&](Index t) { return is_positive(t) || turn(t); });
    }
    if (!bad.empty()) refuse(bad.front());
    return std::move(positions_);
  }

 private:
  [[nodiscard]] bool is_positive(Index t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return orientation(points_[a], points_[b], points_[c]) == Sign::positive;
  }

  // Lists the triangles around the corners of some.
  void list_stars(std::span<const Index> triangles) {
    std::vector<bool> is_corner(points_.size());
    for (const Index t : triangles) {
      for (const Index corner : mesh_.triangles[t]) is_corner[corner] = true;
    }
    for (Index t = 0; t < mesh_.triangles.size(); ++t) {
      for (const Index corner : mesh_.triangles[t]) {
        if (is_corner[corner]) stars_.emplace_back(corner, t);
      }
    }
    std::ranges::sort(stars_);
  }

  // Moves a corner such that the triangle is positive. Returns false if none can be moved so.
  bool turn(Index t) {
    return std::ranges::any_of(mesh_.triangles[t], [&](Index corner) { return move(corner); });
  }

  // A node whose position is exactly its own stays: triangles of such nodes are positive.
  bool move(Index node) {
    if (points_[node] == mesh_.points[node]) return false;
    const auto begin = std::ranges::lower_bound(stars_, std::pair{node, Index{0}});
    const auto end = std::ranges::lower_bound(stars_, std::pair{node + 1, Index{0}});
    const auto is_star_positive = [&] {
      return std::all_of(begin, end, [&](const auto& part) { return is_positive(part.second); });
    };
    const LonLat before = positions_[node];
    const Point point_before = points_[node];
    bool has_moved = false;
    constexpr double least_step = 1e-15;  // zero has no smaller neighbors that are of use
    map::visit_around(before, least_step, [&](const LonLat& candidate) {
      points_[node] = map::point_at(candidate);
      positions_[node] = candidate;
      has_moved = is_star_positive();
      return has_moved;
    });
    if (has_moved) return true;
    positions_[node] = before;
    points_[node] = point_before;
    return false;
  }

  [[noreturn]] void refuse(Index t) const {
    const LonLat& place = positions_[mesh_.triangles[t][0]];
    throw InvalidInput("triangle " + std::to_string(t) + " at longitude " +
                           system::shortest_text(place.lon_deg) + ", latitude " +
                           system::shortest_text(place.lat_deg) +
                           " is so narrow that it has no area in degrees",
                       t);
  }

  const mesh::TriangleMesh& mesh_;
  std::vector<LonLat> positions_;
  std::vector<Point> points_;
  std::vector<std::pair<Index, Index>> stars_;  // of some nodes: node, triangle
};

}  // namespace

std::vector<LonLat> sound_positions(const mesh::TriangleMesh& mesh, double west_deg) {
  std::vector<LonLat> positions = mesh.positions;
  if (positions.empty()) {
    positions = lonlats(mesh.points);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i].lon_deg = map::longitude_in_turn(positions[i].lon_deg, west_deg);
      positions[i] = map::shortened(positions[i], mesh.points[i]);
    }
  }
  return PositionRepair(mesh, std::move(positions)).run();
}

}  // namespace rondel::meshing
