// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the report on a mesh from parts: pieces of cells, edges and vertices, joined in the
// order of the pieces, so that sums have the same bits for every number of threads.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/cell_shape.h"
#include "meshing/consistency.h"
#include "meshing/picture_parts.h"
#include "rondel/mesh_quality.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel::mesh {
namespace {

using meshing::count_in;

constexpr std::size_t quality_grain = 4096;
constexpr std::size_t histogram_steps = 80;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Keeps the smallest value and where it is; of equals the first.
void keep_least(Extremum& worst, double value, std::size_t where) {
  if (value < worst.value) worst = {value, static_cast<Index>(where)};
}
// Keeps the largest value and where it is; of equals the first.
void keep_most(Extremum& worst, double value, std::size_t where) {
  if (value > worst.value) worst = {value, static_cast<Index>(where)};
}

// Returns an empty histogram of [0, high].
Histogram histogram(double high) {
  return {0, high, std::vector<std::uint64_t>(histogram_steps, 0)};
}
void add_to(Histogram& sum, const Histogram& part) {
  for (std::size_t i = 0; i < sum.counts.size(); ++i) sum.counts[i] += part.counts[i];
}

// The report on a piece, or on all pieces up to one.
struct PieceQuality {
  PieceQuality() {
    found.min_angle_deg.value = found.min_edge_ratio.value = found.min_side_ratio.value = infinite;
    found.min_spacing = infinite;
    found.max_angle_deg.value = found.max_gradient.value = found.max_staggering.value = -1;
    found.max_centroid_offset.value = found.max_distance_ratio.value = -1;
    found.angles_deg = histogram(180);
    found.edge_ratios = histogram(2);
  }

  Quality found;  // means are still sums
  std::uint64_t num_40_to_80 = 0;
  std::uint64_t num_angles = 0;
  double kites = 0;
  double cells = 0;
};

// Adds the report of the next piece to that of all before.
void join(PieceQuality& all, const PieceQuality& next) {
  Quality& a = all.found;
  const Quality& b = next.found;
  if (b.sides.size() > a.sides.size()) a.sides.resize(b.sides.size());
  for (std::size_t k = 0; k < b.sides.size(); ++k) a.sides[k] += b.sides[k];
  a.energy += b.energy;
  a.mean_centroid_offset += b.mean_centroid_offset;
  keep_most(a.max_centroid_offset, b.max_centroid_offset.value, b.max_centroid_offset.where);
  keep_least(a.min_angle_deg, b.min_angle_deg.value, b.min_angle_deg.where);
  keep_most(a.max_angle_deg, b.max_angle_deg.value, b.max_angle_deg.where);
  a.num_obtuse += b.num_obtuse;
  keep_least(a.min_edge_ratio, b.min_edge_ratio.value, b.min_edge_ratio.where);
  keep_least(a.min_side_ratio, b.min_side_ratio.value, b.min_side_ratio.where);
  keep_most(a.max_distance_ratio, b.max_distance_ratio.value, b.max_distance_ratio.where);
  keep_most(a.max_gradient, b.max_gradient.value, b.max_gradient.where);
  keep_most(a.max_staggering, b.max_staggering.value, b.max_staggering.where);
  a.mean_staggering += b.mean_staggering;
  a.min_spacing = std::min(a.min_spacing, b.min_spacing);
  a.max_spacing = std::max(a.max_spacing, b.max_spacing);
  a.max_kite_error = std::max(a.max_kite_error, b.max_kite_error);
  add_to(a.angles_deg, b.angles_deg);
  add_to(a.edge_ratios, b.edge_ratios);
  a.num_border_edges += b.num_border_edges;
  all.num_40_to_80 += next.num_40_to_80;
  all.num_angles += next.num_angles;
  all.kites += next.kites;
  all.cells += next.cells;
}

// Computes the report of a mesh.
class QualityFinder {
 public:
  QualityFinder(const VoronoiMesh& arrays, const Execution& execution)
      : arrays_(arrays), execution_(execution), spacings_(arrays.num_cells()) {}

