// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons that are straight in longitude and latitude, against the integral of the sine of the latitude along their sides,
// and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "support/random.h"
#include "unit/overlay/planar.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

double uniform_between(Random& random, double low, double high) {
  return low + (high - low) * random.unit();
}

TEST(overlay_plane, slivers_have_their_area) {
  Random random(7);
  const std::vector<double> lengths = {10, 1, 0.1, 0.01};
  for (const double length : lengths) {
    for (int width = 3; width <= 12; ++width) {
      for (int i = 0; i < 6; ++i) {
        const double turn = uniform_between(random, 0, 2 * std::numbers::pi);
        const LonLat p = {uniform_between(random, -170, 170), uniform_between(random, -70, 70)};
        const LonLat along = {std::cos(turn) * length, std::sin(turn) * length};
        const double side = std::pow(10.0, -width) * (i % 2 == 0 ? 1 : -1);
        const double t = uniform_between(random, 0.1, 0.9);
        const RingInPlane ring = {p,
                                  {p.lon_deg + along.lon_deg, p.lat_deg + along.lat_deg},
                                  {p.lon_deg + t * along.lon_deg - side * std::sin(turn),
                                   p.lat_deg + t * along.lat_deg + side * std::cos(turn)}};
        const double area = areas(planar_table({{planar_polygon({ring})}}).cells)[0];
        // Corners are unit vectors of doubles. Arcs are within the tolerance of lines, and change a thousandth of the area.
        const double rounding = planar_length(ring) * 1e-14;
        const double arc =
            std::min(1e-4 * std::numbers::pi / 180, std::pow(length * std::numbers::pi / 180, 2));
        EXPECT_NEAR(area, area_in_plane(ring),
                    rounding + std::min(2 * arc * planar_length(ring), 1e-3 * area_in_plane(ring)))
            << length << ' ' << width;
        EXPECT_GE(area, -rounding);
      }
    }
  }
}

// Thin cells, each thin in another way, of all scales.
class ThinCells {
 public:
  static constexpr std::size_t num_kinds = 6;
  explicit ThinCells(std::uint64_t seed) : random_(seed) {}

  RingInPlane operator()(std::size_t kind) {
    const double thin = power(-9, 0);
    switch (kind) {
      case 0: {  // along the equator, or another parallel
        const double length = power(-3, 2.2);
        const double west = uniform(-180, 180 - length);
        const double south = one_of(2) ? 0 : one_of(2) ? -thin / 3 : uniform(-85, 85);
        return planar_box(west, south, west + length, south + thin);
      }
      case 1: {  // a cap, or a part of it
        const double length = one_of(2) ? 360 : power(-1, 2.4);
        return planar_box(180 - length, 90 - thin, 180, 90);
      }
      case 2: {  // a band around a pole
        const double length = one_of(2) ? 360 : power(-1, 2.4);
        const double radius = power(-6, 0.5);
        return planar_box(-180, radius - 90, length - 180, radius * (1 - power(-6, -0.1)) - 90);
      }
      case 3: {  // two long sides and a corner between them
        const double length = power(-2, 1.5);
        const double slope = one_of(2) ? 0 : uniform(-0.7, 0.7);
        const double t = uniform(0.1, 0.9) * length;
        const LonLat p = {uniform(-170, 130), uniform(-60, 60)};
        return {p,
                {p.lon_deg + length, p.lat_deg + slope * length},
                {p.lon_deg + t, p.lat_deg + slope * t + thin}};
      }
      case 4: {  // along a meridian, or across many
        const double length = power(-2, 1.8);
        const double shift = one_of(2) ? 0 : uniform(-30, 30);
        const LonLat p = {uniform(-140, 140), uniform(-89, 89 - length)};
        return {p,
                {p.lon_deg + thin, p.lat_deg},
                {p.lon_deg + thin + shift, p.lat_deg + length},
                {p.lon_deg + shift, p.lat_deg + length}};
      }
      default: {  // a triangle beside a pole
        const double length = power(-1, 2.2);
        const double west = uniform(-180, 180 - length);
        return {{west, 90 - thin},
                {west + length, 90 - thin * uniform(0.2, 1)},
                {west + length * random_.unit(), 90 - thin * uniform(0, 0.2)}};
      }
    }
  }

