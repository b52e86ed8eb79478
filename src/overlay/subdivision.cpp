// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/subdivision.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <tuple>
#include <utility>

#include "exact/vector.h"
#include "order/place_keys.h"
#include "order/sorts.h"
#include "overlay/measure.h"
#include "overlay/region_area.h"
#include "overlay/twins.h"
#include "predicates/bounds.h"
#include "rondel/predicates.h"
#include "system/disjoint_sets.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

// True if c is to the left of the great circle from a to b; exact.
bool is_left_turn(const Point& a, const Point& b, const Point& c) {
  const auto ray = exact::to_vector(a);
  const auto ab = exact::to_vector(b) - ray;
  const auto ac = exact::to_vector(c) - ray;
  const double value = det(ray, ab, ac);
  constexpr double bound = predicates::orientation_bound;
  const double squares = dot(ab, ab) * dot(ac, ac);
  if (squares > 1e-200 && value * value > bound * bound * dot(ray, ray) * squares) return value > 0;
  return orientation(a, b, c) == Sign::positive;
}

auto coordinates(const Point& p) { return std::tuple(p.x, p.y, p.z); }

// How many cells ahead memory is asked for: their rings are anywhere in the input.
constexpr std::size_t cells_ahead = 8;

// Asks for the points of a cell.
void prefetch_points(const CellRings& input, std::size_t cell) {
  const std::uint64_t begin = input.rings[input.cells[cell]];
  const std::uint64_t end = input.rings[input.cells[cell + 1]];
  for (std::uint64_t k = begin; k < end; ++k) system::prefetch(&input.points[input.corners[k]]);
}

// Returns the direction of a cell's center of mass, or of its first corner if the moment is zero.
Point center_of(const CellRings& input, std::size_t cell) {
  Point moment{};
  Point first{1, 0, 0};
  for (std::uint64_t r = input.cells[cell]; r < input.cells[cell + 1]; ++r) {
    const std::uint64_t begin = input.rings[r];
    const std::uint64_t end = input.rings[r + 1];
    for (std::uint64_t k = begin; k < end; ++k) {
      const Point& p = input.points[input.corners[k]];
      if (r == input.cells[cell] && k == begin) first = p;
      moment = moment + moment_of_arc(p, input.points[input.corners[k + 1 < end ? k + 1 : begin]]);
    }
  }
  return moment == Point{} ? first : normalized(moment);
}

// Returns the position in `corners` of the ring's corner with the least coordinates.
std::size_t min_corner(const CellRings& input, std::uint64_t ring) {
  const auto begin = input.corners.begin() + static_cast<std::ptrdiff_t>(input.rings[ring]);
  const auto end = input.corners.begin() + static_cast<std::ptrdiff_t>(input.rings[ring + 1]);
  const auto least = std::ranges::min_element(
      begin, end, {}, [&](Index p) { return coordinates(input.points[p]); });
  return static_cast<std::size_t>(least - input.corners.begin());
}

// Sorts the cells with equal keys by the coordinates of their first corners.
void sort_equals(const CellRings& input, order::KeyedIndices& sorted) {
  const auto first_coordinates = [&](Index i) {
    if (input.cells[i] == input.cells[i + 1]) return std::tuple(2.0, 0.0, 0.0);
    return coordinates(input.points[input.corners[min_corner(input, input.cells[i])]]);
  };
  const std::size_t n = sorted.keys.size();
  for (std::size_t i = 0; i < n;) {
    std::size_t end = i + 1;
    while (end < n && sorted.keys[end] == sorted.keys[i]) ++end;
    if (end - i > 1) {
      std::ranges::stable_sort(sorted.indices.begin() + static_cast<std::ptrdiff_t>(i),
                               sorted.indices.begin() + static_cast<std::ptrdiff_t>(end), {},
                               first_coordinates);
    }
    i = end;
  }
}

}  // namespace

Subdivision::Subdivision(const CellRings& input, bool is_rounded, unsigned threads) {
  sort_cells(input, threads);
  take_rings(input, threads);
  number_points(input.points, threads);
  find_begins();
  if (is_rounded) merge_disordered(threads);
  twins = twins_of(rings, corners, points.size(), threads);
  find_shapes(threads);
}

