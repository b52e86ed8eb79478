// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cubic: against its definition in long numbers, and by the laws that it is made for.

#include "interpolation/cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "interpolation/gradient.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/interpolation/cubic_oracle.h"
#include "unit/interpolation/slopes.h"

namespace rondel::test {
namespace {

using namespace interpolation;

// Values and tangent gradients at random, of size 1.
struct RandomData {
  std::vector<double> values;
  std::vector<Point> gradients;

  RandomData(const PreparedTriangulation& prepared, Random& random) {
    for (Index v = 0; v < prepared.num_vertices(); ++v) {
      const Point x = exact::to_point(exact::to_vector(prepared.unit(v).hi));
      const Point g = random.direction();
      values.push_back(random.signed_unit());
      gradients.push_back(g - dot(g, x) * x);
    }
  }
};

// By site, as the triangulation names them. Gradients are made tangent in every digit.
std::vector<CubicOracle::Data> oracle_data(const PreparedTriangulation& prepared,
                                           const RandomData& data) {
  std::vector<CubicOracle::Data> result(prepared.num_sites());
  for (Index v = 0; v < prepared.num_vertices(); ++v) {
    const RealVector x = *normalized(to_real(prepared.point(v) - prepared.center()));
    const RealVector g = to_real(data.gradients[v]);
    result[prepared.name(v)] = {x, Real(data.values[v]), g - inner(g, x) * x};
  }
  return result;
}

struct Sample {
  std::string name;
  std::vector<Point> sites;
  double spacing;
};

std::vector<Sample> samples() {
  Random random(7);
  std::vector<Sample> all;
  std::vector<Point> uniform;
  for (int i = 0; i < 300; ++i) uniform.push_back(random.direction());
  all.push_back({"uniform", uniform, 0.1});
  for (const double size : {1e-1, 1e-6, 1e-12}) {
    std::vector<Point> patch;
    const Point center = random.direction();
    for (int i = 0; i < 100; ++i) patch.push_back(center + size * random.direction());
    all.push_back({"patch of " + std::to_string(size), patch, size});
  }
  all.push_back(
      {"octahedron", {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 1});
  return all;
}

TEST(interpolation_cubic, agrees_with_its_definition) {
  for (const Sample& sample : samples()) {
    const Triangulation triangulation = delaunay(sample.sites);
    const PreparedTriangulation prepared(triangulation);
    Random random(8);
    const RandomData data(prepared, random);
    const CubicOracle oracle(triangulation, oracle_data(prepared, data));
    CubicKernel kernel(prepared);
    CubicKernel undivided(prepared, {}, Normalization::homogeneous);
    int num_checked = 0;
    for (const LocatedTarget& place : places_in_faces(prepared, scaled(40), random)) {
      GradientRow row;
      kernel(place, row);
      const RealVector u = *normalized(to_real(place.point - prepared.center()));
      const Index face = place.location.face;
      const double size = std::max(1.0, largest_weight(row));
      // A random gradient moves values by the spacing.
      const double tolerance = 1e-13 * size;
      ASSERT_NEAR(sum_of(row, data.values, data.gradients), oracle(face, u).rounded(), tolerance)
          << sample.name;
      row.clear();
      undivided(place, row);
      ASSERT_NEAR(sum_of(row, data.values, data.gradients), oracle.undivided(face, u).rounded(),
                  tolerance)
          << sample.name;
      ++num_checked;
    }
    EXPECT_GT(num_checked, 2) << sample.name;
  }
}

// On both sides of an edge, 1e-300 from it, the definition has one normal derivative; the test above says
// that what the kernel computes is the definition.
TEST(interpolation_cubic, has_one_gradient_on_both_sides_of_an_edge) {
  const Real tiny = Real(0x1p-1000);
  for (const Sample& sample : samples()) {
    const Triangulation triangulation = delaunay(sample.sites);
    const PreparedTriangulation prepared(triangulation);
    Random random(9);
    const CubicOracle oracle(triangulation, oracle_data(prepared, RandomData(prepared, random)));
    for (std::size_t i = 0; i < scaled(8); ++i) {
      const Index face = static_cast<Index>(random.below(triangulation.num_faces()));
      const unsigned k = static_cast<unsigned>(random.below(3));
      const Index other = triangulation.neighbors()[face][k];
      if (triangulation.is_ghost(face) || triangulation.is_ghost(other)) continue;
      const Triple& corners = triangulation.faces()[face];
      const RealVector& a = oracle.place(corners[(k + 1) % 3]);
      const RealVector& b = oracle.place(corners[(k + 2) % 3]);
      const RealVector u = *normalized(a + Real(random.unit()) * (b - a));
      const RealVector n = *normalized(outer(a, b));  // points into `face`
      const Real inside = (oracle(face, u + tiny * n) - oracle(face, u)) / tiny;
      const Real beyond = (oracle(other, u) - oracle(other, u - tiny * n)) / tiny;
      const double size = 1 + std::abs(inside.rounded());
      EXPECT_LE(std::abs((inside - beyond).rounded()), 1e-9 * size) << sample.name;
      EXPECT_LE(std::abs((oracle(face, u) - oracle(other, u)).rounded()), 1e-30) << sample.name;
    }
  }
}

TEST(interpolation_cubic, meets_values_and_gradients) {
  const Triangulation triangulation = delaunay(samples()[0].sites);
  const PreparedTriangulation prepared(triangulation);
  Random random(10);
  const RandomData data(prepared, random);
  CubicKernel kernel(prepared);
  for (Index v = 0; v < prepared.num_vertices(); ++v) {
    const Point x = unit_point(prepared, v);
    const Point direction = cross_product(x, random.direction());
    const double step = 1e-7;
    GradientRow row;
    kernel(place_of(prepared, x + step * direction), row);
    const double expected = data.values[v] + step * dot(direction, data.gradients[v]);
    // The second derivative is about the gradient over the spacing.
    ASSERT_NEAR(sum_of(row, data.values, data.gradients), expected, 1e4 * step * step);
  }
}

// Undivided, where all edges have full shares; f of x, y, z alone elsewhere too.
TEST(interpolation_cubic, undivided_it_reproduces_cubics) {
  std::vector<Point> sites;
  const std::size_t n = 500;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - static_cast<double>(2 * i + 1) / n;
    const double turn = 2.399963229728653 * static_cast<double>(i);
    const double r = std::sqrt(1 - z * z);
    sites.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  const auto f = [](const Point& p) {
    return p.x * p.x * p.x - 2 * p.x * p.y * p.z + 3 * p.y * p.y * p.z - p.x * p.z * p.z;
  };
  const auto gradient = [](const Point& p) {
    const Point g = {3 * p.x * p.x - 2 * p.y * p.z - p.z * p.z, -2 * p.x * p.z + 6 * p.y * p.z,
                     -2 * p.x * p.y + 3 * p.y * p.y - 2 * p.x * p.z};
    return g - dot(g, p) * p;
  };
  std::vector<double> values;
  std::vector<Point> gradients;
  for (Index v = 0; v < prepared.num_vertices(); ++v) {
    values.push_back(f(unit_point(prepared, v)));
    gradients.push_back(gradient(unit_point(prepared, v)));
  }
  CubicKernel kernel(prepared, {}, Normalization::homogeneous);
  Random random(11);
  for (const LocatedTarget& place : places_in_faces(prepared, 300, random)) {
    GradientRow row;
    kernel(place, row);
    const Point u = exact::to_point(exact::to_vector(place.unit.hi));
    ASSERT_NEAR(sum_of(row, values, gradients), f(u), 1e-14);
  }
}

// Renka's F0 (ACM TOMS 25, 1999).
double f0(const Point& p) {
  return 1 + std::pow(p.x, 8) + std::exp(2 * p.y * p.y * p.y) + std::exp(2 * p.z * p.z) +
         10 * p.x * p.y * p.z;
}
Point f0_gradient(const Point& p) {
  const Point g = {8 * std::pow(p.x, 7) + 10 * p.y * p.z,
                   6 * p.y * p.y * std::exp(2 * p.y * p.y * p.y) + 10 * p.x * p.z,
                   4 * p.z * std::exp(2 * p.z * p.z) + 10 * p.x * p.y};
  return g - dot(g, p) * p;
}

// Root mean square errors of F0 from n random sites, with exact gradients and with estimated ones.
std::array<double, 2> f0_errors(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> sites;
  for (std::size_t i = 0; i < n; ++i) sites.push_back(random.direction());
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  std::vector<double> values;
  std::vector<Point> exact;
  for (Index v = 0; v < n; ++v) {
    values.push_back(f0(unit_point(prepared, v)));
    exact.push_back(f0_gradient(unit_point(prepared, v)));
  }
  const std::vector<Point> estimated = gradients_of(gradient_rows(prepared, {}, 1), values);
  CubicKernel kernel(prepared);
  std::array<double, 2> sums{};
  const std::size_t num_targets = 2000;
  for (std::size_t i = 0; i < num_targets; ++i) {
    const LocatedTarget place = place_of(prepared, random.direction());
    GradientRow row;
    kernel(place, row);
    sums[0] += std::pow(sum_of(row, values, exact) - f0(place.point), 2);
    sums[1] += std::pow(sum_of(row, values, estimated) - f0(place.point), 2);
  }
  for (double& sum : sums) sum = std::sqrt(sum / num_targets);
  return sums;
}

TEST(interpolation_cubic, has_order_four) {
  const auto coarse = f0_errors(1000, 12);
  const auto fine = f0_errors(16000, 13);
  // A quarter of the spacing.
  EXPECT_GE(std::log2(coarse[0] / fine[0]) / 2, 3.5);
  EXPECT_GE(std::log2(coarse[1] / fine[1]) / 2, 3.5);
  EXPECT_LE(fine[0], 5e-6);
  EXPECT_LE(fine[1], 1e-5);
}

TEST(interpolation_cubic, gives_constants_back_to_4_ulp) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const SiteSet set = generator.make(200, 14);
    const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
    if (triangulation.dimension() < 2) continue;
    const PreparedTriangulation prepared(triangulation);
    CubicKernel kernel(prepared);
    Random random(15);
    for (const LocatedTarget& place : places_in_faces(prepared, scaled(100), random)) {
      GradientRow row;
      kernel(place, row);
      ASSERT_NEAR(sum_of_weights(row), 1, 4 * 0x1p-52) << generator.name;
      for (const GradientShare& share : row) {
        ASSERT_TRUE(std::isfinite(share.weight) && std::isfinite(share.slope.x) &&
                    std::isfinite(share.slope.y) && std::isfinite(share.slope.z))
            << generator.name;
        const Point x = unit_point(prepared, share.vertex);
        ASSERT_LE(std::abs(dot(share.slope, x)), 1e-14 * (1 + norm(share.slope))) << generator.name;
      }
    }
  }
}

TEST(interpolation_cubic, is_linear_where_a_corner_has_no_gradient) {
  const Triangulation triangulation = delaunay(samples()[0].sites);
  const PreparedTriangulation prepared(triangulation);
  Random random(16);
  std::vector<std::uint8_t> has_gradient(prepared.num_vertices(), 1);
  for (std::uint8_t& has : has_gradient) has = random.below(4) > 0 ? 1 : 0;
  CubicKernel kernel(prepared, has_gradient);
  LinearKernel linear(prepared);
  for (const LocatedTarget& place : places_in_faces(prepared, 300, random)) {
    GradientRow row;
    Row flat;
    kernel(place, row);
    linear(place, flat);
    const bool is_linear = std::ranges::any_of(prepared.mesh()[place.location.face].vertex,
                                               [&](Index v) { return has_gradient[v] == 0; });
    if (!is_linear) {
      for (const GradientShare& share : row) ASSERT_NE(has_gradient[share.vertex], 0);
      continue;
    }
    ASSERT_EQ(row.size(), flat.size());
    for (std::size_t k = 0; k < row.size(); ++k) {
      ASSERT_EQ(row[k].weight, flat[k].weight);
      ASSERT_EQ(row[k].slope, Point{});
    }
  }
}

}  // namespace
}  // namespace rondel::test
