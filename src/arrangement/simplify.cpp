// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rings and lines become one network, nodes of it are removed, and what is left of each ring and
// line is read from it.
#include "rondel/simplify.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/corner_removal.h"
#include "arrangement/line_network.h"
#include "map/ring_area.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

using arrangement::LineNetwork;
using arrangement::NodeState;

double limit_of(double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    throw InvalidInput("a tolerance is negative or not a finite number");
  }
  return arrangement::squared_sine_below(tolerance);
}

std::vector<double> limits_of(const LineNetwork& network, const SimplifyOptions& options) {
  const double limit = limit_of(options.tolerance);
  std::vector<double> limits(network.points.size(), limit);
  if (!options.tolerance_at) return limits;
  std::ranges::transform(network.points, limits.begin(),
                         [&](const Point& p) { return limit_of(options.tolerance_at(p)); });
  return limits;
}

// Reads what is left of rings and lines.
class LeftNodes {
 public:
  explicit LeftNodes(std::span<const NodeState> states) : states_(states) {}

  [[nodiscard]] bool is_left(Index node) const { return states_[node] < NodeState::removed; }
  [[nodiscard]] bool is_dropped(std::span<const Index> ring) const {
    return std::ranges::any_of(ring, [&](Index n) { return states_[n] == NodeState::dropped; });
  }

 private:
  std::span<const NodeState> states_;
};

// Returns the points of some of the network's nodes.
std::vector<Point> points_of(std::span<const Index> ring, const LineNetwork& network) {
  std::vector<Point> points;
  for (const Index node : ring) points.push_back(network.points[node]);
  return points;
}

// A polygon of which all rings are dropped becomes what is outside of all of them: nothing for an
// island, with or without a lake, and the whole sphere for the land around a lake.
CellRings polygons_left(const CellRings& given, const LineNetwork& network,
                        const LeftNodes& nodes) {
  std::vector<Index> numbers(network.points.size(), no_index);
  for (const Index node : network.rings.values) {
    if (nodes.is_left(node)) numbers[node] = 0;
  }
  CellRings result;
  for (Index node = 0; node < numbers.size(); ++node) {
    if (numbers[node] == no_index) continue;
    numbers[node] = static_cast<Index>(result.points.size());
    result.points.push_back(network.points[node]);
  }
  for (std::size_t cell = 0; cell < given.num_cells(); ++cell) {
    std::vector<std::vector<Point>> dropped;
    for (std::uint64_t r = given.cells[cell]; r < given.cells[cell + 1]; ++r) {
      const std::span<const Index> ring = network.rings[r];
      if (nodes.is_dropped(ring)) {
        dropped.push_back(points_of(ring, network));
        continue;
      }
      for (const Index node : ring) {
        if (nodes.is_left(node)) result.corners.push_back(numbers[node]);
      }
      result.end_ring();
    }
    const bool has_rings = result.rings.size() - 1 != result.cells.back();
    if (!has_rings && (given.is_whole(cell) || map::have_outside_on_left(dropped))) {
      result.whole.push_back(static_cast<Index>(cell));
    }
    result.end_cell();
  }
  return result;
}

FeatureLines lines_left(const FeatureLines& given, const LineNetwork& network,
                        const LeftNodes& nodes) {
  FeatureLines result;
  result.offsets = given.offsets;
  for (std::size_t i = 0; i < network.lines.size(); ++i) {
    for (const Index node : network.lines[i]) {
      if (nodes.is_left(node)) result.rows.values.push_back(network.points[node]);
    }
    result.rows.end_row();
  }
  return result;
}

}  // namespace

SimplifiedFeatures simplified(const FeatureLines& lines, const CellRings& polygons,
                              const SimplifyOptions& options, const Execution& execution) {
  const system::Call call(execution);
  if (!(options.clearance >= 0 && options.clearance <= 1)) {
    throw InvalidInput("the clearance is not from 0 to 1");
  }
  const LineNetwork network =
      arrangement::line_network(lines, polygons, options.keep_boundary, execution.threads);
  const std::vector<NodeState> states = arrangement::removed_nodes(
      network, limits_of(network, options),
      {.drops_loops = options.drop_small, .clearance = options.clearance}, execution.threads);
  const LeftNodes nodes(states);
  return {lines_left(lines, network, nodes), polygons_left(polygons, network, nodes)};
}

CellRings simplified(const CellRings& polygons, const SimplifyOptions& options,
                     const Execution& execution) {
  return simplified({}, polygons, options, execution).polygons;
}

}  // namespace rondel
