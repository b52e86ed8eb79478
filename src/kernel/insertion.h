// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The incremental algorithm (the paper, section 4), one for both models: locate a face in
// conflict with the new site, find the conflict region by depth-first search,
// replace it by the star of the site. Sites that are in conflict with no face are hidden.
//
// The first hull is flat: three sites that span a plane not through the center, as two faces
// back to back. Any further site is in conflict with exactly one of them,
// ties being broken, and the hull becomes a body. Nothing has to surround the
// center, and no dummy points are needed.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
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
class Insertion {
 public:
  // `first` are three sites with a non-zero orientation.
  Insertion(T& sites, std::array<Index, 3> first) : test_(sites) {
    mesh_.reserve(2 * static_cast<std::size_t>(sites.size()));
    if (predicates::orientation(sites, first[0], first[1], first[2]).sign == Sign::negative) {
      std::swap(first[1], first[2]);
    }
    const auto [top, bottom] = topology::flat_pair(mesh_, first);
    kinds_.add(top, FaceKind::solid);
    kinds_.add(bottom, FaceKind::entry);
    solid_ = top;
    entry_ = bottom;
  }

  void insert(Index p) {
    const Index start = Walk<T>(test_, mesh_, kinds_).locate(p, solid_, entry_).conflict;
    if (start == no_index) return;
    region_.find(test_, mesh_, p, start);
    assert(region_.horizon().size() >= 3);
    if (!tracks_kinds_) {
      topology::star(mesh_, p, region_.horizon(), region_.faces());
      solid_ = region_.faces().front();
      return;
    }
    for (const Index f : region_.faces()) kinds_.remove(f);
    topology::star(mesh_, p, region_.horizon(), region_.faces());
    classify_star();
  }

  [[nodiscard]] const topology::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] topology::Mesh& mesh() { return mesh_; }
  [[nodiscard]] const FaceKinds& kinds() const { return kinds_; }
  // Of all conflict tests.
  [[nodiscard]] const Tally& tally() const { return test_.tally(); }

 private:
  // Where the walks start next. A solid (entry) face can only vanish if the star has one too:
  // what it covers, seen from the center, is covered by the star afterwards.
  void classify_star() {
    entry_ = entry_ != no_index && is_current(entry_, FaceKind::entry) ? entry_ : no_index;
    for (const Index f : region_.faces()) {
      const auto& v = mesh_[f].vertex;
      const FaceKind kind = kind_of(predicates::orientation(test_.sites(), v[0], v[1], v[2]).sign);
      kinds_.add(f, kind);
      if (kind == FaceKind::solid) solid_ = f;
      if (kind == FaceKind::entry) entry_ = f;
    }
    if (kinds_.all_solid()) {
      tracks_kinds_ = false;
      kinds_.release();
    }
  }

  // Whether f still has the kind it is remembered for: it may be a removed or reused slot.
  [[nodiscard]] bool is_current(Index f, FaceKind kind) const {
    const std::vector<Index>& star = region_.faces();
    return mesh_.is_alive(f) && std::find(star.begin(), star.end(), f) == star.end() &&
           kinds_[f] == kind;
  }

  ConflictTest<T> test_;
  topology::Mesh mesh_;
  FaceKinds kinds_;
  bool tracks_kinds_ = true;
  Index solid_ = no_index;
  Index entry_ = no_index;
  ConflictRegion<T> region_;
};

}  // namespace rondel::kernel
