// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs between the 26 directions whose coordinates are -1, 0 or 1: where they meet is known in
// rational numbers, and no two of these places are close to each other. So the nodes and edges of
// the arrangement are those of the exact one.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "exact/vector.h"
#include "rondel/arrangement.h"
#include "support/generators.h"

namespace rondel::test::of_exact_places {
namespace {

using Ends = std::array<Index, 2>;
// A ray: small integers without a common factor.
using Ray = std::array<long, 3>;

Ray cross_of(const Ray& a, const Ray& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long dot_of(const Ray& a, const Ray& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Ray reduced(Ray ray) {
  long factor = 0;
  for (const long x : ray) factor = std::gcd(factor, std::abs(x));
  for (long& x : ray) x /= factor;
  return ray;
}

std::vector<Ray> directions() {
  std::vector<Ray> all;
  for (long x = -1; x <= 1; ++x) {
    for (long y = -1; y <= 1; ++y) {
      for (long z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) all.push_back({x, y, z});
      }
    }
  }
  return all;
}

struct ExactCounts {
  std::size_t nodes;
  std::size_t edges;
  std::vector<std::size_t> pieces;  // of each arc
};

bool is_within(const Ray& p, const Ray& a, const Ray& b) {
  const Ray normal = cross_of(a, b);
  return dot_of(normal, p) == 0 && dot_of(cross_of(a, p), normal) > 0 &&
         dot_of(cross_of(p, b), normal) > 0;
}

// Computes the arrangement in integers.
ExactCounts exact_counts(const std::vector<Ray>& rays, const std::vector<Ends>& arcs) {
  std::set<Ray> nodes;
  for (const auto& [a, b] : arcs) {
    nodes.insert({rays[a], rays[b]});
    for (const auto& [c, d] : arcs) {
      Ray line = cross_of(cross_of(rays[a], rays[b]), cross_of(rays[c], rays[d]));
      if (line == Ray{0, 0, 0}) continue;
      for (int k = 0; k < 2; ++k) {
        if (is_within(line, rays[a], rays[b]) && is_within(line, rays[c], rays[d])) {
          nodes.insert(reduced(line));
        }
        for (long& x : line) x = -x;
      }
    }
  }
  ExactCounts counts{nodes.size(), 0, {}};
  std::set<std::pair<Ray, Ray>> edges;
  for (const auto& [a, b] : arcs) {
    std::vector<Ray> chain = {rays[a], rays[b]};
    for (const Ray& node : nodes) {
      if (is_within(node, rays[a], rays[b])) chain.push_back(node);
    }
    const Ray normal = cross_of(rays[a], rays[b]);
    std::ranges::sort(
        chain, [&](const Ray& p, const Ray& q) { return dot_of(cross_of(p, q), normal) > 0; });
    for (std::size_t k = 1; k < chain.size(); ++k) {
      edges.insert(std::minmax(chain[k - 1], chain[k]));
    }
    counts.pieces.push_back(chain.size() - 1);
  }
  counts.edges = edges.size();
  return counts;
}

class ExactPlaces : public testing::Test {
 protected:
  ExactPlaces() : rays_(directions()) {
    for (const Ray& ray : rays_) {
      points_.push_back(normalized(Point{static_cast<double>(ray[0]), static_cast<double>(ray[1]),
                                         static_cast<double>(ray[2])}));
    }
    for (Index a = 0; a < rays_.size(); ++a) {
      for (Index b = a + 1; b < rays_.size(); ++b) {
        if (cross_of(rays_[a], rays_[b]) != Ray{0, 0, 0}) all_.push_back({a, b});
      }
    }
  }

  void expect_exact(const std::vector<Ends>& arcs) {
    const ExactCounts expected = exact_counts(rays_, arcs);
    const Arrangement result = arrange(points_, arcs, {1});
    ASSERT_EQ(result.nodes.size(), expected.nodes);
    ASSERT_EQ(result.edges.size(), expected.edges);
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      ASSERT_EQ(result.chains[i].size(), expected.pieces[i]);
    }
  }

  std::vector<Ray> rays_;
  std::vector<Point> points_;
  std::vector<Ends> all_;  // all 312 arcs
};

TEST_F(ExactPlaces, of_all_pairs_of_arcs) {
  for (const Ends& first : all_) {
    for (const Ends& second : all_) {
      if (!(first < second)) continue;
      ASSERT_NO_FATAL_FAILURE(expect_exact({first, second}));
    }
  }
}

TEST_F(ExactPlaces, of_random_arcs) {
  std::mt19937_64 random(11);
  const std::size_t count = scaled(30'000);
  for (std::size_t trial = 0; trial < count; ++trial) {
    std::vector<Ends> arcs(3 + trial % 8);
    for (Ends& ends : arcs) ends = all_[random() % all_.size()];
    ASSERT_NO_FATAL_FAILURE(expect_exact(arcs)) << trial;
  }
}

TEST_F(ExactPlaces, of_all_arcs_at_once) { expect_exact(all_); }

}  // namespace
}  // namespace rondel::test::of_exact_places
