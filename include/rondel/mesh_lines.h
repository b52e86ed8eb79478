// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Sites along lines, so that edges of cells follow the lines (coasts, borders of regions, rivers),
/// and sites on lines (target rondel::geo).
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

/// Sites beside lines or on them, for ScvtOptions::fixed.
struct LineSites {
  std::vector<Point> sites;  ///< unit vectors
  /// The number of places left out because they are too near to another line, or another part of
  /// the same one.
  std::size_t num_left_out = 0;
};

/// Places two rows of sites along each line. The sites of a row are a spacing apart; the rows are
/// sqrt(3)/2 of it apart and shifted by half a spacing against each other. With the sites of
/// regular hexagons, the edges between the rows zigzag across the line; their corners are 0.144
/// spacings away from it, a little more where it bends.
///
/// 1. A line is given by points joined by arcs of great circles. If the last point is within 1e-10
///    of the first one, the line is closed, and the steps are stretched or shortened to fit.
/// 2. Details of a line within half a spacing are ignored. Closed lines of less than six steps of
///    half a spacing are left out.
/// 3. Places nearer than 0.7 spacings to a place of a longer line, or to an earlier one of the same
///    line, are left out, and so are those that another part of a line passes at less than 0.3
///    spacings. So where a line turns sharply, or two lines are close, edges do not follow it.
/// \throws InvalidInput (index of the line) if a point is not finite or is the center, neighbors in
///         a line are antipodes, or there would be more than max_sites sites.
RONDEL_API LineSites sites_along(std::span<const std::vector<Point>> lines,
                                 const SizeFunction& size, const Execution& execution = {});

/// Places sites on lines, a spacing apart, so that the middles of cells are on a section, a border
/// or the track of a ship.
///
/// 1. A line is given as for sites_along(). Its first point is a site, and if it is not closed its
///    last one is; the steps between are stretched or shortened to fit. Details of a line within a
///    spacing are ignored.
/// 2. A line of one point, or of points whose directions are within 1e-10 of that of the first one,
///    is a site there in any case, wherever others are. Two such lines in one place are two sites,
///    which ScvtOptions::fixed refuses.
/// 3. Places on lines are left out if they are nearer than 0.7 spacings to such a point, to a place
///    of a longer line, or to an earlier place of the same line.
/// \throws InvalidInput as sites_along() does.
RONDEL_API LineSites sites_on(std::span<const std::vector<Point>> lines, const SizeFunction& size,
                              const Execution& execution = {});

/// Reads the lines of a GeoJSON file, and the outlines of its polygons as closed lines, as
/// read_features() does. They consist of arcs that are as near to the line between two positions as
/// the options say.
///
/// Sides along which the file has cut a polygon at the antimeridian, or has led it around a pole,
/// are not part of outlines: those with a polygon of the file, or a closed line, on both sides of
/// longitude 180. The outlines continue across it.
/// \throws FileError with one line that names the file.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API std::vector<std::vector<Point>> read_lines(const FileName& file,
                                                      const PolygonOptions& options = {},
                                                      const Execution& execution = {});

/// Reads the lines of read_lines() and the points of the file, each as a line of one point. From
/// files of other formats than GeoJSON it reads the sites (read_sites(), read_netcdf_sites()).
/// \throws FileError with one line that names the file, also if the file has neither lines nor
///         points.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API std::vector<std::vector<Point>> read_places(const FileName& file,
                                                       const PolygonOptions& options = {},
                                                       const Execution& execution = {});

}  // namespace rondel::mesh
