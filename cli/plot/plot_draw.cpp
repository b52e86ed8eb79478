// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_draw.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "plot_pixels.h"
#include "rondel/delaunay.h"
#include "run_pieces.h"

namespace rondel::cli {
namespace {

// The colors of the layers. A globe is shaded from a light color, where the light falls, to a dark
// one at the limb; the clear ones lie over filled cells and let their colors through.
constexpr Color white{1, 1, 1};
constexpr Color globe_light{1, 1, 1};
constexpr Color globe_dark{0.860, 0.890, 0.920};
constexpr Color clear_light{1, 1, 1, 0.10};
constexpr Color clear_dark{0.05, 0.10, 0.20, 0.17};
constexpr Color limb_color{0.36, 0.42, 0.48};
constexpr Color triangulation_color{0.090, 0.200, 0.430};
constexpr Color diagram_color{0.850, 0.270, 0.080};
constexpr Color diagram_on_fill_color{0.060, 0.130, 0.220, 0.55};
constexpr Color circle_color{0.000, 0.440, 0.340};
constexpr Color hidden_circle_color{0.000, 0.440, 0.340, 0.30};
constexpr Color isoline_color{0.02, 0.02, 0.04, 0.75};
constexpr Color site_color{0.06, 0.06, 0.08};

// Lines on the far side of the globe have colors that are mixed with white.
const Color triangulation_back_color = blend(triangulation_color, white, 0.75);
const Color diagram_back_color = blend(diagram_color, white, 0.70);
constexpr double back_circle_paleness = 0.75;

// Edges of cells are dark on filled cells, which have all colors, and red otherwise.
const Color& front_diagram_color(const Figure& figure) {
  return figure.filled ? diagram_on_fill_color : diagram_color;
}

// One stroke of very many arcs is slow, and so is a stroke for each arc.
constexpr std::size_t arcs_in_a_stroke = 200;
constexpr std::size_t min_strokes = 64;

// The widths of a figure's lines, in pixels.
struct Widths {
  double line, dot_radius;
};

// Makes lines and dots smaller where sites are close, so that dense figures stay readable.
Widths widths(const Figure& figure, double radius) {
  const double unit = figure.style.size / 1000.0;
  const double spacing = figure.spacing * radius;
  const double line = figure.style.line_width > 0
                          ? figure.style.line_width
                          : std::clamp(0.15 * spacing, 0.25 * unit, 1.3 * unit);
  return {line, std::clamp(0.25 * spacing, 0.4 * unit, 2.6 * unit)};
}

// Draws the arcs in strokes that take every k-th of them, so that neighbors, which follow each
// other, come in different strokes. Within one stroke the coverage of a pixel adds
// up, and a fan of thin arcs would become a blot; strokes laid over each other keep its shades.
void draw_arcs(Canvas& canvas, const ArcLayer& layer, Side side, const Color& color, double width) {
  const double tolerance = 0.02 / canvas.radius();
  const std::size_t num_strokes = std::max(min_strokes, layer.arcs.size() / arcs_in_a_stroke);
  for (std::size_t stroke = 0; stroke < num_strokes; ++stroke) {
    for (std::size_t i = stroke; i < layer.arcs.size(); i += num_strokes) {
      const auto& [from, to] = layer.arcs[i];
      trace_arc(canvas, layer.points[from], layer.points[to], side, tolerance);
    }
    canvas.stroke(color, width);
  }
}

// Draws circles in strokes of every k-th circle, like draw_arcs(). Circles without a cell come
// first, paler.
void draw_circles(Canvas& canvas, std::span<const Circle> circles, Side side, double paleness,
                  double width) {
  const std::size_t num_strokes = std::max(min_strokes, circles.size() / arcs_in_a_stroke);
  for (const bool is_hidden : {true, false}) {
    const Color& color = is_hidden ? hidden_circle_color : circle_color;
    for (std::size_t stroke = 0; stroke < num_strokes; ++stroke) {
      for (std::size_t i = stroke; i < circles.size(); i += num_strokes) {
        const Circle& circle = circles[i];
        if (circle.is_hidden == is_hidden) {
          trace_circle(canvas, circle.axis, circle.radius_deg, side);
        }
      }
      canvas.stroke(blend(color, white, paleness), width);
    }
  }
}

// Maps a cell's area to the scale from 0 to 1: logarithmic, between the 2nd and 98th percentile.
class AreaScale {
 public:
  explicit AreaScale(std::span<const double> areas) {
    std::vector<double> logs;
    for (const double area : areas) {
      if (area > 0) logs.push_back(std::log(area));
    }
    if (logs.empty()) return;
    std::sort(logs.begin(), logs.end());
    low_ = logs[logs.size() / 50];
    high_ = logs[logs.size() - 1 - logs.size() / 50];
  }
  [[nodiscard]] double operator()(double area) const {
    return high_ > low_ ? (std::log(area) - low_) / (high_ - low_) : 0.5;
  }