void Subdivision::sort_cells(const CellRings& input, unsigned threads) {
  const std::size_t n = input.num_cells();
  order::KeyedIndices sorted;
  sorted.keys.resize(n);
  sorted.indices.resize(n);
  std::iota(sorted.indices.begin(), sorted.indices.end(), Index{0});
  LargeVector<Point> places(n);
  system::parallel_for(threads, n, cells_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + cells_ahead < end) prefetch_points(input, i + cells_ahead);
      places[i] = center_of(input, i);
    }
    order::place_keys(std::span(places).subspan(begin, end - begin), Model::projected, {},
                      std::span(sorted.keys).subspan(begin, end - begin));
  });
  order::radix_sort(sorted, order::high_key_bits);
  sort_equals(input, sorted);
  keys = std::move(sorted.keys);
  names.assign(sorted.indices.begin(), sorted.indices.end());
  system::reserve_large(centers, n);
  centers.resize(n);
  system::parallel_for(threads, n, cells_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + system::prefetch_distance < end) {
        system::prefetch(&places[names[i + system::prefetch_distance]]);
      }
      centers[i] = places[names[i]];
    }
  });
}

// Rings begin at their corner with the least coordinates, so that only `names` depends on the order
// of the input. The corners are still points of the input.
void Subdivision::take_rings(const CellRings& input, unsigned threads) {
  const auto offset = [&](std::size_t r) { return input.rings[r]; };
  const std::size_t num_pieces = system::num_pieces(num_cells(), cells_per_task);
  std::vector<Index> rings_before(num_pieces + 1, 0);
  std::vector<Index> corners_before(num_pieces + 1, 0);
  system::parallel_for(
      threads, num_cells(), cells_per_task, [&](std::size_t begin, std::size_t end) {
        const std::size_t piece = begin / cells_per_task + 1;
        for (std::size_t c = begin; c < end; ++c) {
          if (c + cells_ahead < end) system::prefetch(&input.cells[names[c + cells_ahead]]);
          const std::uint64_t first = input.cells[names[c]];
          const std::uint64_t last = input.cells[names[c] + 1];
          rings_before[piece] += static_cast<Index>(last - first);
          corners_before[piece] += static_cast<Index>(offset(last) - offset(first));
        }
      });
  system::sum_counts(rings_before);
  system::sum_counts(corners_before);
  cells.resize(num_cells() + 1);
  rings.resize(std::size_t{rings_before.back()} + 1);
  given_starts.resize(rings_before.back());
  corners.resize(corners_before.back());
  cell_of.resize(corners_before.back());
  cells.back() = rings_before.back();
  rings.back() = corners_before.back();
  system::parallel_for(
      threads, num_cells(), cells_per_task, [&](std::size_t begin, std::size_t end) {
        Index ring = rings_before[begin / cells_per_task];
        Index h = corners_before[begin / cells_per_task];
        const auto cell_after = [&](std::size_t c, std::size_t steps) {
          return names[std::min(c + steps * cells_ahead, num_cells() - 1)];
        };
        for (std::size_t c = begin; c < end; ++c) {
          system::prefetch(&input.cells[cell_after(c, 4)]);
          system::prefetch(&input.rings[input.cells[cell_after(c, 3)]]);
          system::prefetch(input.corners.data() + offset(input.cells[cell_after(c, 2)]));
          prefetch_points(input, cell_after(c, 1));
          cells[c] = ring;
          for (std::uint64_t r = input.cells[names[c]]; r < input.cells[names[c] + 1]; ++r) {
            const std::span ring_corners =
                std::span(input.corners).subspan(offset(r), offset(r + 1) - offset(r));
            const std::size_t start = min_corner(input, r) - offset(r);
            given_starts[ring] = static_cast<Index>(start);
            rings[ring++] = h;
            std::fill_n(cell_of.begin() + h, ring_corners.size(), static_cast<Index>(c));
            const auto middle = ring_corners.begin() + static_cast<std::ptrdiff_t>(start);
            std::rotate_copy(ring_corners.begin(), middle, ring_corners.end(), corners.begin() + h);
            h += static_cast<Index>(ring_corners.size());
          }
        }
      });
}

