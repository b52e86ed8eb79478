// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The hull of places that come and go (a place: what duplicates share), in dimension 2: the
// incremental algorithm's insertion, and removal by triangulating the link of the vertex.
//
// Invariant between operations: the mesh is the hull of the perturbed places; each place that is
// not a vertex is attached to the faces that hide it.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "dynamic/hidden_sites.h"
#include "dynamic/link_triangulation.h"
#include "dynamic/renumbering.h"
#include "kernel/brio.h"
#include "kernel/conflict_region.h"
#include "kernel/conflict_test.h"
#include "kernel/walk.h"
#include "models/sphere_traits.h"
#include "order/cube_position.h"
#include "order/hilbert.h"
#include "predicates/orientation.h"
#include "system/prefetch.h"
#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

template <models::SphereModel T>
class Hull {
 public:
  // `first` are three places with a non-zero orientation.
  Hull(T& sites, std::array<Index, 3> first) : test_(sites) {
    if (predicates::orientation(sites, first[0], first[1], first[2]).sign == Sign::negative) {
      std::swap(first[1], first[2]);
    }
    const auto [top, bottom] = topology::flat_pair(mesh_, first);
    adopt(top, false);
    adopt(bottom, false);
  }

  // The finished mesh of a build, its vertices renamed to places. Places that are hidden follow by
  // attach_hidden.
  Hull(T& sites, topology::Mesh mesh) : test_(sites), mesh_(std::move(mesh)) {
    for (Index f = 0; f < mesh_.num_slots(); ++f) {
      if (mesh_.is_alive(f)) adopt(f, false);
    }
  }

  [[nodiscard]] const topology::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const kernel::FaceKinds& kinds() const { return kinds_; }
  [[nodiscard]] const HiddenSites& hidden() const { return hidden_; }
  [[nodiscard]] std::size_t num_vertices() const { return mesh_.num_faces() / 2 + 2; }
  [[nodiscard]] bool is_vertex(Index p) const {
    return p < corner_of_.size() && corner_of_[p] != no_index;
  }
  // A corner of each vertex, as 3*face + corner.
  [[nodiscard]] std::span<const topology::Halfedge> corners() const { return corner_of_; }

  // Where walks may start. There is always a solid face; no_index if there is no entry face.
  [[nodiscard]] Index solid_face() const { return solid_; }
  [[nodiscard]] Index entry_face() const { return entry_; }

  // Asks for the memory where a walk from this place, or its removal, starts.
  void prefetch(Index place) const {
    if (place >= corner_of_.size()) return;
    sites().prefetch(place);
    system::prefetch(&corner_of_[place]);
  }
  // What comes next, when that has arrived.
  void prefetch_face(Index place) const {
    if (is_vertex(place)) system::prefetch(&mesh_[topology::face_of(corner_of_[place])]);
  }

  // `close` is a place close to p, or no_index.
  void insert(Index p, Index close) { insert_from(p, start_at(close)); }

  // Attaches a place that is known to be hidden.
  void attach_hidden(Index p, Index close) { cover(p, start_at(close)); }

  void remove_hidden(Index p) { hidden_.detach(p); }

  // The neighbors of a vertex, counterclockwise seen from outside, for remove_vertex().
  std::span<const Index> collect_star(Index v) {
    link_.clear();
    outer_.clear();
    star_.clear();
    topology::Halfedge h = corner_of_[v];
    topology::Halfedge back = h;
    do {
      const Index f = topology::face_of(h);
      const unsigned corner = topology::edge_of(h);
      link_.push_back(mesh_[f].vertex[topology::next_corner[corner]]);
      outer_.push_back(mesh_[f].opposite[corner]);
      star_.push_back(f);
      prefetch(link_.back());
      system::prefetch_to_write(&mesh_[topology::face_of(outer_.back())]);
      h = mesh_.next_around(f, corner);
      // The other way around, so that the second half of the star is there when it is needed.
      back = mesh_.previous_around(topology::face_of(back), topology::edge_of(back));
      system::prefetch(&mesh_[topology::face_of(back)]);
    } while (h != corner_of_[v]);
    return link_;
  }

  // Precondition: collect_star(v) was the call before, and the hull of the others has dimension 2.
  void remove_vertex(Index v) {
    const bool was_all_solid = kinds_.all_solid();
    bool is_grazed = false;
    for (const Index f : star_) {
      is_grazed = is_grazed || kinds_[f] == kernel::FaceKind::grazing;
      if (f == entry_) entry_ = no_index;
      if (f == solid_) solid_ = no_index;
      kinds_.remove(f);
      hidden_.take(f, displaced_);
    }
    triangulation_.run(test_, link_);
    corner_of_[v] = no_index;
    sew();
    restart_at(outer_);
    if (is_grazed || (was_all_solid && !kinds_.all_solid())) hidden_.take_ungrounded(displaced_);
    assert(solid_ != no_index);
    if (!displaced_.empty()) bring_back();
  }

