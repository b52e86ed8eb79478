// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that tests of duals share: every named generator in both models.
#pragma once

#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "support/generators.h"

namespace rondel::test {

inline constexpr double ulp = 0x1p-53;

struct DualCase {
  std::string name;
  std::vector<Point> sites;
  Triangulation triangulation;
};

inline DualCase make_case(const Generator& generator, std::size_t n, std::uint64_t seed,
                          Model model) {
  SiteSet set = generator.make(n, seed);
  Triangulation triangulation =
      delaunay(set.sites, {.model = model, .sphere = set.sphere}, {.threads = 1});
  return {std::string(generator.name) + (model == Model::weighted ? " weighted " : " projected ") +
              std::to_string(n) + " " + std::to_string(seed),
          std::move(set.sites), std::move(triangulation)};
}

// visit(case) for every generator, model and seed.
template <class F>
void for_each_case(std::size_t n, std::uint64_t num_seeds, F visit) {
  for (const Generator& generator : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (generator.weighted_only && model == Model::projected) continue;
      for (std::uint64_t seed = 1; seed <= scaled(num_seeds); ++seed) {
        visit(make_case(generator, n, seed, model));
      }
    }
  }
}

inline Triangulation triangulated(std::span<const Point> sites, Model model = Model::projected) {
  return delaunay(sites, {.model = model}, {.threads = 1});
}

inline std::span<const Index> ring_of(const Cells& cells, std::size_t site) {
  return cells.rings[site];
}

inline double dot_product(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Unit vectors of the corners of the platonic solids, as doubles see them.
inline std::vector<Point> octahedron() {
  return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

inline std::vector<Point> cube() {
  std::vector<Point> result;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) result.push_back({x, y, z});
    }
  }
  return result;
}

}  // namespace rondel::test
