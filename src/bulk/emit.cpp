// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/emit.h"

#include <algorithm>

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
    for (Edge e = 0; e < graph_.edge_limit(); ++e) {
      if (graph_.is_alive(e)) edge_at_[graph_.origin(e)] = e;
    }
    for (const Edge e : open) seam_index_[graph_.origin(e)] = seam;
    result_.faces_begin = 2 * first_;
    Index face = result_.faces_begin;
    for (Index v = 0; v < edge_at_.size(); ++v) {
      const Index begin = face;
      if (seam_index_[v] == no_index && edge_at_[v] != no_index) {
        face = name_faces_of<false>(v, face);
        continue;
      }
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
    const PlaneGraph::Links* const links = graph_.links();
    Owned* owned = owned_.data();
    std::size_t count = 0;
    const Edge start = edge_at_[v];
    Edge e = start;
    Index b = links[e].target;
    do {
      const PlaneGraph::Links& edge = links[e];
      const Index c = links[edge.next].target;
      if (count == owned_.size()) {
        owned_.resize(2 * count);
        owned = owned_.data();
      }
      owned[count] = {e, b, c};
      const bool is_final = !has_open_faces || edge.face != open_face;
      count += static_cast<std::size_t>(v < std::min(b, c)) & static_cast<std::size_t>(is_final);
      e = edge.next;
      b = c;
    } while (e != start);
    std::size_t i = 0;
    for (std::size_t j = 1; j < count; ++j) i = owned_[j].b < owned_[i].b ? j : i;
    for (std::size_t n = 0; n < count; ++n) {
      const Owned& o = owned_[i];
      i = i + 1 == count ? 0 : i + 1;
      store_.corners[face] = {first_ + v, first_ + o.b, first_ + o.c};
      store_.neighbors[face][0] = o.edge;
      const Edge g = graph_.face_next(o.edge);
      graph_.set_face(o.edge, face);
      graph_.set_face(g, face);
      graph_.set_face(graph_.face_next(g), face);
      ++face;
    }
    return face;
  }

  void link() {
    for (Index face = result_.faces_begin; face < result_.faces_end; ++face) {
      const Edge f = store_.neighbors[face][0];
      const Edge g = graph_.face_next(f);
      const Edge h = graph_.face_next(g);
      store_.neighbors[face] = {across(g, face, 0), across(h, face, 1), across(f, face, 2)};
    }
  }

  Index across(Edge e, Index face, unsigned corner) {
    const Index other = graph_.face(e ^ 1);
    if (other != open_face) return other;
    result_.seam_edges.push_back(
        {seam_index_[graph_.origin(e)], seam_index_[graph_.target(e)], face, corner});
    return no_index;
  }

  // The face to the left of `edge`, which leads from v to b; its third corner is c.
  struct Owned {
    Edge edge;
    Index b;
    Index c;
  };

  PlaneGraph& graph_;
  Index first_;
  const FaceStore& store_;
  BlockResult& result_;
  std::vector<Edge>& edge_at_;
  std::vector<Index>& seam_index_;
  std::vector<Owned> owned_ = std::vector<Owned>(16);
};

}  // namespace

void emit_faces(PlaneGraph& graph, Index first, Index num_sites, const std::vector<Edge>& open,
                EmissionSpace& space, const FaceStore& store, BlockResult& result) {
  Emission(graph, first, num_sites, space, store, result).run(open);
}

}  // namespace rondel::bulk
