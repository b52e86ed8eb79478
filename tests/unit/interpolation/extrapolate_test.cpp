// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values of targets that have none, against a search of all sources, and against a fill of the grid that
// looks at every target in every level.

#include "rondel/extrapolate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "support/random.h"

namespace rondel::test {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

std::vector<Point> random_directions(std::size_t n, Random& random) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(random.direction());
  return points;
}

std::vector<double> values_with_gaps(std::size_t n, double share, Random& random) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(random.unit() < share ? gap : random.unit());
  return values;
}

double angle_between(const Point& a, const Point& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

// Returns the value that a target gets, by a search of all sources; NaN if none is near enough.
double searched(const std::vector<Point>& sources, const std::vector<double>& values,
                const Point& target, const ExtrapolationOptions& options) {
  const double most_km = options.max_distance_km.value_or(1e9);
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const double angle = angle_between(sources[s], target);
    if (std::isnan(values[s]) || angle * kilometers_per_radian > most_km) continue;
    near.emplace_back(angle, s);
  }
  std::ranges::sort(near);
  if (near.empty()) return gap;
  if (options.method == Extrapolation::nearest) return values[near[0].second];
  double sum = 0;
  double total = 0;
  for (std::size_t k = 0; k < near.size() && k < options.neighbors; ++k) {
    const double chord = 2 * std::sin(near[k].first / 2);
    const double weight = std::pow(chord, -static_cast<double>(options.exponent));
    sum += weight * values[near[k].second];
    total += weight;
  }
  return sum / total;
}

TEST(extrapolate, near_sources_give_values) {
  Random random(1);
  const std::vector<Point> sources = random_directions(400, random);
  const std::vector<Point> targets = random_directions(300, random);
  for (const Extrapolation method : {Extrapolation::nearest, Extrapolation::idw}) {
    for (const std::optional<double> distance : {std::optional(500.0), std::optional(2000.0), {}}) {
      const ExtrapolationOptions options = {
          .method = method, .max_distance_km = distance, .neighbors = 5, .exponent = 3};
      Extrapolator extrapolator(sources, targets, {}, options);
      for (int field = 0; field < 4; ++field) {
        const std::vector<double> values = values_with_gaps(400, 0.5, random);
        std::vector<double> filled = values_with_gaps(300, 0.7, random);
        const std::vector<double> before = filled;
        std::size_t count = 0;
        const std::size_t found = extrapolator.fill(values, filled);
        for (std::size_t t = 0; t < targets.size(); ++t) {
          if (!std::isnan(before[t])) {
            EXPECT_EQ(filled[t], before[t]);
            continue;
          }
          const double wanted = searched(sources, values, targets[t], options);
          EXPECT_EQ(std::isnan(filled[t]), std::isnan(wanted));
          if (std::isnan(wanted)) continue;
          EXPECT_NEAR(filled[t], wanted, 1e-12);
          ++count;
        }
        EXPECT_EQ(found, count);
      }
    }
  }
}

// Fills a grid that goes around, level by level, as the definition says.
std::size_t fill_grid(std::vector<double>& values, std::size_t rows, std::size_t columns,
                      unsigned levels) {
  std::size_t count = 0;
  for (unsigned level = 1; levels == 0 || level <= levels; ++level) {
    std::vector<double> next = values;
    std::size_t filled = 0;
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        if (!std::isnan(values[j * columns + i])) continue;
        std::vector<double> near;
        if (j > 0) near.push_back(values[(j - 1) * columns + i]);
        near.push_back(values[j * columns + (i + columns - 1) % columns]);
        near.push_back(values[j * columns + (i + 1) % columns]);
        if (j + 1 < rows) near.push_back(values[(j + 1) * columns + i]);
        std::erase_if(near, [](double value) { return std::isnan(value); });
        if (near.empty()) continue;
        double sum = 0;
        for (const double value : near) sum += value;
        next[j * columns + i] = sum / static_cast<double>(near.size());
        ++filled;
      }
    }
    values = std::move(next);
    count += filled;
    if (filled == 0) return count;
  }
  return count;
}

std::vector<Point> grid_places(std::size_t rows, std::size_t columns) {
  std::vector<LonLat> places;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      places.push_back({360 * static_cast<double>(i) / static_cast<double>(columns),
                        -60 + 120 * static_cast<double>(j) / static_cast<double>(rows)});
    }
  }
  return unit_vectors(places);
}

