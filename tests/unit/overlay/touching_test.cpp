// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells with corners that are on sides of others, or of their own, to rounding: these do not overlap, and nothing is lost.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "unit/overlay/shapes.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Of the pieces of each cell in all of a cover, by four ways.
void expect_nothing_lost(const CellSet& cells, const CellSet& cover, double tolerance,
                         const std::string& name) {
  const double total = std::accumulate(cells.areas().begin(), cells.areas().end(), 0.0);
  const Remap to = remap(cover, cells);
  const Remap from = remap(cells, cover);
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    EXPECT_NEAR(to.target_fractions[i], 1, tolerance / cells.areas()[i]) << name << ' ' << i;
    EXPECT_NEAR(from.source_fractions[i], 1, tolerance / cells.areas()[i]) << name << ' ' << i;
  }
  EXPECT_NEAR(sum_of(areas(clip(cover, cells))), total, tolerance) << name;
  EXPECT_NEAR(sum_of(areas(clip(cells, cover))), total, tolerance) << name;
  // Neither is a cover.
  const RegionPieces pieces = intersection(cells, cells);
  std::vector<double> sums(cells.num_cells());
  const std::vector<double> of_pieces = areas(pieces.rings);
  for (std::size_t k = 0; k < of_pieces.size(); ++k) {
    EXPECT_TRUE(pieces.cells[k] == pieces.regions[k] || of_pieces[k] < tolerance) << name;
    sums[pieces.cells[k]] += of_pieces[k];
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    EXPECT_NEAR(sums[i], cells.areas()[i], tolerance) << name << ' ' << i;
  }
}

// A point at a longitude and a height above the equator, in one of three directions of axes.
Point above_equator(double longitude, double height, std::size_t turn) {
  const double radius = std::sqrt(1 - height * height);
  const std::array<double, 3> xyz = {radius * std::cos(longitude), radius * std::sin(longitude),
                                     height};
  return {xyz[turn % 3], xyz[(turn + 1) % 3], xyz[(turn + 2) % 3]};
}

constexpr std::array<double, 11> distances = {0,     1e-300, 1e-25, 1e-20, 1e-19, 1e-18,
                                              1e-17, 3e-17,  1e-16, 3e-16, 1e-15};

// A cell north of a part of the equator and one south of it, with corners of their own on it to rounding, and a spike of the
// first one into a slit of the second one, both no wider than rounding.
TEST(overlay_touching, corners_on_sides_to_rounding) {
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 60, 4));
  Random random(31);
  const auto distance = [&] {
    const double size = distances[random.below(distances.size())];
    return random.below(2) == 0 ? size : -size;
  };
  for (std::size_t trial = 0; trial < 300; ++trial) {
    const double start = random.unit() * 2 * std::numbers::pi;
    const auto place = [&](double longitude, double height) {
      return above_equator(start + longitude, height, trial);
    };
    const Point west = place(0, 0);
    const Point east = place(0.4, 0);
    const Point north = place(0.2, 0.3);
    const Point south = place(0.2, -0.3);
    const double middle = 0.1 + 0.2 * random.unit();
    const Point tip = place(middle, -0.05 * random.unit());
    const bool has_spike = random.below(4) != 0;
    const bool has_slit = has_spike && random.below(2) == 0;
    const auto with_corners = [&](const Point& from, const Point& to, const Point& apex,
                                  bool has_tip) {
      RingOfPoints ring = {apex, from};
      ring.push_back(place(middle + distance(), distance()));
      if (has_tip) {
        ring.push_back(tip);
        ring.push_back(place(middle + distance(), distance()));
      }
      ring.push_back(to);
      return ring;
    };
    const CellSet cells = CellSet::polygons(cells_of_rings(
        {with_corners(west, east, north, has_spike), with_corners(east, west, south, has_slit)}));
    const std::string name = "trial " + std::to_string(trial);
    EXPECT_TRUE(overlapping_cells(cells.rings()).empty()) << name;
    for (const auto& [cell, apex] : {std::pair(Index{0}, north), std::pair(Index{1}, south)}) {
      LongRing triangle = {long_vector(cell == 0 ? west : east),
                           long_vector(cell == 0 ? east : west), long_vector(apex)};
      EXPECT_NEAR(cells.areas()[cell], static_cast<double>(area_of(triangle)), 1e-14) << name;
    }
    expect_nothing_lost(cells, cover, 1e-13, name);
  }
}

