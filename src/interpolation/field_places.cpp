// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the values of a netCDF file are: longitudes and latitudes by the CF conventions, of each point, or
// along the two axes of a grid.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "interpolation/field_formats.h"
#include "rondel/delaunay.h"

namespace rondel::interpolation {
namespace {

using ReadVariable = io::NetcdfReader::Variable;

struct CoordinateNames {
  const char* standard;
  const char* unit;  // after "degree" or "degrees"
  const char* plain;
};
constexpr CoordinateNames longitude_names = {"longitude", "_east", "lon"};
constexpr CoordinateNames latitude_names = {"latitude", "_north", "lat"};

bool is_coordinate(const ReadVariable& variable, const CoordinateNames& names) {
  const std::string units = io::netcdf_text(variable.attributes, "units");
  return variable.type != io::NetcdfType::text &&
         (io::netcdf_text(variable.attributes, "standard_name") == names.standard ||
          units == std::string("degrees") + names.unit ||
          units == std::string("degree") + names.unit || variable.name == names.plain ||
          variable.name == names.standard);
}

// Whether a text of names with spaces between them has this one.
bool has_word(const std::string& text, const std::string& word) {
  return (' ' + text + ' ').find(' ' + word + ' ') != std::string::npos;
}

// The one that the attribute `coordinates` of the values names; else the only one of these dimensions.
// Null if there are several.
const ReadVariable* coordinate(const io::NetcdfReader& file, const ReadVariable& values,
                               const CoordinateNames& names,
                               const std::vector<std::size_t>& dimensions) {
  const std::string listed = io::netcdf_text(values.attributes, "coordinates");
  const ReadVariable* found = nullptr;
  std::size_t count = 0;
  for (const ReadVariable& variable : file.variables()) {
    if (variable.dimensions != dimensions || !is_coordinate(variable, names)) continue;
    if (has_word(listed, variable.name)) return &variable;
    found = &variable;
    ++count;
  }
  return count == 1 ? found : nullptr;
}

std::vector<double> degrees_of(const io::NetcdfReader& file, const ReadVariable& variable) {
  std::vector<double> values = file.numbers(variable);
  if (io::netcdf_text(variable.attributes, "units").starts_with("rad")) {
    for (double& value : values) value *= 180 / std::numbers::pi;
  }
  return values;
}

bool is_place(const LonLat& place) {
  return std::abs(place.lon_deg) <= 1e6 && std::abs(place.lat_deg) <= 90;
}

}  // namespace

std::vector<Point> field_places(const io::NetcdfReader& file, const ReadVariable& values,
                                std::size_t num_dimensions) {
  const std::vector<std::size_t> own(
      values.dimensions.end() - static_cast<std::ptrdiff_t>(num_dimensions),
      values.dimensions.end());
  std::vector<LonLat> places;
  const ReadVariable* lon = coordinate(file, values, longitude_names, own);
  const ReadVariable* lat = coordinate(file, values, latitude_names, own);
  if (lon != nullptr && lat != nullptr) {
    const std::vector<double> x = degrees_of(file, *lon);
    const std::vector<double> y = degrees_of(file, *lat);
    for (std::size_t i = 0; i < x.size(); ++i) places.push_back({x[i], y[i]});
  } else if (own.size() == 2) {
    lon = coordinate(file, values, longitude_names, {own[1]});
    lat = coordinate(file, values, latitude_names, {own[0]});
    if (lon == nullptr || lat == nullptr) return {};
    const std::vector<double> x = degrees_of(file, *lon);
    for (const double y : degrees_of(file, *lat)) {
      for (const double of_row : x) places.push_back({of_row, y});
    }
  }
  if (!std::ranges::all_of(places, is_place)) return {};
  return unit_vectors(places);
}

}  // namespace rondel::interpolation
