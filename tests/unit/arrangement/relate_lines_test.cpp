// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Relations of points and lines, against integers of any length, and as laws.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/relate.h"
#include "support/random.h"
#include "support/thrown.h"
#include "unit/arrangement/relation_oracle.h"

namespace rondel::test::of_relations {
namespace {

constexpr std::array<SpatialPredicate, 10> predicates = {
    SpatialPredicate::intersects, SpatialPredicate::disjoint, SpatialPredicate::contains,
    SpatialPredicate::within,     SpatialPredicate::covers,   SpatialPredicate::covered_by,
    SpatialPredicate::touches,    SpatialPredicate::overlaps, SpatialPredicate::equals,
    SpatialPredicate::crosses};

// Places of which many are on common great circles.
std::vector<Point> places(int kind, Random& random) {
  std::vector<Point> points;
  if (kind < 2) {
    for (const double x : {-1.0, 0.0, 1.0}) {
      for (const double y : {-1.0, 0.0, 1.0}) {
        for (const double z : {-1.0, 0.0, 1.0}) {
          if (x != 0 || y != 0 || z != 0) points.push_back(normalized({x, y, z}));
        }
      }
    }
  } else if (kind == 2) {
    for (int i = 0; i < 9; ++i) {
      const double angle = 0.7 * random.unit();
      points.push_back(normalized({std::cos(angle), std::sin(angle), 0}));
      points.push_back(normalized({std::cos(angle), 0, std::sin(angle)}));
      points.push_back(normalized({std::cos(angle), std::sin(angle), random.unit()}));
    }
  } else {
    const Point middle = normalized({random.unit() - 0.5, random.unit() - 0.5, 0.3});
    for (int i = 0; i < 7; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double size = kind == 3 ? 0.1 : 0x1p-50;
        points.push_back(normalized({middle.x + size * i, middle.y + size * k, middle.z}));
      }
    }
  }
  if (kind == 1) {
    for (Point& p : points) {
      for (double* x : {&p.x, &p.y, &p.z}) {
        if (random.below(3) == 0 && *x != 0) *x = std::nextafter(*x, 2);
      }
    }
  }
  return points;
}

void append_triangle(const std::array<Point, 3>& corners, CellRings& polygons) {
  const auto first = static_cast<Index>(polygons.points.size());
  polygons.points.insert(polygons.points.end(), corners.begin(), corners.end());
  polygons.append_ring(std::array{first, first + 1, first + 2});
}

// Geometries between these places: of points, of lines, and triangles.
class Maker {
 public:
  Maker(int kind, Random& random) : random_(random), places_(places(kind, random)) {}

  Geometries operator()(std::size_t number) {
    Geometries made;
    for (std::size_t i = 0; i < number; ++i) {
      const std::uint64_t kind = random_.below(8);
      if (kind < 2) add_points(made);
      if (kind >= 2 && kind < 5) add_lines(made);
      if (kind >= 5 && kind < 7) add_triangle(made);
      made.lines.end_group();
      made.polygons.end_cell();
      if (kind == 7 && random_.below(4) == 0) {
        made.polygons.whole.push_back(static_cast<Index>(i));
      }
    }
    return made;
  }

 private:
  const Point& any() { return places_[random_.below(places_.size())]; }
  void add_points(Geometries& made) {
    for (std::uint64_t k = 1 + random_.below(4); k > 0; --k) {
      const Point& point = any();
      made.lines.rows.append({&point, 1});
    }
  }
  void add_lines(Geometries& made) {
    for (std::uint64_t k = 1 + random_.below(3); k > 0; --k) {
      std::vector<Point> line = {any()};
      while (line.size() < 2 || random_.below(3) > 0) {
        const Point& next = random_.below(6) == 0 ? line.front() : any();
        if (norm(line.back() + next) > 1e-9 && !(next == line.back())) line.push_back(next);
        if (line.size() > 6) break;
      }
      made.lines.rows.append(line);
    }
  }
  void add_triangle(Geometries& made) {
    for (int attempt = 0; attempt < 100; ++attempt) {
      std::array<Point, 3> corners = {any(), any(), any()};
      const Sign sign = orientation(corners[0], corners[1], corners[2]);
      if (sign == Sign::zero) continue;
      if (sign == Sign::negative) std::swap(corners[1], corners[2]);
      if (norm(corners[0] + corners[1]) < 1e-9 || norm(corners[1] + corners[2]) < 1e-9 ||
          norm(corners[2] + corners[0]) < 1e-9) {
        continue;
      }
      if (random_.below(4) == 0) std::swap(corners[1], corners[2]);  // all but the triangle
      append_triangle(corners, made.polygons);
      return;
    }
  }

  Random& random_;
  std::vector<Point> places_;
};

class RelatedLines : public testing::TestWithParam<int> {};

TEST_P(RelatedLines, are_as_integers_say) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  Maker make(GetParam() % 5, random);
  const Geometries a = make(12);
  const Geometries b = make(12);
  const std::vector<Relation> found = relate(a, b);
  const std::vector<Relation> back = relate(b, a);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].text(), relation_by_places(a, i, b, i)) << i;
    ASSERT_EQ(back[i], found[i].transposed()) << i;
  }
}

