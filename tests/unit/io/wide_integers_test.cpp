// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integers of 64 bits are compared with doubles as integers of 128 bits.
#include "io/wide_integers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/bad_value.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using io::NetcdfType;
__extension__ using Wide = __int128;

// The integer that 64 bits of a type are.
Wide integer_of(std::int64_t bits, NetcdfType type) {
  return type == NetcdfType::uint64 ? Wide{static_cast<std::uint64_t>(bits)} : Wide{bits};
}

// Integers around powers of two, and at both ends, where few are doubles.
std::vector<std::int64_t> hostile_integers() {
  std::vector<std::int64_t> result = {0, 1, -1, std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::int64_t>::max()};
  Random random(3);
  for (unsigned bit = 0; bit < 64; ++bit) {
    const std::uint64_t power = std::uint64_t{1} << bit;
    for (const std::uint64_t step : {1U, 2U, 3U, 511U, 512U, 513U, 1024U, 1025U, 2048U}) {
      for (const std::uint64_t value : {power + step, power - step, power}) {
        result.push_back(static_cast<std::int64_t>(value));
        result.push_back(static_cast<std::int64_t>(-value));
      }
    }
    result.push_back(static_cast<std::int64_t>(random.next() >> bit));
  }
  return result;
}

TEST(wide_integers, are_doubles_if_no_digit_is_lost) {
  for (const NetcdfType type : {NetcdfType::int64, NetcdfType::uint64}) {
    for (const std::int64_t bits : hostile_integers()) {
      const Wide value = integer_of(bits, type);
      EXPECT_EQ(io::is_double(bits, type), static_cast<Wide>(static_cast<double>(value)) == value)
          << bits;
    }
  }
}

TEST(wide_integers, have_the_nearest_doubles_that_are_no_less_or_no_more) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const NetcdfType type : {NetcdfType::int64, NetcdfType::uint64}) {
    for (const std::int64_t bits : hostile_integers()) {
      const Wide value = integer_of(bits, type);
      const double above = io::bound_as_double(bits, type, true);
      const double below = io::bound_as_double(bits, type, false);
      if (static_cast<Wide>(static_cast<double>(value)) == value) {
        EXPECT_EQ(static_cast<Wide>(above), value);
        EXPECT_EQ(static_cast<Wide>(below), value);
        continue;
      }
      // Doubles of this size are integers.
      EXPECT_GT(static_cast<Wide>(above), value);
      EXPECT_LT(static_cast<Wide>(std::nextafter(above, -infinity)), value);
      EXPECT_LT(static_cast<Wide>(below), value);
      EXPECT_GT(static_cast<Wide>(std::nextafter(below, infinity)), value);
    }
  }
}

io::NetcdfAttribute attribute(const char* name, NetcdfType type,
                              const std::vector<std::int64_t>& integers) {
  io::NetcdfAttribute result{name, type, "", {}, integers};
  for (const std::int64_t bits : integers) {
    result.numbers.push_back(static_cast<double>(integer_of(bits, type)));
  }
  return result;
}

// The doubles of integers, or the message of the BadValue.
std::pair<std::vector<double>, std::string> doubles(
    NetcdfType type, const std::vector<io::NetcdfAttribute>& attributes,
    const std::vector<std::int64_t>& integers, bool may_round = false) {
  std::vector<double> out(integers.size());
  try {
    const io::NetcdfVariable variable{"ids", type, {}, attributes};
    if (may_round) {
      (void)io::round_to_doubles(variable, integers, out);
    } else {
      io::to_doubles(variable, integers, out);
    }
  } catch (const io::BadValue& error) {
    return {{}, error.what()};
  }
  return {out, ""};
}

constexpr std::int64_t odd = (std::int64_t{1} << 60) + 1;  // no double
constexpr double odd_rounded = 0x1p60;

