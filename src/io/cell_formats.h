// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writers of Voronoi cells, one function a format.
//
// in    sites, their triangulation and its Voronoi diagram
// out   a file
// index sites, which are the cells
#pragma once

#include "io/atomic_file.h"
#include "rondel/io.h"

namespace rondel::io {

// The arguments of write_cells().
struct CellsToWrite {
  const SiteTable& table;
  const Triangulation& triangulation;
  const Diagram& diagram;
  double tolerance_deg;
  const Execution& execution;
};

// Throws InvalidInput if the arrays of the diagram, which callers may have filled, do not belong to
// the triangulation or have offsets or indices out of range.
void require_diagram(const Triangulation& triangulation, const Diagram& diagram);

// Throws InvalidInput (the first other site) if the sites of the table are not those of the
// triangulation.
void require_sites(const SiteTable& table, const Triangulation& triangulation);

// Returns the tolerance in degrees, at least min_tolerance_deg. Throws InvalidInput unless it is
// positive.
double checked_tolerance(double tolerance_deg);

// Writes a FeatureCollection with a feature for each cell, in the order of the sites. Its
// properties are `site`, `area` in steradians, and the columns of the input; a name that is taken
// (by one of these two, or by a column before it) gets underscores at its end until it is not.
// Numbers stay as they are written in the input, other text becomes a string, an empty cell null.
// Coordinates have the shortest digits that give back the same double, so that cells of any size
// stay valid. A cell no wider than rounding has the geometry null. Hidden sites have no cell and no
// feature: the collection's member "hidden" lists each with the three sites of a face below which
// it lies.
void write_cells_geojson(AtomicFile& file, const CellsToWrite& cells);

// Writes polygons on the unit sphere, whose corners are the diagram's points, with the cell data
// `site` and `area`. A cell that is the whole sphere has no polygon.
void write_cells_vtp(AtomicFile& file, const CellsToWrite& to_write);

// Writes six arrays: offsets (n + 1, u8), rings (u4), points (k, 3; f8), areas (n, f8), faces (m,
// 3; u4), whose circumcenters are the first m points, and hidden (h, 2; u4): a site and a face
// above it.
void write_cells_npz(AtomicFile& file, const CellsToWrite& to_write);

}  // namespace rondel::io
