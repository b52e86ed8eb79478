// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles of polygons.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "handles.h"
#include "polygons.h"
#include "rondel.h"
#include "rondel/polygon_triangles.h"

namespace rc = rondel::c;

// NOLINTBEGIN(readability-identifier-naming): C's names
struct rondel_triangles {
  rondel::PolygonTriangles made;
};
// NOLINTEND(readability-identifier-naming)

extern "C" {

rondel_status rondel_triangulate_polygons(const rondel_polygons* polygons, double spacing_deg,
                                          const rondel_execution* execution,
                                          rondel_triangles** made) {
  return rc::make_handle(made, [&] {
    rc::require(polygons, "polygons");
    return std::make_unique<rondel_triangles>(rondel_triangles{
        rondel::triangles_of_polygons(polygons->rings, spacing_deg, rc::execution_of(execution))});
  });
}

void rondel_triangles_free(rondel_triangles* triangles) { delete triangles; }

size_t rondel_num_triangle_points(const rondel_triangles* triangles) {
  return triangles->made.points.size();
}

const double* rondel_triangle_points(const rondel_triangles* triangles) {
  const auto& points = triangles->made.points;
  return points.empty() ? nullptr : &points.front().x;
}

const uint64_t* rondel_triangle_offsets(const rondel_triangles* triangles) {
  return triangles->made.triangles.offsets.data();
}

const uint32_t* rondel_triangle_corners(const rondel_triangles* triangles) {
  const auto& corners = triangles->made.triangles.values;
  return corners.empty() ? nullptr : corners.front().data();
}

}  // extern "C"
