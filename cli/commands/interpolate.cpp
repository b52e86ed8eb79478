// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel interpolate: carries values at sites to targets, or makes the weights for that.
// in    sites, with values or without; targets
// out   values at the targets, weights
// index sources (columns of the weights) and targets (rows), in the order of their files
//
// Steps: read sources and targets, make weights (bilinear, nearest_d2s) or a triangulation (the
// other methods), then carry one field after another, or write the weights themselves.
#include "rondel/interpolate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "column_values.h"
#include "edge_table.h"
#include "extrapolate_options.h"
#include "field_carrier.h"
#include "field_facts.h"
#include "process.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/fields.h"
#include "rondel/regrid.h"
#include "rondel/weight_files.h"
#include "targets.h"

namespace rondel::cli {
namespace {

// The options of `rondel interpolate`.
struct InterpolateOptions {
  CommonOptions common;                // INPUT: the sites
  std::string target;                  // --to; "-": standard input
  std::string weights;                 // --weights; empty: values
  std::string weight_format;           // --weight-format
  std::string mesh;                    // --source; empty: INPUT has the places
  std::string constraints;             // --constraints; empty: faces are Delaunay
  std::vector<std::string> columns;    // --value
  InterpolationOptions interpolation;  // --method, unless it is one of `regrid`
  std::optional<RegridMethod> regrid;  // --method bilinear, nearest_d2s or native
  ExtrapolateOptions extrapolate;      // --extrapolate and its limits
  NetcdfOptions netcdf;                // --kind --deflate
  std::string field;                   // whose places are the sites, if none is at the cells

