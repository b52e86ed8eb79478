// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each source is given to its nearest target.
#include <utility>

#include "rondel/regrid.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel {

Weights nearest_d2s_weights(const Interpolator& targets, std::span<const Point> sources,
                            const Execution& execution) {
  const system::Call call(execution);
  const Weights nearest = targets.weights(sources, {.method = Method::nearest}, execution);
  Weights weights;
  weights.num_columns = sources.size();
  weights.sites_hash = nearest.targets_hash;
  weights.targets_hash = nearest.sites_hash;
  system::RowPlaces places(nearest.num_columns);
  for (const Index target : nearest.columns) places.count(target);
  weights.columns.resize(places.sum());
  weights.values.assign(weights.columns.size(), 1);
  for (std::size_t source = 0; source < nearest.num_rows(); ++source) {
    for (std::uint64_t k = nearest.offsets[source]; k < nearest.offsets[source + 1]; ++k) {
      weights.columns[places.place(nearest.columns[k])] = static_cast<Index>(source);
    }
  }
  weights.offsets = std::move(places).offsets();
  return weights;
}

}  // namespace rondel
