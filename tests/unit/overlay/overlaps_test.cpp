// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The library finds which cells overlap by more than rounding.
#include "overlay/overlaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "support/random.h"
#include "unit/overlay/planar.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

using Positions = std::vector<std::pair<double, double>>;

Point place_of(const std::pair<double, double>& position) {
  constexpr double degree = std::numbers::pi / 180;
  const auto [lon, lat] = position;
  return normalized(Point{std::cos(lat * degree) * std::cos(lon * degree),
                          std::cos(lat * degree) * std::sin(lon * degree), std::sin(lat * degree)});
}

// A cell of one ring each, no point shared.
CellRings cells_of_positions(const std::vector<Positions>& rings) {
  CellRings cells;
  for (const Positions& ring : rings) {
    for (const auto& position : ring) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()));
      cells.points.push_back(place_of(position));
    }
    cells.rings.push_back(cells.corners.size());
    cells.cells.push_back(cells.rings.size() - 1);
  }
  return cells;
}

using Pairs = std::vector<std::pair<Index, Index>>;

Pairs pairs_of(const CellRings& cells) {
  Pairs pairs;
  for (const CrossingCells& pair : overlapping_cells(cells)) {
    pairs.emplace_back(pair.first, pair.second);
    EXPECT_NEAR(dot(pair.place, pair.place), 1, 1e-12);
  }
  return pairs;
}

const Positions large_box = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};

TEST(overlay_overlaps, cells_that_cross_contain_and_repeat_each_other) {
  const Positions crossing = {{10, 10}, {30, 10}, {30, 30}, {10, 30}};
  const Positions within = {{2, 2}, {4, 2}, {4, 4}, {2, 4}};
  const Positions beside = {{20, 0}, {30, 0}, {30, 9}, {20, 20}};
  const Positions apart = {{50, 0}, {60, 0}, {60, 9}};
  EXPECT_EQ(pairs_of(cells_of_positions({large_box, crossing})), (Pairs{{0, 1}}));
  EXPECT_EQ(pairs_of(cells_of_positions({apart, within, large_box})), (Pairs{{1, 2}}));
  EXPECT_EQ(pairs_of(cells_of_positions({large_box, apart, large_box})), (Pairs{{0, 2}}));
  EXPECT_EQ(pairs_of(cells_of_positions({large_box, beside, apart})), Pairs{});
  EXPECT_EQ(pairs_of(cells_of_positions({large_box, crossing, within, large_box, apart})),
            (Pairs{{0, 1}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}));
}

TEST(overlay_overlaps, cells_that_are_no_regions) {
  EXPECT_EQ(pairs_of(cells_of_positions({{{0, 0}, {10, 10}, {10, 0}, {0, 9}}})), (Pairs{{0, 0}}));
  EXPECT_EQ(pairs_of(cells_of_positions({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}})), (Pairs{{0, 0}}));
  // Five corners, each second one next: once around twice.
  Positions star;
  for (int k = 0; k < 5; ++k)
    star.emplace_back(40.0 * std::cos(k * 2.513), 40.0 * std::sin(k * 2.513));
  EXPECT_EQ(pairs_of(cells_of_positions({star})), (Pairs{{0, 0}}));
  CellRings nested = cells_of_positions({large_box, {{2, 2}, {4, 2}, {4, 4}, {2, 4}}});
  nested.cells = {0, 2};
  EXPECT_EQ(pairs_of(nested), (Pairs{{0, 0}}));
  CellRings hole_outside = cells_of_positions({large_box, {{50, 0}, {60, 9}, {60, 0}}});
  hole_outside.cells = {0, 2};
  EXPECT_EQ(pairs_of(hole_outside), (Pairs{{0, 0}}));
}

