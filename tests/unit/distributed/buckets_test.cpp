// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations in buckets, one at a time: what comes out is the incremental build's result, bit by
// bit, whatever the sites, the buckets and the blocks in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributed/bucket_cuts.h"
#include "distributed/bucket_faces.h"
#include "order/place_keys.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

using distributed::GlobalIndex;

// Far apart from what 32 bits can count.
constexpr GlobalIndex first_number = GlobalIndex{1} << 40;

// A bucket on its way: the sites of one square, by increasing index.
struct Part {
  bulk::Square square;
  std::vector<Index> sites;
  bulk::Bucket bucket;
  std::vector<Index> names;  // by rank
};

std::vector<distributed::BucketCut> cuts_of(std::span<const std::uint64_t> keys,
                                            std::uint64_t max_num_sites) {
  distributed::BucketCounts counts(max_num_sites);
  do {
    // In two pieces.
    counts.add(keys.first(keys.size() / 3));
    counts.add(keys.subspan(keys.size() / 3));
  } while (counts.end_round());
  return counts.cuts();
}

class BucketCase {
 public:
  BucketCase(const SiteSet& set, Model model, std::size_t max_bucket_sites)
      : sites_(set.sites),
        options_{{.model = model, .sphere = set.sphere}, {.threads = 1}},
        all_(options_) {
    const auto order = order::spatial_order(sites_, model, set.sphere.center, 1);
    expected_ = kernel::triangulate(sites_, order.order, order.renamed, options_).arrays;
    all_.add(std::span(sites_).first(sites_.size() / 2));
    bulk::AllSites others(options_);
    others.add(std::span(sites_).subspan(sites_.size() / 2));
    all_.add(others);
    std::vector<std::uint64_t> keys(sites_.size());
    order::place_keys(sites_, model, set.sphere.center, keys);
    const auto cuts = cuts_of(keys, max_bucket_sites);
    for (const distributed::BucketCut& cut : cuts) parts_.push_back({cut.square, {}, {}, {}});
    for (Index i = 0; i < sites_.size(); ++i)
      parts_[distributed::bucket_of(keys[i], cuts)].sites.push_back(i);
  }

  [[nodiscard]] bool is_flat() const { return expected_.dimension < 2; }

  // Returns whether there was no need to fall back.
  bool run(std::size_t max_block_sites, const bulk::SeamRule& rule) {
    std::vector<bulk::OpenBucket> open;
    for (Part& part : parts_) open.push_back(triangulate(part, max_block_sites, rule));
    const auto joined = bulk::join_buckets(open, all_, options_, rule);
    if (!joined) return false;
    write(*joined);
    return true;
  }

 private:
  bulk::OpenBucket triangulate(Part& part, std::size_t max_block_sites,
                               const bulk::SeamRule& rule) {
    std::vector<Point> points;
    for (const Index i : part.sites) points.push_back(sites_[i]);
    part.bucket =
        bulk::triangulate_bucket(points, part.square, all_, options_, max_block_sites, rule);
    std::vector<Index> space;
    part.names.clear();
    for (const Index i :
         order::names_of(part.bucket.order.order, part.bucket.order.renamed, space)) {
      part.names.push_back(part.sites[i]);
    }
    bulk::OpenBucket open = {part.square,
                             static_cast<double>(part.bucket.order.order.size()),
                             {},
                             part.bucket.border.open_edges,
                             part.bucket.border.hidden};
    for (const bulk::SeamSite& site : part.bucket.border.open_sites)
      open.points.push_back(points[part.bucket.order.order[site.rank]]);
    return open;
  }

