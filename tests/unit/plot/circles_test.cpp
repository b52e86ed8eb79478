// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks which circles a figure of weighted sites shows.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "api/triangulation_impl.h"
#include "globe.h"
#include "plot_arcs.h"
#include "plot_circles.h"
#include "plot_color.h"
#include "plot_draw.h"
#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

std::vector<Circle> circles_of(const std::vector<Point>& sites, const Sphere& sphere = {},
                               std::vector<double> radii_deg = {}) {
  SiteTable table;
  table.sites = sites;
  table.radii_deg = std::move(radii_deg);
  std::vector<Point> directions;
  for (const Point& p : sites) {
    const Point v{p.x - sphere.center.x, p.y - sphere.center.y, p.z - sphere.center.z};
    directions.push_back(v == Point{} ? v : normalized(v));
  }
  const Triangulation triangulation = delaunay(sites, {.model = Model::weighted, .sphere = sphere});
  return real_circles(table, triangulation, directions);
}

TEST(real_circles, have_the_radii_from_which_sites_were_made) {
  for (const double radius_deg : {1e-5, 0.5, 30.0, 60.0, 89.9999, 90 - 1e-9}) {
    const auto circles = circles_of({polar_point(LonLat{20, 30}, radius_deg)});
    ASSERT_EQ(circles.size(), 1U);
    // The error of a length, 1e-16, is much against the square of a small radius.
    EXPECT_NEAR(circles[0].radius_deg / radius_deg, 1, radius_deg < 1e-3 ? 0.02 : 1e-9);
    EXPECT_NEAR(angle_between(circles[0].axis, unit_vector({20, 30})), 0, 1e-15);
  }
}

TEST(real_circles, take_the_radii_of_the_table) {
  const auto circles = circles_of({polar_point(Point{0, 0, 1}, 1e-9)}, {}, {1e-9});
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_EQ(circles[0].radius_deg, 1e-9);
}

TEST(real_circles, leave_out_points_imaginary_ones_and_the_center) {
  EXPECT_TRUE(circles_of({{0, 0, 1}, {0.5, 0, 0}, {0, 0, 0}, {0, -0.99, 0}}).empty());
  const Sphere sphere{{10, 0, 0}, 4};
  const auto circles = circles_of({{12, 0, 0}, {14, 0, 0}, {10, 0, 0}, {10, 1, 0}}, sphere);
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_NEAR(circles[0].radius_deg, 60, 1e-12);
}

TEST(real_circles, show_duplicates_once_and_mark_hidden_ones) {
  const std::vector<Point> sites = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0},
                                    {0, 0, 2}, {0, 0, -2}, {2, 0, 0}, {1.5, 0, 0}};
  const auto circles = circles_of(sites);
  ASSERT_EQ(circles.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(circles[i].is_hidden, i == 6);
}

// Checks which arcs a figure shows.

std::set<std::set<Index>> undirected(const std::vector<ArcEnds>& arcs) {
  std::set<std::set<Index>> result;
  for (const auto& [a, b] : arcs) result.insert({a, b});
  return result;
}

// A tetrahedron; face i is opposite to site i.
Triangulation tetrahedron(std::vector<Index> ghost_faces) {
  TriangulationArrays arrays;
  arrays.dimension = 2;
  arrays.faces = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  arrays.neighbors = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  arrays.num_sites = 4;
  arrays.ghost_faces = std::move(ghost_faces);
  return api::make_triangulation({}, std::move(arrays), {}, {});
}

Triangulation ring(std::vector<Index> order) {
  TriangulationArrays arrays;
  arrays.num_sites = order.size();
  arrays.dimension = 1;
  arrays.ring = std::move(order);
  return api::make_triangulation({}, std::move(arrays), {}, {});
}

Point on_equator(double radians) { return {std::cos(radians), std::sin(radians), 0}; }

TEST(triangulation_arcs, has_each_edge_once) {
  const auto arcs = triangulation_arcs(tetrahedron({}), {});
  EXPECT_EQ(arcs.size(), 6U);
  EXPECT_EQ(undirected(arcs).size(), 6U);
}

TEST(triangulation_arcs, leaves_out_edges_between_ghost_faces) {
  // Of two ghost faces, 2 and 3, the common edge 0 1 is not seen; the others bound solid faces.
  const auto arcs = triangulation_arcs(tetrahedron({2, 3}), {});
  EXPECT_EQ(arcs.size(), 5U);
  EXPECT_EQ(undirected(arcs).size(), 5U);
  EXPECT_EQ(undirected(arcs).count({0, 1}), 0U);
  EXPECT_TRUE(triangulation_arcs(tetrahedron({0, 1, 2, 3}), {}).empty());
}

TEST(triangulation_arcs, of_a_ring_around_the_sphere_close_it) {
  const std::vector<Point> sites{on_equator(0), on_equator(2.2), on_equator(4.1)};
  EXPECT_EQ(undirected(triangulation_arcs(ring({0, 1, 2}), sites)).size(), 3U);
}

TEST(triangulation_arcs, of_a_ring_leave_a_gap_beyond_180_degrees_open) {
  const std::vector<Point> sites{on_equator(1.5), on_equator(0), on_equator(0.5), on_equator(2.5)};
  const auto arcs = undirected(triangulation_arcs(ring({1, 2, 0, 3}), sites));
  const std::set<std::set<Index>> expected{{1, 2}, {2, 0}, {0, 3}};
  EXPECT_EQ(arcs, expected);
}

TEST(triangulation_arcs, join_two_sites_once_and_antipodal_ones_not_at_all) {
  const std::vector<Point> sites{on_equator(0), on_equator(2)};
  EXPECT_EQ(triangulation_arcs(ring({0, 1}), sites).size(), 1U);
  const std::vector<Point> antipodal{{1, 0, 0}, {-1, 0, 0}};
  EXPECT_TRUE(triangulation_arcs(ring({0, 1}), antipodal).empty());
  EXPECT_TRUE(triangulation_arcs(ring({0}), antipodal).empty());
  EXPECT_TRUE(triangulation_arcs(Triangulation{}, {}).empty());
}

TEST(triangulation_arcs, span_a_half_circle_of_sites_but_not_its_gap) {
  const std::vector<Point> sites{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  const auto arcs = undirected(triangulation_arcs(ring({0, 1, 2}), sites));
  const std::set<std::set<Index>> expected{{0, 1}, {1, 2}};
  EXPECT_EQ(arcs, expected);
}

TEST(cell_arcs, has_each_edge_once_and_none_of_length_zero) {
  Cells cells;
  cells.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}};
  cells.rings.values = {0, 1, 2, 3, 3, 2, 1, 0};
  cells.rings.offsets = {0, 4, 4, 8};
  const auto arcs = cell_arcs(cells);
  const std::set<std::set<Index>> expected{{0, 1}, {1, 2}, {0, 3}};
  EXPECT_EQ(arcs.size(), 3U);
  EXPECT_EQ(undirected(arcs), expected);
}

TEST(median_spacing, is_that_of_the_nearest_sites_in_front) {
  const std::vector<Point> points{{0, 0, 1}, {0.1, 0, 0.99}, {0.4, 0, 0.9}, {0, 0, -1}};
  const std::vector<ArcEnds> arcs{{0, 1}, {0, 2}, {1, 2}, {0, 3}};
  EXPECT_DOUBLE_EQ(median_spacing(std::span(arcs).first(3), points), 0.1);
  EXPECT_EQ(median_spacing({}, points), 0);
}

// Whole figures, as bytes, and their colors.

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
