// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random scripts of changes: after every step the triangulation is that of a build from scratch.
#include <gtest/gtest.h>

#include <map>
#include <ostream>

#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

struct Case {
  std::string_view generator;
  Model model;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.generator << (c.model == Model::weighted ? ", weighted" : ", projected");
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Generator& g : generators()) {
    cases.push_back({g.name, Model::weighted});
    if (!g.weighted_only) cases.push_back({g.name, Model::projected});
  }
  return cases;
}

// The sites by id, kept beside the triangulation.
using Live = std::map<Index, Point>;

void expect_equal_to_a_build(const DynamicTriangulation& changing, const Live& live,
                             const Options& options) {
  const Snapshot now = changing.snapshot();
  ASSERT_EQ(now.ids.size(), live.size());
  std::size_t i = 0;
  for (const auto& [id, point] : live) {
    ASSERT_EQ(now.ids[i], id);
    ASSERT_EQ(now.triangulation.sites()[i], point);
    ++i;
  }
  const Triangulation fresh = delaunay(now.triangulation.sites(), options);
  const Triangulation& t = now.triangulation;
  ASSERT_EQ(t.dimension(), fresh.dimension());
  ASSERT_TRUE(std::ranges::equal(t.hidden(), fresh.hidden()));
  ASSERT_TRUE(std::ranges::equal(t.duplicates(), fresh.duplicates()));
  ASSERT_TRUE(std::ranges::equal(t.faces(), fresh.faces()));
  ASSERT_TRUE(std::ranges::equal(t.neighbors(), fresh.neighbors()));
  ASSERT_TRUE(std::ranges::equal(t.ghost_faces(), fresh.ghost_faces()));
  ASSERT_TRUE(std::ranges::equal(t.ring(), fresh.ring()));
  ASSERT_EQ(changing.dimension(), fresh.dimension());
  ASSERT_EQ(changing.num_sites(), fresh.num_sites());
  ASSERT_EQ(changing.num_vertices(), fresh.num_vertices());
  ASSERT_EQ(changing.num_faces(), fresh.num_faces());
}

class dynamic_script : public testing::TestWithParam<Case> {};

TEST_P(dynamic_script, equals_a_build_from_scratch_after_every_step) {
  const Generator& kind = generator(GetParam().generator);
  const std::size_t steps = scaled(kind.has_long_integers ? 60 : 250);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const SiteSet pool = kind.make(seed == 1 ? 12 : 40, seed);
    if (pool.sites.empty()) continue;
    Options options;
    options.model = GetParam().model;
    options.sphere = pool.sphere;
    DynamicTriangulation changing(options);
    Live live;
    Random random(seed);
    const auto any_site = [&] { return pool.sites[random.below(pool.sites.size())]; };
    const auto any_live = [&] {
      return std::next(live.begin(), static_cast<std::ptrdiff_t>(random.below(live.size())));
    };
    for (std::size_t step = 0; step < steps; ++step) {
      const bool is_growing = (step / 50) % 2 == 0;
      const std::uint64_t what = random.below(10);
      if (live.empty() || what < (is_growing ? 6U : 2U)) {
        const Point p = any_site();
        const Index id = live.empty() || random.below(2) == 0
                             ? changing.insert(p)
                             : changing.insert(p, any_live()->first);
        ASSERT_FALSE(live.contains(id));
        live[id] = p;
      } else if (what < 8) {
        const auto at = any_live();
        changing.remove(at->first);
        live.erase(at);
      } else {
        const auto at = any_live();
        at->second = any_site();
        changing.move(at->first, at->second);
      }
      expect_equal_to_a_build(changing, live, options);
      if (HasFatalFailure()) {
        FAIL() << "seed " << seed << ", step " << step << ", " << live.size() << " sites";
      }
    }
  }
}

std::string name_of(const testing::TestParamInfo<Case>& test) {
  std::string name(test.param.generator);
  name += test.param.model == Model::weighted ? "_weighted" : "_projected";
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(all, dynamic_script, testing::ValuesIn(all_cases()), name_of);

}  // namespace
}  // namespace rondel::test
