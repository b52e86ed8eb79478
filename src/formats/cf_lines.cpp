// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the lines between the cells of an axis: axis_lines() and require_order(). Lines come from
// the bounds (CF section 7.1, two for each cell, or one more than cells), or else lie halfway
// between the coordinates.
//
// Longitudes are first made monotonic by whole turns. At last, latitudes are ended at the poles,
// and longitudes that go around the globe are closed. All numbers are degrees.
#include "formats/cf_lines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "rondel/conventions.h"
#include "rondel/error.h"
#include "system/arithmetic.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// The distance by which rounding to single precision may have moved a bound, as a share of a cell's
// width.
constexpr double rounding_share = 1e-3;

// Returns the largest distance, in degrees, of a coordinate from the middle of its cell. Rounding to
// single precision may add to it.
double most_apart(double width) {
  constexpr double rounding = 1e-4;
  return 1.5 * width + rounding;
}

// The sides of a cell along an axis, in degrees.
struct CellSides {
  double low;
  double high;
};

// Throws InvalidInput for the first coordinate that is not finite or is beyond a million degrees.
void require_finite_axis(std::span<const double> values, const std::string& what) {
  constexpr double max_degrees = 1e6;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) <= max_degrees) continue;
    throw InvalidInput(what + " " + std::to_string(i) + " is " +
                           (std::isfinite(values[i]) ? "too large" : "not finite"),
                       i);
  }
}

// Adds whole turns so that each longitude lies less than a turn beyond the one before it, to the
// east if `sign` is 1 and to the west if it is -1.
void unroll(std::vector<double>& values, double sign) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double turns = std::ceil(sign * (values[i - 1] - values[i]) / 360);
    values[i] += sign * turns * 360;
  }
}

// True if most steps go west when each takes the shorter way around. Values that all increase go
// east, and three or more that all decrease within one turn go west, even if a step is more than
// half a turn.
bool goes_west(const std::vector<double>& values) {
  if (std::ranges::is_sorted(values)) return false;
  if (values.size() > 2 && std::ranges::is_sorted(values, std::greater_equal{}) &&
      values.front() - values.back() <= 360) {
    return true;
  }
  std::size_t num_west = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    num_west += std::remainder(values[i] - values[i - 1], 360) < 0 ? 1U : 0U;
  }
  return 2 * num_west > values.size() - 1;
}

// Returns a coordinate with its number, "latitude 2, -20,".
std::string numbered(const std::string& name, std::size_t i, double value) {
  return name + " " + std::to_string(i) + ", " + system::shortest_text(value) + ",";
}

// Returns the steps from each value to the next one, and their direction, 1 or -1. Longitudes that
// jump by turns go the shorter way around.
std::pair<std::vector<double>, double> steps_along_axis(std::span<const double> values,
                                                        bool is_longitude) {
  std::vector<double> steps;
  std::size_t num_down = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.push_back(values[i] - values[i - 1]);
    num_down += steps.back() < 0 ? 1U : 0U;
  }
  const std::size_t n = steps.size();
  const bool is_sorted =
      std::ranges::all_of(steps, [&](double step) { return num_down == n ? step < 0 : step > 0; });
  if (!is_longitude) return {steps, 2 * num_down > n ? -1.0 : 1.0};
  const double sign = goes_west({values.begin(), values.end()}) ? -1 : 1;
  for (double& step : steps) {
    // Sorted longitudes may have steps of more than half a turn.
    const double shorter = std::remainder(step, 360);
    step = is_sorted && shorter != 0 ? sign : std::abs(shorter) == 180 ? sign * 180 : shorter;
  }
  return {steps, sign};
}

// Throws InvalidInput if longitudes go around more than once; the last one may be the first one
// again.
void require_one_turn_of_axis(std::span<const double> values, const std::vector<double>& unrolled,
                              const std::string& name) {
  const double most = 360 + rounding_share * std::abs(unrolled[1] - unrolled[0]);
  for (std::size_t i = 1; i < unrolled.size(); ++i) {
    if (std::abs(unrolled[i] - unrolled[0]) <= most) continue;
    throw InvalidInput(numbered(name, i, values[i]) + " is more than once around the globe from " +
                           name + " 0, " + system::shortest_text(values[0]),
                       i);
  }
}

