// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites for what works square by square. The bytes are instructions that add sites, many at once: small
// integers, cell lines, great circles, ulps, rays, clusters, weights.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "support/generators.h"

namespace rondel::fuzz {

using test::Random;
using test::SiteSet;
using test::operator+;
using test::operator*;

inline constexpr std::size_t max_num_sites = 260;

// A place (u, v) on one of the six faces of the cube.
inline Point on_cube(unsigned face, double u, double v) {
  const double side = face % 2 == 0 ? 1 : -1;
  if (face / 2 % 3 == 0) return {side, u, v};
  return face / 2 % 3 == 1 ? Point{v, side, u} : Point{u, v, side};
}

inline double digit(Random& random, int most) { return random.between(-most, most); }

inline Point any_of(Random& random, const std::vector<Point>& sites) {
  return sites.empty() ? Point{1, 0, 0} : sites[random.below(sites.size())];
}

// Of one instruction: what its sites have in common.
struct Instruction {
  std::uint8_t kind;
  unsigned face;
  int a;
  int b;
  Random random;
};

inline Point next_point(Instruction& i, const std::vector<Point>& earlier) {
  Random& random = i.random;
  const int width = 1 + i.a % 12;
  switch (i.kind % 12) {
    case 0: {  // integers of one digit near a plane before the face
      const int depth = i.b % 4;
      const double height = width + random.between(0, depth);
      return height * on_cube(i.face, digit(random, width) / height, digit(random, width) / height);
    }
    case 1:  // the lines of cells
      return on_cube(i.face, std::ldexp(digit(random, 1 << width), -width),
                     std::ldexp(digit(random, 1 << width), -width));
    case 2: {  // in lines and corners of cells, by ulps
      Point p = on_cube(i.face, std::ldexp(digit(random, 1 << (width % 4)), -(width % 4)),
                        std::ldexp(digit(random, 1 << (i.b % 20)), -(i.b % 20)));
      for (int k = random.between(0, 3); k > 0; --k) p = test::moved_by_one_ulp(random, p);
      return p;
    }
    case 3: {  // integers on a great circle
      const Point pole = {digit(random, 0) + i.a % 5 - 2, i.a / 5 % 5 - 2.0, i.b % 5 - 2.0};
      return digit(random, 9) * test::cross_product(pole, {1, 2, 3}) +
             digit(random, 9) * test::cross_product(pole, {3, -1, 2});
    }
    case 4:  // earlier ones, by ulps
      return test::moved_by_one_ulp(random, any_of(random, earlier));
    case 5:  // the same rays
      return (1 + random.between(0, width) / 8.0) * any_of(random, earlier);
    case 6:  // nearly the same rays
      return (1 + std::ldexp(random.unit(), -(i.b % 60))) * any_of(random, earlier);
    case 7:  // a cluster
      return test::random_near(random, test::unit_vector_deg(3.0 * i.a, (i.a * 7) % 180 - 90.0),
                               std::ldexp(1, -(i.b % 60)));
    case 8: {  // weights
      const Point p = on_cube(i.face, random.signed_unit(), random.signed_unit());
      return (1 + std::ldexp(random.unit(), -(i.a % 60))) * test::normalized(p);
    }
    case 9:  // a small circle or a meridian
      return i.b % 2 == 0 ? test::unit_vector_deg(random.between(0, 360), i.a % 90)
                          : test::unit_vector_deg(i.a, random.between(-90, 90));
    case 10:  // in other scales
      return std::ldexp(1, random.between(-width, width) * (1 + i.b % 6)) * any_of(random, earlier);
    default:  // integers on a sphere
      return on_cube(i.face, digit(random, 12), digit(random, 12)) +
             (12.0 + i.a % 4) * on_cube(i.face, 0, 0);
  }
}

inline bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

inline void add_sites(ByteSource& source, std::vector<Point>& sites) {
  const std::uint8_t kind = source.byte();
  if (kind >= 240) {
    sites.push_back(next_site(source, sites, Scales::all));
    return;
  }
  const unsigned face = kind / 12;
  const std::uint8_t a = source.byte();
  const std::uint8_t b = source.byte();
  const std::size_t count = 1 + source.below(128);
  Instruction instruction = {kind, face, a, b, Random(source.byte())};
  for (std::size_t i = 0; i < count && sites.size() < max_num_sites; ++i) {
    const Point p = next_point(instruction, sites);
    if (is_finite(p)) sites.push_back(p);
  }
}

inline void move_center(ByteSource& source, SiteSet& set) {
  constexpr std::array<Point, 7> centers = {{{0.1, 0.2, -0.3},
                                             {1e6, 1, -0.1},
                                             {0x1p-30, 0, 0},
                                             {1e-20, 1, 2},
                                             {0.5, 0.25, 8},
                                             {0x1p-52, 0x1p-53, 0},
                                             {-1e300, 0, 0}}};
  const std::uint8_t kind = source.byte();
  if (kind < 160) return;
  set.sphere.center = centers[kind % centers.size()];
  for (Point& p : set.sites) p = p + set.sphere.center;
}

// All that the bytes say.
inline SiteSet block_sites(ByteSource& source, Model model) {
  SiteSet set;
  ByteSource center = source;
  source.byte();
  while (!source.is_empty() && set.sites.size() < max_num_sites) add_sites(source, set.sites);
  move_center(center, set);
  std::erase_if(set.sites, [](const Point& p) { return !is_finite(p); });
  if (model == Model::projected) remove_center(set.sites, set.sphere);
  return set;
}

}  // namespace rondel::fuzz
