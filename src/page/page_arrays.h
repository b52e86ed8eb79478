// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The numbers that a page carries.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/globe.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"

namespace rondel::page {

// An array that viewer/src/decode.js knows by its name.
struct PageArray {
  std::string name;
  std::string kind;    // f64, u32 or u8
  std::string bytes;   // little-endian
  std::size_t length;  // numbers
};

// The directions of the sites from the center of the sphere; (0, 0, 0) of the center.
std::vector<Point> site_directions(const Triangulation& triangulation);

// directions   3 n, f64: unit vectors
// lengths      n, f64: distances from the center in radii (weighted)
// radii        n, f64: radii of the sites' circles in radians, 0 of none (weighted)
// faces        3 m, u32;  ghosts, duplicates and hidden (pairs), ring (below dimension 2), all u32
// points       3 k, f64: the points of the diagram. Of the first m, the circumcenters, the bits are those in which
//              they differ from what the page computes in plain doubles: mostly zeros.
// ringOffsets, ringPoints   u32, the rings of the cells, unless they are just the faces around each site
// areas        n, f64;  values  n, f64, if there are any
// isolines     3 k, f64, their points;  isolineEnds, u32, where each ends; if there are any
std::vector<PageArray> page_arrays(const SiteTable& table, const Triangulation& triangulation,
                                   const Diagram& diagram, const GlobeOptions& options,
                                   const std::vector<Point>& directions);

// column<i> (u8, the text of all cells) and column<i>Lengths (u32) of each column of the table.
std::vector<PageArray> column_arrays(const SiteTable& table);

}  // namespace rondel::page
