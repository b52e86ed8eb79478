// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "meshing/scvt_levels.h"
#include "meshing/size_raster.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_size.h"
#include "rondel/mesh_size_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::mesh {
namespace {

constexpr double pi = std::numbers::pi;

double angle(const Point& p, const Point& q) {
  return std::acos(std::clamp(p.x * q.x + p.y * q.y + p.z * q.z, -1.0, 1.0));
}

const std::vector<Point>& places() {
  static const std::vector<Point> made = sampled_sites(5000, nullptr, 1);
  return made;
}

TEST(mesh_size, constant_spacing_counts_hexagons) {
  const SizeFunction size = SizeFunction::constant(0.01, 16);
  EXPECT_NEAR(size.count(), 4 * pi / (std::sqrt(3.0) / 2 * 1e-4), 1);
  for (const Point& p : places()) {
    EXPECT_EQ(size.spacing(p), 0.01);
    EXPECT_EQ(size.density(p), 1);
  }
}

TEST(mesh_size, function_is_met_at_nodes_and_between_them) {
  const auto wanted = [](const Point& p) { return 0.02 + 0.01 * p.z; };
  const SizeFunction size = SizeFunction::from_function(
      [&](std::span<const Point> at, std::span<double> out) {
        for (std::size_t i = 0; i < at.size(); ++i) out[i] = wanted(at[i]);
      },
      256);
  EXPECT_EQ(size.smallest(), 0.01);
  for (const Point& p : places()) {
    EXPECT_NEAR(size.spacing(p), wanted(p), 1e-6);
    EXPECT_NEAR(size.density(p), std::pow(0.01 / wanted(p), 4), 1e-4);
  }
  // The integral of 1 / (a + b z)^2 over the sphere is 4 pi / (a^2 - b^2).
  EXPECT_NEAR(size.count() * (std::sqrt(3.0) / 2) / (4 * pi / 3e-4), 1, 1e-4);
}

TEST(mesh_size, grid_of_any_direction_goes_around) {
  std::vector<double> lon;
  std::vector<double> lat;
  // The last step goes from 85 to 90 degrees west, where x changes most.
  for (int i = 0; i < 72; ++i) lon.push_back(5.0 * i - 90);
  for (int j = 0; j <= 36; ++j) lat.push_back(90 - 5.0 * j);
  std::vector<double> values;
  for (const double y : lat) {
    for (const double x : lon) {
      const Point p = unit_vector(LonLat{x, y});
      values.push_back(0.02 + 0.005 * p.x);
    }
  }
  const SizeFunction size = SizeFunction::from_grid(lon, lat, values, 256);
  for (const Point& p : places()) EXPECT_NEAR(size.spacing(p), 0.02 + 0.005 * p.x, 3e-5);
}

TEST(mesh_size, refinement_grows_with_the_distance_of_a_line) {
  const std::vector<Point> equator = densified(
      unit_vectors(std::vector<LonLat>{{-170, 0}, {-80, 0}, {10, 0}, {100, 0}, {-170, 0}}), 0.002);
  const SizeFunction size = SizeFunction::constant(0.1, 256).refined(equator, 0.01, 0.1);
  for (const Point& p : places()) {
    EXPECT_NEAR(size.spacing(p), std::min(0.1, 0.01 + 0.1 * std::abs(std::asin(p.z))), 6e-4);
  }
}

// Lines, closed outlines and points, each neighbor in a line nearer than the distance.
TEST(mesh_size, refinement_follows_lines_and_outlines) {
  const std::string path = temporary_path("refinement.geojson");
  const auto read = [&](const std::string& geometries) {
    std::ofstream(path) << R"({"type":"GeometryCollection","geometries":[)" << geometries << "]}";
    return read_refinement({path, {}}, 0.01);
  };
  const std::string line = R"({"type":"LineString","coordinates":[[100,0],[110,0]]})";
  const std::string box =
      R"({"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]})";
  const std::string point = R"({"type":"Point","coordinates":[50,80]})";
  const std::vector<Point> points = read(box + ',' + line + ',' + point);
  EXPECT_EQ(points.size(), read(box).size() + read(line).size() + 1);
  for (const LonLat& place : {LonLat{5, 0}, LonLat{0, 5}, LonLat{105, 0}, LonLat{50, 80}}) {
    EXPECT_TRUE(std::ranges::any_of(
        points, [&](const Point& p) { return angle(p, unit_vector(place)) <= 0.005 + 1e-9; }));
  }
  EXPECT_EQ(test::thrown_message<FileError>(
                [&] { return read(line + R"(,{"type":"LineString","coordinates":[[1,2]]})"); }),
            path + ":1: geometry 1: a line of 1 positions");
}

