// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Finds which arcs a figure shows, each once.
///
/// in    a triangulation or its cells
/// out   arcs, each the shorter one between its two ends, and the points to which they refer
/// index sites, or points of the cells; after in_order_of_arcs() points in the order of their use
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/triangulation.h"

namespace rondel::cli {

/// Two positions in an array of unit vectors, joined by the shorter arc.
using ArcEnds = std::array<Index, 2>;

/// Returns the edges of the solid faces, as pairs of sites. Edges between ghost faces only are left
/// out, since they are not seen from the center. Below dimension 2 it returns the arcs between
/// consecutive sites, except across a gap of 180 degrees or more. `directions` are the sites' unit
/// vectors.
std::vector<ArcEnds> triangulation_arcs(const Triangulation& triangulation,
                                        std::span<const Point> directions);

/// Returns the edges of the cells, as positions in cells.points; edges of length zero are left out.
std::vector<ArcEnds> cell_arcs(const Cells& cells);

/// Renumbers the points in the order in which the arcs use them, so that loops over arcs read
/// memory from front to back. \returns the points that have an arc, in that order
std::vector<Point> in_order_of_arcs(std::span<ArcEnds> arcs, std::span<const Point> points);

/// Returns the median over the sites in front of the distance in the picture to the nearest site; 0
/// if there is no arc. \pre the points are in the view frame, and the arcs are those of a
/// triangulation of them
double median_spacing(std::span<const ArcEnds> arcs, std::span<const Point> points);

}  // namespace rondel::cli
