// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of files as thin as 1e-12 degrees, against cells between few meridians and parallels. What a polygon has in a cell
// is judged by the integral of the sine of the latitude along its lines, cut in the plane in 64 bits. RONDEL_TEST_SCALE
// multiplies the number of polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include "rondel/regions.h"
#include "rondel/remap.h"
#include "support/generators.h"
#include "unit/overlay/grid_oracle.h"
#include "unit/overlay/planar.h"

namespace rondel::test {
namespace {

struct LongPlace {
  long double lon;
  long double lat;
};
using LongPlaces = std::vector<LongPlace>;

// The part of a convex ring where s (x - at) is not negative, for its longitudes or its latitudes x.
LongPlaces cut_in_plane(const LongPlaces& ring, long double LongPlace::*along, long double at,
                        int s) {
  LongPlaces result;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LongPlace& p = ring[k];
    const LongPlace& q = ring[(k + 1) % ring.size()];
    const long double from = s * (p.*along - at);
    const long double to = s * (q.*along - at);
    if (from >= 0) result.push_back(p);
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
      const long double t = from / (from - to);
      LongPlace cut = {p.lon + t * (q.lon - p.lon), p.lat + t * (q.lat - p.lat)};
      cut.*along = at;
      result.push_back(cut);
    }
  }
  return result;
}

long double area_of_lines(const LongPlaces& ring) {
  constexpr long double degree = half_turn / 180;
  long double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LongPlace& p = ring[k];
    const LongPlace& q = ring[(k + 1) % ring.size()];
    const long double half = (q.lat - p.lat) / 2 * degree;
    const long double ratio = half == 0 ? 1 : std::sin(half) / half;
    sum += (p.lon - q.lon) * degree * std::sin((p.lat + q.lat) / 2 * degree) * ratio;
  }
  return std::abs(sum);
}

std::vector<double> expected_in(const RingInPlane& ring, const LonLatGrid& grid) {
  std::vector<double> result;
  for (std::size_t j = 0; j + 1 < grid.lat_deg.size(); ++j) {
    for (std::size_t i = 0; i + 1 < grid.lon_deg.size(); ++i) {
      LongPlaces part;
      for (const LonLat& p : ring) part.push_back({p.lon_deg, p.lat_deg});
      part = cut_in_plane(part, &LongPlace::lon, grid.lon_deg[i], 1);
      part = cut_in_plane(part, &LongPlace::lon, grid.lon_deg[i + 1], -1);
      part = cut_in_plane(part, &LongPlace::lat, grid.lat_deg[j], 1);
      part = cut_in_plane(part, &LongPlace::lat, grid.lat_deg[j + 1], -1);
      result.push_back(static_cast<double>(area_of_lines(part)));
    }
  }
  return result;
}

std::vector<LonLatGrid> few_cells() {
  return {regular_grid(12, 6),
          regular_grid(4, 2),
          regular_grid(1, 2),
          {{-180, -100, 0, 70, 180}, {-90, -50, 0, 45, 90}},
          regular_grid(36, 18)};
}

// From p to q, and as wide at q, to the east or to the north.
class ThinTriangles {
 public:
  explicit ThinTriangles(std::uint64_t seed) : random_(seed) {}

  RingInPlane operator()(double width) {
    const std::size_t kind = random_.below(3);
    LonLat p = {uniform(-170, 170), uniform(-80, 80)};
    LonLat q = {p.lon_deg + uniform(-40, 40), uniform(-80, 80)};
    if (kind == 1) {
      p = {rounded(p.lon_deg, 5), rounded(p.lat_deg, 5)};
      q = {p.lon_deg + rounded(uniform(-40, 40), 5), rounded(q.lat_deg, 5)};
    } else if (kind == 2) {
      p = {rounded(p.lon_deg, 0.01), rounded(p.lat_deg, 0.01)};
      q = {p.lon_deg + rounded(uniform(-5, 5), 0.01), 0.9 * p.lat_deg + uniform(-2, 2)};
    }
    q.lon_deg = std::clamp(q.lon_deg, -179.0, 179.0);
    const bool is_steep = std::abs(q.lat_deg - p.lat_deg) > std::abs(q.lon_deg - p.lon_deg);
    LonLat end = q;
    (is_steep ? end.lon_deg : end.lat_deg) += width;
    return {p, q, end};
  }

