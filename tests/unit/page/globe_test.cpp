// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The page: what it carries is what the library computed, bit for bit, for any input.
#include "rondel/globe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/sites.h"
#include "support/page_reader.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

struct Made {
  SiteTable table;
  Triangulation triangulation;
  Diagram both;
};

Made made(std::vector<Point> sites, Model model = Model::projected) {
  Made result;
  result.table.sites = std::move(sites);
  result.triangulation = delaunay(result.table.sites, {.model = model});
  result.both = diagram(result.triangulation);
  return result;
}

std::vector<Point> random_sites(std::size_t n, double longest = 1) {
  std::mt19937_64 random(7);
  std::normal_distribution<> normal;
  std::uniform_real_distribution<> length(1, longest);
  std::vector<Point> sites(n);
  for (Point& p : sites) {
    const Point v{normal(random), normal(random), normal(random)};
    const double scale = length(random) / std::hypot(v.x, v.y, v.z);
    p = {v.x * scale, v.y * scale, v.z * scale};
  }
  return sites;
}

std::string page_of(const Made& m, const GlobeOptions& options = {}) {
  return globe_page(m.table, m.triangulation, m.both, options);
}

template <class Row, class Number>
std::vector<Number> flat(std::span<const Row> rows) {
  const auto* const first = reinterpret_cast<const Number*>(rows.data());
  return {first, first + rows.size_bytes() / sizeof(Number)};
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

// What viewer/src/surface.js does to the points: the cross product of two sides, made a unit vector.
std::vector<double> restored_points(const std::string& page) {
  auto sites = array_of_page<double>(page, "directions");
  const auto faces = array_of_page<Index>(page, "faces");
  auto points = array_of_page<double>(page, "points");
  if (about_of(page)["model"] == "weighted") {
    const auto lengths = array_of_page<double>(page, "lengths");
    for (std::size_t i = 0; i < sites.size(); ++i) sites[i] *= lengths[i / 3];
  }
  const auto at = [&](Index site, std::size_t k) { return sites[3 * std::size_t{site} + k]; };
  for (std::size_t h = 0; h < faces.size(); h += 3) {
    double u[3], v[3];
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = at(faces[h + 1], k) - at(faces[h], k);
      v[k] = at(faces[h + 2], k) - at(faces[h], k);
    }
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                         u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const bool is_usable = length > 0 && std::isfinite(length);
    for (std::size_t k = 0; k < 3; ++k) {
      const double plain = is_usable ? n[k] / length : 0;
      points[h + k] = std::bit_cast<double>(bits(points[h + k]) ^ bits(plain));
    }
  }
  return points;
}

void expect_carries(const Made& m) {
  const std::string page = page_of(m);
  const auto about = about_of(page);
  EXPECT_EQ(about["sites"], m.triangulation.num_sites());
  EXPECT_EQ(about["dimension"], m.triangulation.dimension());
  EXPECT_EQ(about["faces"], m.triangulation.num_faces());
  EXPECT_EQ(array_of_page<Index>(page, "faces"), (flat<Triple, Index>(m.triangulation.faces())));
  EXPECT_EQ(array_of_page<Index>(page, "ghosts"),
            (flat<Index, Index>(m.triangulation.ghost_faces())));
  EXPECT_EQ(array_of_page<Index>(page, "hidden"), (flat<Hidden, Index>(m.triangulation.hidden())));
  EXPECT_EQ(array_of_page<Index>(page, "duplicates"),
            (flat<Duplicate, Index>(m.triangulation.duplicates())));
  EXPECT_EQ(array_of_page<Index>(page, "ring"), (flat<Index, Index>(m.triangulation.ring())));
  EXPECT_EQ(array_of_page<double>(page, "areas"), m.both.areas);
  EXPECT_EQ(restored_points(page),
            (flat<Point, double>(std::span<const Point>(m.both.cells.points))));
  const auto directions = array_of_page<double>(page, "directions");
  ASSERT_EQ(directions.size(), 3 * m.table.sites.size());
  for (std::size_t i = 0; i < directions.size(); i += 3) {
    const Point& p = m.table.sites[i / 3];
    const double length = std::hypot(p.x, p.y, p.z);
    EXPECT_NEAR(directions[i], p.x / length, 1e-15);
    EXPECT_NEAR(directions[i + 1], p.y / length, 1e-15);
    EXPECT_NEAR(directions[i + 2], p.z / length, 1e-15);
  }
}

