// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons in longitude and latitude are valid, and equal along borders; judged by rational numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "inputs/kinds.h"
#include "rondel/cell_rings.h"
#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/polygons.h"
#include "rondel/regions.h"
#include "support/generators.h"
#include "support/planar_check.h"
#include "support/planar_features.h"
#include "support/temporary_files.h"
#include "unit/io/geojson_rings.h"
#include "unit/overlay/shapes.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

std::vector<PlanarRegion> regions_of(const LonLatRegions& drawn, std::size_t num_cells) {
  std::vector<PlanarRegion> regions(num_cells);
  for (std::size_t p = 0; p < drawn.owners.size(); ++p) {
    PlanarPolygon& polygon = regions[drawn.owners[p]].emplace_back();
    const auto& [ends, rings] = drawn.polygons;
    for (std::uint64_t r = ends[p]; r < ends[p + 1]; ++r) {
      polygon.emplace_back(rings[r].begin(), rings[r].end());
    }
  }
  return regions;
}

std::vector<PlanarRegion> drawn_regions(const CellRings& cells) {
  return regions_of(region_polygons(cells), cells.num_cells());
}

CellRings cells_of(const std::vector<std::vector<LonLat>>& rings) {
  std::vector<std::vector<RingOfPart>> cells;
  for (const auto& ring : rings) cells.push_back({{ring}});
  return cells_of_parts(cells);
}

// The checker finds what is wrong.
TEST(overlay_valid, the_judge_sees_faults) {
  const PlanarRing square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}};
  const PlanarRing hole = {{1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
  EXPECT_EQ(why_invalid({{square, hole}}), "");
  EXPECT_NE(why_invalid({{{{0, 0}, {4, 4}, {4, 0}, {0, 4}, {0, 0}}}}), "");
  EXPECT_NE(why_invalid({{{{0, 0}, {4, 0}, {2, 0}, {2, 2}, {0, 0}}}}), "");
  EXPECT_NE(why_invalid({{{{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}, {0, 0}}}}), "");
  EXPECT_NE(why_invalid({{square, {{1, 1}, {1, 5}, {2, 5}, {2, 1}, {1, 1}}}}), "");
  EXPECT_NE(why_invalid({{square, {{0, 1}, {0, 2}, {2, 2}, {2, 1}, {0, 1}}}}), "");
  EXPECT_NE(why_invalid({{square}, {{{1, 1}, {2, 1}, {2, 2}, {1, 1}}}}), "");
  EXPECT_NE(why_invalid({{square}, {{{4, 1}, {6, 1}, {4, 2}, {4, 1}}}}), "");
  EXPECT_EQ(why_invalid({{square, {{0, 2}, {2, 3}, {2, 1}, {0, 2}}}}), "");
  EXPECT_NE(why_invalid({{square, {{0, 2}, {2, 3}, {4, 2}, {2, 1}, {0, 2}}}}), "");
}

// Two arcs of 60 degrees, a millionth of a degree from each other at their ends, densified at different places.
TEST(overlay_valid, cells_narrower_than_the_tolerance) {
  for (const double width : {1e-3, 1e-6, 1e-9, 1e-11}) {
    const CellRings cells = cells_of({{{-30, 40}, {35, 41}, {33, 41 + width}, {-28, 40 + width}},
                                      {{-28, 40 + width}, {33, 41 + width}, {20, 60}},
                                      {{-30, 40}, {20, 10}, {35, 41}}});
    const auto regions = drawn_regions(cells);
    for (const PlanarRegion& region : regions) EXPECT_EQ(why_invalid(region), "") << width;
  }
}

TEST(overlay_valid, a_corner_in_one_neighbor_is_one_of_both) {
  const LonLat west{-20, 50};
  const LonLat east{40, 55};
  const auto middle = [](const LonLat& p, const LonLat& q) {
    const Point a = unit_vector(p);
    const Point b = unit_vector(q);
    const Point sum = {a.x + b.x, a.y + b.y, a.z + b.z};
    const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
    return Point{sum.x / length, sum.y / length, sum.z / length};
  };
  CellRings cells = cells_of({{west, east, {10, 70}}, {east, west, {5, 20}}});
  // The northern one has the middle of the border as a corner.
  cells.points.push_back(middle(west, east));
  cells.corners.insert(cells.corners.begin() + 1, static_cast<Index>(cells.points.size() - 1));
  for (std::size_t r = 1; r < cells.rings.size(); ++r) ++cells.rings[r];
  const auto regions = drawn_regions(cells);
  const std::size_t outline = count_single_sides({regions[0]}) + count_single_sides({regions[1]});
  const std::size_t both = count_single_sides(regions);
  EXPECT_LT(both, outline);
  const auto apart = drawn_regions(cells_of({{west, east, {10, 70}}, {east, west, {5, 20}}}));
  EXPECT_EQ(both, count_single_sides(apart));
}

// Returns the area of a region in the plane, in square degrees.
double planar_area_of(const PlanarRegion& region) {
  double sum = 0;
  for (const PlanarPolygon& polygon : region) {
    for (const PlanarRing& ring : polygon) {
      for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
        sum += ring[k].lon_deg * ring[k + 1].lat_deg - ring[k + 1].lon_deg * ring[k].lat_deg;
      }
    }
  }
  return sum / 2;
}

