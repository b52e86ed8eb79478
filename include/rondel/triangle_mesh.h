// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes of triangles for ocean models: their nodes, triangles and depths, and their border in open,
/// land and island segments (target rondel::geo).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The kind of place beyond a segment of the border.
enum class BoundaryKind : std::uint8_t {
  open,    ///< water that is not in the mesh
  land,    ///< the coast of the mainland
  island,  ///< an island, around which the segment is closed
};

/// Returns the name of a value: "open", "land", "island"; empty for other numbers.
RONDEL_API std::string_view name_of(BoundaryKind kind) noexcept;

/// A part of the border of a mesh: a chain of its edges.
struct BoundarySegment {
  BoundaryKind kind = BoundaryKind::land;
  /// The nodes in order, at least two. Of an island, at least three: the last one is joined with the
  /// first one. Other chains are closed if their last node is their first one.
  std::vector<Index> nodes;
  /// ADCIRC's number of the type of the boundary, IBTYPE, if it is another one than 0 for open water
  /// and land, 1 for islands: 11 or 21 for islands; for land none of these, and none of the types
  /// that have numbers at their nodes (3, 4, 5, 13, 23, 24, 25, 64); at most 999.
  std::optional<std::int32_t> type = std::nullopt;
  friend bool operator==(const BoundarySegment&, const BoundarySegment&) = default;
};

