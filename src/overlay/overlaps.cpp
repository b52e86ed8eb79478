// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds overlaps of cells. Each cell is inside of a ball around its center, and pairs of cells
// whose balls meet are tested. Two convex cells do not overlap if a side of one has all corners of
// the other to its right, which is exact. Of any other pair, one cell is triangulated and the
// pieces of the other one in it are measured.
#include "overlay/overlaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "exact/angles.h"
#include "exact/vector.h"
#include "map/arc.h"
#include "overlay/cell_set_data.h"
#include "overlay/cover_triangulation.h"
#include "overlay/measure.h"
#include "overlay/pieces.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "rondel/relate.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t balls_per_piece = 1024;
constexpr double around_everything = 4;  // a radius that contains the whole sphere

// A ball that contains a cell.
struct CellBall {
  Index cell;
  Point center;
  double radius;

  [[nodiscard]] double low() const { return center.x - radius; }
  [[nodiscard]] bool may_meet(const CellBall& other) const {
    const Point step = other.center - center;
    const double reach = radius + other.radius;
    return dot(step, step) <= reach * reach;
  }
};

// Returns the ball of a cell. If all corners are less than 90 degrees from the center, so is the
// whole cell: otherwise its center of mass would be on the other side.
CellBall ball_of(const Subdivision& cells, Index cell) {
  constexpr double quarter = 1.4;       // less than the square root of 2, the chord of 90 degrees
  constexpr double rounding = 0x1p-50;  // the rounding of the center
  CellBall ball{cell, cells.centers[cell], 0};
  for (Halfedge h = cells.begin_of(cell); h < cells.end_of(cell); ++h) {
    const Point step = cells.origin(h) - ball.center;
    ball.radius = std::max(ball.radius, std::sqrt(dot(step, step)) + rounding);
  }
  if (ball.radius > quarter) ball.radius = around_everything;
  return ball;
}

// True if a side of a convex cell has all corners of another cell to its right or on it.
bool has_on_right(const Subdivision& cells, Index cell, Index other) {
  for (Halfedge h = cells.begin_of(cell); h < cells.end_of(cell); ++h) {
    const Halfedge twin = cells.twins[h];
    if (twin != no_index && cells.cell_of[twin] == other && cells.shapes[other] == Shape::convex)
      return true;
    const Point& p = cells.origin(h);
    const Point& q = cells.end(h);
    bool is_right = true;
    for (Halfedge g = cells.begin_of(other); is_right && g < cells.end_of(other); ++g) {
      is_right = orientation(p, q, cells.origin(g)) != Sign::positive;
    }
    if (is_right) return true;
  }
  return false;
}

// True if two cells certainly do not overlap.
bool are_apart(const Subdivision& cells, Index a, Index b) {
  const bool are_convex = cells.shapes[a] == Shape::convex && cells.shapes[b] == Shape::convex;
  return are_convex && (has_on_right(cells, a, b) || has_on_right(cells, b, a));
}

// A pair of cells that may overlap; `filled` is to be triangulated.
struct Candidates {
  Index filled;
  Index other;
  friend auto operator<=>(const Candidates&, const Candidates&) = default;
};

// Returns all pairs of cells that may overlap, sorted.
std::vector<Candidates> candidates_of(const Subdivision& cells, unsigned threads) {
  std::vector<CellBall> balls;
  for (Index c = 0; c < cells.num_cells(); ++c) {
    if (cells.shapes[c] != Shape::empty) balls.push_back(ball_of(cells, c));
  }
  std::ranges::sort(balls, {}, [](const CellBall& ball) { return ball.low(); });
  std::vector<std::vector<Candidates>> blocks(system::num_pieces(balls.size(), balls_per_piece));
  system::parallel_for(
      threads, balls.size(), balls_per_piece, [&](std::size_t begin, std::size_t end) {
        std::vector<Candidates>& block = blocks[begin / balls_per_piece];
        for (std::size_t i = begin; i < end; ++i) {
          const double high = balls[i].center.x + balls[i].radius;
          for (std::size_t k = i + 1; k < balls.size() && balls[k].low() <= high; ++k) {
            if (!balls[i].may_meet(balls[k])) continue;
            const auto [a, b] = std::minmax(balls[i].cell, balls[k].cell);
            if (are_apart(cells, a, b)) continue;
            // The cell with more corners is triangulated, once for all cells near it.
            const bool is_first =
                cells.end_of(a) - cells.begin_of(a) >= cells.end_of(b) - cells.begin_of(b);
            block.push_back(is_first ? Candidates{a, b} : Candidates{b, a});
          }
        }
      });
  std::vector<Candidates> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  std::ranges::sort(all);
  return all;
}

