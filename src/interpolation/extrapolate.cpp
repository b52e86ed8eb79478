// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gives values to targets that have none: Extrapolator.
//
// in    places of both sides, values of fields or weights
// out   values or rows where there were none
// index sources and targets as given
//
// The gaps of a field decide: which sources have a value, and which targets need one. From these
// follow rows of weights (nearest, idw) or the levels of the targets (creep), which are kept for
// the next field with the same gaps.
#include "rondel/extrapolate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "interpolation/creep_levels.h"
#include "interpolation/settled_mean.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace {

bool is_place(const Point& p) { return dot(p, p) > 0; }

double squared_chord(const Point& a, const Point& b) { return dot(a - b, a - b); }

// More than the square of any chord, which is at most 4.
constexpr double any_square = 5;

// Returns the square of the chord that is so many kilometers along the sphere; more than any chord
// for half of the circumference or more.
double squared_chord_of(double distance_km) {
  const double half_deg = distance_km / kilometers_per_radian / 2 * exact::degrees_per_radian;
  if (!(half_deg < 90)) return any_square;
  const double half_chord = exact::sine_cosine_of_degrees(half_deg).sine;
  return 4 * half_chord * half_chord;
}

}  // namespace

namespace interpolation {

// Which sources have a value, and which targets get one.
struct ValueGaps {
  std::vector<bool> is_known;  // by source
  std::vector<bool>
      has_value;  // by target; those whose place is unknown may have none, and get none
  std::vector<bool> is_filled;  // by target: true if it needs a value and may have one
  friend bool operator==(const ValueGaps&, const ValueGaps&) = default;
};

}  // namespace interpolation

class Extrapolator::Impl {
 public:
  Impl(std::vector<Point> sources, std::vector<Point> targets, CompressedRows<Index> neighbors,
       const ExtrapolationOptions& options, std::vector<std::int32_t> source_mask,
       std::vector<std::int32_t> target_mask)
      : sources_(std::move(sources)),
        targets_(std::move(targets)),
        neighbors_(std::move(neighbors)),
        options_(options),
        source_mask_(std::move(source_mask)),
        target_mask_(std::move(target_mask)) {
    require("source_mask", source_mask_.size(), source_mask_.empty() ? 0 : sources_.size());
    require("target_mask", target_mask_.size(), target_mask_.empty() ? 0 : targets_.size());
    if (options.method == Extrapolation::creep) {
      require("neighbors", neighbors_.size(), targets_.size());
      for (const Index target : neighbors_.values) {
        if (target >= targets_.size()) throw InvalidInput("a neighbor is no target", target);
      }
    }
    if (options.max_distance_km && !(*options.max_distance_km >= 0)) {
      throw InvalidInput("max_distance_km is " + system::shortest_text(*options.max_distance_km) +
                         ", not 0 or more");
    }
    if (options.neighbors == 0) throw InvalidInput("neighbors is 0: one source is the least");
    if (options.exponent == 0 || options.exponent > 100) {
      throw InvalidInput("exponent is " + std::to_string(options.exponent) + ", not from 1 to 100");
    }
    if (options.max_distance_km) max_square_ = squared_chord_of(*options.max_distance_km);
  }

