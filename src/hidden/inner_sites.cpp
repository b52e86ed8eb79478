// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "hidden/inner_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "hidden/direction_grid.h"
#include "hidden/frame.h"
#include "kernel/triangulate.h"
#include "order/spatial_order.h"

namespace rondel::hidden {
namespace {

using predicates::Vector;

// docs/theory/hull.md: enough as long as the sphere of radius `min_inradius` around the
// origin is inside the hull.
constexpr double slack = 0x1p-25;
constexpr double min_inradius = 0x1p-22;
constexpr double rounding = 64 * predicates::unit_roundoff;

double size_of(const Vector& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

TriangulationArrays hull_of(std::span<const Point> sites, const Point& center) {
  system::Job options;
  options.model = Model::weighted;
  options.sphere.center = center;
  auto order = order::spatial_order(sites, options.model, center, options.threads);
  return kernel::triangulate(sites, std::move(order.order), order.renamed, options).arrays;
}

// A lower bound of the distance of the origin from the faces of a tetrahedron.
double inradius(const std::array<Vector, 4>& corners) {
  double least = 2;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector& a = corners[(i + 1) % 4];
    const Vector& b = corners[(i + 2) % 4];
    const Vector& c = corners[(i + 3) % 4];
    const Vector normal = cross(b - a, c - a);
    const double volume = std::abs(det(a, b, c)) - rounding * size_of(a) * size_of(b) * size_of(c);
    const double area = norm(normal) + rounding * size_of(b - a) * size_of(c - a);
    least = std::min(least, area > 0 ? volume / area : 0);
  }
  return least;
}

// Upper bounds of the gauge of a hull.
class Gauge {
 public:
  Gauge(const DirectionGrid& grid, double inradius, std::span<const Vector> points,
        const TriangulationArrays& hull)
      : grid_(grid), inradius_(inradius), points_(points), hull_(hull) {
    const unsigned lines = grid.cells() + 1;
    values_.reserve(std::size_t{6} * lines * lines);
    Index f = 0;
    for (unsigned side = 0; side < 6; ++side) {
      for (unsigned i = 0; i < lines; ++i) {
        for (unsigned j = 0; j < lines; ++j) {
          values_.push_back(bound_at(grid.point(side, i, j), f));
        }
      }
    }
  }

  // Whether the point is certainly inside.
  [[nodiscard]] bool contains(const Vector& p) const {
    const Direction d = grid_.direction(p);
    if (!(d.length > 0)) return true;
    const std::size_t i = grid_.step(d.u);
    const std::size_t j = grid_.step(d.v);
    const std::size_t lines = grid_.cells() + 1;
    const double* low = &values_[(d.side * lines + i) * lines + j];
    const double* high = low + lines;
    const double s = d.u - static_cast<double>(i);
    const double t = d.v - static_cast<double>(j);
    const double at_low = low[0] + t * (low[1] - low[0]);
    const double at_high = high[0] + t * (high[1] - high[0]);
    return d.length * (at_low + s * (at_high - at_low)) < 1 - slack;
  }

 private:
  // x as a combination of the corners of a face, without negative coefficients; their sum is the
  // bound, what is left of x costs 1 / inradius. `f` is where the walk begins and ends. Any
  // face gives a bound; a good one the face that x sees.
  [[nodiscard]] double bound_at(const Vector& x, Index& f) const {
    for (std::size_t steps = hull_.faces.size();; --steps) {
      const auto& [a, b, c] = hull_.faces[f];
      const std::array<Vector, 3> corner = {points_[a], points_[b], points_[c]};
      const double volume = det(corner[0], corner[1], corner[2]);
      const std::array<double, 3> k = {det(x, corner[1], corner[2]) / volume,
                                       det(corner[0], x, corner[2]) / volume,
                                       det(corner[0], corner[1], x) / volume};
      const auto least = std::ranges::min_element(k);
      if (*least < 0 && steps > 0) {
        f = hull_.neighbors[f][static_cast<std::size_t>(least - k.begin())];
        continue;
      }
      return bound_of(x, corner, k);
    }
  }

  [[nodiscard]] double bound_of(const Vector& x, const std::array<Vector, 3>& corner,
                                const std::array<double, 3>& coefficients) const {
    Vector left = x;
    double sum = 0;
    double size = size_of(x);
    for (std::size_t i = 0; i < 3; ++i) {
      const double k = std::max(coefficients[i], 0.0);
      left = left - k * corner[i];
      sum += k;
      size += k * size_of(corner[i]);
    }
    const double bound = sum + (size_of(left) + rounding * size) / inradius_;
    return std::isfinite(bound) ? bound * (1 + rounding) : 1e300;
  }

  const DirectionGrid& grid_;
  double inradius_;
  std::span<const Vector> points_;
  const TriangulationArrays& hull_;
  std::vector<double> values_;  // at the corners of the cells
};

// The farthest site of each cell.
std::vector<Point> candidates(std::span<const Point> sites, const Frame& frame,
                              const DirectionGrid& grid) {
  std::vector<double> farthest(grid.num_cells(), 0);
  std::vector<Index> site(grid.num_cells(), no_index);
  for (Index i = 0; i < sites.size(); ++i) {
    const Vector v = frame.to(sites[i]);
    const Direction d = grid.direction(v);
    if (!(d.length > 0)) continue;
    const std::size_t cell = grid.cell(d);
    const double distance = dot(v, v);
    if (distance <= farthest[cell]) continue;
    farthest[cell] = distance;
    site[cell] = i;
  }
  std::vector<Point> result;
  for (const Index i : site) {
    if (i != no_index) result.push_back(sites[i]);
  }
  return result;
}

}  // namespace

std::vector<Index> rest_without_inner_sites(std::span<const Point> sites, const InnerPoint& inner) {
  const Frame frame(sites, inner.point);
  std::array<Vector, 4> corners{};
  std::ranges::transform(inner.corners, corners.begin(),
                         [&](const Point& p) { return frame.to(p); });
  std::vector<Index> rest;
  const double radius = inradius(corners);
  if (!(radius > min_inradius)) {
    rest.resize(sites.size());
    std::iota(rest.begin(), rest.end(), Index{0});
    return rest;
  }
  // Some ten candidates' cells for each part of the hull that a random cloud of this size has.
  const auto cells = static_cast<unsigned>(std::sqrt(static_cast<double>(sites.size())) / 32);
  const DirectionGrid grid(std::clamp(cells, 4U, 64U));
  auto chosen = candidates(sites, frame, grid);
  chosen.insert(chosen.end(), inner.corners.begin(), inner.corners.end());
  const TriangulationArrays hull = hull_of(chosen, inner.point);
  std::vector<Vector> points(chosen.size());
  std::ranges::transform(chosen, points.begin(), [&](const Point& p) { return frame.to(p); });
  const Gauge gauge(grid, radius, points, hull);
  for (Index i = 0; i < sites.size(); ++i) {
    if (!gauge.contains(frame.to(sites[i]))) rest.push_back(i);
  }
  return rest;
}

bool has_many_inner_sites(std::span<const Point> sites, const Point& center) {
  constexpr std::size_t sample_size = 2048;
  constexpr std::size_t worthwhile = 8 * sample_size;
  if (sites.size() < worthwhile) return false;
  std::vector<Point> sample;
  sample.reserve(sample_size);
  for (std::size_t i = 0; i < sample_size; ++i) {
    sample.push_back(sites[i * (sites.size() / sample_size)]);
  }
  return hull_of(sample, center).hidden.size() > sample_size / 8;
}

}  // namespace rondel::hidden
