// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/local_ring.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "dual/face_normal.h"
#include "dual/ring_walk.h"
#include "rondel/error.h"

namespace rondel::dual {
namespace {

// Below this square of the sine at the site, the cross product of rounded
// offsets has lost more than four bits and is computed in double-double.
constexpr double smallest_sine_squared = 0x1p-8;
// Offsets of places known to 2^-100 have a relative error of u/2 down to this square.
constexpr double smallest_ring_square = 0x1p-90;
// Squares of offsets below this may underflow in products.
constexpr double underflow_square = 0x1p-200;
// 4u.
constexpr double circumcenter_error = 0x1p-51;

}  // namespace

const LocalRing& RingLocalizer::operator()(Index rank) {
  const Index site = sites_.order()[rank];
  const std::span<const Index> ring = cells_.rings[site];
  ring_.points.clear();
  ring_.error = 0;
  if (sites_.is_projected()) {
    localize_around_site(rank, ring);
    // An arc may pass so near to the site that only relatively right points tell its side.
    if (ring_.error > 0) localize_large(ring);
  } else if (is_small(ring)) {
    localize_small(rank, ring);
  } else {
    localize_large(ring);
  }
  return ring_;
}

RingPoint RingLocalizer::global_point(Index position) const {
  const Vec n = point(position);
  return ring_point(cross(ring_.origin, n), dot(ring_.origin, n));
}

// The offset to a neighbor, rounded, and its square.
struct RingLocalizer::Spoke {
  Index rank;
  Vec v;
  double square;
};

inline RingLocalizer::Spoke RingLocalizer::spoke(const exact::SplitPoint& a, Index b) const {
  const exact::SplitPoint& p = sites_[b];
  const Vec v = (to_vector(p.hi) - to_vector(a.hi)) + (to_vector(p.lo) - to_vector(a.lo));
  return {b, v, dot(v, v)};
}

void RingLocalizer::localize_around_site(Index rank, std::span<const Index> ring) {
  const exact::SplitPoint& a = sites_[rank];
  ring_.origin = to_vector(a.hi);
  ring_.points.resize(ring.size());
  Spoke last{no_index, {}, 0};
  for (std::size_t j = 0; j < ring.size(); ++j) {
    if (!is_face(ring[j])) {
      ring_.points[j] = global_point(ring[j]);
      continue;
    }
    const Triple& face = sites_.corners(ring[j]);
    if (last.rank == no_index) last = spoke(a, face[next_corner(corner_of(face, rank))]);
    const Spoke next = spoke(a, third_corner(face, rank, last.rank));
    ring_.points[j] = star_point(rank, last, next, ring[j]);
    last = next;
  }
}

inline RingPoint RingLocalizer::star_point(Index rank, const Spoke& b, const Spoke& c,
                                           Index position) {
  const Vec n = cross(b.v, c.v);
  const double n2 = dot(n, n);
  if (n2 < smallest_sine_squared * (b.square * c.square) ||
      std::min(b.square, c.square) < smallest_ring_square) {
    return careful_star_point(rank, b.rank, c.rank, position);
  }
  const double inverse = 1 / std::sqrt(n2);
  const double half = 0.5 * inverse;
  return ring_point((half * b.square) * c.v - (half * c.square) * b.v,
                    inverse * dot(ring_.origin, n));
}

// Flat triangles and sites very near to each other. Where C is nearly B, N = B x D and the form of
// r with D do not cancel. Without a proved double-double normal, the rounded one is wrong by u over
// the sine between its factors, and the circumcenter itself by u, which is u / |r|
// relatively, with |r| = |D| / (2 sin(B, C)): the better one is taken.
RingPoint RingLocalizer::careful_star_point(Index rank, Index b, Index c, Index position) {
  const Vec to_b = sites_.difference(rank, b);
  const Vec to_c = sites_.difference(rank, c);
  const Vec d = sites_.difference(b, c);
  const double b2 = dot(to_b, to_b);
  const double c2 = dot(to_c, to_c);
  const double d2 = dot(d, d);
  const bool is_near = 4 * d2 < b2;
  Vec n = split_cross(sites_.offset(rank, b), sites_.offset(rank, c)).rounded();
  if (!is_accurate(b2, c2, dot(n, n), true)) {
    n = cross(to_b, is_near ? d : to_c);
    const double n2 = dot(n, n);
    const double sine2 = n2 / (b2 * (is_near ? d2 : c2));
    if (std::min({b2, c2, d2}) < underflow_square || d2 * b2 * c2 > 4 * n2 * sine2) {
      ring_.error = circumcenter_error;
      return global_point(position);
    }
  }
  const double inverse = 1 / std::sqrt(dot(n, n));
  const Vec r = is_near ? b2 * d - dot(d, to_b + to_c) * to_b : b2 * to_c - c2 * to_b;
  return ring_point((0.5 * inverse) * r, inverse * dot(ring_.origin, n));
}

// Whether all points are within 41 degrees of the first one, so that no arc between two is over 90.
bool RingLocalizer::is_small(std::span<const Index> ring) const {
  const Vec first = point(ring[0]);
  return std::ranges::all_of(ring, [&](Index position) {
    return is_face(position) && dot(first, point(position)) > 0.75;
  });
}

// One corner of the walk around a site: the face's normal N = B x C.
struct RingLocalizer::Wedge {
  Offset to_b;
  Offset to_c;
  SplitNormal normal;
  double squared;  // |N|^2, or 0 where N is not proved to be accurate

