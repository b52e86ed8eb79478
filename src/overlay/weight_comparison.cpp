// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// compare_weights() merges each row of a file with the row of pieces of the same target. Which
// normalization the file has is found first, from the sums of rows.
#include "rondel/weight_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "interpolation/fault_counter.h"
#include "interpolation/weight_method.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace overlay {
namespace {

using interpolation::FaultCounter;

// Returns a mask with the zeros of both; empty if neither masks anything.
std::vector<std::int32_t> common_mask(const std::vector<std::int32_t>& of_cells,
                                      const std::vector<std::int32_t>& of_file) {
  if (of_cells.empty()) return of_file;
  std::vector<std::int32_t> both = of_cells;
  for (std::size_t i = 0; i < of_file.size(); ++i) both[i] = both[i] != 0 && of_file[i] != 0;
  return both;
}

// Throws InvalidInput if the cells of a side are not as many as the file has.
void require_sizes(const WeightFile& file, const CellSet& source, const CellSet& target) {
  const std::size_t rows = file.weights.num_rows();
  const std::size_t columns = file.weights.num_columns;
  if (columns == source.num_cells() && rows == target.num_cells()) return;
  const bool are_exchanged = columns == target.num_cells() && rows == source.num_cells();
  throw InvalidInput("the weights are from " + std::to_string(columns) + " sources to " +
                     std::to_string(rows) + " targets, the cells are " +
                     std::to_string(source.num_cells()) + " sources and " +
                     std::to_string(target.num_cells()) + " targets" +
                     (are_exchanged ? ": source and target are exchanged" : ""));
}

// Returns how often the place that a file has for a cell is farther from the cell's center than any
// place of a cell that is about as wide as long.
void count_places(const std::vector<LonLat>& given, const CellSet& cells, const std::string& word,
                  std::vector<WeightFault>& faults) {
  if (given.empty()) return;
  const std::vector<Point> centers = cells.centers();
  const std::span<const double> areas = cells.areas();
  const std::vector<LonLat> places = cells.places();
  std::size_t looked_at = 0;
  std::size_t outside = 0;
  std::string first;
  const auto text_of = [](const LonLat& place) {
    return system::shortest_text(place.lon_deg) + ", " + system::shortest_text(place.lat_deg);
  };
  for (std::size_t i = 0; i < given.size(); ++i) {
    const bool is_place = std::isfinite(given[i].lon_deg) && std::abs(given[i].lat_deg) <= 90;
    if (!is_place || !(areas[i] > 0)) continue;
    ++looked_at;
    const Point apart = unit_vector(given[i]) - centers[i];
    if (dot(apart, apart) <= 4 * areas[i]) continue;
    if (outside++ == 0) {
      first = word + ' ' + std::to_string(i) + ": " + text_of(given[i]) + " instead of " +
              text_of(places[i]);
    }
  }
  if (2 * outside <= looked_at) return;
  faults.push_back({word + " place", outside,
                    std::to_string(outside) + " of " + std::to_string(looked_at) + " places of " +
                        word + "s are not in their cells (first " + first + ")"});
}

// Returns an error; infinity for one that is not a number.
double known_error(double error) {
  if (std::isfinite(error)) return error;
  return std::numeric_limits<double>::infinity();
}

// Returns the largest relative difference between areas in a file and those of cells.
std::optional<double> apart(const std::vector<double>& given, const std::vector<double>& exact) {
  if (given.empty()) return std::nullopt;
  double most = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (exact[i] > 0) most = std::max(most, std::abs(given[i] - exact[i]) / exact[i]);
  }
  return most;
}

class WeightComparer {
 public:
  WeightComparer(const WeightFile& file, const Remap& exact, const WeightComparisonOptions& options)
      : file_(file),
        weights_(file.weights),
        exact_(exact),
        options_(options),
        covered_(weights_.num_rows()) {
    for (std::size_t j = 0; j < covered_.size(); ++j) {
      for (std::uint64_t k = pieces_begin(j); k < pieces_begin(j + 1); ++k) {
        covered_[j] += exact.areas[k];
      }
    }
    report_.are_sums = interpolation::MethodFacts(file.method).is_second_order;
    report_.pieces = exact.areas.size();
  }

