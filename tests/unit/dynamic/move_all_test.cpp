// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All sites move at once, near and far, into each other and to one side: the result is that of a build
// of the new points, and the object can go on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynamic/editor.h"
#include "models/projected_points.h"
#include "models/weighted_points.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

void expect_build(const DynamicTriangulation& moved, const Options& options,
                  const std::string& what) {
  const Snapshot now = moved.snapshot();
  std::vector<Point> points;
  for (const Index id : now.ids) points.push_back(moved.site(id));
  const Triangulation expected = delaunay(points, options);
  const Triangulation& t = now.triangulation;
  ASSERT_EQ(t.dimension(), expected.dimension()) << what;
  ASSERT_TRUE(std::ranges::equal(t.faces(), expected.faces())) << what;
  ASSERT_TRUE(std::ranges::equal(t.neighbors(), expected.neighbors())) << what;
  ASSERT_TRUE(std::ranges::equal(t.ghost_faces(), expected.ghost_faces())) << what;
  ASSERT_TRUE(std::ranges::equal(t.hidden(), expected.hidden())) << what;
  ASSERT_TRUE(std::ranges::equal(t.duplicates(), expected.duplicates())) << what;
  ASSERT_TRUE(std::ranges::equal(t.ring(), expected.ring())) << what;
  ASSERT_EQ(moved.num_vertices(), expected.num_vertices()) << what;
  ASSERT_EQ(moved.num_faces(), expected.num_faces()) << what;
  for (std::size_t i = 0; i < std::min<std::size_t>(now.ids.size(), 50); ++i) {
    const Index representative = moved.representative(now.ids[i]);
    ASSERT_EQ(moved.neighbors(now.ids[i]), moved.neighbors(representative)) << what;
  }
}

// Each point moves by up to `length` along each axis.
std::vector<Point> shaken(std::span<const Point> points, double length, Random& random) {
  std::vector<Point> result;
  for (const Point& p : points) {
    result.push_back({p.x + length * random.signed_unit(), p.y + length * random.signed_unit(),
                      p.z + length * random.signed_unit()});
  }
  return result;
}

std::vector<Point> points_of(const DynamicTriangulation& moved) {
  std::vector<Point> points;
  for (const Index id : moved.ids()) points.push_back(moved.site(id));
  return points;
}

double spacing_of(std::size_t n) {
  return std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
}

TEST(move_all, is_a_build_for_sites_on_the_sphere_and_any_length) {
  for (const Model model : {Model::projected, Model::weighted}) {
    for (const std::size_t n : {4U, 5U, 12U, 100U, 700U, 3000U}) {
      Random random(n);
      std::vector<Point> points(n);
      for (Point& p : points) p = random.direction();
      DynamicTriangulation moved(points, {.model = model});
      for (const double share : {0.0, 0.001, 0.03, 0.1, 0.3, 1.0, 0.1, 10.0, 0.05}) {
        const std::string what = std::to_string(n) + " moved by " + std::to_string(share);
        points = shaken(points, share * spacing_of(n), random);
        moved.move_all(points, {.threads = 1 + static_cast<unsigned>(n % 2)});
        ASSERT_NO_FATAL_FAILURE(expect_build(moved, {.model = model}, what));
      }
    }
  }
}

TEST(move_all, is_a_build_for_every_kind_of_degenerate_input) {
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      Random random(7);
      const auto [sites, sphere] = kind.make(300, 3);
      const Options options = {.model = model, .sphere = sphere};
      DynamicTriangulation moved(sites, options);
      for (const double length : {0.0, 1e-16, 1e-9, 0.003, 0.03}) {
        const std::string what = std::string(kind.name) + " moved by " + std::to_string(length);
        moved.move_all(shaken(sites, length, random));
        ASSERT_NO_FATAL_FAILURE(expect_build(moved, options, what));
      }
      moved.move_all(sites);  // all of them back
      ASSERT_NO_FATAL_FAILURE(expect_build(moved, options, std::string(kind.name) + " again"));
    }
  }
}

// Sites on one ray share a place, whatever their coordinates: in the result, or under way alone.
TEST(move_all, lets_sites_meet_on_a_ray) {
  for (const Model model : {Model::projected, Model::weighted}) {
    for (const std::size_t n : {20U, 300U, 2000U}) {
      for (int round = 0; round < 40; ++round) {
        Random random(1000 * n + static_cast<std::size_t>(round));
        std::vector<Point> points(n);
        for (Point& p : points) p = random.direction();
        points[1] = {0, 0, 1};
        DynamicTriangulation moved(points, {.model = model});
        const auto neighbor = [&](Index i) { return moved.neighbors(i).front(); };
        const Index first = neighbor(0);
        const Index pole = neighbor(1);
        const auto other = static_cast<Index>(random.below(n));
        const Point before = points[0];
        switch (round % 5) {
          case 0:
            points[0] = 2 * points[first];
            break;
          case 1:
            points[0] = 0.5 * points[other];
            break;
          case 2:
            points[pole] = {0, 0, 1 + 1e-9};
            break;
          case 3:
            points[0] = 2 * points[first];
            points[first] = 2 * before;
            break;
          default:
            for (int k = 0; k < 10; ++k) points[random.below(n)] = 4 * points[random.below(n)];
        }
        moved.move_all(points);
        ASSERT_NO_FATAL_FAILURE(
            expect_build(moved, {.model = model}, std::to_string(n) + std::to_string(round)));
      }
    }
  }
}

