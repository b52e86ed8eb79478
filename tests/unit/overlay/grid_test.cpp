// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells between meridians and parallels under other cells: against quadrature in long double, closed forms, and sums.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rondel/error.h"
#include "rondel/named_grids.h"
#include "rondel/regions.h"
#include "support/thrown.h"
#include "unit/overlay/grid_oracle.h"

namespace rondel::test {
namespace {

// The largest difference of a piece and its integral.
double worst_piece(const Triangulation& sites, const LonLatGrid& grid) {
  const Remap remap = rondel::remap(CellSet::voronoi(sites), CellSet::lonlat_grid(grid));
  const Cells all = cells(sites);
  std::vector<LongRing> sources;
  for (std::size_t i = 0; i < sites.num_sites(); ++i) {
    // A side between two roundings of one corner has no direction.
    LongRing ring = ring_of(all, i);
    const auto is_same = [](const LongVector& p, const LongVector& q) {
      const LongVector d{p.x - q.x, p.y - q.y, p.z - q.z};
      return dot_of(d, d) < 1e-28L;
    };
    ring.erase(std::unique(ring.begin(), ring.end(), is_same), ring.end());
    if (ring.size() > 1 && is_same(ring.front(), ring.back())) ring.pop_back();
    sources.push_back(ring);
  }
  double worst = 0;
  for (std::size_t j = 0; j + 1 < remap.pieces.offsets.size(); ++j) {
    for (std::size_t i = 0; i < sites.num_sites(); ++i) {
      const long double expected = area_in(sources[i], box_of(grid, j));
      worst = std::max(worst, std::abs(piece_of(remap, i, j) - static_cast<double>(expected)));
    }
  }
  return worst;
}

TEST(overlay_grid, pieces_are_integrals_over_longitude) {
  const auto sites = triangulation_of("uniform", 60, 5);
  EXPECT_LT(worst_piece(sites, regular_grid(9, 6, -170)), 2e-15);
  EXPECT_LT(worst_piece(sites, regular_grid(1, 5)), 5e-15);
  EXPECT_LT(worst_piece(sites, regular_grid(2, 3, 33)), 5e-15);
  EXPECT_LT(worst_piece(sites, regular_grid(24, 1)), 5e-15);
  // Southward, from 350 to 370 degrees and from 0 to 60 north; and a band around the globe.
  EXPECT_LT(worst_piece(sites, {{350, 355, 370}, {60, 40, 30, 29.5, 0}}), 2e-15);
  EXPECT_LT(worst_piece(sites, {{-30, 100, 310, 330}, {-89, -88, 12}}), 5e-15);
}

// Corners on meridians, parallels and poles, and sides along meridians and through poles.
TEST(overlay_grid, pieces_of_cells_in_line_with_the_grid) {
  for (const char* kind : {"globe_grid", "platonic_solid"}) {
    const auto sites = triangulation_of(kind, 40, 3);
    EXPECT_LT(worst_piece(sites, regular_grid(8, 4)), 5e-15) << kind;
    EXPECT_LT(worst_piece(sites, regular_grid(12, 12, 0)), 5e-15) << kind;
  }
}

void expect_sums(const Remap& remap, const CellSet& source, const CellSet& target) {
  for (std::size_t i = 0; i < source.num_cells(); ++i) {
    const double area = source.areas()[i];
    if (!(area > 0)) continue;
    EXPECT_NEAR(remap.source_fractions[i], 1, 16 * ulp / std::sqrt(area)) << i;
  }
  for (std::size_t j = 0; j < target.num_cells(); ++j) {
    const double area = target.areas()[j];
    long double sum = 0;
    for (auto k = remap.weights.offsets[j]; k < remap.weights.offsets[j + 1]; ++k) {
      sum += remap.weights.values[k];
    }
    if (!(area > 0)) continue;
    EXPECT_NEAR(remap.target_fractions[j], 1, 16 * ulp / std::sqrt(area)) << j;
    EXPECT_NEAR(static_cast<double>(sum - 1), 0, 8 * ulp) << j;
  }
}

TEST(overlay_grid, sums_of_rows_and_columns) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 3000, 6));
  const CellSet fine = CellSet::lonlat_grid(regular_grid(180, 90));
  const CellSet coarse = CellSet::lonlat_grid(regular_grid(20, 10, 7));
  for (const CellSet& grid : {fine, coarse}) {
    ASSERT_TRUE(grid.covers_sphere());
    EXPECT_NEAR(
        static_cast<double>(std::accumulate(grid.areas().begin(), grid.areas().end(), 0.0L)),
        4 * std::numbers::pi, 1e-14);
    for (const unsigned order : {1U, 2U}) {
      expect_sums(remap(cells, grid, {.order = order}), cells, grid);
      expect_sums(remap(grid, cells, {.order = order}), grid, cells);
    }
  }
  expect_sums(remap(fine, coarse, {.order = 2}), fine, coarse);
  expect_sums(remap(coarse, fine, {.order = 2}), coarse, fine);
}

