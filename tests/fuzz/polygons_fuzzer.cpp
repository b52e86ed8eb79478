// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// read_polygons and read_features on files of any bytes: cells whose arrays fit, or a message of one line that begins
// with the file's name; the cells have an area, and can be clipped to; cells that were made disjoint do not overlap, and
// are what the others cover; the features have sites and cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/arrow.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/remap.h"

namespace rondel::fuzz {
namespace {

void test_cells(const CellTable& table) {
  const CellRings& cells = table.cells;
  require(
      cells.rings.back() == cells.corners.size() && cells.cells.back() + 1 == cells.rings.size(),
      "offsets fit");
  for (const Index corner : cells.corners) {
    require(corner < cells.points.size(), "corners are points");
  }
  for (const Column& column : table.facts.columns) {
    require(column.ends.size() == cells.num_cells(), "a property of each cell");
  }
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    require(feature_name(table.facts.columns, i).starts_with(std::to_string(i)), "a name");
  }
  for (const double area : areas(cells)) {
    require(area > -1e-12 && area < 4 * std::numbers::pi + 1e-9, "an area");
  }
  const std::vector<CrossingCells> crossed = crossing_cells(cells);
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    const CrossingCells& pair = crossed[i];
    require(pair.first <= pair.second && pair.second < cells.num_cells(), "cells that cross");
    require(std::abs(std::hypot(pair.place.x, pair.place.y, pair.place.z) - 1) < 1e-9, "a place");
    require(i == 0 || std::pair(crossed[i - 1].first, crossed[i - 1].second) <
                          std::pair(pair.first, pair.second),
            "each pair once");
  }
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  try {
    const CellRings clipped = clip(CellSet::voronoi(delaunay(sites)), CellSet::polygons(cells));
    require(clipped.num_cells() == sites.size(), "a part of each cell");
    require(clip(CellSet::polygons(clipped), CellSet::polygons(cells)).num_cells() == sites.size(),
            "and again");
  } catch (const InvalidInput&) {  // polygons that cross themselves may have no sides
  }
}

// In a grid of meridians and parallels each cell has the area between its straight sides, which differs from that between
// arcs by a small share. Cells whose sides are geodesic may cross themselves.
void test_in_grid(const CellTable& table) {
  const CellSet cells = CellSet::polygons(table.cells, table.sides);
  const bool is_straight = cells.sides().size() > 0;
  require(!is_straight || cells.sides().size() == cells.num_cells(), "a row for each cell");
  try {
    const CellSet grid = CellSet::lonlat_grid(GlobalGrid{36, 18});
    const Remap found = remap(grid, cells, {.overlap = CellOverlap::each});
    for (std::size_t i = 0; i < cells.num_cells(); ++i) {
      const double area = found.target_areas[i];
      require(!(area > 1e-9) || std::abs(found.target_fractions[i] - 1) < 1e-6, "parts add up");
      require(!is_straight || cells.sides()[i].empty() ||
                  std::abs(area - cells.areas()[i]) < 0.01 * area + 1e-9,
              "arcs are near to lines");
    }
  } catch (const InvalidInput&) {
    require(!is_straight || !table.facts.faults.empty(), "polygons in the plane have parts");
  }
}

double sum_of_areas(const CellRings& cells) {
  double sum = 0;
  for (const double area : areas(cells)) sum += area;
  return sum;
}

void test_overlaps(const std::string& path, PolygonOptions options) {
  const CellTable kept = read_polygons(path, options);
  options.overlap = PolygonOverlap::first;
  const CellTable first = read_polygons(path, options);
  require(first.cells.num_cells() == kept.cells.num_cells(), "a cell of each feature");
  require(sum_of_areas(first.cells) < 4 * std::numbers::pi + 1e-6, "not more than the sphere");
  require(sum_of_areas(first.cells) < sum_of_areas(kept.cells) + 1e-6, "not more than all of them");
  options.overlap = PolygonOverlap::error;
  const CellTable apart = read_polygons(path, options);
  require(apart.cells.corners == kept.cells.corners, "what does not overlap is as it was");
}

