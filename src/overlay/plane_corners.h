// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds corners in the plane of longitude and latitude. Longitudes that differ by 360 degrees are
// the same.
//
// index owners: features
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "overlay/plane.h"
#include "rondel/types.h"
#include "system/row_assembly.h"

namespace rondel::overlay {

// Keeps each position once, in bands of one degree of latitude, sorted by longitude.
class PlaneCorners {
 public:
  // A corner and its feature.
  struct OwnedCorner {
    LonLat position;
    Index owner;  // no_index if several features have this position
  };

  explicit PlaneCorners(std::vector<OwnedCorner> corners) {
    for (OwnedCorner& corner : corners) {
      if (corner.position.lon_deg < -180 || corner.position.lon_deg > 180) {
        corner.position.lon_deg = std::remainder(corner.position.lon_deg, 360.0);
      }
      // The meridians at both ends of the map are the same line.
      if (corner.position.lon_deg == 180) corner.position.lon_deg = -180;
    }
    // Few corners are in one part of a band, so that nearly all of the sorting is counting.
    parts_ = std::clamp<std::size_t>(corners.size() / num_bands, 1, 3600);
    std::vector<Index> of_corners;
    of_corners.reserve(corners.size());
    system::RowPlaces<Index> places(num_bands * parts_);
    for (const OwnedCorner& corner : corners) {
      const LonLat& p = corner.position;
      of_corners.push_back(static_cast<Index>(band_of(p.lat_deg) * parts_ + part_of(p.lon_deg)));
      places.count(of_corners.back());
    }
    corners_.resize(places.sum());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      corners_[places.place(of_corners[k])] = corners[k];
    }
    unite_equal(std::move(places).offsets());
  }

  // Calls visit(position, owner) for the corners near a line that leads east or along a meridian:
  // all whose distances in longitude and in latitude are below these margins, and possibly others.
  // Positions are shifted to the line's own turn of the globe. Corners of one owner alone may be left
  // out where they are not shifted and not at the end of the map.
  template <class Visit>
  void visit_near(const LonLat& west, const LonLat& east, const LonLat& margins, const Visit& visit,
                  Index left_out = no_index) const {
    const double margin_deg = margins.lat_deg;
    const auto [south, north] = std::minmax(west.lat_deg, east.lat_deg);
    const double lowest = south - margin_deg - 1e-9;
    const double highest = north + margin_deg + 1e-9;
    const std::size_t first = band_of(south - margin_deg);
    const std::size_t last = band_of(north + margin_deg);
    for (std::size_t band = first; band <= last; ++band) {
      if (begins_[band * parts_] == begins_[(band + 1) * parts_]) continue;
      double low = west.lon_deg;
      double high = east.lon_deg;
      if (north > south && first < last) {
        // Only the part of the line in this band is searched, with a margin for rounding.
        const double floor = static_cast<double>(band) - 90 - margin_deg;
        const double ceiling = static_cast<double>(band) - 89 + margin_deg;
        const double run = (east.lon_deg - west.lon_deg) / (east.lat_deg - west.lat_deg);
        const double at_floor =
            west.lon_deg + (std::clamp(floor, south, north) - west.lat_deg) * run;
        const double at_ceiling =
            west.lon_deg + (std::clamp(ceiling, south, north) - west.lat_deg) * run;
        low = std::max(low, std::min(at_floor, at_ceiling) - 1e-9);
        high = std::min(high, std::max(at_floor, at_ceiling) + 1e-9);
      }
      visit_band(
          band, low - margins.lon_deg, high + margins.lon_deg,
          [&](const LonLat& p, Index owner) {
            if (p.lat_deg >= lowest && p.lat_deg <= highest) visit(p, owner);
          },
          left_out);
    }
  }

 private:
  static constexpr std::size_t num_bands = 180;  // one for each degree of latitude

