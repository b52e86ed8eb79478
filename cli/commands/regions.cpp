// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel regions: clips the cells of sites by polygons and joins them by groups; with --densify the
// cells are those of lines and polygons. The functions of regions.h also serve `rondel voronoi`.
//
// Steps: read and triangulate the sites, or read the features; cut the cells (Cut); make features
// of them (region_features.h); write these; tell which groups or features have no cell.
#include "regions.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "double_text.h"
#include "job.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// Writes the features to OUTPUT, timed as writing.
void write(Job& job, const RegionsOptions& options, const Features& made) {
  job.time(Stage::write, [&] {
    write_regions(options.common.target(), made.rings, made.columns, options.tolerance_deg,
                  job.execution(), made.ids);
  });
}

// Returns a remark on groups none of whose sites has a cell.
// The remark names the first such group, and counts them; the vector is empty if there are none.
std::vector<std::string> remarks_on_groups(const Groups& groups,
                                           const Triangulation& triangulation) {
  // Without --group there are no groups.
  const std::size_t size = groups.names.ends.size();
  if (size == 0) return {};
  const std::vector<bool> has_cell = are_vertices(triangulation);
  std::vector<bool> is_seen(size);
  for (std::size_t i = 0; i < groups.of_rows.size(); ++i) {
    if (has_cell[i] && groups.of_rows[i] != no_index) is_seen[groups.of_rows[i]] = true;
  }
  const auto lost = static_cast<std::size_t>(std::ranges::count(is_seen, false));
  if (lost == 0) return {};
  const auto first = static_cast<std::size_t>(std::ranges::find(is_seen, false) - is_seen.begin());
  return {count(lost, "group of ", "groups of ") + "'" + groups.names.name +
          (lost > 1 ? "' have" : "' has") +
          " no cell, as all sites are hidden or at the place of one before (" +
          (lost > 1 ? "first '" : "'") + std::string(groups.names.cell(first)) + "')"};
}

// Returns the Voronoi or power cells of the sites, by site: whole ones without --clip, clipped ones
// with it, and with --clip-value their pieces in each polygon. Throws FileError, which names the
// file of --clip, for polygons that are not accepted.
Cut cut_cells_of_sites(const RegionsOptions& options, const Triangulation& triangulation,
                       const Execution& execution) {
  const CellSet all = CellSet::voronoi(triangulation, execution);
  Cut cut;
  if (options.clip.empty()) {
    cut.cells = all.rings();
    return cut;
  }
  Regions regions = regions_of(options, execution);
  try {
    if (options.clip_value.empty()) {
      cut.cells = clip(all, regions.cells, execution);
    } else {
      cut.pieces = intersection(all, regions.cells, execution);
    }
  } catch (const InvalidInput& error) {
    throw FileError(options.clip + ": " + error.what());
  }
  cut.values = std::move(regions.values);
  return cut;
}

// Runs the command for sites: reads and triangulates them, cuts and joins their cells, writes the
// features, and tells which groups have none. Throws FileError, UsageError.
ExitStatus write_cells_of_sites(const RegionsOptions& options) {
  Job job(options.common);
  SiteTable table = job.read();
  Groups groups;
  if (!options.group.empty()) {
    groups = groups_of(table.columns, table.name, options.group, "--group");
  }
  const Triangulation triangulation = job.triangulate(table);
  Features made;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    made = features_of(options, cut_cells_of_sites(options, triangulation, execution), groups,
                       numbered("site", table.sites.size(), std::move(table.columns)), table.ids,
                       execution);
  });
  write(job, options, made);
  tell(table.name, remarks_on_groups(groups, triangulation));
  job.report(triangulation, !options.group.empty()  ? "the joined cells"
                            : !options.clip.empty() ? "the clipped cells"
                                                    : "the cells");
  return done;
}

// Returns the cells of lines and polygons. The tolerance of --densify becomes an angle in radians
// on a sphere of --earth-radius, or of the mean radius of the Earth.
Cut cut_cells_of_features(const RegionsOptions& options, const FeatureTable& table,
                          const Execution& execution) {
  const double radius = options.earth_radius_km > 0 ? options.earth_radius_km : mean_earth_radius;
  const double tolerance = options.densify_km / radius;
  std::optional<Regions> regions;
  if (!options.clip.empty()) regions = regions_of(options, execution);
  Cut cut;
  try {
    if (!regions) {
      cut.cells = feature_cells(table.lines, table.polygons, tolerance, execution);
    } else if (options.clip_value.empty()) {
      cut.cells =
          clipped_feature_cells(table.lines, table.polygons, tolerance, regions->cells, execution);
    } else {
      cut.pieces =
          feature_pieces(table.lines, table.polygons, tolerance, regions->cells, execution);
    }
  } catch (const InvalidInput& error) {
    throw FileError(table.facts.name + ": " + error.what());
  }
  if (regions) cut.values = std::move(regions->values);
  return cut;
}

