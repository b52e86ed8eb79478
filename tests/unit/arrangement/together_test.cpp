// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points, lines and polygons in longitude and latitude that are read together meet on the sphere
// where they meet in the plane, which integers decide; and they are written again.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "rondel/relate.h"
#include "support/random.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::test::of_together {
namespace {

using Line = std::vector<LonLat>;
using Ring = std::vector<LonLat>;  // closed

// Makes a feature of each line.
LonLatGeometries of_lines(const std::vector<Line>& lines) {
  LonLatGeometries set;
  for (const Line& line : lines) {
    set.lines.rows.append(line);
    set.lines.end_group();
    set.polygons.offsets.push_back(0);
  }
  return set;
}

// Makes a feature of each ring.
LonLatGeometries of_rings(const std::vector<Ring>& rings) {
  LonLatGeometries set;
  for (const Ring& ring : rings) {
    set.polygons.rows.rows.append(ring);
    set.polygons.rows.end_group();
    set.polygons.end_group();
    set.lines.end_group();
  }
  return set;
}

std::vector<Geometries> converted(const std::vector<LonLatGeometries>& sets,
                                  const PolygonOptions& options = {}) {
  std::vector<Geometries> result;
  for (FeatureTable& table : features_of_geometries(sets, options)) {
    result.push_back({std::move(table.lines), std::move(table.polygons)});
  }
  return result;
}

double total_length(const Geometries& geometries) {
  double sum = 0;
  for (const double length : lengths(geometries.lines)) sum += length;
  return sum;
}

bool is_empty(const Geometries& geometries) {
  return geometries.lines.rows.size() == 0 && geometries.polygons.rings.size() == 1 &&
         geometries.polygons.whole.empty();
}

// --- an integer grid in the plane ---

constexpr double step = 0x1p-20;  // degrees

struct GridPlace {
  std::int64_t lon;
  std::int64_t lat;
  friend bool operator==(const GridPlace&, const GridPlace&) = default;
};

LonLat lonlat_of(const GridPlace& p) {
  return {static_cast<double>(p.lon) * step, static_cast<double>(p.lat) * step};
}

int side(const GridPlace& a, const GridPlace& b, const GridPlace& c) {
  const std::int64_t sum = (b.lon - a.lon) * (c.lat - a.lat) - (b.lat - a.lat) * (c.lon - a.lon);
  return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

// A box of 20 degrees somewhere, whose corners may be beyond 180 degrees.
class Place {
 public:
  explicit Place(Random& random)
      : random_(random),
        west_(static_cast<std::int64_t>(std::array{0, 170, -185, 300, -70}[random.below(5)]) << 20),
        south_(static_cast<std::int64_t>(std::array{-10, 40, 69, -85}[random.below(4)]) << 20) {}
  GridPlace operator()() {
    const auto part = [&] { return static_cast<std::int64_t>(random_.below(20)) << 20; };
    const std::int64_t lon = west_ + part();
    return {lon, south_ + part()};
  }

 private:
  Random& random_;
  std::int64_t west_;
  std::int64_t south_;
};

class Together : public testing::TestWithParam<int> {};

// The arcs of a side of several degrees are kilometers from its straight line if they do not get
// further corners.
TEST_P(Together, points_are_on_the_side_where_the_plane_has_them) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  Place place(random);
  std::array<GridPlace, 3> corners = {place(), place(), place()};
  if (side(corners[0], corners[1], corners[2]) == 0) return;
  if (side(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  std::vector<Line> points;
  std::vector<bool> expected;
  for (int i = 0; i < 60; ++i) {
    const GridPlace& a = corners[random.below(3)];
    const GridPlace& b = corners[random.below(3)];
    // A place on the side, or a step or more beside it.
    const auto part = static_cast<std::int64_t>(random.below(65));
    const auto offset = static_cast<std::int64_t>(random.below(5)) - 2;
    const std::int64_t scale = std::array<std::int64_t, 3>{1, 16, 1024}[random.below(3)];
    const GridPlace p = {a.lon + (b.lon - a.lon) / 64 * part,
                         a.lat + (b.lat - a.lat) / 64 * part + offset * scale};
    points.push_back({lonlat_of(p)});
    expected.push_back(side(corners[0], corners[1], p) >= 0 &&
                       side(corners[1], corners[2], p) >= 0 &&
                       side(corners[2], corners[0], p) >= 0);
  }
  const Ring ring = {lonlat_of(corners[0]), lonlat_of(corners[1]), lonlat_of(corners[2]),
                     lonlat_of(corners[0])};
  const auto sets = converted({of_lines(points), of_rings({ring})}, {.tolerance_deg = 0.5});
  for (Index i = 0; i < points.size(); ++i) {
    const std::array<Index, 2> pair = {i, 0};
    const Geometries common =
        combine_pairs(sets[0], sets[1], {&pair, 1}, SetOperation::intersection);
    EXPECT_EQ(!is_empty(common), expected[i]) << "point " << i;
  }
}

TEST_P(Together, lines_cross_as_often_as_in_the_plane) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 1000);
  Place place(random);
  const GridPlace a = place();
  const GridPlace b = place();
  const GridPlace p = place();
  GridPlace q = place();
  if (random.below(3) == 0) q = {(a.lon + b.lon) / 2, (a.lat + b.lat) / 2};  // touches
  if (a == b || p == q) return;
  const int p_side = side(a, b, p);
  const int q_side = side(a, b, q);
  const bool are_collinear = p_side == 0 && q_side == 0;
  const bool do_meet = p_side * q_side <= 0 && side(p, q, a) * side(p, q, b) <= 0 && !are_collinear;
  const auto sets = converted(
      {of_lines({{lonlat_of(a), lonlat_of(b)}}), of_lines({{lonlat_of(p), lonlat_of(q)}})},
      {.tolerance_deg = 0.5});
  const Geometries common = combine(sets[0], sets[1], SetOperation::intersection);
  if (are_collinear) {
    const Geometries either = combine(sets[0], sets[1], SetOperation::unite);
    EXPECT_NEAR(total_length(either) + total_length(common),
                total_length(sets[0]) + total_length(sets[1]), 1e-14);
  } else {
    EXPECT_EQ(common.lines.rows.size(), do_meet ? 1U : 0U);
    EXPECT_EQ(common.lines.rows.values.size(), do_meet ? 1U : 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(all, Together, testing::Range(0, 200));

// --- borders of countries ---

// Calls visit(ring) for each ring of the countries, closed.
void visit_borders(const std::function<void(const Ring&)>& visit) {
  std::ifstream file(RONDEL_SOURCE_DIR "/data/countries-110m.geojson");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  Ring ring;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (; at < end; ++at) {
    if (*at == '[' && (at[1] == '-' || (at[1] >= '0' && at[1] <= '9'))) {
      char* next = nullptr;
      const double lon = std::strtod(at + 1, &next);
      const double lat = std::strtod(next + 1, &next);
      ring.push_back({lon, lat});
      at = next;
      if (at[1] == ']') {
        visit(ring);
        ring.clear();
      }
    }
  }
}

// Returns the borders as lines, without those along a pole: forwards and backwards, a turn away,
// and side by side.
std::vector<Line> borders(int variant) {
  std::vector<Line> lines;
  visit_borders([&](const Ring& ring) {
    Line line;
    const auto finish = [&] {
      if (variant == 1) std::ranges::reverse(line);
      if (line.size() > 1) lines.push_back(line);
      line.clear();
    };
    for (LonLat p : ring) {
      if (p.lat_deg == -90) {
        finish();
        continue;
      }
      if (variant == 2) p.lon_deg += 360;
      line.push_back(p);
      if (variant == 3 && line.size() > 1) {
        finish();
        line.push_back(p);
      }
    }
    finish();
  });
  return lines;
}

TEST(together, borders_lie_on_their_polygons) {
  const TemporaryDirectory folder;
  const FileName countries = {RONDEL_SOURCE_DIR "/data/countries-110m.geojson", {}};
  for (int variant = 0; variant < 4; ++variant) {
    const std::vector<Line> lines = borders(variant);
    ASSERT_GT(lines.size(), 280U);
    std::string text = R"({"type":"MultiLineString","coordinates":[)";
    for (const Line& line : lines) {
      text += &line == lines.data() ? "[" : ",[";
      for (std::size_t k = 0; k < line.size(); ++k) {
        std::array<char, 80> position{};
        std::snprintf(position.data(), position.size(), "%s[%.17g,%.17g]", k > 0 ? "," : "",
                      line[k].lon_deg, line[k].lat_deg);
        text += position.data();
      }
      text += ']';
    }
    const std::array files = {FileName{folder.with("borders.geojson", text + "]}"), {}}, countries};
    const std::vector<FeatureTable> tables = read_features_together(files);
    const Geometries border = {tables[0].lines, tables[0].polygons};
    const Geometries land = {tables[1].lines, tables[1].polygons};
    EXPECT_TRUE(is_empty(combine(border, land, SetOperation::difference))) << variant;
    // What is inside of land that is drawn whole is the border of countries.
    const Geometries common = combine(border, land, SetOperation::intersection);
    EXPECT_NEAR(total_length(common), total_length(unite(border)), 1e-12) << variant;
    EXPECT_EQ(common.polygons.rings.size(), 1U);
  }
}

// Longitudes from 0 to 360 are rounded otherwise than those from -180 to 180.
TEST(together, polygons_a_turn_away_are_the_same) {
  std::vector<Ring> rings;
  std::vector<Ring> turned;
  visit_borders([&](const Ring& ring) {
    rings.push_back(ring);
    turned.push_back(ring);
    for (LonLat& p : turned.back()) p.lon_deg += 360;
  });
  const auto sets = converted({of_rings(rings), of_rings(turned)});
  EXPECT_TRUE(is_empty(combine(sets[0], sets[1], SetOperation::symmetric_difference)));
}

TEST(together, results_do_not_depend_on_the_order_of_sets) {
  Random random(7);
  Place place(random);
  std::vector<Line> lines;
  std::vector<Ring> rings;
  for (int i = 0; i < 20; ++i) {
    lines.push_back({lonlat_of(place()), lonlat_of(place()), lonlat_of(place())});
    const GridPlace a = place();
    const GridPlace b = place();
    const GridPlace c = place();
    if (side(a, b, c) != 0) {
      rings.push_back({lonlat_of(a), lonlat_of(b), lonlat_of(c), lonlat_of(a)});
    }
  }
  const auto forth = converted({of_lines(lines), of_rings(rings)});
  const auto back = converted({of_rings(rings), of_lines(lines)});
  EXPECT_EQ(forth[0].lines, back[1].lines);
  EXPECT_EQ(forth[1].polygons.points.size(), back[0].polygons.points.size());
  const auto sorted = [](std::vector<Point> points) {
    std::ranges::sort(points, [](const Point& p, const Point& q) {
      return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    });
    return points;
  };
  EXPECT_EQ(sorted(forth[1].polygons.points), sorted(back[0].polygons.points));
}

// --- what is refused, and what is repaired ---

std::string refused(const std::vector<LonLatGeometries>& sets, const PolygonOptions& options = {}) {
  return thrown_message<InvalidInput>([&] { (void)features_of_geometries(sets, options); });
}

TEST(together, lines_that_do_not_tell_their_way_are_refused) {
  const Line across = {{170, 0}, {-170, 10}};
  const std::string message =
      "its line from 170 0 to -170 10 spans more than 180 degrees of longitude: a line across the "
      "antimeridian has to be cut there, or to be read with geodesic edges; if the long way is "
      "meant, divide it by a position";
  EXPECT_EQ(refused({of_lines({{{0, 0}}, across})}), "feature 1: " + message);
  EXPECT_EQ(refused({of_lines({{{3601, 0}}})}),
            "feature 0: longitude 3601 0 is more than ten turns of the globe away");
  EXPECT_EQ(refused({of_lines({{{0, 0}, {180, 0}}})}, {.edges = PolygonEdges::geodesic}),
            "feature 0: its line leads to the opposite place, 180 0: divide it by a position");
  EXPECT_EQ(refused({of_lines({{{0, 91}}})}), "feature 0: latitude 91 is outside [-90, 90]");
  EXPECT_EQ(refused({of_lines({{}})}), "feature 0: a line without a position");
  EXPECT_EQ(refused({of_lines({across})}, {.overlap = PolygonOverlap::first}),
            "features that are read together may overlap");
  LonLatGeometries uneven = of_lines({across});
  uneven.polygons.offsets.push_back(0);
  EXPECT_EQ(refused({uneven}), "there are lines of 1 features and polygons of 2");
  uneven = of_lines({across});
  uneven.lines.offsets.back() = 7;
  EXPECT_EQ(refused({uneven}), "the offsets of the lines do not fit");

  const std::array sets = {of_lines({{{0, 0}}, across}), of_lines({across})};
  const auto tables = features_of_geometries(sets, {.invalid = InvalidPolygons::repair});
  EXPECT_EQ(tables[0].facts.remarks,
            std::vector<std::string>{"feature 1 was repaired (" + message + ")"});
  EXPECT_EQ(tables[1].facts.remarks,
            std::vector<std::string>{"feature 0 was repaired (" + message + ")"});
  EXPECT_EQ(tables[0].facts.faults, (std::vector<std::string>{"", message}));
  EXPECT_NEAR(lengths(tables[0].lines)[1], 22.3 * std::numbers::pi / 180, 0.01);
  EXPECT_EQ(lengths(tables[0].lines)[1], lengths(tables[1].lines)[0]);
}

TEST(together, faults_are_told_of_their_file) {
  const TemporaryDirectory folder;
  const std::string fine = folder.with("fine.geojson", R"({"type":"Point","coordinates":[1,2]})");
  const std::string faulty = folder.with(
      "faulty.geojson",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"bow"},)"
      R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[10,10],[10,0],[0,10],[0,0]]]}}]})");
  const std::array files = {FileName{fine, {}}, FileName{faulty, {}}};
  EXPECT_EQ(thrown_message<FileError>([&] { (void)read_features_together(files); }),
            faulty + ": feature 0 (bow): ring 0 of part 0 crosses itself at 5 5");
  const auto tables = read_features_together(files, {.invalid = InvalidPolygons::repair});
  EXPECT_TRUE(tables[0].facts.remarks.empty());
  EXPECT_EQ(tables[1].facts.remarks,
            std::vector<std::string>{
                "feature 0 (bow) was repaired (ring 0 of part 0 crosses itself at 5 5)"});
  EXPECT_EQ(tables[0].facts.name, fine);
  EXPECT_EQ(tables[1].facts.columns.front().name, "name");
  EXPECT_TRUE(read_features_together({}).empty());
}

