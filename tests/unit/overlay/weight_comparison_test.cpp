// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// compare_weights: faults that are planted into weights by formula are found where they are.
#include "rondel/weight_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

// Lines that no step repeats. The source ends at 50 degrees south, in the middle of targets.
const LonLatGrid& source_lines() {
  static const LonLatGrid lines{{-180, -110, -45, -5, 20, 81, 120, 180}, {-50, -31, 0, 14, 44, 90}};
  return lines;
}
const LonLatGrid& target_lines() {
  static const LonLatGrid lines{{-180, -97, -33, 7, 45, 150, 180}, {-90, -70, -41, 5, 30, 67, 90}};
  return lines;
}

double in_radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Returns the area between two meridians and two parallels that two cells have in common.
double common_area(const LonLatGrid& a, std::size_t i, const LonLatGrid& b, std::size_t j) {
  const std::size_t a_lon = a.lon_deg.size() - 1;
  const std::size_t b_lon = b.lon_deg.size() - 1;
  const auto between = [](const std::vector<double>& x, std::size_t k, const std::vector<double>& y,
                          std::size_t l) {
    return std::pair(std::max(x[k], y[l]), std::min(x[k + 1], y[l + 1]));
  };
  const auto [west, east] = between(a.lon_deg, i % a_lon, b.lon_deg, j % b_lon);
  const auto [south, north] = between(a.lat_deg, i / a_lon, b.lat_deg, j / b_lon);
  if (west >= east || south >= north) return 0;
  return in_radians(east - west) * (std::sin(in_radians(north)) - std::sin(in_radians(south)));
}

// Returns the right weights of a normalization: "destarea", "fracarea" or "area".
WeightFile right_weights(const std::string& norm) {
  const LonLatGrid& from = source_lines();
  const LonLatGrid& to = target_lines();
  const std::size_t sources = (from.lon_deg.size() - 1) * (from.lat_deg.size() - 1);
  const std::size_t targets = (to.lon_deg.size() - 1) * (to.lat_deg.size() - 1);
  WeightFile file;
  file.weights.num_columns = sources;
  for (std::size_t j = 0; j < targets; ++j) {
    double covered = 0;
    for (std::size_t i = 0; i < sources; ++i) covered += common_area(from, i, to, j);
    const double area = common_area(to, j, to, j);
    const double divisor = norm == "area" ? 1 : norm == "fracarea" ? covered : area;
    for (std::size_t i = sources; i-- > 0;) {  // in descending order, which is no fault
      const double piece = common_area(from, i, to, j);
      if (!(piece > 0)) continue;
      file.weights.columns.push_back(static_cast<Index>(i));
      file.weights.values.push_back(piece / divisor);
    }
    file.weights.end_row();
  }
  file.method = "Conservative remapping";
  file.normalization = norm == "area" ? "none" : norm;
  return file;
}

WeightComparison compare(const WeightFile& file, const WeightComparisonOptions& options = {}) {
  return compare_weights(file, CellSet::lonlat_grid(source_lines()),
                         CellSet::lonlat_grid(target_lines()), options);
}

std::vector<std::string> kinds_of(const WeightComparison& comparison) {
  std::vector<std::string> kinds;
  for (const WeightFault& fault : comparison.faults) {
    kinds.push_back(fault.kind + ' ' + std::to_string(fault.count));
  }
  return kinds;
}

using Kinds = std::vector<std::string>;

// Removes an entry.
void drop(WeightFile& file, std::size_t row, std::uint64_t entry) {
  const auto at = static_cast<std::ptrdiff_t>(entry);
  file.weights.columns.erase(file.weights.columns.begin() + at);
  file.weights.values.erase(file.weights.values.begin() + at);
  for (std::size_t r = row + 1; r < file.weights.offsets.size(); ++r) --file.weights.offsets[r];
}

