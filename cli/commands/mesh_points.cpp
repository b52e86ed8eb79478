// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh points: makes sites of a known kind, and the mesh of their Voronoi cells.
// in    the name of a kind and its size, or for Poisson disks a least distance in kilometers
// out   sites on the unit sphere, or the mesh of their Voronoi cells
// index sites in the order in which the library makes them (rondel/point_sets.h)
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mesh_output.h"
#include "rondel/error.h"
#include "rondel/point_sets.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh points`.
struct MeshPointsOptions {
  MeshOutput output;
  // KIND, one of the words that the parser accepts.
  std::string kind;
  std::size_t size = 0;  // --size
  double radius_km = 0;  // --radius, for the kind poisson
  std::uint64_t seed = 1;
};

// Makes the sites and writes them or their mesh. Poisson disks take --radius, the other kinds take
// --size. Throws UsageError for the other one, and for a size that the library refuses.
ExitStatus run_mesh_points(const MeshPointsOptions& options) {
  require_mesh_output(options.output, MeshOutputKind::mesh_or_sites);
  const bool is_poisson = options.kind == "poisson";
  if (is_poisson != (options.radius_km > 0) || is_poisson == (options.size > 0)) {
    const bool has_other = is_poisson ? options.size > 0 : options.radius_km > 0;
    throw UsageError(options.kind + (is_poisson ? " takes --radius" : " takes --size") +
                     (!has_other   ? ""
                      : is_poisson ? ", not --size"
                                   : ", not --radius"));
  }
  Job job(options.output.common);
  std::vector<Point> sites;
  try {
    if (options.kind == "healpix") sites = mesh::healpix_points(options.size);
    if (options.kind == "reduced-gaussian") sites = mesh::reduced_gaussian_points(options.size);
    if (options.kind == "cubed-sphere") sites = mesh::cubed_sphere_points(options.size);
    if (is_poisson) {
      sites = mesh::poisson_disk_points(options.radius_km / kilometers_per_radian, options.seed,
                                        job.execution());
    }
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
  write_made(options.output, sites, nullptr, "", {{"kind", options.kind}}, job);
  return done;
}

}  // namespace

Command add_mesh_points_command(CLI::App& group) {
  auto options = std::make_shared<MeshPointsOptions>();
  CLI::App* parser = group.add_subcommand("points", "Make the mesh of sites of a known kind");
  parser->add_option("KIND", options->kind, "healpix, reduced-gaussian, cubed-sphere or poisson")
      ->required()
      ->check(one_of({"healpix", "reduced-gaussian", "cubed-sphere", "poisson"}))
      ->type_name("");
  parser
      ->add_option("--size", options->size,
                   "HEALPix's side, the N of O(N), cells along an edge of the cube")
      ->check(count_error)
      ->type_name("N");
  parser->add_option("--radius", options->radius_km, "poisson: the least distance")
      ->check(positive_error)
      ->type_name("KM");
  CLI::Option* const seed = parser->add_option("--seed", options->seed,
                                               "poisson: seed of the random numbers (default: 1)");
  seed->check(seed_error)->type_name("S");
  require_effect(
      options->output.common, seed, [given = options.get()] { return given->kind == "poisson"; },
      "on sites that are not random");
  add_mesh_output_options(*parser, options->output, MeshOutputKind::mesh_or_sites);
  add_threads_option(*parser, options->output.common);
  add_report_options(*parser, options->output.common);
  parser->footer(
      "Examples:\n"
      "  rondel mesh points healpix --size 64 -o centers.npy\n"
      "  rondel mesh points poisson --radius 100 -o poisson.nc --format ugrid");
  return {parser, [options] { return run_mesh_points(*options); }};
}

}  // namespace rondel::cli
