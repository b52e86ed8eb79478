// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "hidden/face_walk.h"

#include <cmath>

#include "system/parallel.h"

namespace rondel::hidden {

FaceWalk::FaceWalk(std::span<const Point> sites, const Point& center,
                   const TriangulationArrays& arrays)
    : sites_(sites),
      center_(center),
      arrays_(arrays),
      frame_(sites, center),
      is_ghost_(arrays.ghost_faces.empty() ? 0 : arrays.faces.size(), false) {
  for (const Index f : arrays.ghost_faces) is_ghost_[f] = true;
  while (is_ghost(first_solid_)) ++first_solid_;
}

void FaceWalk::keep_cones(unsigned threads) {
  constexpr std::size_t grain = 4096;
  cones_.resize(arrays_.faces.size());
  system::parallel_for(threads, cones_.size(), grain, [this](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) cones_[f] = make_cone(static_cast<Index>(f));
  });
}

FaceWalk::Cone FaceWalk::make_cone(Index f) const {
  // A vector that is too short becomes zero: products with it decide nothing.
  const auto unit = [this](Index site) -> Vector {
    const Vector v = frame_.to(sites_[site]);
    const double squared = dot(v, v);
    if (!(squared > min_length * min_length)) return {};
    const double length = std::sqrt(squared);
    return {v.x / length, v.y / length, v.z / length};
  };
  const auto& [a, b, c] = arrays_.faces[f];
  const Vector u = unit(a);
  const Vector v = unit(b);
  const Vector w = unit(c);
  return {{cross(v, w), cross(w, u), cross(u, v)}};
}

Index FaceWalk::walk_by_guess(Index f, const Vector& v) const {
  constexpr int max_steps = 32;
  for (int step = 0; step < max_steps; ++step) {
    const Cone c = cones_.empty() ? make_cone(f) : cones_[f];
    std::size_t i = 0;
    while (i < 3 && !(dot(c.normal[i], v) < 0)) ++i;
    if (i == 3 || is_ghost(arrays_.neighbors[f][i])) return f;
    f = arrays_.neighbors[f][i];
  }
  return f;
}

// det(p-o, a-p, b-p) in the frame, whose scales are positive or make it zero: the errors are those
// of `orientation_bound`, and vectors so short that the frame's absolute error of 2^-374 would
// count prove nothing.
std::size_t FaceWalk::edge_by_corners(Index f, const Point& p, const Vector& v) const {
  const auto& [a, b, c] = arrays_.faces[f];
  const std::array<Vector, 3> to = {frame_.between(p, sites_[a]), frame_.between(p, sites_[b]),
                                    frame_.between(p, sites_[c])};
  const std::array<double, 3> squared = {dot(to[0], to[0]), dot(to[1], to[1]), dot(to[2], to[2])};
  const std::array<double, 3> value = {dot(v, cross(to[1], to[2])), dot(v, cross(to[2], to[0])),
                                       dot(v, cross(to[0], to[1]))};
  const double height = dot(v, v);
  const auto is_proven = [&](std::size_t i) {
    return predicates::is_beyond(value[i], predicates::orientation_bound, height,
                                 squared[(i + 1) % 3], squared[(i + 2) % 3]);
  };
  const std::size_t i = least_of(value);
  if (value[i] < 0) return is_proven(i) ? i : unsure;
  return is_proven(0) && is_proven(1) && is_proven(2) ? inside : unsure;
}

// On which side of the edges' planes p lies: positive inside.
std::array<Sign, 3> FaceWalk::exact_sides(Index f, const Point& p) const {
  const auto& [a, b, c] = arrays_.faces[f];
  const auto side = [&](Index from, Index to) {
    return predicates::orientation(sites_[from], sites_[to], p, center_).sign;
  };
  return {side(b, c), side(c, a), side(a, b)};
}

// p lies in the closed cone of f: on no edge, on one, on two (then its ray meets their
// common corner), or on all three (then it is the center).
FaceWalk::Result FaceWalk::first_of_cones(Index f, const std::array<Sign, 3>& side) const {
  const auto zeros = std::ranges::count(side, Sign::zero);
  if (zeros == 0) return {f, f};
  if (zeros == 3) return {f, first_solid_};
  if (zeros == 2) return {f, no_index, arrays_.faces[f][index_of(side, Sign::positive)]};
  const Index neighbor = arrays_.neighbors[f][index_of(side, Sign::zero)];
  return {f, is_ghost(neighbor) ? f : std::min(f, neighbor)};
}

}  // namespace rondel::hidden
