// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Local fits against polynomials and against least squares by rotations, in every lane.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "interpolation/local_fit.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using interpolation::LocalFits;
using Vec = LocalFits::Vec;

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

// A thin cloud that determines both slopes: each spot has its mirror image across the long axis.
Spots mirrored_spots(std::size_t count, double thinness, Random& random) {
  Spots spots;
  for (std::size_t i = 0; i < count; ++i) {
    const double p = random.signed_unit();
    const double q = thinness * random.signed_unit();
    spots.push_back({p, q});
    spots.push_back({p, -q});
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

// One site's fit, in some lane.
struct OneFit {
  OneFit(const Vec& x, const std::vector<Vec>& steps, std::size_t lane) {
    LocalFits fits;
    fits.start(steps.size());
    fits.set_site(lane, x, steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) fits.set_neighbor(lane, k, steps[k]);
    fits.find();
    has_gradient = fits.has_gradient(lane);
    is_line = fits.is_line(lane);
    num_terms = fits.num_terms(lane);
    for (std::size_t k = 0; k < steps.size(); ++k) weights.push_back(fits.weight(lane, k));
    for (std::size_t other = 0; other < LocalFits::lanes; ++other) {
      EXPECT_TRUE(other == lane || !fits.has_gradient(other));
    }
  }
  bool has_gradient;
  bool is_line;
  std::size_t num_terms;
  std::vector<Vec> weights;
};

// Exact on polynomials of the degree of the fit, whatever the size of the cloud, and nearly whatever its
// shape.
TEST(interpolation_fit, fits_are_exact_on_their_polynomials) {
  Random random(1);
  std::array<int, 10> seen{};
  for (const double size : {0.3, 1e-3, 1e-9, 1e-120}) {
    for (const double thinness : {1.0, 1e-2, 1e-4}) {
      for (std::size_t i = 0; i < scaled(200); ++i) {
        const Plane plane = Plane::at(exact::to_vector(random.direction()));
        const Spots spots = mirrored_spots(1 + random.below(13), thinness, random);
        const OneFit fit(plane.x, steps_to(spots, size, plane), i % LocalFits::lanes);
        ASSERT_TRUE(fit.has_gradient);
        if (fit.is_line) continue;
        ++seen[fit.num_terms];
        std::array<double, 9> coefficients{};
        for (std::size_t t = 0; t < fit.num_terms; ++t) coefficients[t] = random.signed_unit();
        // In units of the cloud.
        Vec gradient{0, 0, 0};
        double most = 0;
        for (std::size_t k = 0; k < spots.size(); ++k) {
          double value = 0;
          const auto at = terms(spots[k][0], spots[k][1] / thinness);
          for (std::size_t t = 0; t < 9; ++t) value += coefficients[t] * at[t];
          gradient = gradient + (value * size) * fit.weights[k];
          most = std::max(most, norm(fit.weights[k]) * size);
        }
        const Vec expected = coefficients[0] * plane.a + (coefficients[1] / thinness) * plane.b;
        ASSERT_LE(norm(gradient - expected), 1e-9 * (1 + most))
            << size << " " << thinness << " " << spots.size() << " " << fit.num_terms;
        for (const Vec& weight : fit.weights) {
          ASSERT_LE(std::abs(dot(weight, plane.x)), 1e-15 * norm(weight));
        }
      }
    }
  }
  EXPECT_GT(seen[2], scaled(100));
  EXPECT_GT(seen[5], scaled(100));
  EXPECT_GT(seen[9], scaled(100));
}

// Least squares by Givens rotations on the rows, as LocalFits never sees them, with its weights.
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

TEST(interpolation_fit, fits_are_least_squares) {
  Random random(2);
  for (std::size_t i = 0; i < scaled(300); ++i) {
    const Plane plane = Plane::at(exact::to_vector(random.direction()));
    Spots spots = random_spots(6 + random.below(25), 1, random);
    spots[0] = {1e-5 * spots[0][0], 1e-5 * spots[0][1]};  // so near that its weight is bounded
    const OneFit fit(plane.x, steps_to(spots, 0.1, plane), i % LocalFits::lanes);
    ASSERT_TRUE(fit.has_gradient);
    if (fit.is_line) continue;
    std::vector<double> values;
    Vec gradient{0, 0, 0};
    for (std::size_t k = 0; k < spots.size(); ++k) {
      values.push_back(random.signed_unit());
      gradient = gradient + (0.1 * values[k]) * fit.weights[k];
    }
    const auto [a, b] = slopes_by_rotations(spots, values, fit.num_terms);
    ASSERT_LE(norm(gradient - (a * plane.a + b * plane.b)), 1e-9 * (1 + std::hypot(a, b)))
        << spots.size() << " " << fit.num_terms;
  }
}

// The rule of settled_fit.h, by least squares of the monomials themselves.
double excess(const Spots& given, std::size_t num_terms) {
  double farthest = 0;
  std::array<double, 2> axis{};
  for (const auto& [p, q] : given) {
    if (std::hypot(p, q) <= farthest) continue;
    farthest = std::hypot(p, q);
    axis = {p / farthest, q / farthest};
  }
  Spots spots;
  for (const auto& [p, q] : given) {
    spots.push_back({p * axis[0] + q * axis[1], q * axis[0] - p * axis[1]});
  }
  double most = 0;
  for (int degree = num_terms == 2 ? 2 : (num_terms == 5 ? 3 : 4); degree <= 4; ++degree) {
    double square = 0;
    for (int power = 0; power <= degree; ++power) {
      std::vector<double> values;
      for (const auto& [p, q] : spots) {
        values.push_back(std::pow(p / farthest, degree - power) * std::pow(q / farthest, power));
      }
      const auto [a, b] = slopes_by_rotations(spots, values, num_terms);
      square += farthest * farthest * (a * a + b * b);
    }
    most = std::max(most, std::sqrt(square));
  }
  return most;
}

// The gain by the weights of each neighbor's value, one after the other.
double gain_of(const Spots& spots, std::size_t num_terms) {
  double farthest = 0;
  for (const auto& [p, q] : spots) farthest = std::max(farthest, std::hypot(p, q));
  double sum = 0;
  double weighted = 0;
  double squares = 0;
  for (std::size_t k = 0; k < spots.size(); ++k) {
    const double length = std::hypot(spots[k][0], spots[k][1]);
    const double r = length / (1.2 * farthest);
    const double weight = std::pow((1 - r) / std::max(r, 0.25), 4);
    std::vector<double> values(spots.size(), 0);
    values[k] = 1;
    const auto [a, b] = slopes_by_rotations(spots, values, num_terms);
    sum += (a * a + b * b) / weight;
    weighted += weight * length * length;
    squares += weight * weight * length * length;
  }
  return farthest * std::sqrt(sum * squares / weighted);
}

// The highest degree whose excess is at most 1 and whose gain is at most 100, and a line if no degree has these.
TEST(interpolation_fit, degree_is_what_the_neighbors_determine) {
  Random random(9);
  std::array<int, 10> seen{};
  int num_gains = 0;
  for (std::size_t i = 0; i < scaled(2000); ++i) {
    const Plane plane = Plane::at(exact::to_vector(random.direction()));
    const double thinness = std::pow(10.0, -2 * std::abs(random.signed_unit()));
    const Spots spots = random_spots(2 + random.below(25), thinness, random);
    const OneFit fit(plane.x, steps_to(spots, 1e-3, plane), i % LocalFits::lanes);
    std::size_t expected = 0;
    bool is_near = false;
    for (const auto& [terms, least] : {std::pair{9U, 11U}, {5U, 6U}, {2U, 2U}}) {
      if (spots.size() < least) continue;
      const double found = excess(spots, terms);
      const double gain = gain_of(spots, terms);
      is_near = is_near || std::abs(found - 1) < 1e-4 || std::abs(gain - 100) < 1e-2;
      expected = terms;
      if (found <= 1 && gain <= 100) break;
      num_gains += found <= 1 ? 1 : 0;
      expected = 0;
    }
    if (is_near) continue;
    ASSERT_TRUE(fit.has_gradient);
    ASSERT_EQ(fit.is_line ? 0 : fit.num_terms, expected) << spots.size() << " " << thinness;
    ++seen[expected];
  }
  for (const std::size_t terms : {0U, 2U, 5U, 9U}) EXPECT_GT(seen[terms], 10) << terms;
  EXPECT_GT(num_gains, 10);
}

// The slope across a line is 0, and the slope along it is that of a polynomial of one variable.
TEST(interpolation_fit, neighbors_in_line_have_the_slope_along_it) {
  const Plane plane = Plane::at({0, 0, 1});
  EXPECT_FALSE(OneFit(plane.x, {}, 0).has_gradient);
  Random random(10);
  std::array<int, 4> seen{};
  for (const double breadth : {0.0, 1e-14, 1e-9, 1e-5}) {
    for (std::size_t n = 1; n < 20; ++n) {
      const double turn = random.signed_unit() * 3;
      const Vec along = std::cos(turn) * plane.a + std::sin(turn) * plane.b;
      const Vec across = cross(plane.x, along);
      Spots spots;
      std::vector<double> places;
      for (std::size_t k = 0; k < n; ++k) {
        const double s = (k % 2 == 0 ? 1 : -1) * (0.1 + std::abs(random.signed_unit()));
        const double t = breadth * random.signed_unit();
        places.push_back(s);
        spots.push_back(
            {s * std::cos(turn) - t * std::sin(turn), s * std::sin(turn) + t * std::cos(turn)});
      }
      const OneFit fit(plane.x, steps_to(spots, 1e-3, plane), n % LocalFits::lanes);
      ASSERT_TRUE(fit.has_gradient);
      ASSERT_TRUE(fit.is_line) << breadth << " " << n;
      ASSERT_LE(fit.num_terms, n < 4 ? 1U : (n < 6 ? 2U : 3U));
      ++seen[fit.num_terms];
      Vec gradient{0, 0, 0};
      for (std::size_t k = 0; k < n; ++k) {
        const double s = places[k];
        const double value =
            s * (3 + (fit.num_terms > 1 ? 2 * s : 0) + (fit.num_terms > 2 ? s * s : 0));
        gradient = gradient + (1e-3 * value) * fit.weights[k];
      }
      ASSERT_NEAR(dot(gradient, along), 3, 1e-3 * breadth + 1e-6);
      ASSERT_NEAR(dot(gradient, across), 0, 100 * breadth + 1e-9);
    }
  }
  EXPECT_GT(seen[1], 0);
  EXPECT_GT(seen[2], 0);
  EXPECT_GT(seen[3], 0);
}

TEST(interpolation_fit, without_lines_there_is_no_gradient_across) {
  const Plane plane = Plane::at({0, 0, 1});
  const std::vector<Vec> steps = steps_to({{0.6, 0.8}, {-1.2, -1.6}, {0.3, 0.4}}, 0.1, plane);
  LocalFits fits;
  for (const bool with_lines : {false, true}) {
    fits.start(steps.size());
    fits.set_site(4, plane.x, steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) fits.set_neighbor(4, k, steps[k]);
    fits.find(with_lines);
    EXPECT_EQ(fits.has_gradient(4), with_lines);
  }
}

// On a conic through the site one quadratic polynomial vanishes: there the quadratic fit is anything.
TEST(interpolation_fit, neighbors_nearly_on_a_circle_through_the_site_have_a_linear_fit) {
  const Plane plane = Plane::at({0, 0, 1});
  for (const double distance : {0.0, 1e-8, 1e-4, 0.1}) {
    Spots spots;
    for (int k = 0; k < 8; ++k) {
      const double turn = 0.7 * k + 0.2;
      const double radius = std::sqrt(0.34) * (1 + (k % 3 - 1) * distance);
      spots.push_back({0.5 + radius * std::cos(turn), 0.3 + radius * std::sin(turn)});
    }
    const OneFit fit(plane.x, steps_to(spots, 0.1, plane), 2);
    EXPECT_TRUE(fit.has_gradient);
    EXPECT_EQ(fit.num_terms, distance < 1e-3 ? 2U : 5U) << distance;
  }
}

// Whatever lies in the other lanes, and however many neighbors those have.
TEST(interpolation_fit, lanes_do_not_see_each_other) {
  Random random(6);
  const std::size_t lanes = LocalFits::lanes;
  for (std::size_t i = 0; i < scaled(100); ++i) {
    std::vector<Plane> planes;
    std::vector<std::vector<Vec>> steps;
    std::size_t most = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      planes.push_back(Plane::at(exact::to_vector(random.direction())));
      const Spots spots = random_spots(random.below(25), lane == 3 ? 0 : 1, random);
      steps.push_back(steps_to(spots, 0.1, planes.back()));
      most = std::max(most, spots.size());
    }
    LocalFits fits;
    fits.start(most);
    std::vector<LocalFits::Lanes> values(fits.num_places());
    LocalFits::Lanes here{};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      fits.set_site(lane, planes[lane].x, steps[lane].size());
      here[lane] = random.signed_unit();
      for (std::size_t k = 0; k < steps[lane].size(); ++k) {
        fits.set_neighbor(lane, k, steps[lane][k]);
        values[k][lane] = random.signed_unit();
      }
    }
    fits.find();
    const LocalFits::LaneVectors gradients = fits.gradients(values, here);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const OneFit alone(planes[lane].x, steps[lane], (lane + i) % lanes);
      ASSERT_EQ(fits.has_gradient(lane), alone.has_gradient);
      if (!alone.has_gradient) continue;
      ASSERT_EQ(fits.num_terms(lane), alone.num_terms);
      Vec sum{0, 0, 0};
      for (std::size_t k = 0; k < steps[lane].size(); ++k) {
        ASSERT_EQ(exact::to_point(fits.weight(lane, k)), exact::to_point(alone.weights[k]));
        sum = sum + (values[k][lane] - here[lane]) * alone.weights[k];
      }
      ASSERT_EQ(exact::to_point(sum),
                (Point{gradients.x[lane], gradients.y[lane], gradients.z[lane]}));
    }
  }
}

}  // namespace
}  // namespace rondel::test
