// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces and edges of constrained triangulations, compared with an oracle.
#include "unit/constrained/constrained_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "support/random.h"

namespace rondel::test::of_constrained_oracle {
namespace {

using Ends = ConstrainedOracle::Ends;

std::vector<Triple> solid_faces(const Triangulation& t) {
  std::vector<Triple> faces;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (t.is_ghost(f)) continue;
    Triple face = t.faces()[f];
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    faces.push_back(face);
  }
  std::ranges::sort(faces);
  return faces;
}

std::vector<std::array<Index, 3>> listed_pieces(const ConstrainedTriangulation& result) {
  std::vector<std::array<Index, 3>> pieces;
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    for (const Index constraint : result.sources[i]) {
      pieces.push_back({result.edges[i][0], result.edges[i][1], constraint});
    }
  }
  return pieces;
}

void expect_oracle(const ConstrainedOracle& oracle, const std::vector<Point>& sites,
                   const std::vector<Ends>& constraints) {
  const ConstrainedTriangulation result = constrained_delaunay(sites, constraints);
  ASSERT_EQ(solid_faces(result.triangulation), oracle.faces(constraints));
  ASSERT_EQ(listed_pieces(result), oracle.pieces(constraints));
  const CheckReport report = check_constrained(sites, constraints, result.triangulation.faces());
  ASSERT_EQ(report.reason, "");
}

// Tries all sets of up to two constraints, and refuses those that cross.
std::size_t try_pairs(const std::vector<Point>& sites) {
  const ConstrainedOracle oracle(sites);
  std::vector<Ends> arcs;
  for (Index a = 0; a < sites.size(); ++a) {
    for (Index b = a + 1; b < sites.size(); ++b) {
      if (oracle.has_arc({a, b})) arcs.push_back({a, b});
    }
  }
  std::size_t count = 0;
  expect_oracle(oracle, sites, {});
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    for (std::size_t j = i; j < arcs.size(); ++j) {
      const std::vector<Ends> both = {arcs[i], arcs[j]};
      if (oracle.do_cross(arcs[i], arcs[j])) {
        EXPECT_THROW(constrained_delaunay(sites, both), CrossingConstraints);
        continue;
      }
      expect_oracle(oracle, sites, both);
      if (testing::Test::HasFatalFailure()) return count;
      ++count;
    }
  }
  return count;
}

std::vector<Point> grid_places(int extent) {
  std::vector<Point> places;
  const auto is_first = [](int x, int y, int z) {
    int divisor = 0;
    for (int k = 2; k <= 4; ++k) {
      if (x % k == 0 && y % k == 0 && z % k == 0) divisor = k;
    }
    return divisor == 0 && (x != 0 || y != 0 || z != 0);
  };
  for (int x = -extent; x <= extent; ++x) {
    for (int y = -extent; y <= extent; ++y) {
      for (int z = -extent; z <= extent; ++z) {
        if (is_first(x, y, z)) places.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  return places;
}

TEST(constrained_oracle, all_four_to_six_of_a_square_grid_with_all_pairs) {
  // A grid of 3 x 3 seen from the center: a regional set with many ties, collinear sites, and
  // borders that several sites lie on.
  std::vector<Point> grid;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) grid.push_back({1.0 * x, 1.0 * y, 1});
  }
  std::size_t count = 0;
  for (unsigned set = 0; set < 1U << grid.size(); ++set) {
    std::vector<Point> sites;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if ((set >> i & 1U) != 0) sites.push_back(grid[i]);
    }
    if (sites.size() < 4 || sites.size() > 6) continue;
    const ConstrainedOracle oracle(sites);
    count += try_pairs(sites);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(count, 9'000U);
}

TEST(constrained_oracle, sets_of_small_integers_with_all_pairs) {
  const std::vector<Point> places = grid_places(1);
  Random random(1);
  std::size_t count = 0;
  for (int round = 0; round < 150; ++round) {
    std::vector<Point> sites = places;
    random.shuffle(sites);
    sites.resize(4 + random.below(3));
    count += try_pairs(sites);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(count, 5'000U);
}

// Constraints that do not cross, as many as are found in some attempts.
std::vector<Ends> random_constraints(const ConstrainedOracle& oracle, std::size_t size,
                                     Random& random) {
  std::vector<Ends> constraints;
  const std::size_t attempts = random.below(3 * size);
  for (std::size_t k = 0; k < attempts; ++k) {
    const Ends ends = {static_cast<Index>(random.below(size)),
                       static_cast<Index>(random.below(size))};
    if (ends[0] == ends[1] || !oracle.has_arc(ends)) continue;
    const bool is_free = std::ranges::none_of(
        constraints, [&](const Ends& other) { return oracle.do_cross(ends, other); });
    if (is_free) constraints.push_back(ends);
  }
  return constraints;
}

void try_random(std::vector<Point> places, std::uint64_t seed, int rounds, std::size_t largest) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round) {
    random.shuffle(places);
    const std::vector<Point> sites(
        places.begin(),
        places.begin() + static_cast<std::ptrdiff_t>(4 + random.below(largest - 3)));
    const ConstrainedOracle oracle(sites);
    expect_oracle(oracle, sites, random_constraints(oracle, sites.size(), random));
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "round " << round;
  }
}

TEST(constrained_oracle, random_sets_of_small_integers) {
  try_random(grid_places(1), 2, 1'500, 10);
  try_random(grid_places(2), 3, 1'000, 12);
  try_random(grid_places(4), 4, 300, 14);
}

TEST(constrained_oracle, random_sets_of_a_hemisphere) {
  std::vector<Point> places;
  for (const Point& p : grid_places(2)) {
    if (p.z >= 0) places.push_back(p);
  }
  try_random(places, 5, 1'000, 12);
}

TEST(constrained_oracle, random_sets_of_a_lune) {
  std::vector<Point> places;
  for (const Point& p : grid_places(2)) {
    if (p.y >= 0 && p.x >= 0) places.push_back(p);
  }
  try_random(places, 6, 1'000, 12);
}

TEST(constrained_oracle, random_sets_of_a_region) {
  std::vector<Point> places;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) places.push_back({1.0 * x, 1.0 * y, 5});
  }
  try_random(places, 7, 1'000, 14);
}

}  // namespace
}  // namespace rondel::test::of_constrained_oracle