// Returns remarks on features without a geometry, and on those that have one but no cell. What lies
// outside of --clip has no cell either, so with that only polygons are told that lie in others
// before.
std::vector<std::string> remarks_on(const FeatureTable& table, const Cut& cut, bool is_clipped,
                                    bool is_quiet) {
  std::size_t unlocated = 0;
  std::size_t without = 0;
  std::size_t first = 0;
  for (std::size_t f = 0; f < table.lines.size(); ++f) {
    if (!table.is_located[f]) {
      ++unlocated;
      continue;
    }
    const CellRings& cells = is_clipped ? table.polygons : cut.cells;
    const bool has_line = table.lines.offsets[f] < table.lines.offsets[f + 1];
    if (cells.cells[f] < cells.cells[f + 1] || cells.is_whole(f) || (is_clipped && has_line)) {
      continue;
    }
    if (without++ == 0) first = f;
  }
  std::vector<std::string> remarks;
  if (unlocated > 0 && !is_quiet) {
    remarks.push_back("left out " + count(unlocated, "feature", "features") + " without a place");
  }
  if (without > 0) {
    remarks.push_back(count(without, "feature has", "features have") +
                      " no cell, as others before have all of their places" +
                      (table.facts.remarks.empty() ? "" : " or rounding leaves nothing of them") +
                      " (" + (without > 1 ? "first " : "") +
                      feature_name(table.facts.columns, first) + ")");
  }
  return remarks;
}

// Runs the command for lines and polygons (--densify). A feature's cell has the places from which
// no other feature is nearer by more than the given distance. Throws FileError, UsageError.
ExitStatus write_cells_of_features(const RegionsOptions& options) {
  Job job(options.common);
  FeatureTable table;
  Features made;
  job.time(Stage::dual, [&] {
    const Execution execution = job.execution();
    table = read_features(
        options.common.source(),
        {.edges = options.edges, .invalid = options.invalid, .overlap = options.overlap},
        execution);
    tell(table.facts.name, table.facts.remarks);
    Groups groups;
    if (!options.group.empty()) {
      groups = groups_of(table.facts.columns, table.facts.name, options.group, "--group");
    }
    Cut cut = cut_cells_of_features(options, table, execution);
    tell(table.facts.name, remarks_on(table, cut, !options.clip.empty(), options.common.quiet));
    made = features_of(options, std::move(cut), groups,
                       numbered("feature", table.lines.size(), std::move(table.facts.columns)),
                       table.ids, execution);
  });
  write(job, options, made);
  const std::size_t count_of_features = table.lines.size();
  const double seconds = job.seconds().total;
  job.report(
      nlohmann::ordered_json{{"features", count_of_features}, {"seconds", seconds}}.dump(2) + '\n',
      count(count_of_features, "feature", "features") + "\nwrote their cells to " +
          options.common.output + " in " + text_of_seconds(seconds) + '\n');
  return done;
}

// Checks OUTPUT and that an option makes regions; whole cells are left to `rondel voronoi`, which
// writes more formats. Columns are kept: they become properties.
ExitStatus run_regions(RegionsOptions options) {
  require_output(options.common, can_write_regions(options.common.target()),
                 ".geojson .gpkg .fgb .parquet", {{"--clip", options.clip}});
  if (options.clip.empty() && options.group.empty() && options.densify_km == 0) {
    throw UsageError(
        "--clip, --group or --densify makes regions; rondel voronoi writes whole cells");
  }
  options.common.read.keep_columns = true;
  return write_regions_of(options);
}

// Adds the options that say what polygons of files mean: the lines between their positions, and
// places that several of them have.
void add_polygon_words(CLI::App& parser, RegionsOptions& options) {
  add_word<PolygonEdges>(
      parser, "--edges", options.edges, named_values<PolygonEdges>(),
      "What joins positions of --clip and --densify: lonlat (default; straight in\n"
      "longitude and latitude, RFC 7946) or geodesic (great circles)");
  add_invalid_option(parser, options.invalid);
  std::unordered_map<std::string, PolygonOverlap> overlaps = named_values<PolygonOverlap>();
  // Cells of features must not overlap: a place in two polygons is an error, or is of the first
  // one.
  overlaps.erase("keep");
  add_word<PolygonOverlap>(
      parser, "--overlap", options.overlap, overlaps,
      "What becomes of a place that several polygons of --clip-value or --densify have:\n"
      "error (default: two of them are named) or first (it is of the first one)");
}

// Checks a radius, whose areas must not overflow.
std::string earth_radius_error(const std::string& text) {
  std::string error = positive_error(text);
  if (!error.empty()) return error;
  // The text is a number, as positive_error() accepts it.
  double radius = 0;
  double_from(text.data(), text.data() + text.size(), radius);
  if (std::isnormal(4 * std::numbers::pi * (radius * radius))) return {};
  return "'" + text + "' is the radius of a sphere whose area is no number";
}

