// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The spatial order and the order of insertion.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "exact/vector.h"
#include "kernel/brio.h"
#include "order/cube_position.h"
#include "order/hilbert.h"
#include "order/sorts.h"
#include "order/spatial_order.h"
#include "rondel/predicates.h"
#include "support/generators.h"

namespace rondel {
namespace {

using order::CubePosition;
using order::HilbertKey;
using order::position_bits;

bool is_less(const HilbertKey& a, const HilbertKey& b) {
  return a.high != b.high ? a.high < b.high : a.low < b.low;
}

TEST(spatial_hilbert, neighbors_along_the_curve_are_neighbors_on_the_face) {
  constexpr unsigned side = 64;
  constexpr int shift = position_bits - 6;
  std::vector<CubePosition> cells;
  for (std::uint64_t u = 0; u < side; ++u) {
    for (std::uint64_t v = 0; v < side; ++v) cells.push_back({0, u << shift, v << shift});
  }
  std::ranges::sort(cells, [](const CubePosition& a, const CubePosition& b) {
    return is_less(hilbert_key(a), hilbert_key(b));
  });
  const auto distance = [](std::uint64_t a, std::uint64_t b) {
    return (a > b ? a - b : b - a) >> shift;
  };
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_EQ(distance(cells[i].u, cells[i - 1].u) + distance(cells[i].v, cells[i - 1].v), 1U);
  }
  EXPECT_EQ(cells.front().u + cells.front().v, 0U);
  EXPECT_EQ(cells.back().u >> shift, side - 1);
  EXPECT_EQ(cells.back().v, 0U);
}

TEST(spatial_hilbert, the_low_key_continues_the_high_key) {
  // Neighboring positions of full precision differ in the low keys only, or are at a border.
  const CubePosition a = {3, 0x5555555555555, 0x3333333333333};
  CubePosition b = a;
  b.u ^= 1;
  EXPECT_EQ(hilbert_key(a).high, hilbert_key(b).high);
  EXPECT_NE(hilbert_key(a).low, hilbert_key(b).low);
}

TEST(spatial_cube, the_curve_enters_a_face_where_it_leaves_the_one_before) {
  // Fine cells around the cube in the order of the curve: consecutive ones are close.
  std::vector<std::pair<HilbertKey, Point>> cells;
  constexpr int side = 40;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
          std::array<double, 3> p{};
          const auto k = static_cast<std::size_t>(axis);
          p[k] = sign;
          p[(k + 1) % 3] = (2 * i + 1.0) / side - 1;
          p[(k + 2) % 3] = (2 * j + 1.0) / side - 1;
          const Point point = {p[0], p[1], p[2]};
          cells.emplace_back(hilbert_key(order::cube_position(point, {})), point);
        }
      }
    }
  }
  std::ranges::sort(cells, [](const auto& a, const auto& b) { return is_less(a.first, b.first); });
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const Point d = {cells[i].second.x - cells[i - 1].second.x,
                     cells[i].second.y - cells[i - 1].second.y,
                     cells[i].second.z - cells[i - 1].second.z};
    EXPECT_LT(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), 10.0 / side);
  }
}

TEST(spatial_cube, exact_positions_agree_with_rounded_ones_but_for_the_last_bits) {
  test::Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const Point p = test::random_direction(random);
    const CubePosition rounded = order::cube_position(p, {});
    const CubePosition exact = order::exact_cube_position(p, {});
    EXPECT_EQ(rounded.face, exact.face);
    EXPECT_LE(std::llabs(static_cast<long long>(rounded.u - exact.u)), 4);
    EXPECT_LE(std::llabs(static_cast<long long>(rounded.v - exact.v)), 4);
  }
}

// With a center the positions are found in integers.
TEST(spatial_cube, exact_positions_of_rays_from_zero_are_those_of_integers) {
  test::Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const auto whole = [&random] {
      return std::trunc(std::ldexp(random.signed_unit(), random.between(0, 51)));
    };
    const Point ray = {whole(), whole(), whole()};
    if (ray == Point{}) continue;
    const Point center = {whole(), whole(), 1};
    const CubePosition exact = order::exact_cube_position(ray + center, center);
    const CubePosition of_doubles = order::exact_cube_position(ray, {});
    ASSERT_EQ(of_doubles.face, exact.face);
    ASSERT_EQ(of_doubles.u, exact.u);
    ASSERT_EQ(of_doubles.v, exact.v);
  }
  const CubePosition middle = order::exact_cube_position({1, -1e-300, 5e-324}, {});
  EXPECT_EQ(std::max(middle.u, middle.v), std::uint64_t{1} << 51U);
  EXPECT_EQ(std::min(middle.u, middle.v), (std::uint64_t{1} << 51U) - 1);
}

