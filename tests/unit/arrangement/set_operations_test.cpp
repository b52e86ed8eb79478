// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of combine(), overlay_pieces() and repaired(), on random and hostile polygons. Which
// places a polygon has is counted anew for each place, along an arc to a place outside.
#include "rondel/set_operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "exact/vector.h"
#include "rondel/arrangement.h"
#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/names.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/arrangement/set_rule.h"

namespace rondel::test::of_set_operations {
namespace {

using Ring = std::vector<Point>;

constexpr std::array<SetOperation, 4> operations = {SetOperation::unite, SetOperation::intersection,
                                                    SetOperation::difference,
                                                    SetOperation::symmetric_difference};

void append(const Ring& ring, CellRings& cells) {
  std::vector<Index> corners;
  for (const Point& p : ring) {
    corners.push_back(static_cast<Index>(cells.points.size()));
    cells.points.push_back(p);
  }
  cells.append_ring(corners);
}

CellRings cells_of(const std::vector<Ring>& rings) {
  CellRings cells;
  for (const Ring& ring : rings) {
    append(ring, cells);
    cells.end_cell();
  }
  return cells;
}

bool is_equal(const CellRings& a, const CellRings& b) {
  return a.cells == b.cells && a.rings == b.rings && a.corners == b.corners &&
         a.points == b.points && a.whole == b.whole;
}

bool cross_inside(const Point& a, const Point& b, const Point& p, const Point& q) {
  const Sign first = orientation(a, b, p);
  return first != Sign::zero && orientation(a, b, q) == -first && orientation(p, q, a) == -first &&
         orientation(p, q, b) == first;
}

// True if a cell has a place; `outside` is a place that it does not have.
bool has(const CellRings& cells, std::size_t cell, const Point& place, const Point& outside) {
  bool is_inside = cells.is_whole(cell);
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    const auto ring = cells.corners_of(r);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      is_inside ^= cross_inside(place, outside, cells.points[ring[k]],
                                cells.points[ring[(k + 1) % ring.size()]]);
    }
  }
  return is_inside;
}

bool any_has(const CellRings& cells, const Point& place, const Point& outside) {
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    if (has(cells, c, place, outside)) return true;
  }
  return false;
}

// Checks promise 1: rings are simple, do not cross, and the region is to their left.
void expect_valid(const CellRings& cells) {
  std::vector<std::array<Index, 2>> sides;
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    const auto ring = cells.corners_of(r);
    ASSERT_GE(ring.size(), 3U);
    ASSERT_EQ(std::set<Index>(ring.begin(), ring.end()).size(), ring.size());
    ASSERT_EQ(*std::ranges::min_element(ring), ring[0]);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      sides.push_back({ring[k], ring[(k + 1) % ring.size()]});
    }
  }
  // Sides that do not cross are the edges of their arrangement.
  const Arrangement arranged = arrange(cells.points, sides, {1});
  ASSERT_EQ(arranged.nodes.size(), cells.points.size());
  for (std::size_t i = 0; i < sides.size(); ++i) ASSERT_EQ(arranged.chains[i].size(), 1U);
}

class Polygons {
 public:
  explicit Polygons(std::uint64_t seed) : random_(seed), center_(place()) {
    size_ = std::pow(10, -1.0 * static_cast<double>(seed % 8));
  }

  double number() { return std::uniform_real_distribution<>(-1, 1)(random_); }
  Point vector() { return {number(), number(), number()}; }
  Point place() { return normalized(vector()); }
  Point near(const Point& p, double distance) { return normalized(p + distance * vector()); }
  // Returns a place among the polygons.
  Point place_inside() { return near(center_, 1.5 * size_); }
  [[nodiscard]] Point outside() const { return -1.0 * center_; }

