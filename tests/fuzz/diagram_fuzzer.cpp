// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// circumcenters, cells, areas, diagram, centroids, edges, merge_cocircular: what rondel/diagram.h
// promises of any triangulation.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace rondel::fuzz {
namespace {

double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

bool is_unit(const Point& p) { return std::abs(dot(p, p) - 1) < 1e-14; }

std::vector<bool> vertices(const Triangulation& t) {
  std::vector<bool> is_vertex(t.num_sites(), true);
  for (const Duplicate& d : t.duplicates()) is_vertex[d.site] = false;
  for (const Hidden& h : t.hidden()) is_vertex[h.site] = false;
  return is_vertex;
}

void test_cells(const Triangulation& t, const Cells& cells) {
  require(cells.rings.offsets.size() == t.num_sites() + 1 && cells.rings.offsets[0] == 0 &&
              cells.rings.offsets.back() == cells.rings.values.size(),
          "offsets frame the rings");
  require(std::ranges::is_sorted(cells.rings.offsets), "offsets increase");
  for (const Point& p : cells.points) require(is_unit(p), "points of a diagram are unit vectors");
  const std::vector<bool> is_vertex = vertices(t);
  for (std::size_t i = 0; i < t.num_sites(); ++i) {
    const std::span<const Index> ring = cells.rings[i];
    const std::size_t length = ring.size();
    const bool has_ring = is_vertex[i] && t.num_vertices() > 1;
    require((length > 0) == has_ring, "exactly the vertices have rings");
    for (std::size_t k = 0; k < length; ++k) {
      const Index here = ring[k];
      const Index there = ring[(k + 1) % length];
      require(here < cells.points.size() && there < cells.points.size(), "rings name points");
      require(dot(cells.points[here], cells.points[there]) > -0.5 - 1e-12,
              "no arc is longer than 120 degrees");
    }
  }
}

void test_areas(const Triangulation& t, const std::vector<double>& area) {
  require(area.size() == t.num_sites(), "an area for each site");
  const std::vector<bool> is_vertex = vertices(t);
  for (std::size_t i = 0; i < area.size(); ++i) {
    require(area[i] >= 0 && (is_vertex[i] || area[i] == 0), "areas are not negative");
  }
  if (t.num_vertices() == 0) return;
  const double sum = std::accumulate(area.begin(), area.end(), 0.0);
  require(std::abs(sum / (4 * std::numbers::pi) - 1) < 1e-12,
          "areas add up to the sphere, not to " + std::to_string(sum));
}

void test_centroids(const Triangulation& t) {
  for (const Point& p : centroids(t)) {
    require(p == Point{} || is_unit(p), "centroids are unit vectors or zero");
  }
}

void test_edges(const Triangulation& t) {
  const auto all = edges(t);
  require(std::ranges::is_sorted(all), "edges are sorted");
  require(std::ranges::adjacent_find(all) == all.end(), "edges are distinct");
  for (const auto& [a, b] : all) require(a < b && b < t.num_sites(), "the lower index is first");
  if (t.dimension() == 2) require(2 * all.size() == 3 * t.num_faces(), "edges of triangles");
}

void test_polygons(const Triangulation& t) {
  const CompressedRows<Index> merged = merge_cocircular(t);
  std::size_t num_triangles = 0;
  for (std::size_t i = 0; i + 1 < merged.offsets.size(); ++i) {
    const auto begin = merged.values.begin() + static_cast<std::ptrdiff_t>(merged.offsets[i]);
    const auto end = merged.values.begin() + static_cast<std::ptrdiff_t>(merged.offsets[i + 1]);
    require(end - begin >= 3, "a polygon has three corners or more");
    require(std::min_element(begin, end) == begin, "the lowest index is first");
    num_triangles += static_cast<std::size_t>(end - begin) - 2;
  }
  require(num_triangles <= t.num_faces(), "merging adds no triangles");
}

void test_cells_alone(const Triangulation& t) {
  const std::vector<Point> centers = circumcenters(t);
  require(centers.size() == t.num_faces(), "a circumcenter for each face");
  const Cells cells_only = cells(t);
  require(cells_only.points.size() >= centers.size() &&
              std::ranges::equal(centers, std::span(cells_only.points).first(centers.size())),
          "the points start with the circumcenters");
  test_cells(t, cells_only);
  test_areas(t, areas(t));
}

void test_diagram(const Triangulation& t) {
  const Diagram both = diagram(t);
  test_cells(t, both.cells);
  test_areas(t, both.areas);
  test_centroids(t);
}

void test_both_ways(const Triangulation& t) {
  const Cells cells_only = cells(t);
  const Diagram both = diagram(t);
  require(both.cells.rings == cells_only.rings && both.cells.points == cells_only.points,
          "cells are the same with areas");
}

void test_edges_and_polygons(const Triangulation& t) {
  test_edges(t);
  test_polygons(t);
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  Options options;
  const std::uint8_t what = source.byte();
  options.model = what % 2 == 0 ? Model::weighted : Model::projected;
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 30);
  options.sphere = fuzz::next_sphere(source, scales);
  const std::vector<Point> sites = fuzz::all_sites(source, limit, scales, options);
  constexpr std::array tests = {fuzz::test_cells_alone, fuzz::test_diagram,
                                fuzz::test_edges_and_polygons, fuzz::test_both_ways};
  tests[what / 2 % tests.size()](delaunay(sites, options));
  return 0;
}
