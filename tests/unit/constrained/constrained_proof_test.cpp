// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random integer sites with many constraints. What determines the result (docs/theory/constrained.md)
// is proved in integers; RONDEL_TEST_SCALE=34 makes 100,000 rounds of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/constrained/integer_places.h"

namespace rondel::test::of_constrained_proof {
namespace {

using Arc = IntegerPlaces::Arc;

// Constraints between sites, and the parts between places into which they are divided.
struct DividedConstraints {
  std::vector<Arc> ends;              // sites
  std::vector<Arc> parts;             // places, the lower one first
  std::map<Arc, std::set<Index>> of;  // the constraints of each part
};

// Returns as many constraints that do not cross as are found in some attempts.
DividedConstraints random_constraints(const IntegerPlaces& places, std::size_t num_sites,
                                      Random& random) {
  DividedConstraints made;
  const std::size_t attempts = random.below(3 * num_sites);
  for (std::size_t k = 0; k < attempts; ++k) {
    const Arc ends = {static_cast<Index>(random.below(num_sites)),
                      static_cast<Index>(random.below(num_sites))};
    const Arc arc = {places.place(ends[0]), places.place(ends[1])};
    if (!places.has_arc(arc)) continue;
    const std::vector<Index> chain = places.chain(arc);
    std::vector<Arc> parts;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      parts.push_back({std::min(chain[i - 1], chain[i]), std::max(chain[i - 1], chain[i])});
    }
    const bool does_cross = std::ranges::any_of(parts, [&](const Arc& part) {
      return std::ranges::any_of(made.parts,
                                 [&](const Arc& other) { return places.do_cross(part, other); });
    });
    if (does_cross) continue;
    for (const Arc& part : parts) {
      if (made.of.find(part) == made.of.end()) made.parts.push_back(part);
      made.of[part].insert(static_cast<Index>(made.ends.size()));
    }
    made.ends.push_back(ends);
  }
  return made;
}

using ApexOfSide = std::map<Arc, Index>;  // the third corner of the solid face on the left

// Lists the sides of solid faces, as places. Faces are positive and have no side in common.
void list_sides(const Triangulation& t, const IntegerPlaces& places, std::vector<Triple>& faces,
                ApexOfSide& apex) {
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (t.is_ghost(f)) continue;
    Triple face = t.faces()[f];
    for (Index& corner : face) {
      ASSERT_EQ(places.name(places.place(corner)), corner);
      corner = places.place(corner);
    }
    ASSERT_GT(places.orientation(face[0], face[1], face[2]), 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const Arc side = {face[i], face[(i + 1) % 3]};
      ASSERT_TRUE(apex.insert({side, face[(i + 2) % 3]}).second);
    }
    faces.push_back(face);
  }
}

// The faces cover what is within the border of the sites, once.
void expect_cover(const IntegerPlaces& places, const std::vector<Triple>& faces,
                  const ApexOfSide& apex) {
  std::set<Index> corners;
  for (const auto& [side, third] : apex) {
    const bool is_inner = apex.contains({side[1], side[0]});
    ASSERT_EQ(!is_inner, places.is_border(side));
    corners.insert(third);
  }
  ASSERT_EQ(corners.size(), places.size());
  for (std::int64_t number = 0; number < 100; ++number) {
    const IntegerRay ray = places.inner_ray(faces.front(), number);
    std::array<std::size_t, 3> count{};
    for (const Triple& face : faces) {
      ++count[static_cast<std::size_t>(places.side_of_face(face, ray) + 1)];
    }
    if (count[1] > 0) continue;
    ASSERT_EQ(count[2], 1U);
    return;
  }
  FAIL() << "no ray is apart from all sides";
}

void expect_proof(const std::vector<Point>& sites, Random& random) {
  const IntegerPlaces places(sites);
  const DividedConstraints given = random_constraints(places, sites.size(), random);
  const ConstrainedTriangulation result = constrained_delaunay(sites, given.ends);
  std::map<Arc, std::set<Index>> listed;
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    const auto sources = result.sources[i];
    Arc part = {places.place(result.edges[i][0]), places.place(result.edges[i][1])};
    if (part[0] > part[1]) std::swap(part[0], part[1]);
    listed[part] = {sources.begin(), sources.end()};
  }
  ASSERT_EQ(listed, given.of);
  if (result.triangulation.dimension() < 2) return;
  std::vector<Triple> faces;
  ApexOfSide apex;
  list_sides(result.triangulation, places, faces, apex);
  if (testing::Test::HasFatalFailure()) return;
  expect_cover(places, faces, apex);
  for (const Arc& part : given.parts) {
    ASSERT_TRUE(apex.contains(part) || apex.contains({part[1], part[0]}));
  }
  for (const auto& [side, third] : apex) {
    const auto other = apex.find({side[1], side[0]});
    if (side[0] > side[1] || other == apex.end() || given.of.contains(side)) continue;
    ASSERT_FALSE(places.is_above(side[0], side[1], third, other->second));
  }
}

// The kinds of sites.
std::vector<Point> integers(int extent, bool (*is_wanted)(int x, int y, int z)) {
  std::vector<Point> all;
  for (int x = -extent; x <= extent; ++x) {
    for (int y = -extent; y <= extent; ++y) {
      for (int z = -extent; z <= extent; ++z) {
        if ((x != 0 || y != 0 || z != 0) && is_wanted(x, y, z))
          all.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  return all;
}

void try_rounds(std::vector<Point> all, std::uint64_t seed, std::size_t rounds) {
  Random random(seed);
  for (std::size_t round = 0; round < scaled(rounds); ++round) {
    random.shuffle(all);
    const std::size_t size = std::min(all.size(), 8 + random.below(33));
    expect_proof({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size)}, random);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "round " << round;
  }
}

TEST(constrained_proof, integers_and_duplicates) {
  // Two of three places of the smallest directions occur several times.
  try_rounds(integers(3, [](int, int, int) { return true; }), 1, 500);
  try_rounds(integers(7, [](int, int, int) { return true; }), 2, 500);
}

TEST(constrained_proof, sites_on_few_circles) {
  try_rounds(integers(6, [](int x, int y, int z) { return x * x + y * y + z * z == 41; }), 3, 500);
  try_rounds(
      integers(7, [](int x, int y,
                     int z) { return z == 3 && (x * x + y * y == 25 || x * x + y * y == 50); }),
      4, 250);
}

TEST(constrained_proof, sites_on_few_great_circles) {
  try_rounds(integers(4, [](int x, int y, int z) { return z == 0 || x + y + z == 0; }), 5, 500);
  try_rounds(integers(5, [](int x, int y, int z) { return x == y || (y == 0 && z >= 0); }), 6, 250);
}

TEST(constrained_proof, sites_of_a_hemisphere_and_of_a_region) {
  try_rounds(integers(3, [](int, int, int z) { return z >= 0; }), 7, 250);
  try_rounds(integers(7, [](int x, int y, int z) { return z == 7 && x >= y; }), 8, 250);
}

}  // namespace
}  // namespace rondel::test::of_constrained_proof
