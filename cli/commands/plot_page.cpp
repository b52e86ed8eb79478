// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the page of `rondel plot` with the values, isolines and options that the command line
// gives; the page itself is made by the library (rondel/globe.h).
// in    INPUT with all columns, and the options of the plot
// out   one file of HTML
// index values are indexed by site
#include "plot_page.h"

#include <filesystem>

#include "column_values.h"
#include "levels.h"
#include "rondel/contours.h"
#include "rondel/diagram.h"
#include "rondel/globe.h"

namespace rondel::cli {
namespace {

// Returns "stations" for "data/stations.csv" and "Sites" for standard input.
std::string title_of(const std::string& input) {
  return input == "-" ? "Sites" : std::filesystem::path(input).stem().string();
}

// Returns the edges that the page shows at first; it can show others later.
GlobeLines lines_of(const PlotOptions& options) {
  const bool is_filled = options.fill == Fill::area || !options.values.empty();
  switch (options.show.value_or(is_filled ? Show::voronoi : Show::delaunay)) {
    case Show::voronoi:
      return GlobeLines::voronoi;
    case Show::both:
      return GlobeLines::both;
    default:
      return GlobeLines::delaunay;
  }
}

// Returns the options of the library's function; values and isolines are added by run_page().
GlobeOptions globe_options(const PlotOptions& options) {
  GlobeOptions globe;
  globe.title = title_of(options.common.input);
  globe.lines = lines_of(options);
  globe.fill = options.fill == Fill::area ? GlobeFill::area
               : !options.values.empty()  ? GlobeFill::values
                                          : GlobeFill::none;
  globe.show_sites = options.show_sites.value_or(true);
  globe.show_circles = options.show_circles;
  globe.show_coast = options.show_coast.value_or(true);
  globe.graticule_deg = options.style.graticule_deg;
  if (!options.view.empty()) globe.view = LonLat{options.view[0], options.view[1]};
  globe.up_deg = options.up_deg;
  globe.value_name = options.values;
  return globe;
}

}  // namespace

ExitStatus run_page(const PlotOptions& options) {
  if (!options.only_pictures.empty())
    throw UsageError(options.only_pictures + ": a page has no such option");
  CommonOptions common = options.common;
  common.read.keep_columns = true;
  Job job(common);
  const SiteTable table = job.read();
  GlobeOptions globe = globe_options(options);
  const Triangulation triangulation = job.triangulate(table);
  const std::vector<double> values = values_of_figure(options, job, table, triangulation);
  globe.values = values;
  // The page can switch to cells at any time, so it carries the diagram whatever is shown first.
  Diagram both;
  Isolines lines;
  if (options.contours > 0) {
    const std::vector<double> levels = levels_at(options.contours, values, "--contours");
    job.time(Stage::dual, [&] {
      lines = with_places(table,
                          [&] { return isolines(triangulation, values, levels, job.execution()); });
    });
    globe.isolines = &lines;
  }
  job.time(Stage::dual, [&] { both = diagram(triangulation, job.execution()); });
  job.time(Stage::write,
           [&] { write_globe(common.output, table, triangulation, both, globe, job.execution()); });
  job.report(triangulation, "the page");
  return done;
}

}  // namespace rondel::cli