// A box that should cross the antimeridian is the rest of its zone. The areas tell which one was read.
TEST(together, sides_that_go_the_long_way_are_told) {
  const TemporaryDirectory folder;
  const auto read = [&](const std::string& west, const std::string& east, PolygonEdges edges) {
    const auto ring = [](const std::string& w, const std::string& e) {
      return "[[[" + w + ",-10],[" + e + ",-10],[" + e + ",10],[" + w + ",10],[" + w + ",-10]]]";
    };
    const std::string file = folder.with(
        "boxes.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature",)"
                         R"("properties":{},"geometry":{"type":"Polygon","coordinates":)" +
                             ring("0", "5") +
                             R"(}},{"type":"Feature","properties":{"name":"Fiji"},)"
                             R"("geometry":{"type":"Polygon","coordinates":)" +
                             ring(west, east) + "}}]}");
    return read_features_together(std::array{FileName{file, {}}}, {.edges = edges}).front();
  };
  const double zone = 4 * std::numbers::pi * std::sin(10 * std::numbers::pi / 180);
  for (const auto& [west, east] :
       {std::array{170, -170}, {-170, 170}, {170, 190}, {-180, 180}, {-90, 90}, {-100, 100}}) {
    const FeatureTable table =
        read(std::to_string(west), std::to_string(east), PolygonEdges::lonlat);
    const double degrees = areas(table.polygons)[1] / zone * 360;
    EXPECT_NEAR(degrees, std::abs(east - west), 0.01) << west;
    const bool is_long = degrees > 180.1 && degrees < 359.9;
    ASSERT_EQ(table.facts.remarks.size(), is_long ? 1U : 0U) << west;
    if (!is_long) continue;
    EXPECT_EQ(table.facts.remarks[0],
              "feature 1 (Fiji): the side from " + std::to_string(west) + " -10 to " +
                  std::to_string(east) + " -10 goes " + std::to_string(std::abs(east - west)) +
                  " degrees of longitude, the long way around the globe, as does another side");
  }
  EXPECT_TRUE(read("170", "-170", PolygonEdges::geodesic).facts.remarks.empty());
}