TEST(extrapolate, creeping_fills_level_by_level) {
  Random random(2);
  constexpr std::size_t rows = 20;
  constexpr std::size_t columns = 30;
  const std::vector<Point> targets = grid_places(rows, columns);
  const std::vector<Point> sources = random_directions(50, random);
  const std::vector<double> values(50, 1);
  for (const unsigned levels : {0U, 1U, 2U, 5U}) {
    Extrapolator extrapolator(sources, targets, grid_neighbors(targets, rows, columns),
                              {.method = Extrapolation::creep, .levels = levels});
    for (const double share : {0.5, 0.95, 1.0}) {
      std::vector<double> filled = values_with_gaps(targets.size(), share, random);
      std::vector<double> wanted = filled;
      const std::size_t count = fill_grid(wanted, rows, columns, levels);
      EXPECT_EQ(extrapolator.fill(values, filled), count);
      for (std::size_t t = 0; t < targets.size(); ++t) {
        EXPECT_TRUE(filled[t] == wanted[t] || (std::isnan(filled[t]) && std::isnan(wanted[t])));
      }
    }
  }
}

TEST(extrapolate, creeping_obeys_the_distance) {
  Random random(3);
  const std::vector<Point> targets = grid_places(20, 30);
  const std::vector<Point> sources = {unit_vector({0, 0})};
  Extrapolator extrapolator(sources, targets, grid_neighbors(targets, 20, 30),
                            {.method = Extrapolation::creep, .max_distance_km = 3000});
  std::vector<double> filled(targets.size(), gap);
  filled[10 * 30] = 7;  // at the source
  extrapolator.fill(std::vector<double>{7}, filled);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const double away = angle_between(targets[t], sources[0]) * kilometers_per_radian;
    EXPECT_EQ(!std::isnan(filled[t]), away <= 3000) << away;
  }
}

TEST(extrapolate, masks_are_obeyed) {
  const std::vector<Point> sources = unit_vectors(std::vector<LonLat>{{0, 0}, {10, 0}});
  const std::vector<Point> targets = unit_vectors(std::vector<LonLat>{{1, 0}, {2, 0}, {3, 0}});
  Extrapolator extrapolator(sources, targets, {}, {}, {0, 1}, {1, 0, 1});
  std::vector<double> filled(3, gap);
  EXPECT_EQ(extrapolator.fill(std::vector<double>{5, 6}, filled), 2U);
  EXPECT_EQ(filled[0], 6);
  EXPECT_TRUE(std::isnan(filled[1]));
  EXPECT_EQ(filled[2], 6);
  // A masked target passes nothing on.
  Extrapolator creeping(sources, targets, place_neighbors(targets),
                        {.method = Extrapolation::creep}, {}, {1, 0, 1});
  filled = {3, gap, gap};
  creeping.fill(std::vector<double>{5, 6}, filled);
  EXPECT_TRUE(std::isnan(filled[1]));
}

