// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers that another reader has unpacked, in double or in single precision, are missing where
// the packed ones of the file are. Integers of 64 bits are compared exactly.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "formats/cf_values.h"
#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel::test {
namespace {

struct PackedCase {
  io::NetcdfType type;
  const char* name;  // what NumPy calls the type
  double fill;       // what netCDF writes where nobody wrote
};

constexpr PackedCase packed_cases[] = {
    {io::NetcdfType::int16, "i2", -32767},        {io::NetcdfType::uint16, "u2", 65535},
    {io::NetcdfType::int32, "i4", -2147483647.0}, {io::NetcdfType::uint32, "u4", 4294967295.0},
    {io::NetcdfType::float32, "f4", 0x1.ep+122},  {io::NetcdfType::float64, "f8", 0x1.ep+122},
};

ValueAttribute in_doubles(const std::string& name, const std::vector<double>& numbers) {
  return {name, "f8", "", numbers};
}

// Unpacks in single precision, as xarray does.
double single(double raw, double scale, double offset) {
  const float product = static_cast<float>(raw) * static_cast<float>(scale);
  return static_cast<double>(product + static_cast<float>(offset));
}

TEST(unpacked_numbers, what_nobody_wrote_is_missing_in_either_precision) {
  for (const auto& [type, name, fill] : packed_cases) {
    for (const double scale : {0.1, -0.5, 0.01, 3.0}) {
      for (const double offset : {0.0, 273.15, -5.0}) {
        const double factor = static_cast<double>(static_cast<float>(scale));
        const std::vector<ValueAttribute> attributes = {in_doubles("scale_factor", {factor}),
                                                        in_doubles("add_offset", {offset})};
        std::vector<double> values = {fill * factor + offset, single(fill, factor, offset),
                                      100 * factor + offset, single(100, factor, offset)};
        mark_missing(values, name, attributes);
        EXPECT_TRUE(std::isnan(values[0])) << name << ' ' << scale << ' ' << offset;
        EXPECT_TRUE(std::isnan(values[1])) << name << ' ' << scale << ' ' << offset;
        EXPECT_FALSE(std::isnan(values[2])) << name << ' ' << scale << ' ' << offset;
        EXPECT_FALSE(std::isnan(values[3])) << name << ' ' << scale << ' ' << offset;
      }
    }
  }
}

// The file's own rules decide, also where a bound is a number of the unpacked ones.
TEST(unpacked_numbers, bounds_are_those_of_the_file) {
  const std::vector<std::vector<double>> ranges = {{1, 2}, {0.5, 1.01}, {99, 101}, {100, 100}};
  for (const std::vector<double>& range : ranges) {
    for (const char* bound_type : {"i2", "f4"}) {
      for (const double scale : {0.01, -0.01, 0.1}) {
        const double factor = static_cast<double>(static_cast<float>(scale));
        const auto of_file = [](const std::string& type) {
          return type == "i2" ? io::NetcdfType::int16 : io::NetcdfType::float32;
        };
        const io::NetcdfVariable variable{
            "values",
            io::NetcdfType::int16,
            {},
            {{"valid_range", of_file(bound_type), "", range},
             {"scale_factor", io::NetcdfType::float32, "", {factor}}}};
        const std::vector<ValueAttribute> attributes = {{"valid_range", bound_type, "", range},
                                                        {"scale_factor", "f4", "", {factor}}};
        std::vector<double> right;
        std::vector<double> doubles;
        std::vector<double> singles;
        for (double raw = -300; raw <= 300; ++raw) {
          right.push_back(raw);
          doubles.push_back(raw * factor);
          singles.push_back(single(raw, factor, 0));
        }
        formats::ValueRules(variable).apply(right);
        mark_missing(doubles, "i2", attributes);
        mark_missing(singles, "i2", attributes);
        for (std::size_t i = 0; i < right.size(); ++i) {
          EXPECT_EQ(std::isnan(doubles[i]), std::isnan(right[i])) << bound_type << ' ' << i;
          EXPECT_EQ(std::isnan(singles[i]), std::isnan(right[i])) << bound_type << ' ' << i;
        }
      }
    }
  }
}

// Sums and means are no unpacked integers; bounds count for them, and no fill is near.
TEST(unpacked_numbers, numbers_between_integers_have_bounds) {
  const std::vector<ValueAttribute> attributes = {in_doubles("scale_factor", {2}),
                                                  {"valid_range", "i2", "", {-10, 10}},
                                                  {"_FillValue", "i2", "", {5}}};
  std::vector<double> values = {20.6, 20, 19, 10, 10.4, 11, -20.6, -19};
  mark_missing(values, "i2", attributes);
  const bool missing[] = {true, false, false, true, true, false, true, false};
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(std::isnan(values[i]), missing[i]) << i;
}

// Unpacking rounds, but a number that is a bound in the file is within it.
TEST(unpacked_numbers, bounds_themselves_are_not_missing) {
  const double scale = 0.01;
  const double offset = 273.15;
  for (int i = -50; i <= 50; ++i) {
    const double low = i * 0.7;
    const double high = low + 3;
    const std::vector<ValueAttribute> attributes = {in_doubles("scale_factor", {scale}),
                                                    in_doubles("add_offset", {offset}),
                                                    in_doubles("valid_range", {low, high})};
    std::vector<double> values;
    for (const double raw : {low, high, low - 0.5, high + 0.5}) {
      values.push_back(raw * scale + offset);
    }
    mark_missing(values, "f8", attributes);
    const bool missing[] = {false, false, true, true};
    for (std::size_t k = 0; k < values.size(); ++k) {
      EXPECT_EQ(std::isnan(values[k]), missing[k]) << low << ' ' << k;
    }
  }
}

// What unpack_integers() should say of an integer, by the rules of read_fields() in long doubles, of
// which those of most machines hold all integers of 64 bits.
struct WideOracle {
  std::string type;
  std::vector<ValueAttribute> attributes;

