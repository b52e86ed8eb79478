// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Bilinear weights on the axes of a grid.
//
//   north   c-----------d    along: 0 at south, 1 at north
//           |     x     |    across: 0 at west, 1 at east
//   south   a-----------b
//         west        east   the weight of a is (1 - along) (1 - across) ...
//
// in    two axes in any direction and at any turn, and targets in degrees
// out   a row for each target
// index columns and rows of the grid in increasing order in GridEntry; places as given in the result
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regrid.h"
#include "system/arithmetic.h"
#include "system/message_text.h"

namespace rondel {
namespace {

constexpr double turn_deg = 360;
constexpr std::size_t max_places = no_index / 2;  // signed 32-bit integers count them, too
// A column that is a turn after the first one up to this difference repeats it, as axes in single
// precision do.
constexpr double repeated_deg = 1e-4;

// Returns the remainder in [0, 360); fmod() is exact. A negative number that is nearly 0 gives 360.
double within_turn(double degrees) {
  const double rest = std::fmod(degrees, turn_deg);
  return rest < 0 ? rest + turn_deg : rest;
}

// Returns the longitudes shifted by turns so that steps are at most 180 degrees.
std::vector<double> unwrapped(std::span<const double> degrees) {
  constexpr double half = turn_deg / 2;
  std::vector<double> result(degrees.begin(), degrees.end());
  double shift = 0;
  for (std::size_t i = 1; i < degrees.size(); ++i) {
    const double step = degrees[i] - degrees[i - 1];
    if (std::abs(step) >= half) {
      double shortest = within_turn(step + half) - half;
      if (shortest == -half && step > 0) shortest = half;
      shift += shortest - step;
    }
    result[i] = degrees[i] + shift;
  }
  return result;
}

// Returns the numbers of an axis, unwrapped if they are longitudes. Throws InvalidInput for what is
// no axis.
std::vector<double> checked_axis(std::span<const double> given, const std::string& name,
                                 bool is_longitude) {
  const auto text_at = [&](std::size_t i) {
    return name + '[' + std::to_string(i) + "] is " + system::shortest_text(given[i]);
  };
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!std::isfinite(given[i])) throw InvalidInput(text_at(i) + ": an axis has no gaps", i);
  }
  const std::string rule = name + " must be an axis: two numbers or more, increasing or decreasing";
  if (given.size() < 2) {
    throw InvalidInput(rule + "; " + (given.empty() ? "there are none" : text_at(0) + " alone"));
  }
  std::vector<double> axis =
      is_longitude ? unwrapped(given) : std::vector<double>(given.begin(), given.end());
  std::size_t num_decreasing = 0;
  for (std::size_t i = 1; i < axis.size(); ++i) num_decreasing += axis[i] < axis[i - 1] ? 1 : 0;
  const bool is_decreasing = 2 * num_decreasing > axis.size() - 1;
  for (std::size_t i = 1; i < axis.size(); ++i) {
    if (is_decreasing ? axis[i] < axis[i - 1] : axis[i] > axis[i - 1]) continue;
    throw InvalidInput(rule + "; " + text_at(i) + " after " + system::shortest_text(given[i - 1]),
                       i);
  }
  return axis;
}

// An axis in increasing order, and the position of each number in the axis as given.
struct SortedAxis {
  explicit SortedAxis(const std::vector<double>& axis) : degrees(axis), positions(axis.size()) {
    std::iota(positions.begin(), positions.end(), std::size_t{0});
    if (axis.front() < axis.back()) return;
    std::ranges::reverse(degrees);
    std::ranges::reverse(positions);
  }

  void shorten(std::size_t size) {
    degrees.resize(size);
    positions.resize(size);
  }
  // Returns the longest and the shortest step.
  [[nodiscard]] std::pair<double, double> steps() const {
    double longest = degrees[1] - degrees[0];
    double shortest = longest;
    for (std::size_t i = 2; i < degrees.size(); ++i) {
      longest = std::max(longest, degrees[i] - degrees[i - 1]);
      shortest = std::min(shortest, degrees[i] - degrees[i - 1]);
    }
    return {longest, shortest};
  }

  std::vector<double> degrees;
  std::vector<std::size_t> positions;
};

// The number of an axis before a value, and how far the value is from there to the next one, in
// steps. It may be below 0 or above 1.
struct AlongAxis {
  std::size_t first = 0;
  double share = 0;
  [[nodiscard]] bool is_inside() const { return share >= 0 && share <= 1; }
};

