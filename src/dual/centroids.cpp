// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Centers of mass of cells. The integral of the position over a spherical polygon is
//
//     M = 1/2 sum over the arcs of  t / sin(t) n x n',   t the length of the arc from n to n'.
//
// In small cells the sum of n x n' cancels. With offsets d = n - q it equals the sum of d x d',
// and what remains is the sum of (t / sin(t) - 1) n x n', where n x n' = q x (d' - d) + d x d'.

#include <cmath>

#include "dual/arc_excess.h"
#include "dual/local_ring.h"
#include "dual/parts.h"
#include "rondel/diagram.h"

namespace rondel {
namespace {

using dual::LocalRing;
using dual::RingPoint;
using dual::Vec;

// n - q. With r = q x n, the part across q is r x q and the part along q is
// q.n - 1 = -|r|^2 / (1 + q.n).
Vec offset_from_origin(const Vec& q, const RingPoint& p) {
  if (p.cosine_plus_1 < 1) return cross(p.r, q) - (2 - p.cosine_plus_1) * q;
  return cross(p.r, q) - (dot(p.r, p.r) / p.cosine_plus_1) * q;
}

Point centroid_of(const LocalRing& ring) {
  const Vec& q = ring.origin;
  Vec moment{0, 0, 0};
  Vec sum{0, 0, 0};
  double perimeter = 0;
  Vec last = offset_from_origin(q, ring.points.back());
  for (const RingPoint& p : ring.points) {
    const Vec d = offset_from_origin(q, p);
    const Vec step = d - last;
    const Vec flat = cross(last, d);
    const Vec pole = cross(q, step) + flat;
    const double chord = norm(step);
    const double sine = norm(pole);
    moment = moment + flat + dual::arc_excess(sine, 1 - 0.5 * chord * chord) * pole;
    sum = sum + q + d;
    perimeter += chord;
    last = d;
  }
  // Where a thin cell's moment drowns in rounding errors, the middle of its points is better. Some
  // cells have no area at all: weighted sites on a flat part of the hull.
  const double noise = 8 * perimeter * (ring.error + 0x1p-52 * perimeter);
  const bool is_thin = dot(moment, moment) <= noise * noise;
  return exact::to_point(normalized(is_thin ? sum : moment));
}

}  // namespace

std::vector<Point> dual::centroids(const Triangulation& triangulation, const SplitSites& sites) {
  if (triangulation.dimension() < 2) return great_circle_centroids(triangulation, sites);
  std::vector<Point> result(triangulation.num_sites());
  measure_cells(triangulation, sites, cells(triangulation, sites, nullptr), centroid_of, result);
  return result;
}

}  // namespace rondel
