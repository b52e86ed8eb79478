// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/surface_check.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "support/oracle.h"

namespace rondel::test {
namespace {

// The position in `face` of the corner opposite to the edge shared with `other`, given the edge's
// ends in the order in which `face` has them; 3 if it is not there.
unsigned opposite_corner(const Triple& face, Index from, Index to) {
  for (unsigned i = 0; i < 3; ++i) {
    if (face[(i + 1) % 3] == from && face[(i + 2) % 3] == to) return i;
  }
  return 3;
}

std::string neighbors_error(const Triangulation& t) {
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Triple& face = t.faces()[f];
    for (unsigned i = 0; i < 3; ++i) {
      const Index g = t.neighbors()[f][i];
      if (face[i] >= t.num_sites()) return text_of_all("face ", f, ": corner out of range");
      if (g >= t.num_faces()) return text_of_all("face ", f, ": neighbor out of range");
      const unsigned j = opposite_corner(t.faces()[g], face[(i + 2) % 3], face[(i + 1) % 3]);
      if (j == 3 || t.neighbors()[g][j] != f)
        return text_of_all("faces ", f, ", ", g, ": not mutual");
    }
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
      return text_of_all("face ", f, ": corners not distinct");
    }
  }
  return {};
}

// Every site is a vertex, a duplicate or hidden, and only one of these.
std::string account_error(const Triangulation& t) {
  std::vector<int> role(t.num_sites(), 0);
  for (const Triple& face : t.faces()) {
    for (const Index corner : face) role[corner] = 1;
  }
  for (const Index site : t.ring()) {
    if (site >= t.num_sites()) return "ring: site out of range";
    if (role[site] != 0) return text_of_all("ring: site ", site, " twice");
    role[site] = 1;
  }
  const auto vertices = static_cast<std::size_t>(std::ranges::count(role, 1));
  if (vertices != t.num_vertices()) return text_of_all("vertices: ", vertices);
  if (t.dimension() == 2 && t.num_faces() != 2 * vertices - 4)
    return text_of_all("faces: ", t.num_faces());
  if (t.dimension() != 2 && t.num_faces() != 0) return "faces below dimension 2";
  for (const Duplicate& d : t.duplicates()) {
    if (d.site >= t.num_sites() || role[d.site] != 0) return text_of_all("duplicate ", d.site);
    if (d.representative >= d.site) return text_of_all("representative ", d.representative);
    role[d.site] = 2;
  }
  for (const Hidden& h : t.hidden()) {
    if (h.site >= t.num_sites() || role[h.site] != 0) return text_of_all("hidden ", h.site);
    if (t.dimension() == 2 ? h.face >= t.num_faces() : h.face != no_index) {
      return text_of_all("hidden ", h.site, ": face ", h.face);
    }
    role[h.site] = 3;
  }
  for (const Duplicate& d : t.duplicates()) {
    if (role[d.representative] == 2) return text_of_all("representative ", d.representative);
  }
  const auto missing = std::ranges::find(role, 0) - role.begin();
  if (missing != static_cast<std::ptrdiff_t>(role.size()))
    return text_of_all("lost site ", missing);
  return {};
}

bool is_connected(const Triangulation& t) {
  if (t.num_faces() == 0) return true;
  std::vector<bool> seen(t.num_faces());
  std::vector<Index> stack = {0};
  seen[0] = true;
  std::size_t count = 0;
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    ++count;
    for (const Index g : t.neighbors()[f]) {
      if (!seen[g]) stack.push_back(g);
      seen[g] = true;
    }
  }
  return count == t.num_faces();
}

// The number of faces through which the ray of `direction` from the center leaves (+1) or enters
// (-1) the surface must be 1 in sum if the center is inside and 0 otherwise; each kind at most
// once.
std::string covering_error(const Triangulation& t, const Oracle& oracle,
                           const IntegerVector& direction) {
  int leaves = 0;
  int enters = 0;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Triple& face = t.faces()[f];
    std::array<int, 3> signs{};
    for (unsigned i = 0; i < 3; ++i) {
      signs[i] =
          sgn(determinant(oracle.vector(face[i]), oracle.vector(face[(i + 1) % 3]), direction));
    }
    if (!t.is_ghost(f) && std::ranges::count(signs, 1) == 3) ++leaves;
    if (t.is_ghost(f) && std::ranges::count(signs, -1) == 3) ++enters;
  }
  if (leaves != 1 || enters > (t.num_ghost_faces() == 0 ? 0 : 1)) {
    return text_of_all("the surface is left ", leaves, " times and entered ", enters, " times");
  }
  return {};
}

