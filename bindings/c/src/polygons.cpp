// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons: features in longitude and latitude, polygons of arcs, and how one becomes the other.
#include "polygons.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "handles.h"
#include "rondel.h"
#include "rondel/arrow.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"

namespace rc = rondel::c;

rondel_polygons::rondel_polygons(rondel::CellRings made) : rings(std::move(made)) {
  points.reserve(rings.corners.size());
  for (const rondel::Index corner : rings.corners) points.push_back(rings.points[corner]);
}

namespace rondel::c {

std::vector<std::uint64_t> copied_offsets(const std::uint64_t* offsets, std::size_t n,
                                          const char* name) {
  if (n == 0 && offsets == nullptr) return {0};
  require(offsets, name);
  if (n >= max_sites) throw InvalidInput(std::string(name) + ": more than can be", max_sites);
  const std::span<const std::uint64_t> given(offsets, n + 1);
  if (given[0] != 0) throw InvalidInput(std::string(name) + " do not begin with 0", 0);
  for (std::size_t i = 1; i <= n; ++i) {
    if (given[i] < given[i - 1]) throw InvalidInput(std::string(name) + " decrease", i);
  }
  if (given[n] >= max_sites) {
    throw InvalidInput(std::string(name) + " count more than can be", n);
  }
  return {given.begin(), given.end()};
}

PolygonEdges edges_of(std::int32_t edges) {
  if (edges == RONDEL_LONLAT) return PolygonEdges::lonlat;
  if (edges == RONDEL_GEODESIC) return PolygonEdges::geodesic;
  throw InvalidInput("edges " + std::to_string(edges) + " are unknown");
}

PolygonOptions reading_of(const rondel_reading* reading) {
  if (reading == nullptr) return {};
  if (reading->size != sizeof(rondel_reading)) {
    throw InvalidInput("the options were not made by rondel_reading_init()");
  }
  if (reading->invalid != RONDEL_REFUSE && reading->invalid != RONDEL_REPAIR) {
    throw InvalidInput("the treatment " + std::to_string(reading->invalid) +
                       " of invalid features is unknown");
  }
  return {.edges = edges_of(reading->edges),
          .tolerance_deg = reading->tolerance_deg,
          .invalid =
              reading->invalid == RONDEL_REPAIR ? InvalidPolygons::repair : InvalidPolygons::error};
}

void require_unit_vectors(std::span<const Point> points, const std::string& what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (!(std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1) <= 2e-14)) {
      throw InvalidInput(what + " " + std::to_string(i) + " is no unit vector", i);
    }
  }
}

std::vector<LonLat> copied_positions(const double* lonlat_deg, std::size_t n) {
  if (n > 0) require(lonlat_deg, "lonlat_deg");
  if (n > max_sites) throw InvalidInput("lonlat_deg: more than can be", max_sites);
  std::vector<LonLat> made;
  made.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    made.push_back({lonlat_deg[2 * i], lonlat_deg[2 * i + 1]});
  }
  return made;
}

namespace {

// Throws InvalidInput unless these polygons exist, increase and have no rings.
void require_whole(std::span<const Index> whole, std::span<const std::uint64_t> cells) {
  for (std::size_t i = 0; i < whole.size(); ++i) {
    // An index has as many bits as a size on some machines, so that the one after it may be 0.
    if (whole[i] >= cells.size() - 1 || (i > 0 && whole[i] <= whole[i - 1]) ||
        cells[whole[i]] != cells[whole[i] + std::size_t{1}]) {
      throw InvalidInput("polygon " + std::to_string(whole[i]) +
                             " is not there, not in order, or has rings; it cannot be whole",
                         i);
    }
  }
}

CellRings rings_of(const std::uint64_t* polygons, std::size_t n, const std::uint64_t* rings,
                   const double* corners, std::span<const Index> whole) {
  CellRings made;
  made.cells = copied_offsets(polygons, n, "polygons");
  made.rings = copied_offsets(rings, made.cells.back(), "rings");
  made.points = copied_points(corners, made.rings.back(), "corners");
  require_unit_vectors(made.points, "corner");
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    made.corners.push_back(static_cast<Index>(i));
  }
  require_whole(whole, made.cells);
  made.whole.assign(whole.begin(), whole.end());
  return made;
}

// Writes one number for each polygon.
template <class Measure>
rondel_status measure_polygons(const rondel_polygons* polygons, double* out,
                               const Measure& measure) {
  return guarded([&] {
    require(polygons, "polygons");
    const std::vector<double> found = measure(polygons->rings);
    if (!found.empty()) require(out, "the place for the numbers");
    std::ranges::copy(found, out);
  });
}

LonLatMultiPolygons features_at(const std::uint64_t* features, std::size_t n,
                                const std::uint64_t* polygons, const std::uint64_t* rings,
                                const double* lonlat_deg) {
  LonLatMultiPolygons made;
  made.offsets = copied_offsets(features, n, "features");
  made.rows.offsets = copied_offsets(polygons, made.offsets.back(), "polygons");
  made.rows.rows.offsets = copied_offsets(rings, made.rows.offsets.back(), "rings");
  made.rows.rows.values = copied_positions(lonlat_deg, made.rows.rows.offsets.back());
  return made;
}

}  // namespace
}  // namespace rondel::c

