// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rows of grids next to the poles, and thin rows anywhere: areas, and pieces of grids and of triangles, against closed forms in
// MPFR of 77 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "rondel/remap.h"
#include "support/random.h"
#include "unit/overlay/oracle.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr double half_ulp = 0x1p-53;

Wide wide_pi() { return acos(Wide(-1)); }
Wide wide_radians(double degrees) { return Wide(degrees) * wide_pi() / 180; }
Wide wide_box(double west, double south, double east, double north) {
  return (wide_radians(east) - wide_radians(west)) *
         (sin(wide_radians(north)) - sin(wide_radians(south)));
}

class PolarGrids {
 public:
  explicit PolarGrids(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * random_.unit(); }
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  bool one_of(std::size_t n) { return random_.below(n) == 0; }

  // Up to a pole, from some multiple of `size` on.
  std::vector<double> latitudes(double size, std::size_t num_rows) {
    const double pole = one_of(2) ? 90 : -90;
    std::vector<double> lat = {pole};
    for (std::size_t k = 0; k < num_rows; ++k) {
      lat.push_back(std::copysign(90 - size * uniform(0.1, 1.5), pole));
    }
    std::ranges::sort(lat);
    return lat;
  }
  std::vector<double> longitudes(std::size_t num_columns) {
    std::vector<double> lon;
    for (std::size_t k = 0; k <= num_columns; ++k) lon.push_back(uniform(-180, 180));
    std::ranges::sort(lon);
    return lon;
  }

 private:
  Random random_;
};

TEST(overlay_polar, areas_of_thin_rows_are_right_to_some_units) {
  PolarGrids random(1);
  for (int trial = 0; trial < 60; ++trial) {
    LonLatGrid grid = {random.longitudes(2), random.latitudes(random.power(-10, 1), 3)};
    if (trial % 3 == 0) {
      const double south = random.uniform(-89, 88);
      grid.lat_deg = {south, south + random.power(-10, 0)};
    }
    const CellSet cells = CellSet::lonlat_grid(grid);
    for (std::size_t j = 0; j + 1 < grid.lat_deg.size(); ++j) {
      for (std::size_t i = 0; i < 2; ++i) {
        const auto area = static_cast<double>(
            wide_box(grid.lon_deg[i], grid.lat_deg[j], grid.lon_deg[i + 1], grid.lat_deg[j + 1]));
        EXPECT_NEAR(cells.areas()[2 * j + i], area, 8 * half_ulp * area) << grid.lat_deg[j];
      }
    }
  }
  // Of 2 pi (1 - sin(lat)).
  const CellSet cap = CellSet::lonlat_grid({{-180, 180}, {90 - 1e-4, 90}});
  const auto area = static_cast<double>(2 * wide_pi() * (1 - sin(wide_radians(90 - 1e-4))));
  EXPECT_NEAR(cap.areas()[0], area, 4 * half_ulp * area);
}

TEST(overlay_polar, pieces_of_two_grids_are_right_to_some_units) {
  PolarGrids random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const double size = random.power(-5, 1);
    const LonLatGrid from = {random.longitudes(2), random.latitudes(size, 2)};
    LonLatGrid to = {random.longitudes(2), random.latitudes(size, 2)};
    if (from.lat_deg[0] * to.lat_deg[0] < 0) {
      for (double& lat : to.lat_deg) lat = -lat;
      std::ranges::reverse(to.lat_deg);
    }
    const Remap remap = rondel::remap(CellSet::lonlat_grid(from), CellSet::lonlat_grid(to));
    for (std::size_t t = 0; t < 4; ++t) {
      for (std::size_t s = 0; s < 4; ++s) {
        const double west = std::max(from.lon_deg[s % 2], to.lon_deg[t % 2]);
        const double east = std::min(from.lon_deg[s % 2 + 1], to.lon_deg[t % 2 + 1]);
        const double south = std::max(from.lat_deg[s / 2], to.lat_deg[t / 2]);
        const double north = std::min(from.lat_deg[s / 2 + 1], to.lat_deg[t / 2 + 1]);
        const bool is_empty = !(west < east) || !(south < north);
        const double area = is_empty ? 0 : static_cast<double>(wide_box(west, south, east, north));
        EXPECT_NEAR(piece_of(remap, s, t), area, 16 * half_ulp * area) << trial;
      }
    }
  }
}

struct WidePoint {
  Wide x, y, z;
};

// The part of a side between two heights, above the lower one, with the side's longitudes from `lon` to `end`.
Wide strip_below(const WidePoint& normal, const Wide& lon, const Wide& end, const Wide& low,
                 const Wide& high) {
  const auto sine_at = [&](const Wide& at) {
    const Wide tangent = -(normal.x * cos(at) + normal.y * sin(at)) / normal.z;
    return Wide(tangent / sqrt(1 + tangent * tangent));
  };
  std::vector<Wide> cuts = {lon, end};
  for (const Wide& height : {low, high}) {
    if (abs(height) >= 1) continue;
    const Wide cosine = -height / sqrt(1 - height * height) * normal.z /
                        sqrt(normal.x * normal.x + normal.y * normal.y);
    if (abs(cosine) > 1) continue;
    for (const int sign : {-1, 1}) {
      for (int turn = -2; turn <= 2; ++turn) {
        const Wide at =
            Wide(atan2(normal.y, normal.x)) + sign * acos(cosine) + 2 * turn * wide_pi();
        if (at > std::min(lon, end) && at < std::max(lon, end)) cuts.push_back(at);
      }
    }
  }
  std::ranges::sort(cuts);
  if (lon > end) std::ranges::reverse(cuts);
  Wide sum = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Wide width = cuts[k + 1] - cuts[k];
    const Wide middle = sine_at((cuts[k] + cuts[k + 1]) / 2);
    if (middle >= high) {
      sum += width * (high - low);
    } else if (middle > low) {
      const Wide p = sine_at(cuts[k]);
      const Wide q = sine_at(cuts[k + 1]);
      const Wide of_ends = sqrt((1 - p * p) * (1 - q * q)) + p * q;
      sum += 2 * atan((p + q) / (1 + of_ends) * tan(width / 2)) - low * width;
    }
  }
  return sum;
}

