// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What holds for all methods: sites, places that several sites share, targets outside, low dimensions,
// any order and any threads, vectors, and what is refused.

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "rondel/error.h"
#include "rondel/query.h"
#include "unit/interpolation_support.h"

namespace rondel::test {
namespace {

constexpr std::array methods = {Method::nearest, Method::linear,  Method::laplace,
                                Method::sibson,  Method::hermite, Method::cubic};

std::string name_of(Method method) { return "method " + std::to_string(static_cast<int>(method)); }

std::vector<double> some_field(std::size_t n) {
  Random random(11);
  std::vector<double> field(n);
  for (double& value : field) value = random.signed_unit();
  return field;
}

// Equal bit by bit, every NaN being like every other.
bool are_same(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return (std::isnan(x) && std::isnan(y)) ||
           std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

// Of a field of values up to 1: to rounding of the sums of rows.
bool are_close(std::span<const double> a, std::span<const double> b, const Weights& weights) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    double scale = 0;
    for (const double w : row_of(weights, i % weights.num_rows()).values) scale += std::abs(w);
    if (std::isnan(a[i]) != std::isnan(b[i]) || std::abs(a[i] - b[i]) > 1e-13 * scale) return false;
  }
  return true;
}

bool has_slopes(Method method) { return method == Method::hermite || method == Method::cubic; }

TEST(interpolation_rules, values_are_what_weights_apply_to) {
  for_each_interpolation_case(40, [](const InterpolationCase& c) {
    const Interpolator interpolator(c.triangulation);
    const std::size_t n = c.set.sites.size();
    const auto field = some_field(3 * n);
    // Where nearly all sites are on one circle, weights of gradients are huge and cancel each other.
    const bool is_flat = c.name == "orbit" || c.name.starts_with("rotated_circle");
    for (const Method method : methods) {
      if (is_flat && has_slopes(method)) continue;
      for (const Outside outside : {Outside::missing, Outside::nearest}) {
        for (const Normalization to : {Normalization::unity, Normalization::homogeneous}) {
          const InterpolationOptions options = {
              .method = method, .outside = outside, .normalization = to};
          const Weights weights = interpolator.weights(c.targets, options);
          std::vector<double> applied(3 * c.targets.size());
          apply(weights, field, applied, n == 0 ? 1 : 3);
          if (n == 0) applied.resize(c.targets.size());
          const auto values = interpolator.values(field, c.targets, options);
          const bool agree =
              has_slopes(method) ? are_close(values, applied, weights) : are_same(values, applied);
          EXPECT_TRUE(agree) << c.name << " " << name_of(method);
        }
      }
    }
  });
}

TEST(interpolation_rules, at_a_site_there_is_its_value_alone) {
  for_each_interpolation_case(40, [](const InterpolationCase& c) {
    const Interpolator interpolator(c.triangulation);
    for (const Method method : methods) {
      const Weights weights = interpolator.weights(c.set.sites, {.method = method});
      std::vector<Index> names(c.set.sites.size());
      std::iota(names.begin(), names.end(), Index{0});
      for (const Duplicate& d : c.triangulation.duplicates()) names[d.site] = d.representative;
      EXPECT_EQ(weights.columns, names) << c.name;
      EXPECT_EQ(weights.values, std::vector<double>(names.size(), 1.0)) << c.name;
    }
  });
}

TEST(interpolation_rules, the_order_of_sites_changes_no_byte) {
  for_each_interpolation_case(60, [](const InterpolationCase& c) {
    const std::size_t n = c.set.sites.size();
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), Index{0});
    // Those that share a place keep their order.
    if (!c.triangulation.duplicates().empty()) return;
    Random random(8);
    random.shuffle(order);
    std::vector<Point> shuffled;
    std::vector<double> shuffled_field;
    const auto field = some_field(n);
    for (const Index i : order) {
      shuffled.push_back(c.set.sites[i]);
      shuffled_field.push_back(field[i]);
    }
    const Interpolator one(c.triangulation);
    const Interpolator other(delaunay(shuffled, {.sphere = c.set.sphere}));
    for (const Method method : methods) {
      const InterpolationOptions options = {.method = method, .outside = Outside::nearest};
      EXPECT_TRUE(are_same(one.values(field, c.targets, options),
                           other.values(shuffled_field, c.targets, options)))
          << c.name << " " << name_of(method);
      const Weights given = one.weights(c.targets, options);
      Weights found = other.weights(c.targets, options);
      for (Index& column : found.columns) column = order[column];
      EXPECT_EQ(found.offsets, given.offsets) << c.name;
      EXPECT_EQ(found.columns, given.columns) << c.name << " " << name_of(method);
      EXPECT_TRUE(are_same(found.values, given.values)) << c.name << " " << name_of(method);
    }
  });
}

