// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Limits remapped values to the bounds of their sources, and keeps the integral: clip and assured
// sum (Bradley et al., SIAM J. Sci. Comput. 41, 2019, section 2).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "exact/eft.h"
#include "rondel/remap.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel {
namespace {

// The bounds of the sources of a target. Without sources that have values, low is above high.
struct ValueBounds {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

// Limits one field after another.
class FieldLimiter {
 public:
  explicit FieldLimiter(const Remap& remap) : remap_(remap) {
    for (std::size_t j = 0; j < remap.target_areas.size(); ++j) {
      covered_.push_back(remap.target_areas[j] * remap.target_fractions[j]);
    }
  }

  // `values` at targets become limited; NaN stays.
  void limit(std::span<const double> sources, std::span<double> values) {
    find_bounds(sources);
    // With destarea a value counts 0 for what is not covered; bounds are those of what is.
    const bool is_of_covered = remap_.norm == RemapNorm::fracarea;
    const auto share = [&](std::size_t j) {
      return is_of_covered ? 1 : remap_.target_fractions[j];
    };
    exact::DoubleDouble lost{};  // the integral that clipping has taken away
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (!has_value(values, j)) continue;
      const double mean = values[j] / share(j);
      const double clipped = std::clamp(mean, bounds_[j].low, bounds_[j].high);
      add_term(covered_[j] * (mean - clipped), lost);
      values[j] = clipped;
    }
    give_back(lost.hi + lost.lo, values);
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (has_value(values, j)) values[j] *= share(j);
    }
  }

 private:
  [[nodiscard]] bool has_value(std::span<const double> values, std::size_t j) const {
    return !std::isnan(values[j]) && bounds_[j].low <= bounds_[j].high && covered_[j] > 0;
  }

  void find_bounds(std::span<const double> sources) {
    bounds_.assign(covered_.size(), {});
    for (std::size_t j = 0; j < covered_.size(); ++j) {
      for (std::uint64_t k = remap_.pieces.offsets[j]; k < remap_.pieces.offsets[j + 1]; ++k) {
        const double value = sources[remap_.pieces.values[k]];
        if (std::isnan(value)) continue;
        bounds_[j] = {std::min(bounds_[j].low, value), std::max(bounds_[j].high, value)};
      }
    }
  }

  // Distributes an integral over the targets, to each in proportion to what its bounds leave room
  // for. The room is always enough, since the means of order 1 are within the bounds and have the
  // integral of before.
  void give_back(double integral, std::span<double> values) const {
    if (integral == 0) return;
    const auto room = [&](std::size_t j) {
      return integral > 0 ? bounds_[j].high - values[j] : bounds_[j].low - values[j];
    };
    exact::DoubleDouble all{};
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (has_value(values, j)) add_term(covered_[j] * room(j), all);
    }
    const double of_all = all.hi + all.lo;
    if (of_all == 0) return;
    const double part = std::min(integral / of_all, 1.0);
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (!has_value(values, j)) continue;
      values[j] = std::clamp(values[j] + part * room(j), bounds_[j].low, bounds_[j].high);
    }
  }

  const Remap& remap_;
  std::vector<double> covered_;  // the area of each target that sources cover
  std::vector<ValueBounds> bounds_;
};

}  // namespace

void apply_limited(const Remap& remap, std::span<const double> in, std::span<double> out,
                   std::size_t num_fields, const ApplyOptions& options,
                   const Execution& execution) {
  const system::Call call(execution);
  ApplyOptions unfilled = options;
  unfilled.fill = std::numeric_limits<double>::quiet_NaN();
  apply(remap.weights, in, out, num_fields, unfilled, execution);
  const std::size_t num_sources = remap.weights.num_columns;
  const std::size_t num_targets = remap.weights.num_rows();
  system::parallel_for(execution.threads, num_fields, 1, [&](std::size_t f, std::size_t /*end*/) {
    FieldLimiter(remap).limit(in.subspan(f * num_sources, num_sources),
                              out.subspan(f * num_targets, num_targets));
  });
  for (double& value : out) {
    if (std::isnan(value)) value = options.fill;
  }
}

}  // namespace rondel