// The first overlap and those of each cell are found without the others.
TEST(overlay_overlaps, some_are_found_without_all) {
  for (int seed = 0; seed < 60; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<Positions> rings;
    for (int k = 0; k < 14; ++k) {
      const double west = 60 * random.unit();
      const double south = 60 * random.unit() - 30;
      const double size = 1 + 14 * random.unit();
      rings.push_back(
          {{west, south}, {west + size, south}, {west + size, south + size}, {west, south + size}});
      if (random.coin())
        rings.back().insert(rings.back().begin() + 2, {west + size / 2, south + 1});
    }
    const CellRings cells = cells_of_positions(rings);
    std::vector<std::int32_t> mask(rings.size(), 1);
    if (seed % 2 == 1) mask[random.below(rings.size())] = 0;
    const auto is_masked = [&](const CrossingCells& pair) {
      return mask[pair.first] == 0 || mask[pair.second] == 0;
    };
    std::vector<CrossingCells> all = overlapping_cells(cells);
    std::erase_if(all, is_masked);
    const auto cells_of = [](const std::vector<CrossingCells>& pairs) {
      std::set<Index> found;
      for (const CrossingCells& pair : pairs) found.insert({pair.first, pair.second});
      return found;
    };
    const overlay::Subdivision laid(cells, false, 1);
    const auto some = [&](overlay::OverlapsWanted wanted) {
      return overlay::some_overlaps(laid, wanted, mask, {});
    };
    const auto first = some(overlay::OverlapsWanted::first);
    ASSERT_EQ(first.empty(), all.empty());
    if (!all.empty()) {
      EXPECT_EQ(first.front().first, all.front().first);
      EXPECT_EQ(first.front().second, all.front().second);
    }
    const auto of_cells = some(overlay::OverlapsWanted::cells);
    EXPECT_EQ(cells_of(of_cells), cells_of(all));
    EXPECT_LE(of_cells.size(), all.size());
    EXPECT_EQ(some(overlay::OverlapsWanted::any).empty(), all.empty());
    EXPECT_EQ(some(overlay::OverlapsWanted::all).size(), all.size());
  }
}

// Where one has a corner on the side of the other, the corner is off it by rounding.
TEST(overlay_overlaps, corners_on_sides_are_none) {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const auto at = [&] { return std::pair(50 * random.signed_unit(), 50 * random.signed_unit()); };
    CellRings cells = cells_of_positions({{at(), at(), at()}, {at(), at(), at(), at()}});
    // The first cell a triangle, the second one on the other side of its first side, with a corner in between.
    if (dot(cells.points[0], cross(cells.points[1], cells.points[2])) < 0) {
      std::swap(cells.points[0], cells.points[1]);
    }
    const double part = 0.1 + 0.8 * random.unit();
    cells.points[3] = cells.points[1];
    cells.points[4] = normalized((1 - part) * cells.points[1] + part * cells.points[0]);
    cells.points[5] = cells.points[0];
    cells.points[6] = normalized(cells.points[0] + cells.points[1] - 0.5 * cells.points[2]);
    EXPECT_EQ(pairs_of(cells), Pairs{}) << seed;
  }
}