TEST(extrapolate, each_field_creeps_from_its_own_values) {
  // The place of the first target is unknown: it needs no value, and passes on what it has.
  std::vector<Point> targets = unit_vectors(std::vector<LonLat>{{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  targets[0] = {0, 0, 0};
  const std::vector<Point> sources = unit_vectors(std::vector<LonLat>{{0, 0}});
  Extrapolator extrapolator(sources, targets, grid_neighbors(targets, 1, 4),
                            {.method = Extrapolation::creep});
  std::vector<double> filled = {1, gap, gap, gap};
  EXPECT_EQ(extrapolator.fill(std::vector<double>{5}, filled), 3U);
  EXPECT_EQ(filled, std::vector<double>({1, 1, 1, 1}));
  filled = {gap, gap, gap, gap};
  EXPECT_EQ(extrapolator.fill(std::vector<double>{5}, filled), 0U);
  EXPECT_TRUE(std::isnan(filled[1]));
}

TEST(extrapolate, weights_do_what_values_do) {
  Random random(4);
  const std::vector<Point> sources = random_directions(200, random);
  std::vector<Point> north;  // sources of the north alone, so that the south has no rows
  for (const Point& p : sources) north.push_back(p.z < 0 ? Point{p.x, p.y, -p.z} : p);
  const std::vector<Point> targets = grid_places(20, 30);
  const Weights weights =
      Interpolator(delaunay(north)).weights(targets, {.method = Method::linear});
  std::vector<double> values;
  for (std::size_t i = 0; i < north.size(); ++i) values.push_back(random.unit());
  std::vector<double> carried(targets.size());
  apply(weights, values, carried);
  ASSERT_GT(std::ranges::count_if(carried, [](double v) { return std::isnan(v); }), 100);
  for (const Extrapolation method :
       {Extrapolation::nearest, Extrapolation::idw, Extrapolation::creep}) {
    const ExtrapolationOptions options = {.method = method, .max_distance_km = 4000, .levels = 4};
    Extrapolator extrapolator(north, targets, grid_neighbors(targets, 20, 30), options);
    std::vector<double> wanted = carried;
    extrapolator.fill(values, wanted);
    const Weights filled = extrapolator.filled(weights);
    EXPECT_EQ(filled.sites_hash, weights.sites_hash);
    std::vector<double> found(targets.size());
    apply(filled, values, found);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      EXPECT_EQ(std::isnan(found[t]), std::isnan(wanted[t]));
      if (std::isnan(wanted[t])) continue;
      EXPECT_NEAR(found[t], wanted[t], 1e-14);
    }
  }
}

TEST(extrapolate, only_mutual_neighbors_pass_values_on) {
  const std::vector<Point> targets = unit_vectors(std::vector<LonLat>{{0, 0}, {1, 0}, {2, 0}});
  CompressedRows<Index> neighbors;
  neighbors.append(std::vector<Index>{1, 2});
  neighbors.append(std::vector<Index>{0});
  neighbors.append(std::vector<Index>{});
  Extrapolator extrapolator(targets, targets, neighbors, {.method = Extrapolation::creep});
  std::vector<double> filled = {4, gap, gap};
  EXPECT_EQ(extrapolator.fill(std::vector<double>{1, 2, 3}, filled), 1U);
  EXPECT_EQ(filled[1], 4);
  EXPECT_TRUE(std::isnan(filled[2]));
}

TEST(extrapolate, neighbors_are_mutual) {
  Random random(5);
  std::vector<Point> places = random_directions(100, random);
  places.push_back(places[7]);
  places.push_back({0, 0, 0});
  const CompressedRows<Index> neighbors = place_neighbors(places);
  ASSERT_EQ(neighbors.size(), 102U);
  EXPECT_TRUE(neighbors[101].empty());
  for (Index i = 0; i < neighbors.size(); ++i) {
    for (const Index other : neighbors[i]) EXPECT_EQ(std::ranges::count(neighbors[other], i), 1);
  }
  const std::vector<Point> grid = grid_places(4, 8);
  const CompressedRows<Index> closed = grid_neighbors(grid, 4, 8);
  EXPECT_EQ(closed[0].size(), 3U);
  const CompressedRows<Index> open = grid_neighbors(std::span(grid).first(16), 4, 4);
  EXPECT_EQ(open[0].size(), 2U);
}

TEST(extrapolate, nothing_comes_of_nothing) {
  Extrapolator extrapolator({}, {{1, 0, 0}}, {}, {});
  std::vector<double> filled = {gap};
  EXPECT_EQ(extrapolator.fill({}, filled), 0U);
  EXPECT_TRUE(std::isnan(filled[0]));
}

TEST(extrapolate, wrong_options_are_refused) {
  const std::vector<Point> one = {{1, 0, 0}};
  EXPECT_THROW(Extrapolator(one, one, {}, {.max_distance_km = -1}), InvalidInput);
  EXPECT_THROW(Extrapolator(one, one, {}, {.max_distance_km = gap}), InvalidInput);
  EXPECT_THROW(Extrapolator(one, one, {}, {.neighbors = 0}), InvalidInput);
  EXPECT_THROW(Extrapolator(one, one, {}, {.exponent = 0}), InvalidInput);
  EXPECT_THROW(Extrapolator(one, one, {}, {.exponent = 101}), InvalidInput);
  EXPECT_THROW(Extrapolator(one, one, {}, {.method = Extrapolation::creep}), InvalidInput);
  EXPECT_THROW(Extrapolator(one, one, {}, {}, {1, 1}), InvalidInput);
  EXPECT_THROW((void)grid_neighbors(one, 2, 1), InvalidInput);
  Extrapolator good(one, one, {}, {});
  std::vector<double> values = {gap, gap};
  EXPECT_THROW(good.fill(values, values), InvalidInput);
}

TEST(extrapolate, names_are_those_of_esmf_too) {
  EXPECT_EQ(extrapolation_named("creep_fill"), Extrapolation::creep);
  EXPECT_EQ(extrapolation_named("inverse_dist"), Extrapolation::idw);
  EXPECT_EQ(extrapolation_named("nearest"), Extrapolation::nearest);
  EXPECT_EQ(extrapolation_named("patch"), std::nullopt);
  EXPECT_EQ(name_of(Extrapolation::idw), "idw");
}

}  // namespace
}  // namespace rondel::test
