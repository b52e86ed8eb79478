// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "inputs.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "rondel/delaunay.h"
#include "rondel/io.h"

namespace rondel::bench {
namespace {

// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
class Random {
 public:
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  Point in_cube() {
    const double x = 2 * uniform() - 1;
    const double y = 2 * uniform() - 1;
    const double z = 2 * uniform() - 1;
    return {x, y, z};
  }

  Point in_ball() {
    for (;;) {
      const Point p = in_cube();
      if (p.x * p.x + p.y * p.y + p.z * p.z <= 1) return p;
    }
  }

  // The polar method (Marsaglia and Bray, SIAM Review 6, 1964).
  double normal() {
    for (;;) {
      const double a = 2 * uniform() - 1;
      const double b = 2 * uniform() - 1;
      const double squared = a * a + b * b;
      if (squared >= 1 || squared == 0) continue;
      return a * std::sqrt(-2 * std::log(squared) / squared);
    }
  }

  Point on_sphere() {
    for (;;) {
      const double x = 2 * uniform() - 1;
      const double y = 2 * uniform() - 1;
      const double z = 2 * uniform() - 1;
      const double squared = x * x + y * y + z * z;
      if (squared > 1 || squared < 0.01) continue;
      const double length = std::sqrt(squared);
      return {x / length, y / length, z / length};
    }
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  std::uint64_t state_ = 2010;
};

std::vector<Point> fibonacci(std::size_t n) {
  std::vector<Point> sites;
  const double turn = 360 * (std::numbers::phi - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double r = std::sqrt(1 - z * z);
    const Point p = unit_vector({std::fmod(static_cast<double>(i) * turn, 360.0), 0});
    sites.push_back({r * p.x, r * p.y, z});
  }
  return sites;
}

std::vector<Point> grid(std::size_t n) {
  const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 2));
  std::vector<LonLat> positions;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < 2 * rows; ++j) {
      positions.push_back({-180 + 180 * static_cast<double>(j) / static_cast<double>(rows),
                           -90 + 180 * (static_cast<double>(i) + 0.5) / static_cast<double>(rows)});
    }
  }
  return unit_vectors(positions);
}

std::vector<Point> patch(std::size_t n, Random& random) {
  std::vector<Point> sites;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 1e-6 * (random.uniform() - 0.5);
    const double b = 1e-6 * (random.uniform() - 0.5);
    const Point p = {0.6 - 0.8 * a, b, 0.8 + 0.6 * a};
    const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    sites.push_back({p.x / length, p.y / length, p.z / length});
  }
  for (int i = 0; i < 1000; ++i) sites.push_back(random.on_sphere());
  return sites;
}

// The set S_n of the paper, section 5.
std::vector<Point> paper_s(std::size_t n) {
  constexpr double pi = std::numbers::pi;
  std::vector<Point> sites;
  for (std::size_t i = 0; i <= n; ++i) {
    const double theta = pi * static_cast<double>(i) / static_cast<double>(n);
    const double phi = (theta * theta + 1) / (pi * pi);
    sites.push_back(
        {std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi), std::cos(phi)});
  }
  const double s = 1 / std::sqrt(3.0);
  sites.insert(sites.end(), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-s, -s, -s}});
  return sites;
}

}  // namespace

std::vector<Point> make_input(const std::string& kind, std::size_t n) {
  Random random;
  const auto repeated = [n](auto make) {
    std::vector<Point> sites(n);
    for (Point& p : sites) p = make();
    return sites;
  };
  if (kind == "uniform") return repeated([&] { return random.on_sphere(); });
  if (kind == "circles" || kind == "small-circles") {
    const double largest_deg = kind == "circles" ? 30 : 0.3;
    return repeated(
        [&] { return polar_point(random.on_sphere(), largest_deg * random.uniform()); });
  }
  if (kind == "mixed-weights") {
    auto sites = repeated([&] { return random.on_sphere(); });
    Point& far = sites[n / 2];
    far = {1e15 * far.x, 1e15 * far.y, 1e15 * far.z};
    return sites;
  }
  if (kind == "ball") return repeated([&] { return random.in_ball(); });
  if (kind == "cube") return repeated([&] { return random.in_cube(); });
  if (kind == "gaussian") {
    return repeated([&] {
      const double x = random.normal();
      const double y = random.normal();
      return Point{x, y, random.normal()};
    });
  }
  if (kind == "fibonacci") return fibonacci(n);
  if (kind == "grid") return grid(n);
  if (kind == "patch") return patch(n, random);
  if (kind == "paper-s") return paper_s(n);
  if (kind.ends_with(".csv") || kind.ends_with(".npy")) {
    const SiteTable table = read_sites(kind);
    return {table.sites.begin(), table.sites.end()};
  }
  throw std::invalid_argument("unknown kind of input: " + kind);
}

}  // namespace rondel::bench
