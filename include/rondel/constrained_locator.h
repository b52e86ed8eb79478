// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The location of points in a constrained triangulation (target rondel::geo).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/export.h"
#include "rondel/query.h"
#include "rondel/types.h"

namespace rondel {

/// Finds the faces of a constrained triangulation in which points are. A query point stands for the
/// ray from the center of the sphere through it.
///
/// 1. All answers are exact, and depend on the sites, the constraints and the query alone: they are
///    those of a Locator where all faces are Delaunay.
/// 2. A range of queries is answered in spatial order, faster than one by one.
/// 3. Any number of threads may use one object at once.
/// 4. An object that was moved from can only be assigned to or destroyed.
///
/// A walk from a vertex nearby crosses edges that are not constrained towards the query, and then,
/// if a constraint is in the way, goes straight on (docs/theory/constrained.md has the proof that
/// it ends). The expected time is O(log n), for large ranges O(1), and in proportion to the edges
/// on the way behind a constraint. The memory is about 80 bytes for each vertex.
class RONDEL_API ConstrainedLocator {
 public:
  /// Prepares a triangulation, whose sites are kept, in O(n).
  /// \param result  what constrained_delaunay() returned, or a snapshot has; no face is proved
  /// \throws InvalidInput if `sides` does not have an entry for each face
  explicit ConstrainedLocator(const ConstrainedTriangulation& result);
  ~ConstrainedLocator();
  ConstrainedLocator(ConstrainedLocator&& other) noexcept;
  ConstrainedLocator& operator=(ConstrainedLocator&& other) noexcept;

  /// Returns where a query is.
  /// \throws InvalidInput with the first bad index if a query is not finite or is the center of the
  ///         sphere; before any work
  [[nodiscard]] Location locate(const Point& query) const;
  [[nodiscard]] std::vector<Location> locate(std::span<const Point> queries,
                                             const Execution& execution = {}) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace rondel
