// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Questions to a triangulation: where is a point, which sites are near it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rondel/dynamic.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// What the ray from the center through a point meets.
enum class Where : std::uint8_t {
  vertex,   ///< a vertex: sites[0]
  edge,     ///< the inside of an edge: sites[0] and sites[1]
  face,     ///< the inside of a solid face: its three corners
  outside,  ///< no solid face: the ray leaves between ghost faces
};

/// The answer of Locator::locate().
struct Location {
  Where where = Where::outside;
  /// A solid face that has it: of several the first; none below dimension 2.
  Index face = no_index;
  std::array<Index, 3> sites = {no_index, no_index, no_index};
  friend bool operator==(const Location&, const Location&) = default;
};

/// Lists of sites in compressed rows: list i is sites[offsets[i]] ... sites[offsets[i+1]-1].
struct SiteLists {
  std::vector<std::uint64_t> offsets;
  std::vector<Index> sites;
};

/// Answers questions to a triangulation. A query point stands for the ray from the center of the
/// sphere through it.
///
/// 1. All answers are exact, ties included, and depend on the set of sites and the query alone.
/// 2. The distance of a site P from a query p is the angle between their rays (Model::projected) or
///    the Laguerre distance arccos(cos(angle) |P|/R), which puts p into the power cell of the
///    nearest site (Model::weighted; Sugihara 2002). Vectors are taken from the center.
/// 3. The answers are vertices: input indices, for duplicates the lowest one; never a hidden site.
/// 4. A range of queries is answered in spatial order, faster than one by one.
/// 5. Any number of threads may use one Locator at once.
/// 6. One that was moved from can only be assigned to or destroyed.
///
/// Expected time for one query: O(log n) and the length of the answer; in a large range
/// O(1). Vertices at exactly the same distance are all visited.
/// Memory: 96 bytes a vertex.
class RONDEL_API Locator {
 public:
  /// Keeps the sites of the triangulation. O(n).
  /// \throws InvalidInput if it is made of arrays from elsewhere that are not those of its sites'
  ///         triangulation; that is proved once, as check() does, and costs more than the rest.
  explicit Locator(const Triangulation& triangulation);

  /// O(1) in dimension 2. Keeps a reference. After the next change, even one that failed, all
  /// questions throw InvalidInput. Sites have their ids, faces numbers for DynamicTriangulation::face().
  explicit Locator(const DynamicTriangulation& triangulation);
  explicit Locator(DynamicTriangulation&& triangulation) = delete;
  ~Locator();
  Locator(Locator&& other) noexcept;
  Locator& operator=(Locator&& other) noexcept;

  /// \throws InvalidInput, like all functions below that take query points, with the first bad
  ///         index if one is not finite or the center of the sphere; before any work.
  [[nodiscard]] Location locate(const Point& query) const;
  [[nodiscard]] std::vector<Location> locate(std::span<const Point> queries,
                                             const Execution& execution = {}) const;

  /// The nearest vertex; of several the lowest index. no_index without sites.
  [[nodiscard]] Index nearest(const Point& query) const;
  [[nodiscard]] std::vector<Index> nearest(std::span<const Point> queries,
                                           const Execution& execution = {}) const;

  /// The k nearest vertices in order of distance, of equal ones the lower index first; all vertices
  /// if there are fewer. For a range of q queries an array of shape (q, k), filled up with
  /// no_index. \throws InvalidInput if q * k is not a size that an array can have.
  [[nodiscard]] std::vector<Index> k_nearest(const Point& query, std::size_t k) const;
  [[nodiscard]] std::vector<Index> k_nearest(std::span<const Point> queries, std::size_t k,
                                             const Execution& execution = {}) const;

  /// All vertices at a distance of at most `angle` radians, in increasing order; with pi or more
  /// all vertices. Weighted with angle 0: the circles that hold the query. Exact for an angle that
  /// differs from the given one by a factor of at most 1 + 1e-15 (beyond 90 degrees: its difference
  /// from pi does, by 1e-15 and a factor), and exactly 0 for 0. \throws InvalidInput if the angle
  /// is negative or not a number.
  [[nodiscard]] std::vector<Index> within(const Point& query, double angle) const;
  [[nodiscard]] SiteLists within(std::span<const Point> queries, double angle,
                                 const Execution& execution = {}) const;

  /// The distance of any site, hidden ones too, in radians from 0 to pi. Projected: within 8e-16 of
  /// itself and 1e-29. Weighted: its cosine, clamped to [-1, 1], is within 1e-15 (1 + |P|/R);
  /// 0 is the inside of the circle.
  /// \throws InvalidInput also if there is no such site.
  [[nodiscard]] double distance(const Point& query, Index site) const;

  /// The vertices that share an edge with a site, counterclockwise from the lowest index. Of a
  /// duplicate those of its representative; of a hidden site none.
  /// \throws InvalidInput if there is no such site.
  [[nodiscard]] std::vector<Index> neighbors(Index site) const;

  /// The faces that would go if the query were inserted as a site, in increasing order, ties broken
  /// as the triangulation breaks them. None for a duplicate of a vertex and for a site that
  /// would be hidden, and below dimension 2. In the weighted model the query is a weighted site,
  /// which may be the center.
  [[nodiscard]] std::vector<Index> conflict_region(const Point& query) const;

  class Impl;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace rondel
