// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// How good a mesh is, in the numbers that decide whether a model runs on it (target rondel::mesh).
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

/// The worst value, and the number of the cell, edge or vertex that has it, the first one of equals.
struct Worst {
  double value = 0;
  Index where = no_index;
};

/// How often values lie in equal steps from `low` to `high`; what lies outside counts in the first or last step.
struct Histogram {
  double low = 0;
  double high = 1;
  std::vector<std::uint64_t> counts;
};

/// Spacing is here spacing_of() the area of a cell; ratios are the same for every radius.
struct Quality {
  std::size_t num_cells = 0;
  std::size_t num_edges = 0;
  std::size_t num_vertices = 0;
  std::size_t num_border_edges = 0;  ///< with one cell; triangles are those of vertices with three
  std::vector<std::uint64_t> sides;  ///< sides[k]: the number of cells with k edges

  /// The mean squared distance to the site, over that of as many regular hexagons, 5 / (18 sqrt 3) of their area: 1 is
  /// out of reach. NaN where the density is not 1 everywhere.
  double energy = 0;
  /// The mean distance of the center of mass from the site, in spacings. Where the mesh has densities, the mass is that of a
  /// density that is linear between sites and corners; a corner has the density of the mean spacing of its cells.
  double mean_centroid_offset = 0;
  Worst max_centroid_offset;  ///< cell

  Worst min_angle_deg;  ///< of the triangles of sites, in the planes of their corners; vertex
  Worst max_angle_deg;  ///< vertex
  std::uint64_t num_obtuse = 0;  ///< triangles: their vertex of the mesh lies outside
  double share_40_to_80_deg = 0;

  Worst min_edge_ratio;      ///< vertex_distance / cell_distance (dv/dc); edge
  Worst min_side_ratio;      ///< the shortest edge of a cell over its longest; cell
  Worst max_distance_ratio;  ///< the farthest neighbor of a cell over the nearest; cell
  Worst max_gradient;  ///< the difference of the spacings of two neighbors over their mean; edge
  Worst
      max_staggering;  ///< from the middle of an edge to edge_points, over its cell_distance; edge
  double mean_staggering = 0;

  double min_spacing = 0;  ///< in units of the radius
  double max_spacing = 0;
  /// Spacing times density^(1/4), which a perfect mesh has the same everywhere, over its median: what 5 and 95 of 100 cells
  /// are below.
  std::array<double, 2> spacing_range = {0, 0};

  /// |sum / whole - 1|; whole is the sphere, of kites of a mesh with a border the sum of its cells.
  double kite_sum_error = 0;
  double cell_sum_error = 0;  ///< NaN of a mesh with a border
  double max_kite_error = 0;  ///< |kites - whole| / whole over the cells and the triangles

  Histogram angles_deg;   ///< of the triangles, 0 to 180
  Histogram edge_ratios;  ///< 0 to 2
  Histogram spacings;     ///< over their median (spacing_range), 0 to 2
};

RONDEL_API Quality quality(const MeshArrays& arrays, const Execution& execution = {});

/// What is wrong with each cell: the ratios of Quality, cell by cell; of edges the worst of its own.
struct CellQuality {
  std::vector<double> centroid_offset;
  std::vector<double> edge_ratio;
  std::vector<double> side_ratio;
  std::vector<double> distance_ratio;
  std::vector<double> gradient;
};
RONDEL_API CellQuality cell_quality(const MeshArrays& arrays, const Execution& execution = {});

/// A few lines for people.
RONDEL_API std::string quality_text(const Quality& quality);
/// One JSON object whose keys are those of Quality; a Worst is {"value", "where"}, what is not finite null.
RONDEL_API std::string quality_json(const Quality& quality);
/// The number of this name, with - for _ as on a command line: "min-edge-ratio"; "min-dv-dc" is another name of that.
/// \throws InvalidInput for another name.
RONDEL_API double quality_value(const Quality& quality, std::string_view name);
/// A picture in SVG: three histograms, and a map in longitude and latitude of the `num_worst` cells with the
/// largest centroid_offset, the smallest edge_ratio and the largest gradient.
RONDEL_API std::string quality_picture(const MeshArrays& arrays, const Quality& quality,
                                       std::size_t num_worst = 100,
                                       const Execution& execution = {});

}  // namespace rondel::mesh
