// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "column_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>

#include "command.h"
#include "double_text.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/read_cells.h"

namespace rondel::cli {
namespace {

// What a cell holds: a finite number, NaN if the cell is empty or says so, or what is wrong.
struct CellNumber {
  double value = std::numeric_limits<double>::quiet_NaN();
  const char* fault = nullptr;
};

// Returns a cell without blanks around it, and without a plus before it.
std::string_view trimmed(std::string_view cell) {
  const auto first = cell.find_first_not_of(" \t+");
  if (first == std::string_view::npos) return {};
  return cell.substr(first, cell.find_last_not_of(" \t") + 1 - first);
}

CellNumber number_of(std::string_view cell) {
  CellNumber number;
  cell = trimmed(cell);
  if (cell.empty()) return number;
  if (cell == "NA" || cell == "null") return number;
  const auto [end, error] = double_from(cell.data(), cell.data() + cell.size(), number.value);
  if (end != cell.data() + cell.size() || error == std::errc::invalid_argument) {
    number.fault = "is not a number";
  } else if (std::isinf(number.value)) {
    number.fault =
        error == std::errc::result_out_of_range ? "is beyond the largest number" : "is not finite";
  }
  return number;
}

// Returns the number in a cell; NaN if the cell is empty or says so.
double number_in(std::string_view cell, const SiteTable& table, std::size_t site,
                 const std::string& name) {
  const CellNumber number = number_of(cell);
  if (number.fault == nullptr) return number.value;
  throw FileError(table.where(site) + ": " + name + " '" + std::string(trimmed(cell)) + "' " +
                  number.fault);
}

// Returns a field of a netCDF file at the sites: that of a variable with one field, or one of
// several.
std::vector<double> netcdf_values(const SiteTable& table, const std::string& name,
                                  const std::string& option) {
  const FieldFile file(table.name, {&name, 1}, table.sites.size(), {}, {}, {table.positions, 1e-9});
  const FieldSet& fields = file.fields();
  const FieldArray& array = fields.arrays.front();
  if (array.num_fields() != 1) {
    std::string text = option + ": '" + name + "' of " + table.name + " has several fields (" +
                       array.lengths_in_words() + ")";
    if (array.num_fields() > 1) {
      std::string first = name + "[0";
      for (std::size_t d = 1; d < array.shape.size(); ++d) first += ",0";
      text += "; one of them is '" + first + "]', or '" +
              names_of_fields(array, fields.axes).front() + "'";
    }
    throw UsageError(text);
  }
  std::vector<double> values(table.sites.size());
  file.read(0, 0, values, Execution{.threads = 1});
  return values;
}

}  // namespace

// The cells of a column stand in one text, cell after cell; ends[i] is where that of site i ends.
std::vector<double> column_values(const SiteTable& table, const std::string& name,
                                  const std::string& option) {
  const auto column = std::ranges::find(table.columns, name, &Column::name);
  if (column == table.columns.end()) {
    if (is_netcdf_file(table.name)) return netcdf_values(table, name, option);
    throw UsageError(option + ": " + table.name + " has no column '" + name + "'");
  }
  std::vector<double> values;
  values.reserve(column->ends.size());
  std::uint64_t begin = 0;
  for (const std::uint64_t end : column->ends) {
    const std::string_view cell = std::string_view(column->text).substr(begin, end - begin);
    values.push_back(number_in(cell, table, values.size(), name));
    begin = end;
  }
  return values;
}

bool holds_numbers(const Column& column) {
  bool has_number = false;
  for (std::size_t row = 0; row < column.ends.size(); ++row) {
    const CellNumber number = number_of(column.cell(row));
    if (number.fault != nullptr) return false;
    has_number = has_number || !std::isnan(number.value);
  }
  return has_number || column.is_numeric;
}

Column numeric_column(const std::string& name, const std::vector<double>& values) {
  Column column;
  column.name = name;
  column.is_numeric = true;
  for (const double value : values) {
    std::array<char, 32> text{};
    if (!std::isnan(value)) {
      column.text.append(text.data(),
                         std::to_chars(text.data(), text.data() + text.size(), value).ptr);
    }
    column.ends.push_back(column.text.size());
  }
  return column;
}

}  // namespace rondel::cli
