// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/linear_weights.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "overlay/index_numbers.h"
#include "overlay/small_sort.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t rows_per_block = 1024;

// Consecutive rows of weights.
struct LinearRows {
  std::vector<Index> sizes;
  std::vector<Index> columns;
  std::vector<double> values;
};

// Computes one row after another.
class LinearRowMaker {
 public:
  LinearRowMaker(const Remap& remap, const CellGradients& gradients)
      : remap_(remap), gradients_(gradients) {}

  // Appends the row of a target, whose weights are divided by `area`.
  void append(std::size_t target, double area, LinearRows& rows) {
    numbers_.clear();
    sums_.clear();
    for (std::uint64_t k = remap_.pieces.offsets[target]; k < remap_.pieces.offsets[target + 1];
         ++k) {
      const Index source = remap_.pieces.values[k];
      double own = remap_.areas[k];
      const std::uint64_t end = gradients_.offsets[source + std::size_t{1}];
      for (std::uint64_t g = gradients_.offsets[source]; g < end; ++g) {
        const double weight = dot(remap_.moments[k], gradients_.slopes[g]);
        if (weight == 0) continue;
        add(gradients_.neighbors[g], weight / area);
        own -= weight;
      }
      add(source, own / area);
    }
    put_in_order(rows);
  }

 private:
  // Adds a weight of a source. Weights of one source are added in the order of the pieces.
  void add(Index source, double weight) {
    const Index number = numbers_(source);
    if (number == sums_.size()) sums_.push_back(0);
    sums_[number] += weight;
  }

  // Appends the weights of the row in ascending order of sources.
  void put_in_order(LinearRows& rows) {
    const std::span<const Index> sources = numbers_.keys();
    const std::size_t begin = rows.columns.size();
    rows.sizes.push_back(static_cast<Index>(sources.size()));
    rows.columns.resize(begin + sources.size());
    rows.values.resize(begin + sources.size());
    const auto put = [&](std::size_t place, std::size_t number) {
      rows.columns[begin + place] = sources[number];
      rows.values[begin + place] = sums_[number];
    };
    if (sources.size() <= SmallSort::most) {
      const SmallSort sorted(sources.size(), [&](std::size_t k) { return sources[k]; });
      for (std::size_t k = 0; k < sources.size(); ++k) put(sorted[k], k);
      return;
    }
    order_.resize(sources.size());
    std::iota(order_.begin(), order_.end(), Index{0});
    std::ranges::sort(order_, {}, [&](Index number) { return sources[number]; });
    for (std::size_t k = 0; k < order_.size(); ++k) put(k, order_[k]);
  }

  const Remap& remap_;
  const CellGradients& gradients_;
  IndexNumbers numbers_;
  std::vector<double> sums_;  // the weight of each number
  std::vector<Index> order_;  // numbers in the order of their sources
};

}  // namespace

Weights linear_weights(const Remap& remap, const CellGradients& gradients,
                       std::span<const double> target_areas, std::span<const Index> targets,
                       unsigned threads) {
  const std::size_t n = target_areas.size();
  const auto target = [&](std::size_t k) { return targets.empty() ? k : std::size_t{targets[k]}; };
  std::vector<LinearRows> blocks(system::num_pieces(n, rows_per_block));
  Weights weights;
  system::parallel_for(threads, n, rows_per_block, [&](std::size_t begin, std::size_t end) {
    LinearRowMaker maker(remap, gradients);
    for (std::size_t k = begin; k < end; ++k) {
      maker.append(target(k), target_areas[target(k)], blocks[begin / rows_per_block]);
    }
  });
  weights.offsets = system::join_rows(
      threads, n, std::move(blocks),
      [&](std::size_t b, const LinearRows&, std::size_t k) {
        return target(b * rows_per_block + k);
      },
      system::JoinedColumn{&LinearRows::columns, weights.columns},
      system::JoinedColumn{&LinearRows::values, weights.values});
  return weights;
}

}  // namespace rondel::overlay
