// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/grid_pieces.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "exact/eft.h"
#include "overlay/gathered_rows.h"
#include "overlay/grid_walk.h"
#include "overlay/measure.h"
#include "overlay/straight_sides.h"
#include "overlay/straight_walk.h"
#include "predicates/bounds.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

bool has_straight_sides(const CellSetData& cells, Index name) {
  return cells.straight_sides() != nullptr && !cells.straight_sides()->rows()[name].empty();
}

// The piece of a cell in a cell of the grid.
struct GridPiece {
  Index cell;
  double area;
  double length;  // approximate length of its border, radians
  Point moment;
};

// The part of a parallel, within one column, that is inside of the cell, as the strips north of the
// parallel tell.
struct Fill {
  double width = 0;           // radians
  double size = 0;            // the sum of the sizes of all widths that were added
  Point run{};                // the difference of its ends' meridians on the equator
  exact::DoubleDouble sum{};  // the width, before it is rounded
};

// The strips in one row of one column.
class RowStrips {
 public:
  // `rise` is the difference of the sines of the row's parallels.
  void add(const Strip& strip, double rise) {
    add_term(strip.area, area_);
    const double from_floor = std::abs(strip.area) / (std::abs(strip.width) * rise);
    const double share = strip.pole > 0 ? 1 - from_floor : from_floor;
    lowest_ = std::min(lowest_, share);
    highest_ = std::max(highest_, share);
    if (strip.pole == 0) {
      has_others_ = true;
    } else if (strip.pole > 0) {
      northern_ += strip.width;
      has_northern_ = true;
    } else {
      southern_ += strip.width;
      has_southern_ = true;
    }
  }
  // Returns approximately the share of the row's height between the lowest and the highest strip.
  // The parallels below and above count as strips if the cell reaches them.
  [[nodiscard]] double extent(bool is_below, bool is_above) const {
    const double lowest = is_below ? 0 : lowest_;
    const double highest = is_above ? 1 : highest_;
    return std::clamp(highest - lowest, 0.0, 1.0);
  }
  // Returns the area of the cell in this row: the strips, and the part of the row below its
  // northern parallel, which is `above` wide there. `below` is the width that is left at the
  // southern parallel; it is known more accurately than the sum of all widths where that is near 0.
  [[nodiscard]] double area(const PreparedGrid& grid, Index row, double above, double below) const {
    const double area = area_.hi + area_.lo;
    if (!has_northern_ && !has_southern_) return area + above * grid.height(row);
    const SphereHeight south = grid.parallel(row).height();
    const SphereHeight north = grid.parallel(row + 1).height();
    if (has_northern_ != has_southern_ && !has_others_) {
      const SphereHeight pole = {has_northern_ ? 1.0 : -1.0, 0};
      return area + (below * rise(south, pole) - above * rise(north, pole));
    }
    return area + above * grid.height(row) + northern_ * rise(south, {1, 0}) +
           southern_ * rise(south, {-1, 0});
  }

 private:
  exact::DoubleDouble area_{};
  double lowest_ = 1;  // share of the row's height, above its southern parallel
  double highest_ = 0;
  double northern_ = 0;  // the sum of the widths of strips whose areas begin at the north pole
  // The sum for strips that begin at the south pole.
  double southern_ = 0;
  bool has_northern_ = false;
  bool has_southern_ = false;
  bool has_others_ = false;
};

// Computes the pieces of one cell after another.
class GridPieceMaker {
 public:
  GridPieceMaker(const CellSetData& cells, const PreparedGrid& grid,
                 std::span<const PlaceInGrid> places, bool has_moments)
      : cells_(cells),
        grid_(grid),
        places_(places),
        walk_(grid, has_moments),
        straight_walk_(grid, has_moments),
        has_moments_(has_moments) {}

  // GCC takes this and what it calls for code that seldom runs, and makes it small and slow, where it
  // is a part of its one caller.
  [[gnu::noinline]] std::span<const GridPiece> operator()(Index cell) {
    const Index name = cells_.subdivision().names[cell];
    const bool is_straight = has_straight_sides(cells_, name);
    find_strips(cell, is_straight);
    pieces_.clear();
    const double area = cells_.areas(Borders::straight)[name];
    const double length = cells_.lengths(Borders::straight)[name];
    if (strips_.empty()) return pieces_;
    // The sides of a cell in the plane go along the pole.
    const bool has_pole = !is_straight && has_north_pole(area);
    if (is_within_one() && !has_pole) {
      const Index there = grid_.cell(strips_.front().column, strips_.front().row);
      if (there != no_index && area > 0) {
        const bool has_own = is_straight && has_moments_;
        pieces_.push_back(
            {there, area, 0,
             has_own ? cells_.straight_sides()->moment(name) : cells_.moments()[name]});
      }
      return pieces_;
    }
    order_strips();
    std::size_t next = 0;
    for (Index column = 0; column < grid_.columns().size(); ++column) {
      if (!has_pole) {
        if (next == strips_.size()) break;
        column = strip_at(next).column;
      }
      next = add_column(column, next, has_pole);
    }
    if (grid_.covers_sphere()) {
      require_sum(pieces_, area, length, name);
    }
    drop_rounding(pieces_, area, length);
    return in_order();
  }
  static Index column(const GridPiece& piece) { return piece.cell; }
  static Index place(const GridPiece& piece) { return piece.cell; }

