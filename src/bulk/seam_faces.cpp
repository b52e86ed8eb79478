// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/seam_faces.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "system/parallel.h"
#include "topology/mesh.h"

namespace rondel::bulk {

using topology::next_corner;

SeamFaces::SeamFaces(std::span<const BlockResult> results, FaceStore store,
                     TriangulationArrays seam, unsigned threads)
    : store_(store), seam_(std::move(seam)), is_inside_(seam_.faces.size(), false) {
  collect(results);
  fill(threads);
  list_owned();
}

void SeamFaces::collect(std::span<const BlockResult> results) {
  for (const BlockResult& block : results)
    sites_.insert(sites_.end(), block.seam_sites.begin(), block.seam_sites.end());
  // An edge goes to the place of its b, in two passes; then those of each b are sorted, mostly one.
  edges_begin_.assign(sites_.size() + 1, 0);
  const auto for_edges = [&](auto visit) {
    Index offset = 0;
    for (const BlockResult& block : results) {
      for (const SeamEdge& e : block.seam_edges)
        visit(SeamEdge{e.a + offset, e.b + offset, e.face, e.corner});
      offset += static_cast<Index>(block.seam_sites.size());
    }
  };
  for_edges([&](const SeamEdge& edge) { ++edges_begin_[edge.b + 1]; });
  for (std::size_t i = 1; i < edges_begin_.size(); ++i) edges_begin_[i] += edges_begin_[i - 1];
  edges_.resize(edges_begin_.back());
  std::vector<Index> next = edges_begin_;
  for_edges([&](const SeamEdge& edge) { edges_[next[edge.b]++] = edge; });
  for (std::size_t b = 0; b < sites_.size(); ++b) {
    std::sort(edges_.begin() + edges_begin_[b], edges_.begin() + edges_begin_[b + 1],
              [](const SeamEdge& x, const SeamEdge& y) { return x.a < y.a; });
  }
}

const SeamEdge* SeamFaces::find_edge(Index b, Index a) const {
  const auto first = edges_.begin() + edges_begin_[b];
  const auto last = edges_.begin() + edges_begin_[b + 1];
  const auto found = std::lower_bound(
      first, last, a, [](const SeamEdge& edge, Index value) { return edge.a < value; });
  return found != last && found->a == a ? &*found : nullptr;
}

// Seam faces that meet an edge of the region from its inside are inside, and so are all that can be
// reached from them without crossing such an edge. Without edges, all are.
void SeamFaces::fill(unsigned threads) {
  constexpr std::size_t grain = 4096;
  const std::size_t num_faces = seam_.faces.size();
  std::atomic<std::size_t> num_met = 0;
  std::vector<Triple> links(num_faces, {no_index, no_index, no_index});
  system::parallel_for(threads, num_faces, grain, [&](std::size_t begin, std::size_t end) {
    std::size_t met_here = 0;
    for (std::size_t f = begin; f < end; ++f) {
      const Triple& v = seam_.faces[f];
      for (unsigned i = 0; i < 3; ++i) {
        const unsigned b = next_corner[i];
        const SeamEdge* edge = find_edge(v[b], v[next_corner[b]]);
        if (edge == nullptr) continue;
        links[f][i] = edge->face;
        store_.neighbors[edge->face][edge->corner] = names_begin() + static_cast<Index>(f);
        ++met_here;
      }
    }
    num_met += met_here;
  });
  fits_ = num_met == edges_.size();

  std::vector<Index> stack;
  const auto enter = [&](Index f) {
    if (is_inside_[f]) return;
    is_inside_[f] = true;
    stack.push_back(f);
  };
  for (Index f = 0; f < num_faces; ++f) {
    if (links[f] != Triple{no_index, no_index, no_index}) enter(f);
  }
  if (edges_.empty() && num_faces > 0) enter(0);
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    for (unsigned i = 0; i < 3; ++i) {
      Index& link = links[f][i];
      const Index g = seam_.neighbors[f][i];
      if (link == no_index) {
        enter(g);
        link = names_begin() + g;
      }
      seam_.neighbors[f][i] = link;
    }
  }
}

void SeamFaces::list_owned() {
  owned_begin_.assign(sites_.size() + 1, 0);
  for (Index f = 0; f < seam_.faces.size(); ++f) {
    if (!is_inside_[f]) continue;
    owned_.push_back(names_begin() + f);
    ++owned_begin_[seam_.faces[f][0] + 1];
  }
  for (std::size_t i = 1; i < owned_begin_.size(); ++i) owned_begin_[i] += owned_begin_[i - 1];
}

}  // namespace rondel::bulk