// What the one side's pieces are does not depend on which is the source.
TEST(overlay_grid, sides_may_be_exchanged) {
  const CellSet cells = CellSet::voronoi(triangulation_of("clustered", 400, 8));
  const CellSet grid = CellSet::lonlat_grid(regular_grid(30, 20));
  const Remap there = remap(cells, grid);
  const Remap back = remap(grid, cells);
  ASSERT_EQ(there.areas.size(), back.areas.size());
  for (std::size_t j = 0; j < grid.num_cells(); ++j) {
    for (auto k = there.pieces.offsets[j]; k < there.pieces.offsets[j + 1]; ++k) {
      EXPECT_EQ(there.areas[k], piece_of(back, j, there.pieces.values[k]));
    }
  }
}

// The mean of x over boxes.
std::vector<LongVector> box_centers(const LonLatGrid& grid) {
  std::vector<LongVector> centers;
  for (std::size_t j = 0; j < (grid.lon_deg.size() - 1) * (grid.lat_deg.size() - 1); ++j) {
    const LonLatBox box = box_of(grid, j);
    const auto primitive = [](long double lat) {
      return (lat + std::sin(lat) * std::cos(lat)) / 2;
    };
    const long double height = std::sin(box.north) - std::sin(box.south);
    const long double inward = (primitive(box.north) - primitive(box.south)) / height;
    const long double width = box.east - box.west;
    centers.push_back({inward * (std::sin(box.east) - std::sin(box.west)) / width,
                       inward * (std::cos(box.west) - std::cos(box.east)) / width,
                       (std::sin(box.north) + std::sin(box.south)) / 2});
  }
  return centers;
}

// Means of a linear field over cells are its values at their centers of mass.
TEST(overlay_grid, linear_fields_with_their_gradients) {
  const Point g{0.3, -1.7, 0.9};
  const auto field = [&](const std::vector<LongVector>& centers) {
    std::vector<double> means;
    for (const LongVector& c : centers) {
      means.push_back(static_cast<double>(3 + g.x * c.x + g.y * c.y + g.z * c.z));
    }
    return means;
  };
  const auto sites = triangulation_of("uniform", 700, 7);
  const LonLatGrid lines = regular_grid(36, 18, 5);
  const LonLatGrid other_lines = regular_grid(20, 24, -7.5);
  const auto check = [&](const CellSet& source, const std::vector<double>& means,
                         const CellSet& target, const std::vector<double>& expected) {
    const Remap remap = rondel::remap(source, target, {.order = 2});
    std::vector<double> values(expected.size());
    apply_gradients(remap, means, std::vector<Point>(means.size(), g), values);
    std::vector<double> estimated(expected.size());
    std::vector<double> constant(expected.size());
    apply(remap.weights, means, estimated);
    apply(rondel::remap(source, target).weights, means, constant);
    double error = 0;
    double error_of_constant = 0;
    for (std::size_t j = 0; j < values.size(); ++j) {
      EXPECT_NEAR(values[j], expected[j], 2e-14) << j;
      error += std::abs(estimated[j] - expected[j]);
      error_of_constant += std::abs(constant[j] - expected[j]);
    }
    EXPECT_LT(error, error_of_constant / 5);
  };
  const CellSet voronoi = CellSet::voronoi(sites);
  const CellSet grid = CellSet::lonlat_grid(lines);
  check(voronoi, field(centers_of(sites)), grid, field(box_centers(lines)));
  check(grid, field(box_centers(lines)), voronoi, field(centers_of(sites)));
  check(grid, field(box_centers(lines)), CellSet::lonlat_grid(other_lines),
        field(box_centers(other_lines)));
}

TEST(overlay_grid, onto_itself_is_the_identity) {
  for (const LonLatGrid& lines :
       {regular_grid(36, 18), regular_grid(7, 11, 12.3), LonLatGrid{{0.1, 0.2, 0.7}, {3, 2, -1}}}) {
    const CellSet grid = CellSet::lonlat_grid(lines);
    for (const unsigned order : {1U, 2U}) {
      const Remap self = remap(grid, grid, {.order = order});
      for (std::size_t j = 0; j < grid.num_cells(); ++j) {
        EXPECT_EQ(piece_of(self, j, j), grid.areas()[j]);
        for (auto k = self.weights.offsets[j]; k < self.weights.offsets[j + 1]; ++k) {
          EXPECT_EQ(self.weights.values[k], self.weights.columns[k] == j ? 1 : 0);
        }
      }
    }
  }
}

