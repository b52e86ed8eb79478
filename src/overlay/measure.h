// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Areas and first moments of regions of the unit sphere, as sums over the arcs of their borders.
//
// in    arcs with the region to their left
// out   steradians; moments are integrals of the unit vector over the region
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "predicates/bounds.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Local coordinates of a point p of the sphere around a point o: (x, y, z) = p - o along three
// axes, of which o is the third.
using LocalPoint = exact::Vector3<double>;

// The axes at o. They are the coordinate axes, rotated along the shortest path from the nearer pole
// to o.
class LocalAxes {
 public:
  explicit LocalAxes(const Point& o) : LocalAxes(o, o.z < 0 ? -1 : 1) {}
  // Returns the local coordinates of a unit vector. Its z is computed from the distance to o.
  [[nodiscard]] LocalPoint place_of(const Point& p) const {
    const Point step = p - o_;
    return {dot(x_, step), dot(y_, step), -0.5 * dot(step, step)};
  }

 private:
  LocalAxes(const Point& o, double pole) : LocalAxes(o, pole, -1 / (pole + o.z)) {}
  LocalAxes(const Point& o, double pole, double scale)
      : o_(o),
        x_{1 + pole * o.x * o.x * scale, pole * (o.x * o.y * scale), -pole * o.x},
        y_{o.x * o.y * scale, pole + o.y * o.y * scale, -o.y} {}

  Point o_;
  Point x_;
  Point y_;
};

// The triangle (o, p, q), with p and q in local coordinates at o. With S = q - p
//
//     tan(area / 2) = o.(P x S) / (1 + o.p + p.q + q.o),    o.p = 1 + z(p), p.q = 1 - |S|^2 / 2.
class Triangle {
 public:
  Triangle(const LocalPoint& p, const LocalPoint& q) {
    const LocalPoint side = q - p;
    above_ = p.x * side.y - p.y * side.x;
    below_ = 4 + (p.z + q.z) - 0.5 * dot(side, side);
    length_ = std::abs(side.x) + std::abs(side.y) + std::abs(side.z);
  }
  // Returns the area of the triangle, negative if it is clockwise.
  [[nodiscard]] double area() const {
    constexpr double small = 0x1p-10;  // t^6 is below rounding then
    if (std::abs(above_) < small * below_) {
      const double t = above_ / below_;
      const double t2 = t * t;
      return 2 * (t - t * t2 * (1.0 / 3 - t2 * (1.0 / 5)));
    }
    return 2 * exact::argument(above_, below_);
  }
  // True if sides are longer than about a radian. The area may be ill-defined then.
  [[nodiscard]] bool is_large() const { return below_ < 2.5; }
  // Returns a bound for the length of the side from p to q, at most sqrt(3) times the chord.
  [[nodiscard]] double rough_length() const { return length_; }

 private:
  double above_;
  double below_;
  double length_;
};

// Returns the contribution of an arc to the first moment of the region to its left. The moment is
// half of the integral of q x dq along the border, and the arc's share is half of its angle times
// its unit normal.
inline Point moment_of_arc(const Point& p, const Point& q) {
  const Point normal = cross(p, q - p);
  const double square = dot(normal, normal);
  constexpr double small = 0x1p-14;  // s^8 in asin(s) / s - 1 is below rounding then
  const double cosine = dot(p, q);
  if (square < small && cosine > 0) {
    return (0.5 + square * (1.0 / 12 + square * (3.0 / 80 + square * (5.0 / 224)))) * normal;
  }
  const double sine = std::sqrt(square);
  return sine > 0 ? exact::argument(sine, cosine) / (2 * sine) * normal : Point{};
}

// Returns a bound for the length of an arc: at most sqrt(3) times its chord.
inline double rough_length(const Point& p, const Point& q) {
  return std::abs(q.x - p.x) + std::abs(q.y - p.y) + std::abs(q.z - p.z);
}

// Returns the area by which rounding of corners changes a region whose border has this length.
// Corners are off by 2u from their edges, or by some 10u where these are nearly parallel. A border
// whose computed length is 0, as at a pole, may be a rounding long.
constexpr double area_of_rounding(double length) {
  return 16 * predicates::unit_roundoff * (length + predicates::unit_roundoff);
}