  Quality find() {
    in_pieces(arrays_.num_cells(), [&](std::size_t i, PieceQuality& part) { add_cell(i, part); });
    in_pieces(arrays_.num_edges(), [&](std::size_t e, PieceQuality& part) { add_edge(e, part); });
    in_pieces(arrays_.num_vertices(),
              [&](std::size_t v, PieceQuality& part) { add_vertex(v, part); });
    Quality result = std::move(all_.found);
    result.num_cells = arrays_.num_cells();
    result.num_edges = arrays_.num_edges();
    result.num_vertices = arrays_.num_vertices();
    const auto cells = static_cast<double>(result.num_cells);
    const double of_sphere = 4 * std::numbers::pi * arrays_.radius * arrays_.radius;
    const double area = result.num_border_edges == 0 ? of_sphere : all_.cells;
    const double at_one = result.num_border_edges == 0 ? 4 * std::numbers::pi
                                                       : area / (arrays_.radius * arrays_.radius);
    // The energy of n regular hexagons that fill the area A is 5 A^2 / (18 sqrt(3) n).
    const double of_hexagons = 5 * std::numbers::inv_sqrt3 / 18;
    const bool is_uniform =
        std::ranges::all_of(arrays_.density, [](double density) { return density == 1; });
    result.energy = is_uniform ? result.energy * cells / (at_one * at_one) / of_hexagons
                               : std::numeric_limits<double>::quiet_NaN();
    result.mean_centroid_offset /= cells;
    result.mean_staggering /= static_cast<double>(result.num_edges);
    result.share_40_to_80_deg =
        static_cast<double>(all_.num_40_to_80) / static_cast<double>(all_.num_angles);
    result.kite_sum_error = std::abs(all_.kites / area - 1);
    result.cell_sum_error = result.num_border_edges == 0 ? std::abs(all_.cells / area - 1)
                                                         : std::numeric_limits<double>::quiet_NaN();
    set_spacings(result);
    return result;
  }

 private:
  // Calls add(i, part) for each element, where pieces of elements share a part, and joins the
  // parts.
  template <class Add>
  void in_pieces(std::size_t count, const Add& add) {
    std::vector<PieceQuality> parts(system::num_pieces(count, quality_grain));
    system::parallel_for(execution_.threads, count, quality_grain,
                         [&](std::size_t begin, std::size_t end) {
                           PieceQuality& part = parts[begin / quality_grain];
                           for (std::size_t i = begin; i < end; ++i) add(i, part);
                         });
    for (const PieceQuality& part : parts) join(all_, part);
  }

  // Adds the shape of a cell, and compares its area with the sum of its kites.
  void add_cell(std::size_t i, PieceQuality& part) {
    const meshing::CellShape shape = meshing::shape_of(arrays_, i);
    Quality& found = part.found;
    const auto sides = static_cast<std::size_t>(arrays_.edges_on_cell.offsets[i + 1] -
                                                arrays_.edges_on_cell.offsets[i]);
    if (found.sides.size() <= sides) found.sides.resize(sides + 1);
    ++found.sides[sides];
    found.energy += shape.energy;
    found.mean_centroid_offset += shape.centroid_offset;
    keep_most(found.max_centroid_offset, shape.centroid_offset, i);
    keep_least(found.min_side_ratio, shape.side_ratio, i);
    keep_most(found.max_distance_ratio, shape.distance_ratio, i);
    found.min_spacing = std::min(found.min_spacing, shape.spacing);
    found.max_spacing = std::max(found.max_spacing, shape.spacing);
    double kites = 0;
    for (std::uint64_t at = arrays_.edges_on_cell.offsets[i];
         at < arrays_.edges_on_cell.offsets[i + 1]; ++at) {
      const Index v = arrays_.vertices_on_cell[at];
      const Triple& cells = arrays_.cells_on_vertex[v];
      const std::size_t k = cells[0] == i ? 0 : cells[1] == i ? 1 : 2;
      kites += arrays_.kite_areas[v][k];
    }
    const double area = arrays_.cell_areas[i];
    found.max_kite_error = std::max(found.max_kite_error, std::abs(kites - area) / area);
    part.cells += area;
    const double density = arrays_.density.empty() ? 1 : arrays_.density[i];
    spacings_[i] = shape.spacing * std::sqrt(std::sqrt(density));
  }

