// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that insertion and removal of places share, and constraints.

#include "constrained/constrained_hull.h"

#include <algorithm>
#include <utility>

#include "system/large_arrays.h"

namespace rondel::constrained {

using topology::edge_of;
using topology::face_of;
using topology::Halfedge;
using topology::halfedge;
using topology::next_corner;
using topology::previous_corner;

ConstrainedHull::ConstrainedHull(PlaceDirections& sites, const std::array<Index, 3>& first)
    : sites_(sites) {
  const auto& [a, b, c] = first;
  const bool is_positive = side(a, b, c) == Sign::positive;
  const auto [top, bottom] =
      topology::flat_pair(mesh_, is_positive ? first : std::array<Index, 3>{a, c, b});
  adopt(top);
  adopt(bottom);
}

ConstrainedHull::ConstrainedHull(PlaceDirections& sites, topology::Mesh mesh)
    : sites_(sites), mesh_(std::move(mesh)) {
  mesh_.for_each_face([this](Index f) { adopt(f); });
}

ConstrainedHull::Edge ConstrainedHull::ends_of(Halfedge h) const {
  const Triple& v = mesh_[face_of(h)].vertex;
  return {v[next_corner[edge_of(h)]], v[previous_corner[edge_of(h)]]};
}

void ConstrainedHull::set_side(Halfedge h, bool is_constrained) {
  const unsigned bit = 1U << edge_of(h);
  const auto bits = static_cast<unsigned>(sides_[face_of(h)]);
  sides_[face_of(h)] = static_cast<std::uint8_t>(is_constrained ? bits | bit : bits & ~bit);
}

void ConstrainedHull::set_sides(Halfedge h, bool is_constrained) {
  set_side(h, is_constrained);
  set_side(opposite(h), is_constrained);
}

void ConstrainedHull::set_corners(Index f) {
  const Triple& v = mesh_[f].vertex;
  for (unsigned i = 0; i < 3; ++i) {
    if (v[i] >= corner_of_.size()) corner_of_.resize(v[i] + std::size_t{1}, no_index);
    corner_of_[v[i]] = halfedge(f, i);
  }
}

void ConstrainedHull::adopt(Index f) {
  if (f >= sides_.size()) sides_.resize(f + std::size_t{1});
  sides_[f] = 0;
  const Triple& v = mesh_[f].vertex;
  const kernel::FaceKind kind = kernel::kind_of(side(v[0], v[1], v[2]));
  kinds_.add(f, kind);
  if (kind != kernel::FaceKind::solid) return;
  set_corners(f);
  solid_face_ = f;
}

void ConstrainedHull::replace(Index f, const Triple& corners) {
  mesh_[f].vertex = corners;
  sides_[f] = 0;
  set_corners(f);
  solid_face_ = f;
}

void ConstrainedHull::renumber(const dynamic::Renumbering& places) {
  dynamic::RenumberedMesh renumbered = dynamic::renumber(mesh_, places);
  const std::vector<Index>& new_face = renumbered.new_face;
  const kernel::FaceKinds kinds = std::exchange(kinds_, {});
  const std::vector<std::uint8_t> sides = std::exchange(sides_, {});
  mesh_ = std::move(renumbered.mesh);
  sides_.resize(mesh_.num_slots());
  corner_of_ = {};
  system::reserve_large(corner_of_, places.room());
  corner_of_.assign(places.old_place.size(), no_index);
  for (Index f = 0; f < new_face.size(); ++f) {
    if (new_face[f] == no_index) continue;
    sides_[new_face[f]] = sides[f];
    kinds_.add(new_face[f], kinds[f]);
    if (kinds[f] == kernel::FaceKind::solid) set_corners(new_face[f]);
  }
  solid_face_ = new_face[solid_face_];
  Sources sources;
  for (auto& [edge, constraints] : sources_) {
    sources.emplace(edge_between(places.new_place[edge[0]], places.new_place[edge[1]]),
                    std::move(constraints));
  }
  sources_ = std::move(sources);
}

void ConstrainedHull::adopt_constraints(std::span<const std::uint8_t> sides, Sources sources) {
  sides_.assign(sides.begin(), sides.end());
  sources_ = std::move(sources);
  has_constraints_ = true;
}

void ConstrainedHull::insert_constraint(Index a, Index b, Index constraint) {
  insertion_.insert(*this, a, b,
                    [&](Index v, Index w) { sources_[edge_between(v, w)].push_back(constraint); });
}

void ConstrainedHull::remove_constraint(Index a, Index b, Index constraint) {
  while (a != b) {
    const Departure step = ArcInsertion<ConstrainedHull>::departure(*this, a, b);
    const Index end = ArcInsertion<ConstrainedHull>::end_along(*this, a, step.halfedge);
    const auto piece = sources_.find(edge_between(a, end));
    std::vector<Index>& constraints = piece->second;
    constraints.erase(std::ranges::find(constraints, constraint));
    if (constraints.empty()) {
      sources_.erase(piece);
      release(step.halfedge);
    }
    a = end;
  }
}

std::vector<Index> ConstrainedHull::chain(Index a, Index b) const {
  std::vector<Index> from_first = {a};
  std::vector<Index> from_last = {b};
  while (a != b) {
    // Whichever end has the smaller degree goes on.
    const Departure step = ArcInsertion<ConstrainedHull>::departure(*this, a, b);
    const Index end = ArcInsertion<ConstrainedHull>::end_along(*this, a, step.halfedge);
    (from_first.back() == a ? from_first : from_last).push_back(end);
    a = end;
  }
  from_first.pop_back();
  from_first.insert(from_first.end(), from_last.rbegin(), from_last.rend());
  return from_first;
}

// Lets an edge be free, and replaces it and what is around it if it is not locally Delaunay.
void ConstrainedHull::release(Halfedge h) {
  set_sides(h, false);
  const Halfedge beyond = opposite(h);
  if (!is_solid(face_of(h)) || !is_solid(face_of(beyond))) return;
  const Index apex = mesh_[face_of(beyond)].vertex[edge_of(beyond)];
  if (is_in_conflict(face_of(h), apex)) removal_.run(*this, h);
}

}  // namespace rondel::constrained
