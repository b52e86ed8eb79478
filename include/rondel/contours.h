// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Isolines and filled bands of values at the sites of a triangulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {

/// Lines of equal value. Line i has the points line_offsets[i] ... line_offsets[i+1]-1; those of
/// levels[k] are the lines level_offsets[k] ... level_offsets[k+1]-1.
struct Isolines {
  std::vector<double> levels;
  std::vector<std::uint64_t> level_offsets = {0};  ///< number of levels + 1
  std::vector<std::uint64_t> line_offsets = {0};   ///< number of lines + 1
  std::vector<std::uint8_t> is_closed;  ///< of each line: the last point leads to the first
  std::vector<Point> points;            ///< unit vectors from the center of the sphere

  [[nodiscard]] std::size_t num_lines() const noexcept { return is_closed.size(); }
};

/// Regions between levels. Band k has the values from levels[k-1] to below levels[k], the first all
/// below, the last all from the last level on. It consists of the polygons band_offsets[k] ...
/// band_offsets[k+1]-1; polygon i has the rings polygon_offsets[i] ... polygon_offsets[i+1]-1, and ring j
/// the points ring_offsets[j] ... ring_offsets[j+1]-1.
struct Bands {
  std::vector<double> levels;
  std::vector<std::uint64_t> band_offsets = {0};     ///< number of levels + 2
  std::vector<std::uint64_t> polygon_offsets = {0};  ///< number of polygons + 1
  std::vector<std::uint64_t> ring_offsets = {0};     ///< number of rings + 1
  std::vector<Point> points;                         ///< unit vectors from the center of the sphere

  [[nodiscard]] std::size_t num_bands() const noexcept { return levels.size() + 1; }
  [[nodiscard]] std::size_t num_polygons() const noexcept { return polygon_offsets.size() - 1; }
};

/// The isolines of the field that is linear in the plane of each solid face, as Method::linear has it:
///
///     f(u) = sum w_i f_i / sum w_i,   u = sum w_i x_i,   x_i the corners' unit vectors
///
/// so f(u) = c where sum w_i (f_i - c) = 0, which is linear in u: a plane through the center. Within a
/// face an isoline is an arc of a great circle, and so it is between consecutive points of a line.
///
/// 1. An isoline of c is the border of the region f >= c, without what is no wider than a line, and
///    without the border of the surface. Higher values are to the left.
/// 2. A face with a corner whose value is missing (NaN) is left out, and so are ghost faces. A line
///    that meets what is left out, or the border of the solid faces, ends there: it is open.
/// 3. No line visits a point twice. Lines meet at most in sites whose value is the level.
/// 4. A point on an edge is computed from the edge's ends alone, the lower value first; a site
///    whose value is the level is that site's unit vector.
/// 5. The bytes depend on the values and the places of the sites, not on the order of these, nor on the number
///    of threads. Of sites in one place the lowest index has the value that counts. (Arrays from
///    elsewhere, Triangulation::from_arrays(): the order of the faces is that of the lines, and tells
///    where a closed line begins.)
///
/// Expected time: O(n log k + length of the answer) for k levels. Below dimension 2 there are no lines.
/// \throws InvalidInput if there is not one value a site, a value is infinite (its index), the levels
///         are not finite and increasing (the first bad one), or the sites are weighted.
RONDEL_API Isolines isolines(const Triangulation& triangulation, std::span<const double> values,
                             std::span<const double> levels, const Execution& execution = {});

/// The bands between the levels, of the same field: polygons whose inside is to the left of all their
/// rings.
///
/// 1. A polygon's inside is connected, its rings are simple and meet at most in points. A band's
///    polygons do not overlap.
/// 2. The bands together are the solid faces without missing values: where two of them meet, both
///    have the same points, byte by byte, which are those of the isolines.
/// 3. A polygon without rings is the whole sphere.
/// 4. A face with three equal values belongs to the band of this value.
/// \throws InvalidInput as isolines().
RONDEL_API Bands bands(const Triangulation& triangulation, std::span<const double> values,
                       std::span<const double> levels, const Execution& execution = {});

/// Writes a feature a level: a MultiLineString with the property `level`, cut at the antimeridian and
/// the poles; higher values are to the left. Without lines its geometry is null. The file is
/// .geojson (RFC 7946), arcs are densified as write_cells() does it.
/// \throws InvalidInput if the arrays do not fit together, or the tolerance is not positive; FileError if the file cannot be
///         written, or has another ending
RONDEL_API void write_isolines(const FileName& file, const Isolines& isolines,
                               double tolerance_deg = 0.01, const Execution& execution = {});

/// Writes a feature a band: a MultiPolygon with the properties `low` and `high`, null for the open
/// ends. The polygons are valid as simple features have it, and where two bands meet both have the same positions, bit by
/// bit; what is no wider than rounding has no polygon, and no band is refused for its form.
/// \throws InvalidInput as write_isolines().
RONDEL_API void write_bands(const FileName& file, const Bands& bands, double tolerance_deg = 0.01,
                            const Execution& execution = {});

}  // namespace rondel
