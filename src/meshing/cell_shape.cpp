// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The moment of a cell, which is the integral of the position x over it, follows from its corners'
// offsets d from the site z, as in dual/centroids.cpp:
//
//     M = 1/2 sum over the edges of (d x d') + (t / sin(t) - 1) (z x (d' - d) + d x d').
//
// The center of mass lies along M, and as |x - z|^2 = 2 - 2 x.z, the energy is 2 area - 2 M.z. In
// small cells the two terms cancel down to area^2, so the energy loses about 2 log2(1 / spacing)
// bits: nine digits are left at a spacing of one kilometer.

#include "meshing/cell_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/arc_excess.h"
#include "exact/angles.h"
#include "exact/vector.h"

namespace rondel::meshing {
namespace {

using Vec = exact::Vector3<double>;

// Returns the corners of a cell on the unit sphere, relative to its site.
struct Offsets {
  const mesh::VoronoiMesh& arrays;
  Point site;
  [[nodiscard]] Vec operator()(std::uint64_t at) const {
    const Point& p = arrays.vertex_points[arrays.vertices_on_cell[at]];
    return exact::to_vector((1 / arrays.radius) * (p - site));
  }
};

// True if the densities of the cell and its neighbors differ.
bool has_densities(const mesh::VoronoiMesh& arrays, std::size_t cell) {
  if (arrays.density.empty()) return false;
  for (std::uint64_t at = arrays.edges_on_cell.offsets[cell];
       at < arrays.edges_on_cell.offsets[cell + 1]; ++at) {
    const Index beyond = arrays.cells_on_cell[at];
    if (beyond != no_index && arrays.density[beyond] != arrays.density[cell]) return true;
  }
  return false;
}

// Returns the density that belongs to the mean spacing of the cells around a vertex; spacings are
// its power -1/4.
double density_at_vertex(const mesh::VoronoiMesh& arrays, Index vertex) {
  double sum = 0;
  double count = 0;
  for (const Index cell : arrays.cells_on_vertex[vertex]) {
    if (cell == no_index) continue;
    sum += 1 / std::sqrt(std::sqrt(arrays.density[cell]));
    ++count;
  }
  const double square = (count / sum) * (count / sum);
  return square * square;
}

// Returns how far the center of mass moves from that of constant density. The density is linear in
// each triangle of the site and two corners. The triangles are treated as planar, since the shift
// itself is small.
Vec shift_by_density(const mesh::VoronoiMesh& arrays, std::size_t cell) {
  const Point& site = arrays.cell_points[cell];
  const Vec z = exact::to_vector((1 / arrays.radius) * site);
  const Offsets offset{arrays, site};
  const std::uint64_t begin = arrays.edges_on_cell.offsets[cell];
  const std::uint64_t end = arrays.edges_on_cell.offsets[cell + 1];
  Vec weighted{0, 0, 0};
  Vec plain{0, 0, 0};
  double mass = 0;
  double area = 0;
  Vec last = offset(end - 1);
  double of_last = density_at_vertex(arrays, arrays.vertices_on_cell[end - 1]);
  for (std::uint64_t at = begin; at < end; ++at) {
    const Vec d = offset(at);
    const double of_d = density_at_vertex(arrays, arrays.vertices_on_cell[at]);
    const double part = dot(cross(last, d), z);  // twice the area of the triangle
    const double sum = arrays.density[cell] + of_last + of_d;
    weighted = weighted + part / 12 * ((sum + of_last) * last + (sum + of_d) * d);
    mass += part / 3 * sum;
    plain = plain + part / 3 * (last + d);
    area += part;
    last = d;
    of_last = of_d;
  }
  const Vec shift = 1 / mass * weighted - 1 / area * plain;
  return shift - dot(shift, z) * z;
}

// Sets spacing, energy and offset of the center of mass, which follow from the moment of the cell.
void add_moment(const mesh::VoronoiMesh& arrays, std::size_t cell, CellShape& shape) {
  const Point& site = arrays.cell_points[cell];
  const Vec z = exact::to_vector((1 / arrays.radius) * site);
  const Offsets offset{arrays, site};
  const std::uint64_t begin = arrays.edges_on_cell.offsets[cell];
  const std::uint64_t end = arrays.edges_on_cell.offsets[cell + 1];
  Vec moment{0, 0, 0};
  Vec last = offset(end - 1);
  for (std::uint64_t at = begin; at < end; ++at) {
    const Vec d = offset(at);
    const Vec step = d - last;
    const Vec flat = cross(last, d);
    const Vec pole = cross(z, step) + flat;
    moment = moment + flat + dual::arc_excess(norm(pole), 1 - 0.5 * dot(step, step)) * pole;
    last = d;
  }
  moment = 0.5 * moment;
  const double along = dot(moment, z);
  const double across = norm(cross(z, moment));
  const double area = arrays.cell_areas[cell] / (arrays.radius * arrays.radius);
  shape.spacing = mesh::spacing_of(area);
  shape.energy = 2 * (area - along);
  if (has_densities(arrays, cell)) {
    const Vec across_by_area = 1 / area * (moment - along * z);
    shape.centroid_offset = norm(across_by_area + shift_by_density(arrays, cell)) / shape.spacing;
  } else {
    shape.centroid_offset = exact::argument(across, along) / shape.spacing;
  }
}

}  // namespace

// At the border of a mesh the cell beyond an edge is missing, and so is its spacing.
double gradient_of(const mesh::VoronoiMesh& arrays, std::size_t edge) {
  const auto [a, b] = arrays.cells_on_edge[edge];
  if (b == no_index) return 0;
  const double of_a = mesh::spacing_of(arrays.cell_areas[a]);
  const double of_b = mesh::spacing_of(arrays.cell_areas[b]);
  return std::abs(of_a - of_b) / (0.5 * (of_a + of_b));
}

CellShape shape_of(const mesh::VoronoiMesh& arrays, std::size_t cell) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  CellShape shape;
  add_moment(arrays, cell, shape);
  double min_side = infinite;
  double longest_side = 0;
  double nearest = infinite;
  double farthest = 0;
  shape.min_edge_ratio = infinite;
  for (std::uint64_t at = arrays.edges_on_cell.offsets[cell];
       at < arrays.edges_on_cell.offsets[cell + 1]; ++at) {
    const Index e = arrays.edges_on_cell.values[at];
    const double side = arrays.vertex_distances[e];
    const double distance = arrays.cell_distances[e];
    min_side = std::min(min_side, side);
    longest_side = std::max(longest_side, side);
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
    shape.min_edge_ratio = std::min(shape.min_edge_ratio, side / distance);
    shape.gradient = std::max(shape.gradient, gradient_of(arrays, e));
  }
  shape.side_ratio = min_side / longest_side;
  shape.distance_ratio = farthest / nearest;
  return shape;
}

}  // namespace rondel::meshing
