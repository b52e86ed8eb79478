// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// CellSet, remap, apply_gradients: what rondel/cell_set.h and rondel/remap.h promise of any sites and
// of any cells.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "fuzz/valid_polygons.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"

namespace rondel::fuzz {
namespace {

double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void test_arrays(const Remap& remap, const CellSet& source, const CellSet& target) {
  require(remap.pieces.offsets.size() == target.num_cells() + 1 &&
              remap.pieces.offsets.back() == remap.pieces.values.size() &&
              remap.areas.size() == remap.pieces.values.size() &&
              remap.weights.num_columns == source.num_cells() &&
              remap.weights.num_rows() == target.num_cells(),
          "the arrays fit together");
  for (std::size_t j = 0; j < target.num_cells(); ++j) {
    double sum = 0;
    double absolute = 0;
    for (auto k = remap.weights.offsets[j]; k < remap.weights.offsets[j + 1]; ++k) {
      require(remap.weights.columns[k] < source.num_cells(), "a column is a source");
      require(std::isfinite(remap.weights.values[k]), "a weight is a number");
      sum += remap.weights.values[k];
      absolute += std::abs(remap.weights.values[k]);
    }
    if (remap.pieces.offsets[j] == remap.pieces.offsets[j + 1]) {
      require(sum == 0, "no piece, no weight");
    } else {
      require(std::abs(sum - 1) <= 1e-14 * absolute, "weights add up to 1");
    }
  }
  for (const double area : remap.areas) require(area > 0, "pieces have an area");
}

// Of diagrams, whose cells may be narrower than rounding.
void test_diagrams(const CellSet& source, const CellSet& target) {
  const bool is_sound = source.covers_sphere() && target.covers_sphere() &&
                        std::abs(sum_of(source.areas()) - 4 * std::numbers::pi) < 1e-9 &&
                        std::abs(sum_of(target.areas()) - 4 * std::numbers::pi) < 1e-9;
  if (!is_sound) return;
  const RemapOptions covered{.norm = RemapNorm::fracarea};
  const Remap there = remap(source, target, covered);
  const Remap back = remap(target, source, covered);
  test_arrays(there, source, target);
  test_arrays(back, target, source);
  require(std::abs(sum_of(there.areas) - 4 * std::numbers::pi) < 1e-8, "pieces cover the sphere");
  require(std::abs(sum_of(back.areas) - 4 * std::numbers::pi) < 1e-8, "and so they do back");
  const Remap second = remap(source, target, {.order = 2, .norm = RemapNorm::fracarea});
  require(second.areas == there.areas, "the order changes no piece");
  const std::vector<double> ones(source.num_cells(), 1);
  std::vector<double> out(target.num_cells());
  apply_gradients(second, ones, std::vector<Point>(source.num_cells()), out);
  for (const double value : out) {
    require(std::isnan(value) || std::abs(value - 1) < 1e-14, "a constant comes back");
  }
  std::vector<double> marks(source.num_cells());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = i % 3 == 0 ? 1 : 0;
  apply_limited(second, marks, out);
  for (const double value : out) {
    require(std::isnan(value) || (value >= 0 && value <= 1), "limited values are within bounds");
  }
  SecondOrderRemap(second, {}, RemapLimiter::slopes).apply(marks, out);
  for (const double value : out) {
    require(std::isnan(value) || (value >= 0 && value <= 1), "slopes reach no new extremes");
  }
  std::vector<std::int32_t> has_value(source.num_cells(), 1);
  for (std::size_t i = 0; i < has_value.size(); i += 3) has_value[i] = 0;
  std::vector<double> with_gaps(source.num_cells(), 2);
  for (std::size_t i = 0; i < has_value.size(); ++i) {
    if (has_value[i] == 0) with_gaps[i] = std::numeric_limits<double>::quiet_NaN();
  }
  apply(weights_with_values(second, has_value), with_gaps, out);
  for (const double value : out) {
    require(std::isnan(value) || std::abs(value - 2) < 1e-9, "constants are kept beside gaps");
  }
  std::vector<double> of_gaps(out.size());
  SecondOrderRemap(second).apply(with_gaps, of_gaps, {.max_missing = 1});
  for (std::size_t j = 0; j < out.size(); ++j) {
    require(std::isnan(out[j]) || of_gaps[j] == out[j], "these weights are applied");
  }
  SecondOrderRemap(second, {}, RemapLimiter::slopes).apply(with_gaps, of_gaps, {.max_missing = 1});
  for (std::size_t j = 0; j < out.size(); ++j) {
    require(std::isnan(out[j]) || of_gaps[j] == 2, "slopes of constants are none");
  }
  const Remap same = remap(source, source, covered);
  for (std::size_t j = 0; j < source.num_cells(); ++j) {
    if (!(source.areas()[j] > 1e-24)) continue;  // no wider than rounding
    double others = 0;  // where edges are as good as parallel, more than rounding of corners
    for (auto k = same.pieces.offsets[j]; k < same.pieces.offsets[j + 1]; ++k) {
      if (same.pieces.values[k] != j) others += same.areas[k];
    }
    require(others < 1e-14, "cells onto themselves are the identity");
  }
}

// Lines at multiples of a few degrees, or anywhere.
std::vector<double> next_lines(ByteSource& source, double first, double last) {
  std::vector<double> lines = {first};
  const std::size_t count = 1 + source.below(8);
  for (std::size_t k = 1; k <= count && lines.back() < last; ++k) {
    const double step = source.below(3) == 0 ? source.byte() * 0.37 + 1e-13
                                             : static_cast<double>(source.below(5)) * 30;
    if (step > 0) lines.push_back(std::min(last, lines.back() + step));
  }
  if (lines.back() < last && source.below(2) == 0) lines.push_back(last);
  if (lines.size() == 1) lines.push_back(last);
  return lines;
}

// What a grid has of the sphere is what the diagram's pieces have of it.
void test_grid(const CellSet& cells, ByteSource& source) {
  LonLatGrid lines;
  const double west = static_cast<double>(source.below(25)) * 30 - 360;
  lines.lon_deg = next_lines(source, west, west + 360);
  lines.lat_deg = next_lines(source, source.below(2) == 0 ? -90 : -37.5, 90);
  if (source.below(2) == 0) std::ranges::reverse(lines.lat_deg);
  const CellSet grid = CellSet::lonlat_grid(lines);
  require(grid.has_parallels() && !cells.has_parallels(), "the grid has no rings");
  const bool is_sound =
      cells.covers_sphere() && std::abs(sum_of(cells.areas()) - 4 * std::numbers::pi) < 1e-9;
  if (!is_sound) return;
  const RemapOptions covered{.order = 2, .norm = RemapNorm::fracarea};
  const Remap there = remap(cells, grid, covered);
  const Remap back = remap(grid, cells, covered);
  test_arrays(there, cells, grid);
  test_arrays(back, grid, cells);
  require(std::abs(sum_of(there.areas) - sum_of(grid.areas())) < 1e-9, "pieces cover the grid");
  require(std::abs(sum_of(back.areas) - sum_of(grid.areas())) < 1e-9, "and so they do back");
  // Lines nearer than 2e-11 degrees to each other are one where grids meet.
  const auto is_narrow = [](const std::vector<double>& all) {
    return std::ranges::adjacent_find(
               all, [](double a, double b) { return std::abs(a - b) < 1e-10; }) != all.end();
  };
  if (is_narrow(lines.lon_deg) || is_narrow(lines.lat_deg)) return;
  const Remap same = remap(grid, grid);
  require(same.pieces.values.size() == grid.num_cells(), "a grid onto itself is the identity");
}

// Every ring of a file is closed and on the map, and there is a feature for each piece.
void test_file(const RegionPieces& pieces) {
  const ScratchFolder folder;
  const std::string path = folder.file("regions.geojson");
  require(can_write_regions(path), "a format of regions can be written");
  require(!can_write_regions(folder.file("regions.csv")), "other formats cannot");
  require_region_writer(path);
  write_regions(path, pieces.rings, {}, 5, {1}, {}, drawing_of(pieces.rings, {1}));
  const LonLatRegions drawn = region_polygons(pieces.rings, 5);
  require(drawn.polygons.rows.offsets.back() == drawn.polygons.rows.values.size(),
          "rings have all positions");
  require(drawn.polygons.offsets.back() == drawn.polygons.rows.size(), "and polygons all rings");
  require(drawn.owners.size() == drawn.polygons.size(), "each polygon has an owner");
  const LonLatRegions apart = region_polygons(pieces.rings, 5, {}, CellDrawing::apart);
  require(apart.owners.size() == apart.polygons.size(), "so it has where cells are drawn apart");
  const auto document = nlohmann::json::parse(content(path));
  require(document["features"].size() == pieces.num_pieces(), "a feature for each piece");
  require_valid(document, false);  // what is no wider than rounding is left out
  for (const auto& feature : document["features"]) {
    const auto& geometry = feature["geometry"];
    if (geometry.is_null()) continue;
    const auto polygons = geometry["type"] == "Polygon"
                              ? nlohmann::json::array({geometry["coordinates"]})
                              : geometry["coordinates"];
    for (const auto& polygon : polygons) {
      for (const auto& ring : polygon) {
        require(ring.size() > 3 && ring.front() == ring.back(), "rings are closed");
        for (const auto& position : ring) {
          require(std::abs(position[0].get<double>()) <= 180 &&
                      std::abs(position[1].get<double>()) <= 90,
                  "positions are on the map");
        }
      }
    }
  }
}

// Whether no cell is the whole sphere, which has no border, and nothing is lost.
bool has_borders(const CellSet& cells) {
  constexpr double nearly_whole = 12;
  return cells.covers_sphere() && std::abs(sum_of(cells.areas()) - 4 * std::numbers::pi) < 1e-9 &&
         std::ranges::all_of(cells.areas(), [](double area) { return area < nearly_whole; });
}

// Of diagrams, too: the pieces as polygons.
void test_regions(const CellSet& cells, const CellSet& others, Index num_groups) {
  const double whole = 4 * std::numbers::pi;
  if (!has_borders(cells) || !has_borders(others)) return;
  const RegionPieces pieces = intersection(cells, others);
  require(std::abs(sum_of(areas(pieces.rings)) - whole) < 1e-8, "polygons cover the sphere");
  if (num_groups == 1) test_file(pieces);
  const CellRings joined = dissolve(pieces.rings, pieces.cells, cells.num_cells());
  require(std::abs(sum_of(areas(joined)) - whole) < 1e-8, "and so they do joined");
  const CellRings clipped = clip(cells, others);
  const std::vector<double> by_pieces = areas(joined);
  const std::vector<double> by_cells = areas(clipped);
  for (std::size_t i = 0; i < by_cells.size(); ++i) {
    require(std::abs(by_pieces[i] - by_cells[i]) < 1e-9, "to join pieces is to clip cells");
  }
  std::vector<Index> groups(cells.num_cells());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i] = i % (num_groups + 1) == num_groups ? no_index : static_cast<Index>(i % num_groups);
  }
  const RegionPieces by_group = dissolve(pieces, groups, {});
  double left = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) left += groups[i] == no_index ? 0 : by_pieces[i];
  require(std::abs(sum_of(areas(by_group.rings)) - left) < 1e-8, "pieces joined by group");
  const CellRings all = dissolve(cells.rings(), std::vector<Index>(cells.num_cells(), 0), 1);
  require(all.is_whole(0), "all cells together are the whole sphere");
  const CellRings regions = dissolve(cells.rings(), groups, num_groups);
  const CellRings inside = clip(others, CellSet::polygons(regions));
  require(std::abs(sum_of(areas(inside)) - sum_of(areas(regions))) < 1e-8,
          "what is clipped has the area of the regions");
}