 private:
  double uniform(double low, double high) { return uniform_between(random_, low, high); }
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  bool one_of(std::size_t n) { return random_.below(n) == 0; }

  Random random_;
};

// For a polygon less than some roundings wide nothing can be said.
void expect_share(const RingInPlane& ring, double share, const PolygonOptions& options) {
  const double area = area_in_plane(ring);
  const double rounding = planar_length(ring) * 1e-14;
  const double found = areas(planar_table({{planar_polygon({ring})}}, options).cells)[0];
  EXPECT_NEAR(found, area, share * area + rounding) << text_of(ring);
}

TEST(overlay_plane, thin_cells_are_right_to_a_thousandth) {
  for (std::size_t kind = 0; kind < ThinCells::num_kinds; ++kind) {
    ThinCells cells(kind);
    for (int i = 0; i < 40; ++i) expect_share(cells(kind), 1e-3, {});
  }
}

TEST(overlay_plane, a_smaller_tolerance_makes_areas_better) {
  for (std::size_t kind = 0; kind < ThinCells::num_kinds; ++kind) {
    ThinCells cells(100 + kind);
    for (int i = 0; i < 8; ++i) expect_share(cells(kind), 1e-5, {.tolerance_deg = 1e-6});
  }
}

// A thin cell between two others is divided as they are.
TEST(overlay_plane, neighbors_of_thin_cells_share_their_corners) {
  const RingInPlane thin = {{0, 0}, {170, 0}, {170, 1e-5}, {0, 1e-5}};
  const CellTable table = planar_table({{planar_polygon({planar_box(0, -10, 170, 0)})},
                                        {planar_polygon({thin})},
                                        {planar_polygon({planar_box(0, 1e-5, 170, 10)})},
                                        {planar_polygon({planar_box(360, 1e-5, 530, 10)})}});
  const double area = area_in_plane(thin);
  EXPECT_NEAR(areas(table.cells)[1], area, 1e-3 * area);
  const std::vector<std::uint64_t>& rings = table.cells.rings;
  EXPECT_EQ(rings[4] - rings[3], rings[3] - rings[2]) << "on another turn of the globe";
  const CellRings joined = dissolve(table.cells, std::vector<Index>{0, 0, 0, 1}, 2);
  EXPECT_EQ(joined.rings.size(), 3U);
  const CellRings alone = planar_table({{planar_polygon({planar_box(0, 1e-5, 170, 10)})}}).cells;
  EXPECT_GT(rings[3] - rings[2], alone.corners.size());
}

TEST(overlay_plane, whole_degrees_in_line_have_no_area) {
  EXPECT_EQ(planar_message({{planar_polygon({{{-45, 14}, {-30, 26}, {-40, 18}}})}}),
            "feature 0 (f0): ring 0 of part 0 runs to and fro along a line at -45 14");
}

// A sliver with a corner that others have, too, on its long side up to rounding, is closed by them. A
// ring that runs to and fro as it is given stays an error.
TEST(overlay_plane, slivers_that_neighbors_close_are_left_out) {
  const LonLat a{10, 10};
  const LonLat b{13, 11};
  const LonLat c{11, 10 + 1.0 / 3};
  ASSERT_NE((b.lon_deg - a.lon_deg) * (c.lat_deg - a.lat_deg) -
                (b.lat_deg - a.lat_deg) * (c.lon_deg - a.lon_deg),
            0);
  const std::string below = planar_polygon({{a, {12, 5}, b}});
  const std::string above = planar_polygon({{a, c, {9, 15}}});
  const std::string sliver = planar_polygon({{a, c, b}});
  const std::string rounding = "no wider than rounding of the corners (some 2e-13 degrees), ";
  const CellTable alone = planar_table({{below}, {sliver}, {above}});
  EXPECT_EQ(alone.facts.remarks,
            std::vector<std::string>{"feature 1 (f1) is " + rounding + "so nothing is left"});
  EXPECT_EQ(areas(alone.cells)[1], 0);
  const CellTable part = planar_table({{below, sliver}, {above}});
  EXPECT_EQ(part.facts.remarks, std::vector<std::string>{"feature 0 (f0) has rings " + rounding +
                                                         "which are left out"});
  EXPECT_EQ(areas(part.cells), areas(planar_table({{below}, {above}}).cells));
  const std::string line = planar_polygon({{a, {12, 12}, {11, 11}}});
  EXPECT_EQ(planar_message({{below, line}, {planar_polygon({{{11, 11}, {14, 10}, {14, 14}}})}}),
            "feature 0 (f0): ring 0 of part 1 runs to and fro along a line at 10 10");
}

