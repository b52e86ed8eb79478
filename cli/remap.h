// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of the commands that move values between sites or cells, and what these commands
/// share.
///
/// in    weights, values, sites or cells, from two files, one of which may be standard input
/// out   values at targets, or the weights that give them
/// index sources (columns of the weights) and targets (rows), in the order of their files
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "rondel/cell_set.h"
#include "rondel/fields.h"
#include "rondel/interpolate.h"
#include "rondel/polygon_files.h"
#include "rondel/regrid.h"
#include "rondel/remap.h"
#include "rondel/weight_check.h"

namespace rondel::cli {

/// The options of `rondel apply`.
struct ApplyCommandOptions {
  CommonOptions common;              ///< INPUT: the weights; output and threads
  std::string values_file;           ///< VALUES; "-": standard input
  std::vector<std::string> columns;  ///< --value
  ApplyOptions apply;                ///< --fill --most-missing
  NetcdfOptions netcdf;              ///< --kind --deflate

  [[nodiscard]] FileName weights_file() const { return common.source_beside(values_file); }
  [[nodiscard]] FileName values() const { return common.other_source(values_file); }
};

/// The options of `rondel check-weights`.
struct CheckWeightsOptions {
  CommonOptions common;      ///< INPUT: the weights
  WeightCheckOptions check;  ///< --allow-negative
};

/// The options of `rondel interpolate`.
struct InterpolateOptions {
  CommonOptions common;                ///< INPUT: the sites
  std::string target;                  ///< --to; "-": standard input
  std::string weights;                 ///< --weights; empty: values
  std::string weight_format;           ///< --weight-format
  std::vector<std::string> columns;    ///< --value
  InterpolationOptions interpolation;  ///< --method, unless it is one of `regrid`
  std::optional<RegridMethod> regrid;  ///< --method bilinear or nearest_d2s
  NetcdfOptions netcdf;                ///< --kind --deflate

  [[nodiscard]] FileName source_file() const { return common.source_beside(target); }
  [[nodiscard]] FileName target_file() const { return common.other_source(target); }
};

/// The targets that --to names: a file of points; a netCDF file with cells, a grid or values at
/// places; or "grid:DEG" or "grid:NLONxNLAT", which are the centers of the cells of a grid, from
/// -180 eastward and from the south pole northward, longitudes varying fastest.
struct Targets {
  SiteTable table;  ///< the points, and where they come from
  WeightSide side;
};
/// Reads the targets of a command. `read` says how tables are read.
/// \throws UsageError for an impossible grid, FileError for a file that cannot be read
Targets read_targets(const FileName& target, const ReadOptions& read);
/// Returns the grid that "grid:DEG" or "grid:NLONxNLAT" names. \throws UsageError for an impossible
/// grid
GlobalGrid grid_of(const std::string& text);

/// Returns the weights of --method bilinear or nearest_d2s; sources that are masked take no part.
/// \throws FileError for a source of bilinear weights that is no grid with axes
Weights regrid_weights(Job& job, RegridMethod method, const NetcdfSites& grid,
                       const Targets& targets);

/// The options of `rondel remap`.
struct RemapCommandOptions {
  CommonOptions common;   ///< INPUT: the source's cells; OUTPUT: the weights
  std::string target;     ///< TARGET; "-": standard input
  RemapOptions remap;     ///< --order --norm --overlap
  CellFileOptions cells;  ///< --sides --edges
  NetcdfOptions netcdf;   ///< --kind --deflate

  [[nodiscard]] FileName source_file() const { return common.source_beside(target); }
  [[nodiscard]] FileName target_file() const { return common.other_source(target); }
};

/// The forms of cells that `rondel remap` reads.
enum class CellForm { grid, netcdf, polygons, sites };
/// Returns the form of INPUT or TARGET, by its name and, for netCDF, its first bytes.
CellForm form_of(const FileName& file);

/// These functions run the commands after parsing.
ExitStatus run_apply(const ApplyCommandOptions& options);
ExitStatus run_check_weights(const CheckWeightsOptions& options);
ExitStatus run_interpolate(const InterpolateOptions& options);
ExitStatus run_remap(const RemapCommandOptions& options);

}  // namespace rondel::cli
