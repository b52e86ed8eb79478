// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The ring of a cell relative to a point q on the sphere, without the cancellation that absolute
// unit vectors suffer in small cells: of each point n
//
//     r = q x n  and  1 + q.n.
//
// Projected: q is the site a, which lies inside its cell. On the unit sphere a.B = -|B|^2/2
// exactly, so that (with N = B x C and D = C - B)
//
//     r = (|B|^2 C - |C|^2 B) / (2|N|) = (|B|^2 D - (D.(B+C)) B) / (2|N|),   q.n = a.N / |N|.
//
// Weighted: the site may lie outside of its cell, q is a point of the ring. The
// ring is walked along its arcs: with neighbors B, C, D in order around a,
//
//     (B x C) x (C x D) = C det(B, C, D),
//
// so the arcs come from determinants that double-double arithmetic gets right.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dual/face_normal.h"
#include "dual/split_sites.h"
#include "rondel/diagram.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::dual {

using system::prefetch;
using system::prefetch_distance;
using system::prefetch_to_write;

struct RingPoint {
  Vec r;                 // q x n
  double cosine_plus_1;  // 1 + q.n
};

struct LocalRing {
  Vec origin{};  // q
  std::vector<RingPoint> points;
  double error = 0;  // of r, beyond the relative rounding errors
};

// 1 + cosine for a unit vector at this cosine from q whose cross product with q is r.
inline RingPoint ring_point(const Vec& r, double cosine) {
  return {r, cosine > 0 ? 1 + cosine : dot(r, r) / (1 - cosine)};
}

// Makes the local rings of the cells of a triangulation of dimension 2, one after the other.
class RingLocalizer {
 public:
  RingLocalizer(const Triangulation& triangulation, const SplitSites& sites, const Cells& cells)
      : num_faces_(triangulation.num_faces()), sites_(sites), cells_(cells) {}

  // Precondition: the cell of the vertex of this rank is not empty. The result lives until the next
  // call.
  const LocalRing& operator()(Index rank);

 private:
  void localize_around_site(Index rank, std::span<const Index> ring);
  struct Spoke;
  [[nodiscard]] Spoke spoke(const exact::SplitPoint& a, Index b) const;
  RingPoint star_point(Index rank, const Spoke& b, const Spoke& c, Index position);
  RingPoint careful_star_point(Index rank, Index b, Index c, Index position);
  [[nodiscard]] RingPoint global_point(Index position) const;

  void localize_small(Index rank, std::span<const Index> ring);
  struct Wedge;
  [[nodiscard]] Wedge wedge(Index rank, Index position) const;
  [[nodiscard]] Vec arc_step(const Wedge& from, const Wedge& to, const Vec& n,
                             const Vec& next) const;
  void localize_large(std::span<const Index> ring);
  [[nodiscard]] bool is_small(std::span<const Index> ring) const;

  [[nodiscard]] Vec point(Index position) const { return to_vector(cells_.points[position]); }
  [[nodiscard]] bool is_face(Index position) const { return position < num_faces_; }

  std::size_t num_faces_;
  const SplitSites& sites_;
  const Cells& cells_;
  LocalRing ring_;
};

// result[site] = measure(local ring) for the cell of every vertex, in parallel and in the order of
// the ranks. The rings and results lie in the order of the input, so they are asked for ahead.
template <class T>
void measure_cells(const Triangulation& triangulation, const SplitSites& sites, const Cells& cells,
                   T (*measure)(const LocalRing&), std::vector<T>& result) {
  const auto order = sites.order();
  const auto measure_range = [&](std::size_t begin, std::size_t end) {
    RingLocalizer localize(triangulation, sites, cells);
    for (std::size_t k = begin; k < end; ++k) {
      if (k + 2 * prefetch_distance < end) {
        prefetch(&cells.rings.offsets[order[k + 2 * prefetch_distance]]);
        const Index ahead = order[k + prefetch_distance];
        prefetch(&cells.rings.values[cells.rings.offsets[ahead]]);
        prefetch(&cells.rings.values[cells.rings.offsets[ahead + 1] - 1]);
        prefetch_to_write(&result[ahead]);
      }
      result[order[k]] = measure(localize(static_cast<Index>(k)));
    }
  };
  system::parallel_for(sites.threads(), order.size(), parallel_grain, measure_range);
}

}  // namespace rondel::dual
