// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query_job.h"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "process.h"
#include "report.h"

namespace rondel::cli {
namespace {

// Fills in the formats: standard output is CSV if no format is named, and the format of standard
// input is that of the file which is read from it.
QueryOptions completed(QueryOptions options) {
  CommonOptions& common = options.common;
  if (common.output == "-" && common.output_format.empty()) common.output_format = "csv";
  if (options.queries == "/dev/stdin") options.queries = "-";
  if (options.queries == "-") std::swap(common.input_format, options.query_format);
  return options;
}

// The queries are points, even if the sites are circles.
ReadOptions query_options(const QueryOptions& options) {
  ReadOptions read = options.common.read;
  read.radius.clear();
  return read;
}

}  // namespace

void add_query_options(CLI::App& parser, QueryOptions& options, const std::string& formats) {
  options.common.output = "-";
  add_input_options(parser, options.common, default_input_help, [&options] {
    return std::vector<FileName>{options.common.source(), {options.queries, options.query_format}};
  });
  parser
      .add_option("QUERIES", options.queries,
                  "The points to ask for, in the formats of INPUT; columns that are named\n"
                  "by an option have the same name in both. One of the two may be -")
      ->required()
      ->type_name("");
  add_output_option(parser, options.common, "Where to write the answers: " + formats);
  add_build_options(parser, options.common);
  add_report_options(parser, options.common);
}

QueryJob::QueryJob(const QueryOptions& options)
    : options_(completed(options)), job_(options_.common) {
  const CommonOptions& common = options_.common;
  if (common.input == "-" && options_.queries == "-") {
    throw UsageError("INPUT and QUERIES: only one of them can be standard input");
  }
  const std::string format = common.format();
  const bool is_known = format == "npy" || format == "csv" || format == "tsv";
  require_output(common, is_known, ".csv .tsv .npy", {{"QUERIES", options_.queries}});
}

void QueryJob::prepare() {
  ReadOptions read = options_.common.read;
  read.keep_columns = !options_.columns.empty();
  // Columns of netCDF are at the sites, so that the first one says which of several grids is meant.
  sites_ = job_.read(options_.common.source(), read, options_.columns);
  queries_ = job_.read({options_.queries, options_.query_format}, query_options(options_));
  const SiteTable* const tables[] = {&sites_, &queries_};
  require_angles(options_.common.read, tables);
  move_to(job_.sphere().center, queries_);
  triangulation_ = job_.triangulate(sites_);
  job_.time(Stage::locator, [this] { locator_.emplace(triangulation_); });
}

bool QueryJob::is_npy() const { return options_.common.format() == "npy"; }

char QueryJob::separator() const { return options_.common.format() == "tsv" ? '\t' : ','; }

void QueryJob::write_text(const std::string& text) {
  job_.time(Stage::write, [&] { write_file(options_.common.output, text); });
}

void QueryJob::write_npy(const std::vector<Index>& values,
                         const std::vector<std::uint64_t>& shape) {
  job_.time(Stage::write, [&] { write_indices(options_.common.output, values, shape); });
}

// The keys of the JSON object are a contract with programs that read it.
void QueryJob::report(const Counts& answers) {
  const Seconds seconds = job_.seconds();
  const BuildReport& build = triangulation_.report();
  nlohmann::ordered_json json = {{"sites", sites_.sites.size()},
                                 {"vertices", triangulation_.num_vertices()},
                                 {"faces", triangulation_.num_faces()},
                                 {"dimension", triangulation_.dimension()},
                                 {"model", name_of(triangulation_.model())},
                                 {"threads", build.threads},
                                 {"queries", queries_.sites.size()}};
  std::string text = count(queries_.sites.size(), "query", "queries") + " to " +
                     count(sites_.sites.size(), "site", "sites") + ": ";
  for (const auto& [name, number] : answers) {
    json["answers"][name] = number;
    if (&name != &answers.front().first) text += ", ";
    text += name + ' ' + std::to_string(number);
  }
  json["seconds"] = {{"read", seconds.read},
                     {"order", build.order_seconds},
                     {"triangulate", build.triangulate_seconds},
                     {"locator", seconds.locator},
                     {"query", seconds.query},
                     {"write", seconds.write},
                     {"total", seconds.total}};
  json["peak_memory_bytes"] = peak_memory_bytes();
  text += "\nwrote the answers to " + options_.common.output + " in " +
          text_of_seconds(seconds.total) + '\n';
  job_.report(json.dump(2) + '\n', text);
}

void append(std::string& text, std::uint64_t value) { text += std::to_string(value); }

void append_distance(std::string& text, double degrees) {
  constexpr int digits = 15;  // one less than what the last operation rounds
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), degrees,
                                 std::chars_format::general, digits)
                       .ptr;
  text.append(buffer.data(), end);
}

void append_field(std::string& text, std::string_view field, char separator) {
  const bool is_plain = field.find_first_of("\"\r\n") == std::string_view::npos &&
                        field.find(separator) == std::string_view::npos;
  if (is_plain) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
  }
  text += '"';
}

}  // namespace rondel::cli
