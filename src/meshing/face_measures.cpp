// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/face_measures.h"

#include <cmath>

#include "dual/face_normal.h"
#include "dual/ring_walk.h"
#include "dual/split_sites.h"
#include "exact/angles.h"

namespace rondel::meshing {
namespace {

using dual::Vec;

// The circumcenter of a face, and the height p and length of each edge.
struct FaceCenter {
  Vec normal;
  std::array<double, 3> heights;
  std::array<double, 3> lengths;
};

// Differences of coordinates that are known to 2^-100 have a relative error of u/2 as long as their
// square is above this bound.
constexpr double min_square = 0x1p-90;

// Computes flat faces and faces of very close sites from the exact normal, where p = n.(b x c) /
// |D| with b x c = b x D.
FaceCenter careful_center(const dual::SplitSites& sites, const Triple& corners) {
  FaceCenter center{};
  center.normal =
      dual::to_vector(dual::exact_normal(sites, corners[0], corners[1], corners[2]).normal);
  for (Index i = 0; i < 3; ++i) {
    const Index b = corners[dual::next_corner(i)];
    const Vec d = sites.difference(b, corners[dual::previous_corner(i)]);
    center.lengths[i] = norm(d);
    center.heights[i] = det(center.normal, dual::to_vector(sites[b].hi), d) / center.lengths[i];
  }
  return center;
}

// Returns the circumcenter of a face and its heights, computed in doubles from exact differences
// where that is accurate, and by careful_center() otherwise.
FaceCenter center_of(const dual::SplitSites& sites, const Triple& corners) {
  const auto b = sites.offset(corners[0], corners[1]);
  const auto c = sites.offset(corners[0], corners[2]);
  const Vec n = dual::split_cross(b, c).rounded();
  const Vec to_b = b.hi + b.lo;
  const Vec to_c = c.hi + c.lo;
  const Vec d = (c.hi - b.hi) + (c.lo - b.lo);
  const std::array<double, 3> squares = {dot(d, d), dot(to_c, to_c), dot(to_b, to_b)};
  const double n2 = dot(n, n);
  if (!dual::is_accurate(squares[2], squares[1], n2, true) ||
      std::min({squares[0], squares[1], squares[2]}) < min_square) {
    return careful_center(sites, corners);
  }
  const std::array<double, 3> products = {dot(to_b, to_c), -dot(to_b, d), dot(to_c, d)};
  const double length = std::sqrt(n2);
  FaceCenter center{n / length, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    center.lengths[i] = std::sqrt(squares[i]);
    center.heights[i] = center.lengths[i] * products[i] / (2 * length);
  }
  return center;
}

// Returns the circumcenter, arcs and kites of a face, by the formulas of the header.
FaceMeasures measures_of(const dual::SplitSites& sites, const Triple& corners) {
  const FaceCenter center = center_of(sites, corners);
  const double cosine = dot(dual::to_vector(sites[corners[0]].hi), center.normal);
  FaceMeasures measures{to_point(center.normal), {}, {}};
  std::array<double, 3> triangles{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double half = center.lengths[i] / 2;
    const double k = std::sqrt((1 - half) * (1 + half));
    measures.arcs[i] = exact::argument(center.heights[i], cosine);
    triangles[i] = 2 * exact::argument(half * center.heights[i], (1 + k) * (k + cosine));
  }
  for (Index i = 0; i < 3; ++i) {
    measures.kites[i] = triangles[dual::next_corner(i)] + triangles[dual::previous_corner(i)];
  }
  return measures;
}

}  // namespace

void measure_faces(const dual::SplitSites& sites, std::size_t begin,
                   std::span<FaceMeasures> measures) {
  for (std::size_t k = 0; k < measures.size(); ++k) {
    measures[k] = measures_of(sites, sites.corners(static_cast<Index>(begin + k)));
  }
}

double distance_of(const dual::SplitSites& sites, Index a, Index b) {
  return angle_of_chord(norm(sites.difference(a, b)));
}

double angle_of_chord(double length) {
  const double half = length / 2;
  return 2 * exact::argument(half, std::sqrt((1 - half) * (1 + half)));
}

// The normal of the edge at its midpoint m is that of the plane through m and a x b.
EdgePlace edge_place(const Vec& a, const Vec& b) {
  const Vec m = normalized(a + b);
  const Vec to = b - a;
  const double across_axis = m.x * m.x + m.y * m.y;
  const double rho = std::sqrt(across_axis);
  const double x = rho > 0 ? m.x / rho : 1;
  const double y = rho > 0 ? m.y / rho : 0;
  const double east = to.y * x - to.x * y;
  const double north = rho * to.z - m.z * (to.x * x + to.y * y);
  return {to_point(m), exact::argument(north, east)};
}

}  // namespace rondel::meshing