/// Triangles on the sphere, which need not be Delaunay.
///
/// 1. Every node is a corner of a triangle. Triangles are counterclockwise seen from outside, by the
///    exact orientation, and two of them share an edge in opposite directions. They should not
///    overlap, which is not checked.
/// 2. Each segment is a chain of edges of the border, in either direction. Segments need not cover
///    the border.
struct TriangleMesh {
  /// The nodes, from the center of the sphere: unit vectors, or vectors of another length as a file
  /// has them.
  std::vector<Point> points;
  /// The nodes in degrees as given; empty if they were given as x, y, z. Files in degrees have these
  /// numbers.
  std::vector<LonLat> positions;
  /// The corners of each triangle, indices of nodes.
  std::vector<Triple> triangles;
  /// The depth of the water at each node in metres, positive down; empty: not known.
  std::vector<double> depths;
  /// The depths of the levels between layers in metres, positive down and increasing, three or more,
  /// which FESOM's files have; empty: not known.
  std::vector<double> levels;
  std::vector<BoundarySegment> boundary;
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Divides the border of triangles into segments.
///
/// 1. The border is the edges of one triangle only. It consists of loops, with the triangles to
///    their left. A loop passes through a node at most once: where triangles meet in a node without
///    a common edge, each gap between them belongs to a loop of its own, and a loop that would come
///    back to a node is divided there.
/// 2. A loop is an *island* if all of its edges are coast and the gap to its right is less than half
///    of the sphere. Any other loop is outer, or has open edges: it is divided into chains, *open*
///    ones and those of *land*. So a mesh of an ocean basin has one outer loop, and the continents
///    in a mesh of all oceans are islands.
/// 3. An outer loop of one kind gives two chains that are linked at both ends, as SCHISM and ADCIRC
///    want it: from its lowest node halfway round, and the rest.
/// 4. Open segments come first, then land, then islands; of one kind, by the lowest node of the
///    loop, and along the loop from there.
///
/// Areas decide between islands and outer loops, rounded to 1e-9 of the sphere; everything else is
/// combinatorial, or exact.
/// \param points  the nodes, of any length but 0
/// \param triangles  counterclockwise seen from outside
/// \param coast  the edges that are coast, in either direction; edges that are not on the border
///               have no effect. Not given: all edges are
/// \throws InvalidInput (the position of the triangle) if a corner is no node, or if two triangles
///         have an edge in the same direction, as of three do; (the position of the node) if a point is not
///         finite or the center, or triangles overlap around a node of the border
RONDEL_API std::vector<BoundarySegment> boundary_segments(
    std::span<const Point> points, std::span<const Triple> triangles,
    const std::optional<std::span<const std::array<Index, 2>>>& coast = std::nullopt);

/// Makes a mesh of triangles between points, with the segments of boundary_segments(). Points in no
/// triangle are left out; the others keep their order.
/// \param positions  the points in degrees, or empty
/// \param coast  as for boundary_segments(), indices of `points`
/// \param depths  of the points in metres, positive down; or empty
/// \throws InvalidInput as boundary_segments() and require_valid() do; if `positions` are not as
///         many as the points, or `depths`; and (the position of the edge) if an edge of `coast` has no such point
RONDEL_API TriangleMesh
triangle_mesh(std::span<const Point> points, std::span<const LonLat> positions,
              std::span<const Triple> triangles,
              const std::optional<std::span<const std::array<Index, 2>>>& coast = std::nullopt,
              std::span<const double> depths = {});

/// Leaves out triangles on the border that have no area in the plane of longitude and latitude, where
/// models compute, are clockwise there, or are at most 1e-12 degrees high, which is what rounding does:
/// as three nodes of one meridian, which become slivers on the hull of a triangulation when their unit
/// vectors are rounded, or of one parallel. A triangle is left out if its longest side in degrees is on
/// the border and no constraint, repeatedly, so that those behind it are next; one with an inner
/// longest side, a corner at a pole or a pole inside stays.
/// \param positions  the nodes in degrees, as a file will have them
/// \param triangles  counterclockwise seen from outside; those that stay keep their order
/// \param constraints  edges that stay, in either direction
/// \return the number of triangles left out
/// \throws InvalidInput (the position of the triangle) if a corner is no node
RONDEL_API std::size_t leave_out_flat(std::span<const LonLat> positions,
                                      std::vector<Triple>& triangles,
                                      std::span<const std::array<Index, 2>> constraints = {});

/// Checks what TriangleMesh promises.
/// \throws InvalidInput (the position of the node, triangle or segment, which the message names) for
///         arrays whose lengths do not fit; for numbers that are not finite, points at the center,
///         and latitudes beyond a pole; and for what breaks 1 or 2
RONDEL_API void require_valid(const TriangleMesh& mesh);

/// Makes nodes deeper that are less deep than so many metres, as models need at coasts, and returns
/// their number.
/// \throws InvalidInput if the mesh has no depths, or the least depth is not finite
RONDEL_API std::size_t deepen(TriangleMesh& mesh, double least_depth);

/// The measures on which the time step and the errors of a model depend.
struct TriangleQuality {
  double smallest_angle_deg = 0;  ///< of all triangles, between chords
  double shortest_edge = 0;       ///< of all edges, in radians
  double longest_edge = 0;
};

/// Returns the extreme edges and the smallest angle of a mesh; zeros if it has no triangles.
RONDEL_API TriangleQuality triangle_quality(const TriangleMesh& mesh);

/// Returns a picture in SVG, of at most a million bytes: histograms of the smallest angles, of all
/// angles and of the sides, and a map of the triangles in colors of their smallest angle, with circles
/// around the `num_worst` smallest ones, whose titles name triangle and place. Meshes within 90
/// degrees of their middle are drawn in Lambert's azimuthal equal-area projection, others in longitude
/// and latitude. Of more than 8000 triangles each square of 3 pixels has the color of the smallest
/// angle in it.
/// \throws InvalidInput as require_valid() does, and if there are no triangles
RONDEL_API std::string quality_picture(const TriangleMesh& mesh, std::size_t num_worst = 20);

/// Returns the nodes with several gaps between their triangles, ascending: SCHISM, ADCIRC and FESOM
/// refuse them.
/// \throws InvalidInput as boundary_segments() does
RONDEL_API std::vector<Index> pinched_nodes(const TriangleMesh& mesh);

}  // namespace rondel::mesh
