// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Runs the commands that make meshes: scvt, icosahedral, points, partition. Each finds sites on the
// unit sphere, and writes them, or the mesh of their Voronoi cells.
#include "mesh_make.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "column_values.h"
#include "mesh.h"
#include "process.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_io.h"
#include "rondel/mesh_partition.h"
#include "rondel/mesh_quality.h"
#include "rondel/point_sets.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// Returns the numbers of shapes that models do not run on, or run on badly.
nlohmann::ordered_json json_of(const mesh::ScvtDefects& defects) {
  return {{"odd_cells", defects.odd_cells},
          {"short_edges", defects.short_edges},
          {"obtuse_triangles", defects.obtuse_triangles},
          {"least_edge_ratio", defects.least_edge_ratio}};
}

// Returns the mesh of sites that were made. The message of an error names the output, as no file
// has the sites.
mesh::MeshArrays arrays_of_made(const Triangulation& triangulation,
                                const mesh::MeshOptions& options, const CommonOptions& common,
                                const Job& job) {
  try {
    return mesh::arrays(triangulation, options, job.execution());
  } catch (const InvalidInput& error) {
    throw FileError(common.output + ": the mesh that was made: " + error.what());
  }
}

// Writes all files that are wanted for these sites; returns the quality as JSON if it was computed.
nlohmann::ordered_json write_made(const MeshOutput& output, const std::vector<Point>& sites,
                                  const mesh::SizeFunction* size, Job& job) {
  const CommonOptions& common = output.common;
  nlohmann::ordered_json quality_of_mesh;
  const bool wants_arrays = is_mesh_file(common) || !output.report.empty() || !output.graph.empty();
  if (wants_arrays) {
    std::vector<double> density;
    if (size != nullptr) {
      for (const Point& site : sites) density.push_back(size->density(site));
    }
    // Models that read MPAS meshes divide by lengths of edges; programs that only use cells do not.
    const bool is_for_model = is_mesh_file(common) && mesh_format(common) == mesh::MeshFormat::mpas;
    const mesh::MeshOptions options{
        .radius = output.radius.value_or(1), .density = density, .allow_zero_edges = !is_for_model};
    const Triangulation triangulation = delaunay(Sites::view(sites), {}, job.execution());
    const mesh::MeshArrays made = arrays_of_made(triangulation, options, common, job);
    quality_of_mesh =
        nlohmann::ordered_json::parse(mesh::quality_json(mesh::quality(made, job.execution())));
    write_mesh_files(output, made, job);
  }
  if (!is_mesh_file(common)) {
    job.time(Stage::write, [&] { write_sites(common.target(), sites, {}, {}, job.execution()); });
  }
  return quality_of_mesh;
}

// Prints the report of a mesh that was made.
// \param how  the begin of the summary, such as "not converged after 10 steps; "
// \param json  what the command adds to the report
// \param quality  the numbers of `rondel mesh quality`; null if no mesh was computed
void report_mesh(const MeshOutput& output, std::size_t num_sites, const std::string& how,
                 nlohmann::ordered_json json, nlohmann::ordered_json quality, Job& job) {
  const Seconds seconds = job.seconds();
  json["cells"] = num_sites;
  if (!quality.is_null()) json["quality"] = std::move(quality);
  json["seconds"] = {{"write", seconds.write}, {"total", seconds.total}};
  job.report(json.dump(2) + '\n', how + "wrote " + count(num_sites, "cell", "cells") + " to " +
                                      output.common.output + '\n');
}

// Shows a step of the relaxation on the progress line.
void show(const mesh::ScvtStep& step, const Execution& execution) {
  if (!execution.progress) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "%zu cells, step %d, energy %.6g, offset %.2g",
                step.sites, step.iteration, step.energy, step.mean_offset);
  execution.progress(text.data(), step.done);
}

// Shows a step of the solver for areas on the progress line.
void show(const mesh::PartitionStep& step, const mesh::AreaPartitionOptions& options,
          const Execution& execution) {
  if (!execution.progress) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "areas within %.2g, of %d steps", step.largest_error,
                options.max_steps);
  execution.progress(text.data(), static_cast<double>(step.step) / options.max_steps);
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
  task.scvt.size = size_of(options, execution);
  task.scvt.repair = !options.no_repair;
  if (!options.start.empty()) task.start = job.read({options.start, {}}, {});
  task.fixed = fixed_sites(options, task.scvt, task.start.sites.size(), execution);
  if (!options.start.empty() && task.fixed.sites.size() > task.start.sites.size()) {
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
  scvt.seen = [&](const mesh::ScvtStep& step) { show(step, execution); };
  if (task.start.sites.empty()) return mesh::scvt(scvt, execution);
  return with_places(task.start, [&] { return mesh::relaxed(task.start.sites, scvt, execution); });
}

}  // namespace