TEST(weight_comparison, finds_nothing_in_right_weights_of_any_normalization) {
  for (const auto& [norm, found] : {std::pair("destarea", WeightNorm::destarea),
                                    {"fracarea", WeightNorm::fracarea},
                                    {"area", WeightNorm::area}}) {
    const WeightComparison right = compare(right_weights(norm));
    EXPECT_EQ(kinds_of(right), Kinds{}) << norm;
    EXPECT_EQ(right.norm, found);
    EXPECT_EQ(right.pieces, right_weights(norm).weights.values.size());
    EXPECT_LE(right.max_error, 1e-14);
    EXPECT_LE(right.mean_error, right.rms_error);
    EXPECT_LE(right.row_sums, 1e-14);
    EXPECT_LE(right.local_conservation, 1e-14);
    EXPECT_LE(right.global_conservation, 1e-14);
    EXPECT_TRUE(right.worst_rows.empty());
    std::size_t counted = 0;
    for (const std::size_t count : right.errors.counts) counted += count;
    EXPECT_EQ(counted, right.pieces);
  }
}

TEST(weight_comparison, finds_a_piece_that_was_dropped) {
  WeightFile file = right_weights("destarea");
  const std::size_t row = 14;
  const std::uint64_t entry = file.weights.offsets[row];
  const Index source = file.weights.columns[entry];
  const double weight = file.weights.values[entry];
  drop(file, row, entry);
  const WeightComparison found = compare(file);
  EXPECT_EQ(kinds_of(found), Kinds{"missing piece 1"});
  ASSERT_EQ(found.worst_rows.size(), 1U);
  const ComparedRow& worst = found.worst_rows[0];
  EXPECT_EQ(worst.target, row);
  EXPECT_EQ(worst.wrong, 1U);
  EXPECT_NEAR(worst.error, weight, 1e-14);
  EXPECT_NEAR(worst.exact_sum - worst.sum, weight, 1e-14);
  EXPECT_EQ(worst.worst.source, source);
  EXPECT_EQ(worst.worst.given, 0);
  EXPECT_NEAR(worst.worst.exact, weight, 1e-14);
  // Row 14 is the third of the third row of targets: between -33 and 7, -41 and 5.
  EXPECT_NEAR(worst.place.lon_deg, -13, 1e-12);
  EXPECT_NEAR(worst.place.lat_deg, -18, 1e-12);
  const double area = weight * common_area(target_lines(), row, target_lines(), row);
  EXPECT_NEAR(found.local_conservation,
              area / common_area(source_lines(), source, source_lines(), source), 1e-13);
  double common = 0;
  for (std::size_t i = 0; i < 35; ++i) common += common_area(source_lines(), i, source_lines(), i);
  EXPECT_NEAR(found.global_conservation, area / common, 1e-14);
  EXPECT_NEAR(found.max_error, weight, 1e-14);
  EXPECT_NEAR(found.mean_error, weight / static_cast<double>(found.pieces), 1e-14);
  EXPECT_NEAR(found.rms_error, weight / std::sqrt(static_cast<double>(found.pieces)), 1e-14);
  std::size_t from_a_millionth = 0;
  for (std::size_t bin = 0; bin < ErrorDistribution::num_bins; ++bin) {
    if (ErrorDistribution::end_of(bin) > 1e-6) from_a_millionth += found.errors.counts[bin];
  }
  EXPECT_EQ(from_a_millionth, 1U);
}

TEST(weight_comparison, finds_weights_that_were_scaled_moved_or_made_up) {
  WeightFile scaled = right_weights("fracarea");
  scaled.weights.values[20] *= 1.5;
  EXPECT_EQ(kinds_of(compare(scaled)), Kinds{"wrong weight 1"});

  WeightFile moved = right_weights("destarea");
  moved.weights.columns[20] = 34;  // the last source, at the pole
  EXPECT_EQ(kinds_of(compare(moved)), (Kinds{"missing piece 1", "needless weight 1"}));

  WeightFile swapped = right_weights("destarea");
  std::swap(swapped.weights.columns[20], swapped.weights.columns[21]);
  EXPECT_EQ(kinds_of(compare(swapped)), Kinds{"wrong weight 2"});

  // A weight that is no number is wrong, and so is one that is infinite.
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    WeightFile broken = right_weights("destarea");
    broken.weights.values[3] = bad;
    const WeightComparison found = compare(broken);
    EXPECT_EQ(kinds_of(found), Kinds{"wrong weight 1"});
    EXPECT_EQ(found.max_error, std::numeric_limits<double>::infinity());
    EXPECT_EQ(found.errors.counts.back(), 1U);
  }
}

