// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that the ESMF and SCRIP formats of weights share: the variables of both sides under the
// names of each format, the attributes of this library, and the sorting of entries into rows.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "formats/cf_reader.h"
#include "formats/weight_formats.h"
#include "io/bad_value.h"
#include "io/column_text.h"
#include "io/number.h"
#include "system/message_text.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

// These global attributes are this library's own; other programs pass over them.
constexpr const char* source_hash_name = "rondel_source_hash";
constexpr const char* target_hash_name = "rondel_target_hash";
constexpr const char* method_name = "rondel_method";
constexpr const char* source_table_name = "rondel_source_table";
constexpr const char* target_table_name = "rondel_target_table";

// Returns a hash as 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t hash) {
  std::array<char, 16> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16).ptr;
  const std::string text(digits.data(), end);
  return std::string(digits.size() - text.size(), '0') + text;
}

// Returns the hash in an attribute; 0 if there is none. Throws BadValue for other texts.
std::uint64_t hash_of(const io::NetcdfReader& file, const char* name) {
  const std::string text = io::netcdf_text(file.attributes(), name);
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (!text.empty() && (error != std::errc{} || end != text.data() + text.size())) {
    throw io::BadValue("attribute " + std::string(name) + " is " + io::in_quotes(text) +
                       ", not a hash");
  }
  return hash;
}

// Writes the texts of cells as one table in an attribute, since the classic formats have no
// strings.
void add_table(io::NetcdfWriter& out, const char* name, const WeightSide& side) {
  constexpr std::size_t max_bytes = std::size_t{1} << 28U;  // readers load an attribute at once
  const std::string table = io::csv_of(side.columns);
  if (!table.empty() && table.size() <= max_bytes) out.add_attribute(name, table);
}

// Reads the table of add_table() into the columns of a side, which is left without columns if there
// is no table. Throws BadValue if it has not `size` rows.
void read_table(const io::NetcdfReader& file, const char* name, std::size_t size,
                WeightSide& side) {
  const std::string table = io::netcdf_text(file.attributes(), name);
  try {
    side.columns = io::columns_of_csv(table, size);
  } catch (const io::BadValue& bad) {
    throw io::BadValue("attribute " + std::string(name) + ": " + bad.what());
  }
}

// Throws BadValue, with the name of the variable, for another number of values.
template <typename Values>
void require_size(const std::string& name, const Values& values, std::size_t size) {
  if (values.size() == size) return;
  throw io::BadValue("variable " + io::in_quotes(name) + " has " + std::to_string(values.size()) +
                     " values instead of " + std::to_string(size));
}

// Returns the `size` values of a variable; empty if there is no such variable or all of them are 0,
// which programs write for numbers that they do not know.
std::vector<double> numbers_of(const io::NetcdfReader& file, const std::string& name,
                               std::size_t size) {
  const io::VariableInFile* const variable = file.find(name);
  if (variable == nullptr) return {};
  std::vector<double> values = meant_numbers(file, *variable);
  require_size(name, values, size);
  if (std::ranges::all_of(values, [](double value) { return value == 0; })) values.clear();
  return values;
}

using NamesOfPair = std::array<std::string, 2>;

// Returns the longitudes and latitudes of the first pair in degrees. A variable without units has
// those of the other one of its kind, or else of any of the four.
std::array<std::vector<double>, 2> degrees_of_pair(const io::NetcdfReader& file,
                                                   const NamesOfPair& wanted,
                                                   const NamesOfPair& related) {
  std::array<std::vector<double>, 2> degrees;
  for (const std::size_t k : {0U, 1U}) {
    degrees[k] =
        degrees_of(file, file.require(wanted[k]), UsualUnits::degrees,
                   {file.find(related[k]), file.find(wanted[1 - k]), file.find(related[1 - k])});
  }
  return degrees;
}

// Returns a place of the file; both numbers are NaN if one of them is missing. Throws BadValue for
// numbers that are no place.
LonLat place_of_side(const SideNames& names, std::size_t i, double lon, double lat) {
  constexpr double no_degrees = std::numeric_limits<double>::quiet_NaN();
  const bool is_lon = !std::isinf(lon);
  const bool is_lat = std::isnan(lat) || std::abs(lat) <= 90 + max_beyond_pole_deg;
  if (!is_lon || !is_lat) {
    throw io::BadValue("value " + std::to_string(i) + " of " + io::in_quotes(names.lon) + " and " +
                       io::in_quotes(names.lat) + ", " + system::shortest_text(lon) + " and " +
                       system::shortest_text(lat) + " degrees, is no place");
  }
  if (std::isnan(lon) || std::isnan(lat)) return {no_degrees, no_degrees};
  return {lon, std::clamp(lat, -90.0, 90.0)};
}

