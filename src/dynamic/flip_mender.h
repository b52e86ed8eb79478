// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A hull whose vertices have all moved, mended by flips (Lawson, Software for C1 surface
// interpolation, 1977). All faces are solid before: the surface S of the old points is star-shaped
// around the center o. The faces stay what they are while the points move, and then
//
// 1. faces that are not positive any more get corners back to their old points, until all faces are
//    positive. Each corner goes back once at most, and the old points are positive.
// 2. edges that are not locally Delaunay are flipped until there are none.
// 3. the corners of step 1 move one by one, each if its star stays positive, with flips around it.
//    Those that cannot are late, and left to the caller.
//
// Why the result is the hull of the points: a closed surface of positive faces covers all directions,
// each as often, its degree. The degree is 1 for S. It stays what it is while a surface is deformed
// without touching o. In step 1 the points of all faces move along straight lines by no more than the
// vertices do, at most by d, and stay away from o if new faces are farther away than 2 d; a face
// (a, b, c) is at least |a-o| - max(|b-a|, |c-a|) away. In step 3 all positions of a vertex with a
// positive star are a convex cone, so that its faces are positive on the straight way between two of
// them. A surface of positive faces and degree 1 is star-shaped, and its faces are a triangulation of
// the directions.
//
// In the projected model an edge that is not locally Delaunay has a convex quadrilateral: the fourth
// site is in the cap of a positive face, which is smaller than a hemisphere, beyond one edge (a chord
// of a disk in the gnomonic plane at the middle of the cap). So the two new faces are positive; the
// flip raises the surface along rays, no surface comes twice, and flips end. The perturbed test is
// that of points that are raised a little, to which the same applies. A star-shaped surface that is
// locally convex at all edges is convex: it is the hull, which is unique. In the weighted model the
// quadrilateral may not be convex, where a vertex has to be hidden: then this gives up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dynamic/place_hull.h"
#include "dynamic/places.h"
#include "models/sphere_traits.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

// A vertex that is at its old point, and its new one.
struct LateVertex {
  Index place;
  Point to;
};

template <models::MovingSphereModel T>
class FlipMender {
 public:
  // All points are the new ones, in places and sites; `from` are the old ones, by site.
  FlipMender(PlaceHull<T>& hull, Places& places, T& sites, std::span<const Point> from)
      : hull_(hull), places_(places), sites_(sites), from_(from) {}

  // Steps 1 to 3 above. `square` is the largest square by which from_center() of a site has changed.
  // Returns the late vertices, or nothing if it gave up: then the points of some places are still the
  // old ones, and the hull means nothing.
  std::optional<std::vector<LateVertex>> run(double square, unsigned threads) {
    if (!look_at_faces(square, threads)) return std::nullopt;
    if (is_many(inverted_.size(), many_inverted) || !make_positive()) return std::nullopt;
    for (const LateVertex& vertex : moved_back_) push_star(vertex.place);
    if (!flip_all()) return std::nullopt;
    // What could not move at first may when its neighbors have.
    for (int round = 0; round < 2; ++round) {
      std::vector<LateVertex> late;
      for (const LateVertex& vertex : std::exchange(moved_back_, {})) {
        if (!move(vertex)) {
          late.push_back(vertex);
        } else if (!flip_all()) {
          return std::nullopt;
        }
      }
      moved_back_ = std::move(late);
    }
    if (is_many(moved_back_.size(), many_late)) return std::nullopt;
    return std::move(moved_back_);
  }

 private:
  // A build takes less time where there is more than one inverted face for so many vertices (about half
  // as many vertices are late then), or more than one vertex of so many goes back, or is late.
  static constexpr std::size_t many_inverted = 16;
  static constexpr std::size_t many_moved_back = 3;
  static constexpr std::size_t many_late = 32;

  // What some faces are found to be.
  struct Findings {
    std::vector<Index> inverted;           // faces that are not positive
    std::vector<topology::Halfedge> open;  // edges that may not be locally Delaunay
    bool are_far = true;                   // from the center, compared with the moves
  };

  [[nodiscard]] bool is_many(std::size_t count, std::size_t one_of) const {
    return count > places_.num_places() / one_of;
  }

  [[nodiscard]] bool is_positive(Index f) const {
    const auto& v = hull_.mesh()[f].vertex;
    return is_turned_left(v[0], v[1], v[2]);
  }
  [[nodiscard]] bool is_turned_left(Index a, Index b, Index c) const {
    if constexpr (T::model == Model::projected) {
      const Sign sign = predicates::sure_orientation(sites_.direction(a), sites_.direction(b),
                                                     sites_.direction(c));
      if (sign != Sign::zero) return sign == Sign::positive;
    }
    return predicates::orientation(std::as_const(sites_), a, b, c).sign == Sign::positive;
  }

