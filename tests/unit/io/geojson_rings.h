// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of GeoJSON, read back.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "unit/map/cells_planar.h"

namespace rondel::test {

inline nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

inline Ring ring_of(const nlohmann::json& coordinates) {
  Ring ring;
  for (const auto& position : coordinates) {
    ring.push_back({position[0].get<double>(), position[1].get<double>()});
  }
  return ring;
}

// The rings of all polygons of a document; checks their orientation, and where they are.
inline std::vector<Ring> checked_rings(const nlohmann::json& document, std::string_view name) {
  std::vector<Ring> rings;
  for (const auto& feature : document["features"]) {
    if (feature["geometry"].is_null()) continue;
    const nlohmann::json& geometry = feature["geometry"];
    const bool is_one = geometry["type"] == "Polygon";
    if (!is_one) {
      EXPECT_EQ(geometry["type"], "MultiPolygon");
    }
    const auto polygons =
        is_one ? nlohmann::json::array({geometry["coordinates"]}) : geometry["coordinates"];
    for (const auto& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Ring ring = ring_of(polygon[i]);
        EXPECT_GE(ring.size(), 4U);
        EXPECT_EQ(ring.front(), ring.back()) << name;
        EXPECT_GT(i == 0 ? planar_area(ring) : -planar_area(ring), 0) << name << " ring " << i;
        for (const LonLat& p : ring) {
          EXPECT_LE(std::abs(p.lon_deg), 180);
          EXPECT_LE(std::abs(p.lat_deg), 90);
        }
        rings.push_back(ring);
      }
    }
  }
  return rings;
}

}  // namespace rondel::test
