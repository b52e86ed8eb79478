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

namespace {

// Replaces the corners of all faces.
void rename_corners(unsigned threads, std::span<const Index> names, std::span<Triple> faces) {
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, faces.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (f + system::prefetch_distance < end) {
        for (const Index name : faces[f + system::prefetch_distance]) {
          system::prefetch(&names[name]);
        }
      }
      for (Index& corner : faces[f]) corner = names[corner];
    }
  });
}

}  // namespace

ConstrainedFaces::ConstrainedFaces(std::span<const Point> sites, api::Parts& built,
                                   const Sphere& sphere, unsigned threads)
    : sphere_(sphere),
      sites_(sites),
      order_(std::move(built.order)),
      names_(order_),
      faces_(std::move(built.arrays.faces)),
      neighbors_(std::move(built.arrays.neighbors)),
      sides_(faces_.size()),
      states_(faces_.size()) {
  for (const Index f : built.arrays.ghost_faces) states_[f] = ghost_face;
  has_ghosts_ = !built.arrays.ghost_faces.empty();
  order::rename(names_, built.renamed);
  rank_names(threads);
}

void ConstrainedFaces::rank_names(unsigned threads) {
  ranks_.resize(sites_.size());
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, names_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank) {
      if (rank + system::prefetch_distance < end) {
        system::prefetch_to_write(&ranks_[names_[rank + system::prefetch_distance]]);
      }
      ranks_[names_[rank]] = static_cast<Index>(rank);
    }
  });
}

void ConstrainedFaces::find_faces() {
  face_at_.assign(is_by_rank_ ? names_.size() : sites_.size(), no_index);
  for (auto f = static_cast<Index>(faces_.size()); f-- > 0;) {
    if (!is_solid(f)) continue;
    const auto& [owner, v, w] = faces_[f];
    face_at_[owner] = f;
    face_at_[v] = face_at_[v] == no_index ? f : face_at_[v];
    face_at_[w] = face_at_[w] == no_index ? f : face_at_[w];
  }
}

void ConstrainedFaces::number_by_rank(unsigned threads) {
  is_by_rank_ = true;
  rename_corners(threads, ranks_, faces_);
  find_faces();
  is_touched_.resize(names_.size());
  directions_.resize(names_.size());
  constexpr std::size_t grain = 4096;
  system::parallel_for(threads, names_.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::array<Point, grain> points;
    for (std::size_t v = begin; v < end; ++v) {
      if (v + system::prefetch_distance < end) {
        system::prefetch(&sites_[order_[v + system::prefetch_distance]]);
      }
      points[v - begin] = sites_[order_[v]];
    }
    predicates::directions(std::span(points).first(end - begin), sphere_.center,
                           &directions_[begin]);
  });
}

// Lets a face that changed start with its owner, as all others do.
void ConstrainedFaces::start_with_owner(Index f) {
  const Triple face = faces_[f];
  const Triple neighbors = neighbors_[f];
  const Triple ranks = {rank_of_vertex(face[0]), rank_of_vertex(face[1]), rank_of_vertex(face[2])};
  const unsigned first = topology::first_corner(ranks);
  unsigned corner = first;
  for (unsigned i = 0; i < 3; ++i) {
    faces_[f][i] = face[corner];
    neighbors_[f][i] = neighbors[corner];
    corner = next_corner[corner];
  }
  const auto bits = static_cast<unsigned>(sides_[f]);
  sides_[f] = static_cast<std::uint8_t>((bits >> first | bits << (3 - first)) & 7U);
}

void ConstrainedFaces::give_back(unsigned threads, TriangulationArrays& arrays,
                                 std::vector<std::uint8_t>& sides) {
  if (is_by_rank_ && has_changes_) {
    for (Index f = 0; f < faces_.size(); ++f) {
      if (!is_changed(f)) continue;
      start_with_owner(f);
      is_touched_[faces_[f][0]] = 1;
    }
    const FacesToOrder all = {faces_, neighbors_, sides_, states_, is_touched_, names_};
    write_in_order(all, threads, arrays, sides);
    return;
  }
  if (is_by_rank_) {
    rename_corners(threads, names_, faces_);
  } else {
    for (const ChangedFace& changed : changed_) start_with_owner(changed.face);
    put_in_order({faces_, neighbors_, sides_, states_, ranks_}, threads, changed_,
                 arrays.ghost_faces);
  }
  arrays.faces = std::move(faces_);
  arrays.neighbors = std::move(neighbors_);
  sides = std::move(sides_);
}

