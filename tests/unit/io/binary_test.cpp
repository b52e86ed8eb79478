// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tests both byte orders on every machine, including the conversion to the order that it does not
// have.
#include "io/binary.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rondel::test {
namespace {

using io::load;
using io::NumberBytes;
using io::store;

std::string stored(std::uint32_t number, std::endian order) {
  std::array<char, sizeof number> bytes{};
  EXPECT_EQ(store(number, bytes.data(), order), bytes.data() + bytes.size());
  return {bytes.data(), bytes.size()};
}

TEST(binary, a_number_is_stored_in_either_order) {
  EXPECT_EQ(stored(0x01020304, std::endian::little), "\x04\x03\x02\x01");
  EXPECT_EQ(stored(0x01020304, std::endian::big), "\x01\x02\x03\x04");
}

TEST(binary, a_number_is_loaded_in_either_order) {
  const char* const bytes = "\xbf\xf8\x00\x00\x00\x00\x00\x00\xf8\xbf";
  EXPECT_EQ(load<double>(bytes, std::endian::big), -1.5);
  EXPECT_EQ(load<double>(bytes + 2, std::endian::little), -1.5);
  EXPECT_EQ(load<std::uint16_t>(bytes), 0xf8bf);
}

TEST(binary, arrays_have_the_bytes_of_their_numbers_in_either_order) {
  const std::vector<Triple> triples = {{0x01020304, 5, 6}, {7, 8, 9}};
  using namespace std::string_view_literals;
  EXPECT_EQ(std::string_view(NumberBytes(triples)),
            "\x04\x03\x02\x01\x05\0\0\0\x06\0\0\0\x07\0\0\0\x08\0\0\0\x09\0\0\0"sv);
  EXPECT_EQ(std::string_view(NumberBytes(triples, std::endian::big)),
            "\x01\x02\x03\x04\0\0\0\x05\0\0\0\x06\0\0\0\x07\0\0\0\x08\0\0\0\x09"sv);
}

template <class Element, class Number = typename io::NumbersOf<Element>::Number>
void expect_numbers(const std::vector<Element>& elements, const std::vector<Number>& numbers) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const NumberBytes bytes(elements, order);
    const std::string_view text = bytes;
    ASSERT_EQ(text.size(), numbers.size() * sizeof(Number));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_EQ(load<Number>(text.data() + i * sizeof(Number), order), numbers[i]) << i;
    }
  }
}

TEST(binary, structures_are_written_number_by_number) {
  expect_numbers<Point>({{1, 2.5, -3}, {4, 5, 0x1p-1074}}, {1, 2.5, -3, 4, 5, 0x1p-1074});
  expect_numbers<LonLat>({{7.25, -45}}, {7.25, -45});
  expect_numbers<Duplicate>({{3, 1U << 28U}}, {3, 1U << 28U});
  expect_numbers<Hidden>({{17, 1U << 29U}}, {17, 1U << 29U});
  expect_numbers<std::uint64_t>({1, 1ULL << 40U}, {1, 1ULL << 40U});
  expect_numbers<std::uint8_t>({1, 255}, {1, 255});
  expect_numbers<double>({}, {});
}

}  // namespace
}  // namespace rondel::test