 private:
  double low_ = 0, high_ = 0;
};

// Calls paint(corners, color) for the cells; the cell of a single site, which is the whole sphere,
// has no corners.
template <class Paint>
void for_each_cell(const Figure& figure, const Paint& paint) {
  const FilledCells& filled = *figure.filled;
  const bool has_values = !filled.values.empty();
  const AreaScale scale(has_values ? std::span<const double>() : filled.areas);
  const Cells& cells = filled.cells;
  std::vector<Point> corners;
  for (std::size_t cell = 0; cell < filled.areas.size(); ++cell) {
    const double area = filled.areas[cell];
    if (!(area > 0)) continue;  // duplicates and hidden sites have no cell
    corners.clear();
    for (const Index i : cells.rings[cell]) corners.push_back(cells.points[i]);
    if (!has_values) {
      paint(std::span<const Point>(corners), area_color(scale(area)));
    } else if (!std::isnan(filled.values[cell])) {
      paint(std::span<const Point>(corners), figure.scale->color(filled.values[cell]));
    }
  }
}

// Fills the visible parts of the cells, each as one path.
void draw_filled_cells(Canvas& canvas, const Figure& figure) {
  const double tolerance = 0.02 / canvas.radius();
  for_each_cell(figure, [&](std::span<const Point> corners, const Color& color) {
    if (corners.empty()) {
      canvas.globe();
    } else if (!trace_region(canvas, corners, tolerance)) {
      return;
    }
    canvas.fill_to_seam(color);
  });
}

// Draws a dot for each site in front; a path has a limited number of them, since long paths are
// slow.
void draw_sites(Canvas& canvas, std::span<const Point> sites, double radius) {
  std::size_t count = 0;
  for (const Point& site : sites) {
    if (site.z < 0) continue;
    canvas.dot({site.x, site.y}, radius);
    if (++count % arcs_in_a_stroke == 0) canvas.fill(site_color);
  }
  canvas.fill(site_color);
}

// Draws what is behind the globe, as paths.
void draw_back(Canvas& canvas, const Figure& figure, double width) {
  draw_arcs(canvas, figure.triangulation, Side::back, triangulation_back_color, width);
  draw_arcs(canvas, figure.diagram, Side::back, diagram_back_color, width);
  draw_circles(canvas, figure.circles, Side::back, back_circle_paleness, width);
}

// Draws what is in front, as paths: later layers lie over earlier ones.
void draw_front(Canvas& canvas, const Figure& figure, const Widths& width) {
  draw_circles(canvas, figure.circles, Side::front, 0, width.line);
  draw_arcs(canvas, figure.triangulation, Side::front, triangulation_color, width.line);
  draw_arcs(canvas, figure.diagram, Side::front, front_diagram_color(figure), width.line);
  if (figure.style.show_sites) draw_sites(canvas, figure.sites, width.dot_radius);
}

// Paints layers as pixels, in some rows of the picture.
class PixelLayer {
 public:
  PixelLayer(int size, double radius, int first_row, int past_row)
      : pixels_(size, first_row, past_row),
        pen_(pixels_, size / 2.0, radius),
        tolerance_(0.02 / radius) {}
  ~PixelLayer() = default;
  PixelLayer(const PixelLayer&) = delete;
  PixelLayer& operator=(const PixelLayer&) = delete;

  [[nodiscard]] const Pixels& pixels() const { return pixels_; }

  // Paints the arcs of a layer on one side of the globe; `width` is in pixels.
  void add_arcs(const ArcLayer& layer, Side side, const Color& color, double width) {
    for (const auto& [from, to] : layer.arcs) {
      const Point& a = layer.points[from];
      const Point& b = layer.points[to];
      if (pen_.is_elsewhere(a, b, width)) continue;
      trace_arc(pen_, a, b, side, tolerance_);
      pen_.stroke(color, width);
    }
  }

  // Paints circles, hidden ones first; `paleness` is the share of white in their color.
  void add_circles(std::span<const Circle> circles, Side side, double paleness, double width) {
    for (const bool is_hidden : {true, false}) {
      const Color color = blend(is_hidden ? hidden_circle_color : circle_color, white, paleness);
      for (const Circle& circle : circles) {
        if (circle.is_hidden != is_hidden) continue;
        trace_circle(pen_, circle.axis, circle.radius_deg, side);
        pen_.stroke(color, width);
      }
    }
  }

  // Paints the cells; a cell without corners is the whole sphere.
  void add_filled_cells(const Figure& figure) {
    for_each_cell(figure, [&](std::span<const Point> corners, const Color& color) {
      if (corners.empty()) {
        trace_circle(pen_, {0, 0, 1}, 90, Side::front);
      } else if (!trace_region(pen_, corners, tolerance_)) {
        return;
      }
      pen_.fill(color, Canvas::seam_width);
    });
  }

  // Paints the sites in front as discs; `radius` is in pixels.
  void add_sites(std::span<const Point> sites, double radius) {
    for (const Point& site : sites) {
      const Spot place{site.x, site.y};
      if (site.z >= 0 && !pen_.is_elsewhere(place, radius)) pen_.dot(place, radius, site_color);
    }
  }