  // A ring around a place near the center, with corners at any distances.
  Ring star() {
    const Point middle = near(center_, size_);
    const Point right = normalized(cross(middle, Point{1, 2, 3}));
    const Point up = cross(middle, right);
    Ring ring;
    const int count = 3 + static_cast<int>(random_() % 8);
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      ring.push_back(normalized(middle + 0.5 * size_ * (1 + 0.5 * number()) *
                                             (std::cos(angle) * right + std::sin(angle) * up)));
    }
    return ring;
  }
  // Counterclockwise squares of a lattice, whose sides overlap and meet in corners.
  Ring box() {
    const Point right = normalized(cross(center_, Point{1, 2, 3}));
    const Point up = cross(center_, right);
    const auto integer = [&] { return static_cast<int>(random_() % 5) - 2; };
    const int x = integer();
    const int y = integer();
    const int width = 1 + static_cast<int>(random_() % 2);
    const int height = 1 + static_cast<int>(random_() % 2);
    const auto corner = [&](int i, int k) {
      return normalized(center_ + 0.3 * size_ * ((x + i) * right + (y + k) * up));
    };
    return {corner(0, 0), corner(width, 0), corner(width, height), corner(0, height)};
  }
  // A ring whose sides cross.
  CellRings crossed() {
    Ring ring = star();
    std::shuffle(ring.begin(), ring.end(), random_);
    return test::of_set_operations::cells_of({ring});
  }
  CellRings some(bool are_boxes) {
    std::vector<Ring> rings(1 + random_() % 4);
    for (Ring& ring : rings) ring = are_boxes ? box() : star();
    return test::of_set_operations::cells_of(rings);
  }

 private:
  std::mt19937_64 random_;
  Point center_;
  double size_ = 1;
};

double area_of(const CellRings& cells) {
  const std::vector<double> all = areas(cells);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

TEST(combine, has_the_places_that_the_operation_says) {
  const std::size_t count = scaled(400);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    const bool are_boxes = seed / 8 % 2 == 0;
    const CellRings a = make.some(are_boxes);
    const CellRings b = make.some(are_boxes);
    for (const SetOperation operation : operations) {
      const CellRings result = combine(a, b, operation, {1});
      ASSERT_NO_FATAL_FAILURE(expect_valid(result));
      for (int k = 0; k < 10; ++k) {
        const Point p = make.place_inside();
        ASSERT_EQ(
            has(result, 0, p, make.outside()),
            result_of(operation, any_has(a, p, make.outside()), any_has(b, p, make.outside())));
      }
      ASSERT_TRUE(is_equal(CellSet::valid_polygons(result, {2}).given_rings(),
                           CellSet::polygons(result, {1}).given_rings()));
      // Promise 3, and that a result is itself.
      ASSERT_TRUE(is_equal(unite(result, {2}), result));
      if (operation == SetOperation::difference) continue;
      ASSERT_TRUE(is_equal(combine(b, a, operation, {2}), result));
    }
    const double either = area_of(combine(a, b, SetOperation::unite));
    const double both = area_of(combine(a, b, SetOperation::intersection));
    const double first = area_of(combine(a, b, SetOperation::difference));
    ASSERT_NEAR(either + both, area_of(unite(a)) + area_of(unite(b)), 1e-13);
    ASSERT_NEAR(first + both, area_of(unite(a)), 1e-13);
  }
}

TEST(combine, can_be_chained) {
  const std::size_t count = scaled(100);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    CellRings region = make.some(seed % 3 == 0);
    bool is_in = false;
    const Point p = make.place_inside();
    is_in = any_has(region, p, make.outside());
    for (int step = 0; step < 8; ++step) {
      const CellRings other = make.some(seed % 3 == 0);
      const SetOperation operation = operations[(seed + 3 * static_cast<std::size_t>(step)) % 4];
      region = combine(region, other, operation, {1});
      is_in = result_of(operation, is_in, any_has(other, p, make.outside()));
      ASSERT_NO_FATAL_FAILURE(expect_valid(region));
      ASSERT_EQ(has(region, 0, p, make.outside()), is_in);
    }
  }
}

// What a polygon means whose rings contradict each other does not depend on others.
TEST(combine, takes_polygons_as_they_are_alone) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Polygons polygons(seed);
    const CellRings first = polygons.crossed();
    const CellRings second = polygons.crossed();
    for (const SetOperation operation : operations) {
      ASSERT_TRUE(is_equal(combine(first, second, operation, {1}),
                           combine(repaired(first, {1}), repaired(second, {1}), operation, {1})))
          << seed;
    }
  }
}

