// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel relate: pairs of polygons that lie to each other as asked for.
// in    polygons of one or two files
// out   a row for each pair: the polygon of A, that of B, and their relation (DE-9IM)
// index features of A, of B, from 0
#include "rondel/relate.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "job.h"
#include "query_job.h"
#include "report.h"
#include "rondel/polygon_files.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel relate`.
struct RelateOptions {
  CommonOptions common;  // A; OUTPUT: the pairs
  std::string second;    // B; empty: the polygons of A
  SpatialPredicate where = SpatialPredicate::intersects;
  std::string pattern;  // --pattern; empty: any relation
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

// Returns the pairs that are asked for. A polygon is no pair with itself.
std::vector<RelatedPair> pairs_of(const CellRings& first, const CellRings& second,
                                  const RelateOptions& options, const Execution& execution) {
  std::vector<RelatedPair> pairs = related_pairs(first, second, options.where, execution);
  std::erase_if(pairs, [&](const RelatedPair& pair) {
    return (options.is_one_file() && pair.first == pair.second) ||
           (!options.pattern.empty() && !pair.relation.matches(options.pattern));
  });
  return pairs;
}

std::string rows_of_pairs(const std::vector<RelatedPair>& pairs, char separator) {
  std::string text = std::string("index_a") + separator + "index_b" + separator + "relation\n";
  for (const RelatedPair& pair : pairs) {
    append(text, std::uint64_t{pair.first});
    text += separator;
    append(text, std::uint64_t{pair.second});
    text += separator;
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
  CellTable first;
  CellTable second;
  std::vector<RelatedPair> pairs;
  job.time(Stage::dual, [&] {
    first = read_polygons(common.source_beside(options.second), options.read, job.execution());
    tell(first.facts.name, first.facts.remarks);
    if (options.is_one_file()) return;
    second = read_polygons(common.other_source(options.second), options.read, job.execution());
    tell(second.facts.name, second.facts.remarks);
  });
  job.time(Stage::query, [&] {
    pairs = pairs_of(first.cells, options.is_one_file() ? first.cells : second.cells, options,
                     job.execution());
  });
  job.time(Stage::write,
           [&] { write_file(common.output, rows_of_pairs(pairs, format == "tsv" ? '\t' : ',')); });
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
  CLI::App* parser = tool.add_subcommand("relate", "Find pairs of polygons by how they lie");
  add_input_file(*parser, "INPUT", options->common.input,
                 "The polygons A: .geojson, or - for standard input")
      ->type_name("");
  add_input_file(*parser, "SECOND", options->second,
                 "The polygons B; without them the polygons of A are related to each other")
      ->required(false)
      ->type_name("");
  add_polygon_format_option(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the pairs: .csv .tsv (standard output: CSV)");
  add_word<SpatialPredicate>(
      *parser, "--where", options->where, words_of_where(),
      "Which pairs are written, as A to B: intersects (default), contains, within, covers,\n"
      "covered-by, touches, overlaps or equals");
  parser
      ->add_option("--pattern", options->pattern,
                   "Only pairs whose relation fits to nine characters: T (not F), F, 0, 1, 2,\n"
                   "or * (anything)")
      ->check(pattern_error)
      ->type_name("PATTERN");
  add_word<PolygonEdges>(
      *parser, "--edges", options->read.edges, named_values<PolygonEdges>(),
      "What joins positions of the files: lonlat (default; straight in longitude and\n"
      "latitude, RFC 7946) or geodesic (great circles)");
  add_invalid_option(*parser, options->read.invalid);
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "A row has the number of a feature of A, that of a feature of B, both from 0, and their\n"
      "relation (DE-9IM): the dimensions of what the interior, the boundary and the exterior of\n"
      "A have in common with those of B; F is nothing. It is exact. Pairs have a place in common.\n"
      "\n"
      "Examples:\n"
      "  rondel relate countries.geojson --where touches\n"
      "  rondel relate countries.geojson basins.geojson --where contains -o inside.csv\n"
      "  rondel relate countries.geojson --pattern '****1****'");
  return {parser, [options] { return run_relate(*options); }};
}

}  // namespace rondel::cli
