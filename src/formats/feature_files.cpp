// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes cells, or points, lines and polygons, as features: write_regions() and write_geometries().
// A GeoJSON file (RFC 7946) is a FeatureCollection; GDAL writes other formats (features_gdal.cpp).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "formats/drawn_features.h"
#include "formats/features_gdal.h"
#include "formats/region_drawing.h"
#include "io/cell_formats.h"
#include "io/ending.h"
#include "io/flat_arrays.h"
#include "io/geojson_writer.h"
#include "io/number.h"
#include "map/arc.h"
#include "map/region.h"
#include "rondel/delaunay.h"
#include "rondel/geometries.h"
#include "rondel/regions.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

// The number of geometries that a thread writes or draws at once.
constexpr std::size_t geometries_per_task = 16;

// Returns the texts of all geometries, which several threads write.
std::vector<std::string> texts_of(const DrawnFeatures& features, unsigned threads) {
  std::vector<std::string> texts(features.geometries.size());
  system::parallel_for(
      threads, texts.size(), geometries_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (!features.is_written[i]) continue;
          const DrawnGeometry& geometry = features.geometries[i];
          io::append_geometry(texts[i], geometry.points, geometry.lines, geometry.polygons);
        }
      });
  return texts;
}

// The arguments of the writer of GeoJSON.
struct FeaturesToWrite {
  const DrawnFeatures& features;
  unsigned threads;
};

// Writes features: the id, what is computed, the columns and the geometry of each.
void write_features_geojson(io::AtomicFile& file, const FeaturesToWrite& job) {
  const DrawnFeatures& features = job.features;
  const std::vector<std::string> texts = texts_of(features, job.threads);
  std::set<std::string> taken;
  for (const Measure& measure : features.measures) taken.insert(measure.name);
  std::vector<std::string> keys = io::property_keys(features.columns, taken);
  file.write(io::features_begin);
  bool is_first = true;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (!features.is_written[i]) continue;
    std::string text;
    io::begin_feature(text, std::exchange(is_first, false), features.ids, i);
    std::string properties;
    for (const Measure& measure : features.measures) {
      properties += std::string(",\"") + measure.name + "\":";
      io::append_number(properties, measure.values[i]);
    }
    for (std::size_t k = 0; k < keys.size(); ++k) {
      properties += keys[k];
      io::append_value(properties, features.columns[k], i);
    }
    if (!properties.empty()) text += properties.substr(1);  // without the first comma
    text += io::geometry_begin + texts[i] + '}';
    file.write(text);
  }
  file.write(io::features_end);
}

constexpr std::array<io::Writer<FeaturesToWrite>, 1> feature_writers = {
    {{".geojson", &write_features_geojson}}};

// True if a column has a cell for each row, and its ends fit to its text.
bool is_complete(const Column& column, std::size_t num_rows) {
  return column.ends.size() == num_rows && std::ranges::is_sorted(column.ends) &&
         (column.ends.empty() || column.ends.back() == column.text.size());
}

// Throws InvalidInput if columns or ids do not fit to the features.
void require_columns(std::span<const Column> columns, const Column& ids, std::size_t num_rows) {
  io::require_fit(ids.ends.empty() || is_complete(ids, num_rows), "ids");
  io::require_fit(std::ranges::all_of(
                      columns, [&](const Column& column) { return is_complete(column, num_rows); }),
                  "columns");
}

// Writes the features in the format of a file.
void write_drawn(const FileName& file, const DrawnFeatures& features, unsigned threads) {
  if (is_format_of_gdal(file)) {
    write_features_gdal(file, features);
  } else {
    io::write_whole<FeaturesToWrite>(feature_writers, file, "regions are written as",
                                     {features, threads});
  }
}

// Returns the geometries of drawn polygons.
std::vector<DrawnGeometry> geometries_of(std::vector<map::PolygonsOfRegion> regions) {
  std::vector<DrawnGeometry> geometries(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) geometries[i].polygons = std::move(regions[i]);
  return geometries;
}

// Adds a line to a geometry, cut at the antimeridian; a line in one place is a point.
void add_line(std::span<const Point> line, double tolerance, DrawnGeometry& geometry) {
  std::vector<std::vector<LonLat>> parts;
  if (line.size() > 1) parts = map::line_parts(line, false, tolerance);
  if (parts.empty()) {
    const LonLat position = lonlats(line.first(1)).front();
    geometry.points.push_back(map::as_written(position, line.front()));
  }
  std::ranges::move(parts, std::back_inserter(geometry.lines));
}

