// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of simplified(). Whether arcs cross or touch is decided for all pairs by exact
// rationals, distances by dense places in long double, and how rings lie by counting crossings.
#include "rondel/simplify.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "rondel/rondel.h"
#include "rondel/set_operations.h"
#include "support/thrown.h"

namespace rondel::test::of_simplification {
namespace {

using Line = std::vector<Point>;
using Long = exact::Vector3<long double>;
using Side = std::array<Point, 2>;
using Rational = mpq_class;

constexpr double pi = std::numbers::pi;

Long to_long(const Point& p) { return {p.x, p.y, p.z}; }
long double length(const Long& v) { return std::sqrt(exact::dot(v, v)); }
long double angle(const Long& a, const Long& b) {
  return 2 * std::atan2(length(a - b), length(a + b));
}

// The distance of a place from the shorter arc between two others.
long double distance_to_side(const Long& p, const Side& side) {
  const Long a = to_long(side[0]);
  const Long b = to_long(side[1]);
  const Long normal = exact::cross(a, b - a);
  const long double ends = std::min(angle(p, a), angle(p, b));
  const bool is_beside =
      exact::dot(exact::cross(normal, a), p) > 0 && exact::dot(exact::cross(b, normal), p) > 0;
  if (!is_beside) return ends;
  return std::min(ends, std::asin(std::min(
                            1.0L, std::abs(exact::dot(normal, p)) / (length(normal) * length(p)))));
}

// Features by their lines and rings.
struct Shapes {
  std::vector<Line> lines;
  std::vector<std::vector<Line>> cells;  // rings of each cell
};

FeatureLines lines_of(const Shapes& shapes) {
  FeatureLines lines;
  for (const Line& line : shapes.lines) {
    lines.rows.append(line);
    lines.end_group();
  }
  return lines;
}

CellRings cells_of(const Shapes& shapes) {
  CellRings cells;
  for (const std::vector<Line>& rings : shapes.cells) {
    for (const Line& ring : rings) {
      for (const Point& p : ring) {
        cells.corners.push_back(static_cast<Index>(cells.points.size()));
        cells.points.push_back(p);
      }
      cells.end_ring();
    }
    cells.end_cell();
  }
  return cells;
}

Shapes shapes_of(const SimplifiedFeatures& features) {
  Shapes shapes;
  for (std::size_t i = 0; i < features.lines.rows.size(); ++i) {
    const auto line = features.lines.rows[i];
    shapes.lines.emplace_back(line.begin(), line.end());
  }
  const CellRings& cells = features.polygons;
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    std::vector<Line>& rings = shapes.cells.emplace_back();
    for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
      Line& ring = rings.emplace_back();
      for (const Index p : cells.corners_of(r)) ring.push_back(cells.points[p]);
    }
  }
  return shapes;
}

Shapes simplified_shapes(const Shapes& shapes, const SimplifyOptions& options,
                         unsigned threads = 1) {
  return shapes_of(simplified(lines_of(shapes), cells_of(shapes), options, {threads}));
}

bool is_less(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}
struct Less {
  bool operator()(const Point& p, const Point& q) const { return is_less(p, q); }
  bool operator()(const Side& s, const Side& t) const {
    return s[0] == t[0] ? is_less(s[1], t[1]) : is_less(s[0], t[0]);
  }
};

// All sides, each once, the lesser end first.
std::vector<Side> sides_of(const Shapes& shapes) {
  std::set<Side, Less> sides;
  const auto add = [&](const Line& line, bool is_closed) {
    for (std::size_t k = is_closed ? 0 : 1; k < line.size(); ++k) {
      const Point& from = line[k == 0 ? line.size() - 1 : k - 1];
      if (from == line[k]) continue;
      sides.insert(is_less(from, line[k]) ? Side{from, line[k]} : Side{line[k], from});
    }
  };
  for (const Line& line : shapes.lines) add(line, false);
  for (const auto& rings : shapes.cells) {
    for (const Line& ring : rings) add(ring, true);
  }
  return {sides.begin(), sides.end()};
}

