// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of relate() and related_pairs(), on figures whose relations are known, and on random
// and hostile polygons, whose relations integers of any length tell (relation_oracle.h).
#include "rondel/relate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/names.h"
#include "rondel/set_operations.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/arrangement/relation_oracle.h"

namespace rondel::test::of_relations {
namespace {

using Ring = std::vector<Point>;

void add_ring(const Ring& ring, CellRings& cells) {
  std::vector<Index> corners;
  for (const Point& p : ring) {
    corners.push_back(static_cast<Index>(cells.points.size()));
    cells.points.push_back(p);
  }
  cells.append_ring(corners);
}

// A polygon with these rings.
CellRings polygon(const std::vector<Ring>& rings) {
  CellRings cells;
  for (const Ring& ring : rings) add_ring(ring, cells);
  cells.end_cell();
  return cells;
}

CellRings whole_sphere() {
  CellRings cells;
  cells.whole = {0};
  cells.end_cell();
  return cells;
}

CellRings complement(const CellRings& cells) {
  return combine(whole_sphere(), cells, SetOperation::difference, {1});
}

void add_cells(const CellRings& others, CellRings& cells) {
  const auto first = static_cast<Index>(cells.points.size());
  cells.points.insert(cells.points.end(), others.points.begin(), others.points.end());
  for (std::size_t c = 0; c < others.num_cells(); ++c) {
    if (others.is_whole(c)) cells.whole.push_back(static_cast<Index>(cells.num_cells()));
    for (std::uint64_t r = others.cells[c]; r < others.cells[c + 1]; ++r) {
      std::vector<Index> ring;
      for (const Index p : others.corners_of(r)) ring.push_back(first + p);
      cells.append_ring(ring);
    }
    cells.end_cell();
  }
}

std::string text_of(const CellRings& a, const CellRings& b) {
  return std::string(relate(a, b, {1})[0].text());
}

// Places of the plane x = 1 near the end of its axis. Those with equal y or with a coordinate 0 are
// on one great circle, exactly.
Point at(double y, double z) {
  const double size = 0.125;
  return normalized(Point{1, size * y, size * z});
}

CellRings box(double west, double south, double east, double north) {
  return polygon({{at(west, south), at(east, south), at(east, north), at(west, north)}});
}

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

TEST(relate, knows_how_two_boxes_can_lie) {
  const CellRings a = box(-1, -1, 1, 1);
  EXPECT_EQ(text_of(a, a), "2FFF1FFF2");
  EXPECT_EQ(text_of(a, box(3, -1, 4, 1)), "FF2FF1212");
  EXPECT_EQ(text_of(a, box(0, 0, 2, 2)), "212101212");
  EXPECT_EQ(text_of(a, box(-3, -2, 3, 2)), "2FF1FF212");
  EXPECT_EQ(text_of(box(-3, -2, 3, 2), a), "212FF1FF2");
  // Neighbors share a side, and corners.
  EXPECT_EQ(text_of(a, box(1, -1, 2, 1)), "FF2F11212");
  EXPECT_EQ(text_of(a, box(1, 1, 2, 2)), "FF2F01212");
  // A corner in the middle of the side through y = 1, z = 0.
  const CellRings wedge = polygon({{at(1, 0), at(3, -1), at(3, 1)}});
  EXPECT_EQ(text_of(polygon({{at(0, 0), at(2, 0), at(1, 1)}}), wedge), "212101212");
  EXPECT_EQ(text_of(polygon({{at(0, 0), at(1, -1), at(2, 0)}}),
                    polygon({{at(1, 0), at(1, 1), at(0, 1)}})),
            "FF2F01212");
  // Sides along z = 0, of which one is a part of the other.
  const CellRings below = polygon({{at(-2, 0), at(0, -1), at(2, 0)}});
  const CellRings above = polygon({{at(-1, 0), at(1, 0), at(0, 1)}});
  EXPECT_EQ(text_of(below, above), "FF2F11212");
  EXPECT_EQ(text_of(below, polygon({{at(-1, 0), at(0, -0.25), at(1, 0)}})), "212F11FF2");
  // Sides that cross, and others that overlap.
  const CellRings both = polygon({{at(-1, 0), at(-3, 0), at(-1, -1)}});
  EXPECT_EQ(text_of(below, both), "212111212");
}

TEST(relate, knows_holes_and_rings_that_touch) {
  const Ring outer = {at(-4, -4), at(4, -4), at(4, 4), at(-4, 4)};
  const Ring inner = {at(-2, -2), at(2, -2), at(2, 2), at(-2, 2)};
  const CellRings frame = polygon({outer, reversed(inner)});
  EXPECT_EQ(text_of(frame, box(-1, -1, 1, 1)), "FF2FF1212");
  EXPECT_EQ(text_of(frame, polygon({inner})), "FF2F112F2");
  EXPECT_EQ(text_of(frame, polygon({outer})), "2FF11F2F2");
  EXPECT_EQ(text_of(frame, box(-3, -3, 3, 3)), "2121F12F2");
  EXPECT_EQ(text_of(frame, box(-3.5, -3.5, -2.5, 3)), "212FF1FF2");
  EXPECT_EQ(text_of(frame, box(-5, -5, 5, 5)), "2FF1FF212");
  EXPECT_EQ(text_of(frame, frame), "2FFF1FFF2");
  // A box that fills the hole but for its corner; a part within the hole; two parts.
  EXPECT_EQ(text_of(frame, box(-2, -2, 1, 1)), "FF2F11212");
  const CellRings island = polygon({outer, reversed(inner), {at(-1, -1), at(1, -1), at(1, 1)}});
  EXPECT_EQ(text_of(island, frame), "2F2F11FF2");
  EXPECT_EQ(text_of(island, box(-2, -2, 2, 2)), "2F21112F2");
  // Triangles that touch in a corner, as one ring and as two.
  const CellRings bow = polygon({{at(0, 0), at(1, -1), at(1, 1), at(0, 0), at(-1, 1), at(-1, -1)}});
  const CellRings two =
      polygon({{at(0, 0), at(1, -1), at(1, 1)}, {at(0, 0), at(-1, 1), at(-1, -1)}});
  EXPECT_EQ(text_of(bow, two), "2FFF1FFF2");
  EXPECT_EQ(text_of(bow, polygon({{at(0, 0), at(0.25, 1), at(-0.25, 1)}})), "FF2F01212");
  EXPECT_EQ(text_of(bow, polygon({{at(0, 0), at(2, 0), at(-2, 1)}})), "212101212");
  // Two parts that share a side are one.
  const CellRings halves =
      polygon({{at(-1, 0), at(1, 0), at(0, 1)}, {at(1, 0), at(-1, 0), at(0, -1)}});
  EXPECT_EQ(text_of(halves, polygon({{at(-1, 0), at(0, -1), at(1, 0), at(0, 1)}})), "2FFF1FFF2");
  // A hole that touches its ring in the inside of a side.
  const CellRings notch =
      polygon({{at(-2, 0), at(2, 0), at(0, 3)}, {at(0, 0), at(-0.5, 1), at(0.5, 1)}});
  EXPECT_EQ(text_of(notch, polygon({{at(0, 0), at(0.5, 1), at(-0.5, 1)}})), "FF2F112F2");
  EXPECT_EQ(text_of(notch, polygon({{at(-2, 0), at(2, 0), at(0, 3)}})), "2FF11F2F2");
}

TEST(relate, knows_the_whole_sphere_and_nothing) {
  const CellRings all = whole_sphere();
  CellRings none;
  none.end_cell();
  const CellRings a = box(-1, -1, 1, 1);
  EXPECT_EQ(text_of(all, all), "2FFFFFFFF");
  EXPECT_EQ(text_of(all, none), "FF2FFFFFF");
  EXPECT_EQ(text_of(none, none), "FFFFFFFF2");
  EXPECT_EQ(text_of(all, a), "212FFFFFF");
  EXPECT_EQ(text_of(a, none), "FF2FF1FF2");
  EXPECT_EQ(text_of(complement(a), a), "FF2F1F2FF");
  EXPECT_EQ(text_of(complement(a), all), "2FF1FF2FF");
  EXPECT_EQ(text_of(complement(a), box(-2, -2, 2, 2)), "2121FF2FF");
  EXPECT_EQ(text_of(complement(a), box(-0.5, -0.5, 0.5, 0.5)), "FF2FF1212");
  EXPECT_EQ(text_of(complement(a), complement(box(-2, -2, 2, 2))), "212FF1FF2");
  // Two hemispheres, of rings along one circle with other corners.
  const CellRings north = polygon({{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}});
  const CellRings south =
      polygon({{{0.6, 0.8, 0}, {0.8, -0.6, 0}, {-0.6, -0.8, 0}, {-0.8, 0.6, 0}}});
  EXPECT_EQ(text_of(north, south), "FF2F1F2FF");
  EXPECT_EQ(text_of(north, complement(south)), "2FFF1FFF2");
}

TEST(relate, takes_points_on_one_ray_as_one_place) {
  const double longer = 1 + 0x1p-50;
  const CellRings a = polygon({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const CellRings b = polygon({{{longer, 0, 0}, {0, longer, 0}, {0, 0, longer}}});
  EXPECT_EQ(text_of(a, b), "2FFF1FFF2");
  const CellRings c = polygon({{{longer, 0, 0}, {0, 0, -1}, {0, longer, 0}}});
  EXPECT_EQ(text_of(a, c), "FF2F11212");
}

TEST(relate, decides_between_neighbouring_doubles) {
  // A corner on the equator, an ulp above it and below it, beside a triangle whose side is there.
  const CellRings a = polygon({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const double s = std::sqrt(0.5);
  for (const double z : {0.0, 0x1p-149, 0x1p-60, -0x1p-149, -0x1p-60}) {
    const CellRings b = polygon({{{s, s, z}, {0.8, 0, -0.6}, {0, 0.8, -0.6}}});
    EXPECT_EQ(text_of(a, b), z == 0 ? "FF2F01212" : z > 0 ? "212101212" : "FF2FF1212") << z;
  }
}

class Polygons {
 public:
  explicit Polygons(std::uint64_t seed) : random_(seed), center_(normalized(vector())) {
    size_ = std::pow(10, -1.0 * static_cast<double>(seed % 8));
  }
  double number() { return std::uniform_real_distribution<>(-1, 1)(random_); }
  std::size_t below(std::size_t end) { return random_() % end; }
  Point vector() { return {number(), number(), number()}; }
  Point near(const Point& p, double distance) { return normalized(p + distance * vector()); }

  // One of the 98 directions with coordinates up to 2, each of which is on a plane x = 0 or x = y,
  // or one that symmetry makes of these: exactly, also when normalized.
  Point direction() {
    const auto integer = [&] { return static_cast<double>(below(5)) - 2; };
    for (;;) {
      const Point p = {integer(), integer(), integer()};
      if (dot(p, p) != 0) return normalized(p);
    }
  }
  // A ring of some directions, which crosses itself or not.
  Ring grid_ring() {
    constexpr double nearly_opposite = -0.999;
    for (;;) {
      Ring ring(3 + below(2));
      for (Point& p : ring) p = direction();
      bool is_usable = true;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        is_usable = is_usable && dot(ring[k], ring[(k + 1) % ring.size()]) > nearly_opposite;
      }
      if (is_usable) return ring;
    }
  }
  // A ring around a place, with corners at any distances.
  Ring star() {
    const Point middle = near(center_, size_);
    const Point right = normalized(cross(middle, Point{1, 2, 3}));
    const Point up = cross(middle, right);
    Ring ring;
    const std::size_t count = 3 + below(5);
    for (std::size_t k = 0; k < count; ++k) {
      const double angle =
          -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
      ring.push_back(normalized(middle + 0.5 * size_ * (1 + 0.5 * number()) *
                                             (std::cos(angle) * right + std::sin(angle) * up)));
    }
    return ring;
  }
  // A box of a lattice around a place of any kind; corners of boxes are the same, bit by bit.
  Ring lattice_box(double size) {
    const auto integer = [&] { return static_cast<double>(below(4)) - 2; };
    const double y = integer();
    const double z = integer();
    const double width = static_cast<double>(1 + below(2));
    const double height = static_cast<double>(1 + below(2));
    const auto corner = [&](double i, double k) {
      return normalized(Point{1, size * (y + i), size * (z + k)});
    };
    return {corner(0, 0), corner(width, 0), corner(width, height), corner(0, height)};
  }
  // A ring of corners of a lattice in the plane x = 1, which are on lines exactly.
  Ring exact_lattice_ring(double size, std::size_t count) {
    const auto integer = [&] { return static_cast<double>(below(5)) - 2; };
    Ring ring(count);
    for (Point& p : ring) p = {1, size * integer(), size * integer()};
    return ring;
  }
  // A ring with two sides of nearly half a turn.
  Ring nearly_half_ring() {
    const double ulp = 2e-16;
    const Point beyond = near(-1.0 * center_, 1e-3);
    return {near(center_, 4 * ulp), near(beyond, 4 * ulp), normalized(vector())};
  }
  Ring ring(std::size_t kind) {
    switch (kind) {
      case 0:
        return grid_ring();
      case 1:
        return star();
      case 2:
        return lattice_box(0.1);
      case 3:
        return lattice_box(1e-9);
      case 4:
        return exact_lattice_ring(0x1p-25, 3 + below(3));
      case 5:
        return nearly_half_ring();
      case 7:
        return exact_lattice_ring(0x1p-53, 3);
      default:
        return exact_lattice_ring(0x1p-140, 3);
    }
  }
  // A union of halves of squares of a lattice: holes and parts that touch in corners.
  CellRings halves() {
    const auto corner = [](double y, double z) { return Point{1, 0x1p-25 * y, 0x1p-25 * z}; };
    CellRings cells;
    for (std::size_t count = 1 + below(30); count > 0; --count) {
      const double y = static_cast<double>(below(4)) - 2;
      const double z = static_cast<double>(below(4)) - 2;
      const Ring square = {corner(y, z), corner(y + 1, z), corner(y + 1, z + 1), corner(y, z + 1)};
      const std::size_t first = below(2) * 2 + static_cast<std::size_t>(y + z + 4) % 2;
      add_ring({square[first], square[(first + 1) % 4], square[(first + 2) % 4]}, cells);
      cells.end_cell();
    }
    return unite(cells, {1});
  }
  // Kinds from num_overlay_kinds on are no wider than rounding; they are not combined, since
  // rounding of the places where their sides cross need not end.
  static constexpr std::size_t num_kinds = 9;
  static constexpr std::size_t num_overlay_kinds = 7;
  // A valid polygon: one ring, or a union or a difference, or all but that.
  CellRings some(std::size_t kind) {
    const bool are_halves = kind == 6;
    CellRings one = are_halves ? halves() : repaired(polygon({ring(kind)}), {1});
    const std::size_t how = kind < 6 ? below(6) : 0;
    if (how >= 3) {
      const CellRings other = polygon({ring(kind)});
      one = combine(one, other,
                    how == 3   ? SetOperation::unite
                    : how == 4 ? SetOperation::difference
                               : SetOperation::symmetric_difference,
                    {1});
    }
    return below(5) == 0 ? complement(one) : one;
  }

 private:
  std::mt19937_64 random_;
  Point center_;
  double size_ = 1;
};

TEST(relate, is_what_places_tell) {
  const std::size_t count = scaled(1200);
  std::vector<std::string> seen;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    const std::size_t kind = seed / 8 % Polygons::num_kinds;
    const CellRings a = make.some(kind);
    CellRings b = make.some(kind);
    // Operands whose sides are those of the other one, in part.
    if (kind < Polygons::num_overlay_kinds && make.below(4) == 0)
      b = combine(a, b, make.below(2) == 0 ? SetOperation::intersection : SetOperation::difference,
                  {1});
    const std::string expected = relation_by_places(a, 0, b, 0);
    ASSERT_EQ(text_of(a, b), expected);
    ASSERT_EQ(relate(b, a, {1})[0], relate(a, b, {1})[0].transposed());
    const bool is_nothing = a.rings.size() == 1 && a.whole.empty();
    ASSERT_EQ(text_of(a, a), is_nothing        ? "FFFFFFFF2"
                             : a.whole.empty() ? "2FFF1FFF2"
                                               : "2FFFFFFFF");
    seen.push_back(expected);
  }
  std::ranges::sort(seen);
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  if (count >= 1200) {
    EXPECT_GE(seen.size(), 30U);
  }
}

TEST(relate, knows_pieces_of_an_overlay) {
  const std::size_t count = scaled(200);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    CellRings a;
    CellRings b;
    const std::size_t kind = seed / 8 % Polygons::num_overlay_kinds;
    for (int k = 0; k < 3; ++k) {
      add_cells(make.some(kind), a);
      add_cells(make.some(kind), b);
    }
    const CellRings region = unite(b, {1});
    const RegionPieces pieces = overlay_pieces(unite(a, {1}), region, SetOperation::unite, {1});
    const std::size_t num_pieces = pieces.num_pieces();
    // Pieces of one arrangement have no interior in common; a piece and what it is not cover the
    // sphere.
    for (const RelatedPair& pair : related_pairs(pieces.rings, pieces.rings)) {
      ASSERT_TRUE(pair.relation.is(pair.first == pair.second ? SpatialPredicate::equals
                                                             : SpatialPredicate::touches));
    }
    for (std::size_t k = 0; k < num_pieces; ++k) {
      CellRings piece;
      piece.points = pieces.rings.points;
      piece.append_cell(pieces.rings, k);
      const std::string text = text_of(piece, complement(piece));
      ASSERT_TRUE(text == "FF2F1F2FF" || text == "FF2FFFFFF") << text;
    }
  }
}

TEST(related_pairs, are_those_of_which_the_answer_is_yes) {
  const std::size_t count = scaled(40);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polygons make(seed);
    CellRings a;
    CellRings b;
    for (int k = 0; k < 20; ++k) {
      add_cells(make.some(seed / 8 % Polygons::num_kinds), a);
      add_cells(make.some(make.below(Polygons::num_kinds)), b);
    }
    b.end_cell();
    std::vector<Relation> all;
    for (std::size_t i = 0; i < a.num_cells(); ++i) {
      CellRings one;
      one.points = a.points;
      one.append_cell(a, i);
      const std::vector<Relation> row = relate(one, b, {2});
      const std::vector<Relation> column = relate(b, one, {1});
      ASSERT_EQ(row.size(), b.num_cells());
      for (std::size_t k = 0; k < row.size(); ++k) ASSERT_EQ(column[k], row[k].transposed());
      all.insert(all.end(), row.begin(), row.end());
    }
    std::vector<std::array<Index, 2>> pairs_of_all;
    for (Index i = 0; i < a.num_cells(); ++i) {
      for (Index k = 0; k < b.num_cells(); ++k) pairs_of_all.push_back({i, k});
    }
    ASSERT_EQ(relate_pairs(a, b, pairs_of_all, {2}), all);
    const CellRings copy = b;
    for (const std::string_view name : names_of<SpatialPredicate>()) {
      const SpatialPredicate predicate = *from_name<SpatialPredicate>(name);
      if (predicate == SpatialPredicate::disjoint) continue;
      ASSERT_EQ(related_pairs(b, b, predicate, {1}), related_pairs(b, copy, predicate, {2}));
      const std::vector<RelatedPair> pairs = related_pairs(a, b, predicate, {2});
      std::size_t next = 0;
      for (Index i = 0; i < a.num_cells(); ++i) {
        for (Index k = 0; k < b.num_cells(); ++k) {
          const Relation& relation = all[i * b.num_cells() + k];
          if (!relation.is(predicate) || !relation.is(SpatialPredicate::intersects)) continue;
          ASSERT_LT(next, pairs.size());
          ASSERT_EQ(pairs[next].first, i);
          ASSERT_EQ(pairs[next].second, k);
          ASSERT_EQ(pairs[next].relation, relation);
          ++next;
        }
      }
      ASSERT_EQ(next, pairs.size());
    }
  }
}

TEST(relate, refuses_what_is_no_valid_polygon) {
  const CellRings good = box(-1, -1, 1, 1);
  const auto index_of = [&](const CellRings& bad) {
    return thrown_index([&] { return relate(good, bad); });
  };
  const auto message_of = [&](const Ring& ring) {
    CellRings two = good;
    add_cells(polygon({ring}), two);
    EXPECT_EQ(index_of(two), 1U);
    EXPECT_EQ(thrown_index([&] { return related_pairs(two, good); }), 1U);
    return thrown_message<InvalidInput>([&] { return relate(two, good); });
  };
  EXPECT_EQ(message_of({at(0, 0), at(1, 1), at(1, 0), at(0, 1)}),
            "polygon 1 of the first operand has sides that cross each other");
  EXPECT_EQ(message_of({at(0, 0), at(1, 0), at(0, 1), at(0, 0), at(-1, 0), at(0, 1)}),
            "polygon 1 of the first operand has sides that disagree on where its interior is");
  EXPECT_EQ(message_of({at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 0), at(1, 1)}),
            "polygon 1 of the first operand has sides that disagree on where its interior is");
  EXPECT_EQ(message_of({at(0, 0), at(1, 0), at(2, 0), at(1, 0)}),
            "polygon 1 of the first operand has rings, but no sides: it may be empty or the whole "
            "sphere");
  // A ring and its hole that run in the same direction.
  EXPECT_EQ(index_of(polygon({{at(-1, -1), at(1, -1), at(0, 1)},
                              {at(-0.25, -0.25), at(0.25, -0.25), at(0, 0.25)}})),
            0U);
  CellRings bad = good;
  bad.whole = {0};
  EXPECT_EQ(index_of(bad), 0U);
  bad = good;
  bad.corners[2] = 99;
  EXPECT_EQ(index_of(bad), InvalidInput::no_index);
  EXPECT_EQ(message_of({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}),
            "polygon 1 of the first operand has a side that leads to the opposite point");
  EXPECT_EQ(message_of({{1, 0, 0}, {0, 2, 0}, {0, 0, 1}}),
            "polygon 1 of the first operand, point 5: no unit vector");
  CellRings two = good;
  add_cells(good, two);
  CellRings three = two;
  add_cells(good, three);
  EXPECT_EQ(thrown_index([&] { return relate(two, three); }), InvalidInput::no_index);
  const std::vector<std::array<Index, 2>> pairs = {{0, 0}, {0, 3}};
  EXPECT_EQ(thrown_index([&] { return relate_pairs(two, three, pairs); }), 1U);
  EXPECT_EQ(thrown_index([&] { return related_pairs(good, good, SpatialPredicate::disjoint); }),
            InvalidInput::no_index);
}

TEST(relate, ends_when_it_is_told_to_stop) {
  const CellRings cells = box(-1, -1, 1, 1);
  const std::atomic<bool> stop = true;
  const Execution execution{.threads = 1, .stop = &stop};
  EXPECT_THROW(relate(cells, cells, execution), Interrupted);
  EXPECT_THROW(related_pairs(cells, cells, SpatialPredicate::intersects, execution), Interrupted);
}

TEST(relate, of_nothing_is_nothing) {
  EXPECT_TRUE(relate(CellRings{}, {}).empty());
  EXPECT_TRUE(relate({}, box(-1, -1, 1, 1)).empty());
  EXPECT_TRUE(related_pairs(CellRings{}, {}).empty());
}

TEST(relation, fits_to_patterns) {
  const Relation relation = {{'2', '1', '2', '1', '0', '1', '2', '1', '2'}};
  EXPECT_EQ(relation.text(), "212101212");
  EXPECT_TRUE(relation.matches("*********"));
  EXPECT_TRUE(relation.matches("T*T***T**"));
  EXPECT_TRUE(relation.matches("212101212"));
  EXPECT_FALSE(relation.matches("T*F**F***"));
  EXPECT_FALSE(relation.matches("1********"));
  EXPECT_EQ(thrown_index([&] { return relation.matches("T*F*"); }), 4U);
  EXPECT_EQ(thrown_index([&] { return relation.matches("T*F******F"); }), 9U);
  EXPECT_EQ(thrown_index([&] { return relation.matches("T*F***3**"); }), 6U);
  EXPECT_EQ(Relation{}.text(), "FFFFFFFF2");
  EXPECT_TRUE(Relation{}.is(SpatialPredicate::equals));
  EXPECT_TRUE(Relation{}.is(SpatialPredicate::disjoint));
  EXPECT_FALSE(Relation{}.is(SpatialPredicate::within));
}

TEST(spatial_predicate, has_names_of_its_own) {
  for (const auto name : names_of<SpatialPredicate>()) {
    EXPECT_EQ(name_of(*from_name<SpatialPredicate>(name)), name);
  }
  EXPECT_EQ(names_of<SpatialPredicate>().size(), 10U);
}

}  // namespace
}  // namespace rondel::test::of_relations
