// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Cells as polygons of arcs with corners of their own, and what is known of them: the form in
/// which files have cells and from which sets of cells (rondel/cell_set.h) are made.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel {

/// Cells in compressed rows. Cell i has the rings `cells[i] ... cells[i+1]-1`; ring r has the
/// corners `corners[rings[r]] ... corners[rings[r+1]-1]`, which are indices into `points`. The
/// first corner of a ring is not repeated at its end.
///
/// 1. Consecutive corners are joined by the shorter arc of a great circle.
/// 2. The interior is to the left: outer rings are counterclockwise seen from outside, holes
///    clockwise. A cell may have several outer rings, and rings may touch in corners.
/// 3. Two cells that share an edge must have the same two indices for its ends; otherwise they are
///    no neighbors.
/// 4. A cell without a ring is the whole sphere if it is in `whole`, and empty otherwise. A ring
///    without corners adds nothing to its cell; what needs cells as CellSet::polygons() does refuses
///    it.
struct CellRings {
  std::vector<std::uint64_t> cells = {0};  ///< one offset more than cells; counts rings
  std::vector<std::uint64_t> rings = {0};  ///< one offset more than rings; counts corners
  std::vector<Index> corners;
  std::vector<Point> points;  ///< unit vectors
  std::vector<Index> whole =
      {};  ///< the cells that are the whole sphere, ascending; they have no rings

  [[nodiscard]] std::size_t num_cells() const { return cells.size() - 1; }
  /// True if a cell is the whole sphere.
  [[nodiscard]] bool is_whole(std::size_t cell) const {
    return std::ranges::binary_search(whole, cell);
  }
  /// Returns the corners of a ring, as indices into `points`.
  [[nodiscard]] std::span<const Index> corners_of(std::uint64_t ring) const {
    return std::span(corners).subspan(rings[ring], rings[ring + 1] - rings[ring]);
  }

  /// Ends a ring, whose corners are those that were appended after the ring before it.
  void end_ring() { rings.push_back(corners.size()); }
  /// Ends a cell, whose rings are those that ended after the cell before it.
  void end_cell() { cells.push_back(rings.size() - 1); }
  /// Appends a ring of some corners, which must not be those of this object.
  void append_ring(std::span<const Index> ring) {
    corners.insert(corners.end(), ring.begin(), ring.end());
    end_ring();
  }
  /// Appends the rings of a cell of others, which have the same points, and does not end the cell.
  void append_rings(const CellRings& others, std::size_t cell) {
    for (std::uint64_t r = others.cells[cell]; r < others.cells[cell + 1]; ++r) {
      append_ring(others.corners_of(r));
    }
  }
  /// Appends a cell of others, which have the same points.
  void append_cell(const CellRings& others, std::size_t cell) {
    if (others.is_whole(cell)) whole.push_back(static_cast<Index>(num_cells()));
    append_rings(others, cell);
    end_cell();
  }
};

/// A side that is straight in longitude and latitude, with its cell to the left.
struct LonLatSide {
  LonLat from;
  LonLat to;
  friend bool operator==(const LonLatSide&, const LonLatSide&) = default;
};

/// A grid in longitude and latitude, given by its lines. Cell `row * (lon_deg.size() - 1) + column`
/// is between the parallels row and row + 1 and the meridians column and column + 1.
struct LonLatGrid {
  std::vector<double> lon_deg;  ///< meridians, ascending or descending, over at most 360 degrees
  std::vector<double> lat_deg;  ///< parallels, ascending or descending
};

/// The axes of a regular grid, in degrees. Its places are all pairs of a longitude and a latitude;
/// place `row * lon_deg.size() + column` has lat_deg[row] and lon_deg[column].
struct LonLatAxes {
  std::vector<double> lon_deg;
  std::vector<double> lat_deg;

  /// Returns all places, latitude by latitude.
  [[nodiscard]] RONDEL_API std::vector<LonLat> places() const;
  /// Returns one of them.
  [[nodiscard]] LonLat place(std::size_t index) const {
    return {lon_deg[index % lon_deg.size()], lat_deg[index / lon_deg.size()]};
  }
};

/// What to do where a file has the centers of cells in two dimensions, and no corners.
enum class MissingCorners : std::uint8_t {
  error,
  made,  ///< they are made from the centers (nodes_between() of rondel/read_cells.h)
};
/// Returns the name of a value: "error", "made"; empty for other numbers.
RONDEL_API std::string_view name_of(MissingCorners corners) noexcept;

/// What is known of cells beside their borders. Any of the arrays may be empty.
struct CellFacts {
  std::string name = {};  ///< the file, for messages
  std::string convention =
      {};  ///< "UGRID", "SCRIP", "ESMF", "MPAS", "ICON", "OASIS", "Exodus" or "CF"
  std::vector<LonLat> centers = {};  ///< one for each cell, as given
  /// How many of `centers` the file lacks, as ocean models do on land: they are the middles of corners.
  std::size_t num_made_centers = 0;
  /// The centers of a grid along lines, if `centers` is empty. Without both, the center of a cell
  /// is its center of mass.
  LonLatAxes axes = {};
  /// Returns the centers, also those of axes; nothing if neither is known.
  [[nodiscard]] std::vector<LonLat> given_centers() const {
    return centers.empty() ? axes.places() : centers;
  }
  std::vector<std::int32_t> mask = {};  ///< 0: the cell takes no part; empty: all cells do
  /// The shape of a grid, whose last dimension changes fastest: nlat, nlon.
  std::vector<std::uint64_t> shape = {};
  std::vector<Column> columns =
      {};  ///< texts and numbers for each cell: the properties of polygons
  /// What was wrong with each cell that was repaired when it was read, and an empty text for the
  /// others; no texts if none was.
  std::vector<std::string> faults = {};
  bool has_corners = true;  ///< whether files of weights get the corners of the cells
  /// Sentences for whoever reads the file: what is masked, left out or without an area, and which
  /// grid of several was read.
  std::vector<std::string> remarks = {};
  /// Whether the file has no corners, and they were made from the centers (MissingCorners::made).
  bool are_corners_made = false;
  /// The lines between the cells of a grid along `axes` that come from bounds in the file; an axis
  /// without bounds has none.
  LonLatGrid given_lines = {};
};

/// The cells of a file. They are in `cells`, or in `grid` if the file has coordinates along axes.
struct CellTable {
  CellRings cells;
  /// The sides that the arcs of `cells` stand for, if these are straight in longitude and latitude: a
  /// row for each cell, or none at all. A row without sides says nothing of its cell. The sides of a
  /// cell are the whole border of its part of the plane, in any order; they run along the poles, and
  /// may be any number of turns of the globe away.
  CompressedRows<LonLatSide> sides;
  std::optional<LonLatGrid> grid;
  CellFacts facts;

  [[nodiscard]] std::size_t num_cells() const {
    return grid ? (grid->lon_deg.size() - 1) * (grid->lat_deg.size() - 1) : cells.num_cells();
  }
};

}  // namespace rondel