TEST(together, sites_are_points) {
  const TemporaryDirectory folder;
  const std::string table =
      folder.with("sites.csv", "lon,lat,name\n5,5,in\n10,5,border\n11,5,out\n");
  const std::string space = folder.with("sites.xyz", "0 2 0\n-3 0 0\n");
  const std::string box = folder.with(
      "box.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]})");
  const std::array files = {FileName{table, {}}, FileName{space, {}}, FileName{box, {}}};
  const auto tables = read_features_together(files);
  EXPECT_EQ(tables[0].facts.columns.back().text, "inborderout");
  EXPECT_EQ(tables[0].is_located, std::vector<bool>(3, true));
  EXPECT_EQ(tables[1].lines.rows.values, (std::vector<Point>{{0, 1, 0}, {-1, 0, 0}}));
  const Geometries polygon = {tables[2].lines, tables[2].polygons};
  const auto relations = relate({tables[0].lines, tables[0].polygons}, polygon);
  EXPECT_EQ(relations[0].text(), "0FFFFF212");
  EXPECT_EQ(relations[1].text(), "F0FFFF212");
  EXPECT_EQ(relations[2].text(), "FF0FFF212");
  const std::string center = folder.with("center.xyz", "1 0 0\n0 0 0\n");
  EXPECT_EQ(thrown_message<FileError>([&] {
              (void)read_features_together(std::array{FileName{center, {}}});
            }),
            center + ":2: the site is the center");
}

