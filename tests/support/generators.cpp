// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/generators.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <string>

#include "rondel/delaunay.h"

namespace rondel::test {

std::span<const Generator> generators() {
  static const std::vector<Generator> all = [] {
    std::vector<Generator> result;
    for (const auto& group : {spherical_generators(), spatial_generators(), extreme_generators(),
                              hostile_generators()}) {
      result.insert(result.end(), group.begin(), group.end());
    }
    return result;
  }();
  return all;
}

const Generator& generator(std::string_view name) {
  const auto found = std::ranges::find(generators(), name, &Generator::name);
  if (found == generators().end()) throw std::invalid_argument("no generator of this name");
  return *found;
}

SiteSet Generator::make(std::size_t n, std::uint64_t seed) const {
  if (kind == nullptr) return from(n, seed);
  return {inputs::make(*kind, {.n = n, .seed = seed}).sites};
}

std::span<const Generator> hostile_generators() {
  static std::deque<std::string> names;
  static const std::vector<Generator> hostile = [] {
    std::vector<Generator> result;
    for (const inputs::Kind& kind : inputs::hostile_kinds()) {
      std::ranges::replace(names.emplace_back(kind.name), '-', '_');
      const bool has_long_integers = kind.name == "exponents";
      result.push_back({names.back(), nullptr, false, has_long_integers, &kind});
    }
    return result;
  }();
  return hostile;
}

Point unit_vector_deg(double lon, double lat) { return unit_vector({lon, lat}); }

std::vector<Point> paper_s(std::size_t n) {
  return inputs::make(*inputs::find_kind("paper-s"), {.n = n}).sites;
}

std::vector<Point> integer_sphere(int square, Random& random) {
  const int bound = static_cast<int>(std::sqrt(static_cast<double>(square))) + 1;
  std::vector<Point> points;
  for (int x = -bound; x <= bound; ++x) {
    for (int y = -bound; y <= bound; ++y) {
      for (int z = -bound; z <= bound; ++z) {
        if (x * x + y * y + z * z == square) {
          points.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  random.shuffle(points);
  return points;
}

static double test_scale() {
  const char* text = std::getenv("RONDEL_TEST_SCALE");
  return text == nullptr ? 1 : std::atof(text);
}

std::size_t scaled(std::size_t count) {
  return std::max<std::size_t>(1,
                               static_cast<std::size_t>(static_cast<double>(count) * test_scale()));
}

bool is_shortened() { return test_scale() < 1; }

}  // namespace rondel::test
