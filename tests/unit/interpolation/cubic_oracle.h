// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cubic interpolation from its definition, in numbers so long that rounding does not matter: forwards,
// with blossoms, determinants and normals of unit length, where the library goes backwards from the
// value to weights and has neither.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "support/mpfr_oracle.h"

namespace rondel::test {

inline RealVector operator+(const RealVector& a, const RealVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline RealVector operator-(const RealVector& a, const RealVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline RealVector operator*(const Real& s, const RealVector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline Real inner(const RealVector& a, const RealVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RealVector outer(const RealVector& a, const RealVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class CubicOracle {
 public:
  struct Data {
    RealVector place;
    Real value;
    RealVector gradient;  // tangent
  };

  // Data of all sites; opposite corners beyond solid faces only.
  CubicOracle(const Triangulation& triangulation, std::vector<Data> data)
      : triangulation_(triangulation), data_(std::move(data)) {}

  [[nodiscard]] const RealVector& place(Index site) const { return data_[site].place; }

  // S[f](u) in a face.
  [[nodiscard]] Real undivided(Index face, const RealVector& u) const {
    return evaluate(face, u, data_);
  }
  [[nodiscard]] Real operator()(Index face, const RealVector& u) const {
    std::vector<Data> one = data_;
    for (Data& d : one) d = {d.place, Real(1), {Real(0), Real(0), Real(0)}};
    return evaluate(face, u, data_) / evaluate(face, u, one);
  }

 private:
  using Three = std::array<Real, 3>;

  // p[x, x, z] of the data at x.
  static Real pair(const Data& at, const RealVector& z) {
    return at.value * inner(at.place, z) + inner(at.gradient, z) / Real(3);
  }

  // Coordinates of z for the base a, b, c.
  static Three coordinates(const RealVector& z, const RealVector& a, const RealVector& b,
                           const RealVector& c) {
    const Real all = inner(a, outer(b, c));
    return {inner(z, outer(b, c)) / all, inner(a, outer(z, c)) / all, inner(a, outer(b, z)) / all};
  }

  static double clamped(double x) { return std::min(1.0, std::max(0.0, x)); }

  // p[a, b, n] for the unit normal n of the edge's plane, on the side of c.
  static Real across(const Data& a, const Data& b, const Data& c, const Data* d) {
    RealVector n = *normalized(outer(a.place, b.place));
    if (inner(n, c.place).rounded() < 0) n = Real(-1) * n;
    const Real at_a = inner(a.gradient, n) / Real(3);
    const Real at_b = inner(b.gradient, n) / Real(3);
    const Real plain = inner(a.place, b.place) * (at_a + at_b) / Real(2);
    if (d == nullptr) return plain;
    const Three in = coordinates(c.place, a.place, b.place, n);
    const Three out = coordinates(d->place, a.place, b.place, n);
    // p[z, z, a] = known + 2 z_b z_n X + z_n^2 W_a, both for z = c and z = d.
    const auto known_at = [&](const Data& x, const Real& normal, const Real& x_part,
                              const Real& other_part, const Data& other, const Real& z_n) {
      return x_part * x_part * x.value + other_part * other_part * pair(other, x.place) +
             Real(2) * x_part * other_part * pair(x, other.place) + Real(2) * x_part * z_n * normal;
    };
    const auto equation = [&](const Data& x, const Real& normal, std::size_t ix, const Data& other,
                              std::size_t io) {
      const Real left_c = pair(c, x.place) - known_at(x, normal, in[ix], in[io], other, in[2]);
      const Real left_d = pair(*d, x.place) - known_at(x, normal, out[ix], out[io], other, out[2]);
      // left / z_n^2 = 2 (z_o / z_n) X + W
      return std::array{Real(2) * (in[io] / in[2] - out[io] / out[2]),
                        left_c / (in[2] * in[2]) - left_d / (out[2] * out[2])};
    };
    const double square = inner(a.place - b.place, a.place - b.place).rounded();
    const double heights =
        std::min(in[2].rounded() * in[2].rounded(), out[2].rounded() * out[2].rounded());
    // Where the arc from c to d meets the plane of the edge.
    const RealVector meets = (Real(0) - out[2]) * c.place + in[2] * d->place;
    const Three m = coordinates(meets, a.place, b.place, n);
    const double turn = ((m[0] + m[1]) / (in[2] - out[2])).rounded();
    const double share = clamped(4 * turn - 2) * clamped(64 * heights / square);
    if (share == 0) return plain;
    const auto first = equation(a, at_a, 0, b, 1);
    const auto second = equation(b, at_b, 1, a, 0);
    const Real fitted = (first[0] * first[1] + second[0] * second[1]) /
                        (first[0] * first[0] + second[0] * second[0]);
    return Real(1 - share) * plain + Real(share) * fitted;
  }

  [[nodiscard]] const Data* opposite(Index face, unsigned edge,
                                     const std::vector<Data>& data) const {
    const Index other = triangulation_.neighbors()[face][edge];
    if (triangulation_.is_ghost(other)) return nullptr;
    const Triple& here = triangulation_.faces()[face];
    for (const Index v : triangulation_.faces()[other]) {
      if (std::find(here.begin(), here.end(), v) == here.end()) return &data[v];
    }
    return nullptr;
  }

  // de Casteljau in the part of the face that has u.
  [[nodiscard]] Real evaluate(Index face, const RealVector& u,
                              const std::vector<Data>& data) const {
    const Triple& f = triangulation_.faces()[face];
    const std::array<const Data*, 3> x = {&data[f[0]], &data[f[1]], &data[f[2]]};
    const RealVector v = x[0]->place + x[1]->place + x[2]->place;
    std::array<Real, 3> edge_center;  // p[x_i, x_j, v]
    for (unsigned k = 0; k < 3; ++k) {
      const Data& a = *x[(k + 1) % 3];
      const Data& b = *x[(k + 2) % 3];
      RealVector n = *normalized(outer(a.place, b.place));
      const Three part = coordinates(v, a.place, b.place, n);
      edge_center[k] = part[0] * pair(a, b.place) + part[1] * pair(b, a.place) +
                       part[2] * across(a, b, *x[k], opposite(face, k, data));
    }
    std::array<Real, 3> twice_center;  // p[x_k, v, v]
    Real center(0);
    for (unsigned k = 0; k < 3; ++k) {
      twice_center[k] = pair(*x[k], v) + edge_center[(k + 1) % 3] + edge_center[(k + 2) % 3];
      center = center + twice_center[k];
    }
    const Three all = coordinates(u, x[0]->place, x[1]->place, x[2]->place);
    unsigned k = 0;
    for (unsigned i = 1; i < 3; ++i) {
      if ((all[i] - all[k]).rounded() < 0) k = i;
    }
    const Data& a = *x[(k + 1) % 3];
    const Data& b = *x[(k + 2) % 3];
    const Three c = coordinates(u, a.place, b.place, v);
    // The triangle of coefficients, [number of b][number of v].
    std::array<std::array<Real, 4>, 4> t;
    t[0][0] = a.value;
    t[1][0] = pair(a, b.place);
    t[2][0] = pair(b, a.place);
    t[3][0] = b.value;
    t[0][1] = pair(a, v);
    t[1][1] = edge_center[k];
    t[2][1] = pair(b, v);
    t[0][2] = twice_center[(k + 1) % 3];
    t[1][2] = twice_center[(k + 2) % 3];
    t[0][3] = center;
    for (unsigned degree = 3; degree > 0; --degree) {
      for (unsigned i = 0; i < degree; ++i) {
        for (unsigned j = 0; i + j < degree; ++j) {
          t[i][j] = c[0] * t[i][j] + c[1] * t[i + 1][j] + c[2] * t[i][j + 1];
        }
      }
    }
    return t[0][0];
  }

  const Triangulation& triangulation_;
  std::vector<Data> data_;
};

}  // namespace rondel::test
