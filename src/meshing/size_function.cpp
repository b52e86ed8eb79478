// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

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

void require_count(std::size_t count) {
  if (count == 0) throw InvalidInput("a mesh has at least one cell");
}

// Throws InvalidInput unless the slope is positive and finite.
void require_slope(double slope) {
  if (!(slope >= 0) || !std::isfinite(slope)) {
    throw InvalidInput("a spacing grows by 0 or more for each radian");
  }
}

// The number of nodes that are worked at together.
constexpr std::size_t block_nodes = std::size_t{1} << 16U;

std::size_t num_nodes_of(const AnyRaster& raster) {
  return std::visit([](const auto& nodes) { return nodes.num_nodes(); }, raster);
}

// Appends the places of the nodes [begin, end).
void append_places(const AnyRaster& raster, std::size_t begin, std::size_t end,
                   std::vector<Point>& places) {
  std::visit(
      [&](const auto& nodes) {
        for (std::size_t k = begin; k < end; ++k) {
          const std::size_t row = k / nodes.columns();
          places.push_back(
              nodes.place(row / nodes.rows(), k % nodes.columns(), row % nodes.rows()));
        }
      },
      raster);
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

SizeFunction SizeFunction::of(std::vector<double> spacings, const SizeRaster& raster) {
  for (std::size_t i = 0; i < spacings.size(); ++i) {
    if (!is_spacing(spacings[i])) {
      throw InvalidInput(
          "the spacing " + std::to_string(spacings[i]) + " radians is not between 0 and pi", i);
    }
  }
  const auto [low, high] = std::ranges::minmax(spacings);
  auto made = std::make_shared<Raster>(Raster{raster_of(raster), {}, low, high});
  made->relative.reserve(spacings.size());
  for (const double h : spacings) made->relative.push_back(static_cast<float>(low / h));
  return SizeFunction(std::move(made));
}

SizeFunction SizeFunction::constant(double spacing, const SizeRaster& raster) {
  const system::ArithmeticScope arithmetic;
  return of(std::vector<double>(num_nodes_of(raster_of(raster)), spacing), raster);
}

SizeFunction SizeFunction::of_count(std::size_t count) {
  const system::ArithmeticScope arithmetic;
  require_count(count);
  return constant(spacing_of(4 * std::numbers::pi / static_cast<double>(count)), 1);
}

std::vector<Point> SizeFunction::nodes(const SizeRaster& raster) {
  const system::ArithmeticScope arithmetic;
  const AnyRaster nodes = raster_of(raster);
  std::vector<Point> places;
  places.reserve(num_nodes_of(nodes));
  append_places(nodes, 0, num_nodes_of(nodes), places);
  return places;
}

SizeFunction SizeFunction::from_nodes(std::vector<double> spacings, const SizeRaster& raster) {
  const system::ArithmeticScope arithmetic;
  const std::size_t num_nodes = num_nodes_of(raster_of(raster));
  if (spacings.size() != num_nodes) {
    throw InvalidInput("there are " + std::to_string(spacings.size()) + " spacings for " +
                           std::to_string(num_nodes) + " nodes",
                       std::min(spacings.size(), num_nodes));
  }
  return of(std::move(spacings), raster);
}

SizeFunction SizeFunction::from_function(const Block& spacings, const SizeRaster& raster) {
  const system::ArithmeticScope arithmetic;
  const AnyRaster nodes = raster_of(raster);
  std::vector<double> values(num_nodes_of(nodes));
  std::vector<Point> places;
  for (std::size_t begin = 0; begin < values.size(); begin += block_nodes) {
    const std::size_t size = std::min(block_nodes, values.size() - begin);
    places.clear();
    append_places(nodes, begin, begin + size, places);
    spacings(places, std::span(values).subspan(begin, size));
  }
  return of(std::move(values), raster);
}

SizeFunction SizeFunction::from_grid(std::span<const double> lon_deg,
                                     std::span<const double> lat_deg,
                                     std::span<const double> spacings, const SizeRaster& raster) {
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
  return from_function(block, raster);
}

SizeFunction SizeFunction::refined(std::span<const Point> points, double near, double slope,
                                   const Execution& execution) const {
  const system::Call call(execution);
  require_slope(slope);
  if (points.empty()) throw InvalidInput("there are no points to refine at");
  if (!is_spacing(near)) throw InvalidInput("a spacing is between 0 and pi");
  const AnyRaster& nodes = raster_->places;
  const Locator locator(delaunay(Sites::view(points), {}, execution));
  std::vector<double> spacings(raster_->relative.size());
  // Each thread has the places of a block alone, and not those of all nodes.
  constexpr std::size_t grain = 4096;
  const auto refine_block = [&](std::size_t begin, std::size_t end) {
    std::vector<Point> places;
    places.reserve(end - begin);
    append_places(nodes, begin, end, places);
    const std::vector<Index> nearest = locator.nearest(places, {.threads = 1});
    for (std::size_t i = begin; i < end; ++i) {
      const double distance = locator.distance(places[i - begin], nearest[i - begin]);
      // Uses the values at the nodes, before they are rounded to single precision.
      const double wide = raster_->smallest / static_cast<double>(raster_->relative[i]);
      spacings[i] = std::min(wide, near + slope * distance);
    }
  };
  system::parallel_for(execution.threads, spacings.size(), grain, refine_block);
  return of(std::move(spacings), raster());
}

SizeFunction SizeFunction::limited(double slope) const {
  const system::ArithmeticScope arithmetic;
  require_slope(slope);
  std::vector<double> spacings(raster_->relative.size());
  std::ranges::transform(raster_->relative, spacings.begin(),
                         [&](float r) { return raster_->smallest / static_cast<double>(r); });
  limit_slope(raster_->places, slope, spacings);
  return of(std::move(spacings), raster());
}

SizeRaster SizeFunction::raster() const {
  if (const auto* plane = std::get_if<PlaneRaster>(&raster_->places)) {
    return {plane->region(), plane->steps()};
  }
  return std::get<CubeRaster>(raster_->places).steps;
}

double SizeFunction::relative(const Point& place) const {
  return std::visit(
      [&](const auto& nodes) {
        const RasterPlace spot = nodes.spot(place);
        const float* const low = &raster_->relative[nodes.node(spot.face, spot.i, spot.j)];
        const float* const high = low + nodes.columns();
        const double below = low[0] + spot.s * (static_cast<double>(low[1]) - low[0]);
        const double above = high[0] + spot.s * (static_cast<double>(high[1]) - high[0]);
        return below + spot.t * (above - below);
      },
      raster_->places);
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
  double sum = 0;
  double whole = 0;
  const auto add_squares = [&](const auto& nodes) {
    for (std::size_t face = 0; face < nodes.num_faces(); ++face) {
      for (std::size_t j = 0; j + 1 < nodes.rows(); ++j) {
        for (std::size_t i = 0; i + 1 < nodes.columns(); ++i) {
          const double a = 0.5 * (nodes.x(i) + nodes.x(i + 1));
          const double b = 0.5 * (nodes.y(j) + nodes.y(j + 1));
          const double square = 1 + a * a + b * b;
          const double solid = 1 / (square * std::sqrt(square));
          double density = 0;
          for (const std::size_t k : {nodes.node(face, i, j), nodes.node(face, i + 1, j),
                                      nodes.node(face, i, j + 1), nodes.node(face, i + 1, j + 1)}) {
            const double r = static_cast<double>(raster_->relative[k]);
            density += 0.25 * r * r;
          }
          sum += solid * density;
          whole += solid;
        }
      }
    }
  };
  std::visit(add_squares, raster_->places);
  const auto* const plane = std::get_if<PlaneRaster>(&raster_->places);
  const double area = plane == nullptr ? 4 * std::numbers::pi : plane->solid_angle();
  const double of_hexagon = 0.5 * std::numbers::sqrt3 * raster_->smallest * raster_->smallest;
  return area * (sum / whole) / of_hexagon;
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
