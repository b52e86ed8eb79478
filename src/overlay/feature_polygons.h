// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts the polygons of a file into cells.
//
// in    features with rings of longitudes and latitudes
// out   a cell for each feature
// index features
#pragma once

#include "io/geojson_polygons.h"
#include "rondel/cell_rings.h"
#include "rondel/polygon_files.h"

namespace rondel::overlay {

// Returns the cells of all features. Throws FileError for polygons that bound no region, with the
// feature, the ring and a place.
CellRings cells_of_features(io::PolygonFeatures& features, const PolygonOptions& options,
                            const Execution& execution);

}  // namespace rondel::overlay
