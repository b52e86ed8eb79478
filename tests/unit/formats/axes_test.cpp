// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Axes of cells: random ones, of which lines are drawn first, then what files say of them in every form that they have; and case by
// case.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "rondel/conventions.h"
#include "rondel/error.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using Doubles = std::vector<double>;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// Lines of cells, which increase. Numbers are multiples of 1/8, so that halves are exact.
Doubles random_lines(Random& random, bool is_longitude, bool is_whole_circle) {
  const int most = is_longitude ? 360 * 8 : 180 * 8;
  const std::size_t n = 2 + random.below(8);
  std::vector<int> steps;
  int total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const int room = (most - total) / static_cast<int>(n - i);
    steps.push_back(random.between(1, std::max(1, random.coin() ? room : room / 7)));
    total += steps.back();
  }
  if (is_whole_circle) steps.back() += most - total;
  int at = is_longitude ? random.between(-400 * 8, 400 * 8)
                        : random.between(-90 * 8, is_whole_circle ? -90 * 8 : 90 * 8 - total);
  Doubles lines = {at / 8.0};
  for (const int step : steps) lines.push_back((at += step) / 8.0);
  return lines;
}

Doubles middles(const Doubles& lines) {
  Doubles result;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    result.push_back((lines[i] + lines[i + 1]) / 2);
  }
  return result;
}

// The bounds of each cell, two by two, perhaps the upper one first, perhaps another turn for each.
Doubles pairs(const Doubles& lines, bool are_swapped) {
  Doubles result;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    result.push_back(are_swapped ? lines[i + 1] : lines[i]);
    result.push_back(are_swapped ? lines[i] : lines[i + 1]);
  }
  return result;
}

// Each longitude in [-180, 180).
Doubles rolled(Doubles values) {
  for (double& x : values) x -= 360 * std::floor((x + 180) / 360);
  return values;
}

Doubles reversed(Doubles values) {
  std::ranges::reverse(values);
  return values;
}

// True if the lines are these ones, up to one number of turns for all.
bool are_same(const Doubles& found, const Doubles& lines, bool is_longitude) {
  if (found.size() != lines.size()) return false;
  const double turns = is_longitude ? std::round((found[0] - lines[0]) / 360) * 360 : 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (found[i] != lines[i] + turns) return false;
  }
  return true;
}

std::string text(const Doubles& values) {
  std::string result;
  for (const double x : values) result += std::to_string(x) + ' ';
  return result;
}

// True if no cell is half of the circle or more, so that its bounds tell its western side alone.
bool are_narrow(const Doubles& lines) {
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i + 1] - lines[i] >= 180) return false;
  }
  return true;
}

TEST(axes, have_the_lines_that_bounds_say_in_every_form) {
  Random random(5);
  for (int k = 0; k < 4000; ++k) {
    const bool is_longitude = random.coin();
    const bool is_whole_circle = random.below(3) == 0;
    Doubles lines = random_lines(random, is_longitude, is_whole_circle);
    if (is_longitude && is_whole_circle && lines.size() == 3) continue;  // goes either way
    const Doubles centers = middles(lines);
    const auto expect = [&](const Doubles& values, const Doubles& bounds, const Doubles& right) {
      Doubles found;
      EXPECT_NO_THROW(found = axis_lines(values, bounds, is_longitude));
      EXPECT_TRUE(are_same(found, right, is_longitude))
          << text(values) << "with " << text(bounds) << "has " << text(found) << "not "
          << text(right);
    };
    const bool is_clear = are_narrow(lines);
    for (const bool are_swapped : {false, true}) {
      if (are_swapped && is_longitude && !is_clear) continue;
      expect(centers, pairs(lines, are_swapped), lines);
      expect(reversed(centers), pairs(reversed(lines), are_swapped), reversed(lines));
      if (!is_longitude || !is_clear || is_whole_circle) continue;
      expect(rolled(centers), pairs(lines, are_swapped), lines);
      expect(centers, rolled(pairs(lines, are_swapped)), lines);
      expect(rolled(reversed(centers)), rolled(pairs(reversed(lines), are_swapped)),
             reversed(lines));
    }
    expect(centers, lines, lines);
    expect(centers, reversed(lines), lines);
    expect(reversed(centers), lines, reversed(lines));
    expect(reversed(centers), reversed(lines), reversed(lines));
  }
}

