// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/described_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/field_choice.h"
#include "io/bad_value.h"
#include "io/column_text.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/named_grids.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

// True for a variable that describes the places along a dimension: texts, the axis of the dimension, and
// what names places by its role or is listed as a coordinate.
bool describes_places(const VariableHeader& variable, const std::string& dimension,
                      const std::set<std::string>& listed) {
  if (variable.dimensions.empty() || variable.dimensions[0] != dimension) return false;
  if (!variable.is_number || variable.text("cf_role").ends_with("_id")) return true;
  const bool is_measured =
      !variable.text("units").empty() || !variable.text("standard_name").empty();
  return variable.dimensions.size() == 1 &&
         (listed.contains(variable.name) || (variable.name == dimension && is_measured));
}

// Returns the attributes that do not name other variables and say nothing of how values are stored. A
// column of longitudes or latitudes, as of where a ship is bound for, loses what makes it a coordinate.
std::vector<std::pair<std::string, std::string>> kept_attributes(const VariableHeader& variable) {
  constexpr std::string_view kept[] = {"long_name", "standard_name", "units",   "calendar",
                                       "cf_role",   "positive",      "comment", "description"};
  const bool is_coordinate = coordinate_evidence(variable, CoordinateKind::lon) > 0 ||
                             coordinate_evidence(variable, CoordinateKind::lat) > 0;
  std::vector<std::pair<std::string, std::string>> attributes;
  for (const auto& [name, text] : variable.texts) {
    const bool is_kept = is_coordinate ? name == "long_name" : std::ranges::count(kept, name) > 0;
    if (is_kept && !text.empty()) attributes.emplace_back(name, text);
  }
  return attributes;
}

// Returns texts of one length, without the zero bytes and blanks that fill them up.
std::vector<std::string> texts_in(const std::string& characters, std::size_t number) {
  const std::size_t length = characters.size() / std::max<std::size_t>(number, 1);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < number; ++i) {
    std::string text = characters.substr(i * length, length);
    text.resize(std::min(text.find('\0'), text.size()));
    text.resize(text.find_last_not_of(' ') + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

// Returns the texts of a variable, or of its numbers; nothing for one that has several for a place.
std::optional<std::vector<std::string>> cells_of_variable(const io::NetcdfReader& file,
                                                          const io::VariableInFile& variable) {
  const std::size_t rank = variable.shape.size();
  if (variable.type == io::NetcdfType::text) {
    if (variable.has_strings) {
      if (rank != 1) return std::nullopt;
      return file.strings(variable);
    }
    if (rank > 2) return std::nullopt;
    return texts_in(file.characters(variable), variable.shape[0]);
  }
  if (rank != 1) return std::nullopt;
  std::vector<std::string> cells;
  for (const double number : meant_numbers(file, variable)) {
    cells.push_back(std::isfinite(number) ? system::shortest_text(number) : std::string());
  }
  return cells;
}

// Returns a variable as a column; nothing if it is none.
std::optional<Column> column_of(const io::NetcdfReader& file, const VariableHeader& header) {
  const io::VariableInFile& variable = file.require(header.name);
  try {
    const auto cells = cells_of_variable(file, variable);
    if (!cells) return std::nullopt;
    Column column = io::make_column(header.name);
    for (const std::string& cell : *cells) io::append_cell(column, cell);
    column.is_numeric = header.is_number;
    column.attributes = kept_attributes(header);
    // Its own name, under which the output may have a field.
    if (column.attributes.empty()) column.attributes.emplace_back("long_name", header.name);
    return column;
  } catch (const io::BadValue&) {
    return std::nullopt;  // it is told that the column is left out
  }
}

DescribedPlaces described_in(const io::NetcdfReader& file, const std::string& values,
                             std::size_t num_places) {
  DescribedPlaces described;
  const std::vector<VariableHeader> headers = headers_of(file);
  const std::vector<CoordinatePair> pairs = find_coordinates(headers, {{}, {}, values});
  if (pairs.empty() || headers[pairs[0].lon].dimensions.size() != 1 || pairs[0].are_axes) return {};
  const CoordinatePair& own = pairs.front();
  described.are_sites = io::find_attribute(file.attributes(), "featureType") != nullptr;
  std::set<std::string> listed;
  for (const VariableHeader& header : headers) {
    for (std::string& word : words_of(header.text("coordinates"))) listed.insert(std::move(word));
  }
  NameList lost;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    if (i == own.lon || i == own.lat || i == own.lon_bounds || i == own.lat_bounds) continue;
    if (!describes_places(headers[i], headers[own.lon].dimensions[0], listed)) continue;
    std::optional<Column> column;
    if (headers[i].shape[0] == num_places) column = column_of(file, headers[i]);
    if (column) {
      described.columns.push_back(std::move(*column));
    } else {
      lost.add(headers[i].name);
    }
  }
  const std::string names = lost.text();
  if (!names.empty()) {
    described.remark = "left out, as they describe the places of the target: " + names;
  }
  return described;
}

}  // namespace

DescribedPlaces described_places(const FileName& target, std::size_t num_places) {
  const auto [file, variable] = file_and_variable(target);
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file.path, error);
  if (NamedGrid::is_name(target.path) || !is_file || !is_netcdf_file(file)) return {};
  try {
    io::FileBytes bytes(file, true);
    return described_in(io::NetcdfReader(bytes), variable, num_places);
  } catch (const io::BadValue&) {
    return {};  // which is told where the places are read
  } catch (const InvalidInput&) {
    return {};
  }
}

}  // namespace rondel::formats
