// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rotations and reflections by signed permutations of the axes are exact in doubles.
#include "property/property.h"

namespace rondel::test {
namespace {

Point moved(const Point& p, int axes, int signs) {
  const Point reflected = {(signs & 1) != 0 ? -p.x : p.x, (signs & 2) != 0 ? -p.y : p.y,
                           (signs & 4) != 0 ? -p.z : p.z};
  const auto& [x, y, z] = reflected;
  switch (axes) {
    case 0:
      return {x, y, z};
    case 1:
      return {y, z, x};
    case 2:
      return {z, x, y};
    case 3:
      return {y, x, z};
    case 4:
      return {x, z, y};
    default:
      return {z, y, x};
  }
}

bool is_reflection(int axes, int signs) {
  return ((axes >= 3 ? 1 : 0) + (signs & 1) + (signs >> 1 & 1) + (signs >> 2)) % 2 != 0;
}

// Ties would be broken in another order, so the kinds of sites are those without ties.
TEST(symmetry, signed_axis_permutations_keep_the_faces) {
  expect_for_all(500, [] {
    const auto name = *rc::gen::element("uniform", "clustered", "patch_1e_6", "patch_1e_9",
                                        "patch_and_globe", "hemisphere", "ball", "ball_outside");
    const auto model = *rc::gen::element(Model::projected, Model::weighted);
    SiteSet set = generator(name).make(*rc::gen::inRange<std::size_t>(4, 400),
                                       *rc::gen::inRange<std::uint64_t>(0, 1000));
    const Triangulation before = triangulate(set, model);
    RC_PRE(before.report().rungs.perturbed == 0U);
    const int axes = *rc::gen::inRange(0, 6);
    const int signs = *rc::gen::inRange(0, 8);
    for (Point& p : set.sites) p = moved(p, axes, signs);
    set.sphere.center = moved(set.sphere.center, axes, signs);
    const Triangulation after = triangulate(set, model);

    for (const bool solid_only : {false, true}) {
      auto expected = face_set(before, solid_only);
      if (is_reflection(axes, signs)) {
        std::set<Triple> reversed;
        for (const Triple& f : expected) reversed.insert(lowest_first({f[0], f[2], f[1]}));
        expected = reversed;
      }
      RC_ASSERT(face_set(after, solid_only) == expected);
    }
    RC_ASSERT(before.hidden().size() == after.hidden().size());
  });
}

// In another order of the sites, ties leave at least the counts alone.
TEST(symmetry, vertices_survive_in_spite_of_ties) {
  expect_for_all(500, [] {
    const auto name = *rc::gen::element("globe_grid", "integer_sphere", "mirrored", "small_circle",
                                        "great_circle_and_some", "closed_hemisphere");
    SiteSet set = generator(name).make(*rc::gen::inRange<std::size_t>(6, 300),
                                       *rc::gen::inRange<std::uint64_t>(0, 1000));
    const Triangulation before = triangulate(set, Model::projected);
    const int axes = *rc::gen::inRange(0, 6);
    const int signs = *rc::gen::inRange(0, 8);
    for (Point& p : set.sites) p = moved(p, axes, signs);
    const Triangulation after = triangulate(set, Model::projected);
    RC_ASSERT(before.num_faces() == after.num_faces());
    RC_ASSERT(before.num_vertices() == after.num_vertices());
    RC_ASSERT(before.dimension() == after.dimension());
  });
}

}  // namespace
}  // namespace rondel::test
