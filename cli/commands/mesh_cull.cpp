// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh cull: removes cells of a mesh, such as those on land.
// in    a mesh, and which cells go: by polygons, or by a mask with a number a cell
// out   the mesh that is left, and optionally the new number of each cell, edge and vertex
// index cells, edges and vertices of INPUT, counted from 0
#include "rondel/mesh_cull.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "mesh_output.h"
#include "report.h"
#include "rondel/fields.h"
#include "rondel/polygon_files.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh cull`. The maps are arrays with the new number of each cell, edge or
// vertex of INPUT.
struct MeshCullOptions {
  MeshOutput written;   // INPUT, the mesh that is left
  std::string mask;     // --mask: FILE, FILE.nc:NAME or FILE.csv:COLUMN
  std::string inside;   // --inside: polygons
  std::string outside;  // --outside: polygons
  PolygonOptions polygons;
  std::string cell_map;    // --cell-map; empty: not written
  std::string edge_map;    // --edge-map
  std::string vertex_map;  // --vertex-map
};

// Throws UsageError for a map of old numbers to new ones that is not .npy; an empty path is an
// option that was not given.
void require_map_output(const char* option, const std::string& path) {
  if (path.empty() || format_of(path) == "npy") return;
  throw UsageError(std::string(option) + ": '" + path + "' is not .npy");
}

// Adds --cell-map, --edge-map and --vertex-map, whose files are written beside OUTPUT.
void add_map_options(CLI::App& parser, MeshCullOptions& options) {
  const auto add = [&](const char* name, std::string& path, const char* what) {
    parser
        .add_option(name, path,
                    std::string("Where to write the new number of each ") + what +
                        " of INPUT, from 0\non; 4294967295 where it is gone: .npy")
        ->type_name("FILE");
  };
  add("--cell-map", options.cell_map, "cell");
  add("--edge-map", options.edge_map, "edge");
  add("--vertex-map", options.vertex_map, "vertex");
}

// True if a mask has regions as its dimension, (nCells, nRegions), as MPAS-Tools writes it; cells
// of any region are removed. A dimension of time is not one of regions.
bool are_regions(const FieldArray& array) {
  return array.dimensions.size() == 1 && array.dimensions.front().find("ime") == std::string::npos;
}

// Returns 1 for each cell that --mask removes, 0 for the others. `text` is FILE, FILE.nc:NAME or
// FILE.csv:COLUMN. Throws UsageError for a table without a column, FileError with the place of a
// number that is missing or neither 0 nor 1.
std::vector<std::uint8_t> mask_of_file(const std::string& text, std::size_t num_cells) {
  const auto [file, name] = split_at_colon(text);
  if (const std::string format = format_of(file);
      name.empty() && (format == "csv" || format == "tsv")) {
    throw UsageError("--mask: '" + file + "' is a table, of which " + file +
                     ":COLUMN names the column");
  }
  std::vector<std::string> wanted;
  if (!name.empty()) wanted.push_back(name);
  const FieldSet fields = read_fields({file, {}}, wanted, num_cells);
  const FieldArray* const array = fields.arrays.size() == 1 ? &fields.arrays.front() : nullptr;
  if (array == nullptr || (array->num_fields() != 1 && !are_regions(*array))) {
    throw FileError(file + ": " + (name.empty() ? "it" : "'" + name + "'") +
                    " has not one number for each cell" +
                    (name.empty() ? ": name it, " + file + ":NAME" : ""));
  }
  std::vector<std::uint8_t> mask(num_cells);
  for (std::size_t k = 0; k < array->values.size(); ++k) {
    const double value = array->values[k];
    // A mask with regions has them one after another, each with a number for every cell.
    const std::size_t cell = k % num_cells;
    if (value != 0 && value != 1) {
      const std::string place =
          fields.lines.empty() ? file : file + ':' + std::to_string(fields.lines[cell]);
      std::array<char, 60> what{" is missing"};
      if (!std::isnan(value)) {
        std::snprintf(what.data(), what.size(), " is %g, neither 0 nor 1", value);
      }
      throw FileError(place + ": " + (name.empty() ? "the number" : "'" + name + "'") +
                      " of cell " + std::to_string(cell) + what.data());
    }
    if (value == 1) mask[cell] = 1;
  }
  return mask;
}

// Marks the cells whose sites lie in the polygons, or do not lie in them.
void mark_by_polygons(const std::string& file, const PolygonOptions& options, bool is_inside,
                      const mesh::VoronoiMesh& arrays, const Execution& execution,
                      std::vector<std::uint8_t>& is_removed) {
  if (file.empty()) return;
  const CellTable table = read_polygons({file, {}}, options, execution);
  tell(table.facts.name, table.facts.remarks);
  std::vector<std::uint8_t> found;
  try {
    found = mesh::inside(arrays.cell_points, table.cells, execution);
  } catch (const InvalidInput& error) {
    throw FileError(file + ": " + error.what());
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if ((found[i] != 0) == is_inside) is_removed[i] = 1;
  }
}

