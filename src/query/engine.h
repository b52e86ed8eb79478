// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The queries of one triangulation, whatever its model and dimension. Answers and vertices
// have internal names (vertices.h).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "predicates/within_angle.h"
#include "query/neighborhood.h"
#include "query/vertices.h"
#include "rondel/query.h"
#include "rondel/triangulation.h"

namespace rondel::query {

// Where the query before ended, and memory for the next one. One for each thread.
struct Cursor {
  Index vertex = no_index;
  Index face = no_index;  // a solid one; none: one at `vertex`, if it has any
  Scratch scratch;
};

class Engine {
 public:
  virtual ~Engine() = default;

  virtual Location locate(const Point& p, Cursor& cursor) const = 0;
  virtual Index nearest(const Point& p, Cursor& cursor) const = 0;
  virtual void k_nearest(const Point& p, std::size_t k, Cursor& cursor,
                         std::vector<Index>& found) const = 0;
  // Without a cosine: all vertices.
  virtual void within(const Point& p, const std::optional<predicates::Cosine>& cosine,
                      Cursor& cursor, std::vector<Index>& found) const = 0;
  [[nodiscard]] virtual std::vector<Index> neighbors(Index v) const = 0;
  virtual std::vector<Index> conflict_region(const Point& p, Cursor& cursor) const = 0;
};

// Keeps all arguments by reference. None for a triangulation without vertices.
std::unique_ptr<Engine> make_engine(const Triangulation& triangulation,
                                    std::span<const Point> sites, const Vertices& vertices);

}  // namespace rondel::query
