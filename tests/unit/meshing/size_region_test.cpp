// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Spacings on a region are compared with formulas at random places, and regions of areas with the
// places that they have to have.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/mesh_size.h"
#include "rondel/mesh_size_files.h"
#include "rondel/mesh_triangles.h"
#include "rondel/scvt.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/meshing/domains.h"

namespace rondel::mesh {
namespace {

constexpr double radians = std::numbers::pi / 180;  // in a degree

// The angle between two places, also for those that are a few micrometers apart.
double apart(const Point& p, const Point& q) {
  const double x = p.y * q.z - p.z * q.y;
  const double y = p.z * q.x - p.x * q.z;
  const double z = p.x * q.y - p.y * q.x;
  return std::atan2(std::hypot(x, y, z), p.x * q.x + p.y * q.y + p.z * q.z);
}

SizeRegion region_at(double lon, double lat, double width_deg, double height_deg) {
  return {unit_vector(LonLat{lon, lat}), width_deg / 2 * radians, height_deg / 2 * radians};
}

// Random places of a region, computed from its longitudes and latitudes as they are named at the
// equator, and turned to its center.
std::vector<Point> places_in(const SizeRegion& region, std::size_t number) {
  const Point& c = region.center;
  const double lon = std::atan2(c.y, c.x);
  const double lat = std::asin(c.z);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<Point> places;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = share(random) * std::tan(region.half_width);
    const double y = share(random) * std::tan(region.half_height);
    const double length = std::sqrt(1 + x * x + y * y);
    // First around the axis of longitude 90 degrees, then around that of the poles.
    const double a = std::cos(lat) - std::sin(lat) * y;
    const double z = std::sin(lat) + std::cos(lat) * y;
    places.push_back({(std::cos(lon) * a - std::sin(lon) * x) / length,
                      (std::sin(lon) * a + std::cos(lon) * x) / length, z / length});
  }
  return places;
}

SizeFunction::Block block_of(double (*wanted)(const Point&)) {
  return [wanted](std::span<const Point> at, std::span<double> out) {
    std::ranges::transform(at, out.begin(), wanted);
  };
}

TEST(size_region, has_what_is_in_its_rectangle) {
  for (const double lat : {0.0, 47.0, -89.9, 90.0}) {
    const SizeRegion region = region_at(179.5, lat, 4, 1);
    for (const Point& p : places_in(region, 500)) EXPECT_TRUE(region.contains(p));
    SizeRegion wider = region;
    wider.half_width *= 2;
    wider.half_height *= 2;
    std::size_t inside = 0;
    for (const Point& p : places_in(wider, 4000)) inside += region.contains(p) ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(inside), 1000, 120);
    const Point& c = region.center;
    EXPECT_TRUE(region.contains(c));
    EXPECT_FALSE(region.contains({-c.x, -c.y, -c.z}));
    EXPECT_FALSE(region.contains({std::nan(""), 0, 0}));
  }
}

TEST(size_region, constant_spacing_counts_hexagons_of_the_region) {
  for (const auto& [width, height] :
       {std::pair(5.0, 5.0), std::pair(90.0, 90.0), std::pair(40.0, 1.0), std::pair(1e-3, 2e-3)}) {
    const SizeRegion region = region_at(30, 60, width, height);
    // The area of a pyramid's rectangle in terms of its angles.
    const double area = 4 * std::asin(std::sin(region.half_width) * std::sin(region.half_height));
    const SizeFunction size = SizeFunction::constant(1e-6, {region, 100});
    EXPECT_NEAR(size.count() * std::sqrt(3.0) / 2 * 1e-12 / area, 1, 1e-9);
    EXPECT_NEAR(size.for_count(500).count(), 500, 1e-6);
    for (const Point& p : places_in(region, 100)) EXPECT_EQ(size.spacing(p), 1e-6);
  }
}

double gentle(const Point& p) { return 0.02 + 0.01 * p.z + 0.005 * p.x; }

