// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Applies weights of order 2 whose gradients leave out sources without a value (rondel/remap.h).
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "exact/vector.h"
#include "overlay/slope_limiter.h"
#include "rondel/error.h"
#include "rondel/remap.h"
#include "rondel/weights.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"

namespace rondel {
namespace {

constexpr std::size_t targets_per_task = 4096;

// Returns for each value of a field whether it is there; nothing if all are.
std::vector<std::int32_t> values_that_are_there(std::span<const double> field) {
  if (std::ranges::none_of(field, [](double value) { return std::isnan(value); })) return {};
  std::vector<std::int32_t> has_value;
  has_value.reserve(field.size());
  for (const double value : field) has_value.push_back(std::isnan(value) ? 0 : 1);
  return has_value;
}

}  // namespace

// The weights are those for fields without gaps at first. Slopes have none: of weights only their absence is
// stored.
SecondOrderRemap::SecondOrderRemap(Remap remap, std::vector<std::int32_t> covered,
                                   RemapLimiter limiter)
    : remap_(std::move(remap)), covered_(std::move(covered)), limiter_(limiter) {
  if (remap_.moments.size() != remap_.areas.size()) {
    throw InvalidInput("the remapping is not of order 2");
  }
  if (covered_.empty()) covered_.assign(remap_.target_areas.size(), 1);
  if (covered_.size() != remap_.target_areas.size()) {
    throw InvalidInput("there are " + std::to_string(covered_.size()) + " numbers for " +
                       std::to_string(remap_.target_areas.size()) + " targets");
  }
  remap_.weights =
      limiter_ == RemapLimiter::slopes ? Weights{} : with_rows(remap_.weights, covered_);
}

// Returns for each target whether it is covered, and enough of what covers it has values, by area: weights
// of order 2 are no shares.
std::vector<std::int32_t> SecondOrderRemap::with_enough(std::span<const std::int32_t> has_value,
                                                        double max_missing) const {
  std::vector<std::int32_t> enough = covered_;
  for (std::size_t j = 0; j < enough.size(); ++j) {
    double all = 0;
    double missing = 0;
    for (std::uint64_t k = remap_.pieces.offsets[j]; k < remap_.pieces.offsets[j + 1]; ++k) {
      all += remap_.areas[k];
      if (has_value[remap_.pieces.values[k]] == 0) missing += remap_.areas[k];
    }
    if (!may_be_missing(missing, all, max_missing)) enough[j] = 0;
  }
  return enough;
}

// Applies the weights that are in use, to fields that they are for.
void SecondOrderRemap::apply_fields(std::span<const double> in, std::span<double> out,
                                    const ApplyOptions& rules, const Execution& execution) const {
  const std::size_t count = in.size() / std::max<std::size_t>(remap_.source_areas.size(), 1);
  if (limiter_ == RemapLimiter::slopes) {
    const std::size_t sources = remap_.source_areas.size();
    const std::size_t targets = remap_.target_areas.size();
    for (std::size_t f = 0; f < count; ++f) {
      apply_slopes(in.subspan(f * sources, sources), out.subspan(f * targets, targets), rules,
                   execution);
    }
  } else if (limiter_ == RemapLimiter::bounds) {
    apply_limited(remap_, in, out, count, rules, execution);
  } else {
    rondel::apply(remap_.weights, in, out, count, rules, execution);
  }
}

// Sums up what the sources give to each target. Rounding does not take a mean beyond its bounds.
void SecondOrderRemap::apply_slopes(std::span<const double> field, std::span<double> out,
                                    const ApplyOptions& rules, const Execution& execution) const {
  const overlay::LimitedSlopes slopes = slopes_->slopes(remap_, field, execution.threads);
  const auto value_of = [&](std::size_t j) {
    double sum = 0;
    double all = 0;
    double present = 0;
    overlay::ValueBounds bounds;
    for (std::uint64_t k = remap_.pieces.offsets[j]; k < remap_.pieces.offsets[j + 1]; ++k) {
      const Index i = remap_.pieces.values[k];
      all += remap_.areas[k];
      if (std::isnan(field[i])) continue;
      present += remap_.areas[k];
      sum += remap_.areas[k] * field[i] + dot(remap_.moments[k], slopes.gradients[i]);
      bounds.include(slopes.bounds[i]);
    }
    const bool is_enough = present > 0 && may_be_missing(all - present, all, rules.max_missing);
    if (covered_[j] == 0 || !is_enough) return rules.fill;
    // A sum may be beyond the largest number although its mean is not; NaN stays.
    const double mean = sum / present;
    const double within =
        bounds.low <= bounds.high ? std::clamp(mean, bounds.low, bounds.high) : mean;
    const double part = rules.keeps_sums && present < all ? present / all : 1;
    return within * (remap_.norm == RemapNorm::fracarea ? part : part * remap_.target_fractions[j]);
  };
  system::parallel_for(execution.threads, out.size(), targets_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t j = begin; j < end; ++j) out[j] = value_of(j);
                       });
}