TEST(overlay_plane, the_map_is_the_whole_sphere) {
  const double sphere = 4 * std::numbers::pi;
  for (const std::vector<std::string>& parts : std::vector<std::vector<std::string>>{
           {planar_polygon({planar_box(-180, -90, 180, 90)})},
           {planar_polygon({planar_box(0, -90, 360, 90)})},
           {planar_polygon({planar_box(-180, -90, 0, 90)}),
            planar_polygon({planar_box(0, -90, 180, 90)})},
           {planar_polygon({{{-180, -90},
                             {0, -90},
                             {180, -90},
                             {180, 10},
                             {180, 90},
                             {-180, 90},
                             {-180, -35}}})},
           {planar_polygon({planar_box(-180, -90, 180, 10)}),
            planar_polygon({{{-180, 10}, {180, 10}, {180, 90}, {3, 90}, {-180, 90}}})},
       }) {
    const CellRings cells = planar_table({parts, {}}).cells;
    EXPECT_EQ(cells.whole, std::vector<Index>{0});
    EXPECT_EQ(areas(cells), (std::vector<double>{sphere, 0}));
  }
  // All but an island.
  const RingInPlane island = planar_box(10, 20, 11, 21);
  const CellRings rest =
      planar_table({{planar_polygon({planar_box(-180, -90, 180, 90), island})}}).cells;
  EXPECT_TRUE(rest.whole.empty());
  EXPECT_NEAR(areas(rest)[0], sphere - area_in_plane(island), 1e-9);
  EXPECT_EQ(planar_message({{planar_polygon({planar_box(0, -90, 720, 90)})}}),
            "feature 0 (f0): the polygon covers more than the whole map");
}

TEST(overlay_plane, what_means_no_region_is_refused) {
  const std::string box = planar_polygon({planar_box(0, 0, 10, 10)});
  const auto message = [](const std::vector<std::string>& parts) {
    const std::string text = planar_message({{planar_polygon({planar_box(50, 0, 51, 1)})}, parts});
    return text.empty() ? text : text.substr(text.find("1 (f1): ") + 8);
  };
  EXPECT_EQ(message({planar_polygon({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}})}),
            "ring 0 of part 0 crosses itself at 5 5");
  EXPECT_EQ(message({box, planar_polygon({planar_box(20, 0, 30, 10), planar_box(25, 5, 35, 8)})}),
            "ring 0 of part 1 and ring 1 of part 1 cross at 30 5");
  EXPECT_EQ(message({planar_polygon({planar_box(0, 0, 10, 10), planar_box(12, 1, 13, 2)})}),
            "ring 1 of part 0, a hole, does not lie inside of its polygon at 12 1");
  EXPECT_EQ(message({planar_polygon({planar_box(0, 0, 10, 10), planar_box(-1, -1, 13, 12)})}),
            "ring 1 of part 0, a hole, does not lie inside of its polygon at -1 -1");
  EXPECT_EQ(message({planar_polygon(
                {planar_box(0, 0, 10, 10), planar_box(1, 1, 9, 9), planar_box(2, 2, 3, 3)})}),
            "ring 2 of part 0, a hole, does not lie inside of its polygon but in ring 1 of part 0 "
            "at 2 2");
  EXPECT_EQ(message({box, box}), "ring 0 of part 1 lies in the polygon of ring 0 of part 0 at 0 0");
  EXPECT_EQ(message({box, planar_polygon({planar_box(2, 2, 3, 3)})}),
            "ring 0 of part 1 lies in the polygon of ring 0 of part 0 at 2 2");
  EXPECT_EQ(message({box, planar_polygon({planar_box(0, 0, 10, 5)})}),
            "ring 0 of part 1 lies in the polygon of ring 0 of part 0 at 0 0");
  EXPECT_EQ(message({box, planar_polygon({planar_box(5, 10, 6, 12)})}), "");
}

