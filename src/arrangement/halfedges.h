// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of an arrangement: which halfedges follow each other around them.
//
// in    an arrangement
// out   halfedges around nodes and faces, and the sectors between them
// index halfedges: 2 * edge from the lower node to the higher one, 2 * edge + 1 backwards. The face
//       of a halfedge is to its left. The sector of a halfedge is the angle between it and the next
//       halfedge from the same node, counterclockwise; it belongs to the same face.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/arrangement.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

class Halfedges {
 public:
  Halfedges(const Arrangement& arrangement, unsigned threads);

  [[nodiscard]] static Index twin(Index h) { return h ^ 1U; }
  [[nodiscard]] Index origin(Index h) const { return arrangement_.edges[h / 2][h % 2]; }
  [[nodiscard]] Index end(Index h) const { return origin(twin(h)); }
  [[nodiscard]] const Point& point(Index node) const { return arrangement_.nodes[node]; }
  [[nodiscard]] std::size_t size() const { return next_.size(); }
  [[nodiscard]] std::size_t num_nodes() const { return around_.size(); }
  // Returns the halfedges from a node, counterclockwise.
  [[nodiscard]] std::span<const Index> around(Index node) const { return around_[node]; }
  // Returns the next halfedge around the face.
  [[nodiscard]] Index next(Index h) const { return next_[h]; }

  // The sectors of a path (directions.h) at an end, of which `target` is the other one. Both ends
  // must have edges, and must not be opposite to each other.
  [[nodiscard]] Index sector_towards(Index node, const Point& target) const;
  [[nodiscard]] Index sector_from(Index node, const Point& target) const;
  // True if the path along the arc from p to q crosses an edge of which neither is an end.
  [[nodiscard]] bool is_crossed(Index edge, const Point& p, const Point& q) const;

 private:
  void sort_around(Index node);

  const Arrangement& arrangement_;
  CompressedRows<Index> around_;
  std::vector<Index> next_;
};

}  // namespace rondel::arrangement
