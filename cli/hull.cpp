// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/hull.h"

#include "report.h"
#include "run.h"

namespace rondel::cli {
namespace {

// A polygon as a closed surface: each triangle of a fan on both sides. Without three corners there
// are no faces.
Triangulation two_sided(const Triangulation& flat) {
  const auto ring = flat.ring();
  TriangulationArrays arrays;
  arrays.num_sites = flat.num_sites();
  arrays.dimension = 2;
  const auto triangles = static_cast<Index>(ring.size() < 3 ? 0 : ring.size() - 2);
  for (Index i = 0; i < triangles; ++i) {
    // The upper side is face i, the lower one face triangles + i. Where the fan ends, they meet.
    const Index lower = triangles + i;
    arrays.faces.push_back({ring[0], ring[i + 1], ring[i + 2]});
    arrays.neighbors.push_back({lower, i + 1 < triangles ? i + 1 : lower, i > 0 ? i - 1 : lower});
  }
  for (Index i = 0; i < triangles; ++i) {
    const Index lower = triangles + i;
    arrays.faces.push_back({ring[0], ring[i + 2], ring[i + 1]});
    arrays.neighbors.push_back({i, i > 0 ? lower - 1 : i, i + 1 < triangles ? lower + 1 : i});
  }
  for (Index f = 0; f < 2 * triangles; ++f) arrays.ghost_faces.push_back(f);
  return {std::move(arrays), {.model = Model::weighted, .sphere = flat.sphere()}, flat.report()};
}

struct Mesh {
  SiteTable table;
  Triangulation surface;
};

// The vertices alone, in the order of input.
Mesh compact(const SiteTable& table, const Triangulation& surface) {
  std::vector<Index> name(table.sites.size(), no_index);
  for (const Triple& face : surface.faces()) {
    for (const Index corner : face) name[corner] = 0;
  }
  for (const Index corner : surface.ring()) name[corner] = 0;
  Mesh mesh;
  mesh.table.name = table.name;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == no_index) continue;
    name[i] = static_cast<Index>(mesh.table.sites.size());
    mesh.table.sites.push_back(table.sites[i]);
  }
  TriangulationArrays arrays;
  arrays.num_sites = mesh.table.sites.size();
  arrays.dimension = surface.dimension();
  arrays.neighbors.assign(surface.neighbors().begin(), surface.neighbors().end());
  arrays.ghost_faces.assign(surface.ghost_faces().begin(), surface.ghost_faces().end());
  for (const auto& [a, b, c] : surface.faces()) {
    arrays.faces.push_back({name[a], name[b], name[c]});
  }
  for (const Index corner : surface.ring()) arrays.ring.push_back(name[corner]);
  mesh.surface = {
      std::move(arrays), {.model = Model::weighted, .sphere = surface.sphere()}, surface.report()};
  return mesh;
}

void require_mesh(const HullCommandOptions& options) {
  const CommonOptions& common = options.common;
  const std::string format = common.format();
  require_output(common, can_write_triangles(common.target()) && format != "geojson",
                 ".npy .off .ply .obj .stl .vtp");
  if (options.is_compact && format == "npy") {
    throw UsageError("--compact: .npy has no list of vertices to shorten");
  }
}

}  // namespace

ExitStatus run_hull(const HullCommandOptions& options) {
  require_mesh(options);
  Job job(options.common);
  const SiteTable table = job.read();
  if (table.is_lonlat()) {
    throw FileError(table.name +
                    ": longitudes and latitudes, where a hull needs x, y, z (rondel delaunay "
                    "triangulates them)");
  }
  const Triangulation hull = job.hull(table);
  HullSize size;
  job.time(Stage::dual, [&] { size = size_of_hull(hull, table.sites); });
  job.time(Stage::write, [&] {
    const bool is_polygon = hull.ring().size() > 2;
    const Triangulation surface = is_polygon ? two_sided(hull) : hull;
    if (options.is_compact) {
      const Mesh mesh = compact(table, surface);
      write_triangles(options.common.target(), mesh.table, mesh.surface, job.progress());
    } else {
      write_triangles(options.common.target(), table, surface, job.progress());
    }
  });
  job.report(options.common.json ? hull_json_report(hull, size, job.seconds()) : std::string(),
             hull_summary(hull, size, job.seconds(), options.common.output));
  return done;
}

}  // namespace rondel::cli
