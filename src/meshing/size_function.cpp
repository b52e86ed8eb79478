// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/size_raster.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh.h"
#include "rondel/mesh_size.h"
#include "rondel/query.h"
#include "system/arithmetic.h"
#include "system/job.h"

namespace rondel::mesh {

namespace {

bool is_spacing(double value) { return value > 0 && value < std::numbers::pi; }

// Throws InvalidInput unless the steps are a power of two from 1 to 4096.
void require_steps(std::size_t steps) {
  if (steps < 1 || steps > 4096 || !std::has_single_bit(steps)) {
    throw InvalidInput("the steps of a raster are a power of two from 1 to 4096, not " +
                       std::to_string(steps));
  }
}

void require_count(std::size_t count) {
  if (count == 0) throw InvalidInput("a mesh has at least one cell");
}

// Throws InvalidInput unless the slope is positive and finite.
void require_slope(double slope) {
  if (!(slope >= 0) || !std::isfinite(slope)) {
    throw InvalidInput("a spacing grows by 0 or more for each radian");
  }
}

// Calls visit(face, i, j) for the nodes in the order of their indices.
template <class Visit>
void for_each_node(const CubeRaster& cube, const Visit& visit) {
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::size_t j = 0; j < cube.side(); ++j) {
      for (std::size_t i = 0; i < cube.side(); ++i) visit(face, i, j);
    }
  }
}

std::vector<Point> places_of_nodes(const CubeRaster& cube) {
  std::vector<Point> places;
  places.reserve(cube.num_nodes());
  for_each_node(cube, [&](std::size_t face, std::size_t i, std::size_t j) {
    places.push_back(cube.place(face, i, j));
  });
  return places;
}

// A position on an increasing axis: between axis[first] and axis[second], and at which part of the
// way.
struct AxisPart {
  std::size_t first;
  std::size_t second;
  double part;
};

AxisPart between(std::span<const double> axis, double x) {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(axis, x) - axis.begin());
  if (next == 0) return {0, 0, 0};
  if (next == axis.size()) return {next - 1, next - 1, 0};
  return {next - 1, next, (x - axis[next - 1]) / (axis[next] - axis[next - 1])};
}

// Returns the part of a closed axis of longitudes, where the first longitude follows the last one.
AxisPart between_longitudes(std::span<const double> axis, double lon) {
  double x = lon - 360 * std::floor((lon - axis.front()) / 360);
  if (x < axis.front()) x = axis.front();
  if (x <= axis.back()) return between(axis, x);
  const double gap = axis.front() + 360 - axis.back();
  return {axis.size() - 1, 0, gap > 0 ? std::min(1.0, (x - axis.back()) / gap) : 0};
}

bool is_increasing(std::span<const double> axis) {
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (!std::isfinite(axis[i]) || (i > 0 && !(axis[i - 1] < axis[i]))) return false;
  }
  return !axis.empty();
}

}  // namespace

SizeFunction SizeFunction::of(std::vector<double> spacings, std::size_t steps) {
  for (std::size_t i = 0; i < spacings.size(); ++i) {
    if (!is_spacing(spacings[i])) {
      throw InvalidInput(
          "the spacing " + std::to_string(spacings[i]) + " radians is not between 0 and pi", i);
    }
  }
  const auto [low, high] = std::ranges::minmax(spacings);
  auto raster = std::make_shared<Raster>(Raster{{steps}, {}, low, high});
  raster->relative.reserve(spacings.size());
  for (const double h : spacings) raster->relative.push_back(static_cast<float>(low / h));
  return SizeFunction(std::move(raster));
}

SizeFunction SizeFunction::constant(double spacing, std::size_t steps) {
  const system::ArithmeticScope arithmetic;
  require_steps(steps);
  return of(std::vector<double>(CubeRaster{steps}.num_nodes(), spacing), steps);
}

SizeFunction SizeFunction::of_count(std::size_t count) {
  const system::ArithmeticScope arithmetic;
  require_count(count);
  return constant(spacing_of(4 * std::numbers::pi / static_cast<double>(count)), 1);
}

std::vector<Point> SizeFunction::nodes(std::size_t steps) {
  const system::ArithmeticScope arithmetic;
  require_steps(steps);
  return places_of_nodes({steps});
}

