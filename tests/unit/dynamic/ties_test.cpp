// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Counts how much of a facet changes when cocircular sites are inserted in order, and how many
// neighbors they have (docs/theory/perturbation.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "support/oracle.h"

namespace rondel::test {
namespace {

// 4m rays in order around the z axis, exactly on one circle: (m^2 - k^2, 2mk) has the length
// m^2 + k^2.
std::vector<Point> circle(int m, double height) {
  std::vector<Point> rays;
  for (const double side : {1.0, -1.0}) {
    for (int i = -m; i < m; ++i) {
      const double k = i;
      const double length = m * m + k * k;
      rays.push_back({side * (m * m - k * k), side * 2 * m * k, height * length});
    }
  }
  return rays;
}

struct Work {
  double mean_removed = 0;  // faces removed by an insertion
  std::size_t most_neighbors = 0;
};

// Inserts the apex, then the circle one by one. A site takes the place of d - 2 faces, d the number
// of its neighbors.
Work insert_in_order(const Point& apex, const std::vector<Point>& sites) {
  DynamicTriangulation changing;
  changing.insert(apex);
  Work work;
  for (const Point& p : sites) {
    const Index id = changing.insert(p);
    if (changing.dimension() == 2) {
      work.mean_removed += static_cast<double>(changing.neighbors(id).size()) - 2;
    }
  }
  work.mean_removed /= static_cast<double>(sites.size());
  for (Index id = 1; id <= sites.size(); ++id) {
    work.most_neighbors = std::max(work.most_neighbors, changing.neighbors(id).size());
  }
  return work;
}

void expect_little(const Work& work) {
  EXPECT_LE(work.mean_removed, 4);
  EXPECT_LE(work.most_neighbors, 60U);
}

TEST(dynamic_ties, a_small_circle_in_order_changes_little) {
  expect_little(insert_in_order({0, 0, -1}, circle(2500, 0.5)));
}

TEST(dynamic_ties, a_great_circle_in_order_changes_little) {
  expect_little(insert_in_order({0, 0, 1}, circle(2500, 0)));
}

TEST(dynamic_ties, an_equator_of_longitudes_in_order_changes_little) {
  std::vector<Point> equator;
  for (int i = 0; i < 10000; ++i) equator.push_back(unit_vector({i * 0.036, 0}));
  expect_little(insert_in_order({0, 0, 1}, equator));
}

// Corners of a facet are joined iff, on one way around, all between them are lowered more than
// both.
TEST(dynamic_ties, a_facet_is_a_treap_of_its_corners) {
  for (const double height : {0.5, 0.0}) {
    const std::vector<Point> rays = circle(40, height);
    const std::size_t size = rays.size();
    std::vector<mpz_class> keys(size);
    std::ranges::transform(rays, keys.begin(), hash_of_coordinates);
    std::vector<std::vector<Index>> expected(size);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) {
        const auto hides = [&](std::size_t from, std::size_t to) {
          for (std::size_t k = (from + 1) % size; k != to; k = (k + 1) % size) {
            if (keys[k] >= std::min(keys[i], keys[j])) return false;
          }
          return true;
        };
        if (i != j && (hides(i, j) || hides(j, i))) expected[i].push_back(static_cast<Index>(j));
      }
    }
    std::vector<Point> sites = rays;
    sites.push_back({0, 0, height > 0 ? -1.0 : 1.0});
    const DynamicTriangulation changing(sites);
    for (Index i = 0; i < size; ++i) {
      std::vector<Index> neighbors = changing.neighbors(i);
      std::erase(neighbors, static_cast<Index>(size));
      std::ranges::sort(neighbors);
      EXPECT_EQ(neighbors, expected[i]);
    }
  }
}

}  // namespace
}  // namespace rondel::test