// Returns the area of a cell that counts: where the cell is covered, the sum of its pieces differs
// from its area only by rounding, and replaces it, since it is the sum that conserves integrals.
// Corners on the cell's border are off by area_of_rounding(), and so are the pieces that were
// dropped; these may be many, and have together at most a share of 1e-9.
inline double counted_area(double covered, double area, double length) {
  constexpr double of_many = 1e-9;
  const double rounding = of_many * area + area_of_rounding(length);
  return covered > 0 && std::abs(covered - area) <= rounding ? covered : area;
}

// Throws InvalidInput with the cell (its index in the input), whose pieces do not add up to its
// area.
[[noreturn]] void refuse_pieces(Index name, double sum, double area);

// Drops the pieces of a cell that are no larger than what rounding of their corners can make.
// `area` and `length` are the area of the cell and the length of its border. A cell that is itself
// no larger than rounding keeps its largest piece. A cell that is little larger, such as a sliver
// whose tip is such a piece, loses at most a thousandth of its area.
template <class Piece>
void drop_rounding(std::vector<Piece>& pieces, double area, double length) {
  const auto is_rounding = [](const Piece& piece) {
    return piece.area <= area_of_rounding(piece.length);
  };
  std::size_t num_small = 0;
  double dropped = 0;
  for (const Piece& piece : pieces) {
    if (!is_rounding(piece)) continue;
    ++num_small;
    dropped += std::max(piece.area, 0.0);
  }
  if (num_small == 0) return;
  const double min_share = area / 1024;
  if (dropped > min_share && area > area_of_rounding(length)) {
    const double least = min_share / static_cast<double>(pieces.size());
    std::erase_if(pieces, [&](const Piece& piece) { return piece.area <= least; });
    return;
  }
  if (num_small == pieces.size()) {
    const Piece largest = *std::ranges::max_element(pieces, {}, &Piece::area);
    pieces.clear();
    if (largest.area > 0) pieces.push_back(largest);
  } else {
    std::erase_if(pieces, is_rounding);
  }
}

// Tests that the pieces of a cell add up to the cell's area. If they do not, drops the pieces if
// the cell is no wider than rounding, and otherwise throws InvalidInput with `name`, the index of
// the cell in the input.
//
// A piece is off by area_of_rounding() of its border where its triangles are no larger than a
// radian, and the cell by that of its own border. Large triangles lose some more digits, for which
// the bound has a factor of four and a share of 1e-9. Where an edge of the cover runs along a cell,
// triangles of a hemisphere can cancel; 64 u covers what is left of them. A piece with a negative
// area, or a sum other than the cell's area, shows that the cell is not what its border says: it
// crosses or overlaps itself.
template <class Piece>
void require_sum(std::vector<Piece>& pieces, double area, double length, Index name) {
  constexpr double of_triangles = 4;
  constexpr double of_large = 1e-9;
  constexpr double of_sums = 64 * predicates::unit_roundoff;
  double sum = 0;
  double total = length;
  double least = 0;
  for (const Piece& piece : pieces) {
    sum += piece.area;
    total += piece.length;
    least = std::min(least, piece.area + of_triangles * area_of_rounding(piece.length));
  }
  const double rounding = of_large * area + of_sums + of_triangles * area_of_rounding(total);
  if (std::abs(sum - area) <= rounding && least >= -(of_large * area + of_sums)) return;
  if (area > of_triangles * area_of_rounding(length)) refuse_pieces(name, sum, area);
  pieces.clear();
}

// An arc of a border, with the region to its left.
struct BorderArc {
  Point from;
  Point to;
};
// The measures of a region.
struct Measures {
  double area = 0;
  double length = 0;  // approximate length of the border, radians
  Point moment{};
  // False if the area is not certain: the region goes around the sphere (as belts do) and has its
  // center of mass near the center of the sphere.
  bool is_sure = true;
};
// Returns the measures of a region that fits into a hemisphere, from all arcs of its border.
// `nearby` is a point near the region, for most regions.
Measures measures_of(std::span<const BorderArc> border, const Point& nearby);

// Distinguishes crossings of sides from contacts that rounding has turned into crossings.
// True if two of the arcs cross by more than rounding of their ends: they cross exactly, and no end
// is within rounding of the other arc.
bool has_sure_crossing(std::span<const BorderArc> arcs);

}  // namespace rondel::overlay
