// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features of memory become tables here, which needs no file.
#include "formats/feature_tables.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "overlay/feature_polygons.h"
#include "overlay/single_cells.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "rondel/types.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/row_assembly.h"

namespace rondel {
namespace formats {
namespace {

// The remark on a file.
constexpr const char* no_features = "there are no features";

// The name of features in memory, which messages leave out.
constexpr std::string_view in_memory_name = "polygons";

// Throws InvalidInput if a position is none.
void require_lonlat(const LonLat& place, std::size_t feature) {
  const bool is_finite = std::isfinite(place.lon_deg) && std::isfinite(place.lat_deg);
  if (is_finite && std::abs(place.lat_deg) <= 90) return;
  throw InvalidInput("feature " + std::to_string(feature) +
                         (is_finite ? ": latitude " + system::shortest_text(place.lat_deg) +
                                          " is outside [-90, 90]"
                                    : ": a position is not finite"),
                     feature);
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
        for (const LonLat& place : row) require_lonlat(place, f);
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
      for (const LonLat& place : line) require_lonlat(place, f);
      converted.lines[f].emplace_back(line.begin(), line.end());
    }
  }
  return converted;
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

}  // namespace

void require_tolerance(const PolygonOptions& options) {
  if (options.tolerance_deg > 0) return;
  throw InvalidInput("the tolerance " + system::shortest_text(options.tolerance_deg) +
                     " is not positive");
}

void require_overlaps_kept(const PolygonOptions& options) {
  if (options.overlap == PolygonOverlap::keep) return;
  throw InvalidInput("features that are read together may overlap");
}

PolygonOptions leniently(PolygonOptions options) {
  options.invalid = InvalidPolygons::repair;
  return options;
}

std::vector<bool> are_located(const map::PolygonFeatures& features) {
  std::vector<bool> located(features.rings.size());
  for (std::size_t f = 0; f < located.size(); ++f) {
    located[f] = !features.rings[f].empty() || !features.lines[f].empty();
  }
  return located;
}

std::vector<LongitudeExtent> longitudes_of(const map::PolygonFeatures& features) {
  std::vector<LongitudeExtent> all(features.rings.size());
  for (std::size_t f = 0; f < all.size(); ++f) {
    const auto include = [&](std::span<const LonLat> positions) {
      for (const LonLat& place : positions) all[f].include({place.lon_deg, place.lon_deg});
    };
    for (const map::LonLatRing& ring : features.rings[f]) include(ring.positions);
    for (const std::vector<LonLat>& line : features.lines[f]) include(line);
  }
  return all;
}

CellTable table_of(map::PolygonFeatures& features, const PolygonOptions& options,
                   const Execution& execution) {
  overlay::ConvertedFeatures converted = overlay::converted_features(features, options, execution);
  CellTable table;
  table.cells = std::move(converted.cells);
  table.sides = std::move(converted.sides);
  table.facts = std::move(converted.facts.front());
  map::FeatureFile& file = features.files.front();
  if (features.rings.empty()) table.facts.remarks.emplace_back(no_features);
  if (file.name != in_memory_name) table.facts.name = std::move(file.name);
  table.facts.columns = std::move(file.columns);
  return table;
}

std::vector<FeatureTable> tables_of(std::vector<map::PolygonFeatures> files,
                                    const PolygonOptions& options, const Execution& execution) {
  std::vector<FeatureTable> tables(files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    tables[k].is_located = are_located(files[k]);
    tables[k].longitudes = longitudes_of(files[k]);
  }
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

}  // namespace formats

std::string_view name_of(PolygonEdges edges) noexcept {
  return system::name_in({"lonlat", "geodesic"}, edges);
}

std::string_view name_of(InvalidPolygons invalid) noexcept {
  return system::name_in({"error", "repair"}, invalid);
}

std::string_view name_of(PolygonOverlap overlap) noexcept {
  return system::name_in({"keep", "error", "first"}, overlap);
}

CellTable cells_of_polygons(const LonLatMultiPolygons& features, const PolygonOptions& options,
                            const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures converted = formats::features_of(features, options);
  return formats::in_memory([&] { return formats::table_of(converted, options, execution); });
}

CellRings rings_of_polygons(const LonLatMultiPolygons& features, const PolygonOptions& options,
                            const Execution& execution) {
  const system::Call call(execution);
  map::PolygonFeatures converted = formats::features_of(features, options);
  return formats::in_memory(
      [&] { return overlay::cells_of_features(converted, options, execution); });
}

std::vector<std::string> polygon_faults(const LonLatMultiPolygons& features,
                                        const PolygonOptions& options, const Execution& execution) {
  const system::Call call(execution);
  return overlay::faults_of_features(formats::features_of(features, formats::leniently(options)),
                                     options, execution);
}

std::vector<FeatureTable> features_of_geometries(std::span<const LonLatGeometries> sets,
                                                 const PolygonOptions& options,
                                                 const Execution& execution) {
  const system::Call call(execution);
  formats::require_overlaps_kept(options);
  std::vector<map::PolygonFeatures> converted;
  converted.reserve(sets.size());
  for (const LonLatGeometries& set : sets) converted.push_back(formats::features_of(set, options));
  return formats::in_memory(
      [&] { return formats::tables_of(std::move(converted), options, execution); });
}

}  // namespace rondel
