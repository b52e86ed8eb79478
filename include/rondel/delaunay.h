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

/// Returns the unit vector of a longitude and latitude, with the same bits on every platform.
/// Quadrants are exact: every longitude at latitude 90 gives (0, 0, 1), and the longitudes -180,
/// 180 and 540 give the same vector. \pre Both angles are finite. A latitude beyond 90 continues
/// over the pole.
RONDEL_API Point unit_vector(const LonLat& position);

/// Returns the unit vectors of n positions, shape (n, 3).
/// \throws InvalidInput (first bad index) if an angle is not finite or a
///         latitude is outside [-90, 90].
RONDEL_API std::vector<Point> unit_vectors(std::span<const LonLat> positions);

/// Returns the longitudes and latitudes of the rays from the origin through points, the same bits on
/// every platform; longitude 0 at the poles, NaN for the origin and for points that are not finite.
RONDEL_API std::vector<LonLat> lonlats(std::span<const Point> points);

/// Returns the weighted site of a circle on the sphere around the origin: the pole of the circle's
/// plane, q / cos r for the center q and the angular radius r.
///
/// 1. Radius 0 gives `center` itself, bit for bit.
/// 2. The bits are the same on every platform, and each coordinate is within 2 ulp of its exact
///    value. A longitude and latitude stand for their unit_vector().
/// 3. The result is on or outside the sphere. A point inside the sphere stands for an imaginary
///    circle, which has no angular radius and is given by its coordinates.
///
/// \param center  is not normalized: it is a unit vector on the unit sphere, and has length R on a
///                sphere of radius R
/// \param radius_deg  degrees
/// \throws InvalidInput if the radius is not in [0, 90).
RONDEL_API Point polar_point(const Point& center, double radius_deg);
RONDEL_API Point polar_point(const LonLat& center, double radius_deg);

/// Returns the weighted sites of n circles, shape (n, 3).
/// \throws InvalidInput if there is not one radius for each center; (first bad index) if a radius
///         is not in [0, 90); for longitudes and latitudes then as unit_vectors() does.
RONDEL_API std::vector<Point> polar_points(std::span<const Point> centers,
                                           std::span<const double> radii_deg);
RONDEL_API std::vector<Point> polar_points(std::span<const LonLat> centers,
                                           std::span<const double> radii_deg);

/// Computes the triangulation of n sites: the Delaunay triangulation of their exact
/// projections on the sphere (Model::projected), or the regular triangulation
/// of weighted sites, which is the convex hull (Model::weighted).
///
/// The result is exact for every finite input, whatever rounding mode the calling thread has set:
/// the library rounds to nearest, as in IEEE 754. Ties of cocircular sites are broken by a symbolic
/// perturbation that depends on the sites' coordinates alone. The expected time is O(n log n); peak
/// memory is about 70 bytes for each site and up to 7 MB for each thread, besides the sites themselves.
/// \throws InvalidInput (first bad index) if a coordinate is not finite, a
///         projected site is the center, the sphere is not valid (squared
///         radius not positive, center not finite) or there are more than
///         `max_sites` sites.
RONDEL_API Triangulation delaunay(Sites sites, const Options& options = {},
                                  const Execution& execution = {});

/// Computes the triangulation of the points in an array of 3n numbers x0 y0 z0 x1 y1 z1 ..., which
/// are copied.
/// \throws InvalidInput also if the length is not a multiple of 3.
RONDEL_API Triangulation delaunay(std::span<const double> xyz, const Options& options = {},
                                  const Execution& execution = {});

}  // namespace rondel
