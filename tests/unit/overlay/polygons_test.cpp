// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of GeoJSON as cells: areas between parallels and meridians are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr double one_degree = std::numbers::pi / 180;

std::string written(const std::string& text) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::string path = temporary_path("polygons_") + test + ".geojson";
  std::ofstream(path) << text;
  return path;
}

CellTable table_of(const std::string& geometry, const PolygonOptions& options = {}) {
  return read_polygons(written(geometry), options);
}

// [[w,s],[e,s],[e,n],[w,n],[w,s]]
std::string ring_of_box(double w, double s, double e, double n) {
  const auto position = [](double lon, double lat) {
    return "[" + std::to_string(lon) + "," + std::to_string(lat) + "]";
  };
  return "[" + position(w, s) + "," + position(e, s) + "," + position(e, n) + "," + position(w, n) +
         "," + position(w, s) + "]";
}
std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}
double area_of_box(double w, double s, double e, double n) {
  return (e - w) * one_degree * (std::sin(n * one_degree) - std::sin(s * one_degree));
}

std::size_t num_rings(const CellTable& table) { return table.cells.rings.size() - 1; }

TEST(overlay_polygons, sides_are_parallels) {
  const CellTable table = table_of(polygon(ring_of_box(10, 40, 50, 60)));
  ASSERT_EQ(table.cells.num_cells(), 1U);
  EXPECT_NEAR(areas(table.cells)[0], area_of_box(10, 40, 50, 60), 2e-6);
  const CellTable fine = table_of(polygon(ring_of_box(10, 40, 50, 60)), {.tolerance_deg = 1e-7});
  EXPECT_NEAR(areas(fine.cells)[0], area_of_box(10, 40, 50, 60), 2e-9);
}

// Green's theorem: the integral of sin(lat) by the longitude, along straight sides.
double area_of_triangle(const std::array<LonLat, 3>& corners) {
  double area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const LonLat& p = corners[i];
    const LonLat& q = corners[(i + 1) % 3];
    const double low = p.lat_deg * one_degree;
    const double high = q.lat_deg * one_degree;
    const double mean =
        low == high ? std::sin(low) : (std::cos(low) - std::cos(high)) / (high - low);
    area -= (q.lon_deg - p.lon_deg) * one_degree * mean;
  }
  return std::abs(area);
}

// An arc across the equator bends both ways, and may meet the straight line in its middle.
TEST(overlay_polygons, sides_across_the_equator_are_straight) {
  Random random(61);
  for (int k = 0; k < 200; ++k) {
    std::array<LonLat, 3> corners;
    std::string ring;
    for (LonLat& p : corners) {
      p = {10.0 * static_cast<double>(random.below(19)) - 90,
           10.0 * static_cast<double>(random.below(17)) - 80};
      ring += "[" + std::to_string(p.lon_deg) + "," + std::to_string(p.lat_deg) + "],";
    }
    const auto& [a, b, c] = corners;
    const double doubled = (b.lon_deg - a.lon_deg) * (c.lat_deg - a.lat_deg) -
                           (c.lon_deg - a.lon_deg) * (b.lat_deg - a.lat_deg);
    if (doubled == 0) continue;
    SCOPED_TRACE(ring);
    ring += "[" + std::to_string(a.lon_deg) + "," + std::to_string(a.lat_deg) + "]";
    const CellTable table = table_of(polygon("[" + ring + "]"));
    ASSERT_EQ(table.cells.num_cells(), 1U);
    EXPECT_NEAR(areas(table.cells)[0], area_of_triangle(corners), 2e-5);
  }
}

// Why a polygon with this ring is refused; empty if it is not.
std::string refusal_of_ring(const std::string& ring) {
  return thrown_message<FileError>([&] { return table_of(polygon(ring)); });
}

