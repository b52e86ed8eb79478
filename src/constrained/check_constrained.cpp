// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The proof of a constrained triangulation (docs/theory/constrained.md):
//
// 1. Ghost faces are those of delaunay(). Solid faces are positive, no directed edge has two of
//    them, and the edges that have one on one side only are those of delaunay()'s. So they cover
//    each place the same number of times as those of delaunay(), up to a constant.
// 2. One place, which is on no edge, tells that the constant is 0. So they cover what those of
//    delaunay() cover, once.
// 3. Every vertex of delaunay() is a corner of a solid face.
// 4. Each constraint is a chain of edges.
// 5. Every other edge between solid faces is locally Delaunay.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "constrained/constraints.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "system/job.h"

namespace rondel {
namespace constrained {
namespace {

std::string number(std::size_t value) { return std::to_string(value); }

// A directed edge of a face, with the third corner.
struct FaceEdge {
  Index from;
  Index to;
  Index apex;
  Index face;
};

class ConstrainedCheck {
 public:
  ConstrainedCheck(const Triangulation& delaunay, std::span<const Triple> triangles)
      : delaunay_(delaunay),
        sites_(delaunay.sites().points(), delaunay.duplicates()),
        sphere_(delaunay.sphere()),
        triangles_(triangles) {}

  // Returns what is wrong, in one line, or nothing.
  std::string find_flaw(std::span<const std::array<Index, 2>> constraints) {
    std::string flaw = find_wrong_corner();
    if (flaw.empty()) flaw = find_wrong_ghost();
    if (flaw.empty()) flaw = find_wrong_border();
    if (flaw.empty()) flaw = find_missing_vertex();
    if (flaw.empty()) flaw = find_cover();
    if (flaw.empty()) flaw = find_broken_constraint(constraints);
    if (flaw.empty()) flaw = find_edge_that_is_not_delaunay();
    return flaw;
  }
  [[nodiscard]] std::size_t num_edges() const { return 3 * triangles_.size() / 2; }

 private:
  [[nodiscard]] Sign oriented(Index a, Index b, Index c) const {
    return orientation(sites_.point(a), sites_.point(b), sites_.point(c), sphere_);
  }

  [[nodiscard]] std::string find_wrong_corner() const {
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const Triple& face = triangles_[f];
      for (std::size_t i = 0; i < 3; ++i) {
        if (face[i] >= sites_.size()) {
          return "face " + number(f) + " has corner " + number(face[i]) + ", but there are " +
                 number(sites_.size()) + " sites";
        }
        if (sites_.name(face[i]) != face[i]) {
          return "face " + number(f) + " has corner " + number(face[i]) +
                 ", which is a duplicate of site " + number(sites_.name(face[i]));
        }
        if (face[i] == face[(i + 1) % 3]) {
          return "face " + number(f) + " has corner " + number(face[i]) + " twice";
        }
      }
    }
    return {};
  }

  static Triple turned(Triple face) {
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    return face;
  }

  // Sorts the faces into solid ones, whose edges are collected, and ghosts.
  std::string find_wrong_ghost() {
    std::vector<Triple> ghosts;
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const Triple& face = triangles_[f];
      if (oriented(face[0], face[1], face[2]) != Sign::positive) {
        ghosts.push_back(turned(face));
        continue;
      }
      solid_.push_back(face);
      for (std::size_t i = 0; i < 3; ++i) {
        edges_.push_back({face[i], face[(i + 1) % 3], face[(i + 2) % 3], static_cast<Index>(f)});
      }
    }
    std::vector<Triple> expected;
    for (const Index f : delaunay_.ghost_faces()) expected.push_back(turned(delaunay_.faces()[f]));
    std::ranges::sort(ghosts);
    std::ranges::sort(expected);
    if (ghosts == expected) return {};
    return "the faces that are not solid, of which there are " + number(ghosts.size()) +
           ", are not the " + number(expected.size()) + " ghost faces of the sites";
  }