TEST(size_region, function_is_met_at_nodes_and_between_them) {
  for (const double lat : {-90.0, 10.0, 85.0, 90.0}) {
    const SizeRegion region = region_at(-179, lat, 20, 10);
    const SizeFunction size = SizeFunction::from_function(block_of(gentle), {region, 256});
    for (const Point& p : places_in(region, 2000)) EXPECT_NEAR(size.spacing(p), gentle(p), 2e-7);
    const std::vector<Point> nodes = SizeFunction::nodes({region, 256});
    EXPECT_EQ(nodes.size(),
              257U * (std::ceil(256 * std::tan(5 * radians) / std::tan(10 * radians)) + 1));
    for (const Point& p : nodes) EXPECT_NEAR(size.spacing(p), gentle(p), 3e-9);
    std::vector<double> values(nodes.size());
    std::ranges::transform(nodes, values.begin(), gentle);
    const SizeFunction same = SizeFunction::from_nodes(values, {region, 256});
    for (const Point& p : places_in(region, 100)) EXPECT_EQ(same.spacing(p), size.spacing(p));
    EXPECT_THROW((void)SizeFunction::from_nodes(values, {region, 255}), InvalidInput);
  }
}

TEST(size_region, outside_is_as_on_its_border) {
  const SizeRegion region = region_at(0, 0, 20, 10);
  const SizeFunction size = SizeFunction::from_function(block_of(gentle), {region, 64});
  const auto at = [&](double lon, double lat) {
    return size.spacing(unit_vector(LonLat{lon, lat}));
  };
  EXPECT_NEAR(at(50, 0), at(10, 0), 1e-9);
  EXPECT_NEAR(at(0, -60), at(0, -5), 1e-9);
  const double corner = gentle(
      unit_vector(LonLat{10, std::atan(std::tan(5 * radians) * std::cos(10 * radians)) / radians}));
  EXPECT_NEAR(at(80, 60), corner, 1e-6);
  EXPECT_NEAR(at(170, 10), corner, 1e-6);
  for (const Point& far :
       {Point{-1, 0, 0}, Point{-1, -0.0, -0.0}, Point{0, 1, 0}, Point{0, 0, -1}}) {
    EXPECT_GE(size.spacing(far), size.smallest());
    EXPECT_LE(size.spacing(far), size.largest() * (1 + 1e-6));
  }
}

// The wish is the smaller one of a wide spacing and one that grows from the nearest point.
TEST(size_region, refinement_is_that_of_all_pairs_of_places) {
  for (const double lat : {0.0, 72.0, -90.0}) {
    const SizeRegion region = region_at(100, lat, 5, 5);
    std::vector<Point> points = places_in(region, 40);
    // Points outside count, too.
    SizeRegion far = region;
    far.half_width *= 3;
    far.half_height *= 3;
    for (const Point& p : places_in(far, 40)) points.push_back(p);
    const double near = 1e-4;
    const double slope = 0.1;
    const SizeRaster raster{region, 1024};
    const SizeFunction size = SizeFunction::constant(0.002, raster).refined(points, near, slope);
    // A node is at most half of a diagonal from a place of its square.
    const double error = 0.71 * slope * raster.longest_step();
    for (const Point& p : places_in(region, 3000)) {
      double distance = 4;
      for (const Point& q : points) distance = std::min(distance, apart(p, q));
      const double wanted = std::min(0.002, near + slope * distance);
      EXPECT_NEAR(size.spacing(p), wanted, error);
    }
    const SizeFunction threads =
        SizeFunction::constant(0.002, raster).refined(points, near, slope, {.threads = 3});
    for (const Point& p : places_in(region, 1000)) EXPECT_EQ(threads.spacing(p), size.spacing(p));
  }
}