TEST(overlay_pieces, divide_the_polygons) {
  const std::size_t count = scaled(200);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    const CellRings a = make.some(seed % 2 == 0);
    const CellRings b = make.some(seed % 2 == 0);
    for (const SetOperation operation : {SetOperation::unite, SetOperation::intersection,
                                         SetOperation::difference, SetOperation::identity}) {
      const RegionPieces pieces = overlay_pieces(a, b, operation, {1});
      for (int k = 0; k < 10; ++k) {
        const Point p = make.place_inside();
        std::set<std::array<Index, 2>> found;
        for (std::size_t i = 0; i < pieces.num_pieces(); ++i) {
          if (has(pieces.rings, i, p, make.outside())) {
            found.insert({pieces.cells[i], pieces.regions[i]});
          }
        }
        std::vector<Index> of_a;
        std::vector<Index> of_b;
        for (Index i = 0; i < a.num_cells(); ++i) {
          if (has(a, i, p, make.outside())) of_a.push_back(i);
        }
        for (Index i = 0; i < b.num_cells(); ++i) {
          if (has(b, i, p, make.outside())) of_b.push_back(i);
        }
        std::set<std::array<Index, 2>> expected;
        const bool is_both = !of_a.empty() && !of_b.empty();
        if (is_both ? operation != SetOperation::difference
                    : (!of_a.empty() ? operation != SetOperation::intersection
                                     : operation == SetOperation::unite)) {
          if (of_a.empty() && !of_b.empty()) of_a.push_back(no_index);
          if (of_b.empty() && !of_a.empty()) of_b.push_back(no_index);
          for (const Index i : of_a) {
            for (const Index j : of_b) expected.insert({i, j});
          }
        }
        ASSERT_EQ(found, expected);
      }
    }
  }
}

using Pairs = std::vector<std::array<Index, 2>>;

// All pairs of cells, twice.
Pairs all_pairs(const CellRings& a, const CellRings& b) {
  Pairs pairs;
  for (int times = 0; times < 2; ++times) {
    for (Index i = 0; i < a.num_cells(); ++i) {
      for (Index k = 0; k < b.num_cells(); ++k) pairs.push_back({i, k});
    }
  }
  return pairs;
}

TEST(combine_pairs, has_the_places_of_each_pair) {
  const std::size_t count = scaled(200);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    const bool are_boxes = seed / 8 % 2 == 0;
    const CellRings a = make.some(are_boxes);
    const CellRings b = make.some(are_boxes);
    const Pairs pairs = all_pairs(a, b);
    for (const SetOperation operation : operations) {
      const CellRings result = combine_pairs(a, b, pairs, operation, {1});
      ASSERT_EQ(result.num_cells(), pairs.size());
      ASSERT_TRUE(is_equal(combine_pairs(a, b, pairs, operation, {2}), result));
      ASSERT_TRUE(is_equal(repaired(result, {1}), result));
      for (int k = 0; k < 10; ++k) {
        const Point p = make.place_inside();
        for (std::size_t i = 0; i < pairs.size(); ++i) {
          ASSERT_EQ(has(result, i, p, make.outside()),
                    result_of(operation, has(a, pairs[i][0], p, make.outside()),
                              has(b, pairs[i][1], p, make.outside())));
        }
      }
    }
  }
}

// Returns the rings of a cell as points.
std::vector<Ring> rings_of(const CellRings& cells, std::size_t cell) {
  std::vector<Ring> rings;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    Ring& ring = rings.emplace_back();
    for (const Index p : cells.corners_of(r)) ring.push_back(cells.points[p]);
  }
  return rings;
}

TEST(combine_pairs, has_the_corners_of_combine) {
  const std::size_t count = scaled(50);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    const CellRings a = make.some(seed % 2 == 0);
    const CellRings b = make.some(seed % 2 == 0);
    const Pairs pairs = all_pairs(a, b);
    for (const SetOperation operation : operations) {
      const CellRings result = combine_pairs(a, b, pairs, operation, {1});
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        CellRings first;
        first.points = a.points;
        first.append_cell(a, pairs[i][0]);
        CellRings second;
        second.points = b.points;
        second.append_cell(b, pairs[i][1]);
        ASSERT_EQ(rings_of(result, i), rings_of(combine(first, second, operation, {1}), 0));
      }
    }
  }
}

