// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Repaired polygons, against the number of sides north of a place in the plane of longitude and latitude.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "rondel/mesh_cull.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "support/random.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/overlay/planar.h"

namespace rondel::test {
namespace {

const PolygonOptions repairing = {.tolerance_deg = 1e-2, .invalid = InvalidPolygons::repair};

// The rings of a polygon, and the polygons of a feature.
using PolygonInPlane = std::vector<RingInPlane>;
using FeatureInPlane = std::vector<PolygonInPlane>;

std::vector<std::string> text_of_feature(const FeatureInPlane& feature) {
  std::vector<std::string> text;
  for (const PolygonInPlane& polygon : feature) text.push_back(planar_polygon(polygon));
  return text;
}

// Returns how far a place is from a side, in degrees along its meridian, and adds the side to the count
// if it is north of the place.
double pass_side(const LonLat& from, const LonLat& to, const LonLat& place, int& count) {
  const auto [west, east] =
      std::minmax(from, to, [](const LonLat& p, const LonLat& q) { return p.lon_deg < q.lon_deg; });
  if (place.lon_deg < west.lon_deg || place.lon_deg >= east.lon_deg) return 90;
  const double t = (place.lon_deg - west.lon_deg) / (east.lon_deg - west.lon_deg);
  const double lat = west.lat_deg + t * (east.lat_deg - west.lat_deg);
  if (lat > place.lat_deg) ++count;
  return std::abs(lat - place.lat_deg);
}

// Whether a feature has a place; `distance` becomes the distance from the next side.
bool has_place(const FeatureInPlane& feature, const LonLat& place, double& distance) {
  bool has_any = false;
  distance = 90;
  for (const PolygonInPlane& polygon : feature) {
    int count = 0;
    for (const RingInPlane& ring : polygon) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        for (const double turn : {-360.0, 0.0, 360.0}) {
          const LonLat turned = {place.lon_deg + turn, place.lat_deg};
          const LonLat& to = ring[k + 1 < ring.size() ? k + 1 : 0];
          distance = std::min(distance, pass_side(ring[k], to, turned, count));
        }
      }
    }
    has_any = has_any || count % 2 != 0;
  }
  return has_any;
}

void expect_places(const FeatureInPlane& feature, const CellRings& cells, Random& random,
                   const std::string& what) {
  std::vector<Point> places;
  std::vector<bool> expected;
  for (int i = 0; i < 400; ++i) {
    const LonLat place = {-180 + 360 * random.unit(), -85 + 170 * random.unit()};
    double distance = 0;
    const bool is_inside = has_place(feature, place, distance);
    if (distance < 1) continue;
    places.push_back(unit_vector(place));
    expected.push_back(is_inside);
  }
  std::vector<std::uint8_t> found(places.size(), cells.is_whole(0) ? 1 : 0);
  if (!cells.is_whole(0)) found = mesh::inside(places, cells);
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(found[i] != 0, expected[i]) << what << ", place " << i;
  }
}

// Valid cells can be read again as they are.
void expect_valid(const CellRings& cells) {
  EXPECT_TRUE(crossing_cells(cells).empty());
  EXPECT_NO_THROW((void)CellSet::polygons(cells).areas());
}

class Repairs : public testing::TestWithParam<int> {};

