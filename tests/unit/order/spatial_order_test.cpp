// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The spatial order against a plain sort by its definition, for any number of threads.
#include "order/spatial_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "gtest/gtest.h"
#include "order/crowds.h"
#include "order/sorts.h"
#include "predicates/ray_order.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel {
namespace {

using order::SpatialOrder;

constexpr unsigned thread_counts[] = {1, 2, 3, 7, 16, 64};

auto coordinates(const Point& p) { return std::tie(p.x, p.y, p.z); }

Sign compare_places(const Point& p, const Point& q, Model model, const Point& center) {
  if (model == Model::projected) return predicates::compare_rays(p, q, center);
  if (p == q) return Sign::zero;
  return coordinates(p) < coordinates(q) ? Sign::negative : Sign::positive;
}

// Sorts all sites so that duplicates meet, keeps one of each place, sorts what is kept.
SpatialOrder sort_by_definition(std::span<const Point> sites, Model model, const Point& center) {
  struct Entry {
    order::HilbertKey key;
    Index site;
    Index name;
  };
  std::vector<Entry> entries;
  for (Index i = 0; i < sites.size(); ++i) {
    entries.push_back({order::place_key(sites[i], model, center), i, i});
  }
  std::ranges::sort(entries, [&](const Entry& a, const Entry& b) {
    if (a.key != b.key) return a.key < b.key;
    const Sign places = compare_places(sites[a.site], sites[b.site], model, center);
    if (places != Sign::zero) return places == Sign::negative;
    return std::tuple(coordinates(sites[a.site]), a.site) <
           std::tuple(coordinates(sites[b.site]), b.site);
  });
  SpatialOrder result;
  std::vector<Entry> kept;
  for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
    for (end = i + 1; end < entries.size(); ++end) {
      const Entry& a = entries[i];
      const Entry& b = entries[end];
      if (a.key != b.key) break;
      if (compare_places(sites[a.site], sites[b.site], model, center) != Sign::zero) break;
    }
    const std::span same(entries.data() + i, end - i);
    kept.push_back(same[0]);
    kept.back().name = std::ranges::min(same, {}, &Entry::site).site;
    for (const Entry& e : same) {
      if (e.site != kept.back().name) result.duplicates.push_back({e.site, kept.back().name});
    }
  }
  std::ranges::sort(kept, [&](const Entry& a, const Entry& b) {
    return std::tuple(a.key, coordinates(sites[a.site])) <
           std::tuple(b.key, coordinates(sites[b.site]));
  });
  std::ranges::sort(result.duplicates, {}, &Duplicate::site);
  for (const Entry& e : kept) {
    if (e.name != e.site) {
      result.renamed.push_back({static_cast<Index>(result.order.size()), e.name});
    }
    result.order.push_back(e.site);
  }
  return result;
}

void expect_order_by_definition(std::span<const Point> sites, Model model, const Point& center) {
  const SpatialOrder expected = sort_by_definition(sites, model, center);
  const auto expect_same = [&expected](const SpatialOrder& order, unsigned threads) {
    EXPECT_EQ(order.order, expected.order) << threads;
    EXPECT_EQ(order.duplicates, expected.duplicates) << threads;
    EXPECT_EQ(order.renamed, expected.renamed) << threads;
  };
  for (const unsigned threads : thread_counts) {
    expect_same(order::spatial_order(sites, model, center, threads), threads);
  }
  std::vector<Point> ordered;
  for (const Index i : expected.order) ordered.push_back(sites[i]);
  for (const unsigned threads : {1U, 3U, 64U}) {
    std::vector<Point> copies(sites.size());
    expect_same(order::spatial_order(sites, model, center, threads, {},
                                     system::SiteCopies(std::span(copies))),
                threads);
    copies.resize(ordered.size());
    EXPECT_EQ(copies, ordered) << threads;
  }
}

