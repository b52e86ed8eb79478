// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds pairs of lines in the plane whose bounding rectangles overlap.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

// A line of the plane. `name` is an index of the caller.
struct Line {
  LonLat from;
  LonLat to;
  std::size_t name;
};

// A closed rectangle along the axes, in degrees.
struct Rectangle {
  double west;
  double east;
  double south;
  double north;

  static Rectangle around(const Line& line) {
    const auto [west, east] = std::minmax(line.from.lon_deg, line.to.lon_deg);
    const auto [south, north] = std::minmax(line.from.lat_deg, line.to.lat_deg);
    return {west, east, south, north};
  }

  [[nodiscard]] bool overlaps(const Rectangle& other) const {
    return west <= other.east && other.west <= east && south <= other.north && other.south <= north;
  }
};

// Two lines, the earlier one first.
struct LinePair {
  std::size_t first;
  std::size_t second;
};

// Returns an order of lines in which lines that are near each other follow each other: along a
// curve through the plane. It is empty if the lines come in few runs of lines that begin where the
// line before them ends, which are in such an order already.
std::vector<std::size_t> order_along_curve(const std::vector<Line>& lines);

// Sorts pairs as a tree of the lines in their given order finds them: those of the first half, those
// of the second half, and those of both.
void sort_as_in_tree(std::vector<LinePair>& pairs);

// A tree of rectangles: level 0 has the rectangles around the lines, level 1 those around the lines
// 2i and 2i + 1, and so on up to one around all. Lines that follow each other are near each other,
// so the rectangles are small; where they are not, the tree has them in another order. A sweep would
// compare all lines along a meridian with each other.
class Rectangles {
 public:
  explicit Rectangles(const std::vector<Line>& lines)
      : lines_(lines), order_(order_along_curve(lines)) {
    all_.reserve(2 * lines.size() + std::numeric_limits<std::size_t>::digits);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      all_.push_back(Rectangle::around(lines[line_at(i)]));
    }
    for (std::size_t first = 0; all_.size() - first > 1;) {
      const std::size_t past = all_.size();
      firsts_.push_back(past);
      for (std::size_t i = first; i < past; i += 2) {
        all_.push_back(i + 1 < past ? joined(all_[i], all_[i + 1]) : all_[i]);
      }
      first = past;
    }
    firsts_.push_back(all_.size());
  }

  // Calls `report` with each line whose rectangle overlaps the given one, in their order.
  template <typename Report>
  void find_overlapping(const Rectangle& rectangle, const Report& report) const {
    if (lines_.empty()) return;
    if (order_.empty()) {
      around(firsts_.size() - 2, 0, rectangle, [&](std::size_t i) { report(lines_[i]); });
      return;
    }
    std::vector<std::size_t> found;
    around(firsts_.size() - 2, 0, rectangle, [&](std::size_t i) { found.push_back(order_[i]); });
    std::ranges::sort(found);
    for (const std::size_t i : found) report(lines_[i]);
  }

  // Calls `report` with each pair of lines whose rectangles overlap, as in sort_as_in_tree().
  template <typename Report>
  void find_overlapping(const Report& report) const {
    if (lines_.size() < 2) return;
    if (order_.empty()) {
      within(firsts_.size() - 2, 0,
             [&](std::size_t i, std::size_t j) { report(lines_[i], lines_[j]); });
      return;
    }
    std::vector<LinePair> pairs;
    within(firsts_.size() - 2, 0, [&](std::size_t i, std::size_t j) {
      const auto [first, second] = std::minmax(order_[i], order_[j]);
      pairs.push_back({first, second});
    });
    sort_as_in_tree(pairs);
    for (const auto& [first, second] : pairs) report(lines_[first], lines_[second]);
  }

 private:
  // Returns the line of a rectangle of level 0.
  [[nodiscard]] std::size_t line_at(std::size_t i) const { return order_.empty() ? i : order_[i]; }

  static Rectangle joined(const Rectangle& a, const Rectangle& b) {
    return {std::min(a.west, b.west), std::max(a.east, b.east), std::min(a.south, b.south),
            std::max(a.north, b.north)};
  }

  [[nodiscard]] std::size_t size(std::size_t level) const {
    return firsts_[level + 1] - firsts_[level];
  }

  [[nodiscard]] const Rectangle& at(std::size_t level, std::size_t i) const {
    return all_[firsts_[level] + i];
  }

  template <typename Report>
  void around(std::size_t level, std::size_t i, const Rectangle& rectangle,
              const Report& report) const {
    if (!at(level, i).overlaps(rectangle)) return;
    if (level == 0) {
      report(i);
      return;
    }
    for (std::size_t k = 2 * i; k < std::min(2 * i + 2, size(level - 1)); ++k)
      around(level - 1, k, rectangle, report);
  }

  // Reports the pairs of overlapping lines inside one rectangle.
  template <typename Report>
  void within(std::size_t level, std::size_t i, const Report& report) const {
    if (level == 0) return;
    const std::size_t first = 2 * i;
    within(level - 1, first, report);
    if (first + 1 >= size(level - 1)) return;
    within(level - 1, first + 1, report);
    between(level - 1, first, first + 1, report);
  }

  // Reports the pairs of a line in one rectangle with a line in another of the same level.
  template <typename Report>
  void between(std::size_t level, std::size_t i, std::size_t j, const Report& report) const {
    if (!at(level, i).overlaps(at(level, j))) return;
    if (level == 0) {
      report(i, j);
      return;
    }
    const std::size_t past = size(level - 1);
    for (std::size_t a = 2 * i; a < std::min(2 * i + 2, past); ++a) {
      for (std::size_t b = 2 * j; b < std::min(2 * j + 2, past); ++b) {
        between(level - 1, a, b, report);
      }
    }
  }

  const std::vector<Line>& lines_;
  std::vector<std::size_t> order_;      // the line of each rectangle of level 0; empty: as they are
  std::vector<Rectangle> all_;          // of all levels, from the lowest on
  std::vector<std::size_t> firsts_{0};  // where each level begins, and the end of the last
};

}  // namespace rondel::map