// Corners on a coarse grid give crossings, sides that overlap, corners on sides, and rings along the
// poles and the edges of the map; others cross at any place.
TEST_P(Repairs, have_the_places_of_an_odd_number_of_sides) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  const std::uint64_t steps = std::array{2U, 4U, 8U, 36U}[static_cast<std::size_t>(GetParam() % 4)];
  FeatureInPlane feature(1 + random.below(3));
  for (PolygonInPlane& polygon : feature) {
    polygon.resize(1 + random.below(2));
    for (RingInPlane& ring : polygon) {
      for (std::uint64_t k = 3 + random.below(5); k > 0; --k) {
        const auto part = [&] {
          return static_cast<double>(random.below(steps + 1)) / static_cast<double>(steps);
        };
        const double lon = -180 + 360 * part();
        ring.push_back({lon, -90 + 180 * part()});
      }
      // Longer sides would go the other way around the globe.
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const LonLat& from = ring[k];
        const LonLat& to = ring[(k + 1) % ring.size()];
        if (std::abs(to.lon_deg - from.lon_deg) <= 180) continue;
        ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                    {(from.lon_deg + to.lon_deg) / 2, (from.lat_deg + to.lat_deg) / 2});
      }
    }
  }
  const std::string text = planar_polygon(feature[0]);
  const CellTable table = planar_table({text_of_feature(feature)}, repairing);
  expect_valid(table.cells);
  expect_places(feature, table.cells, random, text);
}

INSTANTIATE_TEST_SUITE_P(all, Repairs, testing::Range(0, 400));

double area_of(const FeatureInPlane& feature, PolygonOptions options = repairing) {
  const CellTable table = planar_table({text_of_feature(feature)}, options);
  expect_valid(table.cells);
  EXPECT_FALSE(table.facts.faults.empty());
  return table.cells.is_whole(0) ? 4 * std::numbers::pi : areas(table.cells)[0];
}

TEST(overlay_repair, rings_around_a_pole_have_the_pole) {
  const auto cap = [](double lat) {
    return 2 * std::numbers::pi * (1 - std::sin(lat * std::numbers::pi / 180));
  };
  const RingInPlane south = {{-170, -70}, {-60, -70}, {60, -70}, {170, -70}};
  EXPECT_NEAR(area_of({{south}}), cap(70), 1e-3);
  const RingInPlane wider = {{170, -60}, {60, -60}, {-60, -60}, {-170, -60}};
  EXPECT_NEAR(area_of({{wider, south}}), cap(60) - cap(70), 1e-3) << "a hole around the pole";
  EXPECT_NEAR(area_of({{wider}, {south}}), cap(60), 1e-3) << "overlapping parts";
  const RingInPlane north = {{-170, 70}, {-60, 70}, {60, 70}, {170, 70}};
  EXPECT_NEAR(area_of({{south}, {north}}), 2 * cap(70), 1e-3);
}

// A corner of another feature on the long side lies on the other side of the globe.
TEST(overlay_repair, long_sides_get_no_corners_of_features_on_the_long_way) {
  const RingInPlane around = {{-170, 61}, {-60, 62}, {60, 62}, {170, 61}};
  for (const double lat : {61.0, 60.8}) {
    const RingInPlane other = {{0, lat}, {1, 59}, {2, 60.5}};
    const CellTable table =
        planar_table({{planar_polygon({around})}, {planar_polygon({other})}}, repairing);
    EXPECT_NEAR(areas(table.cells)[0], 0.7543, 1e-3) << lat;
  }
}

