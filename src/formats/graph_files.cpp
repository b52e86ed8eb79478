// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes graphs, outlines and empty circles as files: write_graph(), write_outline() and
// write_circles(). GeoJSON has lines, polygons or points in degrees; a table (.csv) has a row for
// each edge or circle; .npy has the two sites of each edge. Sites are named by their indices.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "exact/unit_vector.h"
#include "io/atomic_file.h"
#include "io/binary.h"
#include "io/cell_formats.h"
#include "io/ending.h"
#include "io/flat_arrays.h"
#include "io/geojson_writer.h"
#include "io/npy_header.h"
#include "io/number.h"
#include "map/arc.h"
#include "map/region.h"
#include "rondel/error.h"
#include "rondel/graphs.h"
#include "rondel/outlines.h"
#include "rondel/polygons.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

// The input of a writer of graphs.
struct GraphToWrite {
  const Triangulation& triangulation;
  const SiteGraph& graph;
  double tolerance_deg;
};

// The input of a writer of outlines.
struct OutlineToWrite {
  const Triangulation& triangulation;
  const Outline& outline;
  double tolerance;  // radians
};

using Circles = std::span<const EmptyCircle>;

// Returns the unit vector from the center to a site.
Point unit_of(const Triangulation& triangulation, Index site) {
  return exact::unit_vector(triangulation.sites()[site], triangulation.sphere().center).hi;
}

// Writes a feature for each edge with its two sites, its length in degrees and a MultiLineString.
void write_graph_geojson(io::AtomicFile& file, const GraphToWrite& job) {
  file.write(io::features_begin);
  std::string text;
  for (std::size_t i = 0; i < job.graph.edges.size(); ++i) {
    const auto [a, b] = job.graph.edges[i];
    text.clear();
    io::begin_feature(text, i == 0);
    text += R"("source":)" + std::to_string(a) + R"(,"target":)" + std::to_string(b) +
            R"(,"length_deg":)";
    io::append_number(text, job.graph.lengths[i] * map::degrees_per_radian);
    text += io::geometry_begin;
    const std::array<Point, 2> ends = {unit_of(job.triangulation, a),
                                       unit_of(job.triangulation, b)};
    const CompressedRows<LonLat> parts = arc_lines(std::span(&ends, 1), job.tolerance_deg);
    std::string lines;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (k > 0) lines += ',';
      io::append_positions(lines, parts[k]);
    }
    io::append_multi_line(text, lines);
    file.write(text + '}');
  }
  file.write(io::features_end);
}

// Writes a row for each edge: its two sites and its length in degrees.
void write_graph_csv(io::AtomicFile& file, const GraphToWrite& job) {
  std::string text = "source,target,length_deg\n";
  for (std::size_t i = 0; i < job.graph.edges.size(); ++i) {
    const auto [a, b] = job.graph.edges[i];
    text += std::to_string(a) + ',' + std::to_string(b) + ',';
    io::append_number(text, job.graph.lengths[i] * map::degrees_per_radian);
    text += '\n';
  }
  file.write(text);
}

// Writes the sites of the edges as an array of the shape (edges, 2) of 32-bit integers.
void write_graph_npy(io::AtomicFile& file, const GraphToWrite& job) {
  const std::array<std::uint64_t, 2> shape = {job.graph.edges.size(), 2};
  file.write(io::make_npy_header("<u4", shape));
  file.write(io::NumberBytes(job.graph.edges));
}

// Writes a feature for each part of the outline, with the number of its sites and its polygons.
void write_outline_geojson(io::AtomicFile& file, const OutlineToWrite& job) {
  const Outline& outline = job.outline;
  const std::vector<std::uint64_t>& ends = outline.rows.offsets;
  file.write(io::features_begin);
  std::vector<Point> units(outline.rows.values.size());
  std::ranges::transform(outline.rows.values, units.begin(),
                         [&](Index site) { return unit_of(job.triangulation, site); });
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto first = outline.offsets[i];
    const auto last = outline.offsets[i + 1];
    std::vector<map::UnitVectors> rings;
    for (auto r = first; r < last; ++r) {
      rings.push_back(std::span<const Point>(units).subspan(ends[r], ends[r + 1] - ends[r]));
    }
    std::string text;
    io::begin_feature(text, i == 0);
    text += R"("sites":)" + std::to_string(ends[last] - ends[first]) + io::geometry_begin;
    io::append_multi_polygon(text, map::region_polygons(rings, job.tolerance));
    file.write(text + '}');
  }
  file.write(io::features_end);
}

