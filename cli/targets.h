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
#include "rondel/regrid.h"
#include "rondel/weight_files.h"

namespace rondel::cli {

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

/// Returns the indices of the sites that are not masked.
std::vector<Index> unmasked_sites(const NetcdfSites& grid);

/// Returns the weights of --method bilinear or nearest_d2s; sources that are masked take no part.
/// \throws FileError for a source of bilinear weights that is no grid with axes
Weights regrid_weights(Job& job, RegridMethod method, const NetcdfSites& grid,
                       const Targets& targets);

}  // namespace rondel::cli