TEST(axes, of_narrow_cells_go_across_the_first_meridian) {
  const Doubles centers = {359.875, 0.125, 0.375};
  EXPECT_TRUE(are_same(axis_lines(centers, Doubles{359.75, 360, 0, 0.25, 0.25, 0.5}, true),
                       {-0.25, 0, 0.25, 0.5}, true));
  EXPECT_TRUE(
      are_same(axis_lines(reversed(centers), Doubles{0.25, 0.5, 0, 0.25, 359.75, 360}, true),
               {0.5, 0.25, 0, -0.25}, true));
}

// Both ways from one bound to the other are possible, so the coordinate says which one it is.
TEST(axes, of_one_cell_go_where_its_longitude_is) {
  const auto expect = [](double value, const Doubles& bounds, const Doubles& lines) {
    for (const double turn : {-360, 0, 360}) {
      const Doubles found = axis_lines(Doubles{value + turn}, bounds, true);
      EXPECT_TRUE(are_same(found, lines, true)) << value << " has " << text(found);
    }
  };
  expect(180, {80, 280}, {80, 280});
  expect(180, {280, 80}, {80, 280});
  expect(120, {280, 80}, {80, 280});
  expect(0, {280, 80}, {280, 440});
  expect(0, {80, 280}, {280, 440});
  expect(180, {0, 360}, {0, 360});
  expect(180, {360, 0}, {0, 360});
  expect(0, {180, -180}, {-180, 180});
  expect(180, {360, 0.5}, {0.5, 360});
  expect(0, {350, 10}, {350, 370});
  expect(180, {350, 10}, {10, 350});
  expect(90, {100, 80}, {80, 100});
  expect(270, {100, 80}, {100, 440});
  // A coordinate at or beside a side does not turn the cell around.
  expect(80, {80, 280}, {80, 280});
  expect(280, {80, 280}, {80, 280});
  expect(12, {350, 10}, {350, 370});
  expect(100.00005, {100.000005, 99.999995}, {99.999995, 100.000005});
  expect(12, {0, 10}, {0, 10});
  EXPECT_THROW((void)axis_lines(Doubles{270}, Doubles{80, 100}, true), InvalidInput);
}

TEST(axes, that_go_around_unevenly_meet_in_the_gap) {
  const auto lines = [](const Doubles& values) { return axis_lines(values, {}, true); };
  EXPECT_EQ(lines({0, 60, 120, 180, 240, 250, 260, 320}),
            (Doubles{-20, 30, 90, 150, 210, 245, 255, 290, 340}));
  EXPECT_EQ(lines({320, 260, 250, 240, 180, 120, 60, 0}),
            (Doubles{340, 290, 255, 245, 210, 150, 90, 30, -20}));
  EXPECT_EQ(lines({0, 10, 20, 80, 140, 200, 260, 320, 330}),
            (Doubles{-15, 5, 15, 50, 110, 170, 230, 290, 325, 345}));
  EXPECT_EQ(lines({0, 100, 200, 300}), (Doubles{-30, 50, 150, 250, 330}));
  EXPECT_EQ(lines({0, 180}), (Doubles{-90, 90, 270}));
  EXPECT_EQ(lines({0, 200}), (Doubles{-80, 100, 280}));
  EXPECT_EQ(lines({0, 90}), (Doubles{-45, 45, 135}));
  // A gap that is wider than all steps is left.
  EXPECT_EQ(lines({0, 10, 20}), (Doubles{-5, 5, 15, 25}));
  EXPECT_EQ(lines({0, 100, 190, 280}), (Doubles{-40, 50, 145, 235, 320}));
  EXPECT_EQ(lines({0, 90, 180, 250}), (Doubles{-45, 45, 135, 215, 285}));
}