TEST(overlay_repair, other_features_stay_bit_by_bit) {
  const RingInPlane bow = {{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  const RingInPlane box = planar_box(10, 0, 20, 10);
  const RingInPlane far = planar_box(40, 10, 50, 20);
  const std::vector<std::string> next = {planar_polygon({box}), planar_polygon({far})};
  const CellTable valid = planar_table({next}, {});
  const CellTable both =
      planar_table({next, {planar_polygon({bow})}}, {.invalid = InvalidPolygons::repair});
  ASSERT_EQ(both.facts.faults.size(), 2U);
  EXPECT_EQ(both.facts.faults[0], "");
  EXPECT_EQ(both.facts.faults[1], "ring 0 of part 0 crosses itself at 5 5");
  EXPECT_EQ(both.facts.remarks,
            std::vector<std::string>{
                "feature 1 (f1) was repaired (ring 0 of part 0 crosses itself at 5 5)"});
  const auto points_of = [](const CellTable& table) {
    std::vector<Point> points;
    for (std::uint64_t r = table.cells.cells[0]; r < table.cells.cells[1]; ++r) {
      for (const Index corner : table.cells.corners_of(r))
        points.push_back(table.cells.points[corner]);
    }
    return points;
  };
  EXPECT_EQ(points_of(valid), points_of(both));
  // A corner of the bow is one of the box, too.
  const std::vector<Point> corners = points_of(both);
  EXPECT_EQ(std::ranges::count(both.cells.points, corners[0]), 1);
}

TEST(overlay_repair, geodesic_sides_cross_where_great_circles_do) {
  const PolygonOptions geodesic = {.edges = PolygonEdges::geodesic,
                                   .invalid = InvalidPolygons::repair};
  // Two triangles, which meet on the equator.
  const FeatureInPlane bow = {{{{0, -10}, {20, 10}, {20, -10}, {0, 10}}}};
  const PolygonOptions plain = {.edges = PolygonEdges::geodesic};
  const CellTable half = planar_table({{planar_polygon({{{0, -10}, {10, 0}, {0, 10}}})}}, plain);
  EXPECT_NEAR(area_of(bow, geodesic), 2 * areas(half.cells)[0], 1e-14);
  const FeatureInPlane twice = {{planar_box(0, 0, 10, 10)}, {planar_box(5, 5, 15, 15)}};
  const CellTable parts =
      planar_table({{planar_polygon(twice[0])}, {planar_polygon(twice[1])}}, plain);
  const double area = area_of(twice, geodesic);
  EXPECT_LT(area, areas(parts.cells)[0] + areas(parts.cells)[1] - 0.007);
  EXPECT_GT(area, areas(parts.cells)[0] + areas(parts.cells)[1] - 0.008);
}

// Files that do not cut polygons at the antimeridian have 170 and then -170.
TEST(overlay_repair, longer_sides_go_the_shorter_way) {
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    RingInPlane ring;
    for (std::uint64_t k = 3 + random.below(6); k > 0; --k) {
      ring.push_back({120 + 120 * random.unit(), -80 + 160 * random.unit()});
    }
    ring.push_back({170, ring.front().lat_deg});
    RingInPlane cut = ring;
    for (LonLat& p : cut) p.lon_deg = std::remainder(p.lon_deg, 360.0);
    const std::string box = planar_polygon({planar_box(0, 0, 1, 1)});
    const auto areas_of = [&](const RingInPlane& any) {
      return areas(planar_table({{planar_polygon({any}), box, box}}, repairing).cells)[0];
    };
    EXPECT_NEAR(areas_of(cut), areas_of(ring), 1e-9);
  }
}

// Rings no wider than rounding have no side that is certainly the left one.
TEST(overlay_repair, slivers_do_not_turn_inside_out) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const LonLat place = {-180 + 360 * random.unit(), -90 + 180 * random.unit()};
    const double width = std::pow(10.0, -static_cast<double>(random.below(15)));
    const auto near = [&] {
      return LonLat{place.lon_deg + width * random.unit(),
                    std::clamp(place.lat_deg + width * random.unit(), -90.0, 90.0)};
    };
    const LonLat p = near();
    const LonLat q = near();
    const LonLat r = near();
    const RingInPlane ring = i % 2 == 0 ? RingInPlane{p, q, p, r} : RingInPlane{p, q, r, q, p, r};
    const FeatureInPlane bow = {{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, {ring}};
    for (const PolygonEdges edges : {PolygonEdges::geodesic, PolygonEdges::lonlat}) {
      EXPECT_LT(area_of(bow, {.edges = edges, .invalid = InvalidPolygons::repair}), 0.001);
    }
  }
}

