// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/spatial_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace {

using rondel::Index;
using rondel::no_index;
using rondel::order::HilbertKey;
using rondel::order::SpatialIndex;

bool any(Index) { return true; }
bool unordered(Index) { return false; }

template <class IsBefore>
void insert(SpatialIndex& index, const HilbertKey& key, Index value, IsBefore is_before) {
  index.insert(index.seek(key, is_before), key, value);
}

template <class IsBefore, class IsWanted>
Index find(const SpatialIndex& index, const HilbertKey& key, IsBefore is_before,
           IsWanted is_wanted) {
  return index.find(index.seek(key, is_before), key, is_wanted);
}

// The same by a standard container.
using Model = std::multimap<HilbertKey, Index>;

void expect_same(const SpatialIndex& index, const Model& model) {
  ASSERT_EQ(index.size(), model.size());
  const auto values = index.values();
  ASSERT_EQ(values.size(), model.size());
  std::map<Index, HilbertKey> key_of;
  for (const auto& [key, value] : model) key_of[value] = key;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_TRUE(key_of.contains(values[i]));
    ASSERT_LE(key_of[values[i > 0 ? i - 1 : 0]], key_of[values[i]]);
  }
}

// Random keys out of `range`, so that a small range has long runs of equal keys.
void run_script(std::uint64_t range, int steps, std::uint32_t seed) {
  std::mt19937 random(seed);
  SpatialIndex index;
  Model model;
  Index next = 0;
  std::vector<std::pair<HilbertKey, Index>> live;
  for (int step = 0; step < steps; ++step) {
    const bool is_growing = (step / 3000) % 2 == 0;
    if (live.empty() || random() % 10 < (is_growing ? 7 : 3)) {
      const HilbertKey key = {random() % range, random() % 2};
      insert(index, key, next, unordered);
      model.emplace(key, next);
      live.emplace_back(key, next++);
    } else {
      const std::size_t i = random() % live.size();
      const auto [key, value] = live[i];
      index.erase(key, value, unordered);
      const auto [begin, end] = model.equal_range(key);
      for (auto it = begin; it != end; ++it) {
        if (it->second != value) continue;
        model.erase(it);
        break;
      }
      live[i] = live.back();
      live.pop_back();
      ASSERT_EQ(find(index, key, unordered, [value = value](Index v) { return v == value; }),
                no_index);
    }
    const HilbertKey probe = {random() % range, 0};
    ASSERT_EQ(find(index, probe, unordered, any) == no_index, !model.contains(probe));
    ASSERT_EQ(index.near(probe) == no_index, model.empty());
    if (step % 500 == 0) expect_same(index, model);
  }
  for (const auto& [key, value] : live) {
    ASSERT_EQ(find(index, key, unordered, [value = value](Index v) { return v == value; }), value);
  }
  expect_same(index, model);
}

TEST(spatial_index, behaves_like_a_sorted_list_for_distinct_keys) {
  run_script(std::uint64_t{1} << 50, 20000, 1);
}

TEST(spatial_index, behaves_like_a_sorted_list_for_long_runs_of_equal_keys) {
  run_script(5, 20000, 2);
}

TEST(spatial_index, near_finds_a_neighbor) {
  SpatialIndex index;
  EXPECT_EQ(index.near({7, 0}), no_index);
  for (Index i = 0; i < 1000; ++i) insert(index, {std::uint64_t{10} * i, 0}, i, unordered);
  EXPECT_EQ(index.near({0, 0}), 0U);
  EXPECT_EQ(index.near({100000, 0}), 999U);
  for (Index i = 1; i < 1000; ++i) {
    const Index found = index.near({std::uint64_t{10} * i - 5, 0});
    EXPECT_TRUE(found == i || found == i - 1);
  }
}

// Sites that come in order along a curve have the last one behind them, and nothing near ahead.
TEST(spatial_index, near_finds_the_neighbor_that_is_closer) {
  SpatialIndex index;
  for (Index i = 0; i < 20; ++i) insert(index, {std::uint64_t{10} * i, 0}, i, unordered);
  for (Index i = 0; i < 19; ++i) {
    EXPECT_EQ(index.near({std::uint64_t{10} * i + 2, 0}), i);
    EXPECT_EQ(index.near({std::uint64_t{10} * i + 8, 0}), i + 1);
  }
}

TEST(spatial_index, lists_values_around_a_position) {
  SpatialIndex index;
  const auto around = [&index](const HilbertKey& key) {
    const auto listed = index.around(index.seek(key, unordered));
    std::vector<Index> values(listed.begin(), std::ranges::find(listed, no_index));
    EXPECT_TRUE(std::all_of(listed.begin() + static_cast<std::ptrdiff_t>(values.size()),
                            listed.end(), [](Index v) { return v == no_index; }));
    return values;
  };
  EXPECT_TRUE(around({7, 0}).empty());
  for (Index i = 0; i < 3; ++i) insert(index, {i, 0}, i, unordered);
  EXPECT_EQ(around({1, 0}), (std::vector<Index>{0, 1, 2}));
  for (Index i = 3; i < 2000; ++i) insert(index, {i, 0}, i, unordered);
  for (Index i = 0; i <= 2000; ++i) {
    const auto values = around({i, 0});
    ASSERT_FALSE(values.empty());
    for (const Index v : values) {
      EXPECT_LE(v > i ? v - i : i - v, SpatialIndex::num_around);
    }
  }
}

TEST(spatial_index, numbers_values_in_order) {
  std::mt19937 random(9);
  SpatialIndex index;
  std::map<std::uint64_t, Index> model;
  for (Index i = 0; i < 4000; ++i) {
    const std::uint64_t key = random();
    if (model.emplace(key, i).second) insert(index, {key, 0}, i, unordered);
  }
  index.renumber();
  Index expected = 0;
  for (const auto& [key, value] : model) {
    EXPECT_EQ(find(index, {key, 0}, unordered, any), expected++);
  }
  EXPECT_EQ(expected, index.size());
}

TEST(spatial_index, is_filled_at_once) {
  std::vector<HilbertKey> keys;
  std::vector<Index> values;
  for (Index i = 0; i < 5000; ++i) {
    keys.push_back({i / 3, 0});
    values.push_back(i);
  }
  SpatialIndex index;
  insert(index, {1, 1}, 9999, unordered);
  index.assign(keys, values);
  EXPECT_EQ(index.values(), values);
  for (Index i = 0; i < 5000; ++i) index.erase(keys[i], i, unordered);
  EXPECT_EQ(index.size(), 0U);
}

TEST(spatial_index, orders_values_of_equal_keys) {
  SpatialIndex index;
  const auto before = [](Index value) { return [value](Index other) { return other < value; }; };
  std::vector<Index> values(5000);
  for (Index i = 0; i < 5000; ++i) values[i] = i;
  std::ranges::shuffle(values, std::mt19937(3));
  for (const Index v : values) insert(index, {7, 7}, v, before(v));
  insert(index, {7, 6}, 6000, unordered);
  insert(index, {7, 8}, 7000, unordered);
  const auto listed = index.values();
  EXPECT_TRUE(std::ranges::is_sorted(listed.begin() + 1, listed.end()));
  for (const Index v : values) {
    // The first entry that is not before is the wanted one.
    EXPECT_EQ(find(index, {7, 7}, before(v), any), v);
    index.erase({7, 7}, v, before(v));
    EXPECT_NE(find(index, {7, 7}, before(v), any), v);
  }
  EXPECT_EQ(index.values(), (std::vector<Index>{6000, 7000}));
}

}  // namespace