TEST(overlay_valid, cells_that_are_drawn_apart_may_overlap) {
  // Two boxes that overlap, one in another, the same box again, the whole sphere, nothing.
  const auto box = [](double west, double south, double size) {
    return std::vector<LonLat>{
        {west, south}, {west + size, south}, {west + size, south + size}, {west, south + size}};
  };
  CellRings cells = cells_of({box(0, 0, 2), box(1, 1, 2), box(0.5, 0.5, 1), box(0, 0, 2)});
  cells.whole = {4};
  cells.end_cell();
  cells.end_cell();
  const std::array<double, 6> expected = {4, 4, 1, 4, 360.0 * 180, 0};
  for (const unsigned threads : {1U, 2U}) {
    const auto regions =
        regions_of(region_polygons(cells, 0.01, {threads}, CellDrawing::apart), cells.num_cells());
    for (std::size_t i = 0; i < regions.size(); ++i) {
      EXPECT_NEAR(planar_area_of(regions[i]), expected[i], 1e-2) << i;
      EXPECT_EQ(why_invalid(regions[i]), "") << i;
    }
  }
  EXPECT_LT(planar_area_of(drawn_regions(cells)[1]), 3.1);
  EXPECT_EQ(name_of(CellDrawing::apart), "apart");
  EXPECT_EQ(name_of(CellDrawing::together), "together");
}

TEST(overlay_valid, shapes_that_are_drawn_apart_are_drawn_as_if_alone) {
  for (std::uint64_t seed = 0; seed < scaled(5); ++seed) {
    CellRings cells;
    std::vector<PlanarRegion> alone;
    for (std::size_t kind = 0; kind < shape_kinds.size(); ++kind) {
      const CellRings shape = one_cell_of(hostile_shape(kind, seed, {}));
      alone.push_back(drawn_regions(shape)[0]);
      const auto first = static_cast<Index>(cells.points.size());
      cells.points.insert(cells.points.end(), shape.points.begin(), shape.points.end());
      for (std::size_t r = 0; r + 1 < shape.rings.size(); ++r) {
        for (const Index corner : shape.corners_of(r)) cells.corners.push_back(first + corner);
        cells.end_ring();
      }
      cells.end_cell();
    }
    const auto apart =
        regions_of(region_polygons(cells, 0.01, {}, CellDrawing::apart), cells.num_cells());
    EXPECT_EQ(apart, alone) << seed;
  }
}

// Four cells around a corner, which is one point for the two in the west and another one for those in the east.
TEST(overlay_valid, corners_that_are_one_but_for_rounding) {
  for (const double away : {0.0, 1e-17, 5e-17, 1e-15, 3e-14}) {
    const LonLat south{0, 2};
    const LonLat north{0, 39};
    const LonLat corner{0, 26};
    const LonLat other{away, 26};
    const auto regions = drawn_regions(cells_of({{south, corner, {-30, 20}},
                                                 {corner, north, {-30, 20}},
                                                 {north, other, {30, 25}},
                                                 {other, south, {30, 25}}}));
    for (const PlanarRegion& region : regions) EXPECT_EQ(why_invalid(region), "") << away;
    const std::size_t num_single = count_single_sides(regions);
    const std::size_t num_in_west = count_single_sides({regions[0], regions[1]});
    const std::size_t num_in_east = count_single_sides({regions[2], regions[3]});
    EXPECT_EQ(num_single, num_in_west + num_in_east - 4) << away;
  }
}

// A crescent next to the pole, thinner than the tolerance: its lines enclose a part of the sphere to the right.
TEST(overlay_valid, thin_cells_do_not_become_all_else) {
  const CellRings crescent = cells_of(
      {{{123.7, 80.8}, {61.4, 72.4}, {72.7, 74.4}, {92.2, 75.9}, {101.1, 78.1}, {113.7, 80}}});
  for (const double tolerance : {0.01, 0.3, 1.0, 3.0, 10.0}) {
    const auto regions = regions_of(region_polygons(crescent, tolerance), 1);
    EXPECT_EQ(why_invalid(regions[0]), "") << tolerance;
    for (const PlanarPolygon& polygon : regions[0]) {
      for (const LonLat& p : polygon.front()) EXPECT_LT(std::abs(p.lon_deg), 130) << tolerance;
    }
  }
}

