// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
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

// The positions of files that are a turn of the globe away, whose longitudes are rounded more
// coarsely than others.
class TurnedPositions {
 public:
  // Takes a position that is a turn away, and passes by others.
  void add(const LonLat& p) {
    if (std::abs(p.lon_deg) <= 180) return;
    turned_.push_back({p.lat_deg, reduced(p), std::abs(p.lon_deg)});
    nearest_ = std::min(nearest_, std::abs(turned_.back()[1]) - 3 * on_side_deg);
  }
  // Ends the additions.
  void sort() {
    std::ranges::sort(turned_);
    turned_.erase(std::unique(turned_.begin(), turned_.end()), turned_.end());
  }
  [[nodiscard]] bool is_empty() const { return turned_.empty(); }

  // Moves positions to the coarsest ones that are the same place up to rounding. These are
  // representable on every turn nearer to the map. Returns the positions before if any has moved.
  [[nodiscard]] std::optional<std::vector<LonLat>> move(std::vector<LonLat>& positions) const {
    std::optional<std::vector<LonLat>> before;
    for (LonLat& p : positions) {
      const double lon = reduced(p);
      if (std::abs(lon) < nearest_) continue;
      Turned best = {p.lat_deg, lon, std::abs(p.lon_deg)};
      const auto first =
          std::ranges::lower_bound(turned_, Turned{p.lat_deg, lon - 2 * on_side_deg, 0});
      for (auto q = first; q != turned_.end() && (*q)[0] == p.lat_deg; ++q) {
        if ((*q)[1] > lon + 2 * on_side_deg) break;
        if ((*q)[2] > best[2]) best = *q;
      }
      if (best[1] == lon) continue;
      if (!before) before = positions;
      p.lon_deg = best[1] + (p.lon_deg - lon);
    }
    return before;
  }

 private:
  // Latitude, longitude from -180 to 180, and how far the given longitude is from 0: degrees.
  using Turned = std::array<double, 3>;

  // Returns a longitude from -180 to 180; exact.
  static double reduced(const LonLat& p) {
    return std::abs(p.lon_deg) > 180 ? std::remainder(p.lon_deg, 360.0) : p.lon_deg;
  }

  std::vector<Turned> turned_;
  double nearest_ = 180;  // no turned position is as near to longitude 0 as this
};

// Finds the corners on a side.
class SideCorners {
 public:
  SideCorners(const PlaneCorners& corners, Index feature) : corners_(corners), feature_(feature) {}

  // Returns a ring with the corners on its sides, or a line.
  [[nodiscard]] std::vector<LonLat> along(const std::vector<LonLat>& positions, bool is_ring,
                                          bool is_shorter) {
    std::vector<LonLat> result;
    const std::size_t size = positions.size();
    result.reserve(size);
    for (std::size_t k = 0; k < size; ++k) {
      const LonLat& from = positions[k];
      result.push_back(from);
      if (k + 1 == size && !is_ring) break;
      LonLat to = positions[k + 1 < size ? k + 1 : 0];
      if (is_shorter && std::abs(to.lon_deg - from.lon_deg) > 180) {
        to = map::end_of_shorter(from, to);
      }
      if (from == to) continue;
      const std::vector<LonLat>& between = on_side(from, to);
      result.insert(result.end(), between.begin(), between.end());
    }
    return result;
  }

