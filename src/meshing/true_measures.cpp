// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compares lengths, angles and areas of a mesh with those that follow from its points. The bounds
// are far wider than what programs differ in: edges through other points, single precision, kites
// of obtuse triangles with the wrong sign.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/consistency.h"
#include "meshing/face_measures.h"
#include "rondel/error.h"
#include "system/message_text.h"
#include "system/parallel.h"

namespace rondel::meshing {
namespace {

constexpr std::size_t measure_grain = 4096;

// Throws InvalidInput for a measure that is not the one of the points.
[[noreturn]] void refuse_measure(const char* name, std::size_t i, double given,
                                 const std::string& of_points) {
  throw InvalidInput("variable \"" + std::string(name) + "\", value " + std::to_string(i) + ": " +
                         system::shortest_text(given) + ", where " + of_points,
                     i);
}

// Checks one edge or cell at a time.
class MeasureCheck {
 public:
  explicit MeasureCheck(const mesh::VoronoiMesh& arrays) : arrays_(arrays) {}

  void check_edge(std::size_t e) const {
    const auto [first, second] = arrays_.cells_on_edge[e];
    const auto [v, w] = arrays_.vertices_on_edge[e];
    const double side =
        length_between(unit(arrays_.vertex_points[v]), unit(arrays_.vertex_points[w]));
    const double given_side = arrays_.vertex_distances[e];
    const double given_distance = arrays_.cell_distances[e];
    if (second == no_index) {
      require_length("dvEdge", e, given_side, side, side);
      return;
    }
    const Point a = unit(arrays_.cell_points[first]);
    const Point b = unit(arrays_.cell_points[second]);
    const double distance = length_between(a, b);
    require_length("dcEdge", e, given_distance, distance, 0);
    require_length("dvEdge", e, given_side, side, distance);
    require_angle(e, a, b);
  }

  // The area of a cell is the sum of the triangles of its point and its sides.
  void check_area(std::size_t cell) const {
    constexpr double most = 2;
    const Point site = unit(arrays_.cell_points[cell]);
    const std::uint64_t end = arrays_.edges_on_cell.offsets[cell + 1];
    Point last = unit(arrays_.vertex_points[arrays_.vertices_on_cell[end - 1]]);
    double area = 0;
    for (std::uint64_t at = arrays_.edges_on_cell.offsets[cell]; at < end; ++at) {
      const Point corner = unit(arrays_.vertex_points[arrays_.vertices_on_cell[at]]);
      area += exact::triangle_area(site, last, corner);
      last = corner;
    }
    area *= arrays_.radius * arrays_.radius;
    const double given = arrays_.cell_areas[cell];
    if (given <= most * area && area <= most * given) return;
    refuse_measure("areaCell", cell, given,
                   "the corners have the area " + system::shortest_text(area));
  }

 private:
  [[nodiscard]] static Point unit(const Point& p) { return normalized(p); }
  [[nodiscard]] double length_between(const Point& a, const Point& b) const {
    return arrays_.radius * angle_of_chord(norm(b - a));
  }

  // Models give very short sides a length that is a part of the distance of the cells.
  static void require_length(const char* name, std::size_t e, double given, double length,
                             double scale) {
    constexpr double share_of_length = 0.1;
    constexpr double share_of_scale = 0.25;
    if (std::abs(given - length) <= share_of_length * length + share_of_scale * scale) return;
    refuse_measure(name, e, given, "the points have the distance " + system::shortest_text(length));
  }

  // East has no meaning at a pole, and turns by as much as an edge point is away beside it.
  void require_angle(std::size_t e, const Point& a, const Point& b) const {
    constexpr double max_apart = 0.5;
    constexpr double distances_from_pole = 2;
    const Point middle = normalized(a + b);
    const double from_axis = std::sqrt(middle.x * middle.x + middle.y * middle.y);
    if (from_axis < distances_from_pole * norm(b - a)) return;
    const double angle = edge_place(exact::to_vector(a), exact::to_vector(b)).normal_angle;
    const double given = arrays_.normal_angles[e];
    const double apart = std::abs(std::remainder(given - angle, 2 * std::numbers::pi));
    if (apart <= max_apart) return;
    const auto [first, second] = arrays_.cells_on_edge[e];
    refuse_measure("angleEdge", e, given,
                   "the normal from cell " + std::to_string(first) + " to cell " +
                       std::to_string(second) + " of \"cellsOnEdge\" has the angle " +
                       system::shortest_text(angle));
  }

  const mesh::VoronoiMesh& arrays_;
};

}  // namespace

void require_measures_of_points(const mesh::VoronoiMesh& arrays, unsigned threads) {
  const MeasureCheck check(arrays);
  system::parallel_for(threads, arrays.num_edges(), measure_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t e = begin; e < end; ++e) check.check_edge(e);
                       });
  system::parallel_for(threads, arrays.num_cells(), measure_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) check.check_area(i);
                       });
}

}  // namespace rondel::meshing