TEST(overlay_overlaps, the_sphere_overlaps_all) {
  CellRings cells = cells_of_positions({large_box, {{50, 0}, {60, 0}, {60, 9}}});
  cells.cells.push_back(cells.cells.back());
  cells.cells.push_back(cells.cells.back());
  cells.whole = {2};
  EXPECT_EQ(pairs_of(cells), (Pairs{{0, 2}, {1, 2}}));
  cells.whole = {2, 3};
  EXPECT_EQ(pairs_of(cells), (Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
}

// Cells and the sphere less cells.
TEST(overlay_overlaps, of_complements) {
  const Positions around(large_box.rbegin(), large_box.rend());
  const Positions within = {{2, 2}, {4, 2}, {4, 4}, {2, 4}};
  EXPECT_EQ(pairs_of(cells_of_positions({large_box, around})), Pairs{});
  EXPECT_EQ(pairs_of(cells_of_positions({within, around})), Pairs{});
  EXPECT_EQ(pairs_of(cells_of_positions({{{50, 0}, {60, 0}, {60, 9}}, around})), (Pairs{{0, 1}}));
  EXPECT_EQ(pairs_of(cells_of_positions({large_box, around, within})), (Pairs{{0, 2}}));
}

// A cover, and a few of its cells once more.
TEST(overlay_overlaps, of_covers_with_cells_twice) {
  const CellRings all = CellSet::voronoi(triangulation_of("uniform", 300, 5)).rings();
  EXPECT_EQ(pairs_of(all), Pairs{});
  CellRings twice = all;
  Pairs expected;
  for (const Index i : {3U, 40U, 41U, 200U}) {
    for (auto k = all.rings[i]; k < all.rings[i + 1]; ++k) twice.corners.push_back(all.corners[k]);
    twice.rings.push_back(twice.corners.size());
    expected.emplace_back(i, static_cast<Index>(twice.num_cells()));
    twice.cells.push_back(twice.rings.size() - 1);
  }
  EXPECT_EQ(pairs_of(twice), expected);
}

// Boxes in longitude and latitude, some of them in others, some twice.
struct PlaneBox {
  double west, south, east, north;
  [[nodiscard]] bool has(double lon, double lat) const {
    return west < lon && lon < east && south < lat && lat < north;
  }
};

std::vector<PlaneBox> random_boxes(Random& random) {
  std::vector<PlaneBox> boxes;
  for (std::size_t k = 3 + random.below(3); k > 0; --k) {
    if (!boxes.empty() && random.below(5) == 0) {
      boxes.push_back(boxes.front());
      continue;
    }
    const double west = 40 * random.unit();
    const double south = 30 * random.unit() - 10;
    boxes.push_back({west, south, west + 2 + 20 * random.unit(), south + 2 + 15 * random.unit()});
  }
  return boxes;
}

CellSet cells_of_boxes(const std::vector<PlaneBox>& boxes) {
  std::vector<std::vector<std::string>> features;
  for (const auto& [west, south, east, north] : boxes) {
    features.push_back({planar_polygon({planar_box(west, south, east, north)})});
  }
  return CellSet::polygons(planar_table(features).cells);
}

// What each pair has of the boxes between all lines, each of which counts for the cells that have it by its rule.
std::vector<double> shares_of_pairs(const std::vector<PlaneBox>& from,
                                    const std::vector<PlaneBox>& to, CellOverlap rule) {
  std::vector<double> lons;
  std::vector<double> lats;
  for (const auto* boxes : {&from, &to}) {
    for (const auto& [west, south, east, north] : *boxes) {
      lons.insert(lons.end(), {west, east});
      lats.insert(lats.end(), {south, north});
    }
  }
  std::ranges::sort(lons);
  std::ranges::sort(lats);
  const auto owners = [&](const std::vector<PlaneBox>& boxes, double lon, double lat) {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (boxes[k].has(lon, lat)) found.push_back(k);
    }
    if (rule == CellOverlap::first && found.size() > 1) found.resize(1);
    return found;
  };
  std::vector<double> shares(from.size() * to.size(), 0);
  for (std::size_t x = 0; x + 1 < lons.size(); ++x) {
    for (std::size_t y = 0; y + 1 < lats.size(); ++y) {
      const double lon = (lons[x] + lons[x + 1]) / 2;
      const double lat = (lats[y] + lats[y + 1]) / 2;
      const std::vector<std::size_t> sources = owners(from, lon, lat);
      const std::vector<std::size_t> targets = owners(to, lon, lat);
      for (const std::size_t s : sources) {
        for (const std::size_t t : targets) {
          shares[s * to.size() + t] +=
              area_in_plane(planar_box(lons[x], lats[y], lons[x + 1], lats[y + 1])) /
              static_cast<double>(sources.size() * targets.size());
        }
      }
    }
  }
  return shares;
}

TEST(overlay_overlaps, places_of_several_cells_of_both_sides_are_shared) {
  Random random(11);
  for (int trial = 0; trial < 8; ++trial) {
    const std::vector<PlaneBox> from = random_boxes(random);
    const std::vector<PlaneBox> to = random_boxes(random);
    const CellSet source = cells_of_boxes(from);
    const CellSet target = cells_of_boxes(to);
    for (const CellOverlap rule : {CellOverlap::share, CellOverlap::first}) {
      const Remap found = remap(source, target, {.overlap = rule});
      const Remap second = remap(source, target, {.order = 2, .overlap = rule});
      const std::vector<double> expected = shares_of_pairs(from, to, rule);
      const std::vector<double> of_sources = shares_of_pairs(from, {{-90, -80, 90, 80}}, rule);
      constexpr double arcs = 2e-6;
      for (std::size_t s = 0; s < from.size(); ++s) {
        EXPECT_NEAR(found.source_areas[s], of_sources[s], arcs) << trial << ' ' << s;
        for (std::size_t t = 0; t < to.size(); ++t) {
          EXPECT_NEAR(piece_of(found, s, t), expected[s * to.size() + t], arcs)
              << trial << ": " << s << ' ' << t;
          EXPECT_NEAR(piece_of(second, s, t), piece_of(found, s, t), 1e-14);
        }
      }
    }
  }
}

// Cells around one point, the largest first, with corners that are unit vectors up to 1e-13.
CellSet nested_cells(std::size_t number) {
  CellRings cells;
  for (std::size_t k = 0; k < number; ++k) {
    constexpr Index corners = 24;
    for (Index c = 0; c < corners; ++c) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()));
      const double angle = 2 * std::numbers::pi * c / corners;
      const double lat = 90 - 20 * (1 - static_cast<double>(k) / static_cast<double>(number));
      const Point p = unit_vector({angle * 180 / std::numbers::pi, lat});
      cells.points.push_back((1 + 1e-13 * (c % 3)) * p);
    }
    cells.end_ring();
    cells.end_cell();
  }
  return CellSet::polygons(cells);
}

