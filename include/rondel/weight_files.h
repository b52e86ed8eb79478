// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Weights as files that other programs read and write (target rondel::remap). Every function throws
/// FileError with one line that names the file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// What a file says of the sources or of the targets of its weights; any of the arrays may be empty.
struct WeightSide {
  std::vector<LonLat> points;        ///< centers of cells, or sites; NaN of what has no place
  std::vector<double> areas;         ///< steradians
  std::vector<double> fractions;     ///< the share of a cell that takes part
  std::vector<std::int32_t> mask;    ///< 0: takes no part
  std::vector<std::uint64_t> shape;  ///< of a grid, the last dimension changes fastest: nlat, nlon
  std::vector<LonLat> corners;       ///< of cells, counterclockwise, as many for each
  std::vector<Column> columns;       ///< texts and numbers of each, as the properties of polygons
};

/// Weights and what a file says beside them.
struct WeightFile {
  Weights weights;  ///< with the hashes of the points, where the file has them
  WeightSide source;
  WeightSide target;
  std::string method;         ///< "sibson", "Conservative remapping" ...
  std::string normalization;  ///< "destarea", "fracarea", "none"; of weights of points "none"
};

/// Writes a file. Equal content gives equal bytes.
///
/// | format | ending | what it is |
/// | --- | --- | --- |
/// | `esmf` | `.nc`, `.nc4` | netCDF as ESMF's regridding writes it: `col`, `row` (from 1), `S`; degrees |
/// | `scrip` | none | netCDF as SCRIP wrote it and CDO reads it: `src_address`, `remap_matrix` ... |
/// | `npz` | `.npz` | the matrix as scipy.sparse.save_npz() writes it in CSR; the method, its normalization and the fractions of targets |
///
/// netCDF is one of the classic formats, CDF-5 where a variable has more than 4 GiB, or netCDF-4 if the options or the ending of
/// the path say so.
/// What is not there gets ESMF's values: areas 0, fractions of sources 0, of targets 1 and 0 where a row
/// has no entries, masks 1, points and corners none. In `esmf`, points that have neither areas nor
/// corners and are no grid are cells of one corner, as NCO wants corners.
/// \throws InvalidInput if the weights are not in compressed rows, or an array has not the length of
///         its side.
RONDEL_API void write_weights(const FileName& file, const WeightFile& content,
                              const NetcdfOptions& netcdf = {});

/// Reads what write_weights() or another program wrote; which netCDF it is, its variables tell. Entries
/// may have any order: rows are made of them, and within a row they keep that of the file. Areas and
/// fractions that are all 0, masks that are all 1, and cells of one corner are not there.
RONDEL_API WeightFile read_weights(const FileName& file);

/// Longitudes and latitudes of the rays from the origin through points; longitude 0 at the poles, NaN for the origin.
RONDEL_API std::vector<LonLat> lonlats(std::span<const Point> points);

}  // namespace rondel
