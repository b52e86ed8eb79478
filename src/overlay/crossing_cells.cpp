// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds all pairs of cells whose sides cross, in a tree of the boxes of sides.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "arrangement/ring_arrays.h"
#include "exact/vector.h"
#include "order/along_the_curve.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel {
namespace {

constexpr std::size_t blocks_per_piece = 128;

// The side of a cell: the shorter arc from a to b.
struct CellSide {
  Index cell;
  Point a;
  Point b;
};

bool are_opposite(Sign s, Sign t) { return s * t == Sign::negative; }

// Returns the point where two sides cross, or nothing if they only touch or do not meet.
std::optional<Point> crossing_of(const CellSide& s, const CellSide& t) {
  if (s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b) return std::nullopt;
  if (!are_opposite(orientation(s.a, s.b, t.a), orientation(s.a, s.b, t.b)) ||
      !are_opposite(orientation(t.a, t.b, s.a), orientation(t.a, t.b, s.b))) {
    return std::nullopt;
  }
  // The two great circles cross in two antipodes. One of them lies within both arcs, or within one
  // arc and opposite of the other. A point within an arc is less than 90 degrees from the middle of
  // the arc, which tells these cases apart.
  const Point line = normalized(cross(cross(s.a, s.b - s.a), cross(t.a, t.b - t.a)));
  const Point place = dot(line, s.a + s.b) < 0 ? -1.0 * line : line;
  if (dot(place, t.a + t.b) <= 0) return std::nullopt;
  return place;
}

// Returns the sides of all cells. Throws InvalidInput if the arrays are no compressed rows.
std::vector<CellSide> sides_of_cells(const CellRings& cells) {
  arrangement::validate_rings(cells);
  std::vector<CellSide> sides;
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
      for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
        const std::uint64_t next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
        sides.push_back({static_cast<Index>(c), cells.points[cells.corners[k]],
                         cells.points[cells.corners[next]]});
      }
    }
  }
  return sides;
}

// Returns the sides along the spatial order: cells that are near each other may come in any order.
std::vector<Index> order_of(const std::vector<CellSide>& sides, unsigned threads) {
  std::vector<Index> indices(sides.size());
  std::iota(indices.begin(), indices.end(), Index{0});
  return order::along_the_curve(std::move(indices), Model::projected, {}, threads,
                                [&](Index i) { return sides[i].a; })
      .indices;
}

// Orders crossings by the pair of cells, and then by place.
auto key_of(const CrossingCells& pair) {
  return std::tuple(pair.first, pair.second, pair.place.x, pair.place.y, pair.place.z);
}

}  // namespace

std::vector<CrossingCells> crossing_cells(const CellRings& cells, const Execution& execution) {
  const system::Call call(execution);
  const std::vector<CellSide> sides = sides_of_cells(cells);
  const std::vector<Index> order = order_of(sides, execution.threads);
  std::vector<arrangement::SpaceBox> boxes;
  boxes.reserve(sides.size());
  for (const Index i : order) boxes.push_back(arrangement::box_of(sides[i].a, sides[i].b));
  const arrangement::BoxTree tree(boxes, execution.threads);
  std::vector<std::vector<CrossingCells>> pieces(
      system::num_pieces(tree.num_blocks(), blocks_per_piece));
  system::parallel_for(execution.threads, tree.num_blocks(), blocks_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t block = begin; block < end; ++block) {
                           tree.visit_pairs(block, [&](Index in_tree, Index other_in_tree) {
                             const auto [i, k] = std::minmax(order[in_tree], order[other_in_tree]);
                             if (const auto place = crossing_of(sides[i], sides[k])) {
                               const auto [first, second] =
                                   std::minmax(sides[i].cell, sides[k].cell);
                               pieces[begin / blocks_per_piece].push_back({first, second, *place});
                             }
                           });
                         }
                       });
  std::vector<CrossingCells> all;
  for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  std::ranges::sort(all, {}, key_of);
  const auto is_same_pair = [](const CrossingCells& p, const CrossingCells& q) {
    return p.first == q.first && p.second == q.second;
  };
  all.erase(std::unique(all.begin(), all.end(), is_same_pair), all.end());
  return all;
}

}  // namespace rondel
