// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads lines and points that a mesh follows: lines and outlines of polygons in GeoJSON and in
// formats of GDAL, or the sites of any other file, each of which is a line of one point.
#include <string>
#include <vector>

#include "formats/sites_gdal.h"
#include "formats/unplaced_rows.h"
#include "io/ending.h"
#include "meshing/feature_outlines.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/io.h"
#include "rondel/mesh_lines.h"
#include "rondel/read_cells.h"

namespace rondel::mesh {

std::vector<std::vector<Point>> read_lines(const FileName& file, const PolygonOptions& options,
                                           const Execution& execution) {
  std::vector<std::vector<Point>> lines =
      meshing::outlines_of(read_features(file, options, execution));
  std::erase_if(lines, [](const std::vector<Point>& line) { return line.size() < 2; });
  if (lines.empty()) throw FileError(file.path + ": it has no lines");
  return lines;
}

std::vector<std::vector<Point>> read_places(const FileName& file, const PolygonOptions& options,
                                            const Execution& execution) {
  std::vector<std::vector<Point>> lines;
  if (io::is_geojson(file) || formats::is_read_by_gdal(file)) {
    lines = meshing::outlines_of(read_features(file, options, execution));
  } else {
    const SiteTable table = is_netcdf_file(file) ? read_netcdf_sites(file, {}, false).table
                                                 : read_sites(file, {}, execution);
    formats::require_places_of_rows(table);
    for (const Point& site : table.sites) lines.push_back({site});
  }
  if (lines.empty()) throw FileError(file.path + ": it has no points and no lines");
  return lines;
}

}  // namespace rondel::mesh