TEST(overlay_polygons, rings_around_a_pole_have_to_be_led_there) {
  const auto names = [&](const std::string& ring, const std::string& side) {
    return refusal_of_ring(ring).find(side + " spans more than 180 degrees of longitude") !=
           std::string::npos;
  };
  EXPECT_TRUE(names("[[-160,-60],[-80,-62],[0,-61],[80,-62],[160,-60],[-160,-60]]",
                    "ring 0 of part 0: its side from 160 -60 to -160 -60"));
  EXPECT_TRUE(names("[[0,50],[90,51],[180,52],[270,51],[0,50]]", "side from 270 51 to 0 50"));
  EXPECT_TRUE(names("[[0,50],[90,50],[180,50],[270,50],[0,50]]", "side from 270 50 to 0 50"));
  EXPECT_TRUE(
      names(ring_of_box(-180, -90, 180, 90) + ",[[-170,70],[-60,75],[60,70],[170,75],[-170,70]]",
            "ring 1 of part 0: its side from 170 75 to -170 70"));
  // Led along the edge of the map, boxes, a side that is divided, both sides of the equator.
  for (const std::string& ring :
       {std::string("[[-180,60],[0,50],[180,60],[180,90],[-180,90],[-180,60]]"),
        ring_of_box(-170, 20, 170, 40), ring_of_box(-180, 60, 180, 90),
        std::string("[[0,50],[90,51],[180,52],[270,51],[135,50],[0,50]]"),
        std::string("[[0,40],[100,35],[200,40],[200,70],[0,70],[0,40]]"),
        std::string("[[-100,-10],[100,-10],[0,40],[-100,-10]]")}) {
    EXPECT_EQ(refusal_of_ring(ring), "");
  }
}

TEST(overlay_polygons, parts_a_turn_of_the_globe_apart_are_on_one_place) {
  const auto parts = [](const std::string& first, const std::string& second) {
    return R"({"type":"MultiPolygon","coordinates":[[)" + first + "],[" + second + "]]}";
  };
  for (const std::string& geometry :
       {parts(ring_of_box(10, 10, 20, 20), ring_of_box(370, 10, 380, 20)),
        parts(ring_of_box(170, 0, 190, 10), ring_of_box(-180, 5, -175, 20))}) {
    try {
      (void)table_of(geometry);
      ADD_FAILURE() << geometry;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("feature 0: the polygon crosses or overlaps itself"),
                std::string::npos)
          << error.what();
    }
  }
  const CellTable apart =
      table_of(parts(ring_of_box(170, 0, 190, 10), ring_of_box(-170, 0, -160, 10)));
  EXPECT_NEAR(areas(apart.cells)[0], area_of_box(170, 0, 200, 10), 1e-6);
}

TEST(overlay_polygons, features_that_are_not_taken_take_no_space) {
  const std::string file = written(
      R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"a":null},"geometry":)" +
      polygon(ring_of_box(0, 0, 10, 10)) + R"(},
{"type":"Feature","properties":{"a":"b"},"geometry":)" +
      polygon(ring_of_box(5, 0, 15, 10)) + "}]}");
  PolygonOptions options{.overlap = PolygonOverlap::error};
  EXPECT_THROW((void)read_polygons(file, options), FileError);
  options.is_taken = [](std::size_t feature, std::span<const Column> columns) {
    return columns.front().ends[feature] > 0;
  };
  for (const PolygonOverlap overlap : {PolygonOverlap::error, PolygonOverlap::first}) {
    options.overlap = overlap;
    const CellTable table = read_polygons(file, options);
    EXPECT_EQ(areas(table.cells)[0], 0);
    EXPECT_NEAR(areas(table.cells)[1], area_of_box(5, 0, 15, 10), 1e-6);
  }
}

TEST(overlay_polygons, sides_are_geodesics_if_asked_for) {
  const CellTable table =
      table_of(polygon(ring_of_box(170, -10, 190, 10)), {.edges = PolygonEdges::geodesic});
  EXPECT_EQ(table.cells.corners.size(), 4U);
  EXPECT_GT(areas(table.cells)[0], area_of_box(170, -10, 190, 10) + 1e-4);
  const CellTable across = table_of(polygon("[[170,-10],[-170,-10],[-170,10],[170,10],[170,-10]]"),
                                    {.edges = PolygonEdges::geodesic});
  EXPECT_EQ(across.cells.corners, table.cells.corners);
  EXPECT_TRUE(across.cells.points == table.cells.points);
}

