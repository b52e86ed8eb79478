// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/hull_check.h"

#include <algorithm>
#include <tuple>

#include "support/oracle.h"
#include "support/surface_check.h"

namespace rondel::test {
namespace {

IntegerVector difference(const IntegerVector& a, const IntegerVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

bool is_zero(const IntegerVector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

// The rank, 3 at most, of vectors that come one after the other.
struct Rank {
  int value = 0;
  IntegerVector first;
  IntegerVector normal;  // of the plane that the first two independent vectors span

  void add(const IntegerVector& v) {
    if (value == 0) {
      first = v;
      value = is_zero(v) ? 0 : 1;
    } else if (value == 1) {
      normal = cross(first, v);
      value = is_zero(normal) ? 1 : 2;
    } else if (value == 2) {
      value = dot(normal, v) == 0 ? 2 : 3;
    }
  }
};

// A vertex of a closed convex surface is a corner if and only if the planes of its faces meet in it
// alone: their normals span space.
std::string corner_error(const Triangulation& hull, const Oracle& oracle) {
  std::vector<Rank> ranks(hull.num_sites());
  for (const auto& [a, b, c] : hull.faces()) {
    const IntegerVector normal = cross(difference(oracle.vector(b), oracle.vector(a)),
                                       difference(oracle.vector(c), oracle.vector(a)));
    for (const Index v : {a, b, c}) ranks[v].add(normal);
  }
  for (const Triple& face : hull.faces()) {
    for (const Index v : face) {
      if (ranks[v].value < 3) return text_of_all("vertex ", v, " is no corner");
    }
  }
  return {};
}

// Whether the closed cone of the face contains the site.
bool has_in_cone(const Triangulation& hull, const Oracle& oracle, Index f, Index site) {
  const auto& [a, b, c] = hull.faces()[f];
  return oracle.orientation(a, b, site) >= 0 && oracle.orientation(b, c, site) >= 0 &&
         oracle.orientation(c, a, site) >= 0;
}

// All faces at a vertex of `f`, which are those whose cones can contain the same site.
std::string first_face_error(const Triangulation& hull, const Oracle& oracle) {
  for (const Hidden& h : hull.hidden()) {
    if (oracle.is_center(h.site)) continue;
    if (hull.is_ghost(h.face)) return text_of_all("hidden ", h.site, ": ghost face");
    if (!has_in_cone(hull, oracle, h.face, h.site)) return text_of_all("hidden ", h.site, ": cone");
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Triple& face = hull.faces()[h.face];
      if (oracle.orientation(face[corner], face[(corner + 1) % 3], h.site) != 0) continue;
      Index f = h.face;
      const Index pivot = face[corner];
      do {
        if (f < h.face && !hull.is_ghost(f) && has_in_cone(hull, oracle, f, h.site)) {
          return text_of_all("hidden ", h.site, ": face ", f, " comes before ", h.face);
        }
        const Triple& v = hull.faces()[f];
        const auto at = static_cast<std::size_t>(std::ranges::find(v, pivot) - v.begin());
        f = hull.neighbors()[f][(at + 1) % 3];
      } while (f != h.face);
    }
  }
  return {};
}

bool is_smallest(const Point& p, std::span<const Point> points) {
  return std::ranges::all_of(
      points, [&p](const Point& q) { return std::tie(p.x, p.y, p.z) <= std::tie(q.x, q.y, q.z); });
}

// Every site is in the polygon of the ring, on the left of its edges seen from the side of the
// normal or, if it is no corner, on one.
std::string polygon_error(const Triangulation& hull, const Oracle& oracle) {
  const auto ring = hull.ring();
  const auto edge_normal = [&](std::size_t i, std::size_t p) {
    const IntegerVector& a = oracle.vector(ring[i]);
    const IntegerVector& b = oracle.vector(ring[(i + 1) % ring.size()]);
    return cross(difference(b, a), difference(oracle.vector(p), a));
  };
  const IntegerVector normal = edge_normal(0, ring[2]);
  const auto leading = std::ranges::find_if(normal, [](const mpz_class& x) { return x != 0; });
  if (leading == normal.end()) return "the first three corners are collinear";
  if (*leading < 0) return "the ring is clockwise";
  for (std::size_t p = 0; p < hull.num_sites(); ++p) {
    if (dot(normal, difference(oracle.vector(p), oracle.vector(ring[0]))) != 0) {
      return text_of_all("site ", p, " is not in the plane");
    }
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index next = ring[(i + 1) % ring.size()];
    for (std::size_t p = 0; p < hull.num_sites(); ++p) {
      const mpz_class side = dot(edge_normal(i, p), normal);
      if (side < 0) return text_of_all("site ", p, " is outside of the polygon");
      const bool is_end = oracle.is_same_site(p, ring[i]) || oracle.is_same_site(p, next);
      if (side == 0 && !is_end && !oracle.is_between(p, ring[i], next)) {
        return text_of_all("site ", p, " is beyond the end of an edge");
      }
      if (side == 0 && !is_end && std::ranges::find(ring, p) != ring.end()) {
        return text_of_all("corner ", p, " is on an edge");
      }
    }
  }
  return {};
}

std::string line_error(const Triangulation& hull, const Oracle& oracle) {
  const auto ring = hull.ring();
  for (std::size_t p = 0; p < hull.num_sites(); ++p) {
    if (oracle.is_same_site(p, ring[0]) || oracle.is_same_site(p, ring[1])) continue;
    const auto& a = oracle.vector(ring[0]);
    if (!is_zero(cross(difference(oracle.vector(ring[1]), a), difference(oracle.vector(p), a)))) {
      return text_of_all("site ", p, " is not on the line");
    }
    if (!oracle.is_between(p, ring[0], ring[1]))
      return text_of_all("site ", p, " is beyond the ends");
  }
  return {};
}

}  // namespace

std::string hull_error(const Triangulation& hull, std::span<const Point> points) {
  if (hull.model() != Model::weighted) return "model";
  for (const auto& check : {topology_error, order_error}) {
    if (auto error = check(hull); !error.empty()) return error;
  }
  if (auto error = geometry_error(hull, points); !error.empty()) return error;
  if (points.empty()) return hull.dimension() == -1 ? "" : "dimension of nothing";
  const bool is_inside = hull.dimension() == 2 && hull.num_ghost_faces() == 0;
  if (!is_inside && !is_smallest(hull.sphere().center, points)) return "center";
  const Oracle oracle(points, Model::weighted, hull.sphere());
  if (hull.dimension() == 2) {
    if (auto error = corner_error(hull, oracle); !error.empty()) return error;
    return first_face_error(hull, oracle);
  }
  if (hull.dimension() != (hull.ring().size() == 1 ? 0 : 1)) return "dimension of a flat hull";
  if (hull.ring().size() > 2) return polygon_error(hull, oracle);
  return hull.ring().size() == 2 ? line_error(hull, oracle) : "";
}

}  // namespace rondel::test