// Returns lines halfway between neighbors, and at both ends as far beyond.
std::vector<double> halves(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> lines = {values[0] - (values[1] - values[0]) / 2};
  for (std::size_t i = 0; i + 1 < n; ++i) lines.push_back((values[i] + values[i + 1]) / 2);
  lines.push_back(values[n - 1] + (values[n - 1] - values[n - 2]) / 2);
  return lines;
}

// Puts the line between the last and the first cell of longitudes that go around the globe half way
// between their coordinates. They do if the gap is no wider than their widest step, unless this is more
// than half a turn and leaves room for the gap. Where the gap is as wide as the cells at both ends reach
// beyond their coordinates, as with even steps, close_circle() does it.
void meet_in_gap(std::vector<double>& lines, const std::vector<double>& values) {
  const std::size_t n = values.size();
  const double first_step = values[1] - values[0];
  const double last_step = values[n - 1] - values[n - 2];
  double widest = 0;
  for (std::size_t i = 1; i < n; ++i)
    widest = std::max(widest, std::abs(values[i] - values[i - 1]));
  const double rounding = rounding_share * std::min(std::abs(first_step), std::abs(last_step));
  const double gap = 360 - std::abs(values[n - 1] - values[0]);
  if (gap <= rounding || gap > widest + rounding) return;
  const double beyond = std::abs(first_step + last_step) / 2;
  if (std::abs(beyond - gap) <= rounding || (widest > 180 && beyond < gap)) return;
  const double sign = first_step > 0 ? 1 : -1;
  lines.front() = values[0] - sign * gap / 2;
  lines.back() = lines.front() + sign * 360;
}

// Closes a grid around the globe: removes a gap that comes from rounding, and if the cells at both
// ends are the same one, gives each half of it.
void close_circle(std::vector<double>& lines, double first, double last) {
  const std::size_t n = lines.size();
  const double turn = lines.back() > lines.front() ? 360 : -360;
  const double width =
      std::min(std::abs(lines[1] - lines[0]), std::abs(lines[n - 1] - lines[n - 2]));
  const double excess = std::abs(lines.back() - lines.front()) - 360;
  if (std::abs(excess) <= rounding_share * width) {
    lines.back() = lines.front() + turn;
  } else if (n > 3 && excess > 0 &&
             std::abs(std::abs(last - first) - 360) <= rounding_share * width) {
    const double middle = (lines[0] + lines[1]) / 2;
    lines.front() = first + std::round((middle - first) / 360) * 360;
    lines.back() = lines.front() + turn;
  }
}

// Moves the first and the last line to a pole that is less than a cell beyond them.
void end_at_poles(std::vector<double>& lines) {
  const auto to_pole = [](double line, double width) {
    return 90 - std::abs(line) < std::abs(width) ? std::copysign(90, line) : line;
  };
  const std::size_t n = lines.size();
  // Both widths are taken before either line moves, which matters for an axis of one cell.
  const double last_width = lines[n - 1] - lines[n - 2];
  lines[0] = to_pole(lines[0], lines[1] - lines[0]);
  lines[n - 1] = to_pole(lines[n - 1], last_width);
}

// Returns the sides of each cell, the lower one first. Longitudes may jump by a turn within a cell,
// from 350 to 10; the majority of the cells decides which bound is the western one.
std::vector<CellSides> sides_of_bounds(std::span<const double> bounds, bool is_longitude) {
  std::vector<CellSides> cells;
  std::ptrdiff_t num_forward = 0;
  for (std::size_t i = 0; i + 1 < bounds.size(); i += 2) {
    cells.push_back({bounds[i], bounds[i + 1]});
    const double width = bounds[i + 1] - bounds[i];
    if (std::abs(width) <= 180 && width != 0) num_forward += width > 0 ? 1 : -1;
  }
  for (CellSides& cell : cells) {
    const double width = cell.high - cell.low;
    // Whole turns go from the lower number to the higher one.
    const bool is_whole = std::remainder(width, 360) == 0;
    const bool is_swapped = is_longitude && num_forward != 0
                                ? num_forward < 0
                                : width < 0 && (!is_longitude || width >= -180 || is_whole);
    if (is_swapped) std::swap(cell.low, cell.high);
    if (is_longitude && cell.high < cell.low) cell.high += 360;
  }
  return cells;
}

