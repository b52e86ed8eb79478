// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions as files of GDAL: GeoPackage (.gpkg), FlatGeobuf (.fgb), GeoParquet (.parquet).
//
// in    polygons with holes, and columns of text
// out   a file with a MultiPolygon for each cell, in degrees of longitude and latitude (WGS 84)
// index cells; row i of a column belongs to cell i
#pragma once

#include <span>

#include "rondel/io.h"
#include "rondel/regions.h"

namespace rondel::formats {

// True if files of this format are written by GDAL.
bool is_format_of_gdal(const FileName& file);

// Writes a feature for each cell that has polygons, with `area` and the columns. The file appears
// whole or not at all. A column of numbers has integers if all of them are integers. Throws
// FileError if the file cannot be written, or GDAL is not there. Precondition:
// is_format_of_gdal(file).
void write_regions_gdal(const FileName& file, const LonLatRegions& regions,
                        std::span<const double> areas, std::span<const Column> columns);

}  // namespace rondel::formats
