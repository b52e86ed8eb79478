// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Proximity graphs of the vertices of a triangulation: Delaunay, Urquhart, Gabriel, relative
/// neighborhoods, minimum spanning tree.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The kinds of proximity graphs, each a subgraph of the one above it: spanning_tree of relative,
/// relative of gabriel and of urquhart, and these of delaunay. |ab| is the angle between the rays
/// of two sites.
enum class GraphKind : std::uint8_t {
  delaunay,       ///< the edges of solid faces
  urquhart,       ///< Delaunay edges that are not the longest edge of a solid face
  gabriel,        ///< edges ab without another vertex in the closed cap with the diameter ab
  relative,       ///< edges ab without a vertex c such that |ac| < |ab| and |bc| < |ab|
  spanning_tree,  ///< the minimum spanning tree of all vertices
};

/// Returns the name of a value: "delaunay", "urquhart", "gabriel", "relative", "mst"; empty for other
/// numbers.
RONDEL_API std::string_view name_of(GraphKind kind) noexcept;

/// The edges of a graph between vertices, with their lengths.
struct SiteGraph {
  /// Two sites, the lower index first; edges in lexicographic order.
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;  ///< radians along the great circle, relative error at most 8e-16
};

/// Returns a proximity graph of the vertices of an unweighted triangulation.
///
/// 1. All decisions are exact for the rays of the sites, ties included.
/// 2. Ties depend on the positions of the vertices alone. A vertex on the border of a cap is in the
///    cap. A vertex c that is as far from a or b as these are from each other removes no edge, so
///    an equilateral face keeps its edges. Where several minimum spanning trees exist, edges of
///    equal length are taken in lexicographic order.
/// 3. spanning_tree is a subgraph of relative, relative of gabriel and of urquhart, and these of
///    delaunay. So all graphs are connected.
/// 4. Duplicates are represented by the site of lowest index at their place; the others have no
///    edges.
/// 5. Below dimension 2 the Delaunay edges are the arcs shorter than 180 degrees between neighbors
///    around the great circle. Two vertices alone have one edge in all graphs, even if they are
///    antipodes.
///
/// The expected time is O(n); it is O(n log n) for spanning_tree, and O(n) for relative only if the
/// density of sites is even.
/// \param triangulation a triangulation with Model::projected
/// \throws InvalidInput if the sites are weighted, or constraints have changed faces.
RONDEL_API SiteGraph site_graph(const Triangulation& triangulation, GraphKind kind,
                                const Execution& execution = {});

/// The directions in which edge_index() lists an edge.
enum class EdgeDirections : std::uint8_t {
  one,   ///< from the lower index to the higher one
  both,  ///< both, all in lexicographic order of source and target
};

/// The edges of a graph as libraries for graph learning take them: an array of shape (2, E),
/// sources before targets.
struct EdgeIndex {
  std::vector<std::int64_t> ends;  ///< E sources, then E targets; sites
  std::vector<double> lengths;     ///< the lengths of the E edges, radians
};
RONDEL_API EdgeIndex edge_index(const SiteGraph& graph,
                                EdgeDirections directions = EdgeDirections::both);

/// Writes a graph, one row or feature for each edge, with `source`, `target` (sites) and
/// `length_deg`.
/// \param file  .csv; .geojson (RFC 7946: a MultiLineString, cut at the antimeridian); or .npy (the
///              sites alone, uint32, shape (E, 2))
/// \param tolerance_deg  how far drawn lines of a GeoJSON file may leave the arcs, degrees
/// \throws InvalidInput if an edge has an end that is no site of `triangulation`, or no finite
///         length.
/// \throws FileError if the file cannot be written.
RONDEL_API void write_graph(const FileName& file, const Triangulation& triangulation,
                            const SiteGraph& graph, double tolerance_deg = 0.01,
                            const Execution& execution = {});

}  // namespace rondel
