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
#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/weight_files.h"

namespace rondel::cli {
namespace {

constexpr double mean_earth_radius = 6371.0088;  // kilometers; WGS 84, (2 a + b) / 3

// Returns the column of this name. \throws UsageError, which begins with the option
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
// Returns the group of each row by its text in a column; equal texts are one group.
Groups groups_of(const Column& column) {
  Groups groups{{}, column.empty_copy()};
  std::unordered_map<std::string_view, Index> known;
  for (std::size_t row = 0; row < column.ends.size(); ++row) {
    const std::string_view text = column.cell(row);
    if (text.empty()) {
      groups.of_rows.push_back(no_index);
      continue;
    }
    const auto [entry, is_new] = known.try_emplace(text, static_cast<Index>(known.size()));
    groups.of_rows.push_back(entry->second);
    if (is_new) groups.names.add(column, row);
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
  Column made = column.empty_copy();
  for (const Index row : rows) made.add(column, row);
  return made;
}

// The written features: cells, or the pieces into which the values of --clip-value divide them.
struct Features {
  CellRings rings;
  std::vector<Column> columns;
  Column ids;  ///< without cells where a feature comes from several ones
};

// Cells of a table, whole or clipped; or, with --clip-value, their pieces in the polygons. One of
// both is empty.
struct Cut {
  CellRings cells;
  RegionPieces pieces;
  Groups values;  ///< values of the polygons
};

// Makes the features. The columns of the cells are the number in the table and the table's columns,
// or the name of the group. What is computed comes first, since names that are taken twice change.
Features features_of(const VoronoiOptions& options, Cut cut, const Groups& groups,
                     std::vector<Column> columns, const Column& ids, const Execution& execution) {
  Features made;
  const bool is_joined = !options.group.empty();
  if (is_joined) columns = {groups.names};
  if (options.clip_value.empty()) {
    made.rings = is_joined
                     ? dissolve(cut.cells, groups.of_rows, groups.names.ends.size(), execution)
                     : std::move(cut.cells);
    made.columns = std::move(columns);
    if (!is_joined) made.ids = ids;
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
    const auto place = made.columns.begin() + (is_joined ? 0 : 1);  // behind the number
    made.columns.insert(place, area_column(made.rings, options.earth_radius_km));
  }
  return made;
}

// The polygons of --clip, and the groups of their values.
struct Regions {
  CellSet cells;
  Groups values;  ///< by --clip-value
};
// Reads the polygons of --clip.
Regions regions_of(const VoronoiOptions& options, const Execution& execution) {
  // Without --clip-value, clip() unites the polygons.
  PolygonOptions rules{.edges = options.edges};
  if (!options.clip_value.empty()) {
    rules.overlap = options.overlap;
    rules.is_taken = [&](std::size_t feature, std::span<const Column> columns) {
      const auto column = std::ranges::find(columns, options.clip_value, &Column::name);
      return column == columns.end() || !column->cell(feature).empty();
    };
  }
  const CellTable polygons = read_polygons({options.clip, {}}, rules, execution);
  const CellFacts& facts = polygons.facts;
  tell(facts.name, facts.remarks);
  Groups values;
  if (!options.clip_value.empty()) {
    values = groups_of(column_of(facts.columns, facts.name, options.clip_value, "--clip-value"));
  }
  return {CellSet::polygons(polygons.cells, execution), std::move(values)};
}

// Writes the features as GeoJSON, or by GDAL in one of its formats.
void write(Job& job, const VoronoiOptions& options, const Features& made) {
  const std::string format = options.common.format();
  job.time(Stage::write, [&] {
    if (is_format_of_gdal(format)) {
      write_regions_by_gdal(options.common.output, format, made.rings, made.columns,
                            options.tolerance_deg, job.execution());
    } else {
      write_regions(options.common.target(), made.rings, made.columns, options.tolerance_deg,
                    job.execution(), made.ids);
    }
  });
}

// Returns the number of the row and the table's columns.
std::vector<Column> numbered(const char* name, std::size_t size, std::vector<Column> columns) {
  columns.insert(columns.begin(), index_column(name, size));
  return columns;
}

// Returns a remark on groups none of whose sites has a cell.
std::vector<std::string> remarks_on_groups(const Groups& groups,
                                           const Triangulation& triangulation) {
  const std::size_t size = groups.names.ends.size();
  if (size == 0) return {};
  std::vector<bool> has_cell(groups.of_rows.size(), true);
  for (const Duplicate& duplicate : triangulation.duplicates()) has_cell[duplicate.site] = false;
  for (const Hidden& hidden : triangulation.hidden()) has_cell[hidden.site] = false;
  std::vector<bool> is_seen(size);
  for (std::size_t i = 0; i < groups.of_rows.size(); ++i) {
    if (has_cell[i] && groups.of_rows[i] != no_index) is_seen[groups.of_rows[i]] = true;
  }
  const auto lost = static_cast<std::size_t>(std::ranges::count(is_seen, false));
  if (lost == 0) return {};
  const auto first = static_cast<std::size_t>(std::ranges::find(is_seen, false) - is_seen.begin());
  return {count(lost, "group of ", "groups of ") + "'" + groups.names.name +
          (lost > 1 ? "' have" : "' has") +
          " no cell, as all sites are hidden or at the place of one before (" +
          (lost > 1 ? "first '" : "'") + std::string(groups.names.cell(first)) + "')"};
}

// Returns the Voronoi cells of the sites, clipped if --clip is given.
Cut cut_cells_of_sites(const VoronoiOptions& options, const Triangulation& triangulation,
                       const Execution& execution) {
  const CellSet all = CellSet::voronoi(triangulation, execution);
  Cut cut;
  if (options.clip.empty()) {
    cut.cells = all.rings();
    return cut;
  }
  Regions regions = regions_of(options, execution);
  try {
    if (options.clip_value.empty()) {
      cut.cells = clip(all, regions.cells, execution);
    } else {
      cut.pieces = intersection(all, regions.cells, execution);
    }
  } catch (const InvalidInput& error) {
    throw FileError(options.clip + ": " + error.what());
  }
  cut.values = std::move(regions.values);
  return cut;
}

// Runs the command for sites.
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
                       numbered("site", table.sites.size(), std::move(table.columns)), table.ids,
                       execution);
  });
  write(job, options, made);
  tell(table.name, remarks_on_groups(groups, triangulation));
  job.report(triangulation, !options.group.empty()  ? "the joined cells"
                            : !options.clip.empty() ? "the clipped cells"
                                                    : "the cells");
  return done;
}