// A coordinate of single precision may be beside a cell that is narrower than its rounding.
TEST(axes, may_be_beside_their_cells_by_rounding) {
  const Doubles bounds = {99.999995, 100.000005, 100.000005, 100.000015};
  for (const bool is_longitude : {false, true}) {
    const double moved = is_longitude ? 0 : -50;
    Doubles there = bounds;
    for (double& x : there) x += moved;
    EXPECT_EQ(axis_lines(Doubles{100.00005 + moved, 100.00006 + moved}, there, is_longitude).size(),
              3U);
    EXPECT_THROW(
        (void)axis_lines(Doubles{100.0003 + moved, 100.00031 + moved}, there, is_longitude),
        InvalidInput);
  }
}

TEST(axes, without_bounds_have_lines_halfway) {
  Random random(6);
  for (int k = 0; k < 4000; ++k) {
    const bool is_longitude = random.coin();
    const Doubles values = random_lines(random, is_longitude, false);
    Doubles right = middles(values);
    right.insert(right.begin(), values[0] - (values[1] - values[0]) / 2);
    const std::size_t n = values.size();
    right.push_back(values[n - 1] + (values[n - 1] - values[n - 2]) / 2);
    if (!is_longitude) {
      // Cells at a pole end there, if the pole is less than a cell away.
      if (right[0] + 90 < right[1] - right[0]) right[0] = -90;
      if (90 - right[n] < right[n] - right[n - 1]) right[n] = 90;
    } else {
      double widest = 0;
      for (std::size_t i = 1; i < n; ++i) widest = std::max(widest, values[i] - values[i - 1]);
      const double gap = 360 - (values[n - 1] - values[0]);
      if (gap <= 0) continue;
      // Where a step is as wide as the gap, the cells at both ends meet half way across it.
      if (gap <= widest && (widest <= 180 || right[n] - right[0] > 360)) {
        right[0] = values[0] - gap / 2;
        right[n] = right[0] + 360;
      }
    }
    const auto expect = [&](const Doubles& given, const Doubles& lines) {
      const Doubles found = axis_lines(given, {}, is_longitude);
      EXPECT_TRUE(are_same(found, lines, is_longitude)) << text(given) << "has " << text(found);
    };
    expect(values, right);
    // Longitudes that decrease, and those that jump, go the shorter way around.
    if (!is_longitude) expect(reversed(values), reversed(right));
    if (!is_longitude || !are_narrow(values)) continue;
    expect(reversed(values), reversed(right));
    expect(rolled(values), right);
    expect(rolled(reversed(values)), reversed(right));
  }
}

// The first cell once more at the end: each has half of the cell.
TEST(axes, that_repeat_the_first_longitude_divide_its_cell) {
  Random random(7);
  for (int k = 0; k < 2000; ++k) {
    const Doubles lines = random_lines(random, true, true);
    if (!are_narrow(lines) || lines.size() < 4) continue;
    Doubles values = middles(lines);
    values.push_back(values[0] + 360);
    Doubles bounds = pairs(lines, false);
    bounds.push_back(lines.back());
    bounds.push_back(lines[1] + 360);
    Doubles right = lines;
    right.front() = values.front();
    right.push_back(values.back());
    EXPECT_TRUE(are_same(axis_lines(values, bounds, true), right, true)) << text(values);
    EXPECT_TRUE(are_same(axis_lines(rolled(values), bounds, true), right, true)) << text(values);
    const Doubles west = axis_lines(reversed(values), reversed(bounds), true);
    EXPECT_TRUE(are_same(west, reversed(right), true)) << text(values);
  }
}

