// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel relate: pairs of features that lie to each other as asked for.
// in    points, lines and polygons of one or two files
// out   a row for each pair: the feature of A, that of B, and their relation (DE-9IM)
// index features of A, of B, from 0
#include "rondel/relate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "job.h"
#include "query_job.h"
#include "report.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel relate`.
struct RelateOptions {
  CommonOptions common;  // A; OUTPUT: the pairs
  std::string second;    // B; empty: the features of A
  SpatialPredicate where = SpatialPredicate::intersects;
  std::string pattern;  // --pattern; empty: any relation
  std::string column;   // --column; empty: features have numbers alone
  PolygonOptions read;

  [[nodiscard]] bool is_one_file() const { return second.empty(); }
};

// Returns the words of --where: pairs that are disjoint are not listed.
std::unordered_map<std::string, SpatialPredicate> words_of_where() {
  auto words = named_values<SpatialPredicate>();
  words.erase(word_of(name_of(SpatialPredicate::disjoint)));
  return words;
}

// Returns what is wrong with a pattern, or nothing.
std::string pattern_error(const std::string& text) {
  try {
    static_cast<void>(Relation{}.matches(text));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

// Returns the pairs that are asked for. A feature is no pair with itself.
std::vector<RelatedPair> pairs_of(const Geometries& first, const Geometries& second,
                                  const RelateOptions& options, const Execution& execution) {
  std::vector<RelatedPair> pairs = related_pairs(first, second, options.where, execution);
  std::erase_if(pairs, [&](const RelatedPair& pair) {
    return (options.is_one_file() && pair.first == pair.second) ||
           (!options.pattern.empty() && !pair.relation.matches(options.pattern));
  });
  return pairs;
}

// Returns a column of features, or null if there is none of this name.
const Column* column_of(const FeatureTable& table, const std::string& name) {
  const std::vector<Column>& columns = table.facts.columns;
  const auto found = std::ranges::find(columns, name, &Column::name);
  return found == columns.end() ? nullptr : &*found;
}

// Writes a row for each pair, with the cells of a column that one of the tables has, if it is asked
// for. Throws UsageError if none has it.
std::string rows_of_pairs(const std::vector<RelatedPair>& pairs,
                          const std::vector<FeatureTable>& tables, const std::string& name,
                          char separator) {
  const std::array columns = {column_of(tables.front(), name), column_of(tables.back(), name)};
  const bool is_named = !name.empty();
  if (is_named && columns[0] == nullptr && columns[1] == nullptr) {
    throw UsageError("--column: no file has a column '" + name + "'");
  }
  std::string text = std::string("index_a") + separator + "index_b" + separator;
  for (const char* const end : {"_a", "_b"}) {
    if (!is_named) continue;
    append_field(text, name + end, separator);
    text += separator;
  }
  text += "relation\n";
  for (const RelatedPair& pair : pairs) {
    const std::array rows = {pair.first, pair.second};
    for (const Index row : rows) {
      append(text, std::uint64_t{row});
      text += separator;
    }
    for (std::size_t k = 0; is_named && k < 2; ++k) {
      if (columns[k] != nullptr) append_field(text, columns[k]->cell(rows[k]), separator);
      text += separator;
    }
    text += pair.relation.text();
    text += '\n';
  }
  return text;
}

// Throws FileError for files that cannot be read or written, UsageError.
ExitStatus run_relate(const RelateOptions& options) {
  CommonOptions common = options.common;
  if (common.output == "-" && common.output_format.empty()) common.output_format = "csv";
  const std::string format = common.format();
  require_output(common, format == "csv" || format == "tsv", ".csv .tsv",
                 {{"SECOND", options.second}});
  Job job(common);
  std::vector<FeatureTable> tables;
  std::vector<RelatedPair> pairs;
  job.time(Stage::dual, [&] {
    std::vector<FileName> files = {common.source_beside(options.second)};
    if (!options.is_one_file()) files.push_back(common.other_source(options.second));
    tables = read_features_together(files, options.read, job.execution());
    for (const FeatureTable& table : tables) tell(table.facts.name, table.facts.remarks);
  });
  job.time(Stage::query, [&] {
    const auto taken = [](FeatureTable& table) {
      return Geometries{std::move(table.lines), std::move(table.polygons)};
    };
    const Geometries first = taken(tables.front());
    const Geometries other = options.is_one_file() ? Geometries() : taken(tables.back());
    const Geometries& second = options.is_one_file() ? first : other;
    pairs = pairs_of(first, second, options, job.execution());
  });
  job.time(Stage::write, [&] {
    write_file(common.output,
               rows_of_pairs(pairs, tables, options.column, format == "tsv" ? '\t' : ','));
  });
  const double seconds = job.seconds().total;
  job.report(nlohmann::ordered_json{{"pairs", pairs.size()}, {"seconds", seconds}}.dump(2) + '\n',
             "wrote " + count(pairs.size(), "pair", "pairs") + " to " + common.output + " in " +
                 text_of_seconds(seconds) + '\n');
  return done;
}

}  // namespace

Command add_relate_command(CLI::App& tool) {
  auto options = std::make_shared<RelateOptions>();
  options->common.output = "-";
  CLI::App* parser = tool.add_subcommand("relate", "Find pairs of features by how they lie");
  add_input_file(*parser, "INPUT", options->common.input,
                 "The features A: .geojson, or sites: .csv .tsv .xyz .txt .npy, with GDAL\n"
                 "installed .gpkg .fgb .shp .parquet, the places of a netCDF file; or - for\n"
                 "standard input")
      ->type_name("");
  add_input_file(*parser, "SECOND", options->second,
                 "The features B; without them those of A are related to each other")
      ->required(false)
      ->type_name("");
  add_polygon_format_option(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the pairs: .csv .tsv (standard output: CSV)");
  add_word<SpatialPredicate>(
      *parser, "--where", options->where, words_of_where(),
      "Which pairs are written, as A to B: intersects (default), contains, within, covers,\n"
      "covered-by, touches, crosses, overlaps or equals");
  parser
      ->add_option("--pattern", options->pattern,
                   "Only pairs whose relation fits to nine characters: T (not F), F, 0, 1, 2,\n"
                   "or * (anything)")
      ->check(pattern_error)
      ->type_name("PATTERN");
  parser
      ->add_option("--column", options->column, "A property of the features, which rows have, too")
      ->type_name("NAME");
  add_edges_option(*parser, options->read.edges, "the files");
  add_invalid_option(*parser, options->read.invalid);
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "A row has the number of a feature of A, that of a feature of B, both from 0, and their\n"
      "relation (DE-9IM): the dimensions of what the interior, the boundary and the exterior of\n"
      "A have in common with those of B; F is nothing. It is exact. Pairs have a place in common.\n"
      "A feature has points, lines or polygons, and not several of these.\n\n"
      "Examples:\n"
      "  rondel relate stations.csv countries.geojson --where within --column name\n"
      "  rondel relate countries.geojson --where touches\n"
      "  rondel relate countries.geojson basins.geojson --where contains -o inside.csv\n"
      "  rondel relate countries.geojson --pattern '****1****'");
  return {parser, [options] { return run_relate(*options); }};
}

}  // namespace rondel::cli