  std::size_t fill(std::span<const double> source_values, std::span<double> target_values,
                   const Execution& execution) {
    require("source_values", source_values.size(), sources_.size());
    require("target_values", target_values.size(), targets_.size());
    interpolation::ValueGaps gaps =
        gaps_of([&](std::size_t s) { return !std::isnan(source_values[s]); },
                [&](std::size_t t) { return !std::isnan(target_values[t]); });
    if (std::ranges::find(gaps.is_filled, true) == gaps.is_filled.end()) return 0;
    prepare(std::move(gaps), execution);
    std::size_t count = 0;
    if (options_.method == Extrapolation::creep) {
      for (const std::vector<Index>& level : levels_.filled()) {
        for (const Index target : level) {
          target_values[target] = interpolation::mean_of([&](const auto& visit) {
            levels_.for_each_giver(neighbors_, target,
                                   [&](Index giver) { visit(target_values[giver]); });
          });
          ++count;
        }
      }
      return count;
    }
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (rows_.offsets[t] == rows_.offsets[t + 1]) continue;
      double sum = 0;
      for (std::uint64_t k = rows_.offsets[t]; k < rows_.offsets[t + 1]; ++k) {
        sum += rows_.values[k] * source_values[rows_.columns[k]];
      }
      target_values[t] = interpolation::settled_mean(sum, [&](const auto& visit) {
        for (std::uint64_t k = rows_.offsets[t]; k < rows_.offsets[t + 1]; ++k) {
          visit(rows_.values[k], source_values[rows_.columns[k]]);
        }
      });
      ++count;
    }
    return count;
  }

  Weights filled(const Weights& weights, const Execution& execution) {
    require("weights", weights.num_rows(), targets_.size());
    require("columns", weights.num_columns, sources_.size());
    const auto has_row = [&](std::size_t t) {
      return weights.offsets[t] != weights.offsets[t + 1];
    };
    prepare(gaps_of([](std::size_t) { return true; }, has_row), execution);
    std::vector<std::int32_t> mask(targets_.size());
    for (std::size_t t = 0; t < mask.size(); ++t) mask[t] = has_row(t) ? 1 : 0;
    if (options_.method != Extrapolation::creep) return with_rows(weights, mask, &rows_);
    const Weights crept = levels_.rows(neighbors_, weights, sources_);
    return with_rows(weights, mask, &crept);
  }

 private:
  static void require(const char* name, std::size_t length, std::size_t wanted) {
    if (length == wanted) return;
    throw InvalidInput(std::string(name) + " has " + std::to_string(length) +
                       " numbers instead of " + std::to_string(wanted));
  }

  template <class IsKnown, class HasValue>
  [[nodiscard]] interpolation::ValueGaps gaps_of(const IsKnown& is_known,
                                                 const HasValue& has_value) const {
    interpolation::ValueGaps gaps{std::vector<bool>(sources_.size()),
                                  std::vector<bool>(targets_.size()),
                                  std::vector<bool>(targets_.size())};
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const bool is_masked = !source_mask_.empty() && source_mask_[s] == 0;
      gaps.is_known[s] = !is_masked && is_place(sources_[s]) && is_known(s);
    }
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      gaps.has_value[t] = has_value(t);
      gaps.is_filled[t] = takes_part(t) && is_place(targets_[t]) && !has_value(t);
    }
    return gaps;
  }
  [[nodiscard]] bool takes_part(std::size_t target) const {
    return target_mask_.empty() || target_mask_[target] != 0;
  }

  // Finds rows or levels for these gaps, unless they are those of the last call.
  void prepare(interpolation::ValueGaps gaps, const Execution& execution) {
    if (gaps_ && *gaps_ == gaps) return;
    gaps_.reset();
    if (options_.method == Extrapolation::creep) {
      std::vector<bool> may_fill = gaps.is_filled;
      if (max_square_ < any_square) leave_out_far(gaps, may_fill, execution);
      std::vector<bool> gives = gaps.has_value;
      for (std::size_t t = 0; t < gives.size(); ++t) gives[t] = gives[t] && takes_part(t);
      levels_ = interpolation::CreepLevels(neighbors_, gives, std::move(may_fill), options_.levels);
    } else {
      find_rows(gaps, execution);
    }
    gaps_ = std::move(gaps);
  }

  // The sources with values, and their numbers.
  struct KnownSources {
    std::vector<Index> numbers;
    std::optional<Triangulation> triangulation;
    std::optional<Locator> locator;
  };
  [[nodiscard]] KnownSources known_sources(const interpolation::ValueGaps& gaps,
                                           const Execution& execution) const {
    KnownSources known;
    std::vector<Point> points;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      if (!gaps.is_known[s]) continue;
      known.numbers.push_back(static_cast<Index>(s));
      points.push_back(sources_[s]);
    }
    known.triangulation = delaunay(points, {}, {.threads = execution.threads});
    known.locator.emplace(*known.triangulation);
    return known;
  }
  [[nodiscard]] std::vector<Index> targets_to_fill(const interpolation::ValueGaps& gaps) const {
    std::vector<Index> wanted;
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (gaps.is_filled[t]) wanted.push_back(static_cast<Index>(t));
    }
    return wanted;
  }
  [[nodiscard]] std::vector<Point> points_of(std::span<const Index> targets) const {
    std::vector<Point> points;
    points.reserve(targets.size());
    for (const Index target : targets) points.push_back(targets_[target]);
    return points;
  }

  void find_rows(const interpolation::ValueGaps& gaps, const Execution& execution) {
    rows_ = {};
    rows_.num_columns = sources_.size();
    const KnownSources known = known_sources(gaps, execution);
    const std::vector<Index> wanted = targets_to_fill(gaps);
    const bool is_nearest = options_.method == Extrapolation::nearest;
    const std::size_t k = std::min<std::size_t>(is_nearest ? 1 : options_.neighbors,
                                                std::max<std::size_t>(known.numbers.size(), 1));
    const std::vector<Index> found =
        known.locator->k_nearest(points_of(wanted), k, {.threads = execution.threads});
    std::size_t next = 0;
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (gaps.is_filled[t]) append_row(t, std::span(found).subspan(next++ * k, k), known.numbers);
      rows_.end_row();
    }
  }

  // Appends the entries of a target to the last row: the sources that are near enough, nearest
  // first.
  void append_row(std::size_t target, std::span<const Index> found,
                  const std::vector<Index>& numbers) {
    const std::size_t first = rows_.values.size();
    double sum = 0;
    for (const Index site : found) {
      if (site == no_index) break;
      const double square = squared_chord(sources_[numbers[site]], targets_[target]);
      if (square > max_square_) break;
      const bool is_alone = square == 0 || options_.method == Extrapolation::nearest;
      const double weight = is_alone ? 1 : inverse_power(square);
      rows_.columns.push_back(numbers[site]);
      rows_.values.push_back(weight);
      sum += weight;
      if (is_alone) break;
    }
    for (std::size_t k = first; k < rows_.values.size(); ++k) rows_.values[k] /= sum;
  }
  [[nodiscard]] double inverse_power(double square) const {
    // Sums of larger powers would overflow.
    const double inverse = 1 / std::sqrt(square);
    double power = 1;
    for (unsigned k = 0; k < options_.exponent; ++k) power *= inverse;
    return std::min(power, 0x1p900);
  }

  // Sets may_fill to false for targets whose nearest source with a value is too far.
  void leave_out_far(const interpolation::ValueGaps& gaps, std::vector<bool>& may_fill,
                     const Execution& execution) const {
    const KnownSources known = known_sources(gaps, execution);
    const std::vector<Index> wanted = targets_to_fill(gaps);
    const std::vector<Index> found =
        known.locator->nearest(points_of(wanted), {.threads = execution.threads});
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      may_fill[wanted[k]] =
          found[k] != no_index &&
          squared_chord(sources_[known.numbers[found[k]]], targets_[wanted[k]]) <= max_square_;
    }
  }

  std::vector<Point> sources_;
  std::vector<Point> targets_;
  CompressedRows<Index> neighbors_;
  ExtrapolationOptions options_;
  std::vector<std::int32_t> source_mask_;
  std::vector<std::int32_t> target_mask_;
  double max_square_ = any_square;
  std::optional<interpolation::ValueGaps> gaps_;  // those of rows_ or levels_
  Weights rows_;                                  // nearest, idw
  interpolation::CreepLevels levels_;             // creep
};

