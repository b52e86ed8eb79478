// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: find the direction of each constraint along its edges, and the faces on both sides of each
// edge; then, for each polygon, go from the faces on the left of its sides to all that can be
// reached without a crossing of its sides.
#include <algorithm>
#include <string>
#include <utility>

#include "rondel/constrained.h"

namespace rondel {
namespace constrained {
namespace {

using Ends = std::array<Index, 2>;

// An edge and whether a constraint goes from its lower site to its higher one.
struct DirectedEdge {
  Index edge;
  bool is_ascending;
};

// A corner opposite to a side of a solid face; no_index: the side belongs to no solid face.
struct SideOfFace {
  Index face = no_index;
  unsigned corner = 0;
};

class PolygonFlood {
 public:
  PolygonFlood(const ConstrainedTriangulation& result, std::span<const Ends> constraints)
      : result_(result),
        faces_(result.triangulation.faces()),
        neighbors_(result.triangulation.neighbors()),
        net_(result.edges.size()),
        ascending_(result.edges.size()),
        descending_(result.edges.size()),
        is_reached_(faces_.size()) {
    list_faces();
    list_chains(constraints);
  }

  // Returns the faces in a polygon, ascending.
  std::vector<Index> faces_in(std::span<const Index> sides, std::size_t polygon);

 private:
  [[nodiscard]] Index edge_of(const SideOfFace& side) const;
  void list_faces();
  void list_chains(std::span<const Ends> constraints);
  void visit(Index face, std::vector<Index>& reached);

  // True if the face has the interior of the polygon, which this edge of it bounds.
  [[nodiscard]] bool is_left(Index edge, const SideOfFace& side) const {
    const Index from = faces_[side.face][(side.corner + 1) % 3];
    return (from == result_.edges[edge][0]) == (net_[edge] > 0);
  }