// The largest function below the values with that slope is the least of value + slope * distance over
// all nodes; paths along the moves of a king and a knight are up to 3 % longer.
TEST(size_region, limit_is_that_of_all_pairs_of_nodes) {
  for (const auto& [width, height] : {std::pair(10.0, 10.0), std::pair(80.0, 30.0)}) {
    const SizeRaster raster{region_at(20, 50, width, height), 40};
    const std::vector<Point> nodes = SizeFunction::nodes(raster);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> value(1, 100);
    std::vector<double> values(nodes.size());
    for (double& one : values) one = 1e-4 * value(random) * value(random);
    const double slope = 0.3;
    const SizeFunction size = SizeFunction::from_nodes(values, raster).limited(slope);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      double wanted = values[i];
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        wanted = std::min(wanted, values[k] + slope * apart(nodes[i], nodes[k]));
      }
      EXPECT_GE(size.spacing(nodes[i]), wanted * (1 - 1e-3));
      EXPECT_LE(size.spacing(nodes[i]), wanted * 1.05);
    }
  }
}

TEST(size_region, grid_is_interpolated_across_the_antimeridian) {
  std::vector<double> lon;
  std::vector<double> lat;
  for (int i = 0; i < 100; ++i) lon.push_back(177 + 0.06 * i);
  for (int j = 0; j < 50; ++j) lat.push_back(-1.5 + 0.06 * j);
  std::vector<double> values;
  for (const double y : lat) {
    for (const double x : lon) values.push_back(gentle(unit_vector(LonLat{x, y})));
  }
  const SizeRegion region = region_at(180, 0, 5, 2.5);
  const SizeFunction size = SizeFunction::from_grid(lon, lat, values, {region, 200});
  for (const Point& p : places_in(region, 1000)) EXPECT_NEAR(size.spacing(p), gentle(p), 1e-7);
}

TEST(size_region, rasters_have_a_largest_number_of_places) {
  const SizeRegion square = region_at(5, 5, 2, 2);
  EXPECT_EQ(SizeRaster(square, 1).most_steps(), 4096U);
  EXPECT_EQ(SizeRaster(8).most_steps(), 4096U);
  const SizeRegion narrow = region_at(5, 5, 0.02, 8);
  const std::size_t most = SizeRaster(narrow, 1).most_steps();
  EXPECT_GT(most, 60000U);
  EXPECT_LE(most, 65536U);
  for (const double step : {1e-3, 3e-5, 1.7e-5}) {
    const SizeRaster raster = SizeRaster::with_step(square, step);
    EXPECT_LE(raster.longest_step(), step);
    EXPECT_GT(SizeRaster(square, raster.steps - 1).longest_step(), step);
  }
  EXPECT_EQ(SizeRaster::with_step(square, 1e-9).steps, 4096U);
  EXPECT_EQ(SizeRaster::with_step(square, 10).steps, 1U);
  EXPECT_EQ(SizeRaster(8).longest_step(), 0.25);
}

TEST(size_region, what_is_no_region_is_refused) {
  const double nan = std::nan("");
  const Point east{1, 0, 0};
  for (const SizeRegion& region :
       {SizeRegion{east, 0, 0.1}, SizeRegion{east, 0.1, -0.1}, SizeRegion{east, 1, 0.1},
        SizeRegion{east, 0.1, nan}, SizeRegion{{2, 0, 0}, 0.1, 0.1},
        SizeRegion{{0, 0, 0}, 0.1, 0.1}, SizeRegion{{nan, 0, 0}, 0.1, 0.1}}) {
    EXPECT_THROW((void)SizeFunction::constant(0.1, {region, 8}), InvalidInput);
    EXPECT_THROW((void)region.contains(east), InvalidInput);
    EXPECT_THROW((void)SizeRaster::with_step(region, 0.1), InvalidInput);
    EXPECT_THROW((void)SizeRaster(region, 8).longest_step(), InvalidInput);
    EXPECT_THROW((void)read_refinement({"none.geojson", {}}, 0.1, {}, {}, region), InvalidInput);
  }
  const SizeRegion region{east, 0.1, 0.1};
  EXPECT_THROW((void)SizeFunction::nodes({region, 0}), InvalidInput);
  EXPECT_THROW((void)SizeFunction::nodes({region, 4097}), InvalidInput);
  EXPECT_THROW((void)SizeRaster::with_step(region, 0), InvalidInput);
  EXPECT_THROW((void)SizeRaster::with_step(region, nan), InvalidInput);
  const SizeFunction size = SizeFunction::constant(0.5, {region, 8});
  EXPECT_EQ(test::thrown_message<InvalidInput>([&] { (void)scvt({.count = 50, .size = size}); }),
            "a tessellation covers the sphere, and its spacings are those of a region");
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_THROW((void)relax(sites, {.size = size}), InvalidInput);
}

