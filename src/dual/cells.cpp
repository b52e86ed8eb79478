// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cell of a vertex is the ring of the circumcenters of its faces.

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "blocks/prefetch.h"
#include "dual/arc_points.h"
#include "dual/great_circle.h"
#include "dual/parts.h"
#include "dual/ring_walk.h"
#include "rondel/diagram.h"

namespace rondel {
namespace {

using blocks::prefetch;
using blocks::prefetch_distance;
using blocks::prefetch_to_write;
using dual::ArcPoint;

// Positions in the rings: the faces and arc points around each site, summed.
std::vector<std::uint64_t> ring_offsets(const Triangulation& triangulation,
                                        const dual::SplitSites& sites,
                                        std::span<const ArcPoint> arc_points) {
  const auto order = sites.order();
  std::vector<Index> sizes(order.size(), 0);
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    for (const Index rank : sites.corners(f)) ++sizes[rank];
  }
  // A ring leaves a face across the edge that ends at its site, so the halfedge's head counts it.
  for (const ArcPoint& p : arc_points) {
    ++sizes[sites.corners(p.halfedge / 3)[dual::previous_corner(p.halfedge % 3)]];
  }
  std::vector<std::uint64_t> offsets(triangulation.num_sites() + 1, 0);
  for (std::size_t k = 0; k < order.size(); ++k) offsets[order[k] + 1] = sizes[k];
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

Cells surface_cells(const Triangulation& triangulation, const dual::SplitSites& sites,
                    std::vector<dual::FaceMeasure>& measures) {
  Cells result;
  result.points = dual::circumcenters(triangulation, sites, measures);
  const auto arc_points = dual::add_arc_points(triangulation, sites, result.points);
  result.offsets = ring_offsets(triangulation, sites, arc_points);
  result.rings.resize(result.offsets.back());
  const auto order = sites.order();
  Index next = 0;  // the rank that the faces have not come to yet
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    for (const Index rank : sites.corners(f)) {
      if (rank != next) continue;
      ++next;
      if (rank + 2 * prefetch_distance < order.size()) {
        prefetch(&result.offsets[order[rank + 2 * prefetch_distance]]);
        const Index ahead = order[rank + prefetch_distance];
        prefetch_to_write(&result.rings[result.offsets[ahead]]);
        prefetch_to_write(&result.rings[result.offsets[ahead + 1] - 1]);
      }
      const Index site = order[rank];
      write_ring(triangulation, arc_points, site, f, result.rings.data() + result.offsets[site]);
    }
  }
  return result;
}

}  // namespace

Cells dual::cells(const Triangulation& triangulation, const SplitSites& sites,
                  std::vector<FaceMeasure>& measures) {
  return triangulation.dimension() == 2 ? surface_cells(triangulation, sites, measures)
                                        : great_circle_cells(triangulation, sites);
}

Cells cells(const Triangulation& triangulation, std::span<const Point> sites) {
  std::vector<dual::FaceMeasure> measures;
  return dual::cells(triangulation, dual::SplitSites(triangulation, sites), measures);
}

}  // namespace rondel
