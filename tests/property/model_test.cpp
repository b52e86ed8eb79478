// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The two models agree where they must, and a change of scale changes nothing.
#include <cmath>

#include "property/property.h"

namespace rondel::test {
namespace {

bool are_equal(const Triangulation& a, const Triangulation& b) {
  return a.dimension() == b.dimension() && std::ranges::equal(a.faces(), b.faces()) &&
         std::ranges::equal(a.neighbors(), b.neighbors()) &&
         std::ranges::equal(a.ring(), b.ring()) &&
         std::ranges::equal(a.ghost_faces(), b.ghost_faces()) &&
         std::ranges::equal(a.duplicates(), b.duplicates()) &&
         std::ranges::equal(a.hidden(), b.hidden());
}

void expect_same_but_for_ties(const Triangulation& a, const Triangulation& b) {
  RC_ASSERT(a.dimension() == b.dimension());
  RC_ASSERT(a.num_faces() == b.num_faces());
  RC_ASSERT(std::ranges::equal(a.ring(), b.ring()));
  RC_ASSERT(std::ranges::equal(a.duplicates(), b.duplicates()));
  RC_ASSERT(a.hidden().size() == b.hidden().size());
  RC_ASSERT(facets(a) == facets(b));
  if (!has_ties(a) && !has_ties(b)) RC_ASSERT(are_equal(a, b));
}

// Integer points at one distance from the center lie on the sphere exactly: no site is hidden,
// and both models mean the same points. They break ties differently.
TEST(models, agree_on_a_sphere_of_integers) {
  expect_for_all(500, [] {
    const auto square = *rc::gen::element(9, 26, 81, 89, 161, 206, 329, 594, 1001);
    Random random(*rc::gen::inRange<std::uint64_t>(0, 1000));
    SiteSet set{integer_sphere(square, random)};
    set.sites.resize(
        std::min<std::size_t>(set.sites.size(), *rc::gen::inRange<std::size_t>(1, 300)));
    expect_same_but_for_ties(triangulate(set, Model::projected), triangulate(set, Model::weighted));
  });
}

// But for ties of projected sites, whose keys are others.
TEST(models, powers_of_two_change_nothing) {
  expect_for_all(500, [] {
    const Input input = *inputs(150);
    const SiteSet set = input.make();
    const double factor = std::ldexp(1.0, *rc::gen::inRange(-40, 40));
    SiteSet larger = set;
    for (Point& p : larger.sites) p = factor * p;
    larger.sphere.center = factor * set.sphere.center;
    for (std::size_t i = 0; i < set.sites.size(); ++i) {
      const bool is_exact = (1 / factor) * larger.sites[i] == set.sites[i];
      RC_PRE(is_exact);
    }
    const Triangulation before = triangulate(set, input.model);
    const Triangulation after = triangulate(larger, input.model);
    expect_same_but_for_ties(before, after);
    if (input.model == Model::weighted) RC_ASSERT(are_equal(before, after));
  });
}

// A projected site may move along its ray. Ties are broken by coordinates, so there must be none.
TEST(models, lengths_do_not_matter_to_projected_sites) {
  expect_for_all(500, [] {
    const auto name = *rc::gen::element("uniform", "clustered", "patch_1e_6", "hemisphere", "ball");
    const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000);
    SiteSet set = generator(name).make(*rc::gen::inRange<std::size_t>(4, 200), seed);
    const auto before = face_set(triangulate(set, Model::projected));
    Random random(seed);
    for (Point& p : set.sites) p = std::ldexp(1.0, random.between(-600, 600)) * p;
    RC_ASSERT(face_set(triangulate(set, Model::projected)) == before);
  });
}

TEST(models, every_distinct_ray_is_a_vertex_when_projected) {
  expect_for_all(300, [] {
    Input input = *inputs(150);
    RC_PRE(!input.generator().weighted_only);
    const SiteSet set = input.make();
    const Triangulation t = triangulate(set, Model::projected);
    const Places places = distinct_places(set.sites, Model::projected, set.sphere);
    RC_ASSERT(t.num_vertices() == places.index.size());
    RC_ASSERT(t.hidden().empty());
  });
}

}  // namespace
}  // namespace rondel::test
