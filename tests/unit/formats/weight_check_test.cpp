// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// check_weights: each kind of fault is found where it is, and what is right is not called wrong.
#include "rondel/weight_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace rondel::test {
namespace {

// Three targets of four sources, by hand: target 0 is sources 0 and 1, target 1 source 2, and half of target 2 is
// half of source 3.
WeightFile three_of_four() {
  WeightFile file;
  file.weights.offsets = {0, 2, 3, 4};
  file.weights.columns = {0, 1, 2, 3};
  file.weights.values = {0.25, 0.75, 1, 0.5};
  file.weights.num_columns = 4;
  file.source.areas = {0.1, 0.3, 0.2, 0.2};
  file.source.fractions = {1, 1, 1, 0.5};
  file.target.areas = {0.4, 0.2, 0.2};
  file.target.fractions = {1, 1, 0.5};
  file.method = "Conservative remapping";
  file.normalization = "destarea";
  return file;
}

std::vector<std::string> faults_of(const WeightFile& file, const WeightCheckOptions& options = {}) {
  std::vector<std::string> lines;
  for (const WeightFault& fault : check_weights(file, options).faults) {
    lines.push_back(fault.kind + ": " + fault.what);
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(weight_check, accepts_what_is_conservative) {
  const WeightFile file = three_of_four();
  EXPECT_EQ(faults_of(file), Lines{});
  const WeightReport report = check_weights(file);
  EXPECT_TRUE(report.sums_are_fractions);
  EXPECT_EQ(report.empty_rows, 0U);
  EXPECT_EQ(report.least, 0.25);
  EXPECT_EQ(report.greatest, 1);
  EXPECT_LE(report.worst_row, 1e-15);
  ASSERT_TRUE(report.worst_column.has_value());
  EXPECT_LE(*report.worst_column, 1e-15);
}

TEST(weight_check, names_weights_of_masked_cells) {
  WeightFile file = three_of_four();
  file.source.mask = {1, 0, 1, 1};
  file.target.mask = {1, 1, 0};
  EXPECT_EQ(faults_of(file),
            (Lines{"masked target: 1 weight is of a masked target (target 2, source 3: 0.5)",
                   "masked source: 1 weight is of a masked source (target 0, source 1: 0.75)"}));
  file.source.mask = {0, 0, 0, 0};
  file.target.mask = {};
  EXPECT_EQ(
      faults_of(file),
      Lines{"masked source: 4 weights are of masked sources (first target 0, source 0: 0.25)"});
  // A weight of 0 takes nothing of a cell.
  file = three_of_four();
  file.weights.offsets = {0, 2, 4, 5};
  file.weights.columns = {0, 1, 0, 2, 3};
  file.weights.values = {0, 1, 0, 1, 0.5};
  file.source.mask = {0, 1, 1, 1};
  file.source.areas[1] = 0.4;
  file.source.fractions[0] = 0;
  EXPECT_EQ(faults_of(file), Lines{});
}

TEST(weight_check, names_fractions_above_one_and_below_zero) {
  WeightFile file = three_of_four();
  file.weights.values[2] = 2;
  file.target.fractions[1] = 2;
  file.source.fractions[2] = 2;
  EXPECT_EQ(faults_of(file),
            (Lines{"target fraction: 1 fraction of a target is above 1 (target 1: 2)",
                   "source fraction: 1 fraction of a source is above 1 (source 2: 2)"}));
  file = three_of_four();
  file.method = "";
  file.source.fractions = {-0.5, std::nan(""), 1, 0.5};
  EXPECT_EQ(faults_of(file),
            (Lines{"source fraction: 2 fractions of sources are negative or not numbers "
                   "(first source 0: -0.5)"}));
}

TEST(weight_check, takes_rows_below_one_where_fractions_are_not_known) {
  WeightFile file = three_of_four();
  EXPECT_FALSE(check_weights(file).sums_are_at_most_1);
  file.target.fractions.clear();
  EXPECT_EQ(faults_of(file), Lines{});
  EXPECT_TRUE(check_weights(file).sums_are_at_most_1);
  file.weights.values[3] = 0.125;
  EXPECT_EQ(check_weights(file).min_row, 0.125);
  file = three_of_four();
  file.target.fractions.clear();
  file.weights.values[2] = 1.5;
  EXPECT_EQ(check_weights(file).count("row sum"), 1U);
  file = three_of_four();
  file.target.fractions.clear();
  file.normalization = "fracarea";
  EXPECT_EQ(check_weights(file).count("row sum"), 1U);
}

TEST(weight_check, names_sums_of_rows) {
  WeightFile file = three_of_four();
  file.weights.values[0] = 0.5;
  EXPECT_EQ(faults_of(file),
            (Lines{"row sum: 1 row does not sum up to the fraction of the target (target 0: 1.25)",
                   "conservation: 1 source does not give away its area times its fraction "
                   "(source 0: 2)"}));
  file.normalization = "none";
  file.method = "linear";
  EXPECT_EQ(faults_of(file), (Lines{"row sum: 2 rows sum up to something else than 1 "
                                    "(first target 0: 1.25)"}));
}

TEST(weight_check, names_entries_that_are_repeated_or_no_numbers) {
  WeightFile file = three_of_four();
  file.source = {};
  file.target.areas.clear();
  file.weights.columns = {1, 1, 2, 3};
  EXPECT_EQ(faults_of(file),
            (Lines{"repeated: 1 entry repeats a source of its row (target 0, source 1: 0.75)"}));
  file = three_of_four();
  file.source = {};
  file.target.areas.clear();
  file.weights.values[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(
      faults_of(file),
      (Lines{"not finite: 1 weight is not finite (target 2, source 3: inf)",
             "row sum: 1 row does not sum up to the fraction of the target (target 2: inf)"}));
}

TEST(weight_check, judges_columns_where_sources_are_given_to_their_nearest_targets) {
  WeightFile file;
  file.weights = {{0, 3, 3, 4}, {0, 2, 3, 1}, {1, 1, 1, 1}, 5, 0, 0};
  file.normalization = "none";
  EXPECT_EQ(faults_of(file),
            (Lines{"row sum: 1 row sums up to something else than 1 (target 0: 3)"}));
  for (const char* method : {"nearest_d2s", "Nearest destination to source", "NEAREST_DTOS"}) {
    file.method = method;
    EXPECT_EQ(faults_of(file), Lines{}) << method;
    EXPECT_TRUE(check_weights(file).sums_are_of_columns);
  }
  file.weights.columns[3] = 2;
  file.weights.values[0] = 0.5;
  EXPECT_EQ(faults_of(file), (Lines{"column sum: 2 sources are not given away as a whole, once "
                                    "(first source 0: 0.5)"}));
  EXPECT_EQ(check_weights(file).worst_row, 1);
}

TEST(weight_check, judges_negative_weights_by_the_method) {
  WeightFile file;
  file.weights = {{0, 2}, {0, 1}, {1.25, -0.25}, 2, 0, 0};
  const Lines wrong = {"negative: 1 weight is negative (target 0, source 1: -0.25)"};
  for (const char* method :
       {"Conservative remapping", "First-order Conservative", "linear", "nearest", "laplace",
        "sibson", "Largest area fraction", "Nearest source to destination"}) {
    file.method = method;
    EXPECT_EQ(faults_of(file), wrong) << method;
    EXPECT_EQ(faults_of(file, {.allow_negative = true}), Lines{}) << method;
  }
  for (const char* method :
       {"Conservative remapping, second order", "Second-order Conservative", "conservative_2nd",
        "Bilinear remapping", "Higher-order Patch", "Bicubic remapping", "hermite", "cubic", ""}) {
    file.method = method;
    EXPECT_EQ(faults_of(file), Lines{}) << method;
  }
}

TEST(weight_check, names_areas_and_what_is_not_conserved) {
  WeightFile file = three_of_four();
  file.target.areas[1] = -0.2;
  EXPECT_EQ(faults_of(file),
            (Lines{"target area: 1 area of a target is negative or not finite (target 1: -0.2)",
                   "conservation: 1 source does not give away its area times its fraction "
                   "(source 2: -1)"}));
  file = three_of_four();
  file.weights.offsets = {0, 2, 2, 3};
  file.weights.columns = {0, 1, 3};
  file.weights.values = {0.25, 0.75, 0.5};
  EXPECT_EQ(faults_of(file),
            (Lines{"missing row: 1 target has a fraction and no weight (target 1: 1)",
                   "conservation: 1 source does not give away its area times its fraction "
                   "(source 2: 0)"}));
  // Interpolation conserves nothing, and says nothing of targets without weights.
  file.method = "bilinear";
  EXPECT_EQ(faults_of(file), Lines{});
}

// Areas that are all 0 are read as none. Those of the other side say that areas are meant.
TEST(weight_check, names_areas_that_only_the_other_side_has) {
  WeightFile file = three_of_four();
  file.target.areas.clear();
  EXPECT_EQ(faults_of(file),
            (Lines{"target area: 3 areas of targets with entries are 0 (first target 0: 0)"}));
  file.source.areas.clear();
  EXPECT_EQ(faults_of(file), Lines{});
  file.target.areas = {0.4, 0.2, 0.2};
  file.weights.offsets = {0, 1, 1, 1};
  file.weights.columns = {2};
  file.weights.values = {1};
  file.target.fractions = {1, 0, 0};
  EXPECT_EQ(faults_of(file),
            (Lines{"source area: 1 area of a source with entries is 0 (source 2: 0)"}));
  file.method = "bilinear";  // no pieces of areas
  EXPECT_EQ(faults_of(file), Lines{});
}

// The bound of the header, once more.
TEST(weight_check, allows_what_rounding_makes_of_areas) {
  const double area = 1e-8;  // some 40 hectares of the Earth
  const double bound = 1e-9 + 2 * 8 * std::numbers::pi * std::ldexp(1.0, -52) / area;
  for (const double share : {0.9, 1.1}) {
    WeightFile file;
    const double fraction = 1 + share * bound;
    file.weights = {{0, 1}, {0}, {fraction}, 1, 0, 0};
    file.target.areas = {area};
    file.target.fractions = {fraction};
    file.normalization = "destarea";
    EXPECT_EQ(faults_of(file).empty(), share < 1) << share;
    file.target.areas.clear();
    EXPECT_EQ(faults_of(file).empty(), false) << share;
  }
}

TEST(weight_check, takes_the_report_of_wrong_kinds_apart) {
  WeightFile file = three_of_four();
  file.weights.values = {0.5, 0.75, 2, 0.5};
  const WeightReport report = check_weights(file);
  EXPECT_EQ(report.count("row sum"), 2U);
  EXPECT_EQ(report.count("conservation"), 2U);
  EXPECT_EQ(report.count("repeated"), 0U);
}

}  // namespace
}  // namespace rondel::test
