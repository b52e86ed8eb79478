// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel apply: multiplies fields at the sources of a file of weights by these weights.
// in    the weights, and fields at their sources: netCDF, .npy, or a table with a row a source
// out   the same fields at the targets, in the format of OUTPUT
// index sources: the columns of the weights; targets: their rows
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "column_values.h"
#include "job.h"
#include "process.h"
#include "report.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/fields.h"
#include "rondel/remap.h"
#include "rondel/weight_files.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel apply`.
struct ApplyCommandOptions {
  CommonOptions common;              // INPUT: the weights; output and threads
  std::string values_file;           // VALUES; "-": standard input
  std::vector<std::string> columns;  // --value
  ApplyOptions apply;                // --fill --max-missing
  NetcdfOptions netcdf;              // --kind --deflate

  // Return the two inputs with their formats; --input-format is for the one on standard input.
  [[nodiscard]] FileName weights_file() const { return common.source_beside(values_file); }
  [[nodiscard]] FileName values() const { return common.other_source(values_file); }
};

// How far a place may be from its source: longitudes of floats are off by up to 8e-6 degrees,
// tables have few digits.
constexpr double max_apart_deg = 1e-4;
// True if a longitude and latitude are a place. Files of weights have NaN, or numbers that are no
// degrees, for places that they do not know.
bool is_known(const LonLat& place) {
  return std::isfinite(place.lon_deg) && std::abs(place.lat_deg) <= 90;
}

// How many pairs of places are known on both sides, and whether these are near each other.
struct ComparedPlaces {
  // The number of compared pairs; without any, are_near says nothing.
  std::size_t count = 0;
  bool are_near = true;
};
// Compares the places that the weights give for their sources with the places of the values; the
// index of both counts sources.
ComparedPlaces compare(const std::vector<LonLat>& sources, const std::vector<Point>& places) {
  std::vector<LonLat> known;
  std::vector<Point> own;  // points of a table may be anywhere on their rays
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!is_known(sources[i]) || std::isnan(places[i].x)) continue;
    known.push_back(sources[i]);
    own.push_back(places[i]);
  }
  return {known.size(),
          std::ranges::equal(lonlats(own), known, [](const LonLat& a, const LonLat& b) {
            return is_same_place(a, b, max_apart_deg);
          })};
}

// Values that have places must have those of the weights, as far as both are known; tables the very
// numbers, if the file has nothing but their hash.
void require_places(const ApplyCommandOptions& options, const WeightFile& file,
                    const std::vector<Point>& places, bool is_table) {
  const bool are_complete =
      std::ranges::none_of(places, [](const Point& place) { return std::isnan(place.x); });
  const std::uint64_t hash = file.weights.sites_hash;
  if (hash != 0 && are_complete && point_set_hash(places) == hash) return;
  ComparedPlaces compared;
  if (file.source.points.size() == places.size()) compared = compare(file.source.points, places);
  const bool must_be_known = hash != 0 && is_table && are_complete;
  if (compared.are_near && (compared.count > 0 || !must_be_known)) return;
  throw FileError(options.values_file + ": its points are not the sources of " +
                  options.common.input + ", or not in this order");
}

// Reads the file of weights and prints the reader's remarks. Throws FileError if it cannot be read,
// or if its arrays do not fit together: an application to no fields checks them.
WeightFile readable_weights(const ApplyCommandOptions& options) {
  const CommonOptions& common = options.common;
  WeightFile file = read_weights(options.weights_file());
  tell(common.input, file.remarks);
  try {
    apply(file.weights, {}, {}, 0);
  } catch (const InvalidInput& error) {
    throw FileError(common.input + ": " + error.what());
  }
  return file;
}

// Returns the places of the sources as the file of weights gives them; an empty span if the place
// of any source is unknown.
std::span<const LonLat> places_of_sources(const WeightFile& file) {
  const std::vector<LonLat>& sources = file.source.points;
  const bool are_known = std::ranges::all_of(sources, is_known);
  return are_known ? std::span<const LonLat>(sources) : std::span<const LonLat>();
}

// Opens the file of values and finds the variables whose dimensions are those of the sources.
// `names` are the wanted variables; empty: all that fit. If no variable is at the places of the
// sources, the file is opened again without places, to say whether the points differ or a variable
// is missing. Throws FileError.
std::unique_ptr<FieldFile> open_fields(const ApplyCommandOptions& options, const WeightFile& file,
                                       const FileName& values_file,
                                       const std::vector<std::string>& names) {
  const auto open = [&](const WantedPlaces& places) {
    return std::make_unique<FieldFile>(values_file, names, file.weights.num_columns,
                                       options.common.read, file.source.shape, places);
  };
  try {
    return open({places_of_sources(file), max_apart_deg});
  } catch (const FileError&) {
    if (values_file.path == "-") throw;  // cannot be read again
    const auto elsewhere = open({});
    if (!elsewhere->fields().points.empty()) {
      require_places(options, file, elsewhere->fields().points, false);
    }
    throw;
  }
}

