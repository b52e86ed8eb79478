// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Contacts are found, crossings become nodes, arcs are bent (arc_nodes.h), and each arc gets a chain of
// nodes (Chains), of which its pieces are made.
#include "arrangement/snapping.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/arc_nodes.h"
#include "arrangement/numbering.h"
#include "arrangement/snapped_chain.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

constexpr std::size_t grain = 1024;

// Some arcs of the result: the nodes of each arc, its ends included.
struct ChainBlock {
  std::vector<std::uint64_t> sizes;
  std::vector<Index> nodes;
  bool is_certain = true;
};

// Leads arcs through nodes, for one thread.
class Chains {
 public:
  Chains(const NodedArcs& input, const NodesOfArcs& nodes, std::span<const std::uint8_t> is_bent,
         bool is_forced, ChainBlock& block)
      : input_(input), nodes_(nodes), is_bent_(is_bent), is_forced_(is_forced), block_(block) {}

  void append(Index arc) {
    const NodedArc ends = {nodes_.numbers[input_.arcs[arc].from],
                           nodes_.numbers[input_.arcs[arc].to]};
    const std::size_t begin = block_.nodes.size();
    block_.nodes.push_back(ends.from);
    const std::span<const ArcNode> row = nodes_.of_arc[arc];
    if (is_bent_[arc] != 0) {
      bend(ends, row);
    } else if (!row.empty()) {
      divide(ends, row);
    }
    block_.nodes.push_back(ends.to);
    block_.sizes.push_back(block_.nodes.size() - begin);
  }

 private:
  void bend(NodedArc ends, std::span<const ArcNode> row) {
    through_.clear();
    required_.clear();
    // The result is certain if the nodes near to an arc are those of its crossings.
    bool are_own = true;
    for (const ArcNode& entry : row) {
      are_own = are_own && entry.is_near() && entry.is_of_crossing();
      if (entry.is_near()) through_.push_back(entry.node);
      if (is_forced_ && entry.is_of_crossing()) required_.push_back(entry.node);
    }
    const bool is_crowded =
        append_nearest_nodes(nodes_.nodes, ends, through_, required_, block_.nodes);
    block_.is_certain = block_.is_certain && !is_crowded && are_own && is_short(ends);
  }
  void divide(NodedArc ends, std::span<const ArcNode> row) {
    through_.clear();
    for (const ArcNode& entry : row) {
      if (is_on_near_arc(nodes_.nodes[ends.from], nodes_.nodes[ends.to],
                         nodes_.nodes[entry.node])) {
        through_.push_back(entry.node);
      }
    }
    if (!through_.empty()) append_nodes_on_arc(nodes_.nodes, ends, through_, block_.nodes);
  }
  // True if the arc is at most 120 degrees long: if its ends move, its middle does by at most twice
  // as much.
  [[nodiscard]] bool is_short(NodedArc ends) const {
    constexpr double cosine = -0.49;
    return dot(nodes_.nodes[ends.from], nodes_.nodes[ends.to]) > cosine;
  }

  const NodedArcs& input_;
  const NodesOfArcs& nodes_;
  std::span<const std::uint8_t> is_bent_;
  bool is_forced_;
  ChainBlock& block_;
  std::vector<Index> through_;
  std::vector<Index> required_;
};

// Leaves out nodes through which no arc is led: those of crossings that have nearer ones.
void leave_out_unused(std::vector<Point>& nodes, std::vector<Index>& used, unsigned threads) {
  std::vector<std::uint8_t> is_used(nodes.size(), 0);
  system::parallel_for(threads, used.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::atomic_ref(is_used[used[k]]).store(1, std::memory_order_relaxed);
    }
  });
  if (std::ranges::find(is_used, 0) == is_used.end()) return;
  std::vector<Index> numbers(nodes.size(), no_index);
  Index count = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (is_used[k] == 0) continue;
    nodes[count] = nodes[k];
    numbers[k] = count++;
  }
  nodes.resize(count);
  for (Index& node : used) node = numbers[node];
}

// Returns the pieces of arcs of which each row has the nodes.
Snapped pieces_of(std::vector<Point> nodes, CompressedRows<Index> chains, bool is_certain,
                  unsigned threads) {
  leave_out_unused(nodes, chains.values, threads);
  Snapped result;
  // A chain has one piece less than nodes.
  const std::size_t num_chains = chains.size();
  result.chains.offsets.resize(num_chains + 1);
  std::vector<NodedArc> pieces(chains.values.size() - num_chains);
  system::parallel_for(threads, num_chains, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<const Index> chain = chains[i];
      const std::size_t first = chains.offsets[i] - i;
      for (std::size_t k = 1; k < chain.size(); ++k)
        pieces[first + k - 1] = {chain[k - 1], chain[k]};
      result.chains.offsets[i + 1] = first + chain.size() - 1;
    }
  });
  NumberedArcs numbered = numbered_arcs(pieces, nodes.size(), threads);
  result.pieces = {std::move(nodes), std::move(numbered.arcs)};
  result.chains.values = std::move(numbered.halfedges);
  result.is_certain = is_certain;
  return result;
}

}  // namespace

std::optional<Snapped> snap(const NodedArcs& input, bool is_forced, unsigned threads) {
  const BoxTree boxes = boxes_of(input, threads);
  const Contacts contacts = find_contacts(input, boxes, threads);
  const auto is_on = [&](const NearNode& pair) {
    return is_on_near_arc(input.from(pair.arc), input.to(pair.arc), input.nodes[pair.node]);
  };
  if (contacts.crossings.empty() && std::ranges::none_of(contacts.near, is_on)) return std::nullopt;

  NodesOfArcs nodes = nodes_of_arcs(input, boxes, contacts, threads);
  const std::vector<std::uint8_t> is_bent = bent_arcs(nodes.of_arc, nodes.nodes.size(), threads);
  std::vector<ChainBlock> blocks(system::num_pieces(input.arcs.size(), grain));
  system::parallel_for(threads, input.arcs.size(), grain, [&](std::size_t begin, std::size_t end) {
    Chains chains(input, nodes, is_bent, is_forced, blocks[begin / grain]);
    for (std::size_t arc = begin; arc < end; ++arc) chains.append(static_cast<Index>(arc));
  });
  const bool is_certain = std::ranges::all_of(blocks, &ChainBlock::is_certain);
  CompressedRows<Index> rows;
  rows.offsets = system::join_rows(
      threads, input.arcs.size(), std::move(blocks),
      [](std::size_t b, const ChainBlock& /*block*/, std::size_t k) { return b * grain + k; },
      system::JoinedColumn{&ChainBlock::nodes, rows.values});
  return pieces_of(std::move(nodes.nodes), std::move(rows), is_certain, threads);
}

}  // namespace rondel::arrangement
