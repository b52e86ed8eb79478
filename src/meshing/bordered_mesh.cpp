// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/bordered_mesh.h"

#include <cmath>
#include <string>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "io/bad_value.h"
#include "meshing/face_measures.h"
#include "meshing/mesh_arrays.h"
#include "system/parallel.h"

namespace rondel::meshing {
namespace {

constexpr std::size_t border_grain = 4096;

// Returns p reflected in the plane through the center, v and w.
Point reflected(const Point& p, const Point& v, const Point& w) {
  const Point normal = normalized(cross(v, w - v));
  return normalized(p - 2 * dot(p - v, normal) * normal);
}

double distance_between(const Point& a, const Point& b) { return norm(b - a); }

// Makes the arrays from the lists of the file, whose cells may end at a border. Points are unit
// vectors until the last step multiplies them by the radius.
class BorderedMeshMaker {
 public:
  BorderedMeshMaker(const RingsAndSites& from, const mesh::MeshOptions& options,
                    const Execution& execution)
      : from_(from), options_(options), threads_(execution.threads) {}

  mesh::VoronoiMesh make() {
    require_options(options_, from_.sites.size());
    from_.sides.set_lists(arrays_);
    arrays_.radius = options_.radius;
    arrays_.density.assign(options_.density.begin(), options_.density.end());
    set_edges();
    set_areas();
    require_nearest_sites();
    for (Point& p : arrays_.vertex_points) p = options_.radius * p;
    for (Point& p : arrays_.edge_points) p = options_.radius * p;
    return std::move(arrays_);
  }

 private:
  // Calls each(i) for 0 <= i < count, in parallel.
  template <class Each>
  void for_each(std::size_t count, const Each& each) const {
    system::parallel_for(threads_, count, border_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) each(i);
    });
  }

  // Sets midpoints, lengths, distances and angles of edges. At the border the second site is the
  // reflected one.
  void set_edges() {
    const std::size_t size = arrays_.cells_on_edge.size();
    arrays_.edge_points.resize(size);
    arrays_.cell_distances.resize(size);
    arrays_.vertex_distances.resize(size);
    arrays_.normal_angles.resize(size);
    for_each(size, [&](std::size_t e) {
      const auto [first, second] = arrays_.cells_on_edge[e];
      const Point& v = arrays_.vertex_points[arrays_.vertices_on_edge[e][0]];
      const Point& w = arrays_.vertex_points[arrays_.vertices_on_edge[e][1]];
      const Point& a = from_.sites[first];
      const Point b = second == no_index ? reflected(a, v, w) : from_.sites[second];
      const EdgePlace place = edge_place(exact::to_vector(a), exact::to_vector(b));
      arrays_.edge_points[e] = place.middle;
      arrays_.normal_angles[e] = place.normal_angle;
      arrays_.cell_distances[e] = options_.radius * angle_of_chord(distance_between(a, b));
      arrays_.vertex_distances[e] = options_.radius * angle_of_chord(distance_between(v, w));
    });
  }

  // Sets kites and cell areas. A kite of a cell lies where two of its edges meet: two triangles of
  // the site, the corner and the midpoint of an edge.
  void set_areas() {
    const double square = options_.radius * options_.radius;
    const std::size_t size = from_.sites.size();
    arrays_.cell_points.resize(size);
    arrays_.cell_areas.resize(size);
    arrays_.kite_areas.assign(arrays_.num_vertices(), {0, 0, 0});
    for_each(size, [&](std::size_t i) {
      const Point& site = from_.sites[i];
      double area = 0;
      for (std::uint64_t at = arrays_.edges_on_cell.offsets[i];
           at < arrays_.edges_on_cell.offsets[i + 1]; ++at) {
        const Index v = arrays_.vertices_on_cell[at];
        const Point& corner = arrays_.vertex_points[v];
        const Index before = arrays_.edges_on_cell.values[at];
        const Index after = arrays_.edges_on_cell.values[from_.sides.next(static_cast<Index>(at))];
        const double kite =
            square * (exact::triangle_area(site, arrays_.edge_points[before], corner) +
                      exact::triangle_area(site, corner, arrays_.edge_points[after]));
        for (std::size_t k = 0; k < 3; ++k) {
          if (arrays_.cells_on_vertex[v][k] == i) arrays_.kite_areas[v][k] = kite;
        }
        area += kite;
      }
      arrays_.cell_points[i] = options_.radius * site;
      arrays_.cell_areas[i] = area;
    });
    arrays_.triangle_areas.resize(arrays_.num_vertices());
    for_each(arrays_.num_vertices(), [&](std::size_t v) {
      const auto& kites = arrays_.kite_areas[v];
      arrays_.triangle_areas[v] = kites[0] + kites[1] + kites[2];
    });
  }