// Repaired polygons are valid; those that were valid before are as they were, up to corners of others.
void test_repairs(const std::string& path, PolygonOptions options) {
  const std::vector<std::string> faults = polygon_faults(path, options);
  options.invalid = InvalidPolygons::repair;
  const CellTable repaired = read_polygons(path, options);
  require(faults.size() == repaired.cells.num_cells(), "a text for each feature");
  const bool are_valid = std::ranges::all_of(faults, &std::string::empty);
  require(!are_valid || repaired.facts.faults.empty() || faults.size() > 1, "nothing to repair");
  for (const CrossingCells& pair : crossing_cells(repaired.cells)) {
    require(pair.first != pair.second || faults[pair.first].empty(), "no cell crosses itself");
  }
  for (std::size_t f = 0; f < faults.size(); ++f) {
    require(faults[f].empty() || !repaired.facts.faults[f].empty(), "each fault is repaired");
  }
}

// Returns what becomes of geometries in an array of Arrow.
LonLatGeometries through_arrow(const LonLatGeometries& geometries, ArrowParts parts) {
  ArrowSchema schema = {};
  ArrowArray array = {};
  export_arrow(geometries, parts, PolygonEdges::lonlat, schema, array);
  LonLatGeometries taken = import_arrow_geometries(schema, array);
  array.release(&array);
  schema.release(&schema);
  require(taken.size() == geometries.size(), "a geometry for each element");
  return taken;
}

// Positions of lines, points and polygons are in one of three arrays each.
void test_arrow_geometries(const LonLatMultiPolygons& polygons) {
  LonLatGeometries given;
  given.polygons = polygons;
  // The rings are lines, too, and the first position of each is a point.
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    for (std::uint64_t p = polygons.offsets[f]; p < polygons.offsets[f + 1]; ++p) {
      const std::span<const LonLat> ring = polygons.rows.rows[polygons.rows.offsets[p]];
      given.lines.rows.append(ring);
      given.lines.rows.append(ring.first(1));
    }
    given.lines.end_group();
  }
  const LonLatGeometries points = through_arrow(given, ArrowParts::points);
  const LonLatGeometries lines = through_arrow(given, ArrowParts::lines);
  require(points.lines.rows.values.size() + lines.lines.rows.values.size() ==
              given.lines.rows.values.size(),
          "each position once");
  require(through_arrow(given, ArrowParts::polygons).polygons == polygons, "the same polygons");
}

// Drawn polygons come back from Arrow as they are, and are cells again.
void test_arrow(const CellRings& cells) {
  const LonLatMultiPolygons drawn =
      multipolygons(region_polygons(cells, 1, {}, CellDrawing::apart), cells.num_cells());
  ArrowSchema schema = {};
  ArrowArray array = {};
  export_arrow(drawn, PolygonEdges::lonlat, schema, array);
  const LonLatMultiPolygons taken = import_arrow(schema, array);
  array.release(&array);
  schema.release(&schema);
  require(taken == drawn, "polygons come back from Arrow");
  test_arrow_geometries(drawn);
  const CellTable again = cells_of_polygons(taken, {.tolerance_deg = 1});
  require(again.cells.num_cells() == cells.num_cells(), "a cell for each feature");
  const CellRings alone = rings_of_polygons(taken, {.tolerance_deg = 1});
  require(alone.corners == again.cells.corners && alone.points == again.cells.points,
          "the same cells alone");
}

