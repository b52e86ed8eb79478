// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes that models of atmosphere and ocean run on, from the sites of their cells (target rondel::mesh).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// A Voronoi mesh with all that a C-grid discretization asks for, named as in the specification of MPAS
/// meshes: Voronoi *cells*, the triangles' circumcenters as *vertices*, and *edges*, each between two cells
/// and between two vertices.
///
/// 1. Cells are in the order of the sites, vertices in that of the triangulation's faces. Edges
///    are in the order of the first of their two vertices. Numbers start at 0.
/// 2. Lengths and areas are those of a sphere of `radius` around the origin, on which all points
///    lie; angles are radians.
/// 3. The normal of an edge points from its first cell, the lower one, to its second; the second vertex is
///    to the left of it.
/// 4. The lists around a cell are counterclockwise seen from outside, in rows offsets[i] ...
///    offsets[i+1]-1: the cell cells_on_cell[j] lies across edges_on_cell[j], which ends at
///    vertices_on_cell[j] and starts at the vertex before.
/// 5. The three lists around a vertex are counterclockwise: cells_on_vertex[j] and its kite lie
///    between edges_on_vertex[j] and the next edge.
/// 6. The kite of a vertex and a cell has its corners there and in the middles of two edges of the triangle.
///    Areas are signed: where a triangle is obtuse, its vertex lies beyond an edge, and a
///    kite may be negative. Kites add up to triangles and cells.
/// 7. A mesh of a part of the sphere (mesh_cull.h) has a border, where no_index stands for what is not there: the second
///    cell of an edge, cells across edges, cells and edges around vertices, whose kites are then 0. At a vertex of the
///    border triangle_areas is the sum of the kites.
struct MeshArrays {
  double radius = 1;

  std::vector<Point> cell_points;  ///< the sites
  std::vector<double> cell_areas;
  std::vector<double> density;  ///< of cells by design, the largest 1; empty: 1 everywhere
  std::vector<std::uint64_t> offsets = {0};  ///< number of cells + 1
  std::vector<Index> edges_on_cell;
  std::vector<Index> cells_on_cell;
  std::vector<Index> vertices_on_cell;

  std::vector<Point>
      edge_points;  ///< where the arc between the cells crosses the great circle of the edge
  std::vector<std::array<Index, 2>> cells_on_edge;
  std::vector<std::array<Index, 2>> vertices_on_edge;
  std::vector<double> cell_distances;    ///< MPAS's dcEdge: between the two sites
  std::vector<double> vertex_distances;  ///< MPAS's dvEdge: the length of the edge
  std::vector<double>
      normal_angles;  ///< MPAS's angleEdge: of the normal, from east counterclockwise

  std::vector<Point> vertex_points;
  std::vector<Triple> cells_on_vertex;
  std::vector<Triple> edges_on_vertex;
  std::vector<std::array<double, 3>> kite_areas;
  std::vector<double> triangle_areas;

  [[nodiscard]] std::size_t num_cells() const { return cell_points.size(); }
  [[nodiscard]] std::size_t num_edges() const { return edge_points.size(); }
  [[nodiscard]] std::size_t num_vertices() const { return vertex_points.size(); }
  /// The most edges of a cell.
  [[nodiscard]] RONDEL_API std::size_t max_edges() const;
  friend bool operator==(const MeshArrays&, const MeshArrays&) = default;
};

/// The radii that a mesh can have: within them squares of lengths neither overflow nor vanish.
inline constexpr double least_radius = 1e-30;
inline constexpr double largest_radius = 1e30;

/// What arrays() does beside the triangulation's doing.
struct MeshOptions {
  double radius = 1;  ///< from least_radius to largest_radius
  /// The density of each cell, if the mesh was made for one, as MPAS has it: (least spacing / spacing)^4.
  std::span<const double> density{};
  /// Sites on one circle without a site inside share one vertex, which is here two or more, with
  /// an edge without length between them: models divide by it. Such sites are refused unless this is set.
  bool allow_zero_edges = false;
};

/// The mesh of the Voronoi cells of a triangulation. Distances are right to a few ulp of the
/// spacing, areas to a few ulp of the cells', however small, and the sums of the areas to 1e-13.
/// \throws InvalidInput if the model is weighted (what is built on these meshes takes the cells of Voronoi), the hull does
///         not surround the center of the sphere (meshes of a region are not made), two sites are in one place, or four on
///         one circle (see MeshOptions): with the site; for a radius that is out of range, or a density that is no positive number.
RONDEL_API MeshArrays arrays(const Triangulation& triangulation, const MeshOptions& options = {},
                             const Execution& execution = {});

/// Makes the mesh one of a sphere of another radius: points and lengths are multiplied by the quotient of the radii, areas by its square.
/// \throws InvalidInput if one of the two radii is not from least_radius to largest_radius.
RONDEL_API void rescale(MeshArrays& arrays, double radius);

/// The weights of the tangential velocity (Thuburn, Ringler, Skamarock, Klemp 2009, eq. 33; known as TRiSK).
/// Row e is offsets[e] ... offsets[e+1]-1: the sum of weights[k] u[edges[k]] over normal velocities u is the
/// velocity along the edge e, from its first to its second vertex.
///
/// 1. A row has the other edges of the first cell counterclockwise from e, then those of the second.
/// 2. weight(e, e') * cell_distance(e) / vertex_distance(e') is antisymmetric, so that the
///    Coriolis force does no work.
struct TangentialWeights {
  std::vector<std::uint64_t> offsets = {0};  ///< number of edges + 1
  std::vector<Index> edges;
  std::vector<double> weights;
};
RONDEL_API TangentialWeights tangential_weights(const MeshArrays& arrays,
                                                const Execution& execution = {});

/// The distance of neighbors where all cells are regular hexagons of this area: sqrt(2 area / sqrt 3).
RONDEL_API double spacing_of(double area);

}  // namespace rondel::mesh