 private:
  // Returns the corners on a side between its ends, from its beginning on.
  const std::vector<LonLat>& on_side(const LonLat& from, const LonLat& to) {
    found_.clear();
    const bool goes_east = is_west_of(from, to);
    const LonLat& west = goes_east ? from : to;
    const LonLat& east = goes_east ? to : from;
    const double along = east.lon_deg - west.lon_deg;
    const double up = east.lat_deg - west.lat_deg;
    const double squared = along * along + up * up;
    const double most = on_side_deg * std::sqrt(squared);
    const auto take = [&](const LonLat& p, Index owner) {
      // A feature's own corners were judged by exact signs already, except for those shifted by 360
      // degrees, which are rounded.
      if (owner == feature_ && is_own(p)) return;
      const double x = p.lon_deg - west.lon_deg;
      const double y = p.lat_deg - west.lat_deg;
      const double part = (x * along + y * up) / squared;
      if (std::abs(along * y - up * x) > most || part <= 0 || part >= 1) return;
      if (is_one_place(p, from) || is_one_place(p, to)) return;
      found_.emplace_back(goes_east ? part : 1 - part, p);
    };
    corners_.visit_near(west, east, {on_side_deg, on_side_deg}, take, feature_);
    positions_.clear();
    if (found_.empty()) return positions_;
    std::ranges::sort(found_, [](const auto& p, const auto& q) {
      return p.first != q.first ? p.first < q.first : is_west_of(p.second, q.second);
    });
    for (const auto& [part, position] : found_) {
      if (positions_.empty() || !is_one_place(positions_.back(), position))
        positions_.push_back(position);
    }
    return positions_;
  }

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

// Calls visit(positions, ring) for all rings and lines; the ring of a line is null.
template <class Visit>
void visit_positions(map::PolygonFeatures& features, const Visit& visit) {
  for (std::vector<map::LonLatRing>& rings : features.rings) {
    for (map::LonLatRing& ring : rings) visit(ring.positions, &ring);
  }
  for (std::vector<std::vector<LonLat>>& lines : features.lines) {
    for (std::vector<LonLat>& line : lines) visit(line, nullptr);
  }
}

// Makes positions equal that are the same but for the rounding of a turn of the globe.
void share_rounding(map::PolygonFeatures& features) {
  TurnedPositions turned;
  visit_positions(features, [&](const std::vector<LonLat>& positions, const void* /*ring*/) {
    for (const LonLat& p : positions) turned.add(p);
  });
  if (turned.is_empty()) return;
  turned.sort();
  visit_positions(features, [&](std::vector<LonLat>& positions, map::LonLatRing* ring) {
    std::optional<std::vector<LonLat>> before = turned.move(positions);
    if (before && ring != nullptr && is_thin(*before)) ring->thin_positions = std::move(*before);
  });
}

// True if sides of the rings meet in a corner that has been inserted: a place that occurs several
// times, and more often than in `before`.
bool has_met(const std::vector<map::LonLatRing>& before,
             const std::vector<std::vector<LonLat>>& after) {
  std::vector<LonLat> own;
  std::vector<LonLat> all;
  for (std::size_t r = 0; r < before.size(); ++r) {
    own.insert(own.end(), before[r].positions.begin(), before[r].positions.end());
    all.insert(all.end(), after[r].begin(), after[r].end());
  }
  std::ranges::sort(own, IsWestOf{});
  std::ranges::sort(all, IsWestOf{});
  for (auto first = all.begin(); first != all.end();) {
    const auto past =
        std::ranges::find_if(first, all.end(), [&](const LonLat& p) { return !(p == *first); });
    const auto [own_first, own_past] = std::equal_range(own.begin(), own.end(), *first, IsWestOf{});
    if (past - first > 1 && past - first > own_past - own_first) return true;
    first = past;
  }
  return false;
}

// True if there is one feature, without lines, and it is far from the antimeridian: then all corners
// near its sides are its own.
bool is_alone(const map::PolygonFeatures& features) {
  if (features.rings.size() != 1) return false;
  const bool has_lines =
      std::ranges::any_of(features.lines, [](const auto& lines) { return !lines.empty(); });
  constexpr double far_deg = 179;
  const auto is_far = [](const LonLat& p) { return std::abs(p.lon_deg) < far_deg; };
  return !has_lines && std::ranges::all_of(features.rings.front(), [&](const auto& ring) {
    return !ring.is_shorter && std::ranges::all_of(ring.positions, is_far);
  });
}

std::size_t num_positions(const map::PolygonFeatures& features) {
  std::size_t count = 0;
  for (const auto& rings : features.rings) {
    for (const map::LonLatRing& ring : rings) count += ring.positions.size();
  }
  for (const auto& lines : features.lines) {
    for (const std::vector<LonLat>& line : lines) count += line.size();
  }
  return count;
}

// Inserts corners of others into the sides on which they lie. Returns the features in which sides
// meet there.
std::vector<FeatureBefore> insert_corners(map::PolygonFeatures& features, unsigned threads) {
  if (is_alone(features)) return {};
  const std::size_t size = features.rings.size();
  // Corners of lines belong to none of the features, as no exact sign has judged them.
  const auto of_lines = static_cast<Index>(size);
  std::vector<PlaneCorners::OwnedCorner> all;
  all.reserve(num_positions(features));
  for (std::size_t f = 0; f < size; ++f) {
    for (const map::LonLatRing& ring : features.rings[f]) {
      for (const LonLat& p : ring.positions) all.push_back({p, static_cast<Index>(f)});
    }
  }
  for (const auto& lines : features.lines) {
    for (const std::vector<LonLat>& line : lines) {
      for (const LonLat& p : line) all.push_back({p, of_lines});
    }
  }
  const PlaneCorners corners(std::move(all));
  std::vector<std::vector<map::LonLatRing>> met(size);
  system::parallel_for(threads, size, features_per_block, [&](std::size_t begin, std::size_t end) {
    SideCorners any(corners, of_lines + 1);
    for (std::size_t f = begin; f < end; ++f) {
      SideCorners others(corners, static_cast<Index>(f));
      std::vector<map::LonLatRing>& rings = features.rings[f];
      std::vector<std::vector<LonLat>> made;
      bool has_more = false;
      for (const map::LonLatRing& ring : rings) {
        made.push_back(others.along(ring.positions, true, ring.is_shorter));
        has_more = has_more || made.back().size() > ring.positions.size();
      }
      if (has_more && has_met(rings, made)) met[f] = rings;
      for (std::size_t r = 0; r < rings.size(); ++r) {
        map::LonLatRing& ring = rings[r];
        if (made[r].size() > ring.positions.size() && ring.thin_positions.empty() &&
            is_thin(ring.positions)) {
          ring.thin_positions = std::move(ring.positions);
        }
        ring.positions = std::move(made[r]);
      }
      if (features.lines.empty()) continue;
      for (std::vector<LonLat>& line : features.lines[f]) line = any.along(line, false, true);
    }
  });
  std::vector<FeatureBefore> found;
  for (std::size_t f = 0; f < size; ++f) {
    if (!met[f].empty()) found.push_back({f, std::move(met[f])});
  }
  return found;
}

}  // namespace

std::vector<FeatureBefore> share_corners(map::PolygonFeatures& features, unsigned threads) {
  share_rounding(features);
  std::vector<FeatureBefore> met = insert_corners(features, threads);
  // Corners that were inserted on another turn are rounded again.
  share_rounding(features);
  return met;
}

}  // namespace rondel::overlay
