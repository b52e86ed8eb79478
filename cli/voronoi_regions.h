// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The part of `rondel voronoi` that makes polygons with holes: clipped cells, joined cells, and
/// the cells of lines and polygons.
#pragma once

#include "run.h"

namespace rondel::cli {

/// True if one of the options asks for such polygons.
bool makes_regions(const VoronoiOptions& options);

ExitStatus write_voronoi_regions(const VoronoiOptions& options);

}  // namespace rondel::cli
