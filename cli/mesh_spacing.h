// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The files of `rondel mesh scvt`: spacings, and places that become sites.
///
/// in    the command line, and the files of spacings, lines and points that it names
/// out   spacings in radians, sites on the unit sphere
/// index sites, which are the cells of the mesh
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files_of_command.h"
#include "rondel/polygon_files.h"
#include "rondel/scvt.h"

namespace rondel::cli {

/// The options that name files; lengths are kilometers on the Earth of MPAS.
struct ScvtFiles {
  std::string spacing;              ///< --spacing: kilometers, FILE or FILE:NAME
  std::vector<std::string> refine;  ///< --refine: FILE:KM
  std::optional<double> slope;      ///< --gradient
  std::string start;                ///< --start: sites
  std::string density;              ///< --density: FILE:NAME
  std::vector<std::string> fixed;   ///< --fixed: sites, lines
  std::vector<std::string> along;   ///< --along: lines
  PolygonOptions polygons;          ///< for polygons of --refine, --fixed and --along
};

/// The sites of --fixed and --along.
struct FixedSites {
  std::vector<Point> sites;
  std::size_t num_left_out = 0;  ///< number of sites on lines and beside them that were too close
                                 ///< to others
};

/// The files of --spacing, --refine, --density, --fixed, --along and --start.
std::vector<NamedFile> files_read(const ScvtFiles& options);
/// True if --spacing names a file, and no number of kilometers.
bool is_file_of_spacings(const std::string& spacing);
/// The spacings of --spacing, --refine and --density; none: the same everywhere.
/// \param region  where the spacings are kept; none: on the whole sphere
/// \param corners  of the polygons in which the mesh is; none: it is on the whole sphere
std::optional<mesh::SizeFunction> spacings_of(const ScvtFiles& options, const Execution& execution,
                                              const std::optional<mesh::SizeRegion>& region = {},
                                              std::span<const Point> corners = {});
/// Returns the same. Throws FileError if a mesh of Voronoi cells cannot have them.
/// \param count  the number of cells; 0: not given
std::optional<mesh::SizeFunction> size_of(const ScvtFiles& options, std::size_t count,
                                          const Execution& execution);
/// Returns the fixed sites. On lines, and in rows beside them, they have the spacing of a mesh of
/// `scvt`, which starts with `num_start` given sites (0: none).
FixedSites fixed_sites(const ScvtFiles& options, const mesh::ScvtOptions& scvt,
                       std::size_t num_start, const Execution& execution);

}  // namespace rondel::cli
