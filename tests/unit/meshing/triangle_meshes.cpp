// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "unit/meshing/triangle_meshes.h"

#include <cmath>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel::test {
namespace {

Point sum_of(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

// True within an angle, given by its cosine, of a direction.
bool is_near(const Point& p, const Point& direction, double cosine) {
  return dot(normalized(p), direction) > cosine;
}

}  // namespace

std::vector<LonLat> positions_with_poles(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<LonLat> positions = {{0, 90}, {33, -90}, {180, 5}, {-180, 15}, {180, -25}, {12, 0}};
  while (positions.size() < count) {
    const double lat = std::asin(2 * random.unit() - 1) * 57.29577951308232;
    positions.push_back({random.unit() * 360 - 180, lat});
  }
  return positions;
}

std::vector<Triple> some_triangles_of(
    const std::vector<LonLat>& positions,
    const std::function<bool(const Point&, std::size_t)>& is_kept) {
  const std::vector<Point> points = unit_vectors(positions);
  const Triangulation triangulation = delaunay(points);
  std::vector<Triple> kept;
  for (std::size_t f = 0; f < triangulation.num_faces(); ++f) {
    const auto& [a, b, c] = triangulation.faces()[f];
    const bool is_ghost = triangulation.is_ghost(static_cast<Index>(f));
    if (!is_ghost && is_kept(sum_of(sum_of(points[a], points[b]), points[c]), f)) {
      kept.push_back({a, b, c});
    }
  }
  return kept;
}

mesh::TriangleMesh mesh_of(const std::vector<LonLat>& positions,
                           const std::function<bool(const Point&, std::size_t)>& is_kept,
                           const std::function<bool(const Point&)>& is_coast) {
  const std::vector<Point> points = unit_vectors(positions);
  const std::vector<Triple> triangles = some_triangles_of(positions, is_kept);
  std::vector<std::array<Index, 2>> coast;
  for (const Triple& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangle[k];
      const Index b = triangle[(k + 1) % 3];
      if (is_coast(sum_of(points[a], points[b]))) coast.push_back({b, a});
    }
  }
  return mesh::triangle_mesh(points, positions, triangles, coast);
}

mesh::TriangleMesh arctic_mesh(std::uint64_t seed) {
  const auto is_water = [](const Point& p, std::size_t) {
    return is_near(p, {0, 0, 1}, 0.5) && !is_near(p, {0.3, 0.1, 0.9487}, 0.995) &&
           !is_near(p, {-0.3, -0.1, 0.9487}, 0.995);
  };
  mesh::TriangleMesh mesh = mesh_of(positions_with_poles(3000, seed), is_water, [](const Point& p) {
    return p.x < 0 || normalized(p).z > 0.7;
  });
  Random random(seed + 1);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    mesh.depths.push_back(i == 3 ? 0 : 4000 * random.unit());
  }
  mesh.levels = {0, 12.5, 100, 1e3 / 3, 5000};
  return mesh;
}

mesh::TriangleMesh global_mesh(std::uint64_t seed) {
  const auto is_water = [](const Point& p, std::size_t) {
    return !is_near(p, {1, 0, 0}, 0.7) && !is_near(p, {0, 0.6, 0.8}, 0.95) &&
           !is_near(p, {0, 0, -1}, 0.9);
  };
  return mesh_of(positions_with_poles(2000, seed), is_water, [](const Point&) { return true; });
}

}  // namespace rondel::test
