// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "overlay/plane_arcs.h"

namespace rondel::overlay {
namespace {

bool is_at_pole(const LonLat& p) { return std::abs(p.lat_deg) == 90; }

// True if exactly one end is a pole.
bool is_polar(const LonLat& p, const LonLat& q) { return is_at_pole(p) != is_at_pole(q); }

// Returns the longitude from -180 to below 180 of a meridian; exact.
double meridian_of(const LonLat& p) {
  const double lon = std::remainder(p.lon_deg, 360.0);
  return lon == 180 ? -180 : lon;
}

// The corners on the meridians of arcs to a pole.
class PolarCorners {
 public:
  PolarCorners(std::span<const PlaneSide> sides, const DividedSides& divided) {
    visit(sides, divided, [&](const LonLat& p, const LonLat& q) {
      if (is_polar(p, q)) meridians_.push_back(meridian_of(is_at_pole(p) ? q : p));
    });
    if (meridians_.empty()) return;
    std::ranges::sort(meridians_);
    meridians_.erase(std::unique(meridians_.begin(), meridians_.end()), meridians_.end());
    for (const LonLat& p : divided.values) add(p);
    for (const PlaneSide& side : sides) add(side.to);
    std::ranges::sort(corners_);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  }
  [[nodiscard]] bool is_empty() const { return corners_.empty(); }

  // Appends the corners between the ends of an arc, one of which is a pole, from p on.
  void append_between(const LonLat& p, const LonLat& q, std::vector<LonLat>& positions) const {
    const LonLat& foot = is_at_pole(p) ? q : p;
    const double meridian = meridian_of(foot);
    const double pole = is_at_pole(p) ? p.lat_deg : q.lat_deg;
    const double south = std::min(foot.lat_deg, pole);
    const double north = std::max(foot.lat_deg, pole);
    const std::size_t first = positions.size();
    auto corner = std::ranges::upper_bound(corners_, std::pair(meridian, south));
    for (; corner != corners_.end() && *corner < std::pair(meridian, north); ++corner) {
      positions.push_back({foot.lon_deg, corner->second});
    }
    if (p.lat_deg > q.lat_deg) {
      std::reverse(positions.begin() + static_cast<std::ptrdiff_t>(first), positions.end());
    }
  }

  // Calls take(from, to) for each part of each side.
  template <class Take>
  static void visit(std::span<const PlaneSide> sides, const DividedSides& divided,
                    const Take& take) {
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const std::uint64_t end = divided.offsets[s + 1];
      for (std::uint64_t k = divided.offsets[s]; k < end; ++k) {
        take(divided.values[k], k + 1 < end ? divided.values[k + 1] : sides[s].to);
      }
    }
  }

 private:
  void add(const LonLat& p) {
    if (is_at_pole(p)) return;
    const double meridian = meridian_of(p);
    if (std::ranges::binary_search(meridians_, meridian))
      corners_.emplace_back(meridian, p.lat_deg);
  }

  std::vector<double> meridians_;                   // in order
  std::vector<std::pair<double, double>> corners_;  // meridians and latitudes, in order
};

}  // namespace

void share_polar_corners(std::span<const PlaneSide> sides, DividedSides& divided) {
  const PolarCorners corners(sides, divided);
  if (corners.is_empty()) return;
  DividedSides shared;
  shared.values.reserve(divided.values.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const std::uint64_t end = divided.offsets[s + 1];
    for (std::uint64_t k = divided.offsets[s]; k < end; ++k) {
      const LonLat& from = divided.values[k];
      const LonLat& to = k + 1 < end ? divided.values[k + 1] : sides[s].to;
      shared.values.push_back(from);
      if (is_polar(from, to)) corners.append_between(from, to, shared.values);
    }
    shared.end_row();
  }
  divided = std::move(shared);
}

}  // namespace rondel::overlay
