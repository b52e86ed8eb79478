// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Every site is accounted for.
#include <gtest/gtest.h>

#include <limits>

#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/proof/check_support.h"

namespace rondel::test {
namespace {

TEST(check_sites, counts_duplicates) {
  std::vector<Point> sites = octahedron_sites();
  sites.push_back({0, 0, 7});
  sites.push_back({0, 0, 0.5});
  const CheckReport report = solid(sites).check();
  EXPECT_TRUE(report.is_valid) << report.reason;
  EXPECT_EQ(report.num_vertices, 6U);
  EXPECT_EQ(report.num_edges, 12U);
  EXPECT_EQ(report.num_duplicates, 2U);
  EXPECT_EQ(report.num_hidden, 0U);
}

TEST(check_sites, refutes_a_duplicate_that_names_its_place) {
  std::vector<Point> sites = octahedron_sites();
  sites.push_back({0, 0, 7});
  Solid octahedron = solid(sites);
  for (Triple& face : octahedron.faces) std::ranges::replace(face, 2U, 6U);
  EXPECT_EQ(octahedron.reason(),
            "site 6 is a vertex, but a duplicate of site 2, which names their place");
}

TEST(check_sites, refutes_two_vertices_in_one_place) {
  Solid octahedron = solid(octahedron_sites());
  octahedron.sites[5] = {0, 2, 0};
  EXPECT_EQ(octahedron.reason(),
            "site 5 is a vertex, but a duplicate of site 1, which names their place");
}

TEST(check_sites, refutes_a_missing_site) {
  Solid octahedron = solid(octahedron_sites());
  octahedron.sites.push_back({0.1, 0.1, 0.1});
  EXPECT_EQ(octahedron.reason(), "site 6 is neither a vertex nor the duplicate of one");
}

TEST(check_sites, counts_hidden_sites) {
  std::vector<Point> sites = cube_sites();
  sites.push_back({0, 0, 0});
  sites.push_back({0.5, 0.5, 0.25});
  sites.push_back({0.5, 0.5, 0.25});
  const CheckReport report = solid(sites, Model::weighted).check();
  EXPECT_TRUE(report.is_valid) << report.reason;
  EXPECT_EQ(report.num_vertices, 8U);
  EXPECT_EQ(report.num_hidden, 2U);
  EXPECT_EQ(report.num_duplicates, 1U);
}

TEST(check_sites, refutes_a_hidden_site_above_a_face) {
  Solid cube = solid(cube_sites(), Model::weighted);
  for (const Point& outside :
       {Point{0.5, 0.5, 1.5}, Point{0, 0, -1.01}, Point{7, 7, 6.9}, Point{-0.9, 1.0000001, 0.9}}) {
    cube.sites.resize(8);
    cube.sites.push_back(outside);
    const std::string reason = cube.reason();
    EXPECT_EQ(reason.find("site 8 is no vertex, but lies above face "), 0U) << reason;
  }
}

TEST(check_sites, refutes_an_extreme_site_that_is_no_vertex) {
  Solid cube = solid(cube_sites(), Model::weighted);
  cube.sites.push_back({-3, 0, 0});
  EXPECT_EQ(cube.reason(), "site 8 is no vertex, but an extreme point of the hull");
}

TEST(check_sites, refutes_a_hidden_site_as_vertex) {
  // The star of the inner site is a dent in a face of the octahedron.
  std::vector<Point> sites = octahedron_sites();
  sites.push_back({0.25, 0.25, 0.25});
  Solid dented = solid(sites, Model::weighted);
  ASSERT_EQ(dented.reason(), "");
  const auto face = std::ranges::find(dented.faces, Triple{0, 1, 2});
  ASSERT_NE(face, dented.faces.end());
  *face = {0, 1, 6};
  dented.faces.push_back({1, 2, 6});
  dented.faces.push_back({2, 0, 6});
  EXPECT_NE(dented.reason().find("is not locally regular: site "), std::string::npos)
      << dented.reason();
}

TEST(check_sites, refutes_two_faces_when_there_are_four_sites) {
  Solid flat = solid({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, Model::weighted);
  ASSERT_EQ(flat.faces.size(), 2U);
  EXPECT_EQ(flat.reason(), "");
  flat.sites.push_back({0.25, 0.25, 1});
  EXPECT_EQ(flat.reason(),
            "site 3 is no vertex, but the hull of more than three sites has more than three "
            "vertices");
}

TEST(check_sites, wants_no_faces_on_a_great_circle) {
  std::vector<Point> ring;
  for (int i = 0; i < 8; ++i) ring.push_back(unit_vector_deg(45.0 * i, 0));
  Solid circle = solid(ring);
  CheckReport report = circle.check();
  EXPECT_TRUE(report.is_valid) << report.reason;
  EXPECT_EQ(report.num_vertices, 8U);
  EXPECT_EQ(report.num_edges, 8U);
  circle.faces = {{0, 2, 5}, {0, 5, 2}};
  EXPECT_EQ(circle.reason(),
            "all sites lie on one great circle, so there are no faces; here are 2");
  circle.faces.clear();
  circle.sites[6].z = 5e-324;
  EXPECT_EQ(circle.reason(),
            "there are no faces, but sites 0, 1 and 6 do not lie on one great circle");
}

TEST(check_sites, accepts_no_sites_one_site_and_two) {
  for (std::size_t n = 0; n <= 2; ++n) {
    for (const Model model : {Model::projected, Model::weighted}) {
      std::vector<Point> sites = {{0, 1, 0}, {0, -1, 0}};
      sites.resize(n);
      const CheckReport report = solid(sites, model).check();
      EXPECT_TRUE(report.is_valid) << report.reason;
      EXPECT_EQ(report.num_vertices, n);
      EXPECT_EQ(report.num_edges, n / 2);
    }
  }
}

// Triangulations by brute force with oracles that share no code with the library are accepted.

class CheckValid : public testing::TestWithParam<Model> {};

TEST_P(CheckValid, accepts_every_kind_of_sites) {
  for (const Generator& kind : generators()) {
    if (kind.weighted_only && GetParam() == Model::projected) continue;
    for (const std::size_t n : {3U, 4U, 6U, 9U}) {
      for (std::uint64_t seed = 0; seed < scaled(4); ++seed) {
        const SiteSet set = kind.make(n, seed);
        if (set.sites.size() > 14) continue;
        const Hull hull = brute_force_hull(set.sites, GetParam(), set.sphere);
        const CheckReport report = solid(set.sites, GetParam(), set.sphere).check();
        EXPECT_TRUE(report.is_valid)
            << kind.name << ' ' << n << ' ' << seed << ' ' << report.reason;
        if (hull.dimension < 2) continue;
        EXPECT_EQ(report.num_duplicates, hull.duplicates.size()) << kind.name;
        EXPECT_EQ(report.num_hidden, hull.hidden.size()) << kind.name;
        EXPECT_EQ(2 * report.num_edges, 3 * hull.faces.size()) << kind.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(models, CheckValid, testing::Values(Model::projected, Model::weighted),
                         [](const auto& model) {
                           return model.param == Model::projected ? "projected" : "weighted";
                         });

TEST(check_valid, ignores_the_order_of_faces_and_of_their_corners) {
  Random random(2);
  Solid cube = solid(cube_sites());
  for (int repeat = 0; repeat < 20; ++repeat) {
    random.shuffle(cube.faces);
    for (Triple& face : cube.faces) {
      std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                  face.end());
    }
    EXPECT_EQ(cube.reason(), "");
  }
}

TEST(check_valid, tells_how_far_it_is) {
  Solid cube = solid(cube_sites());
  std::vector<double> told;
  cube.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "check");
    told.push_back(fraction);
  };
  EXPECT_EQ(cube.reason(), "");
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
}

// check() against delaunay(), on sets too large for brute force.

TEST(check_api, accepts_what_delaunay_builds) {
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      for (const std::size_t n : {std::size_t{50}, scaled(700)}) {
        const SiteSet set = kind.make(n, 21);
        Options options;
        options.model = model;
        options.sphere = set.sphere;
        const Triangulation built = delaunay(set.sites, options);
        const CheckReport report = check(set.sites, built.faces(), options);
        EXPECT_TRUE(report.is_valid) << kind.name << ' ' << report.reason;
        EXPECT_EQ(report.num_duplicates, built.duplicates().size()) << kind.name;
        if (built.dimension() < 2) continue;
        EXPECT_EQ(report.num_vertices, built.num_vertices()) << kind.name;
        EXPECT_EQ(report.num_hidden, built.hidden().size()) << kind.name;
      }
    }
  }
}

TEST(check_api, refutes_one_flipped_edge_among_thousands) {
  Random random(4);
  const SiteSet set = generator("globe_grid").make(2000, 1);
  const Triangulation built = delaunay(set.sites);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<Triple> faces(built.faces().begin(), built.faces().end());
    const Triple& face = faces[random.below(faces.size())];
    flip(faces, face[0], face[1]);
    EXPECT_FALSE(check(set.sites, faces).is_valid);
  }
}

TEST(check_api, throws_on_invalid_sites) {
  std::vector<Point> sites = cube_sites();
  sites[5].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(thrown_index([&] { check(sites, {}); }), 5U)
      << "accepted a coordinate that is not a number";
  sites[5] = {};
  EXPECT_THROW(check(sites, {}), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
