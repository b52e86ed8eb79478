// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An arc is inserted among faces whose first answers about circles are wrong: what was triangulated at
// once has to be refused then, and the slower way has to find the right faces.
#include "constrained/arc_insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "api/build.h"
#include "constrained/constrained_faces.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "system/job.h"

namespace rondel::test::of_arc_insertion {
namespace {

using constrained::ConstrainedFaces;

// Returns the ends of an arc, and sites along curves on both sides of it.
std::vector<Point> sites_beside_arc(std::size_t size) {
  std::vector<Point> sites = {{1, -0.2, 0}, {1, 0.2, 0}};
  for (std::size_t i = 1; i <= size; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(size + 1);
    const double height = t * (1 - t) * (1 + 2 * t * t);
    sites.push_back({1, 0.4 * t - 0.2, 0.1 * height});
    sites.push_back({1, 0.4 * t - 0.2, -0.08 * height});
  }
  return sites;
}

// Faces that answer the opposite about circles a number of times.
struct LyingFaces {
  ConstrainedFaces& faces;
  int num_lies;
  int num_asked = 0;

  [[nodiscard]] const Triple& corners(Index f) const { return faces.corners(f); }
  [[nodiscard]] Index neighbor(Index f, unsigned edge) const { return faces.neighbor(f, edge); }
  [[nodiscard]] Index opposite(Index h) const { return faces.opposite(h); }
  [[nodiscard]] bool is_solid(Index f) const { return faces.is_solid(f); }
  [[nodiscard]] Index solid_face_at(Index v) const { return faces.solid_face_at(v); }
  [[nodiscard]] bool is_constrained(Index h) const { return faces.is_constrained(h); }
  [[nodiscard]] Sign side(Index a, Index b, Index v) const { return faces.side(a, b, v); }
  [[nodiscard]] bool is_in_circle(Index a, Index b, Index c, Index v) {
    return faces.is_in_circle(a, b, c, v) != (num_asked++ < num_lies);
  }
  void put_in_cavity(Index f) { faces.put_in_cavity(f); }
  [[nodiscard]] bool is_in_cavity(Index f) const { return faces.is_in_cavity(f); }
  void replace(Index f, const Triple& corners) { faces.replace(f, corners); }
  void link(Index h, Index g) { faces.link(h, g); }
  void constrain_side(Index h) { faces.constrain_side(h); }
  void constrain(Index h) { faces.constrain(h); }
};

// The solid faces, each with its least corner first, sorted; and how often circles were asked about.
struct Insertion {
  std::vector<Triple> faces;
  int num_asked = 0;
};

std::vector<Triple> in_order(std::vector<Triple> faces) {
  for (Triple& face : faces) std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  std::ranges::sort(faces);
  return faces;
}

// Inserts the arc between the first two sites.
Insertion inserted(const std::vector<Point>& sites, int num_lies) {
  const system::Job job = {{Model::projected, Sphere{}}, Execution{.threads = 1}};
  api::Parts built = api::build_parts(sites, job);
  const auto num_faces = static_cast<Index>(built.arrays.faces.size());
  ConstrainedFaces faces(sites, built, {}, 1);
  faces.number_by_rank(1);
  LyingFaces lying{faces, num_lies};
  constrained::ArcInsertion<LyingFaces> insertion;
  const auto crossed = insertion.insert(lying, faces.vertex_of(0), faces.vertex_of(1),
                                        [](Index /*from*/, Index /*to*/) {});
  EXPECT_FALSE(crossed);
  std::vector<Triple> solid;
  for (Index f = 0; f < num_faces; ++f) {
    if (!faces.is_solid(f)) continue;
    const auto& [a, b, c] = faces.corners(f);
    solid.push_back({faces.name_of(a), faces.name_of(b), faces.name_of(c)});
  }
  return {in_order(std::move(solid)), lying.num_asked};
}

std::vector<Triple> expected(const std::vector<Point>& sites) {
  const std::vector<std::array<Index, 2>> constraint = {{0, 1}};
  const ConstrainedTriangulation made =
      constrained_delaunay(Sites::view(sites), constraint, {}, {.threads = 1});
  std::vector<Triple> solid;
  for (Index f = 0; f < made.triangulation.num_faces(); ++f) {
    if (!made.triangulation.is_ghost(f)) solid.push_back(made.triangulation.faces()[f]);
  }
  return in_order(std::move(solid));
}

TEST(arc_insertion, refuses_what_wrong_answers_have_triangulated_at_once) {
  const std::vector<Point> sites = sites_beside_arc(100);
  const std::vector<Triple> right = expected(sites);
  const Insertion honest = inserted(sites, 0);
  EXPECT_EQ(honest.faces, right);
  // Few wrong answers fall among those by which the first polygon is triangulated, not among those by
  // which it is verified.
  for (const int num_lies : {1, 5, 20, 50}) {
    const Insertion misled = inserted(sites, num_lies);
    EXPECT_EQ(misled.faces, right) << num_lies << " wrong answers";
    EXPECT_GT(misled.num_asked, honest.num_asked) << num_lies << " wrong answers";
  }
}

}  // namespace
}  // namespace rondel::test::of_arc_insertion
