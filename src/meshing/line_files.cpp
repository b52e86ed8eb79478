// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "meshing/line_files.h"

#include <cstddef>
#include <utility>

#include "io/geojson_polygons.h"

namespace rondel::meshing {

std::vector<std::vector<LonLat>> lines_of(const FileName& file) {
  io::PolygonFeatures features = io::read_polygon_features(file, io::FeatureKinds::all);
  std::vector<std::vector<LonLat>> all;
  for (std::size_t i = 0; i < features.rings.size(); ++i) {
    for (std::vector<LonLat>& line : features.lines[i]) all.push_back(std::move(line));
    for (io::LonLatRing& ring : features.rings[i]) {
      const LonLat closing = ring.positions.front();
      ring.positions.push_back(closing);
      all.push_back(std::move(ring.positions));
    }
  }
  return all;
}

}  // namespace rondel::meshing
