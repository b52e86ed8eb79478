// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws pictures for `rondel plot`: the layers of a figure in the view frame, drawn by plot_draw.h.
// in    sites, and a column of values where --values names one
// out   a picture (.png .svg .pdf)
// index values, cells and areas are indexed by site; arcs by the points of their own layer
#include "plot_picture.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "globe.h"
#include "job.h"
#include "levels.h"
#include "plot_draw.h"
#include "rondel/contours.h"
#include "rondel/diagram.h"
#include "rondel/globe.h"
#include "run_pieces.h"

namespace rondel::cli {
namespace {

// Returns the directions of the sites from the center of the sphere.
// The result is indexed by site; a site at the center of the sphere has the zero vector.
std::vector<Point> directions(std::span<const Point> sites, const Point& center) {
  std::vector<Point> result(sites.size());
  std::ranges::transform(sites, result.begin(), [&](const Point& p) {
    // The coordinates are halved, so that a difference of huge coordinates is finite.
    const Point half{p.x / 2 - center.x / 2, p.y / 2 - center.y / 2, p.z / 2 - center.z / 2};
    return half == Point{} ? Point{} : normalized(half);
  });
  return result;
}

// Views the middle of the sites if they are on one side of the globe, so that their mean is far
// from the center. Otherwise views the globe from a little north of the equator at the meridian of
// Greenwich.
View default_view(std::span<const Point> sites, double up_deg) {
  Point sum{};
  for (const Point& p : sites) sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  const double length = std::hypot(sum.x, sum.y, sum.z);
  // A mean shorter than 1/2 means that the sites are all around.
  if (length <= 0.5 * static_cast<double>(sites.size())) return View({0, 20}, up_deg);
  const double degrees = 180 / std::numbers::pi;
  return View(
      {std::atan2(sum.y, sum.x) * degrees, std::atan2(sum.z, std::hypot(sum.x, sum.y)) * degrees},
      up_deg);
}

// Returns the points in the view frame.
std::vector<Point> turned(std::vector<Point> points, const View& view) {
  std::ranges::transform(points, points.begin(), [&](const Point& p) { return view.turn(p); });
  return points;
}

// Returns the arcs of the isolines as pairs of places in the values of their rows.
std::vector<ArcEnds> line_arcs(const Isolines& lines) {
  std::vector<ArcEnds> arcs;
  for (std::size_t line = 0; line < lines.num_lines(); ++line) {
    const auto begin = static_cast<Index>(lines.lines.rows.offsets[line]);
    const auto end = static_cast<Index>(lines.lines.rows.offsets[line + 1]);
    for (Index i = begin; i + 1 < end; ++i) arcs.push_back({i, i + 1});
    if (lines.is_closed[line] != 0) arcs.push_back({end - 1, begin});
  }
  return arcs;
}

// Returns the vertices: all sites except duplicates, hidden ones and one at the center of the
// sphere, which a hull may have as a corner.
// `points` has a point for each site; the result is shorter and has no index.
std::vector<Point> vertices(const Triangulation& triangulation, std::vector<Point> points) {
  const std::vector<bool> is_vertex = are_vertices(triangulation);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool has_direction = points[i] != Point{};
    if (is_vertex[i] && has_direction) points[count++] = points[i];
  }
  points.resize(count);
  return points;
}

// Adds the field, its isolines and the scale of its colors.
// `directions` and `values` are indexed by site; the former are in the view frame. A triangle
// without three values, or a ghost face, has no color.
void add_values(Figure& figure, const PlotOptions& options, const Triangulation& triangulation,
                std::span<const Point> directions, std::vector<double> values,
                const Execution& execution) {
  figure.scale = scale_of(values, options.values);
  if (options.contours > 0) {
    const auto levels = levels_at(options.contours, values, "--contours");
    const Isolines lines = isolines(triangulation, values, levels, execution);
    figure.isolines = {turned(lines.lines.rows.values, figure.view), line_arcs(lines)};
  }
  if (filling(options) == Fill::cells) {
    figure.filled->values = std::move(values);
  } else if (filling(options) == Fill::field) {
    std::vector<Triple> faces;
    for (Index f = 0; f < triangulation.num_faces(); ++f) {
      const auto& [a, b, c] = triangulation.faces()[f];
      const bool has_values =
          !std::isnan(values[a]) && !std::isnan(values[b]) && !std::isnan(values[c]);
      // A ghost face is not seen from the center, so no value is linear in it.
      if (has_values && !triangulation.is_ghost(f)) faces.push_back(triangulation.faces()[f]);
    }
    figure.field = {{directions.begin(), directions.end()}, std::move(values), std::move(faces)};
  }
}

// Computes the layers of a picture in the view frame.
// \param values  a value for each site; empty without --values
Figure make_figure(const PlotOptions& options, const Triangulation& triangulation,
                   const SiteTable& table, std::vector<double> values, const Execution& execution) {
  const Show show = shown(options);
  Figure figure;
  figure.style = options.style;
  figure.style.show_sites = options.show_sites.value_or(options.values.empty());
  std::vector<Point> sites = directions(table.sites, triangulation.sphere().center);
  figure.view = options.view.empty() ? default_view(sites, options.up_deg)
                                     : View({options.view[0], options.view[1]}, options.up_deg);
  // Coasts help where sites are longitudes and latitudes, which are places on the Earth.
  if (options.show_coast.value_or(table.is_lonlat())) {
    figure.coast = seen(coast_lines(), figure.view);
  }
  if (options.show_circles) {
    figure.circles = real_circles(table, triangulation, sites);
    for (Circle& circle : figure.circles) circle.axis = figure.view.turn(circle.axis);
  }
  std::vector<ArcEnds> arcs = triangulation_arcs(triangulation, sites);
  sites = turned(std::move(sites), figure.view);
  // The arcs refer to `points`, whose order follows them: neighbors in memory are near each other.
  std::vector<Point> points = in_order_of_arcs(arcs, sites);
  const std::vector<Point> in_view = options.values.empty() ? std::vector<Point>() : sites;
  figure.sites = vertices(triangulation, std::move(sites));
  figure.spacing = median_spacing(arcs, points);
  const bool has_filled_cells = filling(options) == Fill::area || filling(options) == Fill::cells;
  const bool has_cells = show == Show::voronoi || show == Show::both;
  if (show == Show::delaunay || show == Show::both) {
    figure.triangulation = {std::move(points), std::move(arcs)};
  }
  if (has_cells || has_filled_cells) {
    // Cells serve the edges of the diagram and the filling; they are computed once for both.
    auto [cells, cell_areas] = diagram(triangulation, execution);
    cells.points = turned(std::move(cells.points), figure.view);
    if (has_cells) {
      figure.diagram.arcs = cell_arcs(cells);
      figure.diagram.points = cells.points;
    }
    if (has_filled_cells) figure.filled = {std::move(cells), std::move(cell_areas), {}};
  }
  if (!options.values.empty()) {
    add_values(figure, options, triangulation, in_view, std::move(values), execution);
  }
  return figure;
}

// Warns of a drawing of very many arcs, which programs take minutes to open. Pictures of pixels are
// not affected.
void warn_of_size(const PlotOptions& options, const Figure& figure, FigureFormat format) {
  const std::size_t arcs =
      figure.triangulation.arcs.size() + figure.diagram.arcs.size() + figure.circles.size();
  if (options.common.quiet || format == FigureFormat::png || arcs < 200'000) return;
  if (is_dense(figure, format)) {
    std::cerr << "rondel: " << options.common.output << " holds pixels, as " << arcs
              << " arcs are closer together than these; --size N for more of them\n";
    return;
  }
  std::cerr << "rondel: " << options.common.output << " holds up to " << arcs
            << " arcs and will be large; a .png is small\n";
}

}  // namespace

ExitStatus run_picture(const PlotOptions& options, FigureFormat format) {
  CommonOptions common = options.common;
  common.read.keep_columns = !options.values.empty();
  Job job(common);
  std::vector<std::string> names;
  if (!options.values.empty()) names.push_back(options.values);
  const SiteTable table = job.read(common.source(), common.read, names);
  const Triangulation triangulation = job.triangulate(table);
  std::vector<double> values = values_of_figure(options, job, table, triangulation);
  Figure figure;
  job.time(Stage::dual, [&] {
    figure = make_figure(options, triangulation, table, std::move(values), job.execution());
  });
  warn_of_size(options, figure, format);
  job.time(Stage::write, [&] {
    write_file(options.common.output,
               draw(figure, format, is_dense(figure, format), num_workers(options.common.threads)));
  });
  job.report(triangulation, "the figure");
  return done;
}

}  // namespace rondel::cli