// Reads the corners of cells in degrees. Files of points have one corner each, or none: these are
// left out. Throws BadValue if the numbers do not fit.
void read_corners(const io::NetcdfReader& file, const SideNames& names, std::size_t size,
                  WeightSide& side) {
  if (file.find(names.corner_lon) == nullptr || file.find(names.corner_lat) == nullptr) return;
  const auto [lon, lat] =
      degrees_of_pair(file, {names.corner_lon, names.corner_lat}, {names.lon, names.lat});
  // One corner for each place is no cell.
  if (lon.size() <= size) return;
  if (size == 0 || lon.size() % size != 0) {
    throw io::BadValue("variable " + io::in_quotes(names.corner_lon) + " has " +
                       std::to_string(lon.size()) + " values for " + std::to_string(size) +
                       " cells");
  }
  require_size(names.corner_lat, lat, lon.size());
  side.corners.resize(lon.size());
  for (std::size_t i = 0; i < lon.size(); ++i) side.corners[i] = {lon[i], lat[i]};
}

// True if numbers have a 0 and end below the number of points.
bool count_from_zero(std::span<const std::int64_t> numbers, std::size_t size) {
  if (std::ranges::find(numbers, 0) == numbers.end()) return false;
  return static_cast<std::uint64_t>(std::ranges::max(numbers)) < size;
}

}  // namespace

std::vector<std::uint64_t> shape_or(const WeightSide& side, std::size_t size) {
  return side.shape.empty() ? std::vector<std::uint64_t>{size} : side.shape;
}

io::NetcdfVariable variable(std::string name, io::NetcdfType type,
                            std::vector<std::size_t> dimensions,
                            std::initializer_list<std::pair<const char*, const char*>> attributes) {
  io::NetcdfVariable result{std::move(name), type, std::move(dimensions), {}};
  for (const auto& [key, text] : attributes) {
    result.attributes.push_back({key, io::NetcdfType::text, text, {}});
  }
  return result;
}

void add_side(io::NetcdfWriter& out, const SideNames& names, const WeightSide& side,
              std::size_t size, std::size_t cells, std::size_t rank) {
  using io::NetcdfType;
  const auto add = [&](const std::string& name, NetcdfType type, const char* units) {
    out.add_variable(variable(name, type, {cells}, {{"units", units}}));
  };
  if (!side.points.empty()) {
    add(names.lon, NetcdfType::float64, "degrees");
    add(names.lat, NetcdfType::float64, "degrees");
  }
  const std::span<const LonLat> corners = written_corners(names, side);
  if (!corners.empty() || names.needs_corners) {
    const std::size_t corners_per_cell =
        out.add_dimension(names.corners, corners.empty() ? 1 : corners.size() / size);
    for (const std::string& name : {names.corner_lon, names.corner_lat}) {
      if (corners.empty()) break;
      out.add_variable(
          variable(name, NetcdfType::float64, {cells, corners_per_cell}, {{"units", "degrees"}}));
    }
  }
  add(names.mask, NetcdfType::int32, "unitless");
  add(names.area, NetcdfType::float64, "square radians");
  add(names.fraction, NetcdfType::float64, "unitless");
  out.add_variable(variable(names.dims, NetcdfType::int32, {rank}));
}

void add_own_attributes(io::NetcdfWriter& out, const WeightFile& content) {
  const Weights& weights = content.weights;
  if (!content.method.empty()) out.add_attribute(method_name, content.method);
  if (weights.sites_hash != 0) {
    out.add_attribute(source_hash_name, hexadecimal(weights.sites_hash));
  }
  if (weights.targets_hash != 0) {
    out.add_attribute(target_hash_name, hexadecimal(weights.targets_hash));
  }
  if (content.source.are_corners_made) out.add_attribute(source_corners_name, made_corners_text);
  if (content.target.are_corners_made) out.add_attribute(target_corners_name, made_corners_text);
  add_table(out, source_table_name, content.source);
  add_table(out, target_table_name, content.target);
}

bool has_own_method(const io::NetcdfReader& file) {
  return !io::netcdf_text(file.attributes(), method_name).empty();
}

void read_own_attributes(const io::NetcdfReader& file, WeightFile& content) {
  content.weights.sites_hash = hash_of(file, source_hash_name);
  content.source.are_corners_made =
      !io::netcdf_text(file.attributes(), source_corners_name).empty();
  content.target.are_corners_made =
      !io::netcdf_text(file.attributes(), target_corners_name).empty();
  content.weights.targets_hash = hash_of(file, target_hash_name);
  read_table(file, source_table_name, content.weights.num_columns, content.source);
  read_table(file, target_table_name, content.weights.num_rows(), content.target);
  content.normalization = io::netcdf_text(file.attributes(), "normalization");
  content.method = io::netcdf_text(file.attributes(), method_name);
  // ESMF writes "Conservative remapping" into map_method for both orders, so its own attribute
  // comes first.
  for (const char* name : {"ESMF_regrid_method", "map_method"}) {
    if (content.method.empty()) content.method = io::netcdf_text(file.attributes(), name);
  }
  if (!content.method.starts_with("Largest area fraction")) return;
  content.takes_largest_share = true;
  content.remarks.push_back("the weights are of the method " + io::in_quotes(content.method) +
                            ": a target has the value of the largest part of it, and no mean");
}

