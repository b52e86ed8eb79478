// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Voronoi cells of features: lines and polygon borders are replaced by sites along them
// (feature_sites.cpp), and the Voronoi cells of these sites are joined by feature. Where features
// have polygons, the part of each cell inside of any polygon is cut off and joined to that
// polygon's feature.
#include "rondel/feature_cells.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "overlay/disjoint_cells.h"
#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// Appends the corners of one ring to `points`.
void append_ring_points(const CellRings& cells, std::uint64_t ring, std::vector<Point>& points) {
  for (std::uint64_t k = cells.rings[ring]; k < cells.rings[ring + 1]; ++k) {
    points.push_back(cells.points[cells.corners[k]]);
  }
}

// Returns the lines of each feature, followed by the rings of its polygon as closed lines.
FeatureLines with_borders(const FeatureLines& lines, const CellRings& polygons) {
  FeatureLines all;
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t l = lines.offsets[f]; l < lines.offsets[f + 1]; ++l) {
      all.rows.append(lines.rows[l]);
    }
    for (std::uint64_t r = polygons.cells[f]; r < polygons.cells[f + 1]; ++r) {
      std::vector<Point>& points = all.rows.values;
      const std::size_t first = points.size();
      append_ring_points(polygons, r, points);
      const Point closing = points[first];
      points.push_back(closing);
      all.rows.end_row();
    }
    all.end_group();
  }
  return all;
}

// Throws InvalidInput, with the first pair of cells and a point of both, if two polygons overlap or
// one overlaps itself.
void require_disjoint(const CellRings& polygons, const Execution& execution) {
  const std::vector<CrossingCells> overlaps =
      overlapping_cells(polygons, {.threads = execution.threads, .stop = execution.stop});
  if (overlaps.empty()) return;
  const CrossingCells& one = overlaps.front();
  const LonLat place = lonlats(std::vector<Point>{one.place}).front();
  throw InvalidInput("polygon " + std::to_string(one.first) + " overlaps " +
                         (one.first == one.second ? std::string("itself")
                                                  : "polygon " + std::to_string(one.second)) +
                         " at " + system::shortest_text(place.lon_deg) + ' ' +
                         system::shortest_text(place.lat_deg),
                     one.first);
}

// Pairwise disjoint cells that cover the sphere, or pieces of such cells, with the feature that
// each belongs to.
struct OwnedCells {
  CellSet cells;
  std::vector<Index> owners;
  // The union of the cells of each feature, if it was computed on the way.
  std::optional<CellRings> joined;
};
OwnedCells owned_cells(const FeatureLines& lines, const CellRings& polygons, double tolerance,
                       const Execution& execution) {
  const std::size_t n = lines.size();
  const bool has_polygons = !polygons.corners.empty() || !polygons.whole.empty();
  if (has_polygons && polygons.num_cells() != n) {
    throw InvalidInput("there are " + std::to_string(polygons.num_cells()) + " cells for " +
                           std::to_string(n) + " features",
                       polygons.num_cells());
  }
  if (has_polygons) require_disjoint(polygons, execution);
  FeatureSites found =
      feature_sites(has_polygons ? with_borders(lines, polygons) : lines, tolerance, execution);
  CellSet cells = CellSet::voronoi(delaunay(Sites::view(found.sites), {}, execution), execution);
  if (!has_polygons) return {std::move(cells), std::move(found.features), std::nullopt};
  const RegionPieces pieces = intersection(
      cells, CellSet::polygons(overlay::with_outside(polygons, execution), execution), execution);
  std::vector<Index> owners(pieces.num_pieces());
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const bool is_outside = pieces.regions[k] == n;
    owners[k] = is_outside ? found.features[pieces.cells[k]] : pieces.regions[k];
  }
  CellRings joined = dissolve(pieces.rings, owners, n, execution);
  return {CellSet::polygons(pieces.rings, execution), std::move(owners), std::move(joined)};
}

// Returns execution options without a progress callback if owned_cells() has already reported its
// progress, since reported fractions must not decrease.
Execution quiet_after(const OwnedCells& owned, const Execution& execution) {
  if (!owned.joined) return execution;
  return {.threads = execution.threads, .stop = execution.stop};
}

}  // namespace

CellRings feature_cells(const FeatureLines& lines, const CellRings& polygons, double tolerance,
                        const Execution& execution) {
  const system::Call call(execution);
  OwnedCells owned = owned_cells(lines, polygons, tolerance, execution);
  if (owned.joined) return std::move(*owned.joined);
  return dissolve(owned.cells.rings(), owned.owners, lines.size(), execution);
}

CellRings clipped_feature_cells(const FeatureLines& lines, const CellRings& polygons,
                                double tolerance, const CellSet& regions,
                                const Execution& execution) {
  const system::Call call(execution);
  const OwnedCells owned = owned_cells(lines, polygons, tolerance, execution);
  return dissolve(clip(owned.cells, regions, quiet_after(owned, execution)), owned.owners,
                  lines.size(), execution);
}

RegionPieces feature_pieces(const FeatureLines& lines, const CellRings& polygons, double tolerance,
                            const CellSet& regions, const Execution& execution) {
  const system::Call call(execution);
  const OwnedCells owned = owned_cells(lines, polygons, tolerance, execution);
  return dissolve(intersection(owned.cells, regions, quiet_after(owned, execution)), owned.owners,
                  {}, execution);
}

}  // namespace rondel