// The sign of the determinant of three points.
int turn(const Point& a, const Point& b, const Point& c) {
  const Rational ax(a.x), ay(a.y), az(a.z), bx(b.x), by(b.y), bz(b.z), cx(c.x), cy(c.y), cz(c.z);
  const Rational value =
      ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  return sgn(value);
}

// True if a point on the great circle of a side is in its inside.
bool is_inside(const Side& side, const Point& p) {
  const auto cosine_of_normals = [](const Point& a, const Point& b, const Point& c,
                                    const Point& d) {
    const auto product = [](const Point& u, const Point& v) -> Rational {
      return Rational(u.x) * Rational(v.x) + Rational(u.y) * Rational(v.y) +
             Rational(u.z) * Rational(v.z);
    };
    return sgn(Rational(product(a, c) * product(b, d) - product(a, d) * product(b, c)));
  };
  return cosine_of_normals(side[0], p, side[0], side[1]) > 0 &&
         cosine_of_normals(p, side[1], side[0], side[1]) > 0;
}

enum class Meeting { none, touch, crossing };

// How two different sides meet, but for common ends.
Meeting meeting(const Side& s, const Side& t) {
  const std::array<int, 4> turns = {turn(s[0], s[1], t[0]), turn(s[0], s[1], t[1]),
                                    turn(t[0], t[1], s[0]), turn(t[0], t[1], s[1])};
  if (turns[0] * turns[1] < 0 && turns[2] * turns[3] < 0 && turns[0] * turns[2] < 0) {
    return Meeting::crossing;
  }
  const auto touches = [](const Side& side, const Point& p, int sign) {
    return sign == 0 && p != side[0] && p != side[1] && is_inside(side, p);
  };
  const bool is_touch = touches(s, t[0], turns[0]) || touches(s, t[1], turns[1]) ||
                        touches(t, s[0], turns[2]) || touches(t, s[1], turns[3]);
  return is_touch ? Meeting::touch : Meeting::none;
}

std::size_t num_meetings(const std::vector<Side>& sides, Meeting wanted) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t k = i + 1; k < sides.size(); ++k) {
      count += meeting(sides[i], sides[k]) == wanted ? 1 : 0;
    }
  }
  return count;
}

// Expects that each place of a line is near to one of the sides that replace it, both ways. `left`
// is a part of `line`, in order, with the same ends.
void expect_chains_near(const Line& line, const Line& left, double tolerance) {
  std::size_t at = 0;
  for (std::size_t k = 1; k < left.size(); ++k) {
    const Side side = {left[k - 1], left[k]};
    std::vector<Side> chain;
    while (line[at] != left[k] || chain.empty()) {
      ASSERT_LT(at + 1, line.size());
      chain.push_back({line[at], line[at + 1]});
      ++at;
      if (line[at] == left[k]) break;
    }
    const auto places = [](const Side& s, const auto& visit) {
      for (int i = 0; i <= 16; ++i) {
        const long double part = i / 16.0L;
        const Long from = to_long(s[0]);
        const Long step = to_long(s[1]) - from;
        visit(Long{from.x + part * step.x, from.y + part * step.y, from.z + part * step.z});
      }
    };
    for (const Side& old : chain) {
      places(old, [&](const Long& p) { ASSERT_LE(distance_to_side(p, side), tolerance + 1e-17L); });
    }
    places(side, [&](const Long& p) {
      long double nearest = 4;
      for (const Side& old : chain) nearest = std::min(nearest, distance_to_side(p, old));
      ASSERT_LE(nearest, tolerance + 1e-17L);
    });
  }
}

// A ring that begins and ends with a corner of another one that is left.
Line from_corner(const Line& ring, const Point& corner) {
  Line line = ring;
  std::rotate(line.begin(), std::ranges::find(line, corner), line.end());
  line.push_back(corner);
  return line;
}

