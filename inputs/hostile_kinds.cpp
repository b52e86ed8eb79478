// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "inputs/kinds.h"
#include "inputs/points.h"
#include "inputs/random.h"
#include "rondel/delaunay.h"

namespace rondel::inputs {
namespace {

// Returns the i-th of n increasing random numbers from `first` to `last`, one in each of n equal
// steps.
double in_step(Random& random, std::size_t i, std::size_t n, double first, double last) {
  const double t = (static_cast<double>(i) + random.unit()) / static_cast<double>(n);
  return first + (last - first) * t;
}

// Returns n sites: `others`, and after them place(i, count) for the `count` remaining ones.
template <class Place>
Input in_order(const Recipe& recipe, std::initializer_list<Point> others, Place place) {
  const std::size_t n = recipe.n - std::min(recipe.n, others.size());
  Input input;
  input.sites.reserve(n + others.size());
  for (std::size_t i = 0; i < n; ++i) input.sites.push_back(place(i, n));
  input.sites.insert(input.sites.end(), others.begin(), others.end());
  input.sites.resize(recipe.n);
  return input;
}

// All sites but one have x = y, bit for bit.
Input meridian(const Recipe& recipe) {
  Random random(recipe.seed);
  return in_order(recipe, {random.direction()}, [&](std::size_t i, std::size_t n) {
    const Point p = unit_vector({0, in_step(random, i, n, -90, 90)});
    const double h = p.x * std::sqrt(0.5);
    return Point{h, h, p.z};
  });
}

double nine_decimals(double degrees) { return std::round(degrees * 1e9) / 1e9; }

Input meridian_rounded(const Recipe& recipe) {
  Random random(recipe.seed);
  const double lon = nine_decimals(360 * random.unit() - 180);
  std::vector<LonLat> positions;
  positions.reserve(recipe.n);
  for (std::size_t i = 0; i + 1 < recipe.n; ++i) {
    const double lat = nine_decimals(in_step(random, i, recipe.n - 1, -90, 90));
    positions.push_back({lon, lat});
  }
  positions.push_back({nine_decimals(lon > 0 ? lon - 90 : lon + 90), 0});
  return from_positions(std::move(positions));
}

// Returns the unit vector at this angle along the great circle around frame.up.
Point along(const Frame& frame, double degrees) {
  const Point p = unit_vector({degrees, 0});
  return p.x * frame.east + p.y * frame.north;
}

Input rotated_circle(const Recipe& recipe, std::size_t others) {
  Random random(recipe.seed);
  const Frame frame = frame_around(random.direction());
  const auto place = [&](std::size_t i, std::size_t n) {
    return along(frame, in_step(random, i, n, 0, 360));
  };
  if (others == 0) return in_order(recipe, {}, place);
  if (others == 1) return in_order(recipe, {frame.up}, place);
  return in_order(recipe, {frame.up, -1.0 * frame.up}, place);
}

Input rotated_circle_0(const Recipe& recipe) { return rotated_circle(recipe, 0); }
Input rotated_circle_1(const Recipe& recipe) { return rotated_circle(recipe, 1); }
Input rotated_circle_2(const Recipe& recipe) { return rotated_circle(recipe, 2); }

Input orbit(const Recipe& recipe) {
  constexpr double step_deg = 360 * 20 / 40'030'000.0;  // a step of 20 km on the Earth
  Random random(recipe.seed);
  const Frame frame = frame_around(random.direction());
  const double start_deg = 360 * random.unit();
  return in_order(recipe, {}, [&](std::size_t i, std::size_t) {
    return along(frame, start_deg + step_deg * static_cast<double>(i));
  });
}

Input equator_and_pole(const Recipe& recipe) {
  Random random(recipe.seed);
  return in_order(recipe, {{0, 0, 1}}, [&](std::size_t i, std::size_t n) {
    return unit_vector({in_step(random, i, n, -180, 180), 0});
  });
}

// For integers a and b and a height h, the ray of (a^2 - b^2, 2 a b, h (a^2 + b^2)) is at latitude
// arctan h and longitude 2 arctan(b/a). With a, b <= 2^24 and h = 1.75 no coordinate has more than
// 52 bits, so that all rays are exactly on one small circle.
Input cocircular(const Recipe& recipe) {
  Random random(recipe.seed);
  return in_order(recipe, {}, [&](std::size_t i, std::size_t n) {
    const Point half = unit_vector({in_step(random, i, n, -90, 90), 0});
    const double a = std::round(0x1p24 * half.x);
    const double b = std::round(0x1p24 * half.y);
    return 0x1p-49 * Point{a * a - b * b, 2 * a * b, 1.75 * (a * a + b * b)};
  });
}

Input wedge(const Recipe& recipe) {
  Random random(recipe.seed);
  const double lon = 45 * random.unit();
  std::vector<LonLat> positions;
  positions.reserve(recipe.n);
  for (std::size_t i = 0; i < recipe.n; ++i) {
    const double lat = in_step(random, i, recipe.n, -90, 90);
    positions.push_back({random.coin() ? lon : lon + recipe.angle_deg, lat});
  }
  return from_positions(std::move(positions));
}

// Returns a point at the distance r from the pole, at a random longitude. x and y keep all their
// digits.
Point around_pole(Random& random, double r) {
  const Point p = unit_vector({360 * random.unit(), 0});
  return {r * p.x, r * p.y, std::sqrt((1 - r) * (1 + r))};
}

Input cap(const Recipe& recipe) {
  Random random(recipe.seed);
  const double largest = unit_vector({recipe.angle_deg, 0}).y;
  return in_order(recipe, {}, [&](std::size_t, std::size_t) {
    return around_pole(random, largest * std::sqrt(random.unit()));
  });
}

double moved_by_few_ulps(Random& random, double x) {
  const double toward = (random.coin() ? 1 : -1) * std::numeric_limits<double>::infinity();
  for (std::size_t steps = random.below(5); steps > 0; --steps) x = std::nextafter(x, toward);
  return x;
}

Input ulp_clusters(const Recipe& recipe) {
  constexpr std::size_t cluster = 16;
  Random random(recipe.seed);
  Point middle;
  return in_order(recipe, {}, [&](std::size_t i, std::size_t) {
    if (i % cluster == 0) middle = random.direction();
    const double x = moved_by_few_ulps(random, middle.x);
    const double y = moved_by_few_ulps(random, middle.y);
    return Point{x, y, moved_by_few_ulps(random, middle.z)};
  });
}

// Returns 2^-t at integers t, and interpolates linearly between them.
double falling(double t) {
  const double whole = std::floor(t);
  return std::ldexp(1 - (t - whole) / 2, -static_cast<int>(whole));
}

constexpr double last_power = 49.8;  // 2^-49.8 is 1e-15

// Each cluster is at half the distance of the one before from the pole, and half as wide.
Input falling_clusters(const Recipe& recipe) {
  Random random(recipe.seed);
  std::array<double, static_cast<std::size_t>(last_power)> lon_deg{};
  for (double& lon : lon_deg) lon = 360 * random.unit();
  return in_order(recipe, {}, [&](std::size_t, std::size_t) {
    const std::size_t k = random.below(lon_deg.size());
    const double distance = std::ldexp(0.5, -static_cast<int>(k));
    const Point middle = unit_vector({lon_deg[k], 0});
    const Point offset = random.in_ball();
    const double x = distance * (middle.x + offset.x / 4);
    const double y = distance * (middle.y + offset.y / 4);
    return Point{x, y, std::sqrt(1 - x * x - y * y)};
  });
}

// From each site to the next the longitude advances by the golden section of a turn, as in a
// sunflower.
Input falling_spiral(const Recipe& recipe) {
  constexpr double golden_deg = 137.50776405003785;
  Random random(recipe.seed);
  const double start_deg = 360 * random.unit();
  return in_order(recipe, {}, [&](std::size_t i, std::size_t n) {
    const double part = static_cast<double>(i) / static_cast<double>(n);
    const double r = falling(last_power * part);
    const Point p = unit_vector({start_deg + golden_deg * static_cast<double>(i), 0});
    return Point{r * p.x, r * p.y, std::sqrt((1 - r) * (1 + r))};
  });
}

// Returns a number whose absolute value is in [2^-996, 2^996).
double any_magnitude(Random& random) {
  const double digits = (random.coin() ? 1 : -1) * (1 + random.unit());
  return std::ldexp(digits, random.between(-996, 995));
}

Input exponents(const Recipe& recipe) {
  Random random(recipe.seed);
  return in_order(recipe, {}, [&](std::size_t, std::size_t) {
    const double x = any_magnitude(random);
    const double y = any_magnitude(random);
    return Point{x, y, any_magnitude(random)};
  });
}

Input lengths(const Recipe& recipe) {
  Random random(recipe.seed);
  return in_order(recipe, {}, [&](std::size_t, std::size_t) {
    const Point direction = random.direction();
    return any_magnitude(random) * direction;
  });
}

constexpr std::array all_hostile{
    Kind{"meridian", "in order along one meridian, in one plane bit for bit; one site off it",
         &meridian},
    Kind{"meridian-rounded",
         "in order along a meridian, in degrees with 9 decimals; one site off it",
         &meridian_rounded},
    Kind{"orbit", "a satellite's track in an inertial frame, a site each 20 m", &orbit},
    Kind{"rotated-circle-0", "in order along a great circle in any position", &rotated_circle_0},
    Kind{"rotated-circle-1", "rotated-circle-0 and one of its poles", &rotated_circle_1},
    Kind{"rotated-circle-2", "rotated-circle-0 and both of its poles", &rotated_circle_2},
    Kind{"equator-and-pole", "in order along the equator, and the north pole", &equator_and_pole},
    Kind{"cocircular", "in order along a small circle, exactly on it in the model projected",
         &cocircular},
    Kind{"wedge", "random on two meridians that are --angle apart (1e-12)", &wedge, 1e-12},
    Kind{"cap", "random within --angle (1e-15 radians) of the north pole", &cap,
         1e-15 * degrees_per_radian},
    Kind{"ulp-clusters", "clusters of 16 whose coordinates differ by a few ulps", &ulp_clusters},
    Kind{"falling-clusters", "50 clusters, each half as wide as the one before: to 1e-15",
         &falling_clusters},
    Kind{"falling-spiral", "a spiral that falls to 1e-15 radians from the north pole",
         &falling_spiral},
    Kind{"exponents", "coordinates of any magnitudes from 1e-300 to 1e300", &exponents},
    Kind{"lengths", "random directions, vectors of any lengths from 1e-300 to 1e300", &lengths},
};

}  // namespace

std::span<const Kind> hostile_kinds() { return all_hostile; }

}  // namespace rondel::inputs
