// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pixels, beside points counted one by one, and beside what Cairo draws.
#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "plot_draw.h"
#include "plot_pixels.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "run_pieces.h"
#include "support/generators.h"

namespace rondel::cli {
namespace {

constexpr Color black{0, 0, 0};

std::vector<std::uint32_t> rows_of(const Pixels& pixels, int size) {
  std::vector<std::uint32_t> all;
  std::vector<std::uint32_t> row(static_cast<std::size_t>(size));
  for (int y = pixels.first_row(); y < pixels.past_row(); ++y) {
    pixels.copy_row(y, row);
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

// Whether a convex polygon has the place inside.
bool has_inside(std::span<const Spot> polygon, const Spot& place) {
  int left = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Spot& p = polygon[i];
    const Spot& q = polygon[(i + 1) % polygon.size()];
    const double side = (q.x - p.x) * (place.y - p.y) - (q.y - p.y) * (place.x - p.x);
    left += side > 0 ? 1 : 0;
  }
  return left == 0 || left == static_cast<int>(polygon.size());
}

// A convex polygon with its corners on an ellipse in any position.
std::vector<Spot> random_polygon(std::mt19937& random, double size) {
  const auto unit = [&] { return std::uniform_real_distribution<>(0, 1)(random); };
  const Spot center{2 + (size - 4) * unit(), 2 + (size - 4) * unit()};
  const double wide = 2 * unit(), high = 2 * unit() * unit(), turn = 3 * unit();
  const int corners = 3 + static_cast<int>(6 * unit());
  std::vector<Spot> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double x = wide * std::cos(angle), y = high * std::sin(angle);
    polygon.push_back({center.x + std::cos(turn) * x - std::sin(turn) * y,
                       center.y + std::sin(turn) * x + std::cos(turn) * y});
  }
  if (unit() < 0.5) std::ranges::reverse(polygon);
  return polygon;
}

TEST(pixels, have_the_share_that_a_shape_covers) {
  constexpr int size = 9;
  constexpr int samples = 64;  // in each direction of a pixel
  std::mt19937 random(1);
  for (std::size_t turn = 0; turn < test::scaled(100); ++turn) {
    const std::vector<Spot> polygon = random_polygon(random, size);
    Pixels pixels(size, 0, size);
    pixels.fill(polygon, black);
    const auto found = rows_of(pixels, size);
    for (int i = 0; i < size * size; ++i) {
      int inside = 0;
      for (int k = 0; k < samples * samples; ++k) {
        const int column = i % size;
        const int row = i / size;
        const int column_of_sample = k % samples;
        const int row_of_sample = k / samples;
        const Spot place{column + (column_of_sample + 0.5) / samples,
                         row + (row_of_sample + 0.5) / samples};
        inside += has_inside(polygon, place) ? 1 : 0;
      }
      const double share = inside / static_cast<double>(samples * samples);
      // An edge passes at most 2 samples of a row of samples, and half a step of 255.
      EXPECT_NEAR((found[static_cast<std::size_t>(i)] >> 24U) / 255.0, share, 0.02) << turn;
    }
  }
}

TEST(pixels, are_painted_over_each_other) {
  Pixels pixels(3, 0, 3);
  const std::vector<Spot> half{{1, 1}, {1.5, 1}, {1.5, 2}, {1, 2}};
  pixels.fill(half, {1, 0, 0});
  EXPECT_EQ(rows_of(pixels, 3)[4], 0x80800000U);
  pixels.fill(half, {0, 0, 1, 0.5});  // a quarter of the pixel
  EXPECT_EQ(rows_of(pixels, 3)[4], 0x9F600040U);
  EXPECT_EQ(rows_of(pixels, 3)[3], 0U);
}

TEST(pixels, do_not_depend_on_the_rows_that_are_made) {
  constexpr int size = 30;
  std::mt19937 random(2);
  std::vector<std::vector<Spot>> polygons;
  for (int i = 0; i < 500; ++i) polygons.push_back(random_polygon(random, size));
  polygons.push_back({{-5, -5}, {40, 3}, {31, 50}});  // beyond all sides
  const auto painted = [&](int first, int past) {
    Pixels pixels(size, first, past);
    for (const auto& polygon : polygons) pixels.fill(polygon, {0.2, 0.5, 0.9, 0.7});
    return rows_of(pixels, size);
  };
  const auto whole = painted(0, size);
  for (const int rows : {1, 7, 29}) {
    std::vector<std::uint32_t> joined;
    for (int first = 0; first < size; first += rows) {
      const auto some = painted(first, std::min(size, first + rows));
      joined.insert(joined.end(), some.begin(), some.end());
    }
    EXPECT_EQ(joined, whole) << rows;
  }
}

TEST(pixels, have_nothing_of_what_is_nowhere) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Pixels pixels(8, 0, 8);
  pixels.fill(std::vector<Spot>{{1, 1}, {none, 2}, {4, 4}}, black);
  pixels.fill(std::vector<Spot>{{1, 1}, {2, std::numeric_limits<double>::infinity()}, {4, 4}},
              black);
  PixelPen pen(pixels, 4, 4);
  pen.move_to({0, 0});
  pen.curve_to({none, none}, {none, 0}, {0, none});
  pen.stroke(black, 0.5);
  for (const std::uint32_t pixel : rows_of(pixels, 8)) EXPECT_EQ(pixel, 0U);
}

TEST(pixels, have_dots_of_the_area_of_discs) {
  for (const double radius : {0.3, 0.9, 1.0, 2.6}) {
    Pixels pixels(8, 0, 8);
    PixelPen pen(pixels, 4, 4);
    pen.dot({0.05, -0.1}, radius, black);
    double area = 0;
    for (const std::uint32_t pixel : rows_of(pixels, 8)) area += (pixel >> 24U) / 255.0;
    EXPECT_NEAR(area, std::numbers::pi * radius * radius, 0.03) << radius;
  }
}

// What is said to be elsewhere leaves no trace.
TEST(pixels, nothing_that_is_elsewhere_is_there) {
  constexpr int size = 60;
  std::mt19937 random(3);
  std::normal_distribution<> normal;
  int num_elsewhere = 0;
  for (int turn = 0; turn < 20000; ++turn) {
    const Point a = normalized({normal(random), normal(random), normal(random)});
    const double reach = std::pow(0.1, turn % 4);
    const Point b = normalized(
        {a.x + reach * normal(random), a.y + reach * normal(random), a.z + reach * normal(random)});
    Pixels pixels(size, 20, 30);
    PixelPen pen(pixels, size / 2.0, size * 0.48);
    if (!pen.is_elsewhere(a, b, 0.5)) continue;
    ++num_elsewhere;
    for (const Side side : {Side::front, Side::back}) {
      trace_arc(pen, a, b, side, 1e-4);
      pen.stroke(black, 0.5);
    }
    for (const std::uint32_t pixel : rows_of(pixels, size)) ASSERT_EQ(pixel, 0U);
  }
  EXPECT_GT(num_elsewhere, 1000);
}

std::vector<Point> random_sites(std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<> normal;
  std::vector<Point> sites(count);
  for (Point& site : sites) {
    site = normalized({normal(random), normal(random), normal(random)});
  }
  return sites;
}

Figure figure_of(std::size_t count, int size) {
  const std::vector<Point> sites = random_sites(count);
  const Triangulation triangulation = delaunay(Sites::view(sites));
  Figure figure;
  figure.style.size = size;
  figure.sites = sites;
  figure.triangulation = {sites, triangulation_arcs(triangulation, sites)};
  figure.spacing = median_spacing(figure.triangulation.arcs, sites);
  return figure;
}

void show_cells(Figure& figure, bool filled) {
  auto [cells, areas] = diagram(delaunay(Sites::view(figure.sites)));
  figure.diagram = {cells.points, cell_arcs(cells)};
  figure.triangulation = {};
  if (filled) figure.filled = {std::move(cells), std::move(areas)};
}

// The red, green and blue of a picture.
std::vector<int> colors_of(const std::string& png) {
  std::string_view rest = png;
  const auto read = [](void* source, unsigned char* out, unsigned length) {
    auto& bytes = *static_cast<std::string_view*>(source);
    std::memcpy(out, bytes.data(), length);
    bytes.remove_prefix(length);
    return CAIRO_STATUS_SUCCESS;
  };
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create_from_png_stream(read, &rest), &cairo_surface_destroy);
  const int size = cairo_image_surface_get_width(image.get());
  std::vector<int> colors;
  for (int y = 0; y < size; ++y) {
    const unsigned char* const row =
        cairo_image_surface_get_data(image.get()) +
        std::ptrdiff_t{y} * cairo_image_surface_get_stride(image.get());
    for (int x = 0; x < size; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, row + 4 * static_cast<std::ptrdiff_t>(x), sizeof pixel);
      for (const unsigned shift : {16U, 8U, 0U}) {
        colors.push_back(static_cast<int>(pixel >> shift & 0xFFU));
      }
    }
  }
  return colors;
}

