// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/pieces.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "exact/eft.h"
#include "overlay/cover_triangulation.h"
#include "overlay/crossings.h"
#include "overlay/gathered_rows.h"
#include "overlay/measure.h"
#include "overlay/piece_boundaries.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

// A piece of one cell.
struct MeasuredPiece {
  Index beyond;
  double area = 0;
  double length = 0;  // approximate length of its border, radians
  Point moment{};
};

// Computes the pieces of one cell after another.
class PieceMaker {
 public:
  // `owners` has for each cell of the cover the other cell that it is a part of; it is empty if the
  // cover's cells are the other cells themselves. `beyond` of a piece is that owner, or the cell of
  // the cover, and names[beyond] is the piece's column. Pieces without an owner are measured as
  // well: a cell may have nothing else that is wider than rounding.
  PieceMaker(const Subdivision& cells, const CellSizes& sizes, const Subdivision& cover,
             std::span<const Index> names, std::span<const Index> owners, Index first_cell,
             Index end_cell, bool has_moments)
      : cells_(cells),
        sizes_(sizes),
        names_(names),
        owners_(owners),
        arcs_(cells, cover, first_cell, end_cell),
        has_moments_(has_moments) {}
  // Returns the pieces of a cell that has a ring, in the order of the columns.
  std::span<const MeasuredPiece> operator()(Index cell) {
    constexpr std::size_t many = 128;
    const Index name = cells_.names[cell];
    system::prefetch(&sizes_.areas[name]);
    system::prefetch(&sizes_.lengths[name]);
    pieces_.clear();
    const std::span<const BoundaryArc> arcs = arcs_(cell);
    const std::span<const BoundaryArc> owned = owners_.empty() ? arcs : arcs_of_owners(arcs);
    if (owned.size() > many || !add_all(owned, cells_.centers[cell])) {
      pieces_.clear();
      add_by_piece(arcs);
      if (!owners_.empty()) join_by_owner();
    }
    require_sum(pieces_, sizes_.areas[name], sizes_.lengths[name], name);
    drop_rounding(pieces_, sizes_.areas[name], sizes_.lengths[name]);
    if (!owners_.empty()) {
      std::erase_if(pieces_, [&](const MeasuredPiece& piece) { return !has_column(piece); });
    }
    std::ranges::sort(pieces_, {}, [&](const MeasuredPiece& piece) { return column(piece); });
    return pieces_;
  }
  [[nodiscard]] Index column(const MeasuredPiece& piece) const { return names_[piece.beyond]; }
  static Index place(const MeasuredPiece& piece) { return piece.beyond; }

 private:
  // True if the piece belongs to one of the other cells.
  [[nodiscard]] bool has_column(const MeasuredPiece& piece) const {
    return piece.beyond < names_.size();
  }

  // Returns the arcs with owners instead of cells of the cover, without those that have the same
  // owner on both sides.
  std::span<const BoundaryArc> arcs_of_owners(std::span<const BoundaryArc> arcs) {
    owned_.clear();
    for (BoundaryArc arc : arcs) {
      arc.left = owners_[arc.left];
      if (arc.right != no_index) arc.right = owners_[arc.right];
      if (arc.left != arc.right) owned_.push_back(arc);
    }
    return owned_;
  }

  // Adds the triangle of each arc and the cell's center to the pieces on both sides of the arc, and
  // returns false if a triangle is large. The rounding of a triangle that is not large is less than
  // that of the corners.
  bool add_all(std::span<const BoundaryArc> arcs, const Point& center) {
    const LocalAxes axes(center);
    const auto points = arcs_.points();
    places_.clear();
    for (const Point& p : points) places_.push_back(axes.place_of(p));
    bool is_any_large = false;
    for (const BoundaryArc& arc : arcs) {
      const Triangle triangle(places_[arc.from], places_[arc.to]);
      is_any_large |= triangle.is_large();
      const double area = triangle.area();
      MeasuredPiece& left = piece_of(arc.left);
      left.area += area;
      left.length += triangle.rough_length();
      Point moment{};
      if (has_moments_) {
        moment = moment_of_arc(points[arc.from], points[arc.to]);
        left.moment = left.moment + moment;
      }
      if (arc.right == no_index) continue;
      MeasuredPiece& right = piece_of(arc.right);
      right.area -= area;
      right.length += triangle.rough_length();
      if (has_moments_) right.moment = right.moment - moment;
    }
    return !is_any_large;
  }
  // Returns the piece of a cell of the cover. The place of a piece in pieces_ is remembered by the
  // last digits of the cell, in which neighbors seldom agree.
  MeasuredPiece& piece_of(Index beyond) {
    Index& known = known_[beyond % known_.size()];
    if (known < pieces_.size() && pieces_[known].beyond == beyond) return pieces_[known];
    const auto there = std::ranges::find(pieces_, beyond, &MeasuredPiece::beyond);
    known = static_cast<Index>(there - pieces_.begin());
    if (there == pieces_.end()) pieces_.push_back({beyond});
    return pieces_[known];
  }

