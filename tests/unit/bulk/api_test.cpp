// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// delaunay() of so many sites that it works by blocks: all that it tells is right, whatever the
// threads and the input order.
#include "bulk/sphere.h"
#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

struct Case {
  std::string_view generator;
  Model model;
  bool is_divided;
};

// The last ones suit the incremental build better.
constexpr Case cases[] = {
    {"uniform", Model::projected, true},      {"uniform", Model::weighted, true},
    {"clustered", Model::projected, true},    {"globe_grid", Model::weighted, true},
    {"hemisphere", Model::projected, true},   {"hemisphere", Model::weighted, true},
    {"near_sphere", Model::weighted, true},   {"ball", Model::projected, true},
    {"ball", Model::weighted, false},         {"great_circle_and_some", Model::projected, true},
    {"small_circle", Model::projected, false}};

// Whether the first sign of progress is that of a block or of a part of the sphere: the incremental
// build begins with 0.
bool is_divided(const SiteSet& set, const Options& options) {
  double first = -1;
  system::Job job{options, {.threads = 1}};
  job.progress = [&first](std::string_view stage, double fraction) {
    if (stage == "triangulate" && first < 0) first = fraction;
  };
  const auto order = order::spatial_order(set.sites, options.model, set.sphere.center, 1);
  bulk::triangulate(set.sites, order.order, order.renamed, job);
  return first > 0;
}

void expect_equal(const Triangulation& a, const Triangulation& b) {
  EXPECT_TRUE(std::ranges::equal(a.faces(), b.faces()));
  EXPECT_TRUE(std::ranges::equal(a.neighbors(), b.neighbors()));
  EXPECT_TRUE(std::ranges::equal(a.ghost_faces(), b.ghost_faces()));
  EXPECT_TRUE(std::ranges::equal(a.duplicates(), b.duplicates()));
  EXPECT_TRUE(std::ranges::equal(a.hidden(), b.hidden()));
}

TEST(bulk_api, what_many_sites_give) {
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.generator) + " " + text_of(c.model));
    SiteSet set = generator(c.generator).make(16000, 1);
    for (std::size_t i = 0; i < 500; ++i) set.sites.push_back(set.sites[7 * i]);
    Options options;
    options.model = c.model;
    options.sphere = set.sphere;
    EXPECT_EQ(is_divided(set, options), c.is_divided);
    const Triangulation built = delaunay(set.sites, options);
    const CheckReport report = check(set.sites, built.faces(), options);
    EXPECT_TRUE(report.is_valid) << report.reason;
    EXPECT_EQ(report.num_vertices, built.num_vertices());
    EXPECT_EQ(report.num_hidden, built.hidden().size());
    EXPECT_EQ(report.num_duplicates, built.duplicates().size());
    expect_equal(delaunay(set.sites, options, {.threads = 3}), built);
    // In another order, duplicates first, the vertices have other names.
    std::ranges::reverse(set.sites);
    const auto last = static_cast<Index>(set.sites.size() - 1);
    std::vector<Index> name(set.sites.size());
    for (Index i = 0; i <= last; ++i) name[i] = last - i;
    const Triangulation reversed = delaunay(set.sites, options);
    for (const Duplicate& d : built.duplicates()) name[last - d.site] = d.representative;
    EXPECT_TRUE(std::ranges::equal(reversed.faces(), built.faces(), {}, [&](const Triple& f) {
      return Triple{name[f[0]], name[f[1]], name[f[2]]};
    }));
  }
}

// Sites are copied only where they are many.
TEST(bulk_api, copies_of_sites_change_nothing) {
  if (is_shortened()) GTEST_SKIP() << "takes long here";
  for (const std::size_t num_different : {bulk::min_copied_sites, std::size_t{100000}}) {
    SiteSet set = generator("uniform").make(num_different, 1);
    while (set.sites.size() < bulk::min_copied_sites + 1000) {
      set.sites.push_back(set.sites[set.sites.size() / 2]);
    }
    const Triangulation built = delaunay(set.sites, {}, {.threads = 2});
    const auto order = order::spatial_order(set.sites, Model::projected, {}, 1);
    const auto without = bulk::triangulate(set.sites, order.order, order.renamed, {}).arrays;
    EXPECT_EQ(built.num_vertices(), num_different);
    EXPECT_TRUE(std::ranges::equal(built.faces(), without.faces));
    EXPECT_TRUE(std::ranges::equal(built.neighbors(), without.neighbors));
  }
}

TEST(bulk_api, progress_never_goes_back_and_ends_once) {
  const SiteSet set = generator("uniform").make(100000, 1);
  std::vector<double> fractions;
  const Progress progress = [&fractions](std::string_view stage, double fraction) {
    if (stage == "triangulate") fractions.push_back(fraction);
  };
  const Triangulation built = delaunay(set.sites, {}, {.threads = 2, .progress = progress});
  EXPECT_EQ(built.num_vertices(), set.sites.size());
  EXPECT_GE(fractions.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(std::ranges::count(fractions, 1.0), 1);
}

// A plane through the center that is parallel to two axes belongs to no octant, whichever it is.
TEST(bulk_sphere_octants, hold_no_site_on_their_planes) {
  std::vector<Point> corners;
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      for (const double z : {-1, 1}) corners.push_back({x, y, z});
    }
  }
  EXPECT_TRUE(bulk::surround_center(corners, {}));
  for (const Point& center : {Point{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    EXPECT_FALSE(bulk::surround_center(corners, center));
    EXPECT_FALSE(bulk::surround_center(corners, -1.0 * center));
  }
}

}  // namespace
}  // namespace rondel::test
