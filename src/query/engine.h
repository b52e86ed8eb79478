// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The questions to one triangulation, whatever its model and dimension: each is asked of the graph
// that it is told at its making. Vertices go in under internal names, and come out under those that
// they have outside.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kernel/conflict_region.h"
#include "query/graph.h"
#include "query/neighborhood.h"
#include "query/target.h"
#include "rondel/export.h"
#include "rondel/query.h"

namespace rondel::query {

// Where the query before ended, and memory for the next one. One for each thread.
struct Cursor {
  Index vertex = no_index;
  Index face = no_index;  // a solid one; none: one at `vertex`, if it has any
  Scratch scratch;
};

// Memory for searches of conflict regions in the projected model, and the last one's horizon.
using RegionSearch = kernel::ConflictRegion<Target<models::ProjectedPoints>>;

class RONDEL_API Engine {
 public:
  explicit Engine(AnyGraph graph) : graph_(std::move(graph)) {}

  Location locate(const Point& p, Cursor& cursor) const;
  Index nearest(const Point& p, Cursor& cursor) const;
  // Append to `found`; those within a limit in increasing order.
  void k_nearest(const Point& p, std::size_t k, Cursor& cursor, std::vector<Index>& found) const;
  void within(const Point& p, const Limit& limit, Cursor& cursor, std::vector<Index>& found) const;
  // Counterclockwise from the lowest.
  [[nodiscard]] std::vector<Index> neighbors(Index v) const;
  std::vector<Index> conflict_region(const Point& p, Cursor& cursor) const;
  // The edges around the conflict region of p, counterclockwise, their vertices under internal names.
  // Precondition: dimension 2, the projected model; `start` is in conflict with p, as is every solid
  // face that has p, unless p is a vertex.
  std::span<const topology::HorizonEdge> horizon(const Point& p, Index start,
                                                 RegionSearch& search) const;

 private:
  AnyGraph graph_;
};

}  // namespace rondel::query