TEST_P(RelatedLines, are_joined_as_all_pairs) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 1000);
  Maker make(GetParam() % 5, random);
  const Geometries a = make(9);
  const Geometries b = make(7);
  for (const Geometries* other : std::array{&b, &a}) {
    std::vector<std::array<Index, 2>> pairs;
    for (Index i = 0; i < a.size(); ++i) {
      for (Index k = 0; k < other->size(); ++k) pairs.push_back({i, k});
    }
    const std::vector<Relation> all = relate_pairs(a, *other, pairs);
    for (const SpatialPredicate predicate : predicates) {
      if (predicate == SpatialPredicate::disjoint) continue;
      std::vector<RelatedPair> expected;
      for (std::size_t p = 0; p < pairs.size(); ++p) {
        // An empty geometry is in no pair.
        if (!all[p].is(SpatialPredicate::intersects) || !all[p].is(predicate)) continue;
        expected.push_back({pairs[p][0], pairs[p][1], all[p]});
      }
      for (const unsigned threads : {1U, 2U}) {
        ASSERT_EQ(related_pairs(a, *other, predicate, {.threads = threads}), expected)
            << name_of(predicate);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(all, RelatedLines, testing::Range(0, 100));

// --- by name ---

Geometries of(const std::vector<std::vector<LonLat>>& lines) {
  Geometries made;
  for (const std::vector<LonLat>& line : lines) {
    std::vector<Point> points;
    for (const LonLat& p : line) points.push_back(unit_vector(p));
    made.lines.rows.append(points);
    made.lines.end_group();
    made.polygons.end_cell();
  }
  return made;
}

Geometries octant() {
  Geometries made;
  made.lines.end_group();
  append_triangle({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, made.polygons);
  made.polygons.end_cell();
  return made;
}

// Returns the names of the predicates that hold.
std::string names(const Geometries& a, const Geometries& b) {
  const Relation relation = relate(a, b).front();
  std::string text;
  for (const SpatialPredicate predicate : predicates) {
    if (relation.is(predicate)) text += (text.empty() ? "" : " ") + std::string(name_of(predicate));
  }
  return text;
}

TEST(related_lines, predicates_are_those_of_simple_features) {
  const Geometries inside = of({{{45, 30}}});
  const Geometries border = of({{{45, 0}}});
  const Geometries outside = of({{{-45, 0}}});
  EXPECT_EQ(names(inside, octant()), "intersects within covered_by");
  EXPECT_EQ(names(octant(), inside), "intersects contains covers");
  EXPECT_EQ(names(border, octant()), "intersects covered_by touches");
  EXPECT_EQ(names(octant(), border), "intersects covers touches");
  EXPECT_EQ(names(outside, octant()), "disjoint");
  EXPECT_EQ(names(inside, inside), "intersects contains within covers covered_by equals");

  const Geometries across = of({{{-10, 20}, {30, 20}}});
  const Geometries along = of({{{10, 0}, {80, 0}}});
  const Geometries within = of({{{10, 10}, {80, 10}}});
  EXPECT_EQ(names(across, octant()), "intersects crosses");
  EXPECT_EQ(names(octant(), across), "intersects crosses");
  EXPECT_EQ(names(along, octant()), "intersects covered_by touches");
  EXPECT_EQ(names(within, octant()), "intersects within covered_by");
  EXPECT_EQ(names(of({{{0, 0}, {0, -10}}}), octant()), "intersects touches");

  const Geometries longer = of({{{20, 0}, {90, 0}}});
  EXPECT_EQ(names(along, longer), "intersects overlaps");
  EXPECT_EQ(names(of({{{20, 0}, {80, 0}}}), longer), "intersects within covered_by");
  EXPECT_EQ(names(along, of({{{40, -10}, {40, 10}}})), "intersects crosses");
  EXPECT_EQ(names(along, of({{{80, 0}, {80, 10}}})), "intersects touches");
  EXPECT_EQ(names(along, of({{{80, 0}, {40, 0}, {10, 0}}})),
            "intersects contains within covers covered_by equals");
  EXPECT_EQ(names(of({{{40, 0}}}), along), "intersects within covered_by");
  EXPECT_EQ(names(of({{{80, 0}}}), along), "intersects covered_by touches");
}

TEST(related_lines, several_dimensions_are_refused) {
  Geometries both = octant();
  const Point point = {1, 0, 0};
  both.lines.rows.append({&point, 1});
  both.lines.offsets.back() = 1;
  const auto relate_both = [&] { return relate(octant(), both); };
  EXPECT_EQ(thrown_message<InvalidInput>(relate_both),
            "geometry 0 of the second operand has parts of several dimensions, each of which has "
            "relations of its own");
  EXPECT_EQ(thrown_index(relate_both), 0U);
  Geometries uneven = octant();
  uneven.lines.end_group();
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return relate(uneven, octant()); }),
            "there are not as many cells as groups of lines");
  Geometries opposite = octant();
  opposite.polygons.points.push_back({-1, 0, 0});
  opposite.polygons.corners[1] = static_cast<Index>(opposite.polygons.points.size() - 1);
  const auto relate_opposite = [&] { return relate(octant(), opposite); };
  EXPECT_EQ(thrown_index(relate_opposite), 0U);
  EXPECT_EQ(thrown_message<InvalidInput>(relate_opposite),
            "polygon 0 of the second operand has a side that leads to the opposite point");
  opposite.polygons.points.back().x = -2;
  EXPECT_EQ(thrown_index(relate_opposite), 0U);
  EXPECT_EQ(thrown_message<InvalidInput>(relate_opposite),
            "polygon 0 of the second operand, point 3: no unit vector");
  Geometries turned = of({{{0, 0}, {90, 0}}});
  turned.lines.rows.values[1] = {-1, 0, 0};
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return relate(turned, octant()); }),
            "the ends of an arc are opposite to each other up to rounding");
}

}  // namespace
}  // namespace rondel::test::of_relations
