// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstdio>

#include "overlay/feature_polygons.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"

namespace rondel::overlay {

std::string text_of_place(const LonLat& place) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.10g %.10g", place.lon_deg, place.lat_deg);
  return text.data();
}
std::string text_of_place(const Point& place) {
  return text_of_place(lonlats(std::vector<Point>{place}).front());
}

std::string ring_name(const std::vector<map::LonLatRing>& rings, Index ring) {
  std::size_t part = 0;
  std::size_t in_part = 0;
  for (std::size_t r = 1; r <= ring; ++r) {
    part += rings[r].is_hole ? 0 : 1;
    in_part = rings[r].is_hole ? in_part + 1 : 0;
  }
  return "ring " + std::to_string(in_part) + " of part " + std::to_string(part);
}

void refuse_feature(const map::PolygonFeatures& features, std::size_t feature,
                    const std::string& what) {
  const auto [file, of_file] = features.place_of(feature);
  throw FeatureFault(file.name + ": feature " + feature_name(file.columns, of_file) + ": " + what,
                     feature, what);
}

}  // namespace rondel::overlay
