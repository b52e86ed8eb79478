// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/emit.h"

#include <algorithm>
#include <cstdint>

#include "blocks/prefetch.h"
#include "bulk/open_faces.h"

namespace rondel::bulk {
namespace {

using Edge = PlaneGraph::Edge;

using Owned = EmissionSpace::Owned;

// Three passes, over edges, sites, and edges. The first one finds out, without branches, how many
// faces a site owns and which is the first, so that the second one need not go around sites twice.
class Emission {
 public:
  Emission(PlaneGraph& graph, Index first, EmissionSpace& space, const FaceStore& store,
           BlockResult& result)
      : graph_(graph),
        first_(first),
        owned_(space.owned),
        owners_(space.owners),
        corners_(store.corners.data() + result.faces_begin),
        neighbors_(store.neighbors.data() + result.faces_begin),
        result_(result) {}

  void run(const std::vector<Edge>& open, const std::vector<Index>& hidden) {
    find_owned();
    list_sites(open, hidden);
    write_corners();
    write_neighbors();
  }

 private:
  void find_owned() {
    const PlaneGraph::Ring* const rings = graph_.rings();
    const PlaneGraph::End* const ends = graph_.ends();
    for (Edge e = 0; e < graph_.edge_limit(); e += 2) {
      if (!graph_.is_alive(e)) continue;
      // From the end with the lower rank: only this one can own the face on the left.
      const Edge f = e + static_cast<Edge>(ends[e].target < ends[e + 1].target);
      const Index a = ends[f ^ 1].target;
      const Index b = ends[f].target;
      const Index c = ends[rings[f].next].target;
      const auto is_owned =
          static_cast<Index>(a < c) & static_cast<Index>(ends[f].face != open_face);
      Owned& owned = owned_[a];
      const std::uint64_t key = std::uint64_t{b} << 32 | f;
      owned.first = std::min(owned.first, key | (std::uint64_t{is_owned} - 1));
      owned.count += is_owned;
    }
  }

  // Lists owners and seam sites.
  void list_sites(const std::vector<Edge>& open, const std::vector<Index>& hidden) {
    constexpr Index seam = 0;
    for (const Edge e : open) owned_[graph_.origin(e)].seam = seam;
    for (const Index v : hidden) owned_[v].seam = seam;
    const auto num_sites = static_cast<Index>(owned_.size());
    Index num_owners = 0;
    Index face = result_.faces_begin;
    for (Index v = 0; v < num_sites; ++v) {
      const Index count = owned_[v].count;
      owners_[num_owners] = v;
      num_owners += static_cast<Index>(count != 0);
      if (owned_[v].seam == seam) {
        owned_[v].seam = static_cast<Index>(result_.seam_sites.size());
        result_.seam_sites.push_back({first_ + v, face, face + count});
      }
      face += count;
    }
    owners_.resize(num_owners);
    result_.faces_end = face;
  }

  // Names the faces in the order of their owners. A name is kept with the three halfedges, four
  // times, plus the number of the corner opposite to the halfedge.
  void write_corners() {
    const PlaneGraph::Ring* const rings = graph_.rings();
    PlaneGraph::End* const ends = graph_.ends();
    Index face = 0;
    for (std::size_t i = 0; i < owners_.size(); ++i) {
      const Index ahead = owners_[std::min(i + blocks::prefetch_distance, owners_.size() - 1)];
      const auto edge_ahead = static_cast<Edge>(owned_[ahead].first);
      blocks::prefetch(&rings[edge_ahead]);
      blocks::prefetch(&ends[edge_ahead]);
      const Index v = owners_[i];
      const Index end = face + owned_[v].count;
      auto e = static_cast<Edge>(owned_[v].first);
      Index b = ends[e].target;
      do {
        const Edge next = rings[e].next;
        const Index c = ends[next].target;
        if (v < std::min(b, c) && ends[e].face != open_face) {
          corners_[face] = {first_ + v, first_ + b, first_ + c};
          ends[rings[e ^ 1].previous].face = 4 * face;
          ends[next ^ 1].face = 4 * face + 1;
          ends[e].face = 4 * face + 2;
          ++face;
        }
        e = next;
        b = c;
      } while (face != end);
    }
  }

  void write_neighbors() {
    const PlaneGraph::End* const ends = graph_.ends();
    for (Edge e = 0; e < graph_.edge_limit(); e += 2) {
      if (!graph_.is_alive(e)) continue;
      const Index left = ends[e].face;
      const Index right = ends[e ^ 1].face;
      if (std::max(left, right) == open_face) {
        if (left != open_face) write_seam_edge(e);
        if (right != open_face) write_seam_edge(e ^ 1);
        continue;
      }
      neighbors_[left / 4][left % 4] = result_.faces_begin + right / 4;
      neighbors_[right / 4][right % 4] = result_.faces_begin + left / 4;
    }
  }

  // A halfedge with a final face on its left and an open one on its right.
  void write_seam_edge(Edge e) {
    const Index face = graph_.face(e) / 4;
    const unsigned corner = graph_.face(e) % 4;
    neighbors_[face][corner] = no_index;
    result_.seam_edges.push_back({owned_[graph_.origin(e)].seam, owned_[graph_.target(e)].seam,
                                  result_.faces_begin + face, corner});
  }

  PlaneGraph& graph_;
  Index first_;
  std::vector<Owned>& owned_;
  std::vector<Index>& owners_;
  Triple* corners_;
  Triple* neighbors_;
  BlockResult& result_;
};

}  // namespace

void emit_faces(PlaneGraph& graph, Index first, Index num_sites, const std::vector<Edge>& open,
                const std::vector<Index>& hidden, EmissionSpace& space, const FaceStore& store,
                BlockResult& result) {
  result.faces_begin = 2 * first;
  space.owned.assign(num_sites, {~std::uint64_t{0}, 0, no_index});
  space.owners.resize(num_sites);
  Emission(graph, first, space, store, result).run(open, hidden);
}

}  // namespace rondel::bulk
