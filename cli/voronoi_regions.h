// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The part of `rondel voronoi` that makes polygons with holes: clipped cells, joined cells, and
/// the cells of lines and polygons.
///
/// in    sites, or lines and polygons; polygons that clip; a column that groups
/// out   features, each with the polygons of one cell, group or piece
/// index rows of INPUT: sites or features
#pragma once

#include "run.h"

namespace rondel::cli {

/// True if one of the options asks for such polygons.
bool makes_regions(const VoronoiOptions& options);

/// Makes and writes these polygons, and reports. \throws UsageError, FileError
ExitStatus write_voronoi_regions(const VoronoiOptions& options);

}  // namespace rondel::cli
