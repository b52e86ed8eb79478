// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: find the direction of each constraint along its edges, and the faces on both sides of each
// edge; then, for each polygon, go from the faces on the left of its sides to all that can be
// reached without a crossing of its sides.
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "rondel/constrained.h"
#include "system/row_assembly.h"

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
        balance_(result.triangulation.num_sites()),
        ascending_(result.edges.size()),
        descending_(result.edges.size()),
        is_reached_(faces_.size()),
        has_ghosts_(result.triangulation.num_ghost_faces() > 0),
        nets_(faces_.size()) {
    list_edges();
    list_faces();
    if (!list_whole_edges(constraints)) list_chains(constraints);
  }

  // Returns the faces in a polygon, ascending, until the next call.
  std::span<const Index> faces_in(std::span<const Index> sides, std::size_t polygon);

 private:
  [[nodiscard]] Index edge_of(const SideOfFace& side) const;
  void list_edges();
  void list_faces();
  [[nodiscard]] bool list_whole_edges(std::span<const Ends> constraints);
  void list_chains(std::span<const Ends> constraints);
  [[nodiscard]] Index name_of(Index site) const;
  [[nodiscard]] bool append_chain(std::span<const Index> edges, const Ends& ends);
  void visit(Index face);
  template <class Work>
  void for_edges(std::span<const Index> sides, std::size_t polygon, const Work& work) const;
  void take_sides(std::span<const Index> sides, std::size_t polygon);
  [[nodiscard]] bool is_covered_from(std::span<const Index> sides, std::size_t polygon);
  [[nodiscard]] bool spread(bool& is_closed);
  void sort_reached();

  [[nodiscard]] bool is_ghost(Index face) const {
    return has_ghosts_ && result_.triangulation.is_ghost(face);
  }
  // Lets the faces on both sides of an edge know how many sides of the polygon have them on their
  // left, less those that have them on their right.
  void set_net(Index edge, int net) {
    const SideOfFace& up = ascending_[edge];
    const SideOfFace& down = descending_[edge];
    if (up.face != no_index) nets_[up.face][up.corner] = net;
    if (down.face != no_index) nets_[down.face][down.corner] = -net;
  }

  const ConstrainedTriangulation& result_;
  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  std::vector<Index> first_edges_;  // by lower site: the first edge from it or a higher one
  std::vector<int> net_;  // for each edge, how many more sides of the polygon ascend than descend
  std::vector<int> balance_;            // for each site, how many more edges begin there than end
  std::vector<SideOfFace> ascending_;   // the solid faces on the left of the ascending edges
  std::vector<SideOfFace> descending_;  // and on their right
  std::vector<std::uint8_t> is_reached_;
  bool has_ghosts_;
  std::vector<std::array<int, 3>> nets_;  // by side of a face: see set_net()
  CompressedRows<DirectedEdge> chains_;   // of each constraint
  std::vector<Index> reached_;            // the faces in the polygon
};

Index PolygonFlood::edge_of(const SideOfFace& side) const {
  const Triple& face = faces_[side.face];
  const auto [low, high] = std::minmax({face[(side.corner + 1) % 3], face[(side.corner + 2) % 3]});
  constexpr Index few = 8;
  Index edge = first_edges_[low];
  if (const Index end = first_edges_[low + std::size_t{1}]; end - edge > few) {
    const auto begin = result_.edges.begin();
    return static_cast<Index>(std::lower_bound(begin + edge, begin + end, Ends{low, high}) - begin);
  }
  while (result_.edges[edge][1] != high) ++edge;
  return edge;
}

void PolygonFlood::list_edges() {
  const std::size_t num_sites = result_.triangulation.num_sites();
  first_edges_.reserve(num_sites + 1);
  Index edge = 0;
  for (Index site = 0; site <= num_sites; ++site) {
    while (edge < result_.edges.size() && result_.edges[edge][0] < site) ++edge;
    first_edges_.push_back(edge);
  }
}

void PolygonFlood::list_faces() {
  for (Index f = 0; f < faces_.size(); ++f) {
    if (result_.sides[f] == 0 || is_ghost(f)) continue;
    for (unsigned i = 0; i < 3; ++i) {
      if ((result_.sides[f] >> i & 1U) == 0) continue;
      const Index edge = edge_of({f, i});
      const bool is_ascending = faces_[f][(i + 1) % 3] == result_.edges[edge][0];
      (is_ascending ? ascending_ : descending_)[edge] = {f, i};
    }
  }
}

