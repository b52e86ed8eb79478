// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/open_faces.h"

#include <algorithm>
#include <cmath>

namespace rondel::bulk {
namespace {

using Edge = PlaneGraph::Edge;
using predicates::Vector;

Vector operator*(double s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }

}  // namespace

Cone make_cone(const Cell& cell, double hand) {
  const auto ratio = [](std::uint64_t position) {
    return std::ldexp(static_cast<double>(position), 1 - blocks::position_bits) - 1;
  };
  // The directions beyond a limit, in the plane of the third axis and one along the face.
  const auto plane = [](double x, double y, double limit) {
    const double length = std::sqrt(1 + limit * limit);
    return Vector{x / length, y / length, -limit * (x + y) / length};
  };
  const std::uint64_t size = std::uint64_t{1} << cell.bits;
  return {plane(1, 0, ratio(cell.corner.u)), plane(-1, 0, ratio(cell.corner.u + size)),
          plane(0, hand, hand * ratio(cell.corner.v)),
          plane(0, -hand, hand * ratio(cell.corner.v + size))};
}

// The plane of the face cuts the sphere of radius R in a circle with center a + x, where x is in
// the plane and 2 x.B = |B|^2 + w_b - w_a, 2 x.C = |C|^2 + w_c - w_a, w = R^2 - |p|^2. The cap,
// less than half of the sphere, lies in the ball around this center with the radius of the circle.
// `margin` is more than the roundings of a face without very small angles; others are not final.
bool OpenFaces::is_final(Index i, Index j, Index k) const {
  constexpr double margin = 1e-12;
  constexpr double thin = 1e-3;
  const Vector a = ray_(i);
  const Vector b = ray_(j);
  const Vector c = ray_(k);
  const Vector to_b = b - a;
  const Vector to_c = c - a;
  const Vector normal = cross(to_b, to_c);
  const double n2 = dot(normal, normal);
  double b2 = dot(to_b, to_b);
  double c2 = dot(to_c, to_c);
  if (!(n2 > thin * (b2 * c2)) || !(dot(normal, a) > 0)) return false;
  double wa = 0;
  if (radius_ > 0) {
    wa = radius_ * radius_ - dot(a, a);
    b2 -= dot(to_b, a + b);
    c2 -= dot(to_c, a + c);
  }
  const Vector x = (0.5 / n2) * (b2 * cross(to_c, normal) + c2 * cross(normal, to_b));
  const Vector middle = a + x;
  const double size = std::sqrt(std::max(dot(x, x) + wa, 0.0));
  const double least = size * (1 + margin) + margin * (radius_ > 0 ? radius_ : 1);
  return std::ranges::all_of(cone_,
                             [&](const Vector& inward) { return dot(inward, middle) > least; });
}

const std::vector<Edge>& OpenFaces::find(Edge boundary) {
  open_.clear();
  Edge e = boundary;
  do {
    graph_.set_face(e ^ 1, open_face);
    open_.push_back(e ^ 1);
    e = graph_.next(e ^ 1);
  } while (e != boundary);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const Edge f = open_[i] ^ 1;
    if (graph_.face(f) == open_face) continue;
    const Edge g = graph_.face_next(f);
    const Edge h = graph_.face_next(g);
    if (is_final(graph_.origin(f), graph_.origin(g), graph_.origin(h))) continue;
    for (const Edge side : {f, g, h}) {
      graph_.set_face(side, open_face);
      open_.push_back(side);
    }
  }
  return open_;
}

}  // namespace rondel::bulk