TEST(interpolation_rules, threads_change_no_byte) {
  const auto sites = generator("clustered").make(2000, 1).sites;
  const auto targets = generator("uniform").make(20000, 2).sites;
  const Interpolator interpolator(delaunay(sites));
  const auto field = some_field(sites.size());
  for (const Method method : methods) {
    const InterpolationOptions options = {.method = method};
    EXPECT_EQ(interpolator.weights(targets, options, {.threads = 1}),
              interpolator.weights(targets, options, {.threads = 4}));
    EXPECT_TRUE(are_same(interpolator.values(field, targets, options, {.threads = 1}),
                         interpolator.values(field, targets, options, {.threads = 4})));
  }
}

TEST(interpolation_rules, outside_is_where_no_solid_face_is) {
  for_each_interpolation_case(30, [](const InterpolationCase& c) {
    const Interpolator interpolator(c.triangulation);
    const Locator locator(c.triangulation);
    const auto locations = locator.locate(c.targets);
    const Weights missing = interpolator.weights(c.targets, {.method = Method::linear});
    const Weights nearest =
        interpolator.weights(c.targets, {.method = Method::linear, .outside = Outside::nearest});
    std::size_t first = c.targets.size();
    for (std::size_t t = c.targets.size(); t-- > 0;) {
      const bool is_outside = locations[t].where == Where::outside;
      if (is_outside) first = t;
      EXPECT_EQ(row_of(missing, t).values.empty(), is_outside) << c.name;
      if (!is_outside || c.set.sites.empty()) continue;
      const WeightRow row = row_of(nearest, t);
      ASSERT_EQ(row.values.size(), 1U);
      EXPECT_EQ(row.values[0], 1);
      const double distance = locator.distance(c.targets[t], row.columns[0]);
      EXPECT_EQ(distance, locator.distance(c.targets[t], locator.nearest(c.targets[t])));
    }
    const auto strict = [&] {
      static_cast<void>(
          interpolator.weights(c.targets, {.method = Method::linear, .outside = Outside::error}));
    };
    if (first == c.targets.size()) return strict();
    try {
      strict();
      FAIL() << c.name;
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.index(), first) << c.name;
      EXPECT_EQ(std::string(error.what()),
                "target " + std::to_string(first) + " is outside of the sites' faces");
    }
  });
}

// --- places that several sites share ---

const std::vector<Point> shared = {{1, 0, 0}, {0, 1, 0},    {2, 0, 0},
                                   {0, 0, 1}, {-1, -1, -1}, {3, 0, 0}};

TEST(interpolation_rules, of_sites_in_one_place_the_first_or_the_mean_counts) {
  const Interpolator interpolator(delaunay(shared));
  const std::vector<double> field = {1, 10, 2, 100, 1000, 6};
  const std::vector<Point> targets = {{5, 0, 0}, {1, 1, 1}};
  for (const Method method : {Method::nearest, Method::linear}) {
    const auto first = interpolator.values(field, targets, {.method = method});
    EXPECT_EQ(first[0], 1);
    const InterpolationOptions mean = {.method = method, .shared_place = SharedPlace::mean};
    const auto means = interpolator.values(field, targets, mean);
    EXPECT_EQ(means[0], 3);
    const Weights weights = interpolator.weights(targets, mean);
    const WeightRow row = row_of(weights, 0);
    EXPECT_TRUE(std::ranges::equal(row.columns, std::array<Index, 3>{0, 2, 5}));
    for (const double w : row.values) EXPECT_EQ(w, 1.0 / 3);
    std::vector<double> applied(2);
    apply(weights, field, applied);
    EXPECT_NEAR(applied[0], 3, 1e-15);
    EXPECT_NEAR(applied[1], means[1], 1e-13);
  }
  EXPECT_NEAR(interpolator.values(field, targets, {.method = Method::linear})[1], 37, 1e-13);
}

template <class Work>
void expect_refused(std::size_t index, const std::string& message, const Work& work) {
  try {
    work();
    ADD_FAILURE() << "not refused: " << message;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index) << error.what();
    EXPECT_EQ(std::string(error.what()), message);
  }
}

TEST(interpolation_rules, of_sites_in_one_place_the_first_duplicate_is_an_error_if_asked_for) {
  const Interpolator interpolator(delaunay(shared));
  expect_refused(2, "site 2 is in the place of site 0", [&] {
    static_cast<void>(interpolator.weights(
        shared, {.method = Method::nearest, .shared_place = SharedPlace::error}));
  });
}

