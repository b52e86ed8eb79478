// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Isolines, and filled bands between them, of values at the sites of a triangulation or at the
/// corners of the cells of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Lines of equal value.
struct Isolines {
  std::vector<double> levels;
  /// A group has the lines of a level, a row the points of a line: unit vectors from the center of
  /// the sphere.
  RowGroups<CompressedRows<Point>> lines;
  /// 1 for a line whose last point is joined to its first one
  std::vector<std::uint8_t> is_closed;

  [[nodiscard]] std::size_t num_lines() const noexcept { return is_closed.size(); }
};

/// Regions between levels. Band k has the values from levels[k-1] to below levels[k]; the first
/// band has all values below levels[0], and the last one all values from the last level on.
struct Bands {
  std::vector<double> levels;
  /// A group has the polygons of a band, a group of its `rows` the rings of a polygon, and a row of
  /// their `rows` the points of a ring: unit vectors from the center of the sphere.
  RowGroups<RowGroups<CompressedRows<Point>>> bands;

  [[nodiscard]] std::size_t num_bands() const noexcept { return levels.size() + 1; }
  [[nodiscard]] std::size_t num_polygons() const noexcept { return bands.rows.size(); }
  [[nodiscard]] const CompressedRows<Point>& rings() const noexcept { return bands.rows.rows; }
};

/// Returns the values that count at the vertices: of the sites in one place, the first one that has
/// a value. Others keep their own. isolines() and bands() use these values.
/// \param values  one for each site; NaN is missing
/// \throws InvalidInput if there is not one value for each site
RONDEL_API std::vector<double> first_values(const Triangulation& triangulation,
                                            std::span<const double> values);

/// Computes the isolines of the field that is linear in the plane of each solid face, as in
/// Method::linear:
///
///     f(u) = sum w_i f_i / sum w_i,   u = sum w_i x_i,   x_i the corners' unit vectors
///
/// So f(u) = c where sum w_i (f_i - c) = 0, which is linear in u: a plane through the center.
/// Within a face an isoline is therefore an arc of a great circle, and so it is between consecutive
/// points of a line.
///
/// 1. The isoline of c is the border of the region f >= c, without parts of that region that are no
///    wider than a line, and without the border of the surface. Higher values are to the left.
/// 2. Faces with a corner whose value is missing (NaN) are left out, and so are ghost faces, and faces
///    on the border that are flat by rounding, as between sites of a meridian: lines would run along
///    the border in these. A line that meets a face that is left out, or the border of the solid faces,
///    ends there: it is open.
/// 3. No line visits a point twice. Lines meet at most in sites whose value is the level.
/// 4. A point on an edge is computed from the edge's ends alone, the end with the lower value
///    first. A site whose value is the level has its unit vector as a point.
/// 5. The bytes depend on the values and the places of the sites, not on their order, nor on the
///    number of threads. If several sites are in one place, the value of the lowest index that has
///    one counts. (For a Triangulation::from_arrays() the order of faces decides the order of
///    lines, and where a closed line begins.)
///
/// The expected time is O(n log k + length of the result) for k levels. Below dimension 2 there are
/// no lines.
/// \param values  one for each site; NaN is missing
/// \param levels  ascending
/// \throws InvalidInput if there is not one value for each site, a value is infinite (its index),
///         the levels are not finite and ascending (the first bad one), or the sites are weighted.
RONDEL_API Isolines isolines(const Triangulation& triangulation, std::span<const double> values,
                             std::span<const double> levels, const Execution& execution = {});

/// Computes the bands between the levels, of the same field, as polygons whose inside is to the
/// left of their rings.
///
/// 1. The inside of a polygon is connected. Rings are simple, and two rings meet at most in points.
///    The polygons of a band do not overlap.
/// 2. The bands together are the solid faces that isolines() has lines in. Where two bands meet, both
///    have the same points, byte by byte, which are those of the isolines.
/// 3. A polygon without rings is the whole sphere.
/// 4. A face with three equal values belongs to the band of this value.
/// \throws InvalidInput as isolines().
RONDEL_API Bands bands(const Triangulation& triangulation, std::span<const double> values,
                       std::span<const double> levels, const Execution& execution = {});

/// Computes the isolines in the cells of a mesh, in place of the faces of a triangulation: no line
/// crosses a strait or an island.
///
/// 1. In a triangle the field is that of isolines() above. Every other cell is divided into triangles
///    from the middle of its corners, which has the value that native_weights() gives there. So on
///    the sides of cells, lines are where that interpolation has the level.
/// 2. Cells with a corner whose value is missing (NaN), without rings or without an area are left
///    out. Of points in one place the first one that has a value counts.
/// 3. Otherwise 1 to 5 of isolines() hold. The order of the cells decides the order of lines, and
///    where a closed line begins.
///
/// \param cells  a ring each or none, in either direction, and a unit vector for each value; such as
///               those of read_native_cells()
/// \throws InvalidInput as isolines() above, and if the arrays do not fit; if a cell (its index) has
///         several rings, is as wide as a hemisphere or is not seen whole from its middle; or if cells
///         overlap by more than rounding of their corners
RONDEL_API Isolines isolines(const CellRings& cells, std::span<const double> values,
                             std::span<const double> levels, const Execution& execution = {});

/// Computes the bands of the same field; 1, 2 and 4 of bands() above hold. If no cell has a border and
/// one band covers the sphere, its polygon has no rings.
/// \throws InvalidInput as isolines() of cells
RONDEL_API Bands bands(const CellRings& cells, std::span<const double> values,
                       std::span<const double> levels, const Execution& execution = {});

/// Writes isolines, one feature for each level: a MultiLineString with the property `level`, cut at
/// the antimeridian and the poles, with higher values to the left. The geometry of a level without
/// lines is null.
/// \param file  .geojson (RFC 7946)
/// \param tolerance_deg  how far drawn lines may leave the arcs, degrees, as for write_cells()
/// \throws InvalidInput if the arrays do not fit together, or the tolerance is not positive
/// \throws FileError if the file cannot be written, or has another ending
RONDEL_API void write_isolines(const FileName& file, const Isolines& isolines,
                               double tolerance_deg = 0.01, const Execution& execution = {});

/// Writes bands, one feature each: a MultiPolygon with the properties `low` and `high`, which are
/// null for an open end. The polygons are valid in the sense of OGC simple features, and where two
/// bands meet both have the same positions, bit by bit. Parts that are no wider than rounding have
/// no polygon; no band is refused for its form.
/// \throws as write_isolines().
RONDEL_API void write_bands(const FileName& file, const Bands& bands, double tolerance_deg = 0.01,
                            const Execution& execution = {});

}  // namespace rondel
