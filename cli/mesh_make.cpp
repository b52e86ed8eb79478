// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "mesh_make.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
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

bool is_mesh_file(const CommonOptions& common) {
  const std::string format = common.format();
  for (const std::string_view known : {"nc", "mpas", "ugrid", "scrip", "esmf", "exodus", "exo"}) {
    if (format == known) return true;
  }
  return false;
}

mesh::MeshFormat mesh_format(const CommonOptions& common) {
  const std::string format = common.format();
  if (format == "ugrid") return mesh::MeshFormat::ugrid;
  if (format == "scrip") return mesh::MeshFormat::scrip;
  if (format == "esmf") return mesh::MeshFormat::esmf;
  if (format == "exodus" || format == "exo") return mesh::MeshFormat::exodus;
  return mesh::MeshFormat::mpas;
}

void require_made_output(const CommonOptions& common) {
  require_output(common, is_mesh_file(common) || can_write_sites(common.target()),
                 ".nc .exo (mpas ugrid scrip esmf exodus) .csv .tsv .xyz .txt .npy");
  if (is_mesh_file(common) && common.output == "-") {
    throw UsageError("--output: a mesh is written to a file");
  }
}

void write_report(const MeshOutput& output, const mesh::MeshArrays& arrays,
                  const mesh::Quality& quality, const Execution& execution) {
  const std::string& path = output.report;
  if (path.ends_with(".svg")) {
    write_file(path, quality_picture(arrays, quality, 100, execution));
  } else if (path.ends_with(".json")) {
    write_file(path, quality_json(quality));
  } else {
    write_file(path, quality_text(quality));
  }
}

nlohmann::ordered_json json_of(const mesh::ScvtDefects& defects) {
  return {{"odd_cells", defects.odd_cells},
          {"short_edges", defects.short_edges},
          {"obtuse_triangles", defects.obtuse_triangles},
          {"least_edge_ratio", defects.least_edge_ratio}};
}

// Writes all that is wanted of these sites; returns the quality as JSON where it was computed.
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
    // Models that take MPAS's meshes divide by the lengths of edges; what only has cells does not.
    const bool is_for_model = is_mesh_file(common) && mesh_format(common) == mesh::MeshFormat::mpas;
    const mesh::MeshOptions options{
        .radius = output.radius, .density = density, .allow_zero_edges = !is_for_model};
    const Triangulation triangulation = delaunay(Sites::view(sites), {}, job.execution());
    const mesh::MeshArrays made = mesh::arrays(triangulation, options, job.execution());
    const mesh::Quality quality = mesh::quality(made, job.execution());
    quality_of_mesh = nlohmann::ordered_json::parse(mesh::quality_json(quality));
    job.time(Stage::write, [&] {
      if (!output.report.empty()) write_report(output, made, quality, job.execution());
      if (!output.graph.empty()) mesh::write_graph(output.graph, made, job.execution());
      if (is_mesh_file(common)) {
        mesh::write(common.output, made, {.format = mesh_format(common)}, job.execution());
      }
    });
  }
  if (!is_mesh_file(common)) {
    job.time(Stage::write, [&] { write_sites(common.target(), sites, {}, {}, job.execution()); });
  }
  return quality_of_mesh;
}

void report_mesh(const MeshOutput& output, std::size_t num_sites, const std::string& how,
                 nlohmann::ordered_json json, nlohmann::ordered_json quality, Job& job) {
  const Seconds seconds = job.seconds();
  json["cells"] = num_sites;
  if (!quality.is_null()) json["quality"] = std::move(quality);
  json["seconds"] = {{"write", seconds.write}, {"total", seconds.total}};
  job.report(json.dump(2) + '\n', how + "wrote " + count(num_sites, "cell", "cells") + " to " +
                                      output.common.output + '\n');
}

void show(const mesh::ScvtStep& step, int most_steps, const Execution& execution) {
  if (!execution.progress) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "%zu cells, energy %.6g, offset %.2g, of %d steps",
                step.sites, step.energy, step.mean_offset, most_steps);
  execution.progress(text.data(), static_cast<double>(step.iteration) / std::max(1, most_steps));
}

void show(const mesh::PartitionStep& step, const mesh::AreaPartitionOptions& options,
          const Execution& execution) {
  if (!execution.progress) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "areas within %.2g, of %d steps", step.largest_error,
                options.max_steps);
  execution.progress(text.data(), static_cast<double>(step.step) / options.max_steps);
}

}  // namespace

ExitStatus run_scvt(const ScvtCommandOptions& options) {
  const MeshOutput& output = options.output;
  require_made_output(output.common);
  if (options.scvt.count == 0 && options.spacing.empty() && options.start.empty()) {
    throw UsageError("-n, --spacing or --start says how many cells there shall be");
  }
  Job job(output.common);
  mesh::ScvtOptions scvt = options.scvt;
  scvt.size = size_of(options, job);
  scvt.repair = !options.no_repair;
  Execution execution = job.execution();
  execution.stop = &interrupted_by_user();
  scvt.seen = [&](const mesh::ScvtStep& step) { show(step, scvt.max_iterations, execution); };
  SiteTable start;
  if (!options.start.empty()) start = job.read({options.start, {}}, {});
  const FixedSites fixed = fixed_sites(options, scvt, start.sites.size(), job);
  scvt.fixed = fixed.sites;
  const mesh::Scvt made =
      options.start.empty()
          ? mesh::scvt(scvt, execution)
          : with_places(start, [&] { return mesh::relaxed(start.sites, scvt, execution); });
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
    json["left_out"] = fixed.num_left_out;
  }
  std::string how = is_whole ? "" : std::string(mesh::name_of(made.end)) + "; ";
  if (!made.fixed.empty()) how += count(made.fixed.size(), "site", "sites") + " fixed; ";
  report_mesh(output, made.sites.size(), how, json, std::move(quality), job);
  return made.end == mesh::ScvtEnd::stopped ? failed : done;
}

ExitStatus run_icosahedral(const IcosahedralCommandOptions& options) {
  require_made_output(options.output.common);
  Job job(options.output.common);
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
  require_made_output(options.output.common);
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

ExitStatus run_area_partition(const AreaPartitionCommandOptions& options) {
  CommonOptions common = options.common;
  require_output(common, can_write_sites(common.target()), ".csv .tsv .xyz .txt .npy");
  Job job(common);
  common.read.keep_columns = !options.column.empty();
  const SiteTable table = job.read(common.source(), common.read);
  std::vector<double> targets;
  if (!options.column.empty()) {
    targets = column_values(table, options.column, "--area");
    double sum = 0;
    // Of a cell without a number the library names the site.
    for (const double area : targets) sum += std::isfinite(area) ? area : 0;
    for (double& area : targets) area *= 4 * std::numbers::pi / sum;
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
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%s after %d steps, areas within %.2g; ", end.c_str(),
                made.steps, made.largest_error);
  std::string summary = text.data();
  if (!is_whole && made.worst != no_index) {
    summary += "the worst is that of " + table.where(made.worst) + "; ";
  }
  job.report(json.dump(2) + '\n', summary + "wrote " + count(made.poles.size(), "site", "sites") +
                                      " to " + common.output + '\n');
  return is_whole ? done : failed;
}

}  // namespace rondel::cli
