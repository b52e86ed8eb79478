// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "unit/arrangement/arc_sets.h"

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "exact/vector.h"

namespace rondel::test {
namespace {

class RandomPlaces {
 public:
  explicit RandomPlaces(std::uint64_t seed) : engine_(seed) {}

  // Returns a number from -1 to 1.
  double number() { return std::uniform_real_distribution<>(-1, 1)(engine_); }
  Point vector() { return {number(), number(), number()}; }
  Point place() { return normalized(vector()); }
  // Returns a place within a distance of another one in each coordinate.
  Point near(const Point& p, double distance) { return normalized(p + distance * vector()); }
  int integer(int limit) { return std::uniform_int_distribution<>(-limit, limit)(engine_); }

 private:
  std::mt19937_64 engine_;
};

using Maker = std::function<void(ArcSet&, std::size_t, RandomPlaces&)>;

Maker within(double distance) {
  return [distance](ArcSet& set, std::size_t size, RandomPlaces& random) {
    const Point center = random.place();
    for (std::size_t i = 0; i < size; ++i) {
      set.add(random.near(center, distance), random.near(center, distance));
    }
  };
}

Maker on_grid_at_axis(double spacing) {
  return [spacing](ArcSet& set, std::size_t size, RandomPlaces& random) {
    const auto end = [&] {
      constexpr int limit = 3;
      return Point{1, spacing * random.integer(limit), spacing * random.integer(limit)};
    };
    for (std::size_t i = 0; i < size; ++i) set.add(end(), end());
  };
}

// Ends near an axis on a grid, of which each coordinate may be an ulp away.
void make_two_scales(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const auto coordinate = [&] {
    const double x = 0x1p-70 * random.integer(2);
    const int turn = random.integer(1);
    return turn == 0 || x == 0 ? x : std::nextafter(x, turn);
  };
  const auto end = [&] { return Point{1, coordinate(), coordinate()}; };
  for (std::size_t i = 0; i < size; ++i) set.add(end(), end());
}

// Ends on a square grid of neighbouring doubles, whose diagonals cross where four of them are equally
// near.
void make_ulp_grid(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const auto coordinate = [&](double base) {
    return base + 0x1p-81 * static_cast<double>(2 + random.integer(2));
  };
  const auto end = [&] {
    return Point{-1, coordinate(0x1.fca7c320cfa64p-29), coordinate(0x1.41bb1577cdefp-29)};
  };
  for (std::size_t i = 0; i < size; ++i) set.add(end(), end());
}

void make_sphere(ArcSet& set, std::size_t size, RandomPlaces& random) {
  for (std::size_t i = 0; i < size; ++i) set.add(random.place(), random.place());
}

void make_grid(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const auto direction = [&] {
    for (;;) {
      const Point p = {1.0 * random.integer(2), 1.0 * random.integer(2), 1.0 * random.integer(2)};
      if (dot(p, p) != 0) return normalized(p);
    }
  };
  constexpr double nearly_opposite = -0.999;
  while (set.arcs.size() < size) {
    const Point from = direction();
    const Point to = direction();
    if (dot(from, to) > nearly_opposite) set.add(from, to);
  }
}

constexpr double ulp = 2e-16;

void make_same_circle(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const Point from = random.place();
  const Point to = random.place();
  const auto end = [&] {
    return random.near(normalized(from + (random.number() + 1) / 2 * (to - from)), ulp);
  };
  for (std::size_t i = 0; i < size; ++i) set.add(end(), end());
}

void make_pencil(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const Point middle = random.place();
  for (std::size_t i = 0; i < size; ++i) {
    const Point direction = random.place();
    const double from = 0.1 * (2 + random.number());
    const double to = 0.1 * (2 + random.number());
    set.add(random.near(normalized(middle + from * direction), ulp),
            normalized(middle - to * direction));
  }
}

void make_needles(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const Point place = random.place();
  while (set.arcs.size() < size) {
    const Point start = random.near(place, 2 * ulp);
    const Point far = random.place();
    if (dot(far, place) > -0.9) set.add(start, far);
    set.add(start, random.near(place, 2 * ulp));
  }
}

void make_nearly_half(ArcSet& set, std::size_t size, RandomPlaces& random) {
  const Point place = random.place();
  const Point beyond = random.near(-1.0 * place, 1e-3);
  while (set.arcs.size() < size) {
    set.add(random.near(place, 4 * ulp), random.near(beyond, 4 * ulp));
    set.add(random.place(), random.place());
  }
}

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> all = {{"sphere", make_sphere},
                                                   {"cap", within(1e-3)},
                                                   {"ulps", within(1e-15)},
                                                   {"grid", make_grid},
                                                   {"same_circle", make_same_circle},
                                                   {"pencil", make_pencil},
                                                   {"needles", make_needles},
                                                   {"at_axis", on_grid_at_axis(1e-16)},
                                                   {"near_axis", on_grid_at_axis(1e-40)},
                                                   {"two_scales", make_two_scales},
                                                   {"ulp_grid", make_ulp_grid},
                                                   {"nearly_half", make_nearly_half}};
  return all;
}

}  // namespace

void ArcSet::add(const Point& from, const Point& to) {
  const auto first = static_cast<Index>(points.size());
  points.push_back(from);
  points.push_back(to);
  arcs.push_back({first, first + 1});
}

std::vector<std::string> kinds_of_arc_sets() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

ArcSet arc_set(const std::string& kind, std::size_t size, std::uint64_t seed) {
  ArcSet set;
  RandomPlaces random(seed);
  makers().at(kind)(set, size, random);
  return set;
}

}  // namespace rondel::test