// Cells with any corners, some of them of a diagram.
CellRings next_rings(ByteSource& source, const Triangulation& t) {
  CellRings rings;
  for (const Point& p : t.sites().points()) {
    const double length = std::hypot(p.x, p.y, p.z);
    rings.points.push_back({p.x / length, p.y / length, p.z / length});
  }
  if (t.dimension() == 2 && source.below(2) == 0) {
    for (const Triple& face : t.faces()) {
      rings.append_ring(face);
      rings.end_cell();
    }
  }
  const std::size_t more = source.below(4);
  for (std::size_t i = 0; i < more; ++i) {
    const std::size_t size = source.below(8);
    for (std::size_t k = 0; k < size; ++k) {
      rings.corners.push_back(static_cast<Index>(source.below(rings.points.size() + 1)));
    }
    rings.end_ring();
    if (source.below(4) != 0) rings.end_cell();
  }
  if (source.below(16) == 0) rings.cells.push_back(source.byte());
  return rings;
}

std::vector<Index> corners_by_offsets(const CellRings& cells, std::size_t ring) {
  const auto at = [&](std::size_t r) {
    return cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.rings[r]);
  };
  return {at(ring), at(ring + 1)};
}

// Every cell but some, which become empty.
CellSet without_some(const CellSet& cells, Index step) {
  const CellRings all = cells.rings();
  CellRings result;
  result.points = all.points;
  CellRings again = result;
  for (std::size_t i = 0; i < all.num_cells(); ++i) {
    again.append_cell(all, i);
    if (i % step != 0) result.append_rings(all, i);
    result.end_cell();
  }
  require(again.cells == all.cells && again.rings == all.rings && again.corners == all.corners &&
              again.whole == all.whole,
          "all cells one after the other are the cells");
  for (std::size_t r = 0; r + 1 < all.rings.size(); ++r) {
    require(std::ranges::equal(all.corners_of(r), corners_by_offsets(all, r)),
            "a ring has its corners");
  }
  return CellSet::polygons(result);
}

