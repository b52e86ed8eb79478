// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/regions.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "overlay/border_rings.h"
#include "overlay/cell_set_data.h"
#include "overlay/cover_triangulation.h"
#include "overlay/disjoint_cells.h"
#include "overlay/measure.h"
#include "overlay/overlaps.h"
#include "overlay/piece_boundaries.h"
#include "overlay/region_area.h"
#include "overlay/single_cells.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel {
namespace {

using overlay::BoundaryArc;
using overlay::CellSetData;
using overlay::Halfedge;
using overlay::KeyedArc;
using overlay::PieceBoundaries;
using overlay::Subdivision;

constexpr std::size_t cells_per_block = 64;
constexpr double sphere_area = 4 * std::numbers::pi;
// A cell without a border is empty or the whole sphere. Two cells larger than this have at least
// half of the sphere in common, so then it is the sphere.
constexpr double max_per_sphere = 3 * std::numbers::pi;

// An arc on the border of a piece, with the piece to its left: the indices in the input of the cell
// and of the region that have it.
struct NamedArc {
  Index cell;
  Index beyond;
  Point from;
  Point to;
};

// Collects the arcs on the borders of the pieces of cells. beyond[c] is the region that cell c of
// the cover belongs to, or no_index; several cells of the cover may belong to one region.
class NamedArcMaker {
 public:
  NamedArcMaker(const Subdivision& cells, const Subdivision& cover, std::span<const Index> beyond,
                Index first_cell, Index end_cell)
      : cells_(cells), beyond_(beyond), make_(cells, cover, first_cell, end_cell) {}

  // Appends the arcs of all pieces of a cell. Arcs between cells of the cover in one region are
  // left out, and parts of a side within one region are joined.
  void append(Index cell, std::vector<NamedArc>& arcs) {
    const Index name = cells_.names[cell];
    const auto add = [&](Index region, const Point& from, const Point& to) {
      if (region != no_index) arcs.push_back({name, region, from, to});
    };
    std::size_t next = 0;  // the next corner of the cell
    Index region_before = no_index;
    const std::span<const BoundaryArc> arcs_of_cell = make_(cell);
    if (!make_.is_consistent()) {
      refuse_or_skip(cell);
      return;
    }
    for (const BoundaryArc& arc : arcs_of_cell) {
      const Point& from = make_.points()[arc.from];
      const Point& to = make_.points()[arc.to];
      const Index region = beyond_[arc.left];
      if (arc.right != no_index) {
        const Index other = beyond_[arc.right];
        if (region == other) continue;
        add(region, from, to);
        add(other, to, from);
        continue;
      }
      const bool is_corner = next < make_.corners().size() && arc.from == make_.corners()[next];
      if (is_corner) ++next;
      if (is_corner || region != region_before) {
        add(region, from, to);
      } else if (region != no_index) {
        arcs.back().to = to;  // the edge that was crossed is within the region
      }
      region_before = region;
    }
  }

 private:
  // Throws InvalidInput for a cell whose sides cross, unless it is no wider than rounding; then it
  // has no pieces.
  void refuse_or_skip(Index cell) const {
    double length = 0;
    for (Index ring = cells_.cells[cell]; ring < cells_.cells[cell + 1]; ++ring) {
      const Halfedge end = cells_.rings[ring + 1];
      for (Halfedge h = cells_.rings[ring]; h < end; ++h) {
        const Halfedge after = h + 1 < end ? h + 1 : cells_.rings[ring];
        length += overlay::rough_length(cells_.origin(h), cells_.origin(after));
      }
    }
    if (cells_.area_of_other(cell) <= 4 * overlay::area_of_rounding(length)) return;
    const Index name = cells_.names[cell];
    throw InvalidInput("cell " + std::to_string(name) + " crosses or overlaps itself", name);
  }

