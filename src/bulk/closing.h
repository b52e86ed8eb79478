// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The last merge: two parts that fill the two sides of a great circle become a triangulation of
// the sphere. There is no lower common tangent; the new faces form a ring:
//
//      .---------.
//     /   .---.   \        A bridge (l, r) is an edge of the result between the parts. The sewing
//    |   |  L  |   |       from there goes around and comes back to it.
//    |   |     l---r
//    |   |     |   |
//     \   '---'   / R
//      '---------'
//
// To find a bridge, look along a line that is parallel to the plane of the great circle: an edge of
// the outline is one of the hull, and two edges of the outline cross the plane. Doubles guess the
// bridge, and exact predicates prove it.
//
// in    two parts of a graph, each by an edge of its boundary, and the sites to ask
// out   an edge of the triangulation of the sphere, or that this does not work
// index local sites and halfedges of the graph
//
// The closing does not work where the guess is refuted, where a part lies on one great circle, and where a
// weighted site lies on the great circle through the bridge, below it (docs/theory/blocks.md).
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "bulk/given_sites.h"
#include "bulk/merge.h"

namespace rondel::bulk {

template <models::SphereModel T>
class Closing {
 public:
  using Edge = PlaneGraph::Edge;
  using Vector = predicates::Vector;

  Closing(GivenSites<T>& sites, PlaneGraph& graph) : sites_(sites), graph_(graph) {}

  // The parts have edges, and lie on the side to which `normal` points and on the other one of a
  // plane through the center, which is inside the hull of all. Returns an edge of the result, or
  // no_index if this does not work; then the graph is worth nothing.
  Edge run(const Part& left, const Part& right, const Vector& normal, const Vector& along) {
    Bridge bridge = {left.edge, right.edge};
    look_along(cross(normal, along), normal, bridge);
    if (!is_edge_of_hull(bridge)) return no_index;
    const Index l = graph_.origin(bridge.left);
    const Index r = graph_.origin(bridge.right);
    const auto after_left = clear_way(bridge.left, r);
    const auto after_right = clear_way(bridge.right, l);
    if (!after_left || !after_right) return no_index;
    const Edge edge = graph_.add(l, r, *after_left, *after_right);
    return sew_around(edge) ? edge : no_index;
  }

 private:
  using Step = MergeStep<GivenSites<T>>;

  // Two vertices, each by an edge that leaves it.
  struct Bridge {
    Edge left;
    Edge right;
  };

  // Moves to the vertex that is the highest one in this direction, as far as doubles tell.
  // Returns whether it moved.
  bool move_up(Edge& from, const Vector& up) const {
    bool has_moved = false;
    for (std::size_t steps = 0; steps < sites_.size(); ++steps) {
      Edge best = no_index;
      double height = dot(up, sites_.from_center(graph_.origin(from)));
      Edge e = from;
      do {
        const double other = dot(up, sites_.from_center(graph_.target(e)));
        if (other > height) {
          height = other;
          best = e;
        }
        e = graph_.next(e);
      } while (e != from);
      if (best == no_index) return has_moved;
      from = best ^ 1;
      has_moved = true;
    }
    return has_moved;
  }

  // Two convex polygons in the plane, the outlines of the parts seen along a line: moves the
  // bridge to their common tangent, on the side of `side`, or somewhere if roundings mislead it.
  void look_along(const Vector& side, const Vector& normal, Bridge& bridge) const {
    constexpr int enough = 1000;
    for (int i = 0; i < enough; ++i) {
      const Vector step = sites_.from_center(graph_.origin(bridge.left)) -
                          sites_.from_center(graph_.origin(bridge.right));
      const double out = dot(step, normal);
      const double over = -dot(step, side);
      const Vector up = {out * side.x + over * normal.x, out * side.y + over * normal.y,
                         out * side.z + over * normal.z};
      const bool has_left_moved = move_up(bridge.left, up);
      const bool has_right_moved = move_up(bridge.right, up);
      if (!has_left_moved && !has_right_moved) return;
    }
  }

  // All that the hull of the sites and the center has at either end of the bridge, but for the
  // center, lies on one side of a plane through the bridge and one of these sites. By convexity all
  // sites do.
  [[nodiscard]] bool is_edge_of_hull(const Bridge& bridge) const {
    const Index l = graph_.origin(bridge.left);
    const Index r = graph_.origin(bridge.right);
    Index apex = no_index;
    const auto is_in_front = [&](Index x) { return sites_.is_in_conflict(l, r, apex, x); };
    for_neighbors(bridge, [&](Index x) {
      if (sites_.orientation(l, r, x) == Sign::positive &&
          (apex == no_index || (x != apex && is_in_front(x)))) {
        apex = x;
      }
    });
    if (apex == no_index) return false;
    bool is_edge = true;
    for_neighbors(bridge, [&](Index x) { is_edge &= x == apex || !is_in_front(x); });
    return is_edge;
  }

  template <class Visit>
  void for_neighbors(const Bridge& bridge, Visit visit) const {
    for (const Edge first : {bridge.left, bridge.right}) {
      Edge e = first;
      do {
        visit(graph_.target(e));
        e = graph_.next(e);
      } while (e != first);
    }
  }

