// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh scvt: makes a centroidal Voronoi mesh.
// in    a number of cells or spacings, and places that become sites
// out   sites on the unit sphere, or the mesh of their Voronoi cells
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mesh_output.h"
#include "mesh_spacing.h"
#include "process.h"
#include "report.h"
#include "rondel/polygon_files.h"
#include "rondel/scvt.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of the command.
struct ScvtCommandOptions {
  MeshOutput output;
  ScvtFiles files;
  bool no_repair = false;
  // The options of the library; its size, fixed sites and callbacks are set by scvt_task() and
  // solve().
  mesh::ScvtOptions scvt;
};

// Returns the numbers of shapes that models do not run on, or run on badly.
nlohmann::ordered_json json_of(const mesh::ScvtDefects& defects) {
  return {{"odd_cells", defects.odd_cells},
          {"short_edges", defects.short_edges},
          {"obtuse_triangles", defects.obtuse_triangles},
          {"min_edge_ratio", defects.min_edge_ratio}};
}

// Shows a step of the relaxation on the progress line.
void show(const mesh::ScvtStep& step, const Execution& execution) {
  if (!execution.progress) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "%zu cells, step %d, energy %.6g, offset %.2g",
                step.sites, step.iteration, step.energy, step.mean_offset);
  execution.progress(text.data(), step.done);
}

// The options of `rondel mesh scvt` with the content of their files.
struct ScvtTask {
  mesh::ScvtOptions scvt;
  SiteTable start;  // empty if no sites are given
  FixedSites fixed;
};

// Reads the files of the options. Each fixed place takes one of the sites of --start, if these are
// given, so there must be as many of them at least.
ScvtTask scvt_task(const ScvtCommandOptions& options, Job& job, const Execution& execution) {
  ScvtTask task;
  task.scvt = options.scvt;
  task.scvt.size = size_of(options.files, options.scvt.count, execution);
  task.scvt.repair = !options.no_repair;
  if (!options.files.start.empty()) task.start = job.read({options.files.start, {}}, {});
  task.fixed = fixed_sites(options.files, task.scvt, task.start.sites.size(), execution);
  if (!options.files.start.empty() && task.fixed.sites.size() > task.start.sites.size()) {
    throw FileError(task.start.name + ": it has " +
                    count(task.start.sites.size(), "site", "sites") + ", fewer than the " +
                    count(task.fixed.sites.size(), "place", "places") + " of --fixed and --along");
  }
  return task;
}

// Relaxes the given sites, or makes sites from nothing and relaxes them level by level.
mesh::Scvt solve(const ScvtTask& task, const Execution& execution) {
  mesh::ScvtOptions scvt = task.scvt;
  scvt.fixed = task.fixed.sites;
  scvt.on_step = [&](const mesh::ScvtStep& step) { show(step, execution); };
  if (task.start.sites.empty()) return mesh::scvt(scvt, execution);
  return with_places(task.start, [&] { return mesh::relax(task.start.sites, scvt, execution); });
}

// Returns how a relaxation ended that has not met its tolerances; empty if it has.
std::string shortfall(const mesh::Scvt& made, const mesh::ScvtOptions& scvt) {
  if (made.end == mesh::ScvtEnd::converged ||
      (made.last.mean_offset <= scvt.mean_tolerance &&
       made.last.largest_offset <= scvt.largest_tolerance)) {
    return {};
  }
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "not converged (%s after %d %s): the mean offset is %.2g (--tolerance %.2g), the "
                "largest %.2g (--max-tolerance %.2g)",
                std::string(mesh::name_of(made.end)).c_str(), made.last.iteration,
                made.last.iteration == 1 ? "step" : "steps", made.last.mean_offset,
                scvt.mean_tolerance, made.last.largest_offset, scvt.largest_tolerance);
  return text.data();
}

