// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features of files as cells.
#pragma once

#include "io/geojson_polygons.h"
#include "rondel/cell_rings.h"
#include "rondel/polygon_files.h"

namespace rondel::overlay {

// Throws FileError for polygons that mean no region, with the feature, the ring and a place.
CellRings cells_of_features(io::PolygonFeatures& features, const PolygonOptions& options,
                            const Execution& execution);

}  // namespace rondel::overlay