// With the center inside, below a face means in its cone.
std::string hidden_error(const Triangulation& t, const Oracle& oracle) {
  for (const Hidden& h : t.hidden()) {
    if (h.face == no_index) continue;
    const Triple& face = t.faces()[h.face];
    if (oracle.side_of_circle(face[0], face[1], face[2], h.site) > 0) {
      return text_of_all("hidden ", h.site, " is above its face");
    }
    for (unsigned i = 0; i < 3 && t.num_ghost_faces() == 0; ++i) {
      if (oracle.orientation(face[i], face[(i + 1) % 3], h.site) < 0) {
        return text_of_all("hidden ", h.site, " is not below its face");
      }
    }
  }
  return {};
}

}  // namespace

std::string topology_error(const Triangulation& t) {
  if (t.faces().size() != t.neighbors().size()) return "lengths of faces and neighbors differ";
  if (!std::ranges::is_sorted(t.ghost_faces()) ||
      !std::ranges::is_sorted(t.duplicates(), {}, &Duplicate::site) ||
      !std::ranges::is_sorted(t.hidden(), {}, &Hidden::site)) {
    return "a list is not sorted";
  }
  if (auto error = neighbors_error(t); !error.empty()) return error;
  if (auto error = account_error(t); !error.empty()) return error;
  return is_connected(t) ? "" : "more than one surface";
}

std::string order_error(const Triangulation& t) {
  // An owner comes before the other corners of its faces; those that own no face come last.
  std::vector<std::size_t> place(t.num_sites(), t.num_sites());
  std::size_t owners = 0;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Index owner = t.faces()[f][0];
    if (f > 0 && owner == t.faces()[f - 1][0]) continue;
    if (place[owner] != t.num_sites()) return text_of_all("faces of owner ", owner, " are apart");
    place[owner] = owners++;
  }
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Triple& face = t.faces()[f];
    if (place[face[0]] >= place[face[1]] || place[face[0]] >= place[face[2]]) {
      return text_of_all("face ", f, " does not start with its first corner");
    }
  }
  // Counterclockwise around the owner: from face to face the walk over the edge opposite to corner
  // 1 never passes the first face of the owner again before the last.
  for (Index first = 0; first < t.num_faces();) {
    const Index owner = t.faces()[first][0];
    Index next = first + 1;
    Index f = first;
    for (;;) {
      const auto corner =
          static_cast<std::size_t>(std::ranges::find(t.faces()[f], owner) - t.faces()[f].begin());
      f = t.neighbors()[f][(corner + 1) % 3];
      if (f == first) break;
      if (t.faces()[f][0] == owner && f != next++)
        return text_of_all("face ", f, " is out of order");
    }
    first = next;
  }
  return {};
}

std::string geometry_error(const Triangulation& t, std::span<const Point> sites) {
  const Oracle oracle(sites, t.model(), t.sphere());
  for (const Duplicate& d : t.duplicates()) {
    if (!oracle.is_same_site(d.site, d.representative)) return text_of_all("duplicate ", d.site);
  }
  if (t.dimension() != 2) return {};
  // Ties are decided by the place of a duplicated site with the smallest coordinates.
  std::vector<std::size_t> representative(sites.size());
  std::iota(representative.begin(), representative.end(), std::size_t{0});
  for (const Duplicate& d : t.duplicates()) {
    const Point& p = sites[d.site];
    const Point& q = sites[representative[d.representative]];
    if (std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z))
      representative[d.representative] = d.site;
  }
  IntegerVector direction;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const Triple& face = t.faces()[f];
    const std::size_t a = representative[face[0]];
    const std::size_t b = representative[face[1]];
    const std::size_t c = representative[face[2]];
    if ((oracle.orientation(a, b, c) <= 0) != t.is_ghost(f))
      return text_of_all("ghost flag of face ", f);
    if (direction == IntegerVector{} && !t.is_ghost(f)) {
      for (std::size_t i = 0; i < 3; ++i) {
        direction[i] = 5 * oracle.vector(a)[i] + 3 * oracle.vector(b)[i] + 4 * oracle.vector(c)[i];
      }
    }
    for (unsigned i = 0; i < 3; ++i) {
      const Index g = t.neighbors()[f][i];
      if (g < f) continue;
      const unsigned j = opposite_corner(t.faces()[g], face[(i + 2) % 3], face[(i + 1) % 3]);
      const Index across = t.faces()[g][j];
      if (across == face[i]) continue;  // three vertices: both sides of one triangle
      if (oracle.perturbed_side(a, b, c, representative[across]) >= 0) {
        return text_of_all("the edge between faces ", f, " and ", g, " is not regular");
      }
    }
  }
  if (auto error = hidden_error(t, oracle); !error.empty()) return error;
  if (direction == IntegerVector{}) return {};
  return covering_error(t, oracle, direction);
}

}  // namespace rondel::test