TEST(weight_comparison, adds_up_entries_that_are_repeated) {
  WeightFile file = right_weights("destarea");
  file.weights.values[0] /= 2;
  file.weights.columns.insert(file.weights.columns.begin(), file.weights.columns[0]);
  file.weights.values.insert(file.weights.values.begin(), file.weights.values[0]);
  // The first entry is that of target 6, the first one that sources touch.
  for (std::size_t r = 7; r < file.weights.offsets.size(); ++r) ++file.weights.offsets[r];
  EXPECT_EQ(kinds_of(compare(file)), Kinds{});
}

TEST(weight_comparison, tells_the_normalization_that_the_weights_have) {
  WeightFile file = right_weights("fracarea");
  file.normalization = "destarea";
  const WeightComparison found = compare(file);
  EXPECT_EQ(found.norm, WeightNorm::fracarea);
  // Six targets are covered in part: between -70 and -41.
  EXPECT_EQ(kinds_of(found), Kinds{"normalization 6"});
  EXPECT_EQ(found.faults[0].what,
            "the file says destarea of the normalization, but the weights have fracarea (rows that "
            "tell it: 6)");
  // One row with another normalization than the others is wrong.
  file = right_weights("destarea");
  const WeightFile other = right_weights("fracarea");
  for (std::uint64_t k = file.weights.offsets[6]; k < file.weights.offsets[7]; ++k) {
    file.weights.values[k] = other.weights.values[k];
  }
  const std::size_t count = file.weights.offsets[7] - file.weights.offsets[6];
  EXPECT_EQ(kinds_of(compare(file)), Kinds{"wrong weight " + std::to_string(count)});
  // Where sources cover all targets, both are the same.
  WeightFile same = right_weights("destarea");
  same.target.mask.assign(36, 1);
  for (std::size_t j = 0; j < 12; ++j) same.target.mask[j] = 0;
  while (same.weights.offsets[12] > 0) drop(same, 11, 0);
  for (std::size_t j = 0; j < 12; ++j) same.weights.offsets[j] = 0;
  EXPECT_EQ(compare(same).norm, WeightNorm::either);
  EXPECT_EQ(kinds_of(compare(same)), Kinds{});
}

TEST(weight_comparison, heeds_the_masks_of_the_file_and_of_the_cells) {
  WeightFile file = right_weights("destarea");
  file.source.mask.assign(35, 1);
  file.source.mask[10] = 0;
  const auto of_source =
      static_cast<std::size_t>(std::ranges::count(file.weights.columns, Index{10}));
  ASSERT_GT(of_source, 0U);
  EXPECT_EQ(kinds_of(compare(file)), Kinds{"needless weight " + std::to_string(of_source)});
  CellFacts facts;
  facts.mask = file.source.mask;
  file.source.mask.clear();
  const CellSet masked = CellSet::lonlat_grid(source_lines()).with_facts(facts);
  EXPECT_EQ(kinds_of(compare_weights(file, masked, CellSet::lonlat_grid(target_lines()))),
            Kinds{"needless weight " + std::to_string(of_source)});
}

TEST(weight_comparison, finds_numbers_that_are_off_by_one) {
  WeightFile file = right_weights("destarea");
  for (Index& column : file.weights.columns) column = column == 34 ? 0 : column + 1;
  const WeightComparison found = compare(file);
  EXPECT_EQ(found.count("numbering"), 1U);
  EXPECT_EQ(found.faults.back().what,
            "with source numbers one smaller most weights would be right");
  file = right_weights("destarea");
  file.weights.offsets.insert(file.weights.offsets.begin(), 0);
  file.weights.offsets.pop_back();
  file.weights.columns.resize(file.weights.offsets.back());
  file.weights.values.resize(file.weights.offsets.back());
  EXPECT_EQ(compare(file).faults.back().what,
            "with target numbers one smaller most weights would be right");
}

TEST(weight_comparison, finds_places_of_another_order) {
  WeightFile file = right_weights("destarea");
  const CellSet target = CellSet::lonlat_grid(target_lines());
  file.target.points = target.places();
  EXPECT_EQ(kinds_of(compare(file)), Kinds{});
  std::ranges::reverse(file.target.points);
  EXPECT_GT(compare(file).count("target place"), 18U);
  file.target.points = target.places();
  file.source.points = CellSet::lonlat_grid(source_lines()).places();
  std::ranges::reverse(file.source.points);
  EXPECT_EQ(compare(file).faults.size(), 1U);
  EXPECT_GT(compare(file).count("source place"), 17U);
}