  static std::pair<Index, Index> ends_of(const FaceEdge& edge) { return {edge.from, edge.to}; }
  [[nodiscard]] const FaceEdge* find_edge(Index from, Index to) const {
    const auto found = std::ranges::lower_bound(edges_, std::pair(from, to), {}, ends_of);
    return found != edges_.end() && ends_of(*found) == std::pair(from, to) ? &*found : nullptr;
  }

  // The edges that have a face on the left side only.
  template <class Edges>
  static std::vector<std::pair<Index, Index>> border_of(const Edges& edges) {
    std::vector<std::pair<Index, Index>> border;
    for (const auto& [from, to] : edges) {
      if (!std::ranges::binary_search(edges, std::pair(to, from))) border.emplace_back(from, to);
    }
    return border;
  }

  std::string find_wrong_border() {
    std::ranges::sort(edges_, {}, ends_of);
    std::vector<std::pair<Index, Index>> found;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (i > 0 && ends_of(edges_[i - 1]) == ends_of(edges_[i])) {
        return "faces " + number(edges_[i - 1].face) + " and " + number(edges_[i].face) +
               " are on one side of edge " + number(edges_[i].from) + "-" + number(edges_[i].to);
      }
      found.push_back(ends_of(edges_[i]));
    }
    std::vector<std::pair<Index, Index>> expected;
    for (Index f = 0; f < delaunay_.num_faces(); ++f) {
      if (delaunay_.is_ghost(f)) continue;
      const Triple& face = delaunay_.faces()[f];
      for (std::size_t i = 0; i < 3; ++i) expected.emplace_back(face[i], face[(i + 1) % 3]);
    }
    std::ranges::sort(expected);
    found = border_of(found);
    expected = border_of(expected);
    if (found == expected) return {};
    std::vector<std::pair<Index, Index>> wrong;
    std::ranges::set_symmetric_difference(found, expected, std::back_inserter(wrong));
    return "edge " + number(wrong[0].first) + "-" + number(wrong[0].second) +
           (std::ranges::binary_search(found, wrong[0])
                ? " has a face on one side only"
                : ", a part of the border of the hull, has no solid face on its left");
  }

  [[nodiscard]] std::string find_missing_vertex() const {
    for (Index v = 0; v < sites_.size(); ++v) {
      if (sites_.name(v) != v) continue;
      const auto first = std::ranges::lower_bound(edges_, v, {}, &FaceEdge::from);
      if (first == edges_.end() || first->from != v) {
        return "site " + number(v) + " is no corner of a solid face";
      }
    }
    return {};
  }

  // Returns how many faces have a place, or nothing if it is on the plane of an edge.
  template <class Faces>
  [[nodiscard]] std::optional<std::size_t> count_around(const Point& place,
                                                        const Faces& faces) const {
    std::size_t count = 0;
    for (const Triple& face : faces) {
      bool is_inside = true;
      for (std::size_t i = 0; i < 3 && is_inside; ++i) {
        const Sign s =
            orientation(sites_.point(face[i]), sites_.point(face[(i + 1) % 3]), place, sphere_);
        if (s == Sign::zero) return {};
        is_inside = s == Sign::positive;
      }
      count += is_inside ? 1 : 0;
    }
    return count;
  }

  [[nodiscard]] std::string find_cover() const {
    std::vector<Triple> expected_faces;
    for (Index f = 0; f < delaunay_.num_faces(); ++f) {
      if (!delaunay_.is_ghost(f)) expected_faces.push_back(delaunay_.faces()[f]);
    }
    // Directions with other ratios each time: some are in no plane of an edge. Steps towards zero
    // do not leave the range of doubles.
    const auto step = [](double center, double size) {
      return center - std::copysign(std::max(1.0, std::abs(center)), center) / size;
    };
    for (double k = 1;; ++k) {
      const Point& center = sphere_.center;
      const Point place = {step(center.x, k), step(center.y, std::sqrt(k + 1)),
                           step(center.z, std::sqrt(k + 2))};
      const auto found = count_around(place, solid_);
      const auto expected = count_around(place, expected_faces);
      if (!found || !expected) continue;
      if (*found == *expected) return {};
      return "the faces cover a place " + number(*found) + " times that faces should cover " +
             number(*expected) + " times";
    }
  }

