// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "unit/overlay/trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

std::vector<OracleCell> convex_cells(const CellRings& rings, std::vector<Index>& owners) {
  std::vector<OracleCell> result;
  for (std::size_t i = 0; i < rings.num_cells(); ++i) {
    for (auto r = rings.cells[i]; r < rings.cells[i + 1]; ++r) {
      RingOfPoints ring;
      for (auto k = rings.rings[r]; k < rings.rings[r + 1]; ++k) {
        ring.push_back(rings.points[rings.corners[k]]);
      }
      result.emplace_back(std::move(ring));
      owners.push_back(static_cast<Index>(i));
    }
  }
  return result;
}

Cover cover_of(const char* name, CellSet cells) {
  std::vector<Index> owners;
  std::vector<OracleCell> convex = convex_cells(cells.rings(), owners);
  return {name, std::move(cells), std::move(convex), {}, std::move(owners)};
}

Cover grid_of_parallels(const LonLatGrid& grid) {
  Cover cover{"parallels", CellSet::lonlat_grid(grid), {}, {}, {}};
  for (std::size_t row = 0; row + 1 < grid.lat_deg.size(); ++row) {
    for (std::size_t column = 0; column + 1 < grid.lon_deg.size(); ++column) {
      cover.owners.push_back(static_cast<Index>(cover.boxes.size()));
      cover.boxes.push_back({grid.lon_deg[column], grid.lat_deg[row], grid.lon_deg[column + 1],
                             grid.lat_deg[row + 1]});
    }
  }
  return cover;
}

// Regions of several cells each, with holes and gaps, that do not cover the sphere.
Cover regions_of(const Triangulation& sites, std::uint64_t seed) {
  const CellRings all = CellSet::voronoi(sites).rings();
  Cover cover{"regions", CellSet::polygons(all), {}, {}, {}};
  const std::vector<Index> groups = random_groups(all.num_cells(), 6, seed, true);
  std::vector<Index> owners;
  cover.convex = convex_cells(all, owners);
  for (const Index cell : owners) cover.owners.push_back(groups[cell]);
  cover.cells = CellSet::polygons(dissolve(all, groups, 6));
  return cover;
}

std::vector<Cover> covers_of(std::uint64_t seed) {
  const Triangulation sites = triangulation_of("uniform", 12 + 20 * seed, seed);
  const LonLatGrid grid = {{-180, -100, 0, 70, 180},
                           {-90, -50 + 5 * static_cast<double>(seed), 0, 45, 90}};
  std::vector<Cover> result;
  result.push_back(cover_of("voronoi", CellSet::voronoi(sites)));
  result.push_back(cover_of("triangles", CellSet::triangles(sites)));
  result.push_back(cover_of("great_circles", CellSet::lonlat_grid(grid, GridSides::great_circles)));
  result.push_back(grid_of_parallels(grid));
  result.push_back(regions_of(sites, seed));
  return result;
}

}  // namespace

const std::vector<Cover>& known_covers(std::uint64_t set) {
  static const std::vector<std::vector<Cover>> all = [] {
    std::vector<std::vector<Cover>> sets;
    for (std::uint64_t seed = 0; seed < num_cover_sets; ++seed) sets.push_back(covers_of(seed));
    return sets;
  }();
  return all[set];
}

std::vector<Point> corners_of(const Cover& cover) {
  std::vector<Point> corners;
  for (const OracleCell& cell : cover.convex) {
    corners.insert(corners.end(), cell.corners.begin(), cell.corners.end());
  }
  return corners;
}

