// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The whole sphere by divide and conquer: the same bits as the incremental build.
#include "bulk/sphere.h"

#include <utility>

#include "rondel/delaunay.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

struct Outcomes {
  int solved = 0;
  int failed = 0;
  int open = 0;  // the center is not known to be inside
};

void compare(const SiteSet& set, Model model, Outcomes& count) {
  BulkCase sites(set, model);
  if (!bulk::surround_center(set.sites, set.sphere.center)) {
    ++count.open;
    return;
  }
  ++(sites.run_whole() ? count.solved : count.failed);
}

void record(Model model, const Outcomes& count) {
  testing::Test::RecordProperty(text_of(model) + "_solved", std::to_string(count.solved));
  testing::Test::RecordProperty(text_of(model) + "_failed", std::to_string(count.failed));
  testing::Test::RecordProperty(text_of(model) + "_open", std::to_string(count.open));
}

class bulk_sphere : public testing::TestWithParam<Generator> {};

TEST_P(bulk_sphere, as_the_incremental_build) {
  const Generator& generator = GetParam();
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    Outcomes count;
    for (const std::size_t size : {12U, 60U, is_extreme(generator) ? 100U : 400U}) {
      for (std::uint64_t seed = 0; seed < scaled(5); ++seed) {
        SCOPED_TRACE(text_of(model) + " " + std::to_string(size) + " " + std::to_string(seed));
        compare(generator.make(size, seed), model, count);
        ASSERT_FALSE(HasFailure());
      }
    }
    record(model, count);
  }
}

INSTANTIATE_TEST_SUITE_P(generators, bulk_sphere, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

// Both models with scaled(num_sets) sets that `make` draws; `expect` judges the outcomes of each
// model.
template <class Make, class Expect>
void compare_random(std::size_t num_sets, Make make, Expect expect) {
  for (const Model model : {Model::projected, Model::weighted}) {
    Outcomes count;
    for (std::uint64_t seed = 0; seed < scaled(num_sets); ++seed) {
      SCOPED_TRACE(text_of(model) + " " + std::to_string(seed));
      Random random(seed);
      compare(make(random), model, count);
      ASSERT_FALSE(testing::Test::HasFailure());
    }
    SCOPED_TRACE(text_of(model));
    expect(model, count);
  }
}

// Uniform sites never make it fail, however few, and wherever the bridge is.
TEST(bulk_sphere_general, any_number_of_sites) {
  const auto make = [](Random& random) {
    SiteSet set;
    const int n = random.between(8, random.between(8, 97));
    for (int k = 0; k < n; ++k) set.sites.push_back(random_direction(random));
    return set;
  };
  compare_random(3000, make,
                 [](Model, const Outcomes& count) { EXPECT_GT(count.solved, 100 * count.failed); });
}

// Enough sites for threads to be used.
TEST(bulk_sphere_general, any_number_of_threads) {
  for (const char* name : {"uniform", "clustered", "globe_grid", "ball", "patch_and_globe"}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      SCOPED_TRACE(std::string(name) + " " + text_of(model));
      const SiteSet set = generator(name).make(6000, 1);
      BulkCase sites(set, model);
      const bool is_solved = sites.run_whole();
      for (const unsigned threads : {2U, 3U, 16U}) EXPECT_EQ(sites.run_whole(threads), is_solved);
    }
  }
}

TEST(bulk_sphere_general, what_surrounds_the_center) {
  std::vector<Point> corners;
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      for (const double z : {-1, 1}) corners.push_back({x, y, z});
    }
  }
  EXPECT_TRUE(bulk::surround_center(corners, {}));
  EXPECT_TRUE(bulk::surround_center(corners, {0.9, -0.9, 0.9}));
  EXPECT_FALSE(bulk::surround_center(corners, {1, 0, 0}));
  corners.pop_back();
  EXPECT_FALSE(bulk::surround_center(corners, {}));
}

// Sites on the planes that divide the sphere, on the axes, in grids: all is degenerate.
TEST(bulk_sphere_general, small_integers) {
  const auto make = [](Random& random) {
    SiteSet set;
    const int size = random.between(1, 5);
    const int n = random.between(8, 120);
    for (int k = 0; k < n; ++k) {
      const auto coordinate = [&] { return static_cast<double>(random.between(-size, size)); };
      Point p = {coordinate(), coordinate(), coordinate()};
      if (random.coin()) p.y = random.coin() ? p.x : -p.x;
      if (p != Point{}) set.sites.push_back(p);
    }
    if (random.coin()) set.sites.push_back({0, -0.0, 1});
    if (random.coin()) set.sites.push_back({-0.0, 0, -1});
    return set;
  };
  compare_random(3000, make, [](Model model, const Outcomes& count) {
    if (model == Model::projected) {
      EXPECT_GT(count.solved, count.failed);
    }
    record(model, count);
  });
}

void expect_solved(std::vector<Point> sites, Model model, const Point& center = {}) {
  SiteSet set;
  set.sites = std::move(sites);
  set.sphere.center = center;
  BulkCase whole(set, model);
  EXPECT_TRUE(whole.run_whole());
}

// Where earlier versions were wrong or gave up.
TEST(bulk_sphere_general, hidden_sites_on_the_line_of_an_edge) {
  expect_solved({{1, 1, -2}, {1, -2, 1}, {-1, 2, 1}, {-1, -2, 1}, {-1, 1, 1}, {0.7, 0.5, 0.5}},
                Model::weighted);
  expect_solved(
      {{-1, 2, 0}, {2, 1, -1}, {0, -1, 0}, {-1, 1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}},
      Model::weighted);
}

