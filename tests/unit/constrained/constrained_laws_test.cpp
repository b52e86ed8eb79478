// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of constrained triangulations, on hostile sites with many constraints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "order/spatial_order.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic_constrained.h"
#include "rondel/predicates.h"
#include "support/generators.h"

namespace rondel::test::of_constrained_laws {
namespace {

using Ends = std::array<Index, 2>;

Point beside(Point center, double Point::*axis) {
  double& value = center.*axis;
  value = value >= 0 ? value - std::max(1.0, value) : value + std::max(1.0, -value);
  return center;
}

// True if two sites have an arc.
bool has_arc(const SiteSet& set, const Ends& e) {
  const Point& a = set.sites[e[0]];
  const Point& b = set.sites[e[1]];
  for (double Point::*axis : {&Point::x, &Point::y, &Point::z}) {
    if (orientation(a, b, beside(set.sphere.center, axis), set.sphere) != Sign::zero) return true;
  }
  return false;
}

bool do_cross(const SiteSet& set, const Ends& e, const Ends& f) {
  const auto side = [&](const Ends& arc, Index v) {
    return static_cast<int>(
        orientation(set.sites[arc[0]], set.sites[arc[1]], set.sites[v], set.sphere));
  };
  const int c = side(e, f[0]);
  return c != 0 && side(e, f[1]) == -c && side(f, e[0]) == -c && side(f, e[1]) == c;
}

// Constraints without crossings: long ones, and many between sites that are close in the input.
std::vector<Ends> free_constraints(const SiteSet& set, std::size_t wanted, Random& random) {
  std::vector<Ends> constraints;
  const std::size_t n = set.sites.size();
  for (std::size_t k = 0; k < 2 * wanted; ++k) {
    const auto a = static_cast<Index>(random.below(n));
    const std::size_t far = k % 8 == 0 ? n : std::min<std::size_t>(n, 9);
    const auto b = static_cast<Index>((a + random.below(far)) % n);
    if (!has_arc(set, {a, b})) continue;
    const bool is_free = std::ranges::none_of(constraints, [&](const Ends& other) {
      return do_cross(set, {a, b}, other);
    });
    if (is_free) constraints.push_back({a, b});
  }
  return constraints;
}

std::vector<std::string> flaws_of_order(const ConstrainedTriangulation& result) {
  const Triangulation& t = result.triangulation;
  std::vector<Index> rank(t.num_sites(), no_index);
  const auto order = order::spatial_order(t.sites().points(), t.model(), t.sphere().center, 1);
  std::vector<Index> name(t.num_sites());
  std::iota(name.begin(), name.end(), 0);
  for (const auto& [site, representative] : t.duplicates()) name[site] = representative;
  for (Index r = 0; r < order.order.size(); ++r) rank[name[order.order[r]]] = r;
  std::vector<std::string> flaws;
  for (std::size_t f = 0; f < t.num_faces(); ++f) {
    const auto& [a, b, c] = t.faces()[f];
    if (rank[a] > rank[b] || rank[a] > rank[c]) flaws.push_back("corner of " + std::to_string(f));
    if (f == 0) continue;
    const Triple& before = t.faces()[f - 1];
    if (rank[before[0]] > rank[a]) flaws.push_back("owner of " + std::to_string(f));
  }
  for (std::size_t f = 0; f < t.num_faces();) {
    std::size_t end = f;
    for (; end < t.num_faces() && t.faces()[end][0] == t.faces()[f][0]; ++end) {
      if (rank[t.faces()[end][1]] < rank[t.faces()[f][1]]) flaws.emplace_back("first of owner");
    }
    f = end;
  }
  return flaws;
}

// The arrays of a result under the names of other sites.
struct NamedArrays {
  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
  std::vector<Index> ghosts;
  std::vector<std::uint8_t> sides;
  friend bool operator==(const NamedArrays&, const NamedArrays&) = default;
};

NamedArrays arrays_of(const ConstrainedTriangulation& result, const std::vector<Index>& names) {
  const Triangulation& t = result.triangulation;
  NamedArrays arrays;
  for (const auto& [a, b, c] : t.faces()) arrays.faces.push_back({names[a], names[b], names[c]});
  arrays.neighbors.assign(t.neighbors().begin(), t.neighbors().end());
  arrays.ghosts.assign(t.ghost_faces().begin(), t.ghost_faces().end());
  arrays.sides = result.sides;
  return arrays;
}

std::vector<Index> names_of(const Triangulation& t) {
  std::vector<Index> names(t.num_sites());
  std::iota(names.begin(), names.end(), 0);
  for (const auto& [site, representative] : t.duplicates()) names[site] = representative;
  return names;
}

void expect_no_order_matters(const SiteSet& set, const std::vector<Ends>& constraints,
                             const ConstrainedTriangulation& result, Random& random) {
  std::vector<Index> old(set.sites.size());
  std::iota(old.begin(), old.end(), 0);
  random.shuffle(old);
  std::vector<Point> sites;
  std::vector<Index> now(old.size());
  for (Index i = 0; i < old.size(); ++i) {
    sites.push_back(set.sites[old[i]]);
    now[old[i]] = i;
  }
  std::vector<Ends> others;
  for (const auto& [a, b] : constraints) {
    others.push_back(random.coin() ? Ends{now[a], now[b]} : Ends{now[b], now[a]});
  }
  random.shuffle(others);
  const auto changed = constrained_delaunay(sites, others, {.sphere = set.sphere}, {.threads = 3});
  const std::vector<Index> names = names_of(result.triangulation);
  std::vector<Index> renamed;
  for (const Index site : old) renamed.push_back(names[site]);
  EXPECT_TRUE(arrays_of(changed, renamed) == arrays_of(result, names));
}

void expect_laws(const SiteSet& set, const std::vector<Ends>& constraints, Random& random) {
  const auto result = constrained_delaunay(set.sites, constraints, {.sphere = set.sphere});
  const Triangulation& t = result.triangulation;
  EXPECT_EQ(check_constrained(set.sites, constraints, t.faces(), set.sphere).reason, "");
  EXPECT_EQ(flaws_of_order(result), std::vector<std::string>());
  EXPECT_NO_THROW(Triangulation::from_arrays(set.sites,
                                             {.dimension = t.dimension(),
                                              .faces = t.faces(),
                                              .neighbors = t.neighbors(),
                                              .ghost_faces = t.ghost_faces(),
                                              .ring = t.ring(),
                                              .duplicates = t.duplicates()},
                                             {Model::projected, set.sphere}));
  expect_no_order_matters(set, constraints, result, random);
  // Its edges as constraints give it again.
  const auto again = constrained_delaunay(set.sites, result.edges, {.sphere = set.sphere});
  EXPECT_TRUE(arrays_of(again, names_of(t)) == arrays_of(result, names_of(t)));
  EXPECT_EQ(again.edges, result.edges);
  const auto none = constrained_delaunay(set.sites, {}, {.sphere = set.sphere});
  EXPECT_TRUE(std::ranges::equal(none.triangulation.faces(),
                                 delaunay(set.sites, {Model::projected, set.sphere}).faces()));
}

TEST(constrained_laws, hold_for_all_kinds_of_sites) {
  Random random(7);
  for (const Generator& kind : generators()) {
    if (kind.weighted_only) continue;
    for (const std::size_t n : {5U, 12U, 60U, 400U}) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(n));
      const SiteSet set = kind.make(n, n);
      if (set.sites.empty()) continue;
      expect_laws(set, free_constraints(set, n, random), random);
    }
  }
}

