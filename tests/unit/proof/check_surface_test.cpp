// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Refutations that need no coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proof/sites_by_place.h"
#include "proof/surface.h"
#include "rondel/predicates.h"
#include "support/generators.h"
#include "support/hull_oracle.h"
#include "unit/proof/check_support.h"

namespace rondel::test {
namespace {

std::string flaw(std::size_t num_sites, const std::vector<Triple>& faces) {
  return proof::Surface(num_sites, faces).flaw();
}

std::vector<Triple> tetrahedron(Index first = 0) {
  const Index a = first;
  return {{a, a + 1, a + 2}, {a, a + 2, a + 3}, {a, a + 3, a + 1}, {a + 1, a + 3, a + 2}};
}

TEST(check_surface, accepts_a_tetrahedron_in_any_numbering) {
  const std::vector<Triple> faces = tetrahedron();
  const proof::Surface surface(4, faces);
  EXPECT_EQ(surface.flaw(), "");
  EXPECT_EQ(surface.num_vertices(), 4U);
  EXPECT_EQ(surface.num_edges(), 6U);
  EXPECT_EQ(surface.link(0), (std::vector<Index>{3, 1, 2}));
  EXPECT_EQ(flaw(9, tetrahedron(5)), "");
}

TEST(check_surface, lists_links_counterclockwise) {
  const Solid octahedron = solid(octahedron_sites());
  const proof::Surface surface(6, octahedron.faces);
  ASSERT_EQ(surface.flaw(), "");
  std::vector<Index> ring = surface.link(2);
  std::rotate(ring.begin(), std::ranges::find(ring, 0U), ring.end());
  EXPECT_EQ(ring, (std::vector<Index>{0, 1, 3, 4}));
}

TEST(check_surface, accepts_two_faces_back_to_back) {
  EXPECT_EQ(flaw(3, {{0, 1, 2}, {0, 2, 1}}), "");
}

TEST(check_surface, refutes_a_corner_out_of_range) {
  auto faces = tetrahedron();
  faces[2][1] = 4;
  EXPECT_EQ(flaw(4, faces), "face 2 has corner 4, but there are 4 sites");
}

TEST(check_surface, refutes_a_repeated_corner) {
  for (const Triple& corners : {Triple{1, 1, 2}, Triple{1, 2, 1}, Triple{2, 1, 1}}) {
    auto faces = tetrahedron();
    faces[3] = corners;
    EXPECT_EQ(flaw(4, faces), "face 3 has corner 1 twice");
  }
}

TEST(check_surface, refutes_more_faces_than_sites_can_have) {
  EXPECT_EQ(flaw(1, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}),
            "there are 3 faces, but 1 sites have at most 2n-4");
}

TEST(check_surface, refutes_a_missing_face) {
  auto faces = tetrahedron();
  faces.pop_back();
  EXPECT_EQ(flaw(4, faces), "edge 1-2 belongs to face 0 only");
}

TEST(check_surface, refutes_a_face_given_twice) {
  auto faces = tetrahedron();
  faces.push_back({2, 0, 1});
  EXPECT_EQ(flaw(4, faces), "faces 0 and 4 are the same");
}

TEST(check_surface, refutes_a_doubly_covered_surface) {
  auto faces = tetrahedron();
  for (const Triple& face : tetrahedron()) faces.push_back(face);
  EXPECT_EQ(flaw(9, faces), "faces 0 and 4 are the same");
}

TEST(check_surface, refutes_a_third_face_at_an_edge) {
  auto faces = tetrahedron();
  faces.push_back({0, 1, 4});
  EXPECT_EQ(flaw(5, faces), "edge 0-1 belongs to 3 faces, among them 0, 2 and 4");
}

TEST(check_surface, refutes_one_reversed_face) {
  auto faces = tetrahedron();
  faces[1] = reversed(faces[1]);
  EXPECT_EQ(flaw(4, faces),
            "faces 0 and 1 run along edge 0-2 in the same direction: one of them is reversed");
}

TEST(check_surface, refutes_a_pinched_vertex) {
  auto faces = tetrahedron();
  for (Triple face : tetrahedron(3)) faces.push_back(face);
  EXPECT_EQ(flaw(7, faces),
            "the surface is pinched at site 3: its 6 faces form more than one cycle");
}

TEST(check_surface, refutes_two_disjoint_surfaces) {
  auto faces = tetrahedron();
  for (Triple face : tetrahedron(4)) faces.push_back(face);
  EXPECT_EQ(flaw(8, faces),
            "the surface is not connected: no path over edges leads from face 0 to face 4");
}

TEST(check_surface, refutes_a_torus) {
  std::vector<Triple> faces;  // the torus with seven vertices
  for (Index i = 0; i < 7; ++i) {
    faces.push_back({i, (i + 1) % 7, (i + 3) % 7});
    faces.push_back({i, (i + 3) % 7, (i + 2) % 7});
  }
  EXPECT_EQ(flaw(7, faces), "V - E + F is not 2: 7 vertices, 21 edges, 14 faces");
}

// Duplicates are found exactly and completely.

std::vector<Index> first_of(const std::vector<Point>& sites, Model model,
                            const Sphere& sphere = {}) {
  return proof::group_by_place(sites, model, sphere).first;
}

// By comparing all pairs.
std::vector<Index> first_by_pairs(const std::vector<Point>& sites, Model model,
                                  const Sphere& sphere) {
  std::vector<Index> first(sites.size());
  for (Index i = 0; i < sites.size(); ++i) {
    for (first[i] = 0; !is_same_site(sites[first[i]], sites[i], model, sphere);) ++first[i];
  }
  return first;
}

TEST(check_places, finds_the_same_ray_at_any_length) {
  const std::vector<Point> sites = {{1, 2, 3},
                                    {2, 4, 6},
                                    {-1, -2, -3},
                                    {1e-300, 2e-300, 3e-300},
                                    {0x1p900, 0x1p901, 0x1.8p901},
                                    {0x1p-1070, 0x1p-1069, 0x1.8p-1069}};
  const auto first = first_of(sites, Model::projected);
  EXPECT_EQ(first[1], 0U);
  EXPECT_EQ(first[2], 2U);
  EXPECT_EQ(first[4], 0U);
  EXPECT_EQ(first[5], 0U);
  EXPECT_EQ(first, first_by_pairs(sites, Model::projected, {}));
}

TEST(check_places, names_the_lowest_index_and_the_lexicographically_smallest_speaker) {
  const std::vector<Point> sites = {{0, 0, 1}, {3, 6, 9}, {1, 2, 3}, {2, 4, 6}};
  const proof::SitesByPlace places = proof::group_by_place(sites, Model::projected, {});
  EXPECT_EQ(places.first, (std::vector<Index>{0, 1, 1, 1}));
  EXPECT_EQ(places.representative[1], 2U);
}

TEST(check_places, tells_both_zeros_from_the_smallest_number_only) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<Point> sites = {{1, 0.0, 0}, {1, -0.0, 0}, {2, 0.0, -0.0}, {1, tiny, 0}};
  EXPECT_EQ(first_of(sites, Model::projected), (std::vector<Index>{0, 0, 0, 3}));
  EXPECT_EQ(first_of(sites, Model::weighted), (std::vector<Index>{0, 0, 2, 3}));
}