extern "C" {

rondel_status rondel_features_create(const uint64_t* features, size_t n, const uint64_t* polygons,
                                     const uint64_t* rings, const double* lonlat_deg,
                                     rondel_features** made) {
  return rc::make_handle(made, [&] {
    return std::make_unique<rondel_features>(
        rondel_features{rc::features_at(features, n, polygons, rings, lonlat_deg)});
  });
}

rondel_status rondel_features_import_arrow(const struct ArrowSchema* schema,
                                           const struct ArrowArray* array, rondel_features** made) {
  return rc::make_handle(made, [&] {
    rc::require(schema, "schema");
    rc::require(array, "array");
    return std::make_unique<rondel_features>(
        rondel_features{rondel::import_arrow(*schema, *array)});
  });
}

rondel_status rondel_features_export_arrow(const rondel_features* features, int32_t edges,
                                           struct ArrowSchema* schema, struct ArrowArray* array) {
  return rc::guarded([&] {
    rc::require(features, "features");
    rc::require(schema, "schema");
    rc::require(array, "array");
    rondel::export_arrow(features->features, rc::edges_of(edges), *schema, *array);
  });
}

void rondel_features_free(rondel_features* features) { delete features; }

size_t rondel_num_features(const rondel_features* features) { return features->features.size(); }

const uint64_t* rondel_feature_polygons(const rondel_features* features) {
  return features->features.offsets.data();
}

const uint64_t* rondel_feature_rings(const rondel_features* features) {
  return features->features.rows.offsets.data();
}

const uint64_t* rondel_feature_positions(const rondel_features* features) {
  return features->features.rows.rows.offsets.data();
}

const double* rondel_feature_lonlat(const rondel_features* features) {
  const std::vector<rondel::LonLat>& positions = features->features.rows.rows.values;
  return positions.empty() ? nullptr : &positions.front().lon_deg;
}

void rondel_reading_init(rondel_reading* reading) {
  if (reading == nullptr) return;
  *reading = {sizeof(rondel_reading), RONDEL_LONLAT, RONDEL_REFUSE,
              rondel::PolygonOptions().tolerance_deg};
}

void rondel_texts_free(rondel_texts* texts) { delete texts; }

size_t rondel_num_texts(const rondel_texts* texts) { return texts->texts.size(); }

const char* rondel_text(const rondel_texts* texts, size_t i) { return texts->texts[i].c_str(); }

rondel_status rondel_feature_faults(const rondel_features* features, const rondel_reading* reading,
                                    const rondel_execution* execution, rondel_texts** faults) {
  return rc::make_handle(faults, [&] {
    rc::require(features, "features");
    return std::make_unique<rondel_texts>(rondel_texts{rondel::polygon_faults(
        features->features, rc::reading_of(reading), rc::execution_of(execution))});
  });
}

rondel_status rondel_polygons_of_features(const rondel_features* features,
                                          const rondel_reading* reading,
                                          const rondel_execution* execution,
                                          rondel_polygons** made) {
  return rc::make_handle(made, [&] {
    rc::require(features, "features");
    return std::make_unique<rondel_polygons>(rondel::rings_of_polygons(
        features->features, rc::reading_of(reading), rc::execution_of(execution)));
  });
}

rondel_status rondel_polygons_create(const uint64_t* polygons, size_t n, const uint64_t* rings,
                                     const double* corners, const uint32_t* whole, size_t num_whole,
                                     rondel_polygons** made) {
  return rc::make_handle(made, [&] {
    const std::span<const rondel::Index> spheres = rc::indices_at(whole, num_whole, "whole");
    return std::make_unique<rondel_polygons>(rc::rings_of(polygons, n, rings, corners, spheres));
  });
}

void rondel_polygons_free(rondel_polygons* polygons) { delete polygons; }

size_t rondel_num_polygons(const rondel_polygons* polygons) { return polygons->rings.num_cells(); }

const uint64_t* rondel_polygon_rings(const rondel_polygons* polygons) {
  return polygons->rings.cells.data();
}

const uint64_t* rondel_polygon_corners(const rondel_polygons* polygons) {
  return polygons->rings.rings.data();
}

const double* rondel_polygon_points(const rondel_polygons* polygons) {
  return polygons->points.empty() ? nullptr : &polygons->points.front().x;
}

const uint32_t* rondel_whole_polygons(const rondel_polygons* polygons) {
  return polygons->rings.whole.data();
}

size_t rondel_num_whole_polygons(const rondel_polygons* polygons) {
  return polygons->rings.whole.size();
}

rondel_status rondel_features_of_polygons(const rondel_polygons* polygons, double tolerance_deg,
                                          const rondel_execution* execution,
                                          rondel_features** made) {
  return rc::make_handle(made, [&] {
    rc::require(polygons, "polygons");
    const rondel::CellRings& rings = polygons->rings;
    return std::make_unique<rondel_features>(rondel_features{rondel::multipolygons(
        rondel::region_polygons(rings, tolerance_deg, rc::execution_of(execution),
                                rondel::CellDrawing::apart),
        rings.num_cells())});
  });
}

rondel_status rondel_polygon_areas(const rondel_polygons* polygons, double* areas) {
  return rc::measure_polygons(polygons, areas,
                              [](const rondel::CellRings& rings) { return rondel::areas(rings); });
}

rondel_status rondel_polygon_lengths(const rondel_polygons* polygons, double* lengths) {
  return rc::measure_polygons(
      polygons, lengths, [](const rondel::CellRings& rings) { return rondel::lengths(rings); });
}

}  // extern "C"
