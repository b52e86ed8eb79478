// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "voronoi_regions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
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

constexpr double mean_earth_radius = 6371.0088;  // kilometres; of WGS 84, (2 a + b) / 3

const Column& column_of(const std::vector<Column>& columns, const std::string& file,
                        const std::string& name) {
  const auto column = std::ranges::find(columns, name, &Column::name);
  if (column == columns.end()) {
    throw UsageError("--group: " + file + " has no column '" + name + "'");
  }
  return *column;
}

// Numbers from 0 on, as a column.
Column index_column(const char* name, std::size_t size) {
  Column column{name, true, {}, {}};
  for (std::size_t i = 0; i < size; ++i) {
    column.text += std::to_string(i);
    column.ends.push_back(column.text.size());
  }
  return column;
}

// Which sites have the same text, groups in the order in which they come. Sites without a text have none.
struct Groups {
  std::vector<Index> of_sites;
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
      groups.of_sites.push_back(no_index);
      continue;
    }
    const auto [entry, is_new] = known.try_emplace(text, static_cast<Index>(known.size()));
    groups.of_sites.push_back(entry->second);
    if (!is_new) continue;
    groups.names.text += text;
    groups.names.ends.push_back(groups.names.text.size());
  }
  return groups;
}

// Areas in square kilometres, in the fewest digits that tell them.
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

// The columns of the cells: those of what they belong to, after its number, or the name of the group; and areas.
std::vector<Column> columns_of(const VoronoiOptions& options, const CellRings& cells,
                               Column numbers, std::vector<Column> given, Groups groups) {
  std::vector<Column> columns;
  if (options.group.empty()) {
    columns.push_back(std::move(numbers));
    for (Column& column : given) columns.push_back(std::move(column));
  } else {
    columns.push_back(std::move(groups.names));
  }
  if (options.earth_radius_km > 0) {
    columns.push_back(area_column(cells, options.earth_radius_km));
  }
  return columns;
}

std::string feature_name(const PolygonTable& polygons, Index feature) {
  std::string text = std::to_string(feature);
  for (const Column& column : polygons.columns) {
    if (column.name != "name" && column.name != "NAME") continue;
    const std::uint64_t begin = feature == 0 ? 0 : column.ends[feature - 1];
    return text + " (" + column.text.substr(begin, column.ends[feature] - begin) + ')';
  }
  return text;
}

// Polygons that overlap are an error of the file, but of few cells.
void warn_of_crossings(const PolygonTable& polygons, const Execution& execution) {
  const std::vector<CrossingCells> found = crossing_cells(polygons.cells, execution);
  if (found.empty()) return;
  const CrossingCells& one = found.front();
  const LonLat place = lonlats(std::vector<Point>{one.place})[0];
  const std::string what = one.first == one.second
                               ? "feature " + feature_name(polygons, one.first) + " crosses itself"
                               : "features " + feature_name(polygons, one.first) + " and " +
                                     feature_name(polygons, one.second) + " cross";
  const std::string more =
      found.size() > 1 ? ", and others (" + std::to_string(found.size()) + " in all)" : "";
  std::fprintf(stderr, "rondel: %s: %s at %.4f %.4f%s; cells overlap there\n",
               polygons.name.c_str(), what.c_str(), place.lon_deg, place.lat_deg, more.c_str());
}

Partition regions_of(const VoronoiOptions& options, const Execution& execution) {
  const PolygonTable polygons =
      read_polygons({options.clip, {}}, {.edges = options.edges}, execution);
  if (!options.common.quiet) warn_of_crossings(polygons, execution);
  return Partition(polygons.cells, execution);
}

void write(Job& job, const VoronoiOptions& options, const CellRings& cells,
           const std::vector<Column>& columns) {
  const std::string format = options.common.format();
  job.time(Stage::write, [&] {
    if (is_format_of_gdal(format)) {
      write_regions_by_gdal(options.common.output, format, cells, columns, options.tolerance_deg,
                            job.execution());
    } else {
      write_regions(options.common.target(), cells, columns, options.tolerance_deg,
                    job.execution());
    }
  });
}

ExitStatus write_cells_of_sites(const VoronoiOptions& options) {
  Job job(options.common);
  SiteTable table = job.read();
  Groups groups;
  if (!options.group.empty()) {
    groups = groups_of(column_of(table.columns, table.name, options.group));
  }
  const Triangulation triangulation = job.triangulate(table);
  CellRings cells;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    const Partition all = Partition::voronoi(triangulation, execution);
    cells =
        options.clip.empty() ? all.rings() : clip(all, regions_of(options, execution), execution);
    if (!options.group.empty()) {
      cells = dissolve(cells, groups.of_sites, groups.names.ends.size(), execution);
    }
  });
  write(job, options, cells,
        columns_of(options, cells, index_column("site", table.sites.size()),
                   std::move(table.columns), std::move(groups)));
  job.report(triangulation, !options.group.empty()  ? "the joined cells"
                            : !options.clip.empty() ? "the clipped cells"
                                                    : "the cells");
  return done;
}

CellRings cells_of_features(const VoronoiOptions& options, const FeatureTable& table,
                            const Execution& execution) {
  const double radius = options.earth_radius_km > 0 ? options.earth_radius_km : mean_earth_radius;
  const double tolerance = options.densify_km / radius;
  std::optional<Partition> regions;
  if (!options.clip.empty()) regions = regions_of(options, execution);
  try {
    return regions
               ? clipped_feature_cells(table.lines, table.polygons, tolerance, *regions, execution)
               : feature_cells(table.lines, table.polygons, tolerance, execution);
  } catch (const InvalidInput& error) {
    throw FileError(table.name + ": " + error.what());
  }
}

ExitStatus write_cells_of_features(const VoronoiOptions& options) {
  Job job(options.common);
  FeatureTable table;
  CellRings cells;
  Groups groups;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    table = read_features(options.common.source(), {.edges = options.edges}, execution);
    if (!options.group.empty()) {
      groups = groups_of(column_of(table.columns, table.name, options.group));
    }
    cells = cells_of_features(options, table, execution);
    if (!options.group.empty()) {
      cells = dissolve(cells, groups.of_sites, groups.names.ends.size(), execution);
    }
  });
  const std::size_t count_of_features = table.lines.num_features();
  write(job, options, cells,
        columns_of(options, cells, index_column("feature", count_of_features),
                   std::move(table.columns), std::move(groups)));
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
  return !options.clip.empty() || !options.group.empty() || options.densify_km > 0 ||
         options.earth_radius_km > 0 || is_format_of_gdal(options.common.format());
}

ExitStatus write_voronoi_regions(const VoronoiOptions& options) {
  const CommonOptions& common = options.common;
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