// A comb, whose corners go west and east again: any corner may be the first one, and either direction is taken.
TEST(overlay_polygons, geodesics_may_begin_anywhere_and_go_either_way) {
  std::vector<LonLat> comb = {{30, -20}, {30, 25}};
  for (int tooth = 0; tooth < 4; ++tooth) {
    const double lon = 20 - 15 * tooth;
    comb.insert(comb.end(), {{lon, 25}, {lon - 2, -10.0 - tooth}, {lon - 7, 20}});
  }
  comb.insert(comb.end(), {{-60, 25}, {-70, 0}, {-55, -20}});
  // The sum of the triangles that each side makes with a place, by the formula of l'Huilier.
  const auto distance = [](const LonLat& p, const LonLat& q) {
    const double sum = std::sin(p.lat_deg * one_degree) * std::sin(q.lat_deg * one_degree) +
                       std::cos(p.lat_deg * one_degree) * std::cos(q.lat_deg * one_degree) *
                           std::cos((p.lon_deg - q.lon_deg) * one_degree);
    return std::acos(std::clamp(sum, -1.0, 1.0));
  };
  double expected = 0;
  const LonLat place{-17, 3};
  const std::vector<Point> points = unit_vectors(comb);
  const Point origin = unit_vectors(std::vector{place})[0];
  for (std::size_t k = 0; k < comb.size(); ++k) {
    const std::size_t next = (k + 1) % comb.size();
    const double a = distance(place, comb[k]);
    const double b = distance(comb[k], comb[next]);
    const double c = distance(comb[next], place);
    const double half = (a + b + c) / 2;
    const double product = std::tan(half / 2) * std::tan((half - a) / 2) *
                           std::tan((half - b) / 2) * std::tan((half - c) / 2);
    const double area = 4 * std::atan(std::sqrt(std::max(product, 0.0)));
    const Point normal = cross(points[k], points[next]);
    expected += dot(origin, normal) > 0 ? area : -area;
  }
  for (const bool is_reversed : {false, true}) {
    std::vector<LonLat> corners = comb;
    if (is_reversed) std::ranges::reverse(corners);
    for (std::size_t first = 0; first < comb.size(); ++first) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      std::string ring;
      for (std::size_t k = 0; k <= corners.size(); ++k) {
        const LonLat& p = corners[k % corners.size()];
        ring += (k == 0 ? "[" : ",[") + std::to_string(p.lon_deg) + "," +
                std::to_string(p.lat_deg) + "]";
      }
      const CellTable table =
          table_of(polygon("[" + ring + "]"), {.edges = PolygonEdges::geodesic});
      EXPECT_NEAR(areas(table.cells)[0], std::abs(expected), 1e-9) << is_reversed << first;
    }
  }
}

TEST(overlay_polygons, holes_and_directions) {
  const std::string outer = ring_of_box(0, 0, 30, 30);
  const std::string hole = ring_of_box(10, 10, 20, 20);
  const CellTable table = table_of(polygon(outer + "," + hole));
  EXPECT_EQ(num_rings(table), 2U);
  EXPECT_NEAR(areas(table.cells)[0], area_of_box(0, 0, 30, 30) - area_of_box(10, 10, 20, 20), 3e-6);
  const CellTable turned = table_of(polygon("[[0,0],[0,30],[30,30],[30,0],[0,0]]," + hole));
  EXPECT_EQ(turned.cells.corners, table.cells.corners);
  EXPECT_TRUE(turned.cells.points == table.cells.points);
}