// True if an option names columns of a table that have places.
bool are_columns_named(const ReadOptions& read) {
  return !(read.lon + read.x + read.radius).empty();  // the others are given together with these
}

// True for a table: by its format, which on standard input may be unnamed.
bool is_table(const FileName& file) {
  const std::string format = format_of(file);
  return format == "csv" || format == "tsv" || (file.path == "-" && format.empty());
}

// The values at the sources, field by field: those of a file that is read slice by slice, or
// columns of a table in memory. An array is a variable or a column; a field is one of its slices,
// such as a time, with a value for each source.
class ValuesAtSources {
 public:
  explicit ValuesAtSources(std::unique_ptr<FieldFile> file) : file_(std::move(file)) {
    file_->keep_chunks(usual_kept_chunks);
  }
  // Takes the columns of a table, whose rows are the sources.
  ValuesAtSources(const SiteTable& table, const std::vector<std::string>& names) {
    own_.num_points = table.sites.size();
    for (const std::string& name : names) {
      own_.arrays.emplace_back().name = name;
      columns_.push_back(column_values(table, name, "--value"));
    }
  }

  [[nodiscard]] const FieldSet& fields() const { return file_ ? file_->fields() : own_; }
  // Reads fields of an array from the first one on.
  // `values` has room for whole fields, one after another; missing values are NaN.
  void read(std::size_t array, std::size_t first, std::span<double> values,
            const Execution& execution) const {
    if (file_) return file_->read(array, first, values, execution);
    std::ranges::copy(columns_[array], values.begin());
  }

 private:
  // Null for a table, whose values are in columns_.
  std::unique_ptr<FieldFile> file_;
  FieldSet own_;  // without the values
  std::vector<std::vector<double>> columns_;
};

// Leaves out the rows of a table that have no place, if the weights count the others alone, as those
// that `rondel interpolate` makes of a table do. Tells how many they are.
void keep_sources(const WeightFile& file, SiteTable& table) {
  const std::size_t num_rows = table.sites.size();
  if (num_rows == file.weights.num_columns) return;
  std::vector<bool> have_places;
  have_places.reserve(num_rows);
  for (const Point& site : table.sites) have_places.push_back(!std::isnan(site.x));
  const auto num_with = static_cast<std::size_t>(std::ranges::count(have_places, true));
  if (num_with != file.weights.num_columns) return;
  tell(table.name, {"left out " + count(num_rows - num_with, "row", "rows") +
                    " without a place, as the weights do"});
  table = table.selection(have_places);
}

// Reads a table with its columns, and without rows that are no sources.
SiteTable read_table(const ApplyCommandOptions& options, const WeightFile& file) {
  if (options.columns.empty()) throw UsageError("no column of the table is named (--value)");
  ReadOptions read = options.common.read;
  read.may_lack_places = true;
  read.keep_columns = true;
  SiteTable table = read_sites(options.values(), read);
  keep_sources(file, table);
  return table;
}

// Reads a table on standard input, which can be read once only: places and values together.
ValuesAtSources read_standard_table(const ApplyCommandOptions& options, const WeightFile& file) {
  const SiteTable table = read_table(options, file);
  if (table.sites.size() != file.weights.num_columns) {
    throw FileError(table.name + ": " + count(table.sites.size(), "row", "rows") + " for " +
                    count(file.weights.num_columns, "point", "points"));
  }
  require_places(options, file, table.sites, true);
  return {table, options.columns};
}

// Checks the places of a table, if it has any, against those of the weights. Here it is read for its
// places alone, as its values are read as fields afterwards; returns them only where the table has
// rows that are no sources.
std::optional<ValuesAtSources> check_places_of_table(const ApplyCommandOptions& options,
                                                     const WeightFile& file) {
  if (file.weights.sites_hash == 0 && file.source.points.empty()) return std::nullopt;
  ReadOptions read = options.common.read;
  read.may_lack_places = true;
  const SiteTable table = read_sites(options.values(), read);
  if (table.sites.empty()) return std::nullopt;
  if (table.sites.size() != file.weights.num_columns) {
    const SiteTable kept = read_table(options, file);
    if (kept.sites.size() == file.weights.num_columns) {
      require_places(options, file, kept.sites, true);
      return ValuesAtSources(kept, options.columns);
    }
  }
  require_places(options, file, table.sites, true);
  return std::nullopt;
}

// A slice has 32 MiB; larger ones are not faster.
constexpr std::size_t max_values = std::size_t{1} << 22U;

