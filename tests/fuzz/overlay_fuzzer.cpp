// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Partition, remap, apply_gradients: what rondel/partition.h and rondel/remap.h promise of any sites and
// of any cells.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/remap.h"

namespace rondel::fuzz {
namespace {

double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void test_arrays(const Remap& remap, const Partition& source, const Partition& target) {
  require(remap.offsets.size() == target.num_cells() + 1 &&
              remap.offsets.back() == remap.columns.size() &&
              remap.areas.size() == remap.columns.size() &&
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
    if (remap.offsets[j] == remap.offsets[j + 1]) {
      require(sum == 0, "no piece, no weight");
    } else {
      require(std::abs(sum - 1) <= 1e-14 * absolute, "weights add up to 1");
    }
  }
  for (const double area : remap.areas) require(area > 0, "pieces have an area");
}

// Of diagrams, whose cells may be narrower than rounding.
void test_diagrams(const Partition& source, const Partition& target) {
  const bool is_sound = source.is_cover() && target.is_cover() &&
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
  const Remap same = remap(source, source, covered);
  for (std::size_t j = 0; j < source.num_cells(); ++j) {
    if (!(source.areas()[j] > 1e-24)) continue;  // no wider than rounding
    double others = 0;  // where edges are as good as parallel, more than rounding of corners
    for (auto k = same.offsets[j]; k < same.offsets[j + 1]; ++k) {
      if (same.columns[k] != j) others += same.areas[k];
    }
    require(others < 1e-14, "a partition onto itself is the identity");
  }
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
      for (const Index v : face) rings.corners.push_back(v);
      rings.rings.push_back(rings.corners.size());
      rings.cells.push_back(rings.rings.size() - 1);
    }
  }
  const std::size_t more = source.below(4);
  for (std::size_t i = 0; i < more; ++i) {
    const std::size_t size = source.below(8);
    for (std::size_t k = 0; k < size; ++k) {
      rings.corners.push_back(static_cast<Index>(source.below(rings.points.size() + 1)));
    }
    rings.rings.push_back(rings.corners.size());
    if (source.below(4) != 0) rings.cells.push_back(rings.rings.size() - 1);
  }
  if (source.below(16) == 0) rings.cells.push_back(source.byte());
  return rings;
}

void test_any_cells(const CellRings& rings, const Partition& target) {
  try {
    const Partition cells(rings);
    require(cells.num_cells() == rings.num_cells() && cells.areas().size() == cells.num_cells(),
            "an area for each cell");
    const Remap there = remap(cells, target, {.norm = RemapNorm::fracarea});
    require(there.weights.num_columns == cells.num_cells(), "columns are sources");
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
    const Partition cells = Partition::voronoi(t);
    const Partition others = Partition::voronoi(delaunay(second, options));
    fuzz::test_diagrams(cells, others);
    const Partition triangles = Partition::triangles(t);
    if (others.is_cover()) {
      const Remap of_triangles = remap(triangles, others);
      fuzz::require(of_triangles.source_areas.size() == triangles.num_cells(), "an area for each");
      fuzz::test_any_cells(fuzz::next_rings(source, t), others);
    }
  } catch (const InvalidInput&) {  // the center, say
  }
  return 0;
}
