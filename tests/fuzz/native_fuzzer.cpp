// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of weights in the cells of meshes, of their duals, of nodes between centers, and of
// extrapolation, for any cells and places.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/extrapolate.h"
#include "rondel/native_weights.h"
#include "rondel/read_cells.h"

namespace rondel::fuzz {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

LonLat next_place(ByteSource& source) {
  return {source.small() * 3.5, std::clamp(source.small() * 1.5, -90.0, 90.0)};
}

// Cells with any corners: convex ones, some that cross themselves, and numbers of no corner.
CellRings next_cells(ByteSource& source) {
  CellRings cells;
  std::vector<LonLat> places;
  for (std::size_t n = 1 + source.below(12); n > 0; --n) places.push_back(next_place(source));
  cells.points = unit_vectors(places);
  for (std::size_t n = source.below(5); n > 0; --n) {
    for (std::size_t rings = source.below(16) == 15 ? 2 : 1; rings > 0; --rings) {
      for (std::size_t k = source.below(7); k > 0; --k) {
        cells.corners.push_back(static_cast<Index>(source.below(places.size())));
      }
      cells.end_ring();
    }
    cells.end_cell();
  }
  if (source.below(32) == 31 && !cells.corners.empty()) cells.corners.back() = 100;
  return cells;
}

void test_rows(const Weights& weights, std::size_t num_targets, std::size_t num_points) {
  require(weights.num_rows() == num_targets, "a row for each target");
  require(weights.num_columns == num_points, "a column for each point");
  for (std::size_t r = 0; r < num_targets; ++r) {
    double sum = 0;
    double size = 0;
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      require(std::isfinite(weights.values[k]), "weights are finite");
      sum += weights.values[k];
      size += std::abs(weights.values[k]);
    }
    if (size > 0) require(std::abs(sum - 1) <= 1e-14 * size, "weights add up to 1");
  }
}

void test_native(ByteSource& source) {
  const CellRings cells = next_cells(source);
  std::vector<Point> targets = cells.points;
  for (std::size_t n = source.below(4); n > 0; --n) {
    targets.push_back(unit_vector(next_place(source)));
  }
  try {
    const Weights weights = native_weights(cells, targets, {.threads = 1});
    test_rows(weights, targets.size(), cells.points.size());
    std::vector<Point> centers;
    for (std::size_t c = 0; c < cells.num_cells(); ++c) {
      centers.push_back(unit_vector(next_place(source)));
    }
    const CellRings dual = dual_cells(cells, centers);
    require(dual.num_cells() <= cells.points.size(), "a dual cell for each point at most");
    for (const Index i : dual.corners) require(i < centers.size(), "its corners are centers");
  } catch (const InvalidInput& error) {
    require(*error.what() != '\0', "a refusal says why");
  }
}

// Lines end, and bands of any values are regions of cells that do not overlap beside a side.
void test_contours(ByteSource& source) {
  const CellRings cells = next_cells(source);
  std::vector<double> values;
  for (std::size_t i = 0; i < cells.points.size(); ++i) {
    values.push_back(source.below(8) == 7 ? missing : source.small());
  }
  const std::vector<double> levels = {-1, 0, 2};
  try {
    const Isolines lines = isolines(cells, values, levels, {.threads = 1});
    require(lines.lines.size() == levels.size(), "a group for each level");
    for (std::size_t k = 0; k < lines.num_lines(); ++k) {
      require(lines.lines.rows[k].size() >= 2, "lines have points");
    }
    const Bands all = bands(cells, values, levels, {.threads = 1});
    require(all.bands.size() == all.num_bands(), "a group for each band");
    const Bands one = bands(cells, values, {}, {.threads = 1});
    require((one.num_polygons() == 0) == (all.num_polygons() == 0), "bands cover the same");
  } catch (const InvalidInput& error) {
    require(*error.what() != '\0', "a refusal says why");
  }
}

void test_nodes(ByteSource& source) {
  const std::size_t rows = source.below(4);
  const std::size_t columns = source.below(5);
  std::vector<LonLat> centers;
  for (std::size_t k = rows * columns; k > 0; --k) {
    centers.push_back(source.below(8) == 7 ? LonLat{missing, 0} : next_place(source));
  }
  try {
    const std::vector<LonLat> nodes = nodes_between(centers, {rows, columns});
    require(nodes.size() == (rows + 1) * (columns + 1), "one row and one column more");
  } catch (const InvalidInput& error) {
    require(rows < 2 || columns < 2, error.what());
  }
}

void test_extrapolation(ByteSource& source) {
  const auto next_places = [&](std::size_t n) {
    std::vector<LonLat> places;
    for (; n > 0; --n) {
      places.push_back(source.below(8) == 7 ? LonLat{missing, missing} : next_place(source));
    }
    return places;
  };
  const auto next_values = [&](std::size_t n) {
    std::vector<double> values;
    for (; n > 0; --n) values.push_back(source.below(2) == 1 ? missing : source.small());
    return values;
  };
  const std::size_t rows = 1 + source.below(3);
  const std::size_t columns = 1 + source.below(4);
  const std::vector<Point> targets = known_unit_vectors(next_places(rows * columns));
  const std::vector<Point> sources = known_unit_vectors(next_places(source.below(6)));
  ExtrapolationOptions options;
  options.method = static_cast<Extrapolation>(source.below(3));
  require(extrapolation_named(name_of(options.method)) == options.method, "methods have names");
  if (source.below(2) == 1) options.max_distance_km = 100 * std::abs(source.small());
  options.neighbors = 1 + static_cast<unsigned>(source.below(4));
  options.exponent = 1 + static_cast<unsigned>(source.below(3));
  options.levels = static_cast<unsigned>(source.below(3));
  const bool is_grid = source.below(2) == 1;
  const std::vector<std::uint64_t> shape = {rows, columns};
  CompressedRows<Index> neighbors =
      is_grid ? target_neighbors(targets, shape) : place_neighbors(targets);
  if (is_grid) require(neighbors == grid_neighbors(targets, rows, columns), "a shape is a grid");
  Extrapolator extrapolator(sources, targets, std::move(neighbors), options);
  for (int field = 0; field < 2; ++field) {
    const std::vector<double> before = next_values(targets.size());
    std::vector<double> filled = before;
    const std::vector<double> values = next_values(sources.size());
    const std::size_t count = extrapolator.fill(values, filled, {.threads = 1});
    std::size_t num_new = 0;
    for (std::size_t t = 0; t < filled.size(); ++t) {
      const bool had_value = !std::isnan(before[t]);
      require(!had_value || filled[t] == before[t], "values that are there stay");
      if (!had_value && !std::isnan(filled[t])) ++num_new;
    }
    require(num_new == count, "new values are counted");
  }
  Weights empty;
  empty.num_columns = sources.size();
  for (std::size_t t = 0; t < targets.size(); ++t) empty.end_row();
  test_rows(extrapolator.filled(empty), targets.size(), sources.size());
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel::fuzz;
  ByteSource source(data, size);
  switch (source.below(3)) {
    case 0:
      test_native(source);
      test_contours(source);
      break;
    case 1:
      test_nodes(source);
      break;
    default:
      test_extrapolation(source);
  }
  return 0;
}