// The numbers of the report: fields that were written, and values at targets that are missing.
struct AppliedCounts {
  std::size_t fields = 0;
  std::size_t missing = 0;
};

// Calls `take` with the values at the targets, slice by slice in the order of a FieldWriter, so
// that fields may be larger than memory. Values that are missing are NaN.
template <typename Function>
void for_each_slice(Job& job, const ApplyCommandOptions& options, const WeightFile& file,
                    const ValuesAtSources& in, Function take) {
  const Weights& weights = file.weights;
  const auto apply_to = file.takes_largest_share ? apply_largest_share : apply;
  // A slice has as many whole fields as fit into max_values at the sources and at the targets; it
  // has one field at least.
  const std::size_t largest = std::max({weights.num_columns, weights.num_rows(), std::size_t{1}});
  const std::size_t of_slice = std::max<std::size_t>(max_values / largest, 1);
  ApplyOptions unfilled = options.apply;
  // NaN marks targets without a value here, as --fill may be a number that other targets have.
  unfilled.fill = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  std::vector<double> applied;
  for (std::size_t a = 0; a < in.fields().arrays.size(); ++a) {
    const std::size_t num_fields = in.fields().arrays[a].num_fields();
    for (std::size_t first = 0; first < num_fields; first += of_slice) {
      const std::size_t count = std::min(of_slice, num_fields - first);
      values.resize(count * weights.num_columns);
      applied.resize(count * weights.num_rows());
      in.read(a, first, values, job.execution());
      job.time(Stage::query,
               [&] { apply_to(weights, values, applied, count, unfilled, job.execution()); });
      take(std::span<double>(applied));
    }
  }
}

// True if a value that is not missing is the number that --fill gives to those that are. Then
// `_FillValue` in a file of netCDF would make it missing. This applies the weights once more.
bool has_fill_among_values(Job& job, const ApplyCommandOptions& options, const WeightFile& file,
                           const ValuesAtSources& in) {
  const double fill = options.apply.fill;
  if (std::isnan(fill) || !is_netcdf_file(options.common.target())) return false;
  bool is_found = false;
  for_each_slice(job, options, file, in, [&](std::span<double> applied) {
    is_found = is_found || std::ranges::count(applied, fill) != 0;
  });
  if (is_found) {
    tell(options.common.output,
         {"values that are not missing are the number of --fill, too: the file has no _FillValue, "
          "and does not tell which values were missing"});
  }
  return is_found;
}

// Applies the weights to all fields and writes them at the targets; missing values become the number
// of --fill.
AppliedCounts apply_all(Job& job, const ApplyCommandOptions& options, const WeightFile& file,
                        const ValuesAtSources& in) {
  FieldSet out;
  out.num_points = file.weights.num_rows();
  out.arrays = in.fields().arrays;
  const bool are_choices = file.takes_largest_share || choose_values(file.weights);
  for (FieldArray& array : out.arrays) {
    array.is_single = false;  // sums are written as doubles
    if (!are_choices) remove_flags(array);
  }
  out.axes = in.fields().axes;
  out.unlimited = in.fields().unlimited;
  out.fill = options.apply.fill;
  // The attribute `_FillValue` would also mark values that happen to be the number of --fill, so it
  // is written only if there are none.
  out.is_fill_marked = !has_fill_among_values(job, options, file, in);
  FieldWriter writer(options.common.target(), out, file.target, options.netcdf, job.execution());
  tell(writer.remarks());
  AppliedCounts counts;
  for_each_slice(job, options, file, in, [&](std::span<double> applied) {
    for (double& value : applied) {
      if (!std::isnan(value)) continue;
      value = out.fill;
      ++counts.missing;
    }
    job.time(Stage::write, [&] { writer.write(applied); });
  });
  for (const FieldArray& array : out.arrays) counts.fields += array.num_fields();
  job.time(Stage::write, [&] { writer.finish(); });
  return counts;
}

// Reads the values at the sources.
ValuesAtSources values_of(const ApplyCommandOptions& options, const WeightFile& file) {
  // A table is read as sites, so that its columns of places can be compared; other files as fields.
  const bool has_rows = is_table(options.values());
  if (!has_rows && are_columns_named(options.common.read)) {
    throw UsageError("columns of places are named, but '" + options.values_file +
                     "' is no table (.csv .tsv)");
  }
  if (has_rows && options.values_file == "-") return read_standard_table(options, file);
  if (has_rows) {
    if (std::optional<ValuesAtSources> rows = check_places_of_table(options, file)) {
      return std::move(*rows);
    }
  }
  const auto [values_file, variable] = file_and_variable(options.values());
  std::vector<std::string> names = options.columns;
  if (names.empty() && !variable.empty()) names.push_back(variable);
  ValuesAtSources in(open_fields(options, file, values_file, names));
  tell(options.values_file, in.fields().remarks);
  if (!in.fields().points.empty()) require_places(options, file, in.fields().points, false);
  return in;
}

