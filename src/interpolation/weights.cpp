// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/weights.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "interpolation/settled_mean.h"
#include "interpolation/sum_of_present.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "system/row_assembly.h"
#include "system/wide_vectors.h"

namespace rondel {
namespace {

// The number of rows that one thread takes at a time.
constexpr std::size_t rows_per_piece = 8192;

// The constants of FNV-1a (http://www.isthe.com/chongo/tech/comp/fnv).
constexpr std::uint64_t fnv_offset = 0xcbf29ce484222325U;
constexpr std::uint64_t fnv_prime = 0x100000001b3U;

std::uint64_t hashed(std::uint64_t hash, double coordinate) {
  std::uint64_t bits = std::bit_cast<std::uint64_t>(coordinate + 0.0);  // -0 + 0 is 0
  for (int i = 0; i < 8; ++i, bits >>= 8U) hash = (hash ^ (bits & 0xffU)) * fnv_prime;
  return hash;
}

void require_length(std::string_view name, std::size_t length, std::size_t wanted) {
  if (length == wanted) return;
  throw InvalidInput(std::string(name) + " has " + std::to_string(length) + " numbers instead of " +
                     std::to_string(wanted));
}

// Returns the number of values of so many fields; throws InvalidInput if it overflows.
std::size_t product(std::size_t num_fields, std::size_t length) {
  if (length == 0 || num_fields <= std::numeric_limits<std::size_t>::max() / length)
    return num_fields * length;
  throw InvalidInput(std::to_string(num_fields) + " fields of " + std::to_string(length) +
                     " numbers are more than an array can hold");
}

void require_offsets(const Weights& weights) {
  const std::size_t num_entries = weights.columns.size();
  require_length("values", weights.values.size(), num_entries);
  const auto& offsets = weights.offsets;
  if (!system::are_offsets(offsets, num_entries)) {
    const auto row = std::ranges::is_sorted_until(offsets) - offsets.begin();
    if (offsets.empty() || offsets.front() != 0 || offsets.back() != num_entries) {
      throw InvalidInput("the offsets do not go from 0 to " + std::to_string(num_entries));
    }
    throw InvalidInput("the offsets decrease", static_cast<std::size_t>(row));
  }
}

// True if there are columns of these numbers.
bool are_columns(std::span<const Index> numbers, std::size_t num_columns) {
  Index largest = 0;
  // Compilers make vectors of this loop, and not of one that may end early.
  system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
    for (const Index number : numbers) largest = std::max(largest, number);
  });
  return numbers.empty() || largest < num_columns;
}

void require_columns(const Weights& weights) {
  if (are_columns(weights.columns, weights.num_columns)) return;
  const auto bad = std::ranges::find_if(
      weights.columns, [&](Index column) { return column >= weights.num_columns; });
  throw InvalidInput(
      "column " + std::to_string(*bad) + " of " + std::to_string(weights.num_columns),
      static_cast<std::size_t>(bad - weights.columns.begin()));
}

void require_rows(const Weights& weights) {
  require_offsets(weights);
  require_columns(weights);
}

void require_finite_weights(const Weights& weights) {
  for (std::size_t k = 0; k < weights.values.size(); ++k) {
    if (std::isfinite(weights.values[k])) continue;
    throw InvalidInput(
        "weight " + std::to_string(k) + " is " + system::shortest_text(weights.values[k]), k);
  }
}

bool are_finite(const Weights& weights, std::size_t row) {
  for (std::uint64_t k = weights.offsets[row]; k < weights.offsets[row + 1]; ++k) {
    if (!std::isfinite(weights.values[k])) return false;
  }
  return true;
}

double sum_of_present(const Weights& weights, std::size_t row, const double* in,
                      const ApplyOptions& options) {
  return interpolation::sum_of_present(
      [&](const auto& visit) {
        for (std::uint64_t k = weights.offsets[row]; k < weights.offsets[row + 1]; ++k) {
          visit(weights.values[k], in[weights.columns[k]]);
        }
      },
      options);
}

double settled_mean(const Weights& weights, std::size_t row, const double* in, double sum) {
  return interpolation::settled_mean(sum, [&](const auto& visit) {
    for (std::uint64_t k = weights.offsets[row]; k < weights.offsets[row + 1]; ++k) {
      visit(weights.values[k], in[weights.columns[k]]);
    }
  });
}

