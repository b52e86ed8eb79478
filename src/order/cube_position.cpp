// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/cube_position.h"

#include <algorithm>
#include <array>

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

}  // namespace

CubePosition exact_cube_position(const Point& p, const Point& center) {
  using exact::Integer;
  const auto v = exact::scaled_rays({p}, center).front();
  const std::array<Integer, 3> d = {v.x, v.y, v.z};
  const unsigned axis = longest_axis(d);
  const Integer length = abs(d[axis]);
  const cube::CubeFace& face = cube::faces[2 * axis + (d[axis] < 0 ? 1 : 0)];
  const auto position = [&](unsigned along, int sign) {
    const Integer steps = ((sign * d[along] + length) << (position_bits - 1)) / length;
    return std::min(static_cast<std::uint64_t>(steps), cube::last_position);
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