// A ring with a corner at the crossing is two triangles, a slit vanishes, and so does a hole's side on the shell.
TEST(overlay_plane, rings_are_read_even_odd) {
  const auto area_of = [](const std::vector<std::string>& parts) {
    return areas(planar_table({parts}, {.tolerance_deg = 1e-6}).cells)[0];
  };
  const double bow =
      area_in_plane({{0, 0}, {5, 5}, {0, 10}}) + area_in_plane({{10, 0}, {10, 10}, {5, 5}});
  EXPECT_NEAR(area_of({planar_polygon({{{0, 0}, {5, 5}, {10, 10}, {10, 0}, {5, 5}, {0, 10}}})}),
              bow, 1e-8);
  const double box = area_in_plane(planar_box(0, 0, 20, 20));
  const double hole = area_in_plane(planar_box(5, 5, 6, 6));
  const RingInPlane keyhole = {{0, 0}, {20, 0}, {20, 20}, {0, 20}, {0, 0},
                               {5, 5}, {5, 6},  {6, 6},   {6, 5},  {5, 5}};
  EXPECT_NEAR(area_of({planar_polygon({keyhole})}), box - hole, 1e-8);
  const RingInPlane spike = {{0, 0}, {20, 0}, {20, 10}, {30, 17}, {20, 10}, {20, 20}, {0, 20}};
  EXPECT_NEAR(area_of({planar_polygon({spike})}), box, 1e-8);
  const RingInPlane beside = {{0, 5}, {3, 8}, {0, 11}};
  EXPECT_NEAR(area_of({planar_polygon({planar_box(0, 0, 20, 20), beside})}),
              box - area_in_plane(beside), 1e-8);
  EXPECT_NEAR(area_of({planar_polygon({planar_box(0, 0, 20, 20)}),
                       planar_polygon({planar_box(20, 5, 30, 10)})}),
              box + area_in_plane(planar_box(20, 5, 30, 10)), 1e-8);
}

// Long sides that are near to each other, with many corners.
TEST(overlay_plane, a_comb_has_its_area) {
  constexpr int num_teeth = 600;
  RingInPlane comb = {{0, -1}};
  for (int k = 0; k <= 2 * num_teeth; ++k) {
    comb.push_back({50.0 * k / (2 * num_teeth), k % 2 == 0 ? 1.0 : 40.0});
  }
  comb.push_back({50, -1});
  const CellRings cells = planar_table({{planar_polygon({comb})}}).cells;
  const double area = area_in_plane(comb);
  EXPECT_NEAR(areas(cells)[0], area, 1e-3 * area);
  EXPECT_NEAR(CellSet::polygons(cells).areas()[0], area, 1e-3 * area);
  EXPECT_TRUE(crossing_cells(cells).empty());
}

TEST(overlay_plane, corners_of_one_neighbor_are_corners_of_both) {
  // The border from (0, 0) to (30, 21), of which the neighbor has places that are rounded.
  const LonLat p = {10.1, 21 * 10.1 / 30};
  const LonLat q = {17.3, 21 * 17.3 / 30};
  const CellTable table = planar_table({{planar_polygon({{{0, 0}, {30, 0}, {30, 21}}})},
                                        {planar_polygon({{{0, 0}, p, q, {30, 21}, {0, 21}}})}},
                                       {.overlap = PolygonOverlap::error});
  const CellRings joined = dissolve(table.cells, std::vector<Index>{0, 0}, 1);
  EXPECT_EQ(joined.rings.size(), 2U);
  EXPECT_NEAR(areas(joined)[0], area_in_plane(planar_box(0, 0, 30, 21)), 1e-6);
  // Along the antimeridian, where each half has another corner.
  const CellTable cut =
      planar_table({{planar_polygon({{{170, 0}, {180, 0}, {180, 3}, {180, 10}}}),
                     planar_polygon({{{-180, 0}, {-170, 5}, {-180, 10}, {-180, 7}}})}});
  EXPECT_EQ(cut.cells.rings.size(), 2U);
}

