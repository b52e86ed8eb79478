// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Bands and isolines against the field itself: where a point is, by a Locator, and its value, in rational
// numbers.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rondel/error.h"
#include "support/thrown.h"
#include "unit/interpolation/contours_support.h"

namespace rondel::test {
namespace {

using Rational = std::array<mpq_class, 3>;

Rational rational(const Point& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }

mpq_class det(const Rational& a, const Rational& b, const Rational& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// The field at any point, if there is one.
class Field {
 public:
  Field(const Triangulation& triangulation, std::span<const double> values)
      : triangulation_(triangulation), values_(values), locator_(triangulation) {}

  // NaN where there is no value.
  [[nodiscard]] double at(const Point& u) const {
    const Point& center = triangulation_.sphere().center;
    const Location location = locator_.locate({u.x + center.x, u.y + center.y, u.z + center.z});
    if (location.face == no_index) return std::numeric_limits<double>::quiet_NaN();
    std::array<Rational, 3> corners;
    std::array<double, 3> f{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index site = triangulation_.faces()[location.face][i];
      corners[i] = rational(unit(minus(triangulation_.sites()[site], center)));
      f[i] = values_[site];
      if (std::isnan(f[i])) return f[i];
    }
    const Rational target = rational(u);
    mpq_class sum = 0;
    mpq_class all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const mpq_class weight = det(target, corners[(i + 1) % 3], corners[(i + 2) % 3]);
      sum += weight * mpq_class(f[i]);
      all += weight;
    }
    if (all == 0) return std::numeric_limits<double>::quiet_NaN();
    return mpq_class(sum / all).get_d();
  }

 private:
  const Triangulation& triangulation_;
  std::span<const double> values_;
  Locator locator_;
};

// Band k has a value: 1, has none: 0, does not tell as it is too close to a level: nothing.
std::optional<int> is_in_band(const Bands& bands, std::size_t k, double value) {
  if (std::isnan(value)) return 0;
  for (const double level : bands.levels) {
    if (std::abs(value - level) < 1e-9) return std::nullopt;
  }
  const bool is_above = k == 0 || bands.levels[k - 1] <= value;
  const bool is_below = k == bands.levels.size() || value < bands.levels[k];
  return is_above && is_below ? 1 : 0;
}

// The rings of a band wind around a point if it is in the band, and around its antipode the other way.
void expect_right_bands(const Triangulation& t, std::span<const double> values,
                        std::span<const double> levels, std::size_t num_points,
                        std::string_view name) {
  const Bands found = bands(t, values, levels);
  const Field field(t, values);
  Random random(11);
  for (std::size_t i = 0; i < num_points; ++i) {
    const Point u = random.direction();
    const double here = field.at(u);
    const double there = field.at({-u.x, -u.y, -u.z});
    for (std::size_t k = 0; k < found.num_bands(); ++k) {
      const auto inside = is_in_band(found, k, here);
      const auto opposite = is_in_band(found, k, there);
      if (!inside || !opposite) continue;
      const auto rings = rings_of_band(found, k);
      EXPECT_NEAR(winding(rings, u), *inside - *opposite, 1e-6)
          << name << " band " << k << " value " << here << " and " << there;
    }
  }
}

TEST(bands, have_each_point_with_its_value_for_every_generator) {
  const std::vector<double> levels{-0.7, -0.1, 0.2, 0.9, 1.4};
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const Triangulation t = projected(generator.make(60, 3));
    if (t.sphere().center != Point{}) continue;  // the oracle's points would be rounded
    expect_right_bands(t, smooth_values(t), levels, 20, generator.name);
  }
}

TEST(bands, have_each_point_with_its_value_among_missing_and_equal_ones) {
  Random random(5);
  for (int round = 0; round < 10; ++round) {
    const Triangulation t = projected(generator("uniform").make(80, 7));
    std::vector<double> values = stepped_values(80, random);
    for (double& value : values) {
      if (random.below(8) == 0) value = std::numeric_limits<double>::quiet_NaN();
    }
    expect_right_bands(t, values, std::vector<double>{0, 1, 2.5, 3}, 40, "stepped");
  }
}

// Between two points of a line, too: within a face an isoline is an arc of a great circle.
TEST(isolines, have_their_level_everywhere) {
  const Triangulation t = projected(generator("uniform").make(300, 2));
  const std::vector<double> values = smooth_values(t);
  const Field field(t, values);
  const std::vector<double> levels{-0.5, 0.1, 0.8};
  const Isolines lines = isolines(t, values, levels);
  ASSERT_GT(lines.num_lines(), 3U);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    for (auto line = lines.lines.offsets[k]; line < lines.lines.offsets[k + 1]; ++line) {
      const auto points = line_points(lines, line);
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        for (const double share : {0.0, 0.3, 0.5}) {
          const Point& p = points[i];
          const Point& q = points[i + 1];
          const Point place = unit(
              {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y), p.z + share * (q.z - p.z)});
          EXPECT_NEAR(field.at(place), levels[k], 1e-13);
        }
      }
    }
  }
}

TEST(isolines, have_higher_values_to_the_left) {
  const Triangulation t = projected(generator("uniform").make(300, 2));
  const std::vector<double> values = smooth_values(t);
  const Field field(t, values);
  const Isolines lines = isolines(t, values, std::vector<double>{0.1});
  for (std::size_t line = 0; line < lines.num_lines(); ++line) {
    const auto points = line_points(lines, line);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Point middle = unit({points[i].x + points[i + 1].x, points[i].y + points[i + 1].y,
                                 points[i].z + points[i + 1].z});
      const Point along = minus(points[i + 1], points[i]);
      const Point left{middle.y * along.z - middle.z * along.y,
                       middle.z * along.x - middle.x * along.z,
                       middle.x * along.y - middle.y * along.x};
      const double step = 1e-4;
      const Point beside =
          unit({middle.x + step * left.x, middle.y + step * left.y, middle.z + step * left.z});
      EXPECT_GT(field.at(beside), 0.1);
    }
  }
}

