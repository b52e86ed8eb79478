// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds all pairs of cells whose sides cross, by sweeping: sides are sorted by the least x of their
// boxes, and each side is tested with the sides after it whose boxes meet its own.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

constexpr std::size_t sides_per_piece = 1024;

// The side of a cell: the shorter arc from a to b, with an axis-aligned box that contains the arc.
struct BoxedSide {
  Index cell;
  Point a, b;
  std::array<double, 3> low, high;

  BoxedSide(Index cell_index, const Point& from, const Point& to)
      : cell(cell_index), a(from), b(to) {
    // An arc of at most 90 degrees leaves its chord by less than an eighth of the chord's squared
    // length, and any shorter arc by less than a quarter of it.
    const Point chord = b - a;
    const double bulge = dot(chord, chord) / 4;
    low = {std::min(a.x, b.x) - bulge, std::min(a.y, b.y) - bulge, std::min(a.z, b.z) - bulge};
    high = {std::max(a.x, b.x) + bulge, std::max(a.y, b.y) + bulge, std::max(a.z, b.z) + bulge};
  }

  // True if the boxes overlap in y and z. The sweep has already compared their x.
  [[nodiscard]] bool may_meet(const BoxedSide& other) const {
    return low[1] <= other.high[1] && other.low[1] <= high[1] && low[2] <= other.high[2] &&
           other.low[2] <= high[2];
  }
};

bool are_opposite(Sign s, Sign t) { return s * t == Sign::negative; }

// Returns the point where two sides cross, or nothing if they only touch or do not meet.
std::optional<Point> crossing_of(const BoxedSide& s, const BoxedSide& t) {
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
std::vector<BoxedSide> sides_of_cells(const CellRings& cells) {
  if (cells.rings.empty() || !system::are_offsets(cells.cells, cells.rings.size() - 1) ||
      !system::are_offsets(cells.rings, cells.corners.size()) ||
      !std::ranges::all_of(cells.corners, [&](Index p) { return p < cells.points.size(); })) {
    throw InvalidInput("the arrays of the cells do not fit");
  }
  std::vector<BoxedSide> sides;
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
      for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
        const std::uint64_t next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
        sides.emplace_back(static_cast<Index>(c), cells.points[cells.corners[k]],
                           cells.points[cells.corners[next]]);
      }
    }
  }
  return sides;
}

// Orders crossings by the pair of cells, and then by place.
auto key_of(const CrossingCells& pair) {
  return std::tuple(pair.first, pair.second, pair.place.x, pair.place.y, pair.place.z);
}

}  // namespace

std::vector<CrossingCells> crossing_cells(const CellRings& cells, const Execution& execution) {
  const system::Call call(execution);
  std::vector<BoxedSide> sides = sides_of_cells(cells);
  std::ranges::sort(sides, {}, [](const BoxedSide& side) { return side.low[0]; });
  std::vector<std::vector<CrossingCells>> pieces(system::num_pieces(sides.size(), sides_per_piece));
  system::parallel_for(
      execution.threads, sides.size(), sides_per_piece, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const BoxedSide& s = sides[i];
          for (std::size_t k = i + 1; k < sides.size() && sides[k].low[0] <= s.high[0]; ++k) {
            if (!s.may_meet(sides[k])) continue;
            if (const auto place = crossing_of(s, sides[k])) {
              const auto [first, second] = std::minmax(s.cell, sides[k].cell);
              pieces[begin / sides_per_piece].push_back({first, second, *place});
            }
          }
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