TEST(overlay_polygons, what_the_antimeridian_cuts_is_whole_again) {
  const CellTable table =
      table_of(R"({"type":"MultiPolygon","coordinates":[[)" + ring_of_box(170, -20, 180, 20) +
               "],[" + ring_of_box(-180, -20, -170, 20) + "]]}");
  EXPECT_EQ(num_rings(table), 1U);
  EXPECT_NEAR(areas(table.cells)[0], area_of_box(170, -20, 190, 20), 3e-6);
}

TEST(overlay_polygons, poles_are_points) {
  // A cap around the south pole, as maps have it.
  const CellTable cap = table_of(polygon(ring_of_box(-180, -90, 180, -70)));
  EXPECT_EQ(num_rings(cap), 1U);
  EXPECT_NEAR(areas(cap.cells)[0], area_of_box(-180, -90, 180, -70), 3e-6);
  // All but that.
  const CellTable rest = table_of(polygon(ring_of_box(-180, -70, 180, 90)));
  EXPECT_EQ(num_rings(rest), 1U);
  EXPECT_NEAR(areas(rest.cells)[0], area_of_box(-180, -70, 180, 90), 3e-6);
  const CellTable belt = table_of(polygon(ring_of_box(-180, -10, 180, 10)));
  EXPECT_EQ(num_rings(belt), 2U);
  EXPECT_NEAR(areas(belt.cells)[0], area_of_box(-180, -10, 180, 10), 1e-5);
}

TEST(overlay_polygons, neighbors_share_corners) {
  const std::string features = R"({"type":"FeatureCollection","features":[)"
                               R"({"type":"Feature","properties":{"name":"a","n":1},"geometry":)" +
                               polygon(ring_of_box(0, 0, 40, 50)) +
                               R"(},{"type":"Feature","properties":{"name":"b"},"geometry":)" +
                               polygon(ring_of_box(0, 50, 40, 60)) +
                               R"(},{"type":"Feature","properties":null,"geometry":null}]})";
  const CellTable table = table_of(features);
  ASSERT_EQ(table.cells.num_cells(), 3U);
  EXPECT_EQ(table.cells.cells[2], table.cells.cells[3]);
  const CellRings joined = dissolve(table.cells, std::vector<Index>{0, 0, no_index}, 1);
  EXPECT_EQ(joined.rings.size(), 2U);
  EXPECT_NEAR(areas(joined)[0], area_of_box(0, 0, 40, 60), 1e-5);
  ASSERT_EQ(table.facts.columns.size(), 2U);
  EXPECT_EQ(table.facts.columns[0].name, "name");
  EXPECT_EQ(table.facts.columns[0].text, "ab");
  EXPECT_EQ(table.facts.columns[1].ends, (std::vector<std::uint64_t>{1, 1, 1}));
}

// A corner of one neighbor alone becomes one of both, next to the antimeridian and a turn of the globe away, too.
TEST(overlay_polygons, neighbors_share_corners_everywhere) {
  for (const double west :
       {-360.0, -200.0, -190.0, -180.5, -180.0, -90.0, 0.0, 120.0, 170.0, 179.5, 180.0, 350.0}) {
    for (const double off : {0.3, 5.0, 19.7}) {
      const auto position = [&](double lon, double lat) {
        return "[" + std::to_string(lon) + "," + std::to_string(lat) + "]";
      };
      const double turn = west > 0 ? -360 : 360;
      const std::string low = ring_of_box(west, 0, west + 20, 50);
      const std::string high =
          "[" + position(west + turn, 50) + "," + position(west + turn + off, 50) + "," +
          position(west + turn + 20, 50) + "," + position(west + turn + 20, 60) + "," +
          position(west + turn, 60) + "," + position(west + turn, 50) + "]";
      const CellTable table = table_of(R"({"type":"GeometryCollection","geometries":[)" +
                                       polygon(low) + "," + polygon(high) + "]}");
      const CellRings joined =
          dissolve(table.cells, std::vector<Index>(table.cells.num_cells(), 0), 1);
      EXPECT_EQ(joined.rings.size(), 2U) << west << ' ' << off;
      EXPECT_NEAR(areas(joined)[0], area_of_box(0, 0, 20, 60), 1e-5) << west << ' ' << off;
    }
  }
}

