// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of the weights of rondel/regrid.h, and of weights for a part of targets and sites.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regrid.h"

namespace rondel::fuzz {
namespace {

// The numbers of an axis: mostly multiples of 1/16 in steps that may differ, else anything.
std::vector<double> next_axis(ByteSource& source, double first, double most) {
  std::vector<double> axis;
  const std::size_t size = source.below(8) == 7 ? source.below(3) : 2 + source.below(7);
  const double step = (1 + static_cast<double>(source.below(32))) / 16 * most;
  const bool is_even = source.below(2) == 0;
  for (std::size_t i = 0; i < size; ++i) {
    axis.push_back(first);
    first += is_even ? step : step * static_cast<double>(1 + source.below(3)) / 2;
  }
  if (!axis.empty() && source.below(16) == 15) axis[source.below(size)] = source.any_double();
  if (source.below(2) == 1) std::ranges::reverse(axis);
  return axis;
}

std::vector<LonLat> next_targets(ByteSource& source, const LonLatAxes& grid) {
  std::vector<LonLat> targets;
  for (std::size_t n = source.below(6); n > 0; --n) {
    LonLat target = {source.small() * 3.5, source.small() * 0.75};
    target.lat_deg = std::clamp(target.lat_deg, -90.0, 90.0);
    if (source.below(2) == 1 && !grid.lon_deg.empty()) {
      target.lon_deg = grid.lon_deg[source.below(grid.lon_deg.size())] + 360.0 * source.small();
    }
    if (source.below(2) == 1 && !grid.lat_deg.empty()) {
      target.lat_deg = grid.lat_deg[source.below(grid.lat_deg.size())];
    }
    targets.push_back(target);
  }
  return targets;
}

// The longest way from one column to the next one, also behind the last one.
double widest_gap(const LonLatAxes& grid) {
  std::set<double> columns;
  for (const double lon : grid.lon_deg) columns.insert(std::remainder(lon, 360.0));
  double widest = 360 - (*columns.rbegin() - *columns.begin());
  for (auto at = columns.begin(), next = std::next(at); next != columns.end(); at = next++) {
    widest = std::max(widest, *next - *at);
  }
  return widest;
}

void test_bilinear_row(const LonLatAxes& grid, const LonLat& target, std::span<const Index> columns,
                       std::span<const double> weights) {
  const std::size_t num_lon = grid.lon_deg.size();
  double sum = 0;
  double east = 0;
  double lat = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    require(weights[k] > 0 && weights[k] <= 1, "a weight is in (0, 1]");
    require(std::ranges::count(columns, columns[k]) == 1, "a place has one entry");
    sum += weights[k];
    const double lon = grid.lon_deg[columns[k] % num_lon];
    east += weights[k] * std::remainder(lon - target.lon_deg, 360.0);
    lat += weights[k] * grid.lat_deg[columns[k] / num_lon];
  }
  if (weights.empty()) return;
  require(std::abs(sum - 1) <= 0x1p-52 * static_cast<double>(weights.size()),
          "weights add up to 1");
  const auto [south, north] = std::ranges::minmax(grid.lat_deg);
  const double max_apart = 2 * rounding_of(grid);
  if (target.lat_deg < south - max_apart || target.lat_deg > north + max_apart)
    return;  // to a pole
  require(weights.size() <= 4, "a rectangle has four places");
  require(std::abs(lat - target.lat_deg) <= max_apart, "latitudes are reproduced");
  if (widest_gap(grid) >= 180) return;  // the shorter way may lead around
  require(std::abs(east) <= max_apart, "longitudes are reproduced");
}

// Any axes and targets: an InvalidInput, or rows with these laws, in either direction of the axes.
void test_bilinear(ByteSource& source) {
  const double lon = source.small() * 4.5;
  LonLatAxes grid = {.lon_deg = next_axis(source, lon, 30), .lat_deg = {}};
  grid.lat_deg = next_axis(source, source.small() * 0.5, 8);
  const std::vector<LonLat> targets = next_targets(source, grid);
  for (const auto& [site, first] : repeated_places(grid)) {
    require(first < site && site < grid.lon_deg.size() * grid.lat_deg.size(),
            "a place stands for those behind it");
  }
  (void)axes_of_grid(targets, std::vector<std::uint64_t>{source.below(3), source.below(3)});
  Weights weights;
  try {
    weights = bilinear_weights(grid, targets, rounding_of(grid));
  } catch (const InvalidInput& error) {
    require(*error.what() != '\0', "a refusal says why");
    return;
  }
  require(weights.num_rows() == targets.size(), "a row for each target");
  bool are_near = true;  // the products of shares lose digits far from 0
  for (const double number : grid.lon_deg) are_near = are_near && std::abs(number) < 1e4;
  for (std::size_t t = 0; t < targets.size() && are_near; ++t) {
    const std::size_t size = weights.offsets[t + 1] - weights.offsets[t];
    test_bilinear_row(grid, targets[t],
                      std::span(weights.columns).subspan(weights.offsets[t], size),
                      std::span(weights.values).subspan(weights.offsets[t], size));
  }
  std::ranges::reverse(grid.lat_deg);
  const Weights turned = bilinear_weights(grid, targets, rounding_of(grid));
  require(turned.offsets == weights.offsets && turned.values == weights.values,
          "the direction of an axis changes no byte");
}

// Weights with other numbers and back, and with and without masks.
void test_parts(const Weights& weights, std::size_t left_out) {
  std::vector<Index> rows(weights.num_rows());
  std::vector<Index> columns(weights.num_columns);
  for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = static_cast<Index>(rows.size() - 1 - r);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c] = static_cast<Index>(columns.size() - 1 - c);
  }
  const auto turned = [&](const Weights& given) {
    return renumbered(given, rows, rows.size(), columns, columns.size());
  };
  const Weights back = turned(turned(weights));
  require(choose_values(back) == choose_values(weights), "an order of rows makes no mean");
  require(back.offsets == weights.offsets && back.columns == weights.columns &&
              back.values == weights.values,
          "numbers that are exchanged twice are those of before");
  std::vector<std::int32_t> mask(rows.size(), 1);
  mask[left_out % rows.size()] = 0;
  const Weights fewer = with_rows(weights, mask);
  require(with_rows(fewer, mask, &weights) == weights, "a row that comes back is that of before");
  std::vector<std::int32_t> sites(columns.size(), 1);
  require(without_columns(weights, sites) == weights, "no site is left out");
  sites[left_out % columns.size()] = 0;
  for (const Index column : without_columns(weights, sites).columns) {
    require(column != left_out % columns.size(), "no row needs a site that is left out");
  }
}