void expect_near(const Shapes& given, const Shapes& left, double tolerance) {
  ASSERT_EQ(given.lines.size(), left.lines.size());
  for (std::size_t i = 0; i < given.lines.size(); ++i) {
    ASSERT_EQ(given.lines[i].front(), left.lines[i].front());
    ASSERT_EQ(given.lines[i].back(), left.lines[i].back());
    expect_chains_near(given.lines[i], left.lines[i], tolerance);
  }
  ASSERT_EQ(given.cells.size(), left.cells.size());
  for (std::size_t i = 0; i < given.cells.size(); ++i) {
    ASSERT_EQ(given.cells[i].size(), left.cells[i].size());
    for (std::size_t r = 0; r < given.cells[i].size(); ++r) {
      const Line& ring = left.cells[i][r];
      ASSERT_GE(ring.size(), 3U);
      expect_chains_near(from_corner(given.cells[i][r], ring[0]), from_corner(ring, ring[0]),
                         tolerance);
    }
  }
}

// True if an odd number of sides of a cell is crossed on the way.
bool is_apart(const std::vector<Line>& rings, const Point& place, const Point& other) {
  bool result = false;
  for (const Line& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Side side = {ring[k], ring[(k + 1) % ring.size()]};
      result ^= meeting({place, other}, side) == Meeting::crossing;
    }
  }
  return result;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double number(double low = -1, double high = 1) {
    return std::uniform_real_distribution<>(low, high)(engine_);
  }
  Point direction() {
    while (true) {
      const Point p = {number(), number(), number()};
      if (norm(p) > 0.1 && norm(p) < 1) return normalized(p);
    }
  }
  std::size_t below(std::size_t count) { return engine_() % count; }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

// A coverage of wiggly polygons: the sphere, or a part of it around a place, is divided by random
// great circles, whose pieces get corners beside them where nothing is crossed.
Shapes coverage(Random& random, std::size_t num_cuts, double size) {
  const Point middle = random.direction();
  CellRings cap;
  const Point east = normalized(cross(middle, random.direction()));
  const Point north = cross(middle, east);
  constexpr int num_corners = 40;
  for (int k = 0; k < num_corners; ++k) {
    const double turned = 2 * pi * k / num_corners;
    const double radius = size * (1 + 0.2 * random.number());
    cap.corners.push_back(static_cast<Index>(k));
    cap.points.push_back(
        normalized(std::cos(radius) * middle +
                   std::sin(radius) * (std::cos(turned) * east + std::sin(turned) * north)));
  }
  cap.end_ring();
  cap.end_cell();
  CellRings parts = cap;
  for (std::size_t cut = 0; cut < num_cuts; ++cut) {
    // A narrow or wide band of wiggles.
    CellRings band;
    const double turned = random.number(0, 2 * pi);
    const Point along = std::cos(turned) * east + std::sin(turned) * north;
    const Point across = cross(middle, along);
    const double shift = random.number() * size;
    constexpr int steps = 24;
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k <= steps; ++k) {
        const double x = (side == 0 ? 1 : -1) * (2.0 * k / steps - 1) * 1.5 * size;
        const double y = shift + (side == 0 ? -0.3 : 0.3) * size + 0.1 * size * random.number();
        band.corners.push_back(static_cast<Index>(band.points.size()));
        band.points.push_back(normalized(middle + x * along + y * across));
      }
    }
    band.end_ring();
    band.end_cell();
    const RegionPieces pieces = overlay_pieces(parts, band, SetOperation::identity);
    parts = pieces.rings;
  }
  SimplifiedFeatures all{{}, parts};
  return shapes_of(all);
}

