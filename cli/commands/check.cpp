// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel check: proves by exact arithmetic that triangles are the triangulation of sites, or says
// why they are not. A refutation is a result, so its JSON goes to standard output with exit status
// 1.
// in    sites, and triangles as indices of them
// out   a proof in a few lines, or one JSON object; nothing is written
// index sites in the order of INPUT; triangles in the order of their file
#include "rondel/check.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "job.h"
#include "process.h"
#include "report.h"

namespace rondel::cli {
namespace {

// The options of `rondel check`.
struct CheckOptions {
  CommonOptions common;
  std::string triangles;
};

// Returns the JSON object of --json; `faces` is the number of triangles in the file.
std::string json_of(const CheckReport& verdict, const CommonOptions& options, std::size_t sites,
                    std::size_t faces, const Seconds& seconds) {
  const nlohmann::ordered_json json = {
      {"valid", verdict.is_valid},
      {"reason", verdict.reason},
      {"sites", sites},
      {"vertices", verdict.num_vertices},
      {"edges", verdict.num_edges},
      {"faces", faces},
      {"duplicates", verdict.num_duplicates},
      {"hidden", verdict.num_hidden},
      {"model", name_of(options.build.model)},
      {"seconds", {{"read", seconds.read}, {"total", seconds.total}}},
      {"peak_memory_bytes", peak_memory_bytes()}};
  return json.dump(2) + '\n';
}

// Returns the summary for people; it is empty if the triangulation is refuted.
std::string proof_of(const CheckReport& verdict, const CheckOptions& options, std::size_t sites,
                     std::size_t faces) {
  if (!verdict.is_valid) return {};
  std::string text = options.triangles + " is the triangulation of " + options.common.input + '\n';
  text += count(sites, "site", "sites") +
          " accounted for: " + count(verdict.num_vertices, "vertex", "vertices") + ", " +
          count(verdict.num_duplicates, "duplicate", "duplicates") + ", " +
          count(verdict.num_hidden, "hidden site", "hidden sites") + '\n';
  text += count(faces, "face", "faces") + " and " + count(verdict.num_edges, "edge", "edges") +
          " form one closed surface; every edge is locally " +
          (options.common.build.model == Model::projected ? "Delaunay" : "regular") + ", exactly\n";
  return text;
}

// Reads both files and prints the verdict. A refutation gives the exit status `failed`; without
// --json it is thrown as FileError with the reason. The faces may be in any order.
ExitStatus run_check(const CheckOptions& options) {
  Job job(options.common);
  const SiteTable table = job.read();
  const std::vector<Triple> triangles = read_triangles(options.triangles);
  const CheckReport verdict = with_places(
      table, [&] { return check(table.sites, triangles, options.common.build, job.execution()); });
  const std::size_t sites = table.sites.size();
  job.report(json_of(verdict, options.common, sites, triangles.size(), job.seconds()),
             proof_of(verdict, options, sites, triangles.size()));
  if (verdict.is_valid) return done;
  if (options.common.json) return failed;
  throw FileError(options.triangles + ": " + verdict.reason);
}

}  // namespace

Command add_check_command(CLI::App& tool) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* parser =
      tool.add_subcommand("check", "Prove or refute that triangles are the triangulation of sites");
  add_input_options(*parser, options->common);
  parser
      ->add_option("TRIANGLES", options->triangles,
                   "The triangles, as input indices: .npy .off .ply .obj .vtp")
      ->required()
      ->type_name("");
  add_build_options(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "Checks that the triangles form one closed surface, that every site is accounted for\n"
      "and that every edge is Delaunay, by exact arithmetic. Exit status: 0 if it is proved,\n"
      "1 if it is refuted or a file cannot be read.\n\n"
      "Example:\n"
      "  rondel check stations.csv faces.npy");
  return {parser, [options] { return run_check(*options); }};
}

}  // namespace rondel::cli
