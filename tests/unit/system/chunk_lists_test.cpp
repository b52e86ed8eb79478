// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lists of chunks against vectors: few elements and many for each list, several parts.
#include "system/chunk_lists.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gtest/gtest.h"
#include "support/random.h"

namespace rondel::system {
namespace {

struct Wide {
  std::uint64_t name;
  std::array<double, 3> rest;
};

std::uint64_t name_of(std::uint64_t element) { return element; }
std::uint64_t name_of(const Wide& element) { return element.name; }

template <class T>
T element(std::uint64_t name) {
  if constexpr (sizeof(T) > 8) {
    return {name, {}};
  } else {
    return name;
  }
}

// The longest chunk that a part has made.
template <class T>
std::size_t expect_what_was_appended(std::size_t num_parts, std::size_t num_lists,
                                     std::size_t capacity) {
  test::Random random(capacity + num_lists);
  ChunkLists<T> lists(num_parts, num_lists, capacity);
  std::vector<std::vector<std::uint64_t>> expected(num_lists);
  for (std::size_t part = 0; part < num_parts; ++part) {
    auto appender = lists.start(part);
    std::vector<std::size_t> sizes(num_lists);
    for (std::size_t i = 0; i < capacity; ++i) {
      // A third of all in one list.
      const std::size_t list =
          random.between(0, 2) == 0 ? 0 : random.below(static_cast<std::uint64_t>(num_lists));
      const std::uint64_t name = 1000 * i + part;
      appender.append(list, element<T>(name));
      expected[list].push_back(name);
      ++sizes[list];
    }
    for (std::size_t l = 0; l < num_lists; ++l) EXPECT_EQ(lists.size(part, l), sizes[l]);
  }
  std::size_t longest = 0;
  for (std::size_t l = 0; l < num_lists; ++l) {
    std::vector<std::uint64_t> found;
    lists.for_chunks(l, [&](std::span<const T> chunk) {
      longest = std::max(longest, chunk.size());
      for (const T& e : chunk) found.push_back(name_of(e));
    });
    std::ranges::sort(found);
    std::ranges::sort(expected[l]);
    EXPECT_EQ(found, expected[l]) << l;
  }
  EXPECT_LE(longest, std::size_t{1} << lists.chunk_bits());
  return longest;
}

TEST(chunk_lists, have_what_was_appended) {
  for (const std::size_t num_lists : {1U, 7U, 100U}) {
    for (const std::size_t capacity : {0U, 1U, 50U, 3000U}) {
      SCOPED_TRACE(testing::Message() << num_lists << ' ' << capacity);
      expect_what_was_appended<std::uint64_t>(1, num_lists, capacity);
      expect_what_was_appended<Wide>(5, num_lists, capacity);
    }
  }
}

TEST(chunk_lists, have_short_chunks_where_lists_are_short) {
  EXPECT_EQ(expect_what_was_appended<Wide>(3, 100, 1000), 4U);
  EXPECT_EQ(expect_what_was_appended<Wide>(1, 4, 3000), 64U);
}

}  // namespace
}  // namespace rondel::system
