// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "run.h"

namespace rondel::cli {

ExitStatus run_delaunay(const CommonOptions& options) {
  require_output(options, can_write_triangles(options.target()),
                 ".npy .off .ply .obj .stl .vtp .geojson");
  Job job(options);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  job.time(Stage::write,
           [&] { write_triangles(options.target(), table, triangulation, job.execution()); });
  job.report(triangulation, "the triangulation");
  return done;
}

}  // namespace rondel::cli