  // Deletes all edges that an edge from the origin of `from` to a vertex of the other part would
  // cross, seen from the center. Returns the edge after which it comes in its ring; or nothing if
  // it would meet a vertex, or if the origin is in the middle of a part on one great circle.
  std::optional<Edge> clear_way(Edge from, Index to) {
    const Index v = graph_.origin(from);
    std::optional<Edge> outer;
    Edge e = from;
    do {
      const Index a = graph_.target(e);
      const Index b = graph_.target(graph_.next(e));
      if (a == b || sites_.orientation(v, a, b) != Sign::positive) {
        if (outer) return std::nullopt;
        outer = e;
      } else {
        const Sign after_a = sites_.orientation(v, a, to);
        const Sign before_b = sites_.orientation(v, to, b);
        if (after_a == Sign::positive && before_b == Sign::positive) {
          if (!delete_crossed(graph_.face_next(e), v, to)) return std::nullopt;
          return e;
        }
        // Along an edge; not so if the zero is that of the opposite direction.
        if (after_a != Sign::negative && before_b != Sign::negative) return std::nullopt;
      }
      e = graph_.next(e);
    } while (e != from);
    return outer;
  }

  // From this edge on, which has v on its left, out of the part. Returns whether the way meets no
  // vertex.
  bool delete_crossed(Edge first, Index v, Index to) {
    for (Edge crossed = first;;) {
      const Edge beyond = crossed ^ 1;
      const Edge right = graph_.face_next(beyond);
      const Edge left = graph_.face_next(right);
      const Index apex = graph_.target(right);
      const bool is_outer =
          graph_.face_next(left) != beyond ||
          sites_.orientation(graph_.origin(beyond), graph_.target(beyond), apex) != Sign::positive;
      graph_.remove(crossed);
      if (is_outer) return true;
      const Sign side = sites_.orientation(v, to, apex);
      if (side == Sign::zero) return false;
      crossed = side == Sign::positive ? right : left;
    }
  }

  // Does what Merge::sew does, from the bridge to itself. The center is inside the hull, so no face
  // of it is in a plane with the center, and there is a next face until the ring is closed. Returns
  // whether it is, which only an error in an earlier step can make false.
  bool sew_around(Edge bridge) {
    Edge base = bridge;
    Index l = graph_.origin(base);
    Index r = graph_.target(base);
    while (!graph_.is_full()) {
      const Step step(sites_, {}, l, r);
      if constexpr (T::hides_sites) {
        remove_covered<true>(graph_, base, step, bridge);
        remove_covered<false>(graph_, base ^ 1, step, bridge ^ 1);
        remove_on_line(step, base);
      }
      const Edge left = first_stable<true>(step, base, bridge);
      const Edge right = first_stable<false>(step, base ^ 1, bridge ^ 1);
      const Index a = left == no_index ? no_index : graph_.target(left);
      const Index b = right == no_index ? no_index : graph_.target(right);
      // The bridge leads to a candidate of one side, and is what the other side comes to; but the
      // search there may have stopped before, at a site that the last face hides. What is left in
      // its corners leads to such sites.
      if (left == no_index || left == bridge ||
          (right != no_index && right != (bridge ^ 1) && step.is_in_conflict(step.face(a), b))) {
        if (right == no_index || right == (bridge ^ 1)) return false;
        if (l == graph_.origin(bridge) && b == graph_.target(bridge)) {
          remove_between(base, bridge);
          remove_between(bridge ^ 1, right ^ 1);
          return true;
        }
        r = b;
        base = graph_.add(l, r, base, graph_.previous(right ^ 1));
      } else {
        if (r == graph_.target(bridge) && a == graph_.origin(bridge)) {
          remove_between(left ^ 1, bridge);
          remove_between(bridge ^ 1, base ^ 1);
          return true;
        }
        l = a;
        base = graph_.add(l, r, left ^ 1, graph_.previous(base ^ 1));
      }
    }
    return false;
  }

  // A weighted neighbor of l or r on the line between them is below it, as the line is an edge of
  // the hull. Its edge runs along the base and is the first one beyond it.
  void remove_on_line(const Step& step, Edge base) {
    const auto is_on_line = [&](Edge e, Edge own) {
      const Index n = graph_.target(e);
      return e != own && step.orientation(step.face(n)) == Sign::zero &&
             is_between(sites_.point(step.l()), sites_.point(n), sites_.point(step.r()),
                        sites_.center()) != Between::no;
    };
    if (is_on_line(graph_.next(base), base)) graph_.remove(graph_.next(base));
    const Edge back = base ^ 1;
    if (is_on_line(graph_.previous(back), back)) graph_.remove(graph_.previous(back));
  }

  void remove_between(Edge e, Edge f) {
    while (graph_.next(e) != f) graph_.remove(graph_.next(e));
  }

  // The first edge after `from` in its ring, in the direction in which the sewing goes there, that
  // leads to a site above the step and is not deleted; no_index if there is none. The bridge stays.
  template <bool is_left>
  Edge first_stable(const Step& step, Edge from, Edge bridge) {
    const auto following = [this](Edge e) { return is_left ? graph_.next(e) : graph_.previous(e); };
    Edge e = following(from);
    if (e == from || step.orientation(step.face(graph_.target(e))) != Sign::positive) {
      return no_index;
    }
    while (e != bridge) {
      const Edge next = following(e);
      if (next == from || !step.is_in_conflict(step.face(graph_.target(e)), graph_.target(next))) {
        break;
      }
      graph_.remove(e);
      e = next;
    }
    return e;
  }

  GivenSites<T>& sites_;
  PlaneGraph& graph_;
};

}  // namespace rondel::bulk
