// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Bilinear weights on the axes of a grid. The oracle of small grids is a search through all
// rectangles in rational numbers: coordinates are multiples of 1/8 degree, and the fractions of a
// rectangle are quotients of integers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regrid.h"
#include "unit/interpolation/support.h"

namespace rondel::test {
namespace {

using Eighths = std::int64_t;  // of a degree
constexpr Eighths whole_turn = Eighths{360} * 8;
constexpr Eighths right_angle = Eighths{90} * 8;

std::vector<double> degrees_of(const std::vector<Eighths>& axis) {
  std::vector<double> degrees;
  for (const Eighths number : axis) degrees.push_back(static_cast<double>(number) / 8);
  return degrees;
}

// The weights of a target by place; both axes increase and no column stands twice.
class RectangleSearch {
 public:
  RectangleSearch(std::vector<Eighths> lon, std::vector<Eighths> lat)
      : lon_(std::move(lon)), lat_(std::move(lat)) {
    Eighths widest = 0;
    for (std::size_t i = 1; i < lon_.size(); ++i) widest = std::max(widest, lon_[i] - lon_[i - 1]);
    is_around_ = 2 * (whole_turn - (lon_.back() - lon_.front())) <= 3 * widest;
  }

  [[nodiscard]] std::map<std::size_t, long double> weights(Eighths lon, Eighths lat) const {
    std::map<std::size_t, long double> found;
    for (std::size_t west = 0; west < lon_.size() - (is_around_ ? 0 : 1); ++west) {
      const std::size_t east = (west + 1) % lon_.size();
      const Eighths width = lon_[east] - lon_[west] + (east == 0 ? whole_turn : 0);
      const Eighths from_west = ((lon - lon_[west]) % whole_turn + whole_turn) % whole_turn;
      if (from_west > width) continue;
      found.clear();
      add_rows(lat, west, static_cast<long double>(width - from_west) / width, found);
      add_rows(lat, east, static_cast<long double>(from_west) / width, found);
    }
    std::erase_if(found, [](const auto& entry) { return entry.second == 0; });
    return found;
  }

 private:
  void add_rows(Eighths lat, std::size_t column, long double share,
                std::map<std::size_t, long double>& found) const {
    for (std::size_t south = 0; south + 1 < lat_.size(); ++south) {
      const Eighths height = lat_[south + 1] - lat_[south];
      const Eighths from_south = lat - lat_[south];
      if (from_south < 0 || from_south > height) continue;
      found[south * lon_.size() + column] =
          share * static_cast<long double>(height - from_south) / height;
      found[(south + 1) * lon_.size() + column] =
          share * static_cast<long double>(from_south) / height;
    }
    if (!is_around_) return;
    if (lat > lat_.back() && lat_.back() > 0) add_pole(lat, lat_.size() - 1, column, share, found);
    if (lat < lat_.front() && lat_.front() < 0) add_pole(lat, 0, column, share, found);
  }

  void add_pole(Eighths lat, std::size_t row, std::size_t column, long double share,
                std::map<std::size_t, long double>& found) const {
    const Eighths edge = std::abs(lat_[row]);
    const auto to_pole = static_cast<long double>(std::abs(lat) - edge) / (right_angle - edge);
    found[row * lon_.size() + column] += share * (1 - to_pole);
    for (std::size_t i = 0; i < lon_.size(); ++i) {
      found[row * lon_.size() + i] += share * to_pole / static_cast<long double>(lon_.size());
    }
  }

