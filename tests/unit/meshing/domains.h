// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Domains for tests of their triangles: boxes, polygons and lines in degrees.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/mesh_triangles.h"
#include "rondel/sites.h"

namespace rondel::test {

using mesh::DomainTriangles;
using mesh::FeatureOfEdge;
using mesh::MeshDomain;
using mesh::triangles;
using mesh::TrianglesOptions;
using Ring = std::vector<LonLat>;

// A feature of one polygon, or of lines.
inline Geometries polygon(const std::vector<Ring>& rings) {
  Geometries geometries;
  for (const Ring& ring : rings) {
    for (const Point& point : unit_vectors(ring)) {
      geometries.polygons.corners.push_back(static_cast<Index>(geometries.polygons.points.size()));
      geometries.polygons.points.push_back(point);
    }
    geometries.polygons.end_ring();
  }
  geometries.polygons.end_cell();
  geometries.lines.end_group();
  return geometries;
}

inline Geometries line(const Ring& positions) {
  Geometries geometries;
  geometries.lines.rows.append(unit_vectors(positions));
  geometries.lines.end_group();
  geometries.polygons.end_cell();
  return geometries;
}

// All features of some, as one file has them.
inline Geometries together(const std::vector<Geometries>& features) {
  Geometries all;
  for (const Geometries& some : features) {
    for (std::size_t k = 0; k < some.lines.rows.size(); ++k) {
      all.lines.rows.append(some.lines.rows[k]);
    }
    all.lines.end_group();
    for (std::uint64_t r = 0; r + 1 < some.polygons.rings.size(); ++r) {
      for (const Index corner : some.polygons.corners_of(r)) {
        all.polygons.corners.push_back(static_cast<Index>(all.polygons.points.size()));
        all.polygons.points.push_back(some.polygons.points[corner]);
      }
      all.polygons.end_ring();
    }
    all.polygons.end_cell();
  }
  return all;
}

inline Ring box(double west, double south, double east, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}

inline TrianglesOptions spaced(double degrees) {
  TrianglesOptions options;
  options.refine.spacing = mesh::SizeFunction::constant(degrees * std::numbers::pi / 180, 64);
  options.tolerance = 0;
  return options;
}

// The triangles by their corners, whatever numbers these have.
inline std::set<std::array<std::tuple<double, double, double>, 3>> places_of(
    const DomainTriangles& made) {
  std::set<std::array<std::tuple<double, double, double>, 3>> places;
  for (const Triple& triangle : made.mesh.triangles) {
    std::array<std::tuple<double, double, double>, 3> corners;
    for (unsigned i = 0; i < 3; ++i) {
      const Point& p = made.mesh.nodes[triangle[i]];
      corners[i] = {p.x, p.y, p.z};
    }
    std::ranges::sort(corners);
    places.insert(corners);
  }
  return places;
}

inline void expect_same(const DomainTriangles& one, const DomainTriangles& other) {
  EXPECT_TRUE(std::ranges::equal(one.mesh.nodes, other.mesh.nodes));
  EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
  EXPECT_EQ(one.mesh.edges, other.mesh.edges);
  EXPECT_EQ(one.features, other.features);
}

// Returns the lengths of the edges of all triangles in degrees.
inline std::vector<double> edge_lengths(const DomainTriangles& made) {
  std::vector<double> lengths;
  for (const auto& [a, b, c] : made.mesh.triangles) {
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      const Point& from = made.mesh.nodes[p];
      const Point& to = made.mesh.nodes[q];
      const double chord = std::hypot(from.x - to.x, from.y - to.y, from.z - to.z);
      lengths.push_back(2 * std::asin(chord / 2) * 180 / std::numbers::pi);
    }
  }
  return lengths;
}

inline double shortest_edge(const DomainTriangles& made) {
  return std::ranges::min(edge_lengths(made));
}
inline double longest_edge(const DomainTriangles& made) {
  return std::ranges::max(edge_lengths(made));
}

}  // namespace rondel::test