  // Sorts the corners of each part, whose offsets are given, and unites those in one position.
  void unite_equal(std::vector<Index> offsets) {
    begins_ = std::move(offsets);
    owners_.assign(begins_.size() - 1, no_index);
    std::size_t kept = 0;
    for (std::size_t part = 0, from = 0; part + 1 < begins_.size(); ++part) {
      const std::size_t end = begins_[part + 1];
      sort_part(from, end);
      const std::size_t first = kept;
      begins_[part] = static_cast<Index>(kept);
      for (std::size_t k = std::exchange(from, end); k < end; ++k) {
        const OwnedCorner corner = corners_[k];
        if (kept > first && corners_[kept - 1].position == corner.position) {
          if (corners_[kept - 1].owner != corner.owner) corners_[kept - 1].owner = no_index;
        } else {
          corners_[kept++] = corner;
        }
      }
      if (kept == first) continue;
      const Index owner = corners_[first].owner;
      const bool is_shared =
          std::any_of(corners_.begin() + static_cast<std::ptrdiff_t>(first),
                      corners_.begin() + static_cast<std::ptrdiff_t>(kept),
                      [&](const OwnedCorner& corner) { return corner.owner != owner; });
      owners_[part] = is_shared ? no_index : owner;
    }
    begins_.back() = static_cast<Index>(kept);
    corners_.resize(kept);
  }

  // Sorts some corners by their positions.
  void sort_part(std::size_t from, std::size_t end) {
    constexpr std::size_t few = 24;
    const auto is_before = [](const OwnedCorner& p, const OwnedCorner& q) {
      return is_west_of(p.position, q.position);
    };
    if (end - from > few) {
      const auto begin = corners_.begin();
      std::sort(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(end),
                is_before);
      return;
    }
    for (std::size_t k = from + 1; k < end; ++k) {
      const OwnedCorner corner = corners_[k];
      std::size_t place = k;
      for (; place > from && is_before(corner, corners_[place - 1]); --place) {
        corners_[place] = corners_[place - 1];
      }
      corners_[place] = corner;
    }
  }

  // Returns the part of a band that has a longitude from -180 on. It does not decrease with longitudes.
  [[nodiscard]] std::size_t part_of(double lon_deg) const {
    const double turn = (lon_deg + 180) / 360;  // from 0 to below 1, but for rounding
    const double part = std::min(turn * static_cast<double>(parts_), 3600.0);
    return std::min(static_cast<std::size_t>(part), parts_ - 1);
  }
  static std::size_t band_of(double lat_deg) {
    return static_cast<std::size_t>(std::clamp(std::floor(lat_deg + 90), 0.0, 179.0));
  }

  // True if some parts have no corners but those of an owner.
  [[nodiscard]] bool are_of(Index owner, std::size_t first, std::size_t last) const {
    while (first <= last && (owners_[first] == owner || begins_[first] == begins_[first + 1])) {
      ++first;
    }
    return first > last;
  }

  template <class Visit>
  void visit_band(std::size_t number, double low, double high, const Visit& visit,
                  Index left_out) const {
    const std::span<const Index> parts = std::span(begins_).subspan(number * parts_, parts_ + 1);
    const OwnedCorner* const end = corners_.data() + parts.back();
    // Stored longitudes are at least -180 and below 180.
    const double first_turn = 360 * std::floor((low + 180) / 360);
    for (double turn = first_turn; turn - 180 <= high; turn += 360) {
      const double first = low - turn;
      const std::size_t first_part = part_of(std::max(first, -180.0));
      if (left_out != no_index && turn == 0 && first_part > 0 &&
          are_of(left_out, number * parts_ + first_part, number * parts_ + part_of(high))) {
        continue;
      }
      const OwnedCorner* corner = corners_.data() + parts[first_part];
      while (corner != end && corner->position.lon_deg < first) ++corner;
      for (; corner != end && corner->position.lon_deg + turn <= high; ++corner) {
        visit(LonLat{corner->position.lon_deg + turn, corner->position.lat_deg}, corner->owner);
      }
    }
  }

  std::vector<OwnedCorner> corners_;  // band by band
  std::size_t parts_ = 1;             // of each band
  std::vector<Index> begins_;         // of each part, band by band, and the end of the last one
  std::vector<Index> owners_;         // of all corners of a part, or no_index
};

}  // namespace rondel::overlay
