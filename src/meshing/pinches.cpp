// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "meshing/pinches.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "map/ring_area.h"
#include "meshing/mesh_border.h"
#include "system/row_assembly.h"

namespace rondel::meshing {
namespace {

using Ends = std::array<Index, 2>;

// Triangles around a node, each with an edge at the node in common with the next one.
struct Fan {
  std::vector<Index> triangles;
  double area = 0;
  Point first;  // the other end of the edge with which it begins
};

// Finds the fans around the nodes of triangles.
class Fans {
 public:
  Fans(std::span<const Point> nodes, std::span<const Triple> triangles)
      : nodes_(nodes), triangles_(triangles) {
    system::RowPlaces<> places(nodes.size());
    for (const Triple& triangle : triangles) {
      for (const Index corner : triangle) places.count(corner);
    }
    at_node_.resize(places.sum());
    for (Index t = 0; t < triangles.size(); ++t) {
      for (const Index corner : triangles[t]) at_node_[places.place(corner)] = t;
    }
    offsets_ = std::move(places).offsets();
  }

  // Returns the fans around a node of the border.
  [[nodiscard]] std::vector<Fan> around(Index node) const {
    struct SideOfNode {
      Index from, to, triangle;
    };
    std::vector<SideOfNode> spokes;
    for (std::uint64_t k = offsets_[node]; k < offsets_[node + 1]; ++k) {
      const Triple& corners = triangles_[at_node_[k]];
      const auto i = static_cast<std::size_t>(std::ranges::find(corners, node) - corners.begin());
      spokes.push_back({corners[(i + 1) % 3], corners[(i + 2) % 3], at_node_[k]});
    }
    std::vector<Fan> fans;
    for (const SideOfNode& first : spokes) {
      if (std::ranges::find(spokes, first.from, &SideOfNode::to) != spokes.end()) continue;
      Fan fan;
      fan.first = nodes_[first.from];
      for (auto spoke = std::ranges::find(spokes, first.from, &SideOfNode::from);
           spoke != spokes.end(); spoke = std::ranges::find(spokes, spoke->to, &SideOfNode::from)) {
        // It begins with the node, as numbers do not say.
        const std::array<Point, 3> ring = {nodes_[node], nodes_[spoke->from], nodes_[spoke->to]};
        fan.triangles.push_back(spoke->triangle);
        fan.area += map::area_on_left(ring);
      }
      fans.push_back(std::move(fan));
    }
    return fans;
  }

 private:
  std::span<const Point> nodes_;
  std::span<const Triple> triangles_;
  std::vector<std::uint64_t> offsets_;
  std::vector<Index> at_node_;
};

// Marks the triangles that are to be filled, and returns their area.
double mark_pinched(const mesh::RefinedMesh& mesh, std::vector<bool>& is_filled) {
  std::vector<Index> starts;
  for (const Ends& edge : border_of(mesh.nodes.size(), mesh.triangles)) starts.push_back(edge[0]);
  std::ranges::sort(starts);
  const Fans all(mesh.nodes, mesh.triangles);
  double area = 0;
  for (auto node = std::ranges::adjacent_find(starts); node != starts.end();
       node = std::adjacent_find(std::upper_bound(node, starts.end(), *node), starts.end())) {
    const std::vector<Fan> fans = all.around(*node);
    const auto largest = std::ranges::max_element(fans, {}, [](const Fan& fan) {
      return std::tuple(fan.area, fan.first.x, fan.first.y, fan.first.z);
    });
    for (auto fan = fans.begin(); fan != fans.end(); ++fan) {
      if (fan == largest) continue;
      for (const Index t : fan->triangles) {
        if (is_filled[t]) continue;
        is_filled[t] = true;
        const auto& [a, b, c] = mesh.triangles[t];
        area +=
            map::area_on_left(std::array<Point, 3>{mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]});
      }
    }
  }
  return area;
}

// Returns the edges that are on the border of triangles, and were not on that of more triangles: the
// lower node first, sorted.
std::vector<Ends> new_border(std::size_t num_nodes, std::span<const Triple> before,
                             std::span<const Triple> kept) {
  const auto edges_of = [&](std::span<const Triple> triangles) {
    return undirected(border_of(num_nodes, triangles));
  };
  std::vector<Ends> result;
  std::ranges::set_difference(edges_of(kept), edges_of(before), std::back_inserter(result));
  return result;
}

}  // namespace

void remove_triangles(const std::vector<bool>& is_removed, mesh::DomainTriangles& made) {
  mesh::RefinedMesh& mesh = made.mesh;
  std::vector<Triple> kept;
  std::vector<Index> regions;
  std::vector<Index> numbers(mesh.nodes.size(), no_index);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_removed[t]) continue;
    kept.push_back(mesh.triangles[t]);
    regions.push_back(mesh.regions[t]);
    for (const Index corner : kept.back()) numbers[corner] = 0;
  }
  const std::vector<Ends> coast = new_border(mesh.nodes.size(), mesh.triangles, kept);
  std::vector<std::tuple<Ends, Index, mesh::FeatureOfEdge>> edges;
  const std::vector<Ends> sides = sides_of(kept);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const Ends& edge = mesh.edges[e];
    if (std::ranges::binary_search(coast, edge) || !std::ranges::binary_search(sides, edge))
      continue;
    edges.emplace_back(edge, mesh.sources[e], made.features[e]);
  }
  for (const Ends& edge : coast) edges.emplace_back(edge, no_index, mesh::FeatureOfEdge::coast);
  std::ranges::sort(edges);

  std::size_t number = 0;
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] == no_index) continue;
    mesh.nodes[number] = mesh.nodes[v];
    mesh.sites[number] = mesh.sites[v];
    numbers[v] = static_cast<Index>(number++);
  }
  mesh.nodes.resize(number);
  mesh.sites.resize(number);
  mesh.regions = std::move(regions);
  mesh.triangles = std::move(kept);
  for (Triple& triangle : mesh.triangles) {
    for (Index& corner : triangle) corner = numbers[corner];
  }
  mesh.edges.clear();
  mesh.sources.clear();
  made.features.clear();
  for (const auto& [ends, source, feature] : edges) {
    mesh.edges.push_back({numbers[ends[0]], numbers[ends[1]]});
    mesh.sources.push_back(source);
    made.features.push_back(feature);
  }
}

double fill_pinches(mesh::DomainTriangles& made) {
  double area = 0;
  while (true) {
    std::vector<bool> is_filled(made.mesh.triangles.size());
    area += mark_pinched(made.mesh, is_filled);
    if (std::ranges::find(is_filled, true) == is_filled.end()) return area;
    remove_triangles(is_filled, made);
  }
}

}  // namespace rondel::meshing
