// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The elements of netCDF's classic formats: CDF-1, CDF-2 (offsets of 64 bits) and CDF-5 (all counts
// of 64 bits). https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html
//
// index dimensions of the file, to which variables refer
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rondel::io {

// The types of CDF-5 by their numbers in the file; CDF-1 and CDF-2 have the first six.
enum class NetcdfType : std::uint32_t {
  int8 = 1,
  text = 2,
  int16 = 3,
  int32 = 4,
  float32 = 5,
  float64 = 6,
  uint8 = 7,
  uint16 = 8,
  uint32 = 9,
  int64 = 10,
  uint64 = 11,
};

// Returns the size of a value in bytes; 0 if the number is not a type.
constexpr std::size_t size_of(NetcdfType type) {
  constexpr std::size_t sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return static_cast<std::uint32_t>(type) < std::size(sizes)
             ? sizes[static_cast<std::uint32_t>(type)]
             : 0;
}

// The tags of the lists in the header.
inline constexpr std::uint32_t netcdf_dimensions_tag = 10;
inline constexpr std::uint32_t netcdf_variables_tag = 11;
inline constexpr std::uint32_t netcdf_attributes_tag = 12;

// Names and values are padded to a multiple of this.
inline constexpr std::uint64_t netcdf_alignment = 4;

constexpr std::uint64_t netcdf_padded(std::uint64_t size) {
  return (size + netcdf_alignment - 1) / netcdf_alignment * netcdf_alignment;
}

// A dimension. The dimension of records, which may grow, has the size 0 in the file.
struct NetcdfDimension {
  std::string name;
  std::uint64_t size = 0;
  bool is_unlimited = false;  // whether records may be appended along it
};

// An attribute, which is either a text or numbers.
struct NetcdfAttribute {
  std::string name;
  NetcdfType type = NetcdfType::text;
  std::string text;
  std::vector<double> numbers;
  std::vector<std::int64_t>
      integers{};  // the same of 64-bit integers, exactly; those of uint64 as bits
};

// A variable: its values have the lengths of its dimensions.
struct NetcdfVariable {
  std::string name;
  NetcdfType type = NetcdfType::float64;
  std::vector<std::size_t> dimensions;  // the last one varies fastest
  std::vector<NetcdfAttribute> attributes;
};

}  // namespace rondel::io
