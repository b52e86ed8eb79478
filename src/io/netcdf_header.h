// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Parses the header of a file of netCDF's classic formats.
//
// in    bytes
// out   dimensions, attributes and variables
// index dimensions, to which variables refer by number
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/netcdf_reader.h"

namespace rondel::io {

// The header of a file of any format of netCDF.
struct NetcdfHeader {
  int version = 1;                // number of classic format: 1, 2 or 5
  std::uint64_t num_records = 0;  // all bits are 1 if it is not known
  bool counts_records = true;     // true if num_records is known
  std::vector<NetcdfDimension> dimensions;
  std::vector<NetcdfAttribute> attributes;
  std::vector<VariableInFile> variables;  // types, dimensions, attributes, offset
  std::vector<std::string> passed_over;   // names of variables of types that are not read
};

// Throws BadValue if the header is damaged or cut off.
NetcdfHeader parse_netcdf_header(std::string_view bytes);

}  // namespace rondel::io