TEST(axes, whose_bounds_do_not_meet_are_refused) {
  Random random(8);
  for (int k = 0; k < 2000; ++k) {
    const bool is_longitude = random.coin();
    const Doubles lines = random_lines(random, is_longitude, false);
    if (lines.size() < 4 || !are_narrow(lines)) continue;
    Doubles bounds = pairs(lines, false);
    const std::size_t cell = 1 + random.below(lines.size() - 2);
    const double width = lines[cell + 1] - lines[cell];
    const double step = (random.coin() ? 0.25 : -0.25) * width;
    bounds[2 * cell] += step;
    try {
      (void)axis_lines(middles(lines), bounds, is_longitude);
      ADD_FAILURE() << text(bounds) << "leave no gap";
    } catch (const InvalidInput& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("overlap") != std::string::npos, step < 0) << message;
      EXPECT_EQ(error.index(), cell) << message;
    }
    // A rounding is none.
    bounds[2 * cell] = lines[cell] + 1e-8 * width;
    EXPECT_EQ(axis_lines(middles(lines), bounds, is_longitude).size(), lines.size());
  }
}

TEST(axes, lines_of_longitudes) {
  const auto lines = [](const Doubles& values, const Doubles& bounds = {}) {
    return axis_lines(values, bounds, true);
  };
  EXPECT_EQ(lines({0, 90, 180, -90}), (Doubles{-45, 45, 135, 225, 315}));
  EXPECT_EQ(lines({3, 2, 1}), (Doubles{3.5, 2.5, 1.5, 0.5}));
  EXPECT_EQ(lines({10, 0, 350}), (Doubles{15, 5, -5, -15}));
  EXPECT_EQ(lines({355, 5}), (Doubles{350, 360, 370}));
  EXPECT_EQ(lines({300, 290, 80}), (Doubles{305, 295, 185, -25}));
  // Steps that are a little more than a turn, there and back.
  EXPECT_EQ(lines({0, 360.5, 1, 721.5}), (Doubles{-0.25, 0.25, 0.75, 1.25, 1.75}));
  // Where both ends of the circle are there, each has half of the cell.
  EXPECT_EQ(lines({0, 120, 240, 360}), (Doubles{0, 60, 180, 300, 360}));
  EXPECT_EQ(lines({180, 60, -60, -180}), (Doubles{180, 120, 0, -120, -180}));
  EXPECT_EQ(lines({0, 120, 240, 360}, {-60, 60, 60, 180, 180, 300, 300, 420}),
            (Doubles{0, 60, 180, 300, 360}));
  // Bounds in either order, rolled, across the meridian where they jump, and decreasing under coordinates that do.
  EXPECT_EQ(lines({5, 15}, {10, 0, 20, 10}), (Doubles{0, 10, 20}));
  EXPECT_EQ(lines({-175, -5, 5, 175}, {180, 270, 270, 360, 0, 90, 90, 180}),
            (Doubles{180, 270, 360, 450, 540}));
  EXPECT_EQ(lines({355, 5}, {350, 0, 0, 10}), (Doubles{350, 360, 370}));
  EXPECT_EQ(lines({355, 5}, {0, 350, 10, 0}), (Doubles{350, 360, 370}));
  EXPECT_EQ(lines({15, 5}, {10, 20, 0, 10}), (Doubles{20, 10, 0}));
  EXPECT_EQ(lines({15, 5}, {20, 10, 0}), (Doubles{20, 10, 0}));
  EXPECT_EQ(lines({15, 5}, {0, 10, 20}), (Doubles{20, 10, 0}));
  EXPECT_EQ(lines({5, 15}, {20, 10, 0}), (Doubles{0, 10, 20}));
  EXPECT_EQ(lines({180}, {0, 360}), (Doubles{0, 360}));
  EXPECT_EQ(lines({95, 275}, {0, 190, 190, 360}), (Doubles{0, 190, 360}));
  EXPECT_EQ(lines({90, 270}, {0, 180, 360, 180}), (Doubles{0, 180, 360}));
  EXPECT_THROW((void)lines({5, 25}, {0, 10, 20, 30}), InvalidInput);
  EXPECT_THROW((void)lines({5, 25}, {0, 10, 20, 30, 40}), InvalidInput);
  // A coordinate beside its cell, and one of another cell.
  EXPECT_EQ(lines({-4, 6}, {0, 10, 20}), (Doubles{0, 10, 20}));
  EXPECT_EQ(lines({355, 365}, {-10, 0, 10}), (Doubles{-10, 0, 10}));
  EXPECT_THROW((void)lines({25, 35}, {0, 10, 20}), InvalidInput);
  EXPECT_THROW((void)lines({-175, -165}, {0, 10, 10, 20}), InvalidInput);
  EXPECT_THROW((void)lines({5}), InvalidInput);
  EXPECT_THROW((void)lines({5, no_number}), InvalidInput);
}

