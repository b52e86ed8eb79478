// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The natural neighbors of a target: the vertices around its conflict region, and the faces of the
// region.
//
// in    the location of a target
// out   a ring of vertices; faces as triples of positions in the ring
// index vertices by spatial rank; positions in the ring as drawn
//
//              4 ---- 3            Positions in the ring are 0, 1, ..., k-1 counterclockwise from the
//            /  \    / \           lowest vertex; k stands for 0 again. A face (a, apex, b),
//          5 --- \  /   2          counterclockwise, was entered across its edge b -> a; the first one
//            \    \/   /           was entered across the horizon's edge 0 -> 1. The edges between
//             0 -- 1 -             successive positions are the horizon, as the region has no inner vertex.
//
// The result depends only on the set of sites and the target.
#pragma once

#include <span>
#include <vector>

#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "query/engine.h"

namespace rondel::interpolation {

struct RegionFace {
  Index a;
  Index apex;  // a < apex < b
  Index b;
  Index parent;  // index of the face behind the edge b -> a, which comes before this one; no_index
                 // for the first
};

class NaturalRegion {
 public:
  explicit NaturalRegion(const PreparedTriangulation& prepared) : prepared_(prepared) {}

  // Finds the ring. Precondition: the target is not at a vertex.
  void find(const LocatedTarget& place);
  // Lists the faces, after find() for the same target.
  void list_faces();

  [[nodiscard]] std::span<const Index> ring() const { return ring_; }
  [[nodiscard]] std::span<const RegionFace> faces() const { return faces_; }

 private:
  struct RegionEntry {
    topology::Halfedge into;  // the edge b -> a of the face that is entered
    Index a;
    Index b;
    Index parent;
  };

  // Returns the position of a vertex of the ring that lies between positions a and b.
  [[nodiscard]] Index position_between(Index a, Index b, Index vertex) const;

  const PreparedTriangulation& prepared_;
  query::RegionSearch search_;
  topology::Halfedge root_ = 0;  // the horizon's first edge, seen from inside
  std::vector<Index> ring_;
  std::vector<RegionFace> faces_;
  std::vector<RegionEntry> stack_;
};

}  // namespace rondel::interpolation