void expect_simplified(const Shapes& given, double tolerance, Random& random) {
  const Shapes left = simplified_shapes(given, {.tolerance = tolerance});
  std::set<Point, Less> corners;
  for (const Side& side : sides_of(given)) corners.insert(side.begin(), side.end());
  const std::vector<Side> sides = sides_of(left);
  for (const Side& side : sides) {
    ASSERT_TRUE(corners.contains(side[0]) && corners.contains(side[1]));
  }
  ASSERT_EQ(num_meetings(sides, Meeting::crossing), 0U);
  ASSERT_EQ(num_meetings(sides, Meeting::touch), 0U);
  expect_near(given, left, tolerance);
  // Places farther from all new sides than the tolerance stay in their polygons.
  for (int i = 0; i < 60 && !given.cells.empty(); ++i) {
    const auto place = [&] {
      const Side& side = sides[random.below(sides.size())];
      return normalized(side[0] + 3 * tolerance * random.direction());
    };
    const Point p = place();
    const Point q = place();
    const bool is_far = std::ranges::all_of(sides, [&](const Side& side) {
      return distance_to_side(to_long(p), side) > tolerance &&
             distance_to_side(to_long(q), side) > tolerance;
    });
    if (!is_far) continue;
    for (std::size_t cell = 0; cell < given.cells.size(); ++cell) {
      ASSERT_EQ(is_apart(given.cells[cell], p, q), is_apart(left.cells[cell], p, q));
    }
  }
}

TEST(simplify, coverages_stay_coverages_within_the_tolerance) {
  Random random(1);
  for (std::size_t run = 0; run < 24; ++run) {
    const double size = std::array{1e-6, 0.01, 0.4, 1.2}[run % 4];
    const Shapes given = coverage(random, 1 + random.below(3), size);
    ASSERT_EQ(num_meetings(sides_of(given), Meeting::crossing), 0U);
    for (const double share : {0.003, 0.05, 0.3, 3.0}) {
      SCOPED_TRACE(std::to_string(run) + ' ' + std::to_string(share));
      expect_simplified(given, share * size, random);
    }
  }
}

// Random corners of a small grid, joined where nothing is crossed or touched: narrow places,
// corners in line, and arcs that pass other corners by an ulp.
Shapes grid_lines(Random& random, double step, double wiggle) {
  const Point at = random.direction();
  const Point east = normalized(cross(at, random.direction()));
  const Point north = cross(at, east);
  const auto corner = [&] {
    const auto x = static_cast<double>(random.below(7));
    const auto y = static_cast<double>(random.below(7));
    return normalized(at + (step * x + wiggle * random.number()) * east +
                      (step * y + wiggle * random.number()) * north);
  };
  Shapes shapes;
  std::vector<Side> sides;
  const auto fits = [&](const Side& side) {
    return side[0] != side[1] && std::ranges::all_of(sides, [&](const Side& other) {
             const bool is_same = side == other || side == Side{other[1], other[0]};
             return !is_same && meeting(side, other) == Meeting::none;
           });
  };
  for (int i = 0; i < 6; ++i) {
    Line line = {corner()};
    for (int k = 0; k < 60; ++k) {
      const Side side = {line.back(), corner()};
      if (!fits(side)) continue;
      // No place of a line may be in the inside of a side.
      sides.push_back(side);
      line.push_back(side[1]);
    }
    if (line.size() > 1) shapes.lines.push_back(line);
  }
  return shapes;
}

TEST(simplify, lines_on_grids_do_not_meet_anew) {
  Random random(2);
  for (std::size_t run = 0; run < 150; ++run) {
    const double step = std::array{1e-3, 0.05, 1e-7}[run % 3];
    const Shapes given = grid_lines(random, step, run % 2 == 0 ? 0 : 1e-16);
    for (const double share : {0.3, 0.9, 10.0}) {
      SCOPED_TRACE(std::to_string(run) + ' ' + std::to_string(share));
      const Shapes left = simplified_shapes(given, {.tolerance = share * step});
      ASSERT_EQ(num_meetings(sides_of(left), Meeting::crossing), 0U);
      ASSERT_EQ(num_meetings(sides_of(left), Meeting::touch), 0U);
      for (std::size_t i = 0; i < given.lines.size(); ++i) {
        ASSERT_EQ(given.lines[i].front(), left.lines[i].front());
        ASSERT_LE(left.lines[i].size(), given.lines[i].size());
      }
    }
  }
}

// Returns a ring that begins with its least point, wherever it began.
Line turned(Line ring) {
  if (!ring.empty()) {
    std::rotate(ring.begin(), std::ranges::min_element(ring, is_less), ring.end());
  }
  return ring;
}