TEST(axes, lines_of_latitudes) {
  const auto lines = [](const Doubles& values, const Doubles& bounds = {}) {
    return axis_lines(values, bounds, false);
  };
  EXPECT_EQ(lines({60, 20, -20, -60}), (Doubles{90, 40, 0, -40, -90}));
  EXPECT_EQ(lines({-90, 0, 90}), (Doubles{-90, -45, 45, 90}));
  EXPECT_EQ(lines({5, -5}, {10, 0, 0, -10}), (Doubles{10, 0, -10}));
  EXPECT_EQ(lines({5, -5}, {0, 10, -10, 0}), (Doubles{10, 0, -10}));
  // These lines were rounded to single precision as radians.
  EXPECT_EQ(lines({0}, {-90.0000025, 90.0000025}), (Doubles{-90, 90}));
}

// What axis_lines() says of an axis, and the index.
std::pair<std::string, std::size_t> refusal_of_axis(const Doubles& values, const Doubles& bounds,
                                                    bool is_longitude) {
  try {
    (void)axis_lines(values, bounds, is_longitude);
  } catch (const InvalidInput& error) {
    return {error.what(), error.index()};
  }
  return {};
}

TEST(axes, latitudes_that_rounding_moved_beyond_a_pole_are_there) {
  const double next = std::nextafter(90.0F, 100.0F);
  Doubles lat = {-next, -90, 0, no_number, 90.000009, 45};
  EXPECT_EQ(clamp_at_poles(lat), lat.size());
  EXPECT_EQ(lat[0], -90);
  EXPECT_EQ(lat[4], 90);
  EXPECT_TRUE(std::isnan(lat[3]));
  lat = {90.00001, 90.00002, 91, -95};
  EXPECT_EQ(clamp_at_poles(lat), 1U);
  EXPECT_EQ(lat, (Doubles{90, 90.00002, 91, -95}));
  EXPECT_EQ(clamp_at_poles({}), 0U);
}

