// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the ray of a point leaves the cube around the sphere.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "order/hilbert.h"
#include "rondel/types.h"

namespace rondel::order {

namespace cube {

// The faces in the order of the curve, and their axes, chosen so that the curve leaves a face
// where it enters the next one. Indexed by 2*axis + (1 on the negative side).
struct CubeFace {
  unsigned rank;
  unsigned u_axis;
  int u_sign;
  unsigned v_axis;
  int v_sign;
};
inline constexpr std::array<CubeFace, 6> faces = {{{2, 1, 1, 2, 1},
                                                   {4, 2, 1, 1, -1},
                                                   {3, 0, -1, 2, 1},
                                                   {0, 0, -1, 2, 1},
                                                   {5, 0, 1, 1, -1},
                                                   {1, 0, 1, 1, 1}}};

inline constexpr std::uint64_t last_position = (std::uint64_t{1} << position_bits) - 1;

// Returns the position of a ratio in [-1, 1].
inline std::uint64_t position(double ratio) {
  constexpr double half_range = 0x1p51;  // position_bits - 1
  constexpr double last = static_cast<double>(last_position);
  const double position = (ratio + 1) * half_range;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(position < last ? position : last));
}

// A vector in the axes of the face through which it leaves the cube: (u, v, length).
struct CubeRay {
  const CubeFace* face;
  double u;
  double v;
  double length;
};

// The face of sites in no order is anyone's guess: nothing here branches on it.
inline CubeRay ray_of(const std::array<double, 3>& d) {
  const double x = std::abs(d[0]);
  const double y = std::abs(d[1]);
  const double z = std::abs(d[2]);
  const double longer = x < y ? y : x;
  const double length = longer < z ? z : longer;
  const unsigned z_is_longest = longer < z ? 1 : 0;
  const unsigned axis = 2 * z_is_longest + ((x < y ? 1U : 0U) & (1 - z_is_longest));
  const CubeFace& face = faces[2 * axis + (std::signbit(d[axis]) ? 1 : 0)];
  return {&face, face.u_sign * d[face.u_axis], face.v_sign * d[face.v_axis], length};
}

}  // namespace cube

// From differences rounded to doubles. Depends on the ray alone when the center is (0, 0, 0):
// the quotients of two coordinates are rounded correctly, so points on one ray agree.
inline CubePosition cube_position(const Point& p, const Point& center) {
  const cube::CubeRay ray = cube::ray_of({p.x - center.x, p.y - center.y, p.z - center.z});
  if (!(ray.length > 0 && ray.length <= std::numeric_limits<double>::max())) return {};
  return {ray.face->rank, cube::position(ray.u / ray.length), cube::position(ray.v / ray.length)};
}

// From exact differences: depends on the exact ray alone for every center.
CubePosition exact_cube_position(const Point& p, const Point& center);

// The axes of a face of the cube, by its place in the order of the curve: u and v grow along the
// first two, `out` leads to the middle of the face.
struct CubeAxes {
  Point u;
  Point v;
  Point out;
};
CubeAxes cube_axes(unsigned face);

}  // namespace rondel::order
