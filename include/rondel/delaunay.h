// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Delaunay and regular triangulations of points on or close to a sphere
/// (Caroli, de Castro, Loriot, Rouiller, Teillaud et al., SEA 2010, section 4).
#pragma once

#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// The unit vector of a longitude and latitude, the same bits on every
/// platform. Quadrants are exact: every longitude at latitude 90 gives
/// (0, 0, 1), and the longitudes -180, 180 and 540 give the same vector.
/// \pre both angles are finite. A latitude beyond 90 continues over the pole.
RONDEL_API Point unit_vector(const LonLat& position);

/// The unit vectors of n positions, shape (n, 3).
/// \throws InvalidInput (first bad index) if an angle is not finite or a
///         latitude is outside [-90, 90].
RONDEL_API std::vector<Point> unit_vectors(std::span<const LonLat> positions);

/// The weighted site of a circle on the sphere around the origin: q / cos r, the pole of the
/// circle's plane, for the center q and the angular radius r. `center` is taken as it is,
/// so it is a unit vector on the unit sphere and has length R on a sphere of radius R.
/// 1. Radius 0 gives `center` itself, bit for bit.
/// 2. The same bits on every platform; each coordinate within 2 ulp of its exact value. A longitude
///    and latitude stand for their unit_vector().
/// 3. The result is on or outside the sphere. A point inside stands for an imaginary circle: it
///    has no angular radius, and is given by its coordinates.
/// \throws InvalidInput if the radius is not in [0, 90).
RONDEL_API Point polar_point(const Point& center, double radius_deg);
RONDEL_API Point polar_point(const LonLat& center, double radius_deg);

/// The weighted sites of n circles, shape (n, 3).
/// \throws InvalidInput if there is not one radius for each center; (first bad index) if a radius
///         is not in [0, 90); for longitudes and latitudes then as unit_vectors() does.
RONDEL_API std::vector<Point> polar_points(std::span<const Point> centers,
                                           std::span<const double> radii_deg);
RONDEL_API std::vector<Point> polar_points(std::span<const LonLat> centers,
                                           std::span<const double> radii_deg);

/// The triangulation of n sites: the Delaunay triangulation of their exact
/// projections on the sphere (Model::projected) or the regular triangulation
/// of weighted sites, which is the convex hull (Model::weighted).
///
/// Exact for every finite input, whatever the calling thread has set: rounding is to nearest, as
/// IEEE 754 has it. Cocircular sites are resolved by a symbolic perturbation that depends on the
/// sites' coordinates alone.
/// Expected time O(n log n); peak memory about 70 bytes a site and the sites themselves.
/// \throws InvalidInput (first bad index) if a coordinate is not finite, a
///         projected site is the center, the sphere is not valid (squared
///         radius not positive, center not finite) or there are more than
///         `max_sites` sites.
RONDEL_API Triangulation delaunay(Sites sites, const Options& options = {},
                                  const Execution& execution = {});

/// Of an array of 3n numbers x0 y0 z0 x1 y1 z1 ..., which are copied.
/// \throws InvalidInput also if the length is not a multiple of 3.
RONDEL_API Triangulation delaunay(std::span<const double> xyz, const Options& options = {},
                                  const Execution& execution = {});

}  // namespace rondel