AlongAxis between(const std::vector<double>& axis, double value, double rounding_deg) {
  const auto after = std::ranges::upper_bound(axis, value) - axis.begin();
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(axis.size()) - 2));
  const double begin = axis[first];
  const double end = axis[first + 1];
  if (std::abs(value - end) <= rounding_deg) return {first, 1};
  if (std::abs(value - begin) <= rounding_deg) return {first, 0};
  return {first, (value - begin) / (end - begin)};
}

// A place of the grid and a part of its weight.
struct GridEntry {
  std::size_t row = 0;
  std::size_t column = 0;
  double weight = 0;

  [[nodiscard]] std::pair<std::size_t, std::size_t> place() const { return {row, column}; }
};

class BilinearGrid {
 public:
  BilinearGrid(const std::vector<double>& lon_deg, const std::vector<double>& lat_deg,
               double rounding_deg)
      : num_lon_(lon_deg.size()), lons_(lon_deg), lats_(lat_deg) {
    const double turn_later = lons_.degrees.front() + turn_deg - repeated_deg;
    const auto repeated = std::ranges::lower_bound(lons_.degrees, turn_later);
    lons_.shorten(static_cast<std::size_t>(repeated - lons_.degrees.begin()));
    if (lons_.degrees.size() < 2) {
      throw InvalidInput("lon must be an axis of two different meridians or more");
    }
    const auto [longest, shortest] = lons_.steps();
    rounding_deg_ = std::min(rounding_deg, std::min(shortest, lats_.steps().second) / 1000);
    const double gap = turn_deg - (lons_.degrees.back() - lons_.degrees.front());
    is_around_ = gap <= 1.5 * longest;
    meridians_ = lons_.degrees;
    if (is_around_) meridians_.push_back(lons_.degrees.front() + turn_deg);
  }

  // Replaces `row` by the entries of a target, which may be several for one place.
  void find_entries(const LonLat& target, std::vector<GridEntry>& row) const {
    row.clear();
    const AlongAxis columns = between_columns(target.lon_deg);
    const AlongAxis rows = between(lats_.degrees, target.lat_deg, rounding_deg_);
    if (!columns.is_inside()) return;
    if (rows.is_inside()) {
      add_columns(rows.first, 1 - rows.share, columns, row);
      add_columns(rows.first + 1, rows.share, columns, row);
    } else if (is_around_) {
      add_to_pole(target.lat_deg, rows.share < 0 ? 0 : lats_.degrees.size() - 1, columns, row);
    }
  }

  // Appends entries to the last row of the weights: by place, one for each place.
  void append(std::vector<GridEntry>& row, Weights& weights) const {
    std::erase_if(row, [](const GridEntry& entry) { return entry.weight == 0; });
    // Entries of one place keep their order, in which they are summed.
    std::stable_sort(row.begin(), row.end(),
                     [](const GridEntry& a, const GridEntry& b) { return a.place() < b.place(); });
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0 && row[k].place() == row[k - 1].place()) {
        weights.values.back() += row[k].weight;
        continue;
      }
      const std::size_t place =
          lats_.positions[row[k].row] * num_lon_ + lons_.positions[row[k].column];
      weights.columns.push_back(static_cast<Index>(place));
      weights.values.push_back(row[k].weight);
    }
  }

 private:
  [[nodiscard]] AlongAxis between_columns(double lon_deg) const {
    const double first = lons_.degrees.front();
    double wrapped = first + within_turn(lon_deg - first);
    if (wrapped > meridians_.back() + rounding_deg_) wrapped -= turn_deg;
    return between(meridians_, wrapped, rounding_deg_);
  }

  // Adds the value between two columns in a row, times a factor.
  void add_columns(std::size_t row, double factor, const AlongAxis& columns,
                   std::vector<GridEntry>& entries) const {
    const std::size_t east = (columns.first + 1) % lons_.degrees.size();
    entries.push_back({row, columns.first, factor * (1 - columns.share)});
    entries.push_back({row, east, factor * columns.share});
  }

  // Adds what is linear between the value in the last row and the mean of that row at the pole, if
  // the target is between the two.
  void add_to_pole(double lat_deg, std::size_t last, const AlongAxis& columns,
                   std::vector<GridEntry>& entries) const {
    const double edge = lats_.degrees[last];
    const bool is_same_side = edge != 0 && (edge < 0) == (lat_deg < 0);
    if (!is_same_side || std::abs(lat_deg) <= std::abs(edge)) return;
    const double to_pole = (std::abs(lat_deg) - std::abs(edge)) / (90 - std::abs(edge));
    add_columns(last, 1 - to_pole, columns, entries);
    const std::size_t num_columns = lons_.degrees.size();
    const double mean = to_pole / static_cast<double>(num_columns);
    for (std::size_t column = 0; column < num_columns; ++column) {
      entries.push_back({last, column, mean});
    }
  }

  std::size_t num_lon_;  // with the columns that repeat others
  SortedAxis lons_;      // without them
  SortedAxis lats_;
  std::vector<double> meridians_;  // those of lons_, and the first one a turn later
  double rounding_deg_ = 0;
  bool is_around_ = false;
};

