// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// check_weights() takes one pass over the entries and one over the cells of each side.
#include "rondel/weight_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "interpolation/fault_counter.h"
#include "interpolation/weight_method.h"
#include "rondel/delaunay.h"

namespace rondel {
namespace interpolation {
namespace {

class WeightChecker {
 public:
  WeightChecker(const WeightFile& file, const WeightCheckOptions& options)
      : file_(file),
        weights_(file.weights),
        method_(file.method.empty() && options.is_conservative ? "conservative" : file.method),
        allow_negative_(options.allow_negative || !method_.is_never_negative),
        may_give_repeatedly_(options.targets_overlap) {
    report_.sums_are_of_columns = method_.gives_sources_away;
    report_.sums_are_fractions = file.normalization == "destarea" &&
                                 !file.target.fractions.empty() && !method_.gives_sources_away;
    // The part of a target that lies outside of the sources is not known.
    is_at_most_wanted_ = method_.is_conservative && file.target.fractions.empty() &&
                         file.normalization != "fracarea";
    report_.sums_are_at_most_1 = is_at_most_wanted_ && !method_.gives_sources_away;
    const std::string wanted = is_at_most_wanted_           ? "more than 1"
                               : report_.sums_are_fractions ? "the fraction of the target"
                                                            : "something else than 1";
    const bool is_negated = report_.sums_are_fractions;
    row_sums_ = FaultCounter("row sum",
                             (is_negated ? "row does not sum up to " : "row sums up to ") + wanted,
                             (is_negated ? "rows do not sum up to " : "rows sum up to ") + wanted);
  }

  WeightReport run() {
    check_rows();
    if (method_.gives_sources_away) check_sums_of_columns();
    check_columns();
    check_side("target", file_.target, entries_of_rows());
    check_side("source", file_.source, entries_of_column_);
    check_masks();
    check_numbers();
    for (const FaultCounter& faults :
         {not_finite_, repeated_, negative_, row_sums_, column_sums_, missing_}) {
      faults.move_to(report_.faults);
    }
    std::ranges::move(side_faults_, std::back_inserter(report_.faults));
    conservation_.move_to(report_.faults);
    report_.worst_direction = worst_direction();
    return std::move(report_);
  }

 private:
  [[nodiscard]] std::string place_of(std::size_t row, std::uint64_t k) const {
    return "target " + std::to_string(row) + ", source " + std::to_string(weights_.columns[k]);
  }

  void check_numbers() {
    for (const auto& [side, word] :
         {std::pair(&file_.source, "source"), {&file_.target, "target"}}) {
      if (!side->counts_from_zero) continue;
      report_.faults.push_back({"numbering", 1,
                                std::string("the numbers of ") + word +
                                    "s count from 0, where the format counts from 1"});
    }
  }

  void check_rows() {
    std::vector<std::size_t> last_row(weights_.num_columns);
    entries_of_column_.assign(weights_.num_columns, 0);
    for (std::size_t row = 0; row < weights_.num_rows(); ++row) check_row(row, last_row);
  }

  void check_row(std::size_t row, std::vector<std::size_t>& last_row) {
    const std::uint64_t begin = weights_.offsets[row];
    const std::uint64_t end = weights_.offsets[row + 1];
    const double tolerance = tolerance_of(end - begin, file_.target.areas, row);
    const double wanted = report_.sums_are_fractions ? file_.target.fractions[row] : 1;
    if (begin == end) {
      ++report_.empty_rows;
      const std::vector<double>& fractions = file_.target.fractions;
      const double fraction = fractions.empty() ? 0 : fractions[row];
      if (method_.is_conservative && std::abs(fraction) > tolerance) {
        missing_.add("target " + std::to_string(row), fraction);
      }
      return;
    }
    double sum = 0;
    for (std::uint64_t k = begin; k < end; ++k) {
      const double weight = weights_.values[k];
      sum += weight;
      if (!std::isfinite(weight)) not_finite_.add(place_of(row, k), weight);
      if (!allow_negative_ && weight < -tolerance) negative_.add(place_of(row, k), weight);
      report_.least = k == 0 ? weight : std::min(report_.least, weight);
      report_.greatest = k == 0 ? weight : std::max(report_.greatest, weight);
      std::size_t& last = last_row[weights_.columns[k]];
      if (last == row + 1) repeated_.add(place_of(row, k), weight);
      last = row + 1;
      ++entries_of_column_[weights_.columns[k]];
    }
    if (method_.gives_sources_away) return;
    const double deviation =
        is_at_most_wanted_ ? std::max(sum - wanted, 0.0) : std::abs(sum - wanted);
    report_.worst_row = std::max(report_.worst_row, deviation);
    report_.min_row = std::min(report_.min_row.value_or(sum), sum);
    if (!(deviation <= tolerance)) row_sums_.add("target " + std::to_string(row), sum);
  }

