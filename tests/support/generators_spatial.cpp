// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites in planes, cubes, lines and balls: ties and hidden sites of the weighted model. None but
// those marked has a site at the center, so that most serve the projected model too.
#include <algorithm>
#include <array>
#include <cmath>

#include "support/generators.h"

namespace rondel::test {
namespace {

using Seed = std::uint64_t;

std::size_t side_of(std::size_t n) {
  return std::max<std::size_t>(2, static_cast<std::size_t>(std::sqrt(static_cast<double>(n))));
}

SiteSet without_center(SiteSet set) {
  std::erase(set.sites, set.sphere.center);
  return set;
}

// side^2 points a*i + b*j + origin: exactly coplanar.
SiteSet grid(std::size_t side, const Point& origin, const Point& a, const Point& b, Seed seed) {
  SiteSet set;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      set.sites.push_back(origin + static_cast<double>(i) * a + static_cast<double>(j) * b);
    }
  }
  Random random(seed);
  random.shuffle(set.sites);
  return set;
}

SiteSet planar_grid(std::size_t n, Seed seed) {
  Random random(seed);
  const Point origin = {static_cast<double>(random.between(-3, 1)),
                        static_cast<double>(random.between(-3, 1)), random.coin() ? 1.0 : -2.0};
  return grid(side_of(n), origin, {1, 0, 0}, {0, 1, 0}, seed);
}

SiteSet tilted_grid(std::size_t n, Seed seed) {
  return without_center(grid(side_of(n), {-1, -2, 2}, {1, 0, 1}, {0, 1, -1}, seed));
}

// The grid and a few sites above and below it: a flat facet of the hull, or an inner plane.
SiteSet grid_and_some(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set = planar_grid(n - n / 4, seed);
  const double z = set.sites.front().z;
  for (std::size_t i = 0; i < n / 4; ++i) {
    set.sites.push_back({static_cast<double>(random.between(-3, 3)),
                         static_cast<double>(random.between(-3, 3)), z + random.between(-2, 2)});
  }
  return without_center(set);
}

// The points of {0 .. k}^3 on the surface of the cube, k >= 1.
std::vector<Point> cube_surface(std::size_t n, Random& random) {
  const int k = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(n) / 6.0)));
  std::vector<Point> sites;
  for (int x = 0; x <= k; ++x) {
    for (int y = 0; y <= k; ++y) {
      for (int z = 0; z <= k; ++z) {
        if (x % k == 0 || y % k == 0 || z % k == 0) {
          sites.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  random.shuffle(sites);
  return sites;
}

SiteSet cube_surface_around(std::size_t n, Seed seed, const Point& center) {
  Random random(seed);
  SiteSet set{cube_surface(n, random)};
  const double k = std::ranges::max(set.sites, {}, &Point::x).x;
  set.sphere.center = k * center;
  return set;
}

SiteSet cube(std::size_t n, Seed seed) { return cube_surface_around(n, seed, {0.5, 0.5, 0.5}); }
SiteSet cube_skew(std::size_t n, Seed seed) {
  return cube_surface_around(n, seed, {0.25, 0.4375, 0.625});
}
SiteSet cube_outside(std::size_t n, Seed seed) {
  return cube_surface_around(n, seed, {-0.5, -0.25, 3});
}
SiteSet cube_in_facet(std::size_t n, Seed seed) {
  return cube_surface_around(n, seed, {0.375, 0.4375, 1});
}
SiteSet cube_beside_facet(std::size_t n, Seed seed) {
  return cube_surface_around(n, seed, {-2.25, 0.375, 1});
}
SiteSet cube_on_edge(std::size_t n, Seed seed) {
  return cube_surface_around(n, seed, {0, 0.4375, 1});
}
SiteSet cube_beyond_edge(std::size_t n, Seed seed) {
  return cube_surface_around(n, seed, {0, -1.5, 1});
}
SiteSet cube_at_corner(std::size_t n, Seed seed) { return cube_surface_around(n, seed, {0, 0, 1}); }

SiteSet small_integers(std::size_t n, Seed seed) {
  Random random(seed);
  const int bound = 1 + static_cast<int>(seed % 3);
  SiteSet set;
  while (set.sites.size() < n) {
    const Point p = {static_cast<double>(random.between(-bound, bound)),
                     static_cast<double>(random.between(-bound, bound)),
                     static_cast<double>(random.between(-bound, bound))};
    if (p != Point{}) set.sites.push_back(p);
  }
  return set;
}

SiteSet shifted_integers(std::size_t n, Seed seed) {
  SiteSet set = small_integers(n, seed);
  Random random(seed + 7);
  set.sphere.center = {random.between(-4, 4) * 0.5, random.between(-4, 4) * 0.5,
                       random.between(-4, 4) * 0.5};
  return without_center(set);
}

SiteSet integers_with_center(std::size_t n, Seed seed) {
  SiteSet set = small_integers(n, seed);
  set.sphere.center = set.sites[seed % set.sites.size()];
  return set;
}

SiteSet line(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = random.between(-6, 6);
    set.sites.push_back({1 + t, 2 - t, 3 + 2 * t});
  }
  return set;
}

SiteSet line_through_center(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const double t = random.between(-5, 5);
    if (t != 0) set.sites.push_back({t, 2 * t, -t});
  }
  return set;
}

SiteSet lines_and_some(std::size_t n, Seed seed) {
  SiteSet set = seed % 2 == 0 ? line(n / 2, seed) : line_through_center(n / 2, seed);
  const SiteSet others = small_integers(n - n / 2, seed);
  set.sites.insert(set.sites.end(), others.sites.begin(), others.sites.end());
  return set;
}

// Three parallel lines: the edges of a prism, each with collinear sites.
SiteSet prism(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const double t = random.between(-3, 3);
    constexpr std::array<std::array<double, 2>, 3> corners = {{{0, 0}, {4, 1}, {1, 3}}};
    const auto& corner = corners[random.below(3)];
    set.sites.push_back({corner[0], corner[1], t});
  }
  // Inside, in a facet, on an edge, or outside in the plane of a facet.
  constexpr std::array<Point, 4> centers = {
      {{2, 1.5, 0.25}, {2, 0.5, 0.25}, {0, 0, 0.25}, {-4, -1, 0.25}}};
  set.sphere.center = centers[seed % centers.size()];
  return set;
}