// The same lines, turned around the globe, southward, and with a rounded meridian.
TEST(overlay_grid, of_the_same_lines_written_differently) {
  const LonLatGrid lines = regular_grid(10, 6, -180);
  LonLatGrid other = regular_grid(10, 6, 0);
  for (double& lon : other.lon_deg) lon += lon == 72 ? 1e-13 : 0;
  std::ranges::reverse(other.lat_deg);
  const Remap remap = rondel::remap(CellSet::lonlat_grid(lines), CellSet::lonlat_grid(other));
  for (std::size_t j = 0; j < 60; ++j) {
    ASSERT_EQ(remap.weights.offsets[j + 1] - remap.weights.offsets[j], 1U);
    EXPECT_EQ(remap.weights.columns[j], (5 - j / 10) * 10 + (j % 10 + 5) % 10);
    EXPECT_EQ(remap.weights.values[j], 1);
  }
}

TEST(overlay_grid, great_circles_are_sides_on_request) {
  const LonLatGrid lines = regular_grid(12, 6);
  const CellSet arcs = CellSet::lonlat_grid(lines, GridSides::great_circles);
  ASSERT_TRUE(arcs.covers_sphere());
  const CellSet parallels = CellSet::lonlat_grid(lines);
  // North of the equator an arc is north of its parallel.
  const CellRings rings = arcs.rings();
  for (std::size_t i = 0; i < 72; ++i) {
    LongRing ring;
    for (std::uint64_t k = rings.rings[i]; k < rings.rings[i + 1]; ++k) {
      ring.push_back(long_vector(rings.points[rings.corners[k]]));
    }
    EXPECT_NEAR(arcs.areas()[i], static_cast<double>(area_of(ring)), 1e-15);
    const bool is_smaller = i < 24 || i >= 48;
    EXPECT_EQ(arcs.areas()[i] < parallels.areas()[i], is_smaller) << i;
  }
  // Sides of 180 degrees along other parallels than the equator would run over a pole.
  EXPECT_THROW((void)CellSet::lonlat_grid(regular_grid(2, 7), GridSides::great_circles),
               InvalidInput);
  EXPECT_THROW((void)NamedGrid("grid:1x3", GridSides::great_circles).cells(), InvalidInput);
  EXPECT_TRUE(CellSet::lonlat_grid(regular_grid(3, 7), GridSides::great_circles).covers_sphere());
  EXPECT_THROW((void)CellSet::lonlat_grid(regular_grid(2, 2), GridSides::great_circles),
               InvalidInput);
  const Remap remap = rondel::remap(arcs, parallels);
  EXPECT_NEAR(std::accumulate(remap.areas.begin(), remap.areas.end(), 0.0), 4 * std::numbers::pi,
              1e-13);
}

// Hemispheres whose border is along meridians, with both poles as corners or not.
TEST(overlay_grid, borders_through_the_poles) {
  const CellSet grid = CellSet::lonlat_grid(regular_grid(8, 4));
  for (const double lon : {0.0, 45.0, 90.0, 135.0, -45.0, 180.0}) {
    CellRings halves;
    for (const auto& [east, lat] : {std::pair{0.0, 0.0}, {0, 90}, {180, 0}, {0, -90}}) {
      halves.points.push_back(unit_vector_deg(lon + east, lat));
    }
    halves.corners = {0, 1, 2, 3, 0, 3, 2, 1};
    halves.rings = {0, 4, 8};
    halves.cells = {0, 1, 2};
    const CellSet cells = CellSet::polygons(halves);
    for (const unsigned order : {1U, 2U}) {
      const Remap remap = rondel::remap(cells, grid, {.order = order});
      for (std::size_t j = 0; j < 32; ++j) {
        const auto west = static_cast<double>(j % 8) * 45 - 180;
        // The half to the left of the way from lon over the northern pole is to the west of lon.
        const bool is_first = std::sin((west + 22.5 - lon) * std::numbers::pi / 180) < 0;
        EXPECT_NEAR(piece_of(remap, is_first ? 0 : 1, j), grid.areas()[j], 1e-15)
            << lon << ' ' << j;
        EXPECT_EQ(piece_of(remap, is_first ? 1 : 0, j), 0) << lon << ' ' << j;
      }
    }
  }
}

