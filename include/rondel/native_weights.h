// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Interpolation in the cells that a mesh has itself, in place of a triangulation of its points
/// (target rondel::geo).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// Computes weights that interpolate values at the corners of cells inside of these: spherical
/// barycentric coordinates. u is the unit vector of a target, x_i are those of the corners of its
/// cell, w_i its weights.
///
/// 1. In a triangle they are those of Method::linear. In a convex cell they are Wachspress's
///    (Wachspress 1975), whose quotients of determinants are the same in every gnomonic plane; in
///    other cells, and where a corner turns by less than a thousandth (hanging nodes), they are mean
///    value coordinates (Floater 2003; Langer, Belyaev, Seidel, SGP 2006, for the sphere).
/// 2. The sum of w is 1, and the sum of w_i x_i is r u with r <= 1, both up to 1e-14: constants are
///    reproduced, and a + g.x as a + r g.u. In convex cells no weight is negative.
/// 3. At a corner the row has one weight, 1. On a side it has those of its two ends, the same bits
///    from either cell; so values are continuous, and smooth within cells.
/// 4. Which cell has a target, or which side or corner, is decided exactly. Of several cells, as
///    where cells overlap, the one with the lowest index counts. A target in no cell has no row, but
///    if it is within 2^-50 radians of a side or corner it is taken for one there: on the border of
///    all cells coordinates are rounded to either side.
/// 5. Cells without rings take no part. Where a cell crosses itself, a target has the cell if the
///    ring winds around it, and no row if its weights have no positive sum.
/// 6. The bytes depend on the places of corners and targets, and on the order of the cells only
///    where these overlap. Entries of a row are in the order of their places' coordinates.
///
/// \param cells  a ring each, in either direction, and a unit vector for each value, which are the
///               columns; points may be corners of several cells or of none
/// \throws InvalidInput if the arrays do not fit, a cell has several rings or is as wide as a
///         hemisphere (with the cell), or a target is not finite or the center of the sphere
RONDEL_API Weights native_weights(const CellRings& cells, std::span<const Point> targets,
                                  const Execution& execution = {});

/// Returns the cells of the dual mesh, whose corners are the centers of cells: one for each point
/// that is surrounded by cells, in the order of the points, through the centers of these cells. At
/// the border there are none, so values do not reach beyond the outermost centers.
/// \param cells  a ring each or none, in either direction
/// \param centers  unit vectors, one for each cell
/// \throws InvalidInput if the arrays do not fit
RONDEL_API CellRings dual_cells(const CellRings& cells, std::span<const Point> centers);

/// The cells in which values of a file are interpolated.
struct NativeCells {
  CellRings cells;  ///< with one point for each place of the values
  std::vector<std::string> remarks = {};
};

/// Reads the cells of a mesh whose corners are the given places: the faces, if these are the nodes
/// (UGRID, MPAS, ICON, ESMF, Exodus), or the cells of the dual mesh, if they are the centers of the
/// faces. In MPAS the dual cells are the triangles of `cellsOnVertex`. Cells that are masked, or
/// that have a missing corner or several rings, are left out with a remark.
/// \param file  netCDF with a mesh; `FILE.nc:NAME` names a variable or a topology
/// \param places  in degrees, those of the values, in the file's order; nodes without a place are
///                not among them
/// \throws FileError if the file has no mesh with common nodes, the places are others, such as the
///         middles of its edges, or a face crosses itself (with the face and a place)
RONDEL_API NativeCells read_native_cells(const FileName& file, std::span<const LonLat> places);

}  // namespace rondel
