// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// In water that is narrow everything is border: a refinement by angles alone puts no vertex between
// two coasts that are near to each other, and edges across the water are as short as it is narrow.
// Beside such an edge no triangle is much larger. So narrow water is found by its triangles.
#include "meshing/narrow_water.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "exact/point_order.h"
#include "exact/vector.h"
#include "meshing/mesh_border.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"

namespace rondel::meshing {
namespace {

using mesh::FeatureOfEdge;
using Ends = std::array<Index, 2>;

class NarrowWater {
 public:
  explicit NarrowWater(const mesh::DomainTriangles& made)
      : mesh_(made.mesh), features_(made.features), is_needed_(made.mesh.nodes.size()) {
    for (std::size_t v = 0; v < is_needed_.size(); ++v) {
      is_needed_[v] = mesh_.sites[v] != no_index;
    }
  }

  std::optional<WiderDomain> run(const mesh::SizeFunction& spacing, double share) {
    fill(spacing, share);
    if (kept_.size() == mesh_.triangles.size()) return std::nullopt;
    if (kept_.empty()) {
      throw InvalidInput("nothing is left for triangles: all water is narrower than wanted");
    }
    border_ = border_of(mesh_.nodes.size(), kept_);
    for (const auto& [a, b] : border_) {
      if (std::ranges::binary_search(border_before_, Ends{a, b})) continue;
      is_needed_[a] = is_needed_[b] = is_new_[a] = is_new_[b] = true;
    }
    const std::vector<std::vector<Index>> loops = loops_of(mesh_.nodes, border_);
    for (const std::vector<Index>& loop : loops) require_corners_of(loop);
    add_inner_edges();
    for (const std::vector<Index>& loop : loops) add_loop(loop);
    add_lone_sites();
    return finished();
  }

 private:
  // The lines of one kind of feature, and the polygon of the area.
  struct FeaturePart {
    FeatureLines lines;
    CellRings polygon;

    void end() {
      lines.end_group();
      polygon.end_cell();
    }
  };

  // Keeps triangles that are not narrow.
  void fill(const mesh::SizeFunction& spacing, double share) {
    border_before_ = border_of(mesh_.nodes.size(), mesh_.triangles);
    std::vector<bool> is_border(mesh_.nodes.size());
    for (const auto& [a, b] : border_before_) is_border[a] = is_border[b] = true;
    std::ranges::sort(border_before_);
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      if (features_[e] != FeatureOfEdge::coast) continue;
      for (const Index node : mesh_.edges[e]) is_border[node] = true;
    }
    for (const Triple& triangle : mesh_.triangles) {
      const bool is_between =
          std::ranges::all_of(triangle, [&](Index corner) { return is_border[corner]; });
      if (!is_between || !is_narrow(triangle, spacing, share)) kept_.push_back(triangle);
    }
  }

