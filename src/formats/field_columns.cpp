// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the columns of a table as netCDF variables: define() gives each a free name and a type,
// write() its values. Numbers become doubles. Texts, and integers that doubles would round, become
// arrays of characters of the length of the longest text, filled up with zero bytes.
#include "formats/field_columns.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "formats/weight_formats.h"
#include "io/column_text.h"
#include "io/number.h"

namespace rondel::formats {

using io::NetcdfType;

std::string shortened_name(std::string_view name) {
  constexpr std::size_t room = 16;  // for underscores and `_length`
  std::size_t end = std::min(name.size(), max_bytes_of_name - room);
  // Bytes 10xxxxxx of UTF-8 stay with the first byte of their character.
  while (end < name.size() && end > 0 && (name[end] & 0xC0) == 0x80) --end;
  return std::string(name.substr(0, end));
}

// By the netCDF User's Guide, "NetCDF names", a name begins with a letter, a digit, an underscore
// or a UTF-8 character, has no slash and no control characters, and does not end with a blank.
std::string netcdf_name(std::string name) {
  if (name.size() > max_bytes_of_name) name = shortened_name(name);
  for (char& c : name) {
    if (c == '/' || static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '_';
  }
  for (std::size_t k = name.size(); k > 0 && name[k - 1] == ' '; --k) name[k - 1] = '_';
  const auto may_begin = [](char c) {
    return ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
  };
  if (name.empty() || !may_begin(name.front())) name.insert(0, "column_");
  return name;
}

namespace {

// Returns a name that programs accept for a variable: without blanks and beginning with a letter, of
// ASCII or another script.
std::string name_of_variable(const Column& column) {
  std::string name = netcdf_name(column.name);
  std::ranges::replace(name, ' ', '_');
  const auto is_letter = [](char c) {
    return ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || static_cast<unsigned char>(c) >= 0x80;
  };
  if (!is_letter(name.front())) name.insert(0, "column_");
  return name;
}

}  // namespace

// Files have thousands of names, which free_names() would copy for each of them.
std::string take_name(std::string name, std::set<std::string>& taken) {
  while (!taken.insert(name).second) name += '_';
  return name;
}

namespace {

// True for a cell without a number, as programs write it: R has NA, NumPy nan.
bool is_missing_cell(std::string_view text) {
  return text.empty() || text == "nan" || text == "NaN" || text == "NA" || text == "null";
}

}  // namespace

double number_in_cell(std::string_view cell, const std::string& name) {
  const std::string_view text = io::trim(cell);
  return is_missing_cell(text) ? std::numeric_limits<double>::quiet_NaN()
                               : io::parse_number(text, name);
}

// Columns of netCDF, which have attributes, and those of GeoJSON with cells of both kinds know what
// they are.
bool are_numbers(const Column& column) {
  if (column.is_numeric) return !column.has_wide_integers();
  if (!column.attributes.empty() || !column.is_json.empty()) return false;
  bool has_number = false;
  for (std::size_t row = 0; row < column.ends.size(); ++row) {
    const std::string_view cell = column.cell(row);
    if (is_missing_cell(io::trim(cell))) continue;
    if (!io::is_json_number(cell) || io::is_wide_integer(cell)) return false;
    has_number = true;
  }
  return has_number;
}

ColumnsOut::ColumnsOut(std::span<const Column> columns) : columns_(columns) {
  for (const Column& column : columns) is_number_.push_back(are_numbers(column));
}

std::vector<VariableHeader> ColumnsOut::headers() const {
  std::vector<VariableHeader> headers;
  headers.reserve(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    headers.push_back({.name = name_of_variable(columns_[c]),
                       .is_number = is_number_[c],
                       .dimensions = {"point"},
                       .shape = {1},
                       .texts = {}});
  }
  return headers;
}

void ColumnsOut::define(io::NetcdfWriter& out, std::size_t points,
                        std::span<const std::string> names, std::set<std::string> taken) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    const std::string& name = names[c];
    // A dimension of length 0 would be a record dimension.
    std::size_t longest = 1;
    for (std::size_t i = 0; i < column.ends.size(); ++i) {
      longest = std::max(longest, column.cell(i).size());
    }
    lengths_.push_back(longest);
    io::NetcdfVariable made = variable(name, NetcdfType::float64, {points});
    if (!is_number_[c]) {
      const std::size_t length =
          out.add_dimension(take_name(shortened_name(name) + "_length", taken), longest);
      made = variable(name, NetcdfType::text, {points, length}, {{"_Encoding", "utf-8"}});
    }
    for (const auto& [attribute, text] : column.attributes) {
      made.attributes.push_back({attribute, NetcdfType::text, text, {}});
    }
    out.add_variable(std::move(made));
  }
}

void ColumnsOut::write(io::NetcdfWriter& out) const {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    const std::size_t size = column.ends.size();
    if (is_number_[c]) {
      out.write_values<double>(
          size, [&](std::size_t i) { return number_in_cell(column.cell(i), column.name); });
    } else {
      const std::size_t length = lengths_[c];
      out.write_values<char>(size * length, [&](std::size_t k) {
        const std::string_view cell = column.cell(k / length);
        return k % length < cell.size() ? cell[k % length] : '\0';
      });
    }
  }
}

}  // namespace rondel::formats
