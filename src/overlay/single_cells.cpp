// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/single_cells.h"

#include <algorithm>
#include <utility>

#include "system/distinct.h"

namespace rondel::overlay {

std::vector<Point> points_of_ring(const CellRings& cells, std::uint64_t ring) {
  std::vector<Point> points;
  points.reserve(cells.rings[ring + 1] - cells.rings[ring]);
  for (const Index corner : cells.corners_of(ring)) points.push_back(cells.points[corner]);
  return points;
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

}  // namespace rondel::overlay