// Tells of options for polygons without them, and of those for sites with lines and polygons.
void require_effects(const CLI::App& parser, RegionsOptions& options) {
  const auto has_features = [&options] { return options.densify_km > 0; };
  for (const char* const name : {"--edges", "--invalid"}) {
    require_effect(
        options.common, parser.get_option(name),
        [=, &options] { return has_features() || !options.clip.empty(); },
        "without --clip or --densify");
  }
  require_effect(
      options.common, parser.get_option("--overlap"),
      [=, &options] { return has_features() || !options.clip_value.empty(); },
      "without --clip-value or --densify");
  for (const char* const name :
       {"--radius", "--radians", "--delimiter", "--lon", "--x", "--model", "--center"}) {
    require_effect(
        options.common, parser.get_option(name), [=] { return !has_features(); },
        "with --densify, whose INPUT has lines and polygons");
  }
}

}  // namespace

void add_region_options(CLI::App& parser, RegionsOptions& options) {
  parser
      .add_option("--clip", options.clip,
                  "Keep what lies in the polygons of this file (.geojson), as of land or countries")
      ->type_name("FILE");
  parser
      .add_option("--clip-value", options.clip_value,
                  "Cut cells where this property of --clip's polygons changes, and keep it: a\n"
                  "feature for each cell and text; polygons without a text are left out")
      ->type_name("COL");
  add_polygon_words(parser, options);
  parser
      .add_option("--group", options.group,
                  "Join the cells of all sites with the same text in this column; sites without\n"
                  "a text are left out")
      ->type_name("COL");
  parser
      .add_option("--densify", options.densify_km,
                  "INPUT has lines and polygons (.geojson): a cell for each feature, of the\n"
                  "places from which no other is nearer by more than KM")
      ->check(positive_error)
      ->type_name("KM");
  parser
      .add_option("--earth-radius", options.earth_radius_km,
                  "Adds areas on a sphere of this radius, 'area_km2' (the Earth's mean radius\n"
                  "is 6371.0088, which --densify supposes)")
      ->check(earth_radius_error)
      ->type_name("KM");
  add_build_options(parser, options.common);
  require_effects(parser, options);
}

bool makes_regions(const RegionsOptions& options) {
  return !options.clip.empty() || !options.clip_value.empty() || !options.group.empty() ||
         options.densify_km > 0 || options.earth_radius_km > 0 ||
         (options.common.format() != "geojson" && can_write_regions(options.common.target()));
}

ExitStatus write_regions_of(const RegionsOptions& options) {
  const CommonOptions& common = options.common;
  if (!options.clip_value.empty() && options.clip.empty()) {
    throw UsageError("--clip-value goes with --clip, whose polygons have it");
  }
  require_region_writer(common.target());
  if (!can_write_regions(common.target())) {
    throw UsageError(
        "--clip, --group, --densify and --earth-radius write .geojson .gpkg .fgb .parquet, not '" +
        common.output + "'");
  }
  return options.densify_km > 0 ? write_cells_of_features(options) : write_cells_of_sites(options);
}

Command add_regions_command(CLI::App& tool) {
  auto options = std::make_shared<RegionsOptions>();
  CLI::App* parser = tool.add_subcommand("regions", "Clip and join Voronoi or power cells");
  add_input_options(*parser, options->common);
  add_output_option(
      *parser, options->common,
      "Where to write the regions: .geojson (a feature per cell, group or piece, with\n"
      "its area and the input's columns); with GDAL installed .gpkg .fgb .parquet")
      ->required();
  parser
      ->add_option("--tolerance", options->tolerance_deg,
                   "How far a line may be from its great circle (default: 0.01)")
      ->check(positive_error)
      ->type_name("DEG");
  add_region_options(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "Areas are in steradians; --earth-radius adds square kilometres. Hidden sites, which\n"
      "only circles and other weighted sites may be, have no cell. 'rondel voronoi' writes whole\n"
      "cells, and takes these options, too.\n\n"
      "GeoPackage, FlatGeobuf and GeoParquet are written by GDAL (libgdal 3.0 or newer), which\n"
      "is looked for where the system has its libraries, or where RONDEL_GDAL says.\n\n"
      "Examples:\n"
      "  rondel regions stations.csv --clip land.geojson -o parts.geojson\n"
      "  rondel regions stations.csv --clip land.geojson --group country -o groups.geojson\n"
      "  rondel regions stations.csv --clip countries.geojson --clip-value name -o parts.gpkg\n"
      "  rondel regions rivers.geojson --densify 0.5 --earth-radius 6371.0088 -o basins.geojson");
  return {parser, [options] { return run_regions(*options); }};
}

}  // namespace rondel::cli