  [[nodiscard]] FileName source_file() const { return common.source_beside(target); }
  [[nodiscard]] FileName target_file() const { return common.other_source(target); }
  [[nodiscard]] FileName weights_file() const { return {weights, weight_format}; }
  // Returns the file of the mesh, or that of the sources with the name of a variable, if one is
  // named.
  [[nodiscard]] FileName mesh_file() const {
    if (!mesh.empty()) return mesh;
    FileName file = source_file();
    if (!file_and_variable(file).second.empty()) return file;
    const std::string& name = columns.empty() ? field : columns[0];
    if (!name.empty()) file.path += ":" + name;
    return file;
  }
};

// How far the coordinates of a field may be from the sites. Both are read from one file, so they
// can differ by rounding only.
constexpr double same_places_deg = 1e-9;

// Prints the counts, as JSON or as text that names the duplicates, the sites left out and the file
// of weights.
void report(Job& job, const InterpolateOptions& options, const InterpolateCounts& counts) {
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"sites", counts.sites},
                                       {"targets", counts.targets},
                                       {"duplicates", counts.duplicates},
                                       {"left_out", counts.left_out},
                                       {"missing", counts.missing},
                                       {"extrapolated", counts.extrapolated},
                                       {"seconds",
                                        {{"read", seconds.read},
                                         {"interpolate", seconds.query},
                                         {"write", seconds.write},
                                         {"total", seconds.total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  std::string text =
      count(counts.sites, "site", "sites") + " to " + count(counts.targets, "target", "targets");
  if (counts.duplicates > 0) {
    text += ", " + count(counts.duplicates, "duplicate", "duplicates") +
            (options.interpolation.shared_place == SharedPlace::mean ? " (the mean counts)"
                                                                     : " (the first site counts)");
  }
  if (counts.left_out > 0)
    text += ", left out " + std::to_string(counts.left_out) + " without value";
  if (options.extrapolate.method) text += "; extrapolated: " + std::to_string(counts.extrapolated);
  text += "; targets without value: " + std::to_string(counts.missing) + '\n';
  if (!options.weights.empty()) text += "wrote the weights to " + options.weights + '\n';
  job.report(json.dump(2) + '\n', text);
}

// Returns the edges of --constraints, if there are any. Throws FileError.
std::optional<EdgeTable> edges_of(const InterpolateOptions& options, const SiteTable& table) {
  if (options.constraints.empty()) return {};
  return read_edge_table(options.constraints, table);
}

// Leaves out the columns that are interpolated if sites are their own targets: the field stands in their
// place. A column of another file keeps its values, and gives way.
void drop_own_columns(const InterpolateOptions& options, const FieldSet& fields, Targets& targets) {
  const auto path_of = [](const FileName& file) { return file_and_variable(file).first.path; };
  if (!are_one_file(path_of(options.source_file()), path_of(options.target_file()))) return;
  for (const FieldArray& array : fields.arrays) {
    std::vector<std::string> names = names_of_fields(array, fields.axes);
    names.push_back(array.name);
    std::erase_if(targets.side.columns,
                  [&](const Column& column) { return std::ranges::count(names, column.name) > 0; });
  }
}

// Returns the targets as netCDF of fields gets them; the side of the targets is that of weights.
WeightSide side_with_cells(const Job& job, const InterpolateOptions& options,
                           const Targets& targets, FieldSet& fields) {
  WeightSide side = targets.side;
  if (is_netcdf_file(options.common.target())) {
    describe_cells(options.target_file(), fields, side, job.execution());
    tell(options.target, fields.remarks);
  }
  return side;
}

// Interpolates the columns that --value names, and writes them as fields of those names. The index
// of `table` counts sites; `weights` are those of bilinear or nearest_d2s. All columns are in
// memory at once, as a table was.
void interpolate_columns(Job& job, const InterpolateOptions& options,
                         const InterpolateMethod& method, const SiteTable& table, Targets& targets,
                         const std::optional<Weights>& weights, Extrapolator* extrapolator,
                         InterpolateCounts& counts) {
  FieldSet fields;
  fields.num_points = targets.table.sites.size();
  FieldCarrier carrier(job, method, table, targets, weights, extrapolator, counts);
  for (const std::string& name : options.columns) {
    if (std::ranges::count(options.columns, name) > 1) {
      throw UsageError("--value: '" + name + "' is named twice");
    }
    FieldArray array;
    array.name = name;
    array.values = carrier.carry(column_values(table, name, "--value"));
    fields.arrays.push_back(std::move(array));
  }
  drop_own_columns(options, fields, targets);
  const WeightSide side = side_with_cells(job, options, targets, fields);
  job.time(Stage::write, [&] {
    FieldWriter writer(options.common.target(), fields, side, options.netcdf, job.execution());
    tell(writer.remarks());
    for (const FieldArray& array : fields.arrays) writer.write(array.values);
    writer.finish();
  });
}

// True if each target gets the value of one site, so that flags stay flags.
bool gives_values_of_sites(const InterpolateOptions& options) {
  const auto& filling = options.extrapolate.method;
  return !options.regrid && options.interpolation.method == Method::nearest &&
         options.interpolation.shared_place != SharedPlace::mean &&
         (!filling || *filling == Extrapolation::nearest);
}

// Interpolates the fields of a netCDF file, for all indices of their other dimensions; one field at
// a time is in memory.
void interpolate_fields(Job& job, const InterpolateOptions& options,
                        const InterpolateMethod& method, const NetcdfSites& grid, Targets& targets,
                        const std::optional<Weights>& weights, Extrapolator* extrapolator,
                        InterpolateCounts& counts) {
  const SiteTable& table = grid.table;
  const auto [file, variable] = file_and_variable(options.source_file());
  std::vector<std::string> names = options.columns;
  if (names.empty() && !variable.empty()) names.push_back(variable);
  // The fields must be at the places of the sites, in the same order. Where those are another file's,
  // the places of this one do not matter.
  const FieldFile in = options.mesh.empty() ? FieldFile(file, names, table.sites.size(), {}, {},
                                                        {table.positions, same_places_deg})
                                            : FieldFile(file, names, table.sites.size());
  FieldSet out;
  out.num_points = targets.table.sites.size();
  out.arrays = in.fields().arrays;
  for (FieldArray& array : out.arrays) {
    array.is_single = false;  // sums are written as doubles
    if (!gives_values_of_sites(options)) remove_flags(array);
  }
  out.axes = in.fields().axes;
  out.unlimited = in.fields().unlimited;
  tell(file.path, in.fields().remarks);
  drop_own_columns(options, out, targets);
  const WeightSide side = side_with_cells(job, options, targets, out);
  FieldWriter writer(options.common.target(), out, side, options.netcdf, job.execution());
  tell(writer.remarks());
  FieldCarrier carrier(job, method, table, targets, weights, extrapolator, counts);
  for (std::size_t a = 0; a < out.arrays.size(); ++a) {
    for (std::size_t f = 0; f < out.arrays[a].num_fields(); ++f) {
      std::vector<double> values(table.sites.size());
      in.read(a, f, values);
      for (std::size_t i = 0; i < grid.mask.size(); ++i) {
        // A masked cell has no value, whatever number the file has there.
        if (grid.mask[i] == 0) values[i] = std::numeric_limits<double>::quiet_NaN();
      }
      const std::vector<double> carried = carrier.carry(values);
      job.time(Stage::write, [&] { writer.write(carried); });
    }
  }
  job.time(Stage::write, [&] { writer.finish(); });
}

// Turns weights of the cells that are not masked into weights of all cells. `numbers` has the index
// in `table` of each cell that is not masked. Masked cells get the area 0 and no entries.
void spread(const std::vector<Index>& numbers, const SiteTable& table, WeightFile& file) {
  Weights& weights = file.weights;
  for (Index& column : weights.columns) column = numbers[column];
  weights.num_columns = table.sites.size();
  weights.sites_hash = point_set_hash(table.sites);
  std::vector<double> areas(table.sites.size(), 0);
  for (std::size_t k = 0; k < numbers.size(); ++k) areas[numbers[k]] = file.source.areas[k];
  file.source.areas = std::move(areas);
}

// Adds the weights and the areas of the sites, by a triangulation of the cells that are not masked.
void interpolate_weights(Job& job, const InterpolateMethod& method, const NetcdfSites& grid,
                         const Targets& targets, InterpolateCounts& counts, WeightFile& file) {
  const SiteTable& table = grid.table;
  const std::vector<Index> numbers = unmasked_sites(grid);
  const bool has_masked = numbers.size() < table.sites.size();
  SiteTable kept;  // the triangulation refers to it
  if (has_masked) kept = table.selection(grid.unmasked());
  EdgeTable edges;
  if (has_masked && method.edges != nullptr) {
    edges = kept_edges(*method.edges, table, grid.unmasked());
  }
  const bool has_fewer = has_masked && method.edges != nullptr;
  const TableInterpolator interpolator(job, {method.options, has_fewer ? &edges : method.edges},
                                       has_masked ? kept : table, counts);
  job.time(Stage::query, [&] {
    file.weights = with_places(
        targets.table, [&] { return interpolator.weights(targets.table.sites, job.execution()); });
    if (!targets.side.mask.empty()) file.weights = with_rows(file.weights, targets.side.mask);
  });
  // A site has the area of its cell, whatever edges are given.
  const Triangulation delaunay = method.edges == nullptr
                                     ? interpolator.delaunay()
                                     : job.triangulate(has_masked ? kept : table);
  job.time(Stage::dual, [&] { file.source.areas = areas(delaunay, job.execution()); });
  if (has_masked) spread(numbers, table, file);
}

std::size_t num_rows_with_entries(const Weights& weights) {
  std::size_t number = 0;
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    if (weights.offsets[r] != weights.offsets[r + 1]) ++number;
  }
  return number;
}

// Writes the file of --weights: the matrix, both sides and the name of the method. Columns count
// the sites of the file, rows the targets. `counts.missing` becomes the number of targets without
// an entry. `weights` and the targets' side are moved into the file.
void write_weights_of(Job& job, const InterpolateOptions& options, const InterpolateMethod& method,
                      const NetcdfSites& grid, Targets& targets, std::optional<Weights>& weights,
                      Extrapolator* extrapolator, InterpolateCounts& counts) {
  WeightFile file;
  if (weights) {
    file.weights = std::move(*weights);
    file.method = name_of(*options.regrid);
  } else {
    interpolate_weights(job, method, grid, targets, counts, file);
    file.method = name_of(options.interpolation.method);
  }
  if (extrapolator != nullptr) {
    const std::size_t before = num_rows_with_entries(file.weights);
    job.time(Stage::query,
             [&] { file.weights = extrapolator->filled(file.weights, job.execution()); });
    counts.extrapolated = num_rows_with_entries(file.weights) - before;
  }
  // Weights of points are not divided by areas. Areas and corners serve programs that read the
  // file.
  file.normalization = "none";
  file.source.points = lonlats_of(grid.table, job.sphere().center);
  if (grid.shape.size() > 1) file.source.shape = grid.shape;
  file.source.mask = grid.mask;
  file.target = std::move(targets.side);
  if (NamedGrid::is_name(options.target)) {
    const CellSet cells = grid_of(options.target).cells();
    file.target.corners = cells.corners();
    file.target.areas.assign(cells.areas().begin(), cells.areas().end());
  }
  counts.missing = file.weights.num_rows() - num_rows_with_entries(file.weights);
  job.time(Stage::write, [&] { write_weights(options.weights_file(), file, options.netcdf); });
}

// Throws UsageError for options that contradict each other or say nothing to do.
void require_options(const InterpolateOptions& options, bool has_values) {
  const CommonOptions& common = options.common;
  if (has_values != !common.output.empty()) {
    throw UsageError("--value and --output go together: values of a column to a file");
  }
  if (!has_values && options.weights.empty()) {
    throw UsageError("nothing to do: --value COL -o FILE, or --weights FILE");
  }
  require_separate_files({{"INPUT", common.input},
                          {"--to", options.target},
                          {"--constraints", options.constraints},
                          {"--source", options.mesh}},
                         {{"--output", common.output}, {"--weights", options.weights}});
  if (!options.constraints.empty()) require_edge_table(options.constraints);
  const bool is_linear = !options.regrid && options.interpolation.method == Method::linear;
  if (!options.constraints.empty() && !is_linear) {
    throw UsageError("--constraints: no method but linear keeps to edges; add --method linear");
  }
  if (has_values) {
    require_output(common, can_write_fields(common.target()), ".csv .tsv .npy .nc .nc4");
  }
  if (!options.weights.empty() &&
      if_of_format(options.weights_file(), {"nc", "nc4", "npz", "esmf", "scrip"}).empty()) {
    throw UsageError((options.weight_format.empty()
                          ? "--weights: the ending of '" + options.weights
                          : "--weight-format: '" + options.weight_format) +
                     "' is not one of .nc .nc4 .npz esmf scrip");
  }
  const bool is_nearest = !options.regrid && options.interpolation.method == Method::nearest;
  if (common.build.model == Model::weighted && !is_nearest) {
    throw UsageError("--method: weighted sites have no method but nearest");
  }
}

// Throws UsageError if --source is given and INPUT is no netCDF, or does not say which variable is
// on the mesh.
void require_values_on_mesh(const InterpolateOptions& options, bool is_netcdf) {
  if (options.mesh.empty()) return;
  const FileName source = options.source_file();
  if (!is_netcdf || source.path == "-") {
    throw UsageError("--source: the values must be those of a file of netCDF");
  }
  if (options.columns.empty() && file_and_variable(source).second.empty()) {
    throw UsageError("--source: --value NAME says which variable is on the mesh");
  }
}

// Reads the sites. Where all fields of netCDF are to be carried and none is at the cells, they are the
// places of the first field and those with it, such as the nodes of a mesh.
NetcdfSites read_sources(Job& job, const ReadOptions& read, bool has_values,
                         InterpolateOptions& options) {
  const FileName file = options.source_file();
  NetcdfSites cells = job.read_on_mesh(file, options.mesh, read, options.columns);
  const bool is_all = has_values && options.columns.empty() && options.mesh.empty() &&
                      file_and_variable(file).second.empty();
  if (!is_all) return cells;
  const std::optional<FieldSet> fields = fields_elsewhere(file, cells.table);
  if (!fields) return cells;
  options.field = fields->arrays.front().name;
  NetcdfSites sites = job.read_grid(file, read, {&options.field, 1});
  job.remark(file.path,
             "no field is at the " + count(cells.table.sites.size(), "center", "centers") +
                 " of cells; sites are the " + count(sites.table.sites.size(), "place", "places") +
                 " of " + options.field);
  return sites;
}

// Checks the options, reads both files, then interpolates values, makes weights, or does both.
// netCDF needs no --value: all variables at the places of the sites are carried. Throws UsageError
// for options that contradict each other, FileError for files that cannot be read.
ExitStatus run_interpolate(InterpolateOptions options) {
  const CommonOptions& common = options.common;
  const bool is_netcdf = is_netcdf_file(file_and_variable(options.source_file()).first);
  const bool has_values = !options.columns.empty() || (is_netcdf && !common.output.empty());
  require_options(options, has_values);
  Job job(common);
  ReadOptions read = common.read;
  read.keep_columns = has_values && !is_netcdf;
  require_values_on_mesh(options, is_netcdf);
  const NetcdfSites grid = read_sources(job, read, has_values, options);
  const SiteTable& table = grid.table;
  const std::optional<EdgeTable> edges = edges_of(options, table);
  const InterpolateMethod method = {options.interpolation, edges ? &*edges : nullptr};
  Targets targets = read_targets(options.target_file(), common.read, common.build.sphere.center);
  const SiteTable* const tables[] = {&table, &targets.table};
  require_angles(common.read, tables);
  for (const SiteTable* const side : tables) {
    // Files of weights have dimensions for both sides, which netCDF does not allow to be 0.
    if (!options.weights.empty() && side->sites.empty()) {
      throw FileError(side->name + ": " + no_points);
    }
  }
  if (targets.table.sites.empty()) job.remark(targets.table.name, no_points);
  InterpolateCounts counts{table.sites.size(), targets.table.sites.size(), 0, 0, 0};
  std::optional<Weights> weights;
  if (options.regrid) {
    weights = regrid_weights(job, *options.regrid, options.mesh_file(), grid, targets);
  }
  std::optional<Extrapolator> extrapolator;
  if (const auto wanted = options.extrapolate.wanted()) {
    extrapolator.emplace(
        extrapolator_to(targets, grid, common.build.sphere.center, *wanted, job.execution()));
  }
  Extrapolator* const filler = extrapolator ? &*extrapolator : nullptr;
  if (has_values && is_netcdf) {
    interpolate_fields(job, options, method, grid, targets, weights, filler, counts);
  } else if (has_values) {
    interpolate_columns(job, options, method, table, targets, weights, filler, counts);
  }
  // With --weights the report counts rows without entries instead of missing values.
  if (!options.weights.empty()) {
    write_weights_of(job, options, method, grid, targets, weights, filler, counts);
  }
  report(job, options, counts);
  return done;
}

// Adds --method, of interpolation or of regridding.
void add_method(CLI::App& parser, InterpolateOptions& options) {
  using AnyMethod = std::variant<Method, RegridMethod>;
  std::unordered_map<std::string, AnyMethod> methods;
  for (const auto& [name, method] : named_values<Method>()) methods.emplace(name, method);
  for (const std::string_view name : names_of<RegridMethod>()) {
    methods.emplace(name, *from_name<RegridMethod>(name));
  }
  const auto take = [&options, methods](const std::string& text) {
    const AnyMethod& method = methods.at(text);
    // A name is either a method of the library's interpolation or one of its regridding.
    if (const auto* regrid = std::get_if<RegridMethod>(&method)) options.regrid = *regrid;
    if (const auto* plain = std::get_if<Method>(&method)) options.interpolation.method = *plain;
  };
  parser
      .add_option_function<std::string>(
          "--method", take,
          "nearest, linear, laplace, sibson (default), hermite or cubic between any sites;\n"
          "bilinear on a grid along axes; native in the cells of the mesh of the sites; or\n"
          "nearest_d2s, each site given to its nearest target")
      ->check(one_of(keys_of(methods)))
      ->type_name("WORD");
}

// Adds how values are interpolated, also at targets outside and at sites that share a place.
void add_methods(CLI::App& parser, InterpolateOptions& options) {
  add_method(parser, options);
  const CLI::Option* const outside = add_word<Outside>(
      parser, "--outside", options.interpolation.outside, named_values<Outside>(),
      "A target in no triangle that the center sees: nan (default), nearest or error");
  const CLI::Option* const duplicates = add_word<SharedPlace>(
      parser, "--duplicates", options.interpolation.shared_place, named_values<SharedPlace>(),
      "Sites in one place: first (default: the one with the lowest number), mean or error");
  for (const CLI::Option* const option : {outside, duplicates}) {
    require_effect(
        options.common, option, [&options] { return !options.regrid; },
        "with --method bilinear, native or nearest_d2s");
  }
  add_extrapolate_options(parser, options.common, options.extrapolate);
}

// Adds the edges between sites to which linear interpolation keeps.
void add_constraints(CLI::App& parser, InterpolateOptions& options) {
  parser
      .add_option("--constraints", options.constraints,
                  "Edges between sites, across which --method linear mixes no values: .csv, two\n"
                  "columns of indices of sites from 0, as for rondel triangulate")
      ->type_name("FILE");
  parser
      .add_option("--source", options.mesh,
                  "Where INPUT has no places: netCDF with the mesh at whose nodes or cells the\n"
                  "values are")
      ->type_name("FILE");
}

// Returns the outputs that are netCDF: values, weights.
std::vector<FileName> netcdf_outputs(const InterpolateOptions& options) {
  std::vector<FileName> written = if_of_format(options.common.target(), {"nc", "nc4"});
  for (FileName& file : if_of_format(options.weights_file(), {"nc", "nc4", "esmf", "scrip"})) {
    written.push_back(std::move(file));
  }
  return written;
}

// Adds the file for the weights themselves, which may be written beside the values or instead.
void add_weight_options(CLI::App& parser, InterpolateOptions& options) {
  parser
      .add_option("--weights", options.weights,
                  "Where to write the weights: .nc or .nc4 (ESMF), .npz (scipy.sparse)")
      ->type_name("FILE");
  const CLI::Option* const weight_format =
      parser
          .add_option("--weight-format", options.weight_format,
                      "Format of the weights: esmf, scrip (for CDO) or npz")
          ->type_name("FORMAT");
  require_effect(
      options.common, weight_format, [&options] { return !options.weights.empty(); },
      "without --weights");
}

constexpr const char* end_of_help =
    "A site whose value is missing (empty, nan, NA, null) takes no part in that column, as if\n"
    "it were not in the file; weights are those of all sites. With bilinear, native and\n"
    "nearest_d2s a target that needs a missing value has none. native takes netCDF with a mesh:\n"
    "values at its nodes are interpolated in its faces, linearly in triangles and by Wachspress\n"
    "coordinates in polygons, and values at its faces between their centers. bilinear takes\n"
    "netCDF with a grid along longitudes and latitudes: between the last row and the pole of a\n"
    "grid around the globe values change linearly to the mean of that row; other targets outside\n"
    "have no value. With nearest_d2s (ESMF's nearest destination to source) a target has the sum\n"
    "of what it is given.\n"
    "Grids go from longitude -180 eastward and from the south pole northward; centers have the\n"
    "digits of an exact division, rounded once. 180 is a multiple of DEG.\n\n"
    "Examples:\n"
    "  rondel interpolate stations.csv --value temperature --to grid:1 -o grid.nc\n"
    "  rondel interpolate stations.csv --value t --to ships.csv --method linear -o ships.npy\n"
    "  rondel interpolate soundings.csv --value depth --to grid:0.1 --method linear \\\n"
    "      --constraints dikes.csv -o depth.nc\n"
    "  rondel interpolate stations.csv --to grid:360x180 --weights weights.nc\n"
    "  rondel interpolate ocean.nc:salinity --to stations.csv -o at-stations.csv\n"
    "  rondel interpolate ocean.nc --to grid.nc -o on-grid.nc4\n"
    "  rondel interpolate model.nc --to grid:1 --method bilinear -o on-grid.nc\n"
    "  rondel interpolate waves.nc:height --to grid:1 --method native \\\n"
    "      --extrapolate nearest --extrapolate-distance 50 -o on-grid.nc";

}  // namespace

Command add_interpolate_command(CLI::App& tool) {
  auto options = std::make_shared<InterpolateOptions>();
  CLI::App* parser =
      tool.add_subcommand("interpolate", "Carry values at sites to other points, or make weights");
  add_input_options(*parser, options->common, default_input_help, [given = options.get()] {
    return std::vector<FileName>{given->source_file(), given->target_file()};
  });
  add_input_file(
      *parser, "--to", options->target,
      "The targets: a file of points in the formats of INPUT, netCDF with cells, a grid\n"
      "or values at places, or the centers of the cells of a grid: grid:1, healpix:7,\n"
      "F320, O320 ... (see rondel regrid). Other columns of a table, such as names, and\n"
      "properties stand beside the values in .csv .tsv .nc .nc4 and beside the weights in .nc")
      ->type_name("TARGET");
  parser
      ->add_option(
          "--value", options->columns,
          "The column with the values, for GeoJSON a property, for netCDF a variable (default\n"
          "there: that of INPUT.nc:NAME, or all), one of several times of it as 'NAME[3]',\n"
          "'NAME[-1]' or NAME_2001-07-15; may be repeated")
      ->allow_extra_args(false)
      ->type_name("COL");
  add_output_option(*parser, options->common,
                    "Where to write the values at the targets: .csv .tsv .npy .nc .nc4");
  add_weight_options(*parser, *options);
  require_effect(
      options->common, parser->get_option("--format"),
      [given = options.get()] { return !given->common.output.empty(); }, "without --output");
  add_netcdf_options(*parser, options->common, options->netcdf,
                     [given = options.get()] { return netcdf_outputs(*given); });
  add_methods(*parser, *options);
  add_constraints(*parser, *options);
  add_build_options(*parser, options->common);
  // bilinear follows the axes of a grid, native the cells of a mesh; they need no triangulation, no
  // model and no center.
  for (const char* const name : {"--model", "--center"}) {
    require_effect(
        options->common, parser->get_option(name),
        [given = options.get()] {
          return given->regrid != RegridMethod::bilinear && given->regrid != RegridMethod::native;
        },
        "with --method bilinear or native");
  }
  add_report_options(*parser, options->common);
  parser->footer(end_of_help);
  return {parser, [options] { return run_interpolate(*options); }};
}

}  // namespace rondel::cli