// The number of fields of which a row is summed at once: entries are loaded once for all of them, and
// their sums do not wait for each other. Sixteen take longer than eight.
constexpr std::size_t fields_together = 8;

// Some fields of the same length, one after the other.
template <class T>
struct FieldRun {
  T* begin;
  std::size_t length;
  [[nodiscard]] T* field(std::size_t f) const { return begin + f * length; }
};

// Returns a number that has the upper half of a weight, and below it a column. Bits of positive numbers are
// in the order of the numbers, so that the largest of a row has its largest weight but for 2^-20 of it.
std::int64_t weight_with_column(double weight, Index column) {
  constexpr std::uint64_t lower_half = 0xffffffff;
  return static_cast<std::int64_t>((std::bit_cast<std::uint64_t>(weight) & ~lower_half) | column);
}

// Applies some rows to so many fields. Returns false if a weight is not finite, of which no sum is.
// Precondition: the weights are valid, so that the loop over entries goes without checks.
template <std::size_t num_fields>
bool apply_rows(const Weights& weights, std::size_t begin, std::size_t end,
                const FieldRun<const double>& in, const FieldRun<double>& out,
                const ApplyOptions& options) {
  bool is_right = true;
  const std::uint64_t* const offsets = weights.offsets.data();
  const Index* const columns = weights.columns.data();
  const double* const values = weights.values.data();
  const std::size_t num_entries = weights.columns.size();
  for (std::size_t r = begin; r < end; ++r) {
    if (offsets[r] == offsets[r + 1]) {
      for (std::size_t f = 0; f < num_fields; ++f) out.field(f)[r] = options.fill;
      continue;
    }
    std::array<double, num_fields> sums{};
    std::int64_t largest = std::numeric_limits<std::int64_t>::min();
    for (std::uint64_t k = offsets[r]; k < offsets[r + 1]; ++k) {
      largest = std::max(largest, weight_with_column(values[k], columns[k]));
      const Index next = columns[std::min(k + system::prefetch_distance, num_entries - 1)];
      for (std::size_t f = 0; f < num_fields; ++f) {
        system::prefetch(in.field(f) + next);
        sums[f] += values[k] * in.field(f)[columns[k]];
      }
    }
    const auto main = static_cast<Index>(largest & 0xffffffff);
    // Branches that depend on values cost more than what they spare.
    unsigned is_any_special = 0;
    for (std::size_t f = 0; f < num_fields; ++f) {
      out.field(f)[r] = sums[f];
      is_any_special |= unsigned{interpolation::may_be_settled(sums[f], in.field(f)[main])};
    }
    if (is_any_special == 0) continue;
    for (std::size_t f = 0; f < num_fields; ++f) {
      if (!interpolation::may_be_settled(sums[f], in.field(f)[main])) continue;
      if (std::isfinite(sums[f])) {
        out.field(f)[r] = settled_mean(weights, r, in.field(f), sums[f]);
      } else {
        is_right = is_right && are_finite(weights, r);
        out.field(f)[r] = sum_of_present(weights, r, in.field(f), options);
      }
    }
  }
  return is_right;
}

// Applies some rows to all fields, several at a time.
bool apply_rows_to_all(const Weights& weights, std::size_t begin, std::size_t end,
                       std::span<const double> in, std::span<double> out, std::size_t num_fields,
                       const ApplyOptions& options) {
  bool is_right = true;
  const auto apply_to = [&](const auto& rows_of, std::size_t first) {
    const FieldRun<const double> from{in.data() + first * weights.num_columns, weights.num_columns};
    const FieldRun<double> to{out.data() + first * weights.num_rows(), weights.num_rows()};
    is_right = rows_of(weights, begin, end, from, to, options) && is_right;
  };
  std::size_t first = 0;
  for (; first + fields_together <= num_fields; first += fields_together) {
    apply_to(apply_rows<fields_together>, first);
  }
  constexpr std::size_t some = fields_together / 2;
  for (; first + some <= num_fields; first += some) apply_to(apply_rows<some>, first);
  for (; first < num_fields; ++first) apply_to(apply_rows<1>, first);
  return is_right;
}