// Writes a row for each circle: its center and radius in degrees, and its three sites.
void write_circles_csv(io::AtomicFile& file, const Circles& circles) {
  std::string text = "lon,lat,radius_deg,a,b,c\n";
  for (const EmptyCircle& circle : circles) {
    const LonLat center = map::lonlat_of(circle.center, false);
    for (const double number : {center.lon_deg, center.lat_deg}) {
      io::append_number(text, number);
      text += ',';
    }
    io::append_number(text, circle.radius * map::degrees_per_radian);
    for (const Index site : circle.sites) text += ',' + std::to_string(site);
    text += '\n';
  }
  file.write(text);
}

// Writes a point for each circle, its center, with the radius and the three sites as properties.
void write_circles_geojson(io::AtomicFile& file, const Circles& circles) {
  std::string text = io::features_begin;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    io::begin_feature(text, i == 0);
    text += R"("radius_deg":)";
    io::append_number(text, circles[i].radius * map::degrees_per_radian);
    for (std::size_t k = 0; k < 3; ++k) {
      text += std::string(R"(,")") + "abc"[k] + R"(":)" + std::to_string(circles[i].sites[k]);
    }
    text += io::geometry_begin;
    io::append_point(text, map::lonlat_of(circles[i].center, false));
    text += '}';
  }
  file.write(text + io::features_end);
}

using GraphWriter = io::Writer<GraphToWrite>;
using OutlineWriter = io::Writer<OutlineToWrite>;
using CircleWriter = io::Writer<Circles>;
constexpr std::array<GraphWriter, 3> graph_writers = {
    {{".geojson", &write_graph_geojson}, {".csv", &write_graph_csv}, {".npy", &write_graph_npy}}};
constexpr std::array<OutlineWriter, 1> outline_writers = {{{".geojson", &write_outline_geojson}}};
constexpr std::array<CircleWriter, 2> circle_writers = {
    {{".geojson", &write_circles_geojson}, {".csv", &write_circles_csv}}};

}  // namespace

void write_graph(const FileName& file, const Triangulation& triangulation, const SiteGraph& graph,
                 double tolerance_deg, const Execution& execution) {
  const system::Call call(execution);
  const auto is_site = [&](Index site) { return site < triangulation.num_sites(); };
  if (graph.lengths.size() != graph.edges.size()) {
    throw InvalidInput("an edge has no length", std::min(graph.edges.size(), graph.lengths.size()));
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (!std::ranges::all_of(graph.edges[i], is_site) || !std::isfinite(graph.lengths[i])) {
      throw InvalidInput("an edge is not one between sites", i);
    }
  }
  io::write_whole<GraphToWrite>(graph_writers, file, "graphs are written as",
                                {triangulation, graph, io::checked_tolerance(tolerance_deg)});
}

void write_outline(const FileName& file, const Triangulation& triangulation, const Outline& outline,
                   double tolerance_deg, const Execution& execution) {
  const system::Call call(execution);
  const auto is_site = [&](Index site) { return site < triangulation.num_sites(); };
  const auto& [rings, sites] = outline.rows;
  if (!system::are_offsets(rings, sites.size()) ||
      !system::are_offsets(outline.offsets, outline.rows.size()) ||
      !std::ranges::all_of(sites, is_site)) {
    throw InvalidInput("the arrays of the outline do not fit together");
  }
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  io::write_whole<OutlineToWrite>(outline_writers, file, "outlines are written as",
                                  {triangulation, outline, tolerance});
}

void write_circles(const FileName& file, std::span<const EmptyCircle> circles) {
  const system::ArithmeticScope arithmetic;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const Point& c = circles[i].center;
    if (!std::isfinite(circles[i].radius) ||
        !(std::abs(c.x * c.x + c.y * c.y + c.z * c.z - 1) < 1e-6)) {
      throw InvalidInput("a circle has no center or radius", i);
    }
  }
  io::write_whole<Circles>(circle_writers, file, "circles are written as", circles);
}

}  // namespace rondel
