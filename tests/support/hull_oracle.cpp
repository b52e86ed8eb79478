// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/hull_oracle.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>

#include "support/surface_check.h"

namespace rondel::test {
namespace {

// The signs of all 4-subsets, computed once each.
class SideTable {
 public:
  explicit SideTable(const Oracle& oracle) : oracle_(oracle) {}

  int side(std::array<std::size_t, 4> q) {
    int parity = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j + 1 < 4; ++j) {
        if (q[j] > q[j + 1]) {
          std::swap(q[j], q[j + 1]);
          parity = -parity;
        }
      }
    }
    const auto [entry, is_new] = known_.try_emplace(q, 0);
    if (is_new) entry->second = oracle_.perturbed_side(q[0], q[1], q[2], q[3]);
    return parity * entry->second;
  }

  bool is_face(std::size_t a, std::size_t b, std::size_t c) {
    for (std::size_t p = 0; p < oracle_.size(); ++p) {
      if (p != a && p != b && p != c && side({a, b, c, p}) >= 0) return false;
    }
    return true;
  }

 private:
  const Oracle& oracle_;
  std::map<std::array<std::size_t, 4>, int> known_;
};

void add_faces(const Oracle& oracle, const Places& places, Hull& hull) {
  SideTable table(oracle);
  const std::size_t n = oracle.size();
  std::vector<bool> is_vertex(n);
  const auto try_face = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (!table.is_face(a, b, c)) return;
    const Triple face = lowest_first({places.index[a], places.index[b], places.index[c]});
    hull.faces.insert(face);
    if (oracle.orientation(a, b, c) <= 0) hull.ghosts.insert(face);
    is_vertex[a] = is_vertex[b] = is_vertex[c] = true;
  };
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        try_face(a, b, c);
        try_face(a, c, b);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_vertex[i]) hull.hidden.push_back(places.index[i]);
  }
}

// The sites for which all others are on the left of the line to the next. A site between
// two others in line with the center is hidden.
void add_ring(const Oracle& oracle, const Places& places, Hull& hull) {
  const std::size_t n = oracle.size();
  const auto is_left_or_between = [&](std::size_t a, std::size_t b, std::size_t p) {
    if (p == a || p == b) return true;
    const int sign = oracle.flat_orientation(a, b, p);
    return sign != 0 ? sign > 0 : oracle.is_between(p, a, b);
  };
  std::map<std::size_t, std::size_t> next;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      bool is_edge = a != b;
      for (std::size_t p = 0; p < n && is_edge; ++p) is_edge = is_left_or_between(a, b, p);
      if (is_edge) next[a] = b;
    }
  }
  const std::size_t start = next.begin()->first;
  std::size_t site = start;
  do {
    hull.ring.push_back(places.index[site]);
    site = next.at(site);
  } while (site != start && hull.ring.size() <= n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!next.contains(i)) hull.hidden.push_back(places.index[i]);
  }
}

std::string text(const Triple& t) {
  std::ostringstream out;
  out << '(' << t[0] << ' ' << t[1] << ' ' << t[2] << ')';
  return out.str();
}

std::string set_difference_text(const char* what, const std::set<Triple>& actual,
                                const std::set<Triple>& expected) {
  for (const Triple& t : actual) {
    if (!expected.contains(t)) return std::string("unexpected ") + what + ' ' + text(t);
  }
  for (const Triple& t : expected) {
    if (!actual.contains(t)) return std::string("missing ") + what + ' ' + text(t);
  }
  return {};
}

}  // namespace

Triple lowest_first(const Triple& face) {
  Triple result = face;
  std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  return result;
}

Places distinct_places(std::span<const Point> sites, Model model, const Sphere& sphere) {
  const Oracle oracle(sites, model, sphere);
  Places places;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    std::size_t place = 0;
    while (place < places.index.size() && !oracle.is_same_site(i, places.index[place])) ++place;
    if (place == places.index.size()) {
      places.index.push_back(static_cast<Index>(i));
      places.representative.push_back(sites[i]);
      continue;
    }
    places.duplicates.push_back({static_cast<Index>(i), places.index[place]});
    Point& representative = places.representative[place];
    if (std::tie(sites[i].x, sites[i].y, sites[i].z) <
        std::tie(representative.x, representative.y, representative.z)) {
      representative = sites[i];
    }
  }
  return places;
}

Hull brute_force_hull(std::span<const Point> sites, Model model, const Sphere& sphere) {
  const Places places = distinct_places(sites, model, sphere);
  Hull hull;
  hull.duplicates = places.duplicates;
  const Oracle oracle(places.representative, model, sphere);
  if (oracle.size() < 2) {
    hull.dimension = static_cast<int>(oracle.size()) - 1;
    hull.ring = places.index;
  } else if (oracle.is_flat()) {
    hull.dimension = 1;
    add_ring(oracle, places, hull);
  } else {
    hull.dimension = 2;
    add_faces(oracle, places, hull);
  }
  return hull;
}

std::string difference(const Triangulation& triangulation, std::span<const Point> sites,
                       const Hull& expected) {
  if (triangulation.num_sites() != sites.size()) return "number of sites";
  if (triangulation.dimension() != expected.dimension) {
    return "dimension " + std::to_string(triangulation.dimension()) + " instead of " +
           std::to_string(expected.dimension);
  }
  if (!std::ranges::equal(triangulation.duplicates(), expected.duplicates)) return "duplicates";
  std::set<Triple> faces;
  std::set<Triple> ghosts;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    const Triple face = lowest_first(triangulation.faces()[f]);
    if (!faces.insert(face).second) return "face twice " + text(face);
    if (triangulation.is_ghost(f)) ghosts.insert(face);
  }
  if (auto error = set_difference_text("face", faces, expected.faces); !error.empty()) return error;
  if (auto error = set_difference_text("ghost", ghosts, expected.ghosts); !error.empty()) {
    return error;
  }
  std::vector<Index> ring(triangulation.ring().begin(), triangulation.ring().end());
  std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
  if (ring != expected.ring) return "ring";
  if (!std::ranges::equal(triangulation.hidden(), expected.hidden, {}, &Hidden::site)) {
    return "hidden sites";
  }
  for (const auto& check : {topology_error, order_error}) {
    if (auto error = check(triangulation); !error.empty()) return error;
  }
  return geometry_error(triangulation, sites);
}

}  // namespace rondel::test