 private:
  void find_strips(Index cell, bool is_straight) {
    const Subdivision& subdivision = cells_.subdivision();
    strips_.clear();
    if (is_straight) {
      for (const LonLatSide& side : cells_.straight_sides()->rows()[subdivision.names[cell]]) {
        straight_walk_.append(side, strips_);
      }
      return;
    }
    for (Index ring = subdivision.cells[cell]; ring < subdivision.cells[cell + 1]; ++ring) {
      const Index first = subdivision.rings[ring];
      const Index end = subdivision.rings[ring + 1];
      for (Halfedge h = first; h < end; ++h) {
        walk_.append(places_[subdivision.corners[h]],
                     places_[subdivision.corners[h + 1 < end ? h + 1 : first]], strips_);
      }
    }
  }

  // True if the north pole is in the cell. The area south of the arcs then differs from the cell's
  // area by that of the sphere.
  [[nodiscard]] bool has_north_pole(double area) const {
    double south = 0;
    for (const Strip& strip : strips_) {
      const double floor = strip.pole != 0 ? strip.pole : grid_.parallel(strip.row).sine;
      south += strip.area + strip.width * (1 + floor);
    }
    return area - south > 2 * std::numbers::pi;
  }

  // True if all strips are in one cell of the grid, and the cell does not go around the south pole.
  [[nodiscard]] bool is_within_one() const {
    double width = 0;
    for (const Strip& strip : strips_) {
      if (strip.column != strips_.front().column || strip.row != strips_.front().row) return false;
      width += strip.width;
    }
    return std::abs(width) < 1;
  }

  // Orders the strips by column, and in one column from north to south. Strips and pieces stay where
  // they are, since they are much larger than what they are ordered by.
  void order_strips() {
    order_.clear();
    for (const Strip& strip : strips_) {
      const std::uint64_t southward = std::numeric_limits<Index>::max() - strip.row;
      order_.push_back({std::uint64_t{strip.column} << 32U | southward, order_.size()});
    }
    std::ranges::sort(order_);
  }
  // Returns a strip by its number in that order.
  [[nodiscard]] const Strip& strip_at(std::size_t k) const { return strips_[order_[k].number]; }
  // Returns the pieces in the order of their cells.
  std::span<const GridPiece> in_order() {
    order_.clear();
    for (const GridPiece& piece : pieces_) order_.push_back({piece.cell, order_.size()});
    std::ranges::sort(order_);
    ordered_.clear();
    for (const Rank& rank : order_) ordered_.push_back(pieces_[rank.number]);
    return ordered_;
  }

  // Appends the pieces of a column, whose strips begin with strip `next`. Returns the first strip
  // after them.
  [[gnu::noinline]] std::size_t add_column(Index column, std::size_t next, bool has_pole) {
    Fill fill;
    if (has_pole) fill = filled(column);
    std::size_t end = next;
    while (end < strips_.size() && strip_at(end).column == column) ++end;
    Index row = has_pole ? grid_.num_rows() - 1 : strip_at(next).row;
    for (;; --row) {
      const Index southern = next < end ? strip_at(next).row + 1 : 0;  // of the rows without strips
      if (row >= southern) {
        add_rows(column, row, southern, fill);
        if (next == end) return end;
        row = southern - 1;
      }
      GridPiece piece = row_of(column, row, fill);
      Fill below = fill;
      RowStrips strips;
      const double rise = grid_.parallel(row + 1).sine - grid_.parallel(row).sine;
      for (; next < end && strip_at(next).row == row; ++next) {
        const Strip& strip = strip_at(next);
        strips.add(strip, rise);
        piece.length += strip.length;
        piece.moment = piece.moment + strip.moment;
        add_term(strip.width, below.sum);
        add_term(strip.width_rest, below.sum);
        below.size += std::abs(strip.width);
        below.run = below.run + strip.run;
      }
      const double width_above = fill.width;
      const bool is_below = below.sum.hi + below.sum.lo != 0;  // also by rounding alone
      fill = rounded(below, column, next == end);
      piece.area = strips.area(grid_, row, width_above, fill.width);
      piece.length += fill.size * grid_.parallel(row).cosine;
      piece.length += grid_.chord(row) * strips.extent(is_below, width_above != 0);
      if (piece.cell != no_index) pieces_.push_back(piece);
      if (row == 0 || (next == end && fill.width == 0)) return end;
      if (fill.width == 0) row = strip_at(next).row + 1;
    }
  }

