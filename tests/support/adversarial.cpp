// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/adversarial.h"

#include <cmath>
#include <limits>

#include "support/generators.h"

namespace rondel::test {
namespace {

Point random_integer(Random& random, int bound) {
  for (;;) {
    const Point p = {static_cast<double>(random.between(-bound, bound)),
                     static_cast<double>(random.between(-bound, bound)),
                     static_cast<double>(random.between(-bound, bound))};
    if (p != Point{}) return p;
  }
}

Four uniform(Random& random) {
  Four four;
  for (Point& p : four) p = random_direction(random);
  return four;
}

Four at_a_distance(Random& random) {
  const double distance = random_distance(random, 1e-15);
  const Point pole = random_direction(random);
  Four four;
  for (Point& p : four) p = random_near(random, pole, distance);
  return four;
}

Four cocircular(Random& random) { return near_one_circle(random, random_distance(random, 1e-15)); }

Four cocircular_and_ulps(Random& random) {
  Four four = cocircular(random);
  for (Point& p : four) {
    if (random.coin()) p = moved_by_one_ulp(random, p);
  }
  return four;
}

// Exactly cocircular: reflections of one point keep its length and its height.
Four mirrored(Random& random) {
  const Point p = random_near(random, {0, 0, 1}, random_distance(random, 1e-15));
  return {p, {-p.x, p.y, p.z}, {-p.x, -p.y, p.z}, {p.x, -p.y, p.z}};
}

Four mirrored_and_ulp(Random& random) {
  Four four = mirrored(random);
  Point& p = four[random.below(4)];
  p = moved_by_one_ulp(random, p);
  return four;
}

Four small_integers(Random& random) {
  Four four;
  for (Point& p : four) p = random_integer(random, 2);
  return four;
}

// Integer points on one sphere: often exactly cocircular, all roots equal.
Four integer_sphere_four(Random& random) {
  static Random fixed(1);
  static const std::vector<Point> points = integer_sphere(81, fixed);
  Four four;
  for (Point& p : four) p = points[random.below(points.size())];
  return four;
}

// The same directions with other lengths: roots of several classes with exact ties.
Four rational_multiples(Random& random) {
  Four four = integer_sphere_four(random);
  for (Point& p : four) p = static_cast<double>(random.between(1, 9)) * p;
  return four;
}

// Exactly in one plane that misses the center.
Four coplanar(Random& random) {
  const Point a = random_integer(random, 9);
  const Point u = random_integer(random, 9);
  const Point v = random_integer(random, 9);
  Four four;
  for (Point& p : four) {
    do {
      p = a + static_cast<double>(random.between(-4, 4)) * u +
          static_cast<double>(random.between(-4, 4)) * v;
    } while (p == Point{});
  }
  return four;
}

// Exactly in one plane through the center.
Four great_circle(Random& random) {
  const Point u = random_integer(random, 9);
  const Point v = random_integer(random, 9);
  Four four;
  for (Point& p : four) {
    do {
      p = static_cast<double>(random.between(-4, 4)) * u +
          static_cast<double>(random.between(-4, 4)) * v;
    } while (p == Point{});
  }
  return four;
}

// Cocircular but for one coordinate that is smaller than any precision would expect.
Four far_below_ulp(Random& random) {
  Four four = random.coin() ? great_circle(random) : integer_sphere_four(random);
  for (Point& p : four) {
    if (p.z == 0 && random.coin()) p.z = std::ldexp(random.signed_unit(), -random.between(50, 900));
    if (p.x == 0 && random.coin()) p.x = std::ldexp(random.signed_unit(), -random.between(50, 900));
  }
  return four;
}

Four rescale(Random& random, Four four, bool each, int bound) {
  int exponent = random.between(-bound, bound);
  for (Point& p : four) {
    if (each) exponent = random.between(-bound, bound);
    p = std::ldexp(1.0, exponent) * p;
  }
  return four;
}

Four any_of_the_above(Random& random) {
  switch (random.below(7)) {
    case 0:
      return cocircular_and_ulps(random);
    case 1:
      return mirrored_and_ulp(random);
    case 2:
      return coplanar(random);
    case 3:
      return great_circle(random);
    case 4:
      return at_a_distance(random);
    case 5:
      return integer_sphere_four(random);
    default:
      return uniform(random);
  }
}

Four common_scale(Random& random) { return rescale(random, any_of_the_above(random), false, 990); }
Four own_scales(Random& random) { return rescale(random, any_of_the_above(random), true, 990); }
Four moderate_scales(Random& random) {
  return rescale(random, any_of_the_above(random), true, 200);
}

// Near-ties between vectors of very different lengths: q moves off the plane or the line of
// others by rounding only.
Four sums_of_scales(Random& random) {
  const Four at = rescale(random, uniform(random), true, random.coin() ? 330 : 60);
  Four four = at;
  four[1] = at[0] + random.signed_unit() * at[1];
  four[2] = at[0] + random.signed_unit() * at[2];
  four[3] = at[0] + random.signed_unit() * at[1] + random.signed_unit() * at[2];
  return four;
}

// The exact orientation of a, b, c is tiny against |a| |b-a| |c-a|: b - a and c - a are
// parallel up to rounding, at scales whose squares leave the range of doubles.
Four nearly_flat_at_any_scale(Random& random) {
  const double far = std::ldexp(1.0, random.between(-300, 300));
  const double near = std::ldexp(1.0, random.between(-700, 300));
  const double length = std::ldexp(1.0, random.between(-300, 300));
  const double y = random.signed_unit();
  const double z = random.signed_unit();
  const double factor = 1 + random.unit();
  const Point a = {far, 0, 0};
  const Point b = {far, near * y, near * z};
  const Point c = {far, length * (factor * y), length * (factor * z)};
  return {a, b, c, random_direction(random)};
}

// The ends of the range of doubles: differences overflow, products vanish.
Four ends_of_range(Random& random) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array<double, 7> sizes = {0,        Limits::denorm_min(), Limits::min(), 1,
                                           0x1p1000, Limits::max() / 2,    Limits::max()};
  Four four;
  for (Point& p : four) {
    do {
      std::array<double, 3> c{};
      for (double& x : c) x = (random.coin() ? 1 : -1) * sizes[random.below(sizes.size())];
      p = {c[0], c[1], c[2]};
    } while (p == Point{});
  }
  return four;
}

// Around the pole, where coordinates keep all their digits at any distance.
Four cap_of_any_size(Random& random) {
  const double size = random_distance(random, 1e-280);
  Four four;
  for (Point& p : four) p = {size * random.signed_unit(), size * random.signed_unit(), 1};
  return four;
}

Four ulps_of_one_site(Random& random) {
  const Point middle = random_direction(random);
  Four four;
  for (Point& p : four) {
    p = middle;
    for (int steps = random.between(0, 30); steps > 0; --steps) p = moved_by_one_ulp(random, p);
  }
  return four;
}

// Two close sites, and two others that are close elsewhere or in the same place at another scale.
Four two_pairs(Random& random) {
  Four four;
  for (std::size_t i = 0; i < 4; i += 2) {
    const Point pole = random_near(random, {0, 0, 1}, random_distance(random, 1e-10));
    four[i] = random_near(random, pole, random_distance(random, 1e-15));
    four[i + 1] = random_near(random, pole, random_distance(random, 1e-15));
  }
  return four;
}

Four coordinates_of_any_size(Random& random) {
  const int most = random.coin() ? 990 : 60;
  const auto coordinate = [&] {
    return std::ldexp(random.signed_unit(), random.between(-most, most));
  };
  Four four;
  for (Point& p : four) {
    const double x = coordinate();
    const double y = coordinate();
    p = {x, y, coordinate()};
  }
  return four;
}

constexpr std::array fours = {
    FourGenerator{"uniform", uniform},
    FourGenerator{"at_a_distance", at_a_distance},
    FourGenerator{"cocircular", cocircular},
    FourGenerator{"cocircular_and_ulps", cocircular_and_ulps},
    FourGenerator{"mirrored", mirrored},
    FourGenerator{"mirrored_and_ulp", mirrored_and_ulp},
    FourGenerator{"small_integers", small_integers},
    FourGenerator{"integer_sphere", integer_sphere_four},
    FourGenerator{"rational_multiples", rational_multiples},
    FourGenerator{"coplanar", coplanar},
    FourGenerator{"great_circle", great_circle},
    FourGenerator{"far_below_ulp", far_below_ulp},
    FourGenerator{"common_scale", common_scale},
    FourGenerator{"own_scales", own_scales},
    FourGenerator{"moderate_scales", moderate_scales},
    FourGenerator{"sums_of_scales", sums_of_scales},
    FourGenerator{"ends_of_range", ends_of_range},
    FourGenerator{"nearly_flat_at_any_scale", nearly_flat_at_any_scale},
    FourGenerator{"cap_of_any_size", cap_of_any_size},
    FourGenerator{"ulps_of_one_site", ulps_of_one_site},
    FourGenerator{"two_pairs", two_pairs},
    FourGenerator{"coordinates_of_any_size", coordinates_of_any_size},
};

}  // namespace

std::span<const FourGenerator> four_generators() { return fours; }

double random_distance(Random& random, double smallest) {
  return 2 * std::exp2(random.unit() * std::log2(smallest / 2));
}

Four near_one_circle(Random& random, double distance) {
  const Point pole = random_direction(random);
  const Point east = normalized(cross_product(pole, random_direction(random)));
  const Point north = cross_product(pole, east);
  Four four;
  for (Point& p : four) {
    const Point at = unit_vector_deg(360 * random.unit(), 0);
    p = normalized(pole + (0.5 * distance) * (at.x * east + at.y * north));
  }
  return four;
}

}  // namespace rondel::test