// Returns a pair with the lower index first.
CrossingCells named(Index a, Index b, const Point& place) {
  const auto [first, second] = std::minmax(a, b);
  return {first, second, place};
}

}  // namespace

bool are_exactly_valid(const CellRings& cells, const Execution& execution) {
  try {
    (void)relate_pairs(cells, cells, {}, execution);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

CellRings rings_of(const Subdivision& cells, std::span<const Index> some) {
  CellRings rings;
  for (const Index cell : some) {
    for (Index ring = cells.cells[cell]; ring < cells.cells[cell + 1]; ++ring) {
      rings.append_ring(cells.corners_of(ring));
    }
    rings.end_cell();
  }
  std::vector<Index> used = rings.corners;
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const Index p : used) rings.points.push_back(cells.points[p]);
  for (Index& corner : rings.corners) {
    corner = static_cast<Index>(std::ranges::lower_bound(used, corner) - used.begin());
  }
  return rings;
}

namespace {

std::vector<BorderArc> sides_of(const Subdivision& cells) {
  std::vector<BorderArc> sides;
  for (Index ring = 0; ring + 1 < cells.rings.size(); ++ring) {
    const Halfedge end = cells.rings[ring + 1];
    for (Halfedge h = cells.rings[ring]; h < end; ++h) {
      sides.push_back({cells.origin(h), cells.origin(h + 1 < end ? h + 1 : cells.rings[ring])});
    }
  }
  return sides;
}

// Finds the overlaps of one subdivision.
class OverlapFinder {
 public:
  OverlapFinder(const Subdivision& cells, OverlapsWanted wanted, std::span<const std::int32_t> mask,
                const Execution& execution)
      : cells_(cells),
        wanted_(wanted),
        mask_(mask),
        told_{.threads = execution.threads, .stop = execution.stop} {}

  // Finds the cells that overlap themselves.
  void find_in_themselves() {
    soundness_.assign(cells_.num_cells(), Soundness::sound);
    for (Index cell = 0; cell < cells_.num_cells(); ++cell) {
      if (cells_.shapes[cell] == Shape::other) soundness_[cell] = find_in_itself(cell);
    }
  }

  // Finds the wanted overlaps. A cell that overlaps itself is not compared with others.
  void find() {
    find_in_themselves();
    if (is_one_region()) return;
    overlaps_others_.assign(cells_.num_cells(), false);
    const std::vector<Candidates> all = candidates_of(cells_, told_.threads);
    for (std::size_t k = 0; k < all.size() && !has_enough();) {
      std::size_t end = k;
      std::vector<Index> others;
      for (; end < all.size() && all[end].filled == all[k].filled; ++end) {
        if (is_to_be_tested(all[end])) others.push_back(all[end].other);
      }
      system::obey_stop();
      if (soundness_[all[k].filled] == Soundness::sound) {
        find_in(all[k].filled, others);
      } else if (soundness_[all[k].filled] == Soundness::to_rounding) {
        for (const Index other : others) {
          if (soundness_[other] == Soundness::sound) find_in(other, std::span(&all[k].filled, 1));
        }
      }
      k = end;
    }
  }
  [[nodiscard]] std::vector<CrossingCells> take() {
    std::ranges::sort(found_, {}, [](const CrossingCells& pair) {
      return std::tuple(pair.first, pair.second, pair.place.x, pair.place.y, pair.place.z);
    });
    return std::move(found_);
  }

 private:
  // Says whether a cell has a well-defined inside.
  enum class Soundness : std::uint8_t {
    sound,
    to_rounding,  // sides cross, but no end is beyond the other side by more than rounding
    none,
  };

  [[nodiscard]] bool has_enough() const {
    return wanted_ == OverlapsWanted::any && !found_.empty();
  }
  [[nodiscard]] bool is_masked(Index cell) const {
    return !mask_.empty() && mask_[cells_.names[cell]] == 0;
  }
  [[nodiscard]] bool is_to_be_tested(const Candidates& pair) const {
    const auto& [filled, other] = pair;
    if (soundness_[other] == Soundness::none || is_masked(filled) || is_masked(other)) return false;
    if (wanted_ == OverlapsWanted::cells) {
      return !overlaps_others_[filled] || !overlaps_others_[other];
    }
    const auto own = std::minmax({cells_.names[filled], cells_.names[other]});
    return wanted_ != OverlapsWanted::first || !first_ ||
           std::pair(own.first, own.second) < *first_;
  }
  void add(Index a, Index b, const Point& place) {
    found_.push_back(named(cells_.names[a], cells_.names[b], place));
    overlaps_others_[a] = overlaps_others_[b] = true;
    const std::pair pair(found_.back().first, found_.back().second);
    if (!first_ || pair < *first_) first_ = pair;
  }

  // True if all cells together are one region without overlaps. The number of cells that have a
  // place changes only at sides of a single cell. If these sides are the border of a region, the
  // number is k inside of it and k - 1 outside; the areas tell whether k is 1.
  [[nodiscard]] bool is_one_region() const {
    constexpr double whole_area = 4 * std::numbers::pi;
    constexpr double surely = 1e-6;
    constexpr Point origin{0.48, 0.6, 0.64};
    const auto is_sound = [](Soundness soundness) { return soundness == Soundness::sound; };
    if (!std::ranges::all_of(soundness_, is_sound)) return false;
    std::vector<BorderArc> sides;
    double difference = 0;
    double of_border = 0;
    for (Index ring = 0; ring + 1 < cells_.rings.size(); ++ring) {
      const Halfedge end = cells_.rings[ring + 1];
      for (Halfedge h = cells_.rings[ring]; h < end; ++h) {
        if (cells_.twins[h] != no_index) continue;
        const Point& from = cells_.origin(h);
        const Point& to = cells_.origin(h + 1 < end ? h + 1 : cells_.rings[ring]);
        sides.push_back({from, to});
        of_border += exact::triangle_area(origin, from, to);
      }
    }
    for (Index cell = 0; cell < cells_.num_cells(); ++cell) {
      if (cells_.shapes[cell] != Shape::empty) difference += cells_.area_of_rings(cell);
    }
    of_border = std::remainder(of_border, whole_area);
    // The region is nearly empty or nearly the sphere.
    if (std::abs(of_border) < surely) return false;
    if (of_border < 0) of_border += whole_area;
    return std::abs(difference - of_border) < surely && is_region(sides, told_);
  }

  // Tests one cell of Shape::other for crossing sides.
  Soundness find_in_itself(Index cell) {
    const CellRings rings = rings_of(cells_, std::span(&cell, 1));
    if (are_exactly_valid(rings, told_)) return Soundness::sound;
    const Subdivision one(rings, false, 1);
    const std::optional<SideConflict> conflict = side_conflict(one, told_);
    if (!conflict) return Soundness::sound;
    if (conflict->is_crossing && !has_sure_crossing(sides_of(one))) return Soundness::to_rounding;
    if (!is_masked(cell)) {
      found_.push_back(named(cells_.names[cell], cells_.names[cell], conflict->place));
    }
    return Soundness::none;
  }

  // Finds the cells of `others` that overlap with a cell, which is triangulated.
  void find_in(Index filled, std::span<const Index> others) {
    if (others.empty()) return;
    const Subdivision cover(rings_of(cells_, std::span(&filled, 1)), false, 1);
    const PieceRows pieces = pieces_in(cover, others);
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (pieces.offsets[k] == pieces.offsets[k + 1]) continue;
      const auto at = pieces.offsets[k];
      if (!(pieces.areas[at] > area_of_rounding(length_of(others[k])))) continue;
      add(filled, others[k], normalized(pieces.moments[at]));
    }
  }
  // Returns a bound for the length of a cell's border.
  [[nodiscard]] double length_of(Index cell) const {
    double length = 0;
    for (Index ring = cells_.cells[cell]; ring < cells_.cells[cell + 1]; ++ring) {
      const Halfedge end = cells_.rings[ring + 1];
      for (Halfedge h = cells_.rings[ring]; h < end; ++h) {
        length +=
            rough_length(cells_.origin(h), cells_.origin(h + 1 < end ? h + 1 : cells_.rings[ring]));
      }
    }
    return length;
  }
  // Returns the pieces of some cells in a cover.
  [[nodiscard]] PieceRows pieces_in(const Subdivision& cover, std::span<const Index> some) const {
    const CellSetData laid(Subdivision(rings_of(cells_, some), false, told_.threads), {},
                           told_.threads);
    return pieces_of_parts(laid.subdivision(), laid.sizes(), cover, true, told_);
  }

  const Subdivision& cells_;
  OverlapsWanted wanted_;
  std::span<const std::int32_t> mask_;
  Execution told_;
  std::vector<Soundness> soundness_;
  std::vector<bool> overlaps_others_;
  std::vector<CrossingCells> found_;
  std::optional<std::pair<Index, Index>>
      first_;  // of found_, without cells that overlap themselves
};

}  // namespace

