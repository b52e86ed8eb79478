// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Draws a triangulation and its dual on the globe.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot_arcs.h"
#include "plot_canvas.h"
#include "plot_circles.h"
#include "plot_field.h"
#include "plot_ground.h"
#include "rondel/types.h"

namespace rondel::cli {

/// How a figure looks.
struct FigureStyle {
  int size = 1000;         ///< of the square picture, in pixels
  double line_width = 0;   ///< in pixels; 0: follows the density of the arcs
  int graticule_deg = 30;  ///< distance of its circles; 0: none
  bool show_sites = true;
  bool show_back = false;  ///< the arcs and circles behind the globe, faintly
};

/// Points of the sphere in the view frame, and arcs between them.
struct ArcLayer {
  std::vector<Point> points;
  std::vector<ArcEnds> arcs;
};

/// The cells to fill, corners in the view frame.
struct FilledCells {
  Cells cells;
  std::vector<double> areas;
  std::vector<double> values{};  ///< that give the colors, of the sites; empty: areas do
};

/// What a figure shows. Layers that are not wanted stay empty.
struct Figure {
  FigureStyle style;
  View view{LonLat{}};
  LineLayer coast;
  std::vector<Point> sites;  ///< the vertices, in the view frame
  double spacing = 0;        ///< of the sites, see median_spacing()
  ArcLayer triangulation;
  ArcLayer diagram;
  std::vector<Circle> circles;  ///< axes in the view frame
  std::optional<FilledCells> filled;
  std::optional<ValueField> field;
  std::optional<ValueScale> scale;  ///< of values, if there are any: they have a bar below
  ArcLayer isolines;
};

/// Whether a figure has very many arcs with lines thinner than a pixel, and, for a format that can
/// be magnified, closer together than pixels.
bool is_dense(const Figure& figure, FigureFormat format);

/// The bytes of the figure. `as_pixels`: its arcs, circles, cells and sites are painted as pixels
/// instead of paths, by so many threads, which looks the same where is_dense() is true, and is much
/// faster. The bytes do not depend on the threads.
std::string draw(const Figure& figure, FigureFormat format, bool as_pixels, unsigned threads = 1);
inline std::string draw(const Figure& figure, FigureFormat format) {
  return draw(figure, format, is_dense(figure, format));
}

}  // namespace rondel::cli