// Returns the site that stands for all in its place.
Index PolygonFlood::name_of(Index site) const {
  const auto duplicates = result_.triangulation.duplicates();
  const auto found = std::ranges::lower_bound(duplicates, site, {}, &Duplicate::site);
  return found != duplicates.end() && found->site == site ? found->representative : site;
}

// Lists the chains where each constraint is one edge and sites are in different places. Returns false
// elsewhere.
bool PolygonFlood::list_whole_edges(std::span<const Ends> constraints) {
  if (!result_.triangulation.duplicates().empty()) return false;
  std::vector<Index> edges(constraints.size(), no_index);
  for (Index e = 0; e < result_.edges.size(); ++e) {
    for (const Index constraint : result_.sources[e]) {
      if (constraint >= constraints.size()) continue;
      if (edges[constraint] != no_index) return false;
      edges[constraint] = e;
    }
  }
  const auto is_edge = [&](Index edge, const Ends& ends) {
    return edge != no_index &&
           result_.edges[edge] == Ends{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
  };
  if (!std::ranges::equal(edges, constraints, is_edge)) return false;
  chains_.values.reserve(edges.size());
  chains_.offsets.reserve(edges.size() + 1);
  for (Index c = 0; c < constraints.size(); ++c) {
    chains_.values.push_back({edges[c], constraints[c][0] < constraints[c][1]});
    chains_.end_row();
  }
  return true;
}

// The edges of a constraint are a path, which is followed from its first end.
void PolygonFlood::list_chains(std::span<const Ends> constraints) {
  const auto for_sources = [&](const auto& take) {
    for (Index e = 0; e < result_.edges.size(); ++e) {
      for (const Index constraint : result_.sources[e]) {
        if (constraint < constraints.size()) take(constraint, e);
      }
    }
  };
  system::RowPlaces places(constraints.size());
  for_sources([&](Index constraint, Index /*edge*/) { places.count(constraint); });
  std::vector<Index> edges(places.sum());  // constraint by constraint, ascending
  for_sources([&](Index constraint, Index edge) { edges[places.place(constraint)] = edge; });
  const std::vector<std::uint64_t> offsets = std::move(places).offsets();
  chains_.values.reserve(edges.size());
  chains_.offsets.reserve(constraints.size() + 1);
  for (Index c = 0; c < constraints.size(); ++c) {
    const Ends ends = {name_of(constraints[c][0]), name_of(constraints[c][1])};
    const auto own = std::span(edges).subspan(offsets[c], offsets[c + 1] - offsets[c]);
    if (!append_chain(own, ends)) {
      throw InvalidInput("constraint " + std::to_string(c) + " is no chain of edges", c);
    }
    chains_.end_row();
  }
}

// Appends edges in their order between two sites. Returns false if they are no chain.
bool PolygonFlood::append_chain(std::span<const Index> edges, const Ends& ends) {
  if (edges.empty()) return false;
  if (edges.size() == 1) {
    const auto& [low, high] = result_.edges[edges.front()];
    chains_.values.push_back({edges.front(), ends[0] == low});
    return std::minmax(ends[0], ends[1]) == std::minmax(low, high);
  }
  std::vector<std::pair<Index, Index>> at;  // end, edge
  for (const Index edge : edges) {
    for (const Index end : result_.edges[edge]) at.emplace_back(end, edge);
  }
  std::ranges::sort(at);
  Index site = ends[0];
  Index last = no_index;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto begin = std::ranges::lower_bound(at, std::pair<Index, Index>{site, 0});
    const auto end = std::ranges::lower_bound(at, std::pair<Index, Index>{site + 1, 0});
    const auto next = std::find_if(begin, end, [&](const auto& e) { return e.second != last; });
    if (next == end || end - begin != (k == 0 ? 1 : 2)) return false;
    last = next->second;
    const auto& [low, high] = result_.edges[last];
    chains_.values.push_back({last, site == low});
    site = site == low ? high : low;
  }
  return site == ends[1];
}

void PolygonFlood::visit(Index face) {
  if (is_reached_[face] != 0) return;
  is_reached_[face] = 1;
  reached_.push_back(face);
}

// Calls work(edge) for the edges of all sides of a polygon.
template <class Work>
void PolygonFlood::for_edges(std::span<const Index> sides, std::size_t polygon,
                             const Work& work) const {
  for (const Index side : sides) {
    if (side >= chains_.size()) {
      throw InvalidInput("polygon " + std::to_string(polygon) + " has constraint " +
                             std::to_string(side) + ", but there are " +
                             std::to_string(chains_.size()) + " constraints",
                         polygon);
    }
    for (const DirectedEdge& e : chains_[side]) work(e);
  }
}

