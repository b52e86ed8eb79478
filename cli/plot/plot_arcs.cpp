// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_arcs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "globe.h"

namespace rondel::cli {
namespace {

// Returns the arcs between consecutive sites of a ring. If the ring covers less than a half circle,
// it has one gap that is not an edge: the shorter arc across it runs back over all others, so that
// the sum of the arcs is less than 360 degrees.
std::vector<ArcEnds> ring_arcs(std::span<const Index> ring, std::span<const Point> directions) {
  std::vector<ArcEnds> arcs;
  if (ring.size() < 2) return arcs;
  double sum = 0, longest = 0;
  std::size_t gap = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const ArcEnds ends{ring[i], ring[(i + 1) % ring.size()]};
    const double length = angle_between(directions[ends[0]], directions[ends[1]]);
    sum += length;
    // The last one of equal arcs is taken, so that the first arc between two sites stays.
    if (length >= longest) {
      longest = length;
      gap = i;
    }
    arcs.push_back(ends);
  }
  constexpr double rounding = 1e-9;
  const bool has_gap =
      sum < 2 * std::numbers::pi - rounding || longest > std::numbers::pi - rounding;
  if (has_gap) arcs.erase(arcs.begin() + static_cast<std::ptrdiff_t>(gap));
  // Antipodal sites have no shorter arc between them.
  std::erase_if(arcs, [&](const ArcEnds& ends) {
    return angle_between(directions[ends[0]], directions[ends[1]]) > std::numbers::pi - rounding;
  });
  return arcs;
}

}  // namespace

// Each edge is taken from one of its two faces: from the solid one if the other is a ghost face, or
// else from the face with the lower number.
std::vector<ArcEnds> triangulation_arcs(const Triangulation& triangulation,
                                        std::span<const Point> directions) {
  if (triangulation.dimension() < 2) return ring_arcs(triangulation.ring(), directions);
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  std::vector<bool> is_ghost(faces.size());
  for (const Index face : triangulation.ghost_faces()) is_ghost[face] = true;

  std::vector<ArcEnds> arcs;
  arcs.reserve(faces.size() / 2 * 3);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (is_ghost[f]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index across = neighbors[f][i];
      if (f < across || is_ghost[across]) {
        arcs.push_back({faces[f][(i + 1) % 3], faces[f][(i + 2) % 3]});
      }
    }
  }
  return arcs;
}

std::vector<ArcEnds> cell_arcs(const Cells& cells) {
  std::vector<ArcEnds> arcs;
  arcs.reserve(cells.rings.values.size() / 2);
  for (std::size_t cell = 0; cell < cells.rings.size(); ++cell) {
    const std::span<const Index> ring = cells.rings[cell];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      // The cell on the other side has the same edge, from q to p.
      const Index p = ring[i], q = ring[(i + 1) % ring.size()];
      if (p < q && cells.points[p] != cells.points[q]) arcs.push_back({p, q});
    }
  }
  return arcs;
}

std::vector<Point> in_order_of_arcs(std::span<ArcEnds> arcs, std::span<const Point> points) {
  std::vector<Index> numbers(points.size(), no_index);
  std::vector<Point> ordered;
  ordered.reserve(points.size());
  for (ArcEnds& ends : arcs) {
    for (Index& end : ends) {
      Index& number = numbers[end];
      if (number == no_index) {
        number = static_cast<Index>(ordered.size());
        ordered.push_back(points[end]);
      }
      end = number;
    }
  }
  return ordered;
}

double median_spacing(std::span<const ArcEnds> arcs, std::span<const Point> points) {
  // In a Delaunay triangulation the nearest site is a neighbor. Squared lengths have the same order
  // as lengths.
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> nearest(points.size(), none);
  for (const auto& [a, b] : arcs) {
    const double dx = points[a].x - points[b].x, dy = points[a].y - points[b].y;
    const double square = dx * dx + dy * dy;
    nearest[a] = std::min(nearest[a], square);
    nearest[b] = std::min(nearest[b], square);
  }
  std::vector<double> in_front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].z > 0 && nearest[i] < none) in_front.push_back(nearest[i]);
  }
  if (in_front.empty()) return 0;
  const auto middle = in_front.begin() + static_cast<std::ptrdiff_t>(in_front.size() / 2);
  std::ranges::nth_element(in_front, middle);
  return std::sqrt(*middle);
}

}  // namespace rondel::cli