  void write(const bulk::JoinedFaces& joined) {
    std::vector<Index> open_names;
    for (const Part& part : parts_) {
      for (const bulk::SeamSite& site : part.bucket.border.open_sites)
        open_names.push_back(part.names[site.rank]);
    }
    distributed::JoinedNumbers numbers(joined);
    std::vector<std::array<distributed::BucketNeighbor, 3>> neighbors;
    LargeVector<Triple> faces;
    Index first_site = 0;
    Index first_edge = 0;
    for (Part& part : parts_) {
      distributed::BucketFaces own(part.bucket.border, joined, first_site, first_edge);
      own.number(first_number + faces.size(), numbers);
      const std::size_t end = faces.size() + own.size();
      own.for_each_face(part.bucket.faces, [&](const auto& corners) {
        Triple face{};
        for (unsigned i = 0; i < 3; ++i) {
          face[i] = corners[i].is_own ? part.names[corners[i].index] : open_names[corners[i].index];
        }
        faces.push_back(face);
      });
      own.for_each_neighbors(part.bucket.neighbors,
                             [&](const auto& across) { neighbors.push_back(across); });
      EXPECT_EQ(faces.size(), end);
      EXPECT_EQ(neighbors.size(), end);
      first_site += static_cast<Index>(part.bucket.border.open_sites.size());
      first_edge += static_cast<Index>(part.bucket.border.open_edges.size());
    }
    EXPECT_TRUE(faces == expected_.faces);
    ASSERT_EQ(neighbors.size(), expected_.neighbors.size());
    std::size_t num_different = 0;
    for (std::size_t f = 0; f < neighbors.size(); ++f) {
      for (unsigned i = 0; i < 3; ++i)
        num_different += numbers[neighbors[f][i]] != first_number + expected_.neighbors[f][i];
    }
    EXPECT_EQ(num_different, 0U);
    std::vector<Index> ghost_faces;
    for (const Index f : joined.ghost_faces)
      ghost_faces.push_back(static_cast<Index>(numbers.faces[f] - first_number));
    std::ranges::sort(ghost_faces);
    EXPECT_TRUE(ghost_faces == expected_.ghost_faces);
    compare_hidden(joined, open_names);
  }

  void compare_hidden(const bulk::JoinedFaces& joined, const std::vector<Index>& open_names) const {
    std::vector<bool> is_vertex(open_names.size(), false);
    for (const Triple& face : joined.faces) {
      for (const Index s : face) is_vertex[s] = true;
    }
    std::vector<Index> hidden;
    for (std::size_t s = 0; s < open_names.size(); ++s) {
      if (!is_vertex[s]) hidden.push_back(open_names[s]);
    }
    std::vector<Index> expected;
    for (const Part& part : parts_) {
      for (const Index rank : part.bucket.hidden) hidden.push_back(part.names[rank]);
    }
    for (const Hidden& h : expected_.hidden) expected.push_back(h.site);
    std::ranges::sort(hidden);
    EXPECT_TRUE(hidden == expected);
  }

  std::vector<Point> sites_;
  system::Job options_;
  bulk::AllSites all_;
  TriangulationArrays expected_;
  std::vector<Part> parts_;
};

class bulk_buckets : public testing::TestWithParam<Generator> {};

TEST_P(bulk_buckets, as_the_incremental_build) {
  const Generator& generator = GetParam();
  const std::size_t many = is_shortened() ? 800 : 1500;
  const std::size_t size = generator.has_long_integers ? 60 : is_extreme(generator) ? 300 : many;
  constexpr bulk::SeamRule every_square = {.min_sites = 0, .is_every_square = true};
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    for (std::uint64_t seed = 0; seed < scaled(1); ++seed) {
      for (const std::size_t bucket : {40U, 200U, 700U}) {
        SCOPED_TRACE(text_of(model) + " " + std::to_string(bucket) + " " + std::to_string(seed));
        BucketCase sites(generator.make(size, seed), model, bucket);
        // All sites on one great circle: nothing else cannot be done in buckets.
        EXPECT_NE(sites.run(50, every_square), sites.is_flat());
        EXPECT_NE(sites.run(1000, {}), sites.is_flat());
        ASSERT_FALSE(HasFailure());
      }
    }
  }
}