 private:
  Pixels pixels_;
  PixelPen pen_;
  double tolerance_;
};

// Paints on the canvas what add(layer) paints on each of the bands into which the picture is
// divided; several threads paint bands at once.
template <class Add>
void paint(Canvas& canvas, const Figure& figure, unsigned threads, const Add& add) {
  const int size = figure.style.size;
  const int num_bands = std::min(size, static_cast<int>(2 * std::min(threads, 256U)));
  std::vector<std::uint32_t> argb(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  run_pieces(threads, num_bands, [&](int band) {
    const auto row_of = [&](int k) { return static_cast<int>(std::int64_t{size} * k / num_bands); };
    PixelLayer layer(size, canvas.radius(), row_of(band), row_of(band + 1));
    add(layer);
    for (int row = row_of(band); row < row_of(band + 1); ++row) {
      const auto side = static_cast<std::size_t>(size);
      layer.pixels().copy_row(row,
                              std::span(argb).subspan(static_cast<std::size_t>(row) * side, side));
    }
  });
  canvas.paint(argb);
}

// Fields are painted as pixels in every format, since paths have one color each.
void draw_field(Canvas& canvas, const Figure& figure, unsigned threads) {
  const int size = figure.style.size;
  const auto side = static_cast<std::size_t>(size);
  const int num_bands = std::min(size, static_cast<int>(2 * std::min(threads, 256U)));
  std::vector<std::uint32_t> argb(side * side, 0);
  run_pieces(threads, num_bands, [&](int band) {
    const auto row_of = [&](int k) { return static_cast<int>(std::int64_t{size} * k / num_bands); };
    const auto begin = static_cast<std::size_t>(row_of(band)) * side;
    const auto end = static_cast<std::size_t>(row_of(band + 1)) * side;
    paint_field(*figure.field, *figure.scale, size, canvas.radius(), row_of(band), row_of(band + 1),
                std::span(argb).subspan(begin, end - begin));
  });
  canvas.paint(argb);
}

// Paints what draw_back() draws, as pixels.
void add_back(PixelLayer& layer, const Figure& figure, double width) {
  layer.add_arcs(figure.triangulation, Side::back, triangulation_back_color, width);
  layer.add_arcs(figure.diagram, Side::back, diagram_back_color, width);
  layer.add_circles(figure.circles, Side::back, back_circle_paleness, width);
}

// Paints what draw_front() draws, as pixels.
void add_front(PixelLayer& layer, const Figure& figure, const Widths& width) {
  layer.add_circles(figure.circles, Side::front, 0, width.line);
  layer.add_arcs(figure.triangulation, Side::front, triangulation_color, width.line);
  layer.add_arcs(figure.diagram, Side::front, front_diagram_color(figure), width.line);
  if (figure.style.show_sites) layer.add_sites(figure.sites, width.dot_radius);
}

}  // namespace

bool is_dense(const Figure& figure, FigureFormat format) {
  constexpr std::size_t many = 100'000;  // paths take a second
  const std::size_t shapes =
      figure.triangulation.arcs.size() + figure.diagram.arcs.size() + figure.circles.size();
  const double radius = Canvas::radius_of(figure.style.size);
  const bool can_magnify = format != FigureFormat::png;
  return shapes >= many && widths(figure, radius).line < 1 &&
         (!can_magnify || figure.spacing * radius < 1);
}

std::string draw(const Figure& figure, FigureFormat format, bool as_pixels, unsigned threads) {
  Canvas canvas(format, figure.style.size, figure.scale ? bar_height(figure.style.size) : 0);
  const Widths width = widths(figure, canvas.radius());
  const double back_width = 0.7 * width.line;
  const auto paint_layer = [&](const auto& add) { paint(canvas, figure, threads, add); };
  canvas.globe();
  canvas.shade(globe_light, globe_dark);
  if (figure.style.show_back && as_pixels) {
    paint_layer([&](PixelLayer& layer) { add_back(layer, figure, back_width); });
  } else if (figure.style.show_back) {
    draw_back(canvas, figure, back_width);
  }
  if (figure.filled) {
    if (as_pixels) {
      paint_layer([&](PixelLayer& layer) { layer.add_filled_cells(figure); });
    } else {
      draw_filled_cells(canvas, figure);
    }
    // A light would change the meaning of the colors.
    if (!figure.scale) {
      canvas.globe();
      canvas.shade(clear_light, clear_dark);
    }
  }
  if (figure.field) draw_field(canvas, figure, threads);
  draw_coast(canvas, figure.coast, figure.style.size);
  draw_graticule(canvas, figure.view, figure.style.graticule_deg, figure.style.size);
  draw_arcs(canvas, figure.isolines, Side::front, isoline_color,
            figure.style.line_width > 0 ? figure.style.line_width : 1.2 * figure.style.size / 1000);
  if (as_pixels) {
    paint_layer([&](PixelLayer& layer) { add_front(layer, figure, width); });
  } else {
    draw_front(canvas, figure, width);
  }
  canvas.globe();
  canvas.stroke(limb_color, 1.2 * figure.style.size / 1000);
  if (figure.scale) draw_bar(canvas, *figure.scale, figure.style.size);
  return canvas.finish();
}

}  // namespace rondel::cli
