// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes proximity graphs by removing edges of solid faces. docs/theory/graphs.md proves that
// these edges suffice, and that for a cap the two corners across an edge decide. The spanning tree
// is Kruskal's, which sorts only the edges of the Urquhart graph, a supergraph of the tree.
#include "rondel/graphs.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "api/triangulation_impl.h"
#include "proximity/relative_neighborhood.h"
#include "proximity/site_distances.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "system/disjoint_sets.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using proximity::SiteDistances;
using Edge = std::array<Index, 2>;

constexpr std::size_t edges_per_piece = 1024;

// An edge and the two corners across it. A corner is no_index where the face on that side is a
// ghost or does not exist.
struct NearPair {
  Edge edge{};
  std::array<Index, 2> across = {no_index, no_index};
};

// Returns each edge that has a solid face on at least one side, once.
std::vector<NearPair> face_candidates(const Triangulation& triangulation) {
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  std::vector<NearPair> found;
  found.reserve(3 * faces.size() / 2);
  for (Index f = 0; f < faces.size(); ++f) {
    if (triangulation.is_ghost(f)) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const Index g = neighbors[f][i];
      const bool is_shared = !triangulation.is_ghost(g);
      const Index a = faces[f][(i + 1) % 3];
      const Index b = faces[f][(i + 2) % 3];
      if (is_shared && b < a) continue;
      NearPair candidate{{std::min(a, b), std::max(a, b)}, {faces[f][i], no_index}};
      if (is_shared) {
        for (const Index c : faces[g]) {
          if (c != a && c != b) candidate.across[1] = c;
        }
      }
      found.push_back(candidate);
    }
  }
  return found;
}

// Returns the arcs between neighbors around the great circle, for a triangulation of dimension
// below 2. An arc of 180 degrees or more is left out: its cap has another vertex. The cap of a
// shorter arc has none.
std::vector<NearPair> ring_candidates(const Triangulation& triangulation,
                                      const SiteDistances& distances) {
  const auto ring = triangulation.ring();
  std::vector<NearPair> found;
  const std::size_t count = ring.size() < 3 ? ring.size() / 2 : ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const Index a = ring[j];
    const Index b = ring[(j + 1) % ring.size()];
    const Index next = ring[(j + 2) % ring.size()];
    if (ring.size() > 2 && distances.is_in_cap(a, b, next)) continue;
    found.push_back({{std::min(a, b), std::max(a, b)}, {no_index, no_index}});
  }
  return found;
}

// Removes the candidates that fail a test, in parallel. stays() makes the test of one thread: a
// callable that takes a candidate and returns whether it stays.
template <class Stays>
void keep_if(std::vector<NearPair>& candidates, const Execution& execution, const Stays& stays) {
  std::vector<std::uint8_t> is_kept(candidates.size());
  system::parallel_for(execution.threads, candidates.size(), edges_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         auto test = stays();
                         for (std::size_t i = begin; i < end; ++i) is_kept[i] = test(candidates[i]);
                       });
  std::size_t size = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (is_kept[i] != 0) candidates[size++] = candidates[i];
  }
  candidates.resize(size);
}

// True if the edge is in no solid face longer than both other sides.
bool is_in_urquhart(const SiteDistances& distances, const NearPair& candidate) {
  const auto [a, b] = candidate.edge;
  return std::ranges::none_of(candidate.across, [&, p = a, q = b](Index c) {
    return c != no_index && distances.is_shorter(p, c, p, q) && distances.is_shorter(q, c, p, q);
  });
}

// True if no corner across the edge is in the cap with the edge as diameter.
bool is_in_gabriel(const SiteDistances& distances, const NearPair& candidate) {
  const auto [a, b] = candidate.edge;
  return std::ranges::none_of(candidate.across, [&, p = a, q = b](Index c) {
    return c != no_index && distances.is_in_cap(p, q, c);
  });
}

