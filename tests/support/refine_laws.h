// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What refine() promises of any triangulation, checked without a look at how it works: sizes of
// arrays, positive triangles that fit together, constrained Delaunay, angles, lengths, areas and
// chains of edges.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/error.h"
#include "rondel/mesh_refine.h"
#include "rondel/predicates.h"
#include "support/generators.h"

namespace rondel::test {

inline double dot_product(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double length_of(const Point& a) { return std::sqrt(dot_product(a, a)); }
// Returns a unit vector, whatever the size of the numbers.
inline Point unit_of(const Point& p) {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const int exponent = std::ilogb(largest);
  return normalized(
      {std::scalbn(p.x, -exponent), std::scalbn(p.y, -exponent), std::scalbn(p.z, -exponent)});
}
inline double chord_length(const Point& a, const Point& b) { return length_of(b - a); }

class RefineLaws {
 public:
  using Ends = std::array<Index, 2>;

  RefineLaws(const ConstrainedTriangulation& given, std::span<const Index> regions,
             const mesh::RefineOptions& options, const mesh::RefinedMesh& mesh)
      : given_(given), regions_(regions), options_(options), mesh_(mesh) {
    for (const Point& p : mesh.nodes) nodes_.push_back(unit_of(p));
  }

  // Returns what is wrong first, or nothing.
  [[nodiscard]] std::string flaw() const {
    for (const auto& law :
         {&RefineLaws::flaw_of_arrays, &RefineLaws::flaw_of_sides, &RefineLaws::flaw_of_circles,
          &RefineLaws::flaw_of_shapes, &RefineLaws::flaw_of_areas, &RefineLaws::flaw_of_chains}) {
      const std::string text = (this->*law)();
      if (!text.empty()) return text;
    }
    return {};
  }

 private:
  // A chain leaves its constraint by the rounding of its points, which adds up where many divisions
  // follow each other and which the middle of nearly opposite points magnifies.
  static constexpr double farthest = 0x1p-48;

  [[nodiscard]] std::string flaw_of_arrays() const {
    if (mesh_.nodes.size() != mesh_.sites.size()) return "nodes have no sites";
    if (mesh_.triangles.size() != mesh_.regions.size()) return "triangles have no regions";
    if (mesh_.edges.size() != mesh_.sources.size()) return "edges have no sources";
    std::vector<bool> is_used(mesh_.nodes.size(), false);
    for (const Triple& t : mesh_.triangles) {
      for (const Index v : t) {
        if (v >= mesh_.nodes.size()) return "a corner is no node";
        is_used[v] = true;
      }
    }
    if (std::ranges::count(is_used, false) > 0) return "a node is no corner";
    const std::span<const Point> sites = given_.triangulation.sites().points();
    for (std::size_t v = 0; v < mesh_.nodes.size(); ++v) {
      const Index site = mesh_.sites[v];
      if (site != no_index ? !(mesh_.nodes[v] == sites[site])
                           : std::abs(length_of(mesh_.nodes[v]) - 1) > 0x1p-51) {
        return "node " + std::to_string(v) + " is neither its site nor a unit vector";
      }
    }
    if (!std::ranges::is_sorted(mesh_.edges) ||
        std::ranges::adjacent_find(mesh_.edges) != mesh_.edges.end()) {
      return "edges are not in order";
    }
    const bool is_upwards =
        std::ranges::all_of(mesh_.edges, [](const Ends& e) { return e[0] < e[1]; });
    return is_upwards ? "" : "an edge has its lower node last";
  }

  // Triangles are positive, and `edges` are those between regions, at the border and of sources.
  [[nodiscard]] std::string flaw_of_sides() const {
    std::map<Ends, Index> region_on_left;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (orientation(mesh_.nodes[a], mesh_.nodes[b], mesh_.nodes[c]) != Sign::positive) {
        return "triangle " + std::to_string(t) + " is not positive";
      }
      for (const Ends& side : {Ends{a, b}, Ends{b, c}, Ends{c, a}}) {
        if (!region_on_left.emplace(side, mesh_.regions[t]).second) return "triangles overlap";
      }
    }
    for (const auto& [side, region] : region_on_left) {
      const auto other = region_on_left.find({side[1], side[0]});
      const auto [low, high] = std::minmax(side[0], side[1]);
      const bool is_border = other == region_on_left.end() || other->second != region;
      if (is_border && !std::ranges::binary_search(mesh_.edges, Ends{low, high})) {
        return "an edge at a border is missing";
      }
    }
    for (const auto& [low, high] : mesh_.edges) {
      if (!region_on_left.contains({low, high}) && !region_on_left.contains({high, low})) {
        return "an edge is no side";
      }
    }
    return {};
  }

  static Triple from_lowest(const Triple& t) {
    Triple turned = t;
    std::rotate(turned.begin(), std::ranges::min_element(turned), turned.end());
    return turned;
  }

  [[nodiscard]] std::string flaw_of_circles() const {
    try {
      const auto again = constrained_delaunay(Sites::view(mesh_.nodes), mesh_.edges);
      std::vector<Triple> faces;
      for (const Triple& f : again.triangulation.faces()) faces.push_back(from_lowest(f));
      std::ranges::sort(faces);
      for (const Triple& t : mesh_.triangles) {
        if (!std::ranges::binary_search(faces, from_lowest(t))) {
          return "a triangle is not constrained Delaunay";
        }
      }
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return {};
  }

  // Counts the triangles that are surely not as wanted, and those that may not be.
  [[nodiscard]] std::string flaw_of_shapes() const {
    std::size_t sure = 0;
    std::size_t possible = 0;
    for (const Triple& t : mesh_.triangles) {
      std::array<double, 3> sides{};
      double wish = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i) {
        sides.at(i) = chord_length(nodes_[t.at((i + 1) % 3)], nodes_[t.at((i + 2) % 3)]);
        if (!options_.spacing) continue;
        wish = std::min(wish, 2 * std::sin(options_.spacing->spacing(mesh_.nodes[t.at(i)]) / 2));
      }
      std::ranges::sort(sides);
      const auto& [a, b, c] = sides;
      const double cosine = (b * b + c * c - a * a) / (2 * b * c);
      const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.141592653589793;
      const double doubt = 1e-6 + 1e-13 / a;
      if (angle < options_.smallest_angle_deg - doubt || c > 1.5 * wish * (1 + doubt)) ++sure;
      // The diameter of the circle is bounded, too.
      const double area4 = std::sqrt((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c));
      const double diameter = 2 * a * b * c / area4;
      if (angle < options_.smallest_angle_deg + doubt || !(diameter < 1.5 * wish * (1 - doubt))) {
        ++possible;
      }
    }
    const std::size_t reported = mesh_.report.num_near_small_angles + mesh_.report.num_too_small;
    if (reported < sure)
      return std::to_string(sure) + " triangles are bad, not " + std::to_string(reported);
    if (reported > possible)
      return std::to_string(possible) + " triangles may be bad, not " + std::to_string(reported);
    return {};
  }

  static double area_of(const Point& a, const Point& b, const Point& c) {
    const double volume = std::abs(dot_product(a, cross_product(b - a, c - a)));
    return 2 * std::atan2(volume, 1 + dot_product(a, b) + dot_product(b, c) + dot_product(c, a));
  }

  // The triangles of each region have the area of its faces.
  [[nodiscard]] std::string flaw_of_areas() const {
    std::map<Index, double> areas;
    std::map<Index, double> doubts;
    const auto add = [&](const Point& a, const Point& b, const Point& c, Index region,
                         double sign) {
      const double area = area_of(a, b, c);
      areas[region] += sign * area;
      // A face may be close to a hemisphere, or two of its corners to being opposite.
      const double sum = std::min({length_of(a + b), length_of(b + c), length_of(c + a)});
      if (area > 3 || sum < 0x1p-20) doubts[region] = 12;
      doubts[region] +=
          1e-12 * area + 0x1p-48 * (length_of(b - a) + length_of(c - b)) / std::min(1.0, sum);
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      add(nodes_[a], nodes_[b], nodes_[c], mesh_.regions[t], 1);
    }
    const std::span<const Point> sites = given_.triangulation.sites().points();
    for (Index f = 0; f < regions_.size(); ++f) {
      if (given_.triangulation.is_ghost(f) || regions_[f] == no_index) continue;
      const auto& [a, b, c] = given_.triangulation.faces()[f];
      add(unit_of(sites[a]), unit_of(sites[b]), unit_of(sites[c]), regions_[f], -1);
    }
    for (const auto& [region, area] : areas) {
      if (!(std::abs(area) <= doubts[region])) {
        return "region " + std::to_string(region) + " has another area, by " +
               std::to_string(area / doubts[region]) + " tolerances";
      }
    }
    return {};
  }

  // Each constrained edge of a face that is asked for is a chain from one end to the other.
  [[nodiscard]] std::string flaw_of_chains() const {
    std::vector<std::vector<Ends>> pieces(given_.edges.size());
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      if (mesh_.sources[e] == no_index) continue;
      if (mesh_.sources[e] >= pieces.size()) return "a source is no edge";
      pieces[mesh_.sources[e]].push_back(mesh_.edges[e]);
    }
    std::vector<bool> is_asked_for(pieces.size(), false);
    for (Index f = 0; f < regions_.size(); ++f) {
      if (given_.triangulation.is_ghost(f) || regions_[f] == no_index) continue;
      const Triple& corners = given_.triangulation.faces()[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(corners.at((i + 1) % 3), corners.at((i + 2) % 3));
        const auto found = std::ranges::lower_bound(given_.edges, Ends{low, high});
        if (found == given_.edges.end() || *found != Ends{low, high}) continue;
        is_asked_for[static_cast<std::size_t>(found - given_.edges.begin())] = true;
      }
    }
    for (std::size_t e = 0; e < pieces.size(); ++e) {
      if (is_asked_for[e] != !pieces[e].empty()) return "a chain is missing, or idle";
      const std::string flaw = flaw_of_chain(given_.edges[e], pieces[e]);
      if (!flaw.empty()) return "constrained edge " + std::to_string(e) + flaw;
    }
    return {};
  }

