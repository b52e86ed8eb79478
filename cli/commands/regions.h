// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of `rondel regions` that `rondel voronoi` has too, for the same results.
///
/// in    sites, or lines and polygons; polygons that clip; a column that groups
/// out   features, each with the polygons of one cell, group or piece
/// index rows of INPUT: sites or features
#pragma once

#include "region_features.h"

namespace rondel::cli {

/// Adds the options that say how cells are clipped and joined, with those of add_build_options().
/// \pre this comes between add_input_options() and add_report_options()
void add_region_options(CLI::App& parser, RegionsOptions& options);

/// True if one of the options asks for clipped or joined cells, or for their areas in another unit.
bool makes_regions(const RegionsOptions& options);

/// Makes and writes the regions, and reports: of the cells of sites or, with --densify, of lines
/// and polygons. \throws UsageError if options do not fit together or OUTPUT has a format without
/// polygons, FileError for a file that cannot be read or written
ExitStatus write_regions_of(const RegionsOptions& options);

}  // namespace rondel::cli
