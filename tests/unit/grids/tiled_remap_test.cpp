// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights by tiles: the rows that remap() computes for whole sides, bit by bit, for any tiles.

#include "rondel/tiled_remap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

// Compares all tiles with the remapping of whole sides; returns the number of tiles.
std::size_t expect_rows_of(const Remap& whole, const TiledRemap& tiled, const std::string& what) {
  std::vector<int> times(tiled.num_targets(), 0);
  for (std::size_t t = 0; t < tiled.num_tiles(); ++t) {
    const RemapTile tile = tiled.tile(t);
    EXPECT_EQ(tile.weights.num_rows(), tile.targets.size());
    for (std::size_t r = 0; r < tile.targets.size(); ++r) {
      const Index target = tile.targets[r];
      ++times[target];
      const std::uint64_t begin = whole.weights.offsets[target];
      const std::uint64_t size = whole.weights.offsets[target + std::size_t{1}] - begin;
      const std::uint64_t own = tile.weights.offsets[r];
      if (tile.weights.offsets[r + 1] - own != size) {
        ADD_FAILURE() << what << ": row " << target << " has " << tile.weights.offsets[r + 1] - own
                      << " entries, not " << size;
        return 0;
      }
      for (std::uint64_t k = 0; k < size; ++k) {
        EXPECT_EQ(tile.weights.columns[own + k] + tile.first_source,
                  whole.weights.columns[begin + k])
            << what;
        EXPECT_EQ(tile.weights.values[own + k], whole.weights.values[begin + k])
            << what << ": row " << target;
      }
      EXPECT_EQ(tile.areas[r], whole.target_areas[target]) << what;
      EXPECT_EQ(tile.fractions[r], whole.target_fractions[target]) << what;
    }
  }
  EXPECT_EQ(times, std::vector<int>(tiled.num_targets(), 1)) << what;
  return tiled.num_tiles();
}

TEST(tiled_remap, rows_are_those_of_whole_sides) {
  const std::vector<std::string> grids = {
      "grid:6",   "F12",  "N32",           "O20",         "C9",
      "R2B2",     "R3B1", "hexagons:R2B2", "tripolar:15", "healpix:3:ring",
      "healpix:4"};
  for (const std::string& source : grids) {
    for (const std::string& target : grids) {
      if (source == target && source.starts_with("tripolar")) continue;  // it covers no sphere
      const Remap whole = remap(NamedGrid(source).cells(), NamedGrid(target).cells());
      std::size_t most = 0;
      for (const std::size_t cells : {100U, 1500U, 1U << 20U}) {
        const TiledRemap tiled(TiledCells(NamedGrid(source)), TiledCells(NamedGrid(target)),
                               {.cells_per_tile = cells});
        most = std::max(most, expect_rows_of(whole, tiled, source + " to " + target));
      }
      EXPECT_GT(most, 3U);
    }
  }
}

// Compares the rows of order 2 for fields that lack some values, and for fields that lack none.
void expect_second_rows(const Remap& whole, const TiledRemap& tiled, const std::string& what) {
  expect_rows_of(whole, tiled, what);
  std::mt19937 random(17);
  std::vector<std::int32_t> has_value(tiled.num_sources());
  for (std::int32_t& value : has_value) value = random() % 5 == 0 ? 0 : 1;
  const Weights wanted = weights_with_values(whole, has_value);
  for (std::size_t t = 0; t < tiled.num_tiles(); ++t) {
    const RemapTile tile = tiled.tile(t);
    if (tile.targets.empty()) continue;
    std::vector<std::int32_t> own;
    for (const Index source : tile.sources) own.push_back(has_value[source]);
    const Weights found = weights_with_values(tile.part, own);
    ASSERT_EQ(found.num_rows(), tile.targets.size()) << what;
    for (std::size_t r = 0; r < tile.targets.size(); ++r) {
      const std::uint64_t begin = wanted.offsets[tile.targets[r]];
      const std::uint64_t size = wanted.offsets[tile.targets[r] + std::size_t{1}] - begin;
      ASSERT_EQ(found.offsets[r + 1] - found.offsets[r], size) << what;
      for (std::uint64_t k = 0; k < size; ++k) {
        EXPECT_EQ(tile.sources[found.columns[found.offsets[r] + k]], wanted.columns[begin + k]);
        EXPECT_EQ(found.values[found.offsets[r] + k], wanted.values[begin + k]) << what;
      }
    }
  }
}

