// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arguments and the help of the commands that move values between sites or cells.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <variant>

#include "netcdf_options.h"
#include "remap.h"
#include "table_options.h"
#include "validate.h"
#include "words.h"

namespace rondel::cli {
namespace {

// Checks the value of --fill: a finite number, or nan.
std::string fill_error(const std::string& text) {
  return text == "nan" || text == "NaN" ? std::string() : finite_error(text);
}

// Checks a share, from 0 to 1.
std::string share_error(const std::string& text) { return range_error(text, 0, 1); }

// Adds --value, which may be repeated; each names one column or variable.
void add_values(CLI::App& parser, std::vector<std::string>& columns, const std::string& what) {
  parser.add_option("--value", columns, what)->allow_extra_args(false)->type_name("COL");
}

// Adds a required file beside INPUT, which may be standard input.
CLI::Option* add_second_input(CLI::App& parser, const std::string& name, std::string& file,
                              const std::string& what) {
  const auto take = [&file](const std::string& text) { file = standard(text, "/dev/stdin"); };
  return parser.add_option_function<std::string>(name, take, what)->required();
}

// Adds the file of weights as INPUT. `of_others` ends the help of --input-format.
void add_weights_input(CLI::App& parser, CommonOptions& options, const std::string& of_others) {
  parser
      .add_option("WEIGHTS", options.input,
                  "The weights: netCDF (ESMF or SCRIP) or .npz (scipy.sparse)")
      ->required()
      ->type_name("");
  parser
      .add_option("--input-format", options.input_format,
                  "Format of WEIGHTS: esmf, scrip or npz (default: by its ending)" + of_others)
      ->type_name("FORMAT");
}

// Adds --method, of interpolation or of regridding.
void add_method(CLI::App& parser, InterpolateOptions& options) {
  using AnyMethod = std::variant<Method, RegridMethod>;
  std::unordered_map<std::string, AnyMethod> methods;
  for (const auto& [name, method] : named_values<Method>()) methods.emplace(name, method);
  for (const auto& [name, method] : named_values<RegridMethod>()) methods.emplace(name, method);
  const auto take = [&options, methods](const std::string& text) {
    const AnyMethod& method = methods.at(text);
    if (const auto* regrid = std::get_if<RegridMethod>(&method)) options.regrid = *regrid;
    if (const auto* plain = std::get_if<Method>(&method)) options.interpolation.method = *plain;
  };
  parser
      .add_option_function<std::string>(
          "--method", take,
          "nearest, linear, laplace, sibson (default), hermite or cubic between any sites;\n"
          "bilinear on a grid along axes; or nearest_d2s, each site given to its nearest target")
      ->check([methods](const std::string& text) {
        return methods.contains(text) ? std::string() : "'" + text + "' is not a choice";
      })
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
        "with --method bilinear or nearest_d2s");
  }
}

}  // namespace

Command add_apply_command(CLI::App& tool) {
  auto options = std::make_shared<ApplyCommandOptions>();
  CLI::App* parser = tool.add_subcommand("apply", "Apply a file of weights to values");
  add_weights_input(*parser, options->common,
                    ",\nor, if VALUES is -, of standard input: csv (default), tsv, npy or nc");
  add_second_input(
      *parser, "VALUES", options->values_file,
      "Values at the sources: .csv .tsv (--value), .npy of the shape (n) or\n"
      "(fields, n), or netCDF: variables with the dimensions of the sources, FILE.nc:NAME\n"
      "one of them; or - for standard input")
      ->type_name("");
  add_output_option(*parser, options->common,
                    "Where to write the values at the targets: .csv .tsv .npy .nc .nc4")
      ->required();
  add_values(*parser, options->columns,
             "A column, or a variable of netCDF (default: all that fit), one of several times of\n"
             "it as 'NAME[3]', 'NAME[-1]' or NAME_2001-07-15; may be repeated");
  parser
      ->add_option("--fill", options->apply.fill,
                   "The value of targets that have none (default: nan); in netCDF also the\n"
                   "attribute _FillValue, unless other targets have this value")
      ->check(fill_error)
      ->type_name("VALUE");
  parser
      ->add_option("--most-missing", options->apply.most_missing,
                   "Values may be missing that have up to this share of a target's weights,\n"
                   "from 0 (default) to 1; the other weights are scaled up")
      ->check(share_error)
      ->type_name("SHARE");
  add_table_options(*parser, options->common,
                    [given = options.get()] { return std::vector<FileName>{given->values()}; });
  add_netcdf_options(*parser, options->common, options->netcdf, [given = options.get()] {
    return output_of_format(given->common, {"nc", "nc4"});
  });
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "netCDF is read and written slice by slice, whatever the order of its dimensions: it may\n"
      "be larger than the memory.\n\n"
      "The values are those of the sources, in their order. Where the file of weights knows the\n"
      "sources, this is held against a table's columns of longitude and latitude, or x, y, z, and\n"
      "against the longitudes and latitudes of a netCDF file: both may be 1e-4 degrees off. Of\n"
      ".npy, and of files without coordinates, only the number of the values is. What reads the\n"
      "table is told as for rondel interpolate: --lon, --lat, --delimiter ... Weights that are\n"
      "infinite or not a number are an error, and so are places that are none. SCRIP's\n"
      "conservative weights that are areas (normalization \"none\") are divided by the areas of\n"
      "the targets.\n\n"
      "Examples:\n"
      "  rondel apply weights.nc temperature.nc -o on-grid.nc\n"
      "  rondel apply weights.nc stations.csv --value temperature -o on-grid.csv");
  return {parser, [options] { return run_apply(*options); }};
}

