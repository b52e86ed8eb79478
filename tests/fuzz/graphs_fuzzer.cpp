// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/graphs.h and rondel/outlines.h: what they promise of any sites.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "fuzz/table_input.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/graphs.h"
#include "rondel/outlines.h"
#include "rondel/polygons.h"

namespace rondel::fuzz {
namespace {

using Edge = std::array<Index, 2>;
using Edges = std::vector<Edge>;

void test_edge_index(const SiteGraph& graph) {
  const EdgeIndex both = edge_index(graph);
  const std::size_t count = both.lengths.size();
  require(count == 2 * graph.edges.size() && both.ends.size() == 2 * count, "both directions");
  std::set<std::array<std::int64_t, 2>> arcs;
  for (std::size_t i = 0; i < count; ++i) arcs.insert({both.ends[i], both.ends[count + i]});
  for (const auto& [a, b] : arcs) require(arcs.contains({b, a}), "an arc has its opposite");
}

// The graphs, each part of those before it, and a tree.
void test_graphs(const Triangulation& t) {
  const SiteGraph all = site_graph(t, GraphKind::delaunay);
  const SiteGraph urquhart = site_graph(t, GraphKind::urquhart);
  const SiteGraph gabriel = site_graph(t, GraphKind::gabriel);
  const SiteGraph relative = site_graph(t, GraphKind::relative);
  const SiteGraph tree = site_graph(t, GraphKind::spanning_tree);
  const auto is_part = [](const SiteGraph& part, const Edges& whole) {
    return std::ranges::includes(whole, part.edges);
  };
  require(is_part(all, edges(t)), "edges of faces are edges");
  require(is_part(urquhart, all.edges) && is_part(gabriel, all.edges), "graphs are of edges");
  require(is_part(relative, urquhart.edges) && is_part(relative, gabriel.edges),
          "relative neighbors are neighbors");
  require(is_part(tree, relative.edges), "the tree is of relative neighbors");
  require(t.num_vertices() == 0 || tree.edges.size() + 1 == t.num_vertices(), "a tree");
  for (const double length : all.lengths) {
    require(length >= 0 && length <= 3.1415926535897936, "lengths are angles");
  }
  test_edge_index(gabriel);
}

// In another order of the sites the same places are joined, ties between trees apart.
void test_any_order(std::vector<Point> sites, const Options& options, const Triangulation& t) {
  std::ranges::reverse(sites);
  const Triangulation other = delaunay(sites, options);
  if (!other.duplicates().empty()) return;
  const auto last = static_cast<Index>(sites.size() - 1);
  for (const GraphKind kind : {GraphKind::urquhart, GraphKind::gabriel, GraphKind::relative}) {
    Edges found = site_graph(other, kind).edges;
    for (Edge& e : found) e = {last - e[1], last - e[0]};
    std::ranges::sort(found);
    require(found == site_graph(t, kind).edges, "the order of the sites changes nothing");
  }
}

void test_outline(const Outline& outline) {
  require(outline.offsets.back() == outline.rows.size() &&
              outline.rows.offsets.back() == outline.rows.values.size(),
          "the arrays of an outline fit together");
  for (std::size_t r = 0; r < outline.rows.size(); ++r) {
    const std::span<const Index> ring = outline.rows[r];
    const std::set<Index> corners(ring.begin(), ring.end());
    require(corners.size() >= 3 && corners.size() == ring.size(), "rings are simple");
  }
}

void test_files(const ScratchFolder& folder, const Triangulation& t) {
  const SiteGraph graph = site_graph(t, GraphKind::gabriel);
  const std::string path = folder.file("graph.geojson");
  write_graph(path, t, graph, 5);
  require(nlohmann::json::parse(content(path)).at("features").size() == graph.edges.size(),
          "a feature an edge");
  const Outline hull = hull_polygon(t);
  write_outline(path, t, hull, 5);
  require(nlohmann::json::parse(content(path)).at("features").size() == hull.size(),
          "a feature a polygon");
  const auto circles = largest_empty_circles(t, 5);
  write_circles(path, circles);
  require(nlohmann::json::parse(content(path)).at("features").size() == circles.size(),
          "a feature a circle");
  std::vector<std::array<Point, 2>> arcs;
  for (const EmptyCircle& circle : circles) {
    arcs.push_back({circle.center, circles.front().center});
  }
  const CompressedRows<LonLat> lines = arc_lines(arcs, 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    require(lines[i].size() >= 2, "a line has two ends");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::ScratchFolder folder;
  fuzz::ByteSource source(data, size);
  const bool is_written = source.below(8) == 0;
  const double radius = source.small() / 64.0;
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 30);
  const Options options;
  const std::vector<Point> sites = fuzz::all_sites(source, limit, scales, options);
  const Triangulation t = delaunay(sites, options);
  fuzz::test_graphs(t);
  fuzz::test_any_order(sites, options, t);
  fuzz::test_outline(hull_polygon(t));
  fuzz::test_outline(alpha_shape(t, std::abs(radius)));
  const auto circles = largest_empty_circles(t, 7, CircleCenters::anywhere);
  fuzz::require(std::ranges::is_sorted(circles, std::ranges::greater{}, &EmptyCircle::radius),
                "the largest circles come first");
  if (is_written) fuzz::test_files(folder, t);
  return 0;
}