// Turns the only cell of longitudes around, from a to b into from b to a, if its coordinate says so. A
// pair of bounds may mean both if it decreases or is wider than half a turn. A coordinate that is in
// neither by much is that of the cell whose middle is nearer.
void turn_to_coordinate(CellSides& cell, std::span<const double> pair, double value) {
  const double as_given = pair[1] - pair[0];
  const double width = cell.high - cell.low;
  if ((as_given > 0 && as_given <= 180) || !(width > 0 && width < 360)) return;
  const double distance = std::abs(std::remainder(value - (cell.low + cell.high) / 2, 360));
  if (distance <= width / 2 * (1 + rounding_share)) return;
  // The middles of both are half a turn apart.
  if (distance <= 90 && distance <= most_apart(width)) return;
  cell = {cell.high, cell.low + 360};
}

// Throws InvalidInput with the bounds of cells k and i, which overlap.
[[noreturn]] void refuse_overlap(const std::vector<CellSides>& cells, std::size_t k,
                                 std::size_t i) {
  const auto text = [&](std::size_t cell) {
    return std::to_string(cell) + ", " + system::shortest_text(cells[cell].low) + " to " +
           system::shortest_text(cells[cell].high);
  };
  throw InvalidInput("bounds of cell " + text(i) + ", overlap those of cell " + text(k), i);
}

// Returns the lines from the sides of cells, in the order of the cells. Throws InvalidInput if
// neighbors do not share one.
std::vector<double> joined(const std::vector<CellSides>& cells, bool is_longitude) {
  const std::size_t n = cells.size();
  const auto apart = [&](double a, double b) {
    return std::abs(is_longitude ? std::remainder(a - b, 360) : a - b);
  };
  const bool is_upward =
      n < 2 || apart(cells[0].high, cells[1].low) <= apart(cells[0].low, cells[1].high);
  std::vector<double> lines = {is_upward ? cells[0].low : cells[0].high};
  for (std::size_t i = 0; i < n; ++i) {
    // Cells are walked in the direction of the axis, each from the side that it shares with the one
    // before it.
    const double begin = is_upward ? cells[i].low : cells[i].high;
    const double end = is_upward ? cells[i].high : cells[i].low;
    const double turns = is_longitude ? std::round((lines.back() - begin) / 360) * 360 : 0;
    const double gap = begin + turns - lines.back();
    if (!(std::abs(gap) <= rounding_share * std::abs(end - begin))) {
      // A cell that begins before the end of the one before it overlaps that cell.
      if (is_upward == (gap < 0)) refuse_overlap(cells, i - 1, i);
      throw InvalidInput("bounds leave a gap before cell " + std::to_string(i), i);
    }
    lines.push_back(end + turns);
  }
  return lines;
}

// Throws InvalidInput if the lines of longitudes go around the globe more than once, so that cells
// overlap.
void require_one_turn_of_bounds(std::span<const double> bounds, const std::vector<double>& lines) {
  const bool are_lines = bounds.size() == lines.size();
  constexpr double rounding = 1e-9;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    if (std::abs(lines[i] - lines[0]) <= 360 + rounding) continue;
    if (!are_lines) refuse_overlap(sides_of_bounds(bounds, true), 0, i - 1);
    throw InvalidInput("bounds of longitudes go around the globe more than once", i);
  }
}

// Returns lines that the file gives. They may jump by whole turns, and may have the reverse order
// of the coordinates.
std::vector<double> lines_as_given(std::span<const double> bounds, std::span<const double> values,
                                   bool is_longitude) {
  std::vector<double> lines(bounds.begin(), bounds.end());
  const std::string name = is_longitude ? "bound of longitudes" : "bound of latitudes";
  formats::require_order(bounds, is_longitude, name);
  if (is_longitude) unroll(lines, goes_west(lines) ? -1 : 1);
  const bool is_upward = lines.back() > lines.front();
  if (is_upward != (values.back() > values.front())) std::ranges::reverse(lines);
  return lines;
}

