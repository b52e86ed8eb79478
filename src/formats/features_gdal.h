// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features as files of GDAL: GeoPackage (.gpkg), FlatGeobuf (.fgb), GeoParquet (.parquet).
//
// in    points, lines and polygons with holes, and columns of text
// out   a file in degrees of longitude and latitude (WGS 84), with a MultiPoint, MultiLineString,
//       MultiPolygon or collection for each feature
// index features; row i of a column belongs to feature i
#pragma once

#include "formats/drawn_features.h"
#include "rondel/io.h"

namespace rondel::formats {

// True if files of this format are written by GDAL.
bool is_format_of_gdal(const FileName& file);

// Writes the features that have a geometry, with what is computed and the columns. The file appears
// whole or not at all. A column of numbers has integers if all of them are integers. Throws
// FileError if the file cannot be written, or GDAL is not there. Precondition:
// is_format_of_gdal(file).
void write_features_gdal(const FileName& file, const DrawnFeatures& features);

}  // namespace rondel::formats
