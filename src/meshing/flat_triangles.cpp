// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// leave_out_flat() takes triangles from the border inwards: those behind the sides of one that is left
// out are on the border then.
#include "meshing/flat_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/triangle_mesh.h"
#include "system/message_text.h"

namespace rondel {
namespace meshing {
namespace {

// Returns the longitude in the turn around another one.
double turned_to(double lon_deg, double other_deg) {
  const double turns = std::round((other_deg - lon_deg) / 360);
  return turns == 0 ? lon_deg : lon_deg + 360 * turns;
}

// The corners in the plane, the first one's longitude as it is.
std::array<LonLat, 3> in_plane(const LonLat& a, const LonLat& b, const LonLat& c) {
  return {a, LonLat{turned_to(b.lon_deg, a.lon_deg), b.lat_deg},
          LonLat{turned_to(c.lon_deg, a.lon_deg), c.lat_deg}};
}

// A side of a triangle, the lower node first. Sides are sorted, so that the two of an edge are next to
// each other.
struct PlaneSide {
  std::array<Index, 2> nodes;
  Index triangle;
  unsigned opposite;  // the corner
  friend auto operator<=>(const PlaneSide&, const PlaneSide&) = default;
};

class FlatTriangles {
 public:
  FlatTriangles(std::span<const LonLat> positions, std::span<const Triple> triangles,
                std::span<const std::array<Index, 2>> constraints)
      : positions_(positions), triangles_(triangles), are_out_(triangles.size()) {
    for (auto [a, b] : constraints) constraints_.push_back({std::min(a, b), std::max(a, b)});
    std::ranges::sort(constraints_);
    for (Index t = 0; t < triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) sides_.push_back({nodes_of(t, i), t, i});
    }
    std::ranges::sort(sides_);
  }

  // Returns for each triangle whether it is left out.
  std::vector<bool> run() {
    std::vector<PlaneSide> open;
    for (const PlaneSide& side : sides_) {
      if (sides_of(side.nodes).size() == 1) open.push_back(side);
    }
    while (!open.empty()) {
      const auto [nodes, t, opposite] = open.back();
      open.pop_back();
      if (are_out_[t] || opposite != longest(t) || is_constraint(nodes) || has_area(t)) continue;
      are_out_[t] = true;
      for (unsigned i = 0; i < 3; ++i) {
        if (i == opposite) continue;
        for (const PlaneSide& behind : sides_of(nodes_of(t, i))) {
          if (behind.triangle != t) open.push_back(behind);
        }
      }
    }
    return std::move(are_out_);
  }

 private:
  [[nodiscard]] std::array<Index, 2> nodes_of(Index t, unsigned opposite) const {
    const Index a = triangles_[t][(opposite + 1) % 3];
    const Index b = triangles_[t][(opposite + 2) % 3];
    return {std::min(a, b), std::max(a, b)};
  }
  // Returns the sides between two nodes.
  [[nodiscard]] std::span<const PlaneSide> sides_of(const std::array<Index, 2>& nodes) const {
    const auto begin = std::ranges::lower_bound(sides_, nodes, {}, &PlaneSide::nodes);
    const auto end = std::ranges::upper_bound(sides_, nodes, {}, &PlaneSide::nodes);
    return {begin, end};
  }
  [[nodiscard]] bool is_constraint(const std::array<Index, 2>& nodes) const {
    return std::ranges::binary_search(constraints_, nodes);
  }
  [[nodiscard]] bool has_area(Index t) const {
    const auto& [a, b, c] = triangles_[t];
    return sign_in_degrees(positions_[a], positions_[b], positions_[c]) == Sign::positive;
  }
  // Returns the corner that is opposite to the longest side in the plane.
  [[nodiscard]] unsigned longest(Index t) const {
    const auto& [a, b, c] = triangles_[t];
    const auto corners = in_plane(positions_[a], positions_[b], positions_[c]);
    std::array<double, 3> squares{};
    for (unsigned i = 0; i < 3; ++i) {
      const LonLat& p = corners[(i + 1) % 3];
      const LonLat& q = corners[(i + 2) % 3];
      const double east = q.lon_deg - p.lon_deg;
      const double north = q.lat_deg - p.lat_deg;
      squares[i] = east * east + north * north;
    }
    return static_cast<unsigned>(std::ranges::max_element(squares) - squares.begin());
  }

  std::span<const LonLat> positions_;
  std::span<const Triple> triangles_;
  std::vector<std::array<Index, 2>> constraints_;  // the lower node first, sorted
  std::vector<PlaneSide> sides_;                   // sorted
  std::vector<bool> are_out_;
};

}  // namespace

// The determinant of (longitude, latitude, 1) is twice the area.
Sign sign_in_degrees(const LonLat& a, const LonLat& b, const LonLat& c) {
  const auto is_pole = [](const LonLat& p) { return std::abs(p.lat_deg) >= 90; };
  if (is_pole(a) || is_pole(b) || is_pole(c)) return Sign::positive;
  const auto [p, q, r] = in_plane(a, b, c);
  const double widest = std::max({std::abs(q.lon_deg - p.lon_deg), std::abs(r.lon_deg - p.lon_deg),
                                  std::abs(r.lon_deg - q.lon_deg)});
  if (widest >= 180) return Sign::positive;
  return orientation({p.lon_deg, p.lat_deg, 1}, {q.lon_deg, q.lat_deg, 1},
                     {r.lon_deg, r.lat_deg, 1});
}

void require_area_in_degrees(std::span<const LonLat> positions, std::span<const Triple> triangles) {
  for (Index t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (sign_in_degrees(positions[a], positions[b], positions[c]) != Sign::zero) continue;
    throw InvalidInput("triangle " + std::to_string(t) + " at longitude " +
                           system::shortest_text(positions[a].lon_deg) + ", latitude " +
                           system::shortest_text(positions[a].lat_deg) +
                           " has no area in degrees: its corners are on one line",
                       t);
  }
}

}  // namespace meshing

std::size_t mesh::leave_out_flat(std::span<const LonLat> positions, std::vector<Triple>& triangles,
                                 std::span<const std::array<Index, 2>> constraints) {
  for (Index t = 0; t < triangles.size(); ++t) {
    const auto is_node = [&](Index corner) { return corner < positions.size(); };
    if (!std::ranges::all_of(triangles[t], is_node)) {
      throw InvalidInput("triangle " + std::to_string(t) + " has a corner that is no node", t);
    }
  }
  const std::vector<bool> are_out = meshing::FlatTriangles(positions, triangles, constraints).run();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < are_out.size(); ++t) {
    if (!are_out[t]) triangles[kept++] = triangles[t];
  }
  const std::size_t number = triangles.size() - kept;
  triangles.resize(kept);
  return number;
}

}  // namespace rondel
