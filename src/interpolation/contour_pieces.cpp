// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "interpolation/contour_pieces.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "topology/mesh.h"

namespace rondel::interpolation {
namespace {

// The least and the largest value at the corners of a face.
struct ValueExtent {
  double least, most;
};

ValueExtent extent_of(double a, double b, double c) {
  return {std::min(std::min(a, b), c), std::max(std::max(a, b), c)};
}

// True if a face with these values has a part with an area in the range.
bool has_area(const ValueExtent& extent, const ValueRange& range) {
  if (extent.least == extent.most) return range.low <= extent.least && extent.least < range.high;
  return extent.most > range.low && extent.least < range.high;
}

void add_corner(ContourPiece& piece, const PieceCorner& corner) {
  piece.corners[piece.size++] = corner;
}

// True if an edge with the values a and b at its ends crosses the level inside.
bool is_strictly_between(double level, double a, double b) {
  return (a < level && level < b) || (b < level && level < a);
}

}  // namespace

std::size_t ContourPiece::edge_of(std::size_t side) const {
  const unsigned common = corners[side].edges & corners[next(side)].edges;
  return common == 0 ? 3 : static_cast<std::size_t>(std::countr_zero(common));
}

void ValuedFaces::find_missing(std::size_t begin, std::size_t end) {
  for (std::size_t f = begin; f < end; ++f) {
    const auto& [a, b, c] = faces_[f];
    if (std::isnan(values_[a]) || std::isnan(values_[b]) || std::isnan(values_[c]))
      is_missing_[f] = 1;
  }
}

std::size_t ValuedFaces::twin(Index face, std::size_t edge, Index across) const {
  const Index end = faces_[face][(edge + 1) % 3];
  return topology::corner_of(faces_[across], end);
}

bool ValuedFaces::has_piece(Index face, const ValueRange& range) const {
  const auto& [a, b, c] = faces_[face];
  return has_area(extent_of(values_[a], values_[b], values_[c]), range);
}

ContourPiece ValuedFaces::piece(Index face, const ValueRange& range) const {
  ContourPiece piece;
  if (!has_piece(face, range)) return piece;
  const Triple& corners = faces_[face];
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Index from = corners[edge];
    const Index to = corners[(edge + 1) % 3];
    const double begin = values_[from];
    const double end = values_[to];
    const unsigned here = 1U << edge;
    if (range.low <= begin && begin <= range.high) {
      add_corner(piece, {from, no_index, begin, here | 1U << ((edge + 2) % 3)});
    }
    // Along the edge come its first end, and then the crossings, in the order of the values.
    const bool rises = begin < end;
    const auto cross = [&](double level) {
      if (!is_strictly_between(level, begin, end)) return;
      add_corner(piece, {rises ? from : to, rises ? to : from, level, here});
    };
    cross(rises ? range.low : range.high);
    cross(rises ? range.high : range.low);
  }
  return piece;
}

}  // namespace rondel::interpolation
