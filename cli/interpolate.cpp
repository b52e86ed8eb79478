// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel interpolate: columns of values at sites, carried to other points.
#include "rondel/interpolate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "column_values.h"
#include "command.h"
#include "process.h"
#include "report.h"
#include "targets.h"
#include "value_table.h"

namespace rondel::cli {
namespace {

template <class Choice>
using Names = std::vector<std::pair<std::string, Choice>>;

const Names<Method>& methods() {
  static const Names<Method> names = {{"nearest", Method::nearest}, {"linear", Method::linear},
                                      {"laplace", Method::laplace}, {"sibson", Method::sibson},
                                      {"hermite", Method::hermite}, {"cubic", Method::cubic}};
  return names;
}

struct InterpolateOptions {
  CommonOptions common;
  std::vector<std::string> values;  // --value: columns
  std::string targets;              // --to
  InterpolationOptions how;         // --method --outside --duplicates
};

std::vector<bool> present(const std::vector<double>& values) {
  std::vector<bool> is_present;
  is_present.reserve(values.size());
  for (const double value : values) is_present.push_back(!std::isnan(value));
  return is_present;
}

// The sites that have a value, in places of their own.
SiteTable sites_with(const SiteTable& table, const std::vector<bool>& is_present) {
  SiteTable kept;
  kept.name = table.name;
  kept.first_line = table.first_line;
  for (std::size_t i = 0; i < table.sites.size(); ++i) {
    if (!is_present[i]) continue;
    kept.sites.push_back(table.sites[i]);
    if (table.is_lonlat()) kept.positions.push_back(table.positions[i]);
    if (table.first_line > 0 || !table.lines.empty())
      kept.lines.push_back(table.lines.empty() ? table.first_line + i : table.lines[i]);
  }
  return kept;
}

class InterpolateJob {
 public:
  explicit InterpolateJob(const InterpolateOptions& options)
      : options_(completed(options)), job_(options_.common) {
    const CommonOptions& common = options_.common;
    const std::string format = common.format();
    require_output(common, format == "csv" || format == "tsv" || format == "npy", ".csv .tsv .npy");
    if (common.build.model == Model::weighted && options_.how.method != Method::nearest)
      throw UsageError("--method: weighted sites have 'nearest' only");
  }

  void run() {
    read();
    for (const std::string& name : options_.values) {
      answers_.push_back({name, {}});
      fields_.push_back(column_values(sites_, name, "--value"));
    }
    // Columns that miss values at the same sites share a triangulation.
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (answers_[i].values.empty()) answer_from(i);
    }
    write();
    report();
  }

 private:
  static InterpolateOptions completed(InterpolateOptions options) {
    CommonOptions& common = options.common;
    common.read.keep_columns = true;
    if (common.output == "-" && common.output_format.empty()) common.output_format = "csv";
    return options;
  }

  void read() {
    sites_ = job_.read();
    ReadOptions read = options_.common.read;
    read.radius.clear();
    read.keep_columns = false;
    targets_ = read_targets(job_, options_.targets, read);
  }

  void answer_from(std::size_t first) {
    const std::vector<bool> is_present = present(fields_[first]);
    const SiteTable kept = sites_with(sites_, is_present);
    std::vector<std::size_t> columns;
    std::vector<double> values;
    for (std::size_t i = first; i < fields_.size(); ++i) {
      if (present(fields_[i]) != is_present) continue;
      columns.push_back(i);
      std::ranges::copy_if(fields_[i], std::back_inserter(values),
                           [](double v) { return !std::isnan(v); });
    }
    const std::vector<double> found = interpolated(kept, values);
    const auto size = static_cast<std::ptrdiff_t>(targets_.table.sites.size());
    auto begin = found.begin();
    for (const std::size_t i : columns) {
      answers_[i].values.assign(begin, begin + size);
      begin += size;
    }
  }

  std::vector<double> interpolated(const SiteTable& kept, const std::vector<double>& values) {
    const Triangulation triangulation = job_.triangulate(kept);
    const auto& duplicates = triangulation.duplicates();
    if (options_.how.shared_place == SharedPlace::error && !duplicates.empty()) {
      throw FileError(kept.where(duplicates.front().site) + ": the place of " +
                      kept.where(duplicates.front().representative));
    }
    std::vector<double> found;
    job_.time(Stage::query, [&] {
      const Interpolator interpolator(triangulation);
      found = with_places(targets_.table, [&] {
        return interpolator.values(values, targets_.table.sites, options_.how, job_.execution());
      });
    });
    return found;
  }

  void write() {
    job_.time(Stage::write, [&] {
      if (options_.common.format() == "npy") {
        write_array(options_.common.output, answers_, targets_.shape);
      } else {
        const char separator = options_.common.format() == "tsv" ? '\t' : ',';
        write_file(options_.common.output, table_of(targets_.table, answers_, separator));
      }
    });
  }

