// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/point_rings.h"

#include <algorithm>
#include <cmath>

#include "exact/angles.h"

namespace rondel::mesh {
namespace {

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

PointRing healpix_ring(std::size_t side, std::size_t ring) {
  const auto n = static_cast<double>(side);
  const std::size_t from_pole = std::min(ring, 4 * side - ring);
  const auto i = static_cast<double>(from_pole);
  const double sign = ring <= 2 * side ? 1 : -1;
  if (from_pole < side) {
    const double depth = i * i / (3 * n * n);  // 1 - |z|
    return {sign * (1 - depth), std::sqrt(depth * (2 - depth)), 4 * from_pole, 0.5};
  }
  const double z = 4.0 / 3 - 2 * i / (3 * n);
  return {sign * z, std::sqrt(1 - z * z), 4 * side, (from_pole - side) % 2 == 0 ? 0.5 : 0};
}

std::vector<double> gaussian_sines(std::size_t number) {
  std::vector<double> sines(2 * number);
  for (std::size_t row = 1; row <= number; ++row) {
    const double degrees =
        90 * (4 * static_cast<double>(row) - 1) / (4 * static_cast<double>(number) + 1);
    const double sine = legendre_root(2 * number, exact::sine_cosine_of_degrees(degrees).cosine);
    sines[row - 1] = sine;
    sines[2 * number - row] = -sine;
  }
  return sines;
}

std::size_t octahedral_count(std::size_t number, std::size_t row) {
  return 20 + 4 * std::min(row, 2 * number - 1 - row);
}

double cube_tangent(std::size_t side, std::size_t line) {
  if (line % (2 * side) == 0) return line == 0 ? -1 : 1;
  const auto turn = exact::sine_cosine_of_degrees(
      45 * (static_cast<double>(line) - static_cast<double>(side)) / static_cast<double>(side));
  return turn.sine / turn.cosine;
}

Point on_cube(unsigned face, double a, double b) {
  const double s = face % 2 == 0 ? 1 : -1;
  if (face / 2 == 0) return {s, s * a, b};
  if (face / 2 == 1) return {-s * a, s, b};
  return {-s * b, a, s};
}

}  // namespace rondel::mesh
