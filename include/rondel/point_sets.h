// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sites where models and surveys have them, as unit vectors; the same bytes on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The corners of an icosahedron, two of them poles, and the middles of its edges, so many times: 10 * 4^levels + 2.
/// \throws InvalidInput if the levels are more than 12.
RONDEL_API std::vector<Point> icosahedral_points(unsigned levels, const Execution& execution = {});

/// The centers of HEALPix's pixels in ring order (Gorski et al., Astrophys. J. 622, 2005): 12 side^2.
/// \throws InvalidInput if the side is not from 1 to 4096.
RONDEL_API std::vector<Point> healpix_points(std::size_t side);

/// The octahedral reduced Gaussian grid O(number) of ECMWF: rows at the roots of Legendre's polynomial of degree
/// 2 number, from north to south, with 20, 24, 28 ... points up to the equator and back. 4 number (number + 9).
/// \throws InvalidInput if the number is not from 1 to 8000.
RONDEL_API std::vector<Point> reduced_gaussian_points(std::size_t number);

/// The centers of the cells of the equiangular cubed sphere, face by face: 6 side^2.
/// \throws InvalidInput if the side is not from 1 to 8192.
RONDEL_API std::vector<Point> cubed_sphere_points(std::size_t side);

/// Maximal Poisson disks: no two points are closer than `radius` radians, and no point of the sphere is farther
/// than 1 + 1e-12 times it from all of them. Random darts first; then the centers of the empty circles, largest first.
/// \throws InvalidInput if the radius is not from 1e-4 to 1.
RONDEL_API std::vector<Point> poisson_disk_points(double radius, std::uint64_t seed = 1,
                                                  const Execution& execution = {});

}  // namespace rondel::mesh
