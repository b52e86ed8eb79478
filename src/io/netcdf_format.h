// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What files of netCDF's classic formats consist of: CDF-1, CDF-2 (offsets of 64 bits) and CDF-5 (all
// counts of 64 bits). https://docs.unidata.ucar.edu/nug/current/file_format_specifications.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rondel::io {

// The types of CDF-5, by their numbers in the file; the first six are those of CDF-1 and CDF-2.
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

// The bytes of a value; 0 for a number that names no type.
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

// What is padded is so to a multiple of this.
inline constexpr std::uint64_t netcdf_alignment = 4;

constexpr std::uint64_t netcdf_padded(std::uint64_t size) {
  return (size + netcdf_alignment - 1) / netcdf_alignment * netcdf_alignment;
}

// 0 is written for the dimension of records, which may grow.
struct NetcdfDimension {
  std::string name;
  std::uint64_t size = 0;
};

// Either a text or numbers.
struct NetcdfAttribute {
  std::string name;
  NetcdfType type = NetcdfType::text;
  std::string text;
  std::vector<double> numbers;
  std::vector<std::int64_t>
      integers{};  // the same of 64-bit integers, exactly; those of uint64 as bits
};

struct NetcdfVariable {
  std::string name;
  NetcdfType type = NetcdfType::float64;
  std::vector<std::size_t> dimensions;  // the last one changes fastest
  std::vector<NetcdfAttribute> attributes;
};

}  // namespace rondel::io