std::vector<LonLat> places_of_axes(const LonLatAxes& axes) {
  std::vector<LonLat> places;
  places.reserve(axes.lon_deg.size() * axes.lat_deg.size());
  for (const double lat : axes.lat_deg) {
    for (const double lon : axes.lon_deg) places.push_back({lon, lat});
  }
  return places;
}

}  // namespace

std::optional<LonLatAxes> axes_of_grid(std::span<const LonLat> places,
                                       std::span<const std::uint64_t> shape) {
  if (shape.size() != 2 || places.empty() || shape[0] == 0 ||
      places.size() / shape[0] != shape[1] || places.size() % shape[0] != 0) {
    return std::nullopt;
  }
  const auto num_lon = static_cast<std::size_t>(shape[1]);
  LonLatAxes axes;
  for (std::size_t i = 0; i < num_lon; ++i) axes.lon_deg.push_back(places[i].lon_deg);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k % num_lon == 0) axes.lat_deg.push_back(places[k].lat_deg);
    if (places[k] != LonLat{axes.lon_deg[k % num_lon], axes.lat_deg.back()}) return std::nullopt;
  }
  return axes;
}

double rounding_of(const LonLatAxes& axes) {
  bool is_round = true;
  for (const auto* const axis : {&axes.lon_deg, &axes.lat_deg}) {
    for (const double number : *axis) {
      if (!(std::abs(number) < turn_deg * 4) ||
          static_cast<double>(static_cast<float>(number)) != number) {
        return double_rounding_deg;
      }
      is_round = is_round && std::trunc(number * 1024) == number * 1024;
    }
  }
  return is_round ? double_rounding_deg : single_rounding_deg;
}

Weights bilinear_weights(const LonLatAxes& grid, std::span<const LonLat> targets,
                         double rounding_deg) {
  const system::ArithmeticScope arithmetic;
  const LonLatAxes axes = {.lon_deg = checked_axis(grid.lon_deg, "lon", true),
                           .lat_deg = checked_axis(grid.lat_deg, "lat", false)};
  if (axes.lat_deg.size() > max_places / axes.lon_deg.size()) {
    throw InvalidInput("a grid of " + std::to_string(axes.lon_deg.size()) + " x " +
                       std::to_string(axes.lat_deg.size()) + " places is too large");
  }
  Weights weights;
  weights.num_columns = axes.lon_deg.size() * axes.lat_deg.size();
  weights.sites_hash = point_set_hash(unit_vectors(places_of_axes(axes)));
  weights.targets_hash = point_set_hash(unit_vectors(targets));
  weights.offsets.reserve(targets.size() + 1);
  const BilinearGrid rectangles(axes.lon_deg, axes.lat_deg, rounding_deg);
  std::vector<GridEntry> row;
  for (const LonLat& target : targets) {
    rectangles.find_entries(target, row);
    rectangles.append(row, weights);
    weights.end_row();
  }
  return weights;
}

std::vector<Duplicate> repeated_places(const LonLatAxes& grid) {
  const std::vector<double>& lons = grid.lon_deg;
  if (!std::ranges::all_of(lons, [](double lon) { return std::isfinite(lon); })) return {};
  std::vector<std::pair<double, Index>> columns;  // by longitude within a turn
  std::vector<Index> first(lons.size());
  std::iota(first.begin(), first.end(), Index{0});
  columns.reserve(lons.size());
  for (const Index c : first) columns.emplace_back(within_turn(lons[c] + repeated_deg), c);
  std::ranges::sort(columns);
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const auto [east, column] = columns[k];
    const auto [before, other] = columns[k - 1];
    const bool is_turn_later = std::abs(lons[column] - lons[other]) > turn_deg / 2;
    if (east - before > repeated_deg || !is_turn_later) continue;
    first[column] = first[other] = std::min({first[other], column, other});
  }
  std::vector<Duplicate> repeated;
  for (std::size_t row = 0; row < grid.lat_deg.size(); ++row) {
    const auto begin = static_cast<Index>(row * lons.size());
    for (Index c = 0; c < static_cast<Index>(lons.size()); ++c) {
      if (first[c] != c) repeated.push_back({begin + c, begin + first[c]});
    }
  }
  return repeated;
}

}  // namespace rondel
