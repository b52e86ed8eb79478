// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Graphs of who is near to whom, read from a triangulation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// spanning_tree is part of relative, relative of gabriel and of urquhart, all of delaunay. |ab| is the angle between the rays of two sites.
enum class GraphKind : std::uint8_t {
  delaunay,  ///< the edges of solid faces
  urquhart,  ///< of these, all but those longer than both other edges of one of their solid faces
  gabriel,   ///< no other vertex in the closed cap with diameter ab
  relative,  ///< no vertex c with |ac| < |ab| and |bc| < |ab|: relative neighborhoods
  spanning_tree,  ///< the shortest tree of edges that has all vertices
};

/// Edges between vertices, and how long they are.
struct SiteGraph {
  std::vector<std::array<Index, 2>> edges;  ///< the lower index first, in lexicographic order
  std::vector<double> lengths;              ///< radians along the great circle, to 8e-16 of itself
};

/// The graph of the vertices of an unweighted triangulation.
///
/// 1. All decisions are exact for the rays of the sites, ties included.
/// 2. Ties depend on places alone: a vertex on the border of a cap is in it; a vertex c as far from a
///    or b as these are from each other takes no edge away, so an equilateral face keeps its edges. Where
///    there are several shortest trees, of equal edges those first in lexicographic order are taken.
/// 3. spanning_tree is part of relative, relative of gabriel and of urquhart, these of
///    delaunay. So all are connected.
/// 4. Duplicates are represented by the lowest index of their place; other sites there have no edges.
/// 5. Below dimension 2 the faces are the arcs shorter than 180 degrees between neighbors around the
///    great circle, and two vertices alone have one edge in all graphs, even antipodes.
///
/// Expected time: O(n), relative O(n) for sites of even density, spanning_tree O(n log n).
/// \throws InvalidInput if the sites are weighted.
RONDEL_API SiteGraph site_graph(const Triangulation& triangulation, GraphKind kind,
                                const Execution& execution = {});

/// Which directions of its edges a graph is given with.
enum class EdgeDirections : std::uint8_t {
  one,   ///< from the lower index to the higher
  both,  ///< both, one after the other in lexicographic order of source and target
};

/// The edges as libraries for graph learning take them: shape (2, E), sources before targets.
struct EdgeIndex {
  std::vector<std::int64_t> ends;  ///< 2 E
  std::vector<double> lengths;     ///< E, radians
};
RONDEL_API EdgeIndex edge_index(const SiteGraph& graph,
                                EdgeDirections directions = EdgeDirections::both);

/// Writes an edge a row or feature, with its `source`, `target` and `length_deg`: .csv, .geojson (RFC 7946: a
/// MultiLineString, cut at the antimeridian, within the tolerance of its arc), or .npy (the sites alone, uint32,
/// shape (E, 2)).
/// \throws InvalidInput if an edge has another site than those, or no length.
RONDEL_API void write_graph(const FileName& file, const Triangulation& triangulation,
                            const SiteGraph& graph, double tolerance_deg = 0.01,
                            const Execution& execution = {});

}  // namespace rondel