  WeightComparison run() {
    find_norm();
    for (std::size_t row = 0; row < weights_.num_rows(); ++row) {
      if (report_.are_sums) {
        look_for_pieces(row);
      } else {
        compare_row(row);
      }
      compare_sum(row);
    }
    finish_errors();
    compare_columns();
    for (const FaultCounter& faults : {missing_, needless_, wrong_, row_sums_, conservation_}) {
      faults.move_to(report_.faults);
    }
    compare_numbering();
    report_.source_areas = apart(file_.source.areas, exact_.source_areas);
    report_.target_areas = apart(file_.target.areas, exact_.target_areas);
    count_places(file_.target.points, exact_.target, "target", report_.faults);
    count_places(file_.source.points, exact_.source, "source", report_.faults);
    return std::move(report_);
  }

 private:
  using Entry = std::pair<Index, double>;

  [[nodiscard]] std::uint64_t pieces_begin(std::size_t row) const {
    return exact_.pieces.offsets[row];
  }
  // Returns what the areas of a row's pieces are divided by.
  [[nodiscard]] double divisor(std::size_t row) const {
    if (report_.norm == WeightNorm::area) return 1;
    return report_.norm == WeightNorm::fracarea ? covered_[row] : exact_.target_areas[row];
  }
  [[nodiscard]] double exact_sum(std::size_t row) const {
    return covered_[row] > 0 ? covered_[row] / divisor(row) : 0;
  }
  [[nodiscard]] double sum_of(std::size_t row) const {
    double sum = 0;
    for (std::uint64_t k = weights_.offsets[row]; k < weights_.offsets[row + 1]; ++k) {
      sum += weights_.values[k];
    }
    return sum;
  }
  [[nodiscard]] double tolerance(std::size_t row, std::size_t entries) const {
    return interpolation::tolerance_of(entries, exact_.target_areas, row, options_.tolerance);
  }

  // Finds the normalization that most rows have, and adds a fault if the file says another one.
  // A row votes for the sum that is nearest to its own, if that is not more than a tenth away.
  void find_norm() {
    constexpr double same = 1e-6;
    constexpr double near = 0.1;
    std::size_t of_dest = 0;
    std::size_t of_frac = 0;
    std::size_t of_area = 0;
    std::size_t of_either = 0;
    for (std::size_t row = 0; row < weights_.num_rows(); ++row) {
      if (!(covered_[row] > 0) || weights_.offsets[row] == weights_.offsets[row + 1]) continue;
      const double sum = sum_of(row);
      const double share = covered_[row] / exact_.target_areas[row];
      const double dest = std::abs(sum - share) / share;
      const double frac = std::abs(sum - 1);
      const double area = std::abs(sum - covered_[row]) / covered_[row];
      if (!(std::min({dest, frac, area}) <= near)) continue;
      if (area < dest && area < frac) {
        ++of_area;
      } else if (std::abs(share - 1) <= same) {
        ++of_either;
      } else {
        ++(dest <= frac ? of_dest : of_frac);
      }
    }
    if (of_area > of_dest + of_frac + of_either) {
      report_.norm = WeightNorm::area;
    } else if (of_dest + of_frac > 0) {
      report_.norm = of_dest >= of_frac ? WeightNorm::destarea : WeightNorm::fracarea;
    } else if (of_either > 0) {
      report_.norm = WeightNorm::either;
    }
    judge_norm(std::max({of_area, of_dest, of_frac}));
  }
  void judge_norm(std::size_t rows) {
    const std::string& said = file_.normalization;
    const bool is_share =
        report_.norm == WeightNorm::destarea || report_.norm == WeightNorm::fracarea;
    const bool is_said = said == "destarea" || said == "fracarea";
    const bool is_wrong = report_.norm == WeightNorm::area
                              ? said != "none"
                              : is_share && is_said && said != name_of(report_.norm);
    if (!is_wrong) return;
    report_.faults.push_back({"normalization", rows,
                              "the file says " + (said.empty() ? std::string("nothing") : said) +
                                  " of the normalization, but the weights have " +
                                  std::string(name_of(report_.norm)) +
                                  " (rows that tell it: " + std::to_string(rows) + ")"});
  }

