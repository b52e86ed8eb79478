// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The header of a file of netCDF's classic formats, from its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/netcdf_reader.h"

namespace rondel::io {

struct NetcdfHeader {
  int version = 1;
  std::uint64_t num_records = 0;  // all ones of its width: not known
  bool counts_records = true;     // whether num_records is known
  std::vector<NetcdfDimension> dimensions;
  std::vector<NetcdfAttribute> attributes;
  std::vector<NetcdfReader::Variable> variables;  // types, dimensions, attributes, offset
  std::vector<std::string> passed_over;  // names of variables of types that are not read
};

// Throws BadValue.
NetcdfHeader parse_netcdf_header(std::string_view bytes);

}  // namespace rondel::io