  void check_sums_of_columns() {
    std::vector<double> sums(weights_.num_columns);
    for (std::size_t k = 0; k < weights_.values.size(); ++k) {
      sums[weights_.columns[k]] += weights_.values[k];
    }
    for (std::size_t c = 0; c < sums.size(); ++c) {
      if (entries_of_column_[c] == 0) continue;
      const double deviation = std::abs(sums[c] - 1);
      report_.worst_row = std::max(report_.worst_row, deviation);
      if (!(deviation <= min_tolerance)) column_sums_.add("source " + std::to_string(c), sums[c]);
    }
  }

  // A cell that shares pieces with cells that have areas must have an area too.
  void check_areas_of_one_side() {
    if (!method_.is_conservative) return;
    const bool is_of_targets = file_.target.areas.empty();
    const std::string word = is_of_targets ? "target" : "source";
    FaultCounter faults(word + " area", "area of a " + word + " with entries is 0",
                        "areas of " + word + "s with entries are 0");
    const std::vector<std::size_t> entries = is_of_targets ? entries_of_rows() : entries_of_column_;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i] > 0) faults.add(word + ' ' + std::to_string(i), 0);
    }
    faults.move_to(side_faults_);
  }

  // The area that all targets take of a source is the part of the source that they cover.
  void check_columns() {
    const std::vector<double>& to = file_.target.areas;
    const std::vector<double>& from = file_.source.areas;
    if (to.empty() != from.empty()) check_areas_of_one_side();
    if (to.empty() || from.empty()) return;
    std::vector<double> taken(weights_.num_columns);
    for (std::size_t r = 0; r < weights_.num_rows(); ++r) {
      const bool is_shared = file_.normalization == "fracarea" && !file_.target.fractions.empty();
      const double area = to[r] * (is_shared ? file_.target.fractions[r] : 1);
      for (std::uint64_t k = weights_.offsets[r]; k < weights_.offsets[r + 1]; ++k) {
        taken[weights_.columns[k]] += weights_.values[k] * area;
      }
    }
    report_.worst_column = 0;
    for (std::size_t c = 0; c < taken.size(); ++c) {
      if (!(from[c] > 0)) continue;
      const std::vector<double>& fractions = file_.source.fractions;
      const double given = taken[c] / from[c];
      const double wanted = fractions.empty() ? 1 : fractions[c];
      report_.worst_column = std::max(*report_.worst_column, std::abs(given - wanted));
      const double tolerance = tolerance_of(entries_of_column_[c], from, c);
      const bool is_right = fractions.empty() ? may_give_repeatedly_ || given <= 1 + tolerance
                                              : std::abs(given - wanted) <= tolerance;
      if (method_.is_conservative && !is_right) {
        conservation_.add("source " + std::to_string(c), given);
      }
    }
  }

  [[nodiscard]] std::vector<std::size_t> entries_of_rows() const {
    std::vector<std::size_t> entries;
    for (std::size_t r = 0; r < weights_.num_rows(); ++r) {
      entries.push_back(weights_.offsets[r + 1] - weights_.offsets[r]);
    }
    return entries;
  }

  void check_side(const std::string& word, const WeightSide& side,
                  const std::vector<std::size_t>& entries) {
    FaultCounter above(word + " fraction", "fraction of a " + word + " is above 1",
                       "fractions of " + word + "s are above 1");
    FaultCounter below(word + " fraction", "fraction of a " + word + " is negative or not a number",
                       "fractions of " + word + "s are negative or not numbers");
    for (std::size_t i = 0; i < side.fractions.size(); ++i) {
      const double tolerance = tolerance_of(entries[i], side.areas, i);
      const std::string place = word + ' ' + std::to_string(i);
      const bool may_be_above = word == "source" && may_give_repeatedly_;
      if (side.fractions[i] > 1 + tolerance && !may_be_above) {
        above.add(place, side.fractions[i]);
      } else if (!(side.fractions[i] >= -tolerance)) {
        below.add(place, side.fractions[i]);
      }
    }
    FaultCounter areas(word + " area", "area of a " + word + " is negative or not finite",
                       "areas of " + word + "s are negative or not finite");
    for (std::size_t i = 0; i < side.areas.size(); ++i) {
      if (side.areas[i] >= 0 && std::isfinite(side.areas[i])) continue;
      areas.add(word + ' ' + std::to_string(i), side.areas[i]);
    }
    for (const FaultCounter& faults : {above, below, areas}) faults.move_to(side_faults_);
  }

