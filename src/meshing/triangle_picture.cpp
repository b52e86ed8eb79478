// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws the quality of triangles as SVG: histograms above, a map of the triangles below, colored by
// their smallest angles. Where there are too many of them to be drawn, each square of some pixels has
// the color of the smallest angle in it, so that bad triangles are seen and the file stays small.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/map_view.h"
#include "meshing/picture_parts.h"
#include "meshing/triangle_angles.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_quality.h"
#include "rondel/triangle_mesh.h"
#include "system/arithmetic.h"

namespace rondel::mesh {
namespace {

using meshing::count_in;
using meshing::fixed;
using meshing::MapPixel;
using meshing::MapView;
using meshing::text_at;

constexpr double legend_height = 24;
constexpr std::size_t most_drawn = 8000;  // about 50 bytes each

// Angles from `least_deg` on, up to the next class.
struct AngleClass {
  double least_deg;
  const char* color;  // pale where angles are good, and none that the color-blind mistake
  const char* words;
};
constexpr std::array<AngleClass, 6> classes = {{{0, "#a50026", "under 10"},
                                                {10, "#f46d43", "10 to 20"},
                                                {20, "#fdae61", "20 to 30"},
                                                {30, "#9ecae1", "30 to 40"},
                                                {40, "#c6dbef", "40 to 50"},
                                                {50, "#e3eef8", "50 to 60"}}};

std::size_t class_of(double angle_deg) {
  std::size_t k = classes.size() - 1;
  while (k > 0 && angle_deg < classes[k].least_deg) --k;
  return k;
}

using Corners = std::array<Point, 3>;

Corners corners_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {normalized(mesh.points[a]), normalized(mesh.points[b]), normalized(mesh.points[c])};
}

// Returns the base-2 logarithms of sides over their median, in steps of a quarter.
Histogram ratios_of_sides(std::vector<double> squares) {
  Histogram ratios{-4, 4, std::vector<std::uint64_t>(32)};
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::ranges::nth_element(squares, middle);
  const double median = *middle;
  for (const double square : squares) {
    int exponent = 0;  // of the square, from which the logarithm of the side is half as much
    const double fraction = std::frexp(square / median, &exponent);
    const double half = 2 * fraction >= std::numbers::sqrt2 ? 0.5 : 0;
    count_in(ratios, (exponent - 1 + half) / 2 + 0x1p-10);
  }
  return ratios;
}

std::string histograms(const TriangleMesh& mesh, std::span<const double> smallest_deg) {
  Histogram smallest{0, 60, std::vector<std::uint64_t>(60)};
  for (const double angle : smallest_deg) count_in(smallest, angle);
  Histogram all{0, 180, std::vector<std::uint64_t>(60)};
  std::vector<double> squares;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto of_triangle = meshing::squared_sides(corners_of(mesh, t));
    squares.insert(squares.end(), of_triangle.begin(), of_triangle.end());
    for (const double cosine : meshing::cosines(of_triangle)) {
      count_in(all, meshing::degrees_of_cosine(cosine));
    }
  }
  return meshing::bars(smallest, 0, "smallest angles of triangles, degrees") +
         meshing::bars(all, 1, "all angles, degrees") +
         meshing::bars(ratios_of_sides(std::move(squares)), 2, "sides over their median, log2");
}

// The outlines of a triangle on the map: one, and another one if it reaches beyond the map.
template <class Visit>
void visit_outlines(const MapView& view, const Corners& triangle, const Visit& visit) {
  std::vector<MapPixel> outline = view.outline(triangle);
  visit(outline);
  const double west = view.frame().corner.x;
  const auto [least, greatest] = std::ranges::minmax(outline, {}, &MapPixel::x);
  const double turn = view.pixels_of_turn();
  if (turn == 0 || (least.x >= west && greatest.x <= west + turn)) return;
  for (MapPixel& corner : outline) corner.x += least.x < west ? turn : -turn;
  visit(outline);
}

// Draws each triangle, the worst ones last.
std::string drawn_triangles(const TriangleMesh& mesh, const MapView& view,
                            std::span<const double> smallest_deg) {
  std::array<std::string, classes.size()> paths;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::string& path = paths[class_of(smallest_deg[t])];
    visit_outlines(view, corners_of(mesh, t), [&](std::span<const MapPixel> outline) {
      for (std::size_t k = 0; k < outline.size(); ++k) {
        path += (k == 0 ? 'M' : ' ') + fixed(outline[k].x) + ' ' + fixed(outline[k].y);
      }
      path += 'z';
    });
  }
  std::string svg;
  for (std::size_t k = classes.size(); k-- > 0;) {
    svg += std::string("<path fill=\"") + classes[k].color +
           R"(" stroke="#678" stroke-width="0.25" d=")" + paths[k] + "\"/>\n";
  }
  return svg;
}

