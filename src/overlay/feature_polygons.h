// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts the polygons of a file into cells.
//
// in    features with rings of longitudes and latitudes
// out   a cell for each feature
// index features
#pragma once

#include <string>
#include <vector>

#include "map/polygon_features.h"
#include "rondel/cell_rings.h"
#include "rondel/polygon_files.h"

namespace rondel::overlay {

// Returns the cells of all features, and adds a remark on features that rounding of their corners
// has left without an area. Throws FileError for polygons that bound no region, with the feature,
// the ring and a place.
CellRings cells_of_features(map::PolygonFeatures& features, const PolygonOptions& options,
                            std::vector<std::string>& remarks, const Execution& execution);

}  // namespace rondel::overlay
