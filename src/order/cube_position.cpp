// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/cube_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "exact/integer.h"

namespace rondel::order {
namespace {

unsigned longest_axis(const std::array<exact::Integer, 3>& d) {
  unsigned axis = 0;
  for (unsigned i = 1; i < 3; ++i) {
    if (abs(d[axis]) < abs(d[i])) axis = i;
  }
  return axis;
}

// floor((along/length + 1) 2^51), where the quotient of two doubles rounds to that: it does not round
// across a multiple of 2^-51, but may round to one from below. The remainder tells. It is exact, or
// at least of the right sign, for a length above 2^-800.
std::uint64_t position_of_doubles(double along, double length) {
  const double quotient = along / length;
  const double steps = quotient * 0x1p51;
  double whole = std::floor(steps);
  if (whole == steps && std::fma(-quotient, length, along) < 0) --whole;
  const auto position = static_cast<std::int64_t>(whole) + (std::int64_t{1} << (position_bits - 1));
  return std::min(static_cast<std::uint64_t>(position), cube::last_position);
}

}  // namespace

CubePosition exact_cube_position(const Point& p, const Point& center) {
  if (center == Point{}) {
    const cube::CubeRay ray = cube::ray_of({p.x, p.y, p.z});
    if (ray.length > 0x1p-800) {
      return {ray.face->rank, position_of_doubles(ray.u, ray.length),
              position_of_doubles(ray.v, ray.length)};
    }
  }
  using exact::Integer;
  const auto v = exact::scaled_rays({p}, center).front();
  const std::array<Integer, 3> d = {v.x, v.y, v.z};
  const unsigned axis = longest_axis(d);
  const Integer length = abs(d[axis]);
  const cube::CubeFace& face = cube::faces[2 * axis + (d[axis] < 0 ? 1 : 0)];
  const auto position = [&](unsigned along, int sign) {
    const Integer steps = ((sign * d[along] + length) << (position_bits - 1)) / length;
    return std::min(steps.low_word(), cube::last_position);
  };
  return {face.rank, position(face.u_axis, face.u_sign), position(face.v_axis, face.v_sign)};
}

CubeAxes cube_axes(unsigned face) {
  const auto along = [](unsigned axis, double sign) {
    return Point{axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
  };
  for (unsigned i = 0; i < cube::faces.size(); ++i) {
    const cube::CubeFace& f = cube::faces[i];
    if (f.rank != face) continue;
    return {along(f.u_axis, f.u_sign), along(f.v_axis, f.v_sign),
            along(i / 2, i % 2 == 0 ? 1 : -1)};
  }
  return {};
}

}  // namespace rondel::order