  const ConstrainedTriangulation& result_;
  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  std::vector<int> net_;  // for each edge, how many more sides of the polygon ascend than descend
  std::vector<SideOfFace> ascending_;   // the solid faces on the left of the ascending edges
  std::vector<SideOfFace> descending_;  // and on their right
  std::vector<bool> is_reached_;
  CompressedRows<DirectedEdge> chains_;  // of each constraint
};

Index PolygonFlood::edge_of(const SideOfFace& side) const {
  const Triple& face = faces_[side.face];
  const auto [low, high] = std::minmax({face[(side.corner + 1) % 3], face[(side.corner + 2) % 3]});
  const auto found = std::ranges::lower_bound(result_.edges, Ends{low, high});
  return static_cast<Index>(found - result_.edges.begin());
}

void PolygonFlood::list_faces() {
  for (Index f = 0; f < faces_.size(); ++f) {
    if (result_.sides[f] == 0 || result_.triangulation.is_ghost(f)) continue;
    for (unsigned i = 0; i < 3; ++i) {
      if ((result_.sides[f] >> i & 1U) == 0) continue;
      const Index edge = edge_of({f, i});
      const bool is_ascending = faces_[f][(i + 1) % 3] == result_.edges[edge][0];
      (is_ascending ? ascending_ : descending_)[edge] = {f, i};
    }
  }
}

// The edges of a constraint are a path, which is followed from its first end.
void PolygonFlood::list_chains(std::span<const Ends> constraints) {
  std::vector<std::pair<Index, Index>> sources;  // constraint, edge
  for (Index e = 0; e < result_.edges.size(); ++e) {
    for (const Index constraint : result_.sources[e]) sources.emplace_back(constraint, e);
  }
  std::ranges::sort(sources);
  const auto name = [duplicates = result_.triangulation.duplicates()](Index site) {
    const auto found = std::ranges::lower_bound(duplicates, site, {}, &Duplicate::site);
    return found != duplicates.end() && found->site == site ? found->representative : site;
  };
  auto source = sources.begin();
  std::vector<std::pair<Index, Index>> at;  // end, edge
  for (Index c = 0; c < constraints.size(); ++c) {
    at.clear();
    for (; source != sources.end() && source->first == c; ++source) {
      for (const Index end : result_.edges[source->second]) at.emplace_back(end, source->second);
    }
    std::ranges::sort(at);
    Index site = name(constraints[c][0]);
    Index last = no_index;
    const std::size_t length = at.size() / 2;
    for (std::size_t k = 0; k < length; ++k) {
      const auto begin = std::ranges::lower_bound(at, std::pair<Index, Index>{site, 0});
      const auto end = std::ranges::lower_bound(at, std::pair<Index, Index>{site + 1, 0});
      const auto next = std::find_if(begin, end, [&](const auto& e) { return e.second != last; });
      if (next == end || end - begin != (k == 0 ? 1 : 2)) break;
      last = next->second;
      const auto& [low, high] = result_.edges[last];
      chains_.values.push_back({last, site == low});
      site = site == low ? high : low;
    }
    chains_.end_row();
    if (length == 0 || chains_[c].size() != length || site != name(constraints[c][1])) {
      throw InvalidInput("constraint " + std::to_string(c) + " is no chain of edges", c);
    }
  }
}

void PolygonFlood::visit(Index face, std::vector<Index>& reached) {
  if (is_reached_[face]) return;
  is_reached_[face] = true;
  reached.push_back(face);
}

std::vector<Index> PolygonFlood::faces_in(std::span<const Index> sides, std::size_t polygon) {
  const auto for_edges = [&](const auto& work) {
    for (const Index side : sides) {
      if (side >= chains_.size()) {
        throw InvalidInput("polygon " + std::to_string(polygon) + " has constraint " +
                               std::to_string(side) + ", but there are " +
                               std::to_string(chains_.size()) + " constraints",
                           polygon);
      }
      for (const DirectedEdge& e : chains_[side]) work(e);
    }
  };
  std::vector<Index> reached;
  bool is_closed = true;
  bool is_covered = true;
  for_edges([&](const DirectedEdge& e) { net_[e.edge] += e.is_ascending ? 1 : -1; });
  for_edges([&](const DirectedEdge& e) {
    if (net_[e.edge] == 0) return;
    const SideOfFace& left = (net_[e.edge] > 0 ? ascending_ : descending_)[e.edge];
    if (left.face == no_index) {
      is_covered = false;
    } else {
      visit(left.face, reached);
    }
  });
  for (std::size_t k = 0; k < reached.size(); ++k) {
    for (unsigned i = 0; i < 3; ++i) {
      const SideOfFace side = {reached[k], i};
      const bool is_constrained = (result_.sides[side.face] >> i & 1U) != 0;
      const Index edge = is_constrained ? edge_of(side) : no_index;
      if (is_constrained && net_[edge] != 0) {
        is_closed = is_closed && is_left(edge, side);
        continue;
      }
      const Index next = neighbors_[side.face][i];
      if (result_.triangulation.is_ghost(next)) {
        is_covered = false;
      } else {
        visit(next, reached);
      }
    }
  }
  for_edges([&](const DirectedEdge& e) { net_[e.edge] = 0; });
  for (const Index face : reached) is_reached_[face] = false;
  const std::string name = "polygon " + std::to_string(polygon);
  if (!is_closed) throw InvalidInput(name + " has sides that do not divide in and out", polygon);
  if (!is_covered) {
    throw InvalidInput(name + " leaves the hull of the sites, outside of which there are no faces",
                       polygon);
  }
  std::ranges::sort(reached);
  return reached;
}

}  // namespace
}  // namespace constrained

CompressedRows<Index> faces_inside(const ConstrainedTriangulation& result,
                                   std::span<const std::array<Index, 2>> constraints,
                                   const CompressedRows<Index>& polygons) {
  CompressedRows<Index> inside;
  if (result.triangulation.dimension() < 2) {
    inside.offsets.resize(polygons.size() + 1);
    return inside;
  }
  constrained::PolygonFlood flood(result, constraints);
  for (std::size_t p = 0; p < polygons.size(); ++p) inside.append(flood.faces_in(polygons[p], p));
  return inside;
}

}  // namespace rondel
