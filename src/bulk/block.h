// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One block: from its sites to its final faces and what it leaves to the seam.
#pragma once

#include <span>
#include <vector>

#include "bulk/emit.h"
#include "bulk/open_faces.h"
#include "bulk/reach.h"
#include "bulk/solve_square.h"

namespace rondel::bulk {

// Arrays that one block after the other uses.
template <models::SphereModel T>
struct Workspace {
  SquareCoordinates coordinates;
  SquareSites<T> sites;
  PlaneGraph graph;
  std::vector<Misplaced> misplaced;
  EmissionSpace emission;

  // For blocks of up to so many sites: arrays that grow from block to block leave gaps in memory.
  void reserve(std::size_t num_sites) {
    coordinates.reserve(num_sites);
    graph.clear(num_sites);
    emission.owned.reserve(num_sites);
    emission.owners.reserve(num_sites);
  }
};

template <models::SphereModel T>
class BlockTriangulation {
 public:
  BlockTriangulation(const Input& input, const Block& block, Workspace<T>& workspace)
      : input_(input), block_(block), work_(workspace), sites_(workspace.sites) {
    workspace.coordinates.reserve(num_sites());
    sites_.assign(input.sites, input.order.subspan(block.begin, num_sites()), 0, num_sites(),
                  input.options.sphere.center, input.extent, workspace.coordinates,
                  input.copies.from(block.begin));
    sites_.enter(block.square, num_sites());
  }

  BlockResult run(const FaceStore& store) {
    BlockResult result;
    const PlaneGraph::Edge boundary = triangulate();
    result.tally = sites_.tally();
    if (boundary == no_index) {
      leave_to_seam(result);
      return result;
    }
    const Cone cone = make_cone(block_.square, sites_.hand());
    OpenFaces open(
        work_.graph, [this](Index i) { return sites_.ray(i); }, cone, T::hides_sites);
    emit_faces(work_.graph, {block_.begin, num_sites(), {}}, open.find(boundary), hidden_,
               work_.emission, store, result);
    return result;
  }

 private:
  // With fewer sites nothing would be final.
  static constexpr Index least_sites = 32;

  [[nodiscard]] Index num_sites() const { return block_.end - block_.begin; }

  // Returns an edge of the outer boundary, or no_index if this does not work.
  PlaneGraph::Edge triangulate() {
    if (num_sites() < least_sites) return no_index;
    work_.graph.clear(num_sites());
    const auto all = solve_square(input_, block_, 0, sites_, work_.misplaced, work_.graph);
    if (!all) return no_index;
    if (T::hides_sites) find_hidden(all->edge);
    return all->edge;
  }

  // Lists the sites that the boundary does not reach, which are hidden, and deletes their edges.
  // A triangulated disc of V vertices, h of them on the boundary, has 3V-3-h edges.
  void find_hidden(PlaneGraph::Edge boundary) {
    std::size_t length = 0;
    PlaneGraph::Edge e = boundary;
    do {
      ++length;
      e = work_.graph.next(e ^ 1);
    } while (e != boundary);
    if (work_.graph.num_edges() == 3 * std::size_t{num_sites()} - 3 - length) return;
    hidden_ = remove_unreached(work_.graph, boundary, num_sites());
  }

  void leave_to_seam(BlockResult& result) const {
    result.faces_begin = 2 * block_.begin;
    result.faces_end = result.faces_begin;
    for (Index rank = block_.begin; rank < block_.end; ++rank) {
      result.seam_sites.push_back({rank, result.faces_begin, result.faces_begin});
    }
  }

  const Input& input_;
  const Block& block_;
  Workspace<T>& work_;
  SquareSites<T>& sites_;
  std::vector<Index> hidden_;
};

}  // namespace rondel::bulk
