// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The result is a function of the set of sites: input order changes names only.
#include "property/property.h"

namespace rondel::test {
namespace {

// The arrays with every site under the name that `name` gives it.
struct Renamed {
  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
  std::vector<Index> ghosts;
  std::vector<Index> ring;
  std::set<std::pair<Index, Index>> hidden;
  std::set<Index> duplicates;
  int dimension;
  friend bool operator==(const Renamed&, const Renamed&) = default;
};

// Duplicates share a name, that of their representative in the original order, so that it does not
// matter which of them is the vertex.
Renamed renamed(const Triangulation& t, const std::vector<Index>& name) {
  Renamed r;
  r.dimension = t.dimension();
  for (const Triple& f : t.faces()) r.faces.push_back({name[f[0]], name[f[1]], name[f[2]]});
  r.neighbors.assign(t.neighbors().begin(), t.neighbors().end());
  r.ghosts.assign(t.ghost_faces().begin(), t.ghost_faces().end());
  for (const Index v : t.ring()) r.ring.push_back(name[v]);
  for (const Hidden& h : t.hidden()) r.hidden.insert({name[h.site], h.face});
  for (const Duplicate& d : t.duplicates()) r.duplicates.insert(name[d.representative]);
  return r;
}

std::vector<Index> place_names(const Triangulation& t) {
  std::vector<Index> names(t.num_sites());
  std::iota(names.begin(), names.end(), Index{0});
  for (const Duplicate& d : t.duplicates()) names[d.site] = d.representative;
  return names;
}

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
    options.threads = 3;
    const Triangulation three = delaunay(set.sites, options);
    RC_ASSERT(std::ranges::equal(one.faces(), three.faces()));
    RC_ASSERT(std::ranges::equal(one.neighbors(), three.neighbors()));
  });
}

}  // namespace
}  // namespace rondel::test
