// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Targets of interpolation, and the weights of regridding.
///
/// in    points of a file, or a grid that is named
/// out   targets, weights
/// index sources (columns of the weights) and targets (rows), in the order of their files
#pragma once

#include <string>
#include <vector>

#include "job.h"
#include "rondel/cell_set.h"
#include "rondel/extrapolate.h"
#include "rondel/named_grids.h"
#include "rondel/regrid.h"
#include "rondel/weight_files.h"

namespace rondel::cli {

/// The targets that --to names: a file of points; a netCDF file with cells, a grid or values at
/// places; or the name of a grid, whose centers they are.
struct Targets {
  SiteTable table;  ///< the points, and where they come from
  WeightSide side;  ///< a target that is masked gets no value
};
/// Reads the targets of a command, as they are seen from `center`. `read` says how tables are read.
/// \throws UsageError for an impossible grid, FileError for a file that cannot be read
Targets read_targets(const FileName& target, const ReadOptions& read, const Point& center);
/// Returns the grid of this name. \throws UsageError for an impossible grid
NamedGrid grid_of(const std::string& name, GridSides sides = GridSides::parallels);

/// Returns the indices of the sites that are not masked.
std::vector<Index> unmasked_sites(const NetcdfSites& grid);

/// Returns the weights of --method bilinear, nearest_d2s or native; sources that are masked take no
/// part.
/// \param file  the file of the sources; FILE.nc:NAME says which of its meshes is meant
/// \throws FileError for a source of bilinear weights that is no grid with axes, or one of native
///         weights that is no mesh
Weights regrid_weights(Job& job, RegridMethod method, const FileName& file, const NetcdfSites& grid,
                       const Targets& targets);
/// Returns what extrapolates to the targets from sources that are not masked, as they are seen from
/// `center`.
Extrapolator extrapolator_to(const Targets& targets, const NetcdfSites& grid, const Point& center,
                             const ExtrapolationOptions& options, const Execution& execution);

}  // namespace rondel::cli