// True if a place is inside of an outline, by the number of sides to its right.
bool is_inside(std::span<const MapPixel> outline, const MapPixel& p) {
  bool inside = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const MapPixel& a = outline[k];
    const MapPixel& b = outline[(k + 1) % outline.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

// Squares of pixels with the smallest angle of the triangles in each.
class Squares {
 public:
  explicit Squares(const MapView& view)
      : view_(view),
        columns_(number_in(view.frame().width)),
        rows_(number_in(view.frame().height)),
        angles_(columns_ * rows_, none) {}

  // A triangle is in the square of its middle and in those whose middles it has.
  void add(std::span<const MapPixel> outline, double angle_deg) {
    MapPixel middle;
    for (const MapPixel& p : outline) {
      middle.x += p.x / static_cast<double>(outline.size());
      middle.y += p.y / static_cast<double>(outline.size());
    }
    lower(column_of(middle.x), row_of(middle.y), angle_deg);
    const auto [west, east] = std::ranges::minmax(outline, {}, &MapPixel::x);
    const auto [north, south] = std::ranges::minmax(outline, {}, &MapPixel::y);
    const auto last_row = row_of(south.y);
    const auto last_column = column_of(east.x);
    for (std::size_t row = row_of(north.y); row <= last_row; ++row) {
      for (std::size_t column = column_of(west.x); column <= last_column; ++column) {
        const MapPixel center = {
            view_.frame().corner.x + (static_cast<double>(column) + 0.5) * side,
            view_.frame().corner.y + (static_cast<double>(row) + 0.5) * side};
        if (is_inside(outline, center)) lower(column, row, angle_deg);
      }
    }
  }

  // Returns runs of squares of one class in each row.
  [[nodiscard]] std::string drawn() const {
    std::array<std::string, classes.size()> paths;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t begin = 0, end = 0; begin < columns_; begin = end) {
        const auto class_at = [&](std::size_t column) {
          const double angle = angles_[row * columns_ + column];
          return angle == none ? classes.size() : class_of(angle);
        };
        const std::size_t k = class_at(begin);
        for (end = begin + 1; end < columns_ && class_at(end) == k; ++end) {
        }
        if (k == classes.size()) continue;
        paths[k] += 'M' + std::to_string(begin) + ' ' + std::to_string(row) + 'h' +
                    std::to_string(end - begin);
      }
    }
    const auto& [x, y] = view_.frame().corner;
    std::string svg = R"(<g fill="none" transform="translate()" + fixed(x) + ' ' +
                      fixed(y + side / 2) + ") scale(" + fixed(side) + ")\">\n";
    for (std::size_t k = 0; k < classes.size(); ++k) {
      svg += std::string("<path stroke=\"") + classes[k].color + "\" d=\"" + paths[k] + "\"/>\n";
    }
    return svg + "</g>\n";
  }

 private:
  static constexpr double side = 3;  // pixels
  static constexpr double none = std::numeric_limits<double>::infinity();

  static std::size_t number_in(double length) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / side)));
  }
  static std::size_t step_of(double distance, std::size_t number) {
    const auto last = static_cast<double>(number - 1);
    return static_cast<std::size_t>(std::clamp(std::floor(distance / side), 0.0, last));
  }
  [[nodiscard]] std::size_t column_of(double x) const {
    return step_of(x - view_.frame().corner.x, columns_);
  }
  [[nodiscard]] std::size_t row_of(double y) const {
    return step_of(y - view_.frame().corner.y, rows_);
  }
  void lower(std::size_t column, std::size_t row, double angle_deg) {
    double& angle = angles_[row * columns_ + column];
    angle = std::min(angle, angle_deg);
  }

  const MapView& view_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<double> angles_;
};

std::string drawn_squares(const TriangleMesh& mesh, const MapView& view,
                          std::span<const double> smallest_deg) {
  Squares squares(view);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    visit_outlines(view, corners_of(mesh, t), [&](std::span<const MapPixel> outline) {
      squares.add(outline, smallest_deg[t]);
    });
  }
  return squares.drawn();
}

