// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/mesh_triangles.h: what it promises of polygons of land and of water.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_triangles.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
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

// Places in the gnomonic plane around a point of the sphere.
struct Chart {
  Point origin;
  Point east;
  Point north;

  explicit Chart(const LonLat& middle)
      : origin(unit_vectors(std::array{middle}).front()),
        east(unit_vectors(std::array{LonLat{middle.lon_deg + 90, 0}}).front()),
        north{origin.y * east.z - origin.z * east.y, origin.z * east.x - origin.x * east.z,
              origin.x * east.y - origin.y * east.x} {}
  [[nodiscard]] Point at(double x, double y) const {
    const Point p = {origin.x + x * east.x + y * north.x, origin.y + x * east.y + y * north.y,
                     origin.z + x * east.z + y * north.z};
    const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    return {p.x / length, p.y / length, p.z / length};
  }
};

double length_around(const Geometries& geometries) {
  double length = 0;
  for (std::uint64_t r = 0; r + 1 < geometries.polygons.rings.size(); ++r) {
    const auto ring = geometries.polygons.corners_of(r);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto& points = geometries.polygons.points;
      length += std::sqrt(square_of_distance(points[ring[k]], points[ring[(k + 1) % ring.size()]]));
    }
  }
  return length;
}

// Appends a ring of corners around a place; the sign of `size` is its direction.
void append_star(const Chart& chart, double x, double y, double size, std::span<const double> radii,
                 Geometries& island) {
  std::vector<Index> ring;
  const double step = 2 * std::numbers::pi / static_cast<double>(radii.size());
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const double angle = (size < 0 ? -step : step) * static_cast<double>(k);
    const double radius = std::abs(size) * radii[size < 0 && k > 0 ? radii.size() - k : k];
    ring.push_back(static_cast<Index>(island.polygons.points.size()));
    island.polygons.points.push_back(
        chart.at(x + radius * std::cos(angle), y + radius * std::sin(angle)));
  }
  island.polygons.append_ring(ring);
}

// A sea with rocks, some with lakes, of about the sizes at which they are welded or simplified away:
// whatever becomes of them, the area of the mesh is that of the sea but for these and their shores, and
// the order of the rocks changes nothing.
void test_rocks(ByteSource& source) {
  constexpr double half = 0.3;
  constexpr double spacing = 0.05;
  const Chart chart({1.4 * source.byte() - 180, 0.7 * source.byte() - 90});
  mesh::TrianglesOptions options;
  const std::array<std::optional<double>, 4> tolerances = {std::nullopt, 0, spacing / 10, spacing};
  const std::array<std::optional<double>, 4> welds = {std::nullopt, 0, spacing / 100, spacing / 4};
  options.tolerance = tolerances[source.byte() % 4U];
  options.weld = welds[source.byte() % 4U];
  options.fill_narrow = source.byte() % 4 == 0 ? 0.5 : 0;
  const double tolerance = options.tolerance.value_or(spacing / 4);
  const double near = options.weld.value_or(std::min(1e-4 * spacing, tolerance));

  Geometries sea = polygon(
      {chart.at(-half, -half), chart.at(half, -half), chart.at(half, half), chart.at(-half, half)});
  const double area_of_sea = areas(sea.polygons).front();
  double length = length_around(sea);
  double land = 0;
  mesh::MeshDomain domain;
  const std::size_t num_rocks = 1U + source.byte() % 6U;
  for (std::size_t i = 0; i < num_rocks; ++i) {
    const double sizes[] = {near, std::max(tolerance, near), spacing};
    const double size = std::max(sizes[source.byte() % 3U] * (0.05 + source.byte() / 32.0), 1e-9);
    const double x = source.small() / 128.0 * half;
    const double y = source.small() / 128.0 * half;
    std::vector<double> radii(3U + source.byte() % 6U);
    for (double& radius : radii) radius = (64 + source.byte()) / 319.0;
    Geometries rock;
    append_star(chart, x, y, size, radii, rock);
    const double of_lake = source.byte() / 256.0;
    if (of_lake > 0.3) append_star(chart, x, y, -size * of_lake, radii, rock);
    rock.polygons.end_cell();
    rock.lines.end_group();
    land += areas(rock.polygons).front();
    length += length_around(rock);
    domain.coast.push_back(std::move(rock));
  }
  domain.area.push_back(std::move(sea));
  options.refine.spacing =
      mesh::SizeFunction::constant(2 * std::asin(spacing / 2), {*mesh::region_of(domain), 4});
  options.refine.most_vertices = 50'000;
  const mesh::DomainTriangles made = mesh::triangles(domain, options);
  test_mesh(made.mesh, spacing);
  CellRings triangles;
  triangles.points = made.mesh.nodes;
  for (const Triple& triangle : made.mesh.triangles) {
    triangles.append_ring(triangle);
    triangles.end_cell();
  }
  const std::vector<double> each = areas(triangles);
  const double area = std::accumulate(each.begin(), each.end(), 0.0);
  constexpr double rounding = 1e-11;
  const double shores = rounding + (tolerance + 4 * near + options.fill_narrow * spacing) * length;
  require(area < area_of_sea + shores && area > area_of_sea - land - shores,
          "the mesh has the area of the sea");
  std::ranges::reverse(domain.coast);
  const mesh::DomainTriangles again = mesh::triangles(domain, options);
  require(again.mesh.nodes == made.mesh.nodes && again.mesh.triangles == made.mesh.triangles,
          "the order of features changes nothing");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  mesh::TrianglesOptions options;
  const std::uint8_t angle_or_rocks = source.byte();
  if (angle_or_rocks >= 160) {
    fuzz::test_rocks(source);
    return 0;
  }
  options.refine.smallest_angle_deg = angle_or_rocks % 33;
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
