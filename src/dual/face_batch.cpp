// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/face_batch.h"

#include <algorithm>
#include <cmath>

#include "dual/face_normal.h"
#include "dual/split_sites.h"
#include "system/wide_vectors.h"

namespace rondel::dual {
namespace {

using exact::SplitPoint;

// Faces at a time. What the loops read and write lies in arrays of one number each, which
// the first cache holds.
constexpr std::size_t batch_size = 64;
constexpr double careful = careful_kites[0];
using Numbers = double[batch_size];

struct Vectors {
  alignas(64) Numbers x;
  alignas(64) Numbers y;
  alignas(64) Numbers z;

  void set(std::size_t j, const Point& p) {
    x[j] = p.x;
    y[j] = p.y;
    z[j] = p.z;
  }
  [[nodiscard]] Vec operator[](std::size_t j) const { return {x[j], y[j], z[j]}; }
};

struct SplitVectors {
  Vectors hi;
  Vectors lo;

  void set(std::size_t j, const SplitPoint& p) {
    hi.set(j, p.hi);
    lo.set(j, p.lo);
  }
  [[nodiscard]] SplitPoint operator[](std::size_t j) const {
    return {to_point(hi[j]), to_point(lo[j])};
  }
};

// 2 atan(t) for |t| <= largest_tangent: the first term left out is below 2^-59 of the first.
constexpr double largest_tangent = 0x1p-4;
inline double twice_arctangent(double t) {
  const double x = t * t;
  return 2 * t *
         (1 +
          x * (-1.0 / 3 +
               x * (1.0 / 5 + x * (-1.0 / 7 + x * (1.0 / 9 + x * (-1.0 / 11 + x * (1.0 / 13)))))));
}

// Offsets of places known to 2^-100 have a relative error of u/2 down to this square.
constexpr double smallest_square = 0x1p-90;

inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }

struct FaceBatch {
  SplitVectors a, b, c;
  Vectors normals;
  alignas(64) Numbers lengths;
  alignas(64) Numbers accurate;  // 1 or 0
  Vectors kites;
};

// See unit_normal() for the error.
inline void find_normal(FaceBatch& batch, std::size_t j, bool is_projected) {
  const SplitPoint a = batch.a[j];
  const Offset b = offset(a, batch.b[j]);
  const Offset c = offset(a, batch.c[j]);
  const Vec n = split_cross(b, c).rounded();
  const double n2 = dot(n, n);
  const double length = std::sqrt(n2);
  batch.normals.x[j] = n.x / length;
  batch.normals.y[j] = n.y / length;
  batch.normals.z[j] = n.z / length;
  batch.lengths[j] = length;
  batch.accurate[j] = is_accurate(dot(b.hi, b.hi), dot(c.hi, c.hi), n2, is_projected) ? 1.0 : 0.0;
}

// The tangent of half the area of the triangle between an end of an edge, its middle and the
// circumcenter; see docs/theory/areas.md.
inline double half_tangent(double square, double opposite_dot, double inverse, double cosine) {
  const double k = std::sqrt(1 - 0.25 * square);
  return square * opposite_dot * (0.25 * inverse) / ((1 + k) * (k + cosine));
}

inline void find_kites(FaceBatch& batch, std::size_t j) {
  const SplitPoint a = batch.a[j];
  const Offset b = offset(a, batch.b[j]);
  const Offset c = offset(a, batch.c[j]);
  const Vec to_b = b.hi + b.lo;
  const Vec to_c = c.hi + c.lo;
  const Vec d = (c.hi - b.hi) + (c.lo - b.lo);
  const double b2 = dot(to_b, to_b);
  const double c2 = dot(to_c, to_c);
  const double d2 = dot(d, d);
  const double inverse = 1 / batch.lengths[j];
  const double cosine = dot(to_vector(a.hi), batch.normals[j]);
  const double ta = half_tangent(d2, dot(to_b, to_c), inverse, cosine);
  const double tb = half_tangent(c2, -dot(to_b, d), inverse, cosine);
  const double tc = half_tangent(b2, dot(to_c, d), inverse, cosine);
  const double ea = twice_arctangent(ta);
  const double eb = twice_arctangent(tb);
  const double ec = twice_arctangent(tc);
  const double tangent = larger(larger(std::abs(ta), std::abs(tb)), std::abs(tc));
  const double reasons = (1 - batch.accurate[j]) + (cosine > near_cosine ? 0.0 : 1.0) +
                         (tangent <= largest_tangent ? 0.0 : 1.0) +
                         (smaller(smaller(b2, c2), d2) >= smallest_square ? 0.0 : 1.0);
  batch.kites.x[j] = reasons > 0 ? careful : eb + ec;
  batch.kites.y[j] = reasons > 0 ? careful : ec + ea;
  batch.kites.z[j] = reasons > 0 ? careful : ea + eb;
}

// The places of the corners of `count` faces; the rest of the batch repeats the last one.
void load(const SplitSites& sites, std::size_t begin, std::size_t count, FaceBatch& batch) {
  for (std::size_t j = 0; j < batch_size; ++j) {
    const auto [a, b, c] = sites.corners(static_cast<Index>(begin + std::min(j, count - 1)));
    batch.a.set(j, sites[a]);
    batch.b.set(j, sites[b]);
    batch.c.set(j, sites[c]);
  }
}

void store_normals(const SplitSites& sites, std::size_t begin, const FaceBatch& batch,
                   std::span<Point> points) {
  for (std::size_t j = 0; j < points.size(); ++j) {
    points[j] = to_point(batch.normals[j]);
    if (batch.accurate[j] != 0) continue;
    const auto [a, b, c] = sites.corners(static_cast<Index>(begin + j));
    points[j] = exact_normal(sites, a, b, c).normal;
  }
}

}  // namespace

bool unit_normals(const SplitSites& sites, std::size_t begin, std::span<Point> points,
                  Kites* kites) {
  FaceBatch batch;
  bool result = false;
  const bool is_projected = sites.is_projected();
  for (std::size_t first = 0; first < points.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, points.size() - first);
    load(sites, begin + first, count, batch);
    system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
      for (std::size_t j = 0; j < batch_size; ++j) find_normal(batch, j, is_projected);
    });
    store_normals(sites, begin + first, batch, points.subspan(first, count));
    if (kites == nullptr) continue;
    system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
      for (std::size_t j = 0; j < batch_size; ++j) find_kites(batch, j);
    });
    for (std::size_t j = 0; j < count; ++j) {
      kites[first + j] = {batch.kites.x[j], batch.kites.y[j], batch.kites.z[j]};
      result |= is_careful(kites[first + j]);
    }
  }
  return result;
}

}  // namespace rondel::dual
