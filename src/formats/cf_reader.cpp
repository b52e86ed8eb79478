// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads variables as CF means them: packed numbers are unpacked, missing ones become NaN (sections
// 2.5.1 and 8.1), and angles become degrees. places_of() pairs longitudes with latitudes and drops
// dimensions along which they only repeat, such as time.
#include "formats/cf_reader.h"

#include <algorithm>
#include <numbers>

#include "formats/cf_names.h"
#include "formats/cf_values.h"
#include "formats/mpas_places.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "rondel/error.h"

namespace rondel::formats {

VariableHeader header_of(const io::NetcdfReader& file, const io::VariableInFile& variable) {
  VariableHeader header;
  header.name = variable.name;
  header.is_number = variable.type != io::NetcdfType::text;
  header.is_integer = header.is_number && variable.type != io::NetcdfType::float32 &&
                      variable.type != io::NetcdfType::float64;
  for (const std::size_t dimension : variable.dimensions) {
    header.dimensions.push_back(file.dimensions()[dimension].name);
  }
  header.shape = variable.shape;
  for (const io::NetcdfAttribute& attribute : variable.attributes) {
    // Numbers among the attributes are rules for values, which cf_values.h reads.
    if (attribute.type == io::NetcdfType::text) {
      header.texts.emplace_back(attribute.name, attribute.text);
    }
  }
  return header;
}

std::vector<VariableHeader> headers_of(const io::NetcdfReader& file) {
  std::vector<VariableHeader> headers;
  for (const io::VariableInFile& variable : file.variables()) {
    headers.push_back(header_of(file, variable));
  }
  return headers;
}

std::vector<double> meant_numbers(const io::NetcdfReader& file,
                                  const io::VariableInFile& variable) {
  std::vector<double> values = file.numbers(variable);
  ValueRules(variable).apply(values);
  return values;
}

void require_sphere(const io::NetcdfReader& file) {
  const std::pair<std::string, std::string> on_a_sphere = {
      "on_a_sphere", io::netcdf_text(file.attributes(), "on_a_sphere")};
  if (is_planar({&on_a_sphere, 1})) {
    throw io::BadValue("the mesh is in the plane: on_a_sphere is NO");
  }
}

namespace {

// Throws BadValue if places count from another meridian than that of Greenwich.
void require_greenwich(const io::NetcdfReader& file, const io::VariableInFile& coordinate) {
  std::vector<std::pair<std::string, double>> meridians;
  for (const io::VariableInFile& variable : file.variables()) {
    const io::NetcdfAttribute* const attribute =
        io::find_attribute(variable.attributes, "longitude_of_prime_meridian");
    if (attribute == nullptr || attribute->numbers.empty()) continue;
    if (attribute->numbers.front() != 0) {
      meridians.emplace_back(variable.name, attribute->numbers.front());
    }
  }
  if (meridians.empty()) return;
  const std::string why = remark_on_meridian(headers_of(file), coordinate.name, meridians);
  if (!why.empty()) throw io::BadValue(why);
}

// Returns the degrees in a unit of the variable, by its own units, those of relatives, or the usual
// ones.
double degrees_per_unit_of(const io::NetcdfReader& file, const io::VariableInFile& variable,
                           UsualUnits usual,
                           std::initializer_list<const io::VariableInFile*> relatives) {
  const VariableHeader own = header_of(file, variable);
  std::vector<VariableHeader> headers;
  // Pointers into this vector are kept, so it must not move.
  headers.reserve(relatives.size());
  std::vector<const VariableHeader*> known;
  bool has_units = !without_blanks(own.text("units")).empty();
  for (const io::VariableInFile* const relative : relatives) {
    known.push_back(nullptr);
    if (relative == nullptr) continue;
    known.back() = &headers.emplace_back(header_of(file, *relative));
    has_units = has_units || !without_blanks(headers.back().text("units")).empty();
  }
  // The units of the convention count only where the file says nothing at all.
  const bool is_usual = !has_units && !is_rotated_or_projected(own);
  if (!is_usual || usual == UsualUnits::of_name) return degrees_per_unit(own, known);
  return usual == UsualUnits::radians ? 180 / std::numbers::pi : 1;
}

}  // namespace

std::vector<double> degrees_of(const io::NetcdfReader& file, const io::VariableInFile& variable,
                               UsualUnits usual,
                               std::initializer_list<const io::VariableInFile*> relatives) {
  require_sphere(file);
  require_greenwich(file, variable);
  double factor = 1;
  try {
    factor = degrees_per_unit_of(file, variable, usual, relatives);
  } catch (const InvalidInput& error) {
    throw io::BadValue(error.what());
  }
  std::vector<double> values = meant_numbers(file, variable);
  if (factor != 1) {
    for (double& value : values) value *= factor;
  }
  return values;
}

std::vector<double> transposed(std::span<const std::uint64_t> shape,
                               const std::vector<std::size_t>& order, std::vector<double> values) {
  if (std::ranges::is_sorted(order) || values.empty()) return values;
  const std::size_t rank = order.size();
  // The distance in `values` of neighbors along each dimension.
  std::vector<std::size_t> steps(rank, 1);
  for (std::size_t w = 0; w < rank; ++w) {
    for (std::size_t after = order[w] + 1; after < rank; ++after) steps[w] *= shape[after];
  }
  std::vector<double> ordered;
  ordered.reserve(values.size());
  // `at` counts through the new array, the last index fastest; `place` follows in the old one.
  std::vector<std::size_t> at(rank, 0);
  std::size_t place = 0;
  while (ordered.size() < values.size()) {
    ordered.push_back(values[place]);
    for (std::size_t w = rank; w-- > 0;) {
      const std::size_t length = shape[order[w]];
      place += steps[w];
      if (++at[w] < length) break;
      place -= steps[w] * length;
      at[w] = 0;
    }
  }
  return ordered;
}

std::vector<double> in_order(const io::VariableInFile& variable,
                             const std::vector<std::size_t>& wanted, std::vector<double> values) {
  std::vector<std::size_t> order;
  for (const std::size_t dimension : wanted) {
    const auto at = std::ranges::find(variable.dimensions, dimension);
    order.push_back(static_cast<std::size_t>(at - variable.dimensions.begin()));
  }
  return transposed(variable.shape, order, std::move(values));
}

namespace {

// True if the first of several dimensions is one of time.
bool has_time_first(const io::NetcdfReader& file, const io::VariableInFile& variable) {
  return variable.shape.size() > 1 && variable.shape.front() > 1 &&
         is_name_of_time(file.dimensions()[variable.dimensions.front()].name);
}

// True if the values are the same at each index of the first dimension, which are read one after
// the other.
bool is_repeated_along_first(const io::NetcdfReader& file, const io::VariableInFile& variable) {
  const std::uint64_t size = variable.num_values / variable.shape.front();
  std::vector<double> first(size);
  std::vector<double> other(size);
  file.read_numbers(variable, 0, first);
  const auto is_same = [](double a, double b) { return a == b || (a != a && b != b); };
  for (std::uint64_t begin = size; begin < variable.num_values; begin += size) {
    file.read_numbers(variable, begin, other);
    if (!std::ranges::equal(first, other, is_same)) return false;
  }
  return true;
}

// Returns the variable with only the first index of its first dimension.
io::VariableInFile at_first_place(io::VariableInFile variable) {
  variable.num_values /= variable.shape.front();
  variable.shape.front() = 1;
  return variable;
}

}  // namespace

io::VariableInFile without_times(const io::NetcdfReader& file, const io::VariableInFile& variable) {
  // Without room for the values in the file, reading them is an error.
  const bool is_time = variable.num_values <= file.max_values() && has_time_first(file, variable);
  return is_time && is_repeated_along_first(file, variable) ? at_first_place(variable) : variable;
}

PlaceArrays places_of(const io::NetcdfReader& file, const io::VariableInFile& lon,
                      const io::VariableInFile& lat, UsualUnits usual) {
  for (const std::string kind : {"Cell", "Edge", "Vertex"}) {
    if (lon.name == "lon" + kind && lat.name == "lat" + kind)
      require_one_place(file, kind, PlacesMay::be_missing);
  }
  // Places that are repeated at many times need not be in memory together.
  // Without room for them in the file, reading them below is an error.
  const bool has_room = lon.num_values <= file.max_values();
  if (has_room && has_time_first(file, lon) && has_time_first(file, lat) &&
      lon.shape == lat.shape && is_repeated_along_first(file, lon) &&
      is_repeated_along_first(file, lat)) {
    return places_of(file, at_first_place(lon), at_first_place(lat), usual);
  }
  PlaceArrays places{lon.dimensions,
                     lon.shape,
                     {},
                     degrees_of(file, lon, usual, {nullptr, &lat}),
                     degrees_of(file, lat, usual, {nullptr, &lon})};
  if (places.lon.size() != places.lat.size()) {
    throw io::BadValue("variable " + io::in_quotes(lat.name) + " has " +
                       std::to_string(lat.num_values) + " values instead of " +
                       std::to_string(lon.num_values));
  }
  if (std::ranges::is_permutation(lon.dimensions, lat.dimensions)) {
    places.lat = in_order(lat, lon.dimensions, std::move(places.lat));
  }
  if (places.dimensions.size() < 2) return places;
  std::vector<bool> is_repeated;
  try {
    is_repeated =
        repeated_dimensions(header_of(file, lon).dimensions, lon.shape, places.lon, places.lat);
  } catch (const InvalidInput& error) {
    throw io::BadValue(io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name) + ": " +
                       error.what());
  }
  std::vector<std::size_t> order;
  std::vector<std::size_t> kept;
  std::vector<std::uint64_t> shape;
  std::size_t size = 1;
  for (std::size_t d = 0; d < lon.dimensions.size(); ++d) {
    if (is_repeated[d]) {
      order.push_back(lon.dimensions[d]);
      continue;
    }
    kept.push_back(lon.dimensions[d]);
    shape.push_back(lon.shape[d]);
    size *= lon.shape[d];
  }
  if (order.empty()) return places;
  places.repeated = order;
  order.insert(order.end(), kept.begin(), kept.end());
  for (std::vector<double>* values : {&places.lon, &places.lat}) {
    *values = in_order(lon, order, std::move(*values));
    values->resize(size);
  }
  places.dimensions = std::move(kept);
  places.shape = std::move(shape);
  return places;
}

}  // namespace rondel::formats