SiteSet ball(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const double length = 1 - random.unit() * random.unit();
    if (length > 0) set.sites.push_back(length * random_direction(random));
  }
  return set;
}

// Outside the ball's center: the hull is seen from outside and from below.
SiteSet ball_outside(std::size_t n, Seed seed) {
  SiteSet set = ball(n, seed);
  set.sphere.center = {1.5, -0.25, 0.125};
  return set;
}

SiteSet near_sphere(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  const double spread = std::ldexp(1.0, -random.between(4, 50));
  while (set.sites.size() < n) {
    const Point direction = random_direction(random);
    set.sites.push_back((1 + spread * random.signed_unit()) * direction);
  }
  return set;
}

// The points q / cos r of circles with radii r from 0 to 30 degrees.
SiteSet circles(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  const double min_cosine = std::sqrt(0.75);
  while (set.sites.size() < n) {
    const double cosine = min_cosine + (1 - min_cosine) * random.unit();
    set.sites.push_back((1 / cosine) * random_direction(random));
  }
  return set;
}

// Mostly points of the sphere, and some circles of up to nearly 90 degrees: lengths up to 2^50.
SiteSet mixed_magnitudes(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const bool is_huge = random.below(8) == 0;
    const int exponent = is_huge ? random.between(0, 49) : 0;
    const double length = is_huge ? std::ldexp(1 + random.unit(), exponent) : 1;
    set.sites.push_back(length * random_direction(random));
  }
  return set;
}

// Real circles, points of the sphere and imaginary circles. Half of the sites come in pairs on one
// ray, of which the shorter is hidden where the center is inside the hull.
SiteSet imaginary_circles(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const bool has_pair = !set.sites.empty() && random.below(3) == 0;
    const Point q = has_pair ? set.sites.back() : random_direction(random);
    const double length = has_pair ? 0.5 : 1 + 0.125 * random.signed_unit();
    set.sites.push_back(length * q);
  }
  return set;
}

SiteSet cube_with_center(std::size_t n, Seed seed) {
  SiteSet set = cube(n, seed);
  set.sites.push_back(set.sphere.center);
  return set;
}

constexpr std::array spatial = {
    Generator{"planar_grid", planar_grid},
    Generator{"tilted_grid", tilted_grid},
    Generator{"grid_and_some", grid_and_some},
    Generator{"cube", cube},
    Generator{"cube_skew", cube_skew},
    Generator{"cube_outside", cube_outside},
    Generator{"cube_in_facet", cube_in_facet},
    Generator{"cube_beside_facet", cube_beside_facet},
    Generator{"cube_on_edge", cube_on_edge, true},
    Generator{"cube_beyond_edge", cube_beyond_edge, true},
    Generator{"cube_at_corner", cube_at_corner, true},
    Generator{"small_integers", small_integers},
    Generator{"shifted_integers", shifted_integers},
    Generator{"integers_with_center", integers_with_center, true},
    Generator{"line", line},
    Generator{"line_through_center", line_through_center},
    Generator{"lines_and_some", lines_and_some},
    Generator{"prism", prism},
    Generator{"ball", ball},
    Generator{"ball_outside", ball_outside},
    Generator{"near_sphere", near_sphere},
    Generator{"circles", circles},
    Generator{"mixed_magnitudes", mixed_magnitudes},
    Generator{"imaginary_circles", imaginary_circles},
    Generator{"cube_with_center", cube_with_center, true},
};

}  // namespace

std::span<const Generator> spatial_generators() { return spatial; }

}  // namespace rondel::test