// Makes the mesh and writes it with a report. After Ctrl-C the mesh of the last step is written and
// the exit status is `failed`; before there is a mesh, nothing is written, which is an error. A run
// that ends at --max-steps is a success, but a remark says so.
ExitStatus run_scvt(const ScvtCommandOptions& options) {
  const MeshOutput& output = options.output;
  require_mesh_output(output, MeshOutputKind::mesh_or_sites, files_read(options.files));
  if (options.scvt.count == 0 && options.files.spacing.empty() && options.files.start.empty()) {
    throw UsageError("-n, --spacing or --start says how many cells there shall be");
  }
  Job job(output.common);
  Execution execution = job.execution();
  execution.stop = &interrupted_by_user();
  ScvtTask task;
  mesh::Scvt made;
  try {
    task = scvt_task(options, job, execution);
    made = solve(task, execution);
    if (execution.progress) execution.progress("write", 1);
  } catch (const Interrupted&) {
    throw std::runtime_error("interrupted before there was a mesh: nothing is written");
  }
  const mesh::ScvtOptions& scvt = task.scvt;
  // The mesh is a result in full if the tolerances are met, or no step lowers the energy any more.
  const bool is_whole = made.end == mesh::ScvtEnd::converged || made.end == mesh::ScvtEnd::stuck;
  nlohmann::ordered_json json = {{"end", mesh::name_of(made.end)},
                                 {"steps", made.last.iteration},
                                 {"energy", made.last.energy},
                                 {"mean_offset", made.last.mean_offset},
                                 {"largest_offset", made.last.largest_offset}};
  if (scvt.repair && is_whole) {
    json["repair"] = {{"rounds", made.repair.rounds},
                      {"moved", made.repair.moved},
                      {"before", json_of(made.repair.before)},
                      {"after", json_of(made.repair.after)}};
  }
  if (!made.fixed.empty()) {
    json["fixed"] = made.fixed.size();
    json["left_out"] = task.fixed.num_left_out;
  }
  std::string how;  // begins the summary
  if (!made.fixed.empty()) {
    how += count(made.fixed.size(), "site", "sites") + " fixed";
    if (task.fixed.num_left_out > 0) {
      how += ", " + count(task.fixed.num_left_out, "place", "places") + " left out";
    }
    how += "; ";
  }
  write_made(output, made.sites, scvt.size ? &*scvt.size : nullptr, how, std::move(json), job);
  if (const std::string text = shortfall(made, scvt); !text.empty()) {
    tell(output.common.output, {text});
  }
  return made.end == mesh::ScvtEnd::stopped ? failed : done;
}

