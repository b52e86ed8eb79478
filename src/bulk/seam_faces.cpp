// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/seam_faces.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "system/parallel.h"
#include "system/row_assembly.h"
#include "topology/mesh.h"

namespace rondel::bulk {
namespace {

using topology::next_corner;

constexpr std::size_t faces_at_once = 4096;

constexpr Triple no_links = {no_index, no_index, no_index};

// Edges, found by their ends, which are below `num_sites`.
class EdgeTable {
 public:
  // An edge goes to the place of its b, in two passes; then those of each b are sorted, mostly one.
  EdgeTable(const std::vector<SeamEdge>& edges, std::size_t num_sites) : edges_(edges.size()) {
    system::RowPlaces<Index> places(num_sites);
    for (const SeamEdge& edge : edges) places.count(edge.b);
    places.sum();
    for (const SeamEdge& edge : edges) edges_[places.place(edge.b)] = edge;
    begin_ = std::move(places).offsets();
    for (std::size_t b = 0; b < num_sites; ++b) {
      std::sort(edges_.begin() + begin_[b], edges_.begin() + begin_[b + 1],
                [](const SeamEdge& x, const SeamEdge& y) { return x.a < y.a; });
    }
  }

  // Returns the edge with the seam on its left that runs from site b to site a.
  [[nodiscard]] const SeamEdge* find(Index b, Index a) const {
    const auto first = edges_.begin() + begin_[b];
    const auto last = edges_.begin() + begin_[b + 1];
    const auto found = std::lower_bound(
        first, last, a, [](const SeamEdge& edge, Index value) { return edge.a < value; });
    return found != last && found->a == a ? &*found : nullptr;
  }

 private:
  std::vector<Index> begin_;  // by b
  std::vector<SeamEdge> edges_;
};

}  // namespace

SeamFaces::SeamFaces(std::span<const BlockResult> results, FaceStore store, unsigned threads)
    : store_(store), first_site_(results.size() + 1, 0) {
  for (std::size_t i = 0; i < results.size(); ++i)
    first_site_[i + 1] = static_cast<Index>(results[i].seam_sites.size());
  system::sum_counts(first_site_);
  sites_.resize(first_site_.back());
  system::parallel_for(threads, results.size(), 1, [&](std::size_t i, std::size_t /*end*/) {
    std::ranges::copy(results[i].seam_sites, sites_.begin() + first_site_[i]);
  });
}

Index SeamFaces::add(std::size_t count) {
  const Index first = names_end();
  corners_.resize(corners_.size() + count);
  neighbors_.resize(neighbors_.size() + count);
  return first;
}

bool SeamFaces::fill(TriangulationArrays seam, std::span<const Index> sites,
                     std::vector<SeamEdge> edges, unsigned threads) {
  first_filled_ = corners_.size();
  const bool fits = find_region(seam, std::move(edges), threads);
  append(std::move(seam), sites);
  if (fits) list_owned(threads);
  return fits;
}

void SeamFaces::leave_open(unsigned threads) {
  first_filled_ = corners_.size();
  list_owned(threads);
}

// Faces that meet an edge of the region from its inside are inside, and so are all that can be
// reached from them without crossing such an edge. Without edges, all are. Neighbors become names.
bool SeamFaces::find_region(TriangulationArrays& seam, std::vector<SeamEdge> edges,
                            unsigned threads) {
  const std::size_t num_edges = edges.size();
  const std::size_t num_faces = seam.faces.size();
  const Index first_name = names_end();
  const EdgeTable table(edges, seam.num_sites);
  edges = {};
  std::atomic<std::size_t> num_met = 0;
  std::vector<Triple> links(num_faces, no_links);
  system::parallel_for(threads, num_faces, faces_at_once, [&](std::size_t begin, std::size_t end) {
    std::size_t met_here = 0;
    for (std::size_t f = begin; f < end; ++f) {
      const Triple& v = seam.faces[f];
      for (unsigned i = 0; i < 3; ++i) {
        const unsigned b = next_corner[i];
        const SeamEdge* edge = table.find(v[b], v[next_corner[b]]);
        if (edge == nullptr) continue;
        links[f][i] = edge->face;
        neighbors(edge->face)[edge->corner] = first_name + static_cast<Index>(f);
        ++met_here;
      }
    }
    num_met += met_here;
  });

  is_inside_.assign(num_faces, false);
  std::vector<Index> stack;
  const auto enter = [&](Index f) {
    if (is_inside_[f]) return;
    is_inside_[f] = true;
    stack.push_back(f);
  };
  for (Index f = 0; f < num_faces; ++f) {
    if (links[f] != no_links) enter(f);
  }
  if (num_edges == 0 && num_faces > 0) enter(0);
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    for (unsigned i = 0; i < 3; ++i) {
      Index& link = links[f][i];
      const Index g = seam.neighbors[f][i];
      if (link == no_index) {
        enter(g);
        link = first_name + g;
      }
      seam.neighbors[f][i] = link;
    }
  }
  return num_met == num_edges;
}

void SeamFaces::append(TriangulationArrays seam, std::span<const Index> sites) {
  const Index first = names_end();
  for (const Index f : seam.ghost_faces) {
    if (is_inside_[f]) ghost_faces_.push_back(first + f);
  }
  if (!sites.empty()) {
    for (Triple& face : seam.faces) face = {sites[face[0]], sites[face[1]], sites[face[2]]};
  }
  if (corners_.empty()) {
    corners_ = std::move(seam.faces);
    neighbors_ = std::move(seam.neighbors);
    return;
  }
  corners_.insert(corners_.end(), seam.faces.begin(), seam.faces.end());
  neighbors_.insert(neighbors_.end(), seam.neighbors.begin(), seam.neighbors.end());
}

// Faces that were found in squares come in any order, so threads may list them in any, too.
void SeamFaces::list_owned(unsigned threads) {
  const unsigned at_once = are_in_order() ? 1 : threads;
  const auto for_faces = [&](auto visit) {
    system::parallel_for(at_once, corners_.size(), faces_at_once,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t f = begin; f < end; ++f) {
                             if (f < first_filled_ || is_inside_[f - first_filled_])
                               visit(corners_[f][0], f);
                           }
                         });
  };
  owned_begin_.assign(sites_.size() + 1, 0);
  for_faces([this](Index owner, std::size_t /*face*/) {
    std::atomic_ref(owned_begin_[owner + 1]).fetch_add(1, std::memory_order_relaxed);
  });
  system::sum_counts(owned_begin_);
  owned_.resize(owned_begin_.back());
  std::vector<Index> next = owned_begin_;
  for_faces([&](Index owner, std::size_t face) {
    const Index place = std::atomic_ref(next[owner]).fetch_add(1, std::memory_order_relaxed);
    owned_[place] = names_begin() + static_cast<Index>(face);
  });
}

}  // namespace rondel::bulk
