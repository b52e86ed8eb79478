// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All named generators: blocks of any size, any number of threads, and a tree of seams change nothing.
#include <array>
#include <cmath>
#include <map>

#include "bulk/blocks.h"
#include "bulk/sphere.h"
#include "topology/canonical_order.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

class bulk_same : public testing::TestWithParam<Generator> {};

TEST_P(bulk_same, as_the_incremental_build) {
  const Generator& generator = GetParam();
  const std::size_t many = is_shortened() ? 1200 : 2500;
  const std::size_t most = generator.has_long_integers ? 60 : is_extreme(generator) ? 500 : many;
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    for (const std::size_t size : {std::min<std::size_t>(200, most), most}) {
      for (std::uint64_t seed = 0; seed < scaled(2); ++seed) {
        SCOPED_TRACE(text_of(model) + " " + std::to_string(size) + " " + std::to_string(seed));
        BulkCase sites(generator.make(size, seed), model);
        // All sites on one great circle: nothing else makes this fall back.
        const bool is_flat = sites.expected().dimension < 2;
        for (const int block : {40, 100, 1000, 1 << 15}) {
          EXPECT_NE(sites.run(static_cast<std::size_t>(block)), is_flat);
        }
        for (const std::size_t block : {50U, 900U}) {
          EXPECT_NE(sites.run_with_copies(block, 2), is_flat);
        }
        for (const unsigned threads : {2U, 3U, 7U, 16U}) {
          EXPECT_NE(sites.run(120, threads), is_flat);
        }
        EXPECT_NE(sites.run_tree(70), is_flat);
        EXPECT_NE(sites.run_tree(333, 5), is_flat);
        ASSERT_FALSE(HasFailure());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(generators, bulk_same, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

// Powers of two change no ray and no plane: the same faces at all scales that doubles have, and
// when rays have lengths of their own.

void scale(SiteSet& set, int exponent) {
  for (Point& p : set.sites) {
    p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  }
}

TEST(bulk_scale, all_sites_by_one_factor) {
  const int step = is_shortened() ? 200 : 50;
  for (int exponent = -1000; exponent <= 1000; exponent += step) {
    for (const Model model : {Model::projected, Model::weighted}) {
      SiteSet set = generator("uniform").make(1000, 3);
      scale(set, exponent);
      SCOPED_TRACE(text_of(model) + " " + std::to_string(exponent));
      BulkCase sites(set, model);
      EXPECT_TRUE(sites.run(300));
      EXPECT_TRUE(sites.run(1000));
    }
  }
}

TEST(bulk_scale, each_site_by_a_factor_of_its_own) {
  Random random(5);
  for (const int range : {1, 10, 100, 250, 300, 500, 510, 515, 520, 540, 700, 1000}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      for (const bool few : {false, true}) {
        SiteSet set = generator("uniform").make(1000, 4);
        for (Point& p : set.sites) {
          const int exponent = random.between(-range, range);
          if (!few || random.below(20) == 0) p = std::ldexp(1.0, exponent) * p;
        }
        SCOPED_TRACE(text_of(model) + " " + std::to_string(range));
        BulkCase sites(set, model);
        EXPECT_TRUE(sites.run(100));
        EXPECT_TRUE(sites.run(1000));
      }
    }
  }
}

// The canonical order of faces (topology/canonical_order.h): its rules one by one, and in the results
// of all builders.

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
