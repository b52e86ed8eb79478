// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The natural neighbors of a target: the vertices around its conflict region, and the faces of that.
//
//              4 ---- 3            Positions in the ring: 0, 1, ..., k-1 counterclockwise, 0 the lowest
//            /  \    / \           vertex; k stands for 0 again. A face (a, apex, b), counterclockwise,
//          5 --- \  /   2          was entered across its edge b -> a: of the first one that is the
//            \    \/   /           horizon's edge 0 -> 1. Edges between next positions are those of the
//             0 -- 1 -             horizon, because the region has no inner vertex.
//
// All that depends on nothing but the set of sites and the target.
#pragma once

#include <span>
#include <vector>

#include "interpolation/ground.h"
#include "interpolation/row.h"
#include "query/engine.h"

namespace rondel::interpolation {

struct RegionFace {
  Index a;
  Index apex;  // a < apex < b
  Index b;
  Index parent;  // the face behind the edge b -> a, among those before; none: no_index
};

class NaturalRegion {
 public:
  explicit NaturalRegion(const Ground& ground) : ground_(ground) {}

  // Of a target that is no vertex.
  void find(const TargetPlace& place);
  // Of the same target.
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

  // Of a vertex that is there.
  [[nodiscard]] Index position_between(Index a, Index b, Index vertex) const;

  const Ground& ground_;
  query::RegionSearch search_;
  topology::Halfedge root_ = 0;  // the horizon's first edge, seen from inside
  std::vector<Index> ring_;
  std::vector<RegionFace> faces_;
  std::vector<RegionEntry> stack_;
};

}  // namespace rondel::interpolation
