// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A hull that changes, in dimension 2, one for builds, for sites that come and go (place_hull.h),
// and for both models. An insertion (the paper, section 4) locates a face in conflict with the new
// site, finds the conflict region by depth-first search, and replaces it by the star of the site.
// Sites that are in conflict with no face are hidden.
//
// The first hull is flat: three sites that span a plane not through the center, as two faces
// back to back. Any further site is in conflict with exactly one of them,
// ties being broken, and the hull becomes a body. Nothing has to surround the
// center, and no dummy points are needed.
#pragma once

#include <array>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "kernel/conflict_region.h"
#include "kernel/conflict_test.h"
#include "kernel/walk.h"
#include "models/sphere_traits.h"
#include "predicates/orientation.h"
#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::kernel {

template <models::SphereTraits T>
class MutableHull {
 public:
  // Where a walk may start: a solid face, and an entry face if there is one.
  struct Start {
    Index solid = no_index;
    Index entry = no_index;
  };

  // `first` are three sites with a non-zero orientation. Makes room for the faces of all sites.
  MutableHull(T& sites, std::array<Index, 3> first) : test_(sites) {
    if (predicates::orientation(sites, first[0], first[1], first[2]).sign == Sign::negative) {
      std::swap(first[1], first[2]);
    }
    mesh_.reserve(2 * static_cast<std::size_t>(sites.size()));
    const auto [top, bottom] = topology::flat_pair(mesh_, first);
    adopt(top);
    adopt(bottom);
  }
  // The finished mesh of a build.
  MutableHull(T& sites, topology::Mesh mesh) : test_(sites), mesh_(std::move(mesh)) {
    mesh_.for_each_face([this](Index f) { adopt(f); });
  }

  [[nodiscard]] const T& sites() const { return test_.sites(); }
  [[nodiscard]] const topology::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] topology::Mesh& mesh() { return mesh_; }
  [[nodiscard]] const FaceKinds& kinds() const { return kinds_; }
  [[nodiscard]] const Start& start() const { return start_; }
  [[nodiscard]] ConflictTest<T>& test() { return test_; }
  // Returns the tally of all conflict tests.
  [[nodiscard]] const Tally& tally() const { return test_.tally(); }

  // Inserts a site during a build. There the face that hides a site is not needed, and the next
  // site is close, so its walks start from the faces above and below this one.
  void insert(Index p) {
    const auto found = locate(p, start_);
    if (found.conflict != no_index) {
      insert(p, found.conflict, [](const auto& /*region*/) {});
      return;
    }
    start_.solid = found.solid;
    if (found.entry != no_index) start_.entry = found.entry;
  }

  [[nodiscard]] typename Walk<T>::Found locate(Index p, const Start& start) {
    return Walk<T>(test_, mesh_, kinds_).locate(p, start.solid, start.entry);
  }

  [[nodiscard]] Index face_on_ray(Index p, Index solid) {
    return Walk<T>(test_, mesh_, kinds_).face_on_ray(p, solid);
  }

  // Replaces the faces in conflict with p, of which `conflict` is one, by the star of p, whose
  // faces are returned. Before they go, release(region) is told them.
  template <class Release>
  std::span<const Index> insert(Index p, Index conflict, const Release& release) {
    region_.find(test_, mesh_, p, conflict);
    assert(region_.horizon().size() >= 3);
    release(std::as_const(region_));
    // Once the center is strictly inside, insertions leave it there.
    if (kinds_.all_solid()) {
      topology::star(mesh_, p, region_.horizon(), region_.faces());
      start_.solid = region_.faces().front();
      return region_.faces();
    }
    for (const Index f : region_.faces()) forget(f);
    topology::star(mesh_, p, region_.horizon(), region_.faces());
    for (const Index f : region_.faces()) adopt(f);
    for (const auto& edge : region_.horizon()) restart_beside(edge.outside);
    return region_.faces();
  }

  // For whoever replaces a star by other faces: faces that go, before they do, and that came; then,
  // for all edges around them, the halfedges outside.
  void forget(Index f) {
    if (f == start_.entry) start_.entry = no_index;
    if (f == start_.solid) start_.solid = no_index;
    kinds_.remove(f);
  }
  void adopt(Index f) {
    const auto& v = mesh_[f].vertex;
    const FaceKind kind = kind_of(predicates::orientation(sites(), v[0], v[1], v[2]).sign);
    kinds_.add(f, kind);
    if (kind == FaceKind::solid) start_.solid = f;
    if (kind == FaceKind::entry) start_.entry = f;
  }
  // A solid (entry) face can only vanish with a star if one next to the star, or one that replaces
  // it, is solid (entry): the faces of one kind are connected by their edges.
  void restart_beside(topology::Halfedge outside) {
    const Index f = topology::face_of(outside);
    if (start_.solid == no_index && kinds_[f] == FaceKind::solid) start_.solid = f;
    if (start_.entry == no_index && kinds_[f] == FaceKind::entry) start_.entry = f;
  }

  // Takes the same faces under new numbers, which are given by the old ones.
  void renumber(topology::Mesh mesh, std::span<const Index> new_face) {
    mesh_ = std::move(mesh);
    start_.solid = new_face[start_.solid];
    if (start_.entry != no_index) start_.entry = new_face[start_.entry];
    const FaceKinds kinds = std::exchange(kinds_, {});
    for (Index f = 0; f < new_face.size() && !kinds.all_solid(); ++f) {
      if (new_face[f] != no_index) kinds_.add(new_face[f], kinds[f]);
    }
  }

 private:
  ConflictTest<T> test_;
  topology::Mesh mesh_;
  FaceKinds kinds_;
  Start start_;
  ConflictRegion<T> region_;
};

}  // namespace rondel::kernel
