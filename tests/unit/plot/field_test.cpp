// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Colors of values, pixel by pixel, and the bar.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plot_color.h"
#include "plot_draw.h"
#include "plot_field.h"

namespace rondel::cli {
namespace {

constexpr int picture_side = 64;

// An octahedron; the value is x, which is linear in no face but at its corners.
ValueField octahedron() {
  ValueField field;
  field.sites = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  field.values = {1, -1, 0, 0, 0, 0};
  field.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return field;
}

std::vector<std::uint32_t> painted(const ValueField& field, int first_row = 0,
                                   int past_row = picture_side) {
  std::vector<std::uint32_t> argb(static_cast<std::size_t>(past_row - first_row) * picture_side, 0);
  paint_field(field, scale_of(field.values, "x"), picture_side, 30, first_row, past_row, argb);
  return argb;
}

double distance(std::uint32_t argb, const Color& color) {
  const auto part = [&](unsigned shift) { return ((argb >> shift) & 0xffU) / 255.0; };
  return std::hypot(part(16) - color.red, part(8) - color.green, part(0) - color.blue);
}

// In the face of the corners 0, 2 and 4 the value of a direction (x, y, z) is x / (x + y + z).
TEST(paint_field, gives_each_pixel_the_color_of_its_value) {
  const std::vector<std::uint32_t> argb = painted(octahedron());
  for (int row = 0; row < picture_side; ++row) {
    for (int column = 0; column < picture_side; ++column) {
      const double x = (column + 0.5 - picture_side / 2.0) / 30;
      const double y = (picture_side / 2.0 - row - 0.5) / 30;
      const std::uint32_t pixel = argb[static_cast<std::size_t>(row * picture_side + column)];
      if (x * x + y * y > 1.1) {
        EXPECT_EQ(pixel, 0U);
      } else if (x * x + y * y < 0.98) {
        const double z = std::sqrt(1 - x * x - y * y);
        const double value = x / (std::abs(x) + std::abs(y) + z);
        EXPECT_EQ(pixel >> 24U, 255U);
        EXPECT_LT(distance(pixel, value_color((value + 1) / 2)), 0.01) << row << ' ' << column;
      }
    }
  }
}

TEST(paint_field, gives_the_same_rows_in_parts) {
  const std::vector<std::uint32_t> whole = painted(octahedron());
  std::vector<std::uint32_t> parts;
  for (const int row : {0, 7, 40}) {
    const std::vector<std::uint32_t> part = painted(octahedron(), row,
                                                    row == 0   ? 7
                                                    : row == 7 ? 40
                                                               : picture_side);
    parts.insert(parts.end(), part.begin(), part.end());
  }
  EXPECT_EQ(parts, whole);
}

TEST(paint_field, leaves_out_what_has_no_face) {
  ValueField field = octahedron();
  field.faces.erase(field.faces.begin());
  const std::vector<std::uint32_t> argb = painted(field);
  EXPECT_EQ(argb[static_cast<std::size_t>(20 * picture_side + 44)], 0U);
  EXPECT_NE(argb[static_cast<std::size_t>(44 * picture_side + 44)], 0U);
}

TEST(value_color, is_lighter_for_larger_values) {
  double last = 0;
  for (int i = 0; i <= 100; ++i) {
    const Color color = value_color(i / 100.0);
    const double light = 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
    EXPECT_GT(light, last);
    last = light;
  }
  // Ends and middle of the table, within 0.02.
  const auto expect_near = [](const Color& color, double red, double green, double blue) {
    EXPECT_NEAR(color.red, red, 0.02);
    EXPECT_NEAR(color.green, green, 0.02);
    EXPECT_NEAR(color.blue, blue, 0.02);
  };
  expect_near(value_color(-1), 0.267, 0.005, 0.329);
  expect_near(value_color(0.5), 0.128, 0.567, 0.551);
  expect_near(value_color(2), 0.993, 0.906, 0.144);
}

TEST(round_values, are_about_five_in_the_range) {
  EXPECT_EQ(round_values(-3, 2), (std::vector<double>{-3, -2, -1, 0, 1, 2}));
  EXPECT_EQ(round_values(0, 1), (std::vector<double>{0, 0.2, 0.4, 0.2 * 3, 0.8, 1}));
  EXPECT_EQ(round_values(12, 480), (std::vector<double>{100, 200, 300, 400}));
  EXPECT_TRUE(round_values(3, 3).empty());
  EXPECT_EQ(round_values(-1e308, 1.7e308),
            (std::vector<double>{-1e308, -5e307, 0, 5e307, 1e308, 1.5e308}));
  for (const double scale : {1e-300, 1e-5, 1e17, 1e300}) {
    const std::vector<double> marks = round_values(0.7 * scale, 7.9 * scale);
    EXPECT_GE(marks.size(), 3U);
    EXPECT_LE(marks.size(), 8U);
  }
}

// A range that is no double: the colors are those of the same values, scaled down.
TEST(paint_field, takes_values_whose_range_exceeds_the_doubles) {
  const ValueField small = octahedron();
  ValueField large = small;
  for (double& value : large.values) value *= 0x1.8p1023;
  EXPECT_EQ(painted(large), painted(small));
  const ValueScale scale = scale_of(large.values, "x");
  for (const double x : {-1.0, -0.5, 0.0, 0.75, 1.0}) {
    EXPECT_EQ(scale.place(x * 0x1.8p1023), (x + 1) / 2);
    const Color color = scale.color(x * 0x1.8p1023);
    const Color expected = value_color((x + 1) / 2);
    EXPECT_EQ(color.red, expected.red);
    EXPECT_EQ(color.blue, expected.blue);
  }
}

TEST(texts_within, tell_numbers_of_a_small_range_apart) {
  const auto texts = [](std::vector<double> values, double range, int digits) {
    return texts_within(values, range, digits);
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts({0, 12.3456}, 12, 4), (Texts{"0", "12.35"}));
  EXPECT_EQ(texts({98765.25, 98765.75}, 0.5, 4), (Texts{"98765.25", "98765.75"}));
  EXPECT_EQ(texts({-2e6, -2e6 + 3}, 3, 4), (Texts{"-2000000", "-1999997"}));
  EXPECT_EQ(texts({1.0 / 3, 1.0 / 3}, 0, 4), (Texts{"0.3333", "0.3333"}));
}

TEST(scale_of, is_that_of_numbers) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scale_of(std::vector<double>{none, 3, -1, none}, "t").least, -1);
  EXPECT_EQ(scale_of(std::vector<double>{none, 3, -1, none}, "t").most, 3);
  EXPECT_EQ(scale_of(std::vector<double>{none}, "t").most, 0);
}

TEST(draw, has_a_bar_below_where_there_are_values) {
  Figure figure;
  figure.style.size = 100;
  const auto is_higher = [&] {
    const std::string svg = draw(figure, FigureFormat::svg);
    return svg.find("height=\"113") != std::string::npos;
  };
  EXPECT_FALSE(is_higher());
  figure.field = octahedron();
  figure.scale = scale_of(figure.field->values, "x");
  EXPECT_TRUE(is_higher());
  for (const FigureFormat format : {FigureFormat::png, FigureFormat::svg, FigureFormat::pdf}) {
    EXPECT_EQ(draw(figure, format, false, 1), draw(figure, format, false, 3));
  }
}

}  // namespace
}  // namespace rondel::cli
