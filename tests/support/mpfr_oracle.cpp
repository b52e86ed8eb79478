// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "support/mpfr_oracle.h"

#include <cstddef>

namespace rondel::test {

RealVector minus(const RealVector& a, const RealVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Real dot(const RealVector& a, const RealVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RealVector cross(const RealVector& a, const RealVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

namespace {

RealVector plus(const RealVector& a, const RealVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

RealVector times(const Real& s, const RealVector& v) { return {s * v[0], s * v[1], s * v[2]}; }

Real length(const RealVector& v) { return sqrt(dot(v, v)); }

// The sum over the arcs of weight(n x n', n.n') times n x n'.
template <class F>
RealVector sum_of_poles(const std::vector<RealVector>& ring, F weight) {
  RealVector sum;
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const RealVector& next = ring[(j + 1) % ring.size()];
    const RealVector pole = cross(ring[j], next);
    sum = plus(sum, times(weight(pole, dot(ring[j], next)), pole));
  }
  return sum;
}

}  // namespace

RealVector to_real(const Point& p) { return {Real(p.x), Real(p.y), Real(p.z)}; }

std::optional<RealVector> normalized(const RealVector& v) {
  const Real size = length(v);
  if (size.is_zero()) return std::nullopt;
  return RealVector{v[0] / size, v[1] / size, v[2] / size};
}

double distance_in_ulps(const Point& p, const RealVector& v) {
  return (length(minus(to_real(p), v)) * Real(0x1p53)).rounded();
}

DualOracle::DualOracle(const Triangulation& triangulation, std::span<const Point> sites)
    : triangulation_(triangulation) {
  const RealVector center = to_real(triangulation.sphere().center);
  for (const Point& p : sites) {
    const RealVector v = minus(to_real(p), center);
    places_.push_back(triangulation.model() == Model::projected ? normalized(v).value() : v);
  }
}

std::optional<RealVector> DualOracle::circumcenter(const Triple& face) const {
  const RealVector& a = places_[face[0]];
  return normalized(cross(minus(places_[face[1]], a), minus(places_[face[2]], a)));
}

std::vector<RealVector> DualOracle::ring(const Cells& cells, Index site) const {
  std::vector<RealVector> result;
  for (auto j = cells.rings.offsets[site]; j < cells.rings.offsets[site + 1]; ++j) {
    const Index position = cells.rings.values[j];
    std::optional<RealVector> exact;
    if (position < triangulation_.num_faces()) {
      exact = circumcenter(triangulation_.faces()[position]);
    }
    result.push_back(exact ? *exact : normalized(to_real(cells.points[position])).value());
  }
  return result;
}

// The excess of the triangles between a point q and the arcs (van Oosterom and Strackee, IEEE
// Trans. Biomed. Eng. 30, 1983). With q along the vector area all of them are well shaped.
Real polygon_area(const std::vector<RealVector>& ring) {
  const auto q = normalized(sum_of_poles(ring, [](const auto&, const auto&) { return Real(1); }));
  if (!q) return 0;
  Real area;
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const RealVector& n = ring[j];
    const RealVector& next = ring[(j + 1) % ring.size()];
    const Real volume = dot(*q, cross(n, next));
    area = area + Real(2) * atan2(volume, Real(1) + dot(*q, n) + dot(*q, next) + dot(n, next));
  }
  return area;
}

std::optional<RealVector> polygon_centroid(const std::vector<RealVector>& ring) {
  return normalized(sum_of_poles(ring, [](const RealVector& pole, const Real& cosine) {
    const Real sine = length(pole);
    return sine.is_zero() ? Real(1) : atan2(sine, cosine) / sine;
  }));
}

}  // namespace rondel::test
