// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites on or near a sphere: what matters is mostly their direction.
#include <algorithm>
#include <array>
#include <cmath>

#include "support/generators.h"

namespace rondel::test {
namespace {

using Seed = std::uint64_t;

SiteSet uniform(std::size_t n, Seed seed) {
  return {inputs::make(*inputs::find_kind("uniform"), {.n = n, .seed = seed}).sites};
}

SiteSet clustered(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const Point pole = random_direction(random);
    const double radius = std::ldexp(1.0, random.between(-50, 0));
    for (int i = 0; i < 4 && set.sites.size() < n; ++i) {
      set.sites.push_back(random_near(random, pole, radius));
    }
  }
  return set;
}

// Small integer combinations of two integer vectors, so exactly in one plane with the center.
Point on_plane(Random& random, const Point& a, const Point& b) {
  for (;;) {
    const Point along_b = static_cast<double>(random.between(-9, 9)) * b;
    const Point p = static_cast<double>(random.between(-9, 9)) * a + along_b;
    if (p != Point{}) return p;
  }
}

Point small_integer(Random& random, int bound) {
  for (;;) {
    const Point p = {static_cast<double>(random.between(-bound, bound)),
                     static_cast<double>(random.between(-bound, bound)),
                     static_cast<double>(random.between(-bound, bound))};
    if (p != Point{}) return p;
  }
}

SiteSet great_circle_and(std::size_t others, std::size_t n, Seed seed) {
  Random random(seed);
  const Point a = small_integer(random, 5);
  const Point b = small_integer(random, 5);
  SiteSet set;
  while (set.sites.size() + others < n) set.sites.push_back(on_plane(random, a, b));
  while (set.sites.size() < n) set.sites.push_back(small_integer(random, 20));
  random.shuffle(set.sites);
  return set;
}

SiteSet great_circle(std::size_t n, Seed seed) { return great_circle_and(0, n, seed); }
SiteSet great_circle_and_one(std::size_t n, Seed seed) { return great_circle_and(1, n, seed); }
SiteSet great_circle_and_some(std::size_t n, Seed seed) { return great_circle_and(n / 2, n, seed); }

// x^2 + y^2 = 65^2 at one height: exactly on one small circle.
SiteSet small_circle_and(std::size_t others, std::size_t n, Seed seed) {
  constexpr std::array<std::array<double, 2>, 5> legs = {
      {{16, 63}, {33, 56}, {25, 60}, {39, 52}, {0, 65}}};
  Random random(seed);
  const double height = random.coin() ? random.between(1, 60) : 0x1p-30;
  const std::size_t axis = random.below(3);
  SiteSet set;
  while (set.sites.size() + others < n) {
    const auto& leg = legs[random.below(legs.size())];
    const bool swap = random.coin();
    std::array<double, 3> p = {};
    p[axis] = height;
    p[(axis + 1) % 3] = (random.coin() ? 1 : -1) * leg[swap ? 1 : 0];
    p[(axis + 2) % 3] = (random.coin() ? 1 : -1) * leg[swap ? 0 : 1];
    set.sites.push_back({p[0], p[1], p[2]});
  }
  while (set.sites.size() < n) set.sites.push_back(65 * random_direction(random));
  random.shuffle(set.sites);
  return set;
}

SiteSet small_circle(std::size_t n, Seed seed) { return small_circle_and(0, n, seed); }
SiteSet small_circle_and_some(std::size_t n, Seed seed) { return small_circle_and(n / 3, n, seed); }

// Rows of latitudes, columns of longitudes. Sines come in mirrored pairs of equal
// bits, so rows and columns are exactly symmetric, and nearly on common circles otherwise.
std::vector<Point> lonlat_grid(std::size_t rows, std::size_t columns, double lat0, double lat1,
                               double lon0, double lon1) {
  std::vector<Point> sites;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double s = static_cast<double>(r) / static_cast<double>(rows - 1);
      const double t = static_cast<double>(c) / static_cast<double>(columns - 1);
      sites.push_back(unit_vector_deg(lon0 + t * (lon1 - lon0), lat0 + s * (lat1 - lat0)));
    }
  }
  return sites;
}

// The whole globe: each pole as often as there are columns, the seam twice.
SiteSet globe_grid(std::size_t n, Seed seed) {
  Random random(seed);
  const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(n))) | 1U;
  SiteSet set{lonlat_grid(std::max<std::size_t>(rows, 3), std::max<std::size_t>(n / rows, 3), -90,
                          90, -180, 180)};
  random.shuffle(set.sites);
  return set;
}

// A regional grid: its boundary meridians are facets through the center.
SiteSet regional_grid(std::size_t n, Seed seed) {
  Random random(seed);
  const auto side =
      std::max<std::size_t>(2, static_cast<std::size_t>(std::sqrt(static_cast<double>(n))));
  const double lat0 = random.between(-8, 6) * 10;
  const double lon0 = random.between(-18, 17) * 10;
  SiteSet set{lonlat_grid(side, side, lat0, lat0 + 20, lon0, lon0 + 30)};
  random.shuffle(set.sites);
  return set;
}

SiteSet antipodal_pairs(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const Point p = random_direction(random);
    set.sites.push_back(p);
    set.sites.push_back(-1.0 * p);
  }
  return set;
}

