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
#include "overlay/slope_limiter.h"
#include "rondel/remap.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel {
namespace {

using overlay::ValueBounds;

// Limits one field after another.
class FieldLimiter {
 public:
  FieldLimiter(const Remap& remap, bool keeps_sums) : remap_(remap), keeps_sums_(keeps_sums) {}

  // `values` at targets become limited; NaN stays.
  void limit(std::span<const double> sources, std::span<double> values) {
    find_bounds(sources);
    find_parts(sources);
    exact::DoubleDouble lost{};  // the integral that clipping has taken away
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (!has_value(values, j)) continue;
      const double mean = values[j] / share(j);
      const double clipped = std::clamp(mean, bounds_[j].low, bounds_[j].high);
      add_term(area_with_values(j) * (mean - clipped), lost);
      values[j] = clipped;
    }
    give_back(lost.hi + lost.lo, values);
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (has_value(values, j)) values[j] *= share(j);
    }
  }

 private:
  // A value is this part of the mean over the sources that have values, which the bounds are those of.
  [[nodiscard]] double share(std::size_t j) const {
    const double covered = remap_.norm == RemapNorm::fracarea ? 1 : remap_.target_fractions[j];
    return keeps_sums_ ? covered * parts_[j] : covered;
  }
  [[nodiscard]] double area_with_values(std::size_t j) const {
    return remap_.target_areas[j] * remap_.target_fractions[j] * std::max(parts_[j], 0.0);
  }
  [[nodiscard]] bool has_value(std::span<const double> values, std::size_t j) const {
    return !std::isnan(values[j]) && bounds_[j].low <= bounds_[j].high &&
           remap_.target_fractions[j] > 0 && (parts_[j] > 0 || !keeps_sums_);
  }

  // Finds which part of what sources cover of each target is covered by sources that have values: as
  // apply() does, by the weights.
  void find_parts(std::span<const double> sources) {
    parts_.assign(remap_.target_areas.size(), 1);
    if (std::ranges::none_of(sources, [](double value) { return std::isnan(value); })) return;
    const Weights& weights = remap_.weights;
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      double present = 0;
      double all = 0;
      for (std::uint64_t k = weights.offsets[j]; k < weights.offsets[j + 1]; ++k) {
        all += weights.values[k];
        if (!std::isnan(sources[weights.columns[k]])) present += weights.values[k];
      }
      if (present != all) parts_[j] = present / all;
    }
  }

  void find_bounds(std::span<const double> sources) {
    bounds_.assign(remap_.target_areas.size(), {});
    for (std::size_t j = 0; j < bounds_.size(); ++j) {
      for (std::uint64_t k = remap_.pieces.offsets[j]; k < remap_.pieces.offsets[j + 1]; ++k) {
        const double value = sources[remap_.pieces.values[k]];
        if (std::isnan(value)) continue;
        bounds_[j].include({value, value});
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
      if (has_value(values, j)) add_term(area_with_values(j) * room(j), all);
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
  bool keeps_sums_;
  std::vector<ValueBounds> bounds_;  // of the sources of each target
  std::vector<double> parts_;
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
    FieldLimiter(remap, options.keeps_sums)
        .limit(in.subspan(f * num_sources, num_sources), out.subspan(f * num_targets, num_targets));
  });
  for (double& value : out) {
    if (std::isnan(value)) value = options.fill;
  }
}

}  // namespace rondel
