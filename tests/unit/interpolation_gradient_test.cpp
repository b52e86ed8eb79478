// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients from values around: fits against polynomials and against least squares by rotations, rows
// by their laws.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "interpolation/gradient.h"
#include "interpolation/local_fit.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/interpolation_slopes.h"

namespace rondel::test {
namespace {

using namespace interpolation;

// The stereographic plane of x, true to length at x.
struct Plane {
  Vec x;
  Vec a;
  Vec b;

  static Plane at(const Vec& x) {
    const Vec a = normalized(cross(x, std::abs(x.x) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
    return {x, a, cross(x, a)};
  }
  // x + the step to the point at (p, q): the inverse of the projection from -x.
  [[nodiscard]] Vec step(double p, double q) const {
    const double square = (p * p + q * q) / 4;
    return (p / (1 + square)) * a + (q / (1 + square)) * b - (2 * square / (1 + square)) * x;
  }
};

using Spots = std::vector<std::array<double, 2>>;

Spots random_spots(std::size_t count, double thinness, Random& random) {
  Spots spots;
  for (std::size_t i = 0; i < count; ++i) {
    spots.push_back({random.signed_unit(), thinness * random.signed_unit()});
  }
  return spots;
}

std::vector<Vec> steps_to(const Spots& spots, double size, const Plane& plane) {
  std::vector<Vec> steps;
  for (const auto& [p, q] : spots) steps.push_back(plane.step(size * p, size * q));
  return steps;
}

std::array<double, 9> terms(double p, double q) {
  return {p, q, p * p, p * q, q * q, p * p * p, p * p * q, p * q * q, q * q * q};
}

// Exact on polynomials of the degree of the fit, whatever the size of the cloud, and nearly whatever its
// shape.
TEST(interpolation_gradient, fits_are_exact_on_their_polynomials) {
  Random random(1);
  std::array<int, 10> seen{};
  for (const double size : {0.3, 1e-3, 1e-9, 1e-200}) {
    for (const double thinness : {1.0, 1e-2, 1e-4}) {
      for (std::size_t i = 0; i < scaled(200); ++i) {
        const Plane plane = Plane::at(exact::to_vector(random.direction()));
        const Spots spots = random_spots(2 + random.below(25), thinness, random);
        LocalFit fit;
        std::vector<Vec> weights;
        ASSERT_TRUE(fit.find(plane.x, steps_to(spots, size, plane), weights));
        ++seen[fit.num_terms()];
        std::array<double, 9> coefficients{};
        for (std::size_t t = 0; t < fit.num_terms(); ++t) coefficients[t] = random.signed_unit();
        // In units of the cloud.
        Vec gradient{0, 0, 0};
        double most = 0;
        for (std::size_t k = 0; k < spots.size(); ++k) {
          double value = 0;
          const auto at = terms(spots[k][0], spots[k][1] / thinness);
          for (std::size_t t = 0; t < 9; ++t) value += coefficients[t] * at[t];
          gradient = gradient + (value * size) * weights[k];
          most = std::max(most, norm(weights[k]) * size);
        }
        const Vec expected = coefficients[0] * plane.a + (coefficients[1] / thinness) * plane.b;
        ASSERT_LE(norm(gradient - expected), 1e-9 * (1 + most))
            << size << " " << thinness << " " << spots.size() << " " << fit.num_terms();
        for (const Vec& weight : weights) {
          ASSERT_LE(std::abs(dot(weight, plane.x)), 1e-15 * norm(weight));
        }
      }
    }
  }
  EXPECT_GT(seen[2], 0);
  EXPECT_GT(seen[5], 0);
  EXPECT_GT(seen[9], 0);
}

// Least squares by Givens rotations on the rows, as LocalFit never sees them, with its weights.
std::array<double, 2> slopes_by_rotations(const Spots& spots, const std::vector<double>& values,
                                          std::size_t num_terms) {
  double farthest = 0;
  for (const auto& [p, q] : spots) farthest = std::max(farthest, std::hypot(p, q));
  std::array<std::array<long double, 10>, 9> upper{};
  for (std::size_t k = 0; k < spots.size(); ++k) {
    const double r = std::hypot(spots[k][0], spots[k][1]) / (1.2 * farthest);
    const double weight = std::pow((1 - r) / std::max(r, 0.25), 2);
    std::array<long double, 10> row{};
    const auto at = terms(spots[k][0], spots[k][1]);
    for (std::size_t t = 0; t < num_terms; ++t) row[t] = weight * at[t];
    row[9] = weight * values[k];
    for (std::size_t t = 0; t < num_terms; ++t) {
      const long double length = std::hypot(upper[t][t], row[t]);
      if (length == 0) continue;
      const long double c = upper[t][t] / length;
      const long double s = row[t] / length;
      for (std::size_t j = t; j < 10; ++j) {
        if (j >= num_terms && j < 9) continue;
        const long double above = upper[t][j];
        upper[t][j] = c * above + s * row[j];
        row[j] = c * row[j] - s * above;
      }
    }
  }
  std::array<long double, 9> solution{};
  for (std::size_t t = num_terms; t-- > 0;) {
    long double rest = upper[t][9];
    for (std::size_t j = t + 1; j < num_terms; ++j) rest -= upper[t][j] * solution[j];
    solution[t] = rest / upper[t][t];
  }
  return {static_cast<double>(solution[0]), static_cast<double>(solution[1])};
}

TEST(interpolation_gradient, fits_are_least_squares) {
  Random random(2);
  for (std::size_t i = 0; i < scaled(300); ++i) {
    const Plane plane = Plane::at(exact::to_vector(random.direction()));
    Spots spots = random_spots(6 + random.below(25), 1, random);
    spots[0] = {1e-5 * spots[0][0], 1e-5 * spots[0][1]};  // so near that its weight is bounded
    LocalFit fit;
    std::vector<Vec> weights;
    ASSERT_TRUE(fit.find(plane.x, steps_to(spots, 0.1, plane), weights));
    std::vector<double> values;
    Vec gradient{0, 0, 0};
    for (std::size_t k = 0; k < spots.size(); ++k) {
      values.push_back(random.signed_unit());
      gradient = gradient + (0.1 * values[k]) * weights[k];
    }
    const auto [a, b] = slopes_by_rotations(spots, values, fit.num_terms());
    ASSERT_LE(norm(gradient - (a * plane.a + b * plane.b)), 1e-9 * (1 + std::hypot(a, b)))
        << spots.size() << " " << fit.num_terms();
  }
}

TEST(interpolation_gradient, neighbors_in_line_have_no_fit) {
  const Plane plane = Plane::at({0, 0, 1});
  LocalFit fit;
  std::vector<Vec> weights;
  EXPECT_FALSE(fit.find(plane.x, {}, weights));
  const Spots one = {{0.6, 0.8}};
  EXPECT_FALSE(fit.find(plane.x, steps_to(one, 0.1, plane), weights));
  const Spots line = {{0.6, 0.8}, {-1.2, -1.6}, {0.3, 0.4}, {2.4, 3.2}};
  EXPECT_FALSE(fit.find(plane.x, steps_to(line, 0.1, plane), weights));
  EXPECT_TRUE(weights.empty());
}

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
    const Ground ground(triangulation);
    const GradientRows rows = gradient_rows(ground, {}, 1);
    ASSERT_EQ(rows.offsets.size(), ground.num_vertices() + 1);
    for (Index v = 0; v < ground.num_vertices(); ++v) {
      std::set<Index> found;
      Point sum{};
      for (std::uint64_t k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
        ASSERT_TRUE(is_finite(rows.weights[k])) << generator.name;
        if (k == rows.offsets[v]) {
          ASSERT_EQ(rows.vertices[k], v) << generator.name;
        } else {
          ASSERT_TRUE(found.insert(ground.name(rows.vertices[k])).second) << generator.name;
          sum = sum + rows.weights[k];
        }
      }
      if (rows.offsets[v] == rows.offsets[v + 1]) continue;
      ASSERT_EQ(rows.weights[rows.offsets[v]], -1.0 * sum) << generator.name;
      std::set<Index> expected = two_rings(triangulation, ground.name(v));
      std::erase_if(expected, [&](Index w) {
        return dot(unit_point(ground, v), unit_point(ground, ground.vertex_of(w))) < -0.499;
      });
      std::erase_if(found, [&](Index w) {
        return dot(unit_point(ground, v), unit_point(ground, ground.vertex_of(w))) < -0.499;
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
  const GradientRows expected = gradient_rows(Ground(first), {}, 1);
  random.shuffle(sites);
  const Triangulation second = delaunay(sites);
  const GradientRows found = gradient_rows(Ground(second), {}, 3);
  EXPECT_EQ(found.offsets, expected.offsets);
  EXPECT_EQ(found.vertices, expected.vertices);
  EXPECT_EQ(found.weights, expected.weights);
}

// Third order in the spacing, on patches of any size.
TEST(interpolation_gradient, is_right_in_small_patches) {
  Random random(5);
  for (const double size : {1e-2, 1e-6, 1e-12}) {
    const Point center = random.direction();
    std::vector<Point> sites;
    for (int i = 0; i < 400; ++i) sites.push_back(center + size * random.direction());
    const Triangulation triangulation = delaunay(sites);
    const Ground ground(triangulation);
    const Point slope = random.direction();
    // slope.x about the center in units of the patch, from differences that are exact.
    std::vector<double> values;
    for (Index v = 0; v < ground.num_vertices(); ++v) {
      const Vec s = step(ground.unit(0), ground.unit(v));
      values.push_back(dot(exact::to_vector(slope), s) / size);
    }
    const std::vector<Point> gradients = gradients_of(gradient_rows(ground, {}, 1), values);
    for (Index v = 0; v < ground.num_vertices(); ++v) {
      const Point x = unit_point(ground, v);
      const Point expected = slope - dot(slope, x) * x;
      ASSERT_LE(norm(size * gradients[v] - expected), size < 1e-3 ? 1e-9 : 1e-4) << size;
    }
  }
}

}  // namespace
}  // namespace rondel::test