// Throws InvalidInput unless apply() can multiply these fields by these weights, if all columns are
// there.
void require_application(const Weights& weights, std::span<const double> in,
                         std::span<const double> out, std::size_t num_fields,
                         const ApplyOptions& options) {
  require_offsets(weights);
  require_length("the input", in.size(), product(num_fields, weights.num_columns));
  require_length("the output", out.size(), product(num_fields, weights.num_rows()));
  if (!(options.max_missing >= 0 && options.max_missing <= 1)) {
    throw InvalidInput("max_missing is " + system::shortest_text(options.max_missing) +
                       ", not in [0, 1]");
  }
}

// Areas of pieces are exact to some 1e-13 of their cells; no two shares that are meant to differ are
// so close.
constexpr double rounding_of_shares = 1e-9;

// A value, and the part of a row's weights that has it.
struct ShareOfValue {
  double value;
  double weight;
};

// Returns the value that the largest part of a row's weights has. `shares` is memory.
double value_of_largest_share(const Weights& weights, std::size_t row, std::span<const double> in,
                              const ApplyOptions& options, std::vector<ShareOfValue>& shares) {
  shares.clear();
  double all = 0;
  double lacking = 0;
  for (std::uint64_t k = weights.offsets[row]; k < weights.offsets[row + 1]; ++k) {
    const double value = in[weights.columns[k]];
    const double weight = std::abs(weights.values[k]);
    all += weight;
    if (std::isnan(value)) {
      lacking += weight;
      continue;
    }
    const auto known = std::ranges::find(shares, value, &ShareOfValue::value);
    if (known == shares.end()) {
      shares.push_back({value, weight});
    } else {
      known->weight += weight;
    }
  }
  if (shares.empty() || !may_be_missing(lacking, all, options.max_missing)) return options.fill;
  // Equal areas of cells differ by rounding.
  const double largest = std::ranges::max(shares, {}, &ShareOfValue::weight).weight;
  double found = std::numeric_limits<double>::infinity();
  for (const ShareOfValue& share : shares) {
    if (!is_larger_share(largest, share.weight)) found = std::min(found, share.value);
  }
  return found;
}

// Throws InvalidInput for a number that is not below `limit`.
void require_numbers(std::string_view name, std::span<const Index> numbers, std::size_t limit) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k] < limit) continue;
    throw InvalidInput(std::string(name) + '[' + std::to_string(k) + "] is " +
                           std::to_string(numbers[k]) + " of " + std::to_string(limit),
                       k);
  }
}

// Appends a row, which is row r of `from`, to weights whose last row is complete.
void append_row(const Weights& from, std::size_t r, Weights& to) {
  const auto begin = static_cast<std::ptrdiff_t>(from.offsets[r]);
  const auto end = static_cast<std::ptrdiff_t>(from.offsets[r + 1]);
  to.columns.insert(to.columns.end(), from.columns.begin() + begin, from.columns.begin() + end);
  to.values.insert(to.values.end(), from.values.begin() + begin, from.values.begin() + end);
  to.end_row();
}

}  // namespace

std::uint64_t point_set_hash(std::span<const Point> points) {
  const system::ArithmeticScope arithmetic;
  std::uint64_t hash = fnv_offset;
  for (const Point& p : points) hash = hashed(hashed(hashed(hash, p.x), p.y), p.z);
  return hash == 0 ? 1 : hash;
}

bool may_be_missing(double missing, double all, double max_missing) noexcept {
  return missing <= (max_missing + rounding_of_shares) * all;
}

bool is_larger_share(double a, double b) noexcept { return a > b * (1 + rounding_of_shares); }

std::vector<std::int32_t> covered_enough(std::span<const double> fractions, double max_missing) {
  std::vector<std::int32_t> covered;
  covered.reserve(fractions.size());
  for (const double fraction : fractions) {
    const bool is_enough = fraction > 0 && may_be_missing(1 - fraction, 1, max_missing);
    covered.push_back(is_enough ? 1 : 0);
  }
  return covered;
}

