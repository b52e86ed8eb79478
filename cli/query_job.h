// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What locate and nearest share: they read two files and write a table of answers.
///
/// in    INPUT with the sites and QUERIES with points
/// out   answers: a table, .csv or .tsv, or an array of indices, .npy
/// index queries and sites in the order of their files, from 0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "job.h"
#include "rondel/query.h"

namespace rondel::cli {

/// The options of locate and nearest; k and within_deg belong to nearest only.
struct QueryOptions {
  CommonOptions common;
  std::string queries;               ///< QUERIES; "-": standard input
  std::string query_format;          ///< empty: by the ending
  std::vector<std::string> columns;  ///< --column: columns of INPUT to add to the answers
  std::uint64_t k = 0;               ///< -k; 0: not given
  double within_deg = -1;            ///< --within; negative: not given
};

/// Adds INPUT, QUERIES and where the answers go, by default standard output. `formats` says for the
/// help in which formats answers are written.
void add_query_options(CLI::App& parser, QueryOptions& options, const std::string& formats);

/// One run: reads both files, triangulates the sites and makes the locator.
class QueryJob {
 public:
  /// Checks the options before any work. \throws UsageError if they do not fit together
  explicit QueryJob(const QueryOptions& options);

  /// Reads both files, triangulates the sites and makes the locator. \throws FileError
  void prepare();

  /// The results of prepare().
  [[nodiscard]] const SiteTable& sites() const { return sites_; }
  [[nodiscard]] std::span<const Point> queries() const { return queries_.sites; }
  [[nodiscard]] const Triangulation& triangulation() const { return triangulation_; }
  [[nodiscard]] const Locator& locator() const { return *locator_; }
  [[nodiscard]] Execution execution() const { return job_.execution(); }

  /// True if the answers go to a .npy file.
  [[nodiscard]] bool is_npy() const;
  /// Returns the separator between the fields of a row.
  [[nodiscard]] char separator() const;

  /// Returns question(), timed as a query; the error for an invalid query names its place in the
  /// file.
  template <class Ask>
  auto ask(const Ask& question) {
    decltype(question()) answers;
    job_.time(Stage::query, [&] { answers = with_places(queries_, question); });
    return answers;
  }

  /// Writes the answers as a table to OUTPUT. \throws FileError
  void write_text(const std::string& text);
  /// Writes the answers as an array of this shape to OUTPUT. \throws FileError
  void write_npy(const std::vector<Index>& values, const std::vector<std::uint64_t>& shape);

  /// Prints the report where it does not disturb the answers. `answers` counts them by name.
  using Counts = std::vector<std::pair<std::string, std::size_t>>;
  void report(const Counts& answers);

 private:
  QueryOptions options_;
  Job job_;
  SiteTable sites_;
  SiteTable queries_;
  Triangulation triangulation_;
  std::optional<Locator> locator_;
};

/// Appends a number in decimal digits.
void append(std::string& text, std::uint64_t value);
/// Appends an angle with 15 digits.
void append_distance(std::string& text, double degrees);
/// Appends a field, in quotes where RFC 4180 asks for them.
void append_field(std::string& text, std::string_view field, char separator);

}  // namespace rondel::cli