constexpr std::size_t not_thrown = InvalidInput::no_index - 1;

template <class Call>
std::size_t bad_index(const Call& call) {
  return thrown_index(call, not_thrown);
}

TEST(contours, name_the_first_bad_argument) {
  const Triangulation t = projected(generator("uniform").make(20, 1));
  std::vector<double> values(20, 1.0);
  const auto index = [&](const std::vector<double>& levels) {
    return bad_index([&] { isolines(t, values, levels); });
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(index({0, 1}), not_thrown);
  EXPECT_EQ(index({0, 1, 1}), 2U);
  EXPECT_EQ(index({0, -1}), 1U);
  EXPECT_EQ(index({infinity}), 0U);
  EXPECT_EQ(index({0, std::nan("")}), 1U);
  values[7] = -infinity;
  EXPECT_EQ(index({0}), 7U);
  values.pop_back();
  EXPECT_EQ(index({0}), InvalidInput::no_index);
  const Triangulation weighted = delaunay(t.sites(), {.model = Model::weighted});
  values.assign(20, 0);
  EXPECT_EQ(bad_index([&] { bands(weighted, values, std::vector<double>{0}); }),
            InvalidInput::no_index);
}

// The second site of each place has the value of the first one, which has none; the third one's value does not count.
// Sites of a meridian are rounded, so that faces between them are 1e-16 wide and reach along the whole
// border. No line runs along it, as no two neighbors have one value.
TEST(isolines, do_not_run_along_the_straight_border_of_a_grid) {
  Random random(31);
  for (const double west : {100.0, -7.0, 33.3}) {
    std::vector<LonLat> places;
    std::vector<double> values;
    for (int i = 0; i < 9; ++i) {
      for (int j = 0; j < 9; ++j) {
        places.push_back({west + i, static_cast<double>(j)});
        values.push_back(10 * random.unit());
      }
    }
    const std::vector<double> levels = {2, 4, 6, 8};
    const Isolines lines = isolines(delaunay(unit_vectors(places)), values, levels);
    std::size_t num_at_border = 0;
    for (std::size_t k = 0; k < lines.lines.rows.size(); ++k) {
      const std::vector<LonLat> line = lonlats(lines.lines.rows[k]);
      const auto is_at_border = [&](const LonLat& p) {
        return std::abs(p.lon_deg - west) < 1e-9 || std::abs(p.lon_deg - west - 8) < 1e-9;
      };
      for (std::size_t n = 0; n < line.size(); ++n) {
        if (!is_at_border(line[n])) continue;
        ++num_at_border;
        EXPECT_FALSE(n > 0 && is_at_border(line[n - 1])) << west << ' ' << line[n].lat_deg;
      }
    }
    EXPECT_GT(num_at_border, 10U);
  }
}

TEST(contours, take_the_first_value_of_each_place) {
  Random random(23);
  std::vector<Point> sites;
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) {
    sites.push_back({random.signed_unit(), random.signed_unit(), random.signed_unit()});
    values.push_back(random.signed_unit());
  }
  const std::vector<double> levels = {-0.5, 0, 0.25};
  const Triangulation apart = delaunay(sites);
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point> repeated = sites;
  std::vector<double> moved = values;
  for (std::size_t i = 0; i < sites.size(); i += 3) {
    repeated.insert(repeated.end(), {sites[i], sites[i]});
    moved.insert(moved.end(), {values[i], 7});
    moved[i] = none;
  }
  const Triangulation together = delaunay(repeated);
  EXPECT_EQ(isolines(together, moved, levels).lines, isolines(apart, values, levels).lines);
  EXPECT_EQ(bands(together, moved, levels).bands, bands(apart, values, levels).bands);
  const std::vector<double> first = first_values(together, moved);
  EXPECT_TRUE(std::equal(values.begin(), values.end(), first.begin()));
  EXPECT_THROW((void)first_values(together, values), InvalidInput);
}

TEST(contours, of_values_that_hardly_differ_and_that_are_huge) {
  const Triangulation t = projected(generator("uniform").make(50, 1));
  std::vector<double> values = smooth_values(t);
  for (const double scale : {1e-320, 1e-300, 1e300, 1e308}) {
    std::vector<double> scaled_values = values;
    for (double& value : scaled_values) value *= scale / 2;
    const Bands found = bands(t, scaled_values, std::vector<double>{0, 0.3 * scale});
    double area = 0;
    for (std::size_t i = 0; i < found.num_polygons(); ++i) area += polygon_area(found, i);
    EXPECT_NEAR(area, 4 * std::numbers::pi, 1e-12) << scale;
  }
}

TEST(contours, infinite_values_are_named_where_they_are_given) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}, {2, 0, 0}};
  const std::vector<double> values = {std::nan(""), 0, 1, 2, HUGE_VAL};
  const Triangulation t = delaunay(sites);
  const std::vector<double> levels = {0.5};
  EXPECT_EQ(thrown_index([&] { return isolines(t, values, levels); }), 4U);
  EXPECT_EQ(thrown_index([&] { return bands(t, values, levels); }), 4U);
}

}  // namespace
}  // namespace rondel::test
