// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel delaunay: triangulates sites; with --scratch from a file to files.
// in    sites
// out   triangles, and arrays beside them
// index sites in the order of the input; faces in the canonical order
//
// In memory: read, triangulate, compute the arrays that are asked for, write. With --scratch the
// library's delaunay_file() does all of this, in buckets that fit into --memory.
#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "job.h"
#include "report.h"
#include "rondel/diagram.h"
#include "rondel/out_of_core.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel delaunay`; the files are written beside the triangles.
struct DelaunayOptions {
  CommonOptions common;
  std::string neighbors;      // --neighbors; empty: not written
  std::string areas;          // --areas; empty: not written
  std::string circumcenters;  // --circumcenters; empty: not written
  std::string duplicates;     // --duplicates; empty: not written
  std::string scratch;        // --scratch; empty: everything in memory
  std::uint64_t memory = 0;   // --memory, in bytes; 0: not given
  bool resume = false;        // --resume
};

// Returns the numbers in rows of `width` numbers, as a flat array.
template <std::size_t width, class Number, class Row>
std::span<const Number> numbers_of(std::span<const Row> rows) {
  static_assert(sizeof(Row) == width * sizeof(Number) && std::is_standard_layout_v<Row>);
  return {reinterpret_cast<const Number*>(rows.data()), width * rows.size()};
}

// Writes rows of `width` indices as a .npy array of the shape (rows, width). Throws FileError.
template <std::size_t width, class Row>
void write_rows(const std::string& path, std::span<const Row> rows) {
  const std::array<std::uint64_t, 2> shape = {rows.size(), width};
  write_indices(path, numbers_of<width, Index>(rows), shape);
}

// Writes points as a .npy array of the shape (points, 3). Throws FileError.
void write_points(const std::string& path, std::span<const Point> points) {
  const std::array<std::uint64_t, 2> shape = {points.size(), 3};
  write_numbers(path, numbers_of<3, double>(points), shape);
}

// Throws UsageError for formats of several files, and says what is written instead.
void require_one_file(const CommonOptions& common) {
  const std::string output = "--output: '" + common.output + "': ";
  if (common.format() == "zarr") {
    throw UsageError(output +
                     "Zarr groups are written in Python, by rondel.delaunay(points).to_zarr(path); "
                     "by rondel.out_of_core.delaunay(sites, path, scratch=directory) where sites "
                     "do not fit into memory");
  }
  if (common.format() == "pvtp")
    throw UsageError(output + ".pvtp is not written; .vtp has all triangles in one file");
}

// Triangulates from a file to files, .npy only, within the memory of --memory. Throws UsageError
// for other formats and for --radius, before any work.
ExitStatus run_out_of_core(const DelaunayOptions& options) {
  const CommonOptions& common = options.common;
  if (common.input == "-" || format_of(common.source()) != "npy")
    throw UsageError("INPUT: with --scratch '" + common.input + "' must be a .npy file");
  if (common.output == "-" || common.format() != "npy")
    throw UsageError("--output: with --scratch '" + common.output + "' must be a .npy file");
  require_output(common, true, ".npy");
  require_array("--neighbors", options.neighbors);
  require_array("--areas", options.areas);
  require_array("--duplicates", options.duplicates);
  if (!common.read.radius.empty())
    throw UsageError(
        "--radius: .npy files have no names for columns; give weighted sites as x, y, z");
  Job job(common);
  OutOfCoreOptions out_of_core;
  if (options.memory != 0) out_of_core.memory = options.memory;
  out_of_core.scratch = options.scratch;
  out_of_core.resume = options.resume;
  out_of_core.radians = common.read.radians;
  const OutOfCoreReport report = delaunay_file(
      common.input, {common.output, options.neighbors, options.areas, options.duplicates},
      out_of_core, common.build, job.execution());
  job.report(out_of_core_json_report(report, common.build.model, job.seconds()),
             out_of_core_summary(report, common.build.model, job.seconds(), common.output));
  return done;
}

