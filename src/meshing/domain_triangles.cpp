// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: put all features into one set, simplify them, triangulate their arcs, find the faces of the
// area and not of the land, refine these, and tell what the edges of the mesh follow.
#include <algorithm>
#include <array>
#include <utility>

#include "meshing/scvt_levels.h"
#include "rondel/constrained_features.h"
#include "rondel/error.h"
#include "rondel/mesh_triangles.h"
#include "rondel/simplify.h"
#include "system/job.h"

namespace rondel::mesh {
namespace {

// Appends geometries with the points of their polygons.
void append(const Geometries& more, Geometries& all) {
  const auto first = static_cast<Index>(all.polygons.points.size());
  all.polygons.points.insert(all.polygons.points.end(), more.polygons.points.begin(),
                             more.polygons.points.end());
  std::vector<Index> ring;
  for (std::size_t i = 0; i < more.size(); ++i) {
    for (std::uint64_t k = more.lines.offsets[i]; k < more.lines.offsets[i + 1]; ++k) {
      all.lines.rows.append(more.lines.rows[k]);
    }
    all.lines.end_group();
    if (more.polygons.is_whole(i)) {
      all.polygons.whole.push_back(static_cast<Index>(all.polygons.num_cells()));
    }
    for (std::uint64_t r = more.polygons.cells[i]; r < more.polygons.cells[i + 1]; ++r) {
      ring.clear();
      for (const Index corner : more.polygons.corners_of(r)) ring.push_back(first + corner);
      all.polygons.append_ring(ring);
    }
    all.polygons.end_cell();
  }
}

class TrianglesOfDomain {
 public:
  TrianglesOfDomain(const MeshDomain& domain, const TrianglesOptions& options,
                    const Execution& execution)
      : options_(options), execution_(execution) {
    for (const Geometries& more : domain.coast) append(more, all_);
    end_of_coast_ = all_.size();
    for (const Geometries& more : domain.area) append(more, all_);
    end_of_area_ = all_.size();
    for (const Geometries& more : domain.lines) append(more, all_);
  }

  DomainTriangles run() {
    simplify();
    features_ = constraints_of_features(all_.lines, all_.polygons);
    triangulate();
    const Triangulation& first = triangulation_.triangulation;
    if (end_of_area_ == end_of_coast_ && (first.dimension() < 2 || first.num_ghost_faces() > 0)) {
      for (const Point& point : icosahedron()) features_.sites.push_back(point);
      triangulate();
    }
    const std::vector<Index> regions = find_regions();
    if (std::ranges::count(regions, no_index) == static_cast<std::ptrdiff_t>(regions.size())) {
      throw InvalidInput("nothing is left for triangles: the land covers the area");
    }
    DomainTriangles result;
    result.mesh = refine(triangulation_, regions, options_.refine, execution_);
    for (const Index source : result.mesh.sources) {
      result.features.push_back(source == no_index ? FeatureOfEdge::none : feature_of(source));
    }
    result.mesh.sites.clear();
    result.mesh.sources.clear();
    return result;
  }

 private:
  void simplify() {
    SimplifyOptions simplify{.tolerance = options_.tolerance.value_or(0), .drop_small = true};
    const auto& spacing = options_.refine.spacing;
    if (!options_.tolerance && spacing) {
      simplify.tolerance_at = [&](const Point& place) { return spacing->spacing(place) / 4; };
    } else if (simplify.tolerance == 0) {
      return;
    }
    SimplifiedFeatures simple = simplified(all_.lines, all_.polygons, simplify, execution_);
    all_ = {std::move(simple.lines), std::move(simple.polygons)};
  }

  // Makes sites of crossings only if there are any, which takes longer.
  void triangulate() {
    const Sites sites(features_.sites);
    try {
      triangulation_ = constrained_delaunay(sites, features_.constraints, {}, execution_);
    } catch (const CrossingConstraints&) {
      triangulation_ = constrained_delaunay(sites, features_.constraints,
                                            {.crossings = ConstraintCrossings::split}, execution_);
    }
  }

  // Returns 0 for the faces of the mesh, and no_index for others.
  [[nodiscard]] std::vector<Index> find_regions() const {
    const auto inside = faces_inside(triangulation_, features_.constraints, features_.polygons);
    const Index everywhere = end_of_area_ == end_of_coast_ ? 0 : no_index;
    std::vector<Index> regions(triangulation_.triangulation.num_faces(), everywhere);
    for (std::size_t i = end_of_coast_; i < end_of_area_; ++i) {
      for (const Index face : inside[i]) regions[face] = 0;
    }
    for (std::size_t i = 0; i < end_of_coast_; ++i) {
      for (const Index face : inside[i]) regions[face] = no_index;
    }
    for (const Index face : triangulation_.triangulation.ghost_faces()) regions[face] = no_index;
    return regions;
  }

  [[nodiscard]] FeatureOfEdge feature_of(Index edge) const {
    FeatureOfEdge result = FeatureOfEdge::line;
    for (const Index constraint : triangulation_.sources[edge]) {
      const Index feature = features_.features[constraint];
      if (feature < end_of_coast_) return FeatureOfEdge::coast;
      if (feature < end_of_area_) result = FeatureOfEdge::area;
    }
    return result;
  }

  const TrianglesOptions& options_;
  const Execution& execution_;
  Geometries all_;
  std::size_t end_of_coast_ = 0;
  std::size_t end_of_area_ = 0;
  FeatureConstraints features_;
  ConstrainedTriangulation triangulation_;
};

}  // namespace

std::string_view name_of(FeatureOfEdge feature) noexcept {
  constexpr std::array<std::string_view, 4> names = {"none", "coast", "area", "line"};
  const auto i = static_cast<std::size_t>(feature);
  return i < names.size() ? names[i] : std::string_view();
}

DomainTriangles triangles(const MeshDomain& domain, const TrianglesOptions& options,
                          const Execution& execution) {
  const system::Call call(execution);
  return TrianglesOfDomain(domain, options, execution).run();
}

TriangleMesh triangle_mesh(const DomainTriangles& triangles) {
  std::vector<std::array<Index, 2>> coast;
  for (std::size_t e = 0; e < triangles.features.size(); ++e) {
    if (triangles.features[e] == FeatureOfEdge::coast) coast.push_back(triangles.mesh.edges[e]);
  }
  return triangle_mesh(triangles.mesh.nodes, {}, triangles.mesh.triangles,
                       std::span(std::as_const(coast)));
}

}  // namespace rondel::mesh
