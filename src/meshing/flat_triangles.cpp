// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// leave_out_flat() takes triangles from the border inwards: those behind the sides of one that is left
// out are on the border then.
#include "meshing/flat_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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

using PlaneCorners = std::array<LonLat, 3>;

// Returns the corners in the plane, the first one's longitude as it is; nothing if the plane does not
// show the triangle, which has a corner at a pole or a pole inside.
std::optional<PlaneCorners> in_plane(const LonLat& a, const LonLat& b, const LonLat& c) {
  const PlaneCorners corners = {a, LonLat{turned_to(b.lon_deg, a.lon_deg), b.lat_deg},
                                LonLat{turned_to(c.lon_deg, a.lon_deg), c.lat_deg}};
  const auto [west, east] = std::ranges::minmax(corners, {}, &LonLat::lon_deg);
  const auto is_pole = [](const LonLat& p) { return std::abs(p.lat_deg) >= 90; };
  if (std::ranges::any_of(corners, is_pole) || east.lon_deg - west.lon_deg >= 180) return {};
  return corners;
}

Sign sign_of(const PlaneCorners& corners) {
  const auto [p, q, r] = corners;
  return orientation({p.lon_deg, p.lat_deg, 1}, {q.lon_deg, q.lat_deg, 1},
                     {r.lon_deg, r.lat_deg, 1});
}

// Heights in degrees up to this may come from rounding: nodes along a parallel have latitudes that
// differ by some 1e-14.
constexpr double rounded_height_deg = 1e-12;

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
      if (are_out_[t] || opposite != longest(t) || is_constraint(nodes) || !is_flat(t, opposite))
        continue;
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
  // True if the triangle has no area in the plane, or is no higher above the side opposite to a corner
  // than rounding makes it.
  [[nodiscard]] bool is_flat(Index t, unsigned opposite) const {
    const auto& [a, b, c] = triangles_[t];
    const auto corners = in_plane(positions_[a], positions_[b], positions_[c]);
    if (!corners) return false;
    if (sign_of(*corners) != Sign::positive) return true;
    const auto& [p, q, r] = *corners;
    const double area = (q.lon_deg - p.lon_deg) * (r.lat_deg - p.lat_deg) -
                        (q.lat_deg - p.lat_deg) * (r.lon_deg - p.lon_deg);
    return area <= rounded_height_deg * std::sqrt(squared_length(t, opposite));
  }
  // Returns the squared length in the plane of the side opposite to a corner.
  [[nodiscard]] double squared_length(Index t, unsigned opposite) const {
    const LonLat& p = positions_[triangles_[t][(opposite + 1) % 3]];
    const LonLat& q = positions_[triangles_[t][(opposite + 2) % 3]];
    const double east = turned_to(q.lon_deg, p.lon_deg) - p.lon_deg;
    const double north = q.lat_deg - p.lat_deg;
    return east * east + north * north;
  }
  // Returns the corner that is opposite to the longest side in the plane.
  [[nodiscard]] unsigned longest(Index t) const {
    const std::array squares = {squared_length(t, 0), squared_length(t, 1), squared_length(t, 2)};
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
  const auto corners = in_plane(a, b, c);
  return corners ? sign_of(*corners) : Sign::positive;
}

std::size_t require_area_in_degrees(std::span<const LonLat> positions,
                                    std::span<const Triple> triangles) {
  std::size_t num_clockwise = 0;
  for (Index t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Sign sign = sign_in_degrees(positions[a], positions[b], positions[c]);
    num_clockwise += sign == Sign::negative ? 1U : 0U;
    if (sign != Sign::zero) continue;
    throw InvalidInput("triangle " + std::to_string(t) + " at longitude " +
                           system::shortest_text(positions[a].lon_deg) + ", latitude " +
                           system::shortest_text(positions[a].lat_deg) +
                           " has no area in degrees: its corners are on one line",
                       t);
  }
  return num_clockwise;
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
