// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of GeoJSON as regions of the plane, and the sides that only one of them has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/planar_check.h"

namespace rondel::test {

// Empty for a geometry that is null.
inline PlanarRegion region_of_geometry(const nlohmann::json& geometry) {
  PlanarRegion region;
  if (geometry.is_null()) return region;
  const bool is_one = geometry["type"] == "Polygon";
  const auto& coordinates = geometry["coordinates"];
  for (const auto& polygon : is_one ? nlohmann::json::array({coordinates}) : coordinates) {
    region.emplace_back();
    for (const auto& ring : polygon) {
      PlanarRing& positions = region.back().emplace_back();
      for (const auto& p : ring) positions.push_back({p[0].get<double>(), p[1].get<double>()});
    }
  }
  return region;
}

inline std::vector<PlanarRegion> regions_of_features(const nlohmann::json& document) {
  std::vector<PlanarRegion> regions;
  for (const auto& feature : document["features"])
    regions.push_back(region_of_geometry(feature["geometry"]));
  return regions;
}

// Sides inside of the map that no region has in the other direction as often.
inline std::size_t count_single_sides(const std::vector<PlanarRegion>& regions) {
  std::map<std::array<double, 4>, int> sides;
  for (const PlanarRegion& region : regions) {
    for (const PlanarPolygon& polygon : region) {
      for (const PlanarRing& ring : polygon) {
        for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
          const LonLat& p = ring[k];
          const LonLat& q = ring[k + 1];
          if (std::abs(p.lon_deg) == 180 && p.lon_deg == q.lon_deg) continue;
          if (std::abs(p.lat_deg) == 90 && p.lat_deg == q.lat_deg) continue;
          ++sides[{p.lon_deg, p.lat_deg, q.lon_deg, q.lat_deg}];
          --sides[{q.lon_deg, q.lat_deg, p.lon_deg, p.lat_deg}];
        }
      }
    }
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(sides, [](const auto& side) { return side.second > 0; }));
}

inline std::size_t count_positions(const std::vector<PlanarRegion>& regions) {
  std::size_t count = 0;
  for (const PlanarRegion& region : regions) {
    for (const PlanarPolygon& polygon : region) {
      for (const PlanarRing& ring : polygon) count += ring.size();
    }
  }
  return count;
}

}  // namespace rondel::test
