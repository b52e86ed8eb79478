// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites and features in files that GDAL reads: GeoPackage (.gpkg), FlatGeobuf (.fgb), shapefile (.shp)
// and GeoParquet (.parquet).
//
// in    a file with one layer, in degrees of longitude and latitude
// out   a SiteTable, whose columns are the layer's fields; or a text of GeoJSON
#pragma once

#include <string>

#include "io/site_formats.h"
#include "rondel/io.h"

namespace rondel::formats {

// True if GDAL reads files of this format.
bool is_read_by_gdal(const FileName& file);

// Reads every Point and every member of a MultiPoint. Features without a place are left out and
// counted. The name of a column as `options.radius` names a field. Throws FileError if GDAL, its
// driver or the file is not there, if the file has other geometries, several layers or a projected
// coordinate system, or if a place is not valid. Precondition: is_read_by_gdal(file).
void read_sites_gdal(const FileName& file, const io::ReadJob& options, SiteTable& table);

// True if the first feature with a place has a polygon, or several geometries. Throws FileError as
// geojson_of_gdal(). Precondition: is_read_by_gdal(file).
bool begins_with_polygon(const FileName& file);

// Returns a FeatureCollection in one line with all features of a file, whose numbers are the doubles
// that the file has. Throws FileError if GDAL, its driver or the file is not there, if the file has
// curves or surfaces, several layers or a projected coordinate system. Precondition:
// is_read_by_gdal(file).
std::string geojson_of_gdal(const FileName& file);

}  // namespace rondel::formats
