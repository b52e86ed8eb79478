// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes of triangles between coasts (target rondel::geo).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/geometries.h"
#include "rondel/mesh_refine.h"
#include "rondel/mesh_region.h"
#include "rondel/triangle_mesh.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The part of the sphere that a mesh covers, and lines that its edges follow. Straight lines in
/// longitude and latitude become arcs by read_features_together(), which takes all files at once.
struct MeshDomain {
  /// Polygons of land, which the mesh leaves out; lines are edges of the mesh.
  std::vector<Geometries> coast;
  std::vector<Geometries> area;  ///< polygons inside of which the mesh is; none: everywhere
  /// Lines and sides of polygons that are edges inside, and points that are nodes.
  std::vector<Geometries> lines;
  /// Where the turn of the mesh's longitudes begins (west_of(), rondel/longitudes.h).
  double west_deg = -180;
};

/// Returns a small region (rondel/mesh_region.h) that has all of the domain's area, on which its
/// spacings are best kept. None: there is no area, it is on the outside of its border, is not valid,
/// or reaches farther than 45 degrees from its middle to a side.
RONDEL_API std::optional<SizeRegion> region_of(const MeshDomain& domain);

/// The kind of feature that an edge of RefinedMesh::edges follows.
enum class FeatureOfEdge : std::uint8_t {
  none,   ///< nothing: it is on the border of the mesh
  coast,  ///< a coast, and perhaps others
  area,   ///< the border of the area, and perhaps a line
  line,   ///< a line
};

/// Returns the name of a value: "none", "coast" ...; empty for other numbers.
RONDEL_API std::string_view name_of(FeatureOfEdge feature) noexcept;

/// The settings of triangles().
struct TrianglesOptions {
  RefineOptions refine = {};
  /// How far the coasts, borders and lines of the mesh may be from those given, in radians
  /// (simplified(), rondel/simplify.h, of all of them together). Not given: a quarter of the
  /// spacing at the place, or 0 without a spacing. Islands and lakes that are nowhere wider,
  /// with all corners within the tolerance of one arc, vanish with what is within them. Where
  /// features cross, they have corners before they are simplified, and polygons of the coast, or of
  /// the area, that overlap or touch are united: so a coast leaves the area where it did. The
  /// clearance is a quarter of the tolerance.
  std::optional<double> tolerance = std::nullopt;
  /// Corners, ends and points that are nearer than this, in radians, to another one or to a side are
  /// put there before anything else is done: for gaps and overlaps that rounded numbers leave along
  /// borders. Of one line or ring that is done where the way along it is more than eight times as
  /// long. Rings that are no larger vanish before. Places where features cross are corners, which
  /// are welded, too, also to the ends of the sides that cross; and polygons that have changed are
  /// repaired. At most pi / 4.
  std::optional<double> weld = std::nullopt;
  /// Water that is narrower than this share of the spacing, from 0 to 1, becomes land: straits,
  /// coves and the ends of fjords, where edges would be as short as the water is narrow. 0 keeps
  /// all water.
  ///
  /// The domain without its lines, those of `coast` and `area` included, is refined by angles alone
  /// (26.5 degrees). Then triangles are
  /// filled that have all corners on coasts or the border, and an edge in the water that is
  /// shorter than this share of the spacing at its ends. The new coasts are simplified, with the
  /// tolerance and at least a quarter of that length, and all that is repeated until nothing is
  /// narrow, at most ten times. At last triangles are filled at nodes where the mesh touches
  /// itself. What is left of coasts, borders and lines stays where it is. (Compare the closing of
  /// mathematical morphology by a disk: Serra, Image Analysis and Mathematical Morphology, 1982.)
  double fill_narrow = 0;
  /// Parts of the mesh that are smaller than this share of the largest part's area vanish: from 0,
  /// where all stay, to 1, where the largest one stays. Parts have no edge in common.
  double smallest_part = 0;
};

/// The result of triangles().
struct DomainTriangles {
  /// Nodes are along the spatial order. Triangles begin with their lowest node and are sorted. So
  /// features in another order give the same arrays. `sites` and `sources` are empty.
  RefinedMesh mesh;
  std::vector<FeatureOfEdge> features;  ///< of each of `mesh.edges`
  /// The area of the water that `fill_narrow` made land, in steradians; never negative. Land that
  /// became water where new coasts are simplified is not subtracted.
  double filled_area = 0;
  std::size_t num_small_parts = 0;  ///< parts that were smaller than wanted
  /// The features of `lines`, counted over all of them, of which no arc and no point is in the mesh:
  /// they are on land or outside of the area, or so small that they vanished. Ascending.
  std::vector<Index> lines_outside;
  double west_deg = -180;  ///< that of the domain
};

/// Fills a part of the sphere with triangles whose edges follow its border: simplifies coasts,
/// borders and lines, with corners where they cross; triangulates them (rondel/constrained.h); fills
/// narrow water and leaves small parts out, if that is wanted; and refines (rondel/mesh_refine.h).
///
/// Features that touch up to rounding are welded: corners that are nearer to another corner, or to a
/// side, than 1e-4 of the spacing and than the tolerance, or than 1e-12 radians, are put there, before
/// features are simplified. A gap as narrow as that would have triangles of its size.
///
/// Where the coasts leave an open hemisphere free and there is no area, corners of an icosahedron
/// are nodes there.
/// \throws InvalidInput as constraints_of_features() (the feature, counted over coast, area and
///         lines), simplified(), constrained_delaunay() and refine(); if polygons of the coast or
///         the area cross themselves such that nothing is on one side, and are not simplified (else
///         unite() says what they have); if `fill_narrow` or
///         `smallest_part` is not from 0 to 1, or narrow water has no spacing to be compared with;
///         if the spacing asks for more nodes than RefineOptions::most_vertices, before any is made;
///         and if nothing is left, or of the area nothing after its simplification
RONDEL_API DomainTriangles triangles(const MeshDomain& domain, const TrianglesOptions& options = {},
                                     const Execution& execution = {});

/// Makes a mesh for files of the triangles of a domain: edges that follow a coast are coast, the
/// rest of the border is open. The nodes have positions in the turn that begins at `west_deg`, with
/// few decimals where these are theirs. Triangles are counterclockwise by these, too, for which
/// some nodes move by less than 1e-12 degrees.
/// \throws InvalidInput as triangle_mesh() does for points and triangles; and (the position of the
///         triangle) if one is so narrow that it has no area in degrees
RONDEL_API TriangleMesh triangle_mesh(const DomainTriangles& triangles);

}  // namespace rondel::mesh