// With wider gaps, overlaps and crossings either these are found or nothing is lost that is wider.
TEST(overlay_touching, corners_on_sides_to_more_than_rounding) {
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 60, 4));
  Random random(32);
  std::size_t num_refused = 0;
  for (std::size_t trial = 0; trial < 200; ++trial) {
    const double start = random.unit() * 2 * std::numbers::pi;
    const auto place = [&](double longitude, double height) {
      return above_equator(start + longitude, height, trial);
    };
    const auto near = [&](double longitude) {
      const double size = std::pow(10.0, -16 + 4 * random.unit());
      return place(longitude + size * random.signed_unit(), size * random.signed_unit());
    };
    const double middle = 0.1 + 0.2 * random.unit();
    const Point tip = place(middle, -0.05 * random.unit());
    const Point west = place(0, 0);
    const Point east = place(0.4, 0);
    const CellRings rings =
        cells_of_rings({{place(0.2, 0.3), west, near(middle), tip, near(middle), east},
                        {place(0.2, -0.3), east, near(middle), near(0.05), west}});
    try {
      const CellSet cells = CellSet::polygons(rings);
      expect_nothing_lost(cells, cover, 1e-11, "trial " + std::to_string(trial));
    } catch (const InvalidInput& error) {
      EXPECT_FALSE(overlapping_cells(rings).empty()) << trial << ' ' << error.what();
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 20U);
  EXPECT_LT(num_refused, 180U);
}

// A convex ring cut into two by an arc between two of its sides; corners of the cut are none of what is beyond.
std::array<RingOfPoints, 2> halves_of(const RingOfPoints& ring, Random& random) {
  const std::size_t n = ring.size();
  const std::size_t first = random.below(n);
  const std::size_t second = (first + 1 + random.below(n - 1)) % n;
  const auto place_on = [&](std::size_t side) {
    const double part = 0.3 + 0.4 * random.unit();
    return normalized((1 - part) * ring[side] + part * ring[(side + 1) % n]);
  };
  const std::array<Point, 2> ends = {place_on(first), place_on(second)};
  std::array<RingOfPoints, 2> halves = {RingOfPoints{ends[0]}, RingOfPoints{ends[1]}};
  for (std::size_t k = first; k != second; k = (k + 1) % n) halves[0].push_back(ring[(k + 1) % n]);
  halves[0].push_back(ends[1]);
  for (std::size_t k = second; k != first; k = (k + 1) % n) halves[1].push_back(ring[(k + 1) % n]);
  halves[1].push_back(ends[0]);
  return halves;
}

// Cells as countries of two files, each with its own corners along borders that they share; and what is joined of them.
TEST(overlay_touching, cell_sets_with_corners_of_one_cell_on_sides_of_others) {
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 60, 4));
  Random random(33);
  for (std::size_t trial = 0; trial < 350; ++trial) {
    std::vector<RingOfPoints> rings = {{above_equator(0.1, 0.1, trial),
                                        above_equator(1.2, -0.1, trial),
                                        above_equator(0.5, 0.7, trial)}};
    const double total = static_cast<double>(area_of(
        LongRing{long_vector(rings[0][0]), long_vector(rings[0][1]), long_vector(rings[0][2])}));
    for (std::size_t k = 0; k < 24; ++k) {
      const std::size_t chosen = random.below(rings.size());
      auto [left, right] = halves_of(rings[chosen], random);
      rings[chosen] = std::move(left);
      rings.push_back(std::move(right));
    }
    const std::string name = "trial " + std::to_string(trial);
    const CellRings cells = cells_of_rings(rings);
    EXPECT_TRUE(overlapping_cells(cells).empty()) << name;
    const CellSet cell_set = CellSet::polygons(cells);
    EXPECT_NEAR(std::accumulate(cell_set.areas().begin(), cell_set.areas().end(), 0.0), total,
                1e-13)
        << name;
    expect_nothing_lost(cell_set, cover, 1e-12, name);
    const CellRings joined = dissolve(cells, random_groups(rings.size(), 4, trial + 1), 4);
    const CellSet groups = CellSet::polygons(joined);
    EXPECT_TRUE(overlapping_cells(joined).empty()) << name;
    EXPECT_NEAR(std::accumulate(groups.areas().begin(), groups.areas().end(), 0.0), total, 1e-13)
        << name;
    expect_nothing_lost(groups, cover, 1e-12, name + " joined");
    // Each laid over the other one.
    const Remap both = remap(cell_set, groups);
    for (std::size_t i = 0; i < groups.num_cells(); ++i) {
      EXPECT_NEAR(both.target_fractions[i] * groups.areas()[i], groups.areas()[i], 1e-12) << name;
    }
  }
}

// A star around a center, counterclockwise.
RingOfPoints random_star(const Point& center, std::size_t n, Random& random) {
  const Point axis = std::abs(center.z) < 0.6 ? Point{0, 0, 1} : Point{1, 0, 0};
  const Point east = normalized(cross(axis, center));
  const Point north = cross(center, east);
  RingOfPoints ring;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.8 * random.unit()) /
                         static_cast<double>(n);
    const double radius = 0.1 * (0.3 + 0.7 * random.unit());
    ring.push_back(
        normalized(center + radius * std::cos(angle) * east + radius * std::sin(angle) * north));
  }
  return ring;
}

