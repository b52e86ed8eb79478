// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Where sites are, and where there are none: hulls, alpha shapes and empty circles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Polygons whose corners are sites. Polygon i has the rings polygon_offsets[i] ... polygon_offsets[i+1]-1, and
/// ring j the sites ring_offsets[j] ... ring_offsets[j+1]-1.
///
/// 1. Sides are the shorter arcs of great circles, the inside is to the left of all rings.
/// 2. A polygon's inside is connected, its rings are simple and meet at most in sites; polygons too.
/// 3. A polygon without rings is the whole sphere.
struct Outline {
  std::vector<std::uint64_t> polygon_offsets = {0};
  std::vector<std::uint64_t> ring_offsets = {0};
  std::vector<Index> sites;

  [[nodiscard]] std::size_t num_polygons() const noexcept { return polygon_offsets.size() - 1; }
};

/// The convex hull on the sphere: the union of the solid faces, exactly. One polygon; the whole sphere for
/// sites that no closed hemisphere has, none below dimension 2. Sites on its sides are corners.
RONDEL_API Outline hull_polygon(const Triangulation& triangulation);

/// The union of the solid faces whose circle has a radius of at most so many radians, as rounded. Faces
/// with one circle are in it all or none.
/// \throws InvalidInput if the radius is negative or not a number, or the sites are weighted.
RONDEL_API Outline alpha_shape(const Triangulation& triangulation, double radius,
                               const Execution& execution = {});

/// A circle with no site inside.
struct EmptyCircle {
  Point center;       ///< a unit vector from the center of the sphere
  double radius = 0;  ///< radians, to 2e-15
  std::array<Index, 3> sites = {no_index, no_index, no_index};  ///< on it; there may be more
};

/// Where the centers of circles may be.
enum class CircleCenters : std::uint8_t {
  inside,    ///< in solid faces
  anywhere,  ///< also beyond a regional set, where radii go up to 180 degrees
};

/// The k largest circles of the faces, the largest first; all if there are fewer. Faces with one circle
/// count once. Of equal radii (as rounded) that of the first face comes first. Below dimension 2 there are none
/// but, anywhere, those around the poles of a great circle of sites that no open half of it has. A circle of a face touches
/// three sites: where all are in half of the sphere, one that touches two alone may be larger.
/// \throws InvalidInput if the sites are weighted.
RONDEL_API std::vector<EmptyCircle> largest_empty_circles(
    const Triangulation& triangulation, std::size_t k,
    CircleCenters centers = CircleCenters::inside, const Execution& execution = {});

/// Writes a feature a polygon: .geojson (RFC 7946), a MultiPolygon cut at the antimeridian and the poles, with
/// the number `sites` of its corners. \throws InvalidInput if the arrays do not fit together.
RONDEL_API void write_outline(const FileName& file, const Triangulation& triangulation,
                              const Outline& outline, double tolerance_deg = 0.01,
                              const Execution& execution = {});

/// Writes a row or feature a circle, its center with `radius_deg` and the sites `a`, `b`, `c`: .csv (with `lon`
/// and `lat` first) or .geojson, a Point.
RONDEL_API void write_circles(const FileName& file, std::span<const EmptyCircle> circles);

}  // namespace rondel