// --- low dimensions ---

TEST(interpolation_rules, without_sites_there_are_no_values) {
  const Interpolator interpolator{Triangulation()};
  const std::vector<Point> targets = {{1, 0, 0}, {0, 1, 0}};
  for (const Method method : methods) {
    const auto values =
        interpolator.values({}, targets, {.method = method, .outside = Outside::nearest});
    ASSERT_EQ(values.size(), 2U);
    EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[1]));
    const Weights weights = interpolator.weights(targets, {.method = method});
    EXPECT_EQ(weights.offsets, std::vector<std::uint64_t>({0, 0, 0}));
  }
  expect_refused(0, "target 0 is outside of the sites' faces", [&] {
    static_cast<void>(
        interpolator.values({}, targets, {.method = Method::linear, .outside = Outside::error}));
  });
}

TEST(interpolation_rules, one_site_is_known_at_itself_and_as_the_nearest) {
  const Interpolator interpolator(delaunay(std::vector<Point>{{0, 0, 2}}));
  const std::vector<Point> targets = {{0, 0, 1}, {0, 1, 1}};
  for (const Method method : {Method::linear, Method::sibson, Method::cubic}) {
    const auto values = interpolator.values(std::array{5.0}, targets, {.method = method});
    EXPECT_EQ(values[0], 5);
    EXPECT_TRUE(std::isnan(values[1]));
  }
  EXPECT_EQ(interpolator.values(std::array{5.0}, targets, {.method = Method::nearest}),
            std::vector<double>({5, 5}));
}

TEST(interpolation_rules, on_a_circle_values_are_linear_within_solid_arcs) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {0, 1, 2};
  const std::vector<Point> targets = {{1, 1, 0}, {2, 1, 0}, {0, -1, 0}, {1, 1, 1e-9}};
  for (const Method method : {Method::linear, Method::laplace, Method::hermite}) {
    const auto values = interpolator.values(field, targets, {.method = method});
    EXPECT_NEAR(values[0], 0.5, 1e-15);
    EXPECT_NEAR(values[1], 1.0 / 3, 1e-15);  // of the chord, where x : y = 2 : 1
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_TRUE(std::isnan(values[3]));
  }
}

// --- vectors ---

TEST(interpolation_rules, rotations_come_back_across_the_poles) {
  Random random(9);
  for (const char* const kind : {"uniform", "globe_grid", "hemisphere", "patch_1e_6"}) {
    const SiteSet set = generator(kind).make(300, 2);
    const Point axis = 10 * random.direction();
    std::vector<Point> field;
    std::vector<double> coordinates(3 * set.sites.size());
    for (std::size_t i = 0; i < set.sites.size(); ++i) {
      const Point x = normalized(set.sites[i]);
      field.push_back(cross_product(axis, x));
      coordinates[i] = x.x;
      coordinates[set.sites.size() + i] = x.y;
      coordinates[2 * set.sites.size() + i] = x.z;
    }
    const Interpolator interpolator(delaunay(set.sites));
    std::vector<Point> targets = {{0, 0, 1}, {0, 0, -1}, {1e-9, 0, 1}, {1, 2, -1e9}};
    for (int i = 0; i < 200; ++i) {
      targets.push_back(random_near(random, set.sites[random.below(set.sites.size())], 1e-7));
    }
    for (const Method method : {Method::linear, Method::laplace, Method::sibson}) {
      const InterpolationOptions options = {.method = method,
                                            .normalization = Normalization::homogeneous};
      const auto found = interpolator.vectors(field, targets, options);
      const auto xyz = interpolator.values(coordinates, targets, options);
      for (std::size_t t = 0; t < targets.size(); ++t) {
        if (std::isnan(found[t].x)) continue;
        const Point u = normalized(targets[t]);
        const Point off = found[t] - cross_product(axis, u);
        EXPECT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), 2e-14) << kind;
        EXPECT_NEAR(xyz[t], u.x, 1e-15) << kind;
        EXPECT_NEAR(xyz[targets.size() + t], u.y, 1e-15) << kind;
        EXPECT_NEAR(xyz[2 * targets.size() + t], u.z, 1e-15) << kind;
      }
    }
  }
}

