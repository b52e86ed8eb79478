// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the features of GeoJSON and of formats that GDAL reads: read_polygons() returns the cells, and read_features() also the
// lines and points. The rings become cells in overlay/feature_polygons.h; lines are divided here.
#include "rondel/polygon_files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "formats/feature_tables.h"
#include "formats/sites_gdal.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/geojson_polygons.h"
#include "overlay/feature_polygons.h"
#include "overlay/plane_arcs.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"
#include "rondel/io.h"
#include "rondel/read_cells.h"
#include "rondel/types.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

// Returns the sites of a file as points. Throws FileError for a site without a direction.
map::PolygonFeatures features_of_sites(const FileName& file, std::vector<std::string>& remarks,
                                       const Execution& execution) {
  SiteTable table;
  if (is_netcdf_file(file)) {
    NetcdfSites sites = read_netcdf_sites(file, {}, true);
    const std::vector<bool> is_kept = sites.unmasked();
    const auto num_masked = static_cast<std::size_t>(std::ranges::count(is_kept, false));
    if (num_masked > 0) {
      remarks.push_back("left out " + std::to_string(num_masked) + " masked " +
                        (num_masked > 1 ? "sites" : "site") + "; features are numbered without " +
                        (num_masked > 1 ? "them" : "it"));
    }
    table = num_masked > 0 ? sites.table.selection(is_kept) : std::move(sites.table);
  } else {
    ReadOptions with_columns;
    with_columns.keep_columns = true;
    table = read_sites(file, with_columns, execution);
    if (table.num_unlocated > 0) {
      remarks.push_back("left out " + std::to_string(table.num_unlocated) +
                        (table.num_unlocated > 1 ? " rows" : " row") +
                        " without a place; features are numbered without " +
                        (table.num_unlocated > 1 ? "them" : "it"));
    }
  }
  map::PolygonFeatures features;
  features.rings.resize(table.sites.size());
  for (std::size_t i = 0; i < table.sites.size(); ++i) {
    LonLat position;
    if (table.is_lonlat()) {
      position = table.positions[i];
    } else {
      const Point& p = table.sites[i];
      const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (!(largest > 0)) throw FileError(table.where(i) + ": the site is the center");
      position = lonlats(std::vector<Point>{(1 / largest) * p}).front();
    }
    features.lines.push_back({{position}});
  }
  features.files.front() = {std::move(table.name), std::move(table.columns), std::move(table.ids)};
  return features;
}

// Reads the features of a file, and removes the geometry of those that options.is_taken() rejects.
map::PolygonFeatures features_of(const FileName& file, io::FeatureKinds kinds,
                                 const PolygonOptions& options) {
  formats::require_tolerance(options);
  const auto faulty =
      options.invalid == InvalidPolygons::error ? io::FaultyRings::error : io::FaultyRings::keep;
  std::string text;  // GeoJSON of a file that GDAL reads
  const bool is_of_gdal = formats::is_read_by_gdal(file);
  if (is_of_gdal) text = formats::geojson_of_gdal(file);
  map::PolygonFeatures features = io::read_polygon_features(
      is_of_gdal ? FileName::in_memory(text, "geojson", file.path) : file, kinds, faulty);
  for (std::size_t f = 0; options.is_taken && f < features.rings.size(); ++f) {
    if (options.is_taken(f, features.files.front().columns)) continue;
    features.rings[f].clear();
    features.lines[f].clear();
  }
  return features;
}

// Reads the features of .geojson and of GDAL's formats, or the sites of other files.
map::PolygonFeatures features_or_sites_of(const FileName& file, const PolygonOptions& options,
                                          std::vector<std::string>& remarks,
                                          const Execution& execution) {
  if (io::is_unnamed_input(file)) {
    io::FileBytes input(file);
    std::string text(input.text());
    const FileName named = FileName::in_memory(text, io::format_of_text(text), input.name());
    return features_or_sites_of(named, options, remarks, execution);
  }
  return io::is_geojson(file) || formats::is_read_by_gdal(file)
             ? features_of(file, io::FeatureKinds::all, options)
             : features_of_sites(file, remarks, execution);
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

CellTable read_polygons(const FileName& file, const PolygonOptions& options,
                        const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures features = features_of(file, io::FeatureKinds::polygons, options);
  return formats::table_of(features, options, execution);
}

std::vector<std::string> polygon_faults(const FileName& file, const PolygonOptions& options,
                                        const Execution& execution) {
  const system::Call call(execution);
  const map::PolygonFeatures features =
      features_of(file, io::FeatureKinds::polygons, formats::leniently(options));
  return overlay::faults_of_features(features, options, execution);
}

FeatureTable read_features(const FileName& file, const PolygonOptions& options,
                           const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures features = features_of(file, io::FeatureKinds::all, options);
  FeatureTable table;
  table.is_located = formats::are_located(features);
  table.longitudes = formats::longitudes_of(features);
  table.lines = lines_of_features(features, options);
  features.lines.clear();
  CellTable cells = formats::table_of(features, options, execution);
  table.polygons = std::move(cells.cells);
  table.facts = std::move(cells.facts);
  table.ids = std::move(features.files.front().ids);
  return table;
}

std::vector<FeatureTable> read_features_together(std::span<const FileName> files,
                                                 const PolygonOptions& options,
                                                 const Execution& execution) {
  const system::Call call(execution);
  formats::require_overlaps_kept(options);
  formats::require_tolerance(options);
  std::vector<map::PolygonFeatures> sets;
  std::vector<std::vector<std::string>> remarks(files.size());
  sets.reserve(files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    sets.push_back(features_or_sites_of(files[k], options, remarks[k], execution));
  }
  std::vector<FeatureTable> tables = formats::tables_of(std::move(sets), options, execution);
  for (std::size_t k = 0; k < tables.size(); ++k) {
    std::vector<std::string>& all = tables[k].facts.remarks;
    all.insert(all.begin(), remarks[k].begin(), remarks[k].end());
  }
  return tables;
}

}  // namespace rondel
