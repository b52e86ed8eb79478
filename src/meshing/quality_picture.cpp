// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws a report as SVG: histograms above, a map of the worst cells below.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "exact/angles.h"
#include "meshing/picture_parts.h"
#include "rondel/mesh_quality.h"

namespace rondel::mesh {
namespace {

using meshing::bars;
using meshing::begin_picture;
using meshing::fixed;
using meshing::map_top;
using meshing::margin;
using meshing::text_at;

// Positions are in pixels from the corner at the top left; y grows downward.
constexpr double map_width = 900;
constexpr double map_height = map_width / 2;
constexpr double picture_height = 760;

// Returns the cells with the largest values (sign 1) or smallest (sign -1); of equals the lower
// number comes first.
std::vector<Index> largest(const std::vector<double>& values, std::size_t count, double sign) {
  std::vector<Index> cells(values.size());
  std::iota(cells.begin(), cells.end(), Index{0});
  count = std::min(count, cells.size());
  std::ranges::partial_sort(cells, cells.begin() + static_cast<std::ptrdiff_t>(count),
                            [&](Index a, Index b) {
                              const double x = sign * values[a];
                              const double y = sign * values[b];
                              return x != y ? x > y : a < b;
                            });
  cells.resize(count);
  return cells;
}

// Returns a dot for each cell on the map, in the plane of longitude and latitude.
std::string dots(const VoronoiMesh& arrays, const std::vector<Index>& cells, const char* color,
                 double radius) {
  constexpr double turn = 2 * std::numbers::pi;
  std::string svg = std::string(R"(<g fill="none" stroke=")") + color + "\">\n";
  for (const Index cell : cells) {
    const Point& p = arrays.cell_points[cell];
    const double lon = exact::argument(p.y, p.x);
    const double lat = exact::argument(p.z, std::sqrt(p.x * p.x + p.y * p.y));
    svg += "<circle cx=\"" + fixed(margin + map_width * (lon / turn + 0.5)) + "\" cy=\"" +
           fixed(map_top + map_width * (0.25 - lat / turn)) + "\" r=\"" + fixed(radius) +
           "\"><title>cell " + std::to_string(cell) + "</title></circle>\n";
  }
  return svg + "</g>\n";
}

// Returns meridians and parallels of the map, 30 degrees apart.
std::string map_lines() {
  std::string path;
  for (int i = 0; i <= 12; ++i) {
    path +=
        'M' + fixed(margin + map_width * i / 12) + ' ' + fixed(map_top) + 'v' + fixed(map_height);
  }
  for (int i = 0; i <= 6; ++i) {
    path +=
        'M' + fixed(margin) + ' ' + fixed(map_top + map_height * i / 6) + 'h' + fixed(map_width);
  }
  return "<path d=\"" + path + "\" stroke=\"#ccc\"/>\n";
}

}  // namespace

std::string quality_picture(const VoronoiMesh& arrays, const Quality& quality,
                            std::size_t num_worst, const Execution& execution) {
  const CellQuality cells = cell_quality(arrays, execution);
  std::string svg = begin_picture(picture_height);
  svg += bars(quality.angles_deg, 0, "angles of triangles, degrees");
  svg += bars(quality.edge_ratios, 1, "dv / dc of edges");
  svg += bars(quality.spacings, 2, "spacing over its median");
  svg += text_at(margin, map_top - 12,
                 "the worst cells: center of mass (red), short edge (blue), gradient (green)");
  svg += "</g>\n" + map_lines();
  svg += dots(arrays, largest(cells.centroid_offset, num_worst, 1), "#c22", 3);
  svg += dots(arrays, largest(cells.edge_ratio, num_worst, -1), "#22c", 5);
  return svg + dots(arrays, largest(cells.gradient, num_worst, 1), "#292", 7) + "</svg>\n";
}

}  // namespace rondel::mesh
