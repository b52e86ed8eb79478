// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The quality of a mesh, in the numbers that decide whether a model runs on it (target
/// rondel::geo).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/mesh.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The worst value of a quantity, and the index of the cell, edge or vertex that has it; the first
/// one of several.
struct Extremum {
  double value = 0;
  Index where = no_index;
};

/// The number of values in equal steps from `low` to `high`; a value outside counts in the first or
/// last step.
struct Histogram {
  double low = 0;
  double high = 1;
  std::vector<std::uint64_t> counts;
};

/// The qualities of a mesh. The spacing of a cell is spacing_of() its area; ratios do not depend on
/// the radius.
struct Quality {
  std::size_t num_cells = 0;
  std::size_t num_edges = 0;
  std::size_t num_vertices = 0;
  /// Edges with one cell; triangles are those of vertices with three cells.
  std::size_t num_border_edges = 0;
  std::vector<std::uint64_t> sides;  ///< sides[k]: the number of cells with k edges

  /// The mean squared distance to the site, divided by that of as many regular hexagons, 5 / (18
  /// sqrt 3) of their area; 1 is the unreachable optimum. NaN if the density is not 1 everywhere.
  double energy = 0;
  /// The mean distance of the center of mass from the site, in spacings. If the mesh has densities,
  /// the center is that of a density that is linear between sites and corners, and a corner has the
  /// density of the mean spacing of its cells.
  double mean_centroid_offset = 0;
  Extremum max_centroid_offset;  ///< index: cell

  /// Angles of the triangles of sites, in the planes of their corners; index: vertex.
  Extremum min_angle_deg;
  Extremum max_angle_deg;  ///< index: vertex
  /// The number of triangles whose circumcenter, a vertex of the mesh, lies outside of them.
  std::uint64_t num_obtuse = 0;
  /// The share of all angles of triangles that are from 40 to 80 degrees.
  double share_40_to_80_deg = 0;

  Extremum min_edge_ratio;      ///< vertex_distance / cell_distance (dv/dc); index: edge
  Extremum min_side_ratio;      ///< the shortest edge of a cell over its longest; index: cell
  Extremum max_distance_ratio;  ///< the farthest neighbor of a cell over the nearest; index: cell
  /// The difference of the spacings of two neighbors over their mean; index: edge.
  Extremum max_gradient;
  /// The distance from the middle of an edge to its edge_points, over its cell_distance; index:
  /// edge.
  Extremum max_staggering;
  double mean_staggering = 0;

  double min_spacing = 0;  ///< in units of the radius
  double max_spacing = 0;
  /// The 5th and the 95th percentile of spacing times density^(1/4), over its median. In a perfect
  /// mesh this product is the same everywhere.
  std::array<double, 2> spacing_range = {0, 0};

  /// |sum / whole - 1| for the sum of all kites, where the whole is the sphere, or the sum of the
  /// cells if the mesh has a border.
  double kite_sum_error = 0;
  double cell_sum_error = 0;  ///< the same for the sum of all cells; NaN for a mesh with a border
  double max_kite_error = 0;  ///< the largest |kites - whole| / whole of a cell or triangle

  Histogram angles_deg;   ///< angles of the triangles, 0 to 180
  Histogram edge_ratios;  ///< 0 to 2
  Histogram spacings;     ///< spacings over their median (see spacing_range), 0 to 2
};

RONDEL_API Quality quality(const VoronoiMesh& mesh, const Execution& execution = {});

/// The ratios of Quality for each cell; for the ratios of edges, the worst of the cell's edges.
struct CellQuality {
  std::vector<double> centroid_offset;
  std::vector<double> edge_ratio;
  std::vector<double> side_ratio;
  std::vector<double> distance_ratio;
  std::vector<double> gradient;
};
RONDEL_API CellQuality cell_quality(const VoronoiMesh& mesh, const Execution& execution = {});

/// Returns a report of a few lines for people to read.
RONDEL_API std::string quality_text(const Quality& quality);
/// Returns one JSON object with the members of Quality as keys. An Extremum is {"value", "where"};
/// a number that is not finite is null.
RONDEL_API std::string quality_json(const Quality& quality);
/// Returns the member with this name, with - instead of _ as on a command line: "min-edge-ratio";
/// "min-dv-dc" is another name of that.
/// \throws InvalidInput for another name.
RONDEL_API double quality_value(const Quality& quality, std::string_view name);
/// Returns a picture in SVG: three histograms, and a map in longitude and latitude of the
/// `num_worst` cells with the largest centroid_offset, the smallest edge_ratio and the largest
/// gradient.
RONDEL_API std::string quality_picture(const VoronoiMesh& mesh, const Quality& quality,
                                       std::size_t num_worst = 100,
                                       const Execution& execution = {});

}  // namespace rondel::mesh