SiteSet platonic_solid(std::size_t /*n*/, Seed seed) {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  const double one = 1;
  SiteSet set;
  const auto add_signs = [&set](double x, double y, double z) {
    for (int signs = 0; signs < 8; ++signs) {
      const Point p = {(signs & 1) != 0 ? -x : x, (signs & 2) != 0 ? -y : y,
                       (signs & 4) != 0 ? -z : z};
      // -0 == 0: a zero coordinate gives each point once.
      if (std::ranges::find(set.sites, p) == set.sites.end()) set.sites.push_back(p);
    }
  };
  const auto add_cycles = [&](double x, double y, double z) {
    add_signs(x, y, z);
    add_signs(y, z, x);
    add_signs(z, x, y);
  };
  switch (seed % 5) {
    case 0:
      set.sites = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
      break;
    case 1:
      add_signs(1, 1, 1);
      break;
    case 2:
      add_cycles(1, 0, 0);
      break;
    case 3:
      add_cycles(0, one, phi);
      break;
    default:
      add_signs(1, 1, 1);
      add_cycles(0, 1 / phi, phi);
  }
  Random random(seed);
  random.shuffle(set.sites);
  return set;
}

SiteSet one_ulp_apart(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    Point p = random_direction(random);
    const std::size_t copies = 1 + random.below(4);
    for (std::size_t i = 0; i < copies && set.sites.size() < n; ++i) {
      set.sites.push_back(p);
      p = moved_by_one_ulp(random, p);
    }
  }
  return set;
}

SiteSet same_directions(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const Point p = small_integer(random, 6);
    set.sites.push_back(p);
    if (random.coin()) set.sites.push_back(random.between(2, 7) * p);
    if (random.coin()) set.sites.push_back(std::ldexp(1.0, random.between(-60, 60)) * p);
  }
  return set;
}

SiteSet exact_duplicates(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    if (!set.sites.empty() && random.coin()) {
      set.sites.push_back(set.sites[random.below(set.sites.size())]);
    } else {
      set.sites.push_back(random_direction(random));
    }
  }
  return set;
}

SiteSet hemisphere(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    Point p = random_direction(random);
    p.z = std::abs(p.z) + 0x1p-20;
    set.sites.push_back(p);
  }
  return set;
}

// Half a sphere with sites on the boundary circle: that circle is a facet through the center.
SiteSet closed_hemisphere(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    Point p = small_integer(random, 4);
    p.z = random.coin() ? 0 : std::abs(p.z);
    if (p != Point{}) set.sites.push_back(p);
  }
  return set;
}

SiteSet patch(std::size_t n, Seed seed, double radius) {
  Random random(seed);
  const Point pole = random_direction(random);
  SiteSet set;
  while (set.sites.size() < n) set.sites.push_back(random_near(random, pole, radius));
  return set;
}

SiteSet patch_1e_6(std::size_t n, Seed seed) { return patch(n, seed, 1e-6); }
SiteSet patch_1e_9(std::size_t n, Seed seed) { return patch(n, seed, 1e-9); }
SiteSet patch_1e_12(std::size_t n, Seed seed) { return patch(n, seed, 1e-12); }

SiteSet patch_and_globe(std::size_t n, Seed seed) {
  SiteSet set = patch(n / 2, seed, 1e-9);
  const SiteSet globe = uniform(n - n / 2, seed + 1);
  set.sites.insert(set.sites.end(), globe.sites.begin(), globe.sites.end());
  return set;
}

SiteSet s_n(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set{paper_s(std::max<std::size_t>(n, 6) - 5)};
  random.shuffle(set.sites);
  return set;
}

SiteSet few(std::size_t /*n*/, Seed seed) {
  Random random(seed);
  SiteSet set;
  for (std::size_t count = seed % 6; count > 0; --count) {
    set.sites.push_back(small_integer(random, 2));
  }
  return set;
}

SiteSet integer_sphere_sites(std::size_t n, Seed seed) {
  constexpr std::array<int, 5> squares = {9, 26, 81, 89, 161};
  Random random(seed);
  SiteSet set{integer_sphere(squares[seed % squares.size()], random)};
  if (set.sites.size() > n) set.sites.resize(n);
  return set;
}

SiteSet mirrored(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const Point p = random_direction(random);
    for (int signs = 0; signs < 8 && set.sites.size() < n; ++signs) {
      set.sites.push_back({(signs & 1) != 0 ? -p.x : p.x, (signs & 2) != 0 ? -p.y : p.y,
                           (signs & 4) != 0 ? -p.z : p.z});
    }
  }
  return set;
}

constexpr std::array spherical = {
    Generator{"uniform", uniform},
    Generator{"clustered", clustered},
    Generator{"great_circle", great_circle},
    Generator{"great_circle_and_one", great_circle_and_one},
    Generator{"great_circle_and_some", great_circle_and_some},
    Generator{"small_circle", small_circle},
    Generator{"small_circle_and_some", small_circle_and_some},
    Generator{"globe_grid", globe_grid},
    Generator{"regional_grid", regional_grid},
    Generator{"antipodal_pairs", antipodal_pairs},
    Generator{"platonic_solid", platonic_solid},
    Generator{"one_ulp_apart", one_ulp_apart},
    Generator{"same_directions", same_directions},
    Generator{"exact_duplicates", exact_duplicates},
    Generator{"hemisphere", hemisphere},
    Generator{"closed_hemisphere", closed_hemisphere},
    Generator{"patch_1e_6", patch_1e_6},
    Generator{"patch_1e_9", patch_1e_9},
    Generator{"patch_1e_12", patch_1e_12},
    Generator{"patch_and_globe", patch_and_globe},
    Generator{"s_n", s_n},
    Generator{"few", few},
    Generator{"integer_sphere", integer_sphere_sites},
    Generator{"mirrored", mirrored},
};

}  // namespace

std::span<const Generator> spherical_generators() { return spherical; }

}  // namespace rondel::test
