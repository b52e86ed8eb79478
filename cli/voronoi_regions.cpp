// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "voronoi_regions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "region_files.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/partition.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/weight_files.h"

namespace rondel::cli {
namespace {

constexpr double mean_earth_radius = 6371.0088;  // kilometers; WGS 84, (2 a + b) / 3

std::string_view text_in_row(const Column& column, std::size_t row) {
  const std::uint64_t begin = row == 0 ? 0 : column.ends[row - 1];
  return std::string_view(column.text).substr(begin, column.ends[row] - begin);
}

const Column& column_of(const std::vector<Column>& columns, const std::string& file,
                        const std::string& name, const std::string& option) {
  const auto column = std::ranges::find(columns, name, &Column::name);
  if (column == columns.end()) {
    throw UsageError(option + ": " + file + " has no column '" + name + "'");
  }
  return *column;
}

// Returns the numbers 0 ... size - 1 as a column.
Column index_column(const char* name, std::size_t size) {
  Column column{name, true, {}, {}};
  for (std::size_t i = 0; i < size; ++i) {
    column.text += std::to_string(i);
    column.ends.push_back(column.text.size());
  }
  return column;
}

// The rows of a table grouped by their text, groups in the order in which they occur. Rows without
// a text belong to no group.
struct Groups {
  std::vector<Index> of_rows;
  Column names;
};
Groups groups_of(const Column& column) {
  Groups groups{{}, {column.name, column.is_numeric, {}, {}}};
  std::unordered_map<std::string_view, Index> known;
  std::uint64_t begin = 0;
  for (const std::uint64_t end : column.ends) {
    const std::string_view text = std::string_view(column.text).substr(begin, end - begin);
    begin = end;
    if (text.empty()) {
      groups.of_rows.push_back(no_index);
      continue;
    }
    const auto [entry, is_new] = known.try_emplace(text, static_cast<Index>(known.size()));
    groups.of_rows.push_back(entry->second);
    if (!is_new) continue;
    groups.names.text += text;
    groups.names.ends.push_back(groups.names.text.size());
  }
  return groups;
}

// Returns areas in square kilometers, in the shortest digits that identify them.
Column area_column(const CellRings& cells, double radius_km) {
  Column column{"area_km2", true, {}, {}};
  for (const double area : areas(cells)) {
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), area * radius_km * radius_km).ptr;
    column.text.append(text.data(), end);
    column.ends.push_back(column.text.size());
  }
  return column;
}

// Returns these rows of a column.
Column rows_of(const Column& column, std::span<const Index> rows) {
  Column made{column.name, column.is_numeric, {}, {}};
  for (const Index row : rows) {
    const std::uint64_t begin = row == 0 ? 0 : column.ends[row - 1];
    made.text.append(column.text, begin, column.ends[row] - begin);
    made.ends.push_back(made.text.size());
    if (!column.is_number.empty()) made.is_number.push_back(column.is_number[row]);
  }
  return made;
}

// The written features: cells, or the pieces into which the values of --clip-value divide them.
struct Features {
  CellRings rings;
  std::vector<Column> columns;
};

// Cells of a table, whole or clipped; or, with --clip-value, their pieces in the polygons. One of
// both is empty.
struct Cut {
  CellRings cells;
  RegionPieces pieces;
  Groups values;  ///< values of the polygons
};

// Makes the features. The columns of the cells are the number in the table and the table's columns,
// or the name of the group.
Features features_of(const VoronoiOptions& options, Cut cut, const Groups& groups,
                     std::vector<Column> columns, const Execution& execution) {
  Features made;
  const bool is_joined = !options.group.empty();
  if (is_joined) columns = {groups.names};
  if (options.clip_value.empty()) {
    made.rings = is_joined
                     ? dissolve(cut.cells, groups.of_rows, groups.names.ends.size(), execution)
                     : std::move(cut.cells);
    made.columns = std::move(columns);
  } else {
    RegionPieces parts = dissolve(cut.pieces, groups.of_rows, cut.values.of_rows, execution);
    for (const Column& column : columns) made.columns.push_back(rows_of(column, parts.cells));
    Column values = rows_of(cut.values.names, parts.regions);
    if (std::ranges::find(made.columns, values.name, &Column::name) != made.columns.end()) {
      values.name = "clip_" + values.name;
    }
    made.columns.push_back(std::move(values));
    made.rings = std::move(parts.rings);
  }
  if (options.earth_radius_km > 0) {
    made.columns.push_back(area_column(made.rings, options.earth_radius_km));
  }
  return made;
}