std::vector<CrossingCells> overlaps_of(const Subdivision& cells, std::span<const Index> whole,
                                       const Execution& execution) {
  std::vector<CrossingCells> found = some_overlaps(cells, OverlapsWanted::all, {}, execution);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    for (std::size_t i = k + 1; i < whole.size(); ++i) {
      found.push_back(named(whole[k], whole[i], {0, 0, 1}));
    }
    for (Index c = 0; c < cells.num_cells(); ++c) {
      if (cells.shapes[c] == Shape::empty) continue;
      found.push_back(named(whole[k], cells.names[c], cells.origin(cells.begin_of(c))));
    }
  }
  std::ranges::stable_sort(
      found, {}, [](const CrossingCells& pair) { return std::pair(pair.first, pair.second); });
  return found;
}

std::vector<CrossingCells> some_overlaps(const Subdivision& cells, OverlapsWanted wanted,
                                         std::span<const std::int32_t> mask,
                                         const Execution& execution) {
  OverlapFinder finder(cells, wanted, mask, execution);
  finder.find();
  return finder.take();
}

std::vector<CrossingCells> cells_crossing_themselves(const Subdivision& cells,
                                                     const Execution& execution) {
  OverlapFinder finder(cells, OverlapsWanted::all, {}, execution);
  finder.find_in_themselves();
  return finder.take();
}

