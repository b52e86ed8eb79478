// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Constrained Delaunay triangulations on the sphere: given arcs are edges, and everything else is
/// Delaunay as far as the arcs let it be (target rondel::geo).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/check.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// What becomes of constraints that cross each other in the inside of both, where no site is.
enum class ConstraintCrossings : std::uint8_t {
  refuse,  ///< an error, CrossingConstraints
  split,   ///< each crossing, rounded to doubles, becomes a site
};

/// The settings of constrained_delaunay().
struct ConstrainedOptions {
  /// The sphere around whose center the sites lie. Each site is projected on it exactly.
  Sphere sphere{};
  ConstraintCrossings crossings = ConstraintCrossings::refuse;
};

/// Two constraints cross in the inside of both. index() is the larger one of their positions.
class RONDEL_API CrossingConstraints : public InvalidInput {
 public:
  /// \param first  the position of one constraint, the smaller one
  /// \param second  the position of the other one
  /// \param place  where they cross
  CrossingConstraints(Index first, Index second, const LonLat& place);
  CrossingConstraints(const CrossingConstraints&) = default;
  CrossingConstraints& operator=(const CrossingConstraints&) = default;
  ~CrossingConstraints() override;

  /// Returns the positions of both constraints, ascending.
  [[nodiscard]] std::array<Index, 2> constraints() const noexcept { return constraints_; }
  /// Returns where they cross, in degrees, up to rounding.
  [[nodiscard]] LonLat place() const noexcept { return place_; }

 private:
  std::array<Index, 2> constraints_;
  LonLat place_;
};

/// A triangulation with edges that were asked for.
struct ConstrainedTriangulation {
  /// The sites and the faces. Sites that ConstraintCrossings::split has added come after those that
  /// were given, along the spatial order.
  Triangulation triangulation;
  /// The two sites of each constrained edge, the lower one first, in lexicographic order. Of
  /// duplicates the lowest index stands for all.
  std::vector<std::array<Index, 2>> edges;
  /// The constraints that each edge is a part of, ascending.
  CompressedRows<Index> sources;
  /// The sides of each face that are constrained edges: bit i is set if the edge opposite to corner
  /// i is one. Empty below dimension 2.
  std::vector<std::uint8_t> sides;
};

/// Computes the constrained Delaunay triangulation of sites: the triangulation in which each
/// constraint is a chain of edges and every other edge is locally Delaunay.
///
/// 1. A constraint is the shorter arc between two sites. It is divided at each site that lies
///    exactly on it: two that have a site in the inside of both meet there, and do not cross.
///    Constraints may be repeated, in either direction, and may overlap.
/// 2. Every site is a vertex, a duplicate or in the place of one, as delaunay() has it. The solid
///    faces cover what the solid faces of delaunay() cover, and the ghost faces are the same.
/// 3. Of two solid faces with a common edge that is not constrained, neither has the third corner
///    of the other one inside its circle. Four cocircular sites are decided as delaunay() decides
///    them. A face has no site inside its circle that can be seen from inside of the face, where
///    constraints stop the view.
/// 4. The result is unique: 1 to 3 determine it. So it depends neither on the order of the sites
///    and of the constraints nor on the number of threads. Without constraints it is that of
///    delaunay().
/// 5. Faces are in the canonical order of Triangulation. An edge may occur twice, once between
///    solid faces and once between ghost faces, as where a constraint is a diagonal that ghost
///    faces have, too. Of two faces of an owner with the same second corner, the solid one comes
///    first.
/// 6. Below dimension 2 there are no faces, and `edges` are pairs of neighbors in the ring.
///
/// A Locator, an Interpolator, a DynamicTriangulation, cells() and areas(), graphs, alpha shapes,
/// empty circles and meshes, which rely on Delaunay faces, refuse the triangulation unless all its
/// faces are those of delaunay(): its dual is no Voronoi diagram.
/// A ConstrainedLocator locates points in it, a ConstrainedInterpolator interpolates values, and a
/// DynamicConstrainedTriangulation changes it.
///
/// A constraint takes time in proportion to the edges that it crosses, times their logarithm on
/// average, also where sites lie along smooth curves, and their square at worst. The proof is in docs/theory/constrained.md (Chew,
/// Constrained Delaunay triangulations, Algorithmica 4, 1989; Anglada, An improved incremental
/// algorithm for constructing restricted Delaunay triangulations, Computers & Graphics 21, 1997).
/// \param constraints  the two ends of each constraint, as indices of sites
/// \throws InvalidInput as delaunay() does (the position of the site); and (the position of the
///         constraint) if an end is no site, or both ends are one place or opposite to each other.
/// \throws CrossingConstraints if two constraints cross, unless crossings are split. Of several
///         pairs any one is named.
/// \throws InvalidInput also, if crossings are split, where arrange() does: sites must be unit
///         vectors around the origin then.
RONDEL_API ConstrainedTriangulation
constrained_delaunay(const Sites& sites, std::span<const std::array<Index, 2>> constraints,
                     const ConstrainedOptions& options = {}, const Execution& execution = {});

/// Finds the faces in polygons whose sides are constraints, exactly and without coordinates: from
/// the left of each side it goes from face to face, up to the sides of the polygon.
///
/// A polygon may have several rings, holes, and any area; polygons may share sides and overlap. An
/// edge along which as many sides of a polygon go in one direction as in the other is no border of
/// it. Ghost faces are in no polygon. Below dimension 2 there are no faces, and a polygon that has a
/// border leaves what they cover.
/// \param result  what constrained_delaunay() returned for the constraints
/// \param constraints  those that it was called with; the interior of a polygon is to their left
/// \param polygons  the constraints that are sides of each polygon
/// \return the faces in each polygon, ascending
/// \throws InvalidInput (the position of the polygon) if its sides do not close rings that have the
///         interior on one side, or it leaves what the solid faces cover; (the position of the
///         constraint) if `result` has no chain of edges for it
RONDEL_API CompressedRows<Index> faces_inside(const ConstrainedTriangulation& result,
                                              std::span<const std::array<Index, 2>> constraints,
                                              const CompressedRows<Index>& polygons);

/// Proves or refutes that triangles are the faces of the constrained Delaunay triangulation of
/// sites: solid faces have positive orientation and cover what those of delaunay() cover, once;
/// ghost faces are those of delaunay(); every site is a vertex or a duplicate; each constraint is a
/// chain of edges; and every other edge between solid faces is locally Delaunay by an exact test.
/// It shares predicates and delaunay() with constrained_delaunay(), but no other algorithm.
/// \param constraints  as those of constrained_delaunay(); none may cross another one
/// \param triangles  shape (m, 3), indices of sites; the triangles may have any order
/// \throws InvalidInput as constrained_delaunay() does, except for constraints that cross: then no
///         triangles are valid.
RONDEL_API CheckReport check_constrained(std::span<const Point> sites,
                                         std::span<const std::array<Index, 2>> constraints,
                                         std::span<const Triple> triangles,
                                         const Sphere& sphere = {},
                                         const Execution& execution = {});

}  // namespace rondel