// Writes one map, if its option was given.
void write_map(const std::string& path, const std::vector<Index>& numbers) {
  if (path.empty()) return;
  write_indices(path, numbers, std::array<std::uint64_t, 1>{numbers.size()});
}

// Reads or computes the mesh, removes the cells, writes the maps and the rest of the mesh. A cell
// goes if any of the three options removes it. Throws UsageError if none is given, FileError if the
// rest is no mesh or the polygons are not accepted.
ExitStatus run_mesh_cull(const MeshCullOptions& options) {
  const CommonOptions& common = options.written.common;
  require_mesh_output(
      options.written, MeshOutputKind::mesh,
      {{"--inside", options.inside}, {"--outside", options.outside}, {"--mask", options.mask}},
      {{"--cell-map", options.cell_map},
       {"--edge-map", options.edge_map},
       {"--vertex-map", options.vertex_map}});
  require_map_output("--cell-map", options.cell_map);
  require_map_output("--edge-map", options.edge_map);
  require_map_output("--vertex-map", options.vertex_map);
  if (options.mask.empty() && options.inside.empty() && options.outside.empty()) {
    throw UsageError("--inside, --outside or --mask says which cells are removed");
  }
  Job job(common);
  const mesh::VoronoiMesh arrays = read_mesh_or_sites(job, common, options.written.radius, true);
  std::vector<std::uint8_t> is_removed(arrays.num_cells(), 0);
  if (!options.mask.empty()) is_removed = mask_of_file(options.mask, arrays.num_cells());
  mark_by_polygons(options.inside, options.polygons, true, arrays, job.execution(), is_removed);
  mark_by_polygons(options.outside, options.polygons, false, arrays, job.execution(), is_removed);
  mesh::Culled culled;
  try {
    culled = mesh::cull(arrays, is_removed, job.execution());
  } catch (const InvalidInput& error) {
    throw FileError(common.input + ": " + error.what());
  }
  job.time(Stage::write, [&] {
    write_map(options.cell_map, culled.cells);
    write_map(options.edge_map, culled.edges);
    write_map(options.vertex_map, culled.vertices);
  });
  write_mesh(options.written, culled.arrays, job);
  return done;
}

}  // namespace

Command add_mesh_cull_command(CLI::App& group) {
  auto options = std::make_shared<MeshCullOptions>();
  CLI::App* parser =
      group.add_subcommand("cull", "Remove cells of a mesh: those on land, a region");
  add_input_options(*parser, options->written.common, mesh_input_help);
  parser
      ->add_option("--inside", options->inside,
                   "Remove cells whose sites lie in the polygons of this file, .geojson, or on\n"
                   "their borders")
      ->type_name("FILE");
  parser
      ->add_option("--outside", options->outside,
                   "Remove cells whose sites do not lie in the polygons of this file")
      ->type_name("FILE");
  parser
      ->add_option("--mask", options->mask,
                   "Remove the cells that have 1 in this file; the others have 0: .npy,\n"
                   "FILE.nc:NAME, FILE.csv:COLUMN; of NAME(nCells, nRegions) those in any region")
      ->type_name("FILE");
  CLI::Option* const edges = add_edges_option(*parser, options->polygons.edges, "polygons");
  for (CLI::Option* const option :
       {edges, add_invalid_option(*parser, options->polygons.invalid)}) {
    require_effect(
        options->written.common, option,
        [given = options.get()] { return !given->inside.empty() || !given->outside.empty(); },
        "without --inside or --outside");
  }
  add_mesh_output_options(*parser, options->written, MeshOutputKind::mesh);
  add_map_options(*parser, *options);
  add_threads_option(*parser, options->written.common);
  add_report_options(*parser, options->written.common);
  parser->footer(
      "INPUT is sites, or a mesh as 'rondel mesh convert' reads it. A cell goes if one of the\n"
      "options says so. Edges and vertices stay where one of their cells does, and what stays\n"
      "keeps its order; an edge of the border has no second cell.\n\n"
      "Examples:\n"
      "  rondel mesh cull mesh.nc -o ocean.nc --inside land.geojson --cell-map cells.npy\n"
      "  rondel mesh cull mesh.nc -o region.nc --outside region.geojson --graph graph.info");
  return {parser, [options] { return run_mesh_cull(*options); }};
}

}  // namespace rondel::cli