// What all of the stars have in common: the sum over one triangle with its center of each.
long double common_area(const std::vector<RingOfPoints>& stars, const std::vector<Point>& centers,
                        std::size_t next, const LongRing& left) {
  if (left.size() < 3) return 0;
  if (next == stars.size()) return area_of(left);
  long double sum = 0;
  for (std::size_t k = 0; k < stars[next].size(); ++k) {
    const std::array<LongVector, 3> triangle = {
        long_vector(centers[next]), long_vector(stars[next][k]),
        long_vector(stars[next][(k + 1) % stars[next].size()])};
    LongRing part = left;
    for (std::size_t i = 0; i < 3 && part.size() > 2; ++i) {
      part = clipped(part, triangle[i], triangle[(i + 1) % 3]);
    }
    sum += common_area(stars, centers, next + 1, part);
  }
  return sum;
}

// By inclusion and exclusion.
double area_of_union(const std::vector<RingOfPoints>& stars, const std::vector<Point>& centers) {
  long double sum = 0;
  for (std::size_t some = 1; some < std::size_t{1} << stars.size(); ++some) {
    std::vector<RingOfPoints> chosen;
    std::vector<Point> of_chosen;
    for (std::size_t k = 0; k < stars.size(); ++k) {
      if ((some >> k & 1) == 0) continue;
      chosen.push_back(stars[k]);
      of_chosen.push_back(centers[k]);
    }
    long double common = 0;
    for (std::size_t k = 0; k < chosen[0].size(); ++k) {
      common += common_area(chosen, of_chosen, 1,
                            {long_vector(of_chosen[0]), long_vector(chosen[0][k]),
                             long_vector(chosen[0][(k + 1) % chosen[0].size()])});
    }
    sum += chosen.size() % 2 == 1 ? common : -common;
  }
  return static_cast<double>(sum);
}

// Where sides of two stars cross, if any do, as good as rounding lets it be.
std::vector<Point> crossings_of(const RingOfPoints& first, const RingOfPoints& second) {
  std::vector<Point> found;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Point& a = first[i];
    const Point& b = first[(i + 1) % first.size()];
    for (std::size_t k = 0; k < second.size(); ++k) {
      const Point& p = second[k];
      const Point& q = second[(k + 1) % second.size()];
      const Point n = cross(a, b - a);
      const Point m = cross(p, q - p);
      if (dot(n, p) * dot(n, q) >= 0 || dot(m, a) * dot(m, b) >= 0) continue;
      const Point place = normalized(cross(n, m));
      found.push_back(dot(place, a) > 0 ? place : -1.0 * place);
    }
  }
  return found;
}

// The third one has a corner where sides of the first two cross.
TEST(overlay_touching, unions_of_stars) {
  const CellSet cover = CellSet::voronoi(triangulation_of("uniform", 40, 5));
  Random random(77);
  for (std::size_t trial = 0; trial < 250; ++trial) {
    const Point center = random_star({1, 0, 0}, 3, random)[trial % 3];
    std::vector<Point> centers;
    std::vector<RingOfPoints> stars;
    for (std::size_t k = 0; k < 4; ++k) {
      centers.push_back(random_star(center, 3, random)[k % 3]);
      stars.push_back(random_star(centers.back(), 7, random));
    }
    const std::vector<Point> crossings = crossings_of(stars[0], stars[1]);
    if (!crossings.empty()) {
      const Point& corner = crossings[random.below(crossings.size())];
      RingOfPoints& star = stars[2];
      // Its place by angle around the center.
      for (std::size_t k = 0; k < star.size(); ++k) {
        const Point& before = star[k];
        const Point& after = star[(k + 1) % star.size()];
        if (dot(centers[2], cross(before, corner)) > 0 &&
            dot(centers[2], cross(corner, after)) > 0) {
          star.insert(star.begin() + static_cast<std::ptrdiff_t>(k) + 1, corner);
          break;
        }
      }
    }
    const std::string name = "trial " + std::to_string(trial);
    const double expected = area_of_union(stars, centers);
    const CellSet regions = CellSet::polygons(cells_of_rings(stars));
    EXPECT_NEAR(sum_of(areas(clip(cover, regions))), expected, 1e-12) << name;
    const Remap first = remap(cover, regions, {.overlap = CellOverlap::first});
    EXPECT_NEAR(sum_of(first.areas), expected, 1e-12) << name;
    const Remap shared = remap(cover, regions, {.overlap = CellOverlap::share});
    EXPECT_NEAR(sum_of(shared.areas), expected, 1e-12) << name;
    // The union, and what is beyond it, are cells as any others.
    const CellRings inside = dissolve(clip(cover, regions), std::vector<Index>(40, 0), 1);
    const CellSet whole = CellSet::polygons(inside);
    EXPECT_NEAR(whole.areas()[0], expected, 1e-12) << name;
    expect_nothing_lost(whole, cover, 1e-12, name);
  }
}

}  // namespace
}  // namespace rondel::test
