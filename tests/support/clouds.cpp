// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

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

// Of the inputs that all programs share.
Points shared(std::string_view kind, std::size_t n, std::uint64_t seed) {
  return inputs::make(*inputs::find_kind(kind), {.n = n, .seed = seed}).sites;
}
Points ball(std::size_t n, std::uint64_t seed) { return shared("ball", n, seed); }
Points cube(std::size_t n, std::uint64_t seed) { return shared("cube", n, seed); }
Points gaussian(std::size_t n, std::uint64_t seed) { return shared("gaussian", n, seed); }

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

// A point of the unit circle.
Point around(Random& random) { return unit_vector_deg(360 * random.unit(), 0); }

Points torus(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point along = around(random);
    const Point across = around(random);
    const double r = 3 + across.x;
    return Point{r * along.x, r * along.y, across.y};
  });
}

// On the surface of a cone and along its axis: sites whose rays meet the apex.
Points cone(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Points points = {{0, 0, 1}};
  while (points.size() < n) {
    const double h = random.unit();
    const Point p = around(random);
    points.push_back({(1 - h) * p.x, (1 - h) * p.y, h});
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
  return repeated(n, [&] { return random.coin() ? random.in_ball() : random_direction(random); });
}

Points plate(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = random.in_cube();
    return Point{p.x, p.y, std::ldexp(p.z, -30)};
  });
}

// Noise of few ulps: many duplicates and ties.
Points far_away(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = random.in_ball();
    return Point{1e6 + 1e-9 * p.x, -1e6 + 1e-9 * p.y, 1e6 + 1e-9 * p.z};
  });
}

Points many_duplicates(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = random.in_ball();
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
    const Point p = random.in_ball();
    const double x = std::round(1000 * p.x);
    const double y = std::round(1000 * p.y);
    return Point{x + y, x - y, 7 + 2 * x};
  });
}

Points wall(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  return repeated(n, [&] {
    const Point p = random.in_cube();
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