// --- parts in which geometries only meet ---

TEST(together, touching_parts_are_removed) {
  const Ring box = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
  const Ring next = {{10, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 0}};
  const auto sets = converted({of_lines({{{-5, 5}, {5, 5}}, {{-5, 0}, {0, 0}}, {{0, 3}, {0, 7}}}),
                               of_rings({box}), of_rings({next})});
  const GeometryPieces all = overlay_pieces(sets[0], sets[1], SetOperation::intersection);
  EXPECT_EQ(all.first, (std::vector<Index>{0, 1, 2}));
  const GeometryPieces some = without_touching_parts(all, sets[0], sets[1]);
  EXPECT_EQ(some.first, (std::vector<Index>{0, 2}));
  EXPECT_EQ(some.second, (std::vector<Index>{0, 0}));
  EXPECT_EQ(some.pieces.lines.rows.size(), 2U);

  const Geometries border = combine(sets[1], sets[2], SetOperation::intersection);
  EXPECT_EQ(border.lines.rows.size(), 1U);
  EXPECT_TRUE(is_empty(without_touching_parts(border, sets[1], sets[2])));
  const Geometries both = combine(sets[1], sets[2], SetOperation::unite);
  EXPECT_EQ(without_touching_parts(both, sets[1], sets[2]).polygons.corners.size(),
            both.polygons.corners.size());
  EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)without_touching_parts(all, {}, sets[1]); }),
            "a geometry does not exist");
}

