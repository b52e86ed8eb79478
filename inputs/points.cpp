// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "inputs/points.h"

#include <cmath>
#include <limits>
#include <utility>

#include "rondel/delaunay.h"

namespace rondel::inputs {

Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(double s, const Point& p) { return {s * p.x, s * p.y, s * p.z}; }

Point cross_product(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Point normalized(const Point& p) {
  const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.x / length, p.y / length, p.z / length};
}

// This is the method of Duff et al., Building an orthonormal basis, revisited, JCGT 2017.
Frame frame_around(const Point& up) {
  const double sign = up.z < 0 ? -1 : 1;
  const double a = -1 / (sign + up.z);
  const double b = up.x * up.y * a;
  return {
      up, {1 + sign * up.x * up.x * a, sign * b, -sign * up.x}, {b, sign + up.y * up.y * a, -up.y}};
}

Point random_near(Random& random, const Point& pole, double radius) {
  const Point direction = random.direction();  // drawn first, since compilers may evaluate operands
                                               // in any order
  return normalized(pole + (radius * random.unit()) * direction);
}

Point moved_by_one_ulp(Random& random, Point p) {
  const double toward = (random.coin() ? 1 : -1) * std::numeric_limits<double>::infinity();
  double* const coordinates[] = {&p.x, &p.y, &p.z};
  double& x = *coordinates[random.below(3)];
  x = std::nextafter(x, toward);
  return p;
}

Input from_positions(std::vector<LonLat> positions) {
  Input input;
  input.sites = unit_vectors(positions);
  input.positions = std::move(positions);
  return input;
}

}  // namespace rondel::inputs