// Of two diagrams with gaps the pieces are those of the diagrams without any.
void test_parts(const CellSet& cells, const CellSet& others, ByteSource& source) {
  if (!has_borders(cells) || !has_borders(others)) return;
  const auto first = static_cast<Index>(2 + source.below(3));
  const auto second = static_cast<Index>(2 + source.below(3));
  const Remap whole = remap(cells, others);
  const CellSet target = without_some(others, second);
  const Remap parts = remap(without_some(cells, first), target);
  std::vector<double> areas(cells.num_cells());
  for (std::size_t j = 0; j < others.num_cells(); ++j) {
    for (auto k = parts.pieces.offsets[j]; k < parts.pieces.offsets[j + 1]; ++k) {
      require(parts.pieces.values[k] % first != 0 && j % second != 0, "gaps have no pieces");
      areas[parts.pieces.values[k]] += parts.areas[k];
    }
    for (auto k = whole.pieces.offsets[j]; k < whole.pieces.offsets[j + 1]; ++k) {
      if (whole.pieces.values[k] % first != 0 && j % second != 0) {
        areas[whole.pieces.values[k]] -= whole.areas[k];
      }
    }
  }
  for (const double area : areas) require(std::abs(area) < 1e-9, "pieces do not see gaps");
}

// Cells that are not refused have their own area over a cover, and no place twice.
void test_shares(const Remap& there, const CellSet& cells, const CellSet& cover) {
  std::vector<double> shares(cells.num_cells());
  for (std::size_t j = 0; j < cover.num_cells(); ++j) {
    double sum = 0;
    for (auto k = there.pieces.offsets[j]; k < there.pieces.offsets[j + 1]; ++k) {
      shares[there.pieces.values[k]] += there.areas[k];
      sum += there.areas[k];
    }
    require(sum < cover.areas()[j] + 1e-9, "no place counts twice");
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    require(std::abs(shares[i] - cells.areas()[i]) < 1e-9, "pieces add up to their cell");
  }
  for (const double weight : there.weights.values) require(std::isfinite(weight), "finite weights");
}

