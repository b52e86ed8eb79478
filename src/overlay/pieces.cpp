// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/pieces.h"

#include <algorithm>
#include <span>

#include "overlay/arcs.h"
#include "overlay/crossings.h"
#include "overlay/gathered_rows.h"
#include "overlay/measure.h"

namespace rondel::overlay {
namespace {

struct MeasuredPiece {
  Index beyond;
  double area = 0;
  double length = 0;  // of its boundary, roughly
  Point moment{};
};

class PieceMaker {
 public:
  PieceMaker(const Subdivision& cells, const Subdivision& cover, Index first_cell, Index end_cell,
             bool has_moments)
      : cover_(cover), arcs_(cells, cover, first_cell, end_cell), has_moments_(has_moments) {}
  // Of a cell that has a ring, in the order of the columns.
  std::span<const MeasuredPiece> operator()(Index cell) {
    constexpr std::size_t many = 128;
    pieces_.clear();
    const std::span<const PieceArc> arcs = arcs_(cell);
    if (arcs.size() > many || !add_all(arcs)) {
      pieces_.clear();
      add_by_piece(arcs);
    }
    drop_rounding(pieces_);
    std::ranges::sort(pieces_, {}, [&](const MeasuredPiece& piece) { return column(piece); });
    return pieces_;
  }
  [[nodiscard]] Index column(const MeasuredPiece& piece) const {
    return cover_.names[piece.beyond];
  }

 private:
  // Triangles of each arc and the first corner, which count for both sides of an edge. Corners are rounded by
  // more than a triangle is, if it is not large: whether none is.
  bool add_all(std::span<const PieceArc> arcs) {
    const Point& origin = arcs.front().from;
    std::size_t last = 0;
    for (const PieceArc& arc : arcs) {
      const Triangle triangle(origin, arc.from, arc.to);
      if (triangle.is_large()) return false;
      MeasuredPiece share{no_index, triangle.area(), rough_length(arc.from, arc.to)};
      if (has_moments_) share.moment = moment_of_arc(arc.from, arc.to);
      if (pieces_.empty() || pieces_[last].beyond != arc.left) last = find(arc.left);
      MeasuredPiece& left = pieces_[last];
      left.area += share.area;
      left.length += share.length;
      left.moment = left.moment + share.moment;
      if (arc.right == no_index) continue;
      MeasuredPiece& right = pieces_[find(arc.right)];
      right.area -= share.area;
      right.length += share.length;
      right.moment = right.moment - share.moment;
    }
    return true;
  }
  std::size_t find(Index beyond) {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (pieces_[k].beyond == beyond) return k;
    }
    pieces_.push_back({beyond});
    return pieces_.size() - 1;
  }

  // The same for each piece by itself.
  void add_by_piece(std::span<const PieceArc> arcs) {
    sides_.clear();
    for (const PieceArc& arc : arcs) {
      sides_.push_back({arc.left, {arc.from, arc.to}});
      if (arc.right != no_index) sides_.push_back({arc.right, {arc.to, arc.from}});
    }
    std::ranges::stable_sort(sides_, {}, &Side::beyond);
    for (std::size_t k = 0; k < sides_.size();) {
      border_.clear();
      const Index beyond = sides_[k].beyond;
      for (; k < sides_.size() && sides_[k].beyond == beyond; ++k) {
        border_.push_back(sides_[k].arc);
      }
      const auto [area, length, moment] = measures_of(border_);
      pieces_.push_back({beyond, area, length, moment});
    }
  }
  struct Side {
    Index beyond;
    BorderArc arc;
  };

  const Subdivision& cover_;
  ArcMaker arcs_;
  bool has_moments_;
  std::vector<Side> sides_;
  std::vector<BorderArc> border_;
  std::vector<MeasuredPiece> pieces_;
};

}  // namespace

PieceRows pieces(const Subdivision& cells, const Subdivision& cover, bool has_moments,
                 const Execution& execution) {
  return gathered_rows(cells, has_moments, execution, [&](Index first, Index end) {
    return PieceMaker(cells, cover, first, end, has_moments);
  });
}

PieceRows transposed(const PieceRows& pieces, std::size_t num_columns) {
  PieceRows result;
  result.offsets.assign(num_columns + 1, 0);
  for (const Index column : pieces.columns) ++result.offsets[column + std::size_t{1}];
  for (std::size_t i = 0; i < num_columns; ++i) result.offsets[i + 1] += result.offsets[i];
  result.columns.resize(pieces.columns.size());
  result.areas.resize(pieces.areas.size());
  result.moments.resize(pieces.moments.size());
  std::vector<std::uint64_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (std::size_t row = 0; row + 1 < pieces.offsets.size(); ++row) {
    for (std::uint64_t k = pieces.offsets[row]; k < pieces.offsets[row + 1]; ++k) {
      const std::uint64_t to = next[pieces.columns[k]]++;
      result.columns[to] = static_cast<Index>(row);
      result.areas[to] = pieces.areas[k];
      if (!pieces.moments.empty()) result.moments[to] = pieces.moments[k];
    }
  }
  return result;
}

}  // namespace rondel::overlay
