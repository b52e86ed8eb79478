// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: make a feature of each line and each ring, arrange their arcs, and put the nodes
// of each arc's chain in its place.
#include "meshing/corner_meetings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/box_tree.h"
#include "map/ring_area.h"
#include "overlay/single_cells.h"
#include "rondel/arrangement.h"
#include "rondel/constrained_features.h"
#include "rondel/set_operations.h"
#include "system/distinct.h"

namespace rondel::meshing {
namespace {

// Returns the lines, and after them the rings, each as a feature of its own.
Geometries one_by_one(const Geometries& all) {
  Geometries result;
  for (std::size_t i = 0; i < all.lines.rows.size(); ++i) {
    result.lines.rows.append(all.lines.rows[i]);
    result.lines.end_group();
    result.polygons.end_cell();
  }
  result.polygons.points = all.polygons.points;
  for (std::uint64_t r = 0; r + 1 < all.polygons.rings.size(); ++r) {
    result.polygons.append_ring(all.polygons.corners_of(r));
    result.polygons.end_cell();
    result.lines.end_group();
  }
  return result;
}

// The arcs of lines and rings in an arrangement, and the line or the ring of each of them.
struct ArrangedArcs {
  Arrangement arrangement;
  std::vector<Index> features;

  // Returns the nodes of a line or a ring, whose arcs begin at `arc`, and goes on to the next one.
  std::vector<Index> nodes_of(Index feature, std::size_t& arc) const {
    std::vector<Index> nodes;
    for (; arc < features.size() && features[arc] == feature; ++arc) {
      for (const Index h : arrangement.chains[arc]) {
        const std::array<Index, 2>& ends = arrangement.edges[h / 2];
        if (nodes.empty()) nodes.push_back(ends[h % 2]);
        nodes.push_back(ends[1 - h % 2]);
      }
    }
    return nodes;
  }
};

// Puts the nodes of the chains in the place of lines and rings. A line that has become a point is
// its first point; a ring without three corners is left out.
Geometries rebuilt(const Geometries& all, const ArrangedArcs& arranged) {
  Geometries result;
  result.polygons.points = arranged.arrangement.nodes;
  Index feature = 0;
  std::size_t arc = 0;
  for (std::size_t i = 0; i < all.lines.rows.size(); ++i) {
    const std::vector<Index> nodes = arranged.nodes_of(feature++, arc);
    for (const Index node : nodes) {
      result.lines.rows.values.push_back(result.polygons.points[node]);
    }
    if (nodes.empty()) result.lines.rows.values.push_back(all.lines.rows[i].front());
    result.lines.rows.end_row();
  }
  result.lines.offsets = all.lines.offsets;
  for (std::size_t cell = 0; cell < all.polygons.num_cells(); ++cell) {
    for (std::uint64_t r = all.polygons.cells[cell]; r < all.polygons.cells[cell + 1]; ++r) {
      std::vector<Index> nodes = arranged.nodes_of(feature++, arc);
      if (!nodes.empty()) nodes.pop_back();  // the first one again
      if (nodes.size() >= 3) result.polygons.append_ring(nodes);
    }
    result.polygons.end_cell();
  }
  return result;
}

}  // namespace

std::optional<Geometries> meeting_in_corners(const Geometries& all, const Execution& execution) {
  const Geometries alone = one_by_one(all);
  FeatureConstraints features = constraints_of_features(alone.lines, alone.polygons);
  // Points divide the arcs on which they are.
  std::vector<std::array<Index, 2>> arcs = std::move(features.constraints);
  for (std::size_t i = 0; i < all.lines.rows.size(); ++i) {
    if (all.lines.rows[i].size() != 1) continue;
    const auto point = static_cast<Index>(features.sites.size());
    features.sites.push_back(all.lines.rows[i].front());
    arcs.push_back({point, point});
  }
  const ArrangedArcs arranged = {arrange(features.sites, arcs, execution),
                                 std::move(features.features)};
  const CompressedRows<Index>& chains = arranged.arrangement.chains;
  bool is_divided = false;
  for (std::size_t arc = 0; arc < arranged.features.size(); ++arc) {
    is_divided = is_divided || chains[arc].size() != 1;
  }
  if (!is_divided) return std::nullopt;
  return rebuilt(all, arranged);
}

bool may_have_common_places(const CellRings& polygons, std::size_t end) {
  std::vector<Point> corners;
  std::vector<arrangement::SpaceBox> boxes;
  bool has_outside = false;
  for (std::size_t cell = 0; cell < end; ++cell) {
    arrangement::SpaceBox box = arrangement::empty_box;
    std::vector<std::vector<Point>> rings;
    for (std::uint64_t r = polygons.cells[cell]; r < polygons.cells[cell + 1]; ++r) {
      rings.push_back(overlay::points_of_ring(polygons, r));
      for (const Point& p : rings.back()) {
        corners.push_back(p);
        box.include({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
      }
    }
    if (rings.empty()) continue;
    has_outside = has_outside || map::have_outside_on_left(rings);
    // Within its sides a polygon is higher than its corners.
    box.widen(box.squared_diagonal());
    boxes.push_back(box);
  }
  if (has_outside && boxes.size() > 1) return true;
  if (system::distinct(std::span<const Point>(corners)).values.size() < corners.size()) return true;
  const arrangement::BoxTree tree(boxes, 1);
  bool is_any = false;
  for (std::size_t block = 0; block < tree.num_blocks() && !is_any; ++block) {
    tree.visit_pairs(block, [&](Index, Index) { is_any = true; });
  }
  return is_any;
}

void unite_polygons(std::size_t begin, std::size_t end, Geometries& all,
                    const Execution& execution) {
  if (begin == end) return;
  CellRings& polygons = all.polygons;
  CellRings range;
  range.points = polygons.points;
  for (std::size_t cell = begin; cell < end; ++cell) range.append_cell(polygons, cell);
  const CellRings united = unite(range, execution);
  CellRings result;
  result.points = polygons.points;
  for (std::size_t cell = 0; cell < polygons.num_cells(); ++cell) {
    if (cell < begin || cell >= end) {
      result.append_cell(polygons, cell);
      continue;
    }
    if (cell == begin) {
      if (united.is_whole(0)) result.whole.push_back(static_cast<Index>(cell));
      std::vector<Index> ring;
      for (std::uint64_t r = 0; r + 1 < united.rings.size(); ++r) {
        ring.clear();
        for (const Index corner : united.corners_of(r)) {
          ring.push_back(corner + static_cast<Index>(polygons.points.size()));
        }
        result.append_ring(ring);
      }
      result.points.insert(result.points.end(), united.points.begin(), united.points.end());
    }
    result.end_cell();
  }
  polygons = std::move(result);
}

}  // namespace rondel::meshing
