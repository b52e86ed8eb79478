// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tests both byte orders on every machine, including the conversion to the order that it does not
// have.
#include "io/binary.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/utf8.h"

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

// UTF-8 is what the encoding of RFC 3629, section 3, makes of the code points, and nothing else.

std::string encoded(std::uint32_t point) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  const auto rest = [&](unsigned shift) { return byte(0x80U | ((point >> shift) & 0x3FU)); };
  if (point < 0x80) return {byte(point)};
  if (point < 0x800) return {byte(0xC0U | point >> 6U), rest(0)};
  if (point < 0x10000) return {byte(0xE0U | point >> 12U), rest(6), rest(0)};
  return {byte(0xF0U | point >> 18U), rest(12), rest(6), rest(0)};
}

bool is_surrogate(std::uint32_t point) { return point >= 0xD800 && point <= 0xDFFF; }

TEST(utf8, has_every_code_point_alone_and_in_text) {
  std::string text;
  for (std::uint32_t point = 0; point <= 0x10FFFF; ++point) {
    if (is_surrogate(point)) continue;
    const std::string letter = encoded(point);
    ASSERT_TRUE(io::is_utf8(letter)) << point;
    text += letter;
    // A letter that is cut is none.
    const std::string cut = letter.substr(0, letter.size() - 1);
    ASSERT_EQ(io::is_utf8(cut), cut.empty()) << point;
  }
  EXPECT_TRUE(io::is_utf8(text));
  EXPECT_TRUE(io::is_utf8(""));
}

TEST(utf8, has_no_other_sequence) {
  std::set<std::string> letters;
  for (std::uint32_t point = 0; point < 0x10000; ++point) {
    if (!is_surrogate(point)) letters.insert(encoded(point));
  }
  const auto is_text = [&](const std::string& bytes) {  // of letters of one or two bytes, or one
    if (letters.contains(bytes)) return true;
    for (std::size_t k = 1; k < bytes.size(); ++k) {
      if (letters.contains(bytes.substr(0, k)) && letters.contains(bytes.substr(k))) return true;
    }
    return false;
  };
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string two = {static_cast<char>(first), static_cast<char>(second)};
      ASSERT_EQ(io::is_utf8(two), is_text(two)) << first << ' ' << second;
      if (first < 0xE0) continue;
      for (const int third : {0x00, 0x41, 0x7F, 0x80, 0xA0, 0xBF, 0xC0, 0xC3, 0xFF}) {
        const std::string three = two + static_cast<char>(third);
        ASSERT_EQ(io::is_utf8(three), letters.contains(three))
            << first << ' ' << second << ' ' << third;
      }
    }
  }
  // Four bytes: nothing shorter is written so, and nothing is above U+10FFFF.
  for (int first = 0xF0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::uint32_t point = (static_cast<unsigned>(first) & 7U) << 18U |
                                  (static_cast<unsigned>(second) & 0x3FU) << 12U;
      const bool is_letter =
          first <= 0xF4 && (second & 0xC0) == 0x80 && point >= 0x10000 && point <= 0x10FFFF;
      const std::string bytes = {static_cast<char>(first), static_cast<char>(second), '\x80',
                                 '\x80'};
      ASSERT_EQ(io::is_utf8(bytes), is_letter) << first << ' ' << second;
      ASSERT_FALSE(io::is_utf8(bytes.substr(0, 3) + 'a'));
      ASSERT_FALSE(io::is_utf8(bytes.substr(0, 2) + "a\x80"));
    }
  }
}

}  // namespace
}  // namespace rondel::test
