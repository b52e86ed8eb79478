// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of the overlay: of the cells of each kind of sites of tests/support with those of uniform sites, with
// themselves and with a grid of parallels, and of halves of both, the pieces and the weights of both orders; of their cells clipped to
// uniform ones, and dissolved, and of the polygons in longitude and latitude of these and of all cells and faces; of set operations,
// buffers, simplified cells, triangles and relations; of the triangles of countries; with 1, 2 and 5 threads.
//
//     same_bytes_overlay EXPECTED              compares with the hashes that are recorded, and tells
//                                              what differs
//     same_bytes_overlay EXPECTED --update     records those of this build

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "rondel/buffer.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"
#include "rondel/polygon_triangles.h"
#include "rondel/polygons.h"
#include "rondel/regions.h"
#include "rondel/relate.h"
#include "rondel/remap.h"
#include "rondel/set_operations.h"
#include "rondel/simplify.h"
#include "same_bytes/portable/hash.h"
#include "same_bytes/recorded.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

std::string hash_of_remap(const CellSet& source, const CellSet& target, unsigned order,
                          unsigned threads) {
  const Remap result = remap(source, target, {.order = order}, {.threads = threads});
  Hash hash;
  hash.add(result.pieces.offsets);
  hash.add(result.pieces.values);
  hash.add(result.areas);
  for (const Point& moment : result.moments) {
    for (const double c : {moment.x, moment.y, moment.z}) hash.add(std::span(&c, 1));
  }
  hash.add(result.source_areas);
  hash.add(result.target_areas);
  hash.add(result.weights.offsets);
  hash.add(result.weights.columns);
  hash.add(result.weights.values);
  return hash.text();
}

std::string hash_of_rings(const CellRings& rings) {
  Hash hash;
  hash.add(rings.cells);
  hash.add(rings.rings);
  for (const Index k : rings.corners) {
    const Point& p = rings.points[k];
    for (const double c : {p.x, p.y, p.z}) hash.add(std::span(&c, 1));
  }
  return hash.text();
}

std::string hash_of_region_polygons(const CellRings& rings, unsigned threads) {
  const LonLatRegions found = region_polygons(rings, 0.5, {.threads = threads});
  Hash hash;
  for (const LonLat& p : found.polygons.rows.values) {
    for (const double c : {p.lon_deg, p.lat_deg}) hash.add(std::span(&c, 1));
  }
  hash.add(found.polygons.rows.offsets);
  hash.add(found.polygons.offsets);
  hash.add(found.owners);
  return hash.text();
}

// Of cells and faces as they are drawn.
std::string hash_of_map(const Triangulation& triangulation, unsigned threads) {
  const Diagram dual = diagram(triangulation);
  Hash hash;
  for (const LonLatPolygons& found : {cell_polygons(triangulation, dual, 0.5, {.threads = threads}),
                                      face_polygons(triangulation, {.threads = threads})}) {
    for (const LonLat& p : found.rings.values) {
      for (const double c : {p.lon_deg, p.lat_deg}) hash.add(std::span(&c, 1));
    }
    hash.add(found.rings.offsets);
    hash.add(found.owners);
  }
  return hash.text();
}

CellSet cells_of(const SiteSet& set) {
  return CellSet::voronoi(delaunay(set.sites, {.sphere = set.sphere}));
}

CellSet grid_of(std::size_t num_lon, std::size_t num_lat) {
  LonLatGrid grid;
  for (std::size_t k = 0; k <= num_lon; ++k) {
    grid.lon_deg.push_back(360.0 * static_cast<double>(k) / static_cast<double>(num_lon) - 180);
  }
  for (std::size_t k = 0; k <= num_lat; ++k) {
    grid.lat_deg.push_back(180.0 * static_cast<double>(k) / static_cast<double>(num_lat) - 90);
  }
  return CellSet::lonlat_grid(grid);
}

std::string hash_of_geometries(const GeometryPieces& all) {
  Hash hash;
  hash.add(all.first);
  hash.add(all.second);
  const FeatureLines& lines = all.pieces.lines;
  hash.add(lines.offsets);
  hash.add(lines.rows.offsets);
  for (const Point& p : lines.rows.values) {
    for (const double c : {p.x, p.y, p.z}) hash.add(std::span(&c, 1));
  }
  return hash.text() + hash_of_rings(all.pieces.polygons);
}

// The tests of the JavaScript package compute this hash, too.
std::string hash_of_triangles(const CellRings& cells, double spacing_deg, unsigned threads) {
  const PolygonTriangles made = triangles_of_polygons(cells, spacing_deg, {.threads = threads});
  std::vector<Index> corners;
  for (const Triple& t : made.triangles.values) corners.insert(corners.end(), t.begin(), t.end());
  std::vector<double> coordinates;
  for (const Point& p : made.points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  Hash hash;
  hash.add(made.triangles.offsets);
  hash.add(corners);
  hash.add(coordinates);
  return hash.text();
}

// Returns the rings of cells as closed lines, all of one feature.
Geometries outlines_of(const CellRings& cells) {
  Geometries outlines;
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    std::vector<Point> line;
    for (const Index corner : cells.corners_of(r)) line.push_back(cells.points[corner]);
    if (!line.empty()) line.push_back(line.front());
    if (!line.empty()) outlines.lines.rows.append(line);
  }
  outlines.lines.end_group();
  outlines.polygons.end_cell();
  return outlines;
}

