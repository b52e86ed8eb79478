// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each zone and field is computed alone: its values are gathered with their weights, sorted only if a
// statistic needs it, and put into one number for each statistic.
#include "rondel/zonal_statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "rondel/error.h"
#include "system/checked_product.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace overlay {
namespace {

constexpr double no_statistic = std::numeric_limits<double>::quiet_NaN();

// The value of a cell in a zone.
struct ZonalValue {
  double value;
  double weight;
  double share;  // of the cell that is in the zone
  friend bool operator<(const ZonalValue& a, const ZonalValue& b) {
    return a.value != b.value ? a.value < b.value : a.weight < b.weight;
  }
};

// The values of a zone, and those of slivers: cells of which the zone has less than this part of both,
// as where a straight side in longitude and latitude is made of arcs.
struct ZoneMemory {
  std::vector<ZonalValue> values;
  std::vector<ZonalValue> slivers;
};
constexpr double part_of_sliver = 1e-3;

// True for sums, to which a sliver adds as little as it should. It would count as much as a whole cell
// in an extreme value, and shift the places of quantiles.
bool takes_slivers(ZonalOperation operation) {
  return operation == ZonalOperation::mean || operation == ZonalOperation::sum ||
         operation == ZonalOperation::count || operation == ZonalOperation::variance ||
         operation == ZonalOperation::stdev;
}

bool needs_order(ZonalOperation operation) {
  return operation == ZonalOperation::median || operation == ZonalOperation::quantile ||
         operation == ZonalOperation::majority || operation == ZonalOperation::minority ||
         operation == ZonalOperation::variety;
}

bool is_a_number_of_cells(ZonalOperation operation) {
  return operation == ZonalOperation::count || operation == ZonalOperation::fraction ||
         operation == ZonalOperation::variety;
}

// Returns the mean, which rounding does not take beyond the values: constants are exact.
double mean_of(std::span<const ZonalValue> values) {
  double sum = 0;
  double weights = 0;
  double low = values.front().value;
  double high = low;
  for (const ZonalValue& v : values) {
    sum += v.weight * v.value;
    weights += v.weight;
    low = std::min(low, v.value);
    high = std::max(high, v.value);
  }
  return std::clamp(sum / weights, low, high);
}

double variance_of(std::span<const ZonalValue> values) {
  const double mean = mean_of(values);
  double sum = 0;
  double weights = 0;
  for (const ZonalValue& v : values) {
    sum += v.weight * (v.value - mean) * (v.value - mean);
    weights += v.weight;
  }
  return sum / weights;
}

// Returns the quantile of values in ascending order, by the formula of the header.
double quantile_of(std::span<const ZonalValue> values, double quantile) {
  const auto last = static_cast<double>(values.size() - 1);
  double all = 0;
  for (const ZonalValue& v : values) all += v.weight;
  const double wanted = quantile * last * all;
  double before = 0;    // the sum of the weights before value k
  double s_before = 0;  // the place of the value before
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double s = static_cast<double>(k) * values[k].weight + last * before;
    if (s > wanted) {
      const double low = values[k - 1].value;
      return low + (wanted - s_before) * (values[k].value - low) / (s - s_before);
    }
    s_before = s;
    before += values[k].weight;
  }
  return values.back().value;
}

// Calls visit(value, weight) for each different value, in ascending order.
template <class Visit>
void for_each_different(std::span<const ZonalValue> values, const Visit& visit) {
  for (std::size_t k = 0; k < values.size();) {
    const double value = values[k].value;
    double weight = 0;
    for (; k < values.size() && values[k].value == value; ++k) weight += values[k].weight;
    visit(value, weight);
  }
}

double variety_of(std::span<const ZonalValue> values) {
  double number = 0;
  for_each_different(values, [&](double /*value*/, double /*weight*/) { ++number; });
  return number;
}

