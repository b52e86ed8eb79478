// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Queries to a triangulation: the location of a point, and the sites near it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/dynamic.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The part of a triangulation that the ray from the center through a point meets.
enum class Where : std::uint8_t {
  vertex,   ///< a vertex: sites[0]
  edge,     ///< the inside of an edge: sites[0] and sites[1]
  face,     ///< the inside of a solid face: its three corners
  outside,  ///< no solid face: the ray leaves between ghost faces
};

/// Returns the name of a value: "vertex", "edge" ...; empty for other numbers.
RONDEL_API std::string_view name_of(Where where) noexcept;

/// The answer of Locator::locate().
struct Location {
  Where where = Where::outside;
  /// A solid face that has the point, the first one of several; no_index below dimension 2 and
  /// outside.
  Index face = no_index;
  std::array<Index, 3> sites = {no_index, no_index, no_index};
  friend bool operator==(const Location&, const Location&) = default;
};

/// Answers queries to a triangulation. A query point stands for the ray from the center of the
/// sphere through it.
///
/// 1. All answers are exact, ties included, and depend on the set of sites and the query alone.
/// 2. The distance of a site P from a query p is the angle between their rays (Model::projected),
///    or the Laguerre distance arccos(cos(angle) |P|/R), by which p is in the power cell of the
///    nearest site (Model::weighted; Sugihara 2002). Vectors are taken from the center.
/// 3. The answers are vertices: input indices, for duplicates the lowest one; never a hidden site.
/// 4. A range of queries is answered in spatial order, faster than one by one.
/// 5. Any number of threads may use one Locator at once.
/// 6. A Locator that was moved from can only be assigned to or destroyed.
///
/// The expected time of a query is O(log n) plus the length of the answer; in a large range it is
/// O(1) plus that length. Vertices at exactly the same distance are all visited.
/// The memory is 96 bytes for each vertex.
class RONDEL_API Locator {
 public:
  /// Prepares a triangulation, whose sites are kept, in O(n).
  /// \throws InvalidInput if it was made by Triangulation::from_arrays() and is not the
  ///         triangulation of its sites; that is tested once, as check() does, and takes longer
  ///         than the rest.
  explicit Locator(const Triangulation& triangulation);

  /// Prepares a dynamic triangulation, to which it keeps a reference, in O(1) in dimension 2. After
  /// the next change, even one that failed, all queries throw InvalidInput. Sites are given by
  /// their ids, faces by indices for DynamicTriangulation::face().
  explicit Locator(const DynamicTriangulation& triangulation);
  explicit Locator(DynamicTriangulation&& triangulation) = delete;
  ~Locator();
  Locator(Locator&& other) noexcept;
  Locator& operator=(Locator&& other) noexcept;

  /// Returns where a query is.
  /// \throws InvalidInput, like all functions below that take query points, with the first bad
  ///         index if one is not finite or is the center of the sphere; before any work.
  [[nodiscard]] Location locate(const Point& query) const;
  [[nodiscard]] std::vector<Location> locate(std::span<const Point> queries,
                                             const Execution& execution = {}) const;

  /// Returns the nearest vertex; of several the lowest index; no_index if there are no sites.
  [[nodiscard]] Index nearest(const Point& query) const;
  [[nodiscard]] std::vector<Index> nearest(std::span<const Point> queries,
                                           const Execution& execution = {}) const;

  /// Returns the k nearest vertices in order of distance, of equal ones the lower index first; all
  /// vertices if there are fewer. For a range of q queries the result is an array of shape (q, k),
  /// filled up with no_index. \throws InvalidInput if q * k is not a size that an array can have.
  [[nodiscard]] std::vector<Index> k_nearest(const Point& query, std::size_t k) const;
  [[nodiscard]] std::vector<Index> k_nearest(std::span<const Point> queries, std::size_t k,
                                             const Execution& execution = {}) const;

  /// Returns all vertices at a distance of at most `angle` radians, ascending; with pi or more all
  /// vertices. For weighted sites and angle 0 these are the circles that contain the query. The
  /// answer is exact for an angle that differs from the given one by a factor of at most 1 + 1e-15
  /// (beyond 90 degrees: whose difference from pi differs by 1e-15 and such a factor), and for
  /// exactly 0 if it is 0. For a range of queries row i has the vertices of query i.
  /// \throws InvalidInput if the angle is negative or not a number.
  [[nodiscard]] std::vector<Index> within(const Point& query, double angle) const;
  [[nodiscard]] CompressedRows<Index> within(std::span<const Point> queries, double angle,
                                             const Execution& execution = {}) const;

  /// Returns the distance of any site, hidden ones too, in radians from 0 to pi. The error for
  /// projected sites is at most 8e-16 times the distance plus 1e-29. For weighted sites the cosine
  /// of the distance, clamped to [-1, 1], is within 1e-15 (1 + |P|/R), and 0 is the inside of the
  /// circle.
  /// \throws InvalidInput also if there is no such site.
  [[nodiscard]] double distance(const Point& query, Index site) const;

  /// Returns the vertices that share an edge with a site, counterclockwise from the lowest index. A
  /// duplicate has those of its representative; a hidden site has none.
  /// \throws InvalidInput if there is no such site.
  [[nodiscard]] std::vector<Index> neighbors(Index site) const;

  /// Returns the faces that would be removed if the query were inserted as a site, ascending, with
  /// ties broken as the triangulation breaks them. There are none for a duplicate of a vertex, for
  /// a site that would be hidden, and below dimension 2. In the weighted model the query is a
  /// weighted site, which may be the center.
  [[nodiscard]] std::vector<Index> conflict_region(const Point& query) const;

  class Impl;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace rondel
