// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cell of a vertex is the ring of the circumcenters of its faces.

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "dual/arc_points.h"
#include "dual/circumcenters.h"
#include "dual/great_circle.h"
#include "dual/prefetch.h"
#include "dual/ring_walk.h"
#include "rondel/diagram.h"

namespace rondel {
namespace {

using dual::ArcPoint;
using dual::prefetch;
using dual::prefetch_distance;

// Positions in the rings: offsets[i + 1] counts the faces and arc points around i, then sums.
std::vector<std::uint64_t> ring_offsets(const Triangulation& triangulation,
                                        std::span<const ArcPoint> arc_points) {
  std::vector<std::uint64_t> offsets(triangulation.num_sites() + 1, 0);
  const auto faces = triangulation.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (f + prefetch_distance < faces.size()) {
      for (const Index v : faces[f + prefetch_distance]) prefetch(&offsets[v + 1]);
    }
    for (const Index v : faces[f]) ++offsets[v + 1];
  }
  // A ring leaves a face across the edge that ends at its site, so the halfedge's head counts it.
  for (const ArcPoint& p : arc_points) {
    const Triple& face = faces[p.halfedge / 3];
    ++offsets[face[dual::previous_corner(p.halfedge % 3)] + 1];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  return offsets;
}

// Writes the ring of `site` from face `first` on, counterclockwise.
void write_ring(const Triangulation& triangulation, std::span<const ArcPoint> arc_points,
                Index site, Index first, Index* ring) {
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  Index f = first;
  do {
    *ring++ = f;
    const Index i = dual::next_corner(dual::corner_of(faces[f], site));
    if (!arc_points.empty()) {
      const auto p = std::ranges::lower_bound(arc_points, 3 * f + i, {}, &ArcPoint::halfedge);
      if (p != arc_points.end() && p->halfedge == 3 * f + i) *ring++ = p->point;
    }
    f = neighbors[f][i];
  } while (f != first);
}

Cells surface_cells(const Triangulation& triangulation, const dual::SplitSites& sites) {
  Cells result;
  result.points = dual::circumcenters(triangulation, sites);
  const auto arc_points = dual::add_arc_points(triangulation, sites, result.points);
  result.offsets = ring_offsets(triangulation, arc_points);
  result.rings.resize(result.offsets.back());
  std::vector<bool> is_written(triangulation.num_sites(), false);
  const auto faces = triangulation.faces();
  for (Index f = 0; f < faces.size(); ++f) {
    if (f + 2 * prefetch_distance < faces.size()) {
      for (const Index v : faces[f + 2 * prefetch_distance]) prefetch(&result.offsets[v]);
      for (const Index v : faces[f + prefetch_distance]) prefetch(&result.rings[result.offsets[v]]);
    }
    for (const Index v : faces[f]) {
      if (is_written[v]) continue;
      is_written[v] = true;
      write_ring(triangulation, arc_points, v, f, result.rings.data() + result.offsets[v]);
    }
  }
  return result;
}

}  // namespace

Cells cells(const Triangulation& triangulation, std::span<const Point> sites) {
  const dual::SplitSites split_sites(triangulation, sites);
  return triangulation.dimension() == 2 ? surface_cells(triangulation, split_sites)
                                        : dual::great_circle_cells(triangulation, split_sites);
}

}  // namespace rondel
