// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// ocean_mesh [OUT.14]: fills a sea with an island and a narrow strait with triangles for an ocean model.

#include <cstdio>
#include <exception>
#include <numbers>
#include <vector>

#include "rondel/mesh_triangles.h"
#include "rondel/rondel.h"
#include "rondel/triangle_files.h"

namespace {

constexpr double earth_km = 6371.229;

// A feature that is one polygon with one ring, counterclockwise.
rondel::Geometries polygon(const std::vector<rondel::LonLat>& ring) {
  rondel::Geometries feature;
  feature.polygons.points = rondel::unit_vectors(ring);
  for (rondel::Index i = 0; i < ring.size(); ++i) feature.polygons.corners.push_back(i);
  feature.polygons.end_ring();
  feature.polygons.end_cell();
  feature.lines.end_group();
  return feature;
}

void fill_sea(const char* file) {
  rondel::mesh::MeshDomain domain;
  domain.area.push_back(polygon({{0, 40}, {12, 40}, {12, 50}, {0, 50}}));
  domain.coast.push_back(polygon({{3, 44}, {5, 43}, {6, 45}, {4, 46}}));  // an island
  domain.coast.push_back(
      polygon({{8, 40}, {10, 40}, {10, 44.9}, {8, 44.9}}));  // a strait of 0.2 degrees
  domain.coast.push_back(polygon({{8, 45.1}, {10, 45.1}, {10, 50}, {8, 50}}));

  rondel::mesh::TrianglesOptions options;
  options.refine.spacing = rondel::mesh::SizeFunction::constant(50 / earth_km);
  for (const double share : {0.0, 0.5}) {
    options.fill_narrow = share;  // straits below half of the spacing become land
    const rondel::mesh::DomainTriangles made = rondel::mesh::triangles(domain, options);
    const rondel::mesh::TriangleMesh mesh = rondel::mesh::triangle_mesh(made);
    std::printf("%zu nodes, %zu triangles, %zu segments of the border; %.0f km2 filled\n",
                mesh.points.size(), mesh.triangles.size(), mesh.boundary.size(),
                made.filled_area * earth_km * earth_km);
    if (file != nullptr) rondel::mesh::write_triangle_mesh({file, {}}, mesh);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    fill_sea(argc > 1 ? argv[1] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ocean_mesh: %s\n", error.what());
    return 1;
  }
}
