// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The ends of the range of doubles, and centers far away from zero or from the sites.
#include <array>
#include <cmath>
#include <limits>

#include "support/generators.h"

namespace rondel::test {
namespace {

using Seed = std::uint64_t;

SiteSet scaled_to(std::string_view name, std::size_t n, Seed seed, int low, int high) {
  Random random(seed);
  SiteSet set = generator(name).make(n, seed);
  for (Point& p : set.sites) p = std::ldexp(1.0, random.between(low, high)) * p;
  return set;
}

SiteSet tiny(std::size_t n, Seed seed) {
  return scaled_to("great_circle_and_some", n, seed, -998, -998);
}
SiteSet huge(std::size_t n, Seed seed) {
  return scaled_to("small_circle_and_some", n, seed, 990, 990);
}
SiteSet mixed_scales(std::size_t n, Seed seed) {
  return scaled_to("integer_sphere", n, seed, -990, 990);
}
SiteSet moderate_scales(std::size_t n, Seed seed) {
  return scaled_to("one_ulp_apart", n, seed, -200, 200);
}
SiteSet subnormal(std::size_t n, Seed seed) {
  return scaled_to("integer_sphere", n, seed, -1074, -1060);
}

// Coordinates from the ends of the range, where every difference and product is lost.
SiteSet ends_of_range(std::size_t n, Seed seed) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array<double, 7> sizes = {0,        Limits::denorm_min(), Limits::min(), 1,
                                           0x1p1000, Limits::max() / 2,    Limits::max()};
  Random random(seed);
  const auto coordinate = [&] {
    const double sign = random.coin() ? 1 : -1;
    return sign * sizes[random.below(sizes.size())];
  };
  SiteSet set;
  if (seed % 3 == 1) set.sphere.center = {Limits::max(), 0, -1};
  while (set.sites.size() < n) {
    const Point p = {coordinate(), coordinate(), coordinate()};
    if (p != set.sphere.center) set.sites.push_back(p);
  }
  return set;
}

// Zeros of both signs are one number.
SiteSet signed_zeros(std::size_t n, Seed seed) {
  constexpr std::array<double, 4> values = {0.0, -0.0, 1.0, -1.0};
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const Point p = {values[random.below(4)], values[random.below(4)], values[random.below(4)]};
    if (p != Point{}) set.sites.push_back(p);
  }
  return set;
}

// Sites around a center whose distance to the site is not exact in doubles.
SiteSet around(std::size_t n, Seed seed, const Point& center) {
  SiteSet set = generator(seed % 2 == 0 ? "uniform" : "integer_sphere").make(n, seed);
  for (Point& p : set.sites) p = p + center;
  set.sphere.center = center;
  std::erase(set.sites, center);
  return set;
}

SiteSet far_center(std::size_t n, Seed seed) { return around(n, seed, {0.1, -3, 1e6}); }
SiteSet very_far_center(std::size_t n, Seed seed) { return around(n, seed, {1e10, -1e10, 0.3}); }

// Rays that are distinct but closer than any precision: a small grid seen from far away, and
// a pole with neighbors at 1e-300.
SiteSet remote_center(std::size_t n, Seed seed) {
  constexpr std::array<Point, 4> centers = {
      {{1e17, 3, 5}, {-1e300, 1, 0}, {1e40, -1e40, 1e40}, {0, 0, 3e25}}};
  SiteSet set = generator(seed % 2 == 0 ? "small_integers" : "uniform").make(n, seed);
  set.sphere.center = centers[seed % centers.size()];
  return set;
}

SiteSet needle(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const double size = seed % 2 == 0 ? 1e-300 : 1e-25;
    set.sites.push_back({1, size * random.between(-3, 3), size * random.between(-3, 3)});
  }
  return set;
}

// Sites spread over all distances from a pole, from 1 down to far below one ulp.
SiteSet funnel(std::size_t n, Seed seed) {
  Random random(seed);
  SiteSet set;
  while (set.sites.size() < n) {
    const double size = std::ldexp(1.0, -random.between(0, 400));
    set.sites.push_back({size * random.signed_unit(), size * random.signed_unit(), -1});
  }
  return set;
}

constexpr std::array extreme = {
    Generator{"tiny", tiny},
    Generator{"huge", huge},
    Generator{"mixed_scales", mixed_scales},
    Generator{"moderate_scales", moderate_scales},
    Generator{"subnormal", subnormal},
    Generator{"ends_of_range", ends_of_range, false, true},
    Generator{"signed_zeros", signed_zeros},
    Generator{"far_center", far_center},
    Generator{"very_far_center", very_far_center},
    Generator{"remote_center", remote_center, false, true},
    Generator{"needle", needle},
    Generator{"funnel", funnel},
};

}  // namespace

std::span<const Generator> extreme_generators() { return extreme; }

}  // namespace rondel::test