  // Measures each piece by itself.
  void add_by_piece(std::span<const BoundaryArc> arcs) {
    sides_.clear();
    for (const BoundaryArc& arc : arcs) {
      const Point& from = arcs_.points()[arc.from];
      const Point& to = arcs_.points()[arc.to];
      sides_.push_back({arc.left, {from, to}});
      if (arc.right != no_index) sides_.push_back({arc.right, {to, from}});
    }
    std::ranges::stable_sort(sides_, {}, &SideOfPiece::beyond);
    for (std::size_t k = 0; k < sides_.size();) {
      border_.clear();
      const Index beyond = sides_[k].beyond;
      for (; k < sides_.size() && sides_[k].beyond == beyond; ++k) {
        border_.push_back(sides_[k].arc);
      }
      const Measures measures = measures_of(border_, border_.front().from);
      pieces_.push_back({beyond, measures.area, measures.length, measures.moment});
    }
  }
  // Joins the pieces of each owner. They are measured before, since an owner may be too large to be
  // measured at once, while no cell of the cover is.
  void join_by_owner() {
    for (MeasuredPiece& piece : pieces_) piece.beyond = owners_[piece.beyond];
    std::ranges::stable_sort(pieces_, {}, &MeasuredPiece::beyond);
    std::size_t size = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const MeasuredPiece piece = pieces_[k];
      if (size == 0 || pieces_[size - 1].beyond != piece.beyond) {
        pieces_[size++] = piece;
        continue;
      }
      MeasuredPiece& whole = pieces_[size - 1];
      whole.area += piece.area;
      whole.length += piece.length;
      whole.moment = whole.moment + piece.moment;
    }
    pieces_.resize(size);
  }
  // An arc of the border of the piece in `beyond`.
  struct SideOfPiece {
    Index beyond;
    BorderArc arc;
  };

  const Subdivision& cells_;
  CellSizes sizes_;
  std::span<const Index> names_;
  std::span<const Index> owners_;
  PieceBoundaries arcs_;
  std::vector<BoundaryArc> owned_;
  bool has_moments_;
  std::array<Index, 64> known_{};
  std::vector<LocalPoint> places_;
  std::vector<SideOfPiece> sides_;
  std::vector<BorderArc> border_;
  std::vector<MeasuredPiece> pieces_;
};

}  // namespace

PieceRows pieces(const Subdivision& cells, const CellSizes& sizes, const Subdivision& cover,
                 bool has_moments, const Execution& execution) {
  return gathered_rows(cells, cover.names, has_moments, execution, [&](Index first, Index end) {
    return PieceMaker(cells, sizes, cover, cover.names, {}, first, end, has_moments);
  });
}

PieceRows pieces_of_parts(const Subdivision& cells, const CellSizes& sizes,
                          const Subdivision& others, bool has_moments, const Execution& execution) {
  const CoverTriangulation completed = triangulate_cover(others, execution);
  return gathered_rows(cells, others.names, has_moments, execution, [&](Index first, Index end) {
    return PieceMaker(cells, sizes, completed.cover, others.names, completed.owners, first, end,
                      has_moments);
  });
}

void find_row_sums(PieceRows& pieces) {
  pieces.row_sums.assign(pieces.offsets.size() - 1, 0);
  for (std::size_t row = 0; row < pieces.row_sums.size(); ++row) {
    exact::DoubleDouble sum{};
    for (std::uint64_t k = pieces.offsets[row]; k < pieces.offsets[row + 1]; ++k) {
      add_term(pieces.areas[k], sum);
    }
    pieces.row_sums[row] = sum.hi + sum.lo;
  }
}

void find_sums(PieceRows& pieces, std::size_t num_columns) {
  find_row_sums(pieces);
  std::vector<exact::DoubleDouble> sums(num_columns);
  for (std::size_t k = 0; k < pieces.columns.size(); ++k) {
    add_term(pieces.areas[k], sums[pieces.columns[k]]);
  }
  pieces.column_sums.clear();
  for (const exact::DoubleDouble& sum : sums) pieces.column_sums.push_back(sum.hi + sum.lo);
}

PieceRows transposed(const PieceRows& pieces, std::size_t num_columns) {
  PieceRows result;
  result.row_sums = pieces.column_sums;
  result.column_sums = pieces.row_sums;
  system::RowPlaces places(num_columns);
  for (const Index column : pieces.columns) places.count(column);
  result.columns.resize(places.sum());
  result.areas.resize(pieces.areas.size());
  result.moments.resize(pieces.moments.size());
  for (std::size_t row = 0; row + 1 < pieces.offsets.size(); ++row) {
    for (std::uint64_t k = pieces.offsets[row]; k < pieces.offsets[row + 1]; ++k) {
      const std::uint64_t to = places.place(pieces.columns[k]);
      result.columns[to] = static_cast<Index>(row);
      result.areas[to] = pieces.areas[k];
      if (!pieces.moments.empty()) result.moments[to] = pieces.moments[k];
    }
  }
  result.offsets = std::move(places).offsets();
  return result;
}

}  // namespace rondel::overlay
