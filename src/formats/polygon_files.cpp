// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the features of GeoJSON: read_polygons() returns the cells, and read_features() also the
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
#include "io/ending.h"
#include "io/geojson_polygons.h"
#include "overlay/feature_polygons.h"
#include "overlay/plane_arcs.h"
#include "overlay/single_cells.h"
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

// The remark on a file.
constexpr const char* no_features = "there are no features";

// The name of features in memory, which messages leave out.
constexpr std::string_view in_memory_name = "polygons";

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
                        (num_masked > 1 ? "sites" : "site"));
    }
    table = num_masked > 0 ? sites.table.selection(is_kept) : std::move(sites.table);
  } else {
    ReadOptions with_columns;
    with_columns.keep_columns = true;
    table = read_sites(file, with_columns, execution);
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
    if (options.is_taken(f, features.files.front().columns)) continue;
    features.rings[f].clear();
    features.lines[f].clear();
  }
  return features;
}

void require_offsets(bool do_fit, const char* of_what) {
  if (!do_fit) throw InvalidInput(std::string("the offsets of the ") + of_what + " do not fit");
}

// Returns polygons in memory as those of a file. Throws InvalidInput.
map::PolygonFeatures features_of(const LonLatMultiPolygons& features,
                                 const PolygonOptions& options) {
  require_tolerance(options);
  const auto& polygons = features.rows;
  require_offsets(system::are_offsets(features.offsets, polygons.size()) &&
                      system::are_offsets(polygons.offsets, polygons.rows.size()) &&
                      system::are_offsets(polygons.rows.offsets, polygons.rows.values.size()),
                  "polygons");
  map::PolygonFeatures converted;
  converted.files.front().name = in_memory_name;
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

// Returns geometries in memory as those of a file. Throws InvalidInput.
map::PolygonFeatures features_of(const LonLatGeometries& geometries,
                                 const PolygonOptions& options) {
  const auto& lines = geometries.lines;
  require_offsets(system::are_offsets(lines.offsets, lines.rows.size()) &&
                      system::are_offsets(lines.rows.offsets, lines.rows.values.size()),
                  "lines");
  if (lines.size() != geometries.polygons.size()) {
    throw InvalidInput("there are lines of " + std::to_string(lines.size()) +
                       " features and polygons of " + std::to_string(geometries.polygons.size()));
  }
  map::PolygonFeatures converted = features_of(geometries.polygons, options);
  for (std::size_t f = 0; f < lines.size(); ++f) {
    if (options.is_taken && !options.is_taken(f, {})) continue;
    for (std::uint64_t k = lines.offsets[f]; k < lines.offsets[f + 1]; ++k) {
      const std::span<const LonLat> line = lines.rows[k];
      if (line.empty()) {
        throw InvalidInput("feature " + std::to_string(f) + ": a line without a position", f);
      }
      for (const LonLat& place : line) require_position(place, f);
      converted.lines[f].emplace_back(line.begin(), line.end());
    }
  }
  return converted;
}

// Returns which features have a geometry. One that was rejected has none.
std::vector<bool> are_located(const map::PolygonFeatures& features) {
  std::vector<bool> located(features.rings.size());
  for (std::size_t f = 0; f < located.size(); ++f) {
    located[f] = !features.rings[f].empty() || !features.lines[f].empty();
  }
  return located;
}

// Converts polygons into cells.
CellTable table_of(map::PolygonFeatures& features, const PolygonOptions& options,
                   const Execution& execution) {
  overlay::ConvertedFeatures converted = overlay::converted_features(features, options, execution);
  CellTable table;
  table.cells = std::move(converted.cells);
  table.facts = std::move(converted.facts.front());
  map::FeatureFile& file = features.files.front();
  if (features.rings.empty()) table.facts.remarks.emplace_back(no_features);
  if (file.name != in_memory_name) table.facts.name = std::move(file.name);
  table.facts.columns = std::move(file.columns);
  return table;
}

// Returns the lines of the features from `first` to before `end`.
FeatureLines lines_between(const FeatureLines& lines, std::size_t first, std::size_t end) {
  FeatureLines some;
  for (std::size_t f = first; f < end; ++f) {
    for (std::uint64_t k = lines.offsets[f]; k < lines.offsets[f + 1]; ++k) {
      some.rows.append(lines.rows[k]);
    }
    some.end_group();
  }
  return some;
}

// Converts the features of all files together, and returns those of each file with what is known of
// them.
std::vector<FeatureTable> tables_of(std::vector<map::PolygonFeatures> files,
                                    const PolygonOptions& options, const Execution& execution) {
  std::vector<FeatureTable> tables(files.size());
  for (std::size_t k = 0; k < files.size(); ++k) tables[k].is_located = are_located(files[k]);
  if (files.empty()) return tables;
  map::PolygonFeatures all = map::joined(std::move(files));
  overlay::ConvertedFeatures converted = overlay::converted_features(all, options, execution);
  std::size_t first = 0;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    FeatureTable& table = tables[k];
    map::FeatureFile& file = all.files[k];
    const std::size_t end = first + file.num_features;
    table.lines = lines_between(converted.lines, first, end);
    table.polygons = overlay::cells_between(converted.cells, first, end);
    table.ids = std::move(file.ids);
    table.facts = std::move(converted.facts[k]);
    if (end == first) table.facts.remarks.emplace_back(no_features);
    table.facts.name = std::move(file.name);
    table.facts.columns = std::move(file.columns);
    first = end;
  }
  return tables;
}

