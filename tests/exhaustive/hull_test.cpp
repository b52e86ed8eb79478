// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations against brute force: for every named generator, both models and many seeds the
// library must find the one perturbed hull.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "rondel/delaunay.h"
#include "support/generators.h"
#include "support/hull_oracle.h"

namespace rondel::test {
namespace {

std::string text(const SiteSet& set) {
  std::string out;
  char buffer[128];
  for (const Point& p : set.sites) {
    std::snprintf(buffer, sizeof buffer, "{%a, %a, %a},\n", p.x, p.y, p.z);
    out += buffer;
  }
  const Point& c = set.sphere.center;
  std::snprintf(buffer, sizeof buffer, "center {%a, %a, %a}", c.x, c.y, c.z);
  return out + buffer;
}

void expect_brute_force(const SiteSet& set, Model model) {
  const Hull expected = brute_force_hull(set.sites, model, set.sphere);
  Options options;
  options.model = model;
  options.sphere = set.sphere;
  const Triangulation actual = delaunay(set.sites, options);
  EXPECT_EQ(difference(actual, set.sites, expected), "")
      << (model == Model::projected ? "projected\n" : "weighted\n") << text(set);
}

class hulls : public testing::TestWithParam<Generator> {};

TEST_P(hulls, are_those_of_brute_force) {
  const Generator& kind = GetParam();
  for (std::uint64_t seed = 0; seed < scaled(12) && !HasFailure(); ++seed) {
    SiteSet set = kind.make(3 + seed % 10, seed);
    if (set.sites.size() > 14) set.sites.resize(14);
    expect_brute_force(set, Model::weighted);
    if (!kind.weighted_only) expect_brute_force(set, Model::projected);
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, hulls, testing::ValuesIn(generators().begin(), generators().end()),
                         [](const auto& kind) { return std::string(kind.param.name); });

// Sites of two kinds in one input.
TEST(hull, of_mixed_kinds_is_that_of_brute_force) {
  Random random(61);
  for (std::size_t i = 0; i < scaled(600) && !HasFailure(); ++i) {
    SiteSet set = generators()[random.below(generators().size())].make(6, random.next() % 1000);
    set.sites.resize(std::min<std::size_t>(set.sites.size(), 6));
    const Generator& other = generators()[random.below(generators().size())];
    SiteSet more = other.make(6, random.next() % 1000);
    more.sites.resize(std::min<std::size_t>(more.sites.size(), 6));
    set.sites.insert(set.sites.end(), more.sites.begin(), more.sites.end());
    std::erase(set.sites, set.sphere.center);
    expect_brute_force(set, random.coin() ? Model::weighted : Model::projected);
  }
}

}  // namespace
}  // namespace rondel::test