// How two pictures differ, in steps of 255: the root of the mean square of the differences of
// pixels, and the largest difference of the means of squares of 10 pixels.
struct Difference {
  double of_pixels = 0, of_squares = 0;
};

Difference difference(const std::vector<int>& a, const std::vector<int>& b, int size) {
  constexpr int side = 10;
  const int squares = size / side;
  std::vector<double> sums(static_cast<std::size_t>(squares * squares * 3));
  Difference result;
  for (int i = 0; i < size * size * 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double step = a[k] - b[k];
    result.of_pixels += step * step;
    const int square = i / 3 / size / side * squares + i / 3 % size / side;
    sums[static_cast<std::size_t>(square * 3 + i % 3)] += step;
  }
  result.of_pixels = std::sqrt(result.of_pixels / (size * size * 3));
  for (const double sum : sums) {
    result.of_squares = std::max(result.of_squares, std::abs(sum) / (side * side));
  }
  return result;
}

// Cairo rounds to bytes after each stroke, and knows a pixel's share by samples.
TEST(draw, shows_the_same_as_pixels_and_as_paths) {
  constexpr int size = 200;
  for (const std::size_t count : {2'000U, 40'000U}) {
    for (const int kind : {0, 1, 2, 3}) {
      Figure figure = figure_of(count, size);
      if (kind == 1) figure.style.show_back = true;
      if (kind >= 2) show_cells(figure, kind == 3);
      const auto found = colors_of(draw(figure, FigureFormat::png, true));
      const auto expected = colors_of(draw(figure, FigureFormat::png, false));
      const Difference off = difference(found, expected, size);
      EXPECT_LT(off.of_pixels, 4) << count << ' ' << kind;
      EXPECT_LT(off.of_squares, 6) << count << ' ' << kind;
      figure.triangulation.arcs.clear();
      figure.diagram.arcs.clear();
      figure.sites.clear();
      figure.filled.reset();
      const auto bare = colors_of(draw(figure, FigureFormat::png, false));
      EXPECT_GT(difference(bare, expected, size).of_pixels, 20) << "nothing was drawn";
    }
  }
}

