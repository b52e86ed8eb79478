// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Regridding of files: all fields of a netCDF file to another grid, in one call (target
/// rondel::geo). Every function throws FileError with one line that names the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/export.h"
#include "rondel/extrapolate.h"
#include "rondel/io.h"
#include "rondel/remap.h"
#include "rondel/types.h"
#include "rondel/zonal_statistics.h"

namespace rondel {

/// How the values of a field at one side become those at the other one.
enum class FieldMethod : std::uint8_t {
  conservative,      ///< the mean over the target cell of a field that is constant in each source
  conservative_2nd,  ///< the same of a field with a gradient in each source (RemapOptions::order)
  /// The value that the largest part of the target cell has, for categories: flags, types of soil.
  /// Of values with equal parts the smallest counts.
  largest_share,
  nearest,   ///< the value of the nearest place; the others are those of Interpolator
  linear,    ///< in the triangles of the places' Delaunay triangulation
  laplace,   ///< of natural neighbors
  sibson,    ///< of natural neighbors
  hermite,   ///< cubic along edges, with gradients
  cubic,     ///< with continuous gradients
  bilinear,  ///< on a grid along axes (rondel/regrid.h)
  native,    ///< in the cells of the mesh that the fields are on (rondel/native_weights.h)
};

/// Returns the name of a value, "conservative_2nd"; empty for other numbers.
RONDEL_API std::string_view name_of(FieldMethod method) noexcept;

struct RegridFileOptions {
  std::vector<std::string> names = {};  ///< the variables; empty: all that are at the places
  /// Where the fields are: the name of a grid (NamedGrid) or a file with cells. Without it, it is
  /// the file of the fields.
  std::optional<FileName> source = std::nullopt;
  /// Without a method, fields with the attribute `flag_values` or `flag_meanings` get largest_share,
  /// and all others conservative.
  std::optional<FieldMethod> method = std::nullopt;
  /// What conservative sums are divided by. With fracarea constants are kept where sources cover a
  /// part of a target; with destarea integrals are.
  RemapNorm norm = RemapNorm::fracarea;
  RemapLimiter limiter =
      RemapLimiter::none;  ///< what keeps values of conservative_2nd within bounds
  /// The share of a target that no source may cover, and of its covered part in which sources may
  /// have no values.
  /// With 0 any lack is too much, with 1 any value is enough. At the limit, up to 1e-9, a target has a
  /// value (may_be_missing()).
  double max_missing = 0.5;
  CellFileOptions cells = {};                ///< of both sides
  CellOverlap overlap = CellOverlap::error;  ///< of both sides
  /// About how many bytes may be in use, beside some 30 MiB of the program itself. Weights that need
  /// more are computed tile by tile, and again for each group of fields; the values are the same.
  /// Weights of cells that overlap, and between two sides of which neither covers the sphere nor is
  /// between parallels, have no tiles; nor have those of conservative_2nd with the limiter, or of
  /// sources that are neither a named grid nor between parallels.
  std::uint64_t memory = std::uint64_t{2} << 30U;
  /// The number of cells of a tile, or of targets with a method between places; 0: as `memory` says.
  std::size_t cells_per_tile = 0;
  NetcdfOptions netcdf = {};
  std::string history = {};  ///< a line for the attribute `history` of the output
  /// Whether to keep what is computed in a file beside the output, "out.nc.partial", until the output
  /// is complete, and to begin with what a run that was cut short has left there. The output is the
  /// same. Threads, memory, tiles and the format of the output may differ between the runs.
  bool resume = false;
  /// Instead of one value for each target, these statistics of the values in it; there must be no
  /// method. Each variable becomes one for each statistic: "tas_mean", "tas_max".
  std::vector<ZonalStatistic> statistics = {};
  ZonalWeights statistic_weights = ZonalWeights::area;
  /// Pairs of variables that are the eastward and the northward components of vectors, such as winds.
  /// Their components in space are carried, x, y and z, by the method (none of them is turned, also
  /// near poles), and the part along the sphere is taken at the centers of the targets. Both become
  /// missing where one of them is.
  std::vector<std::pair<std::string, std::string>> vectors = {};
  /// How targets that have no value by the method get one, field by field (Extrapolator).
  std::optional<ExtrapolationOptions> extrapolation = std::nullopt;
};

/// What regrid_file() did.
struct RegridFileReport {
  std::size_t sources = 0;
  std::size_t targets = 0;
  std::size_t fields = 0;
  std::size_t missing = 0;  ///< values of targets that are missing
  std::size_t tiles = 0;    ///< 0 if all weights were in memory
  /// Sentences on what was left out or copied as it is, and why; each begins with the name of its file.
  std::vector<std::string> remarks = {};
  std::uint64_t resumed = 0;      ///< values that an earlier run had computed
  std::size_t extrapolated = {};  ///< values of targets that this run extrapolated
};

/// Regrids the fields of a file.
///
/// in      netCDF: all variables at the places of the source, for all times and levels
/// target  the name of a grid (NamedGrid), netCDF with cells, or polygons
///         (can_read_polygons() of rondel/read_cells.h)
/// out     netCDF with the same variables at the target: float if the source has floats or packed
///         integers, otherwise double; with the attributes, the axes, the variables without places
///         (bounds of times) and the attributes of the file. Or .csv, .tsv, .npy, as write_fields()
///         writes them: means over polygons with their properties.
///
/// Of arrays whose `cell_methods` say that they are sums over cells (are_sums_over_cells()), each target
/// gets its share of the sum of each source by conservative and conservative_2nd: sums are kept, any
/// part with a value is enough, and nothing is extrapolated. `cell_methods` of the output says what
/// these methods and largest_share did over cells: "area: mean", "area: sum", "area: mode".
///
/// With statistics, variables of numbers of cells (count, fraction, variety) have the unit 1, those of
/// variance the square of the unit; `cell_methods` says what was done over the area.
///
/// Methods between places take the fields from the places of the first variable that is named, which
/// may be the nodes or edges of a mesh; `target` may be such places, FILE.nc:NAME. Where corners
/// were made from centers (CellFileOptions::corners), the attribute `source_corners` or
/// `target_corners` of the output says so.
///
/// With conservative methods the integral of the components of vectors in space is kept as that of
/// other fields is, up to the part across the sphere, which is left out.
///
/// Values are the same bytes for any number of threads, memory and tiles. The output appears when
/// it is complete. All files that are read must stay as they are meanwhile.
/// \throws FileError also for a method that the sides do not admit: conservative methods need cells
///         on both, bilinear a source along axes; if the output is a file that is read, if such a file
///         changes, or if what is to be resumed is a run with other files or options
/// \throws InvalidInput if the memory is too small, with the number of bytes that are enough; and as
///         remap() does
RONDEL_API RegridFileReport regrid_file(const FileName& in, const FileName& target,
                                        const FileName& out, const RegridFileOptions& options = {},
                                        const Execution& execution = {});

/// Returns the command that does the same: "rondel regrid in.nc healpix:7 --method linear", a line for
/// RegridFileOptions::history. It has all options that change values, unless they are as by default,
/// and none of memory, tiles and the format of the output.
/// \param in, target  the names of the input and the target
RONDEL_API std::string regrid_command(const std::string& in, const std::string& target,
                                      const RegridFileOptions& options = {});

}  // namespace rondel