// The corners of a square around the end of an axis.
Ring square(const Point& middle, double size) {
  const Point right = normalized(cross(Point{1, 2, 3}, middle));
  const Point up = cross(middle, right);
  const auto corner = [&](double x, double y) {
    return normalized(middle + size * (x * right + y * up));
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

TEST(combine, knows_the_whole_sphere_and_nothing) {
  const CellRings a = cells_of({square({0, 0, 1}, 0.3)});
  CellRings rest;
  append(reversed(square({0, 0, 1}, 0.3)), rest);
  rest.end_cell();
  const CellRings all = combine(a, rest, SetOperation::unite);
  EXPECT_EQ(all.whole, (std::vector<Index>{0}));
  EXPECT_EQ(all.rings.size(), 1U);
  const CellRings none = combine(a, rest, SetOperation::intersection);
  EXPECT_TRUE(none.whole.empty());
  EXPECT_EQ(none.num_cells(), 1U);
  EXPECT_EQ(none.rings.size(), 1U);
  EXPECT_TRUE(is_equal(combine(all, a, SetOperation::intersection), unite(a)));
  EXPECT_TRUE(is_equal(combine(all, a, SetOperation::difference), unite(rest)));
  EXPECT_TRUE(is_equal(combine(none, a, SetOperation::unite), unite(a)));
  EXPECT_TRUE(is_equal(combine(all, none, SetOperation::intersection), none));
  EXPECT_TRUE(is_equal(combine(all, none, SetOperation::difference), all));
  EXPECT_TRUE(is_equal(combine(all, all, SetOperation::symmetric_difference), none));
}

// Rings around a place with many corners, which run in and out.
Ring star(const Point& middle, double size, std::size_t num_corners) {
  const Point right = normalized(cross(Point{1, 2, 3}, middle));
  const Point up = cross(middle, right);
  Ring ring;
  for (std::size_t k = 0; k < num_corners; ++k) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(num_corners);
    const double radius = k % 2 == 0 ? size : 0.9 * size;
    ring.push_back(normalized(middle + radius * (std::cos(angle) * right + std::sin(angle) * up)));
  }
  return ring;
}

// Small polygons in, around and across the borders of polygons with many corners and a hole: those
// far from a border need no arrangement, which must not show.
TEST(combine_pairs, has_the_corners_of_combine_where_one_polygon_is_large) {
  const Point middle = normalized(Point{0.3, -0.5, 0.8});
  CellRings large = cells_of({star(middle, 0.6, 200)});
  append(reversed(star(middle, 0.2, 100)), large);
  large.cells.back() = large.rings.size() - 1;      // the hole of the first one
  append(reversed(star(middle, 0.5, 150)), large);  // more than half of the sphere
  large.end_cell();
  CellRings small;
  for (int i = -8; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k) {
      const Point place = normalized(middle + Point{0.11 * i, 0.11 * k, 0.03 * (i - k)});
      append(square(place, 0.02 + 0.01 * (k % 3 == 0)), small);
      if (i % 3 == 0) append(reversed(square(place, 0.01)), small);  // with a hole
      if (k == 5) append(square(-1.0 * place, 0.01), small);         // with another part
      small.end_cell();
    }
  }
  append(reversed(square(-1.0 * middle, 0.1)), small);  // nearly the sphere
  small.end_cell();
  for (const SetOperation operation : operations) {
    for (const bool is_large_first : {false, true}) {
      const CellRings& a = is_large_first ? large : small;
      const CellRings& b = is_large_first ? small : large;
      const Pairs pairs = all_pairs(a, b);
      const CellRings result = combine_pairs(a, b, pairs, operation, {1});
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        CellRings first;
        first.points = a.points;
        first.append_cell(a, pairs[i][0]);
        CellRings second;
        second.points = b.points;
        second.append_cell(b, pairs[i][1]);
        ASSERT_EQ(rings_of(result, i), rings_of(combine(first, second, operation, {1}), 0)) << i;
      }
    }
  }
}

