// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel voronoi: the Voronoi or power cells of sites. Whole cells are written here; clipped and
// joined ones, and those of lines and polygons, in voronoi_regions.cpp.
// in    sites; their columns become properties of GeoJSON
// out   a cell for each site that has one
// index sites in the order of the input
#include "region_files.h"
#include "rondel/diagram.h"
#include "run.h"
#include "voronoi_regions.h"

namespace rondel::cli {

ExitStatus run_voronoi(const VoronoiOptions& options) {
  CommonOptions common = options.common;
  const bool is_by_gdal = is_format_of_gdal(common.format());
  require_output(common, is_by_gdal || can_write_cells(common.target()),
                 ".geojson .vtp .npz .gpkg .fgb .parquet", {{"--clip", options.clip}});
  common.read.keep_columns = is_by_gdal || common.format() == "geojson";  // these have properties
  if (makes_regions(options)) {
    VoronoiOptions regions = options;
    regions.common = common;
    return write_voronoi_regions(regions);
  }
  Job job(common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  Diagram diagram;
  job.time(Stage::dual, [&] { diagram = rondel::diagram(triangulation, job.execution()); });
  job.time(Stage::write, [&] {
    write_cells(common.target(), table, triangulation, diagram, options.tolerance_deg,
                job.execution());
  });
  job.report(triangulation,
             common.build.model == Model::projected ? "the Voronoi cells" : "the power cells");
  return done;
}

}  // namespace rondel::cli