// --- files ---

TEST(together, written_geometries_are_read_again) {
  const TemporaryDirectory folder;
  LonLatGeometries given = of_rings({{{175, 0}, {185, 0}, {185, 10}, {175, 10}, {175, 0}}});
  for (const Line& line : std::vector<Line>{{{3, 4}}, {{170, 5}, {190, 5}}, {{1, 1}, {2, 2}}}) {
    given.lines.rows.append(line);
  }
  given.lines.offsets = {0, 1};  // the polygon has a point
  for (int k = 0; k < 2; ++k) {
    given.lines.offsets.push_back(2 + static_cast<std::uint64_t>(k));
    given.polygons.offsets.push_back(1);
  }
  given.lines.end_group();  // nothing
  given.polygons.offsets.push_back(1);
  const Geometries all = converted({given})[0];
  Column names{"name", false, "abcd", {1, 2, 3, 4}};
  const std::string path = folder.file("all.geojson");
  write_geometries({path, {}}, all, {&names, 1}, 1e-6);
  const std::array files = {FileName{path, {}}};
  const FeatureTable table = read_features_together(files, {.tolerance_deg = 1e-6})[0];
  EXPECT_EQ(table.is_located, (std::vector<bool>{true, true, true, false}));
  EXPECT_EQ(table.facts.columns[0].name, "area");
  EXPECT_EQ(table.facts.columns[1].name, "length");
  EXPECT_EQ(table.facts.columns[2].text, "abcd");
  const std::vector<double> before = lengths(all.lines);
  const std::vector<double> after = lengths(table.lines);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(before[i], after[i], 1e-8) << i;
  EXPECT_EQ(after[0], 0);
  EXPECT_EQ(table.lines.rows[0].size(), 1U);
  EXPECT_NEAR(areas(all.polygons)[0], areas(table.polygons)[0], 1e-8);

  Geometries hollow = all;
  hollow.lines.rows.offsets.push_back(hollow.lines.rows.values.size());
  ++hollow.lines.offsets.back();
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              write_geometries({path, {}}, hollow);
            }),
            "the arrays of the lines do not fit together");
}

}  // namespace
}  // namespace rondel::test::of_together