// Reduces the candidates to the shortest spanning tree by Kruskal's algorithm. Precondition: the
// candidates contain the tree. Edges of equal length are taken in lexicographic order.
void keep_tree(const SiteDistances& distances, std::size_t num_sites,
               std::vector<NearPair>& candidates) {
  struct Keyed {
    exact::DoubleDouble square;
    NearPair candidate;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(candidates.size());
  for (const NearPair& c : candidates) {
    keyed.push_back({distances.squared(c.edge[0], c.edge[1]), c});
  }
  std::ranges::sort(keyed, [&](const Keyed& x, const Keyed& y) {
    const Edge& e = x.candidate.edge;
    const Edge& f = y.candidate.edge;
    const Sign sign = distances.compare(e[0], e[1], x.square, f[0], f[1], y.square);
    return sign != Sign::zero ? sign == Sign::negative : e < f;
  });
  system::DisjointSets components(num_sites);
  candidates.clear();
  for (const Keyed& k : keyed) {
    if (components.join(k.candidate.edge[0], k.candidate.edge[1])) {
      candidates.push_back(k.candidate);
    }
  }
}

// Reduces the candidates, all Delaunay edges, to the edges of a graph of this kind.
void keep_kind(const Triangulation& triangulation, const SiteDistances& distances, GraphKind kind,
               std::vector<NearPair>& candidates, const Execution& execution) {
  if (kind == GraphKind::delaunay) return;
  if (kind == GraphKind::gabriel) {
    keep_if(candidates, execution,
            [&] { return [&](const NearPair& c) { return is_in_gabriel(distances, c); }; });
    return;
  }
  keep_if(candidates, execution,
          [&] { return [&](const NearPair& c) { return is_in_urquhart(distances, c); }; });
  if (kind == GraphKind::relative) {
    const CompressedRows<Index> adjacency =
        proximity::adjacency_of(triangulation.num_sites(), edges(triangulation));
    keep_if(candidates, execution, [&] {
      return [search = proximity::LuneSearch(distances, adjacency)](const NearPair& c) mutable {
        return search.is_empty(c.edge);
      };
    });
  }
  if (kind == GraphKind::spanning_tree) keep_tree(distances, triangulation.num_sites(), candidates);
}

// Sorts the candidates lexicographically: by counting for the lower end, then by comparing the few
// edges of each site.
void sort_by_edge(std::size_t num_sites, std::vector<NearPair>& candidates) {
  system::RowPlaces<std::size_t> places(num_sites);
  for (const NearPair& c : candidates) places.count(c.edge[0]);
  std::vector<NearPair> sorted(places.sum());
  for (const NearPair& c : candidates) sorted[places.place(c.edge[0])] = c;
  std::size_t begin = 0;
  for (const std::size_t end : std::move(places).offsets()) {
    std::ranges::sort(std::span(sorted).subspan(begin, end - begin), {}, &NearPair::edge);
    begin = end;
  }
  candidates = std::move(sorted);
}

}  // namespace

std::string_view name_of(GraphKind kind) noexcept {
  return system::name_in({"delaunay", "urquhart", "gabriel", "relative", "mst"}, kind);
}

SiteGraph site_graph(const Triangulation& triangulation, GraphKind kind,
                     const Execution& execution) {
  const system::Call call(execution);
  if (triangulation.model() == Model::weighted) {
    throw InvalidInput("weighted sites have no graphs of distances");
  }
  api::require_unchanged_faces(triangulation, execution);
  const SiteDistances distances(triangulation, execution);
  std::vector<NearPair> candidates = triangulation.dimension() < 2
                                         ? ring_candidates(triangulation, distances)
                                         : face_candidates(triangulation);
  keep_kind(triangulation, distances, kind, candidates, execution);
  sort_by_edge(triangulation.num_sites(), candidates);
  SiteGraph graph;
  graph.edges.resize(candidates.size());
  graph.lengths.resize(candidates.size());
  system::parallel_for(execution.threads, candidates.size(), edges_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           const Edge edge = candidates[i].edge;
                           graph.edges[i] = edge;
                           graph.lengths[i] = distances.angle(edge[0], edge[1]);
                         }
                       });
  return graph;
}

EdgeIndex edge_index(const SiteGraph& graph, EdgeDirections directions) {
  struct Arc {
    Edge ends;
    double length;
  };
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b] = graph.edges[i];
    arcs.push_back({{a, b}, graph.lengths[i]});
    if (directions == EdgeDirections::both) arcs.push_back({{b, a}, graph.lengths[i]});
  }
  std::ranges::sort(arcs, {}, &Arc::ends);
  EdgeIndex result;
  result.ends.resize(2 * arcs.size());
  result.lengths.resize(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    result.ends[i] = arcs[i].ends[0];
    result.ends[arcs.size() + i] = arcs[i].ends[1];
    result.lengths[i] = arcs[i].length;
  }
  return result;
}

}  // namespace rondel
