// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random axes of cells: lines are drawn first, then what files say of them, in every form that they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "rondel/conventions.h"
#include "rondel/error.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using Doubles = std::vector<double>;

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
    } else if (right[n] - right[0] > 360) {
      continue;
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

}  // namespace
}  // namespace rondel::test
