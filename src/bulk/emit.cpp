// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/emit.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "blocks/prefetch.h"
#include "bulk/open_faces.h"

namespace rondel::bulk {
namespace {

using Edge = PlaneGraph::Edge;

class Emission {
 public:
  Emission(PlaneGraph& graph, Index first, Index num_sites, EmissionSpace& space,
           const FaceStore& store, BlockResult& result)
      : graph_(graph),
        first_(first),
        store_(store),
        result_(result),
        edge_at_(space.edge_at),
        seam_index_(space.seam_index) {
    edge_at_.assign(num_sites, no_index);
    seam_index_.assign(num_sites, no_index);
  }

  void run(const std::vector<Edge>& open) {
    constexpr Index seam = 0;
    for (Edge e = 0; e < graph_.edge_limit(); e += 2) {
      const Index a = graph_.target(e + 1);
      if (a == no_index) continue;
      edge_at_[a] = e;
      edge_at_[graph_.target(e)] = e + 1;
    }
    for (const Edge e : open) seam_index_[graph_.origin(e)] = seam;
    result_.faces_begin = 2 * first_;
    Index face = result_.faces_begin;
    const auto num_sites = static_cast<Index>(edge_at_.size());
    const auto prefetch_edge = [this](Edge e) {
      if (e < graph_.edge_limit()) blocks::prefetch(&graph_.links()[e]);
    };
    for (Index v = 0; v < num_sites; ++v) {
      prefetch_edge(edge_at_[std::min<std::size_t>(v + blocks::prefetch_distance, num_sites - 1)]);
      if (seam_index_[v] == no_index && edge_at_[v] != no_index) {
        face = name_faces_of<false>(v, face);
        continue;
      }
      const Index begin = face;
      if (edge_at_[v] != no_index) face = name_faces_of<true>(v, face);
      seam_index_[v] = static_cast<Index>(result_.seam_sites.size());
      result_.seam_sites.push_back({first_ + v, begin, face});
    }
    result_.faces_end = face;
    link();
  }

 private:
  // Names the final faces that v owns, from `face` on; the first one is that with the smallest
  // second corner. Leaves their halfedges from v in place of the neighbors. Nothing predicts
  // which faces these are, so the loop has no branch for it.
  template <bool has_open_faces>
  Index name_faces_of(Index v, Index face) {
    PlaneGraph::Links* const links = graph_.links();
    Edge* owned = owned_.data();
    Index count = 0;
    std::uint64_t first = ~std::uint64_t{0};  // second corner and place in `owned`
    const Edge start = edge_at_[v];
    Edge e = start;
    Index b = links[e].target;
    do {
      const PlaneGraph::Links& edge = links[e];
      const Index c = links[edge.next].target;
      if (count == owned_.size()) {
        owned_.resize(2 * owned_.size());
        owned = owned_.data();
      }
      owned[count] = e;
      const bool is_final = !has_open_faces || edge.face != open_face;
      const auto is_owned = static_cast<Index>(v < std::min(b, c)) & static_cast<Index>(is_final);
      const std::uint64_t place = std::uint64_t{b} << 32 | count;
      first = std::min(first, place | (std::uint64_t{is_owned} - 1));
      count += is_owned;
      e = edge.next;
      b = c;
    } while (e != start);
    Triple* const corners = store_.corners.data();
    Triple* const neighbors = store_.neighbors.data();
    auto i = static_cast<Index>(first);
    for (Index n = 0; n < count; ++n, ++face) {
      const Edge from = owned[i];
      i = i + 1 == count ? 0 : i + 1;
      const Edge to = links[from].next ^ 1;
      corners[face] = {first_ + v, first_ + links[from].target, first_ + links[to ^ 1].target};
      neighbors[face][0] = from;
      links[from].face = face;
      links[links[from ^ 1].previous].face = face;
      links[to].face = face;
    }
    return face;
  }

  void link() {
    const PlaneGraph::Links* const links = graph_.links();
    Triple* const neighbors = store_.neighbors.data();
    for (Index face = result_.faces_begin; face < result_.faces_end; ++face) {
      const Index ahead = std::min<Index>(face + blocks::prefetch_distance, result_.faces_end - 1);
      if (ahead > face) blocks::prefetch(&links[neighbors[ahead][0]]);
      const Edge f = neighbors[face][0];
      const Edge g = links[f ^ 1].previous;
      const Edge h = links[g ^ 1].previous;
      const Triple across = {links[g ^ 1].face, links[h ^ 1].face, links[f ^ 1].face};
      neighbors[face] = across;
      if (std::max({across[0], across[1], across[2]}) == open_face) link_seam({g, h, f}, face);
    }
  }

  // Its halfedges, by the opposite corners.
  void link_seam(const std::array<Edge, 3>& halfedges, Index face) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const Edge e = halfedges[corner];
      if (graph_.face(e ^ 1) != open_face) continue;
      store_.neighbors[face][corner] = no_index;
      result_.seam_edges.push_back(
          {seam_index_[graph_.origin(e)], seam_index_[graph_.target(e)], face, corner});
    }
  }

  PlaneGraph& graph_;
  Index first_;
  const FaceStore& store_;
  BlockResult& result_;
  std::vector<Edge>& edge_at_;
  std::vector<Index>& seam_index_;
  std::vector<Edge> owned_ = std::vector<Edge>(16);
};

}  // namespace

void emit_faces(PlaneGraph& graph, Index first, Index num_sites, const std::vector<Edge>& open,
                EmissionSpace& space, const FaceStore& store, BlockResult& result) {
  Emission(graph, first, num_sites, space, store, result).run(open);
}

}  // namespace rondel::bulk
