// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Partitions of the sphere, or of parts of it, into cells with sides on great circles.
#pragma once

#include <cstddef>
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

/// Cells, prepared once to be laid over others. Copies share the memory; any thread may read.
class RONDEL_API Partition {
 public:
  /// The Voronoi cells of the sites, in the weighted model their power cells. Corners are circumcenters
  /// rounded to doubles; where rounding has brought corners of a cell into the wrong order, they become
  /// one, so that cells narrower than that may vanish.
  static Partition voronoi(const Triangulation& triangulation, const Execution& execution = {});
  /// The solid faces, in dimension 2; none in others.
  static Partition triangles(const Triangulation& triangulation, const Execution& execution = {});
  /// Any cells.
  /// \throws InvalidInput with the cell that has an index out of range, a ring of less than three corners,
  /// or a corner that is no unit vector.
  explicit Partition(const CellRings& cells, const Execution& execution = {});

  [[nodiscard]] std::size_t num_cells() const;
  /// In steradians, by cell, from its corners.
  [[nodiscard]] std::span<const double> areas() const;
  /// The cells, by index. Those of voronoi() have no corners in the wrong order.
  [[nodiscard]] CellRings rings() const;
  /// Whether the cells cover the sphere, each with one ring, convex or nearly so, and share their
  /// edges. Of two partitions that are laid over each other, one must.
  [[nodiscard]] bool is_cover() const;

 private:
  friend class overlay::PartitionData;
  explicit Partition(std::shared_ptr<const overlay::PartitionData> data);
  std::shared_ptr<const overlay::PartitionData> data_;
};

}  // namespace rondel