Command add_check_weights_command(CLI::App& tool) {
  auto options = std::make_shared<CheckWeightsOptions>();
  CLI::App* parser = tool.add_subcommand("check-weights", "Check a file of weights");
  add_weights_input(*parser, options->common, "");
  parser->add_flag("--allow-negative", options->check.allow_negative,
                   "Negative weights are right whatever the file says of its method");
  add_report_options(*parser, options->common);
  parser->footer(
      "A file is wrong if\n"
      "- a weight is not finite, or a source stands twice in one row;\n"
      "- a row with entries does not sum up to 1 or, normalized by destarea, to the fraction\n"
      "  of its target; where sources are given to their nearest targets (nearest_d2s, nearest\n"
      "  destination to source), a source with entries is not given away as a whole, once;\n"
      "- a fraction is above 1, negative or not a number, or an area negative or not finite;\n"
      "- cells of a conservative method with entries have no areas, or areas that are all 0, but\n"
      "  those of the other side have some;\n"
      "- a weight is negative although the method is an average: conservative of first order,\n"
      "  nearest, linear, laplace, sibson, largest share. Weights of second order, bilinear,\n"
      "  patch, hermite and cubic may be negative, and those of methods that are not known;\n"
      "- a cell that the file masks has a weight other than 0;\n"
      "- a conservative method gives nothing to a target with a fraction, or takes of a source\n"
      "  another area than its own times its fraction.\n"
      "Sums and fractions may be off by 1e-9 + (m + 1) 8 pi 2^-52 / A: m is the number of\n"
      "entries of the row or column, A the area of the cell in steradians, where it is known,\n"
      "and 8 pi 2^-52 what rounding makes of an area that is a difference of angles.\n\n"
      "Each kind of fault is one line with its number and the first place. Exit status: 0 if\n"
      "nothing is wrong, 1 if something is or the file cannot be read. Told, but not judged:\n"
      "empty rows, the range, and the length of u x (sum of w x), u a target and x the sources\n"
      "(with points).\n\n"
      "Example:\n"
      "  rondel check-weights weights.nc");
  return {parser, [options] { return run_check_weights(*options); }};
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

Command add_interpolate_command(CLI::App& tool) {
  auto options = std::make_shared<InterpolateOptions>();
  CLI::App* parser =
      tool.add_subcommand("interpolate", "Carry values at sites to other points, or make weights");
  add_input_options(*parser, options->common, default_input_help, [given = options.get()] {
    return std::vector<FileName>{given->source_file(), given->target_file()};
  });
  add_second_input(
      *parser, "--to", options->target,
      "The targets: a file of points in the formats of INPUT, netCDF with cells, a grid\n"
      "or values at places, or the centers of the cells of a grid, grid:DEG or\n"
      "grid:NLONxNLAT")
      ->type_name("TARGET");
  add_values(*parser, options->columns,
             "The column with the values, for GeoJSON a property, for netCDF a variable (default\n"
             "there: that of INPUT.nc:NAME, or all), one of several times of it as 'NAME[3]',\n"
             "'NAME[-1]' or NAME_2001-07-15; may be repeated");
  add_output_option(*parser, options->common,
                    "Where to write the values at the targets: .csv .tsv .npy .nc .nc4");
  add_weight_options(*parser, *options);
  require_effect(
      options->common, parser->get_option("--format"),
      [given = options.get()] { return !given->common.output.empty(); }, "without --output");
  add_netcdf_options(*parser, options->common, options->netcdf, [given = options.get()] {
    CommonOptions weights;
    weights.output = given->weights;
    weights.output_format = given->weight_format;
    std::vector<FileName> written = output_of_format(given->common, {"nc", "nc4"});
    for (FileName& file : output_of_format(weights, {"nc", "nc4", "esmf", "scrip"})) {
      written.push_back(std::move(file));
    }
    return written;
  });
  add_methods(*parser, *options);
  add_build_options(*parser, options->common);
  for (const char* const name : {"--model", "--center"}) {
    require_effect(
        options->common, parser->get_option(name),
        [given = options.get()] { return given->regrid != RegridMethod::bilinear; },
        "with --method bilinear");
  }
  add_report_options(*parser, options->common);
  parser->footer(
      "A site whose value is missing (empty, nan, NA, null) takes no part in that column, as if\n"
      "it were not in the file; weights are those of all sites. With bilinear and nearest_d2s a\n"
      "target that needs a missing value has none. bilinear takes netCDF with a grid along\n"
      "longitudes and latitudes: between the last row and the pole of a grid around the globe it\n"
      "goes to the mean of that row; other targets outside have no value. With nearest_d2s\n"
      "(ESMF's nearest destination to source) a target has the sum of what it is given. Grids go "
      "from longitude -180\n"
      "eastward and from the south pole northward; centers have the digits of an exact\n"
      "division, rounded once. DEG divides 180.\n\n"
      "Examples:\n"
      "  rondel interpolate stations.csv --value temperature --to grid:1 -o grid.nc\n"
      "  rondel interpolate stations.csv --value t --to ships.csv --method linear -o ships.npy\n"
      "  rondel interpolate stations.csv --to grid:360x180 --weights weights.nc\n"
      "  rondel interpolate ocean.nc:salinity --to stations.csv -o at-stations.csv\n"
      "  rondel interpolate ocean.nc --to grid.nc -o on-grid.nc4\n"
      "  rondel interpolate model.nc --to grid:1 --method bilinear -o on-grid.nc");
  return {parser, [options] { return run_interpolate(*options); }};
}

// Adds the options of grids and polygons, and of cells that are computed.
void add_kinds_of_sides(CLI::App& parser, RemapCommandOptions& options) {
  const CLI::Option* const sides = add_word<GridSides>(
      parser, "--sides", options.cells.sides,
      {{"parallels", GridSides::parallels}, {"great-circles", GridSides::great_circles}},
      "What cells of grids have in the north and south: parallels (default) or\n"
      "great-circles (ESMF's)");
  const CLI::Option* const edges = add_word<PolygonEdges>(
      parser, "--edges", options.cells.edges, named_values<PolygonEdges>(),
      "What joins positions of polygons: lonlat (default; straight in longitude and\n"
      "latitude, RFC 7946) or geodesic (great circles)");
  const auto has_side = [&options](CellForm form) {
    return form_of(options.source_file()) == form || form_of(options.target_file()) == form;
  };
  require_effect(
      options.common, sides,
      [has_side] { return has_side(CellForm::grid) || has_side(CellForm::netcdf); },
      "without a grid");
  require_effect(
      options.common, edges, [has_side] { return has_side(CellForm::polygons); },
      "without polygons in .geojson");
  add_build_options(parser, options.common);
  for (const char* const name : {"--model", "--center"}) {
    require_effect(
        options.common, parser.get_option(name), [has_side] { return has_side(CellForm::sites); },
        "without sites, whose cells are computed");
  }
}

Command add_remap_command(CLI::App& tool) {
  auto options = std::make_shared<RemapCommandOptions>();
  CLI::App* parser = tool.add_subcommand("remap", "Make conservative weights between cells");
  add_input_options(
      *parser, options->common,
      "The cells that have the values: netCDF with those of a model or a grid, grid:DEG or\n"
      "grid:NLONxNLAT, .geojson with polygons, or a file of sites, whose Voronoi cells\n"
      "they are: .csv .tsv .xyz .txt .npy, or - for standard input",
      [given = options.get()] {
        std::vector<FileName> sites = {given->source_file(), given->target_file()};
        std::erase_if(sites, [](const FileName& file) { return form_of(file) != CellForm::sites; });
        return sites;
      });
  add_second_input(*parser, "TARGET", options->target,
                   "The cells that want them, in the same forms")
      ->type_name("");
  add_output_option(
      *parser, options->common,
      "Where to write the weights: .nc (ESMF; --format scrip for CDO), .nc4, .npz (SciPy)")
      ->required();
  add_netcdf_options(*parser, options->common, options->netcdf, [given = options.get()] {
    return output_of_format(given->common, {"nc", "nc4", "esmf", "scrip"});
  });
  add_word<unsigned>(
      *parser, "--order", options->remap.order, {{"1", 1U}, {"2", 2U}},
      "1 (default): the field is constant in each source; 2: it has a gradient there");
  add_word<RemapNorm>(
      *parser, "--norm", options->remap.norm, named_values<RemapNorm>(),
      "What sums are divided by: destarea (default: the target's area, so integrals are\n"
      "kept) or fracarea (the part that sources cover, so constants are)");
  add_word<CellOverlap>(
      *parser, "--overlap", options->remap.overlap, named_values<CellOverlap>(),
      "What becomes of a place that several cells of one side have: error (default: two of\n"
      "them are named), first (the cell with the lowest number has it) or share (each has its\n"
      "part)");
  add_kinds_of_sides(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "netCDF may be UGRID, SCRIP, ESMF, MPAS, ICON, or a grid of CF; netCDF-4 is read by the\n"
      "library netCDF-C. Cells that the file masks take no part.\n\n"
      "Examples:\n"
      "  rondel remap ocean.nc grid:1 -o weights.nc\n"
      "  rondel remap stations.csv countries.geojson --norm fracarea -o weights.npz\n"
      "  rondel remap grid:0.25 icon.nc --order 2 -o weights.nc --format scrip");
  return {parser, [options] { return run_remap(*options); }};
}

}  // namespace rondel::cli
