// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Areas and first moments on the unit sphere, as sums over arcs of great circles.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "exact/argument.h"
#include "exact/vector.h"
#include "predicates/bounds.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Of a point p, as seen from a point o: (x, y, z) = p - o along three axes, of which the third one is o.
using Place = exact::Vector3<double>;

// Axes at o: those of the coordinates, turned from the nearer pole to o along the shortest way.
class LocalAxes {
 public:
  explicit LocalAxes(const Point& o) : LocalAxes(o, o.z < 0 ? -1 : 1) {}
  // Of points of the sphere, so that z follows from the distance.
  [[nodiscard]] Place place_of(const Point& p) const {
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

// The triangle (o, p, q), where p and q are given by their places. With S = q - p
//
//     tan(area / 2) = o.(P x S) / (1 + o.p + p.q + q.o),    o.p = 1 + z(p), p.q = 1 - |S|^2 / 2.
class Triangle {
 public:
  Triangle(const Place& p, const Place& q) {
    const Place side = q - p;
    above_ = p.x * side.y - p.y * side.x;
    below_ = 4 + (p.z + q.z) - 0.5 * dot(side, side);
    length_ = std::abs(side.x) + std::abs(side.y) + std::abs(side.z);
  }
  // Negative if it is clockwise.
  [[nodiscard]] double area() const {
    constexpr double small = 0x1p-10;  // t^6 is nothing then
    if (std::abs(above_) < small * below_) {
      const double t = above_ / below_;
      const double t2 = t * t;
      return 2 * (t - t * t2 * (1.0 / 3 - t2 * (1.0 / 5)));
    }
    return 2 * exact::argument(above_, below_);
  }
  // Whether sides are longer than a radian or so: its area may be ill-defined.
  [[nodiscard]] bool is_large() const { return below_ < 2.5; }
  // How long the side from p to q is, or up to sqrt(3) times that.
  [[nodiscard]] double rough_length() const { return length_; }

 private:
  double above_;
  double below_;
  double length_;
};

// The arc's share of the first moment, the integral of q over a region: half of that of q x dq along its
// boundary, so half of the angle times the unit normal.
inline Point moment_of_arc(const Point& p, const Point& q) {
  const Point normal = cross(p, q - p);
  const double square = dot(normal, normal);
  constexpr double small = 0x1p-14;  // of asin(s) / s - 1, s^8 is nothing then
  const double cosine = dot(p, q);
  if (square < small && cosine > 0) {
    return (0.5 + square * (1.0 / 12 + square * (3.0 / 80 + square * (5.0 / 224)))) * normal;
  }
  const double sine = std::sqrt(square);
  return sine > 0 ? exact::argument(sine, cosine) / (2 * sine) * normal : Point{};
}

// How long an arc is, or up to sqrt(3) times that.
inline double rough_length(const Point& p, const Point& q) {
  return std::abs(q.x - p.x) + std::abs(q.y - p.y) + std::abs(q.z - p.z);
}

// Corners are off by 2u from their edges, or some 10u where those are as good as parallel, so areas by that
// times the border.
constexpr double area_of_rounding(double length) { return 16 * predicates::unit_roundoff * length; }

// Throws InvalidInput with the cell, whose pieces add up to something else than its area.
[[noreturn]] void refuse_pieces(Index name, double sum, double area);

// Leaves out the pieces of a cell whose area is not larger than rounding of their corners may be, by their areas and
// lengths. But a cell that is no larger keeps its largest piece.
template <class Piece>
void drop_rounding(std::vector<Piece>& pieces) {
  const auto is_rounding = [](const Piece& piece) {
    return piece.area <= area_of_rounding(piece.length);
  };
  if (pieces.empty()) return;
  if (std::ranges::all_of(pieces, is_rounding)) {
    const Piece largest = *std::ranges::max_element(pieces, {}, &Piece::area);
    pieces.clear();
    if (largest.area > 0) pieces.push_back(largest);
  } else {
    std::erase_if(pieces, is_rounding);
  }
}

// The pieces of a cell add up to it. A piece is off by area_of_rounding() of its border where the triangles are no larger than
// a radian, and the cell by that of its own; large triangles lose some digits more, for which there are four times as much
// and a share of 1e-9. Where an edge of the cover runs along a cell, triangles of one half may cancel each other: 64 times u
// for what is left of them. Less than nothing of a piece, or another sum, shows that a cell is not what its border says: it
// crosses or overlaps itself.
// A cell no wider than rounding may seem to: then it has no pieces.
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

struct BorderArc {
  Point from;
  Point to;
};
struct Measures {
  double area = 0;
  double length = 0;  // roughly
  Point moment{};
  bool is_sure =
      true;  // the area; not of regions around the sphere, as belts, whose center of mass is its center
};
// Of a region that fits into a hemisphere, by all arcs of its border, and a point not far from most regions'.
Measures measures_of(std::span<const BorderArc> border, const Point& nearby);

}  // namespace rondel::overlay
