// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks in rational numbers that the polygons of a GeoJSON file are valid geometries of the plane.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "support/planar_features.h"

namespace rondel::fuzz {

// Each feature is valid. If features cover the whole map, each side is one of two features.
inline void require_valid(const nlohmann::json& document, bool is_whole) {
  const std::vector<test::PlanarRegion> regions = test::regions_of_features(document);
  constexpr std::size_t most = 1500;  // the judge's time is quadratic
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (test::count_positions({regions[i]}) > most) continue;
    const std::string fault = test::why_invalid(regions[i]);
    require(fault.empty(), "feature " + std::to_string(i) + ": " + fault);
  }
  require(!is_whole || test::count_single_sides(regions) == 0, "borders are equal, bit by bit");
}

}  // namespace rondel::fuzz
