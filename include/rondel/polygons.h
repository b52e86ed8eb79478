// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Cells and faces as polygons of longitude and latitude (target rondel::geo), for programs that
/// draw or store maps: the polygons of the GeoJSON that write_cells() and write_triangles() write.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/diagram.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Polygons in compressed rows. Each is one ring, counterclockwise, whose last position equals its
/// first, within [-180, 180] x [-90, 90]. A region that the antimeridian cuts has several polygons.
struct LonLatPolygons {
  CompressedRows<LonLat> rings;  ///< the positions of each ring
  std::vector<Index> owners;     ///< the site or face of each ring, never decreasing
};

/// Computes the polygons of the cells of a diagram, by site. Arcs are densified as by
/// write_cells(). A cell no wider than rounding has no polygon.
/// \throws InvalidInput if the diagram cannot be that of the triangulation, or the tolerance is not
///         positive.
RONDEL_API LonLatPolygons cell_polygons(const Triangulation& triangulation, const Diagram& diagram,
                                        double tolerance_deg = 0.01,
                                        const Execution& execution = {});

/// Computes lines along arcs of great circles, cut at the antimeridian: each row is a line, and an
/// arc has one or more.
/// \param ends  unit vectors: the two ends of each arc. Opposite ends have no line.
/// \param tolerance_deg  how far lines may leave the arcs, degrees
/// \throws InvalidInput if the tolerance is not positive
RONDEL_API CompressedRows<LonLat> arc_lines(std::span<const std::array<Point, 2>> ends,
                                            double tolerance_deg = 0.01);

/// Computes the polygons of the solid faces, as write_triangles() writes them. A face no wider than
/// rounding has no polygon.
RONDEL_API LonLatPolygons face_polygons(const Triangulation& triangulation,
                                        const Execution& execution = {});

}  // namespace rondel
