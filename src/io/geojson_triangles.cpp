// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The solid faces as GeoJSON (RFC 7946), a feature each, with the property `sites`: the input
// indices of the corners. A ghost face covers, seen from the center, nothing that is not covered by
// others, flat or from behind; it is left out.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "io/geojson_geometry.h"
#include "io/lonlat_arc.h"
#include "io/lonlat_polygon.h"
#include "io/number.h"
#include "io/triangle_formats.h"

namespace rondel::io {
namespace {

// Sides are within a hundredth of a degree of the arcs, and within a tenth of the width
// of the thinner of the two faces at an edge, so that faces do not overlap; but never closer than
// a meter on the earth.
constexpr double tolerance_deg = 0.01;
constexpr double least_tolerance_deg = 1e-5;

class Faces {
 public:
  explicit Faces(const Mesh& mesh) : mesh_(mesh), triangulation_(mesh.triangulation) {}

  // The corners on the unit sphere.
  [[nodiscard]] std::array<Point, 3> ring(Index face) const {
    const auto& sites = mesh_.table.sites;
    const auto& [a, b, c] = triangulation_.faces()[face];
    return {direction(sites[a]), direction(sites[b]), direction(sites[c])};
  }

  // Doubles do not tell which way the arc between two opposite corners takes. A solid face has
  // none, but its corners may be opposite when they are rounded.
  [[nodiscard]] bool is_determined(const std::array<Point, 3>& ring) const {
    const auto are_opposite = [](const Point& p, const Point& q) {
      return norm(sum(p, q)) <= merge_distance;
    };
    return !are_opposite(ring[0], ring[1]) && !are_opposite(ring[1], ring[2]) &&
           !are_opposite(ring[2], ring[0]);
  }

  // The tolerances of the edges 01, 12 and 20.
  [[nodiscard]] std::array<double, 3> tolerances(Index face) const {
    const auto& neighbors = triangulation_.neighbors()[face];
    const double own = tolerance(face);
    const auto edge = [&](std::size_t opposite) {
      const Index neighbor = neighbors[opposite];
      return triangulation_.is_ghost(neighbor) ? own : std::min(own, tolerance(neighbor));
    };
    return {edge(2), edge(0), edge(1)};
  }

 private:
  [[nodiscard]] Point direction(const Point& site) const {
    const Point p = difference(site, triangulation_.sphere().center);
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return normalized({p.x / largest, p.y / largest, p.z / largest});
  }

  [[nodiscard]] double tolerance(Index face) const {
    const auto [a, b, c] = ring(face);
    const Point ab = difference(b, a);
    const Point bc = difference(c, b);
    const double longest = std::max({norm(ab), norm(bc), norm(difference(a, c))});
    if (longest == 0) return least_tolerance_deg;  // one place after rounding
    const double height_deg = norm(cross(ab, bc)) / longest * degrees_per_radian;
    return std::clamp(height_deg / 10, least_tolerance_deg, tolerance_deg);
  }

  const Mesh& mesh_;
  const Triangulation& triangulation_;
};

}  // namespace

void write_geojson(AtomicFile& file, const Mesh& mesh) {
  const Faces faces(mesh);
  Index first_solid = 0;
  while (first_solid < mesh.triangulation.num_faces() && mesh.triangulation.is_ghost(first_solid)) {
    ++first_solid;
  }
  file.write(R"({"type":"FeatureCollection","features":[)");
  mesh.write_faces(file, [&](std::string& text, Index face) {
    if (mesh.triangulation.is_ghost(face)) return;
    text += face == first_solid ? "\n" : ",\n";
    text += R"({"type":"Feature","properties":{"sites":[)";
    for (const Index corner : mesh.triangulation.faces()[face]) {
      append_integer(text, corner);
      text += ',';
    }
    text.back() = ']';
    text += R"(},"geometry":)";
    const auto ring = faces.ring(face);
    if (faces.is_determined(ring)) {
      append_geometry(text, lonlat_polygons(ring, faces.tolerances(face)));
    } else {
      append_geometry(text, {});
    }
    text += '}';
  });
  file.write("\n]}\n");
}

}  // namespace rondel::io
