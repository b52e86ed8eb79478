// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Remapping between two parts of the sphere, neither of which covers it.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "unit/overlay/shapes.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

// The cells of which `is_in` is true; others are empty.
CellRings some_of(const CellRings& all, const std::function<bool(std::size_t)>& is_in) {
  CellRings result;
  result.points = all.points;
  for (std::size_t i = 0; i < all.num_cells(); ++i) {
    for (auto r = all.cells[i]; is_in(i) && r < all.cells[i + 1]; ++r) {
      for (auto k = all.rings[r]; k < all.rings[r + 1]; ++k) {
        result.corners.push_back(all.corners[k]);
      }
      result.rings.push_back(result.corners.size());
    }
    result.cells.push_back(result.rings.size() - 1);
  }
  return result;
}

RingOfPart rectangle(double west, double south, double east, double north) {
  return {{{west, south}, {east, south}, {east, north}, {west, north}}};
}
RingOfPart rectangular_hole(double west, double south, double east, double north) {
  return {{{west, south}, {west, north}, {east, north}, {east, south}}};
}

// 12 corners around the north pole, counterclockwise, at a distance of so many degrees.
std::vector<LonLat> circle_of(double radius) {
  std::vector<LonLat> corners;
  for (int k = 0; k < 12; ++k) corners.push_back({30.0 * k, 90 - radius});
  return corners;
}

double total_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(overlay_parts, pieces_are_those_of_clipping) {
  const auto first = triangulation_of("uniform", 120, 1);
  const auto second = triangulation_of("uniform", 160, 2);
  const auto in_first = [&](std::size_t i) { return first.sites().points()[i].z > -0.2; };
  const auto in_second = [&](std::size_t j) { return j % 3 != 0; };
  const CellSet source = CellSet::polygons(some_of(CellSet::voronoi(first).rings(), in_first));
  const CellSet target = CellSet::polygons(some_of(CellSet::voronoi(second).rings(), in_second));
  ASSERT_FALSE(source.covers_sphere() || target.covers_sphere());
  const Cells sources = cells(first);
  const Cells targets = cells(second);
  const Remap there = remap(source, target);
  const Remap back = remap(target, source);
  for (std::size_t i = 0; i < 120; ++i) {
    for (std::size_t j = 0; j < 160; ++j) {
      const auto expected = in_first(i) && in_second(j)
                                ? static_cast<double>(area_of_piece(sources, i, targets, j))
                                : 0;
      EXPECT_NEAR(piece_of(there, i, j), expected, 1e-15) << i << ' ' << j;
      EXPECT_NEAR(piece_of(back, j, i), expected, 1e-15) << i << ' ' << j;
    }
  }
}

LongRing long_ring(const RingOfPart& ring) {
  LongRing result;
  for (const LonLat& corner : ring.corners) result.push_back(long_vector(unit_vector(corner)));
  return result;
}

// What is filled up has corners on one hemisphere alone, what is laid over it goes around the other one.
TEST(overlay_parts, of_one_hemisphere) {
  const RingOfPart patch = rectangle(0, 10, 40, 50);
  const std::vector<RingOfPart> around = {rectangle(10, -60, 100, 30), rectangle(-100, -70, 5, 40),
                                          rectangle(170, -80, 260, -5), rectangle(30, 40, 50, 80)};
  const CellSet source = CellSet::polygons(cells_of_parts({{patch}}));
  std::vector<std::vector<RingOfPart>> cells;
  for (const RingOfPart& ring : around) cells.push_back({ring});
  const CellSet target = CellSet::polygons(cells_of_parts(cells));
  for (const bool is_back : {false, true}) {
    const Remap result = is_back ? remap(target, source) : remap(source, target);
    for (std::size_t j = 0; j < around.size(); ++j) {
      LongRing piece = long_ring(patch);
      const LongRing other = long_ring(around[j]);
      for (std::size_t k = 0; k < 4 && piece.size() > 2; ++k) {
        piece = clipped(piece, other[k], other[(k + 1) % 4]);
      }
      const double found = is_back ? piece_of(result, j, 0) : piece_of(result, 0, j);
      EXPECT_NEAR(found, static_cast<double>(area_of(piece)), 1e-15) << j;
    }
  }
}