TEST(overlay_valid, the_whole_sphere_is_the_box) {
  CellRings cells;
  cells.cells = {0, 0, 0};
  cells.whole = {1};
  const LonLatRegions drawn = region_polygons(cells);
  ASSERT_EQ(drawn.owners, std::vector<Index>{1});
  const std::vector<LonLat> box = {{-180, -90}, {180, -90}, {180, 90}, {-180, 90}, {-180, -90}};
  EXPECT_EQ(drawn.polygons.rows.values, box);
  const std::string path = temporary_path("whole.geojson");
  write_regions(path, cells);
  const auto document = read_json(path);
  ASSERT_EQ(document["features"].size(), 1U);
  EXPECT_EQ(document["features"][0]["geometry"]["coordinates"][0].size(), 5U);
  EXPECT_NEAR(document["features"][0]["properties"]["area"].get<double>(), 12.566370614359172,
              1e-14);
}

constexpr std::array kinds = {"uniform",
                              "grid",
                              "paper-s",
                              "patch-and-globe",
                              "small-circle",
                              "meridian",
                              "meridian-rounded",
                              "rotated-circle-1",
                              "wedge",
                              "antipodal",
                              "orbit"};

Triangulation triangulation_of_kind(const char* kind) {
  return delaunay(inputs::make(*inputs::find_kind(kind), {.n = 14}).sites);
}

TEST(overlay_valid, bands_of_named_inputs) {
  const std::string path = temporary_path("valid_bands.geojson");
  for (const char* kind : kinds) {
    const Triangulation t = triangulation_of_kind(kind);
    Random random(7);
    std::vector<double> values(t.sites().size());
    for (double& value : values) value = static_cast<double>(random.below(1000)) / 500 - 1;
    write_bands(path, bands(t, values, std::vector<double>{-0.5, 0, 0.5}));
    for (const PlanarRegion& region : regions_of_features(read_json(path)))
      EXPECT_EQ(why_invalid(region), "") << kind;
  }
}

TEST(overlay_valid, groups_of_named_inputs) {
  for (const char* kind : std::span(kinds).first(4)) {
    const Triangulation t = triangulation_of_kind(kind);
    const CellSet cells = CellSet::voronoi(t);
    const CellRings joined = dissolve(cells.rings(), random_groups(t.sites().size(), 3, 5), 3);
    const auto regions = drawn_regions(joined);
    for (const PlanarRegion& region : regions) EXPECT_EQ(why_invalid(region), "") << kind;
  }
}

// Generators of sites that have a diagram in the model projected, and judge by rational numbers in little time.
template <class Test>
void for_each_generator(const Test& test) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const SiteSet set = generator.make(16, 5);
    test(delaunay(set.sites, {.sphere = set.sphere}), std::string(generator.name));
  }
}

void expect_valid(const std::vector<PlanarRegion>& regions, bool is_whole,
                  const std::string& name) {
  for (std::size_t i = 0; i < regions.size(); ++i)
    EXPECT_EQ(why_invalid(regions[i]), "") << name << " region " << i;
  if (is_whole) {
    EXPECT_EQ(count_single_sides(regions), 0U) << name;
  }
}

TEST(overlay_valid, cells_of_every_generator) {
  for_each_generator([](const Triangulation& t, const std::string& name) {
    const LonLatPolygons drawn = cell_polygons(t, diagram(t), 0.5);
    std::vector<PlanarRegion> regions(t.num_sites());
    for (std::size_t k = 0; k < drawn.owners.size(); ++k) {
      regions[drawn.owners[k]].push_back({{drawn.rings[k].begin(), drawn.rings[k].end()}});
    }
    expect_valid(regions, true, name);
  });
}

TEST(overlay_valid, bands_of_every_generator) {
  const std::string path = temporary_path("valid_bands_of_all.geojson");
  for_each_generator([&](const Triangulation& t, const std::string& name) {
    Random random(9);
    std::vector<double> values(t.sites().size());
    for (double& value : values) value = static_cast<double>(random.below(9)) / 4 - 1;
    write_bands(path, bands(t, values, std::vector<double>{-0.5, 0, 0.6}), 0.5);
    expect_valid(regions_of_features(read_json(path)),
                 t.dimension() == 2 && t.num_ghost_faces() == 0, name);
  });
}

TEST(overlay_valid, pieces_of_every_generator) {
  Random random(21);
  std::vector<Point> others(7);
  std::ranges::generate(others, [&] { return random_direction(random); });
  const CellSet regions = CellSet::voronoi(delaunay(others));
  for_each_generator([&](const Triangulation& t, const std::string& name) {
    const CellSet cells = CellSet::voronoi(t);
    const RegionPieces pieces = intersection(cells, regions);
    expect_valid(regions_of(region_polygons(pieces.rings, 0.5), pieces.num_pieces()), true, name);
    const CellRings joined = dissolve(pieces.rings, random_groups(pieces.num_pieces(), 3, 5), 3);
    expect_valid(regions_of(region_polygons(joined, 0.5), 3), true, name);
  });
}

}  // namespace
}  // namespace rondel::test
