// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tells by their attributes and names which variables are longitudes and latitudes, and along which
// dimensions they only repeat: CF 1.11, sections 4.1, 4.2 and 5. Which ones belong together is in
// coordinate_search.cpp.
#include <algorithm>
#include <string>

#include "formats/cf_names.h"
#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel {
namespace {

using formats::CoordinateKind;

// The attributes by which CF marks longitudes, or latitudes.
struct DirectionMarks {
  std::string_view standard_name;
  std::string_view axis_type;  // used by netCDF-Java
  std::vector<std::string_view> units;
};

// Returns the marks of longitudes or latitudes.
const DirectionMarks& marks_of(CoordinateKind kind) {
  static const DirectionMarks east = {
      "longitude",
      "Lon",
      {"degrees_east", "degree_east", "degree_e", "degrees_e", "degreee", "degreese"}};
  static const DirectionMarks north = {
      "latitude",
      "Lat",
      {"degrees_north", "degree_north", "degree_n", "degrees_n", "degreen", "degreesn"}};
  return kind == CoordinateKind::lon ? east : north;
}

// True if the units are degrees in the direction of the marks.
bool has_unit(const DirectionMarks& marks, const std::string& units) {
  const std::string lower = formats::lower_case(formats::without_blanks(units));
  return std::ranges::find(marks.units, lower) != marks.units.end();
}

}  // namespace

namespace formats {

int coordinate_evidence(const VariableHeader& variable, CoordinateKind kind) {
  if (!variable.is_number || variable.shape.empty() || is_rotated_or_projected(variable)) return 0;
  const DirectionMarks& marks = marks_of(kind);
  const std::string standard_name = variable.text("standard_name");
  if (standard_name == marks.standard_name) return 3;
  const std::string units = variable.text("units");
  if (has_unit(marks, units) || variable.text("_CoordinateAxisType") == marks.axis_type) return 2;
  // A standard_name or units that say something else outweigh the name of the variable.
  const bool is_denied =
      !standard_name.empty() ||
      (!formats::without_blanks(units).empty() && !degrees_per_unit(units)) ||
      has_unit(marks_of(kind == CoordinateKind::lon ? CoordinateKind::lat : CoordinateKind::lon),
               units);
  return !is_denied && formats::is_known_name(variable.name, kind) ? 1 : 0;
}

std::string remark_on_units(std::span<const VariableHeader> variables) {
  std::string remark;
  for (const VariableHeader& variable : variables) {
    if (is_rotated_or_projected(variable)) remark += "; " + remark_on_rotation(variable);
    const std::string units = variable.text("units");
    const bool is_called_so = is_known_name(variable.name, CoordinateKind::lon) ||
                              is_known_name(variable.name, CoordinateKind::lat);
    if (!is_called_so || without_blanks(units).empty() || degrees_per_unit(units)) continue;
    remark += "; '" + variable.name + "' has the units '" + units +
              "', which are neither degrees nor radians";
  }
  return remark;
}

}  // namespace formats

std::string VariableHeader::text(std::string_view attribute) const {
  const auto at = std::ranges::find(texts, attribute, &std::pair<std::string, std::string>::first);
  return at == texts.end() ? std::string() : at->second;
}

std::vector<bool> repeated_dimensions(std::span<const std::string> names,
                                      std::span<const std::uint64_t> shape,
                                      std::span<const double> lon, std::span<const double> lat) {
  std::uint64_t size = 1;
  for (const std::uint64_t length : shape) size *= length;
  if (lon.size() != size || lat.size() != size || names.size() != shape.size()) {
    throw InvalidInput(std::to_string(lon.size()) + " longitudes and " +
                           std::to_string(lat.size()) + " latitudes are not " +
                           std::to_string(size),
                       0);
  }
  std::vector<bool> repeated(shape.size(), false);
  if (shape.size() < 2) return repeated;
  const auto is_same = [](double a, double b) { return a == b || (a != a && b != b); };
  std::size_t stride = size;
  std::size_t num_kept = shape.size();
  for (std::size_t d = 0; d < shape.size(); ++d) {
    // The number of values for one index of the dimensions before this one.
    const std::size_t block = stride;
    stride = shape[d] == 0 ? 0 : block / shape[d];
    const bool is_time = is_name_of_time(names[d]);
    // One dimension is always kept, and so is one of length 1 that is not called time.
    if (shape[d] == 0 || (shape[d] == 1 && !is_time) || num_kept == 1) continue;
    bool changes = false;
    for (std::size_t i = 0; i < size && !changes; ++i) {
      // This is the value at index 0 of dimension d, and the same indices of the others.
      const std::size_t first = i - i % block + i % stride;
      changes = !is_same(lon[i], lon[first]) || !is_same(lat[i], lat[first]);
    }
    if (changes && is_time && shape.size() > 2) {
      throw InvalidInput("longitudes and latitudes change along '" + names[d] + "'", d);
    }
    repeated[d] = !changes;
    if (!changes) --num_kept;
  }
  return repeated;
}

}  // namespace rondel