  const Subdivision& cells_;
  std::span<const Index> beyond_;
  PieceBoundaries make_;
};

// Returns the arcs of all pieces of the cells in a cover.
std::vector<NamedArc> arcs_of(const Subdivision& cells, const Subdivision& cover,
                              std::span<const Index> beyond, const Execution& execution) {
  std::vector<std::vector<NamedArc>> blocks(system::num_pieces(cells.num_cells(), cells_per_block));
  system::StageProgress progress(execution.progress, "cut", blocks.size());
  system::parallel_for(execution.threads, cells.num_cells(), cells_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         NamedArcMaker make(cells, cover, beyond, static_cast<Index>(begin),
                                            static_cast<Index>(end));
                         for (std::size_t c = begin; c < end; ++c) {
                           if (cells.shapes[c] == overlay::Shape::empty) continue;
                           make.append(static_cast<Index>(c), blocks[begin / cells_per_block]);
                         }
                         progress.step();
                       });
  std::vector<NamedArc> all;
  std::size_t size = 0;
  for (const auto& block : blocks) size += block.size();
  all.reserve(size);
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

// Returns the arcs of all pieces of the cells in others that need not cover the sphere.
std::vector<NamedArc> arcs_of_parts(const Subdivision& cells, const Subdivision& others,
                                    const Execution& execution) {
  const overlay::CoverTriangulation completed = overlay::triangulate_cover(others, execution);
  std::vector<Index> beyond;
  beyond.reserve(completed.owners.size());
  for (const Index owner : completed.owners) {
    beyond.push_back(owner < others.num_cells() ? others.names[owner] : no_index);
  }
  return arcs_of(cells, completed.cover, beyond, execution);
}

// Returns the sides of all cells, with the cell that is the whole sphere as the region.
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

// Exchanges cells and regions.
void exchange(std::vector<NamedArc>& arcs) {
  for (NamedArc& arc : arcs) std::swap(arc.cell, arc.beyond);
}

// Returns the cells that are the whole sphere, among those without rings that something was left of
// before borders cancelled. Such a cell is empty or the whole sphere. It is the sphere if
// covered(i), the area of the smaller of the two cells that met in it or of all cells that were
// joined, is most of it.
std::vector<Index> whole_cells_of(const CellRings& cells, const auto& covered) {
  std::vector<Index> whole;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    if (cells.cells[i] == cells.cells[i + 1] && covered(i) > max_per_sphere) {
      whole.push_back(static_cast<Index>(i));
    }
  }
  return whole;
}

// Returns the arcs for cells and regions of which neither covers the sphere.
std::vector<NamedArc> overlay_of_parts(const Subdivision& cells, const Subdivision& regions,
                                       const Execution& execution) {
  const auto with = [&](bool are_cells_filled, const Execution& told) {
    if (!are_cells_filled) return arcs_of_parts(cells, regions, told);
    std::vector<NamedArc> arcs = arcs_of_parts(regions, cells, told);
    exchange(arcs);
    return arcs;
  };
  return overlay::with_one_filled(cells, regions, {"first set's", "regions'"}, execution, with);
}

// Returns the arcs of all pieces of cells in regions, whatever the two are.
std::vector<NamedArc> overlay_of(const CellSetData& cells, const CellSetData& regions,
                                 const Execution& execution) {
  std::vector<NamedArc> arcs;
  if (cells.whole() != no_index) {
    arcs = arcs_within(regions.subdivision(), cells.whole());
    exchange(arcs);
  } else if (regions.whole() != no_index) {
    arcs = arcs_within(cells.subdivision(), regions.whole());
  } else if (cells.covers_sphere()) {
    const Subdivision& cover = cells.subdivision();
    arcs = arcs_of(regions.subdivision(), cover, cover.names, execution);
    exchange(arcs);
  } else if (regions.covers_sphere()) {
    const Subdivision& cover = regions.subdivision();
    arcs = arcs_of(cells.subdivision(), cover, cover.names, execution);
  } else {
    arcs = overlay_of_parts(cells.subdivision(), regions.subdivision(), execution);
  }
  return arcs;
}

// Throws InvalidInput if a cell overlaps itself.
void require_sound(const CellSet& cells, const char* what, const Execution& execution) {
  const std::vector<CrossingCells>& found = CellSetData::of(cells).overlaps(execution);
  const auto wrong = std::ranges::find_if(
      found, [](const CrossingCells& pair) { return pair.first == pair.second; });
  if (wrong == found.end()) return;
  throw InvalidInput(std::string(what) + ' ' + overlay::message_of(*wrong), wrong->second);
}

// Returns the area of a cell in steradians.
double area_of_cell(const CellRings& cells, std::size_t cell) {
  if (cells.is_whole(cell)) return sphere_area;
  overlay::RegionArea area;
  for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
    area.add(overlay::points_of_ring(cells, r));
  }
  return area.value();
}