  // Calls visit(compared) for each source that a row of the file or the pieces of a target have;
  // the numbers of the file's sources are moved by `shift`.
  template <class Visit>
  void merge(std::size_t row, std::size_t exact_row, std::int64_t shift, const Visit& visit) {
    entries_.clear();
    for (std::uint64_t k = weights_.offsets[row]; k < weights_.offsets[row + 1]; ++k) {
      const std::int64_t column = std::int64_t{weights_.columns[k]} + shift;
      if (column >= 0) entries_.emplace_back(static_cast<Index>(column), weights_.values[k]);
    }
    std::ranges::stable_sort(entries_, {}, &Entry::first);
    std::uint64_t piece = pieces_begin(exact_row);
    const std::uint64_t end = pieces_begin(exact_row + 1);
    const double by = divisor(exact_row);
    for (std::size_t e = 0; e < entries_.size() || piece < end;) {
      const Index given = e < entries_.size() ? entries_[e].first : no_index;
      const Index wanted = piece < end ? exact_.pieces.values[piece] : no_index;
      ComparedWeight compared{static_cast<Index>(exact_row), std::min(given, wanted), 0, 0};
      for (; e < entries_.size() && entries_[e].first == compared.source; ++e) {
        compared.given += entries_[e].second;
      }
      if (wanted == compared.source) compared.exact = exact_.areas[piece++] / by;
      visit(compared);
    }
  }
  // Returns how far a weight is off; infinity for one that is not finite.
  static double error_of(const ComparedWeight& compared) {
    return known_error(std::abs(compared.given - compared.exact));
  }