// Ties: sites of a grid move to places of the grid, so that four and more are cocircular, and meet.
TEST(move_all, breaks_ties_as_a_build_does) {
  constexpr int steps = 12;
  Random random(5);
  const auto on_cube = [](int face, int u, int v) {
    const double a = 2.0 * u / steps - 1;
    const double b = 2.0 * v / steps - 1;
    const double side = face % 2 == 0 ? 1 : -1;
    const std::array<Point, 3> points = {{{side, a, b}, {a, side, b}, {a, b, side}}};
    return points[static_cast<std::size_t>(face / 2)];
  };
  struct Position {
    int face, u, v;
  };
  std::vector<Position> positions;
  for (int face = 0; face < 6; ++face) {
    for (int u = 1; u < steps; ++u) {
      for (int v = 1; v < steps; ++v) positions.push_back({face, u, v});
    }
  }
  const auto points_at = [&] {
    std::vector<Point> points;
    for (const auto& [face, u, v] : positions) points.push_back(on_cube(face, u, v));
    return points;
  };
  for (const Model model : {Model::projected, Model::weighted}) {
    DynamicTriangulation moved(points_at(), {.model = model});
    for (int round = 0; round < 20; ++round) {
      for (int i = 0; i < 3 * round; ++i) {
        Position& p = positions[random.below(positions.size())];
        p.u = std::clamp(p.u + random.between(-1, 1), 1, steps - 1);
        p.v = std::clamp(p.v + random.between(-1, 1), 1, steps - 1);
      }
      moved.move_all(points_at());
      ASSERT_NO_FATAL_FAILURE(
          expect_build(moved, {.model = model}, "round " + std::to_string(round)));
    }
  }
}

TEST(move_all, keeps_duplicates_that_move_together_and_parts_those_that_do_not) {
  Random random(3);
  std::vector<Point> points;
  for (int i = 0; i < 400; ++i) points.push_back(random.direction());
  for (int i = 0; i < 100; ++i) {
    const Point& p = points[random.below(400)];
    const double factor = i % 2 == 0 ? 2 : 0.25;  // another place on the same ray, exactly
    points.push_back({factor * p.x, factor * p.y, factor * p.z});
  }
  DynamicTriangulation moved(points);
  for (int round = 0; round < 6; ++round) {
    for (Point& p : points) p = {p.y, -p.x, p.z};  // a quarter turn: together
    moved.move_all(points);
    ASSERT_NO_FATAL_FAILURE(expect_build(moved, {}, "turned"));
    for (Point& p : points) p = {-p.x, -p.y, p.z};
    for (Point& p : points) p = {p.x, p.y, p.z + 1e-4 * std::abs(p.x)};
    moved.move_all(points);
    ASSERT_NO_FATAL_FAILURE(expect_build(moved, {}, "raised"));
    points[random.below(points.size())] = points[random.below(points.size())];
    points[450] = random.direction();
    moved.move_all(points);
    ASSERT_NO_FATAL_FAILURE(expect_build(moved, {}, "parted"));
  }
}

TEST(move_all, takes_hostile_points) {
  Random random(11);
  std::vector<Point> points(500);
  for (Point& p : points) p = random.direction();
  for (const Model model : {Model::projected, Model::weighted}) {
    const Options options = {.model = model};
    DynamicTriangulation moved(points, options);
    const auto move_to = [&](const std::vector<Point>& to, const char* what) {
      moved.move_all(to);
      expect_build(moved, options, what);
    };
    std::vector<Point> to = points;
    std::ranges::reverse(to);
    move_to(to, "all cross");
    for (Point& p : to) p = {-p.x, -p.y, -p.z};
    move_to(to, "inverted");
    for (Point& p : to) p = {-p.x, p.y, p.z};
    move_to(to, "mirrored");
    for (Point& p : to) p = {p.x, p.y, 2 + p.z};
    move_to(to, "beyond the hemisphere");
    move_to(points, "around again");
    move_to(std::vector<Point>(points.size(), {0.5, 0.25, -1}), "in one place");
    for (Point& p : to) p = {p.x, p.y, 0};
    move_to(to, "on a great circle");
    move_to(points, "and back");
    for (Point& p : to) p = random.coin() ? Point{1, 2, 3} : random.direction();
    move_to(to, "half in one place");
    // Twice around: each longitude doubled, so that faces stay positive but cover all twice.
    to = points;
    for (Point& p : to) p = {p.x * p.x - p.y * p.y, 2 * p.x * p.y, p.z};
    move_to(to, "twice around");
    to = points;
    for (Point& p : to) p = {0x1p-500 * p.x, 0x1p-500 * p.y, 0x1p-500 * p.z};
    move_to(to, "tiny");
    for (Point& p : to) p = {0x1p999 * p.x, 0x1p999 * p.y, 0x1p999 * p.z};
    move_to(to, "large");
  }
}

