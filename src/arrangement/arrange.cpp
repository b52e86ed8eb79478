// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers the nodes and arcs, leads arcs through nodes (snapping.h) until no arcs cross, and follows
// each given arc through these steps.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "arrangement/arc_checks.h"
#include "arrangement/numbering.h"
#include "arrangement/snapping.h"
#include "rondel/arrangement.h"
#include "rondel/error.h"
#include "system/gather.h"
#include "system/job.h"
#include "system/numbers_where.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using arrangement::NodedArc;

using Ends = std::array<Index, 2>;

constexpr std::size_t arcs_per_task = 4096;

// Throws InvalidInput with the first point or arc that is not as arrange() wants it.
void validate_arcs(std::span<const Point> points, std::span<const Ends> arcs, unsigned threads) {
  const auto validate = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = arcs[i];
      if (a >= points.size() || b >= points.size()) {
        throw InvalidInput("an end of an arc does not exist", i);
      }
      arrangement::validate_ends(points[a], points[b], i);
    }
  };
  try {
    system::parallel_for(threads, points.size(), arcs_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           arrangement::validate_points(points.subspan(begin, end - begin));
                         });
    system::parallel_for(threads, arcs.size(), arcs_per_task, validate);
  } catch (const InvalidInput&) {
    // Others may be before the one that was found.
    arrangement::validate_points(points);
    validate(0, arcs.size());
  }
}

// Arcs between nodes, and how each given arc runs along them.
struct ArrangementState {
  arrangement::NodedArcs arcs;
  CompressedRows<Index> chains;
};

// Only points that are ends of arcs become nodes.
arrangement::NumberedPoints first_nodes(std::span<const Point> points, std::span<const Ends> arcs,
                                        unsigned threads) {
  std::vector<std::uint8_t> is_used(points.size(), 0);
  system::parallel_for(threads, arcs.size(), arcs_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           for (const Index p : arcs[i]) {
                             std::atomic_ref(is_used[p]).store(1, std::memory_order_relaxed);
                           }
                         }
                       });
  if (std::ranges::find(is_used, 0) == is_used.end()) {
    return arrangement::numbered(points, 0, threads);
  }
  const std::vector<Index> used =
      system::numbers_where(threads, points.size(), [&](std::size_t i) { return is_used[i] != 0; });
  arrangement::NumberedPoints nodes =
      arrangement::numbered(system::gather(points, used), 0, threads);
  std::vector<Index> numbers(points.size(), no_index);
  for (std::size_t k = 0; k < used.size(); ++k) numbers[used[k]] = nodes.numbers[k];
  nodes.numbers = std::move(numbers);
  return nodes;
}

ArrangementState first_state(std::span<const Point> points, std::span<const Ends> arcs,
                             unsigned threads) {
  arrangement::NumberedPoints nodes = first_nodes(points, arcs, threads);
  std::vector<NodedArc> given(arcs.size());
  system::parallel_for(threads, arcs.size(), arcs_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           given[i] = {nodes.numbers[arcs[i][0]], nodes.numbers[arcs[i][1]]};
                         }
                       });
  arrangement::NumberedArcs numbered =
      arrangement::numbered_arcs(given, nodes.points.size(), threads);
  ArrangementState state{{std::move(nodes.points), std::move(numbered.arcs)}, {}};
  state.chains.offsets = system::offsets_of(arcs.size(), [&](std::size_t i) {
    return static_cast<std::size_t>(given[i].from != given[i].to);
  });
  state.chains.values.resize(state.chains.offsets.back());
  system::parallel_for(threads, arcs.size(), arcs_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           if (given[i].from != given[i].to) {
                             state.chains.values[state.chains.offsets[i]] = numbered.halfedges[i];
                           }
                         }
                       });
  return state;
}

// Replaces each halfedge by those of its pieces.
CompressedRows<Index> refined(const CompressedRows<Index>& chains,
                              const CompressedRows<Index>& pieces, unsigned threads) {
  CompressedRows<Index> result;
  result.offsets.resize(chains.offsets.size());
  // The arcs come in any order.
  const auto prefetch = [&](std::uint64_t k) {
    if (k < chains.values.size()) system::prefetch(&pieces.offsets[chains.values[k] / 2]);
  };
  system::parallel_for(threads, chains.size(), arcs_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           prefetch(chains.offsets[i] + system::prefetch_distance);
                           std::uint64_t size = 0;
                           for (const Index h : chains[i]) size += pieces[h / 2].size();
                           result.offsets[i + 1] = size;
                         }
                       });
  system::sum_counts(result.offsets);
  result.values.resize(result.offsets.back());
  system::parallel_for(
      threads, chains.size(), arcs_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          prefetch(chains.offsets[i] + 2 * system::prefetch_distance);
          if (const std::uint64_t k = chains.offsets[i] + system::prefetch_distance;
              k < chains.values.size()) {
            system::prefetch(pieces.values.data() + pieces.offsets[chains.values[k] / 2]);
          }
          auto next = result.values.begin() + static_cast<std::ptrdiff_t>(result.offsets[i]);
          for (const Index h : chains[i]) {
            const std::span<const Index> row = pieces[h / 2];
            if (h % 2 == 0) {
              next = std::copy(row.begin(), row.end(), next);
            } else {
              next = std::transform(row.rbegin(), row.rend(), next, [](Index p) { return p ^ 1U; });
            }
          }
        }
      });
  return result;
}

// Leaves out arcs that are points.
void leave_out_points(ArrangementState& state) {
  std::vector<NodedArc>& arcs = state.arcs.arcs;
  const auto is_point = [](const NodedArc& arc) { return arc.from == arc.to; };
  if (std::ranges::none_of(arcs, is_point)) return;
  std::vector<Index> numbers(arcs.size(), no_index);
  Index count = 0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (!is_point(arcs[i])) numbers[i] = count++;
  }
  std::erase_if(arcs, is_point);
  for (Index& h : state.chains.values) h = 2 * numbers[h / 2] + h % 2;
}

Arrangement arrangement_of(ArrangementState state, unsigned threads) {
  leave_out_points(state);
  Arrangement result;
  result.edges.resize(state.arcs.arcs.size());
  system::parallel_for(threads, result.edges.size(), arcs_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           result.edges[i] = {state.arcs.arcs[i].from, state.arcs.arcs[i].to};
                         }
                       });
  result.nodes = std::move(state.arcs.nodes);
  result.chains = std::move(state.chains);
  return result;
}

}  // namespace

Arrangement arrange(std::span<const Point> points, std::span<const Ends> arcs,
                    const Execution& execution) {
  const system::Call call(execution);
  validate_arcs(points, arcs, execution.threads);
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
    state.chains = refined(state.chains, snapped->chains, execution.threads);
    state.arcs = std::move(snapped->pieces);
    if (snapped->is_certain) break;
  }
  return arrangement_of(std::move(state), execution.threads);
}

}  // namespace rondel
