// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the cells around points that were read without them, and names them in files of fields:
// describe_cells() of rondel/fields.h. Places count as the same up to the rounding of single precision.
#include "formats/field_cells.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/described_places.h"
#include "formats/grid_of_file.h"
#include "rondel/cell_set.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/names.h"
#include "rondel/read_cells.h"
#include "rondel/regrid.h"

namespace rondel {
namespace formats {
namespace {

// Returns the names that variables of the fields have.
std::set<std::string> taken_names(const FieldSet& fields) {
  std::set<std::string> names = {"lon", "lat"};
  for (const std::vector<FieldArray>* const arrays :
       {&fields.arrays, &fields.axes, &fields.others}) {
    for (const FieldArray& array : *arrays) names.insert(array.name);
  }
  return names;
}

// True if places that were read in two ways are one.
bool is_near(const LonLat& a, const LonLat& b) { return is_same_place(a, b, single_rounding_deg); }

bool is_same_axis(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double p, double q) { return is_near({p, 0}, {q, 0}); });
}

// Adds the lines of a grid along axes, if its places are those of the side; these become axes.
void add_lines(const CellFacts& grid, WeightSide& side) {
  if (grid.given_lines.lon_deg.empty() && grid.given_lines.lat_deg.empty()) return;
  if (side.axes.lon_deg.empty()) {
    if (!std::ranges::equal(grid.axes.places(), side.points, is_near)) return;
    side.axes = grid.axes;
  } else if (!is_same_axis(grid.axes.lon_deg, side.axes.lon_deg) ||
             !is_same_axis(grid.axes.lat_deg, side.axes.lat_deg)) {
    return;
  }
  side.lines = grid.given_lines;
}

// Says that points are those of a grid with a name, or the bounds of some of its cells; returns false
// for a file that names no grid.
bool describe_grid_of_file(const FileName& file, FieldSet& fields, WeightSide& points,
                           const Execution& execution) {
  const GridOfFile found = grid_of_file(file, true);
  if (found.name.empty()) return false;
  const NamedGrid grid(found.name);
  if (found.numbers.empty() && grid.num_cells() == points.points.size()) add_grid(grid, fields);
  if (!found.numbers.empty() && found.numbers.size() == points.points.size()) {
    points.corners = grid.cells(found.numbers, execution).bounds();
    points.has_bounds = !points.corners.empty();
  }
  return true;
}

}  // namespace

void add_grid(const NamedGrid& grid, FieldSet& fields) {
  const GridMapping mapping = grid.mapping();
  if (mapping.texts.empty()) return;
  if (mapping.texts.front().first == grid_attribute) {
    fields.attributes.push_back(mapping.texts.front());
    return;
  }
  FieldArray crs;
  crs.name = free_names({"crs"}, taken_names(fields)).front();
  crs.values = {0};
  crs.attributes = mapping.texts;
  for (const auto& [name, number] : mapping.numbers) crs.numbers.push_back({name, {number}, "i4"});
  for (FieldArray& array : fields.arrays) array.attributes.emplace_back("grid_mapping", crs.name);
  fields.others.push_back(std::move(crs));
}

void find_bounds(const FileName& file, WeightSide& side, const Execution& execution) {
  const std::size_t number = side.axes.lon_deg.empty()
                                 ? side.points.size()
                                 : side.axes.lon_deg.size() * side.axes.lat_deg.size();
  try {
    CellTable table = read_cells(file);
    if (table.num_cells() != number) return;
    if (table.grid) return add_lines(table.facts, side);
    const CellSet cells = CellSet::of(std::move(table), GridSides::parallels, execution);
    std::vector<LonLat> places = side.axes.lon_deg.empty() ? side.points : side.axes.places();
    if (!std::ranges::equal(cells.places(), places, is_near)) return;
    side.corners = cells.bounds();
    side.has_bounds = !side.corners.empty();
    if (!side.has_bounds) return;
    side.points = std::move(places);
    side.axes = {};
  } catch (const FileError&) {
    return;
  } catch (const InvalidInput&) {
    return;
  }
}

}  // namespace formats

void describe_cells(const FileName& target, FieldSet& fields, WeightSide& points,
                    const Execution& execution) {
  formats::DescribedPlaces described = formats::described_places(target, points.points.size());
  if (!described.remark.empty()) fields.remarks.push_back(described.remark);
  std::ranges::move(described.columns, std::back_inserter(points.columns));
  if (NamedGrid::is_name(target.path)) {
    formats::add_grid(NamedGrid(target.path), fields);
  } else if (!formats::is_read_once(target) && can_read_cells(target) &&
             !formats::describe_grid_of_file(target, fields, points, execution)) {
    formats::find_bounds(target, points, execution);
  }
}

}  // namespace rondel
