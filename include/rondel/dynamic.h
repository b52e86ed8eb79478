// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A triangulation under insertions, removals and moves of sites.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// An immutable copy of a DynamicTriangulation.
struct Snapshot {
  std::vector<Index> ids;  ///< ascending; site i of `triangulation` is ids[i]
  /// The triangulation that delaunay() computes for the sites, without a report.
  Triangulation triangulation;
};

/// A Delaunay or regular triangulation under insertions, removals and moves
/// (insertion: Caroli et al., SEA 2010, section 4; removal: Chew 1990, Devillers 1999).
///
/// 1. At any time the triangulation is the one that delaunay() computes for the present sites,
///    whatever changes led to it.
/// 2. Each site has an id that keeps its meaning until the site is removed; then the id may be
///    given to a new site. The sites of a constructor have the ids 0 ... n-1.
/// 3. Hidden sites become vertices again when the sites that hide them are removed; duplicates stay
///    when one of them is removed.
/// 4. A call that throws changes nothing. The index of InvalidInput is the position in the array
///    that was passed, 0 for a single argument. After std::bad_alloc, Interrupted or another
///    failure amid a change, the triangulation is built again from its sites when it is next
///    needed. This may take as long as delaunay(), may throw std::bad_alloc again, and gives faces
///    new indices.
/// 5. An insertion takes O(log n) expected time for sites in random places, a removal O(d) expected
///    time for a vertex with d neighbors. Exceptions: the sites that a change hides or uncovers are
///    inserted once more each. A change may take O(n) while all sites lie on one great circle, when
///    the center of the sphere leaves the hull of weighted sites, and when weighted sites come in
///    order along a circle (projected ones cost no more than others). Whenever the number of sites
///    has doubled or halved, one change takes O(n) to bring close sites together in memory. Changes
///    of a range are faster than the same changes one by one. A range that changes most of the
///    sites is made by one build of the sites that are left: from 4 insertions for 7 of these on, 2
///    removals for 3, or one move for 4.
/// 6. A Locator (query.h) answers questions of place and distance.
/// 7. Const functions may be called from several threads at once.
/// 8. A triangulation that was moved from can only be assigned to or destroyed.
class RONDEL_API DynamicTriangulation {
 public:
  /// Makes a triangulation without sites. \throws InvalidInput if the sphere is not valid.
  explicit DynamicTriangulation(const Options& options = {});

  /// Makes a triangulation of n sites by delaunay(); the sites are copied. \throws InvalidInput as
  /// delaunay() does.
  explicit DynamicTriangulation(std::span<const Point> sites, const Options& options = {},
                                const Execution& execution = {});

  /// Copies a triangulation and its sites. \throws InvalidInput as a Locator does (query.h) if it
  /// was made by Triangulation::from_arrays().
  explicit DynamicTriangulation(const Triangulation& triangulation,
                                const Execution& execution = {});

  ~DynamicTriangulation();
  DynamicTriangulation(DynamicTriangulation&& other) noexcept;
  DynamicTriangulation& operator=(DynamicTriangulation&& other) noexcept;

  /// Adds a site and returns its id.
  /// \throws InvalidInput if a coordinate is not finite, a projected site is the center, or there
  ///         are `max_sites` sites already.
  Index insert(const Point& site);

  /// Adds a site, in expected constant time if the site with the id `hint` is close to it. \throws
  /// InvalidInput also if there is no site `hint`.
  Index insert(const Point& site, Index hint);

  /// Adds n sites and returns their ids in the order of `sites`. The result is that of inserting
  /// them one by one.
  std::vector<Index> insert(std::span<const Point> sites, const Execution& execution = {});

  /// Removes a site. \throws InvalidInput if there is no such site.
  void remove(Index id);

  /// Removes sites. \throws InvalidInput (first bad position) if there is no such site or an id
  /// appears twice.
  void remove(std::span<const Index> ids, const Execution& execution = {});

  /// Moves a site, which keeps its id.
  /// \throws InvalidInput as remove() and insert() do.
  void move(Index id, const Point& to);

  /// Moves ids[i] to to[i], one after the other; an id may appear again.
  /// \throws InvalidInput if there is no such site, as insert() does, and if the lengths differ.
  void move(std::span<const Index> ids, std::span<const Point> to, const Execution& execution = {});

  /// Moves all sites at once: that of ids()[i] to to[i]. The result is that of moving them one by
  /// one. Where few edges change and the sites surround the center, as when random sites move by up
  /// to a quarter of their spacing, it takes less time than to insert them into a new object, and up
  /// to a third more than that otherwise. The next change of some sites, and the next Locator, take
  /// longer then.
  /// \throws InvalidInput as insert() does, and if there are not num_sites() points.
  void move_all(std::span<const Point> to, const Execution& execution = {});

  [[nodiscard]] Model model() const noexcept;
  [[nodiscard]] const Sphere& sphere() const noexcept;

  /// These have the same meaning as in Triangulation.
  [[nodiscard]] int dimension() const;
  [[nodiscard]] std::size_t num_sites() const noexcept;
  [[nodiscard]] std::size_t num_vertices() const;
  [[nodiscard]] std::size_t num_faces() const;

  /// Returns the ids in use, ascending.
  [[nodiscard]] std::vector<Index> ids() const;
  [[nodiscard]] bool contains(Index id) const noexcept;

  /// The functions below throw InvalidInput if there is no such site.

  [[nodiscard]] Point site(Index id) const;
  /// Returns the lowest id in the same place, which represents all of them.
  [[nodiscard]] Index representative(Index id) const;
  /// True if the site, or its representative, is a vertex; otherwise it is hidden.
  [[nodiscard]] bool is_vertex(Index id) const;
  /// Returns the vertices adjacent to a vertex, counterclockwise seen from outside, beginning with
  /// the lowest id. A duplicate has those of its representative; a hidden site has none.
  [[nodiscard]] std::vector<Index> neighbors(Index id) const;

  /// Returns the corners of a face that a Locator has returned, as ids, counterclockwise seen from
  /// outside. Indices of faces are valid until the next change. \throws InvalidInput if there is no
  /// such face.
  [[nodiscard]] Triple face(Index face) const;

  /// Returns a copy of the sites and their triangulation, in O(n) after sorting the sites.
  [[nodiscard]] Snapshot snapshot() const;

 private:
  friend class Locator;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rondel