SizeFunction SizeFunction::from_nodes(std::vector<double> spacings, std::size_t steps) {
  const system::ArithmeticScope arithmetic;
  require_steps(steps);
  const std::size_t num_nodes = CubeRaster{steps}.num_nodes();
  if (spacings.size() != num_nodes) {
    throw InvalidInput("there are " + std::to_string(spacings.size()) + " spacings for " +
                           std::to_string(num_nodes) + " nodes",
                       std::min(spacings.size(), num_nodes));
  }
  return of(std::move(spacings), steps);
}

SizeFunction SizeFunction::from_function(const Block& spacings, std::size_t steps) {
  const std::vector<Point> places = nodes(steps);
  std::vector<double> values(places.size());
  constexpr std::size_t block = 1 << 16;
  for (std::size_t begin = 0; begin < places.size(); begin += block) {
    const std::size_t size = std::min(block, places.size() - begin);
    spacings(std::span(places).subspan(begin, size), std::span(values).subspan(begin, size));
  }
  return from_nodes(std::move(values), steps);
}

SizeFunction SizeFunction::from_grid(std::span<const double> lon_deg,
                                     std::span<const double> lat_deg,
                                     std::span<const double> spacings, std::size_t steps) {
  const system::ArithmeticScope arithmetic;
  if (spacings.size() != lon_deg.size() * lat_deg.size()) {
    throw InvalidInput("there is not one spacing for each longitude and latitude",
                       std::min(spacings.size(), lon_deg.size() * lat_deg.size()));
  }
  std::vector<double> lon(lon_deg.begin(), lon_deg.end());
  std::vector<double> lat(lat_deg.begin(), lat_deg.end());
  const bool turn_lon = lon.size() > 1 && lon[0] > lon[1];
  const bool turn_lat = lat.size() > 1 && lat[0] > lat[1];
  if (turn_lon) std::ranges::reverse(lon);
  if (turn_lat) std::ranges::reverse(lat);
  if (!is_increasing(lon) || lon.back() - lon.front() > 360) {
    throw InvalidInput("the longitudes are not in order, or go around more than once");
  }
  if (!is_increasing(lat) || lat.front() < -90 || lat.back() > 90) {
    throw InvalidInput("the latitudes are not in order from -90 to 90");
  }
  const auto value = [&](std::size_t i, std::size_t j) {
    const std::size_t column = turn_lon ? lon.size() - 1 - i : i;
    const std::size_t row = turn_lat ? lat.size() - 1 - j : j;
    return spacings[row * lon.size() + column];
  };
  constexpr double degrees = 180 / std::numbers::pi;
  const Block block = [&](std::span<const Point> places, std::span<double> out) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Point& p = places[k];
      const double parallel = std::sqrt(p.x * p.x + p.y * p.y);
      const AxisPart x = between_longitudes(lon, degrees * exact::argument(p.y, p.x));
      const AxisPart y = between(lat, degrees * exact::argument(p.z, parallel));
      const double below =
          value(x.first, y.first) * (1 - x.part) + value(x.second, y.first) * x.part;
      const double above =
          value(x.first, y.second) * (1 - x.part) + value(x.second, y.second) * x.part;
      out[k] = below * (1 - y.part) + above * y.part;
    }
  };
  return from_function(block, steps);
}

SizeFunction SizeFunction::refined(std::span<const Point> points, double near, double slope,
                                   const Execution& execution) const {
  const system::Call call(execution);
  require_slope(slope);
  if (points.empty()) throw InvalidInput("there are no points to refine at");
  if (!is_spacing(near)) throw InvalidInput("a spacing is between 0 and pi");
  const std::vector<Point> places = places_of_nodes(raster_->cube);
  const Locator locator(delaunay(Sites::view(points), {}, execution));
  const std::vector<Index> nearest = locator.nearest(places, execution);
  std::vector<double> spacings(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double distance = locator.distance(places[i], nearest[i]);
    // Uses the values at the nodes, before they are rounded to single precision.
    const double wide = raster_->smallest / static_cast<double>(raster_->relative[i]);
    spacings[i] = std::min(wide, near + slope * distance);
  }
  return of(std::move(spacings), raster_->cube.steps);
}