  // Appends the pieces of rows without strips, where the cell is as wide as at the parallel above.
  [[gnu::noinline]] void add_rows(Index column, Index northern, Index southern, const Fill& fill) {
    for (Index row = northern + 1; row-- > southern;) {
      GridPiece piece = row_of(column, row, fill);
      if (piece.cell == no_index) continue;
      piece.area = fill.width * grid_.height(row);
      piece.length += fill.size * grid_.parallel(row).cosine;
      piece.length += grid_.chord(row);
      pieces_.push_back(piece);
    }
  }

  // Returns the fill of a parallel that is inside of the cell over the whole width of a column.
  [[nodiscard]] Fill filled(Index column) const {
    const double width = grid_.columns()[column].width;
    return {
        width, width, grid_.eastern_meridian(column) - grid_.columns()[column].west, {width, 0}};
  }

  // Returns the fill with its width rounded to a double, or to nothing or all of the column where
  // it differs from that by rounding. Arcs that follow each other add up to the difference of two
  // offsets in twice the precision, so a cell may be as thin as rounding of longitudes. Behind the
  // last strip of the column only these two widths are possible.
  [[nodiscard]] Fill rounded(Fill fill, Index column, bool is_last) const {
    fill.width = fill.sum.hi + fill.sum.lo;
    constexpr double of_sums = 0x1p-90;
    constexpr double of_turns = 16 * predicates::unit_roundoff;
    const double of_last = is_last ? predicates::unit_roundoff * (16 + 4 * fill.size) : 0;
    if (std::abs(fill.width) <= std::max(of_sums, of_last)) return {};
    const bool is_filled =
        std::abs(fill.width - grid_.columns()[column].width) <= std::max(of_turns, of_last);
    return is_filled ? filled(column) : fill;
  }

  // Returns the part of a row that is inside from parallel to parallel.
  [[nodiscard]] GridPiece row_of(Index column, Index row, const Fill& fill) const {
    const PreparedGrid::Parallel& south = grid_.parallel(row);
    const PreparedGrid::Parallel& north = grid_.parallel(row + 1);
    GridPiece piece{grid_.cell(column, row), 0, 0, {}};
    if (fill.width == 0) return piece;
    piece.length = fill.size * north.cosine;
    if (has_moments_) {
      piece.moment = moment_of_row(south, north, grid_.height(row), fill.width, fill.run);
    }
    return piece;
  }

  // What strips and pieces are ordered by: a key of their own, then their number.
  struct Rank {
    std::uint64_t key;
    std::size_t number;
    auto operator<=>(const Rank&) const = default;
  };

  const CellSetData& cells_;
  const PreparedGrid& grid_;
  std::span<const PlaceInGrid> places_;
  GridWalk walk_;
  StraightWalk straight_walk_;
  bool has_moments_;
  std::vector<Strip> strips_;
  std::vector<Rank> order_;
  std::vector<GridPiece> pieces_;
  std::vector<GridPiece> ordered_;
};

}  // namespace

PieceRows pieces(const CellSetData& cells, const PreparedGrid& grid, bool has_moments,
                 const Execution& execution, bool has_column_sums) {
  const Subdivision& subdivision = cells.subdivision();
  // The corners of arcs have places. Where all sides are straight, there are none.
  const bool has_arcs = !std::ranges::all_of(
      subdivision.names, [&](Index name) { return has_straight_sides(cells, name); });
  LargeVector<PlaceInGrid> places(has_arcs ? subdivision.points.size() : 0);
  const GridWalk walk(grid, has_moments);
  system::parallel_for(execution.threads, places.size(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           places[i] = walk.place_of(subdivision.points[i]);
                         }
                       });
  LargeVector<Index> boxes(has_column_sums ? grid.num_cells() : 0);
  std::iota(boxes.begin(), boxes.end(), Index{0});
  return gathered_rows(subdivision, boxes, has_moments, execution,
                       [&](Index /*first*/, Index /*end*/) {
                         return GridPieceMaker(cells, grid, places, has_moments);
                       });
}

}  // namespace rondel::overlay
