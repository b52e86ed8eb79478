// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Cells that are clipped and joined, as features with columns.
///
/// in    cells of sites, or of lines and polygons; polygons that clip; a column that groups
/// out   features, each with the polygons of one cell, group or piece
/// index rows of INPUT: sites or features
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "options.h"
#include "rondel/cell_rings.h"
#include "rondel/cell_set.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"

namespace rondel::cli {

/// The options that say what becomes of the cells.
struct RegionsOptions {
  CommonOptions common;
  double tolerance_deg = 0.01;
  std::string clip;        ///< --clip; empty: whole cells
  std::string clip_value;  ///< --clip-value; empty: the union of the polygons
  PolygonEdges edges = PolygonEdges::lonlat;
  InvalidPolygons invalid = InvalidPolygons::error;
  PolygonOverlap overlap = PolygonOverlap::error;
  std::string group;           ///< --group; empty: one cell a site
  double densify_km = 0;       ///< --densify; 0: the input has sites, otherwise lines and polygons
  double earth_radius_km = 0;  ///< --earth-radius; 0: not given, and areas are not in square
                               ///< kilometers
};

/// The mean radius of the Earth in kilometers: (2 a + b) / 3 of WGS 84.
inline constexpr double mean_earth_radius = 6371.0088;

/// Returns how many cells or geometries have a place.
std::size_t num_not_empty(const CellRings& cells);
std::size_t num_not_empty(const Geometries& geometries);

/// The rows of a table grouped by their text, groups in the order in which they occur. Rows without
/// a text belong to no group.
struct Groups {
  std::vector<Index> of_rows;
  Column names;
};

/// Returns the group of each row by its text in the column of this name; equal texts are one group.
/// \throws UsageError, which begins with the option, if there is no such column
Groups groups_of(const std::vector<Column>& columns, const std::string& file,
                 const std::string& name, const std::string& option);

/// The written features: cells, or the pieces into which the values of --clip-value divide them.
struct Features {
  CellRings rings;
  std::vector<Column> columns;
  Column ids;  ///< without cells where a feature comes from several ones
};

/// Cells of a table, whole or clipped; or, with --clip-value, their pieces in the polygons. One of
/// both is empty.
struct Cut {
  CellRings cells;
  RegionPieces pieces;
  Groups values;  ///< values of the polygons
};

/// Returns these rows of a column; a row that is no_index is empty.
Column rows_of(const Column& column, std::span<const Index> rows);

/// Returns the columns, with the numbers of the rows before them.
std::vector<Column> numbered(const char* name, std::size_t size, std::vector<Column> columns);

/// Makes the features. They have these columns of the cells, or the name of the group.
Features features_of(const RegionsOptions& options, Cut cut, const Groups& groups,
                     std::vector<Column> columns, const Column& ids, const Execution& execution);

/// The polygons of --clip, and the groups of their values.
struct Regions {
  CellSet cells;
  Groups values;  ///< by --clip-value
};
/// Reads the polygons of --clip.
Regions regions_of(const RegionsOptions& options, const Execution& execution);

}  // namespace rondel::cli
