// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/number.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "io/csv_records.h"
#include "support/thrown.h"

namespace rondel::io {
namespace {

TEST(number, json_accepts_just_its_grammar) {
  for (const char* const text :
       {"0", "-0", "7", "-12.50", "0.5", "1e5", "1E+05", "2.5e-300", "12345678901234567890"}) {
    EXPECT_TRUE(is_json_number(text)) << text;
  }
  for (const char* const text : {"", "-", "+1", "01", "-01", ".5", "5.", "1e", "1e+", "0x1", "NaN",
                                 "Infinity", " 1", "1 ", "1,5", "--1", "1.e5"}) {
    EXPECT_FALSE(is_json_number(text)) << text;
  }
}

TEST(number, accepts_blanks_and_a_plus) {
  EXPECT_EQ(parse_number(" \t+2.5e1 ", "x"), 25);
  EXPECT_EQ(parse_number("-.5", "x"), -0.5);
  for (const char* const text : {"+", "++1", "+-1", "1 2", "1e", "nan(1)", "-"}) {
    EXPECT_THROW(parse_number(text, "x"), BadValue) << text;
  }
}

TEST(number, digits_round_trip) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!(value - value == 0)) continue;  // not finite
    std::string text;
    append_number(text, value);
    EXPECT_LE(text.size(), 24U);
    EXPECT_TRUE(is_json_number(text)) << text;
    EXPECT_EQ(parse_number(text, "x"), value);
  }
}

// What write_number() writes, and what std::to_chars does.
void expect_usual_text(double value) {
  std::array<char, number_room> usual{};
  char* const end = std::to_chars(usual.data(), usual.data() + usual.size(), value).ptr;
  std::string text;
  append_number(text, value);
  EXPECT_EQ(text, std::string(usual.data(), end));
}

TEST(number, text_is_that_of_the_standard_library) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 300000; ++i) expect_usual_text(std::bit_cast<double>(random()));
  // All exponents that have a way of their own, and those around them.
  for (int exponent = -40; exponent <= 40; ++exponent) {
    for (int i = 0; i < 20000; ++i) {
      const double value =
          std::ldexp(1 + std::ldexp(static_cast<double>(random() >> 12U), -52), exponent);
      expect_usual_text(i % 2 == 0 ? value : -value);
    }
    const double power = std::ldexp(1, exponent);
    for (const double value : {power, std::nextafter(power, 0.0), std::nextafter(power, 1e300)}) {
      expect_usual_text(value);
    }
  }
  for (const double value : {0.0, -0.0, 1e300, 5e-324, std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
    expect_usual_text(value);
  }
}

// With and without an exponent, and the doubles next to a short decimal.
TEST(number, text_of_few_digits_is_that_of_the_standard_library) {
  for (int exponent = -12; exponent <= 12; ++exponent) {
    const double scale = std::pow(10, std::abs(exponent));
    for (int digits = 1; digits < 3000; ++digits) {
      const double value = exponent < 0 ? digits / scale : digits * scale;
      for (const double next : {value, std::nextafter(value, 0.0), std::nextafter(value, 1e300)}) {
        expect_usual_text(next);
      }
    }
  }
}

// Numbers of few bits lie in the middle between two decimals of as many digits as they need.
TEST(number, text_of_a_tie_is_that_of_the_standard_library) {
  std::mt19937_64 random(6);
  for (int bits = 1; bits <= 40; ++bits) {
    for (int i = 0; i < 20000; ++i) {
      expect_usual_text(std::ldexp(static_cast<double>((random() >> 39U) | 1U), -bits));
    }
  }
}

// What is said of a text that is no number.
std::string refusal_of_number(std::string_view text) {
  return test::thrown_message<BadValue>([&] { parse_number(text, "x"); });
}

