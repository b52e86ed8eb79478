// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Partitions of the sphere, or of parts of it, into cells: with sides on great circles, or between meridians
/// and parallels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::overlay {
class PartitionData;
}  // namespace rondel::overlay

namespace rondel {

/// A grid in longitude and latitude, by its lines. Cell `row * (lon_deg.size() - 1) + column` is between parallels row
/// and row + 1 and meridians column and column + 1.
struct LonLatGrid {
  std::vector<double> lon_deg;  ///< meridians, increasing or decreasing, by 360 degrees at most
  std::vector<double> lat_deg;  ///< parallels, increasing or decreasing
};

/// What the northern and southern sides of a grid's cells are.
enum class GridSides : std::uint8_t {
  parallels,      ///< circles of latitude, as in most models
  great_circles,  ///< the shortest ways between the corners, as ESMF's conservative method takes them
};

/// Cells, prepared once to be laid over others. Copies share the memory; any thread may read.
class RONDEL_API Partition {
 public:
  /// The Voronoi cells of the sites, in the weighted model their power cells. Corners are circumcenters
  /// rounded to doubles; where rounding has brought corners of a cell into the wrong order, they become
  /// one, so that cells narrower than that may vanish.
  static Partition voronoi(const Triangulation& triangulation, const Execution& execution = {});
  /// The solid faces, in dimension 2; none in others.
  static Partition triangles(const Triangulation& triangulation, const Execution& execution = {});
  /// The cells of a grid. With parallels, areas in the overlay are those between parallels and arcs
  /// themselves, not of polygons near them; such a partition has no rings(), and regions.h refuses it.
  /// \throws InvalidInput with the line that is out of order or no longitude or latitude; with
  ///         great circles also with a cell that is 180 degrees wide.
  static Partition lonlat_grid(const LonLatGrid& grid, GridSides sides = GridSides::parallels,
                               const Execution& execution = {});
  /// Any cells. Of cells that are neither convex nor nearly so, sides that run to and fro between two corners vanish, and so
  /// do ways that turn back on themselves.
  /// \throws InvalidInput with the cell that has an index out of range, a ring of less than three corners,
  /// a corner that is no unit vector, or rings although it is named as the whole sphere; or whose sides all run to and fro, as
  /// those of a ring and a hole of the same corners, or of two parts that share all of their border, so that it may be nothing
  /// or the whole sphere. But rings no wider than rounding of their corners are nothing. Cells that cross or overlap
  /// themselves, or each other, are refused by what is done with them (remap.h, regions.h).
  explicit Partition(const CellRings& cells, const Execution& execution = {});

  [[nodiscard]] std::size_t num_cells() const;
  /// In steradians, by cell, from its corners.
  [[nodiscard]] std::span<const double> areas() const;
  /// Where the centers of mass are seen from the center of the sphere, by cell; (0, 0, 0) of an empty one.
  [[nodiscard]] std::vector<Point> centers() const;
  /// The cells, by index. Those of voronoi() have no corners in the wrong order.
  [[nodiscard]] CellRings rings() const;
  /// Whether the cells cover the sphere, each with one ring, convex or nearly so, and share their
  /// edges; or whether they are a grid of parallels that does. An overlay of two of
  /// which one does, or is any grid of parallels, takes less time (remap.h), and regions.h needs one that does.
  [[nodiscard]] bool is_cover() const;

 private:
  friend class overlay::PartitionData;
  explicit Partition(std::shared_ptr<const overlay::PartitionData> data);
  static Partition of_apart(const CellRings& cells, const Execution& execution);
  std::shared_ptr<const overlay::PartitionData> data_;
};

}  // namespace rondel
