// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "overlay/feature_polygons.h"
#include "overlay/plane.h"
#include "overlay/plane_corners.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t features_per_block = 16;

// True if two corners are too near to each other to be different corners of a side.
bool is_one_place(const LonLat& p, const LonLat& q) {
  return std::abs(p.lon_deg - q.lon_deg) <= 2 * on_side_deg &&
         std::abs(p.lat_deg - q.lat_deg) <= 2 * on_side_deg;
}

// Finds the corners on a side.
class SideCorners {
 public:
  SideCorners(const PlaneCorners& corners, Index feature) : corners_(corners), feature_(feature) {}

  // Returns the corners on a side between its ends, from its beginning on.
  const std::vector<LonLat>& operator()(const LonLat& from, const LonLat& to) {
    found_.clear();
    const bool goes_east = is_west_of(from, to);
    const LonLat& west = goes_east ? from : to;
    const LonLat& east = goes_east ? to : from;
    const double along = east.lon_deg - west.lon_deg;
    const double up = east.lat_deg - west.lat_deg;
    const double squared = along * along + up * up;
    const double most = on_side_deg * std::sqrt(squared);
    corners_.visit_near(west, east, {on_side_deg, on_side_deg}, [&](const LonLat& p, Index owner) {
      const double x = p.lon_deg - west.lon_deg;
      const double y = p.lat_deg - west.lat_deg;
      const double part = (x * along + y * up) / squared;
      if (std::abs(along * y - up * x) > most || part <= 0 || part >= 1) return;
      if (is_one_place(p, from) || is_one_place(p, to)) return;
      // A feature's own corners were judged by exact signs already, except for those shifted by 360
      // degrees, which are rounded.
      if (owner == feature_ && is_own(p)) return;
      found_.emplace_back(goes_east ? part : 1 - part, p);
    });
    std::ranges::sort(found_, [](const auto& p, const auto& q) {
      return p.first != q.first ? p.first < q.first : is_west_of(p.second, q.second);
    });
    positions_.clear();
    for (const auto& [part, position] : found_) {
      if (positions_.empty() || !is_one_place(positions_.back(), position))
        positions_.push_back(position);
    }
    return positions_;
  }

 private:
  // True if a corner has not been shifted by 360 degrees.
  static bool is_own(const LonLat& p) { return p.lon_deg > -180 && p.lon_deg < 180; }

  const PlaneCorners& corners_;
  Index feature_;
  std::vector<std::pair<double, LonLat>> found_;
  std::vector<LonLat> positions_;
};

// True if corners that move by rounding may make the ring run to and fro.
bool is_thin(const std::vector<LonLat>& positions) {
  const LonLat origin = positions.front();
  double area = 0;
  double length = 0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const LonLat& p = positions[k];
    const LonLat& q = positions[k + 1 < positions.size() ? k + 1 : 0];
    const double x = q.lon_deg - p.lon_deg;
    const double y = q.lat_deg - p.lat_deg;
    area += (p.lon_deg - origin.lon_deg) * y - (p.lat_deg - origin.lat_deg) * x;
    length += std::abs(x) + std::abs(y);
  }
  return std::abs(area) <= 8 * on_side_deg * length;
}

}  // namespace

void share_corners(std::vector<std::vector<map::LonLatRing>>& features, unsigned threads) {
  std::vector<PlaneCorners::OwnedCorner> all;
  for (std::size_t f = 0; f < features.size(); ++f) {
    for (const map::LonLatRing& ring : features[f]) {
      for (const LonLat& p : ring.positions) all.push_back({p, static_cast<Index>(f)});
    }
  }
  const PlaneCorners corners(std::move(all));
  system::parallel_for(
      threads, features.size(), features_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<LonLat> positions;
        for (std::size_t f = begin; f < end; ++f) {
          SideCorners corners_on(corners, static_cast<Index>(f));
          for (map::LonLatRing& ring : features[f]) {
            positions.clear();
            for (std::size_t k = 0; k < ring.positions.size(); ++k) {
              const LonLat& from = ring.positions[k];
              const LonLat& to = ring.positions[k + 1 < ring.positions.size() ? k + 1 : 0];
              positions.push_back(from);
              if (from == to) continue;
              const std::vector<LonLat>& between = corners_on(from, to);
              positions.insert(positions.end(), between.begin(), between.end());
            }
            if (positions.size() > ring.positions.size() && is_thin(ring.positions)) {
              ring.thin_positions = std::move(ring.positions);
            }
            ring.positions = positions;
          }
        }
      });
}

}  // namespace rondel::overlay
