// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Contacts are found, crossings become nodes, arcs are bent (BentArcs), and each arc gets a chain of
// nodes (Chains), of which its pieces are made.
#include "arrangement/snapping.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "arrangement/crossing_place.h"
#include "arrangement/snapped_chain.h"
#include "order/spatial_order.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

constexpr std::size_t grain = 1024;

// Which arcs have to go through the nodes near to them. An arc that crosses another one is bent, as
// its crossing is rounded. Where an arc is bent, it is led through all nodes near to it, and all
// arcs near to one of these nodes are bent, too. All other arcs stay as they are.
class BentArcs {
 public:
  BentArcs(std::size_t num_nodes, std::size_t num_arcs, std::span<const NearNode> near)
      : near_(near), begins_(num_arcs + 1, 0), is_bent_(num_arcs, 0), is_active_(num_nodes, 0) {
    system::RowPlaces<std::uint64_t> places(num_nodes);
    for (const NearNode& pair : near) places.count(pair.node);
    arcs_.resize(places.sum());
    for (const NearNode& pair : near) arcs_[places.place(pair.node)] = pair.arc;
    offsets_ = std::move(places).offsets();
    for (const NearNode& pair : near) ++begins_[pair.arc + 1];
    system::sum_counts(begins_);
  }

  void bend(Index arc) {
    std::vector<Index> bent = {arc};
    while (!bent.empty()) {
      const Index next = bent.back();
      bent.pop_back();
      if (is_bent_[next] != 0) continue;
      is_bent_[next] = 1;
      for (const NearNode& pair : near_of(next)) {
        if (is_active_[pair.node] != 0) continue;
        is_active_[pair.node] = 1;
        bent.insert(bent.end(), arcs_.begin() + static_cast<std::ptrdiff_t>(offsets_[pair.node]),
                    arcs_.begin() + static_cast<std::ptrdiff_t>(offsets_[pair.node + 1]));
      }
    }
  }
  [[nodiscard]] bool is_bent(Index arc) const { return is_bent_[arc] != 0; }
  [[nodiscard]] std::span<const NearNode> near_of(Index arc) const {
    return near_.subspan(begins_[arc], begins_[arc + 1] - begins_[arc]);
  }

 private:
  std::span<const NearNode> near_;
  std::vector<std::uint64_t> begins_;  // the pairs of each arc
  std::vector<std::uint8_t> is_bent_;
  std::vector<std::uint8_t> is_active_;
  // The arcs near to each node, in compressed rows.
  std::vector<std::uint64_t> offsets_;
  std::vector<Index> arcs_;
};

// The places of crossings, each once, and which of them each arc has.
struct CrossingPlaces {
  std::vector<Point> points;
  std::vector<Index> numbers;  // the place of each crossing
};

CrossingPlaces places_of(const NodedArcs& input, std::span<const CrossingArcs> crossings,
                         unsigned threads) {
  std::vector<Point> points(crossings.size());
  system::parallel_for(threads, crossings.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [s, t] = crossings[k];
      points[k] = crossing_place(input.from(s), input.to(s), input.from(t), input.to(t));
    }
  });
  NumberedPoints places = numbered(points, 0, threads);
  return {std::move(places.points), std::move(places.numbers)};
}

// Returns the nodes of the crossings of each arc, ascending.
CompressedRows<Index> crossing_nodes(std::size_t num_arcs, std::span<const CrossingArcs> crossings,
                                     std::span<const Index> nodes) {
  system::RowPlaces<std::uint64_t> places(num_arcs);
  for (const CrossingArcs& crossing : crossings) {
    places.count(crossing.first);
    places.count(crossing.second);
  }
  CompressedRows<Index> rows;
  rows.values.resize(places.sum());
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    for (const Index arc : {crossings[k].first, crossings[k].second}) {
      rows.values[places.place(arc)] = nodes[k];
    }
  }
  rows.offsets = std::move(places).offsets();
  return rows;
}

// Some arcs of the result: the nodes of each arc, its ends included.
struct ChainBlock {
  std::vector<std::uint64_t> sizes;
  std::vector<Index> nodes;
  bool is_certain = true;
};

// Leads arcs through nodes.
class Chains {
 public:
  Chains(const NodedArcs& input, std::span<const Index> numbers, std::span<const Point> nodes,
         const BentArcs& bent, const CompressedRows<Index>& crossing_nodes, bool is_forced)
      : input_(input),
        numbers_(numbers),
        nodes_(nodes),
        bent_(bent),
        own_(crossing_nodes),
        is_forced_(is_forced) {}

