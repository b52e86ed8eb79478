// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// NaturalCell: the cell that a target gets between its natural neighbors, in the plane.
//
//     1 ----------- 0      The target is the origin. A neighbor at p bounds the cell by the line halfway to it, so four
//     |     /\      |      neighbors at the corners of a square leave a diamond. Laplace's share of a neighbor is the side on
//     |   /    \    |      its line over the distance, Sibson's is twice the area that is nearer to it than to the other
//     |   \    /    |      neighbors. A ring of neighbors at a circle around the target is its own conflict region.
//     |     \/      |
//     2 ----------- 3
#include "interpolation/natural_cell.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "support/random.h"

namespace rondel::test::of_natural_cell {
namespace {

using exact::DoubleDouble;
using interpolation::Bisector;
using interpolation::NaturalCell;
using interpolation::RegionFace;

struct PlanePoint {
  double x;
  double y;
};
using PlaneRing = std::vector<PlanePoint>;

PlanePoint minus(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
double turn_of(const PlanePoint& a, const PlanePoint& b) { return a.x * b.y - a.y * b.x; }
double squared(const PlanePoint& a) { return a.x * a.x + a.y * a.y; }

template <class T>
void set_neighbors(NaturalCell<T>& cell, const PlaneRing& ring) {
  cell.bisectors().clear();
  for (const PlanePoint& p : ring) {
    const interpolation::Planar<T> at{T{p.x}, T{p.y}};
    cell.bisectors().push_back({at, T{squared(p) / 2}, std::abs(p.x) + std::abs(p.y)});
  }
}

const PlaneRing square = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
// The face between 1, 3 and 0 is entered first, across the edge from 0 to 1, and then that between 1, 2 and 3.
const std::vector<RegionFace> halves_of_square = {{1, 3, 4, no_index}, {1, 2, 3, 0}};

TEST(natural_cell, of_a_square_of_neighbors_has_equal_shares) {
  NaturalCell<double> cell;
  set_neighbors(cell, square);
  // The error of a corner is 4, of a side (4 + 4 + 1 + 1) / 2, of a weight a quarter of the sum of four.
  EXPECT_EQ(cell.laplace(), 5);
  // Sides as long as the distances of the neighbors.
  EXPECT_EQ(cell.shares(), (std::vector<double>{1, 1, 1, 1}));
  // The errors of four corners are 4, those of the two Voronoi vertices 2; the radius is 1, and twice the area 4.
  EXPECT_EQ(cell.sibson(halves_of_square), (4 * 4 + 2 * 2 + 1) / 4.0);
  // A quarter of the diamond each, whose area is 2.
  EXPECT_EQ(cell.shares(), (std::vector<double>{1, 1, 1, 1}));
  // The other diagonal leads to the same.
  cell.sibson(std::vector<RegionFace>{{1, 2, 4, no_index}, {2, 3, 4, 0}});
  EXPECT_EQ(cell.shares(), (std::vector<double>{1, 1, 1, 1}));
}

// Neighbors at the distances 2 and 1: the cell has the sides 2 and 1.
TEST(natural_cell, of_a_cross_of_neighbors_has_laplace_shares_by_hand) {
  NaturalCell<double> cell;
  set_neighbors(cell, {{2, 0}, {0, 1}, {-2, 0}, {0, -1}});
  cell.laplace();
  EXPECT_EQ(cell.shares(), (std::vector<double>{0.5, 2, 0.5, 2}));
}

// The cell of a target on the way between two of three neighbors would be without end.
TEST(natural_cell, without_bounds_has_an_infinite_error) {
  NaturalCell<double> cell;
  set_neighbors(cell, {{1, 0}, {1, 1}, {0, 1}});
  EXPECT_TRUE(std::isinf(cell.laplace()));
  EXPECT_TRUE(std::isinf(cell.sibson(std::vector<RegionFace>{{1, 2, 3, no_index}})));
  set_neighbors(cell, {{1, 0}, {0, 1}, {-1, -1}});
  EXPECT_TRUE(std::isfinite(cell.laplace()));
}

// The part of a polygon where the product with p is at most s.
PlaneRing cut(const PlaneRing& ring, const PlanePoint& p, double s) {
  PlaneRing left;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PlanePoint& a = ring[i];
    const PlanePoint& b = ring[(i + 1) % ring.size()];
    const double at_a = p.x * a.x + p.y * a.y - s;
    const double at_b = p.x * b.x + p.y * b.y - s;
    if (at_a <= 0) left.push_back(a);
    if ((at_a < 0) != (at_b < 0) && at_a != at_b) {
      const double t = at_a / (at_a - at_b);
      left.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return left;
}

double doubled_area_of(const PlaneRing& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += turn_of(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

// The target's cell, and twice the area of it that is nearest to each neighbor, by cutting polygons.
struct CutCell {
  explicit CutCell(const PlaneRing& neighbors) {
    ring = {{99, 99}, {-99, 99}, {-99, -99}, {99, -99}};
    for (const PlanePoint& p : neighbors) ring = cut(ring, p, squared(p) / 2);
    for (const PlanePoint& p : neighbors) {
      PlaneRing part = ring;
      for (const PlanePoint& other : neighbors) {
        if (&other == &p) continue;
        part = cut(part, minus(other, p), (squared(other) - squared(p)) / 2);
      }
      taken.push_back(doubled_area_of(part));
    }
  }
  PlaneRing ring;
  std::vector<double> taken;
};

bool is_in_circle(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                  const PlanePoint& p) {
  const PlanePoint u = minus(a, p);
  const PlanePoint v = minus(b, p);
  const PlanePoint w = minus(c, p);
  return squared(u) * turn_of(v, w) + squared(v) * turn_of(w, u) + squared(w) * turn_of(u, v) > 0;
}

// Appends the Delaunay faces of neighbors in convex position beyond the edge from b to a.
void append_faces(const PlaneRing& ring, Index a, Index b, Index parent,
                  std::vector<RegionFace>& faces) {
  if (b == a + 1) return;
  const PlanePoint& p = ring[a];
  const PlanePoint& q = ring[b % ring.size()];
  for (Index apex = a + 1; apex < b; ++apex) {
    bool is_empty = true;
    for (Index other = a + 1; other < b; ++other)
      is_empty = is_empty && (other == apex || !is_in_circle(p, ring[apex], q, ring[other]));
    if (!is_empty) continue;
    const auto here = static_cast<Index>(faces.size());
    faces.push_back({a, apex, b, parent});
    append_faces(ring, a, apex, here, faces);
    append_faces(ring, apex, b, here, faces);
    return;
  }
}

// Neighbors near a circle, and a target in it that all their Delaunay circles contain.
TEST(natural_cell, has_the_shares_of_polygons_that_are_cut) {
  Random random(83);
  std::size_t num_rounds = 0;
  for (int round = 0; round < 200; ++round) {
    const std::size_t size = 3 + random.below(6);
    const PlanePoint target{0.6 * random.unit() - 0.3, 0.6 * random.unit() - 0.3};
    PlaneRing ring;
    for (std::size_t k = 0; k < size; ++k) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.6 * random.unit()) /
                           static_cast<double>(size);
      const double radius = 1 + 0.02 * random.unit();
      ring.push_back({radius * std::cos(angle) - target.x, radius * std::sin(angle) - target.y});
    }
    std::vector<RegionFace> faces;
    append_faces(ring, 1, static_cast<Index>(size), no_index, faces);
    ASSERT_EQ(faces.size(), size - 2);
    bool are_all_around = true;
    for (const RegionFace& face : faces) {
      are_all_around = are_all_around &&
                       is_in_circle(ring[face.a], ring[face.apex], ring[face.b % size], {0, 0});
    }
    const CutCell expected(ring);
    if (!are_all_around || expected.ring.size() != size) continue;
    ++num_rounds;
    NaturalCell<double> cell;
    set_neighbors(cell, ring);
    EXPECT_LT(cell.sibson(faces), 1e6);
    for (std::size_t i = 0; i < size; ++i)
      EXPECT_NEAR(cell.shares()[i], expected.taken[i], 1e-12) << round << ' ' << i;
    // In twice the precision, the mean of the neighbors by the weights is the target, by far less than rounding.
    NaturalCell<DoubleDouble> fine;
    set_neighbors(fine, ring);
    for (DoubleDouble x{}, y{}; const bool is_laplace : {true, false}) {
      is_laplace ? fine.laplace() : fine.sibson(faces);
      x = y = DoubleDouble{};
      for (std::size_t i = 0; i < size; ++i) {
        x = x + fine.shares()[i] * ring[i].x;
        y = y + fine.shares()[i] * ring[i].y;
      }
      // The bisectors are those of rounded squares of distances.
      EXPECT_NEAR(x.hi, 0, 1e-14) << round;
      EXPECT_NEAR(y.hi, 0, 1e-14) << round;
    }
    cell.laplace();
    for (std::size_t i = 0; i < size; ++i) {
      const PlanePoint& p = ring[i];
      double side = 0;  // the side of the cut cell on the line of the neighbor
      for (std::size_t k = 0; k < size; ++k) {
        const PlanePoint& v = expected.ring[k];
        const PlanePoint& w = expected.ring[(k + 1) % size];
        const auto away = [&](const PlanePoint& q) {
          return std::abs(p.x * q.x + p.y * q.y - squared(p) / 2);
        };
        if (away(v) < 1e-11 && away(w) < 1e-11) side = std::sqrt(squared(minus(v, w)));
      }
      EXPECT_NEAR(cell.shares()[i], side / std::sqrt(squared(p)), 1e-9) << round << ' ' << i;
    }
  }
  EXPECT_GT(num_rounds, 100U);
}

// At u the basis of the tangent plane is perpendicular and as long in both directions, whichever coordinate is smallest.
TEST(natural_cell, bisectors_are_those_of_the_tangent_plane) {
  for (const std::array<double, 3>& at : {std::array{0.0, 0.6, 0.8},
                                          {0.6, 0.0, 0.8},
                                          {0.6, 0.8, 0.0},
                                          {2.0 / 3, -2.0 / 3, 1.0 / 3}}) {
    const Point u{at[0], at[1], at[2]};
    const interpolation::TangentBasis basis(u);
    const exact::Vector3<double> center = exact::to_vector(u);
    // Two sites near u, the second one counterclockwise from the first one.
    const Point a = normalized(Point{u.x + 0.2, u.y - 0.1, u.z + 0.05});
    const Point b = normalized(a + 0.3 * cross(u, a));
    const auto to_a = basis.bisector(center, exact::to_vector(a) - center);
    const auto to_b = basis.bisector(center, exact::to_vector(b) - center);
    EXPECT_NEAR(to_a.s, 1 - dot(u, a), 1e-15);
    EXPECT_NEAR(to_b.s, 1 - dot(u, b), 1e-15);
    const Point in_plane_a = a - dot(u, a) * u;
    const Point in_plane_b = b - dot(u, b) * u;
    const double least = std::min({std::abs(u.x), std::abs(u.y), std::abs(u.z)});
    const double scale = 1 - least * least;
    EXPECT_NEAR(to_a.p.x * to_a.p.x + to_a.p.y * to_a.p.y, scale * dot(in_plane_a, in_plane_a),
                1e-15);
    EXPECT_NEAR(to_a.p.x * to_b.p.x + to_a.p.y * to_b.p.y, scale * dot(in_plane_a, in_plane_b),
                1e-15);
    EXPECT_NEAR(interpolation::cross(to_a.p, to_b.p), scale * dot(u, cross(a, b)), 1e-15);
    EXPECT_GT(interpolation::cross(to_a.p, to_b.p), 0);
    std::vector<Bisector<double>> stereographic = {to_a};
    interpolation::make_stereographic(std::span(stereographic));
    EXPECT_NEAR(stereographic[0].p.x, to_a.p.x / (1 - to_a.s / 2), 1e-15);
    EXPECT_NEAR(stereographic[0].p.y, to_a.p.y / (1 - to_a.s / 2), 1e-15);
    EXPECT_NEAR(stereographic[0].s, to_a.s / (1 - to_a.s / 2), 1e-15);
  }
}

}  // namespace
}  // namespace rondel::test::of_natural_cell
