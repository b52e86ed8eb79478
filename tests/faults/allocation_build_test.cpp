// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Builds, duals and queries without enough memory: std::bad_alloc and no leak, or the result.

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "faults/failing_allocation.h"
#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/hull.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

template <class T>
std::vector<T> copy(std::span<const T> values) {
  return {values.begin(), values.end()};
}

auto parts(const Triangulation& t) {
  return std::tuple(t.dimension(), copy(t.faces()), copy(t.neighbors()), copy(t.ghost_faces()),
                    copy(t.ring()), copy(t.duplicates()), copy(t.hidden()));
}

// What is built of some sites, for each way to build.
struct Input {
  std::vector<Point> sites;
  Options options;
};

class Allocation : public testing::TestWithParam<std::tuple<std::string_view, Model>> {
 protected:
  static Input input(std::size_t n) {
    const auto& [name, model] = GetParam();
    SiteSet set = generator(name).make(n, 1);
    set.sites.push_back(set.sites.front());  // a duplicate
    return {std::move(set.sites), {.model = model, .sphere = set.sphere}};
  }
};

TEST_P(Allocation, delaunay) {
  const Input in = input(24);
  expect_result_or_bad_alloc([&] { return parts(delaunay(in.sites, in.options)); });
}

TEST_P(Allocation, convex_hull) {
  const Input in = input(24);
  expect_result_or_bad_alloc([&] { return parts(convex_hull(in.sites, {.threads = 1})); });
}

TEST_P(Allocation, check) {
  const Input in = input(16);
  const Triangulation built = delaunay(in.sites, in.options);
  expect_result_or_bad_alloc([&] { return check(in.sites, built.faces(), in.options).reason; });
}

TEST_P(Allocation, duals) {
  const Input in = input(16);
  const Triangulation built = delaunay(in.sites, in.options);
  expect_result_or_bad_alloc([&] {
    const Diagram d = diagram(built);
    const auto centers = centroids(built);
    return std::tuple(d.cells.rings.offsets, d.cells.rings.values, d.cells.points, d.areas,
                      centers);
  });
  expect_result_or_bad_alloc([&] { return circumcenters(built); });
  expect_result_or_bad_alloc([&] {
    const Cells c = cells(built);
    return std::tuple(c.rings.offsets, areas(built));
  });
  expect_result_or_bad_alloc([&] {
    const CompressedRows<Index> p = merge_cocircular(built);
    return std::tuple(p.offsets, p.values, edges(built));
  });
}

TEST_P(Allocation, queries) {
  const Input in = input(16);
  const Triangulation built = delaunay(in.sites, in.options);
  const std::vector<Point> queries = {{1, 2, 3}, {-1, 0.5, 0.25}, {0.1, -3, 1}, {-1, -1, -1}};
  expect_result_or_bad_alloc([&] { return Locator(built).nearest(queries.front()); });
  const Locator locator(built);
  const Execution one{.threads = 1};
  expect_result_or_bad_alloc([&] { return locator.nearest(queries, one); });
  expect_result_or_bad_alloc([&] { return locator.k_nearest(queries, 3, one); });
  expect_result_or_bad_alloc([&] { return locator.within(queries, 1, one).values; });
  expect_result_or_bad_alloc([&] { return locator.conflict_region(queries.front()); });
  expect_result_or_bad_alloc([&] { return locator.locate(queries, one); });
}

INSTANTIATE_TEST_SUITE_P(sites, Allocation,
                         testing::Combine(testing::Values("uniform", "integer_sphere",
                                                          "great_circle", "regional_grid", "ball"),
                                          testing::Values(Model::projected, Model::weighted)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) == Model::weighted ? "_weighted"
                                                                              : "_projected");
                         });

// So many that they are built by blocks.
TEST(allocation_of_blocks, delaunay) {
  for (const Model model : {Model::projected, Model::weighted}) {
    std::vector<Point> sites = generator("uniform").make(9000, 1).sites;
    expect_result_or_bad_alloc(
        [&] { return parts(delaunay(sites, {.model = model}, {.threads = 1})); });
  }
}

// The exception crosses threads.
TEST(allocation_of_blocks, delaunay_with_threads) {
  std::vector<Point> sites = generator("uniform").make(150'000, 1).sites;
  const Triangulation expected = delaunay(sites, {}, {.threads = 2});
  std::size_t num_failed = 0;
  for (std::size_t n = 1; n < 300; n += 37) {
    FailingAllocation failing(n, Shortage::of_one_block);
    try {
      const Triangulation built = delaunay(sites, {}, {.threads = 2});
      failing.stop();
      EXPECT_TRUE(std::ranges::equal(built.faces(), expected.faces()));
    } catch (const std::bad_alloc&) {
      num_failed += failing.stop() ? 1 : 0;
    }
  }
  EXPECT_GT(num_failed, 0U);
}

TEST(allocation_of_arrays, unit_vectors_and_polar_points) {
  const std::vector<LonLat> positions = {{0, 0}, {90, 45}, {-120, -45}};
  const std::vector<double> radii = {1, 2, 3};
  expect_result_or_bad_alloc([&] { return unit_vectors(positions); });
  expect_result_or_bad_alloc([&] { return polar_points(positions, radii); });
}

}  // namespace
}  // namespace rondel::test
