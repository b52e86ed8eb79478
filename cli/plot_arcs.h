// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Which arcs a figure shows, each once.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rondel/diagram.h"
#include "rondel/triangulation.h"

namespace rondel::cli {

/// Two positions in an array of unit vectors, joined by the shorter arc.
using ArcEnds = std::array<Index, 2>;

/// The edges of the solid faces, as sites. An edge between ghost faces only is not seen from the
/// center. Below dimension 2: the arcs between consecutive sites, except across a gap of
/// 180 degrees or more. `directions` are the sites' unit vectors.
std::vector<ArcEnds> triangulation_arcs(const Triangulation& triangulation,
                                        std::span<const Point> directions);

/// The edges of the cells, as positions in cells.points; none of length zero.
std::vector<ArcEnds> cell_arcs(const Cells& cells);

/// Numbers the points in the order in which arcs come to them, which is that of space for the arcs of a
/// triangulation: loops over arcs then read memory from front to back. \returns the points that have
/// an arc.
std::vector<Point> in_order_of_arcs(std::span<ArcEnds> arcs, std::span<const Point> points);

/// The distance from a site to the nearest one, the median over the sites that are in front: its
/// length in the picture. 0 if no arc is there. \pre points in the view frame, the arcs of
/// a triangulation of them.
double median_spacing(std::span<const ArcEnds> arcs, std::span<const Point> points);

}  // namespace rondel::cli