TEST(bulk_sphere_general, hidden_sites_at_the_end_of_the_ring) {
  expect_solved({{0.67406687916206887, -0.72545549016955102, -0.13909771457348019},
                 {-0.0050966110162312984, -0.72771619659034381, -0.68585943295709884},
                 {-6.6654291535475592, -10.308088285811827, -10.262327713094495},
                 {16, 16, -16},
                 {-16, 16, 16},
                 {4.4767623692466367, 1.4103983184039344, 15.296057507499787}},
                Model::weighted);
}

// Doubles guess a bridge that is none, which only the neighbors at its other end tell.
TEST(bulk_sphere_general, bridge_that_is_none) {
  SiteSet set;
  set.sphere.center = {0x1p-52, 0x1p-53, 0};
  set.sites = {{-0.99999999999999956, -0.99999999999999989, -1},
               {1.0000000000000002, -0.99999999999999989, -1},
               {-16, -16, -16},
               {16.000000000000004, -16, 16},
               {-15.999999999999998, 16, 16},
               {5.826367577510716, 14.80637756746362, 1.6806618284003758}};
  BulkCase sites(set, Model::projected);
  sites.run_whole();  // gives nothing, or what is right
}

// What follows, the other way, is right.
void expect_left_to_others(std::vector<Point> sites, Model model) {
  SiteSet set;
  set.sites = std::move(sites);
  ASSERT_TRUE(bulk::surround_center(set.sites, {}));
  BulkCase whole(set, model);
  EXPECT_FALSE(whole.run_whole());
  const Triangulation built = delaunay(set.sites, {.model = model});
  EXPECT_TRUE(std::ranges::equal(built.faces(), whole.expected().faces));
}

// The half of the positive x and y axis lies on the plane x = y, and the bridge ends in its middle.
TEST(bulk_sphere_general, half_on_one_great_circle) {
  const std::vector<Point> others = {{-9, 1, -1}, {-9, 1, 1}, {1, -9, -1}, {1, -9, 1}};
  std::vector<Point> sites = {{1, 1, -6}, {-6, 5, -2}, {2, -3, -3}, {-2, -1, -3}, {1, 1, 2},
                              {-2, 1, 5}, {3, -6, 5},  {-2, -1, 1}, {3, 3, 9},    {2, 2, -8}};
  sites.insert(sites.end(), others.begin(), others.end());
  expect_left_to_others(sites, Model::projected);
  sites = {{1, 1, -3}, {-6, -3, -3}, {1, 1, 1}, {-5, 3, 4}, {-2, -1, 6}, {3, 3, -6}};
  sites.insert(sites.end(), others.begin(), others.end());
  expect_left_to_others(sites, Model::weighted);
}

// The last site lies on the great circle of the bridge and below it, next to one of its ends.
TEST(bulk_sphere_general, hidden_site_along_the_bridge) {
  expect_left_to_others({{72, -32, 40},
                         {48, -16, -56},
                         {32, -48, -40},
                         {16, 32, 72},
                         {-24, -32, -40},
                         {-40, 40, 32},
                         {56, 56, -72},
                         {-16, 40, -72},
                         {-72, -24, 40},
                         {-8, 48, 16},
                         {32, 8, -72},
                         {6, -5.5, -7.25}},
                        Model::weighted);
}

// One of the last two lies so, and is met behind an edge that the bridge crosses.
TEST(bulk_sphere_general, hidden_site_on_the_way_of_the_bridge) {
  expect_left_to_others(
      {{-72, -16, 8}, {-72, -32, 24}, {72, 72, 16},  {48, 64, -40},    {-32, -40, 72},
       {-24, 72, 64}, {40, -16, 32},  {8, -72, -56}, {72, 72, -16},    {-64, -32, -56},
       {72, 32, 64},  {24, 24, -40},  {-8, -32, 48}, {-24, -56, 72},   {48, -64, 16},
       {0, 0, 24},    {-40, 8, -64},  {-72, -8, 16}, {4.5, -9.5, -13}, {8, 5.5, -9.75}},
      Model::weighted);
}

TEST(bulk_sphere_general, differences_from_the_center_that_overflow) {
  SiteSet set;
  set.sphere.center = {-9e307, -9e307, -9e307};
  set.sites = {{-6.02e307, -7.54e307, -1.2e308}, {-1.68e308, -4.9e307, -1.1e308},
               {1.04e308, 1.53e308, 1.61e308},   {-4.1e307, -1.4e308, -7.54e307},
               {1.35e308, 1.43e308, 9.83e307},   {1.38e308, 1.42e308, 1.57e308}};
  BulkCase sites(set, Model::projected);
  sites.run_whole();  // may give nothing, but ends
}

// A center that is no sum of few bits: differences are rounded.
TEST(bulk_sphere_general, remote_center) {
  const auto make = [](Random& random) {
    SiteSet set;
    set.sphere.center = {0.1, 1 / 3.0, -0.7};
    for (int k = 0; k < 60; ++k) {
      Point d = random_direction(random);
      if (random.coin()) d.y = random.coin() ? d.x : -d.x;
      set.sites.push_back({d.x + 0.1, d.y + 1 / 3.0, d.z - 0.7});
    }
    return set;
  };
  compare_random(200, make, [](Model model, const Outcomes& count) {
    if (model == Model::projected) {
      EXPECT_GT(count.solved, 10 * count.failed);
    }
  });
}

}  // namespace
}  // namespace rondel::test
