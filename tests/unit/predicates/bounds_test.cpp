// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Recomputes the filters in doubles, compares them with values of 400 bits, and climbs
// towards the largest error: none may exceed its bound in src/predicates/bounds.h.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <vector>

#include "predicates/compare_distance.h"
#include "predicates/orientation.h"
#include "predicates/side_of_circle.h"
#include "predicates/side_of_plane.h"
#include "predicates/wide.h"
#include "predicates/within_angle.h"
#include "support/adversarial.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using exact::to_vector;
using exact::Vector3;
using predicates::Vector;

constexpr mp_bitcnt_t precision = 400;
using Big = mpf_class;
using BigVector = Vector3<Big>;

Big big(double v) {
  Big value(v, precision);
  return value;
}
BigVector big(const Vector& v) { return {big(v.x), big(v.y), big(v.z)}; }
BigVector minus(const BigVector& a, const BigVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Big dot_of(const BigVector& a, const BigVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Big det_of(const BigVector& a, const BigVector& b, const BigVector& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
         a.z * (b.x * c.y - b.y * c.x);
}
BigVector unit(const Point& p) {
  const BigVector v = big(to_vector(p));
  const Big length = sqrt(dot_of(v, v));
  return {v.x / length, v.y / length, v.z / length};
}
double to_double(const Big& v) { return v.get_d(); }

// A site and the direction stored for it: the rounded p/|p|, moved as far as the contract allows.
struct Stored {
  Point site;
  Vector direction;
};

Stored store(Random& random, const Point& p) {
  Point d = normalized(p);
  const BigVector u = unit(p);
  for (int tries = random.between(0, 4); tries > 0; --tries) {
    const Point moved = moved_by_one_ulp(random, d);
    const BigVector error = minus(big(to_vector(moved)), u);
    if (std::sqrt(to_double(dot_of(error, error))) <= predicates::direction_error) d = moved;
  }
  return {p, to_vector(d)};
}

using FourStored = std::array<Stored, 4>;

// A filter's quotient |computed - exact| / bound for a configuration.
using Ratio = double (*)(const FourStored&);

double circle_plane_ratio(const FourStored& s) {
  const auto& [b, c, d, p] = s;
  const Vector pb = b.direction - p.direction;
  const Vector pc = c.direction - p.direction;
  const Vector pd = d.direction - p.direction;
  const double value = -dot(pb, cross(pc, pd));
  const BigVector u = unit(p.site);
  const Big exact_value =
      -det_of(minus(unit(b.site), u), minus(unit(c.site), u), minus(unit(d.site), u));
  std::array<double, 3> length = {std::sqrt(dot(pb, pb)), std::sqrt(dot(pc, pc)),
                                  std::sqrt(dot(pd, pd))};
  std::ranges::sort(length);
  const double bound = predicates::circle_plane_bound * length[2] * length[1];
  return std::abs(to_double(value - exact_value)) / bound;
}

// Two corners of the face are far closer to p than the third one.
double circle_plane_of_long_faces_ratio(const FourStored& s) {
  FourStored moved = s;
  const Point& p = s[3].site;
  const Point& far = s[0].site;
  moved[0].site = normalized(p + 1e3 * (far - p));
  moved[0].direction = to_vector(moved[0].site);
  return circle_plane_ratio(moved);
}

double circle_ratio(const FourStored& s) {
  const auto& [b, c, d, p] = s;
  const Vector pb = b.direction - p.direction;
  const Vector pc = c.direction - p.direction;
  const Vector pd = d.direction - p.direction;
  const Vector cd = cross(pc, pd);
  const Vector db = cross(pd, pb);
  const Vector bc = cross(pb, pc);
  const double b2 = dot(pb, pb);
  const double c2 = dot(pc, pc);
  const double d2 = dot(pd, pd);
  const double value =
      dot(p.direction, Vector{b2 * cd.x + c2 * db.x + d2 * bc.x, b2 * cd.y + c2 * db.y + d2 * bc.y,
                              b2 * cd.z + c2 * db.z + d2 * bc.z});
  const BigVector u = unit(p.site);
  const Big exact_value =
      -2 * det_of(minus(unit(b.site), u), minus(unit(c.site), u), minus(unit(d.site), u));
  const double h = std::sqrt(std::max({b2, c2, d2}));
  return std::abs(to_double(value - exact_value)) / (predicates::circle_bound * h * h * h);
}

// The step of side_of_circle_close.cpp between sites whose lengths differ as much as they are
// apart.
double close_step_ratio(const FourStored& s) {
  const Vector p = to_vector(s[3].site);
  const Point apart = s[0].site - s[3].site;
  const Vector q = to_vector(
      s[0].site + (s[1].site.x * std::sqrt(dot(to_vector(apart), to_vector(apart)))) * s[3].site);
  const double length_p = std::sqrt(dot(p, p));
  const double length_q = std::sqrt(dot(q, q));
  const Vector d = q - p;
  const double t = dot(d, p + q) / (length_p * (length_p + length_q));
  const Vector e = {d.x - t * p.x, d.y - t * p.y, d.z - t * p.z};
  const Big exact_length = sqrt(dot_of(big(q), big(q)));
  const BigVector u = unit(s[3].site);
  const BigVector exact_e = {q.x - exact_length * u.x, q.y - exact_length * u.y,
                             q.z - exact_length * u.z};
  const BigVector error = minus(big(e), exact_e);
  return std::sqrt(to_double(dot_of(error, error)) / dot(d, d)) / predicates::close_step_bound;
}

double plane_ratio(const FourStored& s) {
  const auto& [b, c, d, p] = s;
  const Vector o = to_vector(p.site);
  const Vector pb = to_vector(b.site) - o;
  const Vector pc = to_vector(c.site) - o;
  const Vector pd = to_vector(d.site) - o;
  const double value = -det(pb, pc, pd);
  const BigVector u = big(o);
  const Big exact_value =
      -det_of(minus(big(to_vector(b.site)), u), minus(big(to_vector(c.site)), u),
              minus(big(to_vector(d.site)), u));
  const double size = std::sqrt(dot(pb, pb)) * std::sqrt(dot(pc, pc)) * std::sqrt(dot(pd, pd));
  return std::abs(to_double(value - exact_value)) / (predicates::plane_bound * size);
}

// Weights of very different magnitudes: |B|, |C| and |D| are 1e15, 1e3 and 1 apart.
double plane_of_mixed_weights_ratio(const FourStored& s) {
  FourStored scaled_sites = s;
  scaled_sites[0].site = 1e15 * s[0].site;
  scaled_sites[1].site = 1e3 * s[1].site;
  return plane_ratio(scaled_sites);
}

double orientation_ratio(const FourStored& s) {
  const Vector a = to_vector(s[0].site);
  const Vector ab = to_vector(s[1].site) - a;
  const Vector ac = to_vector(s[2].site) - a;
  const double value = det(a, ab, ac);
  const Big exact_value = det_of(big(a), big(to_vector(s[1].site)), big(to_vector(s[2].site)));
  const double size = std::sqrt(dot(a, a)) * std::sqrt(dot(ab, ab)) * std::sqrt(dot(ac, ac));
  return std::abs(to_double(value - exact_value)) / (predicates::orientation_bound * size);
}

double direction_orientation_ratio(const FourStored& s) {
  const Vector a = s[0].direction;
  const Vector ab = s[1].direction - a;
  const Vector ac = s[2].direction - a;
  const double value = det(a, ab, ac);
  const Big exact_value = det_of(unit(s[0].site), unit(s[1].site), unit(s[2].site));
  const double h = std::sqrt(std::max(dot(ab, ab), dot(ac, ac)));
  return std::abs(to_double(value - exact_value)) / (predicates::direction_orientation_bound * h);
}

double wide_orientation_ratio(const FourStored& s) {
  std::array<Vector, 3> rays{};
  const Vector center = to_vector(0.3 * s[3].site);
  for (std::size_t i = 0; i < 3; ++i) rays[i] = to_vector(s[i].site) - center;
  const auto value =
      predicates::det_of_rows(predicates::to_floating(rays[0]), predicates::to_floating(rays[1]),
                              predicates::to_floating(rays[2]));
  const auto exact_ray = [&](std::size_t i) {
    return minus(big(to_vector(s[i].site)), big(center));
  };
  const Big exact_value = det_of(exact_ray(0), exact_ray(1), exact_ray(2));
  return std::abs(to_double(big(std::ldexp(value.value, value.exponent)) - exact_value)) /
         (predicates::orientation_wide_bound * std::ldexp(value.size(), value.exponent));
}

struct ExactRay {
  BigVector v;
  Big height;

  ExactRay(const Vector& p, const Vector& center) : v(minus(big(p), big(center))) {
    height = Big(sqrt(dot_of(v, v)) - v.x, precision);
  }
};

// The first column of four rays along the axis of x.
double wide_circle_ratio(const FourStored& s) {
  const Vector center = {0.3, 0.1, -0.2};
  const auto moved = [&](std::size_t i) {
    const Point& p = s[i].site;
    return Vector{2 + p.x * p.x, p.y, p.z};
  };
  std::vector<predicates::WideRow> rows;
  std::vector<ExactRay> exact;
  for (std::size_t i = 0; i < 4; ++i) {
    rows.push_back(predicates::WideRay(moved(i) - center).row(0, false));
    exact.emplace_back(moved(i), center);
  }
  const auto& o = rows[3];
  const ExactRay& e = exact[3];
  const auto row = [&](std::size_t i) { return predicates::less_origin(rows[i], o); };
  std::array<BigVector, 3> b;
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactRay& q = exact[i];
    b[i] = {e.v.x * q.v.y - q.v.x * e.v.y, e.v.x * q.v.z - q.v.x * e.v.z,
            e.v.x * q.height - q.v.x * e.height};
  }
  const auto value = predicates::det_of_rows(row(0), row(1), row(2));
  const Big exact_value = det_of(b[0], b[1], b[2]);
  return std::abs(to_double(big(std::ldexp(value.value, value.exponent)) - exact_value)) /
         (predicates::circle_wide_bound * std::ldexp(value.size(), value.exponent));
}

Big squared_chord(const Stored& s, const Stored& t) {
  const BigVector d = minus(unit(s.site), unit(t.site));
  return dot_of(d, d);
}

double angle_ratio(const FourStored& s) {
  const Vector a = s[0].direction - s[3].direction;
  const Vector b = s[1].direction - s[3].direction;
  const double value = dot(b, b) - dot(a, a);
  const Big exact_value = squared_chord(s[1], s[3]) - squared_chord(s[0], s[3]);
  const double h = std::sqrt(std::max(dot(a, a), dot(b, b)));
  return std::abs(to_double(value - exact_value)) / (predicates::angle_bound * h);
}

double within_angle_ratio(const FourStored& s) {
  const Vector d = s[0].direction - s[3].direction;
  const double d2 = dot(d, d);
  const double t = 1.25 * d2;
  const Big exact_value = t - squared_chord(s[0], s[3]);
  return std::abs(to_double((t - d2) - exact_value)) /
         (predicates::within_angle_bound * std::sqrt(t));
}

// The center is not the origin, so that the differences are rounded.
double power_ratio(const FourStored& s) {
  const Vector center = to_vector(0.3 * s[2].site);
  const Vector ray = to_vector(s[3].site) - center;
  const Vector ba = to_vector(s[0].site) - to_vector(s[1].site);
  const BigVector exact_ray = minus(big(to_vector(s[3].site)), big(center));
  const Big exact_value =
      dot_of(exact_ray, minus(big(to_vector(s[0].site)), big(to_vector(s[1].site))));
  const double size = std::abs(ray.x * ba.x) + std::abs(ray.y * ba.y) + std::abs(ray.z * ba.z);
  return std::abs(to_double(dot(ray, ba) - exact_value)) / (predicates::power_bound * size);
}

double within_power_ratio(const FourStored& s) {
  const Vector center = to_vector(0.3 * s[2].site);
  const Vector ray = to_vector(s[3].site) - center;
  const Vector a = to_vector(s[0].site) - center;
  const double t = std::abs(s[1].site.x);
  const double squared_radius = 2 + s[1].site.y;
  const double limit = std::sqrt(dot(ray, ray) * squared_radius) * (1 - t / 2);
  const BigVector exact_ray = minus(big(to_vector(s[3].site)), big(center));
  const Big root = sqrt(dot_of(exact_ray, exact_ray) * big(squared_radius));
  const Big exact_value =
      dot_of(exact_ray, minus(big(to_vector(s[0].site)), big(center))) - root * (1 - big(t) / 2);
  const double size = std::sqrt(dot(ray, ray) * dot(a, a)) + limit;
  return std::abs(to_double((dot(ray, a) - limit) - exact_value)) /
         (predicates::within_power_bound * size);
}

FourStored random_configuration(Random& random) {
  const double distance = random_distance(random, 1e-15);
  Four four = near_one_circle(random, distance);
  if (random.coin()) {
    const Point pole = random_direction(random);
    for (Point& p : four) p = random_near(random, pole, distance);
  }
  FourStored stored;
  std::ranges::transform(four, stored.begin(), [&](const Point& p) { return store(random, p); });
  return stored;
}

FourStored mutated(Random& random, FourStored stored) {
  for (Stored& s : stored) {
    if (random.below(3) == 0) {
      Point p = s.site;
      if (random.coin()) p = random_near(random, p, random_distance(random, 1e-16));
      s = store(random, moved_by_one_ulp(random, p));
    }
  }
  return stored;
}

struct Filter {
  const char* name;
  Ratio ratio;
  double least;  // the search must get this close, or it has lost its teeth
};

class bounds : public testing::TestWithParam<Filter> {};

TEST_P(bounds, hold_against_a_search) {
  Random random(41);
  double largest = 0;
  const std::size_t num_searches = std::max<std::size_t>(25, scaled(100));  // fewer find too little
  for (std::size_t start = 0; start < num_searches; ++start) {
    FourStored best = random_configuration(random);
    double best_ratio = 0;
    for (int step = 0; step < 400; ++step) {
      const FourStored next = step == 0 ? best : mutated(random, best);
      const double ratio = GetParam().ratio(next);
      if (!(ratio > best_ratio) || !std::isfinite(ratio)) continue;
      best = next;
      best_ratio = ratio;
    }
    largest = std::max(largest, best_ratio);
    ASSERT_LE(best_ratio, 1.0);
  }
  RecordProperty("largest_ratio", std::to_string(largest));
  std::cout << GetParam().name << ": largest error " << largest << " of the bound\n";
  EXPECT_GT(largest, GetParam().least);
}

INSTANTIATE_TEST_SUITE_P(
    filters, bounds,
    testing::Values(Filter{"circle_plane", circle_plane_ratio, 0.1},
                    Filter{"circle_plane_of_long_faces", circle_plane_of_long_faces_ratio, 0.1},
                    Filter{"circle", circle_ratio, 0.03},
                    Filter{"close_step", close_step_ratio, 0.1}, Filter{"plane", plane_ratio, 0.1},
                    Filter{"plane_of_mixed_weights", plane_of_mixed_weights_ratio, 0.1},
                    Filter{"orientation", orientation_ratio, 0.1},
                    Filter{"direction_orientation", direction_orientation_ratio, 0.1},
                    Filter{"wide_orientation", wide_orientation_ratio, 0.1},
                    Filter{"wide_circle", wide_circle_ratio, 0.03},
                    Filter{"angle", angle_ratio, 0.1},
                    Filter{"within_angle", within_angle_ratio, 0.1},
                    Filter{"power", power_ratio, 0.1},
                    Filter{"within_power", within_power_ratio, 0.1}),
    [](const auto& filter) { return std::string(filter.param.name); });

// The rounding of a direction as the kernel computes it.
TEST(bounds, directions_are_close_to_unit_vectors) {
  Random random(42);
  double largest = 0;
  for (std::size_t i = 0; i < scaled(20000); ++i) {
    const Point p = random.signed_unit() * random_direction(random);
    const BigVector error = minus(big(to_vector(normalized(p))), unit(p));
    largest = std::max(largest, std::sqrt(to_double(dot_of(error, error))));
  }
  EXPECT_LE(largest, predicates::direction_error);
}

// Unit vectors in two doubles: contract 1 and 2 of exact/unit_vector.h.
TEST(bounds, split_unit_vectors_hold_their_contract) {
  Random random(43);
  for (std::size_t i = 0; i < scaled(20000); ++i) {
    const Point center = random.coin() ? Point{} : 4.0 * random_direction(random);
    Point p = center + random_distance(random, 1e-14) * random_direction(random);
    if (p == center) continue;
    const BigVector v = minus(big(to_vector(p)), big(to_vector(center)));
    const Big length = sqrt(dot_of(v, v));
    const BigVector u = {v.x / length, v.y / length, v.z / length};
    const exact::SplitPoint split = exact::unit_vector(p, center);
    const BigVector high = big(to_vector(split.hi));
    const BigVector error_high = minus(high, u);
    const BigVector low = big(to_vector(split.lo));
    const BigVector error = {error_high.x + low.x, error_high.y + low.y, error_high.z + low.z};
    ASSERT_LE(std::sqrt(to_double(dot_of(error_high, error_high))), 0x1p-53);
    ASSERT_LE(std::sqrt(to_double(dot_of(error, error))), 0x1p-100);
  }
}

}  // namespace
}  // namespace rondel::test