TEST(overlay_plane, overlapping_features_are_told_or_divided) {
  const std::string box = planar_polygon({planar_box(0, 0, 10, 10)});
  const std::vector<std::string> others = {
      box, planar_polygon({planar_box(3, 3, 6, 6)}), planar_polygon({planar_box(0, 0, 5, 10)}),
      planar_polygon({planar_box(5, 5, 15, 15)}), planar_polygon({planar_box(-5, -5, 15, 15)})};
  for (const std::string& other : others) {
    const std::string message =
        planar_message({{box}, {other}}, {.overlap = PolygonOverlap::error});
    EXPECT_TRUE(message.starts_with("features 0 (f0) and 1 (f1) overlap at ")) << message;
    const CellTable kept = planar_table({{box}, {other}});
    const CellTable table = planar_table({{other}, {box}}, {.overlap = PolygonOverlap::first});
    EXPECT_TRUE(overlapping_cells(table.cells).empty());
    EXPECT_NEAR(areas(table.cells)[0], areas(kept.cells)[1], 1e-12);
    EXPECT_LE(areas(table.cells)[1], areas(kept.cells)[0]);
  }
  EXPECT_EQ(planar_message({{box}, {planar_polygon({planar_box(10, 5, 12, 7)})}},
                           {.overlap = PolygonOverlap::error}),
            "");
  // On another turn of the globe.
  EXPECT_TRUE(planar_message({{planar_polygon({planar_box(-10, 0, 10, 10)})},
                              {planar_polygon({planar_box(355, 1, 358, 2)})}},
                             {.overlap = PolygonOverlap::error})
                  .starts_with("features 0 (f0) and 1 (f1) overlap"));
  // The least feature has what three share.
  const CellTable three = planar_table({{planar_polygon({planar_box(0, 0, 4, 4)})},
                                        {planar_polygon({planar_box(2, 0, 6, 4)})},
                                        {planar_polygon({planar_box(3, 1, 8, 3)})},
                                        {planar_polygon({planar_box(-180, -90, 180, 90)})}},
                                       {.overlap = PolygonOverlap::first});
  const std::vector<double> found = areas(three.cells);
  EXPECT_NEAR(found[0], area_in_plane(planar_box(0, 0, 4, 4)), 1e-7);
  EXPECT_NEAR(found[1], area_in_plane(planar_box(4, 0, 6, 4)), 1e-7);
  EXPECT_NEAR(found[2], area_in_plane(planar_box(6, 1, 8, 3)), 1e-7);
  EXPECT_NEAR(found[0] + found[1] + found[2] + found[3], 4 * std::numbers::pi, 1e-12);
}

TEST(overlay_plane, rings_around_a_pole) {
  RingInPlane ring;
  for (int lon = -180; lon < 180; lon += 10) ring.push_back({static_cast<double>(lon), -70});
  const std::string polygon = planar_polygon({ring});
  EXPECT_NE(planar_message({{polygon}})
                .find("its side from 170 -70 to -180 -70 spans more than 180 degrees"),
            std::string::npos);
  const PolygonOptions geodesic = {.edges = PolygonEdges::geodesic};
  // 36 triangles at the pole, of which two angles are equal: tan(angle) = 1 / (tan(5 degrees) cos(20 degrees)).
  constexpr double degree = std::numbers::pi / 180;
  const double angle = std::atan(1 / (std::tan(5 * degree) * std::cos(20 * degree)));
  const double cap = 36 * (10 * degree + 2 * angle - std::numbers::pi);
  EXPECT_NEAR(areas(planar_table({{polygon}}, geodesic).cells)[0], cap, 1e-12);
  // Closed at the other end of the map.
  const std::string turn = polygon.substr(0, polygon.rfind("[-180")) + "[180,-70]]]";
  EXPECT_NEAR(areas(planar_table({{turn}}, geodesic).cells)[0], cap, 1e-12);
  EXPECT_NE(planar_message({{turn}}).find("goes around the globe from -180 -70 and is not closed"),
            std::string::npos);
}