struct Regions {
  Partition partition;
  Groups values;  ///< by --clip-value
};
Regions regions_of(const VoronoiOptions& options, const Execution& execution) {
  // Without --clip-value, clip() unites the polygons.
  PolygonOptions rules{.edges = options.edges};
  if (!options.clip_value.empty()) {
    rules.overlap = options.overlap;
    rules.is_taken = [&](std::size_t feature, std::span<const Column> columns) {
      const auto column = std::ranges::find(columns, options.clip_value, &Column::name);
      return column == columns.end() || !text_in_row(*column, feature).empty();
    };
  }
  const PolygonTable polygons = read_polygons({options.clip, {}}, rules, execution);
  tell(polygons.name, polygons.remarks);
  Groups values;
  if (!options.clip_value.empty()) {
    values =
        groups_of(column_of(polygons.columns, polygons.name, options.clip_value, "--clip-value"));
  }
  return {Partition(polygons.cells, execution), std::move(values)};
}

void write(Job& job, const VoronoiOptions& options, const Features& made) {
  const std::string format = options.common.format();
  job.time(Stage::write, [&] {
    if (is_format_of_gdal(format)) {
      write_regions_by_gdal(options.common.output, format, made.rings, made.columns,
                            options.tolerance_deg, job.execution());
    } else {
      write_regions(options.common.target(), made.rings, made.columns, options.tolerance_deg,
                    job.execution());
    }
  });
}

// Returns the number of the row and the table's columns.
std::vector<Column> numbered(const char* name, std::size_t size, std::vector<Column> columns) {
  columns.insert(columns.begin(), index_column(name, size));
  return columns;
}

Cut cut_cells_of_sites(const VoronoiOptions& options, const Triangulation& triangulation,
                       const Execution& execution) {
  const Partition all = Partition::voronoi(triangulation, execution);
  Cut cut;
  if (options.clip.empty()) {
    cut.cells = all.rings();
    return cut;
  }
  Regions regions = regions_of(options, execution);
  try {
    if (options.clip_value.empty()) {
      cut.cells = clip(all, regions.partition, execution);
    } else {
      cut.pieces = intersection(all, regions.partition, execution);
    }
  } catch (const InvalidInput& error) {
    throw FileError(options.clip + ": " + error.what());
  }
  cut.values = std::move(regions.values);
  return cut;
}

ExitStatus write_cells_of_sites(const VoronoiOptions& options) {
  Job job(options.common);
  SiteTable table = job.read();
  Groups groups;
  if (!options.group.empty()) {
    groups = groups_of(column_of(table.columns, table.name, options.group, "--group"));
  }
  const Triangulation triangulation = job.triangulate(table);
  Features made;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    made = features_of(options, cut_cells_of_sites(options, triangulation, execution), groups,
                       numbered("site", table.sites.size(), std::move(table.columns)), execution);
  });
  write(job, options, made);
  job.report(triangulation, !options.group.empty()  ? "the joined cells"
                            : !options.clip.empty() ? "the clipped cells"
                                                    : "the cells");
  return done;
}

