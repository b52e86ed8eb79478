// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each source is given to its nearest target.
#include <numeric>

#include "rondel/regrid.h"
#include "system/job.h"

namespace rondel {

Weights nearest_d2s_weights(const Interpolator& targets, std::span<const Point> sources,
                            const Execution& execution) {
  const system::Call call(execution);
  const Weights nearest = targets.weights(sources, {.method = Method::nearest}, execution);
  Weights weights;
  weights.num_columns = sources.size();
  weights.sites_hash = nearest.targets_hash;
  weights.targets_hash = nearest.sites_hash;
  weights.offsets.assign(nearest.num_columns + 1, 0);
  for (const Index target : nearest.columns) ++weights.offsets[target + std::size_t{1}];
  std::partial_sum(weights.offsets.begin(), weights.offsets.end(), weights.offsets.begin());
  weights.columns.resize(nearest.columns.size());
  weights.values.assign(nearest.columns.size(), 1);
  std::vector<std::uint64_t> next(weights.offsets.begin(), weights.offsets.end() - 1);
  for (std::size_t source = 0; source < nearest.num_rows(); ++source) {
    for (std::uint64_t k = nearest.offsets[source]; k < nearest.offsets[source + 1]; ++k) {
      weights.columns[next[nearest.columns[k]]++] = static_cast<Index>(source);
    }
  }
  return weights;
}

}  // namespace rondel
