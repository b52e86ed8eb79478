// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel nearest: the k sites nearest to each query, or all sites within a distance.
// in    sites and queries
// out   a row for each site found: the query, the site, their distance in degrees, columns of the
//       site
// index queries and sites in the order of their files, from 0
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "column_values.h"
#include "query_job.h"
#include "rondel/mesh_files.h"

namespace rondel::cli {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

// Returns values as a column of text, in the shortest digits that read back as the same doubles.
Column numeric_column(const std::string& name, const std::vector<double>& values) {
  Column column;
  column.name = name;
  column.is_numeric = true;
  for (const double value : values) {
    std::array<char, 32> text{};
    if (!std::isnan(value)) {
      column.text.append(text.data(),
                         std::to_chars(text.data(), text.data() + text.size(), value).ptr);
    }
    column.ends.push_back(column.text.size());
  }
  return column;
}

// The columns that are named. In netCDF one may be one of the several fields of a variable.
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
SiteLists find_sites(QueryJob& job, const QueryOptions& options) {
  if (options.within_deg >= 0) {
    const double angle = options.within_deg / degrees_per_radian;
    return job.ask([&] { return job.locator().within(job.queries(), angle, job.execution()); });
  }
  const std::size_t k = std::max<std::uint64_t>(options.k, 1);
  const std::size_t row = std::min(k, job.triangulation().num_vertices());
  SiteLists lists;
  lists.sites =
      job.ask([&] { return job.locator().k_nearest(job.queries(), row, job.execution()); });
  for (std::size_t i = 0; i <= job.queries().size(); ++i) lists.offsets.push_back(i * row);
  return lists;
}

// Returns the answers as a table with a header; columns whose name is taken get another one.
std::string table_of(const QueryJob& job, const std::vector<Column>& columns,
                     const SiteLists& lists) {
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
    for (std::uint64_t k = lists.offsets[i]; k < lists.offsets[i + 1]; ++k) {
      const Index site = lists.sites[k];
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
void write_npy(QueryJob& job, const QueryOptions& options, const SiteLists& lists) {
  const std::size_t k = std::max<std::uint64_t>(options.k, 1);
  const std::size_t num_queries = job.queries().size();
  std::vector<Index> values(num_queries * k, no_index);
  for (std::size_t i = 0; i < num_queries; ++i) {
    std::copy(lists.sites.begin() + static_cast<std::ptrdiff_t>(lists.offsets[i]),
              lists.sites.begin() + static_cast<std::ptrdiff_t>(lists.offsets[i + 1]),
              values.begin() + static_cast<std::ptrdiff_t>(i * k));
  }
  if (options.k == 0) {
    job.write_npy(values, {num_queries});
  } else {
    job.write_npy(values, {num_queries, k});
  }
}

}  // namespace

ExitStatus run_nearest(const QueryOptions& options) {
  QueryJob job(options);
  if (job.is_npy() && (options.within_deg >= 0 || !options.columns.empty())) {
    throw UsageError("--output: .npy holds one row of sites a query, without --within or --column");
  }
  job.prepare();
  const std::vector<Column> columns = find_columns(options, job.sites());
  const SiteLists lists = find_sites(job, options);
  if (job.is_npy()) {
    write_npy(job, options, lists);
  } else {
    job.write_text(table_of(job, columns, lists));
  }
  job.report({{"found", lists.sites.size()}});
  return done;
}

}  // namespace rondel::cli
