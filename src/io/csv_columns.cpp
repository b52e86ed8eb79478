// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/csv_columns.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/number.h"

namespace rondel::io {
namespace {

using Header = std::vector<std::string>;

// Only letters of ASCII have another case here.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equal_but_for_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

// Returns what may be wrong with a table whose header lacks the columns.
std::string hint(const Header& header) {
  if (is_comment(header.front())) return "; a table has no lines of comments";
  if (std::ranges::all_of(header, is_json_number)) {
    return "; the first line must name the columns";
  }
  if (header.size() > 1) return {};
  for (const char c : {';', '\t', '|', ','}) {
    if (header.front().find(c) == std::string::npos) continue;
    const std::string name = c == '\t' ? "a tab" : std::string("\"") + c + '"';
    return "; is the delimiter " + name + "? (--delimiter)";
  }
  return {};
}

// Returns the name of a column that has none.
std::string name_of_position(std::size_t column) { return "column_" + std::to_string(column + 1); }

// Ends a message that may name a column of the header which has no name.
std::string about_positions(const Header& header) {
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (header[i] == name_of_position(i))
      return "; a column without a name is called by its position";
  }
  return {};
}

// Returns the names of the first columns, for messages.
std::string found(const Header& header) {
  constexpr std::size_t most = 30;
  std::string text = "; found: ";
  for (std::size_t i = 0; i < header.size() && i < most; ++i) {
    const std::string name = in_quotes(header[i]);
    text += (i == 0 ? "" : ", ") + name.substr(1, name.size() - 2);
  }
  if (header.size() > most) text += ", ...";
  return text + about_positions(header) + hint(header);
}

// A coordinate and the names by which columns may hold it.
struct Coordinate {
  std::string_view word;      // used in messages
  const std::string& chosen;  // the name in the options
  std::vector<std::string_view> usual;
};

// True if the name is a usual one of the coordinate.
bool is_usual_name(std::string_view name, const Coordinate& coordinate) {
  return std::ranges::any_of(coordinate.usual,
                             [&](auto usual) { return equal_but_for_case(name, usual); });
}

// Returns the columns of exactly this name.
std::vector<std::size_t> all_equal_to(const Header& header, std::string_view name) {
  std::vector<std::size_t> equal;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (header[i] == name) equal.push_back(i);
  }
  return equal;
}

// Returns a text such as `"lon" (column 1) and "longitude" (column 3)`.
std::string with_positions(const Header& header, std::span<const std::size_t> columns) {
  std::string text;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k > 0) text += k + 1 == columns.size() ? " and " : ", ";
    text += in_quotes(header[columns[k]]) + " (column " + std::to_string(columns[k] + 1) + ")";
  }
  return text;
}

// Throws BadValue with the positions of columns that have one name.
[[noreturn]] void refuse_equal(const Header& header, std::span<const std::size_t> columns) {
  throw BadValue("two columns have the same name: " + with_positions(header, columns.first(2)) +
                 about_positions(header));
}

// Returns the column of a coordinate. An exact match is preferred to one that differs in case.
std::optional<std::size_t> find(const Header& header, const Coordinate& coordinate) {
  const std::string_view chosen = trim(coordinate.chosen);
  std::vector<std::size_t> fitting;
  if (!chosen.empty()) {
    if (const auto exact = find_column(header, chosen)) return exact;
  }
  const auto fits = [&](std::string_view name) {
    return chosen.empty() ? is_usual_name(name, coordinate) : equal_but_for_case(name, chosen);
  };
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (fits(header[i])) fitting.push_back(i);
  }
  if (fitting.size() > 1) {
    const bool are_equal = header[fitting[0]] == header[fitting[1]];
    throw BadValue("more than one column may be the " + std::string(coordinate.word) + ": " +
                   with_positions(header, fitting) + (are_equal ? "" : "; name one of them"));
  }
  if (fitting.empty() && !chosen.empty()) {
    throw BadValue("no column " + in_quotes(coordinate.chosen) + found(header));
  }
  return fitting.empty() ? std::nullopt : std::optional(fitting.front());
}

// Returns the column of a coordinate. Throws BadValue with the columns that there are if it is
// missing, and the hint.
std::size_t require(const Header& header, const Coordinate& coordinate, const std::string& hint) {
  if (const auto column = find(header, coordinate)) return *column;
  std::string names;
  for (const std::string_view name : coordinate.usual) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw BadValue("no column for the " + std::string(coordinate.word) + " (" + names + ")" +
                 found(header) + hint);
}

// Returns what to do about columns x and y without z, which are often degrees.
std::string hint_of_degrees(const Header& header, std::span<const Coordinate> xyz) {
  const auto x = find(header, xyz[0]);
  const auto y = find(header, xyz[1]);
  if (!x || !y || find(header, xyz[2])) return {};
  return "; if they are longitude and latitude: --lon " + header[*x] + " --lat " + header[*y];
}

// True if the options name a column of one of these coordinates.
bool is_any_named(std::span<const Coordinate> coordinates) {
  return std::ranges::any_of(coordinates, [](const auto& c) { return !c.chosen.empty(); });
}

