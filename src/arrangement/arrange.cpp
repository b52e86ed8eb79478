// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers the nodes and arcs, leads arcs through nodes (snapping.h) until no arcs cross, and follows
// each given arc through these steps.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "arrangement/arc_checks.h"
#include "arrangement/snapping.h"
#include "rondel/arrangement.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

using arrangement::NodedArc;

using Ends = std::array<Index, 2>;

// Throws InvalidInput with the first point or arc that is not as arrange() wants it.
void validate_arcs(std::span<const Point> points, std::span<const Ends> arcs) {
  arrangement::validate_points(points);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const auto [a, b] = arcs[i];
    if (a >= points.size() || b >= points.size()) {
      throw InvalidInput("an end of an arc does not exist", i);
    }
    arrangement::validate_ends(points[a], points[b], i);
  }
}

// Arcs between nodes, and how each given arc runs along them.
struct ArrangementState {
  arrangement::NodedArcs arcs;
  CompressedRows<Index> chains;
};

ArrangementState first_state(std::span<const Point> points, std::span<const Ends> arcs,
                             unsigned threads) {
  // Only points that are ends of arcs become nodes.
  std::vector<Index> places(points.size(), no_index);
  std::vector<Point> used;
  for (const Ends& ends : arcs) {
    for (const Index p : ends) {
      if (places[p] != no_index) continue;
      places[p] = static_cast<Index>(used.size());
      used.push_back(points[p]);
    }
  }
  arrangement::NumberedPoints nodes = arrangement::numbered(used, 0, threads);
  std::vector<NodedArc> given;
  given.reserve(arcs.size());
  for (const auto [a, b] : arcs) {
    given.push_back({nodes.numbers[places[a]], nodes.numbers[places[b]]});
  }
  arrangement::NumberedArcs numbered = arrangement::numbered_arcs(given, threads);
  ArrangementState state{{std::move(nodes.points), std::move(numbered.arcs)}, {}};
  state.chains.values.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (given[i].from != given[i].to) state.chains.values.push_back(numbered.halfedges[i]);
    state.chains.end_row();
  }
  return state;
}

// Replaces each halfedge by those of its pieces.
CompressedRows<Index> refined(const CompressedRows<Index>& chains,
                              const CompressedRows<Index>& pieces) {
  CompressedRows<Index> result;
  result.offsets.reserve(chains.offsets.size());
  result.values.reserve(chains.values.size());
  for (std::size_t i = 0; i < chains.size(); ++i) {
    for (const Index h : chains[i]) {
      const std::span<const Index> row = pieces[h / 2];
      if (h % 2 == 0) {
        result.values.insert(result.values.end(), row.begin(), row.end());
      } else {
        for (std::size_t k = row.size(); k-- > 0;) result.values.push_back(row[k] ^ 1U);
      }
    }
    result.end_row();
  }
  return result;
}

// Leaves out arcs that are points.
Arrangement arrangement_of(ArrangementState state) {
  Arrangement result;
  std::vector<Index> numbers(state.arcs.arcs.size(), no_index);
  result.edges.reserve(state.arcs.arcs.size());
  for (std::size_t i = 0; i < state.arcs.arcs.size(); ++i) {
    const NodedArc& arc = state.arcs.arcs[i];
    if (arc.from == arc.to) continue;
    numbers[i] = static_cast<Index>(result.edges.size());
    result.edges.push_back({arc.from, arc.to});
  }
  for (Index& h : state.chains.values) h = 2 * numbers[h / 2] + h % 2;
  result.nodes = std::move(state.arcs.nodes);
  result.chains = std::move(state.chains);
  return result;
}

}  // namespace

Arrangement arrange(std::span<const Point> points, std::span<const Ends> arcs,
                    const Execution& execution) {
  const system::Call call(execution);
  validate_arcs(points, arcs);
  ArrangementState state = first_state(points, arcs, execution.threads);
  constexpr int max_steps = 64;
  bool is_forced = false;
  for (int step = 0;; ++step) {
    std::optional<arrangement::Snapped> snapped =
        arrangement::snap(state.arcs, is_forced, execution.threads);
    if (!snapped) break;
    if (step == max_steps) throw std::runtime_error("rounded arcs do not cease to cross");
    // Arcs may cross in a place that is as near to all of their ends, and that none of them has.
    is_forced =
        snapped->pieces.nodes == state.arcs.nodes && snapped->pieces.arcs == state.arcs.arcs;
    state.chains = refined(state.chains, snapped->chains);
    state.arcs = std::move(snapped->pieces);
    if (snapped->is_certain) break;
  }
  return arrangement_of(std::move(state));
}

}  // namespace rondel
