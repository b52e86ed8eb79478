// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation of sites of one square, with its memory: one square after the other uses the same,
// as arrays that grow from square to square leave gaps.
//
// in    sites of a square in the order of the curve
// out   their graph, the sites that are hidden, and the open faces
// index local sites: 0, 1, ... in this order
#pragma once

#include <algorithm>
#include <vector>

#include "bulk/open_faces.h"
#include "bulk/piece.h"

namespace rondel::bulk {

template <models::SphereModel T>
class SquarePiece {
 public:
  using Edge = PlaneGraph::Edge;

  void reserve(std::size_t num_sites) { memory_.reserve(num_sites); }

  // The graph of these sites, which are all in the square and no more than 2^28. Returns false if
  // this does not work. `input` must stay.
  bool triangulate(const Input& input, const Square& square) {
    const auto num_sites = static_cast<Index>(input.order.size());
    memory_.reserve(num_sites);
    piece_.assign(input, 0, num_sites, memory_);
    const Block all = {0, num_sites, square};
    if (num_sites < min_sites || !piece_.solve({&all, 1}) || !piece_.find_hidden()) return false;
    piece_.graph().clear_faces();
    return true;
  }

  // The halfedges with an open face on the left, see find_open_faces().
  const std::vector<Edge>& find_open(const Square& square) {
    const auto& sites = piece_.sites();
    const Certificate certificate(square, sites.hand(), T::hides_sites);
    find_open_faces(piece_.graph(), piece_.boundary(), open_, [&](Index a, Index b, Index c) {
      return certificate.is_final(sites.ray(a), sites.ray(b), sites.ray(c));
    });
    return open_;
  }

  [[nodiscard]] PlaneGraph& graph() { return piece_.graph(); }
  [[nodiscard]] Index num_sites() const { return piece_.num_sites(); }
  [[nodiscard]] const std::vector<Index>& hidden() const { return piece_.hidden(); }
  [[nodiscard]] Tally tally() const { return piece_.tally(); }

 private:
  // With fewer sites nothing would be final.
  static constexpr Index min_sites = 32;

  PieceMemory memory_;
  Piece<T> piece_;
  std::vector<Edge> open_;
};

}  // namespace rondel::bulk
