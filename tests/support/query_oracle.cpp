// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/query_oracle.h"

#include <mpfr.h>

#include <algorithm>
#include <cmath>

#include "support/generators.h"
#include "support/root_sum.h"

namespace rondel::test {
namespace {

constexpr mpfr_prec_t bits = 1100;
constexpr mpfr_prec_t all_bits = 10000;  // fourth powers of doubles from 2^-1074 to 2^1024

// A number that is freed.
struct Number {
  mpfr_t value;
  explicit Number(mpfr_prec_t precision = bits) { mpfr_init2(value, precision); }
  explicit Number(const mpz_class& v, mpfr_prec_t precision = bits) : Number(precision) {
    mpfr_set_z(value, v.get_mpz_t(), MPFR_RNDN);
  }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  ~Number() { mpfr_clear(value); }
};

// Sites, queries, and two points that are 1 apart.
std::vector<Point> rows(std::span<const Point> sites, std::span<const Point> queries) {
  std::vector<Point> all(sites.begin(), sites.end());
  all.insert(all.end(), queries.begin(), queries.end());
  all.insert(all.end(), {{1, 0, 0}, {0, 0, 0}});
  return all;
}

bool is_upwards(const IntegerVector& v) {
  for (const auto& x : v) {
    if (x != 0) return x > 0;
  }
  return false;
}

}  // namespace

QueryOracle::QueryOracle(const Triangulation& triangulation, std::span<const Point> sites,
                         std::span<const Point> queries)
    : triangulation_(triangulation),
      num_sites_(sites.size()),
      oracle_(rows(sites, queries), triangulation.model(), triangulation.sphere()) {
  std::vector<bool> is_vertex(sites.size(), true);
  for (const Duplicate& d : triangulation.duplicates()) is_vertex[d.site] = false;
  for (const Hidden& h : triangulation.hidden()) is_vertex[h.site] = false;
  for (Index i = 0; i < sites.size(); ++i) {
    if (is_vertex[i]) vertices_.push_back(i);
  }
}

int QueryOracle::compare(std::size_t query, Index a, Index b) const {
  const IntegerVector& p = oracle_.vector(row(query));
  const IntegerVector& va = oracle_.vector(a);
  const IntegerVector& vb = oracle_.vector(b);
  if (triangulation_.model() == Model::weighted) return sgn(mpz_class(dot(p, va) - dot(p, vb)));
  RootSum sum;
  sum.squares = {dot(va, va), dot(vb, vb), 1, 1};
  sum.c[2] = dot(p, va);
  sum.c[1] = -dot(p, vb);
  return sign(sum);
}

std::vector<Index> QueryOracle::by_distance(std::size_t query) const {
  std::vector<Index> sorted = vertices_;
  std::ranges::sort(sorted, [&](Index a, Index b) {
    const int sign = compare(query, a, b);
    return sign != 0 ? sign > 0 : a < b;
  });
  return sorted;
}

double QueryOracle::distance_minus(std::size_t query, Index site, double angle) const {
  const IntegerVector& p = oracle_.vector(row(query));
  const IntegerVector& v = oracle_.vector(site);
  const Number product{mpz_class(dot(p, v))};
  Number result;
  if (triangulation_.model() == Model::projected) {
    const IntegerVector normal = cross(p, v);
    const Number sine{mpz_class(dot(normal, normal))};
    mpfr_sqrt(result.value, sine.value, MPFR_RNDN);
    mpfr_atan2(result.value, result.value, product.value, MPFR_RNDN);
  } else {
    const Number square{mpz_class(dot(p, p) * unit() * unit())};
    mpfr_mul_d(result.value, square.value, triangulation_.sphere().squared_radius, MPFR_RNDN);
    mpfr_sqrt(result.value, result.value, MPFR_RNDN);
    mpfr_div(result.value, product.value, result.value, MPFR_RNDN);
    if (mpfr_cmp_si(result.value, 1) > 0) mpfr_set_si(result.value, 1, MPFR_RNDN);
    if (mpfr_cmp_si(result.value, -1) < 0) mpfr_set_si(result.value, -1, MPFR_RNDN);
    mpfr_acos(result.value, result.value, MPFR_RNDN);
  }
  mpfr_sub_d(result.value, result.value, angle, MPFR_RNDN);
  return mpfr_get_d(result.value, MPFR_RNDN);
}

bool QueryOracle::is_at_distance_0(std::size_t query, Index site) const {
  if (triangulation_.model() == Model::projected) return is_on_ray(query, site);
  const IntegerVector& p = oracle_.vector(row(query));
  const mpz_class product = dot(p, oracle_.vector(site));
  Number square{mpz_class(dot(p, p) * unit() * unit()), all_bits};
  mpfr_mul_d(square.value, square.value, triangulation_.sphere().squared_radius, MPFR_RNDN);
  return product > 0 && mpfr_cmp_z(square.value, mpz_class(product * product).get_mpz_t()) <= 0;
}

mpz_class QueryOracle::unit() const {
  const std::size_t last = oracle_.size() - 1;
  return oracle_.vector(last - 1)[0] - oracle_.vector(last)[0];
}

Location QueryOracle::locate(std::size_t query) const {
  return triangulation_.dimension() == 2 ? locate_on_surface(query) : locate_on_ring(query);
}

// The first solid face whose closed cone has the query.
Location QueryOracle::locate_on_surface(std::size_t query) const {
  for (Index f = 0; f < triangulation_.num_faces(); ++f) {
    if (triangulation_.is_ghost(f)) continue;
    const Triple& v = triangulation_.faces()[f];
    const std::array<int, 3> side = {oracle_.orientation(v[1], v[2], row(query)),
                                     oracle_.orientation(v[2], v[0], row(query)),
                                     oracle_.orientation(v[0], v[1], row(query))};
    if (std::ranges::count(side, -1) > 0) continue;
    std::vector<Index> corners;  // opposite to an edge that the query is off
    for (std::size_t i = 0; i < 3; ++i) {
      if (side[i] != 0) corners.push_back(v[i]);
    }
    if (corners.size() == 3) return {Where::face, f, v};
    std::ranges::sort(corners);
    if (corners.size() == 2) return {Where::edge, f, {corners[0], corners[1], no_index}};
    return {Where::vertex, f, {corners[0], no_index, no_index}};
  }
  return {};
}

bool QueryOracle::is_on_ray(std::size_t query, Index site) const {
  const IntegerVector& p = oracle_.vector(row(query));
  const IntegerVector& v = oracle_.vector(site);
  return cross(p, v) == IntegerVector{} && dot(p, v) > 0;
}

Location QueryOracle::locate_on_ring(std::size_t query) const {
  const auto ring = triangulation_.ring();
  const IntegerVector& p = oracle_.vector(row(query));
  bool is_flat = true;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index a = ring[i];
    const Index b = ring[(i + 1) % ring.size()];
    const IntegerVector normal = cross(oracle_.vector(a), oracle_.vector(b));
    if (!is_upwards(normal)) continue;
    is_flat = false;
    const int from_begin = sgn(dot(cross(oracle_.vector(a), p), normal));
    const int to_end = sgn(dot(cross(p, oracle_.vector(b)), normal));
    if (dot(p, normal) != 0 || from_begin < 0 || to_end < 0) continue;
    if (from_begin == 0) return {Where::vertex, no_index, {a, no_index, no_index}};
    if (to_end == 0) return {Where::vertex, no_index, {b, no_index, no_index}};
    return {Where::edge, no_index, {std::min(a, b), std::max(a, b), no_index}};
  }
  if (!is_flat) return {};
  // All in line with the center: the farthest on the ray is seen.
  for (const Index v : by_distance(query)) {
    if (is_on_ray(query, v)) return {Where::vertex, no_index, {v, no_index, no_index}};
  }
  return {};
}

std::vector<Point> query_points(std::span<const Point> sites, const Point& center, Random& random) {
  std::vector<Point> points;
  const auto add = [&](const Point& p) {
    const bool is_finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (is_finite && p != center) points.push_back(p);
  };
  for (int i = 0; i < 8; ++i) add(center + random_direction(random));
  for (const Point& axis : {Point{1, 0, 0}, Point{0, -1, 0}, Point{0, 0, 1}, Point{1, 1, 0},
                            Point{-1, 1, 1}, Point{0, 1, -1}}) {
    add(center + axis);
  }
  if (sites.empty()) return points;
  const auto any = [&] { return sites[random.below(sites.size())]; };
  for (int i = 0; i < 6; ++i) {
    const Point a = any();
    const Point b = any();
    add(a);
    add(moved_by_one_ulp(random, a));
    add((a - center) + b);
    add((a - center) + ((b - center) + any()));
    add(center - (a - center));
  }
  return points;
}

}  // namespace rondel::test
