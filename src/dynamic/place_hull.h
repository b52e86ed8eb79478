// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The hull of places that come and go (a place: what duplicates share): what it keeps beyond a hull
// that changes (kernel/mutable_hull.h), and removal by triangulating the link of the vertex.
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
#include "kernel/mutable_hull.h"
#include "models/sphere_traits.h"
#include "order/along_the_curve.h"
#include "predicates/ray_order.h"
#include "system/prefetch.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

template <models::SphereModel T>
class PlaceHull {
 public:
  // `first` are three places with a non-zero orientation.
  PlaceHull(T& sites, const std::array<Index, 3>& first) : hull_(sites, first) { set_corners(); }

  // The finished mesh of a build, its vertices renamed to places. Places that are hidden follow by
  // attach_hidden.
  PlaceHull(T& sites, topology::Mesh mesh) : hull_(sites, std::move(mesh)) { set_corners(); }

  [[nodiscard]] const topology::Mesh& mesh() const { return hull_.mesh(); }
  [[nodiscard]] const kernel::FaceKinds& kinds() const { return hull_.kinds(); }
  [[nodiscard]] const HiddenSites& hidden() const { return hidden_; }
  [[nodiscard]] std::size_t num_vertices() const { return mesh().num_faces() / 2 + 2; }
  [[nodiscard]] bool is_vertex(Index p) const {
    return p < corner_of_.size() && corner_of_[p] != no_index;
  }
  // A corner of each vertex, as 3*face + corner.
  [[nodiscard]] std::span<const topology::Halfedge> corners() const { return corner_of_; }

  // Where walks may start. There is always a solid face; no_index if there is no entry face.
  [[nodiscard]] Index solid_face() const { return hull_.start().solid; }
  [[nodiscard]] Index entry_face() const { return hull_.start().entry; }

  // Asks for the memory where a walk from this place, or its removal, starts.
  void prefetch(Index place) const {
    if (place >= corner_of_.size()) return;
    hull_.sites().prefetch(place);
    system::prefetch(&corner_of_[place]);
  }
  // What comes next, when that has arrived.
  void prefetch_face(Index place) const {
    if (is_vertex(place)) system::prefetch(&mesh()[topology::face_of(corner_of_[place])]);
  }

  // `close` is a place close to p, or no_index.
  void insert(Index p, Index close) { insert_from(p, start_at(close)); }

  // Does so unless p would be hidden or is in the place of a vertex: then nothing is done. Returns
  // whether it was inserted. Precondition: all faces are solid.
  [[nodiscard]] bool insert_vertex(Index p, Index close) {
    if (is_on_ray_of_vertex(p, close)) return false;
    const auto found = hull_.locate(p, start_at(close));
    if (found.conflict == no_index) return false;
    insert_into(p, found.conflict);
    return true;
  }

  [[nodiscard]] kernel::ConflictTest<T>& test() { return hull_.test(); }

