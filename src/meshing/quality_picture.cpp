// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws a report as SVG: histograms above, a map of the worst cells below.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "exact/angles.h"
#include "rondel/mesh_quality.h"

namespace rondel::mesh {
namespace {

// Positions are in pixels from the corner at the top left; y grows downward.
constexpr double picture_width = 960;
constexpr double picture_height = 760;
constexpr double margin = 20;
constexpr double histogram_height = 180;
constexpr double histogram_top = 40;
constexpr double map_top = 280;
constexpr double map_width = 900;
constexpr double map_height = map_width / 2;

// Returns the number with two decimals.
std::string fixed(double value) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%.2f", value);
  return digits.data();
}

std::string text_at(double x, double y, const std::string& text) {
  return "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\">" + text + "</text>\n";
}

// Returns the bars of a histogram with its title.
std::string bars(const Histogram& histogram, double left, const std::string& title) {
  const double width = (picture_width - 4 * margin) / 3;
  const double step = width / static_cast<double>(histogram.counts.size());
  const auto most = static_cast<double>(*std::ranges::max_element(histogram.counts));
  const double bottom = histogram_top + histogram_height;
  std::string svg = text_at(left, histogram_top - 10, title);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    if (histogram.counts[i] == 0) continue;
    const double height =
        std::max(1.0, histogram_height * static_cast<double>(histogram.counts[i]) / most);
    svg += "<rect x=\"" + fixed(left + step * static_cast<double>(i)) + "\" y=\"" +
           fixed(bottom - height) + "\" width=\"" + fixed(step) + "\" height=\"" + fixed(height) +
           "\"/>\n";
  }
  svg += "<path d=\"M" + fixed(left) + ' ' + fixed(bottom) + 'h' + fixed(width) + "\"/>\n";
  svg += text_at(left, bottom + 16, fixed(histogram.low));
  return svg + text_at(left + width - 30, bottom + 16, fixed(histogram.high));
}

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
  const double third = (picture_width - margin) / 3;
  std::string svg = R"(<svg xmlns="http://www.w3.org/2000/svg" width=")" + fixed(picture_width) +
                    R"(" height=")" + fixed(picture_height) +
                    R"(" font-family="sans-serif" font-size="12">)"
                    "\n"
                    R"(<rect width="100%" height="100%" fill="white"/>)"
                    "\n"
                    R"(<g fill="#456" stroke="none">)"
                    "\n";
  svg += bars(quality.angles_deg, margin, "angles of triangles, degrees");
  svg += bars(quality.edge_ratios, margin + third, "dv / dc of edges");
  svg += bars(quality.spacings, margin + 2 * third, "spacing over its median");
  svg += text_at(margin, map_top - 12,
                 "the worst cells: center of mass (red), short edge (blue), gradient (green)");
  svg += "</g>\n" + map_lines();
  svg += dots(arrays, largest(cells.centroid_offset, num_worst, 1), "#c22", 3);
  svg += dots(arrays, largest(cells.edge_ratio, num_worst, -1), "#22c", 5);
  return svg + dots(arrays, largest(cells.gradient, num_worst, 1), "#292", 7) + "</svg>\n";
}

}  // namespace rondel::mesh