// Clips cells to regions that do not overlap.
CellRings clipped_to(const CellSet& cells, const CellSet& regions, const Execution& execution) {
  const std::vector<NamedArc> arcs =
      overlay_of(CellSetData::of(cells), CellSetData::of(regions), execution);
  std::vector<KeyedArc> keyed;
  keyed.reserve(arcs.size());
  for (const NamedArc& arc : arcs) keyed.push_back({arc.cell, arc.from, arc.to});
  CellRings clipped = overlay::rings_around(keyed, cells.num_cells(), execution.threads);
  const std::vector<double>& of_cells = CellSetData::of(cells).areas();
  const std::vector<double>& of_regions = CellSetData::of(regions).areas();
  const double covered = std::accumulate(of_regions.begin(), of_regions.end(), 0.0);
  clipped.whole =
      whole_cells_of(clipped, [&](std::size_t i) { return std::min(of_cells[i], covered); });
  return clipped;
}

}  // namespace

RegionPieces intersection(const CellSet& cells, const CellSet& regions,
                          const Execution& execution) {
  const system::Call call(execution);
  overlay::require_arcs(CellSetData::of(cells));
  overlay::require_arcs(CellSetData::of(regions));
  require_sound(cells, "of the first set,", execution);
  require_sound(regions, "of the regions,", execution);
  const std::vector<NamedArc> arcs =
      overlay_of(CellSetData::of(cells), CellSetData::of(regions), execution);
  using Pair = std::pair<Index, Index>;
  std::vector<Pair> pairs;
  pairs.reserve(arcs.size());
  for (const NamedArc& arc : arcs) pairs.emplace_back(arc.cell, arc.beyond);
  for (const Index cell : CellSetData::of(cells).all_whole()) {
    for (const Index region : CellSetData::of(regions).all_whole()) {
      pairs.emplace_back(cell, region);
    }
  }
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
    if (all.cells[k] == all.cells[k + 1]) {
      if (std::min(CellSetData::of(cells).areas()[pairs[k].first],
                   CellSetData::of(regions).areas()[pairs[k].second]) <= max_per_sphere)
        continue;
      result.rings.whole.push_back(static_cast<Index>(result.cells.size()));
    }
    result.rings.cells.push_back(all.cells[k + 1]);
    result.cells.push_back(pairs[k].first);
    result.regions.push_back(pairs[k].second);
  }
  return result;
}

CellRings clip(const CellSet& cells, const CellSet& regions, const Execution& execution) {
  const system::Call call(execution);
  overlay::require_arcs(CellSetData::of(cells));
  overlay::require_arcs(CellSetData::of(regions));
  require_sound(cells, "of the first set,", execution);
  const auto united = overlay::united(CellSetData::of(regions), "of the regions,", execution);
  return clipped_to(cells, united ? *united : regions, execution);
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
      const std::vector<Point> points = overlay::points_of_ring(cells, r);
      for (std::size_t k = 0; k < points.size(); ++k) {
        keyed.push_back({groups[i], points[k], points[k + 1 < points.size() ? k + 1 : 0]});
      }
    }
  }
  CellRings joined = overlay::rings_around(keyed, num_groups, execution.threads);
  const auto is_without_rings = [&](std::size_t group) {
    return joined.cells[group] == joined.cells[group + 1];
  };
  std::vector<double> covered(num_groups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i] == no_index || !is_without_rings(groups[i])) continue;
    covered[groups[i]] += area_of_cell(cells, i);
  }
  joined.whole = whole_cells_of(joined, [&](std::size_t group) { return covered[group]; });
  return joined;
}

std::vector<double> areas(const CellRings& cells) {
  std::vector<double> result;
  result.reserve(cells.num_cells());
  for (std::size_t i = 0; i < cells.num_cells(); ++i) result.push_back(area_of_cell(cells, i));
  return result;
}

std::vector<double> lengths(const CellRings& cells) {
  std::vector<double> result;
  result.reserve(cells.num_cells());
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    double sum = 0;
    for (std::uint64_t r = cells.cells[i]; r < cells.cells[i + 1]; ++r) {
      const std::span<const Index> ring = cells.corners_of(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point& p = cells.points[ring[k]];
        const Point& q = cells.points[ring[k + 1 < ring.size() ? k + 1 : 0]];
        sum += exact::argument(norm(cross(p, q - p)), dot(p, q));
      }
    }
    result.push_back(sum);
  }
  return result;
}

}  // namespace rondel
