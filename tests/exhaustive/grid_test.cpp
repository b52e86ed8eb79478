// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All 4-subsets of small sets full of ties: integer grids, and the neighbors of a few points at a
// distance of one ulp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rondel/predicates.h"
#include "support/adversarial.h"
#include "support/generators.h"
#include "support/oracle.h"

namespace rondel::test {
namespace {

// Checks side_of_circle on all 4-subsets and orientation on all triples; to stay within time, a
// 4-subset is taken if its number is a multiple of `stride`.
void expect_all_subsets(const std::vector<Point>& sites, std::size_t stride) {
  for (const Model model : {Model::projected, Model::weighted}) {
    const Oracle oracle(sites, model, {});
    std::size_t number = 0;
    for (std::size_t a = 0; a < sites.size(); ++a) {
      for (std::size_t b = a + 1; b < sites.size(); ++b) {
        for (std::size_t c = b + 1; c < sites.size(); ++c) {
          ASSERT_EQ(to_int(orientation(sites[a], sites[b], sites[c])), oracle.orientation(a, b, c));
          for (std::size_t p = c + 1; p < sites.size(); ++p) {
            if (++number % stride != 0) continue;
            ASSERT_EQ(to_int(side_of_circle(sites[a], sites[b], sites[c], sites[p], model)),
                      oracle.side_of_circle(a, b, c, p))
                << a << ' ' << b << ' ' << c << ' ' << p;
          }
        }
      }
    }
  }
}

// In general position with respect to the center, so that the second level is not needed.
void expect_all_ties(const std::vector<Point>& sites, Model model, std::size_t stride) {
  const Oracle oracle(sites, model, {});
  std::size_t number = 0;
  for (std::size_t a = 0; a < sites.size(); ++a) {
    for (std::size_t b = a + 1; b < sites.size(); ++b) {
      for (std::size_t c = b + 1; c < sites.size(); ++c) {
        if (oracle.orientation(a, b, c) == 0) continue;
        for (std::size_t p = c + 1; p < sites.size(); ++p) {
          if (++number % stride != 0 || oracle.is_same_site(a, p) || oracle.is_same_site(b, p) ||
              oracle.is_same_site(c, p) || oracle.side_of_circle(a, b, c, p) != 0) {
            continue;
          }
          ASSERT_EQ(is_in_conflict(sites[a], sites[b], sites[c], sites[p], model),
                    oracle.perturbed_side(a, b, c, p) > 0)
              << a << ' ' << b << ' ' << c << ' ' << p;
        }
      }
    }
  }
}

std::vector<Point> integer_grid(int low, int high) {
  std::vector<Point> sites;
  for (int x = low; x <= high; ++x) {
    for (int y = low; y <= high; ++y) {
      for (int z = low; z <= high; ++z) {
        if (x != 0 || y != 0 || z != 0) {
          sites.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  return sites;
}

// A point and its neighbors in each coordinate.
std::vector<Point> ulp_neighbors(const Point& p) {
  constexpr double up = std::numeric_limits<double>::infinity();
  std::vector<Point> sites;
  for (const double x : {p.x, std::nextafter(p.x, up), std::nextafter(p.x, -up)}) {
    for (const double y : {p.y, std::nextafter(p.y, up)}) {
      for (const double z : {p.z, std::nextafter(p.z, -up)}) sites.push_back({x, y, z});
    }
  }
  return sites;
}

const std::size_t stride = std::max<std::size_t>(1, 3 / scaled(1));

TEST(all_subsets, of_the_grid_around_the_center) {
  expect_all_subsets(integer_grid(-1, 1), stride);
}
TEST(all_subsets, of_the_grid_beside_the_center) { expect_all_subsets(integer_grid(0, 2), stride); }
TEST(all_subsets, of_the_grid_away_from_the_center) {
  expect_all_subsets(integer_grid(1, 3), stride);
}

TEST(all_ties, of_the_grid_around_the_center) {
  for (const Model model : {Model::projected, Model::weighted}) {
    expect_all_ties(integer_grid(-1, 1), model, stride);
    expect_all_ties(integer_grid(0, 2), model, stride);
  }
}

TEST(all_subsets, of_ulp_neighbors) {
  Random random(51);
  for (std::size_t i = 0; i < scaled(4); ++i) {
    expect_all_subsets(ulp_neighbors(random_direction(random)), stride);
  }
  expect_all_subsets(ulp_neighbors({1, 0, 0}), stride);
  expect_all_subsets(ulp_neighbors({0x1p-1022, 1, 0}), stride);
}

// Neighbors of the corners of a square: far apart, and cocircular but for one ulp.
TEST(all_subsets, of_ulp_neighbors_of_cocircular_points) {
  constexpr double up = std::numeric_limits<double>::infinity();
  const double h = 0.3;
  std::vector<Point> sites;
  for (const double sx : {1.0, -1.0}) {
    for (const double sy : {1.0, -1.0}) {
      sites.push_back({0.6 * sx, 0.7 * sy, h});
      sites.push_back({0.6 * sx, 0.7 * sy, std::nextafter(h, up)});
      sites.push_back({std::nextafter(0.6, up) * sx, 0.7 * sy, h});
      sites.push_back({0.6 * sx, std::nextafter(0.7, up) * sy, std::nextafter(h, -up)});
    }
  }
  expect_all_subsets(sites, 1);
  expect_all_ties(sites, Model::projected, 1);
  expect_all_ties(sites, Model::weighted, 1);
}

}  // namespace
}  // namespace rondel::test
