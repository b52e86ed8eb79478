// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "rondel/diagram.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "run.h"

namespace rondel::cli {
namespace {

const Column& column_of(const SiteTable& table, const std::string& name) {
  const auto column = std::ranges::find(table.columns, name, &Column::name);
  if (column == table.columns.end()) {
    throw UsageError("--group: " + table.name + " has no column '" + name + "'");
  }
  return *column;
}

// The indices of the sites, as a column.
Column site_column(std::size_t num_sites) {
  Column column{"site", true, {}, {}};
  for (std::size_t i = 0; i < num_sites; ++i) {
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

ExitStatus write_cut_cells(const VoronoiOptions& options) {
  const CommonOptions& common = options.common;
  if (common.format() != "geojson") {
    throw UsageError("--clip and --group write .geojson, not '" + common.output + "'");
  }
  Job job(common);
  SiteTable table = job.read();
  Groups groups;
  if (!options.group.empty()) groups = groups_of(column_of(table, options.group));
  const Triangulation triangulation = job.triangulate(table);
  CellRings cells;
  job.time(Stage::dual, [&] {
    const Partition partition = Partition::voronoi(triangulation, job.execution());
    if (options.clip.empty()) {
      cells = partition.rings();
    } else {
      const PolygonTable polygons =
          read_polygons(options.clip, {.edges = options.edges}, job.execution());
      cells = clip(partition, Partition(polygons.cells, job.execution()), job.execution());
    }
    if (!options.group.empty()) {
      cells = dissolve(cells, groups.of_sites, groups.names.ends.size(), job.execution());
    }
  });
  std::vector<Column> columns;
  if (options.group.empty()) {
    columns.push_back(site_column(table.sites.size()));
    for (Column& column : table.columns) columns.push_back(std::move(column));
  } else {
    columns.push_back(std::move(groups.names));
  }
  job.time(Stage::write, [&] {
    write_regions(common.target(), cells, columns, options.tolerance_deg, job.execution());
  });
  job.report(triangulation, options.group.empty() ? "the clipped cells" : "the joined cells");
  return done;
}

}  // namespace

ExitStatus run_voronoi(const VoronoiOptions& options) {
  CommonOptions common = options.common;
  require_output(common, can_write_cells(common.target()), ".geojson .vtp .npz");
  common.read.keep_columns = common.format() == "geojson";  // only GeoJSON has properties
  if (!options.clip.empty() || !options.group.empty()) {
    VoronoiOptions cut = options;
    cut.common = common;
    return write_cut_cells(cut);
  }
  Job job(common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  Diagram diagram;
  job.time(Stage::dual, [&] { diagram = rondel::diagram(triangulation, job.execution()); });
  job.time(Stage::write, [&] {
    write_cells(common.target(), table, triangulation, diagram, options.tolerance_deg,
                job.execution());
  });
  job.report(triangulation,
             common.build.model == Model::projected ? "the Voronoi cells" : "the power cells");
  return done;
}

}  // namespace rondel::cli
