// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_second.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondel/weights.h"

namespace rondel::formats {
namespace {

// Returns for each value of a field whether it is there; nothing if all are.
std::vector<std::int32_t> values_that_are_there(std::span<const double> field) {
  if (std::ranges::none_of(field, [](double value) { return std::isnan(value); })) return {};
  std::vector<std::int32_t> has_value;
  has_value.reserve(field.size());
  for (const double value : field) has_value.push_back(std::isnan(value) ? 0 : 1);
  return has_value;
}

}  // namespace

// The weights are those for fields without gaps at first.
SecondOrder::SecondOrder(Remap remap, std::vector<std::int32_t> covered, bool is_limited)
    : remap_(std::move(remap)), covered_(std::move(covered)), is_limited_(is_limited) {
  remap_.weights = with_rows(remap_.weights, covered_);
}

// Returns for each target whether it is covered, and enough of what covers it has values, by area: weights
// of order 2 are no shares. Areas that should be equal may differ in their last bits.
std::vector<std::int32_t> SecondOrder::with_enough(std::span<const std::int32_t> has_value,
                                                   double max_missing) const {
  constexpr double rounding = 0x1p-40;
  std::vector<std::int32_t> enough = covered_;
  for (std::size_t j = 0; j < enough.size(); ++j) {
    double all = 0;
    double missing = 0;
    for (std::uint64_t k = remap_.pieces.offsets[j]; k < remap_.pieces.offsets[j + 1]; ++k) {
      all += remap_.areas[k];
      if (has_value[remap_.pieces.values[k]] == 0) missing += remap_.areas[k];
    }
    if (missing > max_missing * all * (1 + rounding)) enough[j] = 0;
  }
  return enough;
}

// Applies the weights that are in use, to fields that they are for.
void SecondOrder::apply_fields(std::span<const double> in, std::span<double> out,
                               const ApplyOptions& rules, const Execution& execution) const {
  const std::size_t count = in.size() / std::max<std::size_t>(remap_.source_areas.size(), 1);
  if (is_limited_) {
    apply_limited(remap_, in, out, count, rules, execution);
  } else {
    rondel::apply(remap_.weights, in, out, count, rules, execution);
  }
}

// Most files have one coast for all times, so that weights are computed once; a gap that moves costs the
// gradients of all sources each time, and no overlay.
void SecondOrder::apply(std::span<const double> in, std::span<double> out,
                        const ApplyOptions& rules, const Execution& execution) {
  const std::size_t sources = remap_.source_areas.size();
  const std::size_t targets = remap_.target_areas.size();
  ApplyOptions of_rows = rules;
  of_rows.max_missing = 1;  // rows of which too much is missing have no entries
  // Fields that lack values in the same sources are carried together.
  while (!in.empty()) {
    std::vector<std::int32_t> has_value = values_that_are_there(in.first(sources));
    std::size_t count = 1;
    while (count * sources < in.size() &&
           values_that_are_there(in.subspan(count * sources, sources)) == has_value) {
      ++count;
    }
    if (has_value != has_value_) {
      if (has_value_.empty()) whole_ = std::move(remap_.weights);
      remap_.weights = {};  // before there are others
      remap_.weights = has_value.empty()
                           ? std::move(whole_)
                           : with_rows(weights_with_values(remap_, has_value, execution),
                                       with_enough(has_value, rules.max_missing));
      has_value_ = std::move(has_value);
    }
    apply_fields(in.first(count * sources), out.first(count * targets), of_rows, execution);
    in = in.subspan(count * sources);
    out = out.subspan(count * targets);
  }
}

}  // namespace rondel::formats
