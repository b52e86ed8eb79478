// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel plot draws figures of the triangulation and its dual on the globe, and pages to turn it.
// in    sites, and a column of values where --values names one
// out   a picture (.png .svg .pdf) made by plot_picture.h, or a page (.html) made by plot_page.h
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "plot_options.h"
#include "plot_page.h"
#include "plot_picture.h"

namespace rondel::cli {
namespace {

// Returns the format of an ending; nothing for .html and endings that are not known.
std::optional<FigureFormat> figure_format(const std::string& name) {
  for (const auto& [known, format] : {std::pair{"png", FigureFormat::png},
                                      {"svg", FigureFormat::svg},
                                      {"pdf", FigureFormat::pdf}}) {
    if (name == known) return format;
  }
  return std::nullopt;
}

// Checks the options about the view and the circles before any file is read.
void require_view(const PlotOptions& options) {
  if (!options.view.empty() && std::abs(options.view[1]) > 90) {
    throw UsageError("--view: the latitude is outside [-90, 90]");
  }
  if (options.show_circles && options.common.build.model != Model::weighted) {
    throw UsageError("--circles: sites are circles with --radius or --model weighted");
  }
}

// Checks the options about values: fields and isolines need a column, and the model projected.
void require_values(const PlotOptions& options) {
  const bool needs_values = filling(options) == Fill::cells || filling(options) == Fill::field;
  if (options.values.empty() && needs_values) throw UsageError("--fill: --values names no column");
  if (options.values.empty() && options.contours > 0) {
    throw UsageError("--contours: --values names no column");
  }
  const bool is_page = options.common.format() == "html";
  const bool is_field = filling(options) == Fill::field && !is_page;
  const bool is_linear = is_field || options.contours > 0;
  if (options.common.build.model == Model::weighted && is_linear) {
    throw UsageError("--values: of weighted sites only --fill cells shows values");
  }
}

// Checks the options, then draws a picture, or hands a page over to run_page(). Throws UsageError
// for options that do not fit together, FileError for a file that cannot be read or written.
ExitStatus run_plot(const PlotOptions& options) {
  const bool is_page = options.common.format() == "html";
  const auto format = figure_format(options.common.format());
  require_output(options.common, is_page || format.has_value(), ".png .svg .pdf .html");
  require_view(options);
  require_values(options);
  if (is_page) return run_page(options);
#if defined(RONDEL_HAS_PICTURES)
  return run_picture(options, *format);
#else
  throw UsageError(options.common.output +
                   ": this rondel was built without Cairo, which draws pictures; it makes pages "
                   "(.html), and rondel in Python draws with Matplotlib");
#endif
}

}  // namespace

Command add_plot_command(CLI::App& tool) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* parser =
      tool.add_subcommand("plot", "Draw the triangulation or the cells on the globe");
  add_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the figure, .png .svg .pdf, or a page with a globe to\nturn, "
                    "zoom and point at, .html")
      ->required();
  add_plot_options(*parser, *options);
  add_build_options(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "The globe is seen from far away (orthographic projection). Edges are arcs of great\n"
      "circles; edges of ghost faces, which the center of the sphere does not see, are left\n"
      "out. The same input gives the same bytes. 100,000 arcs and more that are closer\n"
      "together than pixels are pixels in .svg and .pdf, too: --size says how many.\n\n"
      "A page (.html) is one file for any browser, without a server or a network. It carries\n"
      "all columns of INPUT, which are shown for the site that is picked and can be searched.\n"
      "What is shown can be switched there; the options say how it begins.\n\n"
      "Examples:\n"
      "  rondel plot stations.csv -o stations.png --view -60 35\n"
      "  rondel plot stations.csv -o cells.svg --show voronoi --fill area\n"
      "  rondel plot circles.csv --radius radius --circles --show voronoi -o power.pdf\n"
      "  rondel plot stations.csv --values temperature --contours 5 -o warm.png\n"
      "  rondel plot stations.csv -o globe.html\n"
      "  rondel plot cities.csv --values population -o cities.html\n"
      "  rondel plot stations.csv --values temperature --contours 5 -o warm.html");
  return {parser, [options, parser] {
            // A page refuses options that only pictures have; the parser knows which of them were
            // given.
            for (const char* name : {"--back", "--size", "--line-width"}) {
              if (parser->count(name) > 0) options->only_pictures = name;
            }
            if (options->show == Show::none) options->only_pictures = "--show none";
            if (options->fill == Fill::field) options->only_pictures = "--fill field";
            return run_plot(*options);
          }};
}

}  // namespace rondel::cli