// Reads the weights, applies them to all fields, writes these and reports the numbers. Throws
// UsageError for options that do not fit OUTPUT or VALUES, FileError where values are not at the
// sources of the weights.
ExitStatus run_apply(const ApplyCommandOptions& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_fields(common.target()), ".csv .tsv .npy .nc .nc4",
                 {{"VALUES", options.values_file}});
  Job job(common);
  WeightFile file = readable_weights(options);
  use_corners_as_bounds(file.target);
  const Weights& weights = file.weights;
  const ValuesAtSources in = values_of(options, file);
  const AppliedCounts counts = apply_all(job, options, file, in);
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {
      {"sources", weights.num_columns},
      {"targets", weights.num_rows()},
      {"entries", weights.values.size()},
      {"fields", counts.fields},
      {"missing", counts.missing},
      {"seconds", {{"apply", seconds.query}, {"write", seconds.write}, {"total", seconds.total}}},
      {"peak_memory_bytes", peak_memory_bytes()}};
  job.report(json.dump(2) + '\n', count(counts.fields, "field", "fields") + " to " +
                                      count(weights.num_rows(), "target", "targets") + ", " +
                                      std::to_string(counts.missing) + " values missing\n");
  return done;
}

// Checks the value of --fill: a finite number, or nan.
std::string fill_error(const std::string& text) {
  return text == "nan" || text == "NaN" ? std::string() : finite_error(text);
}

// Checks a share, from 0 to 1.
std::string share_error(const std::string& text) { return range_error(text, 0, 1); }

}  // namespace

Command add_apply_command(CLI::App& tool) {
  auto options = std::make_shared<ApplyCommandOptions>();
  CLI::App* parser = tool.add_subcommand("apply", "Apply a file of weights to values");
  add_weights_input(*parser, options->common,
                    ",\nor, if VALUES is -, of standard input: csv (default), tsv, npy or nc");
  add_input_file(
      *parser, "VALUES", options->values_file,
      "Values at the sources: .csv .tsv (--value), .npy of the shape (n) or\n"
      "(fields, n), or netCDF: variables with the dimensions of the sources, FILE.nc:NAME\n"
      "one of them; or - for standard input")
      ->type_name("");
  add_output_option(*parser, options->common,
                    "Where to write the values at the targets: .csv .tsv .npy .nc .nc4")
      ->required();
  parser
      ->add_option(
          "--value", options->columns,
          "A column, or a variable of netCDF (default: all that fit), one of several times of\n"
          "it as 'NAME[3]', 'NAME[-1]' or NAME_2001-07-15; may be repeated")
      ->allow_extra_args(false)
      ->type_name("COL");
  parser
      ->add_option("--fill", options->apply.fill,
                   "The value of targets that have none (default: nan); in netCDF also the\n"
                   "attribute _FillValue, unless other targets have this value")
      ->check(fill_error)
      ->type_name("VALUE");
  parser
      ->add_option("--max-missing", options->apply.max_missing,
                   "The largest share of a target's weights whose values may be missing,\n"
                   "from 0 (default) to 1; the other weights are scaled up")
      ->check(share_error)
      ->type_name("SHARE");
  add_table_options(*parser, options->common,
                    [given = options.get()] { return std::vector<FileName>{given->values()}; });
  add_netcdf_options(*parser, options->common, options->netcdf, [given = options.get()] {
    return if_of_format(given->common.target(), {"nc", "nc4"});
  });
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "netCDF is read and written slice by slice, whatever the order of its dimensions: it may\n"
      "be larger than the memory.\n\n"
      "The values are those of the sources, in their order. Where the file of weights knows the\n"
      "sources, this is held against a table's columns of longitude and latitude, or x, y, z, and\n"
      "against the longitudes and latitudes of a netCDF file: both may be 1e-4 degrees off. For\n"
      ".npy, and for files without coordinates, only the number of values is checked. The options\n"
      "for reading tables are those of rondel interpolate: --lon, --lat, --delimiter ... Weights\n"
      "that are infinite or not a number are an error, and so are coordinates that are no place.\n"
      "SCRIP's conservative weights that are areas (normalization \"none\") are divided by the "
      "areas\n"
      "of the targets.\n\n"
      "Examples:\n"
      "  rondel apply weights.nc temperature.nc -o on-grid.nc\n"
      "  rondel apply weights.nc stations.csv --value temperature -o on-grid.csv");
  return {parser, [options] { return run_apply(*options); }};
}

}  // namespace rondel::cli