  void compare_row(std::size_t row) {
    const std::uint64_t entries = std::max(weights_.offsets[row + 1] - weights_.offsets[row],
                                           pieces_begin(row + 1) - pieces_begin(row));
    const double allowed = tolerance(row, entries);
    ComparedRow found;
    double worst = -1;
    merge(row, row, 0, [&](const ComparedWeight& compared) {
      const double error = error_of(compared);
      count_error(error);
      found.error += error;
      if (error > worst) {
        worst = error;
        found.worst = compared;
      }
      if (error <= allowed) return;
      ++found.wrong;
      FaultCounter& faults = compared.exact == 0   ? needless_
                             : compared.given == 0 ? missing_
                                                   : wrong_;
      faults.add("target " + std::to_string(row) + ", source " + std::to_string(compared.source),
                 compared.given, compared.exact);
    });
    if (found.wrong == 0) return;
    found.target = static_cast<Index>(row);
    found.sum = sum_of(row);
    found.exact_sum = exact_sum(row);
    report_.worst_rows.push_back(found);
  }
  // Each source that overlaps the target has an entry of order 2, too; others may have one.
  void look_for_pieces(std::size_t row) {
    const std::uint64_t entries = weights_.offsets[row + 1] - weights_.offsets[row];
    const double allowed = tolerance(row, entries);
    merge(row, row, 0, [&](const ComparedWeight& compared) {
      if (!(compared.exact > allowed)) return;
      const auto at = std::ranges::lower_bound(entries_, compared.source, {}, &Entry::first);
      if (at != entries_.end() && at->first == compared.source) return;
      missing_.add("target " + std::to_string(row) + ", source " + std::to_string(compared.source),
                   compared.given, compared.exact);
    });
  }
  void count_error(double error) {
    ++num_compared_;
    report_.max_error = std::max(report_.max_error, error);
    sum_of_errors_ += error;
    sum_of_squares_ += error * error;
    std::size_t bin = 0;
    while (bin + 1 < ErrorDistribution::num_bins && error >= ErrorDistribution::end_of(bin)) ++bin;
    ++report_.errors.counts[bin];
  }
  void compare_sum(std::size_t row) {
    if (weights_.offsets[row] == weights_.offsets[row + 1] && !(covered_[row] > 0)) return;
    const double sum = sum_of(row);
    const double error = std::abs(sum - exact_sum(row));
    report_.row_sums = std::max(report_.row_sums, known_error(error));
    const std::size_t entries = weights_.offsets[row + 1] - weights_.offsets[row];
    if (report_.are_sums && !(error <= tolerance(row, entries))) {
      row_sums_.add("target " + std::to_string(row), sum, exact_sum(row));
    }
  }
  void finish_errors() {
    if (num_compared_ > 0) {
      const auto n = static_cast<double>(num_compared_);
      report_.mean_error = sum_of_errors_ / n;
      report_.rms_error = std::sqrt(sum_of_squares_ / n);
    }
    const std::size_t kept = std::min(options_.max_rows, report_.worst_rows.size());
    const auto order = [](const ComparedRow& row) { return std::pair(-row.error, row.target); };
    std::ranges::partial_sort(report_.worst_rows,
                              report_.worst_rows.begin() + static_cast<std::ptrdiff_t>(kept), {},
                              order);
    report_.worst_rows.resize(kept);
    if (kept == 0) return;
    const std::vector<LonLat> places = exact_.target.places();
    for (ComparedRow& row : report_.worst_rows) row.place = places[row.target];
  }

