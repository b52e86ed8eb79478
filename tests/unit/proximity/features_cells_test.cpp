// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of lines and polygons, against the distances of random places from all arcs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>

#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/query.h"
#include "rondel/regions.h"

namespace rondel::test {
namespace {

constexpr double pi = std::numbers::pi;
using Vector = Point;

double inner(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector outer(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double norm(const Vector& a) { return std::sqrt(inner(a, a)); }
double angle(const Vector& a, const Vector& b) {
  return std::atan2(norm(outer(a, b)), inner(a, b));
}

// From a place to the shorter arc between a and b, by the foot on its great circle.
double distance_to_arc(const Point& q, const Point& a, const Point& b) {
  const double ends = std::min(angle(q, a), angle(q, b));
  const Vector normal = outer(a, b);
  const double length = norm(normal);
  if (length == 0) return ends;
  const double height = inner(q, normal) / length;
  const Vector foot = {q.x - height * normal.x / length, q.y - height * normal.y / length,
                       q.z - height * normal.z / length};
  const bool is_between = inner(outer(a, foot), normal) >= 0 && inner(outer(foot, b), normal) >= 0;
  return is_between ? std::asin(std::min(1.0, std::abs(height))) : ends;
}

double distance_to_feature(const Point& q, const FeatureLines& lines, std::size_t feature) {
  double least = std::numeric_limits<double>::infinity();
  for (auto l = lines.offsets[feature]; l < lines.offsets[feature + 1]; ++l) {
    const auto first = lines.rows.offsets[l];
    const auto last = lines.rows.offsets[l + 1] - 1;
    if (first == last) least = std::min(least, angle(q, lines.rows.values[first]));
    for (auto k = first; k < last; ++k) {
      least = std::min(least, distance_to_arc(q, lines.rows.values[k], lines.rows.values[k + 1]));
    }
  }
  return least;
}

class RandomPlaces {
 public:
  explicit RandomPlaces(unsigned seed) : engine_(seed) {}
  Point next() {
    const Vector v = {normal_(engine_), normal_(engine_), normal_(engine_)};
    const double length = norm(v);
    return {v.x / length, v.y / length, v.z / length};
  }
  Point near(const Point& p, double step) {
    const Point q = next();
    const Vector v = {p.x + step * q.x, p.y + step * q.y, p.z + step * q.z};
    const double length = norm(v);
    return {v.x / length, v.y / length, v.z / length};
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<> normal_;
};

// Random walks, some of them points, some that start where another one does.
FeatureLines random_lines(unsigned seed, int count, int length, double step) {
  RandomPlaces random(seed);
  FeatureLines lines;
  Point start = random.next();
  for (int f = 0; f < count; ++f) {
    if (f % 3 != 2) start = random.next();
    Point at = start;
    const int steps = f % 5 == 4 ? 0 : length;
    for (int k = 0; k <= steps; ++k) {
      lines.rows.values.push_back(at);
      at = random.near(at, step);
    }
    lines.rows.end_row();
    lines.end_group();
  }
  return lines;
}

// How much farther the feature of the nearest site is than the nearest one, at most.
double largest_excess(const FeatureLines& lines, const FeatureSites& found, int num_places) {
  const Locator locator(delaunay(found.sites));
  RandomPlaces random(77);
  double largest = 0;
  for (int i = 0; i < num_places; ++i) {
    // Half of them where lines are near.
    const Point& site = found.sites[static_cast<std::size_t>(i) * 7919 % found.sites.size()];
    const Point q = i % 2 == 0 ? random.next() : random.near(site, 0.02);
    const std::size_t given = found.features[locator.nearest(q)];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < lines.size(); ++f) {
      least = std::min(least, distance_to_feature(q, lines, f));
    }
    largest = std::max(largest, distance_to_feature(q, lines, given) - least);
  }
  return largest;
}

TEST(feature_sites, of_an_arc_are_not_too_many) {
  FeatureLines lines;
  for (const Point& end : {Point{0, 1, 0}, Point{0, 0, 1}}) {
    lines.rows.append(std::vector<Point>{{1, 0, 0}, end});
    lines.end_group();
  }
  EXPECT_LT(feature_sites(lines, 2e-6).sites.size(), 5'000U);
  try {
    (void)feature_sites(lines, 1.4e-6);
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), 0U);
    EXPECT_STREQ(error.what(),
                 "with the tolerance of 1.4e-06 radians an arc of feature 0 could have more than "
                 "524288 sites");
  }
}

TEST(feature_sites, no_feature_is_farther_than_the_nearest_by_more_than_the_tolerance) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const FeatureLines lines = random_lines(seed, 40, 6, 0.15);
    std::size_t before = 0;
    for (const double tolerance : {0.02, 0.004, 0.0005}) {
      const FeatureSites found = feature_sites(lines, tolerance);
      EXPECT_LE(largest_excess(lines, found, 3'000), tolerance * (1 + 1e-9));
      EXPECT_GT(found.sites.size(), before);
      before = found.sites.size();
      EXPECT_TRUE(std::ranges::is_sorted(found.features));
    }
    // What the corners alone would do.
    const FeatureSites corners = feature_sites(lines, 10);
    EXPECT_EQ(corners.sites.size(), lines.rows.values.size());
    EXPECT_GT(largest_excess(lines, corners, 3'000), 0.004);
  }
}

// A long border of many points, of which no neighbor is another feature's, and islands far away.
TEST(feature_sites, nearest_features_are_found_behind_many_points_of_ones_own) {
  FeatureLines lines;
  for (int k = 0; k <= 600; ++k) {
    const double a = 2 * pi * k / 600;
    lines.rows.values.push_back({std::cos(a), std::sin(a), 0});
  }
  lines.rows.end_row();
  lines.offsets.push_back(1);
  for (const double height : {1.0, -1.0}) {
    lines.rows.values.push_back({0, 0, height});
    lines.rows.end_row();
    lines.end_group();
  }
  const FeatureSites found = feature_sites(lines, 1e-4);
  EXPECT_LE(largest_excess(lines, found, 2'000), 1e-4);
  EXPECT_EQ(found.sites.size(), lines.rows.values.size());  // half a degree is close enough
}

// The island is the first site, and no point of the border has it among its nearest sites.
TEST(feature_sites, are_close_where_an_island_is_behind_points_of_ones_own) {
  FeatureLines lines;
  lines.rows.values.push_back(unit_vector({0.3, 5}));
  lines.rows.offsets.push_back(1);
  lines.offsets.push_back(1);
  for (int k = 0; k <= 600; ++k) lines.rows.values.push_back(unit_vector({0.6 * k - 180, 0}));
  lines.rows.end_row();
  lines.offsets.push_back(2);
  const FeatureSites found = feature_sites(lines, 1e-4);
  EXPECT_GT(found.sites.size(), lines.rows.values.size() + 10);
  EXPECT_LE(largest_excess(lines, found, 2'000), 1e-4);
}

TEST(feature_sites, are_far_apart_where_nothing_is_near) {
  FeatureLines lines;
  lines.rows.values = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // a quarter of the equator, and the pole
  lines.rows.offsets = {0, 2, 3};
  lines.offsets = {0, 1, 2};
  const double tolerance = 1e-4;
  const FeatureSites found = feature_sites(lines, tolerance);
  const double spacing = 2 * std::sqrt(tolerance * pi / 2);
  const double fewest = pi / 2 / spacing;
  EXPECT_GE(found.sites.size(), fewest);
  EXPECT_LE(found.sites.size(), 4 * fewest);
  EXPECT_LE(largest_excess(lines, found, 2'000), tolerance);
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(feature_cells, cover_the_sphere) {
  const FeatureLines lines = random_lines(5, 30, 5, 0.2);
  const CellRings cells = feature_cells(lines, {}, 0.01);
  EXPECT_EQ(cells.num_cells(), 30U);
  EXPECT_NEAR(sum(areas(cells)), 4 * pi, 1e-11);
}

// A square of so many degrees around a place of the equator, with corners on great circles.
void add_square(CellRings& cells, double lon_deg, double half_deg) {
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    cells.corners.push_back(static_cast<Index>(cells.points.size()));
    cells.points.push_back(unit_vector({lon_deg + x * half_deg, y * half_deg}));
  }
  cells.rings.push_back(cells.corners.size());
  cells.cells.push_back(cells.rings.size() - 1);
}

// How often the rings of a cell go around a place, less how often around the one opposite of it.
int turns_around(const Point& q, const CellRings& cells, std::size_t cell) {
  double sum = 0;
  for (auto r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    for (auto k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
      const auto next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
      const Vector a = outer(q, cells.points[cells.corners[k]]);
      const Vector b = outer(q, cells.points[cells.corners[next]]);
      sum += std::atan2(inner(q, outer(a, b)), inner(a, b));
    }
  }
  return static_cast<int>(std::lround(sum / (2 * pi)));
}

bool is_in_square(const Point& q, const CellRings& squares, std::size_t square) {
  for (std::size_t k = 0; k < 4; ++k) {
    const Point& a = squares.points[4 * square + k];
    const Point& b = squares.points[4 * square + (k + 1) % 4];
    if (inner(q, outer(a, b)) <= 0) return false;
  }
  return true;
}

TEST(feature_cells, have_their_polygons_exactly) {
  CellRings squares;
  add_square(squares, -20, 10);
  add_square(squares, 0, 10);  // shares a side with the first
  add_square(squares, 90, 30);
  FeatureLines none;
  none.offsets = {0, 0, 0, 0};
  const CellRings cells = feature_cells(none, squares, 0.005);
  EXPECT_NEAR(sum(areas(cells)), 4 * pi, 1e-11);
  RandomPlaces random(3);
  int num_tested = 0;
  for (int t = 0; t < 4'000; ++t) {
    const Point q = random.next();
    for (std::size_t square = 0; square < 3; ++square) {
      if (!is_in_square(q, squares, square)) continue;
      // Opposite of the first two is the cell of the third, opposite of this that of the first.
      const std::size_t opposite = square == 2 ? 0 : 2;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(turns_around(q, cells, c), c == square ? 1 : c == opposite ? -1 : 0);
      }
      ++num_tested;
    }
  }
  EXPECT_GT(num_tested, 300);
}

// Whole, and one that is all of a region; that of one feature is all of the regions.
TEST(feature_cells, may_be_clipped) {
  CellRings squares;
  add_square(squares, -20, 10);
  add_square(squares, 0, 10);
  add_square(squares, 90, 30);
  CellRings around;
  add_square(around, 0, 40);
  add_square(around, 90, 5);
  const CellSet regions = CellSet::polygons(around);
  FeatureLines lines;
  lines.rows.values = {unit_vector({35, 20})};
  lines.rows.offsets = {0, 1};
  lines.offsets = {0, 0, 0, 0, 1};
  squares.cells.push_back(squares.cells.back());  // the fourth is the point
  const CellRings whole = feature_cells(lines, squares, 0.005);
  const std::vector<double> found = areas(clipped_feature_cells(lines, squares, 0.005, regions));
  EXPECT_NEAR(sum(found), sum(areas(around)), 1e-13);
  EXPECT_GT(found[3], 0.01);
  const RegionPieces pieces = intersection(CellSet::polygons(whole), regions);
  const std::vector<double> of_pieces = areas(pieces.rings);
  std::vector<double> expected(4);
  for (std::size_t k = 0; k < of_pieces.size(); ++k) expected[pieces.cells[k]] += of_pieces[k];
  for (std::size_t f = 0; f < 4; ++f) EXPECT_NEAR(found[f], expected[f], 1e-13) << f;
  const RegionPieces parts = feature_pieces(lines, squares, 0.005, regions);
  EXPECT_EQ(parts.cells, pieces.cells);
  EXPECT_EQ(parts.regions, pieces.regions);
  const std::vector<double> of_parts = areas(parts.rings);
  for (std::size_t k = 0; k < of_parts.size(); ++k) EXPECT_NEAR(of_parts[k], of_pieces[k], 1e-13);

  FeatureLines none;
  none.offsets = {0, 0};
  CellRings one;
  add_square(one, 0, 10);
  EXPECT_NEAR(areas(clipped_feature_cells(none, one, 0.01, regions))[0], sum(found), 1e-13);
  lines.offsets = {0, 1};
  EXPECT_NEAR(areas(clipped_feature_cells(lines, {}, 0.01, regions))[0], sum(found), 1e-13);
}

TEST(feature_cells, of_polygons_that_overlap_are_refused) {
  FeatureLines none;
  none.offsets = {0, 0, 0};
  for (const double lon : {5.0, 0.0}) {  // they cross, or one lies in the other
    CellRings squares;
    add_square(squares, 0, 10);
    add_square(squares, lon, lon == 0 ? 5 : 10);
    try {
      (void)feature_cells(none, squares, 0.01);
      ADD_FAILURE();
    } catch (const InvalidInput& error) {
      const std::string expected = "polygon 0 overlaps polygon 1 at ";
      EXPECT_EQ(std::string(error.what()).substr(0, expected.size()), expected);
    }
  }
}

TEST(crossing_cells, are_those_whose_sides_cross) {
  CellRings squares;
  add_square(squares, 0, 10);
  add_square(squares, 20, 10);   // shares a side with the first
  add_square(squares, 35, 10);   // overlaps with the second
  add_square(squares, 0, 5);     // lies in the first
  add_square(squares, 180, 20);  // has no other within, but goes around the antimeridian
  add_square(squares, 215, 30);  // overlaps with that
  const std::vector<CrossingCells> found = crossing_cells(squares);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(std::pair(found[0].first, found[0].second), std::pair(Index{1}, Index{2}));
  EXPECT_EQ(std::pair(found[1].first, found[1].second), std::pair(Index{4}, Index{5}));
  for (const CrossingCells& pair : found) EXPECT_NEAR(norm(pair.place), 1, 1e-15);
  const double lon = std::atan2(found[0].place.y, found[0].place.x) * 180 / pi;
  EXPECT_TRUE(lon >= 25 && lon <= 30) << lon;
}

TEST(crossing_cells, may_cross_themselves) {
  CellRings bow;
  for (const auto& [lon, lat] : {std::pair{0, 0}, {10, 10}, {10, 0}, {0, 10}}) {
    bow.corners.push_back(static_cast<Index>(bow.points.size()));
    bow.points.push_back(unit_vector({double(lon), double(lat)}));
  }
  bow.rings.push_back(4);
  bow.cells.push_back(1);
  const std::vector<CrossingCells> found = crossing_cells(bow);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, found[0].second);
  EXPECT_NEAR(std::atan2(found[0].place.y, found[0].place.x) * 180 / pi, 5, 1e-9);
  bow.corners[0] = 7;
  EXPECT_THROW(crossing_cells(bow), InvalidInput);
}

// Long sides leave the boxes of their ends; the oracle looks at all pairs of sides.
TEST(crossing_cells, are_those_of_all_pairs_of_sides) {
  RandomPlaces random(8);
  CellRings cells;
  for (int c = 0; c < 60; ++c) {
    const Point middle = random.next();
    for (int k = 0; k < 3; ++k) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()));
      cells.points.push_back(random.near(middle, c % 3 == 0 ? 2 : 0.4));
    }
    cells.rings.push_back(cells.corners.size());
    cells.cells.push_back(cells.rings.size() - 1);
  }
  const auto are_apart = [](const Point& a, const Point& b, const Point& p, const Point& q) {
    const Vector normal = outer(a, b);
    return inner(normal, p) * inner(normal, q) < 0;
  };
  std::vector<std::pair<Index, Index>> expected;
  for (std::size_t s = 0; s < cells.points.size(); ++s) {
    for (std::size_t t = s + 1; t < cells.points.size(); ++t) {
      if (s / 3 == t / 3) continue;  // sides of one triangle meet in its corners
      const auto next = [](std::size_t k) { return k % 3 == 2 ? k - 2 : k + 1; };
      const Point& a = cells.points[s];
      const Point& b = cells.points[next(s)];
      const Point& p = cells.points[t];
      const Point& q = cells.points[next(t)];
      if (!are_apart(a, b, p, q) || !are_apart(p, q, a, b)) continue;
      const Point place = outer(outer(a, b), outer(p, q));
      const Point sum_s = {a.x + b.x, a.y + b.y, a.z + b.z};
      const Point sum_t = {p.x + q.x, p.y + q.y, p.z + q.z};
      const bool is_in_both = inner(place, sum_s) * inner(place, sum_t) > 0;
      if (is_in_both) expected.emplace_back(s / 3, t / 3);
    }
  }
  std::ranges::sort(expected);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  std::vector<std::pair<Index, Index>> found;
  for (const CrossingCells& pair : crossing_cells(cells))
    found.emplace_back(pair.first, pair.second);
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 100U);
}

// Sides of a millionth of a millimeter of the Earth.
TEST(crossing_cells, of_tiny_cells_cross_within_them) {
  constexpr double size = 1e-13;
  const Point middle = unit_vector({40, 50});
  CellRings cells;
  RandomPlaces random(9);
  for (int c = 0; c < 12; ++c) {
    for (int k = 0; k < 3; ++k) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()));
      cells.points.push_back(random.near(middle, size));
    }
    cells.rings.push_back(cells.corners.size());
    cells.cells.push_back(cells.rings.size() - 1);
  }
  const std::vector<CrossingCells> found = crossing_cells(cells);
  EXPECT_GT(found.size(), 10U);
  for (const CrossingCells& pair : found) EXPECT_LE(angle(pair.place, middle), 3 * size);
}

TEST(crossing_cells, refuse_arrays_that_do_not_fit) {
  CellRings good;
  add_square(good, 0, 10);
  add_square(good, 40, 10);
  EXPECT_TRUE(crossing_cells(good).empty());
  using Offsets = std::vector<std::uint64_t>;
  for (const Offsets& offsets : {Offsets{}, {1, 1, 2}, {0, 1, 1}, {0, 1, 3}, {0, 3, 2}}) {
    CellRings bad = good;
    bad.cells = offsets;
    EXPECT_THROW(crossing_cells(bad), InvalidInput);
  }
  for (const Offsets& offsets : {Offsets{}, {1, 4, 8}, {0, 4, 7}, {0, 4, 9}, {0, 9, 8}}) {
    CellRings bad = good;
    bad.rings = offsets;
    EXPECT_THROW(crossing_cells(bad), InvalidInput);
  }
}

TEST(crossing_cells, of_a_diagram_are_none) {
  std::vector<Point> sites;
  RandomPlaces random(6);
  for (int i = 0; i < 2'000; ++i) sites.push_back(random.next());
  EXPECT_TRUE(crossing_cells(CellSet::voronoi(delaunay(sites)).rings()).empty());
}

TEST(feature_cells, of_one_feature_have_no_border) {
  FeatureLines one;
  one.rows.values = {{1, 0, 0}, {0, 1, 0}};
  one.rows.offsets = {0, 2};
  one.offsets = {0, 1};
  EXPECT_EQ(feature_cells(one, {}, 1e-3).cells, (std::vector<std::uint64_t>{0, 0}));
  EXPECT_EQ(feature_cells({}, {}, 1e-3).num_cells(), 0U);
}

TEST(feature_sites, what_is_wrong_is_refused) {
  FeatureLines lines;
  lines.rows.values = {{1, 0, 0}, {-1, 0, 0}};
  lines.rows.offsets = {0, 2};
  lines.offsets = {0, 1};
  EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);  // antipodes
  lines.rows.values[1] = {0, 2, 0};
  EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  lines.rows.values[1] = {0, 1, 0};
  EXPECT_THROW(feature_sites(lines, 0), InvalidInput);
  EXPECT_THROW(feature_sites(lines, std::nan("")), InvalidInput);
  lines.rows.offsets = {0, 3};
  EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  lines.rows.offsets = {0, 2};
  lines.offsets = {0, 2};
  EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  using Offsets = std::vector<std::uint64_t>;
  for (const Offsets& offsets : {Offsets{}, {1, 1}, {0, 0}, {0, 2, 1}}) {
    lines.offsets = offsets;
    EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  }
  lines.offsets = {0, 1};
  for (const Offsets& offsets : {Offsets{}, {1, 2}, {0, 1}}) {
    lines.rows.offsets = offsets;
    EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  }
  lines.offsets = {0, 2};
  lines.rows.offsets = {0, 3, 2};
  EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  lines.rows.offsets = {0, 2};
  lines.offsets = {0, 1};
  for (const double excess : {-0.9e-9, 0.9e-9}) {
    lines.rows.values[1] = {0, std::sqrt(1 + excess), 0};
    EXPECT_NO_THROW(feature_sites(lines, 1e-3));
    lines.rows.values[1] = {0, std::sqrt(1 + 1.2 * excess), 0};
    EXPECT_THROW(feature_sites(lines, 1e-3), InvalidInput);
  }
  lines.rows.values[1] = {0, 1, 0};
  CellRings squares;
  add_square(squares, 0, 1);
  lines.offsets = {0, 1, 1};
  EXPECT_THROW(feature_cells(lines, squares, 1e-3), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
