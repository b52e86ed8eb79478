// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "order/place_keys.h"
#include "overlay/cover_walk.h"
#include "rondel/error.h"
#include "rondel/predicates.h"

namespace rondel::overlay {
namespace {

// True if p, a point of the edge's great circle, lies on the edge.
bool is_within(const CoverEdge& edge, const Point& p) {
  const Point& y = edge.start();
  const Point& z = edge.end();
  const double cosine = dot(y, z);
  return dot(p, z - cosine * y) >= 0 && dot(p, y - cosine * z) >= 0;
}

// Returns the unit vector of a vector that is not zero.
Point direction_of(const Vec& v) {
  constexpr double small = 0x1p-14;  // the term 35/128 e^4 of (1 + e)^(-1/2) is below rounding then
  const double excess = dot(v, v) - 1;
  if (std::abs(excess) > small) return exact::to_point(normalized(v));
  return exact::to_point((1 - excess * (0.5 - excess * (0.375 - excess * 0.3125))) * v);
}

// Returns the point where the line and the edge cross. If they have an end in common, it is that
// end. Where they are nearly parallel, rounding may produce a point on the line that is not on the
// edge; then the nearer end of the edge is on both.
Point crossing_point(const TracedLine& line, const CoverEdge& edge) {
  constexpr double min_sine = 0x1p-20;
  const Point& from = line.from();
  const Point& to = line.to();
  const Point& y = edge.start();
  const Point& z = edge.end();
  if (from == y || from == z) return from;
  if (to == y || to == z) return to;
  const double of_start = edge.scaled_distance(from);
  const double of_end = edge.scaled_distance(to);
  const double drop = of_start - of_end;
  double part = of_start / drop;
  if (!(part >= 0)) part = 0;  // both distances are 0
  if (part > 1) part = 1;
  const Point p = direction_of(exact::to_vector(from) + part * line.step());
  if (drop * drop > min_sine * min_sine * edge.squared_length() * dot(line.step(), line.step()))
    return p;
  if (edge.is_on_circle(from) && edge.is_on_circle(to)) {
    if (is_within(edge, from)) return from;
    if (is_within(edge, to)) return to;
  } else if (is_within(edge, p)) {
    return p;
  }
  return dot(p, y) > dot(p, z) ? y : z;
}

// A point strictly inside of a cell of the cover.
struct Base {
  Index cell;
  Point point;
};

// Returns a point strictly inside of a cell, or nothing if rounding leaves none.
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

// Calls `is_good` with points inside of cells, those near p in spatial order first, until it returns
// true. Throws InvalidInput if it does not.
template <class IsGood>
void for_bases_near(const Subdivision& cover, const Point& p, const IsGood& is_good) {
  std::uint64_t key = 0;
  order::place_keys(std::span(&p, 1), Model::projected, {}, std::span(&key, 1));
  const auto near =
      static_cast<std::size_t>(std::ranges::lower_bound(cover.keys, key) - cover.keys.begin());
  const std::size_t n = cover.num_cells();
  for (std::size_t k = 0; k < n; ++k) {
    // The next cells behind, and before, that place.
    const std::size_t step = k % 2 == 0 ? k / 2 : n - 1 - k / 2;
    const auto cell = static_cast<Index>((near + step) % n);
    const auto point = point_inside(cover, cell);
    if (point && is_good(Base{cell, *point})) return;
  }
  throw InvalidInput("no cell has an inside");
}

// Returns a point inside of a cell near p in spatial order. Throws InvalidInput if no cell has one.
Base base_near(const Subdivision& cover, const Point& p) {
  Base result{};
  for_bases_near(cover, p, [&](const Base& base) {
    result = base;
    return true;
  });
  return result;
}

// Returns a unit vector orthogonal to p.
Point point_beside(const Point& p) {
  const Point axis = std::abs(p.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
  return normalized(cross(p, axis));
}

// A point that moves through the cover, with the cell that has it.
class Walker {
 public:
  Walker(const Subdivision& cover, const Base& base)
      : cover_(cover), walk_(cover), at_(base.point), cell_(base.cell) {}

  [[nodiscard]] Index cell() const { return cell_; }
  // Moves to a point whose cell is known.
  void jump_to(const Point& p, Index cell) {
    at_ = p;
    cell_ = cell;
  }
  // Moves to p along a great circle. If p is far, the path has a corner, so that each of its arcs
  // is shorter than 180 degrees. Where the path leaves a cover of a part of the sphere, p is reached
  // from a cell near it.
  void go_to(const Point& p) {
    if (p == at_ || is_reached(p)) return;
    for_bases_near(cover_, p, [&](const Base& base) {
      jump_to(base.point, base.cell);
      return is_reached(p);
    });
  }
  template <class Cross>
  void along(const TracedLine& line, const Cross& cross) {
    cell_ = walk_(line, cell_, cross);
    at_ = line.to();
  }

 private:
  // Moves to p unless the path leaves the cover.
  bool is_reached(const Point& p) {
    constexpr double far = -0.5;
    if (dot(at_, p) < far && !is_reached(point_beside(p))) return false;
    along(TracedLine(at_, p), [](Halfedge /*out*/, const CoverEdge& /*edge*/) {});
    return cell_ != no_index;
  }

  const Subdivision& cover_;
  CoverWalk walk_;
  Point at_;
  Index cell_;
};

}  // namespace

// An edge is always traced from its lower halfedge on, so that the cells on both sides of it find
// the same points.
Crossings::Crossings(const Subdivision& cells, const Subdivision& cover, Index first_cell,
                     Index end_cell)
    : first_(cells.begin_of(first_cell)) {
  const Halfedge end = cells.begins[end_cell];
  if (first_ == end) return;
  traces_.resize(end - first_);
  // The cover's cells at points that were reached first by these cells. Points are numbered in the
  // order in which cells first have them, so those of earlier cells have lower numbers and are not
  // stored.
  const auto corners = std::span(cells.corners).subspan(first_, end - first_);
  const Index points_end = *std::ranges::max_element(corners) + 1;
  const Index points_begin = points_end - std::min(points_end, end - first_);
  std::vector<Index> known(points_end - points_begin, no_index);
  const auto know = [&](Index p, Index cell) {
    if (p >= points_begin) known[p - points_begin] = cell;
  };
  Walker walker(cover, base_near(cover, cells.origin(first_)));
  for (Index ring = cells.cells[first_cell]; ring < cells.cells[end_cell]; ++ring) {
    for (Halfedge h = cells.rings[ring]; h < cells.rings[ring + 1]; ++h) {
      const Halfedge twin = cells.twins[h];
      if (twin < h && twin >= first_) continue;
      const Halfedge next = h + 1 == cells.rings[ring + 1] ? cells.rings[ring] : h + 1;
      const bool is_backwards = twin < h;
      const Index p = cells.corners[is_backwards ? next : h];
      const Index q = cells.corners[is_backwards ? h : next];
      const TracedLine line(cells.points[p], cells.points[q]);
      if (p >= points_begin && known[p - points_begin] != no_index) {
        walker.jump_to(line.from(), known[p - points_begin]);
      } else {
        walker.go_to(line.from());
        know(p, walker.cell());
      }
      const Index start = walker.cell();
      const auto first = static_cast<Index>(crossings_.size());
      walker.along(line, [&](Halfedge out, const CoverEdge& edge) {
        crossings_.push_back({out, crossing_point(line, edge)});
      });
      know(q, walker.cell());
      const Index count = static_cast<Index>(crossings_.size()) - first;
      traces_[h - first_] = {is_backwards ? walker.cell() : start, first, count, is_backwards};
      if (twin > h && twin < end) traces_[twin - first_] = {walker.cell(), first, count, true};
    }
  }
}

}  // namespace rondel::overlay