  std::vector<Eighths> lon_;
  std::vector<Eighths> lat_;
  bool is_around_ = false;
};

struct EighthsGrid {
  std::string name;
  std::vector<Eighths> lon;
  std::vector<Eighths> lat;
};

std::vector<Eighths> steps(Eighths first, Eighths step, std::size_t count) {
  std::vector<Eighths> axis;
  for (std::size_t i = 0; i < count; ++i) {
    axis.push_back(first + static_cast<Eighths>(i) * step);
  }
  return axis;
}

std::vector<EighthsGrid> eighths_grids() {
  return {{"whole", steps(0, 120, 24), steps(-640, 160, 9)},
          {"with the poles", steps(-1440, 240, 12), steps(-720, 180, 9)},
          {"regional", steps(1500, 7, 9), steps(-21, 6, 8)},
          {"over the meridian of 180 degrees", steps(1400, 11, 9), {100, 123, 300}},
          {"uneven", {-500, -100, 3, 900, 1000, 2000}, {-400, -7, 8, 9, 600}},
          {"around in uneven steps", {0, 700, 1300, 2100}, {-300, 0, 500}},
          {"north alone", steps(40, 360, 8), {8, 300, 400}},
          {"two meridians", {0, 1440}, {-80, 80}}};
}

std::vector<LonLat> targets_around(const EighthsGrid& grid, std::vector<Eighths>& lons,
                                   std::vector<Eighths>& lats) {
  Random random(11);
  std::vector<LonLat> targets;
  for (int i = 0; i < 400; ++i) {
    Eighths lon = static_cast<Eighths>(random.below(7000)) - 3500;
    Eighths lat = static_cast<Eighths>(random.below(1441)) - right_angle;
    if (i % 3 == 0) lon = grid.lon[random.below(grid.lon.size())] + whole_turn * (i % 5 - 2);
    if (i % 4 == 0) lat = grid.lat[random.below(grid.lat.size())];
    lons.push_back(lon);
    lats.push_back(lat);
    targets.push_back({static_cast<double>(lon) / 8, static_cast<double>(lat) / 8});
  }
  return targets;
}

TEST(bilinear, rows_are_those_of_a_search_through_all_rectangles) {
  for (const EighthsGrid& grid : eighths_grids()) {
    SCOPED_TRACE(grid.name);
    std::vector<Eighths> lons;
    std::vector<Eighths> lats;
    const std::vector<LonLat> targets = targets_around(grid, lons, lats);
    const RectangleSearch search(grid.lon, grid.lat);
    const Weights weights = bilinear_weights({degrees_of(grid.lon), degrees_of(grid.lat)}, targets);
    ASSERT_EQ(weights.num_rows(), targets.size());
    ASSERT_EQ(weights.num_columns, grid.lon.size() * grid.lat.size());
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const WeightRow row = row_of(weights, t);
      const auto wanted = search.weights(lons[t], lats[t]);
      ASSERT_EQ(row.columns.size(), wanted.size())
          << targets[t].lon_deg << ' ' << targets[t].lat_deg;
      std::size_t k = 0;
      for (const auto& [place, weight] : wanted) {  // by row of the grid and then by column
        EXPECT_EQ(row.columns[k], place);
        EXPECT_NEAR(row.values[k], static_cast<double>(weight), 4 * 0x1p-52);
        ++k;
      }
    }
  }
}

// Returns the axis from its end to its beginning, some turns away.
std::vector<double> turned(std::vector<double> axis, double shift) {
  std::ranges::reverse(axis);
  for (double& number : axis) number += shift;
  return axis;
}

TEST(bilinear, axes_that_decrease_give_the_same_rows_of_the_same_places) {
  for (const EighthsGrid& grid : eighths_grids()) {
    SCOPED_TRACE(grid.name);
    std::vector<Eighths> lons;
    std::vector<Eighths> lats;
    const std::vector<LonLat> targets = targets_around(grid, lons, lats);
    const std::vector<double> lon = degrees_of(grid.lon);
    const std::vector<double> lat = degrees_of(grid.lat);
    const Weights wanted = bilinear_weights({lon, lat}, targets);
    Weights found = bilinear_weights({turned(lon, -720), turned(lat, 0)}, targets);
    for (Index& place : found.columns) {
      const std::size_t row = lat.size() - 1 - place / lon.size();
      const std::size_t column = lon.size() - 1 - place % lon.size();
      place = static_cast<Index>(row * lon.size() + column);
    }
    found.sites_hash = wanted.sites_hash;
    EXPECT_EQ(found, wanted);
  }
}

TEST(bilinear, columns_that_repeat_the_first_ones_have_no_weight) {
  const std::vector<double> lat = {-60, 0, 60};
  const std::vector<LonLat> targets = {{359, 10}, {0, 0}, {-1, 70}, {365, -90}};
  std::vector<double> lon = degrees_of(steps(0, 80, 36));
  const Weights once = bilinear_weights({lon, lat}, targets);
  lon.insert(lon.end(), {360, 370.00001});
  Weights found = bilinear_weights({lon, lat}, targets);
  EXPECT_EQ(found.num_columns, 3 * 38U);
  for (Index& place : found.columns) {
    ASSERT_LT(place % 38, 36U);
    place = place / 38 * 36 + place % 38;
  }
  EXPECT_EQ(found.columns, once.columns);
  EXPECT_EQ(found.values, once.values);
  EXPECT_EQ(found.offsets, once.offsets);
}

// Rule 6: at a place up to the rounding, also beyond the last row and column.
TEST(bilinear, targets_beside_a_line_by_rounding_are_at_it) {
  const LonLatAxes grid = {.lon_deg = {10, 11, 12}, .lat_deg = {40, 41}};
  const std::vector<LonLat> targets = {
      {370 + 1e-10, 40 - 1e-10}, {12 + 5e-10, 41 + 5e-10}, {12 + 1e-6, 41}, {11 - 1e-6, 40.5}};
  const Weights found = bilinear_weights(grid, targets);
  EXPECT_EQ(found.offsets, std::vector<std::uint64_t>({0, 1, 2, 2, 6}));
  EXPECT_EQ(found.columns[0], 0U);
  EXPECT_EQ(found.columns[1], 5U);
  const Weights single = bilinear_weights(grid, targets, single_rounding_deg);
  EXPECT_EQ(single.offsets, std::vector<std::uint64_t>({0, 1, 2, 3, 5}));
  EXPECT_EQ(single.values, std::vector<double>({1, 1, 1, 0.5, 0.5}));
  // Never more than a thousandth of a step.
  const Weights coarse =
      bilinear_weights(grid, std::vector<LonLat>{{11.0011, 40}, {11.0009, 40}}, 0.5);
  EXPECT_EQ(coarse.offsets, std::vector<std::uint64_t>({0, 2, 3}));
}

TEST(bilinear, axes_in_single_precision_are_known_by_their_numbers) {
  const auto single = [](double number) { return static_cast<double>(static_cast<float>(number)); };
  EXPECT_EQ(rounding_of({{0, 0.5, 1}, {10, 10.25}}), double_rounding_deg);
  EXPECT_EQ(rounding_of({{0, 0.1, 0.2}, {10, 20}}), double_rounding_deg);
  EXPECT_EQ(rounding_of({{0, single(0.1), single(0.2)}, {10, 20}}), single_rounding_deg);
  EXPECT_EQ(rounding_of({{0, 1}, {10, single(20.3)}}), single_rounding_deg);
  EXPECT_EQ(rounding_of({{0, single(0.1)}, {10, 20.3}}), double_rounding_deg);
  EXPECT_EQ(rounding_of({{0, 1e300}, {10, single(20.3)}}), double_rounding_deg);
}

TEST(bilinear, hashes_are_those_of_places_and_targets) {
  const LonLatAxes grid = {.lon_deg = {0, 90}, .lat_deg = {0, 45}};
  const std::vector<LonLat> places = {{0, 0}, {90, 0}, {0, 45}, {90, 45}};
  const std::vector<LonLat> targets = {{10, 20}, {30, 40}};
  const Weights weights = bilinear_weights(grid, targets);
  EXPECT_EQ(weights.sites_hash, point_set_hash(unit_vectors(places)));
  EXPECT_EQ(weights.targets_hash, point_set_hash(unit_vectors(targets)));
}

// Expects InvalidInput with this text and index.
void expect_bad_grid(const LonLatAxes& grid, const std::vector<LonLat>& targets,
                     const std::string& text, std::size_t index) {
  try {
    (void)bilinear_weights(grid, targets);
    FAIL() << text;
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    EXPECT_EQ(error.index(), index);
  }
}

TEST(bilinear, what_is_no_axis_is_refused) {
  const std::vector<double> good = {0, 1, 2};
  const std::size_t no = InvalidInput::no_index;
  const std::string rule = "must be an axis: two numbers or more, increasing or decreasing";
  expect_bad_grid({{}, good}, {}, "lon " + rule + "; there are none", no);
  expect_bad_grid({good, {7}}, {}, "lat " + rule + "; lat[0] is 7 alone", no);
  expect_bad_grid({{0, nan, 2}, good}, {}, "lon[1] is nan: an axis has no gaps", 1);
  expect_bad_grid({good, {0, 1, std::numeric_limits<double>::infinity()}}, {}, "lat[2] is inf", 2);
  expect_bad_grid({{0, 1, 1}, good}, {}, "lon[2] is 1 after 1", 2);
  expect_bad_grid({good, {3, 2, 2.5, 1}}, {}, "lat[2] is 2.5 after 2", 2);
  expect_bad_grid({{0, 360}, good}, {}, "lon[1] is 360 after 0", 1);
  expect_bad_grid({{0x1.8p60, 0x1.8p60 + 512}, good}, {}, "two different meridians", no);
  expect_bad_grid({good, {0, 91}}, {}, "91", 3);
  expect_bad_grid({good, good}, {{0, 0}, {0, -90.5}}, "-90.5", 1);
  expect_bad_grid({good, good}, {{nan, 0}}, "not finite", 0);
}

TEST(bilinear, places_of_a_grid_have_axes) {
  const std::vector<LonLat> places = {{0, 5}, {1, 5}, {2, 5}, {0, 7}, {1, 7}, {2, 7}};
  const auto axes = axes_of_grid(places, std::vector<std::uint64_t>{2, 3});
  ASSERT_TRUE(axes.has_value());
  EXPECT_EQ(axes->lon_deg, std::vector<double>({0, 1, 2}));
  EXPECT_EQ(axes->lat_deg, std::vector<double>({5, 7}));
  using Shape = std::vector<std::uint64_t>;
  for (const Shape& shape : {Shape{6}, Shape{3, 2}, Shape{1, 2, 3}, Shape{2, 2}, Shape{0, 6},
                             Shape{2, std::uint64_t{1} << 63U}, Shape{}}) {
    EXPECT_FALSE(axes_of_grid(places, shape).has_value());
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<LonLat> moved = places;
    moved[k].lat_deg += 1e-9;
    EXPECT_FALSE(axes_of_grid(moved, Shape{2, 3}).has_value()) << k;
  }
}

}  // namespace
}  // namespace rondel::test
