// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of triangulations and hulls on shrinking lists of sites with very many ties.
#include "property/tied_sites.h"

#include <map>
#include <optional>

#include "bulk/blocks.h"
#include "order/spatial_order.h"
#include "property/renamed.h"
#include "rondel/dynamic.h"
#include "rondel/hull.h"

namespace rondel::test {
namespace {

// An exact isometry: the axes in another order, some reversed.
struct Isometry {
  std::array<std::size_t, 3> axes;
  std::array<bool, 3> reverses;

  [[nodiscard]] Point operator()(const Point& p) const {
    const std::array<double, 3> from = {p.x, p.y, p.z};
    const auto at = [&](std::size_t i) { return reverses[i] ? -from[axes[i]] : from[axes[i]]; };
    return {at(0), at(1), at(2)};
  }
  [[nodiscard]] bool is_reflection() const {
    const bool is_cyclic = (axes[0] + 1) % 3 == axes[1];
    const bool is_even = std::ranges::count(reverses, true) % 2 == 0;
    return is_cyclic != is_even;
  }
};

Isometry any_isometry() {
  constexpr std::array<std::array<std::size_t, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  const auto [order, a, b, c] =
      *rc::gen::tuple(rc::gen::inRange<std::size_t>(0, 6), rc::gen::arbitrary<bool>(),
                      rc::gen::arbitrary<bool>(), rc::gen::arbitrary<bool>())
           .as("axes");
  return {orders[order], {a, b, c}};
}

std::vector<Point> moved(std::vector<Point> points, const Isometry& isometry) {
  std::ranges::transform(points, points.begin(), isometry);
  return points;
}

std::vector<Index> sorted_ring(const Triangulation& t) {
  std::vector<Index> ring(t.ring().begin(), t.ring().end());
  std::ranges::sort(ring);
  return ring;
}

TEST(tied_sites, signed_permutations_of_the_axes_keep_the_facets) {
  expect_for_all(1500, [] {
    const auto sites = sites_of(*recipes().as("sites"), Model::projected);
    const Isometry isometry = any_isometry();
    const auto there = moved(sites, isometry);
    const Options options = options_of(Model::projected);
    const Triangulation before = delaunay(sites, options);
    const Triangulation after = delaunay(there, options);
    RC_ASSERT(after.dimension() == before.dimension());
    RC_ASSERT(sorted_ring(after) == sorted_ring(before));
    RC_ASSERT(std::ranges::equal(after.duplicates(), before.duplicates()));
    RC_ASSERT(facets(after, isometry.is_reflection()) == facets(before));
  });
}

TEST(tied_sites, signed_permutations_of_the_axes_keep_the_facets_of_hulls) {
  expect_for_all(1500, [] {
    const auto points = sites_of(*recipes().as("points"), Model::weighted);
    const Isometry isometry = any_isometry();
    const auto there = moved(points, isometry);
    const Triangulation before = convex_hull(points);
    const Triangulation after = convex_hull(there);
    RC_ASSERT(after.dimension() == before.dimension());
    RC_ASSERT(sorted_ring(after) == sorted_ring(before));
    RC_ASSERT(facets(after, isometry.is_reflection()) == facets(before));
  });
}

// But for ties of projected sites, whose keys are others.
TEST(tied_sites, powers_of_two_change_nothing) {
  expect_for_all(1000, [] {
    const TiedSites before = any_tied_sites();
    TiedSites after = before;
    const double factor = std::ldexp(1, *rc::gen::inRange(-900, 900).as("exponent"));
    for (Point& p : after.sites) {
      const Point original = p;
      p = factor * p;
      const bool is_exact = (1 / factor) * p == original;  // not where subnormals lose bits
      RC_PRE(is_exact);
    }
    const Triangulation first = before.triangulate();
    const Triangulation second = after.triangulate();
    RC_ASSERT(std::ranges::equal(second.ring(), first.ring()));
    RC_ASSERT(facets(second) == facets(first));
    if (before.options.model == Model::projected && has_ties(first)) return;
    RC_ASSERT(have_same_bits(second, first));
  });
}

TEST(tied_sites, added_duplicates_are_duplicates) {
  expect_for_all(1000, [] {
    const TiedSites before = any_tied_sites();
    TiedSites after = before;
    const auto positions = some_positions(before.sites.size());
    for (const std::size_t i : positions) after.sites.push_back(before.sites[i]);
    const Triangulation once = before.triangulate();
    const Triangulation again = after.triangulate();
    RC_ASSERT(have_same_bits(again, once));
    RC_ASSERT(again.duplicates().size() == once.duplicates().size() + positions.size());
  });
}

TEST(tied_sites, input_order_changes_names_only) {
  expect_for_all(1000, [] {
    const TiedSites before = any_tied_sites();
    const Triangulation first = before.triangulate();
    const auto names = place_names(first);
    const auto order = random_order(before.sites.size(), *rc::gen::arbitrary<std::uint64_t>());
    TiedSites after = before;
    std::vector<Index> new_names(names.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      after.sites[i] = before.sites[order[i]];
      new_names[i] = names[order[i]];
    }
    RC_ASSERT(renamed(after.triangulate(), new_names) == renamed(first, names));
  });
}

TEST(tied_sites, blocks_of_any_size_change_nothing) {
  expect_for_all(600, [] {
    TiedSites input = any_tied_sites();
    // The same recipes on the far side and in between, so that there is enough for several blocks.
    const std::vector<Point> some = input.sites;
    for (const Point& p : some) {
      input.sites.push_back({-p.y, p.z, -p.x});
      input.sites.push_back({2 * p.x + p.y, 2 * p.y + p.z, 2 * p.z - p.x});
    }
    if (input.options.model == Model::projected) std::erase(input.sites, Point{});
    const auto order =
        order::spatial_order(input.sites, input.options.model, input.options.sphere.center, 1);
    RC_PRE(!order.order.empty());
    const auto expected = kernel::triangulate(input.sites, order.order, order.renamed,
                                              {input.options, {.threads = 1}})
                              .arrays;
    const auto size = *rc::gen::inRange<std::size_t>(33, 150).as("sites of a block");
    const system::Job job = {input.options, {.threads = 1}};
    const auto built = bulk::triangulate_by_blocks(bulk::make_input(input.sites, order.order, job),
                                                   order.renamed, size);
    const bool is_built = built.has_value() || expected.dimension < 2;
    RC_ASSERT(is_built);
    if (!built) return;
    RC_ASSERT(built->arrays.faces == expected.faces);
    RC_ASSERT(built->arrays.neighbors == expected.neighbors);
    RC_ASSERT(built->arrays.ghost_faces == expected.ghost_faces);
    RC_ASSERT(built->arrays.hidden == expected.hidden);
  });
}

// What is left is the triangulation of what is left, and what comes back finds its old faces.
TEST(tied_sites, removing_and_reinserting_changes_nothing) {
  expect_for_all(600, [] {
    const TiedSites input = any_tied_sites();
    DynamicTriangulation changing(input.sites, input.options);
    std::set<std::size_t> removed;
    for (const std::size_t i : some_positions(input.sites.size())) {
      if (removed.insert(i).second) changing.remove(static_cast<Index>(i));
    }
    std::vector<Point> rest;
    for (std::size_t i = 0; i < input.sites.size(); ++i) {
      if (removed.count(i) == 0) rest.push_back(input.sites[i]);
    }
    const Snapshot without = changing.snapshot();
    RC_ASSERT(without.triangulation.sites() == rest);
    RC_ASSERT(have_same_bits(without.triangulation, delaunay(rest, input.options)));
    for (const std::size_t i : removed) changing.insert(input.sites[i]);
    const Snapshot with = changing.snapshot();
    const Triangulation again = delaunay(with.triangulation.sites(), input.options);
    RC_ASSERT(with.triangulation.num_sites() == input.sites.size());
    RC_ASSERT(have_same_bits(with.triangulation, again));
    RC_ASSERT(again.num_faces() == input.triangulate().num_faces());
  });
}

// By the error of the sum (Knuth's TwoSum), and no subnormal loses a bit.
bool has_exact_middle(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return (a - (sum - part)) + (b - part) == 0 && 2 * (sum / 2) == sum;
}

// Nothing where rounding would move it.
std::optional<Point> middle(const Point& a, const Point& b) {
  const bool is_exact =
      has_exact_middle(a.x, b.x) && has_exact_middle(a.y, b.y) && has_exact_middle(a.z, b.z);
  return is_exact ? std::optional(0.5 * (a + b)) : std::nullopt;
}

TEST(tied_sites, points_inside_a_hull_refine_nothing) {
  expect_for_all(1000, [] {
    const auto points = sites_of(*recipes().as("points"), Model::weighted);
    const Triangulation before = convex_hull(points);
    std::vector<Point> more = points;
    const auto positions = some_positions(points.size());
    for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
      const auto between = middle(points[positions[i]], points[positions[i + 1]]);
      if (between) more.push_back(*between);
    }
    const Triangulation after = convex_hull(more);
    RC_ASSERT(after.dimension() == before.dimension());
    RC_ASSERT(after.num_vertices() == before.num_vertices());
    RC_ASSERT(face_set(after) == face_set(before));
    RC_ASSERT(sorted_ring(after) == sorted_ring(before));
  });
}

// Point by point, as an editor refines it, or all at once.
TEST(tied_sites, a_hull_may_be_refined_point_by_point) {
  expect_for_all(400, [] {
    const auto points = sites_of(*recipes().as("points"), Model::weighted);
    DynamicTriangulation changing(options_of(Model::weighted));
    for (const Point& p : points) changing.insert(p);
    RC_ASSERT(have_same_bits(changing.snapshot().triangulation,
                             delaunay(points, options_of(Model::weighted))));
    std::vector<Point> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (changing.is_vertex(static_cast<Index>(i))) corners.push_back(points[i]);
    }
    RC_ASSERT(convex_hull(corners).num_vertices() == convex_hull(points).num_vertices());
  });
}

}  // namespace
}  // namespace rondel::test