// Returns the first value whose weight is above, or with `is_least` below, those of all others by more
// than rounding.
double extreme_of(std::span<const ZonalValue> values, bool is_least) {
  double found = no_statistic;
  double found_weight = 0;
  bool is_first = true;
  for_each_different(values, [&](double value, double weight) {
    const bool is_better =
        is_least ? is_larger_share(found_weight, weight) : is_larger_share(weight, found_weight);
    if (!is_first && !is_better) return;
    is_first = false;
    found = value;
    found_weight = weight;
  });
  return found;
}

class ZoneComputer {
 public:
  ZoneComputer(const Remap& remap, std::span<const ZonalStatistic> statistics,
               const ZonalOptions& options)
      : remap_(remap), statistics_(statistics), options_(options) {
    is_sorted_ = std::ranges::any_of(
        statistics, [](const ZonalStatistic& s) { return needs_order(s.operation); });
  }

  // Computes the statistics of one zone; give(s, number) takes the number of statistic s. `memory` is
  // used for the values.
  template <class Give>
  void compute(std::size_t zone, std::span<const double> field, ZoneMemory& memory,
               const Give& give) const {
    auto& [values, slivers] = memory;
    values.clear();
    slivers.clear();
    const double size = remap_.target_areas[zone];
    double covered = 0;
    double with_value = 0;
    for (std::uint64_t k = remap_.pieces.offsets[zone]; k < remap_.pieces.offsets[zone + 1]; ++k) {
      const Index cell = remap_.pieces.values[k];
      const double area = remap_.areas[k];
      covered += area;
      if (std::isnan(field[cell])) continue;
      with_value += area;
      const double share = area / remap_.source_areas[cell];
      const bool is_by_area = options_.weights == ZonalWeights::area;
      const bool is_sliver = area < part_of_sliver * std::min(remap_.source_areas[cell], size);
      (is_sliver ? slivers : values).push_back({field[cell], is_by_area ? area : share, share});
    }
    if (values.empty()) std::swap(values, slivers);
    if (is_sorted_) std::ranges::sort(values, std::less<>());
    const std::size_t counted = values.size();
    values.insert(values.end(), slivers.begin(), slivers.end());
    const double fraction = size > 0 ? with_value / size : 0;
    const bool is_enough = !values.empty() &&
                           may_be_missing(size - covered, size, options_.max_missing) &&
                           may_be_missing(covered - with_value, covered, options_.max_missing);
    for (std::size_t s = 0; s < statistics_.size(); ++s) {
      const ZonalOperation operation = statistics_[s].operation;
      if (operation == ZonalOperation::fraction) {
        give(s, fraction);
      } else {
        const auto taken =
            std::span(values).first(takes_slivers(operation) ? values.size() : counted);
        give(s, is_enough || is_a_number_of_cells(operation) ? number_of(statistics_[s], taken)
                                                             : no_statistic);
      }
    }
  }

 private:
  // Returns a statistic of values, of which there may be none if it is a number of cells.
  static double number_of(const ZonalStatistic& statistic, std::span<const ZonalValue> values) {
    double sum = 0;
    switch (statistic.operation) {
      case ZonalOperation::mean:
        return mean_of(values);
      case ZonalOperation::variance:
        return variance_of(values);
      case ZonalOperation::stdev:
        return std::sqrt(variance_of(values));
      case ZonalOperation::median:
        return quantile_of(values, 0.5);
      case ZonalOperation::quantile:
        return quantile_of(values, statistic.quantile);
      case ZonalOperation::majority:
        return extreme_of(values, false);
      case ZonalOperation::minority:
        return extreme_of(values, true);
      case ZonalOperation::variety:
        return variety_of(values);
      case ZonalOperation::min:
        return std::ranges::min(values, {}, &ZonalValue::value).value;
      case ZonalOperation::max:
        return std::ranges::max(values, {}, &ZonalValue::value).value;
      case ZonalOperation::sum:
        for (const ZonalValue& v : values) sum += v.share * v.value;
        return sum;
      case ZonalOperation::count:
        for (const ZonalValue& v : values) sum += v.share;
        return sum;
      case ZonalOperation::fraction:
        break;  // which is not that of values
    }
    return no_statistic;
  }

