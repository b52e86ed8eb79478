// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Voronoi cells of lines and polygons: the part of the sphere to which a river, road, border or
/// country is nearest (target rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/cell_set.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/longitudes.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel {

/// Polylines of features: a group has the lines of a feature, a row the points of a line, which are
/// unit vectors. A line goes along shorter arcs of great circles from its first point to its last
/// one. A line of one point is that point.
using FeatureLines = RowGroups<CompressedRows<Point>>;

/// Sites along the lines of features, with the index of the feature that each belongs to.
struct FeatureSites {
  std::vector<Point> sites;  ///< unit vectors, in the order of the features; places may occur twice
  std::vector<Index> features;  ///< the feature of each site, never decreasing
};

/// Places sites along lines, as few as the tolerance allows: close together where another feature
/// is near, far apart where no other feature is.
///
/// 1. The feature of the site nearest to a point q is at most `tolerance` farther from q than the
///    feature that is nearest to q (up to rounding).
/// 2. Neighboring sites are at most 2 max(tolerance, sqrt(tolerance d)) apart, where d is the
///    distance of the line there from the nearest other feature.
/// 3. All points of the lines are sites.
/// \param tolerance  radians, positive
/// \throws InvalidInput if offsets do not fit, a point is no unit vector, neighbors in a line are
///         antipodes, the tolerance is not positive, or so small that an arc between two points
///         could have more than 524,288 sites (longer than 1,048,576 tolerances; index of the
///         feature), or if there would be more sites than an Index counts.
RONDEL_API FeatureSites feature_sites(const FeatureLines& lines, double tolerance,
                                      const Execution& execution = {});

/// Computes the cell of each feature: the part of the sphere to which it is the nearest feature,
/// within the tolerance of feature_sites(). A feature consists of its lines and of its polygon.
///
/// 1. A place inside of a polygon belongs to that polygon, exactly. Polygons may touch, but not
///    overlap.
/// 2. The cells cover the sphere; where two of them meet, both have the same corners, bit by bit. A
///    single feature has the whole sphere, which has no border and so no rings.
/// 3. Where features share a line or a point, the first of them gets what is nearest to it.
/// \param polygons  a cell for each feature, without rings where it has no polygon; or no cells at
///                  all
/// \param tolerance  radians, positive
/// \throws InvalidInput as feature_sites() and CellSet(), if the number of cells is neither 0 nor
///         that of the features, or if polygons cross or overlap (the message has the first pair
///         and a place).
RONDEL_API CellRings feature_cells(const FeatureLines& lines, const CellRings& polygons,
                                   double tolerance, const Execution& execution = {});

/// Computes the part of each feature's cell that lies in any of the regions, as clip() cuts cells.
/// A single feature gets all regions. \throws InvalidInput as feature_cells() and clip().
RONDEL_API CellRings clipped_feature_cells(const FeatureLines& lines, const CellRings& polygons,
                                           double tolerance, const CellSet& regions,
                                           const Execution& execution = {});

/// Computes the intersection of each feature's cell with each region, as intersection() does. The
/// `cells` of the result are indices of features. \throws InvalidInput as feature_cells() and
/// intersection().
RONDEL_API RegionPieces feature_pieces(const FeatureLines& lines, const CellRings& polygons,
                                       double tolerance, const CellSet& regions,
                                       const Execution& execution = {});

/// The features that a file has.
struct FeatureTable {
  FeatureLines lines;            ///< lines and points; a polygon has none here
  CellRings polygons;            ///< a cell for each feature, without rings where it has no polygon
  Column ids;                    ///< their members `id`, as in SiteTable
  std::vector<bool> is_located;  ///< which features have a geometry with positions
  std::vector<LongitudeExtent> longitudes;  ///< of the positions of each feature
  CellFacts facts;  ///< with the name of the file, the properties and remarks
};

/// Reads a .geojson or .json file as read_polygons() does, or by GDAL .gpkg, .fgb, .shp and .parquet,
/// with points, lines and collections of them as well. \throws what read_polygons() throws.
RONDEL_API FeatureTable read_features(const FileName& file, const PolygonOptions& options = {},
                                      const Execution& execution = {});

}  // namespace rondel
