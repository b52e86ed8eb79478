// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Refutations of closed surfaces that are not the boundary of the hull.
#include <gtest/gtest.h>

#include "support/generators.h"
#include "unit/proof/check_support.h"

namespace rondel::test {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(check_convexity, refutes_a_flipped_edge_that_is_no_tie) {
  Solid octahedron = solid(octahedron_sites());
  flip(octahedron.faces, 0, 2);
  const CheckReport report = octahedron.check();
  EXPECT_FALSE(report.is_valid);
  EXPECT_TRUE(has(report.reason, "is not locally Delaunay: site ")) << report.reason;
  EXPECT_TRUE(has(report.reason, " lies inside the circle of face ")) << report.reason;
}

TEST(check_convexity, tells_the_other_diagonal_of_a_tie_apart) {
  for (const Model model : {Model::projected, Model::weighted}) {
    const Solid cube = solid(cube_sites(), model);
    const std::string word = model == Model::weighted ? "coplanar" : "cocircular";
    std::size_t num_ties = 0;
    for (const Triple& face : cube.faces) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Point& p = cube.sites[face[i]];
        const Point& q = cube.sites[face[(i + 1) % 3]];
        const bool is_diagonal = (p.x != q.x) + (p.y != q.y) + (p.z != q.z) == 2;
        if (!is_diagonal || face[i] > face[(i + 1) % 3]) continue;
        Solid flipped = cube;
        flip(flipped.faces, face[i], face[(i + 1) % 3]);
        const std::string reason = flipped.reason();
        EXPECT_TRUE(has(reason, "is not the canonical choice: its four sites are " + word))
            << reason;
        ++num_ties;
      }
    }
    EXPECT_EQ(num_ties, 6U);
  }
}

TEST(check_convexity, names_the_edge_its_faces_and_the_site) {
  // The equator's diagonal from 0 to 3 runs through the axis.
  Solid octahedron = solid(octahedron_sites());
  octahedron.faces = {{2, 0, 1}, {2, 1, 3}, {2, 3, 4}, {2, 4, 0},
                      {5, 1, 0}, {5, 3, 1}, {5, 4, 3}, {5, 0, 4}};
  EXPECT_EQ(octahedron.reason(), "");
  octahedron.sites[4] = {0, 0.6, 0.8};  // now inside the circle of face 0
  octahedron.options.model = Model::projected;
  EXPECT_EQ(octahedron.reason(),
            "edge 0-2 of faces 0 and 3 is not locally Delaunay: site 4 lies inside the "
            "circle of face 0");
}

TEST(check_convexity, refutes_a_surface_turned_inside_out) {
  Solid cube = solid(cube_sites());
  for (Triple& face : cube.faces) face = reversed(face);
  EXPECT_TRUE(has(cube.reason(), "is clockwise seen from outside, and so are all others"))
      << cube.reason();
}

// Ten faces around two poles with the ring of a pentagram: closed, of Euler characteristic 2 and
// with every edge locally Delaunay; only the stars of the poles wind twice.
Solid twice_wound() {
  Solid wound;
  for (const int step : {0, 2, 4, 1, 3}) wound.sites.push_back(unit_vector_deg(72.0 * step, 0));
  wound.sites.push_back({0, 0, 1});
  wound.sites.push_back({0, 0, -1});
  for (Index i = 0; i < 5; ++i) {
    wound.faces.push_back({5, i, (i + 1) % 5});
    wound.faces.push_back({6, (i + 1) % 5, i});
  }
  return wound;
}

TEST(check_convexity, refutes_a_star_that_winds_twice) {
  const std::string reason = twice_wound().reason();
  EXPECT_TRUE(has(reason, "the star of site 5 is not convex")) << reason;
}

TEST(check_convexity, refutes_a_twice_wound_surface_seen_from_a_simple_star) {
  Solid wound = twice_wound();
  wound.faces[0] = {0, 1, 5};
  const std::string reason = wound.reason();
  EXPECT_TRUE(has(reason, "site 0 lies inside the circle of face ")) << reason;
}

TEST(check_convexity, refutes_the_triangulation_of_other_sites) {
  Random random(11);
  std::vector<Point> some;
  std::vector<Point> others;
  for (int i = 0; i < 9; ++i) {
    some.push_back(random_direction(random));
    others.push_back(random_direction(random));
  }
  Solid mixed = solid(some);
  ASSERT_EQ(mixed.reason(), "");
  mixed.sites = others;
  EXPECT_NE(mixed.reason(), "");
}

TEST(check_convexity, refutes_a_projected_triangulation_of_weighted_sites) {
  std::vector<Point> sites = octahedron_sites();
  sites.push_back({0.4, 0.4, 0.4});  // above the hull's face in direction only
  sites[0] = {3, 0, 0};
  Solid projected = solid(sites);
  ASSERT_EQ(projected.reason(), "");
  projected.options.model = Model::weighted;
  EXPECT_TRUE(has(projected.reason(), "is not locally regular: site ")) << projected.reason();
}

TEST(check_convexity, refutes_a_face_in_line_with_the_center) {
  Solid line = solid({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Model::weighted);
  ASSERT_EQ(line.reason(), "");
  line.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  line.sites[4] = {0.5, 0.125, 0.125};
  EXPECT_EQ(line.reason(), "the corners of face 0 lie in line with the center");
}

// Every sequence of flips that leads away from the triangulation is refuted.
TEST(check_convexity, refutes_random_flips_of_any_kind_of_sites) {
  Random random(5);
  std::size_t num_refuted = 0;
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      const SiteSet set = kind.make(8, 3);
      if (set.sites.size() > 14) continue;
      const Solid right = solid(set.sites, model, set.sphere);
      if (right.faces.size() < 4) continue;
      for (int repeat = 0; repeat < 4; ++repeat) {
        Solid wrong = right;
        const Triple& face = wrong.faces[random.below(wrong.faces.size())];
        const std::size_t i = random.below(3);
        flip(wrong.faces, face[i], face[(i + 1) % 3]);
        EXPECT_FALSE(wrong.check().is_valid) << kind.name;
        ++num_refuted;
      }
    }
  }
  EXPECT_GT(num_refuted, 200U);
}

}  // namespace
}  // namespace rondel::test
