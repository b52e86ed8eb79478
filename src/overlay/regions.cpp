// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "map/ring_area.h"
#include "overlay/arcs.h"
#include "overlay/border_rings.h"
#include "overlay/measure.h"
#include "overlay/partition_data.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel {
namespace {

using overlay::KeyedArc;
using overlay::PartitionData;
using overlay::Subdivision;

constexpr std::size_t cells_per_block = 64;

// Of a piece of a cell of the first subdivision and one of the second, both by name.
struct NamedArc {
  Index cell;
  Index beyond;
  Point from;
  Point to;
};

std::vector<NamedArc> arcs_of(const Subdivision& cells, const Subdivision& cover,
                              const Execution& execution) {
  std::vector<std::vector<NamedArc>> blocks(system::num_pieces(cells.num_cells(), cells_per_block));
  system::parallel_for(execution.threads, cells.num_cells(), cells_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         overlay::ArcMaker make(cells, cover, static_cast<Index>(begin),
                                                static_cast<Index>(end));
                         for (std::size_t c = begin; c < end; ++c) {
                           if (cells.shapes[c] == overlay::Shape::empty) continue;
                           for (const overlay::PieceArc& arc : make(static_cast<Index>(c))) {
                             auto& block = blocks[begin / cells_per_block];
                             const Point& from = make.points()[arc.from];
                             const Point& to = make.points()[arc.to];
                             block.push_back({cells.names[c], cover.names[arc.left], from, to});
                             if (arc.right == no_index) continue;
                             block.push_back({cells.names[c], cover.names[arc.right], to, from});
                           }
                         }
                       });
  std::vector<NamedArc> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

// The borders of cells, each beyond the cell that is the whole sphere.
std::vector<NamedArc> arcs_within(const Subdivision& cells, Index whole) {
  std::vector<NamedArc> arcs;
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    for (Index ring = cells.cells[c]; ring < cells.cells[c + 1]; ++ring) {
      const Index first = cells.rings[ring];
      const Index end = cells.rings[ring + 1];
      for (Index h = first; h < end; ++h) {
        arcs.push_back(
            {cells.names[c], whole, cells.origin(h), cells.origin(h + 1 < end ? h + 1 : first)});
      }
    }
  }
  return arcs;
}

void exchange(std::vector<NamedArc>& arcs) {
  for (NamedArc& arc : arcs) std::swap(arc.cell, arc.beyond);
}

// `beyond` are the regions.
std::vector<NamedArc> overlay_of(const PartitionData& cells, const PartitionData& regions,
                                 const Execution& execution) {
  overlay::require_arcs(cells);
  overlay::require_arcs(regions);
  std::vector<NamedArc> arcs;
  if (cells.whole() != no_index) {
    arcs = arcs_within(regions.subdivision(), cells.whole());
    exchange(arcs);
  } else if (regions.whole() != no_index) {
    arcs = arcs_within(cells.subdivision(), regions.whole());
  } else if (cells.is_cover()) {
    arcs = arcs_of(regions.subdivision(), cells.subdivision(), execution);
    exchange(arcs);
  } else if (regions.is_cover()) {
    arcs = arcs_of(cells.subdivision(), regions.subdivision(), execution);
  } else {
    throw InvalidInput("neither the cells nor the regions cover the sphere", 0);
  }
  return arcs;
}

std::vector<Point> points_of(const CellRings& cells, std::uint64_t ring) {
  std::vector<Point> points;
  for (std::uint64_t k = cells.rings[ring]; k < cells.rings[ring + 1]; ++k) {
    points.push_back(cells.points[cells.corners[k]]);
  }
  return points;
}

}  // namespace

RegionPieces intersection(const Partition& cells, const Partition& regions,
                          const Execution& execution) {
  const system::Call call(execution);
  const std::vector<NamedArc> arcs =
      overlay_of(PartitionData::of(cells), PartitionData::of(regions), execution);
  using Pair = std::pair<Index, Index>;
  std::vector<Pair> pairs;
  pairs.reserve(arcs.size());
  for (const NamedArc& arc : arcs) pairs.emplace_back(arc.cell, arc.beyond);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<KeyedArc> keyed;
  keyed.reserve(arcs.size());
  for (const NamedArc& arc : arcs) {
    const auto pair = std::ranges::lower_bound(pairs, Pair(arc.cell, arc.beyond));
    keyed.push_back({static_cast<Index>(pair - pairs.begin()), arc.from, arc.to});
  }
  const CellRings all = overlay::rings_around(keyed, pairs.size(), execution.threads);
  RegionPieces result;
  result.rings.points = all.points;
  result.rings.rings = all.rings;
  result.rings.corners = all.corners;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (all.cells[k] == all.cells[k + 1]) continue;
    result.rings.cells.push_back(all.cells[k + 1]);
    result.cells.push_back(pairs[k].first);
    result.regions.push_back(pairs[k].second);
  }
  return result;
}

CellRings clip(const Partition& cells, const Partition& regions, const Execution& execution) {
  const system::Call call(execution);
  const std::vector<NamedArc> arcs =
      overlay_of(PartitionData::of(cells), PartitionData::of(regions), execution);
  std::vector<KeyedArc> keyed;
  keyed.reserve(arcs.size());
  for (const NamedArc& arc : arcs) keyed.push_back({arc.cell, arc.from, arc.to});
  return overlay::rings_around(keyed, cells.num_cells(), execution.threads);
}

CellRings dissolve(const CellRings& cells, std::span<const Index> groups, std::size_t num_groups,
                   const Execution& execution) {
  const system::Call call(execution);
  if (groups.size() != cells.num_cells()) {
    throw InvalidInput("there are " + std::to_string(groups.size()) + " groups for " +
                           std::to_string(cells.num_cells()) + " cells",
                       groups.size());
  }
  std::vector<KeyedArc> keyed;
  keyed.reserve(cells.corners.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i] == no_index) continue;
    if (groups[i] >= num_groups) {
      throw InvalidInput("cell " + std::to_string(i) + " is of group " + std::to_string(groups[i]) +
                             " of " + std::to_string(num_groups),
                         i);
    }
    for (std::uint64_t r = cells.cells[i]; r < cells.cells[i + 1]; ++r) {
      const std::vector<Point> points = points_of(cells, r);
      for (std::size_t k = 0; k < points.size(); ++k) {
        keyed.push_back({groups[i], points[k], points[k + 1 < points.size() ? k + 1 : 0]});
      }
    }
  }
  return overlay::rings_around(keyed, num_groups, execution.threads);
}

std::vector<double> areas(const CellRings& cells) {
  std::vector<double> result(cells.num_cells());
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::size_t num_corners = 0;
    for (std::uint64_t r = cells.cells[i]; r < cells.cells[i + 1]; ++r) {
      const std::vector<Point> points = points_of(cells, r);
      result[i] += map::area_on_left(points);
      num_corners += points.size();
    }
    const double rounding = overlay::area_of_rounding(static_cast<double>(num_corners));
    if (result[i] < -rounding) result[i] += 4 * std::numbers::pi;
  }
  return result;
}

}  // namespace rondel