  // Returns the next vertex of the arc from v to b, or no_index.
  [[nodiscard]] Index next_on_arc(Index v, Index b) const {
    if (find_edge(v, b) != nullptr || find_edge(b, v) != nullptr) return b;
    auto edge = std::ranges::lower_bound(edges_, v, {}, &FaceEdge::from);
    for (; edge != edges_.end() && edge->from == v; ++edge) {
      // The face is left of the edge to `to`; it is right of that to `apex`.
      const Sign to = oriented(v, b, edge->to);
      const Sign apex = oriented(v, b, edge->apex);
      if (to == Sign::zero && apex == Sign::positive) return edge->to;
      if (apex == Sign::zero && to == Sign::negative) return edge->apex;
    }
    return no_index;
  }

  std::string find_broken_constraint(std::span<const std::array<Index, 2>> constraints) {
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      Index v = sites_.name(constraints[i][0]);
      const Index b = sites_.name(constraints[i][1]);
      while (v != b) {
        const Index w = next_on_arc(v, b);
        if (w == no_index) {
          return "constraint " + number(i) + " is no chain of edges: none leaves site " +
                 number(v) + " towards site " + number(b);
        }
        constrained_.emplace_back(std::min(v, w), std::max(v, w));
        v = w;
      }
    }
    std::ranges::sort(constrained_);
    return {};
  }

  [[nodiscard]] std::string find_edge_that_is_not_delaunay() const {
    for (const FaceEdge& edge : edges_) {
      if (edge.to < edge.from) continue;
      const FaceEdge* other = find_edge(edge.to, edge.from);
      if (other == nullptr || std::ranges::binary_search(constrained_, ends_of(edge))) continue;
      if (!is_in_conflict(sites_.point(edge.from), sites_.point(edge.to), sites_.point(edge.apex),
                          sites_.point(other->apex), Model::projected, sphere_)) {
        continue;
      }
      return "edge " + number(edge.from) + "-" + number(edge.to) + " of faces " +
             number(edge.face) + " and " + number(other->face) +
             " is neither constrained nor locally Delaunay: site " + number(other->apex) +
             " lies inside the circle of face " + number(edge.face);
    }
    return {};
  }

  const Triangulation& delaunay_;
  NamedSites sites_;
  Sphere sphere_;
  std::span<const Triple> triangles_;
  std::vector<Triple> solid_;
  std::vector<FaceEdge> edges_;  // of solid faces, sorted by ends
  std::vector<std::pair<Index, Index>> constrained_;
};

}  // namespace
}  // namespace constrained

CheckReport check_constrained(std::span<const Point> sites,
                              std::span<const std::array<Index, 2>> constraints,
                              std::span<const Triple> triangles, const Sphere& sphere,
                              const Execution& execution) {
  const system::Call call(execution);
  const Triangulation triangulation =
      delaunay(Sites::view(sites), {Model::projected, sphere}, execution);
  constrained::require_arcs(sites, constraints, sphere);
  CheckReport report;
  report.num_vertices = triangulation.num_vertices();
  report.num_duplicates = triangulation.duplicates().size();
  if (triangulation.dimension() < 2) {
    report.num_edges = report.num_vertices < 3 ? report.num_vertices / 2 : report.num_vertices;
    if (!triangles.empty()) {
      report.reason = "all sites lie on one great circle, so there are no faces; here are " +
                      constrained::number(triangles.size());
    }
  } else {
    constrained::ConstrainedCheck check(triangulation, triangles);
    report.reason = check.find_flaw(constraints);
    report.num_edges = check.num_edges();
  }
  report.is_valid = report.reason.empty();
  return report;
}

}  // namespace rondel