// Numbers the points in the order of their first use, and corners by these numbers: each piece numbers
// what no piece before it uses.
void Subdivision::number_points(std::span<const Point> given, unsigned threads) {
  const std::size_t size = corners.size();
  const std::size_t grain =
      system::num_threads(threads) == 1 ? std::max<std::size_t>(size, 1) : 4 * cells_per_task;
  LargeVector<Index> first_piece(given.size(), no_index);
  LargeVector<Index> numbers(given.size(), no_index);
  std::vector<Index> points_before(system::num_pieces(size, grain) + 1, 0);
  const auto for_pieces = [&](auto work) {
    system::parallel_for(threads, size, grain, [&](std::size_t begin, std::size_t end) {
      work(static_cast<Index>(begin / grain), std::span(corners).subspan(begin, end - begin));
    });
  };
  for_pieces([&](Index piece, std::span<const Index> part) {
    for (const Index p : part) {
      const std::atomic_ref first(first_piece[p]);
      Index before = first.load(std::memory_order_relaxed);
      while (piece < before &&
             !first.compare_exchange_weak(before, piece, std::memory_order_relaxed)) {
      }
    }
  });
  for_pieces([&](Index piece, std::span<const Index> part) {
    Index next = 0;
    for (const Index p : part) {
      if (first_piece[p] == piece && numbers[p] == no_index) numbers[p] = next++;
    }
    points_before[piece + 1] = next;
  });
  system::sum_counts(points_before);
  system::reserve_large(points, given.size());
  points.resize(points_before.back());
  for_pieces([&](Index piece, std::span<Index> part) {
    for (Index& corner : part) {
      const Index p = corner;
      corner = points_before[first_piece[p]] + numbers[p];
      if (first_piece[p] == piece) points[corner] = given[p];
    }
  });
}

// Whether each edge turns counterclockwise around the center of its cell.
bool Subdivision::is_in_order(Index cell) const {
  const Index begin = begin_of(cell);
  const Index end = end_of(cell);
  for (Halfedge h = begin; h < end; ++h) {
    const Index next = corners[h + 1 == end ? begin : h + 1];
    if (corners[h] != next && !is_left_turn(centers[cell], origin(h), points[next])) return false;
  }
  return true;
}

// Merges corners that rounding has put into the wrong order. Each edge must turn counterclockwise
// around the center of its cell. The ends of a short edge that does not are merged. If a long edge
// does not, the cell is narrower than that edge's rounding, and all its short edges vanish. A cell
// that has fewer than three corners left loses its ring, and the cells on both sides of it become
// neighbors.
void Subdivision::merge_disordered(unsigned threads) {
  constexpr double short_length = 0x1p-44;
  std::atomic<bool> are_in_order = true;
  system::parallel_for(
      threads, num_cells(), cells_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end && are_in_order.load(std::memory_order_relaxed); ++c) {
          if (!is_in_order(static_cast<Index>(c))) are_in_order = false;
        }
      });
  if (are_in_order) return;
  system::DisjointSets merged(points.size());
  bool has_any = false;
  bool has_changed = true;
  const auto join = [&](Index p, Index q) {
    merged.join(p, q);
    has_changed = has_any = true;
  };
  const auto is_short = [&](Index p, Index q) {
    const Point step = points[q] - points[p];
    return dot(step, step) <= short_length * short_length;
  };
  const auto mend = [&](Index cell) {
    const Index begin = begin_of(cell);
    const Index end = end_of(cell);
    bool is_narrow = false;
    for (const bool is_second_pass : {false, true}) {
      for (Halfedge h = begin; h < end; ++h) {
        const Index p = merged[corners[h]];
        const Index q = merged[corners[h + 1 == end ? begin : h + 1]];
        if (p == q) continue;
        const bool is_in_order = is_left_turn(centers[cell], points[p], points[q]);
        if (is_short(p, q)) {
          if (!is_in_order || is_second_pass) join(p, q);
        } else {
          is_narrow |= !is_in_order;
        }
      }
      if (!is_narrow) return;
    }
  };
  while (has_changed) {
    has_changed = false;
    for (Index cell = 0; cell < num_cells(); ++cell) {
      if (begin_of(cell) < end_of(cell)) mend(cell);
    }
  }
  if (!has_any) return;
  given_starts.clear();
  std::vector<Index> final_points(points.size());
  for (Index p = 0; p < points.size(); ++p) final_points[p] = merged[p];
  take_merged(final_points);
}

