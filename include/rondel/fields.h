// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values at points as files (target rondel::remap). Every function throws FileError with one line that
/// names the file.
#pragma once

#include <cstdint>
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

/// What a file says of the same points.
struct FieldSet {
  std::size_t num_points = 0;
  std::vector<FieldArray> arrays;
  std::vector<FieldArray> axes;
  std::vector<Point> points;  ///< of netCDF with longitudes and latitudes of the points; else empty
};

/// Reads values at points:
///
/// | ending | content |
/// | --- | --- |
/// | `.csv`, `.tsv` | the columns `names`, one at least; an empty cell and `nan` are missing |
/// | `.npy` | shape (n,) or (fields, n); no `names` |
/// | `.nc` | the variables `names` or all that fit: the last dimension, or the product of the last |
/// |       | ones, is n; `_FillValue` and `missing_value` are missing, `scale_factor` is applied |
///
/// \param num_points  n; 0 for tables: as many as there are rows
RONDEL_API FieldSet read_fields(const FileName& file, std::span<const std::string> names,
                                std::uint64_t num_points, const ReadOptions& options = {});

/// Writes values at the points of a side: `.csv` and `.tsv` with lon, lat and a column a field, `.npy` of
/// the shape (n,) or (fields, n), `.nc` on the grid of the side if it has one, else along one dimension.
RONDEL_API void write_fields(const FileName& file, const FieldSet& fields,
                             const WeightSide& points);

/// Whether the format can hold fields.
RONDEL_API bool can_write_fields(const FileName& file);

}  // namespace rondel