// Set operations, buffers, simplified cells and relations of two sets of cells.
template <class Record>
void record_operations(const CellRings& cells, const CellRings& others, const Record& record) {
  const Geometries outlines = outlines_of(cells);
  Geometries polygons;
  for (std::size_t i = 0; i < others.num_cells(); ++i) polygons.lines.end_group();
  polygons.polygons = others;
  record("set-operations", [&](unsigned threads) {
    const RegionPieces pieces = overlay_pieces(cells, others, SetOperation::unite, {threads});
    return hash_of_rings(combine(cells, others, SetOperation::symmetric_difference, {threads})) +
           hash_of_rings(pieces.rings);
  });
  record("lines", [&](unsigned threads) {
    return hash_of_geometries(
        overlay_pieces(outlines, polygons, SetOperation::identity, {threads}));
  });
  record("buffers", [&](unsigned threads) {
    return hash_of_rings(buffered(cells, {0.02, 1e-3}, {threads})) +
           hash_of_rings(buffered(cells, {-0.02, 1e-3}, {threads}));
  });
  record("simplified", [&](unsigned threads) {
    return hash_of_rings(simplified(cells, {.tolerance = 0.1}, {threads}));
  });
  record("triangles", [&](unsigned threads) {
    return hash_of_triangles(cells, 0, threads) + hash_of_triangles(cells, 4, threads);
  });
  record("relations", [&](unsigned threads) {
    Hash hash;
    for (const RelatedPair& pair :
         related_pairs(cells, others, SpatialPredicate::intersects, {threads})) {
      for (const char entry : pair.relation.matrix)
        hash.add_word(static_cast<unsigned char>(entry));
    }
    return hash.text();
  });
}

void add_countries(std::vector<std::string>& lines) {
  const CellRings cells = read_polygons(RONDEL_SOURCE_DIR "/data/countries-110m.geojson").cells;
  for (const int spacing_deg : {0, 2}) {
    std::set<std::string> found;
    for (const unsigned threads : {1U, 2U, 5U}) {
      found.insert(hash_of_triangles(cells, spacing_deg, threads));
    }
    for (const std::string& hash : found) {
      lines.push_back("countries triangles-" + std::to_string(spacing_deg) + ' ' + hash);
    }
  }
}

void add_lines(const std::string& name, const SiteSet& set, std::size_t num_others,
               std::vector<std::string>& lines) {
  // What differs between turns of threads is there twice, and fails.
  const auto record = [&](const std::string& what, const auto& hash_with) {
    std::set<std::string> found;
    for (const unsigned threads : {1U, 2U, 5U}) found.insert(hash_with(threads));
    for (const std::string& hash : found) lines.push_back(name + ' ' + what + ' ' + hash);
  };
  const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
  // Drawing the cells of hostile sites takes long.
  constexpr std::array drawn = {"uniform", "clustered", "globe_grid", "regional_grid", "wedge"};
  const bool is_drawn = std::ranges::find(drawn, name) != drawn.end();
  if (is_drawn)
    record("map", [&](unsigned threads) { return hash_of_map(triangulation, threads); });
  const CellSet cells = CellSet::voronoi(triangulation);
  const CellSet others = cells_of(generator("uniform").make(num_others, 7));
  const CellSet grid = grid_of(36, 17);
  const auto record_remaps = [&](const std::string& what, const CellSet& a, const CellSet& b) {
    for (const unsigned order : {1U, 2U}) {
      record(what + '-' + std::to_string(order),
             [&](unsigned threads) { return hash_of_remap(a, b, order, threads); });
    }
  };
  record_remaps("to-uniform", cells, others);
  record_remaps("to-grid", cells, grid);
  record_remaps("of-grid", grid, cells);
  if (!cells.covers_sphere()) return;
  record_remaps("of-uniform", others, cells);
  record_remaps("to-itself", cells, cells);
  const auto half_of = [](const CellSet& all) {
    CellRings half = all.rings();
    half.cells.resize(half.num_cells() / 2 + 1);
    half.rings.resize(half.cells.back() + 1);
    half.corners.resize(half.rings.back());
    std::erase_if(half.whole, [&](Index cell) { return cell >= half.num_cells(); });
    return CellSet::polygons(half);
  };
  record_remaps("parts", half_of(cells), half_of(others));
  record("clip", [&](unsigned threads) {
    return hash_of_rings(clip(cells, half_of(others), {.threads = threads}));
  });
  std::vector<Index> groups;
  for (Index i = 0; i < cells.num_cells(); ++i) groups.push_back(i % 3);
  record("dissolve", [&](unsigned threads) {
    return hash_of_rings(dissolve(cells.rings(), groups, 3, {.threads = threads}));
  });
  if (!is_drawn) return;
  record_operations(half_of(cells).rings(), others.rings(), record);
  const CellRings clipped = clip(cells, half_of(others));
  const CellRings dissolved = dissolve(cells.rings(), groups, 3);
  record("polygons", [&](unsigned threads) {
    return hash_of_region_polygons(cells.rings(), threads) +
           hash_of_region_polygons(clipped, threads) + hash_of_region_polygons(dissolved, threads);
  });
}

std::vector<std::string> all_lines() {
  std::vector<std::string> lines;
  for (const Generator& g : generators()) {
    if (!g.weighted_only) add_lines(std::string(g.name), g.make(40, 1), 60, lines);
  }
  for (const char* name : {"uniform", "globe_grid", "clustered"}) {
    add_lines(std::string(name) + "_5000", generator(name).make(5'000, 1), 6'000, lines);
  }
  add_countries(lines);
  return lines;
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  return rondel::test::compare_or_record("same_bytes_overlay", rondel::test::all_lines, argc, argv);
}