TEST(tiled_remap, rows_of_order_2_are_those_of_whole_sides) {
  const std::vector<std::string> grids = {"grid:9",        "F8",          "O10",      "C6", "R2B1",
                                          "hexagons:R2B1", "tripolar:30", "healpix:2"};
  for (const std::string& source : grids) {
    for (const std::string& target : grids) {
      if (source == target && source.starts_with("tripolar")) continue;
      for (const RemapNorm norm : {RemapNorm::destarea, RemapNorm::fracarea}) {
        const Remap whole =
            remap(NamedGrid(source).cells(), NamedGrid(target).cells(), {.order = 2, .norm = norm});
        for (const std::size_t cells : {50U, 300U, 1U << 20U}) {
          const TiledRemap tiled(TiledCells(NamedGrid(source)), TiledCells(NamedGrid(target)),
                                 {.norm = norm, .cells_per_tile = cells, .order = 2});
          expect_second_rows(whole, tiled, source + " to " + target);
        }
      }
    }
  }
}

TEST(tiled_remap, masks_and_regions_of_order_2_are_those_of_remap) {
  std::mt19937 random(5);
  const NamedGrid source("healpix:3");
  const NamedGrid target("grid:10");
  std::vector<std::int32_t> mask(source.num_cells());
  for (std::int32_t& value : mask) value = random() % 3 == 0 ? 0 : 1;
  const Remap whole = remap(source.cells(), target.cells(), {.order = 2, .source_mask = mask});
  expect_second_rows(whole,
                     TiledRemap(TiledCells(source), TiledCells(target),
                                {.source_mask = mask, .cells_per_tile = 200, .order = 2}),
                     "masked");
  const CellSet region = CellSet::polygons(NamedGrid("R2B1").cells().rings());
  const Remap to_region = remap(source.cells(), region, {.order = 2});
  expect_second_rows(
      to_region,
      TiledRemap(TiledCells(source), TiledCells(region), {.cells_per_tile = 100, .order = 2}),
      "region");
  EXPECT_EQ(thrown_message<InvalidInput>(
                [&] { TiledRemap(TiledCells(region), TiledCells(source), {.order = 2}); }),
            "weights of order 2 have no tiles where the sources are in memory");
}

TEST(tiled_remap, sides_in_memory_are_divided_as_well) {
  const CellSet source = CellSet::polygons(NamedGrid("R2B2").cells().rings());
  const CellSet target = NamedGrid("grid:9x6", GridSides::great_circles).cells();
  const Remap whole = remap(source, target);
  const TiledRemap tiled(TiledCells(source), TiledCells(target), {.cells_per_tile = 60});
  EXPECT_GT(expect_rows_of(whole, tiled, "sets"), 3U);
}

TEST(tiled_remap, masks_and_norms_are_those_of_remap) {
  std::mt19937 random(5);
  const auto mask_of = [&](std::size_t n) {
    std::vector<std::int32_t> mask(n);
    for (std::int32_t& value : mask) value = random() % 3 == 0 ? 0 : 1;
    return mask;
  };
  for (const auto& [from, to] :
       {std::pair{"grid:10", "healpix:3"}, {"O10", "grid:8x9"}, {"C5", "R2B1"}, {"F6", "grid:9"}}) {
    const NamedGrid source(from);
    const NamedGrid target(to);
    const auto source_mask = mask_of(source.num_cells());
    const auto target_mask = mask_of(target.num_cells());
    for (const RemapNorm norm : {RemapNorm::destarea, RemapNorm::fracarea}) {
      const Remap whole =
          remap(source.cells(), target.cells(),
                {.norm = norm, .source_mask = source_mask, .target_mask = target_mask});
      const TiledRemap tiled(TiledCells(source), TiledCells(target),
                             {norm, source_mask, target_mask, 200});
      expect_rows_of(whole, tiled, std::string(from) + " to " + to);
    }
  }
}

