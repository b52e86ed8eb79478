// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The place of a crossing is near to both of its arcs, which is nearly always plain. So other arcs
// near to it are sought only.
#include "arrangement/arc_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "arrangement/crossing_place.h"
#include "arrangement/numbering.h"
#include "exact/vector.h"
#include "system/numbers_where.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

constexpr std::size_t entries_per_task = 1024;

// True if the rounded place of a crossing of the arc ab is near to the arc beyond doubt. It is less
// than `arrangement_radius` from the crossing; so if it is much farther from both ends, the foot of
// its perpendicular is within the arc.
bool is_surely_near(const Point& a, const Point& b, const Point& place) {
  constexpr double much = 0x1p-40;
  constexpr double least_cosine = 0.1;
  return dot(a, b) > least_cosine && exact::largest_coordinate(place - a) > much &&
         exact::largest_coordinate(b - place) > much;
}

// Finds the nodes after a step, and those that an arc has to do with.
class NodeFinder {
 public:
  NodeFinder(const NodedArcs& input, const BoxTree& boxes, const Contacts& contacts,
             unsigned threads)
      : input_(input),
        boxes_(boxes),
        crossings_(contacts.crossings),
        known_(contacts.near),
        threads_(threads),
        num_before_(input.nodes.size()) {}

  NodesOfArcs run() && {
    number_nodes();
    find_merged();
    find_near();
    NodesOfArcs result;
    result.of_arc = rows();
    result.nodes = std::move(nodes_.points);
    result.numbers = std::move(nodes_.numbers);
    result.numbers.resize(num_before_);
    return result;
  }

 private:
  // Computes the places of crossings, and numbers the nodes before the step and these.
  void number_nodes() {
    std::vector<Point> all(num_before_ + crossings_.size());
    std::ranges::copy(input_.nodes, all.begin());
    const std::span<Point> places = std::span(all).subspan(num_before_);
    system::parallel_for(threads_, places.size(), entries_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           std::vector<CrossingEnds> crossings;
                           for (std::size_t k = begin; k < end; ++k) {
                             crossings.push_back(ends_of(crossings_[k]));
                           }
                           crossing_places(crossings, places.subspan(begin, end - begin));
                         });
    nodes_ = numbered(all, num_before_, threads_);
    merged_ = system::numbers_where(threads_, crossings_.size(), [&](std::size_t k) {
      return nodes_.sources[node_of(k)] < num_before_;
    });
    for (const Index k : merged_) merged_places_.push_back(all[num_before_ + k]);
  }
  [[nodiscard]] CrossingEnds ends_of(const CrossingArcs& crossing) const {
    const auto [s, t] = crossing;
    return {input_.from(s), input_.to(s), input_.from(t), input_.to(t)};
  }
  [[nodiscard]] Index node_of(std::size_t crossing) const {
    return nodes_.numbers[num_before_ + crossing];
  }

  // Finds the arcs near to places that are on the ray of a node, which stands for them, but may have
  // other coordinates.
  void find_merged() {
    if (merged_.empty()) return;
    const NumberedPoints places = numbered(merged_places_, 0, threads_);
    std::vector<Index> which(places.points.size());
    std::vector<Index> nodes(places.points.size());
    for (std::size_t k = 0; k < merged_.size(); ++k) {
      which[places.numbers[k]] = places.numbers[k];
      nodes[places.numbers[k]] = node_of(merged_[k]);
    }
    const std::vector<CrossingArcs> known(which.size(), {no_index, no_index});
    near_ = arcs_near(input_, boxes_, {places.points, which, known}, threads_);
    for (NearNode& pair : near_) pair.node = nodes[pair.node];
    std::erase_if(near_, [&](const NearNode& pair) {
      const NodedArc& arc = input_.arcs[pair.arc];
      return pair.node == nodes_.numbers[arc.from] || pair.node == nodes_.numbers[arc.to];
    });
  }

  // Finds the arcs near to new nodes, beside those of one crossing each.
  void find_near() {
    const std::vector<Index> which = system::numbers_where(
        threads_, nodes_.points.size(),
        [&](std::size_t node) { return nodes_.sources[node] >= num_before_; });
    std::vector<CrossingArcs> known(which.size());
    system::parallel_for(threads_, which.size(), entries_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t k = begin; k < end; ++k) {
                             known[k] = crossings_[nodes_.sources[which[k]] - num_before_];
                           }
                         });
    const std::vector<NearNode> found =
        arcs_near(input_, boxes_, {nodes_.points, which, known}, threads_);
    near_.insert(near_.end(), found.begin(), found.end());
    for (const NearNode& pair : known_) near_.push_back({pair.arc, nodes_.numbers[pair.node]});
  }

  // Returns what the node of a crossing is to an arc of it.
  [[nodiscard]] std::uint32_t kind_of(Index arc, Index node) const {
    // The arcs near to others have been found.
    if (nodes_.sources[node] < num_before_) return ArcNode::of_crossing;
    const Point& a = input_.from(arc);
    const Point& b = input_.to(arc);
    const Point& place = nodes_.points[node];
    const bool is_near_arc = is_surely_near(a, b, place) || is_near(a, b, place);
    return is_near_arc ? ArcNode::of_crossing | ArcNode::near_to_arc : ArcNode::of_crossing;
  }

  [[nodiscard]] CompressedRows<ArcNode> rows() const {
    system::RowPlaces<std::uint64_t> places(input_.arcs.size());
    for (const auto [s, t] : crossings_) {
      places.count(s);
      places.count(t);
    }
    for (const NearNode& pair : near_) places.count(pair.arc);
    CompressedRows<ArcNode> rows;
    rows.values.resize(places.sum());
    for (std::size_t k = 0; k < crossings_.size(); ++k) {
      for (const Index arc : {crossings_[k].first, crossings_[k].second}) {
        rows.values[places.place(arc)] = {node_of(k), ArcNode::of_crossing};
      }
    }
    for (const NearNode& pair : near_) {
      rows.values[places.place(pair.arc)] = {pair.node, ArcNode::near_to_arc};
    }
    rows.offsets = std::move(places).offsets();
    tidy(rows);
    return rows;
  }

  // Sorts rows, and joins the entries of an arc and a node.
  void tidy(CompressedRows<ArcNode>& rows) const {
    std::vector<std::uint8_t> has_several(system::num_pieces(rows.size(), entries_per_task), 0);
    system::parallel_for(threads_, rows.size(), entries_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t arc = begin; arc < end; ++arc) {
                             const std::span row(rows.values.data() + rows.offsets[arc],
                                                 rows.values.data() + rows.offsets[arc + 1]);
                             for (ArcNode& entry : row) {
                               if (entry.is_of_crossing())
                                 entry.kind = kind_of(static_cast<Index>(arc), entry.node);
                             }
                             std::ranges::sort(row);
                             for (std::size_t k = 1; k < row.size(); ++k) {
                               if (row[k].node == row[k - 1].node)
                                 has_several[begin / entries_per_task] = 1;
                             }
                           }
                         });
    if (std::ranges::find(has_several, 1) == has_several.end()) return;
    CompressedRows<ArcNode> joined;
    for (std::size_t arc = 0; arc < rows.size(); ++arc) {
      const std::size_t begin = joined.values.size();
      for (const ArcNode& entry : rows[arc]) {
        if (joined.values.size() > begin && joined.values.back().node == entry.node) {
          joined.values.back().kind |= entry.kind;
        } else {
          joined.values.push_back(entry);
        }
      }
      joined.end_row();
    }
    rows = std::move(joined);
  }

  const NodedArcs& input_;
  const BoxTree& boxes_;
  std::span<const CrossingArcs> crossings_;
  std::span<const NearNode> known_;
  unsigned threads_;
  std::size_t num_before_;
  NumberedPoints nodes_;
  std::vector<Index> merged_;  // crossings on the rays of nodes before the step
  std::vector<Point> merged_places_;
  std::vector<NearNode> near_;
};