// A side from one meridian of the grid over the pole to the opposite one.
TEST(overlay_grid, sides_over_the_pole) {
  CellRings triangle;
  for (const auto& [lon, lat] : {std::pair{180.0, 0.0}, {0, 70}, {70, 0}}) {
    triangle.points.push_back(unit_vector_deg(lon, lat));
  }
  triangle.corners = {0, 1, 2};
  triangle.rings = {0, 3};
  triangle.cells = {0, 1};
  const CellSet cell = CellSet::polygons(triangle);
  for (const std::size_t num_lon : {1U, 2U, 4U, 12U}) {
    for (const double west : {-180.0, -170.0, 0.0}) {
      const Remap remap =
          rondel::remap(cell, CellSet::lonlat_grid(regular_grid(num_lon, 5, west)), {.order = 2});
      EXPECT_NEAR(remap.source_fractions[0], 1, 1e-14) << num_lon << ' ' << west;
    }
  }
}

// Cells between great circles through the corners of a grid, each coordinate of which is off by up to `noise`.
CellRings cells_of_corners_of(const LonLatGrid& grid, double noise, Random& random) {
  const std::size_t columns = grid.lon_deg.size() - 1;
  const std::size_t rows = grid.lat_deg.size() - 1;
  const auto off = [&] { return noise * (2 * random.unit() - 1); };
  CellRings cells;
  for (std::size_t r = 0; r <= rows; ++r) {
    const bool is_pole = std::abs(grid.lat_deg[r]) == 90;
    for (std::size_t c = 0; c < columns; ++c) {
      const Point p = unit_vector(LonLat{is_pole ? 0 : grid.lon_deg[c], grid.lat_deg[r]});
      cells.points.push_back(
          is_pole || noise == 0 ? p : normalized(Point{p.x + off(), p.y + off(), p.z + off()}));
    }
  }
  const auto corner = [&](std::size_t r, std::size_t c) {
    const bool is_pole = std::abs(grid.lat_deg[r]) == 90;
    return static_cast<Index>(r * columns + (is_pole ? 0 : c % columns));
  };
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<Index> ring = {corner(r, c), corner(r, c + 1), corner(r + 1, c + 1),
                                 corner(r + 1, c)};
      ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
      cells.corners.insert(cells.corners.end(), ring.begin(), ring.end());
      cells.rings.push_back(cells.corners.size());
      cells.cells.push_back(cells.rings.size() - 1);
    }
  }
  return cells;
}

// The area between a parallel and the arc of a great circle over so many degrees of longitude, which is poleward.
double area_of_arc(double lat_deg, double width_deg) {
  constexpr long double degree = half_turn / 180;
  const long double sine = std::sin(std::abs(lat_deg) * degree);
  const long double half = width_deg * degree / 2;
  return static_cast<double>(2 * (std::atan(sine * std::tan(half)) - sine * half));
}

// Cells of a mesh have the lines of the grid but for rounding, and arcs between corners instead of parallels: each has its
// box but for the bulges of its sides.
TEST(overlay_grid, meshes_with_the_corners_of_the_grid) {
  Random random(5);
  for (const double step : {4.0, 5.0, 6.0, 12.0, 15.0, 20.0}) {
    const auto columns = static_cast<std::size_t>(360 / step);
    const std::size_t rows = columns / 2;
    const LonLatGrid grid = regular_grid(columns, rows);
    const CellSet boxes = CellSet::lonlat_grid(grid);
    for (const double noise : {0.0, 1e-16, 2e-16, 1e-15}) {
      SCOPED_TRACE(std::to_string(step) + ' ' + std::to_string(noise));
      const CellSet mesh = CellSet::polygons(cells_of_corners_of(grid, noise, random));
      const bool is_source = random.below(2) == 0;
      const Remap remap = is_source ? rondel::remap(mesh, boxes) : rondel::remap(boxes, mesh);
      std::size_t num_pieces = 0;
      for (std::size_t r = 0; r < rows; ++r) {
        const double south = grid.lat_deg[r];
        const double north = grid.lat_deg[r + 1];
        const double above = north > 0 && north < 90 ? area_of_arc(north, step) : 0;
        const double below = south < 0 && south > -90 ? area_of_arc(south, step) : 0;
        const double of_box = boxes.areas()[r * columns];
        const double inside = of_box - (south > 0 ? area_of_arc(south, step) : 0) -
                              (north < 0 ? area_of_arc(north, step) : 0);
        num_pieces += columns * (1U + (above > 0 ? 1U : 0U) + (below > 0 ? 1U : 0U));
        for (std::size_t c = 0; c < columns; ++c) {
          const std::size_t cell = r * columns + c;
          const auto piece = [&](std::size_t box) {
            return is_source ? piece_of(remap, cell, box) : piece_of(remap, box, cell);
          };
          EXPECT_NEAR(piece(cell), inside, 16 * (ulp + noise)) << cell;
          if (above > 0) {
            EXPECT_NEAR(piece(cell + columns), above, 16 * (ulp + noise)) << cell;
          }
          if (below > 0) {
            EXPECT_NEAR(piece(cell - columns), below, 16 * (ulp + noise)) << cell;
          }
        }
      }
      // What is beyond a meridian by rounding alone is no piece.
      EXPECT_EQ(remap.pieces.values.size(), num_pieces);
    }
  }
}

