// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The rows of HEALPix and of Gaussian grids, and the lines of cubed spheres.
//
// in    the size of a grid
// out   sines of latitude, numbers of points, longitudes in degrees
// index rows from north to south, points of a row eastward
#pragma once

#include <cstddef>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::mesh {

// Points at equal steps around a parallel.
struct PointRing {
  double z;
  double radius;      // of the parallel
  std::size_t count;  // points
  double first;       // the steps from the meridian 0 to the first point

  [[nodiscard]] double lon_deg(std::size_t point) const {
    return 360 * (static_cast<double>(point) + first) / static_cast<double>(count);
  }
};

// Returns ring 1 ... 4 side - 1 of the centers of HEALPix's pixels, as numbered from the north pole
// in Gorski et al., Astrophys. J. 622, 2005: 4 i pixels in ring i of the polar caps, 4 side pixels
// in the belt between them.
PointRing healpix_ring(std::size_t side, std::size_t ring);

// Returns the sines of the latitudes of a Gaussian quadrature with 2 `number` nodes.
std::vector<double> gaussian_sines(std::size_t number);

// Returns the number of points in a row of ECMWF's octahedral grid: row i from a pole has 16 + 4 i.
std::size_t octahedral_count(std::size_t number, std::size_t row);

// Returns the coordinate, from -1 to 1, of a line on a face of a cube: rows and columns are great
// circles at equal angles from each other. Line 0 is at the edge, line 2 side at the opposite one,
// and the lines through the centers of cells are the odd ones.
double cube_tangent(std::size_t side, std::size_t line);

// Returns the point of a face of the cube from -1 to 1 with two coordinates there.
Point on_cube(unsigned face, double a, double b);

}  // namespace rondel::mesh