TEST(simplify, the_result_does_not_depend_on_orders_and_threads) {
  Random random(3);
  for (std::size_t run = 0; run < 6; ++run) {
    const Shapes given = coverage(random, 3, 0.2);
    Shapes other = given;
    std::vector<std::size_t> order(given.cells.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::shuffle(order, random.engine());
    for (std::size_t i = 0; i < order.size(); ++i) {
      other.cells[i] = given.cells[order[i]];
      std::ranges::reverse(other.cells[i]);
      for (Line& ring : other.cells[i]) {
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2),
                    ring.end());
      }
    }
    const Shapes left = simplified_shapes(given, {.tolerance = 0.01});
    const Shapes left_of_other = simplified_shapes(other, {.tolerance = 0.01}, 4);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto& rings = left.cells[order[i]];
      ASSERT_EQ(rings.size(), left_of_other.cells[i].size());
      for (std::size_t r = 0; r < rings.size(); ++r) {
        EXPECT_EQ(turned(rings[r]), turned(left_of_other.cells[i][rings.size() - 1 - r]));
      }
    }
  }
}

// Corners on a circle; with the circle to the left, or the same ones backwards.
Line circle(double lon_deg, double lat_deg, double radius, int count, bool is_left = true) {
  const Point at = unit_vector({lon_deg, lat_deg});
  const Point east = normalized(cross(Point{0.1, 0.2, 0.9}, at));
  const Point north = cross(at, east);
  Line ring;
  for (int k = 0; k < count; ++k) {
    const double angle_of_k = 2 * pi * k / count;
    const Point direction = std::cos(angle_of_k) * east + std::sin(angle_of_k) * north;
    ring.push_back(normalized(std::cos(radius) * at + std::sin(radius) * direction));
  }
  if (!is_left) std::ranges::reverse(ring);
  return ring;
}

TEST(simplify, small_rings_keep_three_corners_or_vanish) {
  Shapes given;
  given.cells = {{circle(180, 90, 0.2, 100), circle(0, 89, 0.004, 50, false)},
                 {circle(0, 89, 0.004, 50)},
                 {circle(0, 89, 0.001, 12, false)},  // all but a small disk
                 {circle(50, 0, 0.004, 50)}};
  for (const double tolerance : {0.0005, 0.005}) {
    const Shapes left = simplified_shapes(given, {.tolerance = tolerance});
    expect_near(given, left, tolerance);
  }
  const CellRings left = simplified(cells_of(given), {.tolerance = 0.02, .drop_small = true});
  EXPECT_EQ(left.cells, (std::vector<std::uint64_t>{0, 1, 1, 1, 1}));
  EXPECT_EQ(left.whole, std::vector<Index>{2});
  const double area = areas(left)[0];
  EXPECT_NEAR(area, 2 * pi * (1 - std::cos(0.2)), 0.02);
  // A point inside of a small ring keeps it.
  given.lines = {{unit_vector({50, 0})}};
  const auto kept =
      simplified(lines_of(given), cells_of(given), {.tolerance = 0.02, .drop_small = true})
          .polygons;
  EXPECT_EQ(kept.cells, (std::vector<std::uint64_t>{0, 1, 1, 1, 2}));
}

// What is outside of all rings is left: nothing of an island with a lake, and the whole sphere for the
// land around a lake with an island.
TEST(simplify, polygons_without_rings_are_nothing_or_everything) {
  const Line island = circle(10, 20, 0.004, 12);
  const Line lake = circle(10, 20, 0.002, 9, false);
  const Line island_in_lake = circle(10, 20, 0.001, 7);
  Shapes given;
  given.cells = {{island, lake},
                 {lake, island},
                 {island, lake, island_in_lake},
                 {circle(40, 20, 0.004, 12), circle(40, 20, 0.0039, 12, false),
                  circle(60, 20, 0.003, 8), circle(60, 20, 0.0029, 8, false)},
                 {circle(80, 20, 0.004, 12, false), circle(80, 20, 0.0039, 12)},
                 {circle(100, 20, 0.001, 5, false), circle(120, 20, 0.002, 5, false)}};
  for (const std::vector<Line>& cell : given.cells) {
    Shapes one;
    one.cells = {cell};
    const CellRings left = simplified(cells_of(one), {.tolerance = 0.02, .drop_small = true});
    EXPECT_EQ(left.rings.size(), 1U);
    EXPECT_EQ(left.is_whole(0), areas(cells_of(one))[0] > 6);
  }
}