Cut cut_cells_of_features(const VoronoiOptions& options, const FeatureTable& table,
                          const Execution& execution) {
  const double radius = options.earth_radius_km > 0 ? options.earth_radius_km : mean_earth_radius;
  const double tolerance = options.densify_km / radius;
  std::optional<Regions> regions;
  if (!options.clip.empty()) regions = regions_of(options, execution);
  Cut cut;
  try {
    if (!regions) {
      cut.cells = feature_cells(table.lines, table.polygons, tolerance, execution);
    } else if (options.clip_value.empty()) {
      cut.cells = clipped_feature_cells(table.lines, table.polygons, tolerance, regions->partition,
                                        execution);
    } else {
      cut.pieces =
          feature_pieces(table.lines, table.polygons, tolerance, regions->partition, execution);
    }
  } catch (const InvalidInput& error) {
    throw FileError(table.name + ": " + error.what());
  }
  if (regions) cut.values = std::move(regions->values);
  return cut;
}

bool has_place(const FeatureTable& table, std::size_t feature) {
  return table.lines.features[feature] < table.lines.features[feature + 1] ||
         table.polygons.cells[feature] < table.polygons.cells[feature + 1];
}

std::size_t count_unplaced(const FeatureTable& table) {
  std::size_t unplaced = 0;
  for (std::size_t f = 0; f < table.lines.num_features(); ++f) {
    if (!has_place(table, f)) ++unplaced;
  }
  return unplaced;
}

// Returns remarks on features that have a place but no cell.
std::vector<std::string> remarks_on(const FeatureTable& table, const CellRings& cells) {
  std::size_t without = 0;
  std::size_t first = 0;
  for (std::size_t f = 0; f < cells.num_cells(); ++f) {
    if (!has_place(table, f) || cells.cells[f] < cells.cells[f + 1] || cells.is_whole(f)) continue;
    if (without++ == 0) first = f;
  }
  if (without == 0) return {};
  return {count(without, "feature has", "features have") +
          " no cell, as others before have all of their places (" + (without > 1 ? "first " : "") +
          feature_name(table.columns, first) + ")"};
}

ExitStatus write_cells_of_features(const VoronoiOptions& options) {
  Job job(options.common);
  FeatureTable table;
  Features made;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    table = read_features(options.common.source(),
                          {.edges = options.edges, .overlap = options.overlap}, execution);
    tell(table.name, table.remarks);
    Groups groups;
    if (!options.group.empty()) {
      groups = groups_of(column_of(table.columns, table.name, options.group, "--group"));
    }
    Cut cut = cut_cells_of_features(options, table, execution);
    const std::size_t unplaced = count_unplaced(table);
    if (unplaced > 0 && !options.common.quiet) {
      tell(table.name, {"left out " + count(unplaced, "feature", "features") + " without a place"});
    }
    if (options.clip.empty()) tell(table.name, remarks_on(table, cut.cells));
    made = features_of(options, std::move(cut), groups,
                       numbered("feature", table.lines.num_features(), std::move(table.columns)),
                       execution);
  });
  write(job, options, made);
  const std::size_t count_of_features = table.lines.num_features();
  const double seconds = job.seconds().total;
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  job.report(
      nlohmann::ordered_json{{"features", count_of_features}, {"seconds", seconds}}.dump(2) + '\n',
      count(count_of_features, "feature", "features") + "\nwrote their cells to " +
          options.common.output + " in " + text + '\n');
  return done;
}

}  // namespace

bool makes_regions(const VoronoiOptions& options) {
  return !options.clip.empty() || !options.clip_value.empty() || !options.group.empty() ||
         options.densify_km > 0 || options.earth_radius_km > 0 ||
         is_format_of_gdal(options.common.format());
}

ExitStatus write_voronoi_regions(const VoronoiOptions& options) {
  const CommonOptions& common = options.common;
  if (!options.clip_value.empty() && options.clip.empty()) {
    throw UsageError("--clip-value goes with --clip, whose polygons have it");
  }
  if (is_format_of_gdal(common.format())) {
    require_gdal(common.output, common.format());
  } else if (common.format() != "geojson") {
    throw UsageError(
        "--clip, --group, --densify and --earth-radius write .geojson .gpkg .fgb .parquet, not '" +
        common.output + "'");
  }
  return options.densify_km > 0 ? write_cells_of_features(options) : write_cells_of_sites(options);
}

}  // namespace rondel::cli