  // Adds an edge: dv / dc, and how far its middle is from the point where the arc of its sites
  // crosses it, over the distance of the sites.
  void add_edge(std::size_t e, PieceQuality& part) const {
    Quality& found = part.found;
    const double distance = arrays_.cell_distances[e];
    const double ratio = arrays_.vertex_distances[e] / distance;
    keep_least(found.min_edge_ratio, ratio, e);
    count_in(found.edge_ratios, ratio);
    keep_most(found.max_gradient, meshing::gradient_of(arrays_, e), e);
    found.num_border_edges +=
        static_cast<std::uint64_t>(meshing::is_at_border(arrays_.cells_on_edge[e]));
    const auto [v, w] = arrays_.vertices_on_edge[e];
    const Point middle = normalized(arrays_.vertex_points[v] + arrays_.vertex_points[w]);
    const double away = norm(arrays_.radius * middle - arrays_.edge_points[e]) / distance;
    keep_most(found.max_staggering, away, e);
    found.mean_staggering += away;
  }

  // Adds a vertex: its triangle, which a vertex at the border lacks, and the sum of its kites.
  void add_vertex(std::size_t v, PieceQuality& part) const {
    if (!meshing::is_at_border(arrays_.cells_on_vertex[v])) add_triangle(v, part);
    const auto& kites = arrays_.kite_areas[v];
    const double sum = kites[0] + kites[1] + kites[2];
    const double area = arrays_.triangle_areas[v];
    part.found.max_kite_error =
        std::max(part.found.max_kite_error, std::abs(sum - area) / std::abs(area));
    part.kites += sum;
  }

  // Adds the angles of a triangle, in the plane of its three sites.
  void add_triangle(std::size_t v, PieceQuality& part) const {
    Quality& found = part.found;
    const Triple& cells = arrays_.cells_on_vertex[v];
    bool is_obtuse = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& a = arrays_.cell_points[cells[i]];
      const Point b = arrays_.cell_points[cells[(i + 1) % 3]] - a;
      const Point c = arrays_.cell_points[cells[(i + 2) % 3]] - a;
      const double along = dot(b, c);
      is_obtuse |= along < 0;
      const double angle = exact::argument(norm(cross(b, c)), along) * (180 / std::numbers::pi);
      keep_least(found.min_angle_deg, angle, v);
      keep_most(found.max_angle_deg, angle, v);
      part.num_40_to_80 += static_cast<std::uint64_t>(angle >= 40 && angle <= 80);
      count_in(found.angles_deg, angle);
    }
    part.num_angles += 3;
    found.num_obtuse += static_cast<std::uint64_t>(is_obtuse);
  }

  // Sets what is left of the spacings when those that the density asks for are divided out: the
  // range of nine cells in ten, relative to the median.
  void set_spacings(Quality& result) {
    const std::size_t size = spacings_.size();
    const auto of_rank = [&](std::size_t k) {
      std::nth_element(spacings_.begin(), spacings_.begin() + static_cast<std::ptrdiff_t>(k),
                       spacings_.end());
      return spacings_[k];
    };
    const double median = of_rank(size / 2);
    result.spacing_range = {of_rank(size / 20) / median, of_rank(size - 1 - size / 20) / median};
    result.spacings = histogram(2);
    for (const double spacing : spacings_) count_in(result.spacings, spacing / median);
  }

  const VoronoiMesh& arrays_;
  const Execution& execution_;
  std::vector<double> spacings_;  // by cell: spacing times density^(1/4)
  PieceQuality all_;
};

}  // namespace

Quality quality(const VoronoiMesh& arrays, const Execution& execution) {
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  return QualityFinder(arrays, execution).find();
}

CellQuality cell_quality(const VoronoiMesh& arrays, const Execution& execution) {
  const system::Call call(execution);
  meshing::require_consistent(arrays, execution.threads);
  const std::size_t size = arrays.num_cells();
  CellQuality result;
  for (auto* values : {&result.centroid_offset, &result.edge_ratio, &result.side_ratio,
                       &result.distance_ratio, &result.gradient}) {
    values->resize(size);
  }
  system::parallel_for(execution.threads, size, quality_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           const meshing::CellShape shape = meshing::shape_of(arrays, i);
                           result.centroid_offset[i] = shape.centroid_offset;
                           result.edge_ratio[i] = shape.min_edge_ratio;
                           result.side_ratio[i] = shape.side_ratio;
                           result.distance_ratio[i] = shape.distance_ratio;
                           result.gradient[i] = shape.gradient;
                         }
                       });
  return result;
}

}  // namespace rondel::mesh
