// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "rondel/named_grids.h"
#include "rondel/read_cells.h"
#include "validate.h"

namespace rondel::cli {
namespace {

constexpr const char* letters = "abcdefghijklmnopqrstuvwxyz";

// The name of a check begins with this if its other words are those that the check lets through.
constexpr std::string_view mark_of_words = "one of";

// Adds an option that names a column of a table.
CLI::Option* add_column(CLI::App& command, const char* name, std::string& target,
                        const char* what) {
  return command.add_option(name, target, what)
      ->type_name("COL")
      ->group("Columns, where their names in the header are not the usual ones");
}

// Adds --x, --y and --z, which are given together or not at all; returns --x.
CLI::Option* add_xyz(CLI::App& command, ReadOptions& read) {
  CLI::Option* x =
      add_column(command, "--x", read.x, "x coordinate (usual: x); --x, --y and --z go together");
  CLI::Option* y = add_column(command, "--y", read.y, "y coordinate (usual: y)");
  CLI::Option* z = add_column(command, "--z", read.z, "z coordinate (usual: z)");
  x->needs(y)->needs(z);
  y->needs(x);
  z->needs(x);
  return x;
}

// Returns true if the command line says how to read this file: it is no netCDF and no grid.
bool may_be_table(const FileName& file) {
  return !file.path.empty() && !NamedGrid::is_name(file.path) &&
         !is_netcdf_file(file_and_variable(file).first);
}

bool is_unnamed_input(const FileName& file) { return file.path == "-" && file.format.empty(); }

// True if a file has fields with a delimiter between them; standard input is .csv by default.
bool has_delimiter(const FileName& file) {
  const std::string format = is_unnamed_input(file) ? "csv" : format_of(file);
  return may_be_table(file) && (format == "csv" || format == "tsv");
}

// True if at least one of the files is a table, whose columns the options may name.
bool has_table(const TablesRead& tables) { return std::ranges::any_of(tables(), may_be_table); }

// Adds the options for longitude and latitude, which exclude those for x, y, z.
void add_columns(CLI::App& command, ReadOptions& read) {
  CLI::Option* lon =
      add_column(command, "--lon", read.lon, "Longitude (usual: lon, lng, long, longitude)");
  CLI::Option* lat = add_column(command, "--lat", read.lat, "Latitude (usual: lat, latitude)");
  CLI::Option* x = add_xyz(command, read);
  lon->needs(lat)->excludes(x);
  lat->needs(lon);
  command.add_flag("--radians", read.radians, "Longitude, latitude and radius are in radians")
      ->excludes(x);
}

// Adds INPUT and --input-format; standard input has no ending that would tell its format.
void add_input(CLI::App& command, CommonOptions& options, const std::string& what) {
  command
      .add_option_function<std::string>(
          "INPUT",
          [&options](const std::string& name) { options.input = standard(name, "/dev/stdin"); },
          what)
      ->required()
      ->type_name("");
  command
      .add_option("--input-format", options.input_format,
                  "Format of standard input (default: geojson if it begins with {, else csv) or,\n"
                  "where that is not read, of INPUT (default: by its ending)")
      ->type_name("FORMAT");
}

// Adds --delimiter, which replaces the comma of .csv and the tab of .tsv.
void add_delimiter(CLI::App& command, CommonOptions& options) {
  command
      .add_option_function<std::string>(
          "--delimiter",
          [&options](const std::string& text) {
            const bool is_tab = text == "tab" || text == "\\t";
            if (!is_tab && text.size() != 1) {
              throw UsageError("--delimiter: '" + text + "' is neither one character nor 'tab'");
            }
            options.read.delimiter = is_tab ? '\t' : text.front();
          },
          "Between the fields of .csv and .tsv: one character, or 'tab'")
      ->type_name("C");
}

// Adds --radius: sites with a radius are circles, so that it implies the weighted model.
void add_radius(CLI::App& command, CommonOptions& options) {
  command
      .add_option_function<std::string>(
          "--radius",
          [&options](const std::string& column) {
            options.read.radius = column;
            options.build.model = Model::weighted;
          },
          "Angular radius, at least 0 and less than 90 degrees: the sites are circles\n"
          "and the model is weighted. In .geojson a property")
      ->type_name("COL");
}

}  // namespace

std::string standard(const std::string& name, const char* stream) {
  return name == stream ? "-" : name;
}

void add_input_options(CLI::App& command, CommonOptions& options, const std::string& what,
                       const TablesRead& tables) {
  add_input(command, options, what);
  const TablesRead input = [&options] { return std::vector<FileName>{options.source()}; };
  add_table_options(command, options, tables ? tables : input);
}

void require_angles(const ReadOptions& read, std::span<const SiteTable* const> tables) {
  const auto has_angles = [](const SiteTable* table) {
    return table->sites.empty() || table->is_lonlat() || !table->radii_deg.empty();
  };
  if (!read.radians || std::ranges::any_of(tables, has_angles)) return;
  throw UsageError("--radians has no effect on x, y, z: " + tables.front()->name +
                   " has no angles");
}

CLI::Validator one_of(const std::vector<std::string>& words, const std::string& otherwise) {
  std::string name(mark_of_words);
  for (const std::string& word : words) name += ' ' + word;
  std::string wrong = otherwise;
  if (wrong.empty()) {
    wrong = "is none of ";
    for (const std::string& word : words) {
      if (&word != &words.front()) wrong += ", ";
      wrong += word;
    }
  }
  const auto check = [words, wrong](const std::string& text) {
    return std::ranges::count(words, text) != 0 ? std::string() : "'" + text + "' " + wrong;
  };
  return {check, {}, name};
}

std::vector<std::string> words_of(CLI::Option& option) {
  std::string name;
  try {
    name = option.get_validator(0)->get_name();
  } catch (const CLI::OptionNotFound&) {
    return {};  // it has no check at all
  }
  if (!name.starts_with(mark_of_words)) return {};
  std::vector<std::string> words;
  std::istringstream text(name.substr(mark_of_words.size()));
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

void require_effect(CommonOptions& options, const CLI::Option* option,
                    std::function<bool()> has_effect, std::string otherwise) {
  options.effects.push_back({option, std::move(has_effect), std::move(otherwise)});
}

void add_table_options(CLI::App& command, CommonOptions& options, const TablesRead& tables) {
  add_delimiter(command, options);
  add_radius(command, options);
  add_columns(command, options.read);
  const std::string otherwise = "on netCDF and grids, which are no tables";
  for (const char* const name : {"--delimiter", "--radians", "--x"}) {
    require_effect(
        options, command.get_option(name), [tables] { return has_table(tables); }, otherwise);
  }
  require_effect(
      options, command.get_option("--delimiter"),
      [tables] { return std::ranges::any_of(tables(), has_delimiter); },
      "on files other than .csv and .tsv");
  require_effect(
      options, command.get_option("--lon"), [tables] { return has_table(tables); },
      otherwise + "; INPUT.nc:NAME chooses one of several coordinates of netCDF");
  require_effect(
      options, command.get_option("--radius"),
      [tables] {
        const std::vector<FileName> files = tables();
        return !files.empty() && may_be_table(files.front());
      },
      "on netCDF and grids; circles are read from tables");
}

void add_point_input_options(CLI::App& command, CommonOptions& options) {
  add_input(command, options,
            "The points, x, y, z: .csv .tsv .xyz .txt .npy, or - for standard input");
  add_delimiter(command, options);
  add_xyz(command, options.read);
}

CLI::Option* add_output_option(CLI::App& command, CommonOptions& options, const std::string& what) {
  // The first ending in the help text serves as an example of a format.
  const std::size_t dot = what.find(" .") + 2;
  const std::string example = what.substr(dot, what.find_first_not_of(letters, dot) - dot);
  command
      .add_option(
          "--format", options.output_format,
          "Format of the output, '" + example + "' for example (default: by the ending of FILE)")
      ->type_name("FORMAT");
  return command
      .add_option_function<std::string>(
          "-o,--output",
          [&options](const std::string& name) { options.output = standard(name, "/dev/stdout"); },
          what)
      ->type_name("FILE");
}

bool is_geojson(const FileName& file) {
  const std::string format = format_of(file);
  return format == "geojson" || format == "json";
}

bool is_of_gdal(const FileName& file) {
  static constexpr std::array<std::string_view, 4> formats = {"gpkg", "fgb", "shp", "parquet"};
  return std::ranges::count(formats, format_of(file)) > 0;
}

bool may_have_features(const FileName& file) {
  return is_geojson(file) || is_unnamed_input(file) || is_of_gdal(file);
}

FileName CommonOptions::source_beside(const std::string& other) const {
  return {input, other == "-" && input != "-" ? std::string() : input_format};
}

FileName CommonOptions::other_source(const std::string& other) const {
  return {other, other == "-" && input != "-" ? input_format : std::string()};
}

void add_build_options(CLI::App& command, CommonOptions& options) {
  command
      .add_option_function<std::string>(
          "--model",
          [&options](const std::string& text) {
            options.build.model = from_name<Model>(text).value();
            if (options.build.model == Model::projected && !options.read.radius.empty()) {
              throw UsageError("--radius: circles need --model weighted, not projected");
            }
          },
          "projected: every site is moved along its ray to the sphere (default).\n"
          "weighted (implied by --radius): a site off the sphere is a circle; sites inside\n"
          "the convex hull are hidden, and cells are power (Laguerre) cells")
      ->check(one_of({"projected", "weighted"}, "is not a model (projected, weighted)"))
      ->type_name("MODEL");
  command
      .add_option_function<std::vector<double>>(
          "--center",
          [&options](const std::vector<double>& at) {
            options.build.sphere.center = {at[0], at[1], at[2]};
            if (!options.read.radius.empty()) {
              throw UsageError("--radius: circles are on a sphere around 0 0 0, without --center");
            }
          },
          "Center of the sphere (default: 0 0 0)")
      ->expected(3)
      ->check(finite_error)
      ->type_name("X Y Z");
  CLI::Option* const squared_radius =
      command
          .add_option("--squared-radius", options.build.sphere.squared_radius,
                      "Squared radius of the sphere (default: 1); for --model weighted")
          ->check(positive_error)
          ->type_name("R2");
  // `rondel info` reports distances from the sphere, for which every model needs the radius.
  const bool is_measured = command.get_name() == "info";
  require_effect(
      options, squared_radius,
      [&options, is_measured] {
        return is_measured ||
               (options.build.model == Model::weighted && options.read.radius.empty());
      },
      "without --model weighted, and on circles, whose sphere has the radius 1");
  add_threads_option(command, options);
}

void add_threads_option(CLI::App& command, CommonOptions& options) {
  command
      .add_option("--threads", options.threads, "Number of threads (default: one for each core)")
      ->check([](const std::string& text) { return whole_error(text, 1, 1024); })
      ->type_name("N");
}

void add_report_options(CLI::App& command, CommonOptions& options) {
  command.add_flag("--json", options.json, "Print one JSON object instead of the summary");
  command.add_flag("--quiet", options.quiet, "Print no summary and show no progress");
  command.callback([&options] {
    for (const OptionEffect& effect : options.effects) {
      if (effect.option->count() == 0 || effect.has_effect()) continue;
      throw UsageError("--" + effect.option->get_lnames().front() + " has no effect " +
                       effect.otherwise);
    }
  });
}

void require_array(const char* option, const std::string& path) {
  const std::string ending = format_of(path);
  if (ending.empty() || ending == "npy") return;
  throw UsageError(std::string(option) + ": the ending of '" + path + "' is not .npy");
}

void require_output(const CommonOptions& options, bool is_known, const std::string& endings,
                    const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  if (!is_known && !options.output_format.empty()) {
    throw UsageError("--format: '" + options.output_format + "' is not one of " + endings);
  }
  if (!is_known && options.output == "-") {
    throw UsageError("--output: standard output needs --format, one of " + endings);
  }
  if (!is_known) {
    throw UsageError("--output: the ending of '" + options.output + "' is not one of " + endings +
                     "; --format names one");
  }
  if (options.json && options.output == "-") {
    throw UsageError("--json: standard output has the output; name a file");
  }
  std::vector<NamedFile> read = {{"INPUT", options.input}};
  read.insert(read.end(), inputs.begin(), inputs.end());
  std::vector<NamedFile> written = {{"--output", options.output}};
  written.insert(written.end(), outputs.begin(), outputs.end());
  require_separate_files(read, written);
}

CLI::Option* add_edges_option(CLI::App& parser, PolygonEdges& target, const std::string& of) {
  return add_word<PolygonEdges>(parser, "--edges", target, named_values<PolygonEdges>(),
                                "What joins positions of " + of +
                                    ": lonlat (default; straight in longitude and\n"
                                    "latitude, RFC 7946) or geodesic (great circles)");
}

CLI::Option* add_invalid_option(CLI::App& parser, InvalidPolygons& target,
                                const std::string& what) {
  return add_word<InvalidPolygons>(parser, "--invalid", target, named_values<InvalidPolygons>(),
                                   "What becomes of " + what +
                                       " that are not valid: error (default) or repair\n"
                                       "(as 'rondel repair' does)");
}

CLI::Option* add_corners_option(CLI::App& parser, MissingCorners& target) {
  return add_word<MissingCorners>(
      parser, "--corners", target, named_values<MissingCorners>(),
      "What to do where longitudes and latitudes of two dimensions have no bounds: error\n"
      "(default), or made: corners of cells half way between the centers");
}

CLI::Option* add_input_file(CLI::App& parser, const std::string& name, std::string& file,
                            const std::string& what) {
  const auto take = [&file](const std::string& text) { file = standard(text, "/dev/stdin"); };
  return parser.add_option_function<std::string>(name, take, what)->required();
}

void add_feature_files(CLI::App& parser, CommonOptions& options) {
  add_input_file(parser, "INPUT", options.input,
                 "The features: .geojson, with GDAL installed .gpkg .fgb .shp .parquet; or - for\n"
                 "standard input")
      ->type_name("");
  add_polygon_format_option(parser, options);
  add_output_option(parser, options,
                    "Where to write the features: .geojson; with GDAL installed .gpkg .fgb\n"
                    ".parquet")
      ->required();
}

void add_polygon_format_option(CLI::App& parser, CommonOptions& options) {
  parser
      .add_option("--input-format", options.input_format,
                  "Format of standard input (default: geojson if it begins with {, else csv), or\n"
                  "of INPUT: geojson csv tsv xyz txt npy")
      ->type_name("FORMAT");
}

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

void add_netcdf_options(CLI::App& parser, CommonOptions& common, NetcdfOptions& options,
                        const std::function<std::vector<FileName>()>& written) {
  std::unordered_map<std::string, NetcdfKind> kinds = named_values<NetcdfKind>();
  kinds.erase("by-name");
  const CLI::Option* const kind = add_word<NetcdfKind>(
      parser, "--kind", options.kind, kinds,
      "The kind of netCDF: nc4 (netCDF-4, compressed), cdf5, or cdf2 (64-bit offset; less than\n"
      "4 GiB a variable); default: nc4 for names that end in .nc4, or a classic kind that fits");
  const CLI::Option* const deflate =
      parser
          .add_option("--deflate", options.deflate,
                      "How much effort the compression of nc4 takes, 0 (none) to 9 (default: 1)")
          ->check(CLI::Range(0, 9).description(""))
          ->type_name("N");
  require_effect(
      common, kind,
      [written, &options] {
        const std::vector<FileName> files = written();
        for (const FileName& file : files) {
          const bool is_netcdf4 = format_of(file) == "nc4" || format_of(file.path) == "nc4";
          if (!is_netcdf4 || options.kind == NetcdfKind::netcdf4) continue;
          throw UsageError("--kind: " + std::string(name_of(options.kind)) + " contradicts '" +
                           (file.format.empty() ? file.path : file.format) + "', netCDF-4");
        }
        return !files.empty();
      },
      "on files other than netCDF");
  require_effect(
      common, deflate,
      [written, &options] {
        const std::vector<FileName> files = written();
        return std::ranges::any_of(files, [&](const FileName& file) {
          const bool is_by_name = options.kind == NetcdfKind::by_name;
          return is_by_name ? format_of(file) == "nc4" : options.kind == NetcdfKind::netcdf4;
        });
      },
      "without --kind nc4 or the ending .nc4: other files are not compressed");
}

std::vector<FileName> if_of_format(const FileName& file,
                                   std::initializer_list<std::string_view> formats) {
  const bool is_one = std::ranges::find(formats, format_of(file)) != formats.end();
  return is_one ? std::vector<FileName>{file} : std::vector<FileName>();
}

}  // namespace rondel::cli