// Adds the lines and points of all features to their geometries.
void add_lines(const FeatureLines& lines, double tolerance, unsigned threads,
               std::vector<DrawnGeometry>& geometries) {
  system::parallel_for(threads, geometries.size(), geometries_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t f = begin; f < end; ++f) {
                           for (std::uint64_t k = lines.offsets[f]; k < lines.offsets[f + 1]; ++k) {
                             add_line(lines.rows[k], tolerance, geometries[f]);
                           }
                         }
                       });
}

// Throws InvalidInput if the arrays of the lines do not fit together, or a line has no point.
void require_lines(const FeatureLines& lines) {
  const auto& rows = lines.rows;
  io::require_fit(system::are_offsets(lines.offsets, rows.size()) &&
                      system::are_offsets(rows.offsets, rows.values.size()) &&
                      io::are_unit_vectors(rows.values),
                  "lines");
  for (std::size_t k = 0; k < rows.size(); ++k) io::require_fit(!rows[k].empty(), "lines");
}

// Returns areas if there are polygons, and lengths if there are lines of several points.
std::vector<Measure> measures_of(const Geometries& geometries) {
  std::vector<Measure> measures;
  if (geometries.polygons.rings.size() > 1 || !geometries.polygons.whole.empty()) {
    measures.push_back({"area", areas(geometries.polygons)});
  }
  const auto& rows = geometries.lines.rows;
  if (rows.values.size() > rows.size()) measures.push_back({"length", lengths(geometries.lines)});
  return measures;
}

}  // namespace
}  // namespace rondel::formats

namespace rondel {

LonLatLines lonlat_lines(const FeatureLines& lines, double tolerance_deg,
                         const Execution& execution) {
  const system::Call call(execution);
  formats::require_lines(lines);
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  std::vector<formats::DrawnGeometry> drawn(lines.size());
  formats::add_lines(lines, tolerance, execution.threads, drawn);
  LonLatLines all;
  for (std::size_t f = 0; f < drawn.size(); ++f) {
    for (const std::vector<LonLat>& line : drawn[f].lines) all.parts.append(line);
    for (const LonLat& point : drawn[f].points) all.parts.append({&point, 1});
    all.owners.resize(all.parts.size(), static_cast<Index>(f));
  }
  return all;
}

bool can_write_regions(const FileName& file) {
  return io::ending(file) == formats::feature_writers.front().ending ||
         formats::is_format_of_gdal(file);
}

void write_regions(const FileName& file, const CellRings& cells, std::span<const Column> columns,
                   double tolerance_deg, const Execution& execution, const Column& ids,
                   CellDrawing drawing) {
  const system::Call call(execution);
  formats::require_rings(cells);
  formats::require_columns(columns, ids, cells.num_cells());
  require_region_writer(file);
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  std::vector<bool> is_written(cells.num_cells());
  for (std::size_t i = 0; i < is_written.size(); ++i) {
    is_written[i] = cells.cells[i] != cells.cells[i + 1] || cells.is_whole(i);
  }
  formats::write_drawn(
      file,
      {formats::geometries_of(formats::drawn_regions({cells, tolerance, execution, drawing})),
       std::move(is_written),
       {{"area", areas(cells)}},
       columns,
       ids},
      execution.threads);
}

void write_geometries(const FileName& file, const Geometries& geometries,
                      std::span<const Column> columns, double tolerance_deg,
                      const Execution& execution, const Column& ids, CellDrawing drawing) {
  const system::Call call(execution);
  const std::size_t size = geometries.size();
  formats::require_rings(geometries.polygons);
  formats::require_lines(geometries.lines);
  io::require_fit(geometries.polygons.num_cells() == size, "polygons");
  formats::require_columns(columns, ids, size);
  require_region_writer(file);
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  std::vector<formats::DrawnGeometry> drawn = formats::geometries_of(
      formats::drawn_regions({geometries.polygons, tolerance, execution, drawing}));
  formats::add_lines(geometries.lines, tolerance, execution.threads, drawn);
  formats::write_drawn(file,
                       {std::move(drawn), std::vector<bool>(size, true),
                        formats::measures_of(geometries), columns, ids},
                       execution.threads);
}

}  // namespace rondel