TEST(overlay_overlaps, nested_cells_share_what_they_have_in_common) {
  constexpr std::size_t number = 60;
  const CellSet cells = nested_cells(number);
  const CellSet grid = CellSet::lonlat_grid(GlobalGrid{36, 18});
  const Remap shared = remap(grid, cells, {.overlap = CellOverlap::share});
  const Remap first = remap(grid, cells, {.overlap = CellOverlap::first});
  const Remap each = remap(grid, cells, {.overlap = CellOverlap::each});
  std::vector<double> all(number);
  for (std::size_t k = 0; k < number; ++k) all[k] = cells.areas()[k];
  std::vector<double> of_cell(number, 0);
  for (std::size_t k = 0; k < number; ++k) {
    const double ring = all[k] - (k + 1 < number ? all[k + 1] : 0);
    for (std::size_t owner = 0; owner <= k; ++owner) {
      of_cell[owner] += ring / static_cast<double>(k + 1);
    }
  }
  for (std::size_t k = 0; k < number; ++k) {
    EXPECT_NEAR(shared.target_areas[k], of_cell[k], 1e-12) << k;
    EXPECT_NEAR(first.target_areas[k], k == 0 ? all[0] : 0, 1e-12) << k;
    EXPECT_NEAR(each.target_areas[k], all[k], 1e-12) << k;
    EXPECT_NEAR(shared.target_fractions[k], 1, 1e-9) << k;
  }
}

// Borders that were written twice and do not quite agree: boxes whose corners are off, each by itself.
TEST(overlay_overlaps, the_first_of_features_whose_borders_nearly_agree) {
  Random random(11);
  constexpr double size = 4;
  constexpr int num_columns = 3;
  for (std::size_t i = 0, n = scaled(60); i < n; ++i) {
    const double noise = std::pow(10.0, -14 + 12 * random.unit());
    SCOPED_TRACE(std::to_string(i) + ' ' + std::to_string(noise));
    const auto off = [&](double lon, double lat) {
      return LonLat{lon + noise * (2 * random.unit() - 1), lat + noise * (2 * random.unit() - 1)};
    };
    std::vector<std::vector<std::string>> features;
    const double shear = random.unit();
    for (int k = 0; k < num_columns * num_columns; ++k) {
      const double west = size * (k % num_columns);
      const int row = k / num_columns;
      const double south = 20 + size * row;
      const double bottom = west + shear * (south - 20);
      const double top = bottom + shear * size;
      features.push_back(
          {planar_polygon({{off(bottom, south), off(bottom + size, south),
                            off(top + size, south + size), off(top, south + size)}})});
    }
    const CellTable kept = planar_table(features);
    const CellTable first = planar_table(features, {.overlap = PolygonOverlap::first});
    EXPECT_TRUE(overlapping_cells(first.cells).empty());
    const std::vector<double> before = areas(kept.cells);
    const std::vector<double> after = areas(first.cells);
    const double of_border = 4 * size * noise * 3 * std::pow(std::numbers::pi / 180, 2);
    for (std::size_t f = 0; f < before.size(); ++f) {
      EXPECT_NEAR(after[f], before[f], of_border + 1e-13) << f;
      EXPECT_LE(after[f], before[f] + 1e-13) << f;
    }
    EXPECT_NEAR(after[0], before[0], 1e-13);
  }
}

}  // namespace
}  // namespace rondel::test