TEST(globe_page, carries_what_was_computed_bit_for_bit) {
  expect_carries(made(random_sites(500)));
  expect_carries(made(random_sites(500, 1.2), Model::weighted));
}

TEST(globe_page, of_degenerate_sites_says_what_is_there) {
  expect_carries(made({}));
  expect_carries(made({{1, 0, 0}}));
  expect_carries(made({{1, 0, 0}, {-1, 0, 0}}));
  expect_carries(made({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {2, 0, 0}}));
  expect_carries(made({{1, 0, 0}, {1, 0.1, 0}, {1, 0, 0.1}, {1, 0.2, 0.1}, {1, 0.1, 0}}));
  expect_carries(made({{1e-200, 0, 0}, {0, 1e200, 0}, {0, 0, 1}, {-1, -1, -1}}));
}

TEST(globe_page, closes_isolines) {
  GlobeOptions options;
  Isolines lines;
  std::vector<Point>& points = lines.lines.rows.values;
  points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
  lines.lines.rows.offsets = {0, 3, 5};
  lines.is_closed = {1, 0};
  options.isolines = &lines;
  const std::string page = page_of(made(random_sites(9)), options);
  points.insert(points.begin() + 3, points.front());
  const std::vector<double> numbers = array_of_page<double>(page, "isolines");
  ASSERT_EQ(numbers.size(), 3 * points.size());
  EXPECT_EQ(std::memcmp(numbers.data(), points.data(), 8 * numbers.size()), 0);
  EXPECT_EQ(array_of_page<Index>(page, "isolineEnds"), (std::vector<Index>{4, 6}));
}

TEST(globe_page, has_rings_where_the_faces_around_a_site_are_not_all) {
  const std::string page = page_of(made({{1, 0, 0}, {-1, 0, 0}}));
  EXPECT_EQ(array_of_page<Index>(page, "ringOffsets").size(), 3U);
  const std::string usual = page_of(made(random_sites(100)));
  EXPECT_THROW(array_of_page<Index>(usual, "ringOffsets"), std::runtime_error);
}

TEST(globe_page, has_radii_of_circles_and_none_of_duplicates) {
  const double length = 1 / std::cos(0.25);
  const std::string page = page_of(made(
      {{length, 0, 0}, {0, 1, 0}, {length, 0, 0}, {0, 0, 0.9}, {-1, -1, -1}}, Model::weighted));
  const auto radii = array_of_page<double>(page, "radii");
  EXPECT_NEAR(radii[0], 0.25, 1e-15);
  EXPECT_EQ(radii[1], 0);
  EXPECT_EQ(radii[2], 0);
  EXPECT_EQ(radii[3], 0);
  EXPECT_NEAR(array_of_page<double>(page, "lengths")[3], 0.9, 1e-15);
}

