// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/point_sets.h"

#include <cmath>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/point_rings.h"
#include "meshing/scvt_levels.h"
#include "rondel/error.h"
#include "system/arithmetic.h"

namespace rondel::mesh {
namespace {

// Throws InvalidInput unless the value is in [least, most].
void require_between(std::size_t value, std::size_t least, std::size_t most, const char* what) {
  if (value >= least && value <= most) return;
  throw InvalidInput(std::string(what) + " is from " + std::to_string(least) + " to " +
                         std::to_string(most) + ", not " + std::to_string(value),
                     0);
}

// Adds the points of a ring.
void add_ring(std::vector<Point>& points, const PointRing& ring) {
  for (std::size_t j = 0; j < ring.count; ++j) {
    const auto turn = exact::sine_cosine_of_degrees(ring.lon_deg(j));
    points.push_back({ring.radius * turn.cosine, ring.radius * turn.sine, ring.z});
  }
}

}  // namespace

// Each level adds a site in the middle of each edge of the level before: n sites have 3 n - 6
// edges.
std::vector<Point> icosahedral_points(unsigned levels, const Execution& execution) {
  const system::ArithmeticScope arithmetic;
  require_between(levels, 0, 12, "the number of levels");
  std::vector<Point> points = icosahedron();
  for (unsigned level = 0; level < levels; ++level) {
    points = refined_sites(points, 4 * points.size() - 6, nullptr, execution.threads);
  }
  return points;
}

std::vector<Point> healpix_points(std::size_t side) {
  const system::ArithmeticScope arithmetic;
  require_between(side, 1, 4096, "the side of HEALPix's base pixels");
  std::vector<Point> points;
  points.reserve(12 * side * side);
  for (std::size_t ring = 1; ring < 4 * side; ++ring) add_ring(points, healpix_ring(side, ring));
  return points;
}

std::vector<Point> reduced_gaussian_points(std::size_t number) {
  const system::ArithmeticScope arithmetic;
  require_between(number, 1, 8000, "the number of a reduced Gaussian grid");
  std::vector<Point> points;
  points.reserve(4 * number * (number + 9));
  const std::vector<double> sines = gaussian_sines(number);
  for (std::size_t row = 0; row < 2 * number; ++row) {
    const double z = sines[row];
    add_ring(points, {z, std::sqrt((1 - z) * (1 + z)), octahedral_count(number, row), 0});
  }
  return points;
}

std::vector<Point> cubed_sphere_points(std::size_t side) {
  const system::ArithmeticScope arithmetic;
  require_between(side, 1, 8192, "the side of a cubed sphere");
  std::vector<double> tangents;
  for (std::size_t i = 0; i < side; ++i) tangents.push_back(cube_tangent(side, 2 * i + 1));
  std::vector<Point> points;
  points.reserve(6 * side * side);
  for (unsigned face = 0; face < 6; ++face) {
    for (const double b : tangents) {
      for (const double a : tangents) points.push_back(normalized(on_cube(face, a, b)));
    }
  }
  return points;
}

}  // namespace rondel::mesh
