// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/column_text.h"

#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>

#include "io/csv_columns.h"
#include "io/csv_records.h"
#include "io/number.h"
#include "io/utf8.h"

namespace rondel::io {

namespace {

// Throws BadValue if the text has a character U+0000, at which a text of netCDF and GDAL ends.
void require_no_zero(std::string_view text, const std::string& what) {
  if (text.find('\0') == std::string_view::npos) return;
  throw BadValue(what + " has the character \\u0000, at which texts end in other formats");
}

}  // namespace

bool is_wide_integer(std::string_view text) {
  constexpr std::size_t max_digits = 15;  // 10^15 < 2^53
  if (text.size() <= max_digits) return false;
  const std::string_view digits = text.substr(text.front() == '-' ? 1 : 0);
  if (digits.find_first_not_of("0123456789") != std::string_view::npos) return false;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc()) return true;
  const int spare = std::countl_zero(number) + std::countr_zero(number);
  return number != 0 && spare < 64 - std::numeric_limits<double>::digits;
}

Column make_column(std::string_view name) {
  if (!is_utf8(name)) throw BadValue("the name of a column is not UTF-8");
  require_no_zero(name, "the name of the column " + in_quotes(name));
  Column column;
  column.name = name;
  column.is_numeric = true;
  return column;
}

void append_cell(Column& column, std::string_view cell) {
  if (!is_utf8(cell)) {
    throw BadValue("the text in column " + in_quotes(column.name) + " is not UTF-8");
  }
  require_no_zero(cell, "the text in column " + in_quotes(column.name));
  if (column.is_numeric && !cell.empty()) column.is_numeric = is_json_number(cell);
  column.text += cell;
  column.ends.push_back(column.text.size());
}

void append_csv_field(std::string& text, std::string_view field, char separator) {
  if (field.find_first_of(std::string("\"\r\n") + separator) == std::string_view::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) text.append(c == '"' ? 2 : 1, c);
  text += '"';
}

std::string csv_of(std::span<const Column> columns) {
  std::string text;
  if (columns.empty()) return text;
  const auto append_row = [&](const auto& field_of) {
    for (const Column& column : columns) {
      if (&column != columns.data()) text += ',';
      const std::string_view field = field_of(column);
      // A line that consists of one empty field would be an empty line, which is skipped.
      if (field.empty()) {
        text += "\"\"";
      } else {
        append_csv_field(text, field, ',');
      }
    }
    text += '\n';
  };
  append_row([](const Column& column) { return std::string_view(column.name); });
  for (std::size_t row = 0; row < columns.front().ends.size(); ++row) {
    append_row([&](const Column& column) { return column.cell(row); });
  }
  return text;
}

std::vector<Column> columns_of_csv(std::string_view text, std::size_t num_rows) {
  std::vector<Column> columns;
  CsvRecords records(text, ',');
  if (!records.next()) return columns;
  for (const std::string& name : column_names(records.fields())) {
    columns.push_back(make_column(name));
  }
  std::size_t row = 0;
  while (records.next()) {
    if (records.fields().size() != columns.size()) {
      throw BadValue(std::to_string(records.fields().size()) + " fields in row " +
                     std::to_string(row) + " of " + std::to_string(columns.size()) + " columns");
    }
    for (std::size_t c = 0; c < columns.size(); ++c) append_cell(columns[c], records.fields()[c]);
    ++row;
  }
  if (row != num_rows) {
    throw BadValue(std::to_string(row) + " rows for " + std::to_string(num_rows) + " cells");
  }
  return columns;
}

}  // namespace rondel::io

namespace rondel {

bool Column::has_wide_integers() const {
  for (std::size_t row = 0; is_numeric && row < ends.size(); ++row) {
    if (io::is_wide_integer(cell(row))) return true;
  }
  return false;
}

std::vector<std::string> free_names(std::vector<std::string> names, std::set<std::string> taken,
                                    bool ignores_case) {
  const auto known_as = [&](std::string name) {
    for (char& c : name) {
      if (ignores_case && c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return name;
  };
  for (std::string& name : names) {
    while (!taken.insert(known_as(name)).second) name += '_';
  }
  return names;
}

}  // namespace rondel
