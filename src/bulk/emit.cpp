// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/emit.h"

#include <algorithm>
#include <cstdint>

#include "system/prefetch.h"

namespace rondel::bulk {
namespace {

using Edge = PlaneGraph::Edge;

using Owned = EmissionSpace::Owned;

// Three passes, over edges, sites, and edges. The first one finds out, without branches, how many
// faces a site owns and which is the first, so that the second one need not go around sites twice.
// Where no face is open, nobody asks.
template <bool has_open>
class Emission {
 public:
  Emission(PlaneGraph& graph, const EmittedSites& sites, EmissionSpace& space,
           const FaceStore& store, BlockResult& result)
      : graph_(graph),
        sites_(sites),
        owned_(space.owned),
        owners_(space.owners),
        corners_(store.corners.data() + result.faces_begin),
        neighbors_(store.neighbors.data() + result.faces_begin),
        result_(result) {}

  void run(const std::vector<Edge>& open, const std::vector<Index>& hidden) {
    find_owned();
    list_sites(open, hidden);
    if (owners_.empty()) return;
    if (sites_.names.empty()) {
      write_corners([first = sites_.first](Index v) { return first + v; });
    } else {
      write_corners([names = sites_.names.data()](Index v) { return names[v]; });
    }
    write_neighbors();
  }

 private:
  static bool is_open(Index face) { return has_open && face == open_face; }

  void find_owned() {
    const PlaneGraph::Links* const rings = graph_.rings();
    const Index* const targets = graph_.targets();
    const Index* const faces = graph_.faces();
    Owned* const owned = owned_.data();
    const Edge limit = graph_.edge_limit();
    for (Edge e = 0; e < limit; e += 2) {
      if (targets[e] == no_index) continue;
      // From the end with the lower rank: only this one can own the face on the left. An index that
      // is computed takes no branch.
      const Edge f = e + static_cast<Edge>(targets[e] < targets[e + 1]);
      const Index a = targets[f ^ 1];
      const std::uint64_t b = targets[f];
      const Index c = targets[rings[f].next];
      const auto is_owned = static_cast<Index>(a < c) & static_cast<Index>(!is_open(faces[f]));
      const std::uint64_t key = b << 32 | f | (std::uint64_t{is_owned} - 1);
      owned[a].first = std::min(owned[a].first, key);
      owned[a].count += is_owned;
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
        result_.seam_sites.push_back({sites_.first + v, face, face + count});
      }
      face += count;
    }
    for (const Index v : hidden) result_.hidden.push_back(owned_[v].seam);
    owners_.resize(num_owners);
    result_.faces_end = face;
  }

  // Names the faces in the order of their owners. A name is kept with the three halfedges, four
  // times, plus the number of the corner opposite to the halfedge.
  template <class Name>
  void write_corners(Name name) {
    const PlaneGraph::Links* const rings = graph_.rings();
    const Index* const targets = graph_.targets();
    Index* const faces = graph_.faces();
    const Owned* const owned = owned_.data();
    Triple* const corners = corners_;
    const std::size_t last = owners_.size() - 1;
    Index face = 0;
    for (std::size_t i = 0; i <= last; ++i) {
      const Index ahead = owners_[std::min(i + system::prefetch_distance, last)];
      const auto edge_ahead = static_cast<Edge>(owned[ahead].first);
      system::prefetch(&rings[edge_ahead]);
      system::prefetch(&targets[edge_ahead]);
      const Index v = owners_[i];
      const Index end = face + owned[v].count;
      auto e = static_cast<Edge>(owned[v].first);
      Index b = targets[e];
      do {
        const Edge next = rings[e].next;
        const Index c = targets[next];
        if (v < std::min(b, c) && !is_open(faces[e])) {
          corners[face] = {name(v), name(b), name(c)};
          faces[rings[e ^ 1].previous] = 4 * face;
          faces[next ^ 1] = 4 * face + 1;
          faces[e] = 4 * face + 2;
          ++face;
        }
        e = next;
        b = c;
      } while (face != end);
    }
  }

  void write_neighbors() {
    const Index* const targets = graph_.targets();
    const Index* const faces = graph_.faces();
    const Edge limit = graph_.edge_limit();
    const Index begin = result_.faces_begin;
    Index* const neighbors = neighbors_->data();
    for (Edge e = 0; e < limit; e += 2) {
      if (targets[e] == no_index) continue;
      const Index left = faces[e];
      const Index right = faces[e + 1];
      if (is_open(std::max(left, right))) {
        if (left != open_face) write_seam_edge(e);
        if (right != open_face) write_seam_edge(e ^ 1);
        continue;
      }
      // Corner c of face f is 4f + c here and 3f + c there.
      neighbors[left - left / 4] = begin + right / 4;
      neighbors[right - right / 4] = begin + left / 4;
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
  const EmittedSites& sites_;
  std::vector<Owned>& owned_;
  std::vector<Index>& owners_;
  Triple* corners_;
  Triple* neighbors_;
  BlockResult& result_;
};

}  // namespace

void emit_faces(PlaneGraph& graph, const EmittedSites& sites, const std::vector<Edge>& open,
                const std::vector<Index>& hidden, EmissionSpace& space, const FaceStore& store,
                BlockResult& result) {
  result.faces_begin = 2 * sites.first;
  space.owned.assign(sites.num, {~std::uint64_t{0}, 0, no_index});
  space.owners.resize(sites.num);
#if defined(__wasm__)  // where a second one would cost more bytes than it saves time
  if (open.empty()) graph.clear_faces();
#else
  if (open.empty()) return Emission<false>(graph, sites, space, store, result).run(open, hidden);
#endif
  Emission<true>(graph, sites, space, store, result).run(open, hidden);
}

}  // namespace rondel::bulk
