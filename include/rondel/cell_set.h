// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sets of cells on the sphere, prepared for overlays: with sides on great circles, or between
/// meridians and parallels (target rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/polygon_files.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::overlay {
class CellSetData;
}  // namespace rondel::overlay

namespace rondel {

/// The northern and southern sides of a grid's cells.
enum class GridSides : std::uint8_t {
  parallels,  ///< circles of latitude, as in most models
  /// The shorter arcs between the corners, as ESMF's conservative method takes them.
  great_circles,
};

/// Returns the name of a value: "parallels", "great_circles"; empty for other numbers.
RONDEL_API std::string_view name_of(GridSides sides) noexcept;

/// A grid of the whole sphere with equal steps: from longitude -180 eastward and from the south
/// pole northward. Every line and center is an exact quotient that is rounded once.
struct GlobalGrid {
  std::uint64_t num_lon = 0;  ///< cells along a parallel
  std::uint64_t num_lat = 0;  ///< cells along a meridian

  [[nodiscard]] RONDEL_API LonLatGrid lines() const;
  [[nodiscard]] RONDEL_API LonLatAxes centers() const;
  /// Returns the area of each cell between parallels, in steradians.
  [[nodiscard]] RONDEL_API std::vector<double> areas() const;
};

/// How the cells of a file are read.
struct CellFileOptions {
  GridSides sides = GridSides::parallels;     ///< for coordinates along axes
  PolygonEdges edges = PolygonEdges::lonlat;  ///< for polygons
  /// For polygons; other cells are repaired() if they are to be.
  InvalidPolygons invalid = InvalidPolygons::error;
  PolygonOverlap overlap = PolygonOverlap::keep;   ///< for polygons
  FeatureChoice is_taken = {};                     ///< for polygons, as in PolygonOptions
  MissingCorners corners = MissingCorners::error;  ///< for coordinates of two dimensions
};

/// Cells prepared for overlays with others, and what is known of them. Copies share the memory;
/// several threads may use one.
class RONDEL_API CellSet {
 public:
  /// Makes the set of no cells.
  CellSet();
  /// Makes the Voronoi cells of the sites, or the power cells in the weighted model. Corners are
  /// circumcenters, rounded to doubles. Corners that rounding has put into the wrong order are
  /// merged, so cells narrower than that may vanish. Files of weights do not get the corners.
  static CellSet voronoi(const Triangulation& triangulation, const Execution& execution = {});
  /// Makes the solid faces into cells in dimension 2; there are none in other dimensions. Files of
  /// weights do not get the corners.
  static CellSet triangles(const Triangulation& triangulation, const Execution& execution = {});
  /// Makes the cells of a grid, whose centers are half way between its lines. With
  /// GridSides::parallels, areas in the overlay are exact areas between parallels and arcs, not
  /// those of polygons near them; such cells have no rings(), and regions.h refuses them.
  /// \throws InvalidInput with the line that is out of order or no longitude or latitude; with
  ///         great circles also with a cell that is 180 degrees wide.
  static CellSet lonlat_grid(const LonLatGrid& grid, GridSides sides = GridSides::parallels,
                             const Execution& execution = {});
  /// Makes the cells of a grid of the whole sphere.
  /// \throws InvalidInput if there is no cell or too many, or as for other grids
  static CellSet lonlat_grid(const GlobalGrid& grid, GridSides sides = GridSides::parallels,
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
  static CellSet polygons(const CellRings& cells, const Execution& execution = {});
  /// Prepares cells whose arcs stand for sides that are straight in longitude and latitude, as
  /// read_polygons() reads them. Overlays with a grid between meridians and parallels have the areas
  /// between these sides, without arcs; overlays with other cells, areas() and centers() have those
  /// between the arcs.
  /// \param sides  a row for each cell, or no rows (CellTable::sides)
  /// \throws InvalidInput as for cells alone, or if the rows do not fit, or (the cell) a side is at no
  ///         longitude and latitude
  static CellSet polygons(const CellRings& cells, CompressedRows<LonLatSide> sides,
                          const Execution& execution = {});
  /// Makes cells that set_operations.h returned, or others whose rings neither cross nor meet along
  /// sides. polygons() makes the same of them, and looks for such faults before, which takes most
  /// of its time for cells of millions of corners.
  /// \throws InvalidInput as polygons() for indices, corners and rings
  static CellSet valid_polygons(const CellRings& cells, const Execution& execution = {});
  /// Prepares the cells of a file, which read_cells() or read_polygons() has read.
  /// \throws FileError with the file's name for cells that polygons() or lonlat_grid() refuses
  static CellSet of(CellTable table, GridSides sides = GridSides::parallels,
                    const Execution& execution = {});
  /// Reads the cells of a file: netCDF in any convention of read_cells(), or polygons, as
  /// can_read_polygons() tells. Of netCDF that names the grid of its points (grid_named_by() of
  /// rondel/named_grids.h), as regrid_file() writes it, they are the cells of that grid, and
  /// facts().name is its name. \throws what of(), read_cells() and read_polygons() throw
  static CellSet read(const FileName& file, const CellFileOptions& options = {},
                      const Execution& execution = {});

  [[nodiscard]] std::size_t num_cells() const;
  /// Returns the area of each cell in steradians, computed from its corners, or that which it has by
  /// definition: of pixels of HEALPix with GridSides::parallels, 4 pi divided by their number. Rounding of
  /// corners makes the areas of polygons uncertain by about 2^-52 times the length of their border.
  /// \throws InvalidInput with the first cell that crosses or overlaps itself
  [[nodiscard]] std::span<const double> areas() const;
  /// Returns the direction of the center of mass of each cell from the center of the sphere; (0, 0,
  /// 0) for an empty cell, and for one that is balanced around the center up to rounding, as the
  /// whole sphere is and a band along the equator. Rounding moves a center by about 2^-53 radians times
  /// the length of the border over the area, which is out of a square with sides below 1e-8 radians.
  /// \throws InvalidInput as areas() does
  [[nodiscard]] std::vector<Point> centers() const;
  /// Returns the cells. Those of voronoi() have no corners in the wrong order.
  [[nodiscard]] CellRings rings() const;
  /// Returns the same as rings(), but rings begin where those of the input did: polygons() of them
  /// has the same areas and centers, bit by bit, which depend on it in the last digit.
  [[nodiscard]] CellRings given_rings() const;
  /// Returns the straight sides that the arcs of cells stand for, as polygons() takes them; no rows if
  /// none are known.
  [[nodiscard]] CompressedRows<LonLatSide> sides() const;
  /// Returns the lines between the cells of a grid, or null for other cells.
  [[nodiscard]] const LonLatGrid* lines() const;
  /// True if the cells are between parallels, so that they have no rings().
  [[nodiscard]] bool has_parallels() const;
  /// True if the cells cover the sphere, each with one ring that is convex or nearly so, and share
  /// their edges; or if they are a grid of parallels that covers the sphere. An overlay in which
  /// one side is a cover, or is any grid of parallels, takes less time (remap.h, regions.h).
  [[nodiscard]] bool covers_sphere() const;

  /// Returns what is known of the cells.
  [[nodiscard]] const CellFacts& facts() const { return *facts_; }
  /// Returns the same cells with other facts.
  /// \throws InvalidInput if an array, or the shape, has not one element for each cell
  [[nodiscard]] CellSet with_facts(CellFacts facts) const;
  /// Returns the same cells, but those that cross or overlap themselves, which areas() refuses, are
  /// repaired: each has the places that an odd number of its sides divides from the outside, as for
  /// repaired() of rondel/set_operations.h. Its corners do not move, and its sides get corners where
  /// they cross; other cells stay bit by bit. facts() say what was wrong, and a remark that cells
  /// were repaired. Cells that overlap each other still do.
  /// \throws InvalidInput with the first cell that repaired() refuses
  [[nodiscard]] CellSet repaired(const Execution& execution = {}) const;
  /// Returns the place of each cell in degrees: the centers of facts(), or else those of its axes,
  /// or else the centers of mass, NaN for an empty cell. \throws InvalidInput as areas() does
  [[nodiscard]] std::vector<LonLat> places() const;
  /// Returns the corners as files of weights have them: the same number for each cell, of which the
  /// last one may be repeated, and (0, 0) for a cell without ring. The result is empty if facts()
  /// say so, or if a cell has several rings or more than 16 corners.
  [[nodiscard]] std::vector<LonLat> corners() const;
  /// Returns the corners as CF has bounds (section 7.1): as corners(), but NaN for a cell without ring,
  /// and with longitudes at most 180 degrees from that of the cell's place.
  /// \throws InvalidInput as places() does
  [[nodiscard]] std::vector<LonLat> bounds() const;

 private:
  friend class overlay::CellSetData;
  explicit CellSet(std::shared_ptr<const overlay::CellSetData> data, CellFacts facts = {});
  std::shared_ptr<const overlay::CellSetData> data_;
  std::shared_ptr<const CellFacts> facts_;
};

}  // namespace rondel
