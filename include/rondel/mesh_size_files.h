// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Spacings of a mesh from files. Every function throws FileError with one line that names the file.
#pragma once

#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/mesh_size.h"
#include "rondel/polygon_files.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The points to refine() at, closer than `distance` radians along lines: those of read_places().
/// \throws InvalidInput if the distance or the tolerance of the options is not positive.
RONDEL_API std::vector<Point> read_refinement(const FileName& file, double distance,
                                              const PolygonOptions& options = {},
                                              const Execution& execution = {});

/// Spacings at the places of a file, linear between them on their triangulation and at the nearest outside of
/// it: the variable or column `name`, by default the only one; .nc with longitudes and latitudes, of a grid or
/// of points, or of the cells of an MPAS mesh, and tables .csv .tsv. The values times `unit` are radians,
/// and so are a thousandth of them where the attribute `units` says meters; units other than meters and kilometers are refused.
RONDEL_API SizeFunction read_spacings(const FileName& file, const std::string& name, double unit,
                                      std::size_t steps = SizeFunction::usual_steps,
                                      const Execution& execution = {});

/// Spacings from densities of a tessellation, read as read_spacings() does: their power -1/4, the largest 1. Only proportions
/// count; of a mesh of MPAS, "meshDensity" are those of its cells.
RONDEL_API SizeFunction read_density(const FileName& file, const std::string& name,
                                     std::size_t steps = SizeFunction::usual_steps,
                                     const Execution& execution = {});

}  // namespace rondel::mesh