  // A masked cell takes no part, so that it has no weight but 0.
  void check_masks() {
    FaultCounter targets("masked target", "weight is of a masked target",
                         "weights are of masked targets");
    FaultCounter sources("masked source", "weight is of a masked source",
                         "weights are of masked sources");
    const auto is_masked = [](const WeightSide& side, std::size_t cell) {
      return !side.mask.empty() && side.mask[cell] == 0;
    };
    for (std::size_t r = 0; r < weights_.num_rows(); ++r) {
      for (std::uint64_t k = weights_.offsets[r]; k < weights_.offsets[r + 1]; ++k) {
        if (weights_.values[k] == 0) continue;
        if (is_masked(file_.target, r)) targets.add(place_of(r, k), weights_.values[k]);
        if (is_masked(file_.source, weights_.columns[k])) {
          sources.add(place_of(r, k), weights_.values[k]);
        }
      }
    }
    for (const FaultCounter& faults : {targets, sources}) faults.move_to(side_faults_);
  }

  [[nodiscard]] std::optional<double> worst_direction() const {
    const auto are_places = [](const std::vector<LonLat>& points) {
      return !points.empty() && std::ranges::all_of(points, [](const LonLat& place) {
        return std::isfinite(place.lon_deg) && std::abs(place.lat_deg) <= 90;
      });
    };
    if (!are_places(file_.source.points) || !are_places(file_.target.points)) return std::nullopt;
    const std::vector<Point> sources = unit_vectors(file_.source.points);
    const std::vector<Point> targets = unit_vectors(file_.target.points);
    double worst = 0;
    for (std::size_t r = 0; r < weights_.num_rows(); ++r) {
      Point sum;
      for (std::uint64_t k = weights_.offsets[r]; k < weights_.offsets[r + 1]; ++k) {
        const Point& x = sources[weights_.columns[k]];
        sum.x += weights_.values[k] * x.x;
        sum.y += weights_.values[k] * x.y;
        sum.z += weights_.values[k] * x.z;
      }
      const Point& u = targets[r];
      const double x = u.y * sum.z - u.z * sum.y;
      const double y = u.z * sum.x - u.x * sum.z;
      const double z = u.x * sum.y - u.y * sum.x;
      worst = std::max(worst, std::sqrt(x * x + y * y + z * z));
    }
    return worst;
  }

  const WeightFile& file_;
  const Weights& weights_;
  MethodFacts method_;
  bool allow_negative_;
  bool may_give_repeatedly_;        // sources, to targets that overlap
  bool is_at_most_wanted_ = false;  // each sum is a fraction that is not known
  WeightReport report_;
  std::vector<std::size_t> entries_of_column_;
  std::vector<WeightFault> side_faults_;
  FaultCounter not_finite_{"not finite", "weight is not finite", "weights are not finite"};
  FaultCounter repeated_{"repeated", "entry repeats a source of its row",
                         "entries repeat a source of their row"};
  FaultCounter negative_{"negative", "weight is negative", "weights are negative"};
  FaultCounter row_sums_{"row sum", "", ""};
  FaultCounter column_sums_{"column sum", "source is not given away as a whole, once",
                            "sources are not given away as a whole, once"};
  FaultCounter missing_{"missing row", "target has a fraction and no weight",
                        "targets have a fraction and no weight"};
  FaultCounter conservation_{"conservation",
                             "source does not give away its area times its fraction",
                             "sources do not give away their area times their fraction"};
};

}  // namespace
}  // namespace interpolation

std::size_t WeightReport::count(const std::string& kind) const {
  std::size_t sum = 0;
  for (const WeightFault& fault : faults) sum += fault.kind == kind ? fault.count : 0;
  return sum;
}

WeightReport check_weights(const WeightFile& file, const WeightCheckOptions& options) {
  return interpolation::WeightChecker(file, options).run();
}

}  // namespace rondel
