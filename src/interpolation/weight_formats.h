// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The formats of weights, one function each way.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/netcdf_reader.h"
#include "io/netcdf_writer.h"
#include "rondel/weight_files.h"

namespace rondel::interpolation {

struct WeightsToWrite {
  const WeightFile& content;
  NetcdfOptions netcdf;
};
// Each writes the whole file. Precondition: the content fits together.
void write_esmf(io::AtomicFile& file, const WeightsToWrite& job);
void write_scrip(io::AtomicFile& file, const WeightsToWrite& job);
void write_weights_npz(io::AtomicFile& file, const WeightsToWrite& job);

// Each reads the content of a file. Throws BadValue.
WeightFile read_weights_netcdf(const io::NetcdfReader& file);
WeightFile read_weights_npz(std::string_view bytes);

WeightFile read_esmf(const io::NetcdfReader& file);
WeightFile read_scrip(const io::NetcdfReader& file);

// The row of each entry, counted from 1: what both netCDF formats have in place of offsets.
template <typename T>
void write_row_numbers(io::NetcdfWriter& out, const Weights& weights) {
  std::size_t row = 0;
  out.write_values<T>(weights.columns.size(), [&](std::size_t k) {
    while (weights.offsets[row + 1] <= k) ++row;
    return static_cast<T>(row + 1);
  });
}

// Values of an array, or `otherwise` for all of one that is not there.
template <typename T, typename Values>
void write_or(io::NetcdfWriter& out, const Values& values, std::size_t size, T otherwise) {
  out.write_values<T>(
      size, [&](std::size_t i) { return values.empty() ? otherwise : static_cast<T>(values[i]); });
}

// The fraction of a target of which nothing is known.
inline double fraction_of(const Weights& weights, std::size_t row) {
  return weights.offsets[row] < weights.offsets[row + 1] ? 1 : 0;
}

// The shape of a side, or its size if there is none.
std::vector<std::uint64_t> shape_or(const WeightSide& side, std::size_t size);

// int64 where int32 cannot count so many.
inline io::NetcdfType index_type(std::size_t size) {
  return size > 0x7fff'ffff ? io::NetcdfType::int64 : io::NetcdfType::int32;
}

// A variable with attributes of text.
io::NetcdfVariable variable(
    std::string name, io::NetcdfType type, std::vector<std::size_t> dimensions,
    std::initializer_list<std::pair<const char*, const char*>> attributes = {});

// The attributes that say what nobody else's file does: hashes and the method.
void add_own_attributes(io::NetcdfWriter& out, const WeightFile& content);
void read_own_attributes(const io::NetcdfReader& file, WeightFile& content);
// Whether the file says the method as this library writes it.
bool has_own_method(const io::NetcdfReader& file);

// What a netCDF file says of a side: the names of the variables.
struct SideNames {
  std::string lon, lat, area, fraction, mask, dims;
  std::string corners;  // a dimension
  std::string corner_lon, corner_lat;
  // NCO wants ESMF's dimension of corners also where it reads none; CDO wants SCRIP's only with corners.
  bool needs_corners;
};
// Defines them, of a side of `size` points: `cells` and `rank` are dimensions.
void add_side(io::NetcdfWriter& out, const SideNames& names, const WeightSide& side,
              std::size_t size, std::size_t cells, std::size_t rank);
// The corners that the file has: those of the side, of points that are no cells these themselves.
inline std::span<const LonLat> written_corners(const SideNames& names, const WeightSide& side) {
  const bool are_points = names.needs_corners && side.areas.empty() && side.shape.size() < 2;
  return side.corners.empty() && are_points ? side.points : side.corners;
}
// Their values; `fraction` says what the fractions are where there are none.
template <typename Fraction>
void write_side(io::NetcdfWriter& out, const SideNames& names, const WeightSide& side,
                std::size_t size, Fraction fraction) {
  if (!side.points.empty()) {
    out.write_values<double>(size, [&](std::size_t i) { return side.points[i].lon_deg; });
    out.write_values<double>(size, [&](std::size_t i) { return side.points[i].lat_deg; });
  }
  const std::span<const LonLat> corners = written_corners(names, side);
  if (!corners.empty()) {
    out.write_values<double>(corners.size(), [&](std::size_t i) { return corners[i].lon_deg; });
    out.write_values<double>(corners.size(), [&](std::size_t i) { return corners[i].lat_deg; });
  }
  write_or<std::int32_t>(out, side.mask, size, 1);
  write_or<double>(out, side.areas, size, 0);
  out.write_values<double>(size, [&](std::size_t i) {
    return side.fractions.empty() ? fraction(i) : side.fractions[i];
  });
  const std::vector<std::uint64_t> shape = shape_or(side, size);
  out.write_values<std::int32_t>(shape.size(),
                                 [&](std::size_t i) { return shape[shape.size() - 1 - i]; });
}
void read_side(const io::NetcdfReader& file, const SideNames& names, std::size_t size,
               WeightSide& side);

// Entries in any order as compressed rows; rows and columns count from 1. Throws BadValue.
Weights rows_of_entries(std::span<const std::int64_t> rows, std::span<const std::int64_t> columns,
                        std::span<const double> values, std::size_t num_rows,
                        std::size_t num_columns);

// The size of a dimension. Throws BadValue, also if it is larger than the file.
std::size_t dimension_of(const io::NetcdfReader& file, std::string_view name);

}  // namespace rondel::interpolation