TEST(draw, gives_the_same_bytes_for_any_number_of_threads) {
  Figure figure = figure_of(5000, 120);
  figure.style.show_back = true;
  for (const FigureFormat format : {FigureFormat::png, FigureFormat::svg}) {
    const std::string expected = draw(figure, format, true, 1);
    for (const unsigned threads : {2U, 3U, 7U, 64U, 1000U}) {
      EXPECT_TRUE(draw(figure, format, true, threads) == expected) << threads;
    }
  }
}

TEST(draw, makes_pixels_of_what_is_dense) {
  Figure figure = figure_of(40'000, 200);
  EXPECT_TRUE(is_dense(figure, FigureFormat::png));
  EXPECT_TRUE(is_dense(figure, FigureFormat::svg));
  EXPECT_LT(draw(figure, FigureFormat::svg).size(), 500'000U);
  figure.style.size = 900;  // wider apart than pixels
  EXPECT_TRUE(is_dense(figure, FigureFormat::png));
  EXPECT_FALSE(is_dense(figure, FigureFormat::svg));
  figure.style.line_width = 1;
  EXPECT_FALSE(is_dense(figure, FigureFormat::png));
  EXPECT_FALSE(is_dense(figure_of(20'000, 50), FigureFormat::png)) << "few arcs";
}

TEST(in_order_of_arcs, numbers_points_as_arcs_come_to_them) {
  const std::vector<Point> points{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  std::vector<ArcEnds> arcs{{2, 0}, {0, 3}, {3, 2}};
  EXPECT_EQ(in_order_of_arcs(arcs, points), (std::vector<Point>{points[2], points[0], points[3]}));
  EXPECT_EQ(arcs, (std::vector<ArcEnds>{{0, 1}, {1, 2}, {2, 0}}));
}

TEST(run_pieces, runs_each_once_and_passes_on_what_is_thrown) {
  for (const unsigned threads : {0U, 1U, 2U, 7U, 40U}) {
    std::vector<std::atomic<int>> counts(20);
    run_pieces(threads, 20, [&](int k) { ++counts[static_cast<std::size_t>(k)]; });
    for (const auto& count : counts) EXPECT_EQ(count, 1);
    const auto fail = [](int k) {
      if (k == 13) throw std::runtime_error("13");
    };
    EXPECT_THROW(run_pieces(threads, 20, fail), std::runtime_error);
    run_pieces(threads, 0, fail);
  }
  EXPECT_GE(num_workers(0), 1U);
  EXPECT_EQ(num_workers(3), 3U);
}

}  // namespace
}  // namespace rondel::cli
