// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values at points as files (target rondel::remap). Every function throws FileError with one line that
/// names the file.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weight_files.h"

namespace rondel {

/// An array of a file: values, or the numbers of an axis such as time.
struct FieldArray {
  std::string name;
  /// The dimensions in front of that of the points (an axis: its only one), and their lengths.
  std::vector<std::string> dimensions;
  std::vector<std::uint64_t> shape;
  std::vector<double> values;  ///< the points change fastest; NaN: missing
  std::vector<std::pair<std::string, std::string>> attributes;  ///< units, long_name ...

  /// The fields at the points: the product of `shape`.
  [[nodiscard]] RONDEL_API std::size_t num_fields() const;
};

/// A name for each field of an array, as where it is a column: the array's own if there is one field, else with the place on each axis,
/// "tas_2001-07-15_850"; with the number on an axis that the file has not, or has twice in one place.
RONDEL_API std::vector<std::string> names_of_fields(const FieldArray& array,
                                                    std::span<const FieldArray> axes);

/// What a file says of the same points.
struct FieldSet {
  std::size_t num_points = 0;
  std::vector<FieldArray> arrays;
  std::vector<FieldArray> axes;
  std::vector<Point> points;  ///< of netCDF with longitudes and latitudes of the points; else empty
  std::vector<LonLat> positions;  ///< the same in degrees, as the file has them
  /// The lengths of the dimensions that the points have there; empty if some of them have no place.
  std::vector<std::uint64_t> shape;
  std::size_t num_without_place =
      0;  ///< points whose longitude or latitude is missing, and which are left out
  /// The number that the values have where they are missing, as a file that is written says it (`_FillValue`); in files that are read NaN.
  double fill = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> remarks;  ///< sentences: which variables of netCDF are left out, and why
  std::vector<std::uint64_t> lines;  ///< of a table: where each point is, from 1 on; else empty
};

/// Reads values at points:
///
/// | ending | content |
/// | --- | --- |
/// | `.csv`, `.tsv` | the columns `names`, one at least; an empty cell and `nan` are missing |
/// | `.npy` | shape (n,) or (fields, n); no `names` |
/// | `.nc`, `.nc4`, `.cdf`, `.ncf`, or what begins as netCDF | the variables `names`, or all that are fields at the points |
///
/// A name may choose one of the several fields of a variable: "tas[3]", "tas[-1]" and "tas[3, 0]" by its place along the other
/// dimensions, "tas_2001-07-15" as names_of_fields() calls it.
///
/// In netCDF the dimensions of the points are those of their longitudes and latitudes (rondel/conventions.h), in any order and at any
/// place among the others. Where the file has none, they are the dimension of the length n, or dimensions that follow each other and whose
/// product is n. Values are what the attributes `_FillValue`, `missing_value`, `valid_min`, `valid_max`, `valid_range`, `_Unsigned`, `scale_factor` and
/// `add_offset` make of the numbers.
///
/// \param num_points  n; 0 for tables: as many as there are rows; 0 for netCDF: those of the longitudes and latitudes of
///                    the first variable that has some. Points whose longitude or latitude is missing are left out, unless n is
///                    their number with these
/// \param shape  the lengths of the grid of the points, if they are one; a variable of netCDF with other lengths is refused
RONDEL_API FieldSet read_fields(const FileName& file, std::span<const std::string> names,
                                std::uint64_t num_points, const ReadOptions& options = {},
                                std::span<const std::uint64_t> shape = {});

/// A file of fields whose values are read in slices, so that it may be larger than the memory. This holds for netCDF; other formats
/// are read whole.
class FieldFile {
 public:
  /// As read_fields().
  RONDEL_API FieldFile(const FileName& file, std::span<const std::string> names,
                       std::uint64_t num_points, const ReadOptions& options = {},
                       std::span<const std::uint64_t> shape = {});
  RONDEL_API ~FieldFile();
  FieldFile(const FieldFile&) = delete;
  FieldFile& operator=(const FieldFile&) = delete;

  /// Returns what read_fields() does, but the values of the arrays are empty.
  [[nodiscard]] RONDEL_API const FieldSet& fields() const;

  /// Reads so many of an array's fields as there is room for, from field `first` on.
  /// \param array  its number in fields().arrays
  /// \param out  a multiple of the points, which change fastest; NaN: missing
  RONDEL_API void read(std::size_t array, std::size_t first, std::span<double> out) const;

 private:
  struct OpenFields;
  std::unique_ptr<OpenFields> content_;
};

/// Writes values at the points of a side: `.csv` and `.tsv` with lon, lat, the columns of the side, and a
/// column a field, named by its time or place on other axes, "tas_2001-07-15" or "tas_850"; `.npy` of
/// the shape (n,) or (fields, n), `.nc` and `.nc4` on the grid of the side if it has one, else along one dimension. Where two would
/// have one name, as a field and a coordinate of the points, the second one gets a number, "lat_2".
RONDEL_API void write_fields(const FileName& file, const FieldSet& fields, const WeightSide& points,
                             const NetcdfOptions& netcdf = {});

/// Writes the file of write_fields() in slices. Tables are kept in memory until finish(), other formats are not. The file appears when it
/// is complete.
class FieldWriter {
 public:
  /// \param fields  the arrays without values, the axes with theirs; used until finish(), as are the points
  RONDEL_API FieldWriter(const FileName& file, const FieldSet& fields, const WeightSide& points,
                         const NetcdfOptions& netcdf = {});
  RONDEL_API ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  /// The next values: those of the first array, field by field, then those of the second one, and so on.
  RONDEL_API void write(std::span<const double> values);
  /// Precondition: all values are written.
  RONDEL_API void finish();

 private:
  struct BegunFields;
  std::unique_ptr<BegunFields> output_;
};

/// Whether the format can hold fields.
RONDEL_API bool can_write_fields(const FileName& file);

}  // namespace rondel
