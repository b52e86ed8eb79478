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

// The places of a file that are a list, or sites of more dimensions.
struct ListOfPlaces {
  CoordinatePair own;                   // the longitudes and latitudes
  std::vector<std::string> dimensions;  // of both
  std::set<std::string> listed;         // what an attribute `coordinates` names
  bool are_sites = false;               // by `featureType`, so that no number is of a cell
};

bool is_name_of_places(const VariableHeader& variable) {
  return variable.text("cf_role").ends_with("_id");
}

// True for a variable that describes the places along a dimension: texts, the axis of the dimension, what
// names places by its role or is listed as a coordinate, and of sites all numbers with one for each.
bool describes_places(const VariableHeader& variable, const ListOfPlaces& list) {
  const std::string& dimension = list.dimensions.front();
  if (variable.dimensions.empty() || variable.dimensions[0] != dimension) return false;
  if (!variable.is_number || is_name_of_places(variable)) return true;
  const bool is_measured =
      !variable.text("units").empty() || !variable.text("standard_name").empty();
  return variable.dimensions.size() == 1 &&
         (list.are_sites || list.listed.contains(variable.name) ||
          (variable.name == dimension && is_measured));
}

// True for a variable that describes places but is no column beside a list: the name of a whole track;
// and where the places of sites have two dimensions, names and coordinates along one of them or both.
bool is_beside_places(const VariableHeader& variable, const ListOfPlaces& list) {
  if (is_name_of_places(variable)) return true;
  if (list.dimensions.size() == 1 || !list.are_sites || variable.dimensions.empty()) return false;
  return list.listed.contains(variable.name) &&
         std::ranges::count(list.dimensions, variable.dimensions[0]) > 0;
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

// Returns the rows that have a longitude and a latitude: those without are left out where places are read.
std::vector<bool> rows_with_place(const io::NetcdfReader& file, const std::string& lon,
                                  const std::string& lat) {
  const std::vector<double> lons = meant_numbers(file, file.require(lon));
  const std::vector<double> lats = meant_numbers(file, file.require(lat));
  std::vector<bool> rows(std::min(lons.size(), lats.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = std::isfinite(lons[i]) && std::isfinite(lats[i]);
  }
  return rows;
}

// Returns the cells of a column in some rows.
Column with_rows_of(const Column& column, const std::vector<bool>& is_kept) {
  Column kept = column.empty_copy();
  for (std::size_t i = 0; i < column.ends.size(); ++i) {
    if (is_kept[i]) io::append_cell(kept, column.cell(i));
  }
  kept.is_numeric = column.is_numeric;
  return kept;
}

// Returns the places of a file that are a list, or of sites that have more dimensions; no dimensions
// if it has none.
ListOfPlaces list_of(const io::NetcdfReader& file, const std::vector<VariableHeader>& headers,
                     const std::string& values) {
  ListOfPlaces list;
  const std::vector<CoordinatePair> pairs = find_coordinates(headers, {{}, {}, values});
  if (pairs.empty() || pairs[0].are_axes) return list;
  list.own = pairs.front();
  list.are_sites = io::find_attribute(file.attributes(), "featureType") != nullptr;
  const std::vector<std::string>& dimensions = headers[list.own.lon].dimensions;
  if (dimensions.size() == 1 || (list.are_sites && !dimensions.empty())) {
    list.dimensions = dimensions;
  }
  for (const VariableHeader& header : headers) {
    for (std::string& word : words_of(header.text("coordinates"))) {
      list.listed.insert(std::move(word));
    }
  }
  return list;
}

DescribedPlaces described_in(const io::NetcdfReader& file, const std::string& values,
                             std::size_t num_places) {
  const std::vector<VariableHeader> headers = headers_of(file);
  const ListOfPlaces list = list_of(file, headers, values);
  if (list.dimensions.empty()) return {};
  const CoordinatePair& own = list.own;
  const bool is_list = list.dimensions.size() == 1;
  DescribedPlaces described;
  described.are_sites = is_list && list.are_sites;
  std::vector<bool> rows;  // those that are places, if they are fewer
  if (is_list && headers[own.lon].shape[0] != num_places) {
    rows = rows_with_place(file, headers[own.lon].name, headers[own.lat].name);
  }
  const auto num_rows = static_cast<std::size_t>(std::ranges::count(rows, true));
  const bool has_rows = is_list && (rows.empty() || num_rows == num_places);
  NameList lost;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    if (i == own.lon || i == own.lat || i == own.lon_bounds || i == own.lat_bounds) continue;
    const bool is_described = is_list && describes_places(headers[i], list);
    if (!is_described && !is_beside_places(headers[i], list)) continue;
    std::optional<Column> column;
    if (is_described && has_rows) column = column_of(file, headers[i]);
    if (column && !rows.empty()) column = with_rows_of(*column, rows);
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