// Sites that are not closer than keys can tell are cut as those in memory are.
TEST(bulk_bucket, squares_are_those_of_blocks) {
  // All over the sphere, and near one place of it.
  for (const double size : {10.0, 1e-2, 1e-3}) {
    SiteSet set;
    Random random(7);
    for (int i = 0; i < 5000; ++i) {
      const Point around = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
      set.sites.push_back(normalized(Point{0.3, -0.5, 0.8} + size * around));
    }
    std::vector<std::uint64_t> keys(set.sites.size());
    order::place_keys(set.sites, Model::projected, set.sphere.center, keys);
    const auto order = order::spatial_order(set.sites, Model::projected, set.sphere.center, 1);
    ASSERT_EQ(order.order.size(), set.sites.size());
    const system::Job options{{.sphere = set.sphere}, {.threads = 1}};
    const bulk::Input input = bulk::make_input(set.sites, order.order, options);
    for (const std::size_t most : {1U, 30U, 800U, 5000U}) {
      SCOPED_TRACE(std::to_string(size) + " " + std::to_string(most));
      const auto cuts = cuts_of(keys, most);
      const auto blocks = bulk::blocks_of(bulk::make_squares(input, most));
      ASSERT_EQ(cuts.size(), blocks.size());
      for (std::size_t i = 0; i < cuts.size(); ++i) {
        EXPECT_EQ(cuts[i].square.bits, blocks[i].square.bits);
        EXPECT_EQ(cuts[i].square.corner.face, blocks[i].square.corner.face);
        EXPECT_EQ(cuts[i].square.corner.u, blocks[i].square.corner.u);
        EXPECT_EQ(cuts[i].square.corner.v, blocks[i].square.corner.v);
        EXPECT_EQ(cuts[i].square.state, blocks[i].square.state);
        EXPECT_EQ(cuts[i].num_sites, blocks[i].end - blocks[i].begin);
      }
    }
  }
}

// All are in one square of the finest ones: it is a bucket, although it has too many.
TEST(bulk_bucket, is_as_small_as_keys_can_tell) {
  const std::vector<std::uint64_t> keys(100,
                                        (std::uint64_t{3} << (2 * order::high_levels)) + 12345);
  const auto cuts = cuts_of(keys, 10);
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_EQ(cuts[0].square.bits, order::low_levels);
  EXPECT_EQ(cuts[0].first_key, keys[0]);
  EXPECT_EQ(cuts[0].num_sites, 100U);
}

// Of n uniform sites some 4.8 sqrt(n) are near the border of a square. The blocks alone would leave a
// quarter of them all.
TEST(bulk_bucket, leaves_what_is_near_its_border) {
  const auto uniform = std::ranges::find(generators(), std::string("uniform"), &Generator::name);
  const SiteSet set = uniform->make(30000, 1);
  const system::Job options{{.sphere = set.sphere}, {.threads = 1}};
  const auto order = order::spatial_order(set.sites, Model::projected, set.sphere.center, 1);
  const bulk::Input input = bulk::make_input(set.sites, order.order, options);
  bulk::AllSites all(options);
  all.add(set.sites);
  for (const bulk::Block& face : bulk::cube_faces(input)) {
    std::vector<Point> points;
    for (Index rank = face.begin; rank < face.end; ++rank) points.push_back(input.point(rank));
    const auto bucket = bulk::triangulate_bucket(points, face.square, all, options, 300,
                                                 {.min_sites = 0, .is_every_square = true});
    const auto num_sites = static_cast<double>(points.size());
    EXPECT_LT(static_cast<double>(bucket.border.open_sites.size()), 8 * std::sqrt(num_sites));
  }
}

INSTANTIATE_TEST_SUITE_P(generators, bulk_buckets, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

}  // namespace
}  // namespace rondel::test
