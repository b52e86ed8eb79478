// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The texts and numbers of points, as the properties of polygons, in netCDF: variables along their dimension.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/netcdf_writer.h"
#include "rondel/io.h"

namespace rondel::interpolation {

// The name of a variable or a dimension for this one: what netCDF does not take becomes an underscore.
std::string netcdf_name(std::string name);

class ColumnsOut {
 public:
  explicit ColumnsOut(std::span<const Column> columns) : columns_(columns) {}

  // Texts are arrays of characters in UTF-8. `points` is the dimension, `used` the names of other variables.
  void define(io::NetcdfWriter& out, std::size_t points, std::set<std::string> used);
  void write(io::NetcdfWriter& out) const;

 private:
  std::span<const Column> columns_;
  std::vector<std::size_t> lengths_;  // of the longest cells, at least 1
};

}  // namespace rondel::interpolation