  void append(Index arc, ChainBlock& block) const {
    const NodedArc ends = {numbers_[input_.arcs[arc].from], numbers_[input_.arcs[arc].to]};
    const std::size_t begin = block.nodes.size();
    block.nodes.push_back(ends.from);
    const std::span<const NearNode> near = bent_.near_of(arc);
    std::vector<Index> through;
    for (const NearNode& pair : near) {
      if (bent_.is_bent(arc) ||
          is_on_near_arc(nodes_[ends.from], nodes_[ends.to], nodes_[pair.node])) {
        through.push_back(pair.node);
      }
    }
    if (bent_.is_bent(arc)) {
      const std::span<const Index> required = is_forced_ ? own_[arc] : std::span<const Index>();
      const bool is_crowded = append_nearest_nodes(nodes_, ends, through, required, block.nodes);
      block.is_certain = block.is_certain && !is_crowded && is_short(ends) && are_own(arc, through);
    } else if (!through.empty()) {
      append_nodes_on_arc(nodes_, ends, through, block.nodes);
    }
    block.nodes.push_back(ends.to);
    block.sizes.push_back(block.nodes.size() - begin);
  }

 private:
  // True if the arc is at most 120 degrees long: if its ends move, its middle does by at most twice
  // as much.
  [[nodiscard]] bool is_short(NodedArc ends) const {
    constexpr double cosine = -0.49;
    return dot(nodes_[ends.from], nodes_[ends.to]) > cosine;
  }
  // True if the nodes near to an arc are those of its crossings.
  [[nodiscard]] bool are_own(Index arc, std::span<const Index> near) const {
    std::vector<Index> own(own_[arc].begin(), own_[arc].end());
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
    return std::ranges::equal(own, near);
  }

  const NodedArcs& input_;
  std::span<const Index> numbers_;
  std::span<const Point> nodes_;
  const BentArcs& bent_;
  const CompressedRows<Index>& own_;
  bool is_forced_;
};

// Returns the pairs of both lists, each once. The first list ascends, since nodes keep their order.
// So does the second one, unless a place is on the ray of a node and has become that node.
std::vector<NearNode> united(std::span<const NearNode> known, std::vector<NearNode> added) {
  const auto is_not_less = [](const NearNode& p, const NearNode& q) { return !(p < q); };
  if (std::ranges::adjacent_find(added, is_not_less) != added.end()) {
    std::ranges::sort(added);
    added.erase(std::unique(added.begin(), added.end()), added.end());
  }
  std::vector<NearNode> all;
  all.reserve(known.size() + added.size());
  std::ranges::set_union(known, added, std::back_inserter(all));
  return all;
}

// Leaves out nodes through which no arc is led: those of crossings that have nearer ones.
void leave_out_unused(std::vector<Point>& nodes, std::vector<Index>& used) {
  std::vector<Index> numbers(nodes.size(), no_index);
  for (const Index node : used) numbers[node] = 0;
  Index count = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (numbers[k] == no_index) continue;
    nodes[count] = nodes[k];
    numbers[k] = count++;
  }
  nodes.resize(count);
  for (Index& node : used) node = numbers[node];
}

// Returns the pieces of arcs of which each row has the nodes.
Snapped pieces_of(std::vector<Point> nodes, CompressedRows<Index> chains, bool is_certain,
                  unsigned threads) {
  leave_out_unused(nodes, chains.values);
  Snapped result;
  std::vector<NodedArc> pieces;
  pieces.reserve(chains.values.size());
  result.chains.offsets =
      system::offsets_of(chains.size(), [&](std::size_t i) { return chains[i].size() - 1; });
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const std::span<const Index> chain = chains[i];
    for (std::size_t k = 1; k < chain.size(); ++k) pieces.push_back({chain[k - 1], chain[k]});
  }
  NumberedArcs numbered = numbered_arcs(pieces, threads);
  result.pieces = {std::move(nodes), std::move(numbered.arcs)};
  result.chains.values = std::move(numbered.halfedges);
  result.is_certain = is_certain;
  return result;
}

}  // namespace

NumberedPoints numbered(std::span<const Point> given, std::size_t num_fixed, unsigned threads) {
  order::SpatialOrder order = order::spatial_order(given, Model::projected, {}, threads);
  bool is_replaced = false;
  for (const auto& [rank, name] : order.renamed) {
    if (name >= num_fixed) continue;
    order.order[rank] = name;
    is_replaced = true;
  }
  NumberedPoints result;
  result.points.resize(order.order.size());
  result.numbers.assign(given.size(), no_index);
  for (std::size_t rank = 0; rank < order.order.size(); ++rank) {
    result.points[rank] = given[order.order[rank]];
    result.numbers[order.order[rank]] = static_cast<Index>(rank);
  }
  for (const auto& [rank, name] : order.renamed) result.numbers[name] = rank;
  for (const auto& [site, representative] : order.duplicates) {
    result.numbers[site] = result.numbers[representative];
  }
  if (!is_replaced) return result;
  // The order was that of points which others on their rays have replaced.
  NumberedPoints sorted = numbered(result.points, 0, threads);
  for (Index& number : result.numbers) number = sorted.numbers[number];
  result.points = std::move(sorted.points);
  return result;
}

