// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rings and lines are connected correctly for any values: ties, plateaus, saddles, missing ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "unit/interpolation/contours_support.h"

namespace rondel::test {
namespace {

using Place = std::array<double, 3>;
using Arc = std::pair<Place, Place>;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Place place_of(const Point& p) { return {p.x, p.y, p.z}; }

// Visits the arcs of a ring.
template <class Visit>
void for_each_arc(std::span<const Point> ring, const Visit& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    visit(Arc{place_of(ring[i]), place_of(ring[(i + 1) % ring.size()])});
  }
}

void expect_simple(std::span<const Point> points, std::string_view name) {
  std::vector<Place> places(points.size());
  std::ranges::transform(points, places.begin(), place_of);
  std::ranges::sort(places);
  EXPECT_EQ(std::ranges::adjacent_find(places), places.end()) << name;
}

double surface_area(const Triangulation& t, std::span<const double> values) {
  std::vector<bool> has_value(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) has_value[i] = !std::isnan(values[i]);
  for (const auto& [site, representative] : t.duplicates()) {
    if (has_value[site]) has_value[representative] = true;
  }
  double area = 0;
  for (Index f = 0; f < t.num_faces(); ++f) {
    std::array<Point, 3> corners;
    bool is_there = !t.is_ghost(f);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index site = t.faces()[f][i];
      corners[i] = unit(minus(t.sites()[site], t.sphere().center));
      is_there = is_there && has_value[site];
    }
    if (is_there) area += signed_ring_area(corners);
  }
  return area;
}

struct Case {
  std::string name;
  Triangulation triangulation;
  std::vector<double> values;
};

const std::vector<double> stepped_levels{0, 0.5, 1, 2, 3};

template <class Visit>
void for_each_stepped_case(const Visit& visit) {
  Random random(17);
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    for (const std::size_t n : {12U, 70U}) {
      for (const unsigned gaps : {0U, 6U}) {
        Case c{std::string(generator.name) + " " + std::to_string(n) + (gaps > 0 ? " gaps" : ""),
               projected(generator.make(n, 4)),
               {}};
        c.values = stepped_values(c.triangulation.num_sites(), random);
        for (double& value : c.values) {
          if (gaps > 0 && random.below(gaps) == 0) value = missing;
        }
        visit(c);
      }
    }
  }
}

TEST(contours, are_simple_lines_and_rings_for_every_generator) {
  for_each_stepped_case([](const Case& c) {
    const Bands found = bands(c.triangulation, c.values, stepped_levels);
    for (std::size_t ring = 0; ring < found.rings().size(); ++ring) {
      EXPECT_GE(ring_points(found, ring).size(), 3U);
      expect_simple(ring_points(found, ring), c.name);
    }
    const Isolines lines = isolines(c.triangulation, c.values, stepped_levels);
    for (std::size_t line = 0; line < lines.num_lines(); ++line) {
      EXPECT_GE(line_points(lines, line).size(), lines.is_closed[line] != 0 ? 3U : 2U);
      expect_simple(line_points(lines, line), c.name);
    }
  });
}

TEST(bands, have_the_area_of_the_surface_for_every_generator) {
  for_each_stepped_case([](const Case& c) {
    const Bands found = bands(c.triangulation, c.values, stepped_levels);
    double area = 0;
    for (std::size_t i = 0; i < found.num_polygons(); ++i) area += polygon_area(found, i);
    // Of a polygon as wide as rounding nobody knows whether it has nothing or all.
    const double difference = area - surface_area(c.triangulation, c.values);
    EXPECT_NEAR(std::remainder(difference, 4 * std::numbers::pi), 0, 1e-11) << c.name;
  });
}

TEST(bands, have_the_area_of_the_sphere) {
  const Triangulation t = projected(generator("uniform").make(2000, 1));
  const Bands found = bands(t, smooth_values(t), std::vector<double>{-0.7, -0.1, 0.2, 0.9, 1.4});
  ASSERT_GT(found.num_polygons(), 8U);
  double area = 0;
  for (std::size_t i = 0; i < found.num_polygons(); ++i) area += polygon_area(found, i);
  EXPECT_NEAR(area, 4 * std::numbers::pi, 1e-13);
}