TEST(combine_pairs, knows_the_whole_sphere_and_nothing) {
  CellRings cells = cells_of({square({0, 0, 1}, 0.3)});
  append(reversed(square({0, 0, 1}, 0.3)), cells);  // with points of its own
  cells.end_cell();
  cells.whole = {2};
  cells.end_cell();
  cells.end_cell();  // empty
  const auto [cap, rest, all, none] = std::array<Index, 4>{0, 1, 2, 3};
  const Pairs pairs = {{cap, rest}, {all, cap}, {none, cap}, {all, all}, {none, none}, {cap, cap}};
  const auto wholes = [&](SetOperation operation) {
    return combine_pairs(cells, cells, pairs, operation).whole;
  };
  const auto nums_of_rings = [&](SetOperation operation) {
    const CellRings result = combine_pairs(cells, cells, pairs, operation);
    std::vector<std::uint64_t> nums;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      nums.push_back(result.cells[k + 1] - result.cells[k]);
    }
    return nums;
  };
  using Nums = std::vector<std::uint64_t>;
  using Cells = std::vector<Index>;
  EXPECT_EQ(wholes(SetOperation::unite), (Cells{0, 1, 3}));
  EXPECT_EQ(nums_of_rings(SetOperation::unite), (Nums{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(wholes(SetOperation::intersection), (Cells{3}));
  EXPECT_EQ(nums_of_rings(SetOperation::intersection), (Nums{0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(wholes(SetOperation::difference), Cells{});
  EXPECT_EQ(nums_of_rings(SetOperation::difference), (Nums{1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(wholes(SetOperation::symmetric_difference), (Cells{0}));
  EXPECT_EQ(nums_of_rings(SetOperation::symmetric_difference), (Nums{0, 1, 1, 0, 0, 0}));
  EXPECT_EQ(combine_pairs(cells, cells, {}, SetOperation::unite).num_cells(), 0U);
}

TEST(combine_pairs, names_the_first_pair_that_it_refuses) {
  CellRings cells;
  for (int k = 0; k < 100; ++k) {
    const bool is_good = k < 60;
    append(is_good ? square({0, 0, 1}, 0.3) : Ring{{1, 0, 0}, {0, 2, 0}, {0, 0, 1}}, cells);
    cells.end_cell();
  }
  Pairs pairs;
  for (Index k = 0; k < 100; ++k) pairs.push_back({0, k});
  for (const unsigned threads : {1U, 2U}) {
    const auto unite_pairs = [&] {
      return combine_pairs(cells, cells, pairs, SetOperation::unite, {threads});
    };
    EXPECT_EQ(thrown_index(unite_pairs), 60U);
    EXPECT_EQ(thrown_index([&] { return repaired(cells, {threads}); }), 60U);
  }
  pairs[3] = {100, 0};
  EXPECT_EQ(thrown_index([&] { return combine_pairs(cells, cells, pairs, operations[0]); }), 3U);
  pairs[3] = {0, 100};
  EXPECT_EQ(thrown_index([&] { return combine_pairs(cells, cells, pairs, operations[0]); }), 3U);
  cells.rings.pop_back();
  EXPECT_EQ(thrown_index([&] { return combine_pairs(cells, cells, {}, operations[0]); }),
            InvalidInput::no_index);
}

TEST(unite, keeps_polygons_that_lie_apart_and_in_each_other) {
  // At opposite ends of the sphere, and a ring in the hole of another one.
  const Point opposite = {0, 0, -1};
  CellRings cells = cells_of({square({0, 0, 1}, 0.3), square(opposite, 0.1)});
  append(square({1, 0, 0}, 0.4), cells);
  append(reversed(square({1, 0, 0}, 0.3)), cells);
  cells.end_cell();
  append(square({1, 0, 0}, 0.2), cells);
  cells.end_cell();
  const CellRings result = unite(cells);
  EXPECT_EQ(result.rings.size() - 1, 5U);
  EXPECT_NEAR(area_of(result), area_of(cells), 1e-14);
}

TEST(unite, of_opposite_corners_finds_a_path) {
  const Point p = normalized(Point{1, 2, 3});
  const Ring one = {p, normalized(Point{1, 2.1, 3}), normalized(Point{0.9, 2, 3})};
  Ring other;
  for (const Point& q : one) other.push_back(-1.0 * q);
  const CellRings cells = cells_of({one, reversed(other)});
  EXPECT_EQ(unite(cells).rings.size() - 1, 2U);
}

TEST(repaired, reads_rings_even_odd) {
  const double s = 0.1;
  const auto at = [&](double x, double y) { return normalized(Point{1, s * x, s * y}); };
  // A bow tie; a square that is led around twice; a keyhole; a ring that repeats itself.
  const std::vector<Ring> rings = {
      {at(0, 0), at(2, 2), at(2, 0), at(0, 2)},
      {at(0, 0), at(1, 0), at(1, 1), at(0, 1), at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
      {at(0, 0), at(1, 0), at(1, 1), at(3, 1), at(1, 1), at(0, 1)},
      {at(0, 0), at(1, 0), at(1, 1), at(1, 1), at(0, 1)}};
  const CellRings result = repaired(cells_of(rings));
  ASSERT_EQ(result.num_cells(), 4U);
  EXPECT_EQ(result.cells, (std::vector<std::uint64_t>{0, 2, 2, 3, 4}));
  const auto places = [&](std::size_t cell, double x, double y) {
    return has(result, cell, at(x, y), {-1, 0, 0});
  };
  EXPECT_TRUE(places(0, 0.2, 1));
  EXPECT_TRUE(places(0, 1.8, 1));
  EXPECT_FALSE(places(0, 1, 0.2));
  EXPECT_TRUE(places(2, 0.4, 0.5));
  EXPECT_FALSE(places(2, 2, 1.1));
  EXPECT_EQ(result.corners_of(3).size(), 4U);
  // Where rings contradict each other, what is opposite to the polygon is outside.
  EXPECT_LT(areas(result)[0], 0.1);
}

TEST(repaired, cuts_rings_where_they_meet_themselves) {
  const double s = 0.1;
  const auto at = [&](double x, double y) { return normalized(Point{1, s * x, s * y}); };
  // A hole that touches the border in a corner, drawn as one ring.
  const CellRings cells =
      cells_of({{at(0, 0), at(4, 0), at(4, 4), at(0, 4), at(0, 0), at(1, 3), at(2, 2), at(3, 1)}});
  const CellRings result = repaired(cells);
  EXPECT_EQ(result.rings.size() - 1, 2U);
  EXPECT_NO_FATAL_FAILURE(expect_valid(result));
}

TEST(combine, refuses_what_is_no_polygon) {
  CellRings cells = cells_of({square({0, 0, 1}, 0.3)});
  cells.corners[1] = 99;
  EXPECT_EQ(thrown_index([&] { return unite(cells); }), InvalidInput::no_index);
  cells = cells_of({{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}});
  EXPECT_EQ(thrown_index([&] { return unite(cells); }), 2U);
  cells = cells_of({{{1, 0, 0}, {0, 2, 0}, {0, 0, 1}}});
  EXPECT_EQ(thrown_index([&] { return unite(cells); }), 1U);
}

TEST(combine, ends_when_it_is_told_to_stop) {
  const CellRings cells = cells_of({square({0, 0, 1}, 0.3)});
  const std::atomic<bool> stop = true;
  const Execution execution{.threads = 1, .stop = &stop};
  EXPECT_THROW(unite(cells, execution), Interrupted);
  EXPECT_THROW(repaired(cells, execution), Interrupted);
  EXPECT_THROW(combine_pairs(cells, cells, Pairs{{0, 0}}, SetOperation::unite, execution),
               Interrupted);
}

TEST(set_operation, has_names_of_its_own) {
  for (const auto name : names_of<SetOperation>()) {
    EXPECT_EQ(name_of(*from_name<SetOperation>(name)), name);
  }
  EXPECT_EQ(names_of<SetOperation>().size(), 5U);
}

}  // namespace
}  // namespace rondel::test::of_set_operations