// The value of a row is that of one of its columns, whose weights are together the largest.
void test_largest_share(const Weights& weights) {
  std::vector<double> values(weights.num_columns);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 3);
  std::vector<double> found(weights.num_rows());
  apply_largest_share(weights, values, found);
  for (std::size_t r = 0; r < found.size(); ++r) {
    double shares[3] = {0, 0, 0};
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      shares[weights.columns[k] % 3] += std::abs(weights.values[k]);
    }
    if (weights.offsets[r] == weights.offsets[r + 1]) {
      require(std::isnan(found[r]), "a row without entries has no value");
      continue;
    }
    double all = 0;
    for (const double share : shares) all += share;
    require(!may_be_missing(shares[0], all, 0.5) == (shares[0] > (0.5 + 1e-9) * all) &&
                covered_enough(std::vector{1.0, 0.0}, 0) == std::vector<std::int32_t>({1, 0}),
            "shares are compared up to rounding");
    for (const double share : shares) {
      require(!is_larger_share(share, shares[static_cast<std::size_t>(found[r])]),
              "no share is larger");
    }
  }
}

// Each source is in the row of its nearest target.
void test_nearest_d2s(ByteSource& source) {
  const Scales scales = next_scales(source);
  std::vector<Point> places = all_sites(source, 16, scales);
  remove_center(places, {});
  const std::size_t num_targets = (places.size() + 1) / 2;
  const auto sources = std::span<const Point>(places).subspan(num_targets);
  const Triangulation triangulation = delaunay(
      std::vector(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(num_targets)));
  const Interpolator targets(triangulation);
  const Weights nearest = targets.weights(sources, {.method = Method::nearest});
  const Weights given = nearest_d2s_weights(targets, sources);
  require(given.num_rows() == nearest.num_columns && given.num_columns == sources.size() &&
              given.columns.size() == nearest.columns.size(),
          "a row for each target, an entry for each source");
  for (std::size_t target = 0; target < given.num_rows(); ++target) {
    for (std::uint64_t k = given.offsets[target]; k < given.offsets[target + 1]; ++k) {
      require(nearest.columns[nearest.offsets[given.columns[k]]] == target && given.values[k] == 1,
              "a source is given to its nearest target");
    }
  }
  if (num_targets == 0 || sources.empty()) return;
  test_parts(nearest, places.size());
  test_parts(given, places.size());
  test_largest_share(given);
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rondel::fuzz::ByteSource source(data, size);
  if (source.below(2) == 0) {
    rondel::fuzz::test_bilinear(source);
  } else {
    rondel::fuzz::test_nearest_d2s(source);
  }
  return 0;
}
