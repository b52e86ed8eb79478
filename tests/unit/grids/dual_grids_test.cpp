// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hexagons, and the tripolar grid: borders that two cells share bit by bit, places that are in one
// cell, areas, and corners by the formulas of the literature.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "grids/grid_formula.h"
#include "rondel/delaunay.h"
#include "rondel/named_grids.h"
#include "rondel/predicates.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using CornerBits = std::tuple<double, double, double>;
using Side = std::pair<CornerBits, CornerBits>;

constexpr double degree = std::numbers::pi / 180;

CornerBits bits_of(const Point& p) { return {p.x, p.y, p.z}; }

std::vector<std::vector<Point>> rings_of(const grids::GridFormula& grid) {
  std::vector<std::vector<Point>> rings(grid.num_cells());
  for (Index cell = 0; cell < grid.num_cells(); ++cell) grid.append_ring(cell, rings[cell]);
  return rings;
}

// Returns the cell to the left of each side; each side has one.
std::map<Side, std::size_t> sides_of(const std::vector<std::vector<Point>>& rings) {
  std::map<Side, std::size_t> sides;
  for (std::size_t cell = 0; cell < rings.size(); ++cell) {
    for (std::size_t k = 0; k < rings[cell].size(); ++k) {
      const Point& to = rings[cell][(k + 1) % rings[cell].size()];
      EXPECT_TRUE(sides.emplace(Side(bits_of(rings[cell][k]), bits_of(to)), cell).second) << cell;
    }
  }
  return sides;
}

// Returns the sides that no other cell has in the other direction.
std::vector<Side> outer_sides(const std::map<Side, std::size_t>& sides) {
  std::vector<Side> outer;
  for (const auto& [side, cell] : sides) {
    if (!sides.contains({side.second, side.first})) outer.push_back(side);
  }
  return outer;
}

// Returns how many convex cells have a point, by exact signs.
int cells_with(const std::vector<std::vector<Point>>& rings, const Point& point) {
  int count = 0;
  for (const std::vector<Point>& ring : rings) {
    bool is_inside = true;
    for (std::size_t k = 0; k < ring.size() && is_inside; ++k) {
      is_inside = orientation(ring[k], ring[(k + 1) % ring.size()], point) == Sign::positive;
    }
    count += is_inside ? 1 : 0;
  }
  return count;
}

void expect_convex(const std::vector<std::vector<Point>>& rings) {
  for (std::size_t cell = 0; cell < rings.size(); ++cell) {
    const std::vector<Point>& ring = rings[cell];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      EXPECT_EQ(orientation(ring[k], ring[(k + 1) % ring.size()], ring[(k + 2) % ring.size()]),
                Sign::positive)
          << cell << ' ' << k;
    }
  }
}

// The area of a triangle by Eriksson's formula, in long double.
double triangle_of(const Point& a, const Point& b, const Point& c) {
  const auto product = [](const Point& p, const Point& q) {
    return static_cast<long double>(p.x) * q.x + static_cast<long double>(p.y) * q.y +
           static_cast<long double>(p.z) * q.z;
  };
  const Point ab = cross(a, b);
  const long double volume = product(ab, c);
  return static_cast<double>(2 *
                             std::atan2(volume, 1 + product(a, b) + product(b, c) + product(c, a)));
}