// Shores that are rough, with places beside them.
Shapes rough_shores(Random& random) {
  Shapes shores;
  for (const double lat : {0.0, 0.4}) {
    Line line;
    for (int k = 0; k <= 300; ++k) {
      line.push_back(unit_vector({0.05 * k, lat + random.number(-0.15, 0.15)}));
    }
    shores.lines.push_back(line);
  }
  for (int k = 0; k < 40; ++k) {
    shores.lines.push_back({unit_vector({random.number(0, 15), random.number(-0.3, 0.7)})});
  }
  return shores;
}

// Returns how often a new arc is much nearer to a corner than it may be: nearer than the clearance,
// than given sides are, and than its own ends.
int num_too_near(const Shapes& given, const Shapes& left, double clearance) {
  const std::vector<Side> before = sides_of(given);
  int count = 0;
  for (const Side& side : sides_of(left)) {
    if (std::ranges::find(before, side) != before.end()) continue;
    for (const Line& line : left.lines) {
      for (const Point& corner : line) {
        const Long p = to_long(corner);
        if (corner == side[0] || corner == side[1]) continue;
        const long double distance = distance_to_side(p, side);
        const long double to_end = std::min(angle(p, to_long(side[0])), angle(p, to_long(side[1])));
        constexpr long double much = 4;
        if (distance >= clearance / much || distance >= to_end / much) continue;
        long double given_distance = 4;
        for (const Side& other : before) {
          if (other[0] == corner || other[1] == corner) continue;
          given_distance = std::min(given_distance, distance_to_side(p, other));
        }
        if (distance < given_distance / much) ++count;
      }
    }
  }
  return count;
}

TEST(simplify, arcs_keep_away_from_other_corners) {
  Random random(11);
  int num_without = 0;
  constexpr double tolerance = 0.004;  // 0.23 degrees
  for (int run = 0; run < 4; ++run) {
    const Shapes given = rough_shores(random);
    const auto left_with = [&](double clearance) {
      return simplified_shapes(given, {.tolerance = tolerance, .clearance = clearance});
    };
    for (const double clearance : {0.1, 0.5}) {
      EXPECT_EQ(num_too_near(given, left_with(clearance), clearance * tolerance), 0);
      num_without += num_too_near(given, left_with(0), clearance * tolerance);
    }
    EXPECT_LT(left_with(0.5).lines[0].size(), given.lines[0].size() / 3);
  }
  EXPECT_GT(num_without, 0);
}

// A thin ring does not keep the clearance between its own sides, and nothing keeps it from a ring that
// vanishes.
TEST(simplify, thin_rings_vanish_with_a_clearance) {
  constexpr double tolerance = 0.01;
  for (const int size : {5, 8, 40}) {
    for (const double height_deg : {0.5, 0.1, 1e-3}) {
      Shapes given;
      for (const double lat_deg : {0.0, 0.6}) {
        Line& ring = given.cells.emplace_back().emplace_back();
        for (int k = 0; k < size; ++k) {
          const double turn = 2 * pi * k / size;
          ring.push_back(
              unit_vector({4 * std::cos(turn), lat_deg + height_deg * std::sin(turn) / 2}));
        }
      }
      for (const double clearance : {0.0, 0.25, 1.0}) {
        const CellRings left = simplified(
            cells_of(given), {.tolerance = tolerance, .drop_small = true, .clearance = clearance});
        EXPECT_TRUE(left.corners.empty()) << size << " " << height_deg << " " << clearance;
      }
    }
  }
}

