// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Circumcenters, areas and centroids from their definitions, in numbers so long that
// rounding does not matter. Shares no code and no formula with the library.
#pragma once

#include <mpfr.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/triangulation.h"

namespace rondel::test {

// Enough for sites 1e-600 apart: doubles reach from 2^-1074 to 2^1024.
inline constexpr mpfr_prec_t oracle_bits = 4400;

class Real {
 public:
  Real(double value = 0) {  // NOLINT(google-explicit-constructor): numbers mix
    mpfr_init2(value_, oracle_bits);
    mpfr_set_d(value_, value, MPFR_RNDN);
  }
  Real(const Real& other) {
    mpfr_init2(value_, oracle_bits);
    mpfr_set(value_, other.value_, MPFR_RNDN);
  }
  Real& operator=(const Real& other) {
    if (this != &other) mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Real() { mpfr_clear(value_); }

  [[nodiscard]] double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }
  [[nodiscard]] int sign() const { return mpfr_sgn(value_); }
  [[nodiscard]] bool is_zero() const { return mpfr_zero_p(value_) != 0; }

  friend Real operator+(const Real& a, const Real& b) { return binary(mpfr_add, a, b); }
  friend Real operator-(const Real& a, const Real& b) { return binary(mpfr_sub, a, b); }
  friend Real operator*(const Real& a, const Real& b) { return binary(mpfr_mul, a, b); }
  friend Real operator/(const Real& a, const Real& b) { return binary(mpfr_div, a, b); }
  friend Real atan2(const Real& y, const Real& x) { return binary(mpfr_atan2, y, x); }
  friend Real sqrt(const Real& a) {
    Real r;
    mpfr_sqrt(r.value_, a.value_, MPFR_RNDN);
    return r;
  }

 private:
  template <class F>
  static Real binary(F function, const Real& a, const Real& b) {
    Real r;
    function(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }

  mpfr_t value_;
};

using RealVector = std::array<Real, 3>;

RealVector minus(const RealVector& a, const RealVector& b);
Real dot(const RealVector& a, const RealVector& b);
RealVector cross(const RealVector& a, const RealVector& b);

RealVector to_real(const Point& p);
// Empty for the zero vector.
std::optional<RealVector> normalized(const RealVector& v);
// |p - v| in units of 2^-53.
double distance_in_ulps(const Point& p, const RealVector& v);

class DualOracle {
 public:
  DualOracle(const Triangulation& triangulation, std::span<const Point> sites);

  // The unit vector (projected) or the coordinates (weighted) of a site.
  [[nodiscard]] const RealVector& place(Index site) const { return places_[site]; }
  // The unit normal of a face; empty when its corners are collinear.
  [[nodiscard]] std::optional<RealVector> circumcenter(const Triple& face) const;
  // The points of a ring: exact circumcenters; arc points and the normals of collinear faces as
  // they are in `cells`.
  [[nodiscard]] std::vector<RealVector> ring(const Cells& cells, Index site) const;

 private:
  const Triangulation& triangulation_;
  std::vector<RealVector> places_;
};

// Of a convex spherical polygon.
Real polygon_area(const std::vector<RealVector>& ring);
// The unit vector of the center of mass; empty for a polygon without area.
std::optional<RealVector> polygon_centroid(const std::vector<RealVector>& ring);

}  // namespace rondel::test