// Regions are no more convex, have holes and several rings, and touch themselves in corners.
TEST(overlay_parts, regions_onto_regions) {
  const auto regions = [](std::size_t n, std::uint64_t seed) {
    const CellRings all = CellSet::voronoi(triangulation_of("uniform", n, seed)).rings();
    return std::pair(all, random_groups(n, 7, seed, true));
  };
  const auto [first, first_groups] = regions(400, 3);
  const auto [second, second_groups] = regions(300, 4);
  const Remap of_cells = remap(CellSet::polygons(first), CellSet::polygons(second));
  std::vector<double> expected(49);
  for (std::size_t j = 0; j < 300; ++j) {
    for (auto k = of_cells.pieces.offsets[j]; k < of_cells.pieces.offsets[j + 1]; ++k) {
      const Index from = first_groups[of_cells.pieces.values[k]];
      const Index to = second_groups[j];
      if (from != no_index && to != no_index) expected[7 * to + from] += of_cells.areas[k];
    }
  }
  const CellSet source = CellSet::polygons(dissolve(first, first_groups, 7));
  const CellSet target = CellSet::polygons(dissolve(second, second_groups, 7));
  const Remap result = remap(source, target, {.order = 2});
  for (Index i = 0; i < 7; ++i) {
    for (Index j = 0; j < 7; ++j) {
      EXPECT_NEAR(piece_of(result, i, j), expected[7 * j + i], 1e-14) << i << ' ' << j;
    }
  }
}

TEST(overlay_parts, patches_of_one_diagram_are_the_identity) {
  for (const char* kind : {"uniform", "clustered", "globe_grid", "regional_grid"}) {
    const CellRings all = CellSet::voronoi(triangulation_of(kind, 500, 5)).rings();
    const CellSet source =
        CellSet::polygons(some_of(all, [](std::size_t i) { return i % 5 != 0; }));
    const CellSet target =
        CellSet::polygons(some_of(all, [](std::size_t i) { return i % 7 != 0; }));
    const Remap result = remap(source, target);
    for (std::size_t j = 0; j < all.num_cells(); ++j) {
      if (target.areas()[j] == 0 || source.areas()[j] == 0) {
        EXPECT_EQ(result.pieces.offsets[j], result.pieces.offsets[j + 1]) << kind << ' ' << j;
      } else {
        ASSERT_EQ(result.pieces.offsets[j + 1] - result.pieces.offsets[j], 1U) << kind << ' ' << j;
        EXPECT_EQ(result.pieces.values[result.pieces.offsets[j]], j);
        EXPECT_EQ(result.weights.values[result.pieces.offsets[j]], 1);
      }
    }
  }
}

TEST(overlay_parts, holes_and_what_is_in_them) {
  const CellSet ring = CellSet::polygons(cells_of_parts(
      {{rectangle(0, 0, 30, 30), rectangular_hole(10, 10, 20, 20)}, {rectangle(-20, 0, 0, 30)}}));
  const CellSet island = CellSet::polygons(cells_of_parts({{rectangle(10, 10, 20, 20)}}));
  EXPECT_TRUE(remap(ring, island).areas.empty());
  EXPECT_TRUE(remap(island, ring).areas.empty());
  const CellSet within = CellSet::polygons(cells_of_parts({{rectangle(12, 12, 18, 18)}}));
  EXPECT_TRUE(remap(ring, within).areas.empty());
  const CellSet box_around = CellSet::polygons(cells_of_parts({{rectangle(-90, -40, 80, 60)}}));
  for (const auto& result : {remap(ring, box_around), remap(box_around, ring)}) {
    EXPECT_NEAR(total_of(result.areas), ring.areas()[0] + ring.areas()[1], 1e-14);
  }
  const CellSet far = CellSet::polygons(cells_of_parts({{rectangle(150, -30, 170, -10)}}));
  EXPECT_TRUE(remap(ring, far).areas.empty());
  EXPECT_TRUE(remap(ring, CellSet::polygons(cells_of_parts({{}, {}}))).areas.empty());
  EXPECT_TRUE(remap(CellSet::polygons(cells_of_parts({})), ring).areas.empty());
}

