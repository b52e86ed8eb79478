// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that tests of isolines and bands share: fields, and the areas that rings enclose.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/query.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel::test {

inline Point minus(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double dot_of(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double volume(const Point& a, const Point& b, const Point& c) {
  return dot_of(a, {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x});
}

inline Point unit(const Point& p) {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const Point scaled{p.x / largest, p.y / largest, p.z / largest};
  const double length = std::hypot(scaled.x, scaled.y, scaled.z);
  return {scaled.x / length, scaled.y / length, scaled.z / length};
}

// The area of a triangle of unit vectors, negative if it is clockwise (Oosterom, Strackee 1983).
inline double triangle_area(const Point& a, const Point& b, const Point& c) {
  const double det = volume(a, minus(b, a), minus(c, a));
  return 2 * std::atan2(det, 1 + dot_of(a, b) + dot_of(b, c) + dot_of(c, a));
}

// The area to the left of a ring, up to multiples of 4 pi: a fan from a place that is no antipode of others.
inline double signed_ring_area(std::span<const Point> ring) {
  const Point apex = unit({0.2718281, 0.5772156, 0.1415926});
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    area += triangle_area(apex, ring[i], ring[(i + 1) % ring.size()]);
  }
  return area;
}

inline std::span<const Point> ring_points(const Bands& bands, std::uint64_t ring) {
  return bands.rings()[ring];
}

inline std::span<const Point> line_points(const Isolines& lines, std::uint64_t line) {
  return lines.lines.rows[line];
}

// The rings of band k.
inline std::vector<std::span<const Point>> rings_of_band(const Bands& bands, std::size_t k) {
  std::vector<std::span<const Point>> rings;
  for (auto ring = bands.bands.rows.offsets[bands.bands.offsets[k]];
       ring < bands.bands.rows.offsets[bands.bands.offsets[k + 1]]; ++ring) {
    rings.push_back(ring_points(bands, ring));
  }
  return rings;
}

inline double polygon_area(const Bands& bands, std::uint64_t polygon) {
  constexpr double sphere = 4 * std::numbers::pi;
  double area = 0;
  for (auto ring = bands.bands.rows.offsets[polygon]; ring < bands.bands.rows.offsets[polygon + 1];
       ++ring) {
    area += signed_ring_area(ring_points(bands, ring));
  }
  area = std::fmod(area, sphere);
  if (bands.bands.rows.offsets[polygon] == bands.bands.rows.offsets[polygon + 1]) return sphere;
  return area < 0 ? area + sphere : area;
}

// How often rings wind around the axis through u, from the azimuths of their points: around u, less
// around its antipode.
inline double winding(std::span<const std::span<const Point>> rings, const Point& u) {
  double turn = 0;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& p = ring[i];
      const Point& q = ring[(i + 1) % ring.size()];
      turn += std::atan2(volume(u, p, q), dot_of(p, q) - dot_of(u, p) * dot_of(u, q));
    }
  }
  return turn / (2 * std::numbers::pi);
}

inline Triangulation projected(const SiteSet& set) {
  return delaunay(set.sites, {.sphere = set.sphere}, {.threads = 1});
}

// Smooth, with hills and hollows, at any sites.
inline std::vector<double> smooth_values(const Triangulation& t) {
  std::vector<double> values;
  for (const Point& site : t.sites().points()) {
    const Point p = unit(minus(site, t.sphere().center));
    values.push_back(std::sin(3 * p.x + 1) + std::cos(4 * p.y) * p.z + 0.3 * std::sin(9 * p.z));
  }
  return values;
}

// Whole numbers from 0 to 3: ties, plateaus and saddles of every kind.
inline std::vector<double> stepped_values(std::size_t n, Random& random) {
  std::vector<double> values(n);
  for (double& value : values) value = static_cast<double>(random.below(4));
  return values;
}

}  // namespace rondel::test