TEST(simplify, a_shared_border_is_simplified_once_and_a_boundary_may_stay) {
  Random random(4);
  const Shapes given = coverage(random, 3, 0.1);
  std::size_t num_sides = 0;
  for (const bool keeps : {false, true}) {
    const CellRings left = simplified(cells_of(given), {.tolerance = 0.01, .keep_boundary = keeps});
    const double area = areas(unite(left))[0];
    double sum = 0;
    for (const double part : areas(left)) sum += part;
    EXPECT_NEAR(sum, area, 1e-14);
    if (keeps) {
      EXPECT_NEAR(area, areas(unite(cells_of(given)))[0], 1e-14);
    }
    EXPECT_GT(left.corners.size(), num_sides);
    num_sides = left.corners.size();
  }
}

TEST(simplify, the_tolerance_may_vary) {
  Line line;
  for (int k = 0; k <= 400; ++k) {
    line.push_back(unit_vector({0.1 * k, k % 2 == 0 ? 0.0 : 0.2}));
  }
  Shapes given;
  given.lines = {line};
  const auto is_west = [](const Point& p) { return p.y < p.x * 0.36; };  // 20 degrees
  const Shapes left = simplified_shapes(
      given, {.tolerance_at = [&](const Point& p) { return is_west(p) ? 0.01 : 1e-4; }});
  const auto num_west = std::ranges::count_if(left.lines[0], is_west);
  EXPECT_LT(num_west, 12);
  EXPECT_EQ(std::ranges::count_if(line, is_west) - num_west,
            static_cast<std::ptrdiff_t>(line.size() - left.lines[0].size()));
}

TEST(simplify, ends_points_and_short_chains_stay) {
  const auto at = [](double lon, double lat) { return unit_vector({lon, lat}); };
  Shapes given;
  given.lines = {{at(0, 0), at(1, 0.1), at(2, 0)},   // two chains between two nodes,
                 {at(0, 0), at(1, -0.1), at(2, 0)},  // of which one becomes an arc
                 {at(5, 5)},                         // a point
                 {at(9, 9), at(9, 9)},               // a line without a length
                 {at(4, 0), at(5, 1), at(6, 0), at(5, -1), at(4, 0)},  // a closed line
                 {at(20, 0), at(21, 0), at(20, 0)}};                   // there and back
  const Shapes left = simplified_shapes(given, {.tolerance = 0.5});
  EXPECT_EQ(left.lines[0].size() + left.lines[1].size(), 5U);
  EXPECT_EQ(left.lines[2], given.lines[2]);
  EXPECT_EQ(left.lines[3], given.lines[2].size() == 1 ? Line{at(9, 9)} : Line{});
  EXPECT_EQ(left.lines[4].size(), 4U);
  EXPECT_EQ(left.lines[5], given.lines[5]);
  EXPECT_EQ(simplified_shapes(given, {.tolerance = 0}).lines[0], given.lines[0]);
  EXPECT_EQ(simplified({}, SimplifyOptions{.tolerance = 1}).num_cells(), 0U);
}

TEST(simplify, what_is_not_as_described_is_refused) {
  Shapes given;
  given.cells = {{circle(0, 0, 0.1, 5)}};
  CellRings cells = cells_of(given);
  for (const double tolerance :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)simplified(cells, {.tolerance = tolerance}), InvalidInput);
  }
  for (const double clearance : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)simplified(cells, {.clearance = clearance}), InvalidInput);
  }
  cells.points[3] = {1, 1, 1};
  EXPECT_EQ(thrown_index([&] { return simplified(cells, {}); }), 3U);
  cells.points[3] = {-cells.points[2].x, -cells.points[2].y, -cells.points[2].z};
  EXPECT_EQ(thrown_index([&] { return simplified(cells, {}); }), 2U);
  cells.rings.back() = 9;
  EXPECT_THROW((void)simplified(cells, {}), InvalidInput);
  given.lines = {{{1, 0, 0}}, {{0, 0, 2}}};
  EXPECT_EQ(thrown_index([&] { return simplified(lines_of(given), {}, {}); }), 1U);
}

}  // namespace
}  // namespace rondel::test::of_simplification