TEST(number, says_why_a_text_is_none) {
  EXPECT_EQ(refusal_of_number(" "), "x is empty");
  EXPECT_EQ(refusal_of_number("12,5"), "x \"12,5\" is not a number: its decimal point is a comma");
  EXPECT_EQ(refusal_of_number("-1,25"),
            "x \"-1,25\" is not a number: its decimal point is a comma");
  for (const char* const text : {"12,", ",5", "12,x5", "12,5x", "1x,5", "12,5,6", "a"}) {
    EXPECT_EQ(refusal_of_number(text), "x \"" + std::string(text) + "\" is not a number");
  }
  EXPECT_EQ(refusal_of_number("1e400"), "x \"1e400\" is beyond the largest number");
  EXPECT_EQ(refusal_of_number("-inf"), "x \"-inf\" is not finite");
  EXPECT_EQ(refusal_of_number("+nan"), "x \"+nan\" is not finite");
  EXPECT_EQ(refusal_of_number("1e-400"), "");
  EXPECT_EQ(parse_number("+5", "x"), 5);
}

TEST(number, integers_have_all_bits) {
  EXPECT_EQ(parse_integer(" -9223372036854775808\t", "n"),
            std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parse_integer("9223372036854775807", "n"), std::numeric_limits<std::int64_t>::max());
  for (const char* const text : {"", "9223372036854775808", "1.0", "1 2", "x", "+1"}) {
    EXPECT_THROW((void)parse_integer(text, "n"), BadValue) << text;
  }
  std::string text = "-";
  append_integer(text, 0);
  append_integer(text, ~std::uint64_t{0});
  EXPECT_EQ(text, "-018446744073709551615");
}

TEST(number, indices_are_of_32_bits) {
  EXPECT_EQ(checked_index(std::int64_t{0}), 0U);
  EXPECT_EQ(checked_index(std::uint64_t{4294967295}), 4294967295U);
  EXPECT_THROW((void)checked_index(std::uint64_t{4294967296}), BadValue);
  EXPECT_THROW((void)checked_index(std::int64_t{-1}), BadValue);
  EXPECT_EQ(checked_index(std::int32_t{2147483647}), 2147483647U);
}

TEST(number, positions_are_on_the_sphere) {
  EXPECT_EQ(checked_position(7, 90, false), (LonLat{7, 90}));
  EXPECT_EQ(checked_position(-700, -90, false), (LonLat{-700, -90}));
  const double beyond = std::nextafter(90.0, 100.0);
  EXPECT_THROW(checked_position(0, beyond, false), BadValue);
  EXPECT_THROW(checked_position(0, -beyond, false), BadValue);
  constexpr double half = std::numbers::pi / 2;
  EXPECT_EQ(checked_position(half, half, true), (LonLat{90, 90}));
  EXPECT_EQ(checked_position(-half, -half, true), (LonLat{-90, -90}));
  EXPECT_EQ(checked_position(0, half + 8e-16, true).lat_deg, 90);
  EXPECT_EQ(checked_position(0, -half - 8e-16, true).lat_deg, -90);
  EXPECT_THROW(checked_position(0, half + 2e-15, true), BadValue);
  EXPECT_THROW(checked_position(0, -half - 2e-15, true), BadValue);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const bool is_radians : {false, true}) {
    EXPECT_THROW(checked_position(infinite, 0, is_radians), BadValue);
    EXPECT_THROW(checked_position(0, -infinite, is_radians), BadValue);
  }
  EXPECT_EQ(checked_radius(0, false), 0);
  EXPECT_EQ(checked_radius(std::nextafter(90.0, 0.0), false), std::nextafter(90.0, 0.0));
  EXPECT_EQ(checked_radius(half / 2, true), 45);
  for (const double bad : {90.0, -1e-300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)checked_radius(bad, false), BadValue);
  }
  EXPECT_THROW((void)checked_radius(half, true), BadValue);
  EXPECT_EQ(checked_point({1, -2, 3}), (Point{1, -2, 3}));
  EXPECT_THROW((void)checked_point({infinite, 0, 0}), BadValue);
  EXPECT_THROW((void)checked_point({0, infinite, 0}), BadValue);
  EXPECT_THROW((void)checked_point({0, 0, -infinite}), BadValue);
}

