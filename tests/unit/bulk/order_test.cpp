// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of faces (topology/canonical_order.h): its rules one by one, and in the results
// of all builders.
#include <array>
#include <map>

#include "bulk/blocks.h"
#include "bulk/sphere.h"
#include "topology/canonical_order.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

TEST(canonical_order, a_face_starts_with_its_smallest_rank) {
  std::array<Index, 3> ranks = {3, 5, 9};
  do {
    EXPECT_EQ(ranks[topology::first_corner(ranks)], 3U);
  } while (std::ranges::next_permutation(ranks).found);
}

TEST(canonical_order, an_owner_starts_with_its_smallest_second_corner) {
  const std::vector<Index> turned = {10, 12, 11, 13};  // names of faces
  const std::map<Index, Index> second = {{10, 7}, {11, 4}, {12, 9}, {13, 6}};
  for (std::size_t i = 0; i < turned.size(); ++i) {
    std::vector<Index> faces = turned;
    std::rotate(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(i), faces.end());
    topology::start_with_first(faces, [&](Index f) { return second.at(f); });
    EXPECT_EQ(faces, (std::vector<Index>{11, 13, 10, 12}));
  }
}

// The faces that a vertex owns, as a walk around it from the first one meets them.
std::vector<Index> owned_around(const TriangulationArrays& arrays, Index first) {
  const Index owner = arrays.faces[first][0];
  std::vector<Index> owned;
  Index f = first;
  do {
    const Triple& v = arrays.faces[f];
    if (v[0] == owner) owned.push_back(f);
    const auto corner = static_cast<std::size_t>(std::ranges::find(v, owner) - v.begin());
    f = arrays.neighbors[f][(corner + 1) % 3];
  } while (f != first);
  return owned;
}

// Of sites whose indices are their ranks.
void expect_order(const TriangulationArrays& arrays) {
  ASSERT_EQ(arrays.dimension, 2);
  for (Index f = 0; f < arrays.faces.size();) {
    const Triple& v = arrays.faces[f];
    ASSERT_TRUE(f == 0 || arrays.faces[f - 1][0] < v[0]);  // rule 2
    const std::vector<Index> owned = owned_around(arrays, f);
    for (const Index g : owned) {
      ASSERT_EQ(g, f++);                    // rule 3: they follow each other
      ASSERT_LE(v[1], arrays.faces[g][1]);  // rule 3: the first one
      ASSERT_LT(v[0], arrays.faces[g][1]);  // rule 1
      ASSERT_LT(v[0], arrays.faces[g][2]);
    }
  }
}

TEST(canonical_order, every_builder_keeps_it) {
  for (const char* name : {"uniform", "clustered", "globe_grid", "ball"}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      SCOPED_TRACE(std::string(name) + " " + text_of(model));
      const SiteSet set = generator(name).make(3000, 1);
      const auto order = order::spatial_order(set.sites, model, set.sphere.center, 1);
      std::vector<Point> sites;
      std::vector<Index> ranks;
      for (const Index i : order.order) {
        ranks.push_back(static_cast<Index>(sites.size()));
        sites.push_back(set.sites[i]);
      }
      const system::Job job{{.model = model, .sphere = set.sphere}, {.threads = 2}};
      const bulk::Input input = bulk::make_input(sites, ranks, job);
      expect_order(kernel::triangulate(sites, ranks, {}, job).arrays);
      const auto by_blocks = bulk::triangulate_by_blocks(input, {}, 100);
      ASSERT_TRUE(by_blocks.has_value());
      expect_order(by_blocks->arrays);
      if (const auto whole = bulk::triangulate_sphere(input, {})) expect_order(whole->arrays);
    }
  }
}

}  // namespace
}  // namespace rondel::test
