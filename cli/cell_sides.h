// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The cells of one side of a remapping.
///
/// in    the name of a grid; netCDF with cells; polygons; or sites, whose Voronoi cells they are
/// out   cells
/// index cells, in the order of the grid or the file
#pragma once

#include "job.h"
#include "options.h"
#include "rondel/cell_set.h"
#include "rondel/remap.h"

namespace rondel::cli {

/// The forms in which cells are given.
enum class CellForm { grid, netcdf, polygons, sites };

/// Returns the form of a side, by its name and, for netCDF, its first bytes.
CellForm form_of(const FileName& side);

/// How the cells of a side are read.
struct CellSideOptions {
  CellFileOptions cells;
  CellOverlap overlap = CellOverlap::error;
  ReadOptions read;  ///< of sites
};

/// Returns the cells of a side, and prints the remarks of the reader. Errors name features by their
/// names, and cells by their numbers. Sites have the cells of their Voronoi diagram or, with
/// weights, power cells; one without a cell (hidden, duplicate) has an empty one.
/// \throws UsageError for a grid that is not possible, FileError for what cannot be read
CellSet cells_of_side(const FileName& side, const CellSideOptions& options, Job& job);

}  // namespace rondel::cli