// A line far away has few points, and is nearly as far from the region as with many.
TEST(size_region, lines_are_as_dense_as_they_are_near) {
  const std::string path = temporary_path("far.geojson");
  std::ofstream(path) << R"({"type":"MultiLineString","coordinates":[[[-170,20],[-20,60],[0,-40]],)"
                      << R"([[9,49],[12,52]],[[170,-50],[-170,-50]]]})";
  const SizeRegion region = region_at(10, 50, 1, 1);
  const PolygonOptions arcs{.edges = PolygonEdges::geodesic};
  const std::vector<Point> all = read_refinement({path, {}}, 0.0005, arcs);
  const std::vector<Point> some = read_refinement({path, {}}, 0.0005, arcs, {}, region);
  EXPECT_GT(all.size(), 5000U);
  EXPECT_LT(some.size(), 400U);
  const auto nearest = [](const Point& p, const std::vector<Point>& points) {
    double least = 4;
    for (const Point& q : points) least = std::min(least, apart(p, q));
    return least;
  };
  for (const Point& p : places_in(region, 100)) {
    // Half of the distance of points is the most that a line through the region differs by.
    EXPECT_NEAR(nearest(p, some), nearest(p, all), 0.01 * nearest(p, all) + 0.00026);
  }
}

// The steps are as long as places are apart where they are closest, however many are outside.
TEST(size_region, spacings_of_files_have_the_steps_of_their_places) {
  const std::string path = temporary_path("places.csv");
  std::ofstream file(path);
  file << "lon,lat,h\n";
  for (int i = -30; i <= 30; ++i) {
    for (int j = -30; j <= 30; ++j) file << 10 + i * 0.01 << ',' << 50 + j * 0.01 << ",0.001\n";
  }
  for (int i = 0; i < 360; i += 5) file << i << ",-30," << (i % 2 == 0 ? 0.1 : 0.2) << '\n';
  file.close();
  const SizeRegion region = region_at(10, 50, 1, 1);
  std::vector<std::string> remarks;
  const auto read = [&](std::size_t steps, std::size_t most) {
    return read_spacings({path, {}}, "h", 1, {region, steps}, {}, &remarks,
                         {.most_steps = most, .corners = std::array{region.center}});
  };
  const SizeFunction size = read(1, 4096);
  EXPECT_EQ(remarks, std::vector<std::string>{});
  // Places are 0.01 degrees apart northward, and 0.64 of that eastward.
  EXPECT_GE(size.raster().steps, 100U);
  EXPECT_LE(size.raster().steps, 220U);
  EXPECT_NEAR(size.spacing(region.center), 0.001, 1e-9);
  EXPECT_EQ(read(500, 4096).raster().steps, 500U);
  EXPECT_EQ(read(1, 0).raster().steps, 1U);
  EXPECT_EQ(read(1, 50).raster().steps, 50U);
}

// Returns the region of an area of polygons.
std::optional<SizeRegion> region_around(const std::vector<test::Ring>& rings) {
  MeshDomain domain;
  domain.area.push_back(test::polygon(rings));
  return region_of(domain);
}

