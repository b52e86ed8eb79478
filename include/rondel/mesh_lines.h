// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sites along lines, so that edges of cells follow them (coasts, borders of regions, rivers), and on lines (target rondel::mesh).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/mesh_size.h"
#include "rondel/polygon_files.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// Places beside lines or on them, for ScvtOptions::fixed.
struct LineSites {
  std::vector<Point> sites;      ///< unit vectors
  std::size_t num_left_out = 0;  ///< places too near to another line, or another part of their own
};

/// Two rows of sites along each line, a spacing apart in a row, the rows half a spacing out of step and sqrt(3)/2 of it
/// apart: with the sites of regular hexagons the edges between the rows go to and fro across the line. Their corners are
/// 0.144 spacings away from it, a little more where it bends.
///
/// 1. A line is given by points joined by arcs of great circles. If the last is the first, or within 1e-10 of it, it is
///    closed, and the steps are stretched or shortened to fit.
/// 2. What a line does within half a spacing is passed over. Closed lines of less than six steps of half a spacing are left out.
/// 3. Places nearer than 0.7 spacings to one of a longer line, or of the same line before, are left out, and those that
///    another part of a line passes by at less than 0.3: where a line turns sharply, or two are close, edges do not follow it.
/// \throws InvalidInput (index of the line) if a point is not finite or the center, neighbors in a line are antipodes, or there
///         would be more than max_sites.
RONDEL_API LineSites sites_along(std::span<const std::vector<Point>> lines,
                                 const SizeFunction& size, const Execution& execution = {});

/// Sites on lines, a spacing apart: cells whose middles are on a section, a border or the track of a ship.
///
/// 1. A line is given as to sites_along(). Its first point is a site, and if it is not closed its last one; the steps between
///    are stretched or shortened to fit. What a line does within a spacing is passed over.
/// 2. A line of one point, or of points in one place, is a site as it is, wherever others are.
/// 3. Places of lines nearer than 0.7 spacings to such a point, to a place of a longer line, or of the same line before, are
///    left out.
/// \throws InvalidInput as sites_along() does.
RONDEL_API LineSites sites_on(std::span<const std::vector<Point>> lines, const SizeFunction& size,
                              const Execution& execution = {});

/// The lines of a GeoJSON file, and the outlines of its polygons, which are closed, as read_features() reads them: in arcs
/// that are as near to what joins two positions as the options say.
///
/// Sides along which the file has cut a polygon at the antimeridian, or has led it around a pole, are no outlines: those
/// where there is a polygon of the file, or a closed line, on both sides of longitude 180. The outlines go on across it.
/// \throws FileError with one line that names the file.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API std::vector<std::vector<Point>> read_lines(const FileName& file,
                                                      const PolygonOptions& options = {},
                                                      const Execution& execution = {});

/// The lines of read_lines() and the points of the file, each of which is a line of one point. Files of other formats than GeoJSON
/// have the points of their sites (read_sites(), read_netcdf_sites()).
/// \throws FileError with one line that names the file, also if nothing is in it.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API std::vector<std::vector<Point>> read_places(const FileName& file,
                                                       const PolygonOptions& options = {},
                                                       const Execution& execution = {});

}  // namespace rondel::mesh