  // A face of the new points as three questions need it: whether it is positive, how far from the
  // center it is, and on which side of it a site is.
  struct FaceOfPoints {
    predicates::Vector a;
    predicates::Vector normal;
    double ab2;
    double ac2;
  };
  [[nodiscard, gnu::always_inline]] FaceOfPoints face_of_points(const topology::Face& face) const {
    const predicates::Vector a = sites_.from_center(face.vertex[0]);
    const predicates::Vector ab = sites_.from_center(face.vertex[1]) - a;
    const predicates::Vector ac = sites_.from_center(face.vertex[2]) - a;
    return {a, cross(ab, ac), dot(ab, ab), dot(ac, ac)};
  }

  [[nodiscard]] bool is_positive(Index f, const FaceOfPoints& face) const {
    if constexpr (T::model == Model::projected) {
      const double value = dot(face.a, face.normal);
      if (predicates::is_direction_orientation_certain(value, face.ab2, face.ac2)) return value > 0;
    }
    return is_positive(f);
  }
  // Whether it is farther from the center than 2 d, for the square of d. Squares of sums are at most
  // twice the sums of squares; the rest is for roundings.
  [[nodiscard]] static bool is_far(const FaceOfPoints& face, double square) {
    const double longest = std::max(face.ab2, face.ac2);
    return 2 * (longest + 4 * square) < 0.98 * dot(face.a, face.a);
  }
  // The sign of the conflict test, or zero if that is not certain.
  [[nodiscard, gnu::always_inline]] Sign sure_side(const std::array<Index, 3>& v,
                                                   const FaceOfPoints& face, Index p) const {
    if constexpr (T::model == Model::projected) {
      const Sign sign = predicates::sure_side_of_face(face.a, face.normal, face.ab2, face.ac2,
                                                      sites_.direction(p));
      if (sign != Sign::zero) return sign;
    }
    return predicates::sure_conflict(std::as_const(sites_), v[0], v[1], v[2], p);
  }

  // Faces that are looked at together: what is read of their neighbors is asked for early, and a
  // branch that no processor could foretell is none.
  static constexpr std::size_t faces_at_once = 128;