TEST(size_region, areas_have_small_regions) {
  struct Case {
    test::Ring ring;
    double width_deg;
    double height_deg;
  };
  const double m = 1e-3 / 111.2;  // a meter
  for (const auto& [ring, width, height] :
       {Case{test::box(0, 40, 5, 45), 3.9, 5.1}, Case{test::box(177, -20, 184, -10), 7, 10.2},
        Case{{{0, 85}, {90, 85}, {180, 85}, {270, 85}}, 10, 10},
        Case{{{0, -89}, {270, -89}, {180, -89}, {90, -89}}, 2, 2},
        Case{test::box(10, 50, 10 + 100 * m, 50 + 100 * m), 70 * m, 101 * m},
        Case{test::box(-25, -25, 25, 25), 50, 54}}) {
    const auto region = region_around({ring});
    ASSERT_TRUE(region);
    // The rectangle may be turned at a pole.
    EXPECT_LE(2 * region->half_width, 1.02 * width * radians);
    EXPECT_LE(2 * region->half_height, 1.02 * height * radians);
    for (const Point& p : unit_vectors(ring)) EXPECT_TRUE(region->contains(p));
    // The border of the area is within the region, for example at the middle of its sides.
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = unit_vector(ring[i]);
      const Point b = unit_vector(ring[(i + 1) % ring.size()]);
      EXPECT_TRUE(region->contains({a.x + b.x, a.y + b.y, a.z + b.z}));
    }
  }
}

TEST(size_region, corners_that_are_not_spread_evenly_do_not_pull_the_region) {
  test::Ring ring = test::box(0, 0, 40, 30);
  std::vector<LonLat> many;
  for (int k = 1; k < 1000; ++k) many.push_back({0.001 * k, 0});
  ring.insert(ring.begin() + 1, many.begin(), many.end());
  const auto region = region_around({ring});
  ASSERT_TRUE(region);
  EXPECT_LE(region->half_width, 21 * radians);
  EXPECT_LE(region->half_height, 16.5 * radians);
}

TEST(size_region, large_areas_and_outsides_have_none) {
  EXPECT_FALSE(region_of({}));
  EXPECT_FALSE(region_around({test::box(-50, -10, 50, 10)}));
  test::Ring outside = test::box(0, 0, 5, 5);
  std::ranges::reverse(outside);
  EXPECT_FALSE(region_around({outside}));
  EXPECT_TRUE(region_around({test::box(0, 0, 5, 5)}));
  // A hole is no outside, and a part that is far away makes the region too large.
  test::Ring hole = test::box(1, 1, 2, 2);
  std::ranges::reverse(hole);
  EXPECT_TRUE(region_around({test::box(0, 0, 5, 5), hole}));
  EXPECT_FALSE(region_around({test::box(0, 0, 5, 5), test::box(180, 0, 185, 5)}));
  MeshDomain two;
  two.area = {test::polygon({test::box(0, 0, 5, 5)}), test::polygon({test::box(10, 20, 15, 25)})};
  const auto region = region_of(two);
  ASSERT_TRUE(region);
  EXPECT_TRUE(region->contains(unit_vector(LonLat{15, 25})));
  two.area.push_back(test::polygon({test::box(100, 20, 105, 25)}));
  EXPECT_FALSE(region_of(two));
  // Antipodes, whose box has no middle.
  EXPECT_FALSE(region_around({test::box(-1, -1, 1, 1), test::box(179, -1, 181, 1)}));
  MeshDomain sphere;
  sphere.area = {test::polygon({})};
  sphere.area[0].polygons.whole = {0};
  EXPECT_FALSE(region_of(sphere));
}

TEST(size_region, areas_that_are_not_valid_have_none) {
  MeshDomain domain;
  domain.area = {test::polygon({test::box(0, 0, 5, 5)})};
  CellRings& polygons = domain.area[0].polygons;
  polygons.points[2] = {std::nan(""), 0, 0};
  EXPECT_FALSE(region_of(domain));
  polygons.points[2] = {0, 0, 0};
  EXPECT_FALSE(region_of(domain));
  polygons.points[2] = unit_vector(LonLat{5, 5});
  polygons.corners[1] = 17;
  EXPECT_FALSE(region_of(domain));
  polygons.corners[1] = 1;
  polygons.rings.back() = 90;
  EXPECT_FALSE(region_of(domain));
  polygons.rings = {};
  EXPECT_FALSE(region_of(domain));
}

}  // namespace
}  // namespace rondel::mesh
