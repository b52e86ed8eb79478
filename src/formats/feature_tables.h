// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The steps that features of files and of memory share on their way to cells and lines.
//
// in    features with rings and lines of longitudes and latitudes
// out   tables
// index features
#pragma once

#include <vector>

#include "map/polygon_features.h"
#include "rondel/feature_cells.h"
#include "rondel/polygon_files.h"

namespace rondel::formats {

// Throws InvalidInput.
void require_tolerance(const PolygonOptions& options);
void require_overlaps_kept(const PolygonOptions& options);

// Returns options with which features that are not valid are kept.
PolygonOptions leniently(PolygonOptions options);

// Returns which features have a geometry. One that was rejected has none.
std::vector<bool> are_located(const map::PolygonFeatures& features);

// Returns the longitudes of each feature.
std::vector<LongitudeExtent> longitudes_of(const map::PolygonFeatures& features);

// Converts polygons into cells.
CellTable table_of(map::PolygonFeatures& features, const PolygonOptions& options,
                   const Execution& execution);

// Converts the features of all files together, and returns those of each file with what is known of
// them.
std::vector<FeatureTable> tables_of(std::vector<map::PolygonFeatures> files,
                                    const PolygonOptions& options, const Execution& execution);

}  // namespace rondel::formats
