// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers that another reader has unpacked, in double or in single precision, are missing where
// the packed ones of the file are.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "formats/cf_values.h"
#include "rondel/conventions.h"

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

}  // namespace
}  // namespace rondel::test