// What is opposite of a cell's center of mass is inside of it, where triangles around that are anything.
TEST(overlay_parts, of_nearly_the_whole_sphere) {
  std::vector<RingOfPart> holes;
  std::vector<std::vector<RingOfPart>> islands;
  for (const double lon : {0.0, 120.0, 240.0}) {
    holes.push_back(rectangular_hole(lon - 5, -70, lon + 5, -60));
    islands.push_back({rectangle(lon - 5, -70, lon + 5, -60)});
  }
  const CellSet sea = CellSet::polygons(cells_of_parts({holes}));
  const CellSet land = CellSet::polygons(cells_of_parts(islands));
  const CellSet octants = CellSet::triangles(delaunay(
      std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}));
  ASSERT_TRUE(octants.covers_sphere());
  const Remap of_sea = remap(sea, octants);
  const Remap of_land = remap(land, octants);
  for (Index j = 0; j < 8; ++j) {
    double sum = piece_of(of_sea, 0, j);
    for (Index i = 0; i < 3; ++i) sum += piece_of(of_land, i, j);
    EXPECT_NEAR(sum, std::numbers::pi / 2, 1e-14) << j;
  }
}

// More than a hemisphere, with what is opposite of its center of mass inside, or with that in no direction at all.
TEST(overlay_parts, areas_of_large_cells) {
  constexpr double sphere = 4 * std::numbers::pi;
  const auto area_of_cap = [](double radius) {
    const CellSet cap = CellSet::polygons(cells_of_parts({{{circle_of(radius)}}}));
    return cap.areas()[0];
  };
  for (const double radius : {1.0, 10.0, 60.0, 89.0, 91.0, 120.0, 179.0}) {
    RingOfPart outside{circle_of(radius)};
    std::ranges::reverse(outside.corners);
    const CellSet without = CellSet::polygons(cells_of_parts({{outside}}));
    // 12 triangles with the apex at the pole and equal sides.
    const double half = std::numbers::pi / 12;
    const double angle = radius * std::numbers::pi / 180;
    const double known =
        12 * (2 * half - 2 * std::atan2(std::cos(angle) * std::sin(half), std::cos(half)));
    EXPECT_NEAR(area_of_cap(radius), known, 1e-13) << radius;
    EXPECT_NEAR(without.areas()[0], sphere - known, 1e-13) << radius;
  }
  const RingOfPart south{circle_of(120)};
  RingOfPart north{circle_of(60)};
  std::ranges::reverse(north.corners);
  EXPECT_NEAR(CellSet::polygons(cells_of_parts({{south, north}})).areas()[0],
              sphere - 2 * area_of_cap(60), 1e-13);
  std::vector<RingOfPart> holes;
  double islands = 0;
  for (const double lon : {0.0, 120.0, 240.0}) {
    holes.push_back(rectangular_hole(lon - 5, -70, lon + 5, -60));
    islands +=
        CellSet::polygons(cells_of_parts({{rectangle(lon - 5, -70, lon + 5, -60)}})).areas()[0];
  }
  EXPECT_NEAR(CellSet::polygons(cells_of_parts({holes})).areas()[0], sphere - islands, 1e-13);
}

// A cell beside two smaller ones, whose common corner lies on its side; ends of the axes inside, on sides, and corners.
TEST(overlay_parts, corners_on_sides) {
  const CellSet uneven = CellSet::polygons(cells_of_parts({{rectangle(-30, 0, 0, 40)},
                                                           {{{{0, 0}, {45, 0}, {0, 40}}}},
                                                           {{{{45, 0}, {90, 0}, {0, 90}, {0, 40}}}},
                                                           {{{{-30, 0}, {30, -40}, {90, 0}}}}}));
  const CellSet other = CellSet::polygons(
      cells_of_parts({{rectangle(-20, -20, 50, 30)}, {rectangle(50, -20, 70, 30)}}));
  const Remap there = remap(uneven, other);
  const Remap back = remap(other, uneven);
  // Each cell by itself leaves no corner on a side.
  for (Index i = 0; i < 4; ++i) {
    const CellSet alone =
        CellSet::polygons(some_of(uneven.rings(), [&](std::size_t k) { return k == i; }));
    const Remap expected = remap(alone, other);
    for (Index j = 0; j < 2; ++j) {
      EXPECT_NEAR(piece_of(there, i, j), piece_of(expected, i, j), 1e-15) << i << ' ' << j;
      EXPECT_NEAR(piece_of(back, j, i), piece_of(expected, i, j), 1e-15) << i << ' ' << j;
    }
  }
  EXPECT_NEAR(total_of(there.areas), total_of(back.areas), 1e-14);
}