  void report() {
    const Seconds seconds = job_.seconds();
    const auto method =
        std::ranges::find(methods(), options_.how.method, &std::pair<std::string, Method>::second);
    nlohmann::ordered_json json = {{"sites", sites_.sites.size()},
                                   {"targets", targets_.table.sites.size()},
                                   {"method", method->first}};
    std::string text = count(sites_.sites.size(), "site", "sites") + " to " +
                       count(targets_.table.sites.size(), "target", "targets") + " by " +
                       method->first + '\n';
    for (const ValueColumn& answer : answers_) {
      json["missing"][answer.name] = answer.num_missing();
      if (answer.num_missing() == 0) continue;
      text += answer.name + ": " + count(answer.num_missing(), "target", "targets") +
              " without a value (outside of the sites' triangles)\n";
    }
    json["seconds"] = {{"read", seconds.read},
                       {"query", seconds.query},
                       {"write", seconds.write},
                       {"total", seconds.total}};
    json["peak_memory_bytes"] = peak_memory_bytes();
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.3f s", seconds.total);
    text += "wrote the values to " + options_.common.output + " in " + time.data() + '\n';
    job_.report(json.dump(2) + '\n', text);
  }

  InterpolateOptions options_;
  Job job_;
  SiteTable sites_;
  Targets targets_;
  std::vector<std::vector<double>> fields_;
  std::vector<ValueColumn> answers_;
};

template <class Choice>
void add_choice(CLI::App& parser, const std::string& name, Choice& choice,
                const Names<Choice>& names, const std::string& what) {
  const auto find = [&names](const std::string& text) {
    return std::ranges::find(names, text, &std::pair<std::string, Choice>::first);
  };
  std::string list;
  for (const auto& [word, value] : names) list += (list.empty() ? "" : ", ") + word;
  parser
      .add_option_function<std::string>(
          name, [&choice, find](const std::string& text) { choice = find(text)->second; }, what)
      ->check([&names, find, list](const std::string& text) {
        return find(text) == names.end() ? "'" + text + "' is none of " + list : std::string();
      })
      ->type_name("WORD");
}

void add_ways(CLI::App& parser, InterpolationOptions& how) {
  static const Names<Outside> outsides = {
      {"nan", Outside::missing}, {"nearest", Outside::nearest}, {"error", Outside::error}};
  static const Names<SharedPlace> places = {
      {"first", SharedPlace::first}, {"mean", SharedPlace::mean}, {"error", SharedPlace::error}};
  add_choice(parser, "--method", how.method, methods(),
             "nearest, linear, laplace, sibson (default), hermite or cubic");
  add_choice(parser, "--outside", how.outside, outsides,
             "Targets outside of the sites' triangles: nan (default: no value), nearest (that\n"
             "of the nearest site), error");
  add_choice(parser, "--duplicates", how.shared_place, places,
             "Sites in one place: first (default: the first one's value), mean, error");
}

}  // namespace

Command add_interpolate_command(CLI::App& tool) {
  const auto options = std::make_shared<InterpolateOptions>();
  CLI::App* parser =
      tool.add_subcommand("interpolate", "Carry values at the sites to other points");
  options->common.output = "-";
  add_input_options(*parser, options->common);
  parser
      ->add_option("--value", options->values,
                   "A column with values; may be repeated. A site whose cell is empty does not\n"
                   "count for this column")
      ->required()
      ->allow_extra_args(false)
      ->type_name("COL");
  parser
      ->add_option("--to", options->targets,
                   "Where values are wanted: a file of points, in the formats of INPUT; grid:DEG,\n"
                   "the centers of cells of DEG x DEG; or grid:NLONxNLAT")
      ->required()
      ->check(targets_error)
      ->type_name("TARGET");
  add_output_option(*parser, options->common,
                    "Where to write the values: .csv .tsv (standard output: CSV), or .npy:\n"
                    "(targets), of a grid (latitudes, longitudes), before it the columns if there\n"
                    "are several");
  add_ways(*parser, options->how);
  add_build_options(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "A row for each target: its place and the values; an empty cell (.npy: NaN) is none.\n"
      "Grids go from south to north, and within a row from -180 degrees to the east.\n\n"
      "linear is exact at the sites and has edges; laplace and sibson (natural neighbors) are\n"
      "smooth off the sites; hermite and cubic use gradients, which they estimate, and are the\n"
      "most accurate for smooth fields, but may overshoot.\n\n"
      "Examples:\n"
      "  rondel interpolate stations.csv --value temperature --to grid:1 -o grid.npy\n"
      "  rondel interpolate stations.csv --value t --to ships.csv --method linear");
  return {parser, [options] {
            InterpolateJob(*options).run();
            return done;
          }};
}

}  // namespace rondel::cli