TEST(overlay_grid, of_few_cells) {
  for (const std::size_t n : {1U, 2U, 3U, 4U}) {
    const CellSet cells = CellSet::voronoi(triangulation_of("uniform", n, 15));
    for (const std::size_t num_lon : {1U, 2U, 5U}) {
      const CellSet grid = CellSet::lonlat_grid(regular_grid(num_lon, 4));
      for (const Remap& remap : {rondel::remap(cells, grid), rondel::remap(grid, cells)}) {
        EXPECT_NEAR(std::accumulate(remap.areas.begin(), remap.areas.end(), 0.0),
                    4 * std::numbers::pi, 1e-13)
            << n << ' ' << num_lon;
      }
    }
  }
}

// Columns from east to west are those from west to east in reverse.
TEST(overlay_grid, meridians_may_decrease) {
  for (const bool is_around : {false, true}) {
    LonLatGrid east = regular_grid(7, 5);
    if (!is_around) east.lon_deg.pop_back();
    LonLatGrid west = east;
    std::ranges::reverse(west.lon_deg);
    const std::size_t columns = east.lon_deg.size() - 1;
    const auto mirrored = [&](std::size_t cell) {
      return cell - cell % columns + columns - 1 - cell % columns;
    };
    const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 60, 3));
    for (const GridSides sides : {GridSides::parallels, GridSides::great_circles}) {
      const CellSet a = CellSet::lonlat_grid(east, sides);
      const CellSet b = CellSet::lonlat_grid(west, sides);
      EXPECT_EQ(a.covers_sphere(), b.covers_sphere());
      const Remap of_a = rondel::remap(cells, a, {.order = 2});
      const Remap of_b = rondel::remap(cells, b, {.order = 2});
      const Remap same = rondel::remap(a, b);
      for (std::size_t i = 0; i < a.num_cells(); ++i) {
        const std::size_t j = mirrored(i);
        EXPECT_NEAR(a.areas()[i], b.areas()[j], 1e-15);
        EXPECT_NEAR(of_a.target_fractions[i], of_b.target_fractions[j], 1e-13);
        EXPECT_EQ(of_a.weights.offsets[i + 1] - of_a.weights.offsets[i],
                  of_b.weights.offsets[j + 1] - of_b.weights.offsets[j]);
        ASSERT_EQ(same.weights.offsets[j + 1] - same.weights.offsets[j], 1U);
        EXPECT_EQ(same.weights.columns[same.weights.offsets[j]], i);
      }
    }
  }
}

TEST(overlay_grid, names_what_is_wrong) {
  const auto message_of = [](const LonLatGrid& grid) -> std::string {
    return thrown_message<InvalidInput>([&] { return CellSet::lonlat_grid(grid); });
  };
  EXPECT_EQ(message_of({{0}, {0, 1}}), "a grid of 1 meridians and 2 parallels has no cell");
  EXPECT_EQ(message_of({{0, 1, 1}, {0, 1}}), "meridian 2, 1, is not east of the last");
  EXPECT_EQ(message_of({{2, 1, 1}, {0, 1}}), "meridian 2, 1, is not west of the last");
  EXPECT_EQ(message_of({{0, 361}, {0, 1}}), "meridian 1, 361, is more than once around the globe");
  EXPECT_EQ(message_of({{0, NAN}, {0, 1}}), "meridian 1, nan, is no longitude");
  EXPECT_EQ(message_of({{0, 1}, {0, 91}}), "parallel 1, 91, is no latitude");
  EXPECT_EQ(message_of({{0, 1}, {0, -1, 2}}), "parallel 2, 2, is not in order");
  const CellSet grid = CellSet::lonlat_grid(regular_grid(4, 2));
  EXPECT_THROW((void)grid.rings(), InvalidInput);
  EXPECT_THROW((void)intersection(grid, grid), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