TEST(mesh_size, limited_spacing_grows_slowly_and_is_lowered_no_more_than_that) {
  const Point middle = unit_vector(LonLat{45, 35});  // near a corner of the cube
  const SizeFunction steep = SizeFunction::from_function(
      [&](std::span<const Point> at, std::span<double> out) {
        for (std::size_t i = 0; i < at.size(); ++i)
          out[i] = angle(at[i], middle) < 0.2 ? 0.01 : 0.2;
      },
      128);
  const SizeFunction gentle = steep.limited(0.1);
  EXPECT_EQ(gentle.smallest(), steep.smallest());
  for (const Point& p : places()) {
    const double distance = std::max(0.0, angle(p, middle) - 0.2);
    const double wanted = std::min(0.2, 0.01 + 0.1 * distance);
    EXPECT_GE(gentle.spacing(p), wanted - 0.003);
    EXPECT_LE(gentle.spacing(p), 1.03 * wanted + 0.003);
  }
}

// Where faces of the cube meet, a place belongs to several of them, at the first or the last of their nodes.
TEST(mesh_size, edges_of_the_cube_are_no_seams) {
  const SizeFunction size = SizeFunction::from_function(
      [](std::span<const Point> at, std::span<double> out) {
        for (std::size_t i = 0; i < at.size(); ++i)
          out[i] = 0.02 + 0.005 * at[i].x + 0.003 * at[i].y;
      },
      64);
  for (const double along : {-1.0, -0.37, 0.0, 0.6, 1.0}) {
    for (const double sign : {-1.0, 1.0}) {
      for (const double other : {-1.0, 1.0}) {
        for (const Point& p :
             {Point{sign, other, along}, Point{along, sign, other}, Point{other, along, sign}}) {
          const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
          EXPECT_NEAR(size.spacing(p), 0.02 + (0.005 * p.x + 0.003 * p.y) / length, 1e-5);
        }
      }
    }
  }
}

// All that surrounds a place is held against it, also across the edges of the cube.
TEST(mesh_size, limited_spacing_grows_slowly_everywhere) {
  for (const Point& middle :
       {Point{1, 0.99, 0.1}, Point{1, -0.99, -0.4}, Point{-0.98, 0.2, -1}, Point{0.9, -1, 0.97}}) {
    const Point center =
        unit_vector(LonLat{std::atan2(middle.y, middle.x) * 180 / pi,
                           std::atan2(middle.z, std::hypot(middle.x, middle.y)) * 180 / pi});
    const SizeFunction steep = SizeFunction::from_function(
        [&](std::span<const Point> at, std::span<double> out) {
          for (std::size_t i = 0; i < at.size(); ++i)
            out[i] = angle(at[i], center) < 0.05 ? 0.01 : 0.2;
        },
        64);
    const SizeFunction gentle = steep.limited(0.2);
    for (const Point& p : places()) {
      const double wanted = std::min(0.2, 0.01 + 0.2 * std::max(0.0, angle(p, center) - 0.05));
      EXPECT_LE(gentle.spacing(p), 1.04 * wanted + 0.012);
      EXPECT_GE(gentle.spacing(p), wanted - 0.012);
    }
  }
}

// Also where numbers are so small or large that quotients or squares of them are none.
TEST(mesh_size, spacing_depends_on_the_direction_alone) {
  const auto wanted = [](const Point& p) { return 0.02 + 0.01 * p.y + 0.005 * p.x; };
  const auto values = [&](std::span<const Point> at, std::span<double> out) {
    for (std::size_t i = 0; i < at.size(); ++i) out[i] = wanted(at[i]);
  };
  const SizeRegion region{{0, -1, 0}, 0.7, 0.7};
  const SizeFunction of_region = SizeFunction::from_function(values, SizeRaster{region, 16});
  const SizeFunction of_sphere = SizeFunction::from_function(values, 16);
  for (const Point& way : {Point{0, -1, 0}, Point{0.25, -1, 0.5}, Point{-0.5, -1, 0}}) {
    for (const double length : {0x1p-1070, 0x1p-1040, 0x1p-600, 1.0, 3.0, 0x1p520, 0x1.8p1023}) {
      const Point place = length * way;
      for (const SizeFunction* size : {&of_region, &of_sphere}) {
        EXPECT_NEAR(size->spacing(place), size->spacing(way), 1e-15) << length;
        EXPECT_NEAR(size->density(place), size->density(way), 1e-12) << length;
      }
      EXPECT_TRUE(region.contains(place));
      EXPECT_FALSE(region.contains({-place.x, -place.y, -place.z}));
    }
  }
}

