// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The part of `rondel voronoi` that makes polygons with holes: cells that are clipped, joined, or those of lines
/// and polygons.
#pragma once

#include "run.h"

namespace rondel::cli {

/// Whether an option asks for that.
bool makes_regions(const VoronoiOptions& options);

ExitStatus write_voronoi_regions(const VoronoiOptions& options);

}  // namespace rondel::cli