SizeFunction SizeFunction::limited(double slope) const {
  const system::ArithmeticScope arithmetic;
  require_slope(slope);
  std::vector<double> spacings(raster_->relative.size());
  std::ranges::transform(raster_->relative, spacings.begin(),
                         [&](float r) { return raster_->smallest / static_cast<double>(r); });
  limit_slope(raster_->cube, slope, spacings);
  return of(std::move(spacings), raster_->cube.steps);
}

double SizeFunction::relative(const Point& place) const {
  const CubeRaster::RasterPlace spot = raster_->cube.spot(place);
  const float* const low = &raster_->relative[raster_->cube.node(spot.face, spot.i, spot.j)];
  const float* const high = low + raster_->cube.side();
  const double below = low[0] + spot.s * (static_cast<double>(low[1]) - low[0]);
  const double above = high[0] + spot.s * (static_cast<double>(high[1]) - high[0]);
  return below + spot.t * (above - below);
}

double SizeFunction::spacing(const Point& place) const {
  return raster_->smallest / relative(place);
}

double SizeFunction::density(const Point& place) const {
  const double r = relative(place);
  return (r * r) * (r * r);
}

double SizeFunction::smallest() const noexcept { return raster_->smallest; }
double SizeFunction::largest() const noexcept { return raster_->largest; }

// Sums over the squares of the raster the solid angle times the mean of 1/spacing^2 at the corners.
// The solid angle is estimated at the center of a square; the last factor corrects the sum of all
// solid angles.
double SizeFunction::count() const {
  const system::ArithmeticScope arithmetic;
  const CubeRaster& cube = raster_->cube;
  double sum = 0;
  double whole = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::size_t j = 0; j < cube.steps; ++j) {
      for (std::size_t i = 0; i < cube.steps; ++i) {
        const double a = 0.5 * (cube.coordinate(i) + cube.coordinate(i + 1));
        const double b = 0.5 * (cube.coordinate(j) + cube.coordinate(j + 1));
        const double square = 1 + a * a + b * b;
        const double solid = 1 / (square * std::sqrt(square));
        double density = 0;
        for (const std::size_t k : {cube.node(face, i, j), cube.node(face, i + 1, j),
                                    cube.node(face, i, j + 1), cube.node(face, i + 1, j + 1)}) {
          const double r = static_cast<double>(raster_->relative[k]);
          density += 0.25 * r * r;
        }
        sum += solid * density;
        whole += solid;
      }
    }
  }
  const double of_hexagon = 0.5 * std::numbers::sqrt3 * raster_->smallest * raster_->smallest;
  return 4 * std::numbers::pi * (sum / whole) / of_hexagon;
}

SizeFunction SizeFunction::for_count(std::size_t number) const {
  const system::ArithmeticScope arithmetic;
  require_count(number);
  return scaled(std::sqrt(count() / static_cast<double>(number)));
}

SizeFunction SizeFunction::scaled(double factor) const {
  const system::ArithmeticScope arithmetic;
  if (!is_spacing(factor * raster_->largest) || !(factor > 0)) {
    throw InvalidInput("a spacing is between 0 and pi");
  }
  auto raster = std::make_shared<Raster>(*raster_);
  raster->smallest *= factor;
  raster->largest *= factor;
  return SizeFunction(std::move(raster));
}

std::vector<Point> densified(std::span<const Point> line, double distance) {
  const system::ArithmeticScope arithmetic;
  if (!(distance > 0)) throw InvalidInput("a distance of points is more than 0");
  std::vector<Point> points;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0) {
      const auto a = exact::to_vector(line[i - 1]);
      const auto b = exact::to_vector(line[i]);
      constexpr double nearly_antipodes = 1e-9;
      if (norm(a + b) < nearly_antipodes * norm(b)) {
        throw InvalidInput("points " + std::to_string(i - 1) + " and " + std::to_string(i) +
                               " of a line are antipodes, which no one arc joins",
                           i);
      }
      const double parts = std::ceil(norm(b - a) / distance);
      for (std::size_t k = 1; static_cast<double>(k) < parts; ++k) {
        points.push_back(
            exact::to_point(normalized(a + (static_cast<double>(k) / parts) * (b - a))));
      }
    }
    points.push_back(line[i]);
  }
  return points;
}

}  // namespace rondel::mesh
