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
                           : with_rows(weights_with_values(remap_, has_value, execution), covered_);
      has_value_ = std::move(has_value);
    }
    apply_fields(in.first(count * sources), out.first(count * targets), rules, execution);
    in = in.subspan(count * sources);
    out = out.subspan(count * targets);
  }
}

}  // namespace rondel::formats
