// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel locate: the face of the triangulation that the ray through each query meets.
// in    sites and queries
// out   a row for each query: vertex, edge, face or outside, the face, and one to three sites
// index queries and sites in the order of their files; faces as `rondel delaunay` writes them
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>

#include "query_job.h"
#include "rondel/names.h"

namespace rondel::cli {
namespace {

// Returns the answers as rows; fields without a meaning, as the third site of an edge, are empty.
std::string table_of(const std::vector<Location>& locations, char separator) {
  std::string text;
  for (const std::string_view name : {"query", "where", "face", "site_a", "site_b", "site_c"}) {
    if (!text.empty()) text += separator;
    text += name;
  }
  for (std::size_t i = 0; i < locations.size(); ++i) {
    const Location& location = locations[i];
    text += '\n';
    append(text, i);
    text += separator;
    text += name_of(location.where);
    for (const Index index :
         {location.face, location.sites[0], location.sites[1], location.sites[2]}) {
      text += separator;
      if (index != no_index) append(text, std::uint64_t{index});
    }
  }
  return text + '\n';
}

// Locates the queries, writes a row for each, and reports how many meet a vertex, an edge, a face,
// and none of these. An array .npy holds the faces alone.
ExitStatus run_locate(const QueryOptions& options) {
  QueryJob job(options);
  job.prepare();
  const auto locations =
      job.ask([&] { return job.locator().locate(job.queries(), job.execution()); });
  if (job.is_npy()) {
    std::vector<Index> faces(locations.size());
    std::ranges::transform(locations, faces.begin(), &Location::face);
    job.write_npy(faces, {faces.size()});
  } else {
    job.write_text(table_of(locations, job.separator()));
  }
  // The report counts the queries by the kind of place that they are in.
  QueryJob::Counts counts;
  for (const std::string_view name : names_of<Where>()) {
    const auto number = std::ranges::count(locations, from_name<Where>(name), &Location::where);
    counts.emplace_back(name, static_cast<std::size_t>(number));
  }
  job.report(counts);
  return done;
}

}  // namespace

Command add_locate_command(CLI::App& tool) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* parser = tool.add_subcommand("locate", "Tell in which triangle points lie");
  add_query_options(*parser, *options, ".csv .tsv (standard output: CSV), or .npy: the\nfaces");
  parser->footer(
      "A row for each query: whether its ray from the center meets a vertex, an edge, a face,\n"
      "or the outside (no face that the center sees), the face, and the 1, 2 or 3 sites. Faces\n"
      "are numbered as 'rondel delaunay' writes them; .npy holds their numbers (4294967295\n"
      "outside).\n\n"
      "Example:\n"
      "  rondel locate stations.csv ships.csv -o faces.csv");
  return {parser, [options] { return run_locate(*options); }};
}

}  // namespace rondel::cli
