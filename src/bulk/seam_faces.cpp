// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/seam_faces.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "topology/mesh.h"

namespace rondel::bulk {

using topology::next_corner;

SeamFaces::SeamFaces(std::span<const BlockResult> results, FaceStore store,
                     TriangulationArrays seam)
    : store_(store), seam_(std::move(seam)), is_inside_(seam_.faces.size(), false) {
  collect(results);
  fill();
  list_owned();
}

void SeamFaces::collect(std::span<const BlockResult> results) {
  for (const BlockResult& block : results) {
    const auto offset = static_cast<Index>(sites_.size());
    sites_.insert(sites_.end(), block.seam_sites.begin(), block.seam_sites.end());
    for (SeamEdge edge : block.seam_edges) {
      edge.a += offset;
      edge.b += offset;
      edges_.push_back(edge);
    }
  }
  std::ranges::sort(edges_, [](const SeamEdge& x, const SeamEdge& y) {
    return std::tie(x.b, x.a) < std::tie(y.b, y.a);
  });
  edges_begin_.assign(sites_.size() + 1, 0);
  for (const SeamEdge& edge : edges_) ++edges_begin_[edge.b + 1];
  for (std::size_t i = 1; i < edges_begin_.size(); ++i) edges_begin_[i] += edges_begin_[i - 1];
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
void SeamFaces::fill() {
  const auto num_faces = static_cast<Index>(seam_.faces.size());
  std::vector<Index> stack;
  const auto enter = [&](Index f) {
    if (is_inside_[f]) return;
    is_inside_[f] = true;
    stack.push_back(f);
  };
  std::size_t num_met = 0;
  std::vector<Triple> links(num_faces, {no_index, no_index, no_index});
  for (Index f = 0; f < num_faces; ++f) {
    const Triple& v = seam_.faces[f];
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned b = next_corner[i];
      const SeamEdge* edge = find_edge(v[b], v[next_corner[b]]);
      if (edge == nullptr) continue;
      links[f][i] = edge->face;
      store_.neighbors[edge->face][edge->corner] = names_begin() + f;
      ++num_met;
      enter(f);
    }
  }
  fits_ = num_met == edges_.size();
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