Extrapolator::Extrapolator(std::vector<Point> sources, std::vector<Point> targets,
                           CompressedRows<Index> neighbors, const ExtrapolationOptions& options,
                           std::vector<std::int32_t> source_mask,
                           std::vector<std::int32_t> target_mask)
    : impl_(std::make_unique<Impl>(std::move(sources), std::move(targets), std::move(neighbors),
                                   options, std::move(source_mask), std::move(target_mask))) {}
Extrapolator::~Extrapolator() = default;
Extrapolator::Extrapolator(Extrapolator&& other) noexcept = default;
Extrapolator& Extrapolator::operator=(Extrapolator&& other) noexcept = default;

std::size_t Extrapolator::fill(std::span<const double> source_values,
                               std::span<double> target_values, const Execution& execution) {
  const system::Call call(execution);
  return impl_->fill(source_values, target_values, execution);
}

Weights Extrapolator::filled(const Weights& weights, const Execution& execution) {
  const system::Call call(execution);
  return impl_->filled(weights, execution);
}

std::string_view name_of(Extrapolation method) noexcept {
  return system::name_in({"nearest", "idw", "creep"}, method);
}

std::optional<Extrapolation> extrapolation_named(std::string_view name) {
  constexpr std::array<std::string_view, 3> names_of_esmf = {"nearest_s2d", "inverse_dist",
                                                             "creep_fill"};
  for (std::size_t k = 0; k < names_of_esmf.size(); ++k) {
    const auto method = static_cast<Extrapolation>(k);
    if (name == name_of(method) || name == names_of_esmf[k]) return method;
  }
  return std::nullopt;
}

}  // namespace rondel