  // True if an edge in the water is shorter than `share` of the spacing at its ends.
  [[nodiscard]] bool is_narrow(const Triple& triangle, const mesh::SizeFunction& spacing,
                               double share) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangle[k];
      const Index b = triangle[(k + 1) % 3];
      if (number_of(a, b) != no_index) continue;
      const Point& p = mesh_.nodes[a];
      const Point& q = mesh_.nodes[b];
      if (norm(q - p) < share * std::min(spacing.spacing(p), spacing.spacing(q))) return true;
    }
    return false;
  }

  // Returns the number of a constrained edge; no_index if it is none.
  [[nodiscard]] Index number_of(Index a, Index b) const {
    const Ends ends = {std::min(a, b), std::max(a, b)};
    const auto place = std::ranges::lower_bound(mesh_.edges, ends);
    if (place == mesh_.edges.end() || *place != ends) return no_index;
    return static_cast<Index>(place - mesh_.edges.begin());
  }

  // Returns what an edge of the border follows: where it was inside before, the new coast.
  [[nodiscard]] FeatureOfEdge feature_of(Index a, Index b) const {
    const bool is_old = std::ranges::binary_search(border_before_, Ends{a, b});
    return is_old ? features_[number_of(a, b)] : FeatureOfEdge::coast;
  }

  // True for a corner of the features that is no end of new coast.
  [[nodiscard]] bool is_old_site(Index node) const {
    return !is_new_[node] && mesh_.sites[node] != no_index;
  }

  FeaturePart& part_of(FeatureOfEdge feature) {
    return feature == FeatureOfEdge::coast  ? coast_
           : feature == FeatureOfEdge::line ? lines_
                                            : area_;
  }

  // Keeps all nodes of a loop that would not have three.
  void require_corners_of(const std::vector<Index>& loop) {
    if (std::ranges::count_if(loop, [&](Index node) { return is_needed_[node]; }) >= 3) return;
    for (const Index node : loop) is_needed_[node] = true;
  }

  void add_line(std::span<const Index> nodes, FeaturePart& part) {
    std::vector<Point> points;
    for (const Index node : nodes) {
      points.push_back(mesh_.nodes[node]);
      is_on_line_[node] = true;
    }
    part.lines.rows.append(points);
  }

  // Adds constrained edges with water on both sides: where all pieces of an edge are left the edge
  // between its sites, else its pieces.
  void add_inner_edges() {
    const std::vector<Ends> border = undirected(border_);
    const std::vector<Ends> sides = sides_of(kept_);
    const auto is_inside = [&](const Ends& edge) {
      return std::ranges::binary_search(sides, edge) && !std::ranges::binary_search(border, edge);
    };
    std::vector<Ends> pieces;  // the source and the number of each constrained edge
    for (Index e = 0; e < mesh_.edges.size(); ++e) {
      if (mesh_.sources[e] != no_index) pieces.push_back({mesh_.sources[e], e});
    }
    std::ranges::sort(pieces);
    for (auto begin = pieces.begin(); begin != pieces.end();) {
      const auto end = std::find_if(begin, pieces.end(),
                                    [&](const Ends& piece) { return piece[0] != (*begin)[0]; });
      const std::span<const Ends> of_source(begin, end);
      if (std::ranges::all_of(of_source,
                              [&](const Ends& p) { return is_inside(mesh_.edges[p[1]]); })) {
        add_line(sites_of(of_source), part_of(features_[(*begin)[1]]));
      } else {
        for (const auto& [source, e] : of_source) {
          if (!is_inside(mesh_.edges[e])) continue;
          add_line(mesh_.edges[e], part_of(features_[e]));
          for (const Index node : mesh_.edges[e]) is_needed_[node] = true;
        }
      }
      begin = end;
    }
  }

  // Returns the two sites between which the pieces of an edge are.
  [[nodiscard]] std::vector<Index> sites_of(std::span<const Ends> pieces) const {
    std::vector<Index> sites;
    for (const auto& [source, e] : pieces) {
      for (const Index node : mesh_.edges[e]) {
        if (mesh_.sites[node] != no_index) sites.push_back(node);
      }
    }
    return sites;
  }

  // Adds a loop of the border to the polygon, and its coasts as lines.
  void add_loop(const std::vector<Index>& loop) {
    std::vector<Index> nodes;
    std::vector<bool> is_coast;  // of the side that begins at each node
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (!is_needed_[loop[k]]) continue;
      nodes.push_back(loop[k]);
      is_coast.push_back(feature_of(loop[k], loop[(k + 1) % loop.size()]) == FeatureOfEdge::coast);
    }
    CellRings& polygon = area_.polygon;
    for (const Index node : nodes) {
      polygon.corners.push_back(static_cast<Index>(polygon.points.size()));
      polygon.points.push_back(mesh_.nodes[node]);
      is_on_line_[node] = true;
      if (!is_old_site(node)) new_corners_.push_back(mesh_.nodes[node]);
    }
    polygon.end_ring();
    add_coasts(nodes, is_coast);
  }

  // Adds the chains of coast of a ring. If all of it is coast, the chain begins at the site with the
  // least coordinates: ends of lines are not simplified, and numbers follow the order of features.
  void add_coasts(std::span<const Index> nodes, const std::vector<bool>& is_coast) {
    const std::size_t n = nodes.size();
    std::size_t first = 0;
    while (first < n && (is_coast[first] || !is_coast[(first + 1) % n])) ++first;
    if (first < n) {
      ++first;
    } else if (is_coast.front()) {
      const auto is_before = [&](Index a, Index b) {
        const bool is_site = is_old_site(a);
        if (is_site != is_old_site(b)) return is_site;
        return exact::is_less(mesh_.nodes[a], mesh_.nodes[b]);
      };
      first = static_cast<std::size_t>(std::ranges::min_element(nodes, is_before) - nodes.begin());
    }
    std::vector<Index> chain;
    for (std::size_t k = first; k < first + n; ++k) {
      if (!is_coast[k % n]) continue;
      chain.push_back(nodes[k % n]);
      if (k + 1 < first + n && is_coast[(k + 1) % n]) continue;
      chain.push_back(nodes[(k + 1) % n]);
      add_line(chain, coast_);
      chain.clear();
    }
  }

  // Adds the sites that are on no line, and corners of what is left.
  void add_lone_sites() {
    std::vector<bool> is_corner(mesh_.nodes.size());
    for (const Triple& triangle : kept_) {
      for (const Index corner : triangle) is_corner[corner] = true;
    }
    for (Index v = 0; v < is_corner.size(); ++v) {
      if (is_corner[v] && mesh_.sites[v] != no_index && !is_on_line_[v]) {
        add_line(std::span(&v, 1), lines_);
      }
    }
  }

  WiderDomain finished() {
    WiderDomain result;
    result.new_corners = std::move(new_corners_);
    for (FeaturePart* part : {&coast_, &area_, &lines_}) part->end();
    result.domain.coast.push_back({std::move(coast_.lines), std::move(coast_.polygon)});
    result.domain.area.push_back({std::move(area_.lines), std::move(area_.polygon)});
    result.domain.lines.push_back({std::move(lines_.lines), std::move(lines_.polygon)});
    return result;
  }

  const mesh::RefinedMesh& mesh_;
  const std::vector<FeatureOfEdge>& features_;
  std::vector<bool> is_needed_;                                      // nodes that become corners
  std::vector<bool> is_new_ = std::vector<bool>(is_needed_.size());  // ends of the new coast
  std::vector<bool> is_on_line_ = std::vector<bool>(is_needed_.size());
  std::vector<Triple> kept_;
  std::vector<Ends> border_before_;  // sorted
  std::vector<Ends> border_;         // of the kept triangles, which are to the left
  std::vector<Point> new_corners_;
  FeaturePart coast_;
  FeaturePart area_;
  FeaturePart lines_;
};

}  // namespace

std::optional<WiderDomain> without_narrow_water(const mesh::DomainTriangles& made,
                                                const mesh::SizeFunction& spacing, double share) {
  return NarrowWater(made).run(spacing, share);
}

CellRings polygon_of(std::span<const Point> points, std::span<const Triple> triangles) {
  CellRings result;
  result.points.assign(points.begin(), points.end());
  for (const std::vector<Index>& loop : loops_of(points, border_of(points.size(), triangles))) {
    result.append_ring(loop);
  }
  result.end_cell();
  return result;
}

double area_without(const CellRings& before, const CellRings& after, const Execution& execution) {
  const CellRings lost = combine(before, after, SetOperation::difference, execution);
  double area = 0;
  for (const double part : areas(lost)) area += part;
  return area;
}

}  // namespace rondel::meshing