NumberedArcs numbered_arcs(std::span<const NodedArc> given, unsigned threads) {
  // Arcs by their lower node, each with its place in the input.
  struct ArcEntry {
    Index to;
    Index place;
    auto operator<=>(const ArcEntry&) const = default;
  };
  Index num_nodes = 0;
  for (const NodedArc& arc : given) num_nodes = std::max({num_nodes, arc.from + 1, arc.to + 1});
  system::RowPlaces<std::uint64_t> places(num_nodes);
  for (const NodedArc& arc : given) places.count(std::min(arc.from, arc.to));
  std::vector<ArcEntry> entries(places.sum());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto [low, high] = std::minmax(given[i].from, given[i].to);
    entries[places.place(low)] = {high, static_cast<Index>(i)};
  }
  const std::vector<std::uint64_t> offsets = std::move(places).offsets();
  system::parallel_for(threads, num_nodes, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      std::sort(entries.begin() + static_cast<std::ptrdiff_t>(offsets[node]),
                entries.begin() + static_cast<std::ptrdiff_t>(offsets[node + 1]));
    }
  });
  NumberedArcs result;
  result.halfedges.resize(given.size());
  for (Index node = 0; node < num_nodes; ++node) {
    for (std::uint64_t k = offsets[node]; k < offsets[node + 1]; ++k) {
      const NodedArc arc = {node, entries[k].to};
      if (result.arcs.empty() || result.arcs.back() != arc) result.arcs.push_back(arc);
      const auto number = static_cast<Index>(result.arcs.size() - 1);
      const bool is_backward = given[entries[k].place].from != node;
      result.halfedges[entries[k].place] = 2 * number + static_cast<Index>(is_backward);
    }
  }
  return result;
}

std::optional<Snapped> snap(const NodedArcs& input, bool is_forced, unsigned threads) {
  const BoxTree boxes = boxes_of(input, threads);
  const Contacts contacts = find_contacts(input, boxes, threads);
  const auto is_on = [&](const NearNode& pair) {
    return is_on_near_arc(input.from(pair.arc), input.to(pair.arc), input.nodes[pair.node]);
  };
  if (contacts.crossings.empty() && std::ranges::none_of(contacts.near, is_on)) return std::nullopt;

  // The nodes after this step are those before it and the places of crossings.
  CrossingPlaces places = places_of(input, contacts.crossings, threads);
  std::vector<Point> all = input.nodes;
  all.insert(all.end(), places.points.begin(), places.points.end());
  NumberedPoints nodes = numbered(all, input.nodes.size(), threads);
  const auto number_of_place = [&](Index place) {
    return nodes.numbers[input.nodes.size() + place];
  };

  std::vector<NearNode> known = contacts.near;
  for (NearNode& pair : known) pair.node = nodes.numbers[pair.node];
  std::vector<NearNode> added = arcs_near(input, boxes, places.points, threads);
  for (NearNode& pair : added) pair.node = number_of_place(pair.node);
  std::erase_if(added, [&](const NearNode& pair) {
    const NodedArc& arc = input.arcs[pair.arc];
    return pair.node == nodes.numbers[arc.from] || pair.node == nodes.numbers[arc.to];
  });
  const std::vector<NearNode> near = united(known, std::move(added));

  BentArcs bent(nodes.points.size(), input.arcs.size(), near);
  for (const CrossingArcs& crossing : contacts.crossings) {
    bent.bend(crossing.first);
    bent.bend(crossing.second);
  }
  for (Index& place : places.numbers) place = number_of_place(place);
  const CompressedRows<Index> own =
      crossing_nodes(input.arcs.size(), contacts.crossings, places.numbers);

  const Chains chains(input, nodes.numbers, nodes.points, bent, own, is_forced);
  std::vector<ChainBlock> blocks(system::num_pieces(input.arcs.size(), grain));
  system::parallel_for(threads, input.arcs.size(), grain, [&](std::size_t begin, std::size_t end) {
    ChainBlock& block = blocks[begin / grain];
    for (std::size_t arc = begin; arc < end; ++arc) chains.append(static_cast<Index>(arc), block);
  });
  const bool is_certain = std::ranges::all_of(blocks, &ChainBlock::is_certain);
  CompressedRows<Index> rows;
  rows.offsets = system::join_rows(
      threads, input.arcs.size(), std::move(blocks),
      [](std::size_t b, const ChainBlock& /*block*/, std::size_t k) { return b * grain + k; },
      system::JoinedColumn{&ChainBlock::nodes, rows.values});
  return pieces_of(std::move(nodes.points), std::move(rows), is_certain, threads);
}

}  // namespace rondel::arrangement
