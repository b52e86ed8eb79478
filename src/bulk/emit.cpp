// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/emit.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/wide_vectors.h"

namespace rondel::bulk {
namespace {

using Edge = PlaneGraph::Edge;

using Owned = EmissionSpace::Owned;
using Owner = EmissionSpace::Owner;

// So many owners ahead, halfedges are asked for.
constexpr std::size_t num_ahead = 8;

// Passes over edges, sites, owners, faces, and edges. The first one finds out how many faces a site
// owns and which is the first, so that nothing goes around sites twice. Branches that depend on the
// input are few: several walks wait for memory at once instead. Where no face is open, nobody asks.
template <bool has_open>
class Emission {
 public:
  Emission(PlaneGraph& graph, const EmittedSites& sites, EmissionSpace& space,
           const FaceStore& store, BlockResult& result, unsigned threads)
      : threads_(has_open ? 1 : threads),
        graph_(graph),
        sites_(sites),
        owned_(space.owned),
        owners_(space.owners),
        corners_(store.corners.data() + result.faces_begin),
        neighbors_(store.neighbors.data() + result.faces_begin),
        result_(result) {}

  void run(const std::vector<Edge>& open, const std::vector<Index>& hidden) {
    find_owned();
    list_sites(open, hidden);
    if (result_.faces_end == result_.faces_begin) return;
    for_parts(num_owners_, [this](std::size_t begin, std::size_t end) {
      if (sites_.names.empty()) {
        write_corners([first = sites_.first](Index v) { return first + v; }, begin, end);
      } else {
        write_corners([names = sites_.names.data()](Index v) { return names[v]; }, begin, end);
      }
    });
    for_parts(result_.faces_end - result_.faces_begin,
              [this](std::size_t begin, std::size_t end) { name_faces(begin, end); });
    for_parts(graph_.edge_limit() / 2,
              [this](std::size_t begin, std::size_t end) { write_neighbors(begin, end); });
  }

 private:
  // Calls work(begin, end) for parts of 0 ... count-1, by several threads if there are.
  template <class Work>
  void for_parts(std::size_t count, const Work& work) const {
    constexpr std::size_t grain = 4096;
    if (threads_ == 1) {
      work(std::size_t{0}, count);
    } else {
      system::parallel_for(threads_, count, grain, work);
    }
  }

  static bool is_open(Index face) { return has_open && face == open_face; }

  // Counts the face on the left of an edge for the lower one of its ends, if this site owns it.
  RONDEL_ALWAYS_INLINE void look_at(Edge e, const PlaneGraph::Links* rings, const Index* targets,
                                    const Index* faces, Owned* owned) const {
    if (targets[e] == no_index) return;
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

  // Edges that follow each other often have the same lower end: two halves in turns, as the next one
  // would wait for what was just written.
  void find_owned() {
    const PlaneGraph::Links* const rings = graph_.rings();
    const Index* const targets = graph_.targets();
    const Index* const faces = graph_.faces();
    Owned* const owned = owned_.data();
    const Edge limit = graph_.edge_limit();
    const Edge half = limit / 4 * 2;
    for (Edge e = 0; e < half; e += 2) {
      look_at(e, rings, targets, faces, owned);
      look_at(half + e, rings, targets, faces, owned);
    }
    for (Edge e = 2 * half; e < limit; e += 2) look_at(e, rings, targets, faces, owned);
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
      owners_[num_owners] = {owned_[v].first, v, face - result_.faces_begin + count};
      num_owners += static_cast<Index>(count != 0);
      if (owned_[v].seam == seam) {
        owned_[v].seam = static_cast<Index>(result_.seam_sites.size());
        result_.seam_sites.push_back({sites_.first + v, face, face + count});
      }
      face += count;
    }
    for (const Index v : hidden) result_.hidden.push_back(owned_[v].seam);
    std::fill_n(owners_.begin() + num_owners, num_ahead, Owner{});
    num_owners_ = num_owners;
    result_.faces_end = face;
  }

  // Around one owner after the other, from the first face to the last.
  struct OwnerWalk {
    std::uint64_t at;  // second corner of the next face that may be owned, and halfedge to it
    std::size_t face;
    const Owner* owner;
    const Owner* end;
  };

