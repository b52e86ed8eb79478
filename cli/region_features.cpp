// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "region_features.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "column_values.h"
#include "report.h"

namespace rondel::cli {
namespace {

// Returns the numbers 0 ... size - 1 as a column.
Column index_column(const char* name, std::size_t size) {
  Column column{name, true, {}, {}};
  for (std::size_t i = 0; i < size; ++i) {
    column.text += std::to_string(i);
    column.ends.push_back(column.text.size());
  }
  return column;
}

// Returns areas in square kilometers.
Column area_column(const CellRings& cells, double radius_km) {
  std::vector<double> found = areas(cells);
  for (double& area : found) area = area * radius_km * radius_km;
  return numeric_column("area_km2", found);
}

}  // namespace

Column rows_of(const Column& column, std::span<const Index> rows) {
  Column made = column.empty_copy();
  for (const Index row : rows) {
    if (row != no_index) {
      made.add(column, row);
      continue;
    }
    made.ends.push_back(made.text.size());
    // Empty cells that are JSON are null.
    if (!column.is_json.empty()) made.is_json.push_back(true);
  }
  return made;
}

std::vector<Column> numbered(const char* name, std::size_t size, std::vector<Column> columns) {
  columns.insert(columns.begin(), index_column(name, size));
  return columns;
}

std::size_t num_not_empty(const CellRings& cells) {
  std::size_t number = cells.whole.size();
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    number += cells.cells[c] < cells.cells[c + 1] ? 1 : 0;
  }
  return number;
}

std::size_t num_not_empty(const Geometries& geometries) {
  const CellRings& polygons = geometries.polygons;
  std::size_t number = 0;
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    const bool is_empty = geometries.lines.offsets[i] == geometries.lines.offsets[i + 1] &&
                          polygons.cells[i] == polygons.cells[i + 1] && !polygons.is_whole(i);
    number += is_empty ? 0 : 1;
  }
  return number;
}

Groups groups_of(const std::vector<Column>& columns, const std::string& file,
                 const std::string& name, const std::string& option) {
  const auto found = std::ranges::find(columns, name, &Column::name);
  if (found == columns.end()) {
    throw UsageError(option + ": " + file + " has no column '" + name + "'");
  }
  const Column& column = *found;
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

// What is computed comes first, since names that are taken twice change.
Features features_of(const RegionsOptions& options, Cut cut, const Groups& groups,
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

Regions regions_of(const RegionsOptions& options, const Execution& execution) {
  // Without --clip-value, clip() unites the polygons.
  PolygonOptions rules{.edges = options.edges, .invalid = options.invalid};
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
    values = groups_of(facts.columns, facts.name, options.clip_value, "--clip-value");
  }
  return {CellSet::polygons(polygons.cells, execution), std::move(values)};
}

}  // namespace rondel::cli