// Ratios that round differently on the same ray, near cell borders and edges of the cube.
TEST(check_places, agrees_with_all_pairs_around_every_border) {
  Random random(3);
  for (int repeat = 0; repeat < 400; ++repeat) {
    std::vector<Point> sites;
    const Point base = repeat % 2 == 0 ? Point{1, random.coin() ? 1.0 : -1.0, random.unit()}
                                       : random_direction(random);
    for (int i = 0; i < 24; ++i) {
      Point p = base;
      if (random.coin()) p = moved_by_one_ulp(random, p);
      const double length =
          std::ldexp(1.0 + static_cast<double>(random.below(3)), random.between(-300, 300));
      sites.push_back(length * p);
    }
    EXPECT_EQ(first_of(sites, Model::projected), first_by_pairs(sites, Model::projected, {}));
    EXPECT_EQ(first_of(sites, Model::weighted), first_by_pairs(sites, Model::weighted, {}));
  }
}

// Rays nearer to each other than any grid of doubles can tell: one cell holds them all.
TEST(check_places, orders_one_cell_exactly) {
  Sphere sphere;
  sphere.center = {1, 0, 0};
  std::vector<Point> sites;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j)
      sites.push_back({i * 1e-30, 0.25 + 0x1p-50 * (j % 5), j % 3 * 0.5});
  }
  EXPECT_EQ(first_of(sites, Model::projected, sphere),
            first_by_pairs(sites, Model::projected, sphere));
}

TEST(check_places, agrees_with_the_oracle_on_every_kind) {
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      const SiteSet set = kind.make(40, 9);
      EXPECT_EQ(first_of(set.sites, model, set.sphere),
                first_by_pairs(set.sites, model, set.sphere))
          << kind.name;
    }
  }
}

TEST(check_places, does_not_overflow) {
  Sphere sphere;
  sphere.center = {-1.7e308, 0, 0};
  const std::vector<Point> sites = {
      {1.7e308, 1e300, 5e-324}, {1.7e308, 1e300, 0}, {0, 0.5e300, 0}, {1.7e308, 1e300, 5e-324}};
  EXPECT_EQ(first_of(sites, Model::projected, sphere), (std::vector<Index>{0, 1, 1, 0}));
}

}  // namespace
}  // namespace rondel::test