TEST(globe_page, is_small) { EXPECT_LT(page_of(made(random_sites(2000))).size(), 300'000U); }

TEST(globe_page, is_the_same_for_any_number_of_threads) {
  const Made m = made(random_sites(60'000));
  EXPECT_EQ(globe_page(m.table, m.triangulation, m.both, {}, {.threads = 1}),
            globe_page(m.table, m.triangulation, m.both, {}, {.threads = 3}));
}

TEST(globe_page, carries_columns_and_values) {
  Made m = made(random_sites(3));
  m.table.columns.push_back({"name",
                             false,
                             "a\xc3\xa9"
                             "c",
                             {1, 1, 4}});
  const std::vector<double> values{1.5, std::numeric_limits<double>::quiet_NaN(), -2};
  GlobeOptions options;
  options.value_name = "height";
  options.values = values;
  const std::string page = page_of(m, options);
  EXPECT_EQ(about_of(page)["columns"][0]["name"], "name");
  EXPECT_EQ(about_of(page)["valueName"], "height");
  EXPECT_EQ(array_of_page<Index>(page, "column0Lengths"), (std::vector<Index>{1, 0, 3}));
  EXPECT_EQ(array_of_page<char>(page, "column0").size(), 4U);
  const auto carried = array_of_page<double>(page, "values");
  EXPECT_EQ(carried[0], 1.5);
  EXPECT_TRUE(std::isnan(carried[1]));
  EXPECT_EQ(carried[2], -2);
}

TEST(globe_page, lets_no_text_out_of_its_place) {
  Made m = made(random_sites(5));
  m.table.columns.push_back({"</script><b>@DATA@\xff", false, "<<<<<", {1, 2, 3, 4, 5}});
  GlobeOptions options;
  options.title = "<img src=x> & \"@SCRIPT@\"";
  const std::string page = page_of(m, options);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_NE(page.find("<h1>&lt;img src=x&gt; &amp; &quot;@SCRIPT@&quot;</h1>"), std::string::npos);
  EXPECT_EQ(about_of(page)["columns"][0]["name"], "</script><b>@DATA@\xef\xbf\xbd");
}

TEST(globe_page, looks_at_the_sites_from_near_enough) {
  const auto near_sites = about_of(page_of(made({{1, 0, 0}, {1, 1e-6, 0}, {1, 0, 1e-6}})));
  EXPECT_GT(near_sites["closeness"], 1e5);
  EXPECT_NEAR(near_sites["view"][0], 0, 1e-4);
  const auto everywhere = about_of(page_of(made(random_sites(300))));
  EXPECT_EQ(everywhere["closeness"], 1.0);
  EXPECT_EQ(everywhere["view"][1], 20.0);
  GlobeOptions options;
  options.view = LonLat{-60, 35};
  EXPECT_EQ(about_of(page_of(made(random_sites(300)), options))["view"][0], -60.0);
}

TEST(globe_page, refuses_what_does_not_fit_together) {
  const Made m = made(random_sites(9));
  const std::vector<double> values(8);
  GlobeOptions options;
  options.values = values;
  EXPECT_THROW(page_of(m, options), InvalidInput);
  options.values = {};
  Isolines lines;
  lines.is_closed = {0};
  options.isolines = &lines;
  EXPECT_THROW(page_of(m, options), InvalidInput);
  options.isolines = nullptr;
  options.up_deg = std::numeric_limits<double>::infinity();
  EXPECT_THROW(page_of(m, options), InvalidInput);
  Made other = m;
  other.table.sites.pop_back();
  EXPECT_THROW(page_of(other), InvalidInput);
  other = m;
  other.both.areas.pop_back();
  EXPECT_THROW(page_of(other), InvalidInput);
  other = m;
  other.table.columns.push_back({"name", false, "abc", {1, 2, 3}});
  EXPECT_THROW(page_of(other), InvalidInput);
}

TEST(write_globe, writes_the_page_or_nothing) {
  const Made m = made(random_sites(40));
  const std::filesystem::path path = temporary_path("globe.html");
  write_globe(path.string(), m.table, m.triangulation, m.both);
  std::ifstream file(path, std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_EQ(written, page_of(m));
  std::filesystem::remove(path);
  GlobeOptions options;
  options.graticule_deg = -1;
  EXPECT_THROW(write_globe(path.string(), m.table, m.triangulation, m.both, options), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_THROW(write_globe("/nonexistent/globe.html", m.table, m.triangulation, m.both), FileError);
}

}  // namespace
}  // namespace rondel::test