// Draws the border: coasts black, open water dashed.
std::string drawn_border(const TriangleMesh& mesh, const MapView& view) {
  std::string coast;
  std::string open;
  for (const BoundarySegment& segment : mesh.boundary) {
    std::string& path = segment.kind == BoundaryKind::open ? open : coast;
    MapPixel last;
    const auto go_to = [&](Index node, bool is_first) {
      const MapPixel at = view.pixel(normalized(mesh.points[node]));
      const double turn = view.pixels_of_turn();
      const bool is_cut = is_first || (turn > 0 && std::abs(at.x - last.x) > turn / 2);
      path += (is_cut ? 'M' : 'L') + fixed(at.x) + ' ' + fixed(at.y);
      last = at;
    };
    for (std::size_t k = 0; k < segment.nodes.size(); ++k) go_to(segment.nodes[k], k == 0);
    if (segment.kind == BoundaryKind::island) go_to(segment.nodes.front(), false);
  }
  return "<g fill=\"none\" stroke=\"#222\" stroke-width=\"0.8\">\n<path d=\"" + coast +
         "\"/>\n<path stroke=\"#06a\" stroke-dasharray=\"4 2\" d=\"" + open + "\"/>\n</g>\n";
}

// Draws a circle around each of the worst triangles, whose title names it.
std::string drawn_worst(const TriangleMesh& mesh, const MapView& view,
                        std::span<const double> smallest_deg, std::size_t num_worst) {
  std::vector<Index> worst(smallest_deg.size());
  std::iota(worst.begin(), worst.end(), Index{0});
  const std::size_t count = std::min(num_worst, worst.size());
  std::ranges::partial_sort(worst, worst.begin() + static_cast<std::ptrdiff_t>(count), {},
                            [&](Index t) { return std::pair(smallest_deg[t], t); });
  std::string svg = "<g fill=\"none\" stroke=\"#000\">\n";
  for (const Index t : std::span(worst).first(count)) {
    const Corners corners = corners_of(mesh, t);
    const Point middle = normalized(corners[0] + corners[1] + corners[2]);
    const MapPixel at = view.pixel(middle);
    const LonLat place = lonlats({&middle, 1}).front();
    svg += "<circle cx=\"" + fixed(at.x) + "\" cy=\"" + fixed(at.y) +
           R"(" r="6"><title>triangle )" + std::to_string(t) + ": " + fixed(smallest_deg[t]) +
           " degrees, at longitude " + fixed(place.lon_deg) + ", latitude " + fixed(place.lat_deg) +
           "</title></circle>\n";
  }
  return svg + "</g>\n";
}

std::string legend(std::span<const double> smallest_deg, double top) {
  std::array<std::size_t, classes.size()> counts{};
  for (const double angle : smallest_deg) ++counts[class_of(angle)];
  std::string svg;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const double left = meshing::margin + 153 * static_cast<double>(k);
    svg +=
        "<rect x=\"" + fixed(left) + "\" y=\"" + fixed(top - 11) +
        R"(" width="14" height="14" fill=")" + classes[k].color + "\"/>\n" +
        text_at(left + 20, top, classes[k].words + std::string(": ") + std::to_string(counts[k]));
  }
  return svg;
}

}  // namespace

std::string quality_picture(const TriangleMesh& mesh, std::size_t num_worst) {
  require_valid(mesh);
  if (mesh.triangles.empty()) throw InvalidInput("a mesh without triangles has no picture");
  const system::ArithmeticScope arithmetic;
  std::vector<Point> places;
  for (const Point& p : mesh.points) places.push_back(normalized(p));
  const std::vector<double> smallest_deg = meshing::smallest_angles_deg(mesh);
  const double top = meshing::map_top + legend_height;
  const MapView view(places, {{meshing::margin, top}, 920, 720});
  const auto& [corner, width, height] = view.frame();
  std::string svg = meshing::begin_picture(top + height + meshing::margin);
  svg += histograms(mesh, smallest_deg);
  svg += text_at(meshing::margin, meshing::map_top - 22,
                 "triangles by their smallest angles, degrees; circles: the " +
                     std::to_string(std::min(num_worst, smallest_deg.size())) + " smallest");
  svg += legend(smallest_deg, meshing::map_top) + "</g>\n";
  const std::string frame = "<rect x=\"" + fixed(corner.x) + "\" y=\"" + fixed(corner.y) +
                            "\" width=\"" + fixed(width) + "\" height=\"" + fixed(height) + '"';
  svg += "<clipPath id=\"map\">" + frame + "/></clipPath>\n<g clip-path=\"url(#map)\">\n";
  const bool is_small = mesh.triangles.size() <= most_drawn;
  svg += is_small ? drawn_triangles(mesh, view, smallest_deg) + drawn_border(mesh, view)
                  : drawn_squares(mesh, view, smallest_deg);
  svg += view.lines() + drawn_worst(mesh, view, smallest_deg, num_worst);
  return svg + "</g>\n" + frame + " fill=\"none\" stroke=\"#888\"/>\n</svg>\n";
}

}  // namespace rondel::mesh