  static long double exact(const ValueAttribute& attribute, std::size_t i) {
    if (attribute.integers.empty()) return static_cast<long double>(attribute.numbers[i]);
    const std::int64_t bits = attribute.integers[i];
    return attribute.type == "u8" ? static_cast<long double>(static_cast<std::uint64_t>(bits))
                                  : static_cast<long double>(bits);
  }
  [[nodiscard]] bool is_missing(std::int64_t bits) const {
    const bool is_unsigned = type == "u8";
    const auto value = is_unsigned ? static_cast<long double>(static_cast<std::uint64_t>(bits))
                                   : static_cast<long double>(bits);
    const long double fill = is_unsigned ? 0x1p64L - 2 : 2 - 0x1p63L;
    bool has_fill = false;
    bool is_gone = false;
    for (const ValueAttribute& attribute : attributes) {
      const std::string& name = attribute.name;
      has_fill = has_fill || name == "_FillValue";
      for (std::size_t i = 0; i < attribute.numbers.size(); ++i) {
        const long double number = exact(attribute, i);
        // Doubles and floats are less precise: what rounds to one of them is it.
        const bool is_one = attribute.integers.empty()
                                ? static_cast<double>(value) == attribute.numbers[i]
                                : value == number;
        const bool is_low = name == "valid_min" || (name == "valid_range" && i == 0);
        const bool is_fill = name == "_FillValue" || name == "missing_value";
        is_gone = is_gone || (is_fill ? is_one : is_low ? value < number : value > number);
      }
    }
    return is_gone || (!has_fill && value == fill);
  }
};

std::int64_t some_integer(std::mt19937_64& random) {
  const int shift = static_cast<int>(random() % 13) + 50;
  const std::int64_t near = static_cast<std::int64_t>(random() % 5) - 2;
  const auto large = static_cast<std::int64_t>(std::uint64_t{1} << static_cast<unsigned>(shift));
  switch (random() % 6) {
    case 0:
      return near;
    case 1:
      return -large + near;
    case 2:
      return std::numeric_limits<std::int64_t>::min() + 2 + near;
    default:
      return large + near;
  }
}

ValueAttribute some_attribute(std::mt19937_64& random, const std::string& name) {
  static const std::string types[] = {"i8", "u8", "f8"};
  ValueAttribute attribute{name, types[random() % 3], "", {}};
  for (int k = name == "valid_range" ? 2 : 1; k > 0; --k) {
    const std::int64_t bits = some_integer(random);
    if (attribute.type == "f8") {
      attribute.numbers.push_back(static_cast<double>(bits));
      continue;
    }
    attribute.integers.push_back(bits);
    attribute.numbers.push_back(attribute.type == "u8"
                                    ? static_cast<double>(static_cast<std::uint64_t>(bits))
                                    : static_cast<double>(bits));
  }
  return attribute;
}

TEST(unpacked_numbers, integers_of_64_bits_are_compared_exactly) {
  if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP();
  std::mt19937_64 random(1);
  std::size_t num_missing = 0;
  std::size_t num_refused = 0;
  for (int round = 0; round < 20000; ++round) {
    WideOracle oracle{round % 2 == 0 ? "i8" : "u8", {}};
    for (const char* name : {"_FillValue", "missing_value", "valid_min", "valid_max"}) {
      if (random() % 2 == 0) oracle.attributes.push_back(some_attribute(random, name));
    }
    // Beside valid_min or valid_max it does not count for doubles.
    if (oracle.attributes.empty()) {
      oracle.attributes.push_back(some_attribute(random, "valid_range"));
    }
    const std::int64_t bits = some_integer(random);
    const double rounded = oracle.type == "u8"
                               ? static_cast<double>(static_cast<std::uint64_t>(bits))
                               : static_cast<double>(bits);
    const bool is_missing = oracle.is_missing(bits);
    num_missing += is_missing ? 1 : 0;
    try {
      const double found = unpack_integers({&bits, 1}, oracle.type, oracle.attributes).front();
      EXPECT_EQ(std::isnan(found), is_missing) << bits << ' ' << round;
      EXPECT_EQ(is_missing ? rounded : found, rounded) << bits;
    } catch (const InvalidInput& error) {
      ++num_refused;
      EXPECT_FALSE(is_missing) << bits << ' ' << round << error.what();
      const std::string digits = oracle.type == "u8"
                                     ? std::to_string(static_cast<std::uint64_t>(bits))
                                     : std::to_string(bits);
      EXPECT_EQ(error.what(), "has the integer " + digits + ", which is no double");
    }
  }
  EXPECT_GT(num_missing, 5000U);
  EXPECT_GT(num_refused, 500U);
}

}  // namespace
}  // namespace rondel::test