// On which side of the great circle from a to b a vertex is: positive on the left.
Sign ConstrainedFaces::side(Index a, Index b, Index v) const {
  const Sign sign =
      is_by_rank_ ? predicates::sure_orientation(directions_[a], directions_[b], directions_[v])
                  : predicates::sure_orientation(direction(a), direction(b), direction(v));
  if (sign != Sign::zero) return sign;
  return orientation(point(a), point(b), point(v), sphere_);
}

// True if a vertex is inside the circle of three others.
bool ConstrainedFaces::is_in_circle(Index a, Index b, Index c, Index v) const {
  const Sign sign = is_by_rank_ ? predicates::sure_side_of_circle(directions_[a], directions_[b],
                                                                  directions_[c], directions_[v])
                                : predicates::sure_side_of_circle(direction(a), direction(b),
                                                                  direction(c), direction(v));
  if (sign != Sign::zero) return sign == Sign::positive;
  return is_in_conflict(point(a), point(b), point(c), point(v), Model::projected, sphere_);
}

Index ConstrainedFaces::opposite(Index h) const {
  const Triple& face = faces_[face_of(h)];
  const Index to = face[previous_corner[edge_of(h)]];
  const Index g = neighbors_[face_of(h)][edge_of(h)];
  return halfedge(g, previous_corner[topology::corner_of(faces_[g], to)]);
}

void ConstrainedFaces::link(Index h, Index g) {
  neighbors_[face_of(h)][edge_of(h)] = face_of(g);
  neighbors_[face_of(g)][edge_of(g)] = face_of(h);
}

void ConstrainedFaces::put_in_cavity(Index f) {
  has_changes_ = true;
  const Index owner = faces_[f][0];
  if (is_by_rank_) {
    if (!is_changed(f)) is_touched_[owner] = 1;
  } else if (!is_changed(f)) {
    changed_.push_back({f, ranks_[owner]});
  }
  states_[f] |= face_in_cavity | changed_face;
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

// Most edges are among the faces of their lower end, which follow each other. There is no branch on
// which corners those of an edge are: nothing predicts them.
bool ConstrainedFaces::constrain_edge(Index a, Index b) {
  const Triple* const faces = faces_.data();
  const Index low = ranks_[a] < ranks_[b] ? a : b;
  const Index high = a ^ b ^ low;
  const auto size = static_cast<Index>(faces_.size());
  for (Index f = face_at_[low]; f < size && faces[f][0] == low; ++f) {
    const auto is_second = static_cast<unsigned>(faces[f][1] == high);
    const auto is_third = static_cast<unsigned>(faces[f][2] == high);
    if ((is_second | is_third) == 0 || (has_ghosts_ && !is_solid(f))) continue;
    const unsigned edge = 2 - is_third;
    const Index g = neighbors_[f][edge];
    // The edge begins, in the face beyond, where it ends here.
    const Index first = is_second != 0 ? high : low;
    const auto bits = static_cast<unsigned>(faces[g][1] == first) |
                      static_cast<unsigned>(faces[g][2] == first) << 1U |
                      static_cast<unsigned>(faces[g][0] == first) << 2U;
    sides_[f] = static_cast<std::uint8_t>(sides_[f] | 1U << edge);
    sides_[g] = static_cast<std::uint8_t>(sides_[g] | bits);
    return true;
  }
  const Index edge = insertion_.edge_between(*this, low, high);
  if (edge != no_index) constrain(edge);
  return edge != no_index;
}

void ConstrainedFaces::constrain_edges(std::span<const std::array<Index, 2>> ends, Index first,
                                       std::vector<ConstrainedPiece>& others) {
  if (face_at_.empty()) find_faces();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i + system::prefetch_distance < ends.size()) {
      const Index f = face_at_[ends[i + system::prefetch_distance][0]];
      system::prefetch(&faces_[f]);
      system::prefetch(&neighbors_[f]);
      system::prefetch_to_write(&sides_[f]);
    }
    const auto& [a, b] = ends[i];
    if (constrain_edge(a, b)) continue;
    others.push_back(piece_between(ranks_[a], ranks_[b], static_cast<Index>(first + i)));
  }
}

std::optional<std::array<Index, 2>> ConstrainedFaces::insert(
    const ConstrainedPiece& arc, std::vector<ConstrainedPiece>& pieces) {
  const Index low = is_by_rank_ ? arc.low : names_[arc.low];
  const Index high = is_by_rank_ ? arc.high : names_[arc.high];
  const auto crossed = insertion_.insert(*this, low, high, [&](Index v, Index w) {
    pieces.push_back(piece_between(name_of(v), name_of(w), arc.constraint));
  });
  if (!crossed) return {};
  return std::array{name_of((*crossed)[0]), name_of((*crossed)[1])};
}

}  // namespace rondel::constrained
