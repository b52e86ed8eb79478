// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The area that sites cover and the gaps between them: convex hull, alpha shapes and largest empty
/// circles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Polygons whose corners are sites: a group is a polygon, a row is a ring.
///
/// 1. Sides are the shorter arcs of great circles; the inside is to the left of each ring.
/// 2. The inside of a polygon is connected. Rings are simple, and two rings or polygons meet at
///    most in sites.
/// 3. A polygon without rings is the whole sphere.
using Outline = RowGroups<CompressedRows<Index>>;

/// Computes the convex hull on the sphere: the union of the solid faces, exactly. It is one
/// polygon: the whole sphere if no closed hemisphere contains all sites. Below dimension 2 there is
/// no polygon. Sites on the sides of the hull are corners of it.
RONDEL_API Outline hull_polygon(const Triangulation& triangulation);

/// Computes the alpha shape: the union of the solid faces whose circumscribed circles have at most
/// a given radius. Faces with the same circle are taken or left together.
/// \param radius  radians; compared with the computed radii
/// \throws InvalidInput if the radius is negative or not a number, the sites are weighted, or
///         constraints have changed faces.
RONDEL_API Outline alpha_shape(const Triangulation& triangulation, double radius,
                               const Execution& execution = {});

/// A circle with no site inside and at least three sites on it.
struct EmptyCircle {
  Point center;       ///< a unit vector from the center of the sphere
  double radius = 0;  ///< radians, to 2e-15
  /// Three sites on the circle; it may have more.
  std::array<Index, 3> sites = {no_index, no_index, no_index};
};

/// The places where the centers of empty circles may be.
enum class CircleCenters : std::uint8_t {
  inside,    ///< in a solid face only
  anywhere,  ///< also outside of the hull, where a radius can be up to 180 degrees
};

/// Computes the k largest empty circles of the faces, the largest first; fewer if fewer exist.
///
/// Faces with the same circle count once. Circles of equal radius (as rounded) are in the order of
/// their first faces. Below dimension 2 the result is empty, except for CircleCenters::anywhere and
/// sites on a great circle of which no open half is free of sites: then it has the circles around
/// the two poles. Each circle touches three sites, so where all sites are in a hemisphere, a circle
/// that touches only two of them may be larger.
/// \throws InvalidInput if the sites are weighted, or constraints have changed faces.
RONDEL_API std::vector<EmptyCircle> largest_empty_circles(
    const Triangulation& triangulation, std::size_t k,
    CircleCenters centers = CircleCenters::inside, const Execution& execution = {});

/// Writes an outline, one feature for each polygon, with the number `sites` of its corners.
/// \param file  .geojson (RFC 7946): a MultiPolygon, cut at the antimeridian and the poles
/// \param tolerance_deg  how far drawn lines may leave the arcs, degrees
/// \throws InvalidInput if the arrays do not fit together.
RONDEL_API void write_outline(const FileName& file, const Triangulation& triangulation,
                              const Outline& outline, double tolerance_deg = 0.01,
                              const Execution& execution = {});

/// Writes circles, one row or feature each, with the center, `radius_deg` and the sites `a`, `b`,
/// `c`.
/// \param file  .csv (with `lon` and `lat` first, degrees) or .geojson (a Point)
RONDEL_API void write_circles(const FileName& file, std::span<const EmptyCircle> circles);

}  // namespace rondel