Point random_point(Random& random) {
  for (;;) {
    const Point p{2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
    const double squared = dot(p, p);
    if (squared > 0.01 && squared < 1) return normalized(p);
  }
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(tripolar_grid, sides_are_shared_but_those_of_the_first_row) {
  for (const unsigned columns : {12U, 16U, 36U, 120U, 364U}) {
    const auto grid = grids::tripolar_grid(columns);
    const std::vector<std::vector<Point>> rings = rings_of(*grid);
    const std::map<Side, std::size_t> sides = sides_of(rings);
    const std::vector<Side> outer = outer_sides(sides);
    EXPECT_EQ(outer.size(), columns);
    for (const Side& side : outer) EXPECT_LT(sides.at(side), columns);
    // Cells of the last row meet across the fold, those of others across the seam of the columns.
    const Index last = grid->num_cells() - columns;
    const auto are_neighbors = [&](Index a, Index b) {
      return std::ranges::any_of(sides, [&](const auto& entry) {
        const auto other = sides.find({entry.first.second, entry.first.first});
        return entry.second == a && other != sides.end() && other->second == b;
      });
    };
    for (const Index i : {Index{0}, Index{1}, columns / 4, columns / 2 - 1}) {
      EXPECT_TRUE(are_neighbors(last + i, last + columns - 1 - i)) << columns << ' ' << i;
    }
    EXPECT_TRUE(are_neighbors(0, columns - 1));
    expect_convex(rings);
  }
}

TEST(tripolar_grid, areas_are_those_of_the_sphere_north_of_the_first_row) {
  for (const char* const name : {"tripolar:30", "tripolar:10", "tripolar:3", "tripolar:1"}) {
    const NamedGrid grid(name);
    const CellSet cells = grid.cells();
    EXPECT_FALSE(grid.covers_sphere());
    EXPECT_FALSE(cells.covers_sphere());
    const std::vector<double> areas(cells.areas().begin(), cells.areas().end());
    const auto columns = static_cast<std::size_t>(grid.shape()[1]);
    const CellRings rings = cells.given_rings();
    long double south = 0;
    for (std::size_t i = 0; i < columns; ++i) {
      const auto ring = rings.corners_of(rings.cells[i]);
      south += triangle_of({0, 0, -1}, rings.points[ring[1]], rings.points[ring[0]]);
    }
    const long double sum = std::accumulate(areas.begin(), areas.end(), 0.0L);
    const long double missing = 4 * std::numbers::pi_v<long double> - south - sum;
    EXPECT_LT(std::abs(static_cast<double>(missing)), 2e-14) << name;
    EXPECT_GT(*std::ranges::min_element(areas), 0);
  }
}

// Points at random, near poles of the cap and on both sides of the fold.
TEST(tripolar_grid, a_place_is_in_one_cell) {
  Random random(36);
  for (const unsigned columns : {12U, 24U, 60U}) {
    const std::vector<std::vector<Point>> rings = rings_of(*grids::tripolar_grid(columns));
    int num_inside = 0;
    for (int k = 0; k < 2000; ++k) {
      Point point = random_point(random);
      if (k % 2 == 1) {
        // Beside a corner of the cap, by up to 1e-2 in longitude and latitude.
        const std::vector<Point>& ring = rings[rings.size() - 1 - random.below(columns * 3)];
        const Point& corner = ring[random.below(ring.size())];
        point = normalized(corner + 0.01 * random_point(random));
      }
      const int count = cells_with(rings, point);
      EXPECT_LE(count, 1) << columns;
      num_inside += count;
      if (point.z > -0.97) {
        EXPECT_EQ(count, 1) << columns << ' ' << k;
      }
    }
    EXPECT_GT(num_inside, 1900);
  }
}

// The latitude of Mercator's ordinate y is atan(sinh(y)). In the cap, a corner on the circle at the
// angle t from A and on the meridian that rises by r is, by the sides of the right triangle at the
// north pole of the other sphere, at the colatitude c with cos(c) = sin(t) sin(r), in the direction
// atan2(sin(t) cos(r), cos(t)) from A; the projection turns the colatitude c into
// 2 atan(tan(c / 2) tan(c0 / 2)) with c0 that of the joint.
TEST(tripolar_grid, corners_are_those_of_murray) {
  for (const int columns : {12, 36, 360, 1440}) {
    const auto grid = grids::tripolar_grid(static_cast<unsigned>(columns));
    const double step = 360.0 / columns;
    const auto joint =
        static_cast<int>(std::lround(std::asinh(std::tan(65 * degree)) / degree / step));
    const auto south =
        static_cast<int>(std::ceil(std::asinh(std::tan(78 * degree)) / degree / step));
    const int rows = joint + south + columns / 4;
    ASSERT_EQ(grid->shape(), (std::vector<std::uint64_t>{static_cast<std::uint64_t>(rows),
                                                         static_cast<std::uint64_t>(columns)}));
    const auto wanted = [&](double i, double j) {
      const double lon = (80 + i * step) * degree;
      if (j <= joint + south || i == 0 || i == columns / 2.0 || i == columns) {
        const double lat =
            std::atan(std::sinh((std::min<double>(j, joint + south) - south) * step * degree));
        return Point{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
      }
      const double rise = (j - joint - south) * step * degree;
      const bool is_beyond = 2 * i > columns;
      const double angle = (is_beyond ? columns - i : i) * step * degree;
      const double colatitude = std::acos(std::sin(angle) * std::sin(rise));
      const double turn = std::atan2(std::sin(angle) * std::cos(rise), std::cos(angle));
      const double of_joint = std::numbers::pi / 2 - std::atan(std::sinh(joint * step * degree));
      const double c = 2 * std::atan(std::tan(colatitude / 2) * std::tan(of_joint / 2));
      const double azimuth = 80 * degree + (is_beyond ? -turn : turn);
      return Point{std::sin(c) * std::cos(azimuth), std::sin(c) * std::sin(azimuth), std::cos(c)};
    };
    Random random(9);
    for (int k = 0; k < 2000; ++k) {
      // All of the rows beside the joint and the fold, and others at random.
      const int j = k % 4 == 0   ? rows - 1
                    : k % 4 == 1 ? joint + south + static_cast<int>(random.below(2)) - 1
                                 : static_cast<int>(random.below(static_cast<std::size_t>(rows)));
      const int i = static_cast<int>(random.below(static_cast<std::size_t>(columns)));
      const auto cell = static_cast<Index>(j * columns + i);
      std::vector<Point> ring;
      grid->append_ring(cell, ring);
      const std::array<Point, 4> corners = {wanted(i, j), wanted(i + 1, j), wanted(i + 1, j + 1),
                                            wanted(i, j + 1)};
      for (const Point& corner : corners) {
        const auto nearest =
            std::ranges::min(ring, {}, [&](const Point& own) { return distance(own, corner); });
        EXPECT_LT(distance(nearest, corner), 2e-8) << columns << ' ' << i << ' ' << j;
        if (j < rows - 1) {
          EXPECT_LT(distance(nearest, corner), 3e-14) << columns << ' ' << i << ' ' << j;
        }
      }
      EXPECT_LT(distance(unit_vector(grid->center(cell)), wanted(i + 0.5, j + 0.5)), 3e-14);
    }
  }
}

TEST(tripolar_grid, the_fold_is_on_the_meridians_of_the_poles) {
  const auto grid = grids::tripolar_grid(72);
  std::vector<Point> ring;
  for (Index i = 1; i < 35; ++i) {
    ring.clear();
    grid->append_ring(grid->num_cells() - 72 + i, ring);
    for (const Point& corner : {ring[2], ring[3]}) {
      const double lon = std::atan2(corner.y, corner.x) / degree;
      if (corner.z < 1) {
        EXPECT_NEAR(corner.z > 0 && i < 18 ? lon - 80 : lon + 100, 0, 1e-12) << i;
      }
    }
    if (i == 17) {
      EXPECT_EQ(ring[2], (Point{0, 0, 1}));
    }
  }
}

// The height of a cell is its width, on both sides of the joint, half way between the poles.
TEST(tripolar_grid, cells_are_as_high_as_wide_at_the_joint) {
  constexpr unsigned columns = 1440;
  const auto grid = grids::tripolar_grid(columns);
  const Index first_of_cap = static_cast<Index>(grid->num_cells() - columns * (columns / 4));
  for (const Index cell : {first_of_cap - columns + columns / 4, first_of_cap + columns / 4}) {
    std::vector<Point> ring;
    grid->append_ring(cell, ring);
    EXPECT_NEAR(distance(ring[1], ring[2]) / distance(ring[0], ring[1]), 1, 0.005);
  }
}

TEST(hexagon_grid, sides_are_shared) {
  for (const auto& [root, bisections] :
       {std::pair{1U, 0U}, {2U, 0U}, {1U, 1U}, {3U, 0U}, {5U, 1U}, {2U, 3U}, {7U, 0U}, {1U, 4U}}) {
    const auto grid = grids::hexagon_grid(root, bisections);
    const std::vector<std::vector<Point>> rings = rings_of(*grid);
    const Index n = root << bisections;
    EXPECT_EQ(rings.size(), 10 * n * n + 2);
    EXPECT_TRUE(outer_sides(sides_of(rings)).empty());
    EXPECT_EQ(std::ranges::count(rings, std::size_t{5}, &std::vector<Point>::size), 12);
    EXPECT_EQ(std::ranges::count(rings, std::size_t{6}, &std::vector<Point>::size),
              10 * n * n - 10);
    expect_convex(rings);
  }
}

TEST(hexagon_grid, a_place_is_in_the_cell_of_the_nearest_center) {
  Random random(3);
  const auto grid = grids::hexagon_grid(2, 2);
  const std::vector<std::vector<Point>> rings = rings_of(*grid);
  std::vector<Point> centers(rings.size());
  for (Index cell = 0; cell < rings.size(); ++cell) centers[cell] = unit_vector(grid->center(cell));
  for (int k = 0; k < 3000; ++k) {
    const Point point = random_point(random);
    std::vector<double> distances(centers.size());
    std::ranges::transform(centers, distances.begin(),
                           [&](const Point& center) { return distance(center, point); });
    const auto nearest = std::ranges::min_element(distances) - distances.begin();
    EXPECT_EQ(cells_with(rings, point), 1);
    EXPECT_EQ(cells_with({rings[static_cast<std::size_t>(nearest)]}, point), 1) << k;
  }
}

// Centers are the corners of the triangles, each once.
TEST(hexagon_grid, centers_are_corners_of_triangles) {
  const auto triangles = grids::triangle_grid(3, 2);
  std::map<CornerBits, int> corners;
  for (const std::vector<Point>& ring : rings_of(*triangles)) {
    for (const Point& corner : ring) ++corners[bits_of(corner)];
  }
  std::vector<LonLat> wanted;
  for (const auto& [corner, times] : corners) {
    const auto& [x, y, z] = corner;
    wanted.push_back(lonlats(std::vector<Point>{{x, y, z}})[0]);
  }
  std::vector<LonLat> found = NamedGrid("hexagons:R3B2").centers();
  const auto is_before = [](const LonLat& a, const LonLat& b) {
    return std::tie(a.lon_deg, a.lat_deg) < std::tie(b.lon_deg, b.lat_deg);
  };
  std::sort(found.begin(), found.end(), is_before);
  std::sort(wanted.begin(), wanted.end(), is_before);
  EXPECT_EQ(found, wanted);
}

// Rows of places inside of faces are found by a square root, which may be off by one.
TEST(hexagon_grid, large_grids_have_cells_around_their_centers) {
  for (const auto& [root, bisections] : {std::pair{100U, 7U}, {2U, 12U}, {1U, 13U}}) {
    const auto grid = grids::hexagon_grid(root, bisections);
    Random random(8);
    const Index n = root << bisections;
    for (int k = 0; k < 3000; ++k) {
      // The ends of rows are where the numbers of places jump.
      const std::uint64_t j = 1 + random.below(n - 2);
      const std::uint64_t of_face = std::uint64_t{n - 1} * (n - 2) / 2;
      const std::uint64_t row = (j - 1) * (2 * std::uint64_t{n} - 2 - j) / 2;
      const std::uint64_t inside =
          12 + 30 * std::uint64_t{n - 1} + random.below(20) * of_face + row;
      const auto cell =
          static_cast<Index>(k % 3 == 0 ? random.below(grid->num_cells())
                                        : std::max<std::uint64_t>(inside, 1) - (k % 3 - 1));
      std::vector<Point> ring;
      grid->append_ring(cell, ring);
      EXPECT_EQ(cells_with({ring}, unit_vector(grid->center(cell))), 1) << cell;
    }
  }
}

}  // namespace
}  // namespace rondel::test
