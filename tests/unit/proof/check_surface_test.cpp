// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Refutations that need no coordinates.
#include <gtest/gtest.h>

#include "proof/surface.h"
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

}  // namespace
}  // namespace rondel::test
