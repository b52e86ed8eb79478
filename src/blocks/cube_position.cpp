// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "blocks/cube_position.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/eft.h"
#include "exact/integer.h"

namespace rondel::blocks {
namespace {

// The faces in the order of the curve, and their axes, chosen so that the curve leaves a face
// where it enters the next one. Indexed by 2*axis + (1 on the negative side).
struct CubeFace {
  unsigned rank;
  unsigned u_axis;
  int u_sign;
  unsigned v_axis;
  int v_sign;
};
constexpr std::array<CubeFace, 6> cube_faces = {{{2, 1, 1, 2, 1},
                                                 {4, 2, 1, 1, -1},
                                                 {3, 0, -1, 2, 1},
                                                 {0, 0, -1, 2, 1},
                                                 {5, 0, 1, 1, -1},
                                                 {1, 0, 1, 1, 1}}};

constexpr std::uint64_t last_position = (std::uint64_t{1} << position_bits) - 1;
constexpr double half_range = 0x1p51;  // position_bits - 1

std::uint64_t to_position(double ratio) {
  return std::min(static_cast<std::uint64_t>((ratio + 1) * half_range), last_position);
}

template <class T, class Size>
unsigned longest_axis(const std::array<T, 3>& d, Size size) {
  unsigned axis = 0;
  for (unsigned i = 1; i < 3; ++i) {
    if (size(d[axis]) < size(d[i])) axis = i;
  }
  return axis;
}

}  // namespace

CubePosition cube_position(const Point& p, const Point& center) {
  const std::array<double, 3> d = {p.x - center.x, p.y - center.y, p.z - center.z};
  const unsigned axis = longest_axis(d, [](double v) { return std::abs(v); });
  const double length = std::abs(d[axis]);
  if (!(length > 0 && std::isfinite(length))) return {};
  const CubeFace& face = cube_faces[2 * axis + (d[axis] < 0 ? 1 : 0)];
  return {face.rank, to_position(face.u_sign * (d[face.u_axis] / length)),
          to_position(face.v_sign * (d[face.v_axis] / length))};
}

CubePosition exact_cube_position(const Point& p, const Point& center) {
  using exact::Integer;
  const auto v = exact::scaled_rays({p}, center).front();
  const std::array<Integer, 3> d = {v.x, v.y, v.z};
  const unsigned axis = longest_axis(d, [](const Integer& c) { return Integer(abs(c)); });
  const Integer length = abs(d[axis]);
  const CubeFace& face = cube_faces[2 * axis + (d[axis] < 0 ? 1 : 0)];
  const auto position = [&](unsigned along, int sign) {
    const Integer steps = ((sign * d[along] + length) << (position_bits - 1)) / length;
    return std::min(static_cast<std::uint64_t>(steps), last_position);
  };
  return {face.rank, position(face.u_axis, face.u_sign), position(face.v_axis, face.v_sign)};
}

}  // namespace rondel::blocks
