// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Standard sets of sites, as unit vectors: those of models and surveys; the same bytes on every
/// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// Returns the corners of an icosahedron, two of them poles, refined `levels` times by the middles
/// of all edges: 10 * 4^levels + 2 points.
/// \throws InvalidInput if the levels are more than 12.
RONDEL_API std::vector<Point> icosahedral_points(unsigned levels, const Execution& execution = {});

/// Returns the centers of HEALPix's pixels in ring order (Gorski et al., Astrophys. J. 622, 2005):
/// 12 side^2 points.
/// \throws InvalidInput if the side is not from 1 to 4096.
RONDEL_API std::vector<Point> healpix_points(std::size_t side);

/// Returns the points of the octahedral reduced Gaussian grid O(number) of ECMWF: rows at the roots
/// of the Legendre polynomial of degree 2 number, from north to south, with 20, 24, 28 ... points
/// up to the equator and back; together 4 number (number + 9).
/// \throws InvalidInput if the number is not from 1 to 8000.
RONDEL_API std::vector<Point> reduced_gaussian_points(std::size_t number);

/// Returns the centers of the cells of the equiangular cubed sphere, face by face: 6 side^2 points.
/// \throws InvalidInput if the side is not from 1 to 8192.
RONDEL_API std::vector<Point> cubed_sphere_points(std::size_t side);

/// Returns a maximal Poisson disk set: no two points are closer than `radius` radians, and every
/// point of the sphere is within (1 + 1e-12) radius of one of them. Random darts come first, and
/// then the centers of the empty circles, the largest first.
/// \throws InvalidInput if the radius is not from 1e-4 to 1.
RONDEL_API std::vector<Point> poisson_disk_points(double radius, std::uint64_t seed = 1,
                                                  const Execution& execution = {});

}  // namespace rondel::mesh
