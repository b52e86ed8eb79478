// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lines of files that a mesh follows: how positions are joined, and sides along which files cut polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_lines.h"
#include "rondel/mesh_size_files.h"
#include "support/temporary_files.h"

namespace rondel::mesh {
namespace {

using FileLines = std::vector<std::vector<Point>>;
using Positions = std::vector<LonLat>;

constexpr double radians_per_degree = std::numbers::pi / 180;

std::string ring(const Positions& positions) {
  std::string text = "[";
  for (const LonLat& p : positions) {
    text += (text.size() > 1 ? ",[" : "[") + std::to_string(p.lon_deg) + "," +
            std::to_string(p.lat_deg) + "]";
  }
  return text + "]";
}
std::string polygon(const Positions& positions) {
  return R"({"type":"Polygon","coordinates":[)" + ring(positions) + "]}";
}
std::string line(const Positions& positions) {
  return R"({"type":"LineString","coordinates":)" + ring(positions) + "}";
}

FileLines read(const std::vector<std::string>& features,
               PolygonEdges edges = PolygonEdges::lonlat) {
  const std::string path = temporary_path("outlines.geojson");
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (std::size_t i = 0; i < features.size(); ++i) {
    text += std::string(i > 0 ? "," : "") + R"({"type":"Feature","properties":{},"geometry":)" +
            features[i] + "}";
  }
  std::ofstream(path) << text << "]}";
  return read_lines({path, {}}, {.edges = edges});
}

// The angle to the nearest place on a line: an end of an arc, or the foot of the perpendicular where it lies between them.
double distance_to_lines(const FileLines& lines, const LonLat& place) {
  const Point p = unit_vector(place);
  double least = 4;
  const auto try_point = [&](const Point& q) {
    least = std::min(least, 2 * std::asin(std::min(1.0, norm(p - q) / 2)));
  };
  for (const std::vector<Point>& one : lines) {
    for (std::size_t k = 0; k < one.size(); ++k) {
      try_point(one[k]);
      if (k == 0) continue;
      const Point n = cross(one[k - 1], one[k]);
      if (!(norm(n) > 0)) continue;
      const Point foot = p - dot(p, n) / dot(n, n) * n;
      if (dot(cross(one[k - 1], foot), n) > 0 && dot(cross(foot, one[k]), n) > 0) {
        try_point(normalized(foot));
      }
    }
  }
  return least / radians_per_degree;
}

double length_in_degrees(const FileLines& lines) {
  double sum = 0;
  for (const std::vector<Point>& one : lines) {
    for (std::size_t k = 1; k < one.size(); ++k)
      sum += 2 * std::asin(norm(one[k] - one[k - 1]) / 2);
  }
  return sum / radians_per_degree;
}

bool is_closed(const std::vector<Point>& one) { return one.front() == one.back(); }

TEST(mesh_outlines, positions_are_joined_as_the_options_say) {
  const Positions parallel = {{-30, 60}, {60, 60}};
  const FileLines straight = read({line(parallel)});
  const FileLines arc = read({line(parallel)}, PolygonEdges::geodesic);
  EXPECT_LT(distance_to_lines(straight, {15, 60}), 1.1e-4);
  // The middle of the arc is at the latitude whose tangent is tan 60 / cos 45.
  const double top =
      std::atan(std::tan(60 * radians_per_degree) / std::cos(45 * radians_per_degree)) /
      radians_per_degree;
  EXPECT_LT(distance_to_lines(arc, {15, top}), 1e-9);
  EXPECT_GT(distance_to_lines(arc, {15, 60}), 7);
  EXPECT_NEAR(length_in_degrees(read({line({{-180, 0}, {180, 0}})})), 360, 1e-6);
}

// The west has a corner on the antimeridian that the east has not.
const Positions western = {{170, -10}, {180, -10}, {180, 3}, {180, 10}, {170, 10}, {170, -10}};
const Positions eastern = {{-180, -10}, {-170, -10}, {-170, 10}, {-180, 10}, {-180, -10}};

TEST(mesh_outlines, two_parts_of_an_island_have_one_coast) {
  for (const FileLines& lines : {read({polygon(western), polygon(eastern)}),
                                 read({R"({"type":"MultiPolygon","coordinates":[[)" +
                                       ring(western) + "],[" + ring(eastern) + "]]}"}),
                                 read({line(western), line(eastern)})}) {
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(is_closed(lines[0]));
    EXPECT_NEAR(distance_to_lines(lines, {180, 0}), 10, 0.2);
    for (const LonLat& place :
         {LonLat{180, 10}, LonLat{175, -10}, LonLat{-170, 5}, LonLat{170, 0}}) {
      EXPECT_LT(distance_to_lines(lines, place), 1.1e-4);
    }
    const double parallel = std::cos(10 * radians_per_degree) * 20;
    EXPECT_NEAR(length_in_degrees(lines), 2 * (20 + parallel), 1e-3);
  }
}

// The part of the antimeridian that only one of them has is a coast.
TEST(mesh_outlines, the_rest_of_a_side_is_a_coast) {
  const Positions longer = {{170, -30}, {180, -30}, {180, 20}, {170, 20}, {170, -30}};
  const FileLines lines = read({polygon(longer), polygon(eastern)});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(is_closed(lines[0]));
  EXPECT_GT(distance_to_lines(lines, {180, 0}), 9);
  EXPECT_EQ(distance_to_lines(lines, {180, -10}), 0);
  EXPECT_LT(distance_to_lines(lines, {180, -20}), 1e-9);
  EXPECT_LT(distance_to_lines(lines, {180, 15}), 1e-9);
}

// A closed line that two islands cut twice, given from each corner of the longer rest.
TEST(mesh_outlines, a_coast_does_not_depend_on_where_its_line_begins) {
  const auto island = [](double south, double north) {
    return polygon({{-180, south}, {-170, south}, {-170, north}, {-180, north}, {-180, south}});
  };
  const Positions corners = {{180, 20}, {180, 30}, {170, 30}, {170, -30}, {180, -30}};
  std::vector<FileLines> found;
  for (std::ptrdiff_t first = 0; first < 5; ++first) {
    Positions closed = corners;
    std::rotate(closed.begin(), closed.begin() + first, closed.end());
    closed.push_back(LonLat(closed.front()));
    found.push_back(read({line(closed), island(-20, -10), island(10, 20)}));
  }
  ASSERT_EQ(found[0].size(), 1U);
  EXPECT_TRUE(is_closed(found[0][0]));
  EXPECT_GT(distance_to_lines(found[0], {180, 15}), 4);
  for (const FileLines& one : found) EXPECT_EQ(one, found[0]);
}

TEST(mesh_outlines, a_side_that_nothing_continues_is_a_coast) {
  const FileLines lines = read({polygon(western)});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_LT(distance_to_lines(lines, {180, 0}), 1e-9);
  const FileLines date_line = read({line({{180, -60}, {180, 60}})});
  EXPECT_LT(distance_to_lines(date_line, {180, 33}), 1e-9);
  EXPECT_NEAR(length_in_degrees(date_line), 120, 1e-9);
}

// A cap that a file leads to the pole along the antimeridian, with other corners on the way back: as one feature, as two
// halves, and as a closed line.
TEST(mesh_outlines, nothing_leads_to_the_pole) {
  const Positions whole = {{-180, -90}, {-180, -75}, {-90, -70}, {0, -75},   {90, -65},
                           {180, -75},  {180, -80},  {180, -85}, {180, -90}, {-180, -90}};
  const Positions west = {{-180, -90}, {-180, -75}, {-90, -70}, {0, -75}, {0, -90}, {-180, -90}};
  const Positions east = {{0, -90}, {0, -75}, {90, -65}, {180, -75}, {180, -90}, {0, -90}};
  const FileLines lines = read({polygon(whole)});
  for (const FileLines& found : {lines, read({line(whole)})}) {
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(is_closed(found[0]));
    EXPECT_GT(distance_to_lines(found, {0, -90}), 14);
    EXPECT_GT(distance_to_lines(found, {180, -82}), 6);
    EXPECT_LT(distance_to_lines(found, {45, -70}), 1.1e-4);
  }
  // The cut at longitude 0 is not one that all maps have.
  const FileLines halves = read({polygon(west), polygon(east)});
  EXPECT_GT(distance_to_lines(halves, {180, -82}), 6);
  EXPECT_LT(distance_to_lines(halves, {0, -82}), 1e-9);
}

TEST(mesh_outlines, points_and_islands_elsewhere_stay) {
  const std::string path = temporary_path("outlines.geojson");
  const FileLines lines = read({polygon(western), polygon(eastern), line({{0, 0}, {5, 5}}),
                                polygon({{20, 20}, {30, 20}, {25, 30}, {20, 20}}),
                                R"({"type":"Point","coordinates":[50,-40]})"});
  EXPECT_EQ(lines.size(), 3U);
  const std::vector<Point> points = read_refinement({path, {}}, 0.01);
  EXPECT_TRUE(std::ranges::any_of(points, [](const Point& p) {
    return p == unit_vector(LonLat{50, -40});
  }));
  const FileLines places = read_places({path, {}});
  EXPECT_EQ(places.size(), 4U);
  EXPECT_EQ(std::ranges::count(places, std::vector<Point>{unit_vector(LonLat{50, -40})}), 1);
  for (const std::vector<Point>& one : lines) EXPECT_EQ(std::ranges::count(places, one), 1);
  EXPECT_THROW((void)read_lines({path, {}}, {.tolerance_deg = 0}), InvalidInput);
  EXPECT_THROW((void)read_places({path, {}}, {.tolerance_deg = 0}), InvalidInput);
}

}  // namespace
}  // namespace rondel::mesh