TEST(constrained_laws, hold_for_two_thousand_constraints) {
  Random random(8);
  for (const std::string_view name : {"uniform", "cap", "duplicates"}) {
    SCOPED_TRACE(name);
    for (const Generator& kind : generators()) {
      if (kind.name != name) continue;
      const SiteSet set = kind.make(4'000, 1);
      expect_laws(set, free_constraints(set, 2'000, random), random);
    }
  }
}

// Every constraint is a path along the edges that come from it.
void expect_paths(const ConstrainedTriangulation& result, const std::vector<Ends>& constraints) {
  std::vector<std::vector<Index>> ends(constraints.size());
  for (std::size_t e = 0; e < result.edges.size(); ++e) {
    for (const Index i : result.sources[e]) {
      ends[i].insert(ends[i].end(), result.edges[e].begin(), result.edges[e].end());
    }
  }
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    // All sites of a path but its ends are in two edges.
    std::ranges::sort(ends[i]);
    std::vector<Index> odd;
    for (const Index v : ends[i]) {
      const auto count = std::ranges::count(ends[i], v);
      EXPECT_LE(count, 2);
      if (count == 1) odd.push_back(v);
    }
    const auto [low, high] = std::minmax(constraints[i][0], constraints[i][1]);
    EXPECT_EQ(odd, (std::vector<Index>{low, high}));
  }
}

TEST(constrained_laws, hold_for_crossings_that_are_split) {
  Random random(9);
  for (const std::size_t n : {4U, 10U, 50U, 300U}) {
    SCOPED_TRACE(n);
    SiteSet set;
    for (std::size_t i = 0; i < n; ++i) set.sites.push_back(random_direction(random));
    std::vector<Ends> constraints;
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = static_cast<Index>(random.below(n));
      const auto b = static_cast<Index>(random.below(n));
      if (a != b) constraints.push_back({a, b});
    }
    const auto result =
        constrained_delaunay(set.sites, constraints, {.crossings = ConstraintCrossings::split});
    const Triangulation& t = result.triangulation;
    EXPECT_EQ(check_constrained(t.sites().points(), result.edges, t.faces()).reason, "");
    EXPECT_TRUE(std::ranges::equal(t.sites().points().subspan(0, n), set.sites));
    expect_paths(result, constraints);
    std::ranges::reverse(constraints);
    const auto reversed = constrained_delaunay(
        set.sites, constraints, {.crossings = ConstraintCrossings::split}, {.threads = 2});
    EXPECT_TRUE(std::ranges::equal(reversed.triangulation.faces(), t.faces()));
    EXPECT_EQ(reversed.triangulation.sites(), t.sites());
    EXPECT_EQ(reversed.edges, result.edges);
  }
}

// A star with many arms, and a long constraint between two rows of sites.
TEST(constrained_laws, hold_for_stars_and_rows) {
  Random random(10);
  SiteSet star;
  star.sites.push_back({0, 0, 1});
  std::vector<Ends> arms;
  for (Index i = 1; i <= 3'000; ++i) {
    Point p = random_direction(random);
    p.z = std::abs(p.z) + 0.1;
    star.sites.push_back(p);
    arms.push_back({0, i});
  }
  const auto result = constrained_delaunay(star.sites, arms);
  EXPECT_EQ(check_constrained(star.sites, arms, result.triangulation.faces()).reason, "");

  SiteSet rows;
  rows.sites = {{1, -1, 0}, {1, 1, 0}};
  for (int i = -400; i <= 400; ++i) {
    rows.sites.push_back({1, i / 500.0, 0.01});
    rows.sites.push_back({1, i / 500.0, -0.001 - i * i * 1e-8});
  }
  expect_laws(rows, {{0, 1}}, random);
}

// Closed lines of sites that follow each other, a ring that meets all of them, and few sites elsewhere,
// without which no site is on the other half of the sphere: nearly all constraints are edges.
TEST(constrained_laws, hold_for_coasts) {
  Random random(21);
  for (const bool is_around : {true, false}) {
    SCOPED_TRACE(is_around);
    SiteSet coasts;
    std::vector<Ends> constraints;
    const auto add_line = [&](double x, double y, double radius, Index size) {
      const auto first = static_cast<Index>(coasts.sites.size());
      for (Index i = 0; i < size; ++i) {
        const double turn = 6.283185307179586 * (i + 0.3 * random.unit()) / size;
        const double r = radius * (1 + 0.02 * random.unit());
        coasts.sites.push_back({x + r * std::cos(turn), y + r * std::sin(turn), 1});
        const Ends side = {first + i, first + (i + 1) % size};
        constraints.push_back(random.coin() ? side : Ends{side[1], side[0]});
      }
    };
    for (int k = 0; k < 6; ++k) add_line(k % 3 * 0.5 - 0.5, k / 3 * 0.5, 0.2, 700);
    add_line(0, 0.25, 1.2, 90);
    // Sides that are far longer than what is beside them.
    const auto last = static_cast<Index>(coasts.sites.size() - 1);
    for (int k = 0; k < 60; ++k) {
      coasts.sites.push_back({1.5 * random.unit() - 0.75, 0.8 + 0.01 * random.unit(), 1});
    }
    for (Index i = last - 80; i < last - 10; i += 7) constraints.push_back({i, i + 2});
    if (is_around) {
      for (int k = 0; k < 40; ++k) {
        coasts.sites.push_back({random.unit() - 0.5, random.unit() - 0.5, -0.6});
      }
    }
    std::vector<Ends> free;
    for (const Ends& e : constraints) {
      const bool is_free =
          std::ranges::none_of(free, [&](const Ends& f) { return do_cross(coasts, e, f); });
      if (is_free && has_arc(coasts, e)) free.push_back(e);
    }
    EXPECT_GT(free.size(), std::size_t{4'200});
    expect_laws(coasts, free, random);
    free.push_back(free.front());
    const auto twice = constrained_delaunay(coasts.sites, free, {});
    EXPECT_EQ(twice.sources.values.size(), twice.edges.size() + 1);
    expect_paths(twice, free);
  }
}

// A constraint between two arcs of spirals, along which each face cuts off one site; with dents, more
// and more of which are reflex.
TEST(constrained_laws, hold_between_curves) {
  Random random(13);
  for (const double dents : {0.0, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2}) {
    for (const int n : {20, 90, 350}) {
      SCOPED_TRACE(std::to_string(dents) + " " + std::to_string(n));
      SiteSet curves;
      curves.sites = {{1, -0.2, 0}, {1, 0.2, 0}};
      for (int i = 1; i < n; ++i) {
        const double t = static_cast<double>(i) / n;
        const double height = t * (1 - t) * (1 + 2 * t * t);
        curves.sites.push_back({1, 0.4 * t - 0.2, 0.1 * height + dents * random.unit()});
        curves.sites.push_back({1, 0.4 * t - 0.199, -0.08 * height - dents * random.unit()});
      }
      expect_laws(curves, {{0, 1}}, random);
    }
  }
}

// Three sites in 32 of each curve are nearer to the constraint, one of them close to it: polygons that
// are almost convex, the sides of which are not all Delaunay.
TEST(constrained_laws, hold_between_curves_with_notches) {
  Random random(14);
  for (std::size_t k = 0; k < scaled(60); ++k) {
    SCOPED_TRACE(k);
    const int n = 34 + static_cast<int>(random.below(90));
    const int shift = static_cast<int>(random.below(32));
    const auto depth = [&](int i) {
      const int place = (i + shift) % 32;
      if (place == 16) return 0.02 + 0.1 * random.unit();
      return place == 14 || place == 18 ? 0.1 + 0.8 * random.unit() : 1.0;
    };
    SiteSet curves;
    curves.sites = {{1, -0.2, 0}, {1, 0.2, 0}};
    for (int i = 1; i < n; ++i) {
      const double t = static_cast<double>(i) / n;
      const double height = t * (1 - t) * (1 + 2 * t * t);
      curves.sites.push_back({1, 0.4 * t - 0.2, 0.2 * height * depth(i)});
      curves.sites.push_back({1, 0.4 * t - 0.199, -0.2 * height * depth(i)});
    }
    // The curves are constraints, and the one between them comes last.
    std::vector<Ends> constraints;
    for (Index i = 2; i + 2 < curves.sites.size(); ++i) constraints.push_back({i, i + 2});
    DynamicConstrainedTriangulation changing(curves.sites, constraints);
    changing.insert_constraint(0, 1);
    constraints.push_back({0, 1});
    const auto result = changing.snapshot().result;
    ASSERT_EQ(check_constrained(curves.sites, constraints, result.triangulation.faces()).reason,
              "");
  }
}

// A constraint between two rows of sites on parallels or on curves that bend towards it, where each face
// has one of its ends; and rows with waves, which bend to and fro.
TEST(constrained_laws, hold_between_rows_that_bend_inwards) {
  Random random(15);
  for (const double noise : {0.0, 1e-16, 1e-9, 1e-4, 0.05}) {
    for (const int n : {17, 40, 300}) {
      SCOPED_TRACE(std::to_string(noise) + " " + std::to_string(n));
      SiteSet parallels;
      parallels.sites = {{1, -0.6, 0}, {1, 0.6, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
      SiteSet waves = parallels;
      for (int i = 1; i < n; ++i) {
        const double t = static_cast<double>(i) / n;
        const double y = 1.1 * t - 0.55;
        const double length = std::sqrt(1 + y * y);
        for (const double side : {1.0, -1.0}) {
          parallels.sites.push_back({1, y, side * (0.01 * length + noise * random.unit())});
          const double wave = 0.02 * (1.2 + std::sin((20 + side) * y));
          waves.sites.push_back({1, y + 1e-4 * side, side * (wave + noise * random.unit())});
        }
      }
      expect_laws(parallels, {{0, 1}}, random);
      expect_laws(waves, {{0, 1}}, random);
    }
  }
}

TEST(constrained_laws, hold_below_dimension_two) {
  const SiteSet ring = {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {2, 2, 0}}};
  const std::vector<Ends> constraints = {{0, 3}, {2, 5}, {4, 2}};
  const auto result = constrained_delaunay(ring.sites, constraints);
  EXPECT_EQ(result.edges, (std::vector<Ends>{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  EXPECT_EQ(result.sources.values, (std::vector<Index>{0, 0, 1, 0, 2, 2}));
  EXPECT_EQ(result.sources.offsets, (std::vector<std::uint64_t>{0, 1, 3, 5, 6}));
  EXPECT_TRUE(result.sides.empty());
  EXPECT_EQ(check_constrained(ring.sites, constraints, {}).reason, "");
  // The ring is closed behind the back of a constraint, too.
  const auto open = constrained_delaunay(std::vector<Point>{{2, -1, 0}, {2, 0, 0}, {2, 1, 0}},
                                         std::vector<Ends>{{2, 0}});
  EXPECT_EQ(open.edges, (std::vector<Ends>{{0, 1}, {1, 2}}));
  EXPECT_EQ(constrained_delaunay(std::vector<Point>{}, {}).triangulation.dimension(), -1);
  EXPECT_EQ(constrained_delaunay(std::vector<Point>{{1, 0, 0}}, {}).triangulation.dimension(), 0);
  const auto two = constrained_delaunay(std::vector<Point>{{1, 0, 0}, {1, 1, 1}},
                                        std::vector<Ends>{{1, 0}, {0, 1}});
  EXPECT_EQ(two.edges, (std::vector<Ends>{{0, 1}}));
  EXPECT_EQ(two.sources.values, (std::vector<Index>{0, 1}));
  const auto three = constrained_delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          std::vector<Ends>{{1, 0}});
  EXPECT_EQ(three.triangulation.num_faces(), 2U);
  EXPECT_EQ(three.edges, (std::vector<Ends>{{0, 1}}));
}

}  // namespace
}  // namespace rondel::test::of_constrained_laws
