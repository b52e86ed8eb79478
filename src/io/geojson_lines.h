// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lines of a GeoJSON file (RFC 7946), whatever they are of.
#pragma once

#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::io {

// Lines, the rings of polygons (their first position repeated at the end) and points, which are lines of one
// position. Throws FileError: "rivers.geojson:12: ..."
RONDEL_API std::vector<std::vector<LonLat>> read_line_features(const FileName& file);

}  // namespace rondel::io