// Cells that cross, that are inside of others, that are there twice, and that are inside of themselves.
TEST(overlay_parts, names_cells_that_overlap) {
  const RingOfPart box = rectangle(0, 0, 20, 20);
  const RingOfPart within = rectangle(5, 5, 9, 9);
  const RingOfPart apart = rectangle(-50, 0, -40, 10);
  const auto message_of = [&](const std::vector<std::vector<RingOfPart>>& cells) {
    const CellSet source = CellSet::polygons(cells_of_parts(cells));
    const CellSet target = CellSet::polygons(cells_of_parts({{apart}, {box}}));
    try {
      (void)remap(source, target);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const std::string pair = "source cells 0 and 1 overlap at ";
  EXPECT_EQ(
      message_of({{box}, {rectangle(10, 10, 30, 30)}}),
      pair + "14.9648 15.1233; --overlap first or share (overlap='first' in Python) takes them");
  EXPECT_EQ(message_of({{apart}, {box}, {within}}).substr(0, 29), "source cells 1 and 2 overlap ");
  EXPECT_EQ(message_of({{within}, {box}}).substr(0, pair.size()), pair);
  EXPECT_EQ(message_of({{box}, {box}}).substr(0, pair.size()), pair);
  const std::string alone = "source cell 0 crosses or overlaps itself at ";
  EXPECT_EQ(message_of({{box, within}}).substr(0, alone.size()), alone);
  EXPECT_EQ(message_of({{box, box}, {apart}}).substr(0, alone.size()), alone);
  EXPECT_EQ(message_of({{box, rectangular_hole(5, 5, 9, 9)}, {within}}), "nothing");
  // Where the great circles through two of its sides meet, by their normals.
  const RingOfPart bow_tie = {{{0, 0}, {20, 0}, {0, 20}, {20, 20}, {-10, 10}}};
  EXPECT_EQ(message_of({{bow_tie}, {apart}}), alone + "4.8249 15.5662");
}

// What crosses itself has no area and no center, which is said as remap() says it.
TEST(overlay_parts, that_cross_themselves_have_no_areas) {
  const RingOfPart box = rectangle(0, 0, 20, 20);
  const RingOfPart bow_tie = {{{0, 0}, {20, 0}, {0, 20}, {20, 20}, {-10, 10}}};
  const CellSet wrong = CellSet::polygons(cells_of_parts({{box}, {bow_tie}}));
  const std::string message = "cell 1 crosses or overlaps itself at 4.8249 15.5662";
  for (int time = 0; time < 2; ++time) {
    try {
      (void)wrong.areas();
      ADD_FAILURE();
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.what(), message);
      EXPECT_EQ(error.index(), 1U);
    }
    EXPECT_THROW((void)wrong.centers(), InvalidInput);
  }
  // Cells that overlap others have areas, and so have parts that touch in a corner.
  const RingOfPart other = rectangle(20, 20, 40, 40);
  const CellSet sound =
      CellSet::polygons(cells_of_parts({{box, other}, {rectangle(10, 10, 30, 30)}}));
  const std::vector<double> alone =
      areas(cells_of_parts({{box}, {other}, {rectangle(10, 10, 30, 30)}}));
  EXPECT_NEAR(sound.areas()[0], alone[0] + alone[1], 1e-15);
  EXPECT_NEAR(sound.areas()[1], alone[2], 1e-15);
}

// Two covers of the sphere by lunes, which have nothing but the poles in common: whatever is beyond a side is some cell.
TEST(overlay_parts, names_cells_of_two_covers) {
  std::vector<std::vector<RingOfPart>> lunes;
  for (const double west : {0.0, 120.0, 240.0, 60.0, 180.0, 300.0}) {
    lunes.push_back({{{{0, 90}, {west, 0}, {0, -90}, {west + 120, 0}}}});
  }
  const CellSet twice = CellSet::polygons(cells_of_parts(lunes));
  ASSERT_FALSE(twice.covers_sphere());
  EXPECT_NEAR(total_of({twice.areas().begin(), twice.areas().end()}), 8 * std::numbers::pi, 1e-13);
  try {
    (void)remap(twice, twice);
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 31), "source cells 0 and 3 overlap at");
  }
}

