// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Regions as files of GDAL: GeoPackage (.gpkg), FlatGeobuf (.fgb), GeoParquet (.parquet).
///
/// in    cells with rings of unit vectors, and columns of text
/// out   a file with a MultiPolygon for each cell, in degrees of longitude and latitude (WGS 84)
/// index cells; row i of a column belongs to cell i
#pragma once

#include <span>
#include <string>

#include "rondel/cell_rings.h"
#include "rondel/io.h"

namespace rondel::cli {

/// True if files of this format, such as "gpkg", are written by GDAL.
bool is_format_of_gdal(const std::string& format);

/// \throws FileError, before any work, if GDAL is not installed or cannot write the format
void require_gdal(const std::string& path, const std::string& format);

/// Writes what write_regions() writes as GeoJSON: a feature for each cell that has rings, with
/// `area` and the columns. The file appears whole or not at all; "-" is standard output. A column
/// of numbers has integers if all of them are integers. \throws FileError if the file cannot be
/// written
/// \param path  the file
/// \param format  one for which is_format_of_gdal() is true
/// \param columns  properties of the cells, with a row for each
/// \param tolerance_deg  how far a straight line may be from its great circle, in degrees
void write_regions_by_gdal(const std::string& path, const std::string& format,
                           const CellRings& cells, std::span<const Column> columns,
                           double tolerance_deg, const Execution& execution);

}  // namespace rondel::cli