  // Throws BadValue if a corner has a site that is nearer than those of its cells by more than the
  // tolerance.
  void require_nearest_sites() const {
    const std::vector<Index> nearest =
        from_.locator.nearest(arrays_.vertex_points, {.threads = threads_});
    for_each(from_.sites.size(), [&](std::size_t i) {
      const double allowed =
          corner_tolerance * mesh::spacing_of(arrays_.cell_areas[i]) / options_.radius;
      for (std::uint64_t at = arrays_.edges_on_cell.offsets[i];
           at < arrays_.edges_on_cell.offsets[i + 1]; ++at) {
        const Index v = arrays_.vertices_on_cell[at];
        const Point& corner = arrays_.vertex_points[v];
        const double least = distance_between(corner, from_.sites[nearest[v]]);
        if (!(distance_between(corner, from_.sites[i]) <= least + allowed)) refuse_cell(i);
      }
    });
  }

  const RingsAndSites& from_;
  const mesh::MeshOptions& options_;
  unsigned threads_;
  mesh::VoronoiMesh arrays_;
};

}  // namespace

void refuse_cell(std::size_t cell) {
  throw io::BadValue("cell " + std::to_string(cell) + " is not the Voronoi cell of its center");
}

// Each side runs counterclockwise around the site by less than half a turn. Together they make one
// turn if exactly one side reaches the direction of the last corner, or passes it, from the right.
// Doubles suffice, since corners are far more than rounding errors away from each other's
// directions.
void require_rings_around_sites(const RingsAndSites& from) {
  for (std::size_t i = 0; i < from.sites.size(); ++i) {
    const Point& site = from.sites[i];
    const auto place = [&](std::uint64_t side) -> const Point& {
      return from.cells.points[from.cells.corners[side]];
    };
    const std::uint64_t last = from.cells.rings[i + 1] - 1;
    std::size_t turns = 0;
    for (std::uint64_t side = from.cells.rings[i]; side <= last; ++side) {
      const Point& v = place(from.sides.previous(static_cast<Index>(side)));
      const Point& w = place(side);
      if (!(det(site, v - site, w - site) > 0)) refuse_cell(i);
      const double at_v = det(site, place(last) - site, v - site);
      const double at_w = det(site, place(last) - site, w - site);
      if (at_v < 0 && (at_w >= 0 || side == last)) ++turns;
    }
    if (turns != 1) refuse_cell(i);
  }
}

std::optional<std::pair<Index, Index>> cells_that_differ(const RingsAndSites& from,
                                                         const Execution& execution) {
  std::vector<Index> cells;
  std::vector<Point> across;
  for (Index side = 0; side < from.sides.num_sides(); ++side) {
    if (from.sides.opposite(side) != no_index) continue;
    const Index cell = from.sides.cell_of(side);
    cells.push_back(cell);
    across.push_back(reflected(from.sites[cell],
                               from.cells.points[from.sides.corner(from.sides.previous(side))],
                               from.cells.points[from.sides.corner(side)]));
  }
  const std::vector<Index> nearest = from.locator.nearest(across, execution);
  for (std::size_t k = 0; k < across.size(); ++k) {
    const Point& site = from.sites[nearest[k]];
    if (distance_between(across[k], site) <=
        corner_tolerance * distance_between(across[k], from.sites[cells[k]])) {
      return std::pair(cells[k], nearest[k]);
    }
  }
  return std::nullopt;
}

mesh::VoronoiMesh bordered_mesh(const RingsAndSites& from, const mesh::MeshOptions& options,
                                const Execution& execution) {
  return BorderedMeshMaker(from, options, execution).make();
}

}  // namespace rondel::meshing
