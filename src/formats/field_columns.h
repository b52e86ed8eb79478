// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes texts and numbers of points, such as the properties of polygons, as netCDF variables along
// the dimension of the points.
//
// in    columns of text, one cell for each point
// out   variables of netCDF: numbers as doubles, NaN for empty cells, and texts as UTF-8
// index points, in their order
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/netcdf_writer.h"
#include "rondel/conventions.h"
#include "rondel/io.h"

namespace rondel::formats {

// netCDF-C reads no name of more than NC_MAX_NAME = 256 bytes, and netCDF4-python none of 256 either.
inline constexpr std::size_t max_bytes_of_name = 255;

// Returns the beginning of a name that leaves room for an ending.
std::string shortened_name(std::string_view name);

// Returns a valid netCDF name: characters that netCDF does not accept become underscores, and what is
// beyond max_bytes_of_name is cut off.
std::string netcdf_name(std::string name);

// Returns the name, with as many underscores behind it as make it differ from those that are taken,
// as free_names() does; it is then taken, too.
std::string take_name(std::string name, std::set<std::string>& taken);

// Returns the number in a cell; NaN if it is empty or says that it is missing. Throws BadValue.
double number_in_cell(std::string_view cell, const std::string& name);

// True if a column is written as numbers: if its cells are, but for those that are empty or, in a table,
// say `nan`, `NaN`, `NA` or `null`, and doubles hold them. A column of such words alone is none.
bool are_numbers(const Column& column);

// Columns on their way to a file. They must live until write().
class ColumnsOut {
 public:
  // Columns have a cell for each point.
  explicit ColumnsOut(std::span<const Column> columns);

  // Returns headers with the names that programs accept for variables, one for each column.
  [[nodiscard]] std::vector<VariableHeader> headers() const;
  // Defines the variables, with their attributes. Texts become arrays of UTF-8 characters. `points` is the dimension of
  // the points, `names` the names of the variables, `taken` those of all variables and dimensions.
  void define(io::NetcdfWriter& out, std::size_t points, std::span<const std::string> names,
              std::set<std::string> taken);
  // True if a column has attributes, as those of netCDF have.
  [[nodiscard]] bool has_attributes(std::size_t column) const {
    return !columns_[column].attributes.empty();
  }
  // Returns the name of a column, as its file has it.
  [[nodiscard]] const std::string& name(std::size_t column) const { return columns_[column].name; }
  // Writes the values, after NetcdfWriter::begin().
  void write(io::NetcdfWriter& out) const;

 private:
  std::span<const Column> columns_;
  std::vector<bool> is_number_;       // by column
  std::vector<std::size_t> lengths_;  // by column: bytes of its longest text, at least 1
};

}  // namespace rondel::formats
