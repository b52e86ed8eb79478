// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Duals: centers, cells, areas and facets.
#include "rondel/diagram.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "handles.h"
#include "rondel.h"

namespace rc = rondel::c;

namespace {

// Writes one point for each face or site.
template <class Find>
rondel_status find_points(const rondel_triangulation* triangulation,
                          const rondel_execution* execution, double* out, const Find& find) {
  return rc::guarded([&] {
    rc::require(triangulation, "triangulation");
    const std::vector<rondel::Point> points =
        find(triangulation->triangulation, rc::execution_of(execution));
    if (!points.empty()) rc::require(out, "the place for the points");
    rc::write_points(points, out);
  });
}

}  // namespace

extern "C" {

rondel_status rondel_circumcenters(const rondel_triangulation* triangulation,
                                   const rondel_execution* execution, double* centers) {
  return find_points(triangulation, execution, centers, rondel::circumcenters);
}

rondel_status rondel_centroids(const rondel_triangulation* triangulation,
                               const rondel_execution* execution, double* centroids) {
  return find_points(triangulation, execution, centroids, rondel::centroids);
}

rondel_status rondel_areas(const rondel_triangulation* triangulation,
                           const rondel_execution* execution, double* areas) {
  return rc::guarded([&] {
    rc::require(triangulation, "triangulation");
    const std::vector<double> found =
        rondel::areas(triangulation->triangulation, rc::execution_of(execution));
    if (!found.empty()) rc::require(areas, "areas");
    std::ranges::copy(found, areas);
  });
}

rondel_status rondel_edges(const rondel_triangulation* triangulation, uint32_t* edges,
                           size_t capacity, size_t* num_edges) {
  return rc::guarded([&] {
    rc::require(triangulation, "triangulation");
    if (capacity > 0) rc::require(edges, "edges");
    rc::require(num_edges, "num_edges");
    const std::vector<std::array<rondel::Index, 2>> found =
        rondel::edges(triangulation->triangulation);
    *num_edges = found.size();
    for (std::size_t i = 0; i < std::min(capacity, found.size()); ++i) {
      std::ranges::copy(found[i], edges + 2 * i);
    }
  });
}

rondel_status rondel_diagram_create(const rondel_triangulation* triangulation,
                                    const rondel_execution* execution, rondel_diagram** diagram) {
  return rc::make_handle(diagram, [&] {
    rc::require(triangulation, "triangulation");
    return std::make_unique<rondel_diagram>(
        rondel_diagram{rondel::diagram(triangulation->triangulation, rc::execution_of(execution))});
  });
}

void rondel_diagram_free(rondel_diagram* diagram) { delete diagram; }

const uint64_t* rondel_cell_offsets(const rondel_diagram* diagram) {
  return diagram->diagram.cells.rings.offsets.data();
}

const uint32_t* rondel_cell_rings(const rondel_diagram* diagram) {
  return diagram->diagram.cells.rings.values.data();
}

const double* rondel_cell_points(const rondel_diagram* diagram) {
  const std::vector<rondel::Point>& points = diagram->diagram.cells.points;
  return points.empty() ? nullptr : &points.front().x;
}

size_t rondel_num_cell_points(const rondel_diagram* diagram) {
  return diagram->diagram.cells.points.size();
}

const double* rondel_cell_areas(const rondel_diagram* diagram) {
  return diagram->diagram.areas.data();
}

void rondel_lists_free(rondel_lists* lists) { delete lists; }

size_t rondel_num_lists(const rondel_lists* lists) { return lists->rows.size(); }

const uint64_t* rondel_list_offsets(const rondel_lists* lists) {
  return lists->rows.offsets.data();
}

const uint32_t* rondel_list_items(const rondel_lists* lists) { return lists->rows.values.data(); }

rondel_status rondel_merge_cocircular(const rondel_triangulation* triangulation,
                                      const rondel_execution* execution, rondel_lists** facets) {
  return rc::make_handle(facets, [&] {
    rc::require(triangulation, "triangulation");
    return std::make_unique<rondel_lists>(rondel_lists{
        rondel::merge_cocircular(triangulation->triangulation, rc::execution_of(execution))});
  });
}

}  // extern "C"