TEST(interpolation_rules, vectors_are_tangent_and_several_at_once) {
  const auto sites = generator("uniform").make(100, 2).sites;
  const auto targets = generator("uniform").make(50, 3).sites;
  const Interpolator interpolator(delaunay(sites));
  Random random(1);
  std::vector<Point> field;
  for (int i = 0; i < 200; ++i) field.push_back(random.direction());
  for (const Method method : methods) {
    const auto both = interpolator.vectors(field, targets, {.method = method});
    const auto second =
        interpolator.vectors(std::span(field).subspan(100), targets, {.method = method});
    ASSERT_EQ(both.size(), 100U);
    EXPECT_TRUE(std::ranges::equal(std::span(both).subspan(50), second));
    for (std::size_t t = 0; t < 50; ++t) {
      const Point& u = targets[t];
      EXPECT_NEAR(both[t].x * u.x + both[t].y * u.y + both[t].z * u.z, 0, 1e-15);
    }
  }
}

// --- values that are missing, and what is refused ---

TEST(interpolation_rules, a_missing_value_is_missed_where_it_counts) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {nan, 1, 2, 3};
  const auto values = interpolator.values(
      field, std::vector<Point>{{1, 1, 1}, {0, 1, 1}, {0, 1, 0}}, {.method = Method::linear});
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_NEAR(values[1], 1.5, 1e-15);
  EXPECT_EQ(values[2], 1);
}

TEST(interpolation_rules, what_breaks_the_contract_is_refused) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {0, 1, 2, 3};
  const std::vector<Point> bad = {{1, 0, 0}, {nan, 0, 0}};
  const std::vector<Point> center = {{1, 0, 0}, {1, 2, 3}, {0, 0, 0}};
  const auto ask = [&](std::span<const double> f, std::span<const Point> targets,
                       const InterpolationOptions& options = {.method = Method::linear}) {
    static_cast<void>(interpolator.values(f, targets, options));
  };
  expect_refused(1, "target 1: (nan, 0, 0) is not finite", [&] { ask(field, bad); });
  expect_refused(2, "target 2: (0, 0, 0) is the center of the sphere and has no direction",
                 [&] { ask(field, center); });
  expect_refused(3, "field has 3 values, which are no fields of 4 sites",
                 [&] { ask(std::span(field).first(3), sites); });
  expect_refused(0, "field has 0 values, which are no fields of 4 sites", [&] { ask({}, sites); });
  expect_refused(0, "there is no such method",
                 [&] { ask(field, sites, {.method = static_cast<Method>(17)}); });
  expect_refused(1, "field has 1 values, which are no fields of 0 sites", [&] {
    static_cast<void>(Interpolator(Triangulation()).values(std::array{1.0}, sites));
  });
}

TEST(interpolation_rules, weighted_sites_have_the_nearest_by_power_distance) {
  const std::vector<Point> sites = {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Triangulation triangulation = delaunay(sites, {.model = Model::weighted});
  const Interpolator interpolator(triangulation);
  const std::vector<double> field = {0, 1, 2, 3};
  const std::vector<Point> targets = {{1, 1.5, 0}, {1, 2.5, 0}};
  EXPECT_EQ(interpolator.values(field, targets, {.method = Method::nearest}),
            std::vector<double>({0, 1}));
  expect_refused(0, "weighted sites have no method but nearest", [&] {
    static_cast<void>(interpolator.weights(targets, {.method = Method::linear}));
  });
}

TEST(interpolation_rules, hashes_are_those_of_sites_and_targets_or_none) {
  const auto sites = generator("uniform").make(100, 2).sites;
  const auto targets = generator("uniform").make(50, 3).sites;
  const Interpolator interpolator(delaunay(sites));
  const Weights with = interpolator.weights(targets, {.method = Method::nearest});
  EXPECT_EQ(with.sites_hash, point_set_hash(sites));
  EXPECT_EQ(with.targets_hash, point_set_hash(targets));
  const Weights without =
      interpolator.weights(targets, {.method = Method::nearest, .hashes = false});
  EXPECT_EQ(without.sites_hash, 0U);
  EXPECT_EQ(without.targets_hash, 0U);
}

TEST(interpolation_rules, progress_is_told_and_a_flag_obeyed) {
  const auto sites = generator("uniform").make(100, 2).sites;
  const auto targets = generator("uniform").make(20000, 3).sites;
  const Interpolator interpolator(delaunay(sites));
  std::vector<double> fractions;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "interpolate");
    fractions.push_back(fraction);
  };
  static_cast<void>(interpolator.weights(targets, {.method = Method::linear},
                                         {.threads = 1, .progress = progress}));
  EXPECT_EQ(fractions.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(fractions.back(), 1);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(
      static_cast<void>(interpolator.weights(targets, {.method = Method::linear}, {.stop = &stop})),
      Interrupted);
}

}  // namespace
}  // namespace rondel::test
