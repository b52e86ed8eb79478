// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes for models of atmosphere and ocean, from the sites of their cells (target rondel::geo).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// A Voronoi mesh with all arrays that a C-grid discretization needs, named as in the specification
/// of MPAS meshes: Voronoi *cells*, the triangles' circumcenters as *vertices*, and *edges*, each
/// between two cells and between two vertices.
///
/// 1. Cells are in the order of the sites, vertices in that of the triangulation's faces. Edges
///    are in the order of the first of their two vertices. Indices begin with 0.
/// 2. Lengths and areas are those on a sphere of `radius` around the origin, on which all points
///    lie; angles are radians.
/// 3. The normal of an edge points from its first cell, the lower one, to its second; the second
///    vertex is to the left of it.
/// 4. The lists around a cell are counterclockwise seen from outside: entry j of the rows of
///    edges_on_cell, an edge, has across it the cell cells_on_cell[j], ends at vertices_on_cell[j]
///    and starts at the vertex before.
/// 5. The three lists around a vertex v are counterclockwise: the cell cells_on_vertex[v][j] and
///    its kite lie between the edge edges_on_vertex[v][j] and the next edge.
/// 6. The kite of a vertex and a cell has its corners there and in the middles of two edges of the
///    triangle. Areas are signed: where a triangle is obtuse, its vertex lies beyond an edge, and a
///    kite may be negative. Kites add up to triangles and cells.
/// 7. A mesh of a part of the sphere (mesh_cull.h) has a border, where no_index stands for missing
///    elements: the second cell of an edge, cells across edges, cells and edges around vertices,
///    whose kites are then 0. At a vertex on the border triangle_areas has the sum of the kites.
struct VoronoiMesh {
  double radius = 1;

  std::vector<Point> cell_points;  ///< the sites
  std::vector<double> cell_areas;
  /// The density of each cell by design, the largest 1; empty: 1 everywhere.
  std::vector<double> density;
  CompressedRows<Index> edges_on_cell;  ///< a row for each cell
  std::vector<Index> cells_on_cell;
  std::vector<Index> vertices_on_cell;

  std::vector<Point>
      edge_points;  ///< the middles of arcs between the two sites, on the edges' great circles
  std::vector<std::array<Index, 2>> cells_on_edge;
  std::vector<std::array<Index, 2>> vertices_on_edge;
  std::vector<double> cell_distances;    ///< MPAS's dcEdge: between the two sites
  std::vector<double> vertex_distances;  ///< MPAS's dvEdge: the length of the edge
  std::vector<double>
      normal_angles;  ///< MPAS's angleEdge: the angle of the normal, counterclockwise from east

  std::vector<Point> vertex_points;
  std::vector<Triple> cells_on_vertex;
  std::vector<Triple> edges_on_vertex;
  std::vector<std::array<double, 3>> kite_areas;
  std::vector<double> triangle_areas;

  [[nodiscard]] std::size_t num_cells() const { return cell_points.size(); }
  [[nodiscard]] std::size_t num_edges() const { return edge_points.size(); }
  [[nodiscard]] std::size_t num_vertices() const { return vertex_points.size(); }
  /// Returns the largest number of edges of a cell.
  [[nodiscard]] RONDEL_API std::size_t max_edges() const;
  friend bool operator==(const VoronoiMesh&, const VoronoiMesh&) = default;
};

/// The bounds of a mesh's radius: between them squares of lengths neither overflow nor vanish.
inline constexpr double min_radius = 1e-30;
inline constexpr double largest_radius = 1e30;

/// The options of make_mesh().
struct MeshOptions {
  double radius = 1;  ///< from min_radius to largest_radius
  /// The density of each cell, if the mesh was made for one, as MPAS defines it: (least spacing /
  /// spacing)^4.
  std::span<const double> density{};
  /// Whether edges of length 0 are allowed. Four or more sites on one circle without a site inside
  /// share one vertex, which the mesh has several times, with edges of length 0 between; models
  /// divide by that length. Such sites are refused unless this is set.
  bool allow_zero_edges = false;
};

/// Computes the mesh of the Voronoi cells of a triangulation. Distances are right to a few ulp of
/// the spacing, areas to a few ulp of the cells' areas, however small, and the sums of the areas to
/// 1e-13.
/// \throws InvalidInput if the model is weighted (the models that use such meshes need Voronoi
///         cells), constraints have changed faces, the hull does not surround the center of the sphere,
///         two sites are in one place, or four on one circle (see MeshOptions), with the site; for a
///         radius that is out of range, or a density that is not positive.
RONDEL_API VoronoiMesh make_mesh(const Triangulation& triangulation,
                                 const MeshOptions& options = {}, const Execution& execution = {});

/// Changes the radius of a mesh: points and lengths are multiplied by the quotient of the radii,
/// areas by its square.
/// \throws InvalidInput if one of the two radii is not from min_radius to largest_radius.
RONDEL_API void rescale(VoronoiMesh& mesh, double radius);

/// The weights that reconstruct the tangential velocity (TRiSK: Thuburn, Ringler, Skamarock, Klemp
/// 2009, eq. 33): over the entries k of row e, the sum of weights[k] u[edges.values[k]] for normal
/// velocities u is the velocity along the edge e, from its first to its second vertex.
///
/// 1. A row has the other edges of the first cell counterclockwise from e, then those of the second
///    cell.
/// 2. weight(e, e') * cell_distance(e) / vertex_distance(e') is antisymmetric, so that the
///    Coriolis force does no work.
struct TangentialWeights {
  CompressedRows<Index> edges;  ///< a row for each edge
  std::vector<double> weights;
};
RONDEL_API TangentialWeights tangential_weights(const VoronoiMesh& mesh,
                                                const Execution& execution = {});

/// Returns the distance of neighbors in a grid of regular hexagons of this area: sqrt(2 area / sqrt
/// 3).
RONDEL_API double spacing_of(double area);

}  // namespace rondel::mesh