// Whether the arcs between two sites and their points are longer than rounding.
bool has_clear_arcs(const Triangulation& t) {
  for (const Triple& face : t.faces()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point p = unit(minus(t.sites()[face[i]], t.sphere().center));
      const Point q = unit(minus(t.sites()[face[(i + 1) % 3]], t.sphere().center));
      if (std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) < 1e-14) return false;
    }
  }
  return true;
}

// Each arc is in one band from one end and in another from the other, or at the border of the surface.
// Those of the first kind are the isolines.
TEST(bands, share_their_arcs_and_isolines_are_these) {
  for_each_stepped_case([](const Case& c) {
    if (!has_clear_arcs(c.triangulation)) return;
    const Bands found = bands(c.triangulation, c.values, stepped_levels);
    std::map<Arc, std::size_t> band_of;
    for (std::size_t k = 0; k < found.num_bands(); ++k) {
      for (const auto& ring : rings_of_band(found, k)) {
        for_each_arc(
            ring, [&](const Arc& arc) { EXPECT_TRUE(band_of.emplace(arc, k).second) << c.name; });
      }
    }
    std::map<Arc, int> expected;  // how many levels pass there
    std::map<Place, int> ends;    // of the border
    for (const auto& [arc, band] : band_of) {
      const auto other = band_of.find({arc.second, arc.first});
      if (other == band_of.end()) {
        ++ends[arc.first];
        --ends[arc.second];
      } else {
        EXPECT_NE(other->second, band) << c.name;
        if (other->second < band) expected[arc] = static_cast<int>(band - other->second);
      }
    }
    for (const auto& [place, count] : ends) EXPECT_EQ(count, 0) << c.name;
    const Isolines lines = isolines(c.triangulation, c.values, stepped_levels);
    for (std::size_t line = 0; line < lines.num_lines(); ++line) {
      for_each_arc(line_points(lines, line), [&](const Arc& arc) {
        const bool closes = arc.first == place_of(line_points(lines, line).back());
        if (!closes || lines.is_closed[line] != 0) --expected[arc];
      });
    }
    for (const auto& [arc, count] : expected) EXPECT_EQ(count, 0) << c.name;
  });
}

// On the sphere, a connected region with b rings has the Euler characteristic 2 - b; the sum over
// all regions and what they share is that of the sphere. With simple rings that touch nowhere each ring is
// shared by two regions.
TEST(bands, of_generic_values_have_the_euler_characteristic_of_the_sphere) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Triangulation t = projected(generator("uniform").make(200, seed));
    Random random(seed);
    std::vector<double> values(200);
    for (double& value : values) value = random.unit();
    const Bands found = bands(t, values, std::vector<double>{0.3, 0.4, 0.7});
    const auto rings = static_cast<int>(found.rings().size());
    EXPECT_EQ(2 * static_cast<int>(found.num_polygons()) - rings, 2);
    const Isolines lines = isolines(t, values, std::vector<double>{0.3, 0.4, 0.7});
    EXPECT_EQ(2 * static_cast<int>(lines.num_lines()), rings);
  }
}

TEST(contours, have_the_same_bytes_for_any_order_of_the_sites_and_threads) {
  for_each_stepped_case([](const Case& c) {
    const std::size_t n = c.values.size();
    if (!c.triangulation.duplicates().empty()) return;
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    Random random(2);
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    std::vector<Point> sites;
    std::vector<double> values;
    for (const std::size_t i : order) {
      sites.push_back(c.triangulation.sites()[i]);
      values.push_back(c.values[i]);
    }
    const Triangulation other = delaunay(sites, {.sphere = c.triangulation.sphere()});
    const Bands a = bands(c.triangulation, c.values, stepped_levels, {.threads = 1});
    const Bands b = bands(other, values, stepped_levels, {.threads = 4});
    EXPECT_EQ(a.rings().values, b.rings().values) << c.name;
    EXPECT_EQ(a.rings().offsets, b.rings().offsets) << c.name;
    EXPECT_EQ(a.bands.rows.offsets, b.bands.rows.offsets) << c.name;
    EXPECT_EQ(a.bands.offsets, b.bands.offsets) << c.name;
    const Isolines d = isolines(c.triangulation, c.values, stepped_levels, {.threads = 1});
    const Isolines e = isolines(other, values, stepped_levels, {.threads = 4});
    EXPECT_EQ(d.lines.rows.values, e.lines.rows.values) << c.name;
    EXPECT_EQ(d.lines.rows.offsets, e.lines.rows.offsets) << c.name;
    EXPECT_EQ(d.is_closed, e.is_closed) << c.name;
  });
}