  // After the places have new numbers: the same for vertices, and new ones for the faces.
  void renumber(const Renumbering& places) {
    RenumberedMesh renumbered = dynamic::renumber(mesh_, places);
    mesh_ = std::move(renumbered.mesh);
    const std::vector<Index>& new_face = renumbered.new_face;
    hidden_.renumber(places.new_place, new_face);
    solid_ = new_face[solid_];
    if (entry_ != no_index) entry_ = new_face[entry_];
    const kernel::FaceKinds kinds = std::exchange(kinds_, {});
    for (Index f = 0; f < new_face.size() && !kinds.all_solid(); ++f) {
      if (new_face[f] != no_index) kinds_.add(new_face[f], kinds[f]);
    }
    corner_of_ = {};
    system::reserve_large(corner_of_, places.room());
    corner_of_.assign(places.old_place.size(), no_index);
    for (Index f = mesh_.num_slots(); f-- > 0;) {
      for (unsigned i = 0; i < 3; ++i) corner_of_[mesh_[f].vertex[i]] = topology::halfedge(f, i);
    }
  }

 private:
  struct Start {
    Index solid = no_index;
    Index entry = no_index;
  };

  [[nodiscard]] Start start_at(Index close) const {
    Start start = {solid_, entry_};
    if (close == no_index) return start;
    if (!is_vertex(close)) {
      if (!hidden_.contains(close)) return start;
      start.solid = hidden_.solid_face(close);
      if (hidden_.entry_face(close) != no_index) start.entry = hidden_.entry_face(close);
      return start;
    }
    topology::Halfedge h = corner_of_[close];
    if (kinds_.all_solid()) return {topology::face_of(h), no_index};
    // Any face will do; a vertex of high degree is not searched for the best.
    constexpr int enough = 32;
    for (int i = 0; i < enough; ++i) {
      const Index f = topology::face_of(h);
      if (kinds_[f] == kernel::FaceKind::solid) start.solid = f;
      if (kinds_[f] == kernel::FaceKind::entry) start.entry = f;
      h = mesh_.next_around(f, topology::edge_of(h));
      if (h == corner_of_[close]) break;
    }
    return start;
  }

  [[nodiscard]] const T& sites() const { return test_.sites(); }

  // A face that is new: its kind, its corners, and where walks start.
  void adopt(Index f, bool is_surely_solid) {
    const auto& v = mesh_[f].vertex;
    const auto kind =
        is_surely_solid ? kernel::FaceKind::solid
                        : kernel::kind_of(predicates::orientation(sites(), v[0], v[1], v[2]).sign);
    kinds_.add(f, kind);
    if (kind == kernel::FaceKind::solid) solid_ = f;
    if (kind == kernel::FaceKind::entry) entry_ = f;
    for (unsigned i = 0; i < 3; ++i) {
      if (v[i] >= corner_of_.size()) corner_of_.resize(v[i] + std::size_t{1}, no_index);
      corner_of_[v[i]] = topology::halfedge(f, i);
    }
  }

  // A solid (entry) face can only vanish with a star if one next to the star, or one that replaces
  // it, is solid (entry): the faces of one kind are connected by their edges.
  void restart_at(std::span<const topology::Halfedge> outer) {
    for (const topology::Halfedge h : outer) {
      const Index f = topology::face_of(h);
      if (solid_ == no_index && kinds_[f] == kernel::FaceKind::solid) solid_ = f;
      if (entry_ == no_index && kinds_[f] == kernel::FaceKind::entry) entry_ = f;
    }
  }

  void insert_from(Index p, const Start& start) {
    const auto place = kernel::Walk<T>(test_, mesh_, kinds_)
                           .locate(p, current_solid(start.solid), current_entry(start.entry));
    if (place.conflict == no_index) {
      hidden_.attach(p, place.solid, place.entry);
      return;
    }
    // Once the center is strictly inside, insertions leave it there.
    const bool is_surely_solid = kinds_.all_solid();
    region_.find(test_, mesh_, p, place.conflict);
    std::vector<Index> covered = release_region();
    topology::star(mesh_, p, region_.horizon(), region_.faces());
    for (const Index f : region_.faces()) adopt(f, is_surely_solid);
    restart_around_star();
    cover_all(std::move(covered));
  }

