// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "exact/vector.h"
#include "interpolation/linear.h"

namespace rondel::interpolation {
namespace {

using topology::next_corner;
using topology::previous_corner;

// Returns the distance of c from the great circle through c + to_a and c + to_b, times the sine of
// their angle, as det(c, to_a, to_b).
double height_times_side(const exact::SplitPoint& c, const Vec& to_a, const Vec& to_b) {
  return std::abs(dot(exact::to_vector(c.hi), cross(to_a, to_b)));
}

// Returns the sine of the angle between a and b, of which the steps from a third point are given.
double sine_between(const exact::SplitPoint& a, const Vec& to_a, const Vec& to_b) {
  return norm(cross(exact::to_vector(a.hi), to_b - to_a));
}

// Returns the longest side of a face that is flat by its shape. A flat face has a corner c between the
// other two. Where all three sides are longer than 90 degrees and on one great circle, the face is half of
// the sphere, and no corner is between others.
std::optional<unsigned> flat_side_of(const std::array<exact::SplitPoint, 3>& corners) {
  const std::array<Vec, 3> sides = {step(corners[1], corners[2]), step(corners[2], corners[0]),
                                    step(corners[0], corners[1])};
  std::array<double, 3> squares{};
  for (unsigned i = 0; i < 3; ++i) squares[i] = dot(sides[i], sides[i]);
  if (std::ranges::min(squares) <= min_flat_side * min_flat_side) return std::nullopt;
  const auto longest = static_cast<unsigned>(std::ranges::max_element(squares) - squares.begin());
  const unsigned a = next_corner[longest];
  const unsigned b = previous_corner[longest];
  const Vec to_a = sides[b];
  const Vec to_b = -1.0 * sides[a];
  if (dot(to_a, to_b) >= 0) return std::nullopt;
  const double sine = sine_between(corners[a], to_a, to_b);
  const bool is_flat = height_times_side(corners[longest], to_a, to_b) <= max_flat_height * sine;
  return is_flat ? std::optional(longest) : std::nullopt;
}

// Finds the flat faces from the border inwards: those behind the two shorter sides of a flat face are
// next. corners_of(f) returns the unit vectors of the corners of a face.
template <class CornersOf>
std::vector<Index> flat_faces(const Triangulation& triangulation, const CornersOf& corners_of) {
  const auto neighbors = triangulation.neighbors();
  std::vector<std::pair<Index, unsigned>> open;  // sides of solid faces, towards the outside
  const auto open_from = [&](Index outside) {
    for (const Index f : neighbors[outside]) {
      if (triangulation.is_ghost(f)) continue;
      for (unsigned i = 0; i < 3; ++i) {
        if (neighbors[f][i] == outside) open.emplace_back(f, i);
      }
    }
  };
  for (const Index ghost : triangulation.ghost_faces()) open_from(ghost);
  std::vector<Index> flat;
  std::vector<bool> are_flat(open.empty() ? 0 : triangulation.num_faces());
  while (!open.empty()) {
    const auto [f, side] = open.back();
    open.pop_back();
    if (are_flat[f] || flat_side_of(corners_of(f)) != side) continue;
    are_flat[f] = true;
    flat.push_back(f);
    open_from(f);
  }
  std::ranges::sort(flat);
  return flat;
}

}  // namespace

std::vector<Index> flat_faces_of(const Triangulation& triangulation) {
  return flat_faces(triangulation, [&](Index f) {
    std::array<exact::SplitPoint, 3> corners{};
    exact::unit_vectors(triangulation.sites().points(), triangulation.faces()[f],
                        triangulation.sphere().center, corners.data());
    return corners;
  });
}

FlatFaces::FlatFaces(const Triangulation& triangulation, const topology::Mesh& mesh,
                     std::span<const exact::SplitPoint> units)
    : triangulation_(&triangulation), mesh_(&mesh), units_(units) {
  const std::vector<Index> flat = flat_faces(triangulation, [&](Index f) { return corners_of(f); });
  if (flat.empty()) return;
  are_flat_.resize(triangulation.num_faces());
  for (const Index f : flat) are_flat_[f] = true;
}

std::array<exact::SplitPoint, 3> FlatFaces::corners_of(Index face) const {
  const auto& v = (*mesh_)[face].vertex;
  return {units_[v[0]], units_[v[1]], units_[v[2]]};
}

std::optional<unsigned> FlatFaces::flat_side(Index face) const {
  return flat_side_of(corners_of(face));
}

Location FlatFaces::on_edge(Index face, unsigned edge) const {
  const auto& v = (*mesh_)[face].vertex;
  const auto [low, high] = std::minmax(v[next_corner[edge]], v[previous_corner[edge]]);
  return {Where::edge, face, {low, high, no_index}};
}

// Each step leads to a side that is shorter than the one before.
Location FlatFaces::on_chain(Index face, const exact::SplitPoint& unit) const {
  for (;;) {
    const unsigned longest = *flat_side(face);
    const auto& v = (*mesh_)[face].vertex;
    const unsigned a = next_corner[longest];
    const unsigned b = previous_corner[longest];
    const Vec to_c = step(unit, units_[v[longest]]);
    const bool is_beside_b = dot(to_c, step(units_[v[a]], units_[v[b]])) < 0;
    const unsigned exit = is_beside_b ? a : b;
    const topology::Halfedge inside = (*mesh_)[face].opposite[exit];
    const Index next = topology::face_of(inside);
    if (contains(next) && flat_side(next) == topology::edge_of(inside)) {
      face = next;
      continue;
    }
    const bool is_inner = !triangulation_->is_ghost(next) && !contains(next);
    return is_inner ? on_edge(next, topology::edge_of(inside)) : on_edge(face, exit);
  }
}

std::optional<unsigned> FlatFaces::edge_beside(Index face, const exact::SplitPoint& unit) const {
  const topology::Face& corners = (*mesh_)[face];
  for (unsigned i = 0; i < 3; ++i) {
    if (!contains(topology::face_of(corners.opposite[i]))) continue;
    const exact::SplitPoint& a = units_[corners.vertex[next_corner[i]]];
    const exact::SplitPoint& b = units_[corners.vertex[previous_corner[i]]];
    const Vec to_a = step(unit, a);
    const Vec to_b = step(unit, b);
    const double most = max_flat_height * sine_between(a, to_a, to_b);
    if (dot(to_a, to_b) < 0 && height_times_side(unit, to_a, to_b) <= most) return i;
  }
  return std::nullopt;
}

Location FlatFaces::location_beside(const LocatedTarget& place) const {
  const Location& location = place.location;
  if (empty() || location.where != Where::face) return location;
  const auto edge = edge_beside(location.face, place.unit);
  return edge ? on_edge(location.face, *edge) : location;
}

}  // namespace rondel::interpolation