  const Remap& remap_;
  std::span<const ZonalStatistic> statistics_;
  const ZonalOptions& options_;
  bool is_sorted_ = false;
};

// Throws InvalidInput if arguments do not fit together.
void require_arguments(const Remap& remap, std::span<const ZonalStatistic> statistics,
                       std::size_t in, std::size_t out, std::size_t num_fields,
                       const ZonalOptions& options) {
  const std::size_t sources = remap.source_areas.size();
  const std::size_t targets = remap.target_areas.size();
  if (remap.pieces.size() != targets || remap.areas.size() != remap.pieces.values.size()) {
    throw InvalidInput("the remapping has no pieces");
  }
  for (const ZonalStatistic& statistic : statistics) {
    if (statistic.operation > ZonalOperation::variety) throw InvalidInput("no statistic");
    if (statistic.quantile >= 0 && statistic.quantile <= 1) continue;
    throw InvalidInput("the quantile is " + system::shortest_text(statistic.quantile) +
                       ", not in [0, 1]");
  }
  if (!(options.max_missing >= 0 && options.max_missing <= 1)) {
    throw InvalidInput("max_missing is " + system::shortest_text(options.max_missing) +
                       ", not in [0, 1]");
  }
  std::size_t values = 0;
  std::size_t numbers = 0;
  const bool fits = system::multiply_checked(num_fields, sources, values) &&
                    system::multiply_checked(num_fields, targets, numbers) &&
                    system::multiply_checked(numbers, statistics.size(), numbers);
  if (!fits || in != values) {
    throw InvalidInput("there are " + std::to_string(in) + " values for " +
                       std::to_string(num_fields) + " fields of " + std::to_string(sources) +
                       " sources");
  }
  if (out != numbers) {
    throw InvalidInput("there is room for " + std::to_string(out) + " numbers where " +
                       std::to_string(numbers) + " are computed");
  }
}

}  // namespace
}  // namespace overlay

std::string_view name_of(ZonalOperation operation) noexcept {
  return system::name_in({"mean", "sum", "count", "min", "max", "fraction", "variance", "stdev",
                          "median", "quantile", "majority", "minority", "variety"},
                         operation);
}

std::string_view name_of(ZonalWeights weights) noexcept {
  return system::name_in({"area", "fraction"}, weights);
}

std::string ZonalStatistic::name() const {
  std::string text(name_of(operation));
  if (operation == ZonalOperation::quantile) text += '_' + system::shortest_text(quantile);
  return text;
}

void zonal_statistics(const Remap& remap, std::span<const ZonalStatistic> statistics,
                      std::span<const double> in, std::span<double> out, std::size_t num_fields,
                      const ZonalOptions& options, const Execution& execution) {
  const system::Call call(execution);
  overlay::require_arguments(remap, statistics, in.size(), out.size(), num_fields, options);
  const std::size_t sources = remap.source_areas.size();
  const std::size_t zones = remap.target_areas.size();
  const overlay::ZoneComputer computer(remap, statistics, options);
  constexpr std::size_t pieces_per_task = std::size_t{1} << 14U;
  const std::size_t zones_per_task =
      std::max<std::size_t>(1, zones * pieces_per_task / (remap.areas.size() + zones + 1));
  system::parallel_for(execution.threads, num_fields * zones, zones_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         overlay::ZoneMemory memory;
                         for (std::size_t n = begin; n < end; ++n) {
                           const std::size_t field = n / zones;
                           computer.compute(n % zones, in.subspan(field * sources, sources), memory,
                                            [&](std::size_t s, double number) {
                                              out[s * num_fields * zones + n] = number;
                                            });
                         }
                       });
}

}  // namespace rondel
