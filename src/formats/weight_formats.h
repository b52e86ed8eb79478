// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers and writers of weights, one function a format and direction, and what the netCDF formats
// share.
//
// in    WeightFile: weights and a description of the points or cells of both sides
// out   a file; or the same from a file
// index rows are targets, columns are sources; files count from 1, `Weights` from 0
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

namespace rondel::formats {

// Global attributes of netCDF with weights or fields whose cells have corners that were made.
inline constexpr const char* source_corners_name = "source_corners";
inline constexpr const char* target_corners_name = "target_corners";
inline constexpr const char* made_corners_text =
    "made half way between the centers, as the file has none";

// The input of a writer of weights.
struct WeightsToWrite {
  const WeightFile& content;
  NetcdfOptions netcdf;
};
// Each of these writes the whole file. Precondition: the sizes in the content agree.
void write_esmf(io::AtomicFile& file, const WeightsToWrite& job);
void write_scrip(io::AtomicFile& file, const WeightsToWrite& job);
void write_weights_npz(io::AtomicFile& file, const WeightsToWrite& job);

// Each of these reads the content of a file. They throw BadValue if it is not as the format says.
// `format` is "esmf" or "scrip" if the file must have that one of the netCDF formats.
WeightFile read_weights_netcdf(const io::NetcdfReader& file, std::string_view format,
                               const WeightReadOptions& options);
WeightFile read_weights_npz(std::string_view bytes);

// Each of these reads one of the netCDF formats; read_weights_netcdf() calls the one whose
// variables the file has.
WeightFile read_esmf(const io::NetcdfReader& file, const WeightReadOptions& options);
WeightFile read_scrip(const io::NetcdfReader& file, const WeightReadOptions& options);
WeightFile read_yac(const io::NetcdfReader& file, const WeightReadOptions& options);
// True if a file says that it has weights of YAC.
bool is_of_yac(const io::NetcdfReader& file);

// Writes the row of each entry, counted from 1, which both netCDF formats have in place of offsets.
template <typename T>
void write_row_numbers(io::NetcdfWriter& out, const Weights& weights) {
  std::size_t row = 0;
  out.write_values<T>(weights.columns.size(), [&](std::size_t k) {
    while (weights.offsets[row + 1] <= k) ++row;
    return static_cast<T>(row + 1);
  });
}

// Writes the values of an array, or `otherwise` for each element if the array is empty.
template <typename T, typename Values>
void write_or(io::NetcdfWriter& out, const Values& values, std::size_t size, T otherwise) {
  out.write_values<T>(
      size, [&](std::size_t i) { return values.empty() ? otherwise : static_cast<T>(values[i]); });
}

// Returns the fraction of a target for which none is given: 1 if its row has entries, else 0.
inline double fraction_of(const Weights& weights, std::size_t row) {
  return weights.offsets[row] < weights.offsets[row + 1] ? 1 : 0;
}

// Returns the shape of a side, or its size if the shape is not known.
std::vector<std::uint64_t> shape_or(const WeightSide& side, std::size_t size);

// Returns int64 if int32 cannot count `size` elements.
inline io::NetcdfType index_type(std::size_t size) {
  return size > 0x7fff'ffff ? io::NetcdfType::int64 : io::NetcdfType::int32;
}

// Makes a variable with attributes of text.
io::NetcdfVariable variable(
    std::string name, io::NetcdfType type, std::vector<std::size_t> dimensions,
    std::initializer_list<std::pair<const char*, const char*>> attributes = {});

// Writes the attributes that only files of this library have: hashes, method, tables.
void add_own_attributes(io::NetcdfWriter& out, const WeightFile& content);
// Reads the attributes of add_own_attributes(), and `normalization` and `map_method`, which other
// programs write as well. Throws BadValue for a hash that is none and for a table with another
// number of rows.
void read_own_attributes(const io::NetcdfReader& file, WeightFile& content);
// True if the file says the method as this library writes it.
bool has_own_method(const io::NetcdfReader& file);

// The names that a netCDF format has for the variables and dimensions of one side.
struct SideNames {
  // Names of variables; `dims` holds the lengths of the grid, the fastest one first.
  std::string lon, lat, area, fraction, mask, dims;
  std::string corners;  // name of the dimension
  std::string corner_lon, corner_lat;
  // NCO expects ESMF's dimension of corners even where it reads no corners; CDO expects SCRIP's
  // only with corners.
  bool needs_corners;
};
// Defines the variables of a side of `size` points. `cells` and `rank` are dimensions.
void add_side(io::NetcdfWriter& out, const SideNames& names, const WeightSide& side,
              std::size_t size, std::size_t cells, std::size_t rank);
// Returns the corners to write: those of the side, or the points themselves if they are no cells
// and the format needs corners.
inline std::span<const LonLat> written_corners(const SideNames& names, const WeightSide& side) {
  const bool are_points = names.needs_corners && side.areas.empty() && side.shape.size() < 2;
  return side.corners.empty() && are_points ? side.points : side.corners;
}
// Writes the values of a side. `fraction(i)` is the fraction of point i if the side has no
// fractions.
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
// Reads the variables of a side of `size` points; arrays of variables that are not there stay
// empty. Throws BadValue for another number of values, and for numbers that are no place.
void read_side(const io::NetcdfReader& file, const SideNames& names, std::size_t size,
               WeightSide& side);

// The entries of a file in its order; rows and columns count from 1, or from 0 where that is
// accepted.
struct WeightEntries {
  std::vector<std::int64_t> rows;
  std::vector<std::int64_t> columns;
  std::vector<double> values;
};

// Sorts entries in any order into the compressed rows of `content`, which may also learn that
// numbers count from 0. Throws BadValue if a number is out of range.
void set_entries(const WeightEntries& entries, std::size_t num_rows, std::size_t num_columns,
                 const WeightReadOptions& options, WeightFile& content);

// Returns the size of a dimension. Throws BadValue if it is missing or larger than the file could
// hold.
std::size_t dimension_of(const io::NetcdfReader& file, std::string_view name);

}  // namespace rondel::formats