namespace {

constexpr double roundoff = 0x1p-53;

// Pieces are off by rounding of their corners along their borders.
double rounding_of(double length, double area) {
  return 192 * roundoff * length + 64 * roundoff * area;
}

double sum_of_areas(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void expect_agreement(const OracleAnswer& full, const OracleAnswer& quick) {
  EXPECT_LE(std::abs(full.area - quick.area), quick.error) << "the quick oracle";
}

}  // namespace

Trial::Trial(std::vector<RingOfPoints> rings, bool is_audited)
    : rings_(std::move(rings)),
      cells_(one_cell_of(rings_)),
      oracle_(rings_),
      is_audited_(is_audited) {}

bool Trial::is_wrong() const { return oracle_.excess() > 4 * rounding_of(oracle_.length(), 0); }

// Exactly, but for what moving the corners does; or every side runs to and fro.
bool Trial::is_questionable() const {
  constexpr double of_moves = 1e-45;
  return oracle_.excess() > of_moves || oracle_.num_sides() == 0 || has_crossing(rings_);
}

// Rings that are no wider than rounding bound nothing, whichever way they turn.
bool Trial::is_taken_for_nothing(double found) const {
  constexpr double half = 2 * std::numbers::pi;
  return found < half && oracle_.area(false).area > 2 * half - 1e-6 &&
         oracle_.missing() < 4 * rounding_of(oracle_.length(), 0);
}

void Trial::expect_areas() const {
  const double found = areas(cells_)[0];
  double of_cell = found;
  try {
    of_cell = CellSet::polygons(cells_).areas()[0];
  } catch (const InvalidInput& error) {
    EXPECT_TRUE(is_questionable()) << error.what();
  }
  const double tolerance = rounding_of(oracle_.length(), found) + oracle_.excess();
  OracleAnswer expected = oracle_.area(false);
  if (is_audited_ || expected.error > tolerance / 4 ||
      std::abs(found - expected.area) > tolerance - expected.error) {
    const OracleAnswer full = oracle_.area(true);
    expect_agreement(full, expected);
    expected = full;
  }
  EXPECT_NEAR(found, is_taken_for_nothing(found) ? 0 : expected.area, tolerance);
  EXPECT_NEAR(of_cell, is_taken_for_nothing(of_cell) ? 0 : expected.area, tolerance);
}

Trial::Laid Trial::laid_over(const Cover& cover, std::uint64_t way) const {
  const Execution one_thread{.threads = 1};
  const CellSet cell = CellSet::polygons(cells_, one_thread);
  const bool is_source = way % 2 == 0;
  const Remap remap = is_source ? rondel::remap(cell, cover.cells, {}, one_thread)
                                : rondel::remap(cover.cells, cell, {.order = 2}, one_thread);
  Laid laid;
  laid.pieces.resize(cover.cells.num_cells());
  for (std::size_t j = 0; j + 1 < remap.pieces.offsets.size(); ++j) {
    for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
      laid.pieces[is_source ? j : remap.pieces.values[k]] += remap.areas[k];
    }
  }
  if (cover.boxes.empty() && way % 3 == 0) {
    laid.clipped = sum_of_areas(areas(clip(cover.cells, cell, one_thread)));
  }
  return laid;
}

Trial::Expected Trial::expected_in(const Cover& cover, bool in_full) const {
  Expected expected;
  expected.pieces.resize(cover.cells.num_cells());
  for (std::size_t c = 0; c < cover.owners.size(); ++c) {
    if (cover.owners[c] == no_index) continue;
    const auto ask = [&](bool full) {
      return cover.boxes.empty() ? oracle_.piece(cover.convex[c], full)
                                 : oracle_.piece(cover.boxes[c], full);
    };
    const OracleAnswer part = ask(in_full);
    if (in_full && is_audited_) expect_agreement(part, ask(false));
    OracleAnswer& piece = expected.pieces[cover.owners[c]];
    piece.area += part.area;
    piece.error += part.error;
    expected.total += part.area;
    expected.error += part.error;
  }
  return expected;
}

// Whether the errors of what is expected do not matter.
bool Trial::is_sure(const Laid& laid, const Expected& expected, double least) const {
  for (std::size_t j = 0; j < laid.pieces.size(); ++j) {
    const auto& [area, error] = expected.pieces[j];
    const double tolerance = rounding_of(oracle_.length(), area) + least;
    if (!(std::abs(laid.pieces[j] - area) + error < tolerance)) return false;
  }
  return laid.clipped < 0 || std::abs(laid.clipped - expected.total) + expected.error <
                                 rounding_of(oracle_.length(), expected.total);
}

void Trial::expect_pieces(const Cover& cover, std::uint64_t way) const {
  Laid laid;
  try {
    laid = laid_over(cover, way);
  } catch (const InvalidInput& error) {
    EXPECT_TRUE(is_questionable())
        << error.what() << ", but it is a region of " << oracle_.area(true).area;
    return;
  }
  // In a region nearly as large as the sphere it may be less than rounding of the area.
  const bool is_seen = oracle_.excess() > rounding_of(oracle_.length(), oracle_.area(false).area);
  if (is_wrong() && is_seen) {
    ADD_FAILURE() << "nothing was said, but " << oracle_.excess() << " is wrong of "
                  << oracle_.area(true).area;
    return;
  }
  Expected expected = expected_in(cover, is_audited_);
  // Next to a pole, heights are rounded to the last digit of 1.
  const double least = cover.boxes.empty() ? 0 : 64 * roundoff;
  if (!is_sure(laid, expected, least)) expected = expected_in(cover, true);
  if (is_taken_for_nothing(sum_of_areas(laid.pieces))) {
    expected = {std::vector<OracleAnswer>(laid.pieces.size()), 0, 0};
  }
  for (std::size_t j = 0; j < laid.pieces.size(); ++j) {
    const auto& [area, error] = expected.pieces[j];
    EXPECT_NEAR(laid.pieces[j], area,
                rounding_of(oracle_.length(), area) + oracle_.excess() + error + least)
        << j;
  }
  if (laid.clipped < 0) return;
  const auto n = static_cast<double>(laid.pieces.size());
  EXPECT_NEAR(laid.clipped, expected.total,
              n * rounding_of(oracle_.length(), expected.total) + oracle_.excess())
      << "clipped";
}

}  // namespace rondel::test
