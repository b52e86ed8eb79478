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

// A rock, perhaps with a lake, which may touch its shore in a corner.
Geometries next_rock(ByteSource& source, const Chart& chart, double size, double x, double y) {
  std::vector<double> radii(3U + source.byte() % 6U);
  for (double& radius : radii) radius = (64 + source.byte()) / 319.0;
  Geometries rock;
  append_star(chart, x, y, size, radii, rock);
  const double of_lake = source.byte() / 256.0;
  const double first = radii.front();
  for (double& radius : radii) radius *= of_lake;
  if (source.byte() % 4 == 0) radii.front() = first;
  if (of_lake > 0.3) append_star(chart, x, y, -size, radii, rock);
  return rock;
}

// A land that stays, with a lake like a needle across it, and a lake beside that.
Geometries next_land(ByteSource& source, const Chart& chart, double x, double y) {
  constexpr double size = 0.15;
  std::vector<double> radii(6U + source.byte() % 6U);
  for (double& radius : radii) radius = (768 + source.byte()) / 1023.0;
  Geometries land;
  append_star(chart, x, y, size, radii, land);
  const double side = source.byte() % 2 == 0 ? 1 : -1;
  const double width = std::ldexp(1, -source.byte() % 32) / 64;
  const auto corner = [&](double along, double across) {
    land.polygons.points.push_back(chart.at(x + size * (0.3 * along + side * across),
                                            y + size * (0.3 * side * along - across)));
    return static_cast<Index>(land.polygons.points.size() - 1);
  };
  const std::array<Index, 3> needle = {corner(-1, 0), corner(1, 0), corner(0, width)};
  land.polygons.append_ring(needle);
  append_star(chart, x + size * 0.2, y - size * side * 0.2, -0.2 * size, std::array{1., 1., 1., 1.},
              land);
  return land;
}

// A sea with rocks, lakes and lands of about the sizes at which they are welded or simplified away.
class Rocks {
 public:
  explicit Rocks(ByteSource& source)
      : chart_({1.4 * source.byte() - 180, 0.7 * source.byte() - 90}) {
    options_.tolerance = std::array<std::optional<double>, 4>{std::nullopt, 0, spacing / 10,
                                                              spacing}[source.byte() % 4U];
    options_.weld = std::array<std::optional<double>, 4>{std::nullopt, 0, spacing / 100,
                                                         spacing / 4}[source.byte() % 4U];
    options_.fill_narrow = source.byte() % 4 == 0 ? 0.5 : 0;
    tolerance_ = options_.tolerance.value_or(spacing / 4);
    near_ = options_.weld.value_or(std::min(1e-4 * spacing, tolerance_));
    Geometries sea = polygon({chart_.at(-half, -half), chart_.at(half, -half),
                              chart_.at(half, half), chart_.at(-half, half)});
    area_of_sea_ = areas(sea.polygons).front();
    length_ = length_around(sea);
    domain_.area.push_back(std::move(sea));
    options_.refine.spacing =
        mesh::SizeFunction::constant(2 * std::asin(spacing / 2), {*mesh::region_of(domain_), 4});
    options_.refine.most_vertices = 50'000;
    for (std::size_t num_rocks = 1U + source.byte() % 6U; num_rocks > 0; --num_rocks) add(source);
  }

  // Whatever becomes of the rocks, the area of the mesh is that of the sea but for them and their
  // shores, and their order changes nothing. Without a tolerance there may be too many vertices.
  void test() {
    try {
      test_area();
    } catch (const InvalidInput&) {
      require(tolerance_ == 0, "the sea has a mesh");
    }
  }

 private:
  static constexpr double half = 0.3;
  static constexpr double spacing = 0.05;

  void test_area() {
    const mesh::DomainTriangles made = mesh::triangles(domain_, options_);
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
    const double shores =
        rounding + (tolerance_ + 4 * near_ + options_.fill_narrow * spacing) * length_;
    require(area < area_of_sea_ - largest_ + shores && area > area_of_sea_ - land_ - shores,
            "the mesh has the area of the sea");
    std::ranges::reverse(domain_.coast);
    std::ranges::reverse(domain_.lines);
    const mesh::DomainTriangles again = mesh::triangles(domain_, options_);
    require(again.mesh.nodes == made.mesh.nodes && again.mesh.triangles == made.mesh.triangles,
            "the order of features changes nothing");
  }

  void add(ByteSource& source) {
    const double sizes[] = {near_, std::max(tolerance_, near_), spacing};
    const double size = std::max(sizes[source.byte() % 3U] * (0.05 + source.byte() / 32.0), 1e-9);
    const double x = source.small() / 128.0;
    const double y = source.small() / 128.0;
    const bool is_land = source.byte() % 8 == 0;
    Geometries rock = is_land ? next_land(source, chart_, x * half / 2, y * half / 2)
                              : next_rock(source, chart_, size, x * half, y * half);
    rock.polygons.end_cell();
    rock.lines.end_group();
    const double area = areas(rock.polygons).front();
    land_ += area;
    if (is_land) largest_ = std::max(largest_, area);
    length_ += length_around(rock);
    if (source.byte() % 4 == 0) {  // a point at its corner, or a line through that
      Geometries line;
      std::vector<Point> points(1U, rock.polygons.points.front());
      if (source.byte() % 2 == 0) {
        points.insert(points.begin(), chart_.at(x * half, y * half));
        points.push_back(chart_.at(source.small() / 128.0 * half, source.small() / 128.0 * half));
      }
      line.lines.rows.append(points);
      line.lines.end_group();
      line.polygons.end_cell();
      domain_.lines.push_back(std::move(line));
    }
    domain_.coast.push_back(std::move(rock));
  }

  Chart chart_;
  mesh::TrianglesOptions options_;
  mesh::MeshDomain domain_;
  double tolerance_ = 0;
  double near_ = 0;
  double area_of_sea_ = 0;
  double length_ = 0;   // of shores and the border
  double land_ = 0;     // the sum of the areas
  double largest_ = 0;  // the area of a land that stays
};

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  mesh::TrianglesOptions options;
  const std::uint8_t angle_or_rocks = source.byte();
  if (angle_or_rocks >= 160) {
    fuzz::Rocks(source).test();
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