// Repaired cells do not cross themselves, and are not repaired again.
void test_repaired(const CellSet& cells) {
  const CellSet sound = cells.repaired();
  require(sound.num_cells() == cells.num_cells(), "a cell for each cell");
  for (const CrossingCells& pair : overlapping_cells(sound.rings())) {
    require(pair.first != pair.second, "no cell crosses itself");
  }
  require(sound.repaired().facts().remarks == sound.facts().remarks, "nothing is left to repair");
}

void test_any_cells(const CellRings& rings, const CellSet& target) {
  try {
    const CellSet cells = CellSet::polygons(rings);
    test_repaired(cells);
    const std::vector<CrossingCells> overlaps = overlapping_cells(rings);
    require(cells.num_cells() == rings.num_cells() && cells.areas().size() == cells.num_cells(),
            "an area for each cell");
    require(CellSet::polygons(cells.given_rings()).num_cells() == cells.num_cells(),
            "the same cells again");
    const Remap there = remap(cells, target, {.norm = RemapNorm::fracarea});
    require(there.weights.num_columns == cells.num_cells(), "columns are sources");
    require(overlaps.empty(), "cells that overlap are refused");
    test_shares(there, cells, target);
    require(clip(target, cells).num_cells() == target.num_cells(), "a part of each cell");
    const Remap of_parts = remap(cells, without_some(target, 2), {.order = 2});
    require(of_parts.weights.num_columns == cells.num_cells(), "of two parts, too");
  } catch (const InvalidInput&) {  // says what is wrong
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const fuzz::Scales scales = fuzz::next_scales(source);
  const Options options;
  std::vector<Point> sites = fuzz::all_sites(source, 40, scales, options);
  // The second half is that of the target, which shares a few.
  const std::size_t half = sites.size() / 2;
  const std::vector<Point> first(sites.begin(), sites.begin() + static_cast<std::ptrdiff_t>(half));
  std::vector<Point> second(sites.begin() + static_cast<std::ptrdiff_t>(half), sites.end());
  second.insert(second.end(), first.begin(), first.begin() + static_cast<std::ptrdiff_t>(half / 3));
  try {
    const Triangulation t = delaunay(first, options);
    const CellSet cells = CellSet::voronoi(t);
    const CellSet others = CellSet::voronoi(delaunay(second, options));
    fuzz::test_diagrams(cells, others);
    fuzz::test_regions(cells, others, static_cast<Index>(1 + source.below(3)));
    fuzz::test_grid(cells, source);
    fuzz::test_parts(cells, others, source);
    const CellSet triangles = CellSet::triangles(t);
    if (others.covers_sphere()) {
      const Remap of_triangles = remap(triangles, others);
      fuzz::require(of_triangles.source_areas.size() == triangles.num_cells(), "an area for each");
      fuzz::test_any_cells(fuzz::next_rings(source, t), others);
    }
  } catch (const InvalidInput&) {  // the center, say
  }
  return 0;
}
