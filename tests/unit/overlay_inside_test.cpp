// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What is inside of a cell: hostile regions against cells of every kind. The oracle knows a region as the sphere or
// nothing, plus or less convex polygons, whose parts in convex cells it finds by clipping; it shares no code with the overlay.
// RONDEL_TEST_SCALE multiplies the number of regions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "overlay_support.h"
#include "rondel/error.h"
#include "rondel/regions.h"

namespace rondel::test {
namespace {

using RingOfPoints = std::vector<Point>;

// A cell by its rings, and as a sum of convex polygons.
struct Region {
  std::vector<RingOfPoints> rings;
  std::vector<std::pair<int, RingOfPoints>> terms;  // 1 or -1 times what is left of the ring
  bool is_of_sphere = false;                        // and the whole sphere
  bool is_wrong = false;                            // it is no region
  double rounding = 1e-13;
};

RingOfPoints turned(RingOfPoints ring) {
  std::ranges::reverse(ring);
  return ring;
}

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * random_.unit(); }
  Point direction() {
    for (;;) {
      const Point p{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (const double square = dot(p, p); square > 0.01 && square < 1) return normalized(p);
    }
  }
  // The end of an axis now and then: a pole, or a point of the antimeridian.
  Point center() {
    constexpr std::array<Point, 4> special = {{{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
    const double which = uniform(0, 8);
    return which < 4 ? special.at(static_cast<std::size_t>(which)) : direction();
  }
  std::size_t below(double n) { return static_cast<std::size_t>(uniform(0, n)); }
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  // So many corners at one distance from a point, counterclockwise.
  RingOfPoints circle(const Point& center, double radius, std::size_t n, double stretch = 1) {
    const Point axis = std::abs(center.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point east = normalized(cross(axis, center));
    const Point north = cross(center, east);
    const double first = uniform(0, 1);
    RingOfPoints ring;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle =
          2 * std::numbers::pi * (static_cast<double>(k) + first) / static_cast<double>(n);
      ring.push_back(normalized(std::cos(radius) * center +
                                std::sin(radius) *
                                    (std::cos(angle) * east + stretch * std::sin(angle) * north)));
    }
    return ring;
  }
  // Points around a center that are apart: rings of them.
  std::vector<RingOfPoints> islands(const Point& center, double radius, std::size_t n) {
    std::vector<RingOfPoints> result;
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
    const Point axis = std::abs(center.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point east = normalized(cross(axis, center));
    const Point north = cross(center, east);
    const double step = radius / static_cast<double>(side);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t column = k % side;
      const std::size_t row = k / side;
      const double x = step * static_cast<double>(2 * column) - radius + step;
      const double y = step * static_cast<double>(2 * row) - radius + step;
      const Point at = normalized(center + x * east + y * north);
      result.push_back(circle(at, 0.6 * step * power(-3, 0), 3 + below(6)));
    }
    return result;
  }

 private:
  Random random_;
};

constexpr std::array<const char*, 12> kinds = {
    "sliver",  "folded", "bow tie", "bow tie with a corner",
    "keyhole", "spike",  "islands", "world less islands",
    "lagoon",  "belt",   "octant",  "cap"};

void add_islands(const std::vector<RingOfPoints>& islands, int sign, Region& region) {
  for (const RingOfPoints& island : islands) {
    region.rings.push_back(sign > 0 ? island : turned(island));
    region.terms.emplace_back(sign, island);
  }
}

void take(const RingOfPoints& ring, Region& region) {
  region.rings.push_back(ring);
  region.terms.emplace_back(1, ring);
}

// Along a great circle and back, to rounding.
void add_fold(const Point& center, Generator& next, Region& region) {
  const Point other = next.direction();
  RingOfPoints there;
  const std::size_t size = 3 + next.below(4);
  for (std::size_t k = 0; k < size; ++k) {
    there.push_back(normalized(center + next.uniform(-1, 1) * other));
  }
  RingOfPoints back(there.begin() + 1, there.end() - 1);
  for (Point& p : back) p = normalized(p + 1e-16 * next.direction());
  there.insert(there.end(), back.rbegin(), back.rend());
  region.rings.push_back(there);
  region.rounding = 1e-12;
}

// With or without a corner where it crosses itself.
void add_bow_tie(const Point& center, double radius, bool has_corner, Generator& next,
                 Region& region) {
  RingOfPoints ring = next.circle(center, radius, 4);
  std::swap(ring[2], ring[3]);
  if (has_corner) ring = {ring[0], ring[1], center, ring[2], ring[3], center};
  region.rings.push_back(ring);
  region.is_wrong = true;
}

// A ring that goes to its hole and back.
void add_keyhole(const Point& center, double radius, Generator& next, Region& region) {
  const RingOfPoints outer = next.circle(center, radius, 5);
  const RingOfPoints hole = turned(next.circle(center, radius / 3, 4));
  RingOfPoints ring = outer;
  ring.push_back(outer[0]);
  // The way to the corner of the hole that is nearest crosses nothing.
  const auto near =
      std::ranges::max_element(hole, {}, [&](const Point& p) { return dot(p, outer[0]); });
  ring.insert(ring.end(), near, hole.end());
  ring.insert(ring.end(), hole.begin(), near + 1);
  region.rings.push_back(ring);
  region.terms = {{1, outer}, {-1, turned(hole)}};
}

// A ring with a way out and back.
void add_spike(const Point& center, double radius, Generator& next, Region& region) {
  const RingOfPoints outer = next.circle(center, radius, 3 + next.below(5));
  RingOfPoints ring = outer;
  ring.push_back(outer[0]);
  ring.push_back(normalized(outer[0] + next.uniform(0.1, 1) * (outer[0] - center)));
  region.rings.push_back(ring);
  region.terms = {{1, outer}};
}

// The sphere less an island, and the island's lagoon.
void add_lagoon(const Point& center, Generator& next, Region& region) {
  const double size = next.power(-9, -0.3);
  add_islands({next.circle(center, size, 8)}, -1, region);
  add_islands({next.circle(center, size / 3, 5)}, 1, region);
  region.is_of_sphere = true;
}

void add_belt(const Point& center, Generator& next, Region& region) {
  const RingOfPoints outer = next.circle(center, next.uniform(1, 1.5), 40);
  const RingOfPoints inner = next.circle(center, next.uniform(0.1, 0.9), 30);
  region.rings = {outer, turned(inner)};
  region.terms = {{1, outer}, {-1, inner}};
}

void add_octant(Generator& next, Region& region) {
  const double x = next.below(2) == 0 ? 1 : -1;
  const double y = next.below(2) == 0 ? 1 : -1;
  const double z = next.below(2) == 0 ? 1 : -1;
  const RingOfPoints ring = {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
  take(x * y * z < 0 ? turned(ring) : ring, region);
}

// A cap, or all but a cap.
void add_cap(const Point& center, Generator& next, Region& region) {
  const RingOfPoints cap = next.circle(center, next.uniform(0.01, 1.5), 3 + next.below(40));
  if (next.below(2) == 0) {
    take(cap, region);
  } else {
    add_islands({cap}, -1, region);
    region.is_of_sphere = true;
  }
}

Region region_of(std::size_t kind, Generator& next) {
  Region region;
  const Point center = next.center();
  const double radius = next.power(-3, -0.3);
  switch (kind) {
    case 0:
      take(next.circle(center, radius, 3 + next.below(9), next.power(-17, 0)), region);
      break;
    case 1:
      add_fold(center, next, region);
      break;
    case 2:
    case 3:
      add_bow_tie(center, radius, kind == 3, next, region);
      break;
    case 4:
      add_keyhole(center, radius, next, region);
      break;
    case 5:
      add_spike(center, radius, next, region);
      break;
    case 6:
    case 7:
      add_islands(next.islands(center, next.power(-6, -0.7), 1 + next.below(100)),
                  kind == 6 ? 1 : -1, region);
      region.is_of_sphere = kind == 7;
      break;
    case 8:
      add_lagoon(center, next, region);
      break;
    case 9:
      add_belt(center, next, region);
      break;
    case 10:
      add_octant(next, region);
      break;
    default:
      add_cap(center, next, region);
  }
  return region;
}

CellRings cells_of(const Region& region) {
  CellRings cells;
  for (const RingOfPoints& ring : region.rings) {
    for (const Point& p : ring) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()));
      cells.points.push_back(p);
    }
    cells.rings.push_back(cells.corners.size());
  }
  cells.cells.push_back(cells.rings.size() - 1);
  return cells;
}

LongRing long_ring(const RingOfPoints& ring) {
  LongRing result;
  for (const Point& p : ring) result.push_back(long_vector(p));
  return result;
}

RingOfPoints ring_of(const CellRings& cells, std::size_t cell) {
  RingOfPoints ring;
  const std::uint64_t r = cells.cells[cell];
  for (auto k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
    ring.push_back(cells.points[cells.corners[k]]);
  }
  return ring;
}

double expected_piece(const Region& region, const RingOfPoints& cell) {
  const LongRing whole = long_ring(cell);
  long double sum = region.is_of_sphere ? area_of(whole) : 0;
  for (const auto& [sign, ring] : region.terms) {
    LongRing piece = long_ring(ring);
    for (std::size_t k = 0; k < whole.size() && piece.size() > 2; ++k) {
      piece = clipped(piece, whole[k], whole[(k + 1) % whole.size()]);
    }
    sum += sign * area_of(piece);
  }
  return static_cast<double>(sum);
}

// The pieces of a region in convex cells.
void expect_pieces(const Region& region, const Partition& cell, const Partition& cover,
                   const CellRings& rings) {
  const Remap there = remap(cell, cover);
  const Remap back = remap(cover, cell, {.order = 2});
  const double clipped = areas(clip(cell, cover))[0];
  double total = 0;
  for (std::size_t j = 0; j < rings.num_cells(); ++j) {
    if (rings.cells[j] == rings.cells[j + 1]) continue;
    const double expected = expected_piece(region, ring_of(rings, j));
    total += expected;
    ASSERT_NEAR(piece_of(there, 0, j), expected, region.rounding) << j;
    ASSERT_NEAR(piece_of(back, j, 0), expected, region.rounding) << j;
  }
  ASSERT_NEAR(clipped, total, 10 * region.rounding);
  if (cover.is_cover()) {
    ASSERT_NEAR(cell.areas()[0], total, 10 * region.rounding);
    ASSERT_NEAR(areas(cells_of(region))[0], total, 10 * region.rounding);
  }
}

// What overlaps with everything, or nothing, in a grid of parallels has the area of the region.
void expect_sums(const Region& region, const Partition& cell, const Partition& grid) {
  const Remap there = remap(cell, grid);
  ASSERT_NEAR(std::accumulate(there.areas.begin(), there.areas.end(), 0.0), cell.areas()[0],
              10 * region.rounding);
}

struct Cover {
  Partition cells;
  CellRings rings;
};

std::vector<Cover> covers(std::uint64_t seed) {
  const auto sites = triangulation_of("uniform", 12 + 20 * (seed % 5), seed);
  std::vector<Cover> result;
  for (Partition cells : {Partition::voronoi(sites), Partition::triangles(sites),
                          Partition::lonlat_grid({{-180, -100, 0, 70, 180}, {-90, 0, 90}},
                                                 GridSides::great_circles)}) {
    CellRings rings = cells.rings();
    result.push_back({std::move(cells), std::move(rings)});
  }
  CellRings some = Partition::voronoi(sites).rings();
  std::vector<Index> groups(some.num_cells(), no_index);
  for (Index i = 0; i < groups.size(); ++i) {
    if (i % 3 != 0) groups[i] = i;
  }
  CellRings part = dissolve(some, groups, groups.size());
  result.push_back({Partition(part), std::move(part)});
  return result;
}

class OverlayInside : public testing::TestWithParam<std::size_t> {};

TEST_P(OverlayInside, pieces_are_those_of_clipping) {
  const std::size_t num_regions = scaled(10);
  const Partition grid = Partition::lonlat_grid({{-180, -60, 0, 10, 180}, {-90, -60, 0, 45, 90}});
  for (std::uint64_t seed = 0; seed < num_regions; ++seed) {
    Generator next(1000 * seed + GetParam());
    const Region region = region_of(GetParam(), next);
    SCOPED_TRACE(std::string(kinds.at(GetParam())) + ' ' + std::to_string(seed));
    const Partition cell(cells_of(region));
    for (const Cover& cover : covers(seed)) {
      if (region.is_wrong) {
        ASSERT_THROW((void)remap(cell, cover.cells), InvalidInput);
        ASSERT_THROW((void)remap(cover.cells, cell), InvalidInput);
        ASSERT_THROW((void)clip(cover.cells, cell), InvalidInput);
        continue;
      }
      expect_pieces(region, cell, cover.cells, cover.rings);
      if (HasFatalFailure()) return;
    }
    if (!region.is_wrong) expect_sums(region, cell, grid);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(overlay, OverlayInside, testing::Range(std::size_t{0}, kinds.size()),
                         [](const auto& test) {
                           std::string name = kinds.at(test.param);
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace rondel::test
