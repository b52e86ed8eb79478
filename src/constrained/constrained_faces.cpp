// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/constrained_faces.h"

#include <algorithm>
#include <array>
#include <utility>

#include "order/renamed.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "rondel/predicates.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "topology/canonical_order.h"
#include "topology/mesh.h"

namespace rondel::constrained {

using topology::edge_of;
using topology::face_of;
using topology::halfedge;
using topology::next_corner;
using topology::previous_corner;

ConstrainedFaces::ConstrainedFaces(std::span<const Point> sites, api::Parts& built,
                                   const Sphere& sphere, unsigned threads)
    : sphere_(sphere),
      sites_(sites),
      order_(std::move(built.order)),
      names_(order_),
      faces_(std::move(built.arrays.faces)),
      neighbors_(std::move(built.arrays.neighbors)),
      sides_(faces_.size()),
      states_(faces_.size()),
      is_touched_(order_.size()) {
  for (const Index f : built.arrays.ghost_faces) states_[f] = ghost_face;
  order::rename(names_, built.renamed);
  number_vertices(threads);
  rename_corners(threads, vertices_);
  face_at_.resize(names_.size());
  for (Index f = 0; f < faces_.size(); ++f) {
    if (!is_solid(f)) continue;
    for (const Index v : faces_[f]) face_at_[v] = f;
  }
}

void ConstrainedFaces::number_vertices(unsigned threads) {
  vertices_.resize(sites_.size());
  directions_.resize(names_.size());
  constexpr std::size_t grain = 4096;
  system::parallel_for(threads, names_.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::array<Point, grain> points;
    for (std::size_t v = begin; v < end; ++v) {
      if (v + system::prefetch_distance < end) {
        system::prefetch_to_write(&vertices_[names_[v + system::prefetch_distance]]);
        system::prefetch(&sites_[order_[v + system::prefetch_distance]]);
      }
      vertices_[names_[v]] = static_cast<Index>(v);
      points[v - begin] = sites_[order_[v]];
    }
    predicates::directions(std::span(points).first(end - begin), sphere_.center,
                           &directions_[begin]);
  });
}

// Replaces the corners of all faces.
void ConstrainedFaces::rename_corners(unsigned threads, std::span<const Index> names) {
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, faces_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (f + system::prefetch_distance < end) {
        for (const Index name : faces_[f + system::prefetch_distance]) {
          system::prefetch(&names[name]);
        }
      }
      for (Index& corner : faces_[f]) corner = names[corner];
    }
  });
}

FacesToOrder ConstrainedFaces::to_order() {
  for (Index f = 0; f < faces_.size(); ++f) {
    if (!is_changed(f)) continue;
    const unsigned first = topology::first_corner(faces_[f]);
    const Triple face = faces_[f];
    const Triple neighbors = neighbors_[f];
    unsigned corner = first;
    for (unsigned i = 0; i < 3; ++i) {
      faces_[f][i] = face[corner];
      neighbors_[f][i] = neighbors[corner];
      corner = next_corner[corner];
    }
    const auto bits = static_cast<unsigned>(sides_[f]);
    sides_[f] = static_cast<std::uint8_t>((bits >> first | bits << (3 - first)) & 7U);
    is_touched_[faces_[f][0]] = 1;
  }
  return {faces_, neighbors_, sides_, states_, is_touched_, names_};
}

void ConstrainedFaces::give_back(TriangulationArrays& arrays) {
  rename_corners(1, names_);
  arrays.faces = std::move(faces_);
  arrays.neighbors = std::move(neighbors_);
}

// On which side of the great circle from a to b a vertex is: positive on the left.
Sign ConstrainedFaces::side(Index a, Index b, Index v) const {
  const Sign sign = predicates::sure_orientation(directions_[a], directions_[b], directions_[v]);
  if (sign != Sign::zero) return sign;
  return orientation(point(a), point(b), point(v), sphere_);
}

// True if a vertex is inside the circle of three others.
bool ConstrainedFaces::is_in_circle(Index a, Index b, Index c, Index v) const {
  const Sign sign = predicates::sure_side_of_circle(directions_[a], directions_[b], directions_[c],
                                                    directions_[v]);
  if (sign != Sign::zero) return sign == Sign::positive;
  return is_in_conflict(point(a), point(b), point(c), point(v), Model::projected, sphere_);
}

Index ConstrainedFaces::opposite(Index h) const {
  const Triple& face = faces_[face_of(h)];
  const Index from = face[next_corner[edge_of(h)]];
  const Index to = face[previous_corner[edge_of(h)]];
  const Index g = neighbors_[face_of(h)][edge_of(h)];
  unsigned j = 0;
  while (faces_[g][next_corner[j]] != to || faces_[g][previous_corner[j]] != from) ++j;
  return halfedge(g, j);
}

void ConstrainedFaces::link(Index h, Index g) {
  neighbors_[face_of(h)][edge_of(h)] = face_of(g);
  neighbors_[face_of(g)][edge_of(g)] = face_of(h);
}

void ConstrainedFaces::put_in_cavity(Index f) {
  has_changes_ = true;
  if (!is_changed(f)) is_touched_[faces_[f][0]] = 1;
  states_[f] |= face_in_cavity;
}

void ConstrainedFaces::replace(Index f, const Triple& corners) {
  faces_[f] = corners;
  sides_[f] = 0;
  states_[f] = changed_face;
  for (const Index v : corners) face_at_[v] = f;
}

void ConstrainedFaces::constrain_side(Index h) {
  sides_[face_of(h)] = static_cast<std::uint8_t>(sides_[face_of(h)] | 1U << edge_of(h));
}

void ConstrainedFaces::constrain(Index h) {
  constrain_side(h);
  constrain_side(opposite(h));
}

std::optional<std::array<Index, 2>> ConstrainedFaces::insert(
    const ConstrainedPiece& arc, std::vector<ConstrainedPiece>& pieces) {
  const auto crossed = insertion_.insert(*this, arc.low, arc.high, [&](Index v, Index w) {
    pieces.push_back(piece_between(names_[v], names_[w], arc.constraint));
  });
  if (!crossed) return {};
  return std::array{names_[(*crossed)[0]], names_[(*crossed)[1]]};
}

}  // namespace rondel::constrained
