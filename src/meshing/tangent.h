// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Coordinates in the tangent planes of many sites, and sums over the sites in a fixed order.
//
// in    sites as unit vectors, each with the axis of its frame
// out   two unit vectors that span the tangent plane; sites moved by tangent vectors
// index axes: 0, 1 or 2 for x, y or z
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"
#include "system/parallel.h"

namespace rondel::mesh {

// A tangent vector in the frame of its site.
struct TangentVector {
  double u;
  double v;
};

// Two unit vectors that span the tangent plane of a site.
struct TangentFrame {
  exact::Vector3<double> u;
  exact::Vector3<double> v;
};

// Returns the axis that a site is farthest from in angle. The frame that belongs to it is smooth as
// long as the site stays half a radian away from that axis.
inline std::uint8_t far_axis(const Point& z) {
  const double x2 = z.x * z.x;
  const double y2 = z.y * z.y;
  const double z2 = z.z * z.z;
  if (x2 <= y2 && x2 <= z2) return 0;
  return y2 <= z2 ? 1 : 2;
}

// Returns the frame of a site: u is perpendicular to the axis and to z, v to both.
inline TangentFrame frame_at(const Point& z, std::uint8_t axis) {
  const exact::Vector3<double> east = axis == 0
                                          ? exact::Vector3<double>{0, -z.z, z.y}
                                          : (axis == 1 ? exact::Vector3<double>{z.z, 0, -z.x}
                                                       : exact::Vector3<double>{-z.y, z.x, 0});
  const exact::Vector3<double> u = east / norm(east);
  return {u, cross(exact::to_vector(z), u)};
}

// Returns z moved by a tangent vector, projected back to the sphere.
inline Point moved(const Point& z, std::uint8_t axis, const TangentVector& by) {
  const TangentFrame frame = frame_at(z, axis);
  const auto p = exact::to_vector(z) + by.u * frame.u + by.v * frame.v;
  return exact::to_point(p / norm(p));
}

inline constexpr std::size_t terms_at_a_time = 4096;

// Returns the sum of piece(begin, end) over pieces of all `count` terms, added from the first to
// the last.
template <class Piece>
double sum_in_order(unsigned threads, std::size_t count, const Piece& piece) {
  std::vector<double> sums(system::num_pieces(count, terms_at_a_time));
  system::parallel_for(threads, count, terms_at_a_time, [&](std::size_t begin, std::size_t end) {
    sums[begin / terms_at_a_time] = piece(begin, end);
  });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum;
}

inline double dot(const TangentVector& a, const TangentVector& b) { return a.u * b.u + a.v * b.v; }

}  // namespace rondel::mesh
