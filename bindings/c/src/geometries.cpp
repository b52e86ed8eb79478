// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points, lines and polygons together, and the pieces into which two sets divide each other.
#include "rondel/geometries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "handles.h"
#include "polygons.h"
#include "rondel.h"
#include "rondel/arrow.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"

// NOLINTBEGIN(readability-identifier-naming): C's names
struct rondel_lonlat_geometries {
  rondel::RowGroups<rondel::CompressedRows<rondel::LonLat>> lines;
  rondel_features polygons;

  explicit rondel_lonlat_geometries(rondel::LonLatGeometries&& made)
      : lines(std::move(made.lines)), polygons{std::move(made.polygons)} {}
  // Returns a copy.
  [[nodiscard]] rondel::LonLatGeometries geometries() const { return {lines, polygons.features}; }
};

struct rondel_geometries {
  rondel::FeatureLines lines;
  rondel_polygons polygons;

  explicit rondel_geometries(rondel::Geometries&& made)
      : lines(std::move(made.lines)), polygons(std::move(made.polygons)) {}
  // Returns a copy.
  [[nodiscard]] rondel::Geometries geometries() const { return {lines, polygons.rings}; }
};

struct rondel_pieces {
  std::vector<rondel::Index> in_a;
  std::vector<rondel::Index> in_b;
  rondel_geometries geometries;
};
// NOLINTEND(readability-identifier-naming)

namespace rc = rondel::c;

namespace rondel::c {
namespace {

// Returns groups of rows without their values.
template <class Value>
RowGroups<CompressedRows<Value>> copied_groups(const std::uint64_t* groups, std::size_t n,
                                               const std::uint64_t* lines) {
  RowGroups<CompressedRows<Value>> made;
  made.offsets = copied_offsets(groups, n, "groups");
  made.rows.offsets = copied_offsets(lines, made.offsets.back(), "lines");
  return made;
}

// Throws InvalidInput unless there are as many polygons as geometries.
void require_as_many(std::size_t num_polygons, std::size_t n) {
  if (num_polygons == n) return;
  throw InvalidInput("there are " + std::to_string(num_polygons) + " polygons for " +
                     std::to_string(n) + " geometries");
}

ArrowParts parts_of(std::int32_t parts) {
  switch (parts) {
    case RONDEL_POINT_PARTS:
      return ArrowParts::points;
    case RONDEL_LINE_PARTS:
      return ArrowParts::lines;
    case RONDEL_POLYGON_PARTS:
      return ArrowParts::polygons;
    default:
      throw InvalidInput("the parts " + std::to_string(parts) + " are unknown");
  }
}

// Makes geometries of geometries.
template <class Make>
rondel_status make_geometries(rondel_geometries** made, const Make& make) {
  return make_handle(made, [&] { return std::make_unique<rondel_geometries>(make()); });
}

// Throws InvalidInput unless both arguments are there.
void require_two(const void* a, const void* b) {
  require(a, "a");
  require(b, "b");
}

// Returns the lines and points in longitude and latitude, in a group for each of n geometries.
RowGroups<CompressedRows<LonLat>> grouped(const LonLatLines& drawn, std::size_t n) {
  RowGroups<CompressedRows<LonLat>> made;
  std::size_t part = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (; part < drawn.owners.size() && drawn.owners[part] == i; ++part) {
      made.rows.append(drawn.parts[part]);
    }
    made.end_group();
  }
  return made;
}

LonLatGeometries drawn(const rondel_geometries& given, double tolerance_deg,
                       const Execution& execution) {
  const CellRings& rings = given.polygons.rings;
  LonLatGeometries made;
  made.lines = grouped(lonlat_lines(given.lines, tolerance_deg, execution), given.lines.size());
  made.polygons = multipolygons(
      region_polygons(rings, tolerance_deg, execution, CellDrawing::apart), rings.num_cells());
  return made;
}

// Returns the handles of sets that are read together.
std::vector<std::unique_ptr<rondel_geometries>> geometries_of(
    const rondel_lonlat_geometries* const* sets, std::size_t num_sets,
    const PolygonOptions& options, const Execution& execution) {
  std::vector<LonLatGeometries> given;
  if (num_sets > 0) require(sets, "sets");
  for (std::size_t k = 0; k < num_sets; ++k) {
    require(sets[k], "a set");
    given.push_back(sets[k]->geometries());
  }
  std::vector<std::unique_ptr<rondel_geometries>> made;
  for (FeatureTable& table : features_of_geometries(given, options, execution)) {
    made.push_back(std::make_unique<rondel_geometries>(
        Geometries{std::move(table.lines), std::move(table.polygons)}));
  }
  return made;
}

std::unique_ptr<rondel_pieces> pieces_of(GeometryPieces found) {
  return std::make_unique<rondel_pieces>(rondel_pieces{
      std::move(found.first), std::move(found.second), rondel_geometries(std::move(found.pieces))});
}

}  // namespace
}  // namespace rondel::c

