// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A constrained Delaunay triangulation under insertions and removals of sites and of constraints
/// (target rondel::geo).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// An immutable copy of a DynamicConstrainedTriangulation.
struct ConstrainedSnapshot {
  std::vector<Index> site_ids;        ///< ascending; site i of `result` is site_ids[i]
  std::vector<Index> constraint_ids;  ///< ascending; constraint i of `result` is constraint_ids[i]
  /// What constrained_delaunay() returns for the sites and the constraints in the order of their
  /// ids, without a report.
  ConstrainedTriangulation result;
};

/// A constrained Delaunay triangulation under insertions and removals of single sites and
/// constraints (Anglada, Computers & Graphics 21, 1997; Shewchuk and Brown, Fast segment insertion
/// and incremental construction of constrained Delaunay triangulations, Computational Geometry 48,
/// 2015). The proofs are in docs/theory/constrained.md.
///
/// 1. At any time the triangulation is the one that constrained_delaunay() computes for the present
///    sites and constraints, whatever changes led to it.
/// 2. Each site and each constraint has an id that keeps its meaning until it is removed; then the
///    id may be given to a new one. Those of a constructor have the ids 0, 1, 2 ...
/// 3. A site may lie on constraints, which it divides; when it goes, their pieces unite. It cannot
///    go while it is an end of a constraint, nor while constraints pass it along different arcs,
///    which would cross where it was. Of duplicates each can go that is no end of a constraint
///    itself.
/// 4. Constraints may be repeated and may overlap. An edge stays as long as one of its constraints
///    is left.
/// 5. A call that throws changes nothing. The index of InvalidInput is the position in the
///    argument. After std::bad_alloc, Interrupted or another failure amid a change, the
///    triangulation is built again from its sites and constraints when it is next needed. This may
///    take as long as constrained_delaunay(), and may throw std::bad_alloc again.
/// 6. The insertion of a site takes time in proportion to the faces that it changes, after O(log n)
///    expected time to find its place; and the edges on the way to it, where a constraint is
///    between it and the closest site in the spatial order. The removal of a site with d neighbors
///    takes O(d) expected time. A constraint takes the time that constrained_delaunay() takes for
///    it; its removal takes time in proportion to the faces that change with each of its edges,
///    also at worst. A change may take as long as constrained_delaunay() while all sites lie on one
///    great circle. Whenever the number of sites has doubled or halved,
///    one change takes O(n) to bring close sites together in memory.
/// 7. Const functions may be called from several threads at once.
/// 8. A triangulation that was moved from can only be assigned to or destroyed.
class RONDEL_API DynamicConstrainedTriangulation {
 public:
  /// Makes a triangulation without sites. \throws InvalidInput if the sphere is not valid.
  explicit DynamicConstrainedTriangulation(const Sphere& sphere = {});

  /// Makes a triangulation of sites and constraints, which are copied, by constrained_delaunay().
  /// \param constraints  the two ends of each constraint, as indices of sites
  /// \throws InvalidInput, CrossingConstraints as constrained_delaunay() does
  DynamicConstrainedTriangulation(std::span<const Point> sites,
                                  std::span<const std::array<Index, 2>> constraints,
                                  const Sphere& sphere = {}, const Execution& execution = {});

  ~DynamicConstrainedTriangulation();
  DynamicConstrainedTriangulation(DynamicConstrainedTriangulation&& other) noexcept;
  DynamicConstrainedTriangulation& operator=(DynamicConstrainedTriangulation&& other) noexcept;

  /// Adds a site and returns its id.
  /// \throws InvalidInput if a coordinate is not finite, the site is the center, or there are
  ///         `max_sites` sites already.
  Index insert(const Point& site);

  /// Adds a site, in time that does not depend on the number of sites if the one with the id `hint`
  /// is close to it. \throws InvalidInput also if there is no site `hint`.
  Index insert(const Point& site, Index hint);

  /// Removes a site.
  /// \throws InvalidInput if there is no such site, or it is an end of a constraint, which is named
  /// \throws CrossingConstraints if several constraints meet in the site that would cross without
  ///         it; the constraints are named by their ids
  void remove(Index site);

  /// Adds the arc between two sites and returns its id.
  /// \throws InvalidInput (0 for the first site, 1 for the second one) if there is no such site;
  ///         also if both are in one place or opposite to each other
  /// \throws CrossingConstraints if it crosses a constraint in the inside of both. They are named
  ///         by their ids, the new one by the id that it would have got. Of several any one is
  ///         named.
  Index insert_constraint(Index first, Index second);

  /// Removes a constraint. \throws InvalidInput if there is no such constraint.
  void remove_constraint(Index constraint);

  [[nodiscard]] const Sphere& sphere() const noexcept;

  /// These have the same meaning as in Triangulation.
  [[nodiscard]] int dimension() const;
  [[nodiscard]] std::size_t num_sites() const noexcept;
  [[nodiscard]] std::size_t num_vertices() const;
  [[nodiscard]] std::size_t num_faces() const;
  [[nodiscard]] std::size_t num_constraints() const noexcept;

  /// Return the ids in use, ascending.
  [[nodiscard]] std::vector<Index> site_ids() const;
  [[nodiscard]] std::vector<Index> constraint_ids() const;
  [[nodiscard]] bool contains(Index site) const noexcept;
  [[nodiscard]] bool contains_constraint(Index constraint) const noexcept;

  /// The functions below throw InvalidInput if there is no such site or constraint.

  [[nodiscard]] Point site(Index site) const;
  /// Returns the two sites of a constraint, in the order in which they were given.
  [[nodiscard]] std::array<Index, 2> constraint(Index constraint) const;
  /// Returns the lowest id in the same place, which represents all of them.
  [[nodiscard]] Index representative(Index site) const;
  /// Returns the vertices that share an edge of a solid face with a site, counterclockwise seen
  /// from outside: from the lowest id on, or, on the border of what solid faces cover, from the
  /// next vertex of the border on. A duplicate has those of its representative. Below dimension 2
  /// they are the neighbors in the ring, ascending.
  [[nodiscard]] std::vector<Index> neighbors(Index site) const;
  /// Returns the vertices along a constraint, from its first site to its second one; of duplicates
  /// the lowest id.
  [[nodiscard]] std::vector<Index> chain(Index constraint) const;

  /// Returns a copy of the sites, the constraints and their triangulation, in O(n) after sorting
  /// the sites.
  [[nodiscard]] ConstrainedSnapshot snapshot() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rondel