std::vector<std::pair<Index, Index>> near_cells(const Subdivision& cells, unsigned threads) {
  std::vector<std::pair<Index, Index>> pairs;
  for (const auto& [filled, other] : candidates_of(cells, threads)) {
    pairs.emplace_back(std::minmax(cells.names[filled], cells.names[other]));
  }
  std::ranges::sort(pairs);
  return pairs;
}

namespace {

// Returns " at 12.5000 40.2500".
std::string text_at(const Point& place) {
  std::array<char, 64> at{};
  const LonLat position = map::lonlat_of(place, true);
  // Without the sign of a zero.
  const auto shown = [](double degrees) { return std::round(degrees * 1e4) / 1e4 + 0.0; };
  std::snprintf(at.data(), at.size(), " at %.4f %.4f", shown(position.lon_deg),
                shown(position.lat_deg));
  return at.data();
}

}  // namespace

std::string fault_of(const CrossingCells& crossing) {
  return "crosses or overlaps itself" + text_at(crossing.place);
}

std::string message_of(const CrossingCells& overlap, std::span<const Column> columns) {
  const std::string first = feature_name(columns, overlap.first);
  if (overlap.first == overlap.second) return "cell " + first + ' ' + fault_of(overlap);
  return "cells " + first + " and " + feature_name(columns, overlap.second) + " overlap" +
         text_at(overlap.place);
}

}  // namespace rondel::overlay

namespace rondel {

std::vector<CrossingCells> overlapping_cells(const CellRings& cells, const Execution& execution) {
  const system::Call call(execution);
  const CellSet cell_set = CellSet::polygons(cells, execution);
  const overlay::CellSetData& data = overlay::CellSetData::of(cell_set);
  return overlay::overlaps_of(data.subdivision(), data.all_whole(), execution);
}

CellDrawing drawing_of(const CellRings& cells, const Execution& execution) {
  if (cells.num_cells() < 2) return CellDrawing::together;
  // Exact relations are found quickly. Cells that they know to overlap may do so by rounding alone.
  std::set<Index> doubtful;
  try {
    for (const auto& [first, second, relation] :
         related_pairs(cells, cells, SpatialPredicate::intersects, execution)) {
      if (first != second && relation.matrix[0] != 'F') doubtful.insert({first, second});
    }
  } catch (const InvalidInput&) {  // a cell is not valid
    for (Index c = 0; c < cells.num_cells(); ++c) doubtful.insert(doubtful.end(), c);
  }
  if (doubtful.empty()) return CellDrawing::together;
  CellRings some;
  some.points = cells.points;
  for (const Index c : doubtful) some.append_cell(cells, c);
  return overlapping_cells(some, execution).empty() ? CellDrawing::together : CellDrawing::apart;
}

}  // namespace rondel