TEST(spatial_order, is_that_of_its_definition_for_every_kind_of_input) {
  for (const test::Generator& generator : test::generators()) {
    const std::size_t many = test::is_shortened() ? 1000 : 3000;
    const std::size_t n = generator.has_long_integers ? 60 : many;
    const test::SiteSet set = generator.make(n, 21);
    SCOPED_TRACE(generator.name);
    expect_order_by_definition(set.sites, Model::weighted, set.sphere.center);
    if (!generator.weighted_only) {
      expect_order_by_definition(set.sites, Model::projected, set.sphere.center);
    }
  }
}

// A point in a square of this side on the cube's face x = 1.
Point in_patch(test::Random& random, double side) {
  return {1, 0.3 + side * random.unit(), -0.2 + side * random.unit()};
}

// Enough sites for many leaves and several pieces of input.
TEST(spatial_order, is_that_of_its_definition_for_many_sites) {
  test::Random random(22);
  constexpr std::size_t n = 70000;
  for (const double side : {1.0, 1e-3, 1e-6, 1e-10, 1e-14, 0.0}) {
    for (const std::size_t spread : {0U, 2U, 1000U}) {
      if (test::is_shortened() && (spread != 2 || side == 1e-3 || side == 1e-10)) continue;
      SCOPED_TRACE(testing::Message() << side << ' ' << spread);
      std::vector<Point> sites;
      for (std::size_t i = 0; i < n; ++i) {
        const bool is_anywhere = spread != 0 && i % spread == 0;
        sites.push_back(is_anywhere ? test::random_direction(random) : in_patch(random, side));
        if (random.between(0, 9) == 0) {
          const Point& p = sites[random.next() % sites.size()];
          const double scale = random.coin() ? 1 : 3;
          sites.push_back({scale * p.x, scale * p.y, scale * p.z});
        }
      }
      expect_order_by_definition(sites, Model::weighted, {});
    }
  }
}

TEST(spatial_order, merges_rays_of_any_length_for_any_number_of_threads) {
  test::Random random(23);
  std::vector<Point> sites;
  for (int i = 0; i < 70000; ++i) {
    const Point p = {random.between(1, 60) + 0.0, random.between(-60, 60) + 0.0,
                     random.between(-60, 60) + 0.0};
    sites.push_back(p);
  }
  expect_order_by_definition(sites, Model::projected, {});
}

void expect_keys_of_each(std::span<const Point> sites, Model model, const Point& center) {
  std::vector<std::uint64_t> keys(sites.size());
  std::vector<std::uint64_t> keys_alone(sites.size());
  std::vector<std::uint64_t> low_keys(sites.size());
  order::place_keys(sites, model, center, keys, low_keys);
  order::place_keys(sites, model, center, keys_alone);
  EXPECT_EQ(keys_alone, keys);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const order::HilbertKey key = order::place_key(sites[i], model, center);
    EXPECT_EQ(keys[i], key.high) << i;
    EXPECT_EQ(low_keys[i], key.low) << i;
  }
}

TEST(spatial_place_keys, of_many_sites_are_those_of_each) {
  for (const test::Generator& generator : test::generators()) {
    const test::SiteSet set = generator.make(300, 25);
    SCOPED_TRACE(generator.name);
    expect_keys_of_each(set.sites, Model::weighted, set.sphere.center);
    if (!generator.weighted_only) {
      expect_keys_of_each(set.sites, Model::projected, set.sphere.center);
    }
  }
  // Edges and corners of the cube, its center, beyond the range of doubles.
  std::vector<Point> sites;
  for (const double x : {-1e308, -2.0, -1.0, -5e-324, -0.0, 0.0, 5e-324, 1.0, 2.0, 1e308}) {
    for (const double y : {-1e308, -2.0, -1.0, -0.0, 0.0, 5e-324, 1.0, 0x1.fffffffffffffp0}) {
      for (const double z : {-2.0, -1.0, 0.0, 1.0, 2.0}) sites.push_back({x, y, z});
    }
  }
  expect_keys_of_each(sites, Model::weighted, {});
  expect_keys_of_each(sites, Model::weighted, {1e308, -1e308, 1});
  expect_keys_of_each(sites, Model::projected, {-1, 0.5, -1});
}

