// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The options of `rondel plot`, and the choices that follow from them: which edges are drawn, how
// cells are filled, and which values are shown.
// in    the command line; for values_of_figure() also the sites and their triangulation
// out   PlotOptions; values by site
#include "plot_options.h"

#include <utility>

#include "column_values.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The words of an option in the order in which a message names them.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// Adds an option whose values are words.
// A word that is not among the choices is a usage error, whose message lists them in this order.
// The target may be an optional, so that an option not given can be told.
template <class Value, class Target>
void add_choice(CLI::App& parser, const std::string& name, Target& target,
                const Choices<Value>& choices, const std::string& help) {
  const auto set_target = [&target, choices](const std::string& text) {
    for (const auto& [word, value] : choices) {
      if (word == text) target = value;
    }
  };
  std::string words;
  std::vector<std::string> names;
  for (const auto& choice : choices) {
    words += (words.empty() ? "" : ", ") + choice.first;
    names.push_back(choice.first);
  }
  parser.add_option_function<std::string>(name, set_target, help)
      ->check(one_of(names, "is not one of " + words))
      ->type_name("WHAT");
}

// Adds the options that say what is drawn.
void add_content_options(CLI::App& parser, PlotOptions& options) {
  add_choice<Show>(parser, "--show", options.show,
                   {{"none", Show::none},
                    {"delaunay", Show::delaunay},
                    {"voronoi", Show::voronoi},
                    {"both", Show::both}},
                   "delaunay (default), voronoi (default where cells are filled), both or none\n"
                   "(default where a field is)");
  add_choice<Fill>(
      parser, "--fill", options.fill,
      {{"none", Fill::none}, {"area", Fill::area}, {"cells", Fill::cells}, {"field", Fill::field}},
      "area: color the cells by area, dark for small ones; cells: by --values;\n"
      "field: the values, linear in the triangles (default with --values in\n"
      "pictures); none (default)");
  add_choice<bool>(parser, "--back", options.style.show_back, {{"none", false}, {"faint", true}},
                   "What is behind the globe: faint, or none (default)");
  const CLI::Option* const values =
      parser
          .add_option(
              "--values", options.values,
              "A column of numbers, shown as colors with a color bar. Of netCDF a variable,\n"
              "of one with several times 'NAME[3]', 'NAME[-1]' or NAME_2001-07-15")
          ->type_name("COL");
  require_effect(
      options.common, values,
      [&options] {
        const bool is_page = options.common.format() == "html";
        return is_page || options.contours > 0 || filling(options) == Fill::cells ||
               filling(options) == Fill::field;
      },
      "with --fill none and area, unless --contours draws isolines");
  parser
      .add_option("--contours", options.contours,
                  "Draw isolines of --values at the multiples of STEP")
      ->check(positive_error)
      ->type_name("STEP");
  parser.add_flag("--circles", options.show_circles,
                  "Draw the circles for which weighted sites stand, hidden ones paler");
  const auto show_sites = [&options](bool show) {
    return [&options, show] { options.show_sites = show; };
  };
  CLI::Option* sites = parser.add_flag_callback(
      "--sites", show_sites(true), "Draw the sites as dots (default without --values)");
  parser.add_flag_callback("--no-sites", show_sites(false), "Do not draw the sites")
      ->excludes(sites);
  add_choice<bool>(parser, "--coast", options.show_coast, {{"none", false}, {"110m", true}},
                   "Coasts at 1:110 million under the drawing (default where sites are\n"
                   "longitudes and latitudes, and in pages), or none");
  parser
      .add_option("--graticule", options.style.graticule_deg,
                  "Distance of meridians and parallels: 30 (default), 15, 10, 5, or 0\nfor none")
      ->check(one_of({"0", "5", "10", "15", "30"}, "is not one of 0, 5, 10, 15, 30"))
      ->type_name("DEG");
}

// Adds the options that say from where the globe is seen, and how large the picture is.
void add_view_options(CLI::App& parser, PlotOptions& options) {
  parser
      .add_option("--view", options.view,
                  "The place that faces the viewer, in degrees (default: the middle of the\n"
                  "sites, or 0 20 if they are all around)")
      ->expected(2)
      ->check(finite_error)
      ->type_name("LON LAT");
  parser
      .add_option("--up", options.up_deg,
                  "The direction that points up, in degrees clockwise from north (default: 0)")
      ->check(finite_error)
      ->type_name("DEG");
  parser.add_option("--size", options.style.size, "Width and height in pixels (default: 1000)")
      ->check([](const std::string& text) { return whole_error(text, 16, 20'000); })
      ->type_name("N");
  const CLI::Option* const line_width =
      parser
          .add_option("--line-width", options.style.line_width,
                      "Width of the arcs in pixels (default: thinner where sites are close)")
          ->check(positive_error)
          ->type_name("W");
  require_effect(
      options.common, line_width,
      [&options] {
        return shown(options) != Show::none || options.contours > 0 || options.show_circles;
      },
      "without lines: --show, --contours or --circles draws some");
}

}  // namespace

Show shown(const PlotOptions& options) {
  if (options.show) return *options.show;
  if (filling(options) == Fill::field) return Show::none;
  return filling(options) == Fill::none ? Show::delaunay : Show::voronoi;
}

std::vector<double> values_of_figure(const PlotOptions& options, Job& job, const SiteTable& table,
                                     const Triangulation& triangulation) {
  if (options.values.empty()) return {};
  const bool has_cells = options.common.format() == "html" || filling(options) == Fill::cells;
  return job.shown_values(triangulation, column_values(table, options.values, "--values"),
                          options.values,
                          has_cells ? "cells without a value have no color"
                                    : "triangles without three values have no color");
}

void add_plot_options(CLI::App& parser, PlotOptions& options) {
  add_content_options(parser, options);
  add_view_options(parser, options);
}

}  // namespace rondel::cli
