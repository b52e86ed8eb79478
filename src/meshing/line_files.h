// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Lines of GeoJSON.
#pragma once

#include <vector>

#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::meshing {

/// Lines, the rings of polygons, and points, which are lines of one position. \throws FileError
std::vector<std::vector<LonLat>> lines_of(const FileName& file);

}  // namespace rondel::meshing
