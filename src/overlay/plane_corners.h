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
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

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
    constexpr std::size_t per_part = 4;
    const std::size_t parts =
        std::clamp<std::size_t>(corners.size() / (num_bands * per_part), 1, 3600);
    const auto part_of = [parts](const LonLat& p) {
      const double turn = (p.lon_deg + 180) / 360;  // from 0 to below 1, but for rounding
      const auto part = static_cast<std::size_t>(turn * static_cast<double>(parts));
      return band_of(p.lat_deg) * parts + std::min(part, parts - 1);
    };
    system::RowPlaces places(num_bands * parts);
    for (const OwnedCorner& corner : corners) places.count(part_of(corner.position));
    corners_.resize(places.sum());
    for (const OwnedCorner& corner : corners) {
      corners_[places.place(part_of(corner.position))] = corner;
    }
    unite_equal(std::move(places).offsets(), parts);
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
      if (begins_[band] == begins_[band + 1]) continue;
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
      visit_band(band, low - margins.lon_deg, high + margins.lon_deg, visit);
    }
  }

 private:
  static constexpr std::size_t num_bands = 180;  // one for each degree of latitude

  // Sorts the corners of each part, whose offsets are given, and unites those in one position.
  void unite_equal(const std::vector<std::uint64_t>& offsets, std::size_t parts) {
    const auto begin = corners_.begin();
    std::size_t kept = 0;
    for (std::size_t part = 0; part + 1 < offsets.size(); ++part) {
      if (part % parts == 0) begins_[part / parts] = kept;
      std::sort(begin + static_cast<std::ptrdiff_t>(offsets[part]),
                begin + static_cast<std::ptrdiff_t>(offsets[part + 1]),
                [](const OwnedCorner& p, const OwnedCorner& q) { return key(p) < key(q); });
      const std::size_t first = kept;
      for (std::uint64_t k = offsets[part]; k < offsets[part + 1]; ++k) {
        const OwnedCorner corner = corners_[k];
        if (kept > first && corners_[kept - 1].position == corner.position) {
          if (corners_[kept - 1].owner != corner.owner) corners_[kept - 1].owner = no_index;
        } else {
          corners_[kept++] = corner;
        }
      }
    }
    begins_[num_bands] = kept;
    corners_.resize(kept);
  }

  static std::pair<double, double> key(const OwnedCorner& corner) {
    return {corner.position.lon_deg, corner.position.lat_deg};
  }
  static std::size_t band_of(double lat_deg) {
    return static_cast<std::size_t>(std::clamp(std::floor(lat_deg + 90), 0.0, 179.0));
  }

  template <class Visit>
  void visit_band(std::size_t number, double low, double high, const Visit& visit) const {
    const std::span band =
        std::span(corners_).subspan(begins_[number], begins_[number + 1] - begins_[number]);
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

  std::vector<OwnedCorner> corners_;  // band by band
  std::array<std::size_t, num_bands + 1> begins_{};
};

}  // namespace rondel::overlay
