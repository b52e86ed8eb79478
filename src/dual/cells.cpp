// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cell of a vertex is the ring of the circumcenters of its faces.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "dual/local_ring.h"
#include "dual/parts.h"
#include "dual/ring_walk.h"
#include "rondel/diagram.h"
#include "system/large_arrays.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using dual::ArcPoint;
using system::prefetch;
using system::prefetch_distance;
using system::prefetch_to_write;

// Positions in the rings: the faces and arc points around each site, summed.
std::vector<std::uint64_t> ring_offsets(const Triangulation& triangulation,
                                        const dual::SplitSites& sites,
                                        std::span<const ArcPoint> arc_points) {
  const auto order = sites.order();
  auto offsets = system::large_vector<std::uint64_t>(triangulation.num_sites() + 1);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k + prefetch_distance < order.size()) {
      prefetch_to_write(&offsets[order[k + prefetch_distance] + 1]);
    }
    offsets[order[k] + 1] = sites.degree(static_cast<Index>(k));
  }
  // A ring leaves a face across the edge that ends at its site, so the halfedge's head counts it.
  const auto faces = triangulation.faces();
  for (const ArcPoint& p : arc_points) {
    ++offsets[faces[p.halfedge / 3][dual::previous_corner(p.halfedge % 3)] + 1];
  }
  system::sum_counts(offsets);
  return offsets;
}

// Writes rings and areas for ranges of ranks.
class DiagramWriter {
 public:
  DiagramWriter(const Triangulation& triangulation, const dual::SplitSites& sites, Cells& cells)
      : faces_(triangulation.faces()),
        neighbors_(triangulation.neighbors()),
        sites_(sites),
        rings_(cells.rings),
        localize_(triangulation, sites, cells) {}

  void write(std::size_t begin, std::size_t end, std::span<const ArcPoint> arc_points,
             const dual::Kites* kites, double* areas, std::size_t num_whole) {
    const auto order = sites_.order();
    for (std::size_t k = begin; k < end; ++k) {
      if (k + 2 * prefetch_distance < end) {
        prefetch(&rings_.offsets[order[k + 2 * prefetch_distance]]);
        const Index ahead = order[k + prefetch_distance];
        prefetch_to_write(&rings_.values[rings_.offsets[ahead]]);
        prefetch_to_write(&rings_.values[rings_.offsets[ahead + 1] - 1]);
        if (areas != nullptr) prefetch_to_write(&areas[ahead]);
        const Index face = sites_.first_face(static_cast<Index>(k + 2 * prefetch_distance));
        prefetch(&faces_[face]);
        prefetch(&neighbors_[face]);
        if (kites != nullptr) prefetch(&kites[face]);
      }
      const auto rank = static_cast<Index>(k);
      const double area = write_ring(rank, arc_points, kites);
      if (areas == nullptr || order[k] >= num_whole) continue;
      areas[order[k]] = area > 0 ? area : careful_area(localize_, rank);
    }
  }

 private:
  // visit(f, i) for the faces around a vertex, which is their corner i, counterclockwise. The
  // number of steps is known, so that the next turn can begin before the last one has come to its
  // end.
  template <class Visit>
  void turn(Index rank, const Visit& visit) const {
    const Index site = sites_.order()[rank];
    Index f = sites_.first_face(rank);
    for (Index left = sites_.degree(rank); left > 0; --left) {
      const Index i = dual::corner_of(faces_[f], site);
      visit(f, i);
      f = neighbors_[f][dual::next_corner(i)];
    }
  }

  // Returns the sum of the kites, nan where one of them is; 0 without kites.
  double write_ring(Index rank, std::span<const ArcPoint> arc_points, const dual::Kites* kites) {
    Index* out = &rings_.values[rings_.offsets[sites_.order()[rank]]];
    double area = 0;
    if (arc_points.empty() && kites == nullptr) {
      turn(rank, [&](Index f, Index) { *out++ = f; });
    } else if (arc_points.empty()) {
      turn(rank, [&](Index f, Index i) {
        *out++ = f;
        area += kites[f][i];
      });
    } else {
      turn(rank, [&](Index f, Index i) {
        *out++ = f;
        const Index across = 3 * f + dual::next_corner(i);
        const auto p = std::ranges::lower_bound(arc_points, across, {}, &ArcPoint::halfedge);
        if (p != arc_points.end() && p->halfedge == across) *out++ = p->point;
        if (kites != nullptr) area += kites[f][i];
      });
    }
    return area;
  }

  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  const dual::SplitSites& sites_;
  CompressedRows<Index>& rings_;
  dual::RingLocalizer localize_;
};

Cells surface_cells(const Triangulation& triangulation, const dual::SplitSites& sites,
                    std::vector<double>* areas, std::size_t num_whole) {
  Cells result;
  dual::FaceKites kites;
  const bool with_kites = sites.is_projected();
  result.points = dual::circumcenters(triangulation, sites, with_kites ? &kites : nullptr);
  std::vector<ArcPoint> arc_points;
  if (!with_kites || kites.has_careful) {
    arc_points = dual::add_arc_points(triangulation, sites, result.points);
  }
  result.rings.offsets = ring_offsets(triangulation, sites, arc_points);
  result.rings.values = system::large_vector<Index>(result.rings.offsets.back());
  if (areas != nullptr) *areas = system::large_vector<double>(triangulation.num_sites());
  system::parallel_for(sites.threads(), sites.order().size(), dual::parallel_grain,
                       [&](std::size_t begin, std::size_t end) {
                         DiagramWriter(triangulation, sites, result)
                             .write(begin, end, arc_points, kites.of.get(),
                                    areas == nullptr ? nullptr : areas->data(), num_whole);
                       });
  return result;
}

}  // namespace

Cells dual::cells(const Triangulation& triangulation, const SplitSites& sites,
                  std::vector<double>* areas) {
  if (triangulation.dimension() == 2)
    return surface_cells(triangulation, sites, areas, triangulation.num_sites());
  if (areas != nullptr) *areas = great_circle_areas(triangulation, sites);
  return great_circle_cells(triangulation, sites);
}

std::vector<double> dual::areas_within(const Triangulation& surface, std::size_t num_whole) {
  std::vector<double> areas;
  surface_cells(surface, SplitSites(surface, 1), &areas, num_whole);
  areas.resize(num_whole);
  return areas;
}

}  // namespace rondel
