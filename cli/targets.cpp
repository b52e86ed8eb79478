// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

constexpr std::string_view grid_prefix = "grid:";
constexpr std::uint64_t most_targets = 1'000'000'000;

struct Grid {
  std::uint64_t num_lon = 0;
  std::uint64_t num_lat = 0;
};

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// How often the width goes into an angle.
std::optional<std::uint64_t> times(double width_deg, double angle_deg) {
  const double ratio = std::round(angle_deg / width_deg);
  constexpr double tolerance = 1e-9;  // for thirds and the like, written with some digits
  if (!(ratio >= 1 && std::abs(ratio * width_deg - angle_deg) <= tolerance * angle_deg)) return {};
  return static_cast<std::uint64_t>(ratio);
}

std::optional<Grid> grid_of(std::string_view text) {
  const std::size_t by = text.find('x');
  Grid grid;
  if (by == std::string_view::npos) {
    const auto width = number<double>(text);
    if (!width || !(*width >= 1e-3 && *width <= 180)) return {};
    grid = {times(*width, 360).value_or(0), times(*width, 180).value_or(0)};
  } else {
    grid = {number<std::uint64_t>(text.substr(0, by)).value_or(0),
            number<std::uint64_t>(text.substr(by + 1)).value_or(0)};
  }
  const bool is_empty = grid.num_lon == 0 || grid.num_lat == 0;
  if (is_empty || grid.num_lon > most_targets / grid.num_lat) return {};
  return grid;
}

// The middle of interval i of n; rounded once.
double middle(std::uint64_t i, std::uint64_t n, double low_deg, double high_deg) {
  const auto odd = static_cast<double>(2 * i + 1);
  const auto count = static_cast<double>(n);
  return (low_deg * 2 * count + odd * (high_deg - low_deg)) / (2 * count);
}

Targets grid_targets(const std::string& text, const Grid& grid) {
  Targets targets;
  targets.table.name = text;
  targets.table.first_line = 0;
  targets.table.positions.reserve(grid.num_lat * grid.num_lon);
  for (std::uint64_t row = 0; row < grid.num_lat; ++row) {
    const double lat_deg = middle(row, grid.num_lat, -90, 90);
    for (std::uint64_t column = 0; column < grid.num_lon; ++column)
      targets.table.positions.push_back({middle(column, grid.num_lon, -180, 180), lat_deg});
  }
  targets.table.sites = unit_vectors(targets.table.positions);
  targets.shape = {grid.num_lat, grid.num_lon};
  return targets;
}

}  // namespace

std::string targets_error(const std::string& text) {
  if (!text.starts_with(grid_prefix)) {
    return text.empty() || text == "-" ? "a file or grid:DEG is wanted" : "";
  }
  if (grid_of(std::string_view(text).substr(grid_prefix.size()))) return {};
  return "'" + text + "' is not a grid: DEG must divide 180, or be NLONxNLAT; at most 10^9 targets";
}

Targets read_targets(Job& job, const std::string& text, const ReadOptions& read) {
  if (text.starts_with(grid_prefix))
    return grid_targets(text, *grid_of(std::string_view(text).substr(grid_prefix.size())));
  Targets targets;
  targets.table = job.read({text, ""}, read);
  targets.shape = {targets.table.sites.size()};
  return targets;
}

}  // namespace rondel::cli