TEST(overlay_polygons, cells_are_clipped_to_them) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 500, 2));
  const CellTable table = table_of(polygon(ring_of_box(150, -60, 200, 70)));
  const CellRings clipped = clip(cells, CellSet::polygons(table.cells));
  double sum = 0;
  for (const double area : areas(clipped)) sum += area;
  EXPECT_NEAR(sum, areas(table.cells)[0], 1e-13);
}

std::string message_of(const std::string& text) {
  try {
    (void)table_of(text);
  } catch (const FileError& error) {
    const std::string message = error.what();
    return message.substr(message.rfind("geojson:") + 8);
  }
  return "";
}

TEST(overlay_polygons, longitudes_are_up_to_ten_turns_away) {
  const double whole_turns = 3600;
  const CellTable table = table_of(polygon(ring_of_box(whole_turns - 10, 0, whole_turns, 5)));
  EXPECT_NEAR(areas(table.cells)[0], area_of_box(0, 0, 10, 5), 1e-5);
  EXPECT_THROW((void)table_of(polygon(ring_of_box(whole_turns - 10, 0, whole_turns + 1e-3, 5))),
               FileError);
}

// A side along a pole is as long as the ring has longitudes there, and asks for no advice.
TEST(overlay_polygons, advice_is_about_sides_across_the_map) {
  const std::string crossing = refusal_of_ring(
      "[[-180,90],[180,90],[180,10],[90,50],[100,20],[110,50],[80,30],[-90,30],[-180,10],[-180,90]"
      "]");
  EXPECT_NE(crossing.find("crosses itself"), std::string::npos) << crossing;
  EXPECT_EQ(crossing.find("crosses the map"), std::string::npos) << crossing;
}

TEST(overlay_polygons, collections_are_nested_as_deep_as_the_text_may_be) {
  std::string geometry = polygon(ring_of_box(10, 40, 50, 60));
  for (int k = 0; k < 40; ++k) {
    geometry = R"({"type":"GeometryCollection","geometries":[)" + geometry + "]}";
  }
  const CellTable table = table_of(geometry);
  ASSERT_EQ(table.cells.num_cells(), 1U);
  EXPECT_NEAR(areas(table.cells)[0], area_of_box(10, 40, 50, 60), 2e-6);
}

TEST(overlay_polygons, messages_say_where) {
  EXPECT_EQ(message_of(R"({"type":"Point","coordinates":[1,2]})"),
            R"(1: type "Point" where a Polygon is needed)");
  EXPECT_EQ(message_of(polygon("[[0,0],[1,1],[0,0]]")), "1: a ring of 3 positions");
  EXPECT_EQ(message_of(polygon("[[0,0],[1,1],[0,1],[0,2]]")),
            "1: a ring that is not closed, from 0 0 to 0 2; --invalid repair (invalid='repair' in "
            "Python) closes it");
  EXPECT_EQ(message_of("{\"type\":\"FeatureCollection\",\"features\":[\n"
                       R"({"type":"Feature","geometry":)" +
                       polygon("[[0,0],[1,91],[0,1],[0,0]]") + "}]}"),
            "2: feature 0: coordinates \"[1,91]\": latitude 91 is outside [-90, 90]");
  EXPECT_EQ(message_of(polygon("[[0,0],[1,1],[0,-95],[0,0]]")),
            "1: coordinates \"[0,-95]\": latitude -95 is outside [-90, 90]");
  const std::string ring = polygon("[[0,0],[1,1],[0,1],[0,0]]");
  EXPECT_EQ(message_of(ring + std::string(1, '\0') + ring),
            "1: not JSON: a byte 0 at position " + std::to_string(ring.size()) + " of the file");
  EXPECT_EQ(message_of(""), " the file is empty");
  EXPECT_THROW((void)table_of("{}", {.tolerance_deg = 0}), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