// The part of a counterclockwise ring between two parallels.
double part_between(const std::vector<Point>& ring, double south, double north) {
  const Wide low = sin(wide_radians(south));
  const Wide high = sin(wide_radians(north));
  Wide area = 0;
  Wide turns = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point& from = ring[k];
    const Point& to = ring[k + 1 < ring.size() ? k + 1 : 0];
    const WidePoint p = {from.x, from.y, from.z};
    const WidePoint q = {to.x, to.y, to.z};
    const WidePoint normal = {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    const Wide lon = atan2(p.y, p.x);
    const Wide turn = atan2(normal.z, p.x * q.x + p.y * q.y);
    area -= strip_below(normal, lon, lon + turn, low, high);
    turns += turn;
  }
  if (turns > 1) area += 2 * wide_pi() * (high - low);  // around the northern pole
  return static_cast<double>(area);
}

// A triangle of this size beside a pole or around it, some of whose sides come near to it.
std::vector<Point> polar_triangle(PolarGrids& random, double size, double distance, double pole) {
  std::vector<LonLat> plane;  // of which the pole is the middle
  for (int k = 0; k < 3; ++k) {
    plane.push_back({random.uniform(-size, size), random.uniform(-size, size)});
  }
  if (random.one_of(2)) {
    const double t = -random.uniform(0.2, 1);
    plane[1] = {t * plane[0].lon_deg + random.uniform(-distance, distance),
                t * plane[0].lat_deg + random.uniform(-distance, distance)};
  }
  std::vector<Point> ring;
  for (const auto& [x, y] : plane) {
    const double lon = std::atan2(y, x) * 180 / std::numbers::pi;
    ring.push_back(unit_vector({lon, std::copysign(90 - std::hypot(x, y), pole)}));
  }
  if (orientation(ring[0], ring[1], ring[2]) == Sign::negative) std::ranges::reverse(ring);
  return ring;
}

TEST(overlay_polar, pieces_of_triangles_are_right_to_rounding_of_their_place) {
  PolarGrids random(3);
  for (int trial = 0; trial < 150; ++trial) {
    const double distance = random.power(-9, 0.5);
    const double size = trial % 2 == 0 ? distance : random.power(std::log10(distance), 1.5);
    LonLatGrid grid = {{-180, 180}, random.latitudes(distance, 4)};
    const double pole = grid.lat_deg.back() == 90 ? 90 : -90;
    (pole > 0 ? grid.lat_deg.front() : grid.lat_deg.back()) = 0;
    const std::vector<Point> ring = polar_triangle(random, size, distance, pole);
    CellRings cells;
    cells.points = ring;
    cells.corners = {0, 1, 2};
    cells.rings = {0, 3};
    cells.cells = {0, 1};
    const Remap remap = rondel::remap(CellSet::polygons(cells), CellSet::lonlat_grid(grid));
    for (std::size_t row = 0; row + 1 < grid.lat_deg.size(); ++row) {
      const double south = grid.lat_deg[row];
      const double north = grid.lat_deg[row + 1];
      // Places are right to rounding, and nearer to the pole to that of their distance, so areas are to that times a length.
      const double radius = std::min(90 - std::min(std::abs(south), std::abs(north)), 4 * size);
      EXPECT_NEAR(piece_of(remap, 0, row), part_between(ring, south, north),
                  64 * half_ulp * radius * std::numbers::pi / 180)
          << trial << ", row " << row << ", size " << size << ", distance " << distance;
    }
  }
}

// A row that is thinner than rounding of the sine of its latitude is covered by what covers it, and by nothing else.
TEST(overlay_polar, fractions_of_rows_at_a_pole) {
  const CellSet grid = CellSet::lonlat_grid({{-180, 180}, {-90, 0, 90 - 2e-7, 90 - 1e-7, 90}});
  const CellSet half = CellSet::lonlat_grid({{-180, 0}, {-90, 90}}, GridSides::parallels);
  const Remap of_half = remap(half, grid);
  for (std::size_t row = 0; row < 4; ++row) EXPECT_NEAR(of_half.target_fractions[row], 0.5, 4e-16);
  CellRings octant;
  octant.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  octant.corners = {0, 1, 2};
  octant.rings = {0, 3};
  octant.cells = {0, 1};
  const Remap of_octant = remap(CellSet::polygons(octant), grid);
  EXPECT_EQ(of_octant.target_fractions[0], 0);
  for (std::size_t row = 1; row < 4; ++row) {
    EXPECT_NEAR(of_octant.target_fractions[row], 0.25, 1e-15);
  }
}

}  // namespace
}  // namespace rondel::test
