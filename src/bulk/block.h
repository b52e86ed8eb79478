// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One block: from its sites to its final faces and what it leaves to the seam.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "blocks/cube_position.h"
#include "bulk/cells.h"
#include "bulk/divide.h"
#include "bulk/emit.h"
#include "bulk/open_faces.h"

namespace rondel::bulk {

// What all blocks share.
struct Input {
  std::span<const Point> sites;
  std::span<const Index> order;  // the site of each rank
  Options options;
  Extent extent{};

  [[nodiscard]] blocks::CubePosition position(Index rank) const {
    const Point& center = options.sphere.center;
    const bool is_rounding_harmless = options.model == Model::weighted || center == Point{};
    return is_rounding_harmless ? blocks::cube_position(sites[order[rank]], center)
                                : blocks::exact_cube_position(sites[order[rank]], center);
  }
};

// Arrays that one block after the other uses.
template <incremental::SphereTraits T>
struct Workspace {
  CellSites<T> sites;
  PlaneGraph graph;
  std::vector<Misplaced> misplaced;
  EmissionSpace emission;
};

template <incremental::SphereTraits T>
class BlockTriangulation {
 public:
  BlockTriangulation(const Input& input, const Block& block, Workspace<T>& workspace)
      : input_(input), block_(block), work_(workspace), sites_(workspace.sites) {
    sites_.assign(input.sites, input.order.subspan(block.begin, num_sites()),
                  input.options.sphere.center, block.cell, input.extent);
  }

  BlockResult run(const FaceStore& store) {
    BlockResult result;
    const PlaneGraph::Edge boundary = triangulate();
    result.tally = sites_.tally();
    if (boundary == no_index) {
      leave_to_seam(result);
      return result;
    }
    const Cone cone = make_cone(block_.cell, sites_.hand());
    OpenFaces open(
        work_.graph, [this](Index i) { return sites_.ray(i); }, cone, T::hides_sites);
    emit_faces(work_.graph, block_.begin, num_sites(), open.find(boundary), hidden_, work_.emission,
               store, result);
    return result;
  }

 private:
  // With fewer sites nothing would be final.
  static constexpr Index least_sites = 32;

  [[nodiscard]] Index num_sites() const { return block_.end - block_.begin; }

  // Returns an edge of the outer boundary, or no_index if this does not work.
  PlaneGraph::Edge triangulate() {
    if (num_sites() < least_sites || !check_positions()) return no_index;
    Divide<T> divide(sites_, work_.misplaced, work_.graph);
    const PlaneGraph::Edge boundary = divide.run(block_.cell.state, block_.cell.bits - 1);
    if (boundary != no_index && T::hides_sites) find_hidden(boundary);
    return boundary;
  }

  // Returns whether all sites can be told apart by positions, but for those listed as misplaced.
  bool check_positions() {
    work_.misplaced.clear();
    for (Index i = 0; i < num_sites(); ++i) {
      const CellPosition& p = sites_.positions()[i];
      if ((is_doubtful(p.u) || is_doubtful(p.v)) && !check_position(i)) return false;
    }
    return true;
  }

  // Rounding moves positions by less than `rounding`. Divide does not look at the lowest bits.
  static constexpr std::uint64_t rounding = 4;
  static bool is_close(std::uint64_t p, std::uint64_t q) {
    return p < q + rounding && q < p + rounding;
  }
  static bool is_doubtful(std::uint64_t p) {
    constexpr std::uint64_t mask = (std::uint64_t{1} << Divide<T>::least_bit) - 1;
    return ((p + rounding) & mask) < 2 * rounding;
  }

  bool check_position(Index i) {
    if (sites_.site(i) == sites_.center()) return false;
    // The one by which the site is in its place. It may be exact, or none if a difference
    // overflows.
    const blocks::CubePosition p = input_.position(block_.begin + i);
    const blocks::CubePosition q = blocks::exact_cube_position(sites_.site(i), sites_.center());
    if (p.face != q.face || q.face != block_.cell.corner.face) return false;
    if (!is_close(p.u, q.u) || !is_close(p.v, q.v)) return false;
    sites_.set_position(i, {p.u, p.v});
    const std::uint64_t difference = ((p.u ^ q.u) | (p.v ^ q.v)) >> Divide<T>::least_bit;
    if (difference != 0) {
      work_.misplaced.push_back(
          {i, Divide<T>::least_bit + static_cast<int>(std::bit_width(difference)) - 1});
    }
    return true;
  }

  // Lists the sites that the boundary does not reach, which are hidden, and deletes their edges.
  void find_hidden(PlaneGraph::Edge boundary);

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
  CellSites<T>& sites_;
  std::vector<Index> hidden_;
};

// A triangulated disc of V vertices, h of them on the boundary, has 3V-3-h edges.
template <incremental::SphereTraits T>
void BlockTriangulation<T>::find_hidden(PlaneGraph::Edge boundary) {
  PlaneGraph& graph = work_.graph;
  std::size_t length = 0;
  PlaneGraph::Edge e = boundary;
  do {
    ++length;
    e = graph.next(e ^ 1);
  } while (e != boundary);
  std::size_t num_edges = 0;
  for (e = 0; e < graph.edge_limit(); e += 2)
    num_edges += static_cast<std::size_t>(graph.is_alive(e));
  if (num_edges == 3 * static_cast<std::size_t>(num_sites()) - 3 - length) return;
  std::vector<bool> is_reached(num_sites(), false);
  std::vector<PlaneGraph::Edge> stack = {boundary};
  is_reached[graph.origin(boundary)] = true;
  while (!stack.empty()) {
    const PlaneGraph::Edge first = stack.back();
    stack.pop_back();
    e = first;
    do {
      if (!is_reached[graph.target(e)]) {
        is_reached[graph.target(e)] = true;
        stack.push_back(e ^ 1);
      }
      e = graph.next(e);
    } while (e != first);
  }
  for (Index i = 0; i < num_sites(); ++i) {
    if (!is_reached[i]) hidden_.push_back(i);
  }
  for (e = 0; e < graph.edge_limit(); e += 2) {
    if (graph.is_alive(e) && !is_reached[graph.origin(e)]) graph.remove(e);
  }
}

}  // namespace rondel::bulk