// Takes the sides of a polygon as those that divide faces. Throws InvalidInput unless as many of them
// begin at each site as end there.
void PolygonFlood::take_sides(std::span<const Index> sides, std::size_t polygon) {
  std::size_t num_unbalanced = 0;
  const auto change = [&](Index site, int step) {
    num_unbalanced += balance_[site] == 0 ? 1U : 0U;
    balance_[site] += step;
    num_unbalanced -= balance_[site] == 0 ? 1U : 0U;
  };
  for_edges(sides, polygon, [&](const DirectedEdge& e) {
    const auto& [low, high] = result_.edges[e.edge];
    const int step = e.is_ascending ? 1 : -1;
    net_[e.edge] += step;
    change(low, step);
    change(high, -step);
  });
  if (num_unbalanced == 0) return;
  throw InvalidInput("polygon " + std::to_string(polygon) + " has sides that close no ring",
                     polygon);
}

// Reaches the faces on the left of the sides. Returns false if a side has no face there.
bool PolygonFlood::is_covered_from(std::span<const Index> sides, std::size_t polygon) {
  bool is_covered = true;
  for_edges(sides, polygon, [&](const DirectedEdge& e) {
    if (net_[e.edge] == 0) return;
    set_net(e.edge, net_[e.edge]);
    const SideOfFace& left = (net_[e.edge] > 0 ? ascending_ : descending_)[e.edge];
    if (left.face == no_index) {
      is_covered = false;
    } else {
      visit(left.face);
    }
  });
  return is_covered;
}

// Reaches what can be reached without a crossing of sides. Returns false if a ghost face can, and
// lets is_closed be false if a side is reached from its right.
bool PolygonFlood::spread(bool& is_closed) {
  bool is_covered = true;
  for (std::size_t k = 0; k < reached_.size(); ++k) {
    const Index face = reached_[k];
    const Triple& neighbors = neighbors_[face];
    const std::array<int, 3>& nets = nets_[face];
    for (unsigned i = 0; i < 3; ++i) {
      if (nets[i] != 0) {
        is_closed = is_closed && nets[i] > 0;
        continue;
      }
      const Index next = neighbors[i];
      if (is_reached_[next] != 0) continue;
      if (is_ghost(next)) {
        is_covered = false;
      } else {
        visit(next);
      }
    }
  }
  return is_covered;
}

// Sorts the faces that were reached and forgets them. Faces of a polygon are close to each other in
// their order, so that most of those between the first one and the last one were reached.
void PolygonFlood::sort_reached() {
  constexpr std::size_t share = 8;
  const auto [least, most] = std::ranges::minmax_element(reached_);
  if (reached_.empty()) return;
  const Index first = *least;
  const Index last = *most;
  if ((last - first) / share >= reached_.size()) {
    for (const Index face : reached_) is_reached_[face] = 0;
    std::ranges::sort(reached_);
    return;
  }
  reached_.clear();
  for (Index face = first; face <= last; ++face) {
    if (is_reached_[face] != 0) reached_.push_back(face);
    is_reached_[face] = 0;
  }
}

std::span<const Index> PolygonFlood::faces_in(std::span<const Index> sides, std::size_t polygon) {
  reached_.clear();
  take_sides(sides, polygon);
  bool is_closed = true;
  bool is_covered = is_covered_from(sides, polygon);
  is_covered = spread(is_closed) && is_covered;
  for_edges(sides, polygon, [&](const DirectedEdge& e) {
    net_[e.edge] = 0;
    set_net(e.edge, 0);
  });
  if (!is_closed) {
    throw InvalidInput(
        "polygon " + std::to_string(polygon) + " has sides that do not divide in and out", polygon);
  }
  if (!is_covered) {
    throw InvalidInput("polygon " + std::to_string(polygon) +
                           " leaves the hull of the sites, outside of which there are no faces; "
                           "one more site there, such as a pole, makes some",
                       polygon);
  }
  sort_reached();
  return reached_;
}

}  // namespace
}  // namespace constrained

CompressedRows<Index> faces_inside(const ConstrainedTriangulation& result,
                                   std::span<const std::array<Index, 2>> constraints,
                                   const CompressedRows<Index>& polygons) {
  CompressedRows<Index> inside;
  constrained::PolygonFlood flood(result, constraints);
  for (std::size_t p = 0; p < polygons.size(); ++p) inside.append(flood.faces_in(polygons[p], p));
  return inside;
}

}  // namespace rondel