  void cover_all(std::vector<Index> places) {
    Start start = {solid_, entry_};
    for (const Index q : in_spatial_order(std::move(places))) {
      if (is_vertex(q)) continue;
      cover(q, start);
      start = start_at(q);
    }
  }

  // As a build inserts, in rounds along the spatial order: all hidden sites may come back at once.
  void bring_back() {
    const std::vector<Index> places = in_spatial_order(std::exchange(displaced_, {}));
    Start start = {solid_, entry_};
    for (const Index rank : kernel::insertion_order(static_cast<Index>(places.size()))) {
      insert_from(places[rank], start);
      start = is_vertex(places[rank]) ? Start{solid_, entry_} : start_at(places[rank]);
    }
  }

  // Each walk can then start where the one before has ended.
  [[nodiscard]] std::vector<Index> in_spatial_order(std::vector<Index> places) const {
    constexpr std::size_t few = 8;
    if (places.size() <= few) return places;
    std::vector<std::pair<order::HilbertKey, Index>> order;
    order.reserve(places.size());
    for (const Index p : places) {
      const auto position = order::cube_position(sites().point(p), sites().center());
      order.emplace_back(order::hilbert_key(position), p);
    }
    std::ranges::sort(order);
    std::ranges::transform(order, places.begin(), [](const auto& entry) { return entry.second; });
    return places;
  }

  // Start faces found before other insertions may be gone.
  [[nodiscard]] Index current_solid(Index f) const {
    return mesh_.is_alive(f) && kinds_[f] == kernel::FaceKind::solid ? f : solid_;
  }
  [[nodiscard]] Index current_entry(Index f) const {
    return f != no_index && mesh_.is_alive(f) && kinds_[f] == kernel::FaceKind::entry ? f : entry_;
  }

  // Before the star takes the place of the region: returns the sites that its faces hide, and the
  // vertices that may have none left.
  std::vector<Index> release_region() {
    std::vector<Index> covered;
    for (const Index f : region_.faces()) {
      if (f == entry_) entry_ = no_index;
      if (f == solid_) solid_ = no_index;
      kinds_.remove(f);
      if constexpr (T::hides_sites) hidden_.take(f, covered);
    }
    // By Euler's formula, a region without inner vertices has two faces less than edges.
    if (T::hides_sites && region_.faces().size() + 2 != region_.horizon().size()) {
      for (const Index f : region_.faces()) {
        for (const Index v : mesh_[f].vertex) {
          if (std::exchange(corner_of_[v], no_index) != no_index) covered.push_back(v);
        }
      }
    }
    return covered;
  }

  void restart_around_star() {
    if (solid_ != no_index && (entry_ != no_index || kinds_.all_solid())) return;
    outer_.clear();
    for (const auto& edge : region_.horizon()) outer_.push_back(edge.outside);
    restart_at(outer_);
  }

  // Finds the faces that hide q.
  void cover(Index q, const Start& start) {
    const auto place = kernel::Walk<T>(test_, mesh_, kinds_).locate(q, start.solid, start.entry);
    assert(place.conflict == no_index);
    hidden_.attach(q, place.solid, place.entry);
  }

  // Puts the triangulation of the link in the slots of the star.
  void sew() {
    for (int i = 0; i < 2; ++i) {
      mesh_.remove_face(star_.back());
      star_.pop_back();
    }
    const auto faces = triangulation_.faces();
    for (std::size_t k = 0; k < faces.size(); ++k) {
      topology::Face& face = mesh_[star_[k]];
      for (unsigned i = 0; i < 3; ++i) {
        face.vertex[i] = link_[faces[k].vertex[i]];
        const topology::Halfedge inside = faces[k].opposite[i];
        if (inside != no_index) {
          face.opposite[i] =
              topology::halfedge(star_[topology::face_of(inside)], topology::edge_of(inside));
        } else {
          mesh_.link(topology::halfedge(star_[k], i),
                     outer_[faces[k].vertex[topology::next_corner[i]]]);
        }
      }
    }
    for (const Index f : star_) adopt(f, false);
  }

  kernel::ConflictTest<T> test_;
  topology::Mesh mesh_;
  kernel::FaceKinds kinds_;
  HiddenSites hidden_;
  std::vector<topology::Halfedge> corner_of_;
  Index solid_ = no_index;
  Index entry_ = no_index;

  kernel::ConflictRegion<T> region_;
  LinkTriangulation<T> triangulation_;
  std::vector<Index> link_;
  std::vector<topology::Halfedge> outer_;
  std::vector<Index> star_;
  std::vector<Index> displaced_;
};

}  // namespace rondel::dynamic