// What two cells share is the first one's, or counts half for each.
TEST(overlay_parts, places_of_two_cells) {
  const CellRings both = cells_of_parts({{rectangle(0, 0, 20, 20)}, {rectangle(10, 10, 30, 30)}});
  const CellSet twice = CellSet::polygons(both);
  const auto alone = [&](Index i) {
    return CellSet::polygons(some_of(both, [&](std::size_t k) { return k == i; }));
  };
  const RegionPieces shared = intersection(alone(0), alone(1));
  const CellSet middle = CellSet::polygons(shared.rings);
  const CellSet plain = CellSet::polygons(cells_of_parts(
      {{rectangle(8, 8, 12, 12)}, {rectangle(20, 20, 25, 25)}, {rectangle(12, 8, 19, 12)}}));
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 500, 9));
  const CellSet grid = CellSet::lonlat_grid({{0, 5, 12, 18, 40}, {-5, 3, 11, 16, 45}});
  for (const CellSet* other : {&plain, &cover, &grid}) {
    EXPECT_THROW((void)remap(twice, *other), InvalidInput);
    EXPECT_THROW((void)remap(*other, twice), InvalidInput);
    const Remap of_middle = remap(middle, *other);
    for (const CellOverlap rule : {CellOverlap::first, CellOverlap::share}) {
      const RemapOptions options{.overlap = rule};
      const Remap there = remap(twice, *other, options);
      const Remap back = remap(*other, twice, options);
      for (Index i = 0; i < 2; ++i) {
        const Remap whole = remap(alone(i), *other);
        const double lost = rule == CellOverlap::share ? 0.5 : i;
        EXPECT_NEAR(there.source_areas[i], twice.areas()[i] - lost * middle.areas()[0], 1e-15);
        for (Index j = 0; j < other->num_cells(); ++j) {
          const double expected = piece_of(whole, i, j) - lost * piece_of(of_middle, 0, j);
          EXPECT_NEAR(piece_of(there, i, j), expected, 1e-15) << i << ' ' << j;
          EXPECT_NEAR(piece_of(back, j, i), expected, 1e-15) << i << ' ' << j;
        }
      }
    }
  }
}

// A cell with a hole that is larger than a quarter of the sphere, inside of one cell that is nearly half of it.
TEST(overlay_parts, a_large_cell_within_one_cell) {
  std::vector<LonLat> places = {{0, 90}, {0, -70}, {120, -70}, {240, -70}};
  const std::vector<Point> points = unit_vectors(places);
  const Triangulation sites = delaunay(Sites::view(points));
  const CellSet cover = CellSet::voronoi(sites);
  std::vector<LonLat> hole = circle_of(10);
  std::ranges::reverse(hole);
  const CellSet ring = CellSet::polygons(cells_of_parts({{{circle_of(70)}, {hole}}}));
  ASSERT_GT(ring.areas()[0], 1.1 * std::numbers::pi);
  ASSERT_GT(cover.areas()[0], ring.areas()[0]);
  const Remap there = remap(ring, cover);
  const Remap back = remap(cover, ring);
  EXPECT_NEAR(piece_of(there, 0, 0), ring.areas()[0], 1e-13);
  EXPECT_NEAR(piece_of(back, 0, 0), ring.areas()[0], 1e-13);
  EXPECT_EQ(there.pieces.values.size(), 1U);
  EXPECT_EQ(back.pieces.values.size(), 1U);
}