  [[nodiscard]] std::string flaw_of_chain(const Ends& ends, const std::vector<Ends>& chain) const {
    if (chain.empty()) return {};
    const std::span<const Point> sites = given_.triangulation.sites().points();
    const Point a = unit_of(sites[ends[0]]);
    const Point b = unit_of(sites[ends[1]]);
    const Point normal = normalized(cross_product(a, b - a));
    std::map<Index, std::vector<Index>> next;
    for (const auto& [v, w] : chain) {
      next[v].push_back(w);
      next[w].push_back(v);
    }
    Index before = no_index;
    Index at = no_index;
    for (const auto& [v, ways] : next) {
      const double beside = dot_product(nodes_[v] - a, normal);
      if (std::abs(beside) * std::min(1.0, length_of(a + b)) > farthest) {
        return " is left by " + std::to_string(beside * 0x1p52) + " times 2^-52";
      }
      if (mesh_.sites[v] == ends[0]) at = v;
    }
    for (std::size_t steps = 0; steps < chain.size(); ++steps) {
      if (at == no_index || next[at].size() != (before == no_index ? 1U : 2U)) return " has a gap";
      const Index after = next[at].front() != before ? next[at].front() : next[at].back();
      before = std::exchange(at, after);
    }
    return mesh_.sites[at] == ends[1] && next[at].size() == 1 ? "" : " does not end where it did";
  }

