// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/column_text.h"

#include "io/csv_columns.h"
#include "io/csv_records.h"
#include "io/number.h"
#include "io/utf8.h"

namespace rondel::io {

Column make_column(std::string_view name) {
  if (!is_utf8(name)) throw BadValue("the name of a column is not UTF-8");
  Column column;
  column.name = name;
  column.is_numeric = true;
  return column;
}

void append_cell(Column& column, std::string_view cell) {
  if (!is_utf8(cell)) {
    throw BadValue("the text in column " + in_quotes(column.name) + " is not UTF-8");
  }
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

std::string_view cell_of(const Column& column, std::size_t row) {
  const std::uint64_t begin = row == 0 ? 0 : column.ends[row - 1];
  return std::string_view(column.text).substr(begin, column.ends[row] - begin);
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
    append_row([&](const Column& column) { return cell_of(column, row); });
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
