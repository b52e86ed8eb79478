// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading and writing of weights in the formats of other programs (target rondel::geo). Every
/// function throws FileError with one line that names the file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// The sources or the targets of weights, as a file describes them. Any of the arrays may be empty.
struct WeightSide {
  std::vector<LonLat> points;      ///< centers of cells, or sites; NaN for a cell without a place
  std::vector<double> areas;       ///< steradians
  std::vector<double> fractions;   ///< the share of each cell that takes part
  std::vector<std::int32_t> mask;  ///< 0: the cell takes no part
  /// The shape of a grid, whose last dimension changes fastest: nlat, nlon.
  std::vector<std::uint64_t> shape;
  /// Corners of cells, counterclockwise, the same number for each cell.
  std::vector<LonLat> corners;
  /// Texts and numbers for each cell, such as the properties of polygons.
  std::vector<Column> columns;
  /// The axes of a grid along axes, in place of `points`; only files of fields take them.
  LonLatAxes axes = {};
  /// The lines between the cells along `axes`, of which files of fields write bounds; an axis without
  /// lines gets no bounds.
  LonLatGrid lines = {};
  /// Whether files of fields write `corners` as bounds of the places. The places are written as a
  /// list or in the shape then, and not as axes.
  bool has_bounds = {};
  /// True if the numbers of this side counted from 0 in a file whose format counts from 1
  /// (WeightReadOptions::are_checked).
  bool counts_from_zero = false;
  /// Whether the corners were made from the centers; netCDF has the attributes `source_corners` and
  /// `target_corners` that say so.
  bool are_corners_made = {};
};

/// Weights, and what a file says about them.
struct WeightFile {
  Weights weights;  ///< with the hashes of the points, if the file has them
  WeightSide source;
  WeightSide target;
  std::string method;         ///< "sibson", "Conservative remapping" ...
  std::string normalization;  ///< "destarea", "fracarea", "none"; "none" for weights of points
  std::vector<std::string> remarks;  ///< what read_weights() changed, one line each
  /// Whether the file says that each target has the value of the largest part of its weights, which
  /// apply_largest_share() gives it, and no mean: CDO's genlaf writes such files.
  bool takes_largest_share = false;
};

/// Makes the corners of a side bounds of its points by CF (section 7.1), as CellSet::bounds() has them,
/// and sets has_bounds; not of points on a grid along axes, which is written without a list of places.
RONDEL_API void use_corners_as_bounds(WeightSide& side);

/// Writes a file. Equal content gives equal bytes.
///
/// | format | ending | content |
/// | --- | --- | --- |
/// | `esmf` | `.nc`, `.nc4` | netCDF as ESMF's regridding writes it: `col`, `row` (from 1), `S`; degrees |
/// | `scrip` | none | netCDF as SCRIP wrote it and CDO reads it: `src_address`, `remap_matrix` ... |
/// | `npz` | `.npz` | the matrix as scipy.sparse.save_npz() writes it in CSR; the method, its normalization and the fractions of targets |
///
/// netCDF is one of the classic formats, CDF-5 if a variable has more than 4 GiB, or netCDF-4 if
/// the options or the ending of the path say so. Arrays that are empty get ESMF's defaults: areas
/// 0, fractions of sources 0, fractions of targets 1 (0 if a row has no entries), masks 1, and no
/// points and corners. In `esmf`, points that have neither areas nor corners and are on no grid are
/// written as cells of one corner, since NCO requires corners.
/// \throws InvalidInput if the weights are not in compressed rows, or the length of an array is not
///         that of its side.
RONDEL_API void write_weights(const FileName& file, const WeightFile& content,
                              const NetcdfOptions& netcdf = {});

/// How weights are read.
struct WeightReadOptions {
  /// The numbers of sources and targets, for files that do not have them: those of YAC. 0: not known.
  std::uint64_t num_sources = 0;
  std::uint64_t num_targets = 0;
  /// Whether the weights are only to be checked. Then numbers of sources, or of targets, may count
  /// from 0 in formats that count from 1: they do if there is a 0 among them and their largest is
  /// below the number of the points. And of several weights a link in SCRIP, of which all but the
  /// first multiply gradients, the first ones are read, with a remark.
  bool are_checked = false;
};

/// Reads weights that write_weights() or another program wrote; the variables of netCDF tell which
/// format it is. A file that has another format than the one named is refused. Entries may have any order: they are sorted into rows, and keep the order of the
/// file within a row. Areas and fractions that are all 0, masks that are all 1, and cells of one
/// corner are read as empty arrays.
///
/// Conservative weights of SCRIP with the normalization "none" are areas: they are divided by the
/// areas of the targets and get the normalization "destarea", as WeightFile::remarks says. Files of
/// write_weights() hold means, whatever their normalization is.
/// YAC's own files (`yac weight file 1.0`) have links of one field of sources, and no description of
/// the places. What they say of targets with fixed values is left out with a remark.
/// \throws FileError also if a target of such weights has no area in the file, for longitudes and
///         latitudes that are neither a place nor missing (these become NaN), and for a file of YAC
///         if the options do not have both numbers.
RONDEL_API WeightFile read_weights(const FileName& file, const WeightReadOptions& options = {});

}  // namespace rondel