// Each of two equal cells has half of every piece, and half of its moment around the mean that both have.
TEST(overlay_parts, equal_cells_share_moments) {
  const CellSet once = CellSet::polygons(cells_of_parts({{rectangle(0, 0, 20, 20)}}));
  const CellSet twice =
      CellSet::polygons(cells_of_parts({{rectangle(0, 0, 20, 20)}, {rectangle(0, 0, 20, 20)}}));
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 500, 9));
  const Remap whole = remap(once, cover, {.order = 2});
  const Remap halves = remap(twice, cover, {.order = 2, .overlap = CellOverlap::share});
  ASSERT_EQ(halves.pieces.values.size(), 2 * whole.pieces.values.size());
  ASSERT_GT(whole.pieces.values.size(), 4U);
  for (std::size_t k = 0; k < halves.pieces.values.size(); ++k) {
    EXPECT_EQ(halves.pieces.values[k], k % 2);
    EXPECT_NEAR(halves.areas[k], whole.areas[k / 2] / 2, 1e-15);
    const Point difference = halves.moments[k] - 0.5 * whole.moments[k / 2];
    EXPECT_LT(norm(difference), 1e-15) << k;
  }
}

// Gradients of cells are those that they have without two equal cells elsewhere.
TEST(overlay_parts, equal_cells_do_not_turn_gradients) {
  std::vector<std::vector<RingOfPart>> plain;
  for (int k = 0; k < 25; ++k) {
    const double west = 8 * (k % 5);
    const double south = 8 * std::floor(k / 5.0);
    plain.push_back({rectangle(west, south, west + 8, south + 8)});
  }
  std::vector<std::vector<RingOfPart>> more = plain;
  for (int twice = 0; twice < 2; ++twice) more.push_back({rectangle(150, 0, 158, 8)});
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 2000, 11));
  const Weights wanted =
      remap(CellSet::polygons(cells_of_parts(plain)), cover, {.order = 2}).weights;
  const Weights found = remap(CellSet::polygons(cells_of_parts(more)), cover,
                              {.order = 2, .overlap = CellOverlap::share})
                            .weights;
  ASSERT_GT(wanted.values.size(), 100U);
  for (std::size_t j = 0; j < cover.num_cells(); ++j) {
    const std::uint64_t size = wanted.offsets[j + 1] - wanted.offsets[j];
    if (size == 0) continue;
    ASSERT_EQ(found.offsets[j + 1] - found.offsets[j], size) << j;
    for (std::uint64_t k = 0; k < size; ++k) {
      EXPECT_EQ(found.columns[found.offsets[j] + k], wanted.columns[wanted.offsets[j] + k]);
      EXPECT_NEAR(found.values[found.offsets[j] + k], wanted.values[wanted.offsets[j] + k], 1e-10);
    }
  }
}

// A row of cells that is there twice, as the folds of ocean grids are.
TEST(overlay_parts, cells_that_are_there_twice) {
  const CellRings cells = CellSet::voronoi(triangulation_of("uniform", 60, 10)).rings();
  CellRings twice = cells;
  for (const std::size_t i : {7U, 8U, 9U}) {
    for (auto k = cells.rings[i]; k < cells.rings[i + 1]; ++k) {
      twice.corners.push_back(cells.corners[k]);
    }
    twice.rings.push_back(twice.corners.size());
    twice.cells.push_back(twice.rings.size() - 1);
  }
  const CellSet source = CellSet::polygons(twice);
  const CellSet grid = CellSet::lonlat_grid({{0, 90, 180, 270, 360}, {-90, -30, 30, 90}});
  const CellSet other = CellSet::voronoi(triangulation_of("uniform", 80, 11));
  std::vector<double> values(63);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(i < 60 ? i : i - 53);
  }
  for (const CellSet* target : {&grid, &other}) {
    try {
      (void)remap(source, *target);
      ADD_FAILURE();
    } catch (const InvalidInput& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 30), "source cells 7 and 60 overlap ");
    }
    const Remap once = remap(CellSet::polygons(cells), *target);
    std::vector<double> expected(target->num_cells());
    apply(once.weights, std::span(values).first(60), expected);
    std::vector<std::int32_t> mask(63, 1);
    mask[7] = mask[61] = mask[9] = 0;
    for (const RemapOptions& options :
         {RemapOptions{.overlap = CellOverlap::first}, RemapOptions{.overlap = CellOverlap::share},
          RemapOptions{.source_mask = mask}}) {
      const Remap found = remap(source, *target, options);
      std::vector<double> out(target->num_cells());
      apply(found.weights, values, out);
      for (std::size_t j = 0; j < out.size(); ++j) EXPECT_NEAR(out[j], expected[j], 1e-12) << j;
      for (const double fraction : found.target_fractions) EXPECT_NEAR(fraction, 1, 1e-13);
    }
  }
}

