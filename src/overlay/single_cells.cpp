// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/single_cells.h"

#include <algorithm>
#include <utility>

#include "exact/point_order.h"
#include "system/distinct.h"

namespace rondel::overlay {

std::vector<Point> points_of_ring(const CellRings& cells, std::uint64_t ring) {
  std::vector<Point> points;
  points.reserve(cells.rings[ring + 1] - cells.rings[ring]);
  for (const Index corner : cells.corners_of(ring)) points.push_back(cells.points[corner]);
  return points;
}

void append_ring_of(std::span<const Point> points, CellRings& cells) {
  for (const Point& p : points) {
    cells.corners.push_back(static_cast<Index>(cells.points.size()));
    cells.points.push_back(p);
  }
  cells.end_ring();
}

CellRings one_cell(const CellRings& cells, Index cell) {
  CellRings one;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + std::size_t{1}]; ++r) {
    for (const Index corner : cells.corners_of(r)) {
      one.corners.push_back(static_cast<Index>(one.points.size()));
      one.points.push_back(cells.points[corner]);
    }
    one.end_ring();
  }
  one.end_cell();
  if (cells.is_whole(cell)) one.whole = {0};
  return one;
}

CellRings cells_between(const CellRings& cells, std::size_t first, std::size_t end) {
  CellRings some;
  std::vector<Index> numbers(cells.points.size(), no_index);
  for (std::size_t c = first; c < end; ++c) {
    if (cells.is_whole(c)) some.whole.push_back(static_cast<Index>(c - first));
    for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
      for (const Index corner : cells.corners_of(r)) {
        if (numbers[corner] == no_index) {
          numbers[corner] = static_cast<Index>(some.points.size());
          some.points.push_back(cells.points[corner]);
        }
        some.corners.push_back(numbers[corner]);
      }
      some.end_ring();
    }
    some.end_cell();
  }
  return some;
}

CellRings beyond_cell(CellRings one) {
  for (std::size_t r = 0; r + 1 < one.rings.size(); ++r) {
    std::reverse(one.corners.begin() + static_cast<std::ptrdiff_t>(one.rings[r]),
                 one.corners.begin() + static_cast<std::ptrdiff_t>(one.rings[r + 1]));
  }
  const bool was_empty = one.whole.empty() && one.rings.size() == 1;
  one.whole.clear();
  if (was_empty) one.whole = {0};
  return one;
}

bool has_any(const CellRings& one) { return one.rings.size() > 1 || !one.whole.empty(); }

void append(const CellRings& one, CellRings& all) {
  const auto first = static_cast<Index>(all.points.size());
  const auto begin = all.corners.size();
  all.points.insert(all.points.end(), one.points.begin(), one.points.end());
  for (const Index corner : one.corners) all.corners.push_back(first + corner);
  for (std::size_t r = 1; r < one.rings.size(); ++r) all.rings.push_back(begin + one.rings[r]);
  if (!one.whole.empty()) all.whole.push_back(static_cast<Index>(all.num_cells()));
  all.end_cell();
}

void merge_equal_points(CellRings& cells) {
  system::Distinct<Point> places = system::distinct<Point>(cells.points);
  for (Index& corner : cells.corners) corner = places.numbers[corner];
  cells.points = std::move(places.values);
}

MergedCells::MergedCells(const CellRings& set, std::size_t num_others)
    : set_(set), of_set_(set.points.size(), no_index), known_(others_, num_others) {
  made_.corners.reserve(set.corners.size());
  made_.points.reserve(set.points.size());
}

void MergedCells::append_of_set(Index cell) {
  if (set_.is_whole(cell)) made_.whole.push_back(static_cast<Index>(made_.num_cells()));
  for (std::uint64_t r = set_.cells[cell]; r < set_.cells[cell + std::size_t{1}]; ++r) {
    for (const Index corner : set_.corners_of(r)) {
      if (of_set_[corner] == no_index) {
        of_set_[corner] = static_cast<Index>(made_.points.size());
        made_.points.push_back(set_.points[corner]);
      }
      made_.corners.push_back(of_set_[corner]);
    }
    made_.end_ring();
  }
  made_.end_cell();
}

// Returns the number of a point, and appends the point if it is new.
Index MergedCells::number(const Point& point) {
  const auto near = std::ranges::lower_bound(set_.points, point, exact::is_less);
  const bool is_of_set = near != set_.points.end() && *near == point;
  const auto added = static_cast<Index>(made_.points.size());
  if (is_of_set) {
    Index& known = of_set_[static_cast<std::size_t>(near - set_.points.begin())];
    if (known != no_index) return known;
    known = added;
  } else {
    const Index other = known_.number(point, system::hash_of(point));
    if (other < of_others_.size()) return of_others_[other];
    of_others_.push_back(added);
  }
  made_.points.push_back(point);
  return added;
}

void MergedCells::append(const CellRings& one) {
  std::vector<Index> numbers;
  numbers.reserve(one.points.size());
  for (const Point& point : one.points) numbers.push_back(number(point));
  const std::size_t begin = made_.corners.size();
  for (const Index corner : one.corners) made_.corners.push_back(numbers[corner]);
  for (std::size_t r = 1; r < one.rings.size(); ++r) made_.rings.push_back(begin + one.rings[r]);
  if (!one.whole.empty()) made_.whole.push_back(static_cast<Index>(made_.num_cells()));
  made_.end_cell();
}

void MergedCells::append_by_corners(const CellRings& one) {
  const std::size_t begin = made_.corners.size();
  for (const Index corner : one.corners) made_.corners.push_back(number(one.points[corner]));
  for (std::size_t r = 1; r < one.rings.size(); ++r) made_.rings.push_back(begin + one.rings[r]);
  if (!one.whole.empty()) made_.whole.push_back(static_cast<Index>(made_.num_cells()));
  made_.end_cell();
}

}  // namespace rondel::overlay