// The places of duplicates on one ray differ; their order must not matter.
TEST(contours, take_the_place_of_a_duplicate_from_no_order) {
  std::vector<Point> sites{{1, 2, 3}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {1.0 / 3, 2.0 / 3, 1}};
  sites.push_back({0.1 * 3, 0.2 * 3, 0.3 * 3});
  std::vector<double> values{1, 0, 0, 0, 1, 1};
  const Bands a = bands(delaunay(sites), values, std::vector<double>{0.5, 1});
  std::ranges::reverse(sites);
  std::ranges::reverse(values);
  const Bands b = bands(delaunay(sites), values, std::vector<double>{0.5, 1});
  EXPECT_EQ(a.rings().values, b.rings().values);
}

TEST(bands, of_one_value_are_the_whole_surface) {
  const Triangulation globe = projected(generator("uniform").make(30, 1));
  const Bands all = bands(globe, std::vector<double>(30, 1.0), std::vector<double>{0, 1, 2});
  EXPECT_EQ(all.bands.offsets, (std::vector<std::uint64_t>{0, 0, 0, 1, 1}));
  EXPECT_EQ(all.bands.rows.offsets, (std::vector<std::uint64_t>{0, 0}));
  const Bands none = bands(globe, std::vector<double>(30, missing), std::vector<double>{0});
  EXPECT_EQ(none.num_polygons(), 0U);
  EXPECT_EQ(bands(globe, std::vector<double>(30, 1.0), {}).num_polygons(), 1U);
  EXPECT_EQ(isolines(globe, std::vector<double>(30, 1.0), std::vector<double>{1}).num_lines(), 0U);
}

TEST(bands, of_fewer_than_two_dimensions_are_empty) {
  for (const std::vector<Point>& sites : {std::vector<Point>{},
                                          {{1, 0, 0}},
                                          {{1, 0, 0}, {0, 1, 0}},
                                          {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}) {
    const Triangulation t = delaunay(sites);
    const std::vector<double> values(sites.size(), 1.0);
    EXPECT_EQ(bands(t, values, std::vector<double>{0}).num_polygons(), 0U);
    EXPECT_EQ(isolines(t, values, std::vector<double>{0}).num_lines(), 0U);
  }
}

// A site at the level between two higher and two lower ones: the higher side is connected there only in
// a point.
TEST(contours, of_a_saddle_at_a_level) {
  const std::vector<Point> sites{{0, 0, 1},    {1, 0, 0.5},  {0, 1, 0.5},
                                 {-1, 0, 0.5}, {0, -1, 0.5}, {0, 0, -1}};
  const Triangulation t = delaunay(sites);
  const std::vector<double> values{1, 2, 0, 2, 0, 0};
  const Bands found = bands(t, values, std::vector<double>{1});
  EXPECT_EQ(found.bands.offsets, (std::vector<std::uint64_t>{0, 1, 3}));
  EXPECT_EQ(isolines(t, values, std::vector<double>{1}).num_lines(), 2U);
  const std::vector<double> peak{1, 0, 0, 0, 0, 0};
  EXPECT_EQ(isolines(t, peak, std::vector<double>{1}).num_lines(), 0U);
  EXPECT_EQ(bands(t, peak, std::vector<double>{1}).bands.offsets,
            (std::vector<std::uint64_t>{0, 1, 1}));
}

}  // namespace
}  // namespace rondel::test
