// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks that a GeoJSON file of polygons follows RFC 7946; the file is read by another program.
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"

namespace rondel::fuzz {

struct FeatureCount {
  std::size_t features = 0;
  double square_degrees = 0;           // all polygons together
  std::vector<std::size_t> not_drawn;  // features without a geometry
};

// Twice the area, in square degrees.
inline double check_ring(const nlohmann::json& ring) {
  require(ring.size() >= 4 && ring.front() == ring.back(), "a ring is closed");
  double twice_area = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const double lon = ring[i].at(0);
    const double lat = ring[i].at(1);
    const double next_lon = ring[i + 1].at(0);
    const double next_lat = ring[i + 1].at(1);
    require(std::abs(lon) <= 180 && std::abs(lat) <= 90, "a position is on the map");
    require(std::abs(lon - next_lon) <= 180 || (std::abs(lat) == 90 && lat == next_lat),
            "no side crosses the antimeridian");
    twice_area += (lon - next_lon) * (lat + next_lat);
  }
  return twice_area;
}

inline FeatureCount check_geojson(const std::string& text) {
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  require(!document.is_discarded(), "GeoJSON is JSON");
  FeatureCount found;
  for (const auto& feature : document.at("features")) {
    const auto& geometry = feature.at("geometry");
    if (geometry.is_null()) found.not_drawn.push_back(found.features);
    ++found.features;
    if (geometry.is_null()) continue;
    const bool is_one = geometry.at("type") == "Polygon";
    const auto& coordinates = geometry.at("coordinates");
    const auto polygons = is_one ? nlohmann::json::array({coordinates}) : coordinates;
    for (const auto& polygon : polygons) {
      for (const auto& ring : polygon) found.square_degrees += check_ring(ring) / 2;
    }
  }
  return found;
}

}  // namespace rondel::fuzz
