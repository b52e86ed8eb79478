// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Isolines and bands of heights at a few thousand sites, for a map.

#include "rondel/contours.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include "rondel/rondel.h"

namespace {

// Points on a spiral around the globe, and a smooth hill at each of two of them.
struct Heights {
  std::vector<rondel::Point> sites;
  std::vector<double> values;
};

Heights make_heights() {
  Heights heights;
  constexpr int count = 5000;
  constexpr double golden_deg = 137.50776405003785;
  for (int i = 0; i < count; ++i) {
    const double lat = 90 - 180 * (i + 0.5) / count;
    const rondel::Point p = rondel::unit_vector({i * golden_deg, lat});
    heights.sites.push_back(p);
    heights.values.push_back(100 * p.x * p.x + 60 * p.y * p.z);
  }
  return heights;
}

void draw_contours() {
  const Heights heights = make_heights();
  const rondel::Triangulation triangulation = rondel::delaunay(heights.sites);
  const std::vector<double> levels = {0, 25, 50, 75};

  const rondel::Isolines lines = rondel::isolines(triangulation, heights.values, levels);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    std::printf("level %g: %d lines\n", levels[k],
                static_cast<int>(lines.lines.offsets[k + 1] - lines.lines.offsets[k]));
  }
  const auto folder = std::filesystem::temp_directory_path();
  rondel::write_isolines(folder / "rondel-isolines.geojson", lines);

  const rondel::Bands bands = rondel::bands(triangulation, heights.values, levels);
  std::printf("%d bands of %d polygons\n", static_cast<int>(bands.num_bands()),
              static_cast<int>(bands.num_polygons()));
  rondel::write_bands(folder / "rondel-bands.geojson", bands);
}

}  // namespace

int main() {
  try {
    draw_contours();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contours: %s\n", error.what());
    return 1;
  }
}
