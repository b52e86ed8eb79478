// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays as a page holds them: planes, zlib streams, base64.
#include "page/packed.h"

#include <gtest/gtest.h>

#include <random>

#include "support/page_reader.h"

namespace rondel::test {
namespace {

std::string random_bytes(std::size_t size, unsigned values) {
  std::mt19937_64 random(3);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % values);
  return bytes;
}

TEST(base64, is_that_of_rfc_4648) {
  EXPECT_EQ(page::base64(""), "");
  EXPECT_EQ(page::base64("f"), "Zg==");
  EXPECT_EQ(page::base64("fo"), "Zm8=");
  EXPECT_EQ(page::base64("foo"), "Zm9v");
  EXPECT_EQ(page::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(page::base64("\xff\xfe\xfd"), "//79");
}

TEST(in_planes, puts_bytes_of_one_place_together) {
  EXPECT_EQ(page::in_planes("abcdABCD", 4), "aAbBcCdD");
  EXPECT_EQ(page::in_planes("abc", 1), "abc");
  EXPECT_EQ(page::in_planes("", 8), "");
}

TEST(zlib_stream, is_read_by_zlib_at_any_length) {
  constexpr std::size_t piece = 1 << 20;
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, piece - 1, piece, piece + 1, 3 * piece + 17}) {
    for (const unsigned values : {2U, 256U}) {
      const std::string bytes = random_bytes(size, values);
      EXPECT_EQ(inflated(page::zlib_stream(bytes, 2), size), bytes) << size;
    }
  }
}

TEST(zlib_stream, does_not_depend_on_the_number_of_threads) {
  const std::string bytes = random_bytes(5'000'000, 16);
  const std::string one = page::zlib_stream(bytes, 1);
  EXPECT_LT(one.size(), bytes.size() * 6 / 10);
  EXPECT_EQ(one, page::zlib_stream(bytes, 4));
}

}  // namespace
}  // namespace rondel::test
