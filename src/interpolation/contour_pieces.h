// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The part of a face in which low <= f < high, for a field f that is linear in each face.
//
// in    the faces and neighbors of a surface, the values at its sites, a range of values
// out   for each face a polygon of up to six corners
// index faces and sites of the surface; sides of a piece, side i from its corner i to the
//       next
//            c                 The piece of the face a b c between two levels. Its corners are corners
//           / \                of the face and points where an edge crosses a level. A corner of the
//     high x---x high          face whose value is the level is itself the crossing, so that no two
//         /     \              corners of a piece coincide. A piece without area is dropped. So a region
//        /       \             is the union of closed polygons that meet in whole sides and in corners.
//   low x         x low
//      /  \      /  \          (Where f = low along an edge, f >= low on both sides of it or on one side;
//     a    '----'    b         in the second case that edge is the border.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "interpolation/contour_surface.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// The values from `low` on that are less than `high`.
struct ValueRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// A corner of a piece. Without an `upper` site it is the site `lower`; otherwise it is the point at
// which the value on the edge from `lower` to `upper` is `level`. The value at `lower` is the
// smaller one.
struct PieceCorner {
  Index lower = no_index;
  Index upper = no_index;
  double level = 0;
  unsigned edges = 0;  // bit i is set if the corner lies on edge i of the face, from its corner i
                       // to the next
};

// A convex polygon in a face.
struct ContourPiece {
  std::array<PieceCorner, 6> corners;  // counterclockwise; the first `size` count
  std::size_t size = 0;                // 0 if no part of the face with an area is in the range

  [[nodiscard]] std::size_t next(std::size_t side) const { return side + 1 == size ? 0 : side + 1; }
  [[nodiscard]] std::size_t previous(std::size_t side) const {
    return side == 0 ? size - 1 : side - 1;
  }
  // Returns the edge of the face on which the side from corner `side` to the next lies, or 3 if the
  // side runs across the face.
  [[nodiscard]] std::size_t edge_of(std::size_t side) const;
};

// The surface on which contours are drawn: all faces that count and whose three corners have values. A
// face that is not on it is missing.
class ValuedFaces {
 public:
  ValuedFaces(const ContourSurface& surface, std::span<const double> values)
      : faces_(surface.faces),
        neighbors_(surface.neighbors),
        values_(values),
        is_missing_(surface.faces.size(), 0) {
    for (const Index face : surface.left_out) is_missing_[face] = 1;
  }

  // Finds which of the faces begin ... end - 1 are missing. Call it for all faces before anything
  // else.
  void find_missing(std::size_t begin, std::size_t end);
  [[nodiscard]] bool is_missing(Index face) const { return is_missing_[face] != 0; }
  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  [[nodiscard]] const Triple& corners(Index face) const { return faces_[face]; }
  [[nodiscard]] double value(Index site) const { return values_[site]; }

  // Returns the face across an edge (from the face's corner `edge` to the next), or no_index if
  // that is missing.
  [[nodiscard]] Index across(Index face, std::size_t edge) const {
    const Index neighbor = neighbors_[face][(edge + 2) % 3];
    return neighbor == no_index || is_missing(neighbor) ? no_index : neighbor;
  }
  // True if there is nothing across an edge.
  [[nodiscard]] bool is_at_border(Index face) const {
    const auto& [a, b, c] = neighbors_[face];
    return a == no_index || b == no_index || c == no_index;
  }
  // Returns the number that the same edge has in the face across it.
  [[nodiscard]] std::size_t twin(Index face, std::size_t edge, Index across) const;

  // Returns the part of a face in the range. Precondition: the face is not missing.
  [[nodiscard]] ContourPiece piece(Index face, const ValueRange& range) const;
  // True if that part has an area.
  [[nodiscard]] bool has_piece(Index face, const ValueRange& range) const;

 private:
  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  std::span<const double> values_;
  std::vector<std::uint8_t> is_missing_;
};

}  // namespace rondel::interpolation