// Bends arcs near to nodes through which an arc is led.
class Bending {
 public:
  Bending(const CompressedRows<ArcNode>& of_arc, std::size_t num_nodes,
          std::span<std::uint8_t> is_bent)
      : of_arc_(of_arc), is_bent_(is_bent), is_active_(num_nodes, 0) {}

  // `straight` lists the arcs that are not bent and have nodes near to them.
  void run(std::span<const Index> straight) {
    system::RowPlaces<std::uint64_t> places(is_active_.size());
    for (const Index arc : straight) {
      for (const ArcNode& entry : of_arc_[arc]) places.count(entry.node);
    }
    arcs_.values.resize(places.sum());
    for (const Index arc : straight) {
      for (const ArcNode& entry : of_arc_[arc]) arcs_.values[places.place(entry.node)] = arc;
    }
    arcs_.offsets = std::move(places).offsets();
    for (std::size_t arc = 0; arc < is_bent_.size(); ++arc) {
      if (is_bent_[arc] != 0) activate_nodes(static_cast<Index>(arc));
    }
    while (!next_.empty()) {
      const Index arc = next_.back();
      next_.pop_back();
      if (std::exchange(is_bent_[arc], std::uint8_t{1}) == 0) activate_nodes(arc);
    }
  }

 private:
  void activate_nodes(Index arc) {
    for (const ArcNode& entry : of_arc_[arc]) {
      if (!entry.is_near() || std::exchange(is_active_[entry.node], std::uint8_t{1}) != 0) continue;
      const std::span<const Index> near = arcs_[entry.node];
      next_.insert(next_.end(), near.begin(), near.end());
    }
  }

  const CompressedRows<ArcNode>& of_arc_;
  std::span<std::uint8_t> is_bent_;
  std::vector<std::uint8_t> is_active_;  // nodes
  CompressedRows<Index> arcs_;           // the straight arcs near to each node
  std::vector<Index> next_;              // arcs that have to be bent
};

}  // namespace

NodesOfArcs nodes_of_arcs(const NodedArcs& input, const BoxTree& boxes, const Contacts& contacts,
                          unsigned threads) {
  return NodeFinder(input, boxes, contacts, threads).run();
}

std::vector<std::uint8_t> bent_arcs(const CompressedRows<ArcNode>& of_arc, std::size_t num_nodes,
                                    unsigned threads) {
  std::vector<std::uint8_t> is_bent(of_arc.size());
  system::parallel_for(
      threads, of_arc.size(), entries_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t arc = begin; arc < end; ++arc) {
          is_bent[arc] = std::ranges::any_of(of_arc[arc], &ArcNode::is_of_crossing) ? 1 : 0;
        }
      });
  const std::vector<Index> straight = system::numbers_where(
      threads, of_arc.size(),
      [&](std::size_t arc) { return is_bent[arc] == 0 && !of_arc[arc].empty(); });
  if (!straight.empty()) Bending(of_arc, num_nodes, is_bent).run(straight);
  return is_bent;
}

}  // namespace rondel::arrangement
