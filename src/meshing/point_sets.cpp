// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/point_sets.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
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

// Adds `count` points around a parallel, the first one `first` steps east of Greenwich.
void add_ring(std::vector<Point>& points, double z, double r, std::size_t count, double first) {
  for (std::size_t j = 0; j < count; ++j) {
    const auto turn = exact::sine_cosine_of_degrees(360 * (static_cast<double>(j) + first) /
                                                    static_cast<double>(count));
    points.push_back({r * turn.cosine, r * turn.sine, z});
  }
}

// Returns a root of the Legendre polynomial of this degree by Newton's method. The root is the sine
// of a latitude.
double legendre_root(std::size_t degree, double x) {
  const auto n = static_cast<double>(degree);
  for (int step = 0; step < 100; ++step) {
    double before = 1;
    double value = x;
    for (std::size_t order = 2; order <= degree; ++order) {
      const auto k = static_cast<double>(order);
      const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
      before = value;
      value = next;
    }
    const double slope = n * (x * value - before) / (x * x - 1);
    const double move = value / slope;
    x -= move;
    if (std::abs(move) < 1e-15) break;
  }
  return x;
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

// Rings are numbered from the north pole as in Gorski et al., ApJ 622 (2005): 4 i pixels in ring i
// of the polar caps, 4 side pixels in the belt between them.
std::vector<Point> healpix_points(std::size_t side) {
  const system::ArithmeticScope arithmetic;
  require_between(side, 1, 4096, "the side of HEALPix's base pixels");
  const auto n = static_cast<double>(side);
  std::vector<Point> points;
  points.reserve(12 * side * side);
  for (std::size_t ring = 1; ring < 4 * side; ++ring) {
    const std::size_t from_pole = std::min(ring, 4 * side - ring);
    const auto i = static_cast<double>(from_pole);
    const double sign = ring <= 2 * side ? 1 : -1;
    if (from_pole < side) {
      const double depth = i * i / (3 * n * n);  // 1 - |z|
      add_ring(points, sign * (1 - depth), std::sqrt(depth * (2 - depth)), 4 * from_pole, 0.5);
    } else {
      const double z = 4.0 / 3 - 2 * i / (3 * n);
      add_ring(points, sign * z, std::sqrt(1 - z * z), 4 * side,
               (from_pole - side) % 2 == 0 ? 0.5 : 0);
    }
  }
  return points;
}

// The latitudes are those of a Gaussian quadrature with 2 N nodes; row i from a pole has 16 + 4 i
// points.
std::vector<Point> reduced_gaussian_points(std::size_t number) {
  const system::ArithmeticScope arithmetic;
  require_between(number, 1, 8000, "the number of a reduced Gaussian grid");
  std::vector<double> sines;
  for (std::size_t row = 1; row <= number; ++row) {
    const double degrees =
        90 * (4 * static_cast<double>(row) - 1) / (4 * static_cast<double>(number) + 1);
    sines.push_back(legendre_root(2 * number, exact::sine_cosine_of_degrees(degrees).cosine));
  }
  std::vector<Point> points;
  points.reserve(4 * number * (number + 9));
  for (std::size_t row = 0; row < 2 * number; ++row) {
    const std::size_t from_pole = std::min(row, 2 * number - 1 - row);
    const double z = row < number ? sines[from_pole] : -sines[from_pole];
    add_ring(points, z, std::sqrt((1 - z) * (1 + z)), 20 + 4 * from_pole, 0);
  }
  return points;
}

// Rows and columns of a face are great circles at equal angles from each other; their coordinates
// on the cube are the tangents of these angles.
std::vector<Point> cubed_sphere_points(std::size_t side) {
  const system::ArithmeticScope arithmetic;
  require_between(side, 1, 8192, "the side of a cubed sphere");
  std::vector<double> tangents;
  for (std::size_t i = 0; i < side; ++i) {
    const auto turn = exact::sine_cosine_of_degrees(
        45 * (2 * static_cast<double>(i) + 1 - static_cast<double>(side)) /
        static_cast<double>(side));
    tangents.push_back(turn.sine / turn.cosine);
  }
  std::vector<Point> points;
  points.reserve(6 * side * side);
  for (int face = 0; face < 6; ++face) {
    const double s = face % 2 == 0 ? 1 : -1;
    for (const double b : tangents) {
      for (const double a : tangents) {
        const exact::Vector3<double> p = face / 2 == 0   ? exact::Vector3<double>{s, s * a, b}
                                         : face / 2 == 1 ? exact::Vector3<double>{-s * a, s, b}
                                                         : exact::Vector3<double>{-s * b, a, s};
        points.push_back(exact::to_point(normalized(p)));
      }
    }
  }
  return points;
}

}  // namespace rondel::mesh
