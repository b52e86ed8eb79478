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

// The integers of 64 bits that netCDF writes where nobody has written (netcdf.h, NC_FILL_INT64 and
// NC_FILL_UINT64). They are no doubles.
inline constexpr std::int64_t default_fill_of_int64 = -9223372036854775806;
inline constexpr std::uint64_t default_fill_of_uint64 = 18446744073709551614U;

// Returns the number that netCDF writes where nobody has written (netcdf.h, NC_FILL_*), rounded.
constexpr double default_fill(NetcdfType type) {
  switch (type) {
    case NetcdfType::int8:
      return -127;
    case NetcdfType::uint8:
      return 255;
    case NetcdfType::int16:
      return -32767;
    case NetcdfType::uint16:
      return 65535;
    case NetcdfType::int32:
      return -2147483647;
    case NetcdfType::uint32:
      return 4294967295;
    case NetcdfType::int64:
      return static_cast<double>(default_fill_of_int64);
    case NetcdfType::uint64:
      return static_cast<double>(default_fill_of_uint64);
    case NetcdfType::float32:
    case NetcdfType::float64:
      return 0x1.ep+122;  // this is 9.9692099683868690e+36
    case NetcdfType::text:
      break;
  }
  return 0;
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
