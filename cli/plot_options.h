// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of `rondel plot`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "plot_draw.h"

namespace rondel::cli {

enum class Show { none, delaunay, voronoi, both };
enum class Fill { none, area, cells, field };

struct PlotOptions {
  CommonOptions common;
  FigureStyle style;
  std::optional<Show> show;  ///< none: the cells if they are filled, otherwise the triangulation
  std::optional<Fill> fill;  ///< none: by values if there are any
  bool show_circles = false;
  std::string values;   ///< --values: a column; empty: none
  double contours = 0;  ///< --contours: their step; 0: none
  std::optional<bool> show_sites;
  std::optional<bool> show_coast;  ///< none: under longitudes and latitudes, and in pages
  std::vector<double> view;        ///< LON LAT, or empty
  double up_deg = 0;
  std::string only_pictures;  ///< an option that was given and that pages do not have; empty: none
};

/// How the cells, or the globe, are filled.
inline Fill filling(const PlotOptions& options) {
  return options.fill.value_or(options.values.empty() ? Fill::none : Fill::field);
}

/// What is shown, and from where.
void add_plot_options(CLI::App& parser, PlotOptions& options);

}  // namespace rondel::cli