extern "C" {

rondel_status rondel_lonlat_geometries_create(const uint64_t* groups, size_t n,
                                              const uint64_t* lines, const double* lonlat_deg,
                                              const rondel_features* polygons,
                                              rondel_lonlat_geometries** made) {
  return rc::make_handle(made, [&] {
    rondel::LonLatGeometries geometries;
    geometries.lines = rc::copied_groups<rondel::LonLat>(groups, n, lines);
    geometries.lines.rows.values =
        rc::copied_positions(lonlat_deg, geometries.lines.rows.offsets.back());
    geometries.polygons.offsets.assign(n + 1, 0);
    if (polygons != nullptr) geometries.polygons = polygons->features;
    rc::require_as_many(geometries.polygons.size(), n);
    return std::make_unique<rondel_lonlat_geometries>(std::move(geometries));
  });
}

rondel_status rondel_lonlat_geometries_import_arrow(const struct ArrowSchema* schema,
                                                    const struct ArrowArray* array,
                                                    rondel_lonlat_geometries** made) {
  return rc::make_handle(made, [&] {
    rc::require(schema, "schema");
    rc::require(array, "array");
    return std::make_unique<rondel_lonlat_geometries>(
        rondel::import_arrow_geometries(*schema, *array));
  });
}

rondel_status rondel_lonlat_geometries_export_arrow(const rondel_lonlat_geometries* geometries,
                                                    int32_t parts, int32_t edges,
                                                    struct ArrowSchema* schema,
                                                    struct ArrowArray* array) {
  return rc::guarded([&] {
    rc::require(geometries, "geometries");
    rc::require(schema, "schema");
    rc::require(array, "array");
    rondel::export_arrow(geometries->geometries(), rc::parts_of(parts), rc::edges_of(edges),
                         *schema, *array);
  });
}

void rondel_lonlat_geometries_free(rondel_lonlat_geometries* geometries) { delete geometries; }

size_t rondel_num_lonlat_geometries(const rondel_lonlat_geometries* geometries) {
  return geometries->lines.size();
}

const uint64_t* rondel_lonlat_line_groups(const rondel_lonlat_geometries* geometries) {
  return geometries->lines.offsets.data();
}

const uint64_t* rondel_lonlat_lines(const rondel_lonlat_geometries* geometries) {
  return geometries->lines.rows.offsets.data();
}

const double* rondel_lonlat_line_positions(const rondel_lonlat_geometries* geometries) {
  const std::vector<rondel::LonLat>& positions = geometries->lines.rows.values;
  return positions.empty() ? nullptr : &positions.front().lon_deg;
}

const rondel_features* rondel_lonlat_polygons(const rondel_lonlat_geometries* geometries) {
  return &geometries->polygons;
}

rondel_status rondel_geometries_of_lonlat(const rondel_lonlat_geometries* const* sets,
                                          size_t num_sets, const rondel_reading* reading,
                                          const rondel_execution* execution,
                                          rondel_geometries** made) {
  if (made != nullptr) std::fill_n(made, num_sets, nullptr);
  return rc::guarded([&] {
    rc::require(made, "the place for the handles");
    auto found =
        rc::geometries_of(sets, num_sets, rc::reading_of(reading), rc::execution_of(execution));
    for (std::size_t k = 0; k < num_sets; ++k) made[k] = found[k].release();
  });
}

rondel_status rondel_geometries_create(const uint64_t* groups, size_t n, const uint64_t* lines,
                                       const double* points, const rondel_polygons* polygons,
                                       rondel_geometries** made) {
  return rc::make_geometries(made, [&] {
    rondel::Geometries geometries;
    geometries.lines = rc::copied_groups<rondel::Point>(groups, n, lines);
    geometries.lines.rows.values =
        rc::copied_points(points, geometries.lines.rows.offsets.back(), "points");
    rc::require_unit_vectors(geometries.lines.rows.values, "point");
    geometries.polygons.cells.assign(n + 1, 0);
    if (polygons != nullptr) geometries.polygons = polygons->rings;
    rc::require_as_many(geometries.polygons.num_cells(), n);
    return geometries;
  });
}

void rondel_geometries_free(rondel_geometries* geometries) { delete geometries; }

size_t rondel_num_geometries(const rondel_geometries* geometries) {
  return geometries->lines.size();
}

const uint64_t* rondel_line_groups(const rondel_geometries* geometries) {
  return geometries->lines.offsets.data();
}

const uint64_t* rondel_lines(const rondel_geometries* geometries) {
  return geometries->lines.rows.offsets.data();
}

const double* rondel_line_points(const rondel_geometries* geometries) {
  const std::vector<rondel::Point>& points = geometries->lines.rows.values;
  return points.empty() ? nullptr : &points.front().x;
}

const rondel_polygons* rondel_geometry_polygons(const rondel_geometries* geometries) {
  return &geometries->polygons;
}

rondel_status rondel_line_lengths(const rondel_geometries* geometries, double* lengths) {
  return rc::guarded([&] {
    rc::require(geometries, "geometries");
    const std::vector<double> found = rondel::lengths(geometries->lines);
    if (!found.empty()) rc::require(lengths, "the place for the numbers");
    std::ranges::copy(found, lengths);
  });
}

rondel_status rondel_lonlat_of_geometries(const rondel_geometries* geometries, double tolerance_deg,
                                          const rondel_execution* execution,
                                          rondel_lonlat_geometries** made) {
  return rc::make_handle(made, [&] {
    rc::require(geometries, "geometries");
    return std::make_unique<rondel_lonlat_geometries>(
        rc::drawn(*geometries, tolerance_deg, rc::execution_of(execution)));
  });
}

rondel_status rondel_combine_geometries(const rondel_geometries* a, const rondel_geometries* b,
                                        int32_t operation, const rondel_execution* execution,
                                        rondel_geometries** made) {
  return rc::make_geometries(made, [&] {
    rc::require_two(a, b);
    return rondel::combine(a->geometries(), b->geometries(), rc::operation_of(operation),
                           rc::execution_of(execution));
  });
}

rondel_status rondel_unite_geometries(const rondel_geometries* geometries,
                                      const rondel_execution* execution, rondel_geometries** made) {
  return rc::make_geometries(made, [&] {
    rc::require(geometries, "geometries");
    return rondel::unite(geometries->geometries(), rc::execution_of(execution));
  });
}

rondel_status rondel_combine_geometry_pairs(const rondel_geometries* a, const rondel_geometries* b,
                                            const uint32_t* pairs, size_t n, int32_t operation,
                                            const rondel_execution* execution,
                                            rondel_geometries** made) {
  return rc::make_geometries(made, [&] {
    rc::require_two(a, b);
    return rondel::combine_pairs(a->geometries(), b->geometries(), rc::copied_pairs(pairs, n),
                                 rc::operation_of(operation), rc::execution_of(execution));
  });
}

rondel_status rondel_overlay_pieces(const rondel_polygons* a, const rondel_polygons* b,
                                    int32_t operation, const rondel_execution* execution,
                                    rondel_pieces** made) {
  return rc::make_handle(made, [&] {
    rc::require_two(a, b);
    rondel::RegionPieces found = rondel::overlay_pieces(
        a->rings, b->rings, rc::operation_of(operation), rc::execution_of(execution));
    rondel::GeometryPieces pieces;
    pieces.pieces.lines.offsets.assign(found.num_pieces() + 1, 0);
    pieces.pieces.polygons = std::move(found.rings);
    pieces.first = std::move(found.cells);
    pieces.second = std::move(found.regions);
    return rc::pieces_of(std::move(pieces));
  });
}

rondel_status rondel_overlay_geometry_pieces(const rondel_geometries* a, const rondel_geometries* b,
                                             int32_t operation, int32_t keeps_touching,
                                             const rondel_execution* execution,
                                             rondel_pieces** made) {
  return rc::make_handle(made, [&] {
    rc::require_two(a, b);
    const rondel::Geometries first = a->geometries();
    const rondel::Geometries second = b->geometries();
    rondel::GeometryPieces found = rondel::overlay_pieces(
        first, second, rc::operation_of(operation), rc::execution_of(execution));
    if (keeps_touching == 0) found = rondel::without_touching_parts(found, first, second);
    return rc::pieces_of(std::move(found));
  });
}

void rondel_pieces_free(rondel_pieces* pieces) { delete pieces; }

size_t rondel_num_pieces(const rondel_pieces* pieces) { return pieces->in_a.size(); }

const uint32_t* rondel_piece_owners_in_a(const rondel_pieces* pieces) {
  return pieces->in_a.data();
}

const uint32_t* rondel_piece_owners_in_b(const rondel_pieces* pieces) {
  return pieces->in_b.data();
}

const rondel_geometries* rondel_piece_geometries(const rondel_pieces* pieces) {
  return &pieces->geometries;
}

}  // extern "C"
