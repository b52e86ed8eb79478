// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a face has of a region low <= f < high of a field that is linear in it.
//
//            c                 The piece of the face a b c between two levels: its corners are
//           / \                corners of the face, or crossings of an edge with a level. A corner whose
//     high x---x high          value is the level is itself the crossing, so that no two
//         /     \              crossings of a piece are one point. A piece without area is none, and so
//        /       \             what is left is clean: a region is the union of closed polygons, which
//   low x         x low        meet in whole sides and in corners.
//      /  \      /  \          (Where f = low along an edge, f >= low on both sides or on one: in the
//     a    '----'    b         second case that edge is the border.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// The values low <= f < high.
struct ValueRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// A corner of a piece: the site `lower` alone, if there is no `upper`; otherwise where the edge between
// them, by their values, has the level.
struct PieceCorner {
  Index lower = no_index;
  Index upper = no_index;
  double level = 0;
  unsigned edges = 0;  // bit i: on edge i of the face, from its corner i to the next
};

struct ContourPiece {
  std::array<PieceCorner, 6> corners;  // counterclockwise
  std::size_t size = 0;                // 0: the face has no area of the region

  [[nodiscard]] std::size_t next(std::size_t side) const { return side + 1 == size ? 0 : side + 1; }
  [[nodiscard]] std::size_t previous(std::size_t side) const {
    return side == 0 ? size - 1 : side - 1;
  }
  // The edge on which the side from corner `side` to the next lies; 3 for one across the face.
  [[nodiscard]] std::size_t edge_of(std::size_t side) const;
};

// The surface: the solid faces all of whose corners have values.
class ValuedFaces {
 public:
  ValuedFaces(const Triangulation& triangulation, std::span<const double> values)
      : faces_(triangulation.faces()),
        neighbors_(triangulation.neighbors()),
        values_(values),
        is_missing_(triangulation.num_faces(), 0) {
    for (const Index ghost : triangulation.ghost_faces()) is_missing_[ghost] = 1;
  }

  void find_missing(std::size_t begin, std::size_t end);
  [[nodiscard]] bool is_missing(Index face) const { return is_missing_[face] != 0; }
  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  [[nodiscard]] const Triple& corners(Index face) const { return faces_[face]; }
  [[nodiscard]] double value(Index site) const { return values_[site]; }

  // The face across an edge (from its corner `edge` to the next); no_index if it is missing.
  [[nodiscard]] Index across(Index face, std::size_t edge) const {
    const Index neighbor = neighbors_[face][(edge + 2) % 3];
    return is_missing(neighbor) ? no_index : neighbor;
  }
  // The same edge in the face across it.
  [[nodiscard]] std::size_t twin(Index face, std::size_t edge, Index across) const;

  // Precondition: the face is not missing.
  [[nodiscard]] ContourPiece piece(Index face, const ValueRange& range) const;
  [[nodiscard]] bool has_piece(Index face, const ValueRange& range) const;

 private:
  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  std::span<const double> values_;
  std::vector<std::uint8_t> is_missing_;
};

}  // namespace rondel::interpolation
