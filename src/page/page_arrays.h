// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arrays of numbers that a page contains.
//
// in    sites with their columns, the triangulation, its diagram, the options of the page
// out   named arrays of bytes, as viewer/src/decode.js reads them
// index sites (n), faces (m) and points of the diagram (k), each from 0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/globe.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"

namespace rondel::page {

// An array that viewer/src/decode.js finds by its name.
struct PageArray {
  std::string name;
  std::string kind;    // the type of a number: f64, u32 or u8
  std::string bytes;   // little-endian
  std::size_t length;  // how many numbers it has
};

// Returns the unit vector from the center of the sphere to each site; (0, 0, 0) for a site at the
// center.
std::vector<Point> site_directions(const Triangulation& triangulation);

// Returns the arrays of a page:
//
// directions   3 n, f64: unit vectors lengths      n, f64: distances from the center in radii of
// the sphere; weighted sites only radii        n, f64: radii of the sites' circles in radians, 0
// for a site without one; weighted sites only faces        3 m, u32: the corners of each face
// ghosts, duplicates and hidden (pairs), ring (below dimension 2): u32 points       3 k, f64: the
// points of the diagram. The first m are the circumcenters; they are stored as the
//              bits in which they differ from what the page computes in doubles, most of which are zero
// ringOffsets, ringPoints   u32: the rings of the cells, unless they are just the faces around each
// site areas        n, f64: steradians values       n, f64; only if there are values isolines     3
// k, f64: the points of the isolines, and isolineEnds  u32: the place after the last point of each
// isoline; only if there are isolines
std::vector<PageArray> page_arrays(const SiteTable& table, const Triangulation& triangulation,
                                   const Diagram& diagram, const GlobeOptions& options,
                                   const std::vector<Point>& directions);

// Returns two arrays for each column i of the table: column<i> (u8) has the text of all cells, and
// column<i>Lengths (u32) the length of each cell in bytes.
std::vector<PageArray> column_arrays(const SiteTable& table);

}  // namespace rondel::page
