// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids whose cells are computed one by one, so that a grid may have more of them than memory.
//
// in    a cell
// out   its center, and its corners, joined by arcs of great circles
// index cells, in the order that models have
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/cell_set.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::grids {

// The cells of a grid: none overlaps another, and each is convex or nearly so unless it is stored.
// Several threads may use one.
class GridFormula {
 public:
  GridFormula() = default;
  virtual ~GridFormula() = default;
  GridFormula(const GridFormula&) = delete;
  GridFormula& operator=(const GridFormula&) = delete;

  [[nodiscard]] virtual Index num_cells() const = 0;
  [[nodiscard]] virtual LonLat center(Index cell) const = 0;
  // Appends the corners of a cell, counterclockwise. Cells that share a corner get it bit by bit.
  virtual void append_ring(Index cell, std::vector<Point>& ring) const = 0;
  // Returns cells that are in memory, which may have several rings, or null. Then append_ring()
  // appends the corners of all of them.
  [[nodiscard]] virtual const CellRings* stored() const { return nullptr; }
  // Returns the straight sides of stored cells, which may have no rows, or null.
  [[nodiscard]] virtual const CompressedRows<LonLatSide>* stored_sides() const { return nullptr; }
  // Returns the area of a stored cell in steradians, and otherwise 0.
  [[nodiscard]] virtual double area(Index /*cell*/) const { return 0; }
  // Returns the area that each cell has by definition, in steradians, or 0 if there is no such area.
  [[nodiscard]] virtual double equal_area() const { return 0; }
  // False if the cells leave a part of the sphere out.
  [[nodiscard]] virtual bool covers_sphere() const { return true; }
  // Returns the lengths of the dimensions of an array of the cells; the last one varies fastest.
  [[nodiscard]] virtual std::vector<std::uint64_t> shape() const { return {num_cells()}; }
};

// Returns HEALPix (Gorski et al., Astrophys. J. 622, 2005) with 2^order pixels along the sides of
// its 12 base pixels. Borders of pixels are curves; here each is a chain of arcs, with every other
// corner moved so that the area on both sides is that of the curve. With GridSides::great_circles
// it is one arc, which changes the areas. Precondition: order <= 13.
std::unique_ptr<GridFormula> healpix_grid(unsigned order, bool is_in_rings, GridSides sides);

// Returns ECMWF's reduced Gaussian grids: rows between parallels half way between Gaussian
// latitudes, from north to south, each divided into equal cells of which the first is centered at
// the meridian 0. On a parallel, the corners of both rows are joined by arcs.
// `counts` are the numbers of cells of all rows.
std::unique_ptr<GridFormula> reduced_gaussian_grid(std::vector<Index> counts);
// Returns the numbers of cells of the rows of N`number`, as ECMWF has published them, or nothing if
// there is no such grid.
std::vector<Index> counts_of_reduced(unsigned number);
// Returns the numbers for which counts_of_reduced() has a grid, as words of a list.
std::string numbers_of_reduced();

// Returns the cubed sphere with side^2 cells on each of its six faces: rows and columns are great
// circles at equal angles.
std::unique_ptr<GridFormula> cubed_sphere_grid(unsigned side);

// Returns the triangles of an icosahedron of which each side is divided into `root` parts, and then
// `bisections` times into halves, as ICON's grid R`root`B`bisections` before its points are moved.
// The triangles within one of the division before are consecutive: the middle one comes first.
std::unique_ptr<GridFormula> triangle_grid(unsigned root, unsigned bisections);

// Returns the cells around the corners of triangle_grid(): 12 pentagons, then hexagons along the
// edges of the icosahedron, then those inside of its faces. Their corners are the circumcenters of
// the triangles.
std::unique_ptr<GridFormula> hexagon_grid(unsigned root, unsigned bisections);

// Returns a tripolar grid of the ocean (Murray 1996) with `columns` cells around the globe, a multiple
// of 4 that is at least 12: rows at Mercator's latitudes from the south, and a bipolar cap around the
// north pole. The Antarctic south of the first row is in no cell.
std::unique_ptr<GridFormula> tripolar_grid(unsigned columns);

}  // namespace rondel::grids
