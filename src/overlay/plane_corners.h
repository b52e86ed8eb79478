// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds corners in the plane of longitude and latitude. Longitudes that differ by 360 degrees are
// the same.
//
// index owners: features
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "rondel/types.h"

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
      bands_[band_of(corner.position.lat_deg)].push_back(corner);
    }
    for (std::vector<OwnedCorner>& band : bands_) {
      std::ranges::sort(band,
                        [](const OwnedCorner& p, const OwnedCorner& q) { return key(p) < key(q); });
      std::size_t kept = 0;
      for (const OwnedCorner& corner : band) {
        if (kept > 0 && band[kept - 1].position == corner.position) {
          if (band[kept - 1].owner != corner.owner) band[kept - 1].owner = no_index;
        } else {
          band[kept++] = corner;
        }
      }
      band.resize(kept);
    }
  }

  // Calls visit(position, owner) for the corners near a line that leads east or along a meridian:
  // all whose distances in longitude and in latitude are below these margins, and possibly others.
  // Positions are shifted to the line's own turn of the globe.
  template <class Visit>
  void visit_near(const LonLat& west, const LonLat& east, const LonLat& margins,
                  const Visit& visit) const {
    const double margin_deg = margins.lat_deg;
    const auto [south, north] = std::minmax(west.lat_deg, east.lat_deg);
    const std::size_t last = band_of(north + margin_deg);
    for (std::size_t band = band_of(south - margin_deg); band <= last; ++band) {
      if (bands_[band].empty()) continue;
      double low = west.lon_deg;
      double high = east.lon_deg;
      if (north > south) {
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
      visit_band(bands_[band], low - margins.lon_deg, high + margins.lon_deg, visit);
    }
  }

 private:
  static std::pair<double, double> key(const OwnedCorner& corner) {
    return {corner.position.lon_deg, corner.position.lat_deg};
  }
  static std::size_t band_of(double lat_deg) {
    return static_cast<std::size_t>(std::clamp(std::floor(lat_deg + 90), 0.0, 179.0));
  }

  template <class Visit>
  static void visit_band(const std::vector<OwnedCorner>& band, double low, double high,
                         const Visit& visit) {
    // Stored longitudes are at least -180 and below 180.
    const double first_turn = 360 * std::floor((low + 180) / 360);
    for (double turn = first_turn; turn - 180 <= high; turn += 360) {
      auto corner = std::ranges::lower_bound(
          band, low - turn, {}, [](const OwnedCorner& c) { return c.position.lon_deg; });
      for (; corner != band.end() && corner->position.lon_deg + turn <= high; ++corner) {
        visit(LonLat{corner->position.lon_deg + turn, corner->position.lat_deg}, corner->owner);
      }
    }
  }

  std::array<std::vector<OwnedCorner>, 180> bands_;  // one for each degree of latitude
};

}  // namespace rondel::overlay