TEST(overlay_plane, geodesic_rings_are_checked_on_the_sphere) {
  const PolygonOptions geodesic = {.edges = PolygonEdges::geodesic};
  const std::string message =
      planar_message({{planar_polygon({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}})}}, geodesic);
  EXPECT_TRUE(message.starts_with("feature 0 (f0): ")) << message;
  EXPECT_NE(message.find("itself"), std::string::npos) << message;
  EXPECT_NE(planar_message({{planar_polygon({{{0, 0}, {180, 0}, {90, 80}}})}}, geodesic)
                .find("antipodes"),
            std::string::npos);
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const double w = std::pow(10.0, -uniform_between(random, 6, 11));
    const RingInPlane sliver = {{20, 30}, {21, 30.3}, {20.4, 30.12 + 0.001 + w}};
    const double area = areas(planar_table({{planar_polygon({sliver})}}, geodesic).cells)[0];
    EXPECT_GE(area, 0);
    EXPECT_LT(area, 1e-5);
  }
}

// Sides that run to and fro vanish: what is left of a feature is all, or nothing, or less than its parts are.
TEST(overlay_plane, geodesic_parts_that_cancel_each_other) {
  const PolygonOptions geodesic = {.edges = PolygonEdges::geodesic};
  std::vector<std::string> octants;
  for (const double pole : {90, -90}) {
    for (const double west : {-180, -90, 0, 90}) {
      octants.push_back(planar_polygon({{{west, 0}, {west + 90, 0}, {0, pole}}}));
    }
  }
  const CellRings all = planar_table({octants, {}}, geodesic).cells;
  EXPECT_EQ(all.whole, std::vector<Index>{0});
  EXPECT_EQ(areas(all), (std::vector<double>{4 * std::numbers::pi, 0}));
  const auto message = [&](const std::vector<std::string>& parts) {
    return planar_message({parts}, geodesic);
  };
  std::vector<std::string> more = octants;
  more.push_back(octants[5]);
  EXPECT_TRUE(message(more).starts_with("feature 0 (f0): part 5 and part 8 overlap at "))
      << message(more);
  more.insert(more.end(), octants.begin(), octants.end());
  EXPECT_TRUE(message(more).starts_with("feature 0 (f0): part 0 and part 9 overlap at "))
      << message(more);
  octants.pop_back();
  EXPECT_NEAR(areas(planar_table({octants}, geodesic).cells)[0], 3.5 * std::numbers::pi, 1e-14);

  const RingInPlane box = planar_box(10, 10, 20, 20);
  EXPECT_EQ(message({planar_polygon({box, box})}),
            "feature 0 (f0): the holes of ring 0 of part 0 leave nothing of it");
  EXPECT_EQ(message({octants[0],
                     planar_polygon({box, {box[0], box[1], box[2]}, {box[0], box[2], box[3]}})}),
            "feature 0 (f0): the holes of ring 0 of part 1 leave nothing of it");
  EXPECT_EQ(message({planar_polygon({{{5, 5}, {10, 8}, {20, 3}, {10, 8}}})}),
            "feature 0 (f0): ring 0 of part 0 runs to and fro along a line at 5 5");
  EXPECT_EQ(message({planar_polygon({box, {{12, 12}, {13, 15}, {14, 12}, {13, 15}}})}),
            "feature 0 (f0): ring 1 of part 0 runs to and fro along a line at 12 12");
  // Over the pole and back, on one great circle; and all of it.
  EXPECT_EQ(message({planar_polygon({{{0, 80}, {180, 80}, {180, 70}, {0, 70}}})}),
            "feature 0 (f0): ring 0 of part 0 runs to and fro along a line at 0 80");
  EXPECT_EQ(message({planar_polygon({{{0, 0}, {90, 0}, {180, 0}, {-90, 0}}})}), "");
  EXPECT_EQ(
      message({planar_polygon({box, planar_box(30, 30, 40, 40)})}),
      "feature 0 (f0): ring 1 of part 0, a hole, does not lie inside of its polygon at 30 30");
  EXPECT_EQ(
      message({planar_polygon({box, planar_box(11, 11, 19, 19), planar_box(12, 12, 13, 13)})}),
      "feature 0 (f0): ring 2 of part 0, a hole, does not lie inside of its polygon but in "
      "ring 1 of part 0 at 12 12");
}

}  // namespace
}  // namespace rondel::test