TEST(wide_integers, that_are_no_doubles_are_refused_or_rounded) {
  for (const NetcdfType type : {NetcdfType::int64, NetcdfType::uint64}) {
    EXPECT_EQ(doubles(type, {}, {1, 1024, odd - 1}).first,
              (std::vector<double>{1, 1024, odd_rounded}));
    EXPECT_EQ(doubles(type, {}, {1, odd}).second,
              "variable \"ids\": 1152921504606846977 is no double");
    EXPECT_EQ(doubles(type, {}, {1, odd}, true).first, (std::vector<double>{1, odd_rounded}));
  }
  EXPECT_EQ(doubles(NetcdfType::int64, {}, {-odd}).second,
            "variable \"ids\": -1152921504606846977 is no double");
  EXPECT_EQ(doubles(NetcdfType::uint64, {}, {-odd}).second,
            "variable \"ids\": 17293822569102704639 is no double");
}

TEST(wide_integers, that_are_no_doubles_may_be_missing) {
  for (const NetcdfType type : {NetcdfType::int64, NetcdfType::uint64}) {
    const auto is_missing = [&](const std::vector<io::NetcdfAttribute>& attributes,
                                std::int64_t value = odd) {
      const auto [out, message] = doubles(type, attributes, {7, value});
      if (!message.empty()) return false;
      EXPECT_EQ(out[0], 7);
      return std::isnan(out[1]);
    };
    EXPECT_FALSE(is_missing({}));
    EXPECT_TRUE(is_missing({attribute("_FillValue", type, {odd})}));
    EXPECT_FALSE(is_missing({attribute("_FillValue", type, {odd + 1})}));
    EXPECT_TRUE(is_missing({attribute("missing_value", type, {3, odd})}));
    EXPECT_FALSE(is_missing({attribute("missing_value", type, {3, odd - 2})}));
    EXPECT_TRUE(is_missing({attribute("valid_min", type, {odd + 1})}));
    EXPECT_FALSE(is_missing({attribute("valid_min", type, {odd})}));
    EXPECT_TRUE(is_missing({attribute("valid_max", type, {odd - 1})}));
    EXPECT_FALSE(is_missing({attribute("valid_max", type, {odd})}));
    EXPECT_TRUE(is_missing({attribute("valid_range", type, {0, odd - 1})}));
    EXPECT_TRUE(is_missing({attribute("valid_range", type, {odd + 1, odd + 2})}));
    EXPECT_FALSE(is_missing({attribute("valid_range", type, {odd, odd})}));
    // Bounds are one number each, a range is two.
    EXPECT_FALSE(is_missing({attribute("valid_min", type, {odd + 1, odd + 1})}));
    EXPECT_FALSE(is_missing({attribute("valid_range", type, {odd + 1})}));
    // A fill of another type is a double.
    const NetcdfType other = NetcdfType::float64;
    EXPECT_TRUE(is_missing({{"_FillValue", other, "", {odd_rounded}, {}}}));
    EXPECT_FALSE(is_missing({{"_FillValue", other, "", {5}, {}}}));
  }
}

TEST(wide_integers, that_nobody_wrote_are_missing_unless_a_fill_is_named) {
  constexpr std::int64_t fill = std::numeric_limits<std::int64_t>::min() + 2;
  constexpr std::int64_t unsigned_fill = -2;  // 2^64 - 2
  EXPECT_TRUE(std::isnan(doubles(NetcdfType::int64, {}, {fill}).first.at(0)));
  EXPECT_TRUE(std::isnan(doubles(NetcdfType::uint64, {}, {unsigned_fill}).first.at(0)));
  for (const auto& [type, bits] :
       {std::pair{NetcdfType::int64, fill - 1}, std::pair{NetcdfType::int64, fill + 1},
        std::pair{NetcdfType::uint64, unsigned_fill - 1},
        std::pair{NetcdfType::uint64, unsigned_fill + 1}}) {
    EXPECT_NE(doubles(type, {}, {bits}).second, "");
  }
  EXPECT_NE(
      doubles(NetcdfType::int64, {attribute("_FillValue", NetcdfType::int64, {1})}, {fill}).second,
      "");
}

}  // namespace
}  // namespace rondel::test