ExitStatus run_scvt(const ScvtCommandOptions& options) {
  const MeshOutput& output = options.output;
  require_mesh_output(output, MeshOutputKind::mesh_or_sites, files_read(options));
  if (options.scvt.count == 0 && options.spacing.empty() && options.start.empty()) {
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
  nlohmann::ordered_json quality =
      write_made(output, made.sites, scvt.size ? &*scvt.size : nullptr, job);
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
  std::string how;
  if (made.end == mesh::ScvtEnd::iterations) {
    how = "not converged after " +
          count(static_cast<std::size_t>(made.last.iteration), "step", "steps") + "; ";
  } else if (!is_whole) {
    how = std::string(mesh::name_of(made.end)) + "; ";
  }
  if (!made.fixed.empty()) {
    how += count(made.fixed.size(), "site", "sites") + " fixed";
    if (task.fixed.num_left_out > 0) {
      how += ", " + count(task.fixed.num_left_out, "place", "places") + " left out";
    }
    how += "; ";
  }
  report_mesh(output, made.sites.size(), how, json, std::move(quality), job);
  if (!is_whole && output.common.quiet) {
    tell(output.common.output, {how.substr(0, how.find(';'))});
  }
  return made.end == mesh::ScvtEnd::stopped ? failed : done;
}

ExitStatus run_icosahedral(const IcosahedralCommandOptions& options) {
  require_mesh_output(options.output, MeshOutputKind::mesh_or_sites);
  Job job(options.output.common);
  // Each division makes four faces of one, and a triangulation with n vertices has 2 n - 4 faces;
  // the icosahedron has 20.
  const std::size_t count = (std::size_t{10} << (2 * options.levels)) + 2;
  const std::vector<Point> sites = options.keep
                                       ? mesh::icosahedral_points(options.levels, job.execution())
                                       : mesh::scvt({.count = count}, job.execution()).sites;
  nlohmann::ordered_json quality = write_made(options.output, sites, nullptr, job);
  report_mesh(options.output, sites.size(), "", {{"levels", options.levels}}, std::move(quality),
              job);
  return done;
}

ExitStatus run_mesh_points(const MeshPointsOptions& options) {
  require_mesh_output(options.output, MeshOutputKind::mesh_or_sites);
  const bool is_poisson = options.kind == "poisson";
  if (is_poisson != (options.radius_km > 0) || is_poisson == (options.size > 0)) {
    throw UsageError(options.kind + (is_poisson ? " takes --radius" : " takes --size"));
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
  nlohmann::ordered_json quality = write_made(options.output, sites, nullptr, job);
  report_mesh(options.output, sites.size(), "", {{"kind", options.kind}}, std::move(quality), job);
  return done;
}

namespace {

// Scales areas in any unit, as large or small as doubles can be, so that their sum is that of the
// sphere. The library names the site of an area that is not positive or no number.
void scale_to_sphere(std::vector<double>& areas) {
  double largest = 0;
  for (const double area : areas) {
    if (std::isfinite(area)) largest = std::max(largest, area);
  }
  if (!(largest > 0)) return;
  const int exponent = std::ilogb(largest);
  double sum = 0;
  for (double& area : areas) {
    const bool is_positive = area > 0;
    area = std::scalbn(area, -exponent);
    if (is_positive) area = std::max(area, std::numeric_limits<double>::min());
    if (std::isfinite(area)) sum += area;
  }
  for (double& area : areas) area *= 4 * std::numbers::pi / sum;
}

}  // namespace

ExitStatus run_area_partition(const AreaPartitionCommandOptions& options) {
  CommonOptions common = options.common;
  require_output(common, can_write_sites(common.target()), ".csv .tsv .xyz .txt .npy");
  Job job(common);
  common.read.keep_columns = !options.column.empty();
  const SiteTable table = job.read(common.source(), common.read);
  std::vector<double> targets;
  if (!options.column.empty()) {
    targets = column_values(table, options.column, "--area");
    scale_to_sphere(targets);
  }
  Execution execution = job.execution();
  execution.stop = &interrupted_by_user();
  mesh::AreaPartitionOptions partition{.tolerance = options.tolerance};
  partition.seen = [&](const mesh::PartitionStep& step) { show(step, partition, execution); };
  const mesh::AreaPartition made = with_places(
      table, [&] { return mesh::area_partition(table.sites, targets, partition, execution); });
  job.time(Stage::write, [&] {
    write_sites(common.target(), made.poles, table.positions,
                table.is_lonlat() ? made.radii_deg : std::vector<double>{}, execution);
  });
  const bool is_whole =
      made.end == mesh::PartitionEnd::converged || made.end == mesh::PartitionEnd::rounded;
  const std::string end(mesh::name_of(made.end));
  const Seconds seconds = job.seconds();
  nlohmann::ordered_json json = {{"end", end},
                                 {"sites", made.poles.size()},
                                 {"steps", made.steps},
                                 {"largest_error", made.largest_error},
                                 {"seconds", {{"write", seconds.write}, {"total", seconds.total}}}};
  if (made.worst != no_index) json["worst"] = made.worst;
  if (!made.reason.empty()) json["reason"] = made.reason;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%s after %d steps, areas within %.2g; ", end.c_str(),
                made.steps, made.largest_error);
  std::string summary = text.data();
  if (!made.reason.empty()) summary += made.reason + "; ";
  if (!is_whole && made.worst != no_index) {
    summary += "the worst is that of " + table.where(made.worst) + "; ";
  }
  job.report(json.dump(2) + '\n', summary + "wrote " + count(made.poles.size(), "site", "sites") +
                                      " to " + common.output + '\n');
  if (is_whole) return done;
  if (common.json) return failed;
  throw FileError(common.input +
                  ": the areas are not reached: " + summary.substr(0, summary.size() - 2));
}

}  // namespace rondel::cli