  // Replaces the edge of a halfedge by the other diagonal of the two faces beside it, which are
  // returned: edge 1 of both is the new one. Precondition: all faces are solid, and these two will
  // be; they hide nothing.
  //
  //        b               b
  //       /|\             / \          f = (c, a, b) becomes (c, a, d),
  //      c | d    ->     c---d         g = (d, b, a) becomes (d, b, c)
  //       \|/             \ /
  //        a               a
  std::array<Index, 2> flip(topology::Halfedge h) {
    topology::Mesh& mesh = hull_.mesh();
    const Index f = topology::face_of(h);
    const unsigned i = topology::edge_of(h);
    const topology::Face left = mesh[f];
    const Index g = topology::face_of(left.opposite[i]);
    const unsigned j = topology::edge_of(left.opposite[i]);
    const topology::Face right = mesh[g];
    const Index c = left.vertex[i];
    const Index d = right.vertex[j];
    mesh[f].vertex = {c, left.vertex[topology::next_corner[i]], d};
    mesh[g].vertex = {d, right.vertex[topology::next_corner[j]], c};
    mesh.link(topology::halfedge(f, 0), right.opposite[topology::next_corner[j]]);
    mesh.link(topology::halfedge(f, 1), topology::halfedge(g, 1));
    mesh.link(topology::halfedge(f, 2), left.opposite[topology::previous_corner[i]]);
    mesh.link(topology::halfedge(g, 0), left.opposite[topology::next_corner[i]]);
    mesh.link(topology::halfedge(g, 2), right.opposite[topology::previous_corner[j]]);
    set_corners(f);
    set_corners(g);
    return {f, g};
  }

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
      link_.push_back(mesh()[f].vertex[topology::next_corner[corner]]);
      outer_.push_back(mesh()[f].opposite[corner]);
      star_.push_back(f);
      prefetch(link_.back());
      system::prefetch_to_write(&mesh()[topology::face_of(outer_.back())]);
      h = mesh().next_around(f, corner);
      // The other way around, so that the second half of the star is there when it is needed.
      back = mesh().previous_around(topology::face_of(back), topology::edge_of(back));
      system::prefetch(&mesh()[topology::face_of(back)]);
    } while (h != corner_of_[v]);
    return link_;
  }

  // Precondition: collect_star(v) was the call before, and the hull of the others has dimension 2.
  void remove_vertex(Index v) {
    const bool was_all_solid = kinds().all_solid();
    bool is_grazed = false;
    for (const Index f : star_) {
      is_grazed = is_grazed || kinds()[f] == kernel::FaceKind::grazing;
      hull_.forget(f);
      hidden_.take(f, displaced_);
    }
    triangulation_.run(hull_.test(), link_);
    corner_of_[v] = no_index;
    sew();
    for (const topology::Halfedge h : outer_) hull_.restart_beside(h);
    if (is_grazed || (was_all_solid && !kinds().all_solid())) hidden_.take_ungrounded(displaced_);
    assert(solid_face() != no_index);
    if (!displaced_.empty()) bring_back();
  }

  // After the places have new numbers: the same for vertices, and new ones for the faces.
  void renumber(const Renumbering& places) {
    RenumberedMesh renumbered = dynamic::renumber(mesh(), places);
    hull_.renumber(std::move(renumbered.mesh), renumbered.new_face);
    hidden_.renumber(places.new_place, renumbered.new_face);
    corner_of_ = {};
    system::reserve_large(corner_of_, places.room());
    corner_of_.assign(places.old_place.size(), no_index);
    set_corners();
  }

 private:
  using Start = typename kernel::MutableHull<T>::Start;

  [[nodiscard]] Start start_at(Index close) const {
    Start start = hull_.start();
    if (close == no_index) return start;
    if (!is_vertex(close)) {
      if (!hidden_.contains(close)) return start;
      start.solid = hidden_.solid_face(close);
      if (hidden_.entry_face(close) != no_index) start.entry = hidden_.entry_face(close);
      return start;
    }
    topology::Halfedge h = corner_of_[close];
    if (kinds().all_solid()) return {topology::face_of(h), no_index};
    // Any face will do; a vertex of high degree is not searched for the best.
    constexpr int enough = 32;
    for (int i = 0; i < enough; ++i) {
      const Index f = topology::face_of(h);
      if (kinds()[f] == kernel::FaceKind::solid) start.solid = f;
      if (kinds()[f] == kernel::FaceKind::entry) start.entry = f;
      h = mesh().next_around(f, topology::edge_of(h));
      if (h == corner_of_[close]) break;
    }
    return start;
  }

  // Whether p would share its place with a vertex although its coordinates are others. No conflict
  // test is defined for both.
  [[nodiscard]] bool is_on_ray_of_vertex(Index p, Index close) {
    if constexpr (T::model != Model::projected) return false;
    const auto& vertices = mesh()[hull_.face_on_ray(p, start_at(close).solid)].vertex;
    const T& sites = hull_.sites();
    return std::ranges::any_of(vertices, [&](Index v) {
      return predicates::are_on_one_ray(sites.point(p), sites.point(v), sites.center());
    });
  }

  void set_corners(Index f) {
    const auto& v = mesh()[f].vertex;
    for (unsigned i = 0; i < 3; ++i) {
      if (v[i] >= corner_of_.size()) corner_of_.resize(v[i] + std::size_t{1}, no_index);
      corner_of_[v[i]] = topology::halfedge(f, i);
    }
  }
  // Sets the corners of all vertices; the first face of a vertex counts.
  void set_corners() {
    for (Index f = mesh().num_slots(); f-- > 0;) {
      if (mesh().is_alive(f)) set_corners(f);
    }
  }

  void insert_from(Index p, const Start& start) {
    const auto found = hull_.locate(p, start);
    if (found.conflict == no_index) {
      hidden_.attach(p, found.solid, found.entry);
      return;
    }
    insert_into(p, found.conflict);
  }

  void insert_into(Index p, Index conflict) {
    std::vector<Index> covered;
    const auto star = hull_.insert(
        p, conflict, [&](const kernel::ConflictRegion<T>& region) { release(region, covered); });
    for (const Index f : star) set_corners(f);
    if (!covered.empty()) cover_all(std::move(covered));
  }

  void cover_all(std::vector<Index> places) {
    Start start = hull_.start();
    for (const Index q : in_spatial_order(std::move(places))) {
      if (is_vertex(q)) continue;
      cover(q, start);
      start = start_at(q);
    }
  }

  // Inserts the hidden sites again in the order of a build, in rounds along the spatial order,
  // since all of them may become vertices at once.
  void bring_back() {
    const std::vector<Index> places = in_spatial_order(std::exchange(displaced_, {}));
    Start start = hull_.start();
    for (const Index rank : kernel::insertion_order(static_cast<Index>(places.size()))) {
      insert_from(places[rank], start);
      start = is_vertex(places[rank]) ? hull_.start() : start_at(places[rank]);
    }
  }

  // Each walk can then start where the one before has ended.
  [[nodiscard]] std::vector<Index> in_spatial_order(std::vector<Index> places) const {
    constexpr std::size_t few = 8;
    if (places.size() <= few) return places;
    order::sort_along_the_curve(places, [this](Index p) {
      return order::place_key(hull_.sites().point(p), T::model, hull_.sites().center());
    });
    return places;
  }

  // Before the star takes the place of the region: appends the sites that its faces hide, and the
  // vertices that may have none left.
  void release(const kernel::ConflictRegion<T>& region, std::vector<Index>& covered) {
    if constexpr (T::hides_sites) {
      for (const Index f : region.faces()) hidden_.take(f, covered);
      // By Euler's formula, a region without inner vertices has two faces less than edges.
      if (region.faces().size() + 2 == region.horizon().size()) return;
      for (const Index f : region.faces()) {
        for (const Index v : mesh()[f].vertex) {
          if (std::exchange(corner_of_[v], no_index) != no_index) covered.push_back(v);
        }
      }
    }
  }

  // Finds the faces that hide q.
  void cover(Index q, const Start& start) {
    const auto found = hull_.locate(q, start);
    assert(found.conflict == no_index);
    hidden_.attach(q, found.solid, found.entry);
  }

  // Puts the triangulation of the link in the slots of the star.
  void sew() {
    topology::Mesh& mesh = hull_.mesh();
    for (int i = 0; i < 2; ++i) {
      mesh.remove_face(star_.back());
      star_.pop_back();
    }
    const auto faces = triangulation_.faces();
    for (std::size_t k = 0; k < faces.size(); ++k) {
      topology::Face& face = mesh[star_[k]];
      for (unsigned i = 0; i < 3; ++i) {
        face.vertex[i] = link_[faces[k].vertex[i]];
        const topology::Halfedge inside = faces[k].opposite[i];
        if (inside != no_index) {
          face.opposite[i] =
              topology::halfedge(star_[topology::face_of(inside)], topology::edge_of(inside));
        } else {
          mesh.link(topology::halfedge(star_[k], i),
                    outer_[faces[k].vertex[topology::next_corner[i]]]);
        }
      }
    }
    for (const Index f : star_) {
      hull_.adopt(f);
      set_corners(f);
    }
  }

  kernel::MutableHull<T> hull_;
  HiddenSites hidden_;
  std::vector<topology::Halfedge> corner_of_;

  LinkTriangulation triangulation_;
  std::vector<Index> link_;
  std::vector<topology::Halfedge> outer_;
  std::vector<Index> star_;
  std::vector<Index> displaced_;
};

}  // namespace rondel::dynamic