  // sin^2 of the angle between B and C.
  [[nodiscard]] double sine_squared() const {
    return squared / (dot(to_b.hi, to_b.hi) * dot(to_c.hi, to_c.hi));
  }
};

RingLocalizer::Wedge RingLocalizer::wedge(Index rank, Index position) const {
  const Triple& face = sites_.corners(position);
  const Index corner = corner_of(face, rank);
  Wedge w{sites_.offset(rank, face[next_corner(corner)]),
          sites_.offset(rank, face[previous_corner(corner)]),
          {},
          0};
  w.normal = split_cross(w.to_b, w.to_c);
  const Vec n = w.normal.rounded();
  const double n2 = dot(n, n);
  if (is_accurate(dot(w.to_b.hi, w.to_b.hi), dot(w.to_c.hi, w.to_c.hi), n2, false)) w.squared = n2;
  return w;
}

// n' - n from one face to the next. It turns n about C by the angle with the sine
// s = C det(B, C, D) / (|N| |N'|), C and s taken as vectors: n' - n = s x n - n |s|^2 / (1 + cos).
// The determinant is right to 2^-100 |B||C|^2|D|, hence s to 2^-100 divided by both sines;
// where that is not below u/4 the difference of the circumcenters is better.
Vec RingLocalizer::arc_step(const Wedge& from, const Wedge& to, const Vec& n,
                            const Vec& next) const {
  const double sines = from.sine_squared() * to.sine_squared();
  if (!(sines > 0x1p-90)) return next - n;
  const double volume = split_dot(from.normal, to.to_c);
  const Vec s = (volume / (std::sqrt(from.squared) * std::sqrt(to.squared))) * to.to_b.hi;
  const double s2 = std::min(dot(s, s), 1.0);
  return cross(s, n) - (s2 / (1 + std::sqrt(1 - s2))) * n;
}

// The offsets d = n - q are sums of steps along the ring.
void RingLocalizer::localize_small(Index rank, std::span<const Index> ring) {
  ring_.origin = point(ring[0]);
  Vec d{0, 0, 0};
  Wedge last = wedge(rank, ring[0]);
  ring_.points.push_back({d, 2});
  for (std::size_t j = 1; j < ring.size(); ++j) {
    const Wedge next = wedge(rank, ring[j]);
    d = d + arc_step(last, next, point(ring[j - 1]), point(ring[j]));
    ring_.points.push_back(ring_point(cross(ring_.origin, d), 1 - 0.5 * dot(d, d)));
    last = next;
  }
}

// q is the direction of the vector area S, the sum of n x n' over the ring. A convex cell lies on
// the positive side of each arc's pole n x n', so q.n >= 0 for all its points. In a cell so thin
// that S is noise, q is the middle of the points, which does not vanish there.
void RingLocalizer::localize_large(std::span<const Index> ring) {
  constexpr double noise = 0x1p-40;
  Vec area{0, 0, 0};
  Vec sum{0, 0, 0};
  for (std::size_t j = 0; j < ring.size(); ++j) {
    sum = sum + point(ring[j]);
    area = area + cross(point(ring[j]), point(ring[(j + 1) % ring.size()]));
  }
  ring_.origin = normalized(dot(area, area) > noise * noise ? area : sum);
  ring_.points.clear();
  for (const Index position : ring) ring_.points.push_back(global_point(position));
}

}  // namespace rondel::dual