// Removes the edges whose ends were merged, and rings with fewer than three corners. Each cell has
// at most one ring.
void Subdivision::take_merged(std::span<const Index> merged) {
  Index size = 0;
  Index num_rings = 0;
  for (std::size_t c = 0; c < num_cells(); ++c) {
    const Index begin = rings[cells[c]];
    const Index end = rings[cells[c + 1]];
    cells[c] = num_rings;
    const Index new_begin = size;
    for (Halfedge h = begin; h < end; ++h) {
      const Index p = merged[corners[h]];
      if (size > new_begin && corners[size - 1] == p) continue;
      corners[size] = p;
      cell_of[size] = static_cast<Index>(c);
      ++size;
    }
    while (size > new_begin + 1 && corners[size - 1] == corners[new_begin]) --size;
    if (size < new_begin + 3) {
      size = new_begin;
    } else {
      rings[num_rings++] = new_begin;
    }
  }
  cells[num_cells()] = num_rings;
  rings[num_rings] = size;
  rings.resize(num_rings + 1);
  corners.resize(size);
  cell_of.resize(size);
  find_begins();
}

void Subdivision::find_begins() {
  begins.resize(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) begins[c] = rings[cells[c]];
}

// True if a cell is strictly convex: its ring turns left at all corners and goes around once. Seen
// from the first corner, the other corners must follow each other counterclockwise, within 180
// degrees of the second one. For the first two and the last of them the turns at corners say so.
bool Subdivision::is_convex(Index cell) const {
  const Halfedge begin = begin_of(cell);
  const Halfedge end = end_of(cell);
  const auto after = [&](Halfedge h) { return h + 1 < end ? h + 1 : begin; };
  for (Halfedge h = begin; h < end; ++h) {
    const Halfedge next = after(h);
    if (!is_left_turn(origin(h), origin(next), origin(after(next)))) return false;
    const bool is_told_by_turns = h < begin + 2 || h + 2 >= end;
    if (!is_told_by_turns && !(is_left_turn(origin(begin), origin(h), origin(next)) &&
                               is_left_turn(origin(begin), origin(begin + 1), origin(next)))) {
      return false;
    }
  }
  return true;
}

// True if a cell is of Shape::star: all corners are in the hemisphere around the center, and all
// edges turn counterclockwise around it, by less than 180 degrees each and 360 degrees together.
// Then only one of them reaches or passes the half circle through the first corner.
bool Subdivision::is_star(Index cell) const {
  constexpr double behind = -0x1p-10;  // cells of a diagram end at a right angle to rounding
  const Point& center = centers[cell];
  const Point& first = origin(begin_of(cell));
  const auto is_before_half = [&](const Point& p) {
    const Sign side = orientation(center, first, p);
    if (side != Sign::zero) return side == Sign::positive;
    return dot(cross(center, first), cross(center, p)) > 0;
  };
  std::size_t num_turns = 0;
  bool was_before_half = is_before_half(origin(end_of(cell) - 1));
  for (Halfedge h = begin_of(cell); h < end_of(cell); ++h) {
    if (dot(center, origin(h)) < behind || !is_left_turn(center, origin(h), end(h))) return false;
    const bool is_before = is_before_half(origin(h));
    if (is_before && !was_before_half) ++num_turns;
    was_before_half = is_before;
  }
  return num_turns == 1;
}

void Subdivision::find_areas_of_others() {
  for (Index cell = 0; cell < num_cells(); ++cell) {
    if (shapes[cell] == Shape::other) areas_of_others.emplace_back(cell, area_of_rings(cell));
  }
}

double Subdivision::area_of_rings(Index cell) const {
  RegionArea area;
  std::vector<Point> corners_of_ring;
  for (Index ring = cells[cell]; ring < cells[cell + 1]; ++ring) {
    copy_ring(ring, corners_of_ring);
    area.add(corners_of_ring);
  }
  return area.value();
}

double Subdivision::area_of_other(Index cell) const {
  return std::ranges::lower_bound(areas_of_others, cell, {}, &std::pair<Index, double>::first)
      ->second;
}

void Subdivision::find_shapes(unsigned threads) {
  shapes.resize(num_cells());
  const auto shape_of = [&](Index cell) {
    const Index num_rings = cells[cell + 1] - cells[cell];
    if (num_rings == 0) return Shape::empty;
    if (num_rings > 1) return Shape::other;
    if (is_convex(cell)) return Shape::convex;
    return is_star(cell) ? Shape::star : Shape::other;
  };
  system::parallel_for(threads, num_cells(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t c = begin; c < end; ++c) {
                           shapes[c] = shape_of(static_cast<Index>(c));
                         }
                       });
  is_closed = !corners.empty() && std::ranges::find(twins, no_index) == twins.end() &&
              std::ranges::find(shapes, Shape::other) == shapes.end();
  find_areas_of_others();
}

}  // namespace rondel::overlay
