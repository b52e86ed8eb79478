// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh quality: reports shapes and sizes of the cells of a mesh, and fails if a number of
// the report is not within a bound that --require gives.
// in    sites, or a mesh of netCDF, or triangles
// out   the report as text or JSON, and as a file of --report (JSON, text or a picture)
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh_output.h"
#include "report.h"
#include "rondel/error.h"
#include "triangle_output.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh quality`.
struct MeshQualityOptions {
  CommonOptions common;  // INPUT: sites or a mesh
  std::string report;    // --report; empty: not written
  // --require: a name of quality_value() and its bound.
  std::vector<std::pair<std::string, double>> required;
};

// A requirement is NAME=NUMBER; these are its two parts.
std::string name_part(const std::string& text) { return text.substr(0, text.find('=')); }
std::string bound_part(const std::string& text) { return text.substr(text.find('=') + 1); }

// A number of triangles that may be required, and the key of json_of_triangles() that has it.
struct TriangleNumber {
  std::string_view name;
  const char* key;
};
constexpr std::array<TriangleNumber, 3> triangle_numbers = {{{"min-angle", "smallest_angle"},
                                                             {"min-edge-km", "shortest_edge_km"},
                                                             {"max-edge-km", "longest_edge_km"}}};

const TriangleNumber* triangle_number(const std::string& name) {
  const auto* const found = std::ranges::find(triangle_numbers, name, &TriangleNumber::name);
  return found == triangle_numbers.end() ? nullptr : found;
}

// Returns what is wrong with a requirement; empty if nothing is.
std::string requirement_error(const std::string& text) {
  if (text.find('=') == std::string::npos) return "'" + text + "' is not NAME=NUMBER";
  try {
    if (triangle_number(name_part(text)) == nullptr) mesh::quality_value({}, name_part(text));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return finite_error(bound_part(text));
}

// True if a number is better when it is larger; all others are better when smaller.
bool is_at_least(const std::string& name) {
  return name.starts_with("min-") || name.starts_with("min_") || name.starts_with("share");
}

// Throws runtime_error, which names all of them, if requirements are not met.
void require_met(const MeshQualityOptions& options,
                 const std::function<double(const std::string&)>& value_of) {
  std::string text;
  for (const auto& [name, bound] : options.required) {
    const double value = value_of(name);
    if (is_at_least(name) ? value >= bound : value <= bound) continue;
    std::array<char, 96> line;
    std::snprintf(line.data(), line.size(), " is %.6g, not %.6g or %s", value, bound,
                  is_at_least(name) ? "more" : "less");
    text += (text.empty() ? "" : "; ") + name + line.data();
  }
  if (!text.empty()) throw std::runtime_error(options.common.input + ": " + text);
}

// Throws UsageError for a number that the mesh does not have.
void require_names(const MeshQualityOptions& options, bool are_triangles) {
  for (const auto& [name, bound] : options.required) {
    if ((triangle_number(name) != nullptr) == are_triangles) continue;
    throw UsageError("--require: " + name + " is no number of " +
                     (are_triangles ? "triangles, which have min-angle, min-edge-km and max-edge-km"
                                    : "cells: it is one of triangles"));
  }
}

// Prints the numbers of triangles.
ExitStatus report_triangles(const MeshQualityOptions& options) {
  require_names(options, true);
  Job job(options.common);
  const mesh::TriangleMesh mesh = read_triangles_of(options.common, job);
  write_triangle_report(options.report, mesh);
  const nlohmann::ordered_json json = json_of_triangles(mesh);
  job.report(json.dump(2) + '\n', text_of_triangles(mesh) + '\n');
  require_met(options, [&](const std::string& name) {
    return json.at(triangle_number(name)->key).get<double>();
  });
  return done;
}

// Computes the quality, writes the file of --report and prints the report. Only after that it
// throws runtime_error if a requirement is not met, so that the numbers can be read.
ExitStatus run_mesh_quality(const MeshQualityOptions& options) {
  require_separate_files({{"INPUT", options.common.input}}, {{"--report", options.report}});
  if (has_triangles_alone(options.common)) return report_triangles(options);
  require_names(options, false);
  Job job(options.common);
  const mesh::VoronoiMesh arrays = read_mesh_or_sites(job, options.common, {}, true);
  const mesh::Quality quality = mesh::quality(arrays, job.execution());
  if (!options.report.empty()) {
    write_mesh_report(options.report, arrays, quality, job.execution());
  }
  job.report(mesh::quality_json(quality), mesh::quality_text(quality));
  require_met(options, [&](const std::string& name) { return mesh::quality_value(quality, name); });
  return done;
}

}  // namespace

Command add_mesh_quality_command(CLI::App& group) {
  auto options = std::make_shared<MeshQualityOptions>();
  CLI::App* parser = group.add_subcommand("quality", "Report how good a mesh is");
  add_input_options(*parser, options->common, std::string(mesh_input_help) + triangle_input_help);
  parser
      ->add_option_function<std::vector<std::string>>(
          "--require",
          [target = options.get()](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              target->required.emplace_back(name_part(text), std::stod(bound_part(text)));
            }
          },
          "Fail (exit status 1) unless a number of the report is within this bound: min-...\n"
          "and share-... at least, others at most. min-dv-dc is min-edge-ratio. Triangles have\n"
          "min-angle (degrees), min-edge-km and max-edge-km. May be repeated")
      ->check(requirement_error)
      ->allow_extra_args(false)
      ->type_name("NAME=NUMBER");
  add_mesh_report_option(*parser, options->report, "--report,--picture");
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "INPUT is sites, or a mesh as 'rondel mesh convert' reads it.\n\n"
      "Examples:\n"
      "  rondel mesh quality sites.csv\n"
      "  rondel mesh quality mesh.nc --require min-dv-dc=0.05 --require num-obtuse=0\n"
      "  rondel mesh quality fort.14 --require min-angle=25 --require min-edge-km=1\n"
      "  rondel mesh quality fort.14 --report fort.svg");
  return {parser, [options] { return run_mesh_quality(*options); }};
}

}  // namespace rondel::cli