TEST(weight_comparison, compares_areas_in_the_file) {
  WeightFile file = right_weights("destarea");
  EXPECT_FALSE(compare(file).target_areas.has_value());
  for (std::size_t j = 0; j < 36; ++j) {
    file.target.areas.push_back(common_area(target_lines(), j, target_lines(), j));
  }
  EXPECT_LE(compare(file).target_areas.value(), 1e-14);
  file.target.areas[7] *= 1.25;
  EXPECT_NEAR(compare(file).target_areas.value(), 0.25, 1e-14);
}

TEST(weight_comparison, compares_sums_of_second_order) {
  WeightFile file = right_weights("destarea");
  file.method = "Conservative remapping, second order";
  // What a gradient moves from one source to another keeps the sum of the row, not that of columns.
  file.weights.values[20] += 0.01;
  file.weights.values[21] -= 0.01;
  const WeightComparison found = compare(file);
  EXPECT_TRUE(found.are_sums);
  EXPECT_EQ(kinds_of(found), Kinds{"conservation 2"});
  EXPECT_LE(found.row_sums, 1e-14);
  file.weights.values[21] += 0.01;
  EXPECT_EQ(kinds_of(compare(file)), (Kinds{"row sum 1", "conservation 1"}));
  const CellSet source = CellSet::lonlat_grid(source_lines());
  const CellSet target = CellSet::lonlat_grid(target_lines());
  const WeightFile second = weight_file(remap(source, target, {.order = 2}));
  EXPECT_EQ(kinds_of(compare(second)), Kinds{});
}

// Of cells that are symmetric, sums of rows in reverse order are right.
TEST(weight_comparison, looks_for_pieces_of_second_order) {
  const CellSet source = CellSet::lonlat_grid(GlobalGrid{8, 4});
  const CellSet target = CellSet::lonlat_grid(GlobalGrid{12, 6});
  WeightFile file = weight_file(remap(source, target, {.order = 2}));
  EXPECT_EQ(compare_weights(file, source, target).faults.size(), 0U);
  std::vector<Index> rows(target.num_cells());
  for (Index j = 0; j < rows.size(); ++j) rows[rows.size() - 1 - j] = j;
  std::vector<Index> columns(source.num_cells());
  for (Index i = 0; i < columns.size(); ++i) columns[i] = i;
  file.weights = renumbered(file.weights, rows, rows.size(), columns, columns.size());
  const WeightComparison found = compare_weights(file, source, target);
  EXPECT_LE(found.row_sums, 1e-13);
  EXPECT_GT(found.count("missing piece"), 50U);
}

TEST(weight_comparison, allows_what_the_tolerance_says) {
  WeightFile file = right_weights("destarea");
  file.weights.values[9] += 1e-7;
  EXPECT_EQ(kinds_of(compare(file)), Kinds{"wrong weight 1"});
  EXPECT_EQ(kinds_of(compare(file, {.tolerance = 1e-6})), Kinds{});
  EXPECT_EQ(compare(file, {.max_rows = 0}).worst_rows.size(), 0U);
}

TEST(weight_comparison, refuses_what_it_cannot_compare) {
  const auto message = [](const WeightFile& file, const WeightComparisonOptions& options = {}) {
    return thrown_message<InvalidInput>([&] { return compare(file, options); });
  };
  WeightFile file = right_weights("destarea");
  file.method = "Bilinear remapping";
  EXPECT_EQ(message(file),
            "the method of the weights is \"Bilinear remapping\", whose weights are not areas of "
            "pieces");
  file.method = "";
  EXPECT_EQ(message(file), "");
  EXPECT_EQ(message(file, {.tolerance = std::nan("")}), "the tolerance is nan");
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return compare_weights(file, CellSet::lonlat_grid(target_lines()),
                                     CellSet::lonlat_grid(source_lines()));
            }),
            "the weights are from 35 sources to 36 targets, the cells are 36 sources and 35 "
            "targets: source and target are exchanged");
}

TEST(weight_comparison, norms_have_names) {
  EXPECT_EQ(name_of(WeightNorm::unknown), "unknown");
  EXPECT_EQ(name_of(WeightNorm::area), "area");
}

}  // namespace
}  // namespace rondel::test