// Four nodes are around each place of the cube's surface, also where a face ends; both coordinates give the place back.
TEST(mesh_size, places_are_among_nodes_of_their_face) {
  const CubeRaster cube{8};
  constexpr std::size_t side = 33;
  for (std::size_t node = 0; node < 6 * side * side; ++node) {
    const auto p =
        CubeRaster{side - 1}.on_cube(node / (side * side), node % side, node / side % side);
    const RasterPlace found = cube.spot({p[0], p[1], p[2]});
    ASSERT_LT(found.i, cube.steps);
    ASSERT_LT(found.j, cube.steps);
    const auto at = cube.on_cube(found.face, found.i, found.j);
    const std::size_t axis = found.face / 2;
    EXPECT_EQ(p[axis], at[axis]);
    EXPECT_EQ(p[(axis + 1) % 3], at[(axis + 1) % 3] + found.s / 4);
    EXPECT_EQ(p[(axis + 2) % 3], at[(axis + 2) % 3] + found.t / 4);
  }
}

TEST(mesh_size, of_nodes_is_that_of_a_function) {
  const std::vector<Point> nodes = SizeFunction::nodes(8);
  std::vector<double> spacings;
  for (const Point& p : nodes) spacings.push_back(0.1 + 0.05 * p.z);
  const SizeFunction size = SizeFunction::from_nodes(spacings, 8);
  const SizeFunction same = SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.1 + 0.05 * places[i].z;
      },
      8);
  for (const Point& p : places()) EXPECT_EQ(size.spacing(p), same.spacing(p));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_NEAR(size.spacing(nodes[i]), spacings[i], 1e-6) << i;
  }
  EXPECT_THROW((void)SizeFunction::from_nodes({0.1, 0.2}, 8), InvalidInput);
  EXPECT_THROW((void)SizeFunction::nodes(3), InvalidInput);
}

TEST(mesh_size, for_a_count_has_that_many_sites) {
  const SizeFunction size = SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.1 + 0.05 * places[i].z;
      },
      8);
  for (const std::size_t count : {100U, 12345U}) {
    const SizeFunction scaled = size.for_count(count);
    EXPECT_NEAR(scaled.count() / static_cast<double>(count), 1, 1e-12);
    EXPECT_NEAR(scaled.largest() / scaled.smallest(), size.largest() / size.smallest(), 1e-12);
    EXPECT_NEAR(SizeFunction::of_count(count).count() / static_cast<double>(count), 1, 1e-2);
  }
  EXPECT_THROW((void)size.for_count(0), InvalidInput);
  EXPECT_THROW((void)SizeFunction::of_count(0), InvalidInput);
}

TEST(mesh_size, what_is_no_size_is_refused) {
  EXPECT_THROW(SizeFunction::constant(0), InvalidInput);
  EXPECT_THROW(SizeFunction::constant(std::nan("")), InvalidInput);
  EXPECT_THROW(SizeFunction::constant(0.1, 100), InvalidInput);
  const SizeFunction size = SizeFunction::constant(0.1, 8);
  EXPECT_THROW((void)size.limited(-1), InvalidInput);
  EXPECT_THROW((void)size.scaled(100), InvalidInput);
  EXPECT_THROW((void)size.refined({}, 0.1, 0.1), InvalidInput);
  EXPECT_THROW((void)size.refined(places(), 0, 0.1), InvalidInput);
  EXPECT_THROW((void)densified(places(), 0), InvalidInput);
  EXPECT_THROW((void)densified(std::vector<Point>{{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}}, 0.1),
               InvalidInput);
  const std::vector<double> axis = {0, 1};
  EXPECT_THROW(SizeFunction::from_grid(axis, axis, axis), InvalidInput);
  const std::vector<double> twice = {1, 1};
  const std::vector<double> four(4, 0.1);
  EXPECT_THROW(SizeFunction::from_grid(twice, axis, four), InvalidInput);
  EXPECT_THROW(SizeFunction::from_grid(axis, twice, four), InvalidInput);
}

}  // namespace
}  // namespace rondel::mesh
