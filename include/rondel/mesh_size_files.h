// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading the spacings of a mesh, and heights at its nodes. Every function throws FileError with one
/// line that names the file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/mesh_size.h"
#include "rondel/polygon_files.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// Reads the points for SizeFunction::refined(): those of read_places(), closer than `distance`
/// radians along lines.
/// \param region  the region of the spacings. Lines outside of it have points that are at most a
///                quarter of their distance from it apart, if that is more: in the region this adds
///                at most 1 % to the distance of a line
/// \throws InvalidInput if the distance or the tolerance of the options is not positive, or the region
///         is not as described.
RONDEL_API std::vector<Point> read_refinement(const FileName& file, double distance,
                                              const PolygonOptions& options = {},
                                              const Execution& execution = {},
                                              const std::optional<SizeRegion>& region = {});

/// What a mesh asks of the spacings of a file.
struct SpacingsWanted {
  /// While the raster has another spacing than a place of the file by more than a fifth, its steps are
  /// doubled up to this number, and then a remark says how many places there are; 0: the steps stay.
  /// On a region places outside do not count, and the steps begin with the distance of places where
  /// these are closest, if that is shorter.
  std::size_t most_steps = 0;
  /// Corners of the polygons in which the mesh is; empty: it is on the whole sphere. A remark says if
  /// the places of the file do not surround them.
  std::span<const Point> corners = {};
};

/// Reads spacings at places. They are interpolated linearly on the triangulation of the places, those
/// at the nodes of triangles of UGRID (is_ugrid_of_triangles()) in these triangles; and are those of
/// the nearest place outside. Where triangles of the mesh overlap they do not count, and a remark says so.
/// \param file  .nc with longitudes and latitudes of a grid or of points, or with the cells of an
///              MPAS mesh; a table .csv .tsv; or points, .geojson and what GDAL reads
/// \param name  the variable, column or property; empty: the only variable
/// \param unit  what a value is multiplied by to get radians. If the attribute `units` says meters,
///              values are also divided by 1000; units other than meters and kilometers are refused
/// \param[out] remarks  gets sentences on what the file has and the spacings have not: places without
///              a value, places that another one with another value repeats, of which the first
///              one counts, and parts of the sphere without places; null: nobody is told
RONDEL_API SizeFunction read_spacings(const FileName& file, const std::string& name, double unit,
                                      const SizeRaster& raster = SizeFunction::usual_steps,
                                      const Execution& execution = {},
                                      std::vector<std::string>* remarks = nullptr,
                                      const SpacingsWanted& wanted = {});

/// Reads densities of a tessellation as read_spacings() reads spacings, and returns spacings: their
/// power -1/4, the largest 1. Only the proportions count. For an MPAS mesh, "meshDensity" are the
/// densities of its cells.
RONDEL_API SizeFunction read_density(const FileName& file, const std::string& name,
                                     const SizeRaster& raster = SizeFunction::usual_steps,
                                     const Execution& execution = {},
                                     std::vector<std::string>* remarks = nullptr,
                                     const SpacingsWanted& wanted = {});

/// The direction in which the numbers of heights, or depths, grow (CF's attribute `positive`).
enum class Positive : std::uint8_t { up, down };

/// Reads heights or depths as read_spacings() reads spacings, or the depths of a mesh of triangles
/// (is_triangle_mesh_file()), and interpolates them linearly at nodes: in the triangles of a mesh, and
/// else on the triangulation of their places. A node within 2^-50 radians of one of a mesh has exactly
/// its depth, and one within 2^-46 of the border of a mesh is on it. Outside of the triangles the
/// value of the nearest place counts, and a remark says how many nodes are there.
/// \param positive  up for heights, down for depths. Where the attribute `positive`, or else the
///                  `standard_name`, says otherwise, the file is refused
/// \param nodes  unit vectors
/// \return metres, positive as in the file. Values are metres, unless the attribute `units` says
///         kilometers; other units are refused.
RONDEL_API std::vector<double> read_heights(const FileName& file, const std::string& name,
                                            Positive positive, std::span<const Point> nodes,
                                            const Execution& execution = {},
                                            std::vector<std::string>* remarks = nullptr);

}  // namespace rondel::mesh