TEST(axes, of_less_than_two_cells_without_bounds_are_refused_with_their_number) {
  const auto why = [](const Doubles& values, bool is_longitude) {
    try {
      (void)axis_lines(values, {}, is_longitude);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(why({}, false), "there are no latitudes");
  EXPECT_EQ(why({47.5}, false), "one latitude without bounds, 47.5, has no width");
  EXPECT_EQ(why({7}, true), "one longitude without bounds, 7, has no width");
}

TEST(axes, of_cells_are_in_order) {
  const std::string throughout = ", but an axis of cells must increase or decrease throughout";
  using Refusal = std::pair<std::string, std::size_t>;
  const auto latitudes = [](const Doubles& values, const Doubles& bounds = {}) {
    return refusal_of_axis(values, bounds, false);
  };
  const auto longitudes = [](const Doubles& values, const Doubles& bounds = {}) {
    return refusal_of_axis(values, bounds, true);
  };
  EXPECT_EQ(latitudes({-50, 10, -10, 50}),
            Refusal("latitude 2, -10, is not north of latitude 1, 10" + throughout, 2));
  EXPECT_EQ(latitudes({50, -10, 10, -50}),
            Refusal("latitude 2, 10, is not south of latitude 1, -10" + throughout, 2));
  EXPECT_EQ(latitudes({-50, -10, -10, 50}),
            Refusal("latitude 2, -10, repeats latitude 1, -10" + throughout, 2));
  EXPECT_EQ(latitudes({7, 7}), Refusal("latitude 1, 7, repeats latitude 0, 7" + throughout, 1));
  // Also where bounds are in order, or are lines that are not.
  EXPECT_EQ(latitudes({-30, 10, -10, 30}, {-40, -20, -20, 0, 0, 20, 20, 40}).second, 2U);
  EXPECT_EQ(
      latitudes({-10, 0, 10}, {-15, 5, -5, 15}),
      Refusal("bound of latitudes 2, -5, is not north of bound of latitudes 1, 5" + throughout, 2));
  EXPECT_EQ(longitudes({0, 100, 50, 150}),
            Refusal("longitude 2, 50, is not east of longitude 1, 100" + throughout, 2));
  EXPECT_EQ(longitudes({20, 10, 15}).second, 1U);
  EXPECT_EQ(longitudes({0, 60, 60, 120}),
            Refusal("longitude 2, 60, repeats longitude 1, 60" + throughout, 2));
  EXPECT_EQ(longitudes({350, 355, -5, 0}).second, 2U);
  EXPECT_EQ(longitudes({0, 360}).second, 1U);
  EXPECT_EQ(longitudes({10, 0, -10, -5}),
            Refusal("longitude 3, -5, is not west of longitude 2, -10" + throughout, 3));
  EXPECT_EQ(longitudes({0, 150, 300, 90}),
            Refusal("longitude 3, 90, is more than once around the globe from longitude 0, 0", 3));
  EXPECT_EQ(longitudes({0, 100, 200}, {-50, 50, 40, 150}).second, 2U);
  // Steps of half a turn and more, and ends that meet, are in order.
  for (const Doubles& right : {Doubles{-90, 90, -90}, Doubles{0, 200}, Doubles{0, 1, 300},
                               Doubles{0, 120, 240, 0}, Doubles{170, -170, -150}}) {
    EXPECT_EQ(longitudes(right), Refusal()) << right[0] << ' ' << right[1];
  }
}

TEST(axes, bounds_that_overlap_say_so) {
  EXPECT_EQ(refusal_of_axis({-45, 40}, {-90, 0, -10, 90}, false).first,
            "bounds of cell 1, -10 to 90, overlap those of cell 0, -90 to 0");
  EXPECT_EQ(refusal_of_axis({45, -40}, {0, 90, -90, 10}, false).first,
            "bounds of cell 1, -90 to 10, overlap those of cell 0, 0 to 90");
  EXPECT_EQ(refusal_of_axis({100, 270}, {0, 200, 180, 360}, true).first,
            "bounds of cell 1, 180 to 360, overlap those of cell 0, 0 to 200");
  EXPECT_EQ(refusal_of_axis({5, 14}, {0, 10, 8, 20}, true).first,
            "bounds of cell 1, 8 to 20, overlap those of cell 0, 0 to 10");
  EXPECT_EQ(refusal_of_axis({5, 16}, {0, 10, 12, 20}, true).first,
            "bounds leave a gap before cell 1");
  EXPECT_EQ(refusal_of_axis({60, 180, 300}, {0, 120, 240, 400}, true).first,
            "bounds of longitudes go around the globe more than once");
}

TEST(axes, are_within_a_million_degrees) {
  const auto refusal = [](const Doubles& values, const Doubles& bounds) {
    return refusal_of_axis(values, bounds, true);
  };
  using Refusal = std::pair<std::string, std::size_t>;
  EXPECT_EQ(refusal({999'999, 1e6}, {}), Refusal());
  EXPECT_EQ(refusal({999'999, 1'000'001}, {}), Refusal("longitude 1 is too large", 1));
  EXPECT_EQ(refusal({0, -1'000'001}, {}), Refusal("longitude 1 is too large", 1));
  EXPECT_EQ(refusal({0, no_number}, {}), Refusal("longitude 1 is not finite", 1));
  EXPECT_EQ(refusal({0, 1}, {-1, no_number, 2}), Refusal("bound of longitudes 1 is not finite", 1));
}

}  // namespace
}  // namespace rondel::test