TEST(overlay_repair, faults_are_told_without_repair) {
  const std::string path = temporary_path("repair_faults.geojson");
  std::ofstream(path) << R"({"type":"GeometryCollection","geometries":[
{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]},
{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1]]]},
{"type":"Polygon","coordinates":[[[0,0],[1,0],[0,0]]]},
{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[2,3]]]},
{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]],[[3,3],[4,3],[4,4],[3,3]]]},
{"type":"Polygon","coordinates":[]}]})";
  EXPECT_EQ(polygon_faults(path),
            (std::vector<std::string>{
                "", "a ring of 3 positions", "a ring of 3 positions",
                "a ring that is not closed, from 0 0 to 2 3",
                "ring 1 of part 0, a hole, does not lie inside of its polygon at 3 3", ""}));
  const CellTable table = read_polygons(path, {.invalid = InvalidPolygons::repair});
  const std::vector<double> found = areas(table.cells);
  EXPECT_EQ(found[0], found[1]) << "closed";
  EXPECT_EQ(found[2], 0) << "to and fro";
  EXPECT_GT(found[4], areas(table.cells)[0]);
}

TEST(overlay_repair, what_has_no_meaning_stays_an_error) {
  const PolygonOptions geodesic = {.edges = PolygonEdges::geodesic,
                                   .invalid = InvalidPolygons::repair};
  EXPECT_EQ(
      planar_message({{planar_polygon({{{0, 0}, {180, 0}, {90, 10}, {5, 20}}})}}, geodesic),
      "feature 0 (f0): ring 0 of part 0 joins antipodes: there is no shortest way from 0 0 to "
      "180 0, which cannot be repaired: the ends of an arc are opposite to each other up to "
      "rounding");
  EXPECT_EQ(
      planar_message({{planar_polygon({planar_box(4000, 0, 4001, 1)})}}, repairing),
      "feature 0 (f0): ring 0 of part 0: longitude 4000 0 is more than ten turns of the globe "
      "away");
}

// A feature of one ring on a grid, whose sides often cross in corners of the grid.
LonLatMultiPolygons random_features(Random& random, std::size_t count) {
  LonLatMultiPolygons features;
  for (std::size_t f = 0; f < count; ++f) {
    std::vector<LonLat>& positions = features.rows.rows.values;
    const std::size_t first = positions.size();
    for (std::uint64_t k = 3 + random.below(3); k > 0; --k) {
      const auto lon = static_cast<double>(random.below(5));
      positions.push_back({lon, static_cast<double>(random.below(5))});
    }
    positions.push_back(positions[first]);
    features.rows.rows.end_row();
    features.rows.end_group();
    features.end_group();
  }
  return features;
}

// Corners of one feature are inserted into the sides of the others, where these may cross.
TEST(overlay_repair, other_features_do_not_make_a_feature_valid) {
  std::size_t num_refused = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    const LonLatMultiPolygons features = random_features(random, 2 + random.below(2));
    const std::vector<std::string> faults = polygon_faults(features);
    const auto first = std::ranges::find_if(faults, [](const auto& text) { return !text.empty(); });
    const std::string found =
        thrown_message<InvalidInput>([&] { (void)cells_of_polygons(features); });
    EXPECT_EQ(found.empty(), first == faults.end()) << seed << ": " << found;
    if (found.empty() || first == faults.end()) continue;
    ++num_refused;
    const std::size_t named = std::stoul(found.substr(std::string("feature ").size()));
    EXPECT_EQ(found, "feature " + std::to_string(named) + ": " + faults[named]) << seed;
  }
  EXPECT_GT(num_refused, 500U);
}

// A feature of shells and holes on a grid: some are valid, as boxes in boxes.
LonLatMultiPolygons random_rings(Random& random) {
  LonLatMultiPolygons feature;
  auto& polygons = feature.rows;
  std::vector<LonLat>& positions = polygons.rows.values;
  for (std::uint64_t r = 1 + random.below(4); r > 0; --r) {
    const std::size_t first = positions.size();
    if (random.below(2) == 0) {
      const auto west = static_cast<double>(random.below(6));
      const auto south = static_cast<double>(random.below(6));
      const double size = 0.5 + static_cast<double>(random.below(6));
      positions.insert(
          positions.end(),
          {{west, south}, {west + size, south}, {west + size, south + size}, {west, south + size}});
    } else {
      for (std::uint64_t k = 3 + random.below(3); k > 0; --k) {
        const auto lon = static_cast<double>(random.below(6));
        positions.push_back({lon, static_cast<double>(random.below(6))});
      }
    }
    positions.push_back(positions[first]);
    polygons.rows.end_row();
    // The next ring is a hole of this polygon, or the shell of another one.
    if (r == 1 || random.below(3) == 0) polygons.end_group();
  }
  feature.end_group();
  return feature;
}