// Adds the conditions under which the relaxation of a centroidal mesh ends.
void add_tolerances(CLI::App& parser, mesh::ScvtOptions& options) {
  parser
      .add_option("--tolerance", options.mean_tolerance,
                  "Mean distance of sites from the centroids of their cells,\n"
                  "over the spacing (default: 1e-4)")
      ->check(positive_error)
      ->type_name("T");
  parser
      .add_option("--max-tolerance", options.largest_tolerance,
                  "The largest of these distances (default: 1e-2)")
      ->check(positive_error)
      ->type_name("T");
  parser.add_option("--max-steps", options.max_iterations, "Steps in each level (default: 1000)")
      ->check([](const std::string& text) { return whole_error(text, 0, 1'000'000'000); })
      ->type_name("N");
}

// Adds the files of places that become sites which are never moved.
void add_places_that_stay(CLI::App& parser, ScvtCommandOptions& options) {
  parser
      .add_option("--fixed", options.files.fixed,
                  "Points of FILE, .geojson or a table, are sites of the mesh and never move;\n"
                  "so are places on lines and outlines of FILE, the spacing apart;\n"
                  "may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  parser
      .add_option("--along", options.files.along,
                  "Let edges of cells follow the lines or outlines of FILE, .geojson: rows of\n"
                  "sites on both sides never move; may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  CLI::Option* const edges = add_word<PolygonEdges>(
      parser, "--edges", options.files.polygons.edges, named_values<PolygonEdges>(),
      "What joins positions of --refine, --fixed and --along: lonlat (default;\n"
      "straight in longitude and latitude, RFC 7946) or geodesic (great circles)");
  for (CLI::Option* const option :
       {edges, add_invalid_option(parser, options.files.polygons.invalid)}) {
    require_effect(
        options.output.common, option,
        [&options] {
          return !(options.files.refine.empty() && options.files.fixed.empty() &&
                   options.files.along.empty());
        },
        "without --refine, --fixed or --along");
  }
}

// Adds the bound on how fast the spacing grows: by G kilometers a kilometer.
void add_gradient(CLI::App& parser, ScvtCommandOptions& options) {
  const CLI::Option* const gradient =
      parser
          .add_option("--gradient", options.files.slope,
                      "How much the spacing grows over its own distance, at most\n"
                      "(default: 0.05 of --refine; files as they are)")
          ->check(positive_error)
          ->type_name("G");
  require_effect(
      options.output.common, gradient,
      [&options] {
        return !options.files.refine.empty() || is_file_of_spacings(options.files.spacing);
      },
      "without --refine or a file of --spacing");
}

}  // namespace

Command add_mesh_scvt_command(CLI::App& group) {
  auto options = std::make_shared<ScvtCommandOptions>();
  CLI::App* parser = group.add_subcommand("scvt", "Make a centroidal Voronoi mesh");
  CLI::Option* number =
      parser->add_option("-n,--number", options->scvt.count, "Number of cells, also as 1e6");
  number->check([](const std::string& text) { return whole_error(text, 12, max_sites); })
      ->transform(digits_of_whole)
      ->type_name("N");
  // An option that others need is added before these: --refine needs --spacing.
  CLI::Option* spacing = parser->add_option(
      "--spacing", options->files.spacing,
      "Distance of neighbors: kilometers, or a file of them, FILE.nc[:NAME]\n"
      "or FILE.csv:COLUMN; with -n only its proportions count. The attribute units\n"
      "of netCDF may say meters (m)");
  spacing->type_name("KM|FILE");
  parser
      ->add_option("--refine", options->files.refine,
                   "Kilometers near the lines, outlines or points of FILE, .geojson\n"
                   "or a table; may be repeated")
      ->allow_extra_args(false)
      ->needs(spacing)
      ->type_name("FILE:KM");
  add_gradient(*parser, *options);
  parser
      ->add_option("--density", options->files.density,
                   "Spacing as the power -1/4 of this density of a tessellation, FILE.nc:NAME or\n"
                   "FILE.csv:COLUMN; of a mesh of MPAS FILE.nc:meshDensity")
      ->needs(number)
      ->excludes(spacing)
      ->type_name("FILE");
  add_places_that_stay(*parser, *options);
  CLI::Option* start = parser->add_option("--start", options->files.start,
                                          "Begin with the sites of FILE, and keep them in order");
  start->excludes(number)->type_name("FILE");
  add_word<mesh::ScvtMethod>(*parser, "--method", options->scvt.method,
                             named_values<mesh::ScvtMethod>(),
                             "lbfgs (default), or lloyd, to compare");
  add_tolerances(*parser, options->scvt);
  parser->add_flag("--no-repair", options->no_repair,
                   "Leave short edges, obtuse triangles, and cells with\n"
                   "other than 5 to 7 sides");
  add_mesh_output_options(*parser, options->output, MeshOutputKind::mesh_or_sites);
  add_threads_option(*parser, options->output.common);
  add_report_options(*parser, options->output.common);
  parser->footer(
      "Kilometers are those of a sphere of 6371.229 km. With Ctrl-C the mesh so far is written, "
      "and\n"
      "the exit status is 1. Sides along which a file has cut polygons at longitude 180, or has\n"
      "led them around a pole, are no lines.\n\n"
      "Examples:\n"
      "  rondel mesh scvt -n 40962 -o x1.40962.nc\n"
      "  rondel mesh scvt --spacing 240 --refine coast.geojson:60 -o coast.nc --report coast.json\n"
      "  rondel mesh scvt -n 40962 --along land.geojson -o coast.nc\n"
      "  rondel mesh scvt --spacing 240 --fixed sections.geojson -o sections.nc\n"
      "  rondel mesh scvt --spacing spacing.nc:h -o mesh.nc --format ugrid");
  return {parser, [options] { return run_scvt(*options); }};
}

}  // namespace rondel::cli
