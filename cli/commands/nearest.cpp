// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel nearest: the k sites nearest to each query, or all sites within a distance.
// in    sites and queries
// out   a row for each site found: the query, the site, their distance in degrees, columns of the
//       site
// index queries and sites in the order of their files, from 0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numbers>

#include "column_values.h"
#include "query_job.h"
#include "rondel/read_cells.h"
#include "validate.h"

namespace rondel::cli {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

// Returns the columns that --column names, a cell for each site. In netCDF a name may be that of
// one of the several fields of a variable. Throws UsageError for a name that the file does not
// have.
std::vector<Column> find_columns(const QueryOptions& options, const SiteTable& table) {
  std::vector<Column> found;
  for (const std::string& name : options.columns) {
    const auto at = std::ranges::find(table.columns, name, &Column::name);
    if (at != table.columns.end()) {
      found.push_back(*at);
    } else if (is_netcdf_file(table.name)) {
      found.push_back(numeric_column(name, column_values(table, name, "--column")));
    } else {
      throw UsageError("--column: " + table.name + " has no column '" + name + "'");
    }
  }
  return found;
}

// Returns the sites of each query in compressed rows.
// Row i has the sites of query i: by --within in increasing order, else the nearest first. A row
// has fewer than K sites if there are fewer vertices.
CompressedRows<Index> find_sites(QueryJob& job, const QueryOptions& options) {
  if (options.within_deg >= 0) {
    const double angle = options.within_deg / degrees_per_radian;
    return job.ask([&] { return job.locator().within(job.queries(), angle, job.execution()); });
  }
  const std::size_t k = std::max<std::uint64_t>(options.k, 1);
  // Each query finds as many sites as there are vertices at most, so rows of the result are full.
  const std::size_t row = std::min(k, job.triangulation().num_vertices());
  CompressedRows<Index> lists;
  lists.values =
      job.ask([&] { return job.locator().k_nearest(job.queries(), row, job.execution()); });
  for (std::size_t i = 1; i <= job.queries().size(); ++i) lists.offsets.push_back(i * row);
  return lists;
}

// Returns the answers as a table with a header; columns whose name is taken get another one.
std::string table_of(const QueryJob& job, const std::vector<Column>& columns,
                     const CompressedRows<Index>& lists) {
  const char separator = job.separator();
  std::vector<std::string> names = {"query", "site", "distance_deg"};
  for (const Column& column : columns) names.push_back(column.name);
  const std::vector<std::string> free = free_names(std::move(names));
  std::string text;
  for (const std::string& name : free) {
    if (!text.empty()) text += separator;
    append_field(text, name, separator);
  }
  text += '\n';
  for (std::size_t i = 0; i < job.queries().size(); ++i) {
    for (const Index site : lists[i]) {
      append(text, i);
      text += separator;
      append(text, std::uint64_t{site});
      text += separator;
      append_distance(text, job.locator().distance(job.queries()[i], site) * degrees_per_radian);
      for (const Column& column : columns) {
        text += separator;
        append_field(text, column.cell(site), separator);
      }
      text += '\n';
    }
  }
  return text;
}

// Writes rows of k sites; missing ones are filled with no_index.
void write_npy(QueryJob& job, const QueryOptions& options, const CompressedRows<Index>& lists) {
  const std::size_t k = std::max<std::uint64_t>(options.k, 1);
  const std::size_t num_queries = job.queries().size();
  std::vector<Index> values(num_queries * k, no_index);
  for (std::size_t i = 0; i < num_queries; ++i) {
    std::ranges::copy(lists[i], values.begin() + static_cast<std::ptrdiff_t>(i * k));
  }
  // Without --count the array has one dimension, with it two, also for a count of 1.
  if (options.k == 0) {
    job.write_npy(values, {num_queries});
  } else {
    job.write_npy(values, {num_queries, k});
  }
}

// Finds the sites and writes them as a table, or as an array of indices. Throws UsageError for .npy
// with --within or --column, whose rows have no fixed length or hold text.
ExitStatus run_nearest(const QueryOptions& options) {
  QueryJob job(options);
  if (job.is_npy() && (options.within_deg >= 0 || !options.columns.empty())) {
    throw UsageError("--output: .npy holds one row of sites a query, without --within or --column");
  }
  job.prepare();
  const std::vector<Column> columns = find_columns(options, job.sites());
  const CompressedRows<Index> lists = find_sites(job, options);
  if (job.is_npy()) {
    write_npy(job, options, lists);
  } else {
    job.write_text(table_of(job, columns, lists));
  }
  job.report({{"found", lists.values.size()}});
  return done;
}

// Checks a distance on the sphere in degrees.
std::string distance_error(const std::string& text) { return range_error(text, 0, 180); }

}  // namespace

Command add_nearest_command(CLI::App& tool) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* parser = tool.add_subcommand("nearest", "Find the sites nearest to points");
  add_query_options(*parser, *options, ".csv .tsv (standard output: CSV), or .npy: the\nsites");
  CLI::Option* k = parser->add_option("-k,--count", options->k, "The K nearest sites (default: 1)");
  k->check(count_error)->type_name("K");
  parser
      ->add_option("--within", options->within_deg,
                   "All sites at a distance of at most DEG, from 0 to 180")
      ->excludes(k)
      ->check(distance_error)
      ->type_name("DEG");
  parser
      ->add_option("--column", options->columns,
                   "Add this column of INPUT to the answers; may be repeated. A column 'site' is\n"
                   "called 'site_' there, as the answers have one of that name")
      ->allow_extra_args(false)
      ->type_name("COL");
  parser->footer(
      "A row for each site found: the query, the site (both counted from 0) and its distance,\n"
      "the nearest first, ties by site; with --within in the order of the sites. The distance\n"
      "is the angle; with --model weighted it is the Laguerre distance, which is 0 within a\n"
      "circle. Comparisons are exact. .npy holds the sites as (queries) or (queries x K),\n"
      "4294967295 for none.\n\n"
      "Examples:\n"
      "  rondel nearest stations.csv ships.csv --column name\n"
      "  rondel nearest stations.csv ships.csv --within 2 -o close.csv");
  return {parser, [options] { return run_nearest(*options); }};
}

}  // namespace rondel::cli
