// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites in files that GDAL reads: GeoPackage (.gpkg), FlatGeobuf (.fgb), shapefile (.shp) and
// GeoParquet (.parquet).
//
// in    a file with one layer of points, in degrees of longitude and latitude
// out   a SiteTable, whose columns are the layer's fields
#pragma once

#include "io/site_formats.h"
#include "rondel/io.h"

namespace rondel::formats {

// True if GDAL reads sites from files of this format.
bool is_read_by_gdal(const FileName& file);

// Reads every Point and every member of a MultiPoint. Features without a place are left out and
// counted. The name of a column as `options.radius` names a field. Throws FileError if GDAL, its
// driver or the file is not there, if the file has other geometries, several layers or a projected
// coordinate system, or if a place is not valid. Precondition: is_read_by_gdal(file).
void read_sites_gdal(const FileName& file, const io::ReadJob& options, SiteTable& table);

}  // namespace rondel::formats
