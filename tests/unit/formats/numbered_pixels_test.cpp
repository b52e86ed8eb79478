// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lists of pixels of HEALPix by the marks that files have, and messages for those that are unclear or
// wrong. Tests in Python regrid such files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel/conventions.h"
#include "rondel/error.h"

namespace rondel::test {
namespace {

using PixelTexts = std::vector<std::pair<std::string, std::string>>;

VariableHeader pixel_header(const std::string& name, const std::vector<std::string>& dimensions,
                            const PixelTexts& texts = {}) {
  return {name, true, dimensions, std::vector<std::uint64_t>(dimensions.size(), 4), texts};
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

// A file with a grid mapping "crs" of 12 pixels.
struct PixelFile {
  std::vector<VariableHeader> headers = {};
  std::vector<std::vector<double>> numbers = {};

  // Adds a variable; a list is one of integers, which are given.
  void add(VariableHeader variable, std::vector<double> its = {}) {
    variable.is_integer = !its.empty();
    if (!its.empty()) variable.shape = {its.size()};
    headers.push_back(std::move(variable));
    numbers.push_back(std::move(its));
  }
  // Returns the name of the list and its numbers, "none", or a message.
  [[nodiscard]] std::string list() const {
    const auto read = [&](std::size_t variable, std::uint64_t begin, std::span<double> out) {
      const auto first = numbers[variable].begin() + static_cast<std::ptrdiff_t>(begin);
      std::copy_n(first, out.size(), out.begin());
    };
    try {
      const auto found = numbered_pixels(headers, {"healpix:0:nested", 12, "crs", read});
      if (!found) return "none";
      std::string text = headers[found->variable].name;
      for (const Index number : found->numbers) text += " " + std::to_string(number);
      return text;
    } catch (const InvalidInput& error) {
      return error.what();
    }
  }
};

const std::vector<double> all_reversed = {11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
const std::vector<double> from_one = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

// Returns a file with a field of so many values along `d`, and a list.
std::string list_in(std::uint64_t size, const std::string& name, std::vector<double> numbers,
                    const PixelTexts& texts = {}, const std::string& dimension = "d") {
  PixelFile file;
  file.add(pixel_header("t", {"time", dimension}, {{"grid_mapping", "crs"}}));
  file.headers.back().shape = {3, size};
  VariableHeader list = pixel_header(name, {dimension});
  list.texts.assign(texts.begin(), texts.end());
  file.add(std::move(list), std::move(numbers));
  return file.list();
}

TEST(numbered_pixels, lists_of_pixels_are_known_by_what_says_so) {
  const std::string reversed = " 11 10 9 8 7 6 5 4 3 2 1 0";
  for (const char* const name :
       {"cell", "cells", "cell_ids", "ipix", "PixelIndex", "hpx_id", "nest_order", "d"}) {
    EXPECT_EQ(list_in(12, name, all_reversed), name + reversed);
    EXPECT_EQ(list_in(3, name, {7, 0, 3}), std::string(name) + " 7 0 3");
  }
  EXPECT_EQ(list_in(12, "any", all_reversed, {{"standard_name", "healpix_index"}}),
            "any" + reversed);
  // What has another meaning is no list.
  EXPECT_EQ(list_in(12, "cell", all_reversed, {{"units", "km"}}), "none");
  EXPECT_EQ(list_in(12, "cell", all_reversed, {{"standard_name", "region"}}), "none");
  EXPECT_EQ(list_in(12, "any", all_reversed, {{"flag_meanings", "a b"}}), "none");
  EXPECT_EQ(list_in(12, "ring_index", all_reversed), "none");
  EXPECT_EQ(list_in(12, "hp", std::vector<double>(12, 3)), "none");
}

TEST(numbered_pixels, lists_of_pixels_that_are_unclear_are_refused) {
  expect_part(list_in(12, "place", all_reversed),
              "'place' may have the numbers of the pixels of 'healpix:0:nested'");
  expect_part(list_in(4, "place", {5, 2, 8, 1}), "'place' may have the numbers");
  // These tell of no other order.
  std::vector<double> in_order(12);
  std::iota(in_order.begin(), in_order.end(), 0);
  EXPECT_EQ(list_in(12, "place", in_order), "none");
  EXPECT_EQ(list_in(12, "cell", in_order), "cell");
  EXPECT_EQ(list_in(12, "place", from_one), "none");
  EXPECT_EQ(list_in(12, "d", from_one), "none");
  EXPECT_EQ(list_in(12, "cell", {4, 4, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1}), "none") << "a field";
  PixelFile two;
  two.add(pixel_header("t", {"d"}, {{"grid_mapping", "crs"}}));
  two.headers.back().shape = {3};
  two.add(pixel_header("cell", {"d"}), {1, 2, 3});
  two.add(pixel_header("ipix", {"d"}), {1, 2, 4});
  expect_part(two.list(), "'cell' and 'ipix' have different numbers");
  // Levels count along another dimension than pixels.
  PixelFile levels;
  levels.add(pixel_header("t", {"lev", "d"}, {{"grid_mapping", "crs"}}));
  levels.headers.back().shape = {3, 5};
  levels.add(pixel_header("lev", {"lev"}), {0, 1, 2});
  EXPECT_EQ(levels.list(), "none");
}

TEST(numbered_pixels, lists_of_pixels_that_are_wrong_are_refused_with_the_number) {
  EXPECT_EQ(list_in(3, "cell", {5, 5, 6}, {}, "cell"),
            "variable 'cell' has the number 5 of a pixel twice");
  EXPECT_EQ(list_in(3, "d", {5, 12, 6}),
            "variable 'd' has the number 12, which is not one of the 12 pixels of "
            "'healpix:0:nested'");
  expect_part(list_in(12, "cell", {12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1}),
              "has the number 12, which is not one");
  expect_part(list_in(2, "any", {1, 1}, {{"standard_name", "healpix_index"}}),
              "the number 1 of a pixel twice");
}

}  // namespace
}  // namespace rondel::test