void read_side(const io::NetcdfReader& file, const SideNames& names, std::size_t size,
               WeightSide& side) {
  if (file.find(names.lon) != nullptr && file.find(names.lat) != nullptr) {
    const auto [lon, lat] =
        degrees_of_pair(file, {names.lon, names.lat}, {names.corner_lon, names.corner_lat});
    require_size(names.lon, lon, size);
    require_size(names.lat, lat, size);
    side.points.resize(size);
    for (std::size_t i = 0; i < size; ++i) side.points[i] = place_of_side(names, i, lon[i], lat[i]);
  }
  read_corners(file, names, size, side);
  side.areas = numbers_of(file, names.area, size);
  side.fractions = numbers_of(file, names.fraction, size);
  if (const auto* const mask = file.find(names.mask)) {
    const std::vector<double> values = meant_numbers(file, *mask);
    require_size(names.mask, values, size);
    // A missing value masks, too; a mask that masks nothing is left out.
    for (const double value : values) side.mask.push_back(value == 0 || value != value ? 0 : 1);
    if (std::ranges::count(side.mask, 0) == 0) side.mask.clear();
  }
  if (const auto* const dims = file.find(names.dims)) {
    side.shape = io::shape_of_grid(file, *dims, size);
  }
}

void set_entries(const WeightEntries& entries, std::size_t num_rows, std::size_t num_columns,
                 const WeightReadOptions& options, WeightFile& content) {
  const std::size_t num_entries = entries.values.size();
  if (entries.rows.size() != num_entries || entries.columns.size() != num_entries) {
    throw io::BadValue(std::to_string(entries.rows.size()) + " rows and " +
                       std::to_string(entries.columns.size()) + " columns for " +
                       std::to_string(num_entries) + " weights");
  }
  if (num_columns > no_index) throw io::BadValue("more than 2^32 - 1 sources");
  content.target.counts_from_zero = options.are_checked && count_from_zero(entries.rows, num_rows);
  content.source.counts_from_zero =
      options.are_checked && count_from_zero(entries.columns, num_columns);
  const std::int64_t first_row = content.target.counts_from_zero ? 0 : 1;
  const std::int64_t first_column = content.source.counts_from_zero ? 0 : 1;
  const auto require = [](const char* what, std::int64_t index, std::int64_t first,
                          std::size_t size, std::size_t k) {
    if (index >= first && static_cast<std::uint64_t>(index - first) < size) return;
    throw io::BadValue("entry " + std::to_string(k) + ": " + what + " " + std::to_string(index) +
                       " is not in 1 to " + std::to_string(size));
  };
  Weights& weights = content.weights;
  weights.num_columns = num_columns;
  // A counting sort: the first pass counts the entries of each row, the second one places them.
  // Entries of a row stay in their order.
  system::RowPlaces places(num_rows);
  for (std::size_t k = 0; k < num_entries; ++k) {
    require("row", entries.rows[k], first_row, num_rows, k);
    require("column", entries.columns[k], first_column, num_columns, k);
    places.count(static_cast<std::size_t>(entries.rows[k] - first_row));
  }
  weights.columns.resize(places.sum());
  weights.values.resize(num_entries);
  for (std::size_t k = 0; k < num_entries; ++k) {
    const std::uint64_t at = places.place(static_cast<std::size_t>(entries.rows[k] - first_row));
    weights.columns[at] = static_cast<Index>(entries.columns[k] - first_column);
    weights.values[at] = entries.values[k];
  }
  weights.offsets = std::move(places).offsets();
}

std::size_t dimension_of(const io::NetcdfReader& file, std::string_view name) {
  for (const io::NetcdfDimension& dimension : file.dimensions()) {
    if (dimension.name != name) continue;
    // Every format has a value for each point, so a larger size is wrong, and allocating it would
    // exhaust memory.
    if (dimension.size > file.max_values()) {
      throw io::BadValue("dimension " + io::in_quotes(name) + " of " +
                         std::to_string(dimension.size) + " in a file of " +
                         std::to_string(file.num_bytes()) + " bytes");
    }
    return static_cast<std::size_t>(dimension.size);
  }
  throw io::BadValue("no dimension " + io::in_quotes(name));
}

// Picks the format by the variable that holds the weights.
WeightFile read_weights_netcdf(const io::NetcdfReader& file, std::string_view format,
                               const WeightReadOptions& options) {
  if (is_of_yac(file)) {
    if (format.empty()) return read_yac(file, options);
    throw io::BadValue("the weights are those of YAC, not " + std::string(format));
  }
  const bool is_esmf = file.find("S") != nullptr;
  const bool is_scrip = !is_esmf && file.find("remap_matrix") != nullptr;
  if (is_esmf && format == "scrip") {
    throw io::BadValue(R"(the weights are those of ESMF (variable "S"), not scrip)");
  }
  if (is_scrip && format == "esmf") {
    throw io::BadValue(R"(the weights are those of SCRIP (variable "remap_matrix"), not esmf)");
  }
  if (is_esmf) return read_esmf(file, options);
  if (is_scrip) return read_scrip(file, options);
  throw io::BadValue(
      R"(no file of weights: neither variable "S" (ESMF) nor "remap_matrix" (SCRIP))");
}

}  // namespace rondel::formats
