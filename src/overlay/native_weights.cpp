// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Interpolates inside the cells of a mesh: native_weights().
//
// in    cells as rings of corners, targets
// out   rows of weights
// index cells and corners as given; corner k of a cell is the one where side k begins
//
// A tree of boxes finds the cells near a target; exact signs choose the cell, side or corner.
// Weights are computed from differences d_i = x_i - u, which are nearly exact, so that their error
// is one of rounding in relation to the size of the cell.
#include "rondel/native_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "api/validation.h"
#include "arrangement/box_tree.h"
#include "arrangement/ring_arrays.h"
#include "exact/vector.h"
#include "order/along_the_curve.h"
#include "overlay/barycentric.h"
#include "predicates/orientation.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

constexpr std::size_t targets_per_piece = 1024;
constexpr std::size_t no_part = ~std::size_t{0};

// How far a target may be from a cell, in radians, and count as on its border. The unit vectors of
// three places of one arc, each rounded by at most 2^-52, are not farther from each other's arc.
constexpr double rounding_of_places = 0x1p-50;

// A target: the ray as given, for exact signs, and its unit vector.
struct TargetRay {
  Point given;
  Point unit;
};

// Returns the side of the arc from a to b on which a target is, exactly.
Sign side_of_arc(const Point& a, const Point& b, const TargetRay& target) {
  const Sign sign = predicates::sure_orientation({a.x, a.y, a.z}, {b.x, b.y, b.z},
                                                 {target.unit.x, target.unit.y, target.unit.z});
  return sign != Sign::zero ? sign : orientation(a, b, target.given);
}