  // One step around an owner, or to the next one.
  template <class Name>
  RONDEL_ALWAYS_INLINE void step(OwnerWalk& walk, const PlaneGraph::Links* rings,
                                 const Index* targets, const Index* faces, const Name& name) const {
    const auto e = static_cast<Edge>(walk.at);
    const auto b = static_cast<Index>(walk.at >> 32U);
    const Edge next = rings[e].next;
    const Index c = targets[next];
    const auto ahead = static_cast<Edge>(walk.owner[num_ahead].first);
    system::prefetch(&rings[ahead]);
    system::prefetch(&targets[ahead]);
    neighbors_[walk.face][0] = e;
    corners_[walk.face] = {name(walk.owner->site), name(b), name(c)};
    walk.face += static_cast<std::size_t>(walk.owner->site < std::min(b, c)) &
                 static_cast<std::size_t>(!is_open(faces[e]));
    const auto is_last = static_cast<std::uint64_t>(walk.face == walk.owner->end);
    const std::uint64_t on = std::uint64_t{c} << 32U | next;
    walk.at = on ^ ((on ^ walk.owner[1].first) & (0 - is_last));
    walk.owner += is_last;
  }

  // Writes the corners of the faces in the order of their owners and, where the first neighbor of each
  // will be, the halfedge from the owner to the second corner. Only some owners, by their place.
  template <class Name>
  void write_corners(const Name& name, std::size_t first_owner, std::size_t end_owner) {
    const PlaneGraph::Links* const rings = graph_.rings();
    const Index* const targets = graph_.targets();
    const Index* const faces = graph_.faces();
    constexpr std::size_t num_walks = 3;
    std::array<OwnerWalk, num_walks> walks;
    for (std::size_t k = 0; k < num_walks; ++k) {
      const std::size_t count = end_owner - first_owner;
      const std::size_t begin = first_owner + count * k / num_walks;
      const std::size_t end = first_owner + count * (k + 1) / num_walks;
      const Owner* const owners = owners_.data();
      walks[k] = {owners[begin].first, begin == 0 ? 0 : owners[begin - 1].end, owners + begin,
                  owners + end};
    }
    const auto has_ended = [](const OwnerWalk& walk) { return walk.owner == walk.end; };
    while (!has_ended(walks[0]) && !has_ended(walks[1]) && !has_ended(walks[2])) {
      for (OwnerWalk& walk : walks) step(walk, rings, targets, faces, name);
    }
    for (OwnerWalk& walk : walks) {
      while (!has_ended(walk)) step(walk, rings, targets, faces, name);
    }
  }

  // Names some faces. A name is kept with the three halfedges, four times, plus the number of the corner
  // opposite to the halfedge.
  void name_faces(std::size_t first_face, std::size_t end_face) {
    const PlaneGraph::Links* const rings = graph_.rings();
    Index* const faces = graph_.faces();
    const auto end = static_cast<Index>(end_face);
    for (auto face = static_cast<Index>(first_face); face < end; ++face) {
      const Edge e = neighbors_[face][0];
      const Edge next = rings[e].next;
      faces[rings[e ^ 1].previous] = 4 * face;
      faces[next ^ 1] = 4 * face + 1;
      faces[e] = 4 * face + 2;
    }
  }

  // Writes the neighbors across the edges with these numbers.
  void write_neighbors(std::size_t first_edge, std::size_t end_edge) {
    const Index* const targets = graph_.targets();
    const Index* const faces = graph_.faces();
    const auto limit = static_cast<Edge>(2 * end_edge);
    const Index begin = result_.faces_begin;
    Index* const neighbors = neighbors_->data();
    for (auto e = static_cast<Edge>(2 * first_edge); e < limit; e += 2) {
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

  unsigned threads_;
  PlaneGraph& graph_;
  const EmittedSites& sites_;
  std::vector<Owned>& owned_;
  std::vector<Owner>& owners_;  // and none behind them, as walks look ahead
  std::size_t num_owners_ = 0;
  Triple* corners_;
  Triple* neighbors_;
  BlockResult& result_;
};

}  // namespace

void emit_faces(PlaneGraph& graph, const EmittedSites& sites, const std::vector<Edge>& open,
                const std::vector<Index>& hidden, EmissionSpace& space, const FaceStore& store,
                BlockResult& result, unsigned threads) {
  result.faces_begin = 2 * sites.first;
  space.owned.assign(sites.num, {~std::uint64_t{0}, 0, no_index});
  space.owners.resize(sites.num + num_ahead);
#if defined(__wasm__)  // where a second one would cost more bytes than it saves time
  if (open.empty()) graph.clear_faces();
#else
  if (open.empty())
    return Emission<false>(graph, sites, space, store, result, threads).run(open, hidden);
#endif
  Emission<true>(graph, sites, space, store, result, threads).run(open, hidden);
}

}  // namespace rondel::bulk