// Throws InvalidInput if a coordinate is farther from its cell than the cell is wide.
void require_near_cells(std::span<const double> values, std::span<const double> lines,
                        const std::string& name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double away = values[i] - (lines[i] + lines[i + 1]) / 2;
    const double width = std::abs(lines[i + 1] - lines[i]);
    const double distance = std::abs(name == "longitude" ? std::remainder(away, 360) : away);
    if (distance <= most_apart(width)) continue;
    throw InvalidInput(name + " " + system::shortest_text(values[i]) + " is far from its cell, " +
                           system::shortest_text(lines[i]) + " to " +
                           system::shortest_text(lines[i + 1]),
                       i);
  }
}

// Throws InvalidInput for a latitude beyond a pole, up to rounding.
void require_latitudes(std::span<const double> values, const std::string& name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) <= 90 + max_beyond_pole_deg) continue;
    throw InvalidInput(name + " " + system::shortest_text(values[i]) + " is beyond a pole", i);
  }
}

}  // namespace

void formats::require_order(std::span<const double> values, bool is_longitude,
                            const std::string& name) {
  const auto [steps, sign] = steps_along_axis(values, is_longitude);
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = steps[i - 1] * sign;
    if (step > 0 || std::isnan(step)) continue;
    const char* const direction =
        is_longitude ? (sign > 0 ? "east" : "west") : (sign > 0 ? "north" : "south");
    const std::string why = step == 0 ? " repeats " : std::string(" is not ") + direction + " of ";
    throw InvalidInput(numbered(name, i, values[i]) + why + numbered(name, i - 1, values[i - 1]) +
                           " but an axis of cells must increase or decrease throughout",
                       i);
  }
}

std::size_t clamp_at_poles(std::span<double> lat_deg) {
  std::size_t first = lat_deg.size();
  for (std::size_t i = 0; i < lat_deg.size(); ++i) {
    if (!(std::abs(lat_deg[i]) > 90)) continue;
    if (std::abs(lat_deg[i]) <= 90 + max_beyond_pole_deg) {
      lat_deg[i] = std::copysign(90.0, lat_deg[i]);
    } else {
      first = std::min(first, i);
    }
  }
  return first;
}

std::vector<double> axis_lines(std::span<const double> values, std::span<const double> bounds,
                               bool is_longitude) {
  const system::ArithmeticScope arithmetic;
  const std::string name = is_longitude ? "longitude" : "latitude";
  require_finite_axis(values, name);
  require_finite_axis(bounds, is_longitude ? "bound of longitudes" : "bound of latitudes");
  formats::require_order(values, is_longitude, name);
  std::vector<double> unrolled(values.begin(), values.end());
  if (is_longitude && !values.empty()) unroll(unrolled, goes_west(unrolled) ? -1 : 1);
  if (!is_longitude) (void)clamp_at_poles(unrolled);
  std::vector<double> lines;
  const std::size_t n = values.size();
  if (!bounds.empty()) {
    if (n == 0 || (bounds.size() != 2 * n && bounds.size() != n + 1)) {
      throw InvalidInput("bounds of " + std::to_string(n) + " cells have " +
                             std::to_string(bounds.size()) + " values",
                         0);
    }
    if (bounds.size() == n + 1 && n > 1) {
      lines = lines_as_given(bounds, unrolled, is_longitude);
    } else {
      std::vector<CellSides> cells = sides_of_bounds(bounds, is_longitude);
      if (is_longitude && n == 1) turn_to_coordinate(cells.front(), bounds, values[0]);
      lines = joined(cells, is_longitude);
    }
    require_near_cells(values, lines, name);
  } else {
    if (n == 0) throw InvalidInput("there are no " + name + "s", 0);
    if (n == 1) {
      throw InvalidInput(
          "one " + name + " without bounds, " + system::shortest_text(values[0]) + ", has no width",
          0);
    }
    if (is_longitude) require_one_turn_of_axis(values, unrolled, name);
    lines = halves(unrolled);
    if (is_longitude) {
      meet_in_gap(lines, unrolled);
    } else {
      end_at_poles(lines);
    }
  }
  if (!is_longitude) {
    require_latitudes(values, name);
    require_latitudes(lines, bounds.empty() ? "side of cells at latitude" : "bound of latitudes");
    (void)clamp_at_poles(lines);
  }
  if (is_longitude && lines.size() > 2) close_circle(lines, unrolled.front(), unrolled.back());
  if (is_longitude && !bounds.empty()) require_one_turn_of_bounds(bounds, lines);
  return lines;
}

}  // namespace rondel