bool is_before(const Point& a, const Point& b) {
  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

// Where a target is in a cell: at a corner, on a side, or inside of all.
struct Seat {
  bool is_in = false;
  std::size_t side = no_part;
  std::size_t corner = no_part;
};

// The cells in a form for queries: each ring begins at the corner that comes first by coordinates,
// so that sums along it do not depend on where the ring began.
class CellFinder {
 public:
  CellFinder(const CellRings& cells, unsigned threads) : points_(cells.points) {
    arrangement::validate_rings(cells);
    for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) take(cells, cell);
    make_tree(threads);
  }

  // Appends the entries of a target: columns with weights whose sum is 1, or none.
  void find(const TargetRay& target, std::vector<CornerWeight>& row) const {
    row.clear();
    const Seat none;
    Seat seat = none;
    std::size_t found = no_part;
    const Point& u = target.unit;
    tree_->visit({{u.x, u.y, u.z}, {u.x, u.y, u.z}}, [&](Index in_tree) {
      const std::size_t cell = order_[in_tree];
      if (cell >= found) return;
      const Seat here = seat_in(cell, target);
      if (!here.is_in) return;
      found = cell;
      seat = here;
    });
    if (found != no_part) {
      weigh(found, seat, u, row);
    } else {
      weigh_beside(u, row);
    }
  }

 private:
  // A side that a target is beside, or a corner, which is both of its ends.
  struct BorderPart {
    Index from;
    Index to;
    [[nodiscard]] bool is_corner() const { return from == to; }
  };

  [[nodiscard]] std::size_t size(std::size_t cell) const { return rings_[cell].size(); }
  [[nodiscard]] Index corner(std::size_t cell, std::size_t k) const { return rings_[cell][k]; }
  [[nodiscard]] const Point& point(std::size_t cell, std::size_t k) const {
    return points_[corner(cell, k)];
  }
  [[nodiscard]] std::size_t next(std::size_t cell, std::size_t k) const {
    return k + 1 < size(cell) ? k + 1 : 0;
  }

  // Takes the ring of a cell without corners that repeat the one before them.
  void take(const CellRings& cells, std::size_t cell) {
    const std::uint64_t num_rings = cells.cells[cell + 1] - cells.cells[cell];
    const std::string text = "cell " + std::to_string(cell);
    if (num_rings > 1) throw InvalidInput(text + " has several rings", cell);
    std::vector<Index> ring;
    if (num_rings == 1) {
      for (const Index i : cells.corners_of(cells.cells[cell])) {
        if (ring.empty() || points_[ring.back()] != points_[i]) ring.push_back(i);
      }
      while (ring.size() > 1 && points_[ring.back()] == points_[ring.front()]) ring.pop_back();
    }
    if (ring.size() < 3) ring.clear();
    turn_left(points_, ring);
    const auto first = std::ranges::min_element(
        ring, [&](Index a, Index b) { return is_before(points_[a], points_[b]); });
    std::rotate(ring.begin(), first, ring.end());
    rings_.append(ring);
    Point sum{0, 0, 0};
    for (const Index i : ring) sum = sum + points_[i];
    const Point middle = normalized(sum);
    for (const Index i : ring) {
      // So no place of the cell is opposite to another one.
      if (!(dot(middle, points_[i]) > 0)) {
        throw InvalidInput(text + " is as wide as a hemisphere", cell);
      }
    }
    middles_.push_back(middle);
    convex_.push_back(!ring.empty() && is_convex(cell) ? 1 : 0);
  }

  // True if each corner turns to the left by more than the least turn, once around in all.
  [[nodiscard]] bool is_convex(std::size_t cell) const {
    for (std::size_t k = 0; k < size(cell); ++k) {
      const std::size_t k1 = next(cell, k);
      if (!is_sharp(point(cell, k), point(cell, k1), point(cell, next(cell, k1)))) return false;
    }
    return winding(cell, {middles_[cell], middles_[cell]}) == 1;
  }

  void make_tree(unsigned threads) {
    for (std::size_t cell = 0; cell < middles_.size(); ++cell) {
      if (size(cell) > 0) order_.push_back(static_cast<Index>(cell));
    }
    order_ = order::along_the_curve(std::move(order_), Model::projected, {}, threads, [&](Index i) {
               return middles_[i];
             }).indices;
    tree_.emplace(
        order_.size(), [&](std::size_t k) { return box_of_cell(order_[k]); }, threads);
  }

  // A cell lies in the cap around its middle that has its corners, for the cap is convex.
  [[nodiscard]] arrangement::SpaceBox box_of_cell(std::size_t cell) const {
    const Point& m = middles_[cell];
    double square = 0;
    for (std::size_t k = 0; k < size(cell); ++k) {
      const Point away = point(cell, k) - m;
      square = std::max(square, dot(away, away));
    }
    constexpr double rounding = 1e-14;  // of the middle, the radius and the target
    const double radius = std::sqrt(square) * (1 + rounding) + rounding;
    return {{m.x - radius, m.y - radius, m.z - radius}, {m.x + radius, m.y + radius, m.z + radius}};
  }

  // Returns where the target is; a cell has its border.
  [[nodiscard]] Seat seat_in(std::size_t cell, const TargetRay& target) const {
    return convex_[cell] != 0 ? seat_in_convex(cell, target) : seat_in_any(cell, target);
  }

  [[nodiscard]] Seat seat_in_convex(std::size_t cell, const TargetRay& target) const {
    Seat seat;
    for (std::size_t k = 0; k < size(cell); ++k) {
      const Sign sign = side_of_arc(point(cell, k), point(cell, next(cell, k)), target);
      if (sign == Sign::negative) return {};
      if (sign != Sign::zero) continue;
      // A target on the lines of two sides is at the corner between them.
      if (seat.side != no_part) seat.corner = next(cell, seat.side) == k ? k : seat.side;
      seat.side = k;
    }
    seat.is_in = true;
    return seat;
  }

  [[nodiscard]] Seat seat_in_any(std::size_t cell, const TargetRay& target) const {
    for (std::size_t k = 0; k < size(cell); ++k) {
      const std::size_t end = next(cell, k);
      const Point& a = point(cell, k);
      const Point& b = point(cell, end);
      if (side_of_arc(a, b, target) != Sign::zero) continue;
      // For u on the circle of a and b, the sign of det(n, a, u) is that of the angle from a to u
      // for any n on the left of the circle.
      const Point left = normalized(cross(a, b - a));
      const Sign behind = orientation(left, a, target.given);
      const Sign before = orientation(left, target.given, b);
      if (behind == Sign::negative || before == Sign::negative) continue;
      if (behind == Sign::zero) return {true, k, k};
      return {true, k, before == Sign::zero ? end : no_part};
    }
    return {winding(cell, target) != 0, no_part, no_part};
  }

  // Returns how often the ring of a cell goes around a target that is not on it: its sides that
  // cross a half plane from the axis through the target, from the right to the left or back.
  [[nodiscard]] int winding(std::size_t cell, const TargetRay& target) const {
    const Point size_of = {std::abs(target.unit.x), std::abs(target.unit.y),
                           std::abs(target.unit.z)};
    Point across{0, 0, 1};  // the axis that is farthest from the target
    if (size_of.x <= size_of.y && size_of.x <= size_of.z) {
      across = {1, 0, 0};
    } else if (size_of.y <= size_of.z) {
      across = {0, 1, 0};
    }
    const auto is_left = [&](const Point& p) {
      return side_of_arc(across, p, target) != Sign::negative;
    };
    int turns = 0;
    const Point* before = &point(cell, size(cell) - 1);
    bool was_left = is_left(*before);
    for (std::size_t k = 0; k < size(cell); ++k) {
      const Point* const here = &point(cell, k);
      const bool is_now_left = is_left(*here);
      if (was_left != is_now_left) {
        const Sign sign = side_of_arc(*before, *here, target);
        if (is_now_left && sign == Sign::positive) ++turns;
        if (!is_now_left && sign == Sign::negative) --turns;
      }
      before = here;
      was_left = is_now_left;
    }
    return turns;
  }

  void weigh(std::size_t cell, const Seat& seat, const Point& u,
             std::vector<CornerWeight>& row) const {
    if (seat.corner != no_part) {
      row.push_back({corner(cell, seat.corner), 1});
      return;
    }
    if (seat.side != no_part) {
      const std::size_t ends[] = {seat.side, next(cell, seat.side)};
      for (const std::size_t k : ends) row.push_back({corner(cell, k), 0});
    } else {
      for (std::size_t k = 0; k < size(cell); ++k) row.push_back({corner(cell, k), 0});
    }
    const bool has_weights = seat.side != no_part ? weigh_side(points_, u, row)
                             : convex_[cell] != 0 ? weigh_convex(points_, u, row)
                                                  : weigh_any(points_, u, row);
    if (!has_weights) row.clear();
    std::erase_if(row, [](const CornerWeight& entry) { return entry.weight == 0; });
    std::ranges::sort(row, [&](const CornerWeight& a, const CornerWeight& b) {
      return is_before(points_[a.corner], points_[b.corner]);
    });
  }

  // Appends the entries of a target in no cell that rounding may have put there: those of the side or
  // the corner that it is at. Corners come before sides, then what comes first by coordinates.
  void weigh_beside(const Point& u, std::vector<CornerWeight>& row) const {
    constexpr double r = rounding_of_places;
    std::optional<BorderPart> best;
    tree_->visit({{u.x - r, u.y - r, u.z - r}, {u.x + r, u.y + r, u.z + r}}, [&](Index in_tree) {
      const std::size_t cell = order_[in_tree];
      for (std::size_t k = 0; k < size(cell); ++k) {
        const std::optional<BorderPart> part =
            part_beside(corner(cell, k), corner(cell, next(cell, k)), u);
        if (part && (!best || is_preferred(*part, *best))) best = part;
      }
    });
    if (!best) return;
    row.push_back({best->from, 1});
    if (best->is_corner()) return;
    row.push_back({best->to, 0});
    if (!weigh_side(points_, u, row)) row.clear();
    std::erase_if(row, [](const CornerWeight& entry) { return entry.weight == 0; });
  }

  // Returns the part of a side that a target is beside, its ends in the order of their coordinates;
  // nothing if it is farther away.
  [[nodiscard]] std::optional<BorderPart> part_beside(Index from, Index to, const Point& u) const {
    constexpr double square = rounding_of_places * rounding_of_places;
    if (is_before(points_[to], points_[from])) std::swap(from, to);
    for (const Index end : {from, to}) {
      const Point away = u - points_[end];
      if (dot(away, away) <= square) return BorderPart{end, end};
    }
    const Point along = points_[to] - points_[from];
    const Point away = u - points_[from];
    const double place = dot(away, along);
    if (place < 0 || place > dot(along, along)) return std::nullopt;
    const Point normal = cross(points_[from], along);
    const double height = dot(normal, away);
    if (height * height > square * dot(normal, normal)) return std::nullopt;
    return BorderPart{from, to};
  }

  [[nodiscard]] bool is_preferred(const BorderPart& a, const BorderPart& b) const {
    if (a.is_corner() != b.is_corner()) return a.is_corner();
    const Point& of_a = points_[a.from];
    const Point& of_b = points_[b.from];
    return of_a == of_b ? is_before(points_[a.to], points_[b.to]) : is_before(of_a, of_b);
  }

  const std::vector<Point>& points_;
  CompressedRows<Index> rings_;  // by cell
  std::vector<Point> middles_;   // by cell; no direction without corners
  std::vector<std::uint8_t> convex_;
  std::vector<Index> order_;  // cells with corners, as the tree has them
  std::optional<arrangement::BoxTree> tree_;
};

