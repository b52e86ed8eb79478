// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/generators.h"
#include "support/hull_check.h"

namespace rondel::test {
namespace {

using Points = std::vector<Point>;

template <class Make>
Points repeated(std::size_t n, Make make) {
  Points points(n);
  for (Point& p : points) p = make();
  return points;
}

Point in_cube(Random& random) {
  const double x = random.signed_unit();
  const double y = random.signed_unit();
  return {x, y, random.signed_unit()};
}

Point in_ball(Random& random) {
  for (;;) {
    const Point p = in_cube(random);
    if (p.x * p.x + p.y * p.y + p.z * p.z <= 1) return p;
  }
}

Points ball(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] { return in_ball(random); });
}

Points cube(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] { return in_cube(random); });
}

double normal(Random& random) {
  double sum = -6;  // of twelve uniform numbers: the tails are cut, which does not matter here
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

Points gaussian(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const double x = normal(random);
    const double y = normal(random);
    return Point{x, y, normal(random)};
  });
}

// Coplanar facets: six square grids.
Points cube_surface_grid(std::size_t n, std::uint64_t seed) {
  const auto side = std::max(2, static_cast<int>(std::sqrt(static_cast<double>(n) / 6)));
  Points points;
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      for (const int k : {0, side}) {
        const double x = i;
        const double y = j;
        const double z = k;
        points.push_back({x, y, z});
        points.push_back({y, z, x});
        points.push_back({z, x, y});
      }
    }
  }
  Random(seed).shuffle(points);
  return points;
}

Points torus(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const double u = 2 * std::numbers::pi * random.unit();
    const double v = 2 * std::numbers::pi * random.unit();
    const double r = 3 + std::cos(v);
    return Point{r * std::cos(u), r * std::sin(u), std::sin(v)};
  });
}

// On the surface of a cone and along its axis: sites whose rays meet the apex.
Points cone(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Points points = {{0, 0, 1}};
  while (points.size() < n) {
    const double h = random.unit();
    const double u = 2 * std::numbers::pi * random.unit();
    points.push_back({(1 - h) * std::cos(u), (1 - h) * std::sin(u), h});
    if (points.size() % 16 == 0) points.push_back({0, 0, random.unit()});
  }
  random.shuffle(points);
  return points;
}

Points lattice(std::size_t n, std::uint64_t seed) {
  const auto side = std::max(2, static_cast<int>(std::cbrt(static_cast<double>(n))));
  Points points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) points.push_back({double(i), double(j), double(k)});
    }
  }
  Random(seed).shuffle(points);
  return points;
}

Points half_inside(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] { return random.coin() ? in_ball(random) : random_direction(random); });
}

Points plate(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = in_cube(random);
    return Point{p.x, p.y, std::ldexp(p.z, -30)};
  });
}

// Noise of few ulps: many duplicates and ties.
Points far_away(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = in_ball(random);
    return Point{1e6 + 1e-9 * p.x, -1e6 + 1e-9 * p.y, 1e6 + 1e-9 * p.z};
  });
}

Points many_duplicates(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = in_ball(random);
    return Point{std::round(20 * p.x), std::round(20 * p.y), std::round(20 * p.z) + 0.0};
  });
}

Points planar_grid(std::size_t n, std::uint64_t seed) {
  const auto side = std::max(2, static_cast<int>(std::sqrt(static_cast<double>(n))));
  Points points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) points.push_back({double(i), double(j), 2.0 * i - 3.0 * j + 5});
  }
  Random(seed).shuffle(points);
  return points;
}

Points disk(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = in_ball(random);
    const double x = std::round(1000 * p.x);
    const double y = std::round(1000 * p.y);
    return Point{x + y, x - y, 7 + 2 * x};
  });
}

Points wall(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = in_cube(random);
    return Point{0.1, p.x, p.y};
  });
}

Points line(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const double t = random.between(-1000000, 1000000);
    return Point{t, 3 * t + 1, 2 - t};
  });
}

}  // namespace

std::span<const Cloud> solid_clouds() {
  static constexpr std::array clouds = {Cloud{"ball", ball},
                                        Cloud{"cube", cube},
                                        Cloud{"gaussian", gaussian},
                                        Cloud{"cube_surface_grid", cube_surface_grid},
                                        Cloud{"torus", torus},
                                        Cloud{"cone", cone},
                                        Cloud{"lattice", lattice},
                                        Cloud{"half_inside", half_inside},
                                        Cloud{"plate", plate},
                                        Cloud{"far_away", far_away},
                                        Cloud{"many_duplicates", many_duplicates}};
  return clouds;
}

std::span<const Cloud> flat_clouds() {
  static constexpr std::array clouds = {Cloud{"planar_grid", planar_grid}, Cloud{"disk", disk},
                                        Cloud{"wall", wall}, Cloud{"line", line}};
  return clouds;
}

}  // namespace rondel::test
