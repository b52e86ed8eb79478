// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whole figures, as bytes, and their colors.
#include <gtest/gtest.h>

#include <string>

#include "plot_color.h"
#include "plot_draw.h"

namespace rondel::cli {
namespace {

Figure small_figure() {
  Figure figure;
  figure.style.size = 64;
  figure.view = View({10, 30});
  figure.sites = {{0, 0, 1}, normalized({1, 0, 1}), {1, 0, 0}, {0, 0, -1}};
  figure.triangulation = {figure.sites, {{0, 1}, {1, 2}, {2, 3}}};
  figure.spacing = 0.5;
  return figure;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++result;
  return result;
}

TEST(draw, gives_each_format_its_signature) {
  EXPECT_EQ(draw(small_figure(), FigureFormat::png).substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(draw(small_figure(), FigureFormat::pdf).substr(0, 5), "%PDF-");
  EXPECT_EQ(draw(small_figure(), FigureFormat::svg).substr(0, 5), "<?xml");
}

TEST(draw, gives_the_same_bytes_again_and_no_date) {
  for (const FigureFormat format : {FigureFormat::png, FigureFormat::svg, FigureFormat::pdf}) {
    const std::string bytes = draw(small_figure(), format);
    EXPECT_EQ(bytes, draw(small_figure(), format));
    EXPECT_EQ(bytes.find("Date"), std::string::npos);
  }
}

TEST(draw, shows_the_arcs_behind_only_when_told) {
  Figure figure = small_figure();
  figure.triangulation.arcs = {{2, 3}};
  const std::size_t before = count(draw(figure, FigureFormat::svg), "<path");
  figure.style.show_back = true;
  EXPECT_EQ(count(draw(figure, FigureFormat::svg), "<path"), before + 1);
}

TEST(draw, an_empty_figure_is_the_bare_globe) {
  Figure figure;
  figure.style.graticule_deg = 0;
  // The disc and its outline, which Cairo may join.
  EXPECT_LE(count(draw(figure, FigureFormat::svg), "<path"), 2U);
}

TEST(area_color, gets_lighter_with_the_area) {
  double before = -1;
  for (int i = 0; i <= 50; ++i) {
    const Color color = area_color(i / 50.0);
    const double lightness = 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
    EXPECT_GT(lightness, before);
    before = lightness;
  }
}

TEST(blend, starts_and_ends_with_its_colors) {
  const Color a{0.2, 0.4, 0.9}, b{0.8, 0.1, 0.05, 0.5};
  EXPECT_NEAR(blend(a, b, 0).blue, a.blue, 1e-6);
  EXPECT_NEAR(blend(a, b, 1).red, b.red, 1e-6);
  EXPECT_NEAR(blend(a, b, 1).green, b.green, 1e-6);
  EXPECT_DOUBLE_EQ(blend(a, b, 0.5).alpha, 0.75);
}

}  // namespace
}  // namespace rondel::cli
