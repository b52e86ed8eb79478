// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/piece.h"

namespace rondel::bulk {

void PieceMemory::reserve(std::size_t num_sites, std::size_t num_pieces) {
  const std::size_t num_halfedges = 6 * num_sites + 2 * num_pieces;
  if (num_halfedges <= num_halfedges_) return;
  const std::size_t of_points = num_sites * sizeof(SquarePoint);
  const std::size_t of_positions = num_sites * sizeof(SquarePosition);
  const std::size_t of_edges = num_halfedges * PlaneGraph::halfedge_bytes;
  memory_ = {};
  memory_ = system::make_large_array<std::byte>(of_points + of_positions + of_edges +
                                                num_sites * sizeof(predicates::Vector));
  std::byte* const memory = memory_.get();
  coordinates_ = {reinterpret_cast<SquarePoint*>(memory),
                  reinterpret_cast<SquarePosition*>(memory + of_points)};
  edges_ = memory + of_points + of_positions;
  num_halfedges_ = num_halfedges;
  directions_ = reinterpret_cast<predicates::Vector*>(edges_ + of_edges);
}

}  // namespace rondel::bulk