void test_features(const FeatureTable& table) {
  require(table.polygons.num_cells() == table.lines.size(), "a cell for each feature");
  require(table.lines.rows.offsets.back() == table.lines.rows.values.size(),
          "offsets of lines fit");
  constexpr double tolerance = 0.3;
  try {
    const FeatureSites found = feature_sites(table.lines, tolerance);
    require(found.sites.size() == found.features.size(), "a feature for each site");
    const CellRings cells = feature_cells(table.lines, table.polygons, tolerance);
    require(cells.num_cells() == table.lines.size(), "a cell for each feature");
    const CellSet octants = CellSet::triangles(
        delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}}));
    const RegionPieces pieces = feature_pieces(table.lines, table.polygons, tolerance, octants);
    require(areas(pieces.rings).size() == pieces.num_pieces(), "a ring for each piece");
    const CellRings clipped = clipped_feature_cells(table.lines, table.polygons, tolerance,
                                                    CellSet::polygons(table.polygons));
    require(clipped.num_cells() == cells.num_cells(), "a part of each cell");
  } catch (const InvalidInput&) {  // antipodes, or polygons that cross themselves
  }
}

// A message of one line that begins with the file's name, or an answer.
template <class Read>
void test_reader(const std::string& path, const Read& read) {
  try {
    read();
  } catch (const FileError& error) {
    const std::string what = error.what();
    require(what.starts_with(path + ":") && what.find('\n') == std::string::npos,
            "a message of one line starts with the file: " + what);
  }
}

// What is read together with itself has the same places twice, and what is written is read again.
void test_together(const ScratchFolder& folder, const std::string& path,
                   const PolygonOptions& options) {
  const std::array files = {FileName{path, {}}, FileName{path, {}}};
  std::vector<FeatureTable> tables = read_features_together(files, options);
  require(tables[0].lines == tables[1].lines, "equal files have equal lines");
  require(tables[0].polygons.points == tables[1].polygons.points, "equal files have equal corners");
  test_features(tables[0]);
  const Geometries all = {std::move(tables[0].lines), std::move(tables[0].polygons)};
  const std::string written = folder.file("written.geojson");
  write_geometries({written, {}}, all, tables[0].facts.columns, 1);
  require(lonlat_lines(all.lines, 1).owners.size() >= all.lines.rows.size(), "no line is lost");
  const Geometries proper = without_touching_parts(all, all, all);
  require(proper.size() == all.size(), "geometries stay");
  LonLatGeometries places;
  for (std::size_t f = 0; f < all.size(); ++f) {
    for (std::uint64_t k = all.lines.offsets[f]; k < all.lines.offsets[f + 1]; ++k) {
      places.lines.rows.append(lonlats(all.lines.rows[k]));
    }
    places.lines.end_group();
    places.polygons.end_group();
  }
  require(places.size() == all.size(), "a group for each feature");
  const PolygonOptions repairing = {.edges = options.edges, .invalid = InvalidPolygons::repair};
  const auto again = features_of_geometries({&places, 1}, repairing);
  require(again.front().lines.size() == all.size(), "lines in memory are lines");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  const fuzz::ScratchFolder folder;
  const std::string path = folder.file("polygons.geojson");
  write_file(path, std::string(reinterpret_cast<const char*>(data), size));
  for (const PolygonEdges edges : {PolygonEdges::lonlat, PolygonEdges::geodesic}) {
    const PolygonOptions options = {.edges = edges, .tolerance_deg = 1};
    fuzz::test_reader(path, [&] { fuzz::test_cells(read_polygons(path, options)); });
    fuzz::test_reader(path, [&] { fuzz::test_in_grid(read_polygons(path, options)); });
    fuzz::test_reader(path, [&] { fuzz::test_features(read_features(path, options)); });
    fuzz::test_reader(path, [&] { fuzz::test_together(folder, path, options); });
    fuzz::test_reader(path, [&] { fuzz::test_overlaps(path, options); });
    fuzz::test_reader(path, [&] { fuzz::test_repairs(path, options); });
    fuzz::test_reader(path, [&] { fuzz::test_arrow(read_polygons(path, options).cells); });
  }
  return 0;
}