// Computes the weights of fields with these values, unless they are in use. Those in use are dropped before; if
// that ends early, none are in use.
void SecondOrderRemap::use_weights(std::vector<std::int32_t> has_value, double max_missing,
                                   const Execution& execution) {
  if (limiter_ == RemapLimiter::slopes) {
    // How much is missing does not change slopes.
    if (slopes_ != nullptr && has_value == has_value_) return;
    slopes_.reset();
    slopes_ = std::make_shared<overlay::SlopeLimiter>(remap_, has_value, execution.threads);
    has_value_ = std::move(has_value);
    return;
  }
  const bool are_in_use =
      has_value.empty() ? is_whole_ : has_value == has_value_ && max_missing == max_missing_;
  if (are_in_use) return;
  if (is_whole_) whole_ = std::move(remap_.weights);
  is_whole_ = false;
  has_value_.clear();
  remap_.weights = {};
  if (has_value.empty()) {
    remap_.weights = std::move(whole_);
    is_whole_ = true;
    return;
  }
  remap_.weights = with_rows(weights_with_values(remap_, has_value, execution),
                             with_enough(has_value, max_missing));
  has_value_ = std::move(has_value);
  max_missing_ = max_missing;
}

// Most files have one coast for all times, so that weights are computed once; a gap that moves costs the
// gradients of all sources each time, and no overlay.
void SecondOrderRemap::apply(std::span<const double> in, std::span<double> out,
                             const ApplyOptions& rules, const Execution& execution) {
  const system::Call call(execution);
  const std::size_t sources = remap_.source_areas.size();
  const std::size_t targets = remap_.target_areas.size();
  const std::size_t count_of_fields = sources == 0 ? 0 : in.size() / sources;
  if (in.size() != count_of_fields * sources || out.size() != count_of_fields * targets) {
    throw InvalidInput("there are " + std::to_string(in.size()) + " and " +
                       std::to_string(out.size()) + " numbers, not a value for each of " +
                       std::to_string(sources) + " sources and " + std::to_string(targets) +
                       " targets");
  }
  if (!(rules.max_missing >= 0 && rules.max_missing <= 1)) {
    throw InvalidInput("max_missing is " + system::shortest_text(rules.max_missing) +
                       ", not in [0, 1]");
  }
  ApplyOptions of_rows = rules;
  // Rows of weights of which too much is missing have no entries.
  if (limiter_ != RemapLimiter::slopes) of_rows.max_missing = 1;
  // Fields that lack values in the same sources are carried together.
  while (!in.empty()) {
    std::vector<std::int32_t> has_value = values_that_are_there(in.first(sources));
    std::size_t count = 1;
    while (count * sources < in.size() &&
           values_that_are_there(in.subspan(count * sources, sources)) == has_value) {
      ++count;
    }
    use_weights(std::move(has_value), rules.max_missing, execution);
    apply_fields(in.first(count * sources), out.first(count * targets), of_rows, execution);
    in = in.subspan(count * sources);
    out = out.subspan(count * targets);
  }
}

}  // namespace rondel
