// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The result is a function of the set of sites: input order changes names only.
#include "property/property.h"
#include "property/renamed.h"

namespace rondel::test {
namespace {

TEST(input_order, changes_nothing) {
  expect_for_all(300, [] {
    const Input input = *inputs(300);
    const SiteSet set = input.make();
    const Triangulation first = triangulate(set, input.model);
    const auto names = place_names(first);

    const auto order = random_order(set.sites.size(), input.seed + 1);
    SiteSet shuffled = set;
    std::vector<Index> shuffled_names(set.sites.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      shuffled.sites[i] = set.sites[order[i]];
      shuffled_names[i] = names[order[i]];
    }
    const Triangulation second = triangulate(shuffled, input.model);
    RC_ASSERT(renamed(first, names) == renamed(second, shuffled_names));
  });
}

TEST(input_order, representatives_have_the_lowest_index) {
  expect_for_all(500, [] {
    const Input input = *inputs(100);
    const SiteSet set = input.make();
    const Triangulation t = triangulate(set, input.model);
    const Places places = distinct_places(set.sites, input.model, set.sphere);
    RC_ASSERT(std::ranges::equal(t.duplicates(), places.duplicates));
  });
}

// The same sites again, in any order and as often as one likes.
TEST(input_order, repeated_sites_add_duplicates_only) {
  expect_for_all(300, [] {
    const Input input = *inputs(120);
    const SiteSet set = input.make();
    const Triangulation first = triangulate(set, input.model);
    SiteSet more = set;
    for (const std::size_t i : random_order(set.sites.size(), input.seed)) {
      if (i % 3 == 0) more.sites.push_back(set.sites[i]);
    }
    const Triangulation second = triangulate(more, input.model);
    RC_ASSERT(std::ranges::equal(first.faces(), second.faces()));
    RC_ASSERT(std::ranges::equal(first.ring(), second.ring()));
    RC_ASSERT(std::ranges::equal(first.hidden(), second.hidden()));
    RC_ASSERT(second.duplicates().size() ==
              first.duplicates().size() + more.sites.size() - set.sites.size());
  });
}

// With two threads or any number, the bytes are the same.
TEST(input_order, threads_change_nothing) {
  expect_for_all(60, [] {
    const Input input = *inputs(2000);
    const SiteSet set = input.make();
    const Triangulation one = triangulate(set, input.model);
    Options options;
    options.model = input.model;
    options.sphere = set.sphere;
    const Triangulation three = delaunay(set.sites, options, {.threads = 3});
    RC_ASSERT(std::ranges::equal(one.faces(), three.faces()));
    RC_ASSERT(std::ranges::equal(one.neighbors(), three.neighbors()));
  });
}

}  // namespace
}  // namespace rondel::test