  const ConstrainedTriangulation& given_;
  std::span<const Index> regions_;
  const mesh::RefineOptions& options_;
  const mesh::RefinedMesh& mesh_;
  std::vector<Point> nodes_;  // unit vectors
};

// The triangles and edges of a mesh as points, whatever the numbers of its nodes.
struct RefinedPoints {
  std::vector<std::array<double, 10>> triangles;  // with their regions
  std::vector<std::array<double, 6>> edges;
  friend bool operator==(const RefinedPoints&, const RefinedPoints&) = default;
};

inline RefinedPoints points_of(const mesh::RefinedMesh& mesh) {
  using Coordinates = std::array<double, 3>;
  const auto at = [&](Index v) {
    const Point& p = mesh.nodes[v];
    return Coordinates{p.x, p.y, p.z};
  };
  RefinedPoints points;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    std::array<Coordinates, 3> corners = {at(a), at(b), at(c)};
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    const auto& [p, q, r] = corners;
    points.triangles.push_back({p[0], p[1], p[2], q[0], q[1], q[2], r[0], r[1], r[2],
                                static_cast<double>(mesh.regions[t])});
  }
  for (const auto& [a, b] : mesh.edges) {
    const Coordinates p = std::min(at(a), at(b));
    const Coordinates q = std::max(at(a), at(b));
    points.edges.push_back({p[0], p[1], p[2], q[0], q[1], q[2]});
  }
  std::ranges::sort(points.triangles);
  std::ranges::sort(points.edges);
  return points;
}

// A region for each face that does not depend on the order of its corners: the number of its
// corners with a positive coordinate, of which some are left out.
inline std::vector<Index> regions_by_sign(const Triangulation& triangulation,
                                          double Point::*coordinate, Index left_out) {
  std::vector<Index> regions;
  for (const Triple& face : triangulation.faces()) {
    const auto count = static_cast<Index>(std::ranges::count_if(
        face, [&](Index v) { return triangulation.sites().points()[v].*coordinate > 0; }));
    regions.push_back(count == left_out ? no_index : count / 2);
  }
  return regions;
}

}  // namespace rondel::test
