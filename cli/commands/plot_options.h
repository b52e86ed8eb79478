// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of `rondel plot`.
///
/// in    the command line
/// out   what a picture or a page shows; options that are not given are chosen by the others
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "job.h"
#include "plot_draw.h"

namespace rondel::cli {

/// Which edges are drawn: those of the triangles, those of the cells, or both.
enum class Show { none, delaunay, voronoi, both };
/// Colors show nothing, the areas of the cells, a value in each cell, or a field that is linear in
/// the triangles.
enum class Fill { none, area, cells, field };

/// The options as they are given.
struct PlotOptions {
  CommonOptions common;
  FigureStyle style;
  std::optional<Show> show;  ///< if not given: nothing if cells are filled, otherwise the
                             ///< triangulation
  std::optional<Fill> fill;  ///< if not given: by values if there are any
  bool show_circles = false;
  std::string values;   ///< --values: a column; empty: none
  double contours = 0;  ///< --contours: their step; 0: not given
  /// --sites, --no-sites; if not given: shown without --values, and in pages.
  std::optional<bool> show_sites;
  std::optional<bool> show_coast;  ///< if not given: for longitudes and latitudes, and in pages
  std::vector<double> view;        ///< LON LAT, or empty
  /// --up: the direction that points up, in degrees clockwise from north.
  double up_deg = 0;
  std::string only_pictures;  ///< a given option that pages do not have; empty: none
};

/// Returns how the cells, or the globe, are filled.
inline Fill filling(const PlotOptions& options) {
  return options.fill.value_or(options.values.empty() ? Fill::none : Fill::field);
}

/// Returns which edges are drawn.
Show shown(const PlotOptions& options);

/// Returns the values of --values as Job::shown_values() does; none without --values.
std::vector<double> values_of_figure(const PlotOptions& options, Job& job, const SiteTable& table,
                                     const Triangulation& triangulation);

/// Adds the options that say what is shown, and from where.
void add_plot_options(CLI::App& parser, PlotOptions& options);

}  // namespace rondel::cli
