// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel hull: the convex hull of points in space, as a closed surface of triangles.
// in    points x, y, z
// out   triangles; the volume and the area in the report
// index points of the input; with --compact the vertices of the hull, numbered in the same order
#include "rondel/hull.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <numeric>

#include "job.h"
#include "report.h"

namespace rondel::cli {
namespace {

// The options of `rondel hull`.
struct HullCommandOptions {
  CommonOptions common;
  bool is_compact = false;  // --compact
};

// Returns a polygon as a closed surface: both sides of each triangle of a fan.
Triangulation two_sided(const Triangulation& flat) {
  // The ring has the corners of the polygon in order; the fan has its apex at ring[0].
  const auto ring = flat.ring();
  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
  const auto triangles = static_cast<Index>(ring.size() - 2);
  for (Index i = 0; i < triangles; ++i) {
    // The upper side is face i, the lower side face triangles + i. They meet at the border of the
    // fan.
    const Index lower = triangles + i;
    faces.push_back({ring[0], ring[i + 1], ring[i + 2]});
    neighbors.push_back({lower, i + 1 < triangles ? i + 1 : lower, i > 0 ? i - 1 : lower});
  }
  for (Index i = 0; i < triangles; ++i) {
    const Index lower = triangles + i;
    faces.push_back({ring[0], ring[i + 2], ring[i + 1]});
    neighbors.push_back({i, i > 0 ? lower - 1 : i, i + 1 < triangles ? lower + 1 : i});
  }
  // The center of the sphere is in the plane of the polygon, so it sees no face: all are ghosts.
  std::vector<Index> ghost_faces(faces.size());
  std::iota(ghost_faces.begin(), ghost_faces.end(), Index{0});
  std::vector<Hidden> hidden(flat.hidden().begin(), flat.hidden().end());
  // In dimension 2 each hidden site names a face; below it none has one.
  for (Hidden& h : hidden) h.face = 0;
  return Triangulation::from_arrays(flat.sites(),
                                    {.dimension = 2,
                                     .faces = faces,
                                     .neighbors = neighbors,
                                     .ghost_faces = ghost_faces,
                                     .duplicates = flat.duplicates(),
                                     .hidden = hidden},
                                    {.model = Model::weighted, .sphere = flat.sphere()});
}

// A surface with a table of its own sites, to which its indices refer.
struct Mesh {
  SiteTable table;
  Triangulation surface;
};

// Returns the surface with its vertices only, in the order of the input.
Mesh compact(const SiteTable& table, const Triangulation& surface) {
  // Holds no_index for points that are no vertices, otherwise their new number.
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
  // Faces and ring get the new numbers; neighbors and ghost faces are numbers of faces, which stay.
  std::vector<Triple> faces;
  std::vector<Index> ring;
  for (const auto& [a, b, c] : surface.faces()) faces.push_back({name[a], name[b], name[c]});
  for (const Index corner : surface.ring()) ring.push_back(name[corner]);
  mesh.surface = Triangulation::from_arrays(Sites(mesh.table.sites),
                                            {.dimension = surface.dimension(),
                                             .faces = faces,
                                             .neighbors = surface.neighbors(),
                                             .ghost_faces = surface.ghost_faces(),
                                             .ring = ring},
                                            {.model = Model::weighted, .sphere = surface.sphere()});
  return mesh;
}

// Checks the format of OUTPUT. GeoJSON is none of the formats: it has positions on the sphere only.
void require_mesh(const HullCommandOptions& options) {
  const CommonOptions& common = options.common;
  const std::string format = common.format();
  require_output(common, can_write_triangles(common.target()) && format != "geojson",
                 ".npy .off .ply .obj .stl .vtp");
  if (options.is_compact && format == "npy") {
    throw UsageError("--compact: .npy has no list of vertices to shorten");
  }
}

// Computes the hull, its volume and its area, and writes the surface. A flat hull is written with
// two sides; points on one line give a file without triangles. Throws FileError for longitudes and
// latitudes, which are points of a sphere and all extreme.
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
  job.time(Stage::dual, [&] { size = size_of_hull(hull); });
  job.time(Stage::write, [&] {
    const bool is_polygon = hull.ring().size() > 2;
    const Triangulation surface = is_polygon ? two_sided(hull) : hull;
    if (options.is_compact) {
      const Mesh mesh = compact(table, surface);
      write_triangles(options.common.target(), mesh.table, mesh.surface, job.execution());
    } else {
      write_triangles(options.common.target(), table, surface, job.execution());
    }
  });
  job.report(options.common.json ? hull_json_report(hull, size, job.seconds()) : std::string(),
             hull_summary(hull, size, job.seconds(), options.common.output));
  return done;
}

}  // namespace

Command add_hull_command(CLI::App& tool) {
  auto options = std::make_shared<HullCommandOptions>();
  CLI::App* parser = tool.add_subcommand("hull", "Compute the convex hull of points in space");
  add_point_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the triangles: .npy (m x 3 input indices), .off .ply .obj\n"
                    ".stl .vtp")
      ->required();
  parser->add_flag("--compact", options->is_compact,
                   "Write the vertices of the hull only, renumbered; otherwise every input point\n"
                   "is written, in input order");
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "The hull is exact and unique; its vertices are the extreme points alone. Points in one\n"
      "plane make a flat hull, which is written as a surface with two sides; points on one\n"
      "line make no triangles. Volume and area are sums in doubles.\n\n"
      "Examples:\n"
      "  rondel hull scan.xyz -o hull.ply --compact\n"
      "  rondel hull points.npy --json -o faces.npy");
  return {parser, [options] { return run_hull(*options); }};
}

}  // namespace rondel::cli