// Returns the cells of lines and polygons. The tolerance of --densify becomes an angle in radians
// on a sphere of --earth-radius, or of the mean radius of the Earth.
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
      cut.cells =
          clipped_feature_cells(table.lines, table.polygons, tolerance, regions->cells, execution);
    } else {
      cut.pieces =
          feature_pieces(table.lines, table.polygons, tolerance, regions->cells, execution);
    }
  } catch (const InvalidInput& error) {
    throw FileError(table.facts.name + ": " + error.what());
  }
  if (regions) cut.values = std::move(regions->values);
  return cut;
}

// Returns remarks on features without a geometry, and on those that have one but no cell. What lies
// outside of --clip has no cell either, so with that only polygons are told that lie in others
// before.
std::vector<std::string> remarks_on(const FeatureTable& table, const Cut& cut, bool is_clipped,
                                    bool is_quiet) {
  std::size_t unlocated = 0;
  std::size_t without = 0;
  std::size_t first = 0;
  for (std::size_t f = 0; f < table.lines.num_features(); ++f) {
    if (!table.is_located[f]) {
      ++unlocated;
      continue;
    }
    const CellRings& cells = is_clipped ? table.polygons : cut.cells;
    const bool has_line = table.lines.features[f] < table.lines.features[f + 1];
    if (cells.cells[f] < cells.cells[f + 1] || cells.is_whole(f) || (is_clipped && has_line)) {
      continue;
    }
    if (without++ == 0) first = f;
  }
  std::vector<std::string> remarks;
  if (unlocated > 0 && !is_quiet) {
    remarks.push_back("left out " + count(unlocated, "feature", "features") + " without a place");
  }
  if (without > 0) {
    remarks.push_back(count(without, "feature has", "features have") +
                      " no cell, as others before have all of their places" +
                      (table.facts.remarks.empty() ? "" : " or rounding leaves nothing of them") +
                      " (" + (without > 1 ? "first " : "") +
                      feature_name(table.facts.columns, first) + ")");
  }
  return remarks;
}

// Runs the command for lines and polygons.
ExitStatus write_cells_of_features(const VoronoiOptions& options) {
  Job job(options.common);
  FeatureTable table;
  Features made;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    table = read_features(options.common.source(),
                          {.edges = options.edges, .overlap = options.overlap}, execution);
    tell(table.facts.name, table.facts.remarks);
    Groups groups;
    if (!options.group.empty()) {
      groups =
          groups_of(column_of(table.facts.columns, table.facts.name, options.group, "--group"));
    }
    Cut cut = cut_cells_of_features(options, table, execution);
    tell(table.facts.name, remarks_on(table, cut, !options.clip.empty(), options.common.quiet));
    made =
        features_of(options, std::move(cut), groups,
                    numbered("feature", table.lines.num_features(), std::move(table.facts.columns)),
                    table.ids, execution);
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