// Faults are found without cells where a feature is valid at first sight.
TEST(overlay_repair, geodesic_faults_are_those_of_reading) {
  const PolygonOptions geodesic{.edges = PolygonEdges::geodesic};
  std::size_t num_valid = 0;
  std::size_t num_with_holes = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    const LonLatMultiPolygons feature = random_rings(random);
    const std::vector<std::string> faults = polygon_faults(feature, geodesic);
    const std::string found =
        thrown_message<InvalidInput>([&] { (void)cells_of_polygons(feature, geodesic); });
    ASSERT_EQ(found, faults[0].empty() ? "" : "feature 0: " + faults[0]) << seed;
    if (!found.empty()) continue;
    ++num_valid;
    if (feature.rows.rows.size() > 1) ++num_with_holes;
  }
  EXPECT_GT(num_valid, 500U);
  EXPECT_GT(num_with_holes, 100U);
}

// True if two sets of cells have the same rings, whatever the numbers of their points are.
bool have_same_rings(const CellRings& a, const CellRings& b) {
  const auto places = [](const CellRings& cells) {
    std::vector<Point> found;
    for (const Index corner : cells.corners) found.push_back(cells.points[corner]);
    return found;
  };
  return a.cells == b.cells && a.rings == b.rings && a.whole == b.whole && places(a) == places(b);
}

// Where features are to be repaired, valid ones are taken at first sight, and nobody is told what is
// wrong with others.
TEST(overlay_repair, cells_alone_are_those_of_reading) {
  std::size_t num_valid = 0;
  std::size_t num_repaired = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    const LonLatMultiPolygons feature = random_rings(random);
    for (const PolygonEdges edges : {PolygonEdges::lonlat, PolygonEdges::geodesic}) {
      const PolygonOptions repair{.edges = edges, .invalid = InvalidPolygons::repair};
      const CellRings cells = rings_of_polygons(feature, repair);
      ASSERT_TRUE(have_same_rings(cells, cells_of_polygons(feature, repair).cells)) << seed;
      try {
        ASSERT_TRUE(have_same_rings(cells, cells_of_polygons(feature, {.edges = edges}).cells))
            << seed;
        ++num_valid;
      } catch (const InvalidInput&) {
        ++num_repaired;
      }
    }
  }
  EXPECT_GT(num_valid, 1000U);
  EXPECT_GT(num_repaired, 1000U);
}

TEST(overlay_repair, lines_do_not_make_a_feature_valid) {
  // A bow tie, and a line that ends where its sides cross.
  LonLatGeometries tie;
  tie.lines.rows.append(std::vector<LonLat>{{1, 1}, {1, 5}});
  tie.lines.end_group();
  tie.polygons.rows.rows.append(std::vector<LonLat>{{0, 0}, {2, 2}, {2, 0}, {0, 2}, {0, 0}});
  tie.polygons.rows.end_group();
  tie.polygons.end_group();
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              (void)features_of_geometries({&tie, 1});
            }),
            "feature 0: ring 0 of part 0 crosses itself at 1 1");
  // A ring that has its own corner there touches itself.
  tie.polygons.rows.rows = {};
  tie.polygons.rows.rows.append(
      std::vector<LonLat>{{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}, {0, 0}});
  EXPECT_NO_THROW((void)features_of_geometries({&tie, 1}));
}

}  // namespace
}  // namespace rondel::test
