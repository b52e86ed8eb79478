// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "hidden/inner_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "hidden/frame.h"
#include "kernel/great_circle.h"
#include "kernel/triangulate.h"
#include "predicates/orientation.h"
#include "predicates/perturbation.h"

namespace rondel::hidden {
namespace {

using predicates::is_lexicographically_less;
using predicates::Vector;
using Tetrahedron = std::array<Point, 4>;

// The site of largest size; of several the lexicographically smallest.
template <class Size>
Point largest(std::span<const Point> sites, Size size) {
  const Point* best = &sites.front();
  double most = -1;
  for (const Point& p : sites) {
    const double s = size(p);
    if (s < most) continue;
    if (s > most || is_lexicographically_less(p, *best)) best = &p;
    most = s;
  }
  return *best;
}

Point smallest(std::span<const Point> sites) {
  const Point* best = &sites.front();
  for (const Point& p : sites) {
    if (p.x <= best->x && is_lexicographically_less(p, *best)) best = &p;
  }
  return *best;
}

// The orientation of d seen from the face (a, b, c): zero when the four are coplanar.
Sign orientation(const Tetrahedron& t) {
  return predicates::orientation(t[1], t[2], t[3], t[0]).sign;
}

Tetrahedron far_corners(std::span<const Point> sites, const Point& a, const Frame& frame) {
  const Point b = largest(sites, [&](const Point& p) {
    const Vector v = frame.to(p);
    return dot(v, v);
  });
  const Vector ab = frame.to(b);
  const Point c = largest(sites, [&](const Point& p) {
    const Vector v = cross(ab, frame.to(p));
    return dot(v, v);
  });
  const Vector normal = cross(ab, frame.to(c));
  const Point d =
      largest(sites, [&](const Point& p) { return std::abs(dot(normal, frame.to(p))); });
  return {a, b, c, d};
}

// Where rounding hides that the sites span space: the first ones that do, by coordinates.
Tetrahedron first_corners(std::span<const Point> sites, const Point& a) {
  std::vector<Point> sorted(sites.begin(), sites.end());
  std::ranges::sort(sorted, is_lexicographically_less);
  const auto span = kernel::find_span(sorted, a);
  return {a, sorted[span[0]], sorted[span[1]], sorted[span[2]]};
}

bool is_strictly_inside(const Point& p, const Tetrahedron& t) {
  const Sign sign = orientation(t);
  for (std::size_t i = 0; i < 4; ++i) {
    Tetrahedron replaced = t;
    replaced[i] = p;
    if (orientation(replaced) != sign) return false;
  }
  return true;
}

// The rounded centroid and its neighbors in the grid of doubles, the centroid first.
InnerPoint inner_point_of(const Tetrahedron& t) {
  const auto mean = [&t](double Point::*x) {
    return (t[0].*x / 4 + t[1].*x / 4) + (t[2].*x / 4 + t[3].*x / 4);
  };
  const auto moved = [](double value, int step) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return step == 0 ? value : std::nextafter(value, step < 0 ? -infinity : infinity);
  };
  const Point centroid = {mean(&Point::x), mean(&Point::y), mean(&Point::z)};
  constexpr std::array<int, 3> steps = {0, -1, 1};
  for (const int x : steps) {
    for (const int y : steps) {
      for (const int z : steps) {
        const Point p = {moved(centroid.x, x), moved(centroid.y, y), moved(centroid.z, z)};
        if (is_strictly_inside(p, t)) return {p, true, t};
      }
    }
  }
  return {t[0]};
}

struct Extremes {
  Point lowest;
  Point highest;
};

// Along an axis; of several the lexicographically smallest.
Extremes extremes(std::span<const Point> sites, double Point::*x) {
  Extremes e = {sites.front(), sites.front()};
  for (const Point& p : sites) {
    if (p.*x <= e.lowest.*x && (p.*x < e.lowest.*x || is_lexicographically_less(p, e.lowest)))
      e.lowest = p;
    if (p.*x >= e.highest.*x && (p.*x > e.highest.*x || is_lexicographically_less(p, e.highest)))
      e.highest = p;
  }
  return e;
}

bool is_strictly_inside_hull(const Point& p, std::vector<Point> sites) {
  std::ranges::sort(sites, is_lexicographically_less);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  std::vector<Index> order(sites.size());
  std::iota(order.begin(), order.end(), Index{0});
  system::Job options;
  options.model = Model::weighted;
  options.sphere.center = p;
  options.threads = 1;
  const auto hull = kernel::triangulate(sites, std::move(order), {}, options).arrays;
  return hull.dimension == 2 && hull.ghost_faces.empty();
}

}  // namespace

std::optional<Point> find_middle(std::span<const Point> sites) {
  if (sites.empty()) return std::nullopt;
  Point middle;
  std::vector<Point> touching;
  for (double Point::*const x : {&Point::x, &Point::y, &Point::z}) {
    const Extremes e = extremes(sites, x);
    middle.*x = e.lowest.*x / 2 + e.highest.*x / 2;
    touching.insert(touching.end(), {e.lowest, e.highest});
  }
  if (!is_strictly_inside_hull(middle, std::move(touching))) return std::nullopt;
  return middle;
}

InnerPoint find_inner_point(std::span<const Point> sites) {
  if (sites.empty()) return {};
  const Point a = smallest(sites);
  Tetrahedron corners = far_corners(sites, a, Frame(sites, a));
  if (orientation(corners) == Sign::zero) {
    if (kernel::find_span(sites, a).size() < 3) return {a};
    corners = first_corners(sites, a);
  }
  return inner_point_of(corners);
}

}  // namespace rondel::hidden