// Returns how many of these coordinates have a column.
std::size_t count_found(const Header& header, std::span<const Coordinate> coordinates) {
  return static_cast<std::size_t>(std::ranges::count_if(
      coordinates, [&](const auto& c) { return find(header, c).has_value(); }));
}

// The coordinates of both kinds.
struct CoordinateKinds {
  std::array<Coordinate, 2> lonlat;
  std::array<Coordinate, 3> xyz;
};
// Returns the coordinates with the names in the options and the usual names.
CoordinateKinds usual_coordinates(const ReadOptions& options) {
  return {{{{"longitude", options.lon, {"lon", "lng", "long", "longitude"}},
            {"latitude", options.lat, {"lat", "latitude"}}}},
          {{{"x coordinate", options.x, {"x"}},
            {"y coordinate", options.y, {"y"}},
            {"z coordinate", options.z, {"z"}}}}};
}

// True if the coordinates are x, y, z. A file may have both kinds, or a part of one: a complete
// kind is preferred, then one that is named in part, so that the message says what is missing.
bool is_xyz(const Header& header, std::span<const Coordinate> lonlat,
            std::span<const Coordinate> xyz) {
  if (is_any_named(lonlat) && is_any_named(xyz)) {
    throw BadValue("columns are named both for longitude, latitude and for x, y, z");
  }
  if (is_any_named(lonlat) || is_any_named(xyz)) return is_any_named(xyz);
  const std::size_t num_lonlat = count_found(header, lonlat);
  const std::size_t num_xyz = count_found(header, xyz);
  if (num_lonlat == lonlat.size() && num_xyz == xyz.size()) {
    throw BadValue("columns for both longitude, latitude and x, y, z; name those to read" +
                   found(header));
  }
  if (num_lonlat == 0 && num_xyz == 0) {
    throw BadValue("no columns for longitude and latitude (lon, lat) or for x, y, z" +
                   found(header));
  }
  return num_xyz == xyz.size() || num_lonlat == 0;
}

}  // namespace

void distinguish_from_coordinates(std::span<std::string> names) {
  const ReadOptions usual;
  const CoordinateKinds kinds = usual_coordinates(usual);
  const auto is_of = [&](const std::string& name, std::span<const Coordinate> coordinates) {
    return std::ranges::any_of(coordinates,
                               [&](const Coordinate& c) { return is_usual_name(name, c); });
  };
  const bool has_xyz = std::ranges::all_of(kinds.xyz, [&](const Coordinate& c) {
    return std::ranges::any_of(names,
                               [&](const std::string& name) { return is_usual_name(name, c); });
  });
  for (std::string& name : names) {
    if (is_of(name, kinds.lonlat) || (has_xyz && is_of(name, kinds.xyz))) name += '_';
  }
}

bool is_comment(std::string_view first_field) { return trim(first_field).starts_with('#'); }

std::vector<std::string> column_names(const std::vector<std::string_view>& header) {
  std::vector<std::string> names;
  for (const std::string_view field : header) {
    const std::string_view name = trim(field);
    names.push_back(name.empty() ? name_of_position(names.size()) : std::string(name));
  }
  return names;
}

std::optional<std::size_t> find_column(const std::vector<std::string>& names,
                                       std::string_view name) {
  const std::vector<std::size_t> equal = all_equal_to(names, trim(name));
  if (equal.size() > 1) refuse_equal(names, equal);
  return equal.empty() ? std::nullopt : std::optional(equal.front());
}

void require_different_names(const std::vector<std::string>& names) {
  for (const std::string& name : names) find_column(names, name);
}

bool has_coordinates(const Header& header, const ReadOptions& options) {
  const auto [lonlat, xyz] = usual_coordinates(options);
  if (is_any_named(lonlat) || is_any_named(xyz)) return true;
  return count_found(header, lonlat) == lonlat.size() || count_found(header, xyz) == xyz.size();
}

CoordinateColumns find_columns(const Header& header, const ReadOptions& options) {
  const auto [lonlat, xyz] = usual_coordinates(options);
  CoordinateColumns result;
  result.is_lonlat = !is_xyz(header, lonlat, xyz);
  const std::string hint = result.is_lonlat ? std::string() : hint_of_degrees(header, xyz);
  std::ranges::transform(result.is_lonlat ? std::span<const Coordinate>(lonlat) : std::span(xyz),
                         result.columns.begin(),
                         [&](const Coordinate& c) { return require(header, c, hint); });
  if (!options.radius.empty()) result.radius = find(header, {"radius", options.radius, {}});
  return result;
}

}  // namespace rondel::io

namespace rondel {

std::vector<std::string> value_columns(const SiteTable& table, const ReadOptions& options) {
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  try {
    if (!io::has_coordinates(names, options)) return names;
    const io::CoordinateColumns found = io::find_columns(names, options);
    std::vector<std::size_t> columns(found.columns.begin(),
                                     found.columns.begin() + (found.is_lonlat ? 2 : 3));
    if (found.radius) columns.push_back(*found.radius);
    std::ranges::sort(columns, std::greater());
    for (const std::size_t column : columns) {
      names.erase(names.begin() + static_cast<std::ptrdiff_t>(column));
    }
  } catch (const io::BadValue&) {  // properties of GeoJSON, which has its places elsewhere
  }
  return names;
}

}  // namespace rondel