// Sides that a cell has to and fro bound nothing: a cut inwards, one outwards, and two rings along it.
TEST(overlay_parts, sides_that_bound_nothing) {
  const RingOfPart plain = {{{0, 0}, {20, 0}, {20, 20}, {0, 20}}};
  const RingOfPart inwards = {{{0, 0}, {20, 0}, {20, 20}, {10, 10}, {20, 20}, {0, 20}}};
  const RingOfPart outwards = {{{0, 0}, {20, 0}, {20, 20}, {30, 33}, {20, 20}, {0, 20}}};
  const CellSet other =
      CellSet::polygons(cells_of_parts({{rectangle(-5, 3, 12, 50)},
                                        {rectangle(12, 3, 40, 50)},
                                        {{{{-5, -9}, {40, -9}, {40, 3}, {12, 3}, {-5, 3}}}},
                                        {rectangle(50, 3, 60, 20)},
                                        {rectangle(60, 3, 70, 20)}}));
  const Remap expected = remap(CellSet::polygons(cells_of_parts({{plain}})), other);
  const std::vector<std::vector<RingOfPart>> cells = {
      {inwards}, {outwards}, {{{{0, 0}, {20, 0}, {20, 20}}}, {{{0, 0}, {20, 20}, {0, 20}}}}};
  for (const auto& rings : cells) {
    const Remap result = remap(CellSet::polygons(cells_of_parts({rings})), other);
    ASSERT_EQ(result.pieces.values, expected.pieces.values);
    for (std::size_t k = 0; k < result.areas.size(); ++k) {
      EXPECT_NEAR(result.areas[k], expected.areas[k], 1e-15) << k;
    }
  }
}

TEST(overlay_parts, filling_tells_how_far_it_is_and_stops) {
  const auto part = [](std::uint64_t seed) {
    return CellSet::polygons(
        some_of(CellSet::voronoi(triangulation_of("uniform", 900, seed)).rings(),
                [](std::size_t i) { return i % 4 != 0; }));
  };
  const CellSet source = part(6);
  const CellSet target = part(7);
  std::vector<double> fractions;
  const auto listen = [&](std::string_view stage, double fraction) {
    if (stage == "fill") fractions.push_back(fraction);
  };
  (void)remap(source, target, {}, {.threads = 1, .progress = listen});
  EXPECT_GT(fractions.size(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(fractions.back(), 1);
  std::atomic<bool> stop = false;
  const auto halt = [&](std::string_view stage, double) { stop = stop || stage == "fill"; };
  EXPECT_THROW((void)remap(source, target, {}, {.threads = 1, .progress = halt, .stop = &stop}),
               Interrupted);
}

// A mesh of a patch of 1e-6 radians, beside itself turned by less than an ulp and more.
TEST(overlay_parts, patches_that_nearly_agree) {
  for (const double shift : {0.0, 1e-17, 1e-16, 1e-12, 1e-8}) {
    const auto patch = [](double by) {
      CellRings rings;
      for (int y = 0; y <= 10; ++y) {
        for (int x = 0; x <= 10; ++x) {
          rings.points.push_back(normalized(Point{1, 1e-7 * x + by, 1e-7 * y + 0.5}));
        }
      }
      for (Index y = 0; y < 10; ++y) {
        for (Index x = 0; x < 10; ++x) {
          const Index p = 11 * y + x;
          rings.corners.insert(rings.corners.end(), {p, p + 1, p + 12, p + 11});
          rings.rings.push_back(rings.corners.size());
          rings.cells.push_back(rings.rings.size() - 1);
        }
      }
      return CellSet::polygons(rings);
    };
    const CellSet source = patch(0);
    const CellSet target = patch(shift);
    const Remap result = remap(source, target);
    const double whole = std::accumulate(source.areas().begin(), source.areas().end(), 0.0);
    EXPECT_NEAR(total_of(result.areas) / whole, 1 - shift / 1e-6, 1e-8) << shift;
  }
}

}  // namespace
}  // namespace rondel::test
