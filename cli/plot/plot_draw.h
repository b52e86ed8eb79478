// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Draws a triangulation and its dual on the globe.
///
/// in    layers of points, arcs, circles and cells in the view frame (globe.h)
/// out   the bytes of a picture
/// index layers refer to their own points; cells, areas and values are indexed by site
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
  int size = 1000;         ///< width and height of the picture in pixels
  double line_width = 0;   ///< in pixels; 0: chosen by the density of the arcs
  int graticule_deg = 30;  ///< distance between its circles in degrees; 0: none
  bool show_sites = true;
  bool show_back = false;  ///< draw the arcs and circles behind the globe, faintly
};

/// Points of the sphere in the view frame, and arcs between them.
struct ArcLayer {
  std::vector<Point> points;
  std::vector<ArcEnds> arcs;
};

/// The cells to fill; their corners are in the view frame.
struct FilledCells {
  Cells cells;
  // by site
  std::vector<double> areas;
  std::vector<double> values{};  ///< by site: the values that determine the colors; empty: areas do
};

/// The content of a figure. Layers that are not wanted stay empty.
struct Figure {
  FigureStyle style;
  View view{LonLat{}};
  LineLayer coast;
  std::vector<Point> sites;  ///< the vertices, in the view frame
  double spacing = 0;        ///< median distance of neighboring sites, see median_spacing()
  ArcLayer triangulation;
  ArcLayer diagram;
  std::vector<Circle> circles;  ///< axes in the view frame
  std::optional<FilledCells> filled;
  std::optional<ValueField> field;
  std::optional<ValueScale> scale;  ///< scale of the values, which have a bar below the globe
  ArcLayer isolines;
};

/// True if a figure has very many arcs with lines thinner than a pixel and, in a format that can be
/// magnified, closer together than pixels.
bool is_dense(const Figure& figure, FigureFormat format);

/// Returns the bytes of the figure. With `as_pixels`, arcs, circles, cells and sites are painted as
/// pixels instead of paths, by `threads` threads, which looks the same if is_dense() is true, and
/// is much faster. The bytes do not depend on the threads.
std::string draw(const Figure& figure, FigureFormat format, bool as_pixels, unsigned threads = 1);
inline std::string draw(const Figure& figure, FigureFormat format) {
  return draw(figure, format, is_dense(figure, format));
}

}  // namespace rondel::cli