TEST(spatial_radix_sort, sorts_spread_and_crowded_keys) {
  test::Random random(6);
  for (const int crowding : {0, 20, 40, 57}) {
    for (const std::size_t n : {0U, 1U, 2U, 31U, 33U, 5000U}) {
      order::KeyedIndices data;
      for (Index i = 0; i < n; ++i) {
        data.keys.push_back((random.next() >> 5) >> crowding);
        data.indices.push_back(i);
      }
      const auto keys = data.keys;
      order::radix_sort(data, 59);
      EXPECT_TRUE(std::ranges::is_sorted(data.keys));
      std::vector<bool> seen(n);
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(keys[data.indices[i]], data.keys[i]);
        EXPECT_FALSE(seen[data.indices[i]]);
        seen[data.indices[i]] = true;
      }
    }
  }
}

// All pairs, by the exact predicate.
void expect_all_duplicates_found(std::span<const Point> sites, Model model, const Sphere& sphere) {
  const auto order = order::spatial_order(sites, model, sphere.center, 1);
  std::vector<Index> representative(sites.size());
  for (Index i = 0; i < sites.size(); ++i) {
    representative[i] = i;
    for (Index j = 0; j < i && representative[i] == i; ++j) {
      if (is_same_site(sites[i], sites[j], model, sphere)) representative[i] = representative[j];
    }
  }
  std::vector<Duplicate> expected;
  for (Index i = 0; i < sites.size(); ++i) {
    if (representative[i] != i) expected.push_back({i, representative[i]});
  }
  EXPECT_EQ(order.duplicates, expected);
  EXPECT_EQ(order.order.size() + expected.size(), sites.size());
  for (const auto& [rank, name] : order.renamed) {
    EXPECT_NE(order.order[rank], name);
    EXPECT_TRUE(is_same_site(sites[order.order[rank]], sites[name], model, sphere));
  }
}

TEST(spatial_order, finds_all_duplicates_of_every_kind_of_input) {
  for (const test::Generator& generator : test::generators()) {
    if (generator.has_long_integers) continue;
    const test::SiteSet set = generator.make(150, 9);
    SCOPED_TRACE(generator.name);
    expect_all_duplicates_found(set.sites, Model::weighted, set.sphere);
    if (!generator.weighted_only)
      expect_all_duplicates_found(set.sites, Model::projected, set.sphere);
  }
}

TEST(spatial_order, finds_rays_of_any_length_from_a_center_that_is_not_zero) {
  // Multiples of one integer vector from an integer center: exactly one ray, whatever the rounding.
  test::Random random(8);
  Sphere sphere;
  sphere.center = {1e6 + 3, -12345, 77};
  std::vector<Point> sites;
  for (int i = 0; i < 60; ++i) {
    const std::array<int, 3> d = {random.between(-9, 9), random.between(-9, 9), 10};
    for (const int k : {1, 3, 7, 1000003}) {
      sites.push_back(
          {sphere.center.x + k * d[0], sphere.center.y + k * d[1], sphere.center.z + k * d[2]});
    }
  }
  expect_all_duplicates_found(sites, Model::projected, sphere);
  // From 0.1 the differences are not doubles; powers of two around the center keep rays exact.
  sphere.center = {0.1, 0.1, 0.1};
  sites.clear();
  for (int i = 0; i < 200; ++i) sites.push_back(test::random_direction(random));
  for (int i = 0; i < 50; ++i) sites.push_back(sites[static_cast<std::size_t>(3 * i)]);
  expect_all_duplicates_found(sites, Model::projected, sphere);
}

TEST(insertion_order, is_a_permutation_whose_rounds_grow) {
  for (const Index n : {0U, 1U, 7U, 64U, 100000U}) {
    auto order = kernel::insertion_order(n);
    // The last round is in spatial order, and is about 7/8 of all.
    const auto last_descent = std::adjacent_find(order.rbegin(), order.rend(), std::less<>());
    if (n == 100000) {
      const auto last_round = last_descent - order.rbegin();
      EXPECT_GT(last_round, 86000);
      EXPECT_LT(last_round, 89000);
    }
    std::ranges::sort(order);
    std::vector<Index> all(n);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(order, all);
  }
}

}  // namespace
}  // namespace rondel