  // Compares the area that each source gives away with that which targets cover of it.
  void compare_columns() {
    std::vector<double> given(weights_.num_columns);
    std::vector<double> wanted(weights_.num_columns);
    std::vector<std::size_t> entries(weights_.num_columns);
    for (std::size_t row = 0; row < weights_.num_rows(); ++row) {
      for (std::uint64_t k = weights_.offsets[row]; k < weights_.offsets[row + 1]; ++k) {
        given[weights_.columns[k]] += weights_.values[k] * divisor(row);
        ++entries[weights_.columns[k]];
      }
      for (std::uint64_t k = pieces_begin(row); k < pieces_begin(row + 1); ++k) {
        wanted[exact_.pieces.values[k]] += exact_.areas[k];
      }
    }
    double all_given = 0;
    double all_wanted = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      all_given += given[i];
      all_wanted += wanted[i];
      if (!(exact_.source_areas[i] > 0)) continue;
      const double error = std::abs(given[i] - wanted[i]) / exact_.source_areas[i];
      report_.local_conservation = std::max(report_.local_conservation, known_error(error));
      const double allowed =
          interpolation::tolerance_of(entries[i], exact_.source_areas, i, options_.tolerance);
      if (report_.are_sums && !(error <= allowed)) {
        conservation_.add("source " + std::to_string(i), given[i], wanted[i]);
      }
    }
    if (all_wanted > 0) {
      report_.global_conservation = known_error(std::abs(all_given - all_wanted) / all_wanted);
    }
  }

  // Looks for rows or columns whose numbers are one too large or too small, if more than a tenth of
  // the weights are wrong.
  void compare_numbering() {
    const std::size_t wrong = missing_.count() + needless_.count() + wrong_.count();
    if (report_.are_sums || 10 * wrong <= num_compared_) return;
    for (const std::int64_t of_rows : {0, -1, 1}) {
      for (const std::int64_t of_columns : {0, -1, 1}) {
        if (of_rows == 0 && of_columns == 0) continue;
        if (10 * count_wrong(of_rows, of_columns) > wrong) continue;
        std::string text = "with ";
        const auto add = [&](std::int64_t shift, const char* word) {
          if (shift == 0) return;
          text += std::string(text == "with " ? "" : " and ") + word + " numbers one " +
                  (shift > 0 ? "larger" : "smaller");
        };
        add(of_columns, "source");
        add(of_rows, "target");
        report_.faults.push_back({"numbering", 1, text + " most weights would be right"});
        return;
      }
    }
  }
  // Returns how many weights would be wrong if the numbers of rows and columns were moved.
  std::size_t count_wrong(std::int64_t of_rows, std::int64_t of_columns) {
    std::size_t wrong = 0;
    const auto num_rows = static_cast<std::int64_t>(weights_.num_rows());
    for (std::int64_t row = 0; row < num_rows; ++row) {
      const std::int64_t exact_row = row + of_rows;
      if (exact_row < 0 || exact_row >= num_rows) continue;
      const auto at = static_cast<std::size_t>(exact_row);
      const double allowed = tolerance(at, pieces_begin(at + 1) - pieces_begin(at));
      merge(static_cast<std::size_t>(row), at, of_columns, [&](const ComparedWeight& compared) {
        wrong += error_of(compared) <= allowed ? 0 : 1;
      });
    }
    return wrong;
  }

  const WeightFile& file_;
  const Weights& weights_;
  const Remap& exact_;
  const WeightComparisonOptions& options_;
  std::vector<double> covered_;  // the area of each target that sources cover
  std::vector<Entry> entries_;   // of one row
  WeightComparison report_;
  std::size_t num_compared_ = 0;
  double sum_of_errors_ = 0;
  double sum_of_squares_ = 0;
  FaultCounter missing_{"missing piece", "piece has no weight", "pieces have no weight"};
  FaultCounter needless_{"needless weight", "weight is of cells without a common area",
                         "weights are of cells without a common area"};
  FaultCounter wrong_{"wrong weight", "weight is wrong", "weights are wrong"};
  FaultCounter row_sums_{"row sum", "row has another sum", "rows have other sums"};
  FaultCounter conservation_{"conservation", "source gives away another area",
                             "sources give away other areas"};
};

}  // namespace
}  // namespace overlay

std::string_view name_of(WeightNorm norm) noexcept {
  return system::name_in({"unknown", "either", "destarea", "fracarea", "area"}, norm);
}

double ErrorDistribution::end_of(std::size_t bin) {
  constexpr std::array<double, num_bins - 1> ends = {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11,
                                                     1e-10, 1e-9,  1e-8,  1e-7,  1e-6,  1e-5,
                                                     1e-4,  1e-3,  1e-2,  1e-1,  1};
  return bin < ends.size() ? ends[bin] : std::numeric_limits<double>::infinity();
}

std::size_t WeightComparison::count(std::string_view kind) const {
  std::size_t sum = 0;
  for (const WeightFault& fault : faults) sum += fault.kind == kind ? fault.count : 0;
  return sum;
}

WeightComparison compare_weights(const WeightFile& file, const CellSet& source,
                                 const CellSet& target, const WeightComparisonOptions& options,
                                 const Execution& execution) {
  const system::Call call(execution);
  if (!(options.tolerance >= 0)) {
    throw InvalidInput("the tolerance is " + system::shortest_text(options.tolerance));
  }
  if (interpolation::MethodFacts(file.method).is_of_points) {
    throw InvalidInput("the method of the weights is \"" + file.method +
                       "\", whose weights are not areas of pieces");
  }
  overlay::require_sizes(file, source, target);
  RemapOptions rules;
  rules.overlap = options.overlap;
  rules.source_mask = overlay::common_mask(source.facts().mask, file.source.mask);
  rules.target_mask = overlay::common_mask(target.facts().mask, file.target.mask);
  const Remap exact = remap(source, target, rules, execution);
  return overlay::WeightComparer(file, exact, options).run();
}

}  // namespace rondel
