// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Data that libdeflate or zlib compresses is read by zlib, and the other way round.
#include "io/zlib_data.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/random.h"

namespace rondel::test {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes compressed_by_zlib(const Bytes& bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  Bytes result(size);
  EXPECT_EQ(compress2(result.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level),
            Z_OK);
  result.resize(size);
  return result;
}

Bytes uncompressed_by_zlib(const Bytes& data, std::size_t count) {
  Bytes bytes(count);
  uLongf size = count;
  EXPECT_EQ(uncompress(bytes.data(), &size, data.data(), static_cast<uLong>(data.size())), Z_OK);
  bytes.resize(size);
  return bytes;
}

// Bytes that repeat, that hardly do, and that do not.
std::vector<Bytes> samples() {
  Random random(5);
  std::vector<Bytes> result;
  for (const std::size_t size : {2U, 3U, 255U, 65'536U, 1'000'001U}) {
    for (const std::uint64_t range : {1U, 5U, 256U}) {
      Bytes bytes(size);
      for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random.below(range));
      result.push_back(bytes);
    }
  }
  return result;
}

TEST(ZlibData, IsReadAndWrittenAsZlibDoes) {
  for (const Bytes& bytes : samples()) {
    for (const int level : {1, 4, 9}) {
      const Bytes data = io::zlib_compressed(bytes, level);
      ASSERT_EQ(uncompressed_by_zlib(data, bytes.size()), bytes);
      Bytes found(bytes.size(), 77);
      ASSERT_TRUE(io::zlib_uncompress(data, found));
      ASSERT_EQ(found, bytes);
      found.assign(bytes.size(), 77);
      ASSERT_TRUE(io::zlib_uncompress(compressed_by_zlib(bytes, level), found));
      ASSERT_EQ(found, bytes);
    }
  }
}

TEST(ZlibData, OfAnotherSizeOrDamagedIsRefused) {
  Random random(6);
  for (const Bytes& bytes : samples()) {
    Bytes data = compressed_by_zlib(bytes, 6);
    Bytes longer(bytes.size() + 1);
    EXPECT_FALSE(io::zlib_uncompress(data, longer));
    Bytes shorter(bytes.size() - 1);
    EXPECT_FALSE(io::zlib_uncompress(data, shorter));
    Bytes found(bytes.size());
    EXPECT_FALSE(io::zlib_uncompress(std::span(data).first(data.size() - 1), found));
    data.push_back(1);  // which is not of the data
    EXPECT_TRUE(io::zlib_uncompress(data, found));
    data.pop_back();
    // Its last bytes are the checksum of all.
    data.back() = static_cast<unsigned char>(data.back() + 1 + random.below(255));
    EXPECT_FALSE(io::zlib_uncompress(data, found));
  }
}

}  // namespace
}  // namespace rondel::test
