// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the features of GeoJSON: read_polygons() returns the cells, and read_features() also the
// lines and points. The rings become cells in overlay/feature_polygons.h; lines are divided here.
#include "rondel/polygon_files.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/geojson_polygons.h"
#include "overlay/feature_polygons.h"
#include "overlay/plane_arcs.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

// The remark on a file.
constexpr const char* no_features = "there are no features";

// Throws InvalidInput if a position is none.
void require_position(const LonLat& place, std::size_t feature) {
  const bool is_finite = std::isfinite(place.lon_deg) && std::isfinite(place.lat_deg);
  if (is_finite && std::abs(place.lat_deg) <= 90) return;
  throw InvalidInput("feature " + std::to_string(feature) +
                         (is_finite ? ": latitude " + system::shortest_text(place.lat_deg) +
                                          " is outside [-90, 90]"
                                    : ": a position is not finite"),
                     feature);
}

void require_tolerance(const PolygonOptions& options) {
  if (options.tolerance_deg > 0) return;
  throw InvalidInput("the tolerance " + system::shortest_text(options.tolerance_deg) +
                     " is not positive");
}

// Reads the features of a file, and removes the geometry of those that options.is_taken() rejects.
map::PolygonFeatures features_of(const FileName& file, io::FeatureKinds kinds,
                                 const PolygonOptions& options) {
  require_tolerance(options);
  const auto faulty =
      options.invalid == InvalidPolygons::error ? io::FaultyRings::error : io::FaultyRings::keep;
  map::PolygonFeatures features = io::read_polygon_features(file, kinds, faulty);
  for (std::size_t f = 0; options.is_taken && f < features.rings.size(); ++f) {
    if (options.is_taken(f, features.columns)) continue;
    features.rings[f].clear();
    features.lines[f].clear();
  }
  return features;
}

// Returns polygons in memory as those of a file. Throws InvalidInput.
map::PolygonFeatures features_of(const LonLatMultiPolygons& features,
                                 const PolygonOptions& options) {
  require_tolerance(options);
  const auto& polygons = features.rows;
  if (!system::are_offsets(features.offsets, polygons.size()) ||
      !system::are_offsets(polygons.offsets, polygons.rows.size()) ||
      !system::are_offsets(polygons.rows.offsets, polygons.rows.values.size())) {
    throw InvalidInput("the offsets of the polygons do not fit");
  }
  map::PolygonFeatures converted;
  converted.name = "polygons";
  converted.rings.resize(features.size());
  converted.lines.resize(features.size());
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (options.is_taken && !options.is_taken(f, {})) continue;
    std::vector<map::LonLatRing>& rings = converted.rings[f];
    for (std::uint64_t p = features.offsets[f]; p < features.offsets[f + 1]; ++p) {
      for (std::uint64_t r = polygons.offsets[p]; r < polygons.offsets[p + 1]; ++r) {
        const std::span<const LonLat> row = polygons.rows[r];
        for (const LonLat& place : row) require_position(place, f);
        rings.push_back(map::ring_of_file({row.begin(), row.end()}, r > polygons.offsets[p]));
        if (options.invalid == InvalidPolygons::error && !rings.back().fault.empty()) {
          throw InvalidInput("feature " + std::to_string(f) + ": " + rings.back().fault, f);
        }
      }
    }
  }
  return converted;
}

// Returns options with which features that are not valid are kept.
PolygonOptions leniently(PolygonOptions options) {
  options.invalid = InvalidPolygons::repair;
  return options;
}

// Returns the lines of features as arcs of great circles. Lines that are straight in longitude and
// latitude are divided within the tolerance.
FeatureLines lines_of_features(const map::PolygonFeatures& features,
                               const PolygonOptions& options) {
  FeatureLines all;
  std::vector<Point>& points = all.rows.values;
  std::vector<LonLat> positions;
  for (const auto& lines : features.lines) {
    for (const std::vector<LonLat>& line : lines) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        if (options.edges == PolygonEdges::geodesic) {
          points.push_back(unit_vector(line[k]));
        } else {
          positions.clear();
          overlay::append_divided(line[k], line[k + 1], options.tolerance_deg * radians_per_degree,
                                  positions);
          for (const LonLat& p : positions) points.push_back(unit_vector(p));
        }
      }
      points.push_back(unit_vector(line.back()));
      all.rows.end_row();
    }
    all.end_group();
  }
  return all;
}

}  // namespace

std::string_view name_of(PolygonEdges edges) noexcept {
  return system::name_in({"lonlat", "geodesic"}, edges);
}

std::string_view name_of(InvalidPolygons invalid) noexcept {
  return system::name_in({"error", "repair"}, invalid);
}

std::string_view name_of(PolygonOverlap overlap) noexcept {
  return system::name_in({"keep", "error", "first"}, overlap);
}

CellTable read_polygons(const FileName& file, const PolygonOptions& options,
                        const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures features = features_of(file, io::FeatureKinds::polygons, options);
  CellTable table;
  if (features.rings.empty()) table.facts.remarks.emplace_back(no_features);
  table.cells = overlay::cells_of_features(features, options, table.facts, execution);
  table.facts.name = std::move(features.name);
  table.facts.columns = std::move(features.columns);
  return table;
}

CellTable cells_of_polygons(const LonLatMultiPolygons& features, const PolygonOptions& options,
                            const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures converted = features_of(features, options);
  CellTable table;
  try {
    table.cells = overlay::cells_of_features(converted, options, table.facts, execution);
  } catch (const overlay::FeatureFault& fault) {
    throw InvalidInput("feature " + std::to_string(fault.feature()) + ": " + fault.fault(),
                       fault.feature());
  } catch (const FileError& error) {
    throw InvalidInput(error.what() + converted.name.size() + 2);
  }
  return table;
}

std::vector<std::string> polygon_faults(const FileName& file, const PolygonOptions& options,
                                        const Execution& execution) {
  const system::Call call(execution);
  const map::PolygonFeatures features =
      features_of(file, io::FeatureKinds::polygons, leniently(options));
  return overlay::faults_of_features(features, options, execution);
}

std::vector<std::string> polygon_faults(const LonLatMultiPolygons& features,
                                        const PolygonOptions& options, const Execution& execution) {
  const system::Call call(execution);
  return overlay::faults_of_features(features_of(features, leniently(options)), options, execution);
}

FeatureTable read_features(const FileName& file, const PolygonOptions& options,
                           const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures features = features_of(file, io::FeatureKinds::all, options);
  FeatureTable table;
  for (std::size_t f = 0; f < features.rings.size(); ++f) {
    // A feature without geometry, or one that was rejected, stays in the table without a place.
    table.is_located.push_back(!features.rings[f].empty() || !features.lines[f].empty());
  }
  table.lines = lines_of_features(features, options);
  if (features.rings.empty()) table.facts.remarks.emplace_back(no_features);
  table.polygons = overlay::cells_of_features(features, options, table.facts, execution);
  table.ids = std::move(features.ids);
  table.facts.name = std::move(features.name);
  table.facts.columns = std::move(features.columns);
  return table;
}

}  // namespace rondel