// The rows of consecutive targets.
struct FoundRows {
  std::vector<std::uint64_t> sizes;
  std::vector<Index> columns;
  std::vector<double> values;
};

}  // namespace

Weights native_weights(const CellRings& cells, std::span<const Point> targets,
                       const Execution& execution) {
  const system::Call call(execution);
  api::validate_queries(targets, {}, true, "target");
  const CellFinder finder(cells, execution.threads);
  std::vector<FoundRows> blocks(system::num_pieces(targets.size(), targets_per_piece));
  system::parallel_for(execution.threads, targets.size(), targets_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         FoundRows& block = blocks[begin / targets_per_piece];
                         std::vector<CornerWeight> row;
                         for (std::size_t t = begin; t < end; ++t) {
                           finder.find({targets[t], normalized(targets[t])}, row);
                           for (const auto& [corner, weight] : row) {
                             block.columns.push_back(corner);
                             block.values.push_back(weight);
                           }
                           block.sizes.push_back(row.size());
                         }
                       });
  Weights weights;
  weights.num_columns = cells.points.size();
  weights.offsets = system::join_rows(
      execution.threads, targets.size(), std::move(blocks),
      [](std::size_t b, const FoundRows& /*block*/, std::size_t k) {
        return b * targets_per_piece + k;
      },
      system::JoinedColumn{&FoundRows::columns, weights.columns},
      system::JoinedColumn{&FoundRows::values, weights.values});
  weights.sites_hash = point_set_hash(cells.points);
  weights.targets_hash = point_set_hash(targets);
  return weights;
}

}  // namespace rondel
