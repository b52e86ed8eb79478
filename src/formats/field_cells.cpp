// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the cells around points that were read without them, and names them in files of fields:
// describe_cells() of rondel/fields.h. Places count as the same up to the rounding of single precision.
#include "formats/field_cells.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/field_choice.h"
#include "formats/grid_of_file.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
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

// True for a variable that describes the places along a dimension: texts, the axis of the dimension, and
// what has a role or is listed as a coordinate.
bool describes_places(const VariableHeader& variable, const std::string& dimension,
                      const std::set<std::string>& listed) {
  if (variable.dimensions.empty() || variable.dimensions[0] != dimension) return false;
  if (!variable.is_number || !variable.text("cf_role").empty()) return true;
  const bool is_measured =
      !variable.text("units").empty() || !variable.text("standard_name").empty();
  return variable.dimensions.size() == 1 &&
         (listed.contains(variable.name) || (variable.name == dimension && is_measured));
}

// Returns the names of such variables of a file, with commas between them.
std::string names_of_descriptions(const io::NetcdfReader& file, const std::string& values) {
  const std::vector<VariableHeader> headers = headers_of(file);
  const std::vector<CoordinatePair> pairs = find_coordinates(headers, {{}, {}, values});
  if (pairs.empty() || headers[pairs[0].lon].dimensions.size() != 1 || pairs[0].are_axes) return {};
  const CoordinatePair& own = pairs.front();
  std::set<std::string> listed;
  for (const VariableHeader& header : headers) {
    for (std::string& word : words_of(header.text("coordinates"))) listed.insert(std::move(word));
  }
  NameList names;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    if (i == own.lon || i == own.lat || i == own.lon_bounds || i == own.lat_bounds) continue;
    if (!describes_places(headers[i], headers[own.lon].dimensions[0], listed)) continue;
    names.add(headers[i].name);
  }
  return names.text();
}

}  // namespace

std::string remark_on_places(const FileName& target) {
  const auto [file, variable] = file_and_variable(target);
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file.path, error);
  if (NamedGrid::is_name(target.path) || !is_file || !is_netcdf_file(file)) return {};
  try {
    io::FileBytes bytes(file, true);
    const std::string names = names_of_descriptions(io::NetcdfReader(bytes), variable);
    return names.empty() ? "" : "left out, as they describe the places of the target: " + names;
  } catch (const io::BadValue&) {
    return {};  // which is told where the places are read
  } catch (const InvalidInput&) {
    return {};
  }
}

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
  const std::string remark = formats::remark_on_places(target);
  if (!remark.empty()) fields.remarks.push_back(remark);
  if (NamedGrid::is_name(target.path)) {
    formats::add_grid(NamedGrid(target.path), fields);
  } else if (!formats::is_read_once(target) && can_read_cells(target) &&
             !formats::describe_grid_of_file(target, fields, points, execution)) {
    formats::find_bounds(target, points, execution);
  }
}

}  // namespace rondel