void require_overlaps_kept(const PolygonOptions& options) {
  if (options.overlap == PolygonOverlap::keep) return;
  throw InvalidInput("features that are read together may overlap");
}

// Returns what convert() returns. A fault of a feature in memory is an InvalidInput.
template <class Convert>
auto in_memory(const Convert& convert) {
  try {
    return convert();
  } catch (const overlay::FeatureFault& fault) {
    throw InvalidInput("feature " + std::to_string(fault.feature()) + ": " + fault.fault(),
                       fault.feature());
  } catch (const FileError& error) {
    throw InvalidInput(error.what() + (in_memory_name.size() + 2));
  }
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
  return table_of(features, options, execution);
}

CellTable cells_of_polygons(const LonLatMultiPolygons& features, const PolygonOptions& options,
                            const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures converted = features_of(features, options);
  return in_memory([&] { return table_of(converted, options, execution); });
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
  table.is_located = are_located(features);
  table.lines = lines_of_features(features, options);
  features.lines.clear();
  CellTable cells = table_of(features, options, execution);
  table.polygons = std::move(cells.cells);
  table.facts = std::move(cells.facts);
  table.ids = std::move(features.files.front().ids);
  return table;
}

std::vector<FeatureTable> read_features_together(std::span<const FileName> files,
                                                 const PolygonOptions& options,
                                                 const Execution& execution) {
  const system::Call call(execution);
  require_overlaps_kept(options);
  require_tolerance(options);
  std::vector<map::PolygonFeatures> sets;
  std::vector<std::vector<std::string>> remarks(files.size());
  sets.reserve(files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    sets.push_back(io::is_geojson(files[k]) ? features_of(files[k], io::FeatureKinds::all, options)
                                            : features_of_sites(files[k], remarks[k], execution));
  }
  std::vector<FeatureTable> tables = tables_of(std::move(sets), options, execution);
  for (std::size_t k = 0; k < tables.size(); ++k) {
    std::vector<std::string>& all = tables[k].facts.remarks;
    all.insert(all.begin(), remarks[k].begin(), remarks[k].end());
  }
  return tables;
}

std::vector<FeatureTable> features_of_geometries(std::span<const LonLatGeometries> sets,
                                                 const PolygonOptions& options,
                                                 const Execution& execution) {
  const system::Call call(execution);
  require_overlaps_kept(options);
  std::vector<map::PolygonFeatures> converted;
  converted.reserve(sets.size());
  for (const LonLatGeometries& set : sets) converted.push_back(features_of(set, options));
  return in_memory([&] { return tables_of(std::move(converted), options, execution); });
}

}  // namespace rondel