TEST(number, lines_are_cut_between_letters) {
  EXPECT_EQ(one_line("abcd", 4), "abcd");
  EXPECT_EQ(one_line("abcd", 3), "abc...");
  EXPECT_EQ(one_line("a\xC3\xA9z", 3), "a...");
  EXPECT_EQ(one_line("a\xC3\xA9z", 2), "a...");
  EXPECT_EQ(one_line("a\xE2\x82\xAC", 3), "a...");
  EXPECT_EQ(one_line("a\xE2\x82\xAC", 4), "a\xE2\x82\xAC");
  EXPECT_EQ(one_line("\x1F \x7F~", 9), "? ?~");
  EXPECT_EQ(trim("\t a b \t"), "a b");
  EXPECT_EQ(trim(" \t"), "");
}

TEST(number, degrees_of_a_longitude_in_radians_are_finite) {
  EXPECT_GT(checked_position(1e306, 0, true).lon_deg, 5e307);
  EXPECT_THROW(checked_position(1e308, 0, true), BadValue);
}

TEST(number, quotes_stay_on_one_line) {
  EXPECT_EQ(in_quotes("a\nb\x7F"), "\"a?b?\"");
  EXPECT_EQ(in_quotes(std::string(61, 'x')), '"' + std::string(60, 'x') + "...\"");
}

TEST(number, quotes_are_utf_8) {
  EXPECT_EQ(in_quotes("\xC3\xA9 \xED\x9F\xBF \xF4\x8F\xBF\xBF"),
            "\"\xC3\xA9 \xED\x9F\xBF \xF4\x8F\xBF\xBF\"");
  // An overlong form, a surrogate, beyond U+10FFFF, a lone continuation, a sequence cut off.
  for (const char* const text :
       {"\xC0\xAF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\x80", "a\xC3"}) {
    EXPECT_EQ(in_quotes(text).find_first_not_of("\"?a"), std::string::npos) << text;
  }
}

using Records = std::vector<std::vector<std::string>>;

Records records_of(std::string_view text) {
  Records result;
  CsvRecords records(text, ',');
  while (records.next()) result.emplace_back(records.fields().begin(), records.fields().end());
  return result;
}

TEST(csv_records, split_as_rfc_4180_says) {
  EXPECT_EQ(records_of(""), Records{});
  EXPECT_EQ(records_of("\n\r\n"), Records{});
  EXPECT_EQ(records_of("a,b"), (Records{{"a", "b"}}));
  EXPECT_EQ(records_of("a,\r\n,b\r\n"), (Records{{"a", ""}, {"", "b"}}));
  EXPECT_EQ(records_of("a\r"), (Records{{"a"}}));
  EXPECT_THROW(records_of("a\rb\n"), BadValue);
  EXPECT_EQ(records_of("a\r\r\n\"b\rc\"\r\n"), (Records{{"a"}, {"b\rc"}}));
  EXPECT_EQ(records_of("\"\",\"a,\"\"\r\n\"\"\"\r\nc,\" d\""),
            (Records{{"", "a,\"\r\n\""}, {"c", " d"}}));
  EXPECT_EQ(records_of("a\"b, \"c\"\n"), (Records{{"a\"b", " \"c\""}}));
  EXPECT_EQ(records_of("a,"), (Records{{"a", ""}}));
  EXPECT_EQ(records_of("\"a\"\r"), (Records{{"a"}}));
}

TEST(csv_records, count_lines_inside_quotes) {
  CsvRecords records("a\n\n\"b\n\nc\"\"\n\",x\n\"d\"\n", ',');
  std::vector<std::uint64_t> lines;
  while (records.next()) lines.push_back(records.line());
  EXPECT_EQ(lines, (std::vector<std::uint64_t>{1, 3, 7}));
}

}  // namespace
}  // namespace rondel::io