// Returns the cells of a named grid whose numbers fulfil a condition.
template <class Keep>
CellSet some_of(const std::string& name, const Keep& keep) {
  const CellRings all = NamedGrid(name, GridSides::great_circles).cells().rings();
  const std::vector<LonLat> centers = NamedGrid(name).centers();
  CellRings some;
  some.points = all.points;
  for (std::size_t i = 0; i < all.num_cells(); ++i) {
    if (keep(centers[i])) some.append_cell(all, i);
  }
  return CellSet::polygons(some);
}

// Returns polygons with holes and several parts: each has the cells of some squares of a board.
CellSet board_of(const std::string& name) {
  const NamedGrid grid(name, GridSides::great_circles);
  std::vector<Index> groups;
  for (const LonLat& place : grid.centers()) {
    const auto column = static_cast<Index>((place.lon_deg + 540) / 25) % 4;
    const auto row = static_cast<Index>((place.lat_deg + 90) / 17) % 3;
    const bool is_out = place.lat_deg < -80 || column + row == 1;
    groups.push_back(is_out ? no_index : column * 3 + row);
  }
  return CellSet::polygons(dissolve(grid.cells().rings(), groups, 12));
}

TEST(tiled_remap, cells_of_a_region_are_divided_as_well) {
  const auto near = [](const LonLat& place) {
    return place.lat_deg > 20 && std::abs(place.lon_deg) < 130;
  };
  const auto scattered = [](const LonLat& place) {
    return std::fmod(place.lon_deg + 720, 50) < 30 && place.lat_deg < 70;
  };
  const auto polar = [](const LonLat& place) { return place.lat_deg < -50; };
  const CellSet regions[] = {some_of("R2B2", near), some_of("healpix:3", scattered),
                             some_of("C8", polar), some_of("O16", scattered), board_of("grid:10")};
  const LonLatGrid lines{{-20, -13, 0, 4, 21, 60}, {70, 50, 44, 13, -9}};
  std::size_t number = 0;
  for (const CellSet& region : regions) {
    const std::string what = "region " + std::to_string(number++);
    std::vector<std::pair<CellSet, TiledCells>> others;
    for (const char* const name : {"grid:9", "grid:45", "healpix:3", "R2B1"}) {
      others.emplace_back(NamedGrid(name).cells(), TiledCells(NamedGrid(name)));
    }
    others.emplace_back(CellSet::lonlat_grid(lines), TiledCells(lines));
    for (const auto& [cells, tiled_cells] : others) {
      for (const std::size_t size : {40U, 700U, 1U << 20U}) {
        const TiledRemap to(tiled_cells, TiledCells(region), {.cells_per_tile = size});
        expect_rows_of(remap(cells, region), to, "to " + what);
        const TiledRemap from(TiledCells(region), tiled_cells, {.cells_per_tile = size});
        expect_rows_of(remap(region, cells), from, "from " + what);
      }
    }
  }
}

TEST(tiled_remap, refuses_cells_without_tiles) {
  CellRings one;
  one.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 2; ++k) {
    one.append_ring(std::vector<Index>{0, 1, 2});
    one.end_cell();
  }
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return TiledCells(CellSet::polygons(one)); }),
            "cells that overlap have no tiles");
  one.cells.pop_back();
  one.rings.pop_back();
  one.corners.resize(3);
  const TiledCells part{CellSet::polygons(one)};
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return TiledRemap(part, part); }),
            "neither side covers the sphere or is between parallels");
  CellRings whole;
  whole.whole = {0};
  whole.end_cell();
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return TiledCells(CellSet::polygons(whole)); }),
            "a cell that is the whole sphere has no tiles");
  const TiledCells grid{NamedGrid("grid:30")};
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return TiledRemap(grid, grid, {.source_mask = {1, 0}});
            }),
            "the mask of the source has 2 values for 72 cells");
}

}  // namespace
}  // namespace rondel::test
