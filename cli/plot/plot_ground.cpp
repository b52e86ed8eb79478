// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "plot_ground.h"

#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

// The lines are translucent, so that the colors below show through.
constexpr Color graticule_color{0.40, 0.48, 0.55, 0.38};
constexpr Color coast_color{0.20, 0.25, 0.35, 0.75};

}  // namespace

// The offsets stay those of the positions, since each position becomes one point.
LineLayer seen(const CompressedRows<LonLat>& lines, const View& view) {
  LineLayer layer{lines.offsets, {}};
  for (const LonLat& p : lines.values) layer.values.push_back(view.turn(unit_vector(p)));
  return layer;
}

void draw_coast(Canvas& canvas, const LineLayer& coast, int size) {
  const double tolerance = 0.02 / canvas.radius();
  for (std::size_t line = 0; line < coast.size(); ++line) {
    trace_line(canvas, coast[line], Side::front, tolerance);
  }
  canvas.stroke(coast_color, 0.9 * size / 1000);
}

void draw_graticule(Canvas& canvas, const View& view, int step, int size) {
  if (step == 0) return;
  const Point north = view.turn({0, 0, 1});
  for (int lon = 0; lon < 180; lon += step) {
    // The plane of the meridians lon and lon + 180 is normal to the direction 90 degrees east.
    const Point normal = view.turn(unit_vector({lon + 90.0, 0}));
    trace_circle(canvas, normal, 90, Side::front);
  }
  for (int colatitude = step; colatitude < 180; colatitude += step) {
    trace_circle(canvas, north, colatitude, Side::front);
  }
  canvas.stroke(graticule_color, 0.7 * size / 1000);
}

}  // namespace rondel::cli