void apply(const Weights& weights, std::span<const double> in, std::span<double> out,
           std::size_t num_fields, const ApplyOptions& options, const Execution& execution) {
  const system::Call call(execution);
  require_application(weights, in, out, num_fields, options);
  if (num_fields == 0) require_finite_weights(weights);
  std::atomic<bool> are_right = true;
  // All fields of some rows, as long as these rows are in the cache.
  system::parallel_for(
      execution.threads, weights.num_rows(), rows_per_piece,
      [&](std::size_t begin, std::size_t end) {
        const std::uint64_t first = weights.offsets[begin];
        const auto columns = std::span(weights.columns)
                                 .subspan(static_cast<std::size_t>(first),
                                          static_cast<std::size_t>(weights.offsets[end] - first));
        if (!are_columns(columns, weights.num_columns) ||
            !apply_rows_to_all(weights, begin, end, in, out, num_fields, options)) {
          are_right = false;
        }
      });
  if (are_right) return;
  require_columns(weights);
  require_finite_weights(weights);
}

void apply_largest_share(const Weights& weights, std::span<const double> in, std::span<double> out,
                         std::size_t num_fields, const ApplyOptions& options,
                         const Execution& execution) {
  const system::Call call(execution);
  require_application(weights, in, out, num_fields, options);
  require_columns(weights);
  require_finite_weights(weights);
  const std::size_t num_rows = weights.num_rows();
  system::parallel_for(
      execution.threads, num_rows, rows_per_piece, [&](std::size_t begin, std::size_t end) {
        std::vector<ShareOfValue> shares;
        for (std::size_t f = 0; f < num_fields; ++f) {
          const auto values = in.subspan(f * weights.num_columns, weights.num_columns);
          for (std::size_t r = begin; r < end; ++r) {
            out[f * num_rows + r] = value_of_largest_share(weights, r, values, options, shares);
          }
        }
      });
}

Weights renumbered(const Weights& weights, std::span<const Index> rows, std::size_t num_rows,
                   std::span<const Index> columns, std::size_t num_columns) {
  require_rows(weights);
  require_length("rows", rows.size(), weights.num_rows());
  require_length("columns", columns.size(), weights.num_columns);
  require_numbers("rows", rows, num_rows);
  require_numbers("columns", columns, num_columns);
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> former(num_rows, none);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (former[rows[r]] != none) {
      throw InvalidInput("row " + std::to_string(rows[r]) + " stands twice", r);
    }
    former[rows[r]] = r;
  }
  Weights result;
  result.num_columns = num_columns;
  result.offsets.reserve(num_rows + 1);
  result.columns.reserve(weights.columns.size());
  result.values.reserve(weights.values.size());
  for (const std::size_t r : former) {
    if (r == none) {
      result.end_row();
    } else {
      append_row(weights, r, result);
    }
  }
  for (Index& column : result.columns) column = columns[column];
  return result;
}

Weights with_rows(const Weights& weights, std::span<const std::int32_t> mask,
                  const Weights* others) {
  require_rows(weights);
  require_length("the mask", mask.size(), weights.num_rows());
  if (others != nullptr) {
    require_rows(*others);
    require_length("the mask", mask.size(), others->num_rows());
    if (others->num_columns != weights.num_columns) {
      throw InvalidInput("matrices of " + std::to_string(weights.num_columns) + " and " +
                         std::to_string(others->num_columns) + " columns");
    }
  }
  Weights result;
  result.num_columns = weights.num_columns;
  result.sites_hash = weights.sites_hash;
  result.targets_hash = weights.targets_hash;
  result.offsets.reserve(weights.offsets.size());
  for (std::size_t r = 0; r < mask.size(); ++r) {
    if (mask[r] != 0) {
      append_row(weights, r, result);
    } else if (others != nullptr) {
      append_row(*others, r, result);
    } else {
      result.end_row();
    }
  }
  return result;
}

Weights without_columns(const Weights& weights, std::span<const std::int32_t> mask) {
  require_rows(weights);
  require_length("the mask", mask.size(), weights.num_columns);
  std::vector<std::int32_t> is_kept(weights.num_rows(), 1);
  for (std::size_t r = 0; r < is_kept.size(); ++r) {
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      if (mask[weights.columns[k]] == 0) is_kept[r] = 0;
    }
  }
  return with_rows(weights, is_kept);
}

bool choose_values(const Weights& weights) {
  require_rows(weights);
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    std::size_t number = 0;
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      if (weights.values[k] == 0) continue;
      if (weights.values[k] != 1 || ++number > 1) return false;
    }
  }
  return true;
}

}  // namespace rondel
