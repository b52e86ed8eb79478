// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/mesh_triangles.h: what it promises of polygons of land and of water.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_triangles.h"
#include "rondel/predicates.h"
#include "rondel/triangle_mesh.h"

namespace rondel::fuzz {
namespace {

using mesh::RefinedMesh;
using mesh::RefineOptions;
using mesh::SizeFunction;
using Edge = std::array<Index, 2>;

double square_of_distance(const Point& p, const Point& q) {
  return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
}

// The spacing is a chord between unit vectors, or 0 if nodes are none.
void test_mesh(const RefinedMesh& made, double spacing) {
  std::set<Edge> sides;
  for (const auto& [a, b, c] : made.triangles) {
    require(orientation(made.nodes[a], made.nodes[b], made.nodes[c]) == Sign::positive,
            "triangles are counterclockwise");
    for (const Edge& side : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      require(sides.insert(side).second, "a side belongs to one triangle");
    }
  }
  for (const Edge& side : sides) {
    if (sides.contains({side[1], side[0]})) continue;
    const auto [low, high] = std::minmax(side[0], side[1]);
    require(std::ranges::binary_search(made.edges, Edge{low, high}), "the border is listed");
  }
  require(made.report.num_too_small > 0 || spacing == 0 ||
              std::ranges::all_of(sides,
                                  [&](const Edge& side) {
                                    const double square = square_of_distance(made.nodes[side[0]],
                                                                             made.nodes[side[1]]);
                                    return square <= 2.2501 * spacing * spacing;
                                  }),
          "edges have the spacing");
  const auto again = constrained_delaunay(Sites(made.nodes), made.edges);
  std::set<std::array<Index, 3>> faces;
  for (auto face : again.triangulation.faces()) {
    std::ranges::sort(face);
    faces.insert(face);
  }
  for (auto face : made.triangles) {
    std::ranges::sort(face);
    require(faces.contains(face), "triangles are constrained Delaunay");
  }
}

Geometries polygon(const std::vector<Point>& corners) {
  Geometries geometries;
  geometries.polygons.points = corners;
  std::vector<Index> ring(corners.size());
  std::iota(ring.begin(), ring.end(), Index{0});
  geometries.polygons.append_ring(ring);
  geometries.polygons.end_cell();
  geometries.lines.end_group();
  return geometries;
}

void test_domain(const mesh::MeshDomain& domain, const mesh::TrianglesOptions& options,
                 double spacing) {
  try {
    const mesh::DomainTriangles made = mesh::triangles(domain, options);
    const mesh::TriangleMesh in_files = mesh::triangle_mesh(made);
    require(in_files.triangles == made.mesh.triangles, "files have the triangles");
    require(options.fill_narrow == 0 || pinched_nodes(in_files).empty(), "no gap is narrow");
    require(made.features.size() == made.mesh.edges.size(), "edges have features");
    for (const mesh::FeatureOfEdge feature : made.features) {
      require(!name_of(feature).empty(), "features have names");
    }
    test_mesh(made.mesh, spacing);
  } catch (const InvalidInput&) {
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  mesh::TrianglesOptions options;
  options.refine.smallest_angle_deg = source.byte() % 33;
  options.refine.most_vertices = 2000;
  const bool is_spaced = source.byte() % 2 == 0;
  const double angle = 0.2 + 0.01 * source.byte();
  if (is_spaced) options.refine.spacing = mesh::SizeFunction::constant(angle, 1);
  const double spacing = is_spaced ? 2 * std::sin(angle / 2) : 0;
  const std::uint8_t kind = source.byte();
  if (is_spaced) options.fill_narrow = (kind / 4) % 4 / 3.0;
  options.smallest_part = kind / 16 % 4 / 3.0;
  if (kind >= 128) options.weld = kind / 64 % 2 == 0 ? 0.02 : 0.3;
  mesh::MeshDomain domain;
  for (auto* part : {&domain.coast, &domain.area}) {
    std::vector<LonLat> positions(3U + source.byte() % 6U);
    for (LonLat& position : positions) {
      position = {1.4 * source.byte() - 180, 0.7 * source.byte() - 90};
    }
    const bool is_coast = part == &domain.coast;
    if ((kind & (is_coast ? 1U : 2U)) != 0) part->push_back(fuzz::polygon(unit_vectors(positions)));
  }
  if (const auto region = mesh::region_of(domain)) {
    for (const Geometries& area : domain.area) {
      for (const Point& corner : area.polygons.points) {
        fuzz::require(region->contains(corner), "a region has the area");
      }
    }
    if (is_spaced) options.refine.spacing = mesh::SizeFunction::constant(angle, {*region, 4});
  }
  fuzz::test_domain(domain, options, spacing);
  return 0;
}
