// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/crossings.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include "order/place_keys.h"
#include "overlay/cover_walk.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::overlay {
namespace {

// Whether a point of the edge's circle is on the edge.
bool is_within(const CoverEdge& edge, const Point& p) {
  const Point& y = edge.start();
  const Point& z = edge.end();
  const double cosine = dot(y, z);
  return dot(p, z - cosine * y) >= 0 && dot(p, y - cosine * z) >= 0;
}

// A common end is where the two meet. Where they are as good as parallel, rounding may find a point that is on
// the line but not on the edge: then the edge's nearer end is on both.
Point crossing_point(const TracedLine& line, const CoverEdge& edge) {
  constexpr double least_sine = 0x1p-20;
  const Point& from = line.from();
  const Point& to = line.to();
  const Point& y = edge.start();
  const Point& z = edge.end();
  if (from == y || from == z) return from;
  if (to == y || to == z) return to;
  const double of_start = edge.distance(from);
  const double of_end = edge.distance(to);
  const double drop = of_start - of_end;
  double part = of_start / drop;
  if (!(part >= 0)) part = 0;  // both vanish
  if (part > 1) part = 1;
  const Point p = exact::to_point(normalized(exact::to_vector(from) + part * line.step()));
  if (drop * drop > least_sine * least_sine * edge.squared_length() * dot(line.step(), line.step()))
    return p;
  if (orientation(y, z, from) == Sign::zero && orientation(y, z, to) == Sign::zero) {
    if (is_within(edge, from)) return from;
    if (is_within(edge, to)) return to;
  } else if (is_within(edge, p)) {
    return p;
  }
  return dot(p, y) > dot(p, z) ? y : z;
}

// A point that is strictly inside of a cell.
struct Base {
  Index cell;
  Point point;
};

std::optional<Point> point_inside(const Subdivision& cover, Index cell) {
  if (cover.shapes[cell] == Shape::empty) return std::nullopt;
  const Halfedge begin = cover.begin_of(cell);
  const bool is_star = cover.shapes[cell] == Shape::star;
  const Point& apex = is_star ? cover.centers[cell] : cover.origin(begin);
  for (Halfedge h = is_star ? begin : begin + 1; h < cover.end_of(cell); ++h) {
    const Point& y = cover.origin(h);
    const Point& z = cover.end(h);
    const Point middle = normalized(apex + y + z);
    if (orientation(apex, y, middle) == Sign::positive &&
        orientation(y, z, middle) == Sign::positive &&
        orientation(z, apex, middle) == Sign::positive) {
      return middle;
    }
  }
  return std::nullopt;
}

// One not far from p along the curve. Precondition: there is any.
Base base_near(const Subdivision& cover, const Point& p) {
  std::uint64_t key = 0;
  order::place_keys(std::span(&p, 1), Model::projected, {}, std::span(&key, 1));
  const auto near =
      static_cast<std::size_t>(std::ranges::lower_bound(cover.keys, key) - cover.keys.begin());
  const std::size_t n = cover.num_cells();
  for (std::size_t k = 0; k < n; ++k) {
    const auto cell = static_cast<Index>((near + k) % n);
    if (const auto point = point_inside(cover, cell)) return {cell, *point};
  }
  throw InvalidInput("no cell has an inside", 0);
}

// A point at a right angle to p.
Point point_beside(const Point& p) {
  const Point axis = std::abs(p.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
  return normalized(cross(p, axis));
}

// A point that moves through the cover.
class Walker {
 public:
  Walker(const Subdivision& cover, const Base& base)
      : walk_(cover), at_(base.point), cell_(base.cell) {}

  [[nodiscard]] Index cell() const { return cell_; }
  void jump_to(const Point& p, Index cell) {
    at_ = p;
    cell_ = cell;
  }
  void go_to(const Point& p) {
    if (p == at_) return;
    constexpr double far = -0.5;
    if (dot(at_, p) < far) go_to(point_beside(p));
    along(TracedLine(at_, p), [](Halfedge /*out*/, const CoverEdge& /*edge*/) {});
  }
  template <class Cross>
  void along(const TracedLine& line, const Cross& cross) {
    cell_ = walk_(line, cell_, cross);
    at_ = line.to();
  }

 private:
  CoverWalk walk_;
  Point at_;
  Index cell_;
};

}  // namespace

Crossings::Crossings(const Subdivision& cells, const Subdivision& cover, const Execution& execution)
    : cells_(cells), known_(cells.points.size()) {
  const std::size_t num_blocks = system::num_pieces(cells.num_cells(), cells_per_block);
  blocks_.resize(num_blocks);
  for (auto& cell : known_) cell.store(no_index, std::memory_order_relaxed);
  traces_.resize(cells.num_halfedges());
  system::StageProgress progress(execution.progress, "trace", num_blocks);
  system::parallel_for(execution.threads, num_blocks, 1,
                       [&](std::size_t begin, std::size_t /*end*/) {
                         trace_block(begin, cover);
                         progress.step();
                       });
}

void Crossings::trace_block(std::size_t block, const Subdivision& cover) {
  const std::size_t first_cell = block * cells_per_block;
  const std::size_t end_cell = std::min(first_cell + cells_per_block, cells_.num_cells());
  const Halfedge first = cells_.begin_of(static_cast<Index>(first_cell));
  const Halfedge end = cells_.rings[cells_.cells[end_cell]];
  if (first == end) return;
  auto& crossings = blocks_[block];
  Walker walker(cover, base_near(cover, cells_.origin(first)));
  for (Index ring = cells_.cells[first_cell]; ring < cells_.cells[end_cell]; ++ring) {
    for (Halfedge h = cells_.rings[ring]; h < cells_.rings[ring + 1]; ++h) {
      const Halfedge twin = cells_.twins[h];
      if (twin < h) continue;
      const Halfedge next = h + 1 == cells_.rings[ring + 1] ? cells_.rings[ring] : h + 1;
      const TracedLine line(cells_.origin(h), cells_.origin(next));
      const Index known = known_[cells_.corners[h]].load(std::memory_order_relaxed);
      if (known != no_index) {
        walker.jump_to(line.from(), known);
      } else {
        walker.go_to(line.from());
        known_[cells_.corners[h]].store(walker.cell(), std::memory_order_relaxed);
      }
      const Index start = walker.cell();
      const auto begin = static_cast<Index>(crossings.size());
      walker.along(line, [&](Halfedge out, const CoverEdge& edge) {
        crossings.push_back({out, crossing_point(line, edge)});
      });
      known_[cells_.corners[next]].store(walker.cell(), std::memory_order_relaxed);
      const Index count = static_cast<Index>(crossings.size()) - begin;
      const auto number = static_cast<Index>(block);
      traces_[h] = {start, number, begin, count, false};
      if (twin != no_index) traces_[twin] = {walker.cell(), number, begin, count, true};
    }
  }
}

}  // namespace rondel::overlay