 private:
  double uniform(double low, double high) { return low + (high - low) * random_.unit(); }
  static double rounded(double x, double to) { return std::round(x / to) * to; }
  Random random_;
};

void expect_parts(const RingInPlane& ring, const LonLatGrid& grid) {
  const CellRings cells = planar_table({{planar_polygon({ring})}}).cells;
  const double area = areas(cells)[0];
  const Remap remap = rondel::remap(CellSet::polygons(cells), CellSet::lonlat_grid(grid));
  std::vector<double> found(grid.lon_deg.size() * grid.lat_deg.size());
  for (std::size_t j = 0; j + 1 < remap.pieces.offsets.size(); ++j) {
    for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k)
      found[j] += remap.areas[k];
  }
  // Rounding of corners along the border: 16 u times its length, which is taken up to sqrt(3) times longer.
  const double rounding = 28 * 0x1p-53 * planar_length(ring);
  EXPECT_NEAR(std::accumulate(found.begin(), found.end(), 0.0), area, area / 1024 + rounding);
  const std::vector<double> expected = expected_in(ring, grid);
  const double all = std::accumulate(expected.begin(), expected.end(), 0.0);
  for (std::size_t j = 0; j < expected.size(); ++j) {
    EXPECT_NEAR(found[j], expected[j], 4e-3 * all + rounding) << j << " of " << all;
  }
}

TEST(overlay_thin, parts_between_meridians_and_parallels_are_those_of_the_lines) {
  ThinTriangles triangles(3);
  const std::vector<LonLatGrid> grids = few_cells();
  Random random(5);
  for (std::size_t i = 0, n = scaled(60); i < n; ++i) {
    const double width = std::pow(10.0, -12 + 2 * random.unit());
    const RingInPlane ring = triangles(width);
    if (ring[1] == ring[2] || ring[0] == ring[1]) continue;
    SCOPED_TRACE(text_of(ring));
    expect_parts(ring, grids[i % grids.size()]);
  }
}

TEST(overlay_thin, a_thin_part_is_not_lost_where_a_side_has_many_corners) {
  const RingInPlane ring = {{150, -45}, {120, 45}, {120 - 1e-11, 45}};
  for (const LonLatGrid& grid : few_cells()) expect_parts(ring, grid);
}

// Features west and east of a sliver, and the sliver.
TEST(overlay_thin, what_rounding_leaves_nothing_of_is_told) {
  const auto box = [](double width) {
    return planar_polygon({{{10, 10}, {10 + width, 10}, {10 + width, 11}, {10, 11}}});
  };
  EXPECT_TRUE(planar_table({{box(1e-12)}}).facts.remarks.empty());
  const CellTable table = planar_table({{box(1)}, {box(2e-14)}, {box(1e-12)}, {box(1e-14)}});
  ASSERT_EQ(table.facts.remarks.size(), 1U);
  EXPECT_EQ(table.facts.remarks[0],
            "feature 1 (f1) and 1 more are no wider than rounding of the corners (some 2e-13 "
            "degrees), so nothing is left");
  EXPECT_EQ(areas(table.cells)[1], 0);
}

TEST(overlay_thin, a_sliver_between_neighbors_is_a_cell_like_others) {
  const double width = 4e-11;
  const RingInPlane west = {{-30, -50}, {11, -50}, {-20 - width, 40}, {-30, 40}};
  const RingInPlane east = {{11, -50}, {40, -50}, {40, 40}, {-20, 40}};
  const RingInPlane sliver = {{11, -50}, {-20, 40}, {-20 - width, 40}};
  const CellRings cells =
      planar_table({{planar_polygon({west})}, {planar_polygon({east})}, {planar_polygon({sliver})}})
          .cells;
  for (const LonLatGrid& grid : few_cells()) {
    const CellSet boxes = CellSet::lonlat_grid(grid);
    const Remap remap = rondel::remap(boxes, CellSet::polygons(cells));
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(remap.target_fractions[j], 1, 0.02) << j;
  }
}

}  // namespace
}  // namespace rondel::test
