// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites, triangulations, hulls and predicates.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "handles.h"
#include "rondel.h"
#include "rondel/rondel.h"

namespace rc = rondel::c;

rondel_triangulation::rondel_triangulation(rondel::Triangulation made)
    : triangulation(std::move(made)) {
  for (const auto& [site, representative] : triangulation.duplicates()) {
    duplicates.insert(duplicates.end(), {site, representative});
  }
  for (const auto& [site, face] : triangulation.hidden()) {
    hidden.insert(hidden.end(), {site, face});
  }
}

namespace {

std::vector<rondel::LonLat> copied_positions(const double* lonlat_deg, std::size_t n) {
  if (n > 0) rc::require(lonlat_deg, "lonlat_deg");
  if (n > rondel::max_sites) {
    throw rondel::InvalidInput("lonlat_deg: more than can be", rondel::max_sites);
  }
  std::vector<rondel::LonLat> positions(n);
  for (std::size_t i = 0; i < n; ++i) positions[i] = {lonlat_deg[2 * i], lonlat_deg[2 * i + 1]};
  return positions;
}

rondel::Point point_at(const double* p, const char* name) {
  rc::require(p, name);
  return {p[0], p[1], p[2]};
}

// Returns the numbers of an array of triples; NULL if it is empty.
const std::uint32_t* numbers(std::span<const rondel::Triple> triples) {
  return triples.empty() ? nullptr : triples.front().data();
}

std::unique_ptr<rondel_triangulation> handle_of(rondel::Triangulation made) {
  return std::make_unique<rondel_triangulation>(std::move(made));
}

}  // namespace

extern "C" {

rondel_status rondel_unit_vectors(const double* lonlat_deg, size_t n, double* points) {
  return rc::guarded([&] {
    const std::vector<rondel::Point> made = rondel::unit_vectors(copied_positions(lonlat_deg, n));
    if (n > 0) rc::require(points, "points");
    rc::write_points(made, points);
  });
}

rondel_status rondel_polar_points(const double* lonlat_deg, const double* radii_deg, size_t n,
                                  double* points) {
  return rc::guarded([&] {
    if (n > 0) rc::require(radii_deg, "radii_deg");
    if (n > 0) rc::require(points, "points");
    rc::write_points(rondel::polar_points(copied_positions(lonlat_deg, n), {radii_deg, n}), points);
  });
}

rondel_status rondel_delaunay(const double* points, size_t n, const rondel_options* options,
                              const rondel_execution* execution,
                              rondel_triangulation** triangulation) {
  return rc::make_handle(triangulation, [&] {
    return handle_of(rondel::delaunay(rc::copied_points(points, n, "points"),
                                      rc::options_of(options), rc::execution_of(execution)));
  });
}

rondel_status rondel_convex_hull(const double* points, size_t n, const rondel_execution* execution,
                                 rondel_triangulation** hull) {
  return rc::make_handle(hull, [&] {
    return handle_of(
        rondel::convex_hull(rc::copied_points(points, n, "points"), rc::execution_of(execution)));
  });
}

void rondel_triangulation_free(rondel_triangulation* triangulation) { delete triangulation; }

int32_t rondel_dimension(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.dimension();
}

int32_t rondel_model(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.model() == rondel::Model::projected ? RONDEL_PROJECTED
                                                                          : RONDEL_WEIGHTED;
}

void rondel_center(const rondel_triangulation* triangulation, double center[3]) {
  rc::write_points({&triangulation->triangulation.sphere().center, 1}, center);
}

const char* rondel_builder(const rondel_triangulation* triangulation) {
  return rondel::name_of(triangulation->triangulation.report().builder);
}

size_t rondel_num_sites(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.num_sites();
}

size_t rondel_num_vertices(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.num_vertices();
}

size_t rondel_num_faces(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.num_faces();
}

size_t rondel_num_ghost_faces(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.num_ghost_faces();
}

size_t rondel_num_ring(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.ring().size();
}

size_t rondel_num_duplicates(const rondel_triangulation* triangulation) {
  return triangulation->duplicates.size() / 2;
}

size_t rondel_num_hidden(const rondel_triangulation* triangulation) {
  return triangulation->hidden.size() / 2;
}

const double* rondel_points(const rondel_triangulation* triangulation) {
  const std::span<const rondel::Point> points = triangulation->triangulation.sites().points();
  return points.empty() ? nullptr : &points.front().x;
}

const uint32_t* rondel_faces(const rondel_triangulation* triangulation) {
  return numbers(triangulation->triangulation.faces());
}

const uint32_t* rondel_neighbors(const rondel_triangulation* triangulation) {
  return numbers(triangulation->triangulation.neighbors());
}

const uint32_t* rondel_ghost_faces(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.ghost_faces().data();
}

const uint32_t* rondel_ring(const rondel_triangulation* triangulation) {
  return triangulation->triangulation.ring().data();
}

const uint32_t* rondel_duplicates(const rondel_triangulation* triangulation) {
  return triangulation->duplicates.data();
}

const uint32_t* rondel_hidden(const rondel_triangulation* triangulation) {
  return triangulation->hidden.data();
}

rondel_status rondel_check(const double* points, size_t n, const uint32_t* triangles, size_t m,
                           const rondel_options* options, const rondel_execution* execution,
                           int32_t* is_valid) {
  return rc::guarded([&] {
    rc::require(is_valid, "is_valid");
    if (m > 0) rc::require(triangles, "triangles");
    std::vector<rondel::Triple> faces(m);
    for (std::size_t f = 0; f < m; ++f) {
      faces[f] = {triangles[3 * f], triangles[3 * f + 1], triangles[3 * f + 2]};
    }
    const rondel::CheckReport report =
        rondel::check(rc::copied_points(points, n, "points"), faces, rc::options_of(options),
                      rc::execution_of(execution));
    *is_valid = report.is_valid ? 1 : 0;
    rc::set_message(report.reason);
  });
}

rondel_status rondel_size_of_hull(const rondel_triangulation* hull, double* volume, double* area) {
  return rc::guarded([&] {
    rc::require(hull, "hull");
    const rondel::HullSize size = rondel::size_of_hull(hull->triangulation);
    if (volume != nullptr) *volume = size.volume;
    if (area != nullptr) *area = size.area;
  });
}

rondel_status rondel_orientation(const double a[3], const double b[3], const double c[3],
                                 const rondel_options* options, int32_t* sign) {
  return rc::guarded([&] {
    rc::require(sign, "sign");
    *sign = static_cast<std::int32_t>(rondel::orientation(
        point_at(a, "a"), point_at(b, "b"), point_at(c, "c"), rc::options_of(options).sphere));
  });
}

rondel_status rondel_side_of_circle(const double a[3], const double b[3], const double c[3],
                                    const double p[3], const rondel_options* options,
                                    int32_t* sign) {
  return rc::guarded([&] {
    rc::require(sign, "sign");
    const rondel::Options chosen = rc::options_of(options);
    *sign = static_cast<std::int32_t>(rondel::side_of_circle(point_at(a, "a"), point_at(b, "b"),
                                                             point_at(c, "c"), point_at(p, "p"),
                                                             chosen.model, chosen.sphere));
  });
}

}  // extern "C"