// Weighted sites that are hidden, come back, and hide others.
TEST(move_all, hides_weighted_sites_as_a_build_does) {
  Random random(17);
  std::vector<Point> points(800);
  for (Point& p : points) p = random.direction();
  const Options options = {.model = Model::weighted};
  DynamicTriangulation moved(points, options);
  for (const double spread : {0.0, 1e-6, 1e-4, 1e-3, 0.02, 0.3, 0.0}) {
    std::vector<Point> to = points;
    for (Point& p : to) {
      const double factor = 1 + spread * random.signed_unit();
      p = {factor * p.x, factor * p.y, factor * p.z};
    }
    moved.move_all(to);
    ASSERT_NO_FATAL_FAILURE(expect_build(moved, options, "spread " + std::to_string(spread)));
  }
}

// The index of places is sorted when it is needed again.
TEST(move_all, leaves_an_object_that_changes_and_answers_as_before) {
  Random random(23);
  std::vector<Point> points(1000);
  for (Point& p : points) p = random.direction();
  for (const Model model : {Model::projected, Model::weighted}) {
    DynamicTriangulation moved(points, {.model = model});
    for (int round = 0; round < 10; ++round) {
      for (int i = 0; i < 30; ++i) {
        const std::vector<Index> ids = moved.ids();
        const Index id = ids[random.below(ids.size())];
        if (i % 3 == 0) {
          moved.remove(id);
        } else if (i % 3 == 1) {
          moved.insert(random.direction());
        } else {
          moved.move(id, random.direction());
        }
      }
      moved.move_all(shaken(points_of(moved), 0.1 * spacing_of(1000), random));
      if (round % 2 == 0) {
        moved.move_all(shaken(points_of(moved), 0.1 * spacing_of(1000), random));
      }
      const Snapshot now = moved.snapshot();
      const Locator locator(moved);
      const Locator expected(now.triangulation);
      for (int i = 0; i < 20; ++i) {
        const Point query = random.direction();
        ASSERT_EQ(locator.nearest(query), now.ids[expected.nearest(query)]);
      }
      ASSERT_NO_FATAL_FAILURE(expect_build(moved, {.model = model}, std::to_string(round)));
    }
  }
}

// Whether flips suffice for sites that move by a share of the spacing.
template <models::MovingSphereModel T>
bool is_mended(double share, unsigned threads) {
  constexpr std::size_t n = 4000;
  Random random(31);
  std::vector<Point> points(n);
  for (Point& p : points) p = random.direction();
  dynamic::Editor<T> editor(T::model, {});
  const std::vector<Index> ids = editor.insert(points, {});
  bool is_built = false;
  const bool result = editor.move_all(ids, shaken(points, share * spacing_of(n), random), threads,
                                      [&] { is_built = true; });
  EXPECT_NE(result, is_built);
  return result;
}

TEST(move_all, needs_no_build_where_sites_move_by_little) {
  for (const unsigned threads : {1U, 2U}) {
    EXPECT_TRUE(is_mended<models::ProjectedPoints>(0.01, threads));
    EXPECT_TRUE(is_mended<models::ProjectedPoints>(0.1, threads));
    EXPECT_FALSE(is_mended<models::ProjectedPoints>(3, threads));
    EXPECT_TRUE(is_mended<models::WeightedPoints>(1e-4, threads));
  }
}

TEST(move_all, refuses_what_is_no_place_for_each_site) {
  std::vector<Point> points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  DynamicTriangulation moved(points);
  EXPECT_THROW(moved.move_all(std::span(points).first(3)), InvalidInput);
  points[2].x = std::numeric_limits<double>::quiet_NaN();
  try {
    moved.move_all(points);
    FAIL() << "took what is not a number";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), 2U);
  }
  points[2] = {};
  EXPECT_THROW(moved.move_all(points), InvalidInput);  // the center
  EXPECT_EQ(moved.site(2), (Point{0, 0, 1}));
  DynamicTriangulation empty;
  empty.move_all({});
  EXPECT_EQ(empty.num_sites(), 0U);
}

}  // namespace
}  // namespace rondel::test