// Triangulates in memory and writes OUTPUT and the arrays beside it. Areas and circumcenters are
// computed only if their options are given. Throws UsageError if two of the files are one.
ExitStatus run_delaunay(const DelaunayOptions& options) {
  require_one_file(options.common);
  if (!options.scratch.empty()) return run_out_of_core(options);
  const CommonOptions& common = options.common;
  require_output(common, can_write_triangles(common.target()),
                 ".npy .off .ply .obj .stl .vtp .geojson");
  require_array("--neighbors", options.neighbors);
  require_array("--areas", options.areas);
  require_array("--circumcenters", options.circumcenters);
  require_array("--duplicates", options.duplicates);
  require_separate_files({{"INPUT", common.input}}, {{"--output", common.output},
                                                     {"--neighbors", options.neighbors},
                                                     {"--areas", options.areas},
                                                     {"--duplicates", options.duplicates},
                                                     {"--circumcenters", options.circumcenters}});
  Job job(common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  std::vector<double> cell_areas;
  std::vector<Point> centers;
  if (!options.areas.empty())
    job.time(Stage::dual, [&] { cell_areas = areas(triangulation, job.execution()); });
  if (!options.circumcenters.empty())
    job.time(Stage::dual, [&] { centers = circumcenters(triangulation, job.execution()); });
  std::vector<std::string> remarks;
  job.time(Stage::write, [&] {
    if (!options.neighbors.empty()) write_rows<3>(options.neighbors, triangulation.neighbors());
    if (!options.areas.empty()) write_numbers(options.areas, cell_areas);
    if (!options.circumcenters.empty()) write_points(options.circumcenters, centers);
    if (!options.duplicates.empty()) write_rows<2>(options.duplicates, triangulation.duplicates());
    write_triangles(common.target(), table, triangulation, job.execution(), &remarks);
  });
  tell(common.output, remarks);
  job.report(triangulation, "the triangulation");
  return done;
}

// Adds the files that `rondel delaunay` writes beside the triangles. An array is indexed by site or
// by face, and each is written only if its option is given.
void add_arrays(CLI::App& command, DelaunayOptions& options) {
  command
      .add_option("--neighbors", options.neighbors,
                  "Where to write the neighbors: .npy, m x 3, the face opposite to each corner")
      ->type_name("FILE");
  command
      .add_option("--areas", options.areas,
                  "Where to write the areas of the cells: .npy, n numbers in steradians")
      ->type_name("FILE");
  command
      .add_option("--circumcenters", options.circumcenters,
                  "Where to write the circumcenters of the triangles (--model weighted: the power\n"
                  "centers): .npy, m x 3, unit vectors from the center of the sphere")
      ->type_name("FILE");
  command
      .add_option("--duplicates", options.duplicates,
                  "Where to write the duplicates: .npy, k x 2, the site and the one it repeats")
      ->type_name("FILE");
}

// Adds the options for sites that do not fit into memory. They go to another program path
// (run_out_of_core), which has no circumcenters.
void add_out_of_core(CLI::App& command, DelaunayOptions& options) {
  const char* const group = "More sites than fit into memory: .npy to .npy";
  CLI::Option* scratch =
      command
          .add_option("--scratch", options.scratch,
                      "A directory for files of some 64 bytes a site, 88 with neighbors,\n"
                      "128 with areas; made if it is not there, and removed at the end")
          ->type_name("DIR")
          ->check(
              [](const std::string& name) { return std::string(name.empty() ? "no name" : ""); })
          ->excludes(command.get_option("--circumcenters"))
          ->group(group);
  command
      .add_option_function<std::string>(
          "--memory", [&options](const std::string& text) { options.memory = bytes_of(text); },
          "What may be in memory at once: bytes, or 500M, 1.5g (K, M, G, T; default: 2G)")
      ->check(bytes_error)
      ->needs(scratch)
      ->type_name("SIZE")
      ->group(group);
  command
      .add_flag("--resume", options.resume,
                "Go on with what a run that ended early left in the scratch directory")
      ->needs(scratch)
      ->group(group);
}

}  // namespace

Command add_delaunay_command(CLI::App& tool) {
  auto options = std::make_shared<DelaunayOptions>();
  CLI::App* parser = tool.add_subcommand("delaunay", "Triangulate sites on or near a sphere");
  add_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the triangles: .npy (m x 3 input indices), .off .ply .obj\n"
                    ".stl .vtp .geojson")
      ->required();
  add_build_options(*parser, options->common);
  add_arrays(*parser, *options);
  add_out_of_core(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "The triangulation is exact and unique: it depends on the set of sites alone.\n\n"
      "Examples:\n"
      "  rondel delaunay stations.csv -o stations.geojson\n"
      "  rondel delaunay points.xyz --model weighted -o hull.ply\n"
      "  rondel delaunay stations.csv --lon east --lat north --json -o faces.npy\n"
      "  rondel delaunay sites.npy -o faces.npy --memory 2G --scratch scratch");
  return {parser, [options] { return run_delaunay(*options); }};
}

}  // namespace rondel::cli
