// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Voronoi cells of lines and polygons: which river, road, border or country is nearest (target rondel::remap).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/partition.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel {

/// Lines of arcs in compressed rows. Feature i has the lines `features[i] ... features[i+1]-1`; line l goes along
/// shorter arcs from `points[lines[l]]` to `points[lines[l+1]-1]`. A line of one point is that point.
struct FeatureLines {
  std::vector<std::uint64_t> features = {0};  ///< number of features + 1
  std::vector<std::uint64_t> lines = {0};     ///< number of lines + 1
  std::vector<Point> points;                  ///< unit vectors

  [[nodiscard]] std::size_t num_features() const { return features.size() - 1; }
};

/// Points of features, and the feature of each.
struct FeatureSites {
  std::vector<Point> sites;     ///< in the order of the features; places may occur twice
  std::vector<Index> features;  ///< never decreasing
};

/// Points along lines, as few as the tolerance allows: close together where another feature is near, far apart
/// where none is.
///
/// 1. If a point q belongs to the nearest site's feature, that feature is at most `tolerance` radians (as rounded)
///    farther from q than the nearest one.
/// 2. Between two sites is at most 2 max(tolerance, sqrt(tolerance d)), with d the distance of the line there from
///    other features.
/// 3. All points of the lines are sites.
/// \throws InvalidInput if offsets do not fit, a point is no unit vector, neighbors in a line are antipodes, the
///         tolerance is not positive, or there would be more sites than an Index counts.
RONDEL_API FeatureSites feature_sites(const FeatureLines& lines, double tolerance,
                                      const Execution& execution = {});

/// The part of the sphere to which each feature is the nearest, within the tolerance of feature_sites(): lines, and
/// cells of which each is the polygons of its feature.
///
/// 1. A place in a polygon belongs to that polygon, exactly. Polygons may touch, but not overlap.
/// 2. Cells cover the sphere; where two meet both have the same corners, bit by bit. A single feature has the
///    whole sphere, which has no border, and so no rings.
/// 3. Where features share a line, or a point, the first of them has what is nearest to that.
/// \throws InvalidInput as feature_sites() and Partition(), if there are cells, but not one a feature, or if polygons
///         cross (with the first one and a place) or overlap.
RONDEL_API CellRings feature_cells(const FeatureLines& lines, const CellRings& polygons,
                                   double tolerance, const Execution& execution = {});

/// The part of each of these cells that lies in any of the regions, as clip() cuts it. A single feature has all of them.
/// \throws InvalidInput as feature_cells() and clip().
RONDEL_API CellRings clipped_feature_cells(const FeatureLines& lines, const CellRings& polygons,
                                           double tolerance, const Partition& regions,
                                           const Execution& execution = {});

/// What these cells have in common with each region, as intersection() makes it; `cells` are the features.
/// \throws InvalidInput as feature_cells() and intersection().
RONDEL_API RegionPieces feature_pieces(const FeatureLines& lines, const CellRings& polygons,
                                       double tolerance, const Partition& regions,
                                       const Execution& execution = {});

/// The features of a file.
struct FeatureTable {
  std::string name;             ///< the file, for messages
  FeatureLines lines;           ///< and points; polygons have none
  CellRings polygons;           ///< a cell for each feature, without rings where it has no polygon
  std::vector<Column> columns;  ///< the properties
};

/// Reads .geojson (or .json) as read_polygons() does, points and lines too, and collections of all.
/// \throws as read_polygons().
RONDEL_API FeatureTable read_features(const FileName& file, const PolygonOptions& options = {},
                                      const Execution& execution = {});

}  // namespace rondel
