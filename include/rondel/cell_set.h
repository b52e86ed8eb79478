// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sets of cells on the sphere, prepared for overlays: with sides on great circles, or between
/// meridians and parallels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::overlay {
class CellSetData;
}  // namespace rondel::overlay

namespace rondel {

/// A grid in longitude and latitude, given by its lines. Cell `row * (lon_deg.size() - 1) + column`
/// is between the parallels row and row + 1 and the meridians column and column + 1.
struct LonLatGrid {
  std::vector<double> lon_deg;  ///< meridians, ascending or descending, over at most 360 degrees
  std::vector<double> lat_deg;  ///< parallels, ascending or descending
};

/// The northern and southern sides of a grid's cells.
enum class GridSides : std::uint8_t {
  parallels,  ///< circles of latitude, as in most models
  /// The shorter arcs between the corners, as ESMF's conservative method takes them.
  great_circles,
};

/// Returns the name of a value: "parallels", "great_circles"; empty for other numbers.
RONDEL_API std::string_view name_of(GridSides sides) noexcept;

/// Cells prepared for overlays with others. Copies share the memory; several threads may use one.
class RONDEL_API CellSet {
 public:
  /// Makes the Voronoi cells of the sites, or the power cells in the weighted model. Corners are
  /// circumcenters, rounded to doubles. Corners that rounding has put into the wrong order are
  /// merged, so cells narrower than that may vanish.
  static CellSet voronoi(const Triangulation& triangulation, const Execution& execution = {});
  /// Makes the solid faces into cells in dimension 2; there are none in other dimensions.
  static CellSet triangles(const Triangulation& triangulation, const Execution& execution = {});
  /// Makes the cells of a grid. With GridSides::parallels, areas in the overlay are exact areas
  /// between parallels and arcs, not those of polygons near them; such cells have no rings(),
  /// and regions.h refuses it.
  /// \throws InvalidInput with the line that is out of order or no longitude or latitude; with
  ///         great circles also with a cell that is 180 degrees wide.
  static CellSet lonlat_grid(const LonLatGrid& grid, GridSides sides = GridSides::parallels,
                             const Execution& execution = {});
  /// Prepares any cells. In cells that are neither convex nor nearly convex, sides that lead back
  /// and forth between two corners cancel, and so do paths that turn back on themselves.
  /// \throws InvalidInput with the cell that has an index out of range, a ring of less than three
  /// corners, a corner that is no unit vector, or rings although it is in `whole`; or whose sides
  /// all cancel, as those of a ring and a hole with the same corners, or of two parts that share
  /// all of their border, so that it may be empty or the whole sphere. (Rings no wider than
  /// rounding of their corners are dropped.) Cells that cross or overlap themselves are refused by
  /// areas(), by centers(), and, as cells that overlap each other, by the functions that use them
  /// (remap.h, regions.h).
  explicit CellSet(const CellRings& cells, const Execution& execution = {});

  [[nodiscard]] std::size_t num_cells() const;
  /// Returns the area of each cell in steradians, computed from its corners.
  /// \throws InvalidInput with the first cell that crosses or overlaps itself
  [[nodiscard]] std::span<const double> areas() const;
  /// Returns the direction of the center of mass of each cell from the center of the sphere; (0, 0,
  /// 0) for an empty cell.
  /// \throws InvalidInput as areas() does
  [[nodiscard]] std::vector<Point> centers() const;
  /// Returns the cells. Those of voronoi() have no corners in the wrong order.
  [[nodiscard]] CellRings rings() const;
  /// Returns the same as rings(), but rings begin where those of the input did: CellSet() of them
  /// has the same areas and centers, bit by bit, which depend on it in the last digit.
  [[nodiscard]] CellRings given_rings() const;
  /// True if the cells cover the sphere, each with one ring that is convex or nearly so, and share
  /// their edges; or if they are a grid of parallels that covers the sphere. An overlay in which
  /// one side is a cover, or is any grid of parallels, takes less time (remap.h, regions.h).
  [[nodiscard]] bool is_cover() const;

 private:
  friend class overlay::CellSetData;
  explicit CellSet(std::shared_ptr<const overlay::CellSetData> data);
  static CellSet of_apart(const CellRings& cells, const Execution& execution);
  std::shared_ptr<const overlay::CellSetData> data_;
};

}  // namespace rondel