TEST(spatial_word_sort, sorts_words_that_agree_in_any_of_their_bits) {
  test::Random random(24);
  for (const std::size_t n : {0U, 1U, 2U, 24U, 25U, 700U, 5000U, 100000U}) {
    for (const int shift : {0, 3, 20, 44}) {
      for (const std::uint64_t mask : {~std::uint64_t{0}, std::uint64_t{0xff000000000fffff}}) {
        std::vector<std::uint64_t> words;
        for (std::size_t i = 0; i < n; ++i) {
          words.push_back((((random.next() & mask) >> shift) & ~std::uint64_t{0x1ffff}) | i);
        }
        auto expected = words;
        std::ranges::sort(expected);
        std::vector<std::uint64_t> result(n);
        order::sort_words(words, result);
        EXPECT_EQ(result, expected) << n << ' ' << shift << ' ' << mask;
      }
    }
  }
}

// By quadrants of a face of the cube, then from the outside to the middle.
TEST(crowds, come_by_their_distance_from_the_middle_of_a_face) {
  test::Random random(1);
  std::vector<Point> sites;
  for (int i = 0; i < 3000; ++i) {
    const auto tiny = [&] {
      return std::ldexp(random.signed_unit(), -60 - random.between(0, 900));
    };
    const double length = std::ldexp(1 + random.unit(), random.between(-50, 50));
    sites.push_back({length * tiny(), length, length * tiny()});
  }
  const auto order = order::spatial_order(sites, Model::projected, {}, 1).order;
  auto ranks = order::ranks_with_crowds_in_order(sites, order, Model::projected, {});
  const auto site = [&](std::size_t i) { return sites[order[ranks[i]]]; };
  const auto quadrant = [](const Point& p) { return std::pair(p.x < 0, p.z < 0); };
  const auto size = [](const Point& p) {
    return std::max(std::abs(p.x / p.y), std::abs(p.z / p.y));
  };
  std::size_t num_quadrants = 1;
  for (std::size_t i = 1; i < ranks.size(); ++i) {
    if (quadrant(site(i)) != quadrant(site(i - 1))) {
      ++num_quadrants;
    } else {
      EXPECT_LT(size(site(i - 1)), 2 * size(site(i)));
    }
  }
  EXPECT_EQ(num_quadrants, 4U);
  std::ranges::sort(ranks);
  for (Index i = 0; i < sites.size(); ++i) EXPECT_EQ(ranks[i], i);
}

TEST(crowds, are_none_where_sites_are_told_apart) {
  test::Random random(2);
  std::vector<Point> sites;
  for (int i = 0; i < 2000; ++i) sites.push_back(test::random_direction(random));
  const auto order = order::spatial_order(sites, Model::projected, {}, 1).order;
  EXPECT_TRUE(order::ranks_with_crowds_in_order(sites, order, Model::projected, {}).empty());
}

// Rays so long or so short that nothing can be computed from them are sorted, too.
TEST(crowds, may_be_of_any_lengths) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  std::vector<Point> sites;
  for (int i = 0; i < 100; ++i) {
    sites.push_back({-most, i * 1e200, 0});
    sites.push_back({-1, i * least, i * 1e-300});
    sites.push_back({-1e290, i * 1e200, -i * 1e-300});
  }
  for (const Point& center : {Point{}, Point{most, 0, 0}, Point{1, 1, 1}}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      const auto order = order::spatial_order(sites, model, center, 1).order;
      auto ranks = order::ranks_with_crowds_in_order(sites, order, model, center);
      std::ranges::sort(ranks);
      for (Index i = 0; i < ranks.size(); ++i) ASSERT_EQ(ranks[i], i);
    }
  }
}

}  // namespace
}  // namespace rondel
