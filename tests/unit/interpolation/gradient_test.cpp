// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients from values around: rows by their laws (their fits: fit_test.cpp).

#include "interpolation/gradient.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "interpolation/linear.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/interpolation/slopes.h"

namespace rondel::test {
namespace {

using namespace interpolation;

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// The vertices at most two edges of solid faces away, by brute force.
std::set<Index> two_rings(const Triangulation& triangulation, Index site) {
  std::set<Index> near = {site};
  for (int ring = 0; ring < 2; ++ring) {
    std::set<Index> more = near;
    for (Index f = 0; f < triangulation.num_faces(); ++f) {
      if (triangulation.is_ghost(f)) continue;
      const Triple& corners = triangulation.faces()[f];
      for (const Index v : corners) {
        if (near.contains(v)) more.insert(corners.begin(), corners.end());
      }
    }
    near = more;
  }
  near.erase(site);
  return near;
}

TEST(interpolation_gradient, rows_have_two_rings_of_solid_faces) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const SiteSet set = generator.make(60, 3);
    const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
    if (triangulation.dimension() < 2) continue;
    const PreparedTriangulation prepared(triangulation);
    const GradientRows rows = gradient_rows(prepared, {}, 1);
    ASSERT_EQ(rows.offsets.size(), prepared.num_vertices() + 1);
    for (Index v = 0; v < prepared.num_vertices(); ++v) {
      std::set<Index> found;
      Point sum{};
      for (std::uint64_t k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
        ASSERT_TRUE(is_finite(rows.weights[k])) << generator.name;
        if (k == rows.offsets[v]) {
          ASSERT_EQ(rows.vertices[k], v) << generator.name;
        } else {
          ASSERT_TRUE(found.insert(prepared.name(rows.vertices[k])).second) << generator.name;
          sum = sum + rows.weights[k];
        }
      }
      if (rows.offsets[v] == rows.offsets[v + 1]) continue;
      ASSERT_EQ(rows.weights[rows.offsets[v]], -1.0 * sum) << generator.name;
      std::set<Index> expected = two_rings(triangulation, prepared.name(v));
      std::erase_if(expected, [&](Index w) {
        return dot(unit_point(prepared, v), unit_point(prepared, prepared.vertex_of(w))) < -0.499;
      });
      std::erase_if(found, [&](Index w) {
        return dot(unit_point(prepared, v), unit_point(prepared, prepared.vertex_of(w))) < -0.499;
      });
      ASSERT_EQ(found, expected) << generator.name;
    }
  }
}

TEST(interpolation_gradient, does_not_depend_on_threads_or_on_the_order_of_sites) {
  Random random(4);
  std::vector<Point> sites;
  for (int i = 0; i < 3000; ++i) sites.push_back(random.direction());
  const Triangulation first = delaunay(sites);
  const GradientRows expected = gradient_rows(PreparedTriangulation(first), {}, 1);
  random.shuffle(sites);
  const Triangulation second = delaunay(sites);
  const GradientRows found = gradient_rows(PreparedTriangulation(second), {}, 3);
  EXPECT_EQ(found.offsets, expected.offsets);
  EXPECT_EQ(found.vertices, expected.vertices);
  EXPECT_EQ(found.weights, expected.weights);
}

// Gradients are found without rows until somebody asks for these.
TEST(interpolation_gradient, values_do_not_depend_on_what_was_asked_before) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const SiteSet set = generator.make(60, 3);
    const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
    Random random(8);
    std::vector<double> fields;
    std::vector<Point> targets;
    for (std::size_t i = 0; i < 3 * set.sites.size(); ++i) {
      fields.push_back(random.signed_unit());
      targets.push_back(set.sphere.center + random.direction());
    }
    const auto bits_of = [](const std::vector<double>& values) {
      std::vector<std::uint64_t> bits;
      for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
      return bits;
    };
    for (const Method method : {Method::hermite, Method::cubic}) {
      const Interpolator interpolator(triangulation);
      const auto first = interpolator.values(fields, targets, {.method = method});
      const Weights rows = interpolator.gradient();
      const auto second = interpolator.values(fields, targets, {.method = method});
      ASSERT_EQ(bits_of(second), bits_of(first)) << generator.name;
    }
  }
}

// Third order in the spacing, on patches of any size.
TEST(interpolation_gradient, is_right_in_small_patches) {
  Random random(5);
  for (const double size : {1e-2, 1e-6, 1e-12}) {
    const Point center = random.direction();
    std::vector<Point> sites;
    for (int i = 0; i < 400; ++i) sites.push_back(center + size * random.direction());
    const Triangulation triangulation = delaunay(sites);
    const PreparedTriangulation prepared(triangulation);
    const Point slope = random.direction();
    // slope.x about the center in units of the patch, from differences that are exact.
    std::vector<double> values;
    for (Index v = 0; v < prepared.num_vertices(); ++v) {
      const Vec s = step(prepared.unit(0), prepared.unit(v));
      values.push_back(dot(exact::to_vector(slope), s) / size);
    }
    const std::vector<Point> gradients = gradients_of(gradient_rows(prepared, {}, 1), values);
    for (Index v = 0; v < prepared.num_vertices(); ++v) {
      const Point x = unit_point(prepared, v);
      const Point expected = slope - dot(slope, x) * x;
      ASSERT_LE(norm(size * gradients[v] - expected), size < 1e-3 ? 1e-9 : 1e-4) << size;
    }
  }
}

}  // namespace
}  // namespace rondel::test
