// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/slope_limiter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "exact/vector.h"
#include "overlay/prepared_grid.h"
#include "overlay/subdivision.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

// Cells that reach farther than 60 degrees from their center have no gradient.
constexpr double least_of_cone = 0.5;

// Arcs of parallels are divided into parts of at most this width, in radians, each with a control point.
constexpr double widest_arc = 0.3;

// A source is covered as a whole if its fraction is 1 but for rounding.
constexpr double rounding_of_fractions = 1e-12;

// Calls visit(node) for each node of a cell of a grid. A pole is one node.
template <class Visit>
void visit_nodes(const PreparedGrid& grid, Index cell, const Visit& visit) {
  const auto [column, row] = grid.place_of(cell);
  const auto num_lines = static_cast<Index>(grid.columns().size());
  const Index east = column + 1 < num_lines ? column + 1 : 0;
  for (const Index parallel : {row, row + 1}) {
    const bool is_pole = parallel == 0 || parallel == grid.num_rows();
    const std::size_t first = std::size_t{parallel} * num_lines;
    visit(first + (is_pole ? 0 : column));
    if (!is_pole) visit(first + east);
  }
}

std::size_t num_nodes(const CellSetData& cells) {
  if (cells.grid() == nullptr) return cells.subdivision().points.size();
  return (std::size_t{cells.grid()->num_rows()} + 1) * cells.grid()->columns().size();
}

// Appends an arc of a parallel as points of a cone: the ends of its parts, and where tangents at these meet.
void append_arc(const PreparedGrid& grid, Index column, const PreparedGrid::Parallel& parallel,
                std::vector<Point>& points) {
  const double width = grid.columns()[column].width;
  const auto number = static_cast<unsigned>(std::ceil(width / widest_arc));
  const auto append = [&](const Point& on_equator) {
    points.push_back(
        {parallel.cosine * on_equator.x, parallel.cosine * on_equator.y, parallel.sine});
  };
  Point from = grid.meridian(column, 0);
  append(from);
  for (unsigned k = 1; k <= number; ++k) {
    const Point to = grid.meridian(column, k == number ? width : width * k / number);
    append((from + to) / (1 + dot(from, to)));
    append(to);
    from = to;
  }
}

void append_points(const PreparedGrid& grid, Index cell, std::vector<Point>& points) {
  const auto [column, row] = grid.place_of(cell);
  append_arc(grid, column, grid.parallel(row), points);
  append_arc(grid, column, grid.parallel(row + 1), points);
}

// The range of g . x over the points of a cell.
struct Reach {
  double low;
  double high;
};

// Returns the range of g . x over a cell. Precondition: c > 0.
Reach reach_of(const Point& gradient, std::span<const Point> points, double c) {
  Reach reach{0, 0};
  for (const Point& p : points) {
    const double along = dot(gradient, p);
    reach = {std::min(reach.low, along), std::max(reach.high, along)};
  }
  return {reach.low / c, reach.high / c};
}

// Returns the largest part, in [0, 1], of a step that leaves no room exceeded.
double part_within(double room, double step) { return step > room ? room / step : 1; }

}  // namespace

SlopeLimiter::SlopeLimiter(const Remap& remap, std::span<const std::int32_t> has_value,
                           unsigned threads)
    : source_(remap.source), is_there_(remap.source.num_cells(), true) {
  const CellSetData& cells = CellSetData::of(source_);
  std::vector<std::int32_t> mask = source_.facts().mask;
  if (mask.empty()) mask.assign(is_there_.size(), 1);
  for (std::size_t i = 0; i < has_value.size(); ++i) {
    if (has_value[i] == 0) mask[i] = 0;
  }
  for (std::size_t i = 0; i < mask.size(); ++i) is_there_[i] = mask[i] != 0;
  unlimited_ = cell_gradients(cells, remap.source_centers, mask, threads);
  if (cells.grid() != nullptr) return;
  places_.assign(is_there_.size(), no_index);
  const auto& names = cells.subdivision().names;
  for (std::size_t place = 0; place < names.size(); ++place) {
    places_[names[place]] = static_cast<Index>(place);
  }
}

// Bounds are taken around each node first.
std::vector<ValueBounds> SlopeLimiter::bounds_around(std::span<const double> means) const {
  const CellSetData& cells = CellSetData::of(source_);
  const Subdivision& subdivision = cells.subdivision();
  const auto visit = [&](std::size_t i, const auto& take) {
    if (cells.grid() != nullptr) {
      visit_nodes(*cells.grid(), static_cast<Index>(i), take);
    } else if (places_[i] != no_index) {
      for (Halfedge h = subdivision.begin_of(places_[i]); h < subdivision.end_of(places_[i]); ++h) {
        take(subdivision.corners[h]);
      }
    }
  };
  std::vector<ValueBounds> at_nodes(num_nodes(cells));
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (!is_there_[i]) continue;
    visit(i, [&](std::size_t node) { at_nodes[node].include({means[i], means[i]}); });
  }
  std::vector<ValueBounds> bounds(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (!is_there_[i]) continue;
    bounds[i] = {means[i], means[i]};
    visit(i, [&](std::size_t node) { bounds[i].include(at_nodes[node]); });
  }
  return bounds;
}

LimitedSlopes SlopeLimiter::slopes(const Remap& remap, std::span<const double> means,
                                   unsigned threads) const {
  const CellSetData& cells = CellSetData::of(source_);
  LimitedSlopes result{std::vector<Point>(means.size()), bounds_around(means)};
  const auto limited = [&](std::size_t i, std::vector<Point>& points) {
    Point gradient{};
    for (std::uint64_t k = unlimited_.offsets[i]; k < unlimited_.offsets[i + 1]; ++k) {
      gradient = gradient + (means[unlimited_.neighbors[k]] - means[i]) * unlimited_.slopes[k];
    }
    const double size = norm(gradient);
    const Point& center = remap.source_centers[i];
    if (!(size > 0 && std::isfinite(size))) return Point{};
    points.clear();
    if (cells.grid() != nullptr) {
      append_points(*cells.grid(), static_cast<Index>(i), points);
    } else if (places_[i] != no_index) {
      const Subdivision& all = cells.subdivision();
      const Index place = places_[i];
      for (Halfedge h = all.begin_of(place); h < all.end_of(place); ++h) {
        points.push_back(all.origin(h));
      }
    }
    const Point direction = normalized(center);
    double c = points.empty() ? 0 : 1;
    for (const Point& p : points) c = std::min(c, dot(direction, p));
    if (!(c > least_of_cone)) return Point{};
    const Reach reach = reach_of(gradient, points, c);
    const bool is_whole = remap.source_fractions[i] >= 1 - rounding_of_fractions;
    const double middle = dot(gradient, center);
    const double rise = reach.high - (is_whole ? middle : reach.low);
    const double fall = (is_whole ? middle : reach.high) - reach.low;
    const auto [low, high] = result.bounds[i];
    return std::min(part_within(high - means[i], rise), part_within(means[i] - low, fall)) *
           gradient;
  };
  system::parallel_for(threads, means.size(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         std::vector<Point> points;
                         for (std::size_t i = begin; i < end; ++i) {
                           if (is_there_[i]) result.gradients[i] = limited(i, points);
                         }
                       });
  return result;
}

}  // namespace rondel::overlay