  // Looks at up to that many faces, from `begin` on.
  [[gnu::flatten]] void look_at(Index begin, Index end, double square, Findings& found) const {
    const topology::Mesh& mesh = hull_.mesh();
    std::array<FaceOfPoints, faces_at_once> faces;
    std::array<topology::Halfedge, 3 * faces_at_once> edges;
    std::array<Index, 3 * faces_at_once> apexes;
    std::size_t size = 0;
    for (Index f = begin; f < end; ++f) {
      if (!mesh.is_alive(f)) continue;
      const topology::Face& face = mesh[f];
      const FaceOfPoints& points = faces[f - begin] = face_of_points(face);
      if (!is_far(points, square)) found.are_far = false;
      if (!is_positive(f, points)) found.inverted.push_back(f);
      for (unsigned i = 0; i < 3; ++i) {
        edges[size] = topology::halfedge(f, i);
        system::prefetch(&mesh[topology::face_of(face.opposite[i])]);
        size += edges[size] < face.opposite[i] ? 1U : 0U;  // each edge once
      }
    }
    for (std::size_t k = 0; k < size; ++k) {
      const topology::Halfedge other =
          mesh[topology::face_of(edges[k])].opposite[topology::edge_of(edges[k])];
      apexes[k] = mesh[topology::face_of(other)].vertex[topology::edge_of(other)];
      sites_.prefetch(apexes[k]);
    }
    std::size_t num_open = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const Index f = topology::face_of(edges[k]);
      const Sign sign = sure_side(mesh[f].vertex, faces[f - begin], apexes[k]);
      edges[num_open] = edges[k];
      num_open += sign != Sign::negative ? 1U : 0U;
    }
    found.open.insert(found.open.end(), edges.begin(),
                      edges.begin() + static_cast<std::ptrdiff_t>(num_open));
  }

  // Collects the faces to make positive, and the edges to flip. False if the degree is not known.
  [[nodiscard]] bool look_at_faces(double square, unsigned threads) {
    constexpr std::size_t grain = 8192;
    const std::size_t size = hull_.mesh().num_slots();
    std::vector<Findings> parts(system::num_pieces(size, grain));
    system::parallel_for(threads, size, grain, [&](std::size_t begin, std::size_t end) {
      Findings found;
      for (std::size_t first = begin; first < end; first += faces_at_once) {
        look_at(static_cast<Index>(first), static_cast<Index>(std::min(first + faces_at_once, end)),
                square, found);
      }
      parts[begin / grain] = std::move(found);
    });
    for (const Findings& part : parts) {
      if (!part.are_far) return false;
      inverted_.insert(inverted_.end(), part.inverted.begin(), part.inverted.end());
      stack_.insert(stack_.end(), part.open.begin(), part.open.end());
    }
    return true;
  }

  // visit(f, corner) for the faces around a vertex.
  template <class Visit>
  void for_star(Index v, const Visit& visit) const {
    topology::Halfedge h = hull_.corners()[v];
    do {
      const Index f = topology::face_of(h);
      const unsigned corner = topology::edge_of(h);
      visit(f, corner);
      h = hull_.mesh().next_around(f, corner);
    } while (h != hull_.corners()[v]);
  }

  // The edges in and around the star of a vertex.
  void push_star(Index v) {
    for_star(v, [this](Index f, unsigned corner) {
      stack_.push_back(topology::halfedge(f, corner));
      stack_.push_back(topology::halfedge(f, topology::next_corner[corner]));
    });
  }

  void set_point(Index place, const Point& p) {
    places_.set_point(places_.representatives()[place], p);
    sites_.set(place, places_.points(), places_.representatives());
  }

  [[nodiscard]] bool make_positive() {
    std::vector<bool> is_back(places_.place_limit());
    while (!inverted_.empty()) {
      const Index f = inverted_.back();
      inverted_.pop_back();
      if (is_positive(f)) continue;
      const Index v = corner_to_move_back(f, is_back);
      is_back[v] = true;
      moved_back_.push_back({v, places_.place_point(v)});
      if (is_many(moved_back_.size(), many_moved_back)) return false;
      set_point(v, from_[places_.representatives()[v]]);
      for_star(v, [this](Index g, unsigned /*corner*/) { inverted_.push_back(g); });
    }
    return true;
  }

  // Returns the corner, of those at new points, that is opposite to the longest edge: it has crossed
  // that edge most likely.
  [[nodiscard]] Index corner_to_move_back(Index f, const std::vector<bool>& is_back) const {
    const auto& v = hull_.mesh()[f].vertex;
    Index best = no_index;
    double longest = -1;
    for (unsigned i = 0; i < 3; ++i) {
      if (is_back[v[i]]) continue;
      const predicates::Vector edge = sites_.from_center(v[topology::previous_corner[i]]) -
                                      sites_.from_center(v[topology::next_corner[i]]);
      const double length = dot(edge, edge);
      if (best != no_index && length <= longest) continue;
      best = v[i];
      longest = length;
    }
    return best;
  }

  // Moves a vertex to its new point if its faces stay positive.
  [[nodiscard]] bool move(const LateVertex& vertex) {
    const Point before = places_.place_point(vertex.place);
    set_point(vertex.place, vertex.to);
    bool are_positive = true;
    for_star(vertex.place,
             [&](Index f, unsigned /*corner*/) { are_positive = are_positive && is_positive(f); });
    if (are_positive) {
      push_star(vertex.place);
    } else {
      set_point(vertex.place, before);
    }
    return are_positive;
  }

  // Asks for what edges of the stack will need: each time for the next thing of another one.
  void prefetch_below_top() const {
    constexpr std::size_t ahead = 6;
    if (stack_.size() < 3 * ahead) return;
    const topology::Mesh& mesh = hull_.mesh();
    const topology::Halfedge* const top = stack_.data() + stack_.size();
    system::prefetch(&mesh[topology::face_of(*(top - 3 * ahead))]);
    const topology::Halfedge next = *(top - 2 * ahead);
    const topology::Face& face = mesh[topology::face_of(next)];
    system::prefetch(&mesh[topology::face_of(face.opposite[topology::edge_of(next)])]);
    for (const Index v : face.vertex) sites_.prefetch(v);
    const topology::Halfedge soon = *(top - ahead);
    const topology::Halfedge other =
        mesh[topology::face_of(soon)].opposite[topology::edge_of(soon)];
    sites_.prefetch(mesh[topology::face_of(other)].vertex[topology::edge_of(other)]);
  }

  // Flips until all edges of the stack, and those that flips put there, are locally Delaunay. False
  // if one cannot be flipped, or a build would take less time.
  [[nodiscard, gnu::flatten]] bool flip_all() {
    const topology::Mesh& mesh = hull_.mesh();
    while (!stack_.empty()) {
      const topology::Halfedge h = stack_.back();
      stack_.pop_back();
      prefetch_below_top();
      const topology::Face& face = mesh[topology::face_of(h)];
      const topology::Halfedge other = face.opposite[topology::edge_of(h)];
      const Index p = mesh[topology::face_of(other)].vertex[topology::edge_of(other)];
      if (!hull_.test().is_in_conflict(face.vertex, p)) continue;
      if (!can_flip(face, topology::edge_of(h), p)) return false;
      if (++num_flips_ > 2 * places_.num_places()) return false;
      if (num_flips_ % 1024 == 0) system::obey_stop();
      for (const Index f : hull_.flip(h)) {
        stack_.push_back(topology::halfedge(f, 0));
        stack_.push_back(topology::halfedge(f, 2));
      }
    }
    return true;
  }

  // Whether both faces would be positive: always, if no vertex has to be hidden.
  [[nodiscard]] bool can_flip(const topology::Face& face, unsigned i, Index d) const {
    if constexpr (!T::hides_sites) return true;
    const Index c = face.vertex[i];
    return is_turned_left(c, face.vertex[topology::next_corner[i]], d) &&
           is_turned_left(d, face.vertex[topology::previous_corner[i]], c);
  }

  PlaceHull<T>& hull_;
  Places& places_;
  T& sites_;
  std::span<const Point> from_;
  std::vector<Index> inverted_;
  std::vector<topology::Halfedge> stack_;
  std::vector<LateVertex> moved_back_;
  std::size_t num_flips_ = 0;
};

}  // namespace rondel::dynamic
