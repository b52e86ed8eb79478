// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random scripts of changes: after every step the triangulation is that of a build from scratch.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <random>

#include "dynamic/renumbering.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "support/generators.h"
#include "topology/mesh.h"

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

using dynamic::Renumbering;

std::vector<Index> natural_numbers(Index n) {
  std::vector<Index> numbers(n);
  for (Index i = 0; i < n; ++i) numbers[i] = i;
  return numbers;
}

// The corner that the edge of a halfedge is opposite to, and the end points of the edge.
std::array<Index, 3> around_halfedge(const topology::Mesh& mesh, topology::Halfedge h) {
  const auto& v = mesh[topology::face_of(h)].vertex;
  const unsigned i = topology::edge_of(h);
  return {v[i], v[topology::next_corner[i]], v[topology::previous_corner[i]]};
}

TEST(dynamic_renumbering, keeps_the_mesh_and_sorts_its_faces) {
  const std::vector<Point> sites = generator("uniform").make(300, 1).sites;
  const Triangulation t = delaunay(sites);
  // Vertices with gaps between their numbers, and a slot that is free.
  std::vector<Index> names = natural_numbers(300);
  for (Index& name : names) name *= 3;
  topology::Mesh mesh = topology::link_faces(t.faces(), t.neighbors(), names);
  mesh.remove_face(mesh.add_face());
  std::vector<Index> order = names;
  std::ranges::shuffle(order, std::mt19937(5));
  const Renumbering places(order, 900);
  const auto [renumbered, new_face] = dynamic::renumber(mesh, places);

  ASSERT_EQ(renumbered.num_slots(), mesh.num_faces());
  EXPECT_EQ(new_face.back(), no_index);
  Index before = 0;
  for (Index f = 0; f < renumbered.num_slots(); ++f) {
    const Index least = std::ranges::min(renumbered[f].vertex);
    EXPECT_LE(before, least);
    before = least;
  }
  for (Index f = 0; f + 1 < mesh.num_slots(); ++f) {
    for (unsigned i = 0; i < 3; ++i) {
      const topology::Halfedge h = mesh[f].opposite[i];
      const topology::Halfedge g = renumbered[new_face[f]].opposite[i];
      EXPECT_EQ(topology::face_of(g), new_face[topology::face_of(h)]);
      std::array<Index, 3> expected = around_halfedge(mesh, h);
      for (Index& v : expected) v = places.new_place[v];
      EXPECT_EQ(around_halfedge(renumbered, g), expected);
    }
  }
}

TEST(dynamic_renumbering, costs_a_constant_for_each_change) {
  dynamic::RenumberingSchedule schedule;
  std::mt19937 random(7);
  std::size_t size = 0;
  std::size_t work = 0;
  std::size_t times = 0;
  constexpr std::size_t changes = 1'000'000;
  for (std::size_t i = 0; i < changes; ++i) {
    // It drifts up and down, and trembles all the time.
    const bool is_growing = (i / 100'000) % 2 == 0;
    if (random() % 10 < (is_growing ? 9U : 1U)) {
      ++size;
    } else if (size > 0) {
      --size;
    }
    if (!schedule.is_due(size)) continue;
    schedule.done(size);
    work += size;
    ++times;
  }
  EXPECT_GT(times, 50U);
  EXPECT_LT(work, 4 * changes);
}

// Enough sites to be renumbered many times on the way up and down, with duplicates and, weighted,
// hidden sites among them.
void change_many(Model model) {
  Options options;
  options.model = model;
  DynamicTriangulation changing(options);
  std::vector<Point> sites = generator("uniform").make(400, 3).sites;
  for (std::size_t i = 0; i < 60; ++i) {
    const Point p = sites[5 * i];
    sites.push_back(p);
    sites.push_back({p.x / 2, p.y / 2, p.z / 2});
  }
  std::mt19937 random(11);
  std::ranges::shuffle(sites, random);
  const auto expect_equal_to_a_build = [&] {
    const Snapshot now = changing.snapshot();
    const Triangulation fresh = delaunay(now.triangulation.sites(), options);
    ASSERT_TRUE(std::ranges::equal(now.triangulation.faces(), fresh.faces()));
    ASSERT_TRUE(std::ranges::equal(now.triangulation.hidden(), fresh.hidden()));
    ASSERT_TRUE(std::ranges::equal(now.triangulation.duplicates(), fresh.duplicates()));
    for (std::size_t i = 0; i < now.ids.size(); ++i) {
      ASSERT_EQ(changing.site(now.ids[i]), sites[now.ids[i]]);
    }
  };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    ASSERT_EQ(changing.insert(sites[i]), i);
    if (i % 7 == 0) expect_equal_to_a_build();
  }
  std::vector<Index> ids = changing.ids();
  std::ranges::shuffle(ids, random);
  // Ranges of growing size.
  for (std::size_t size = 1; !ids.empty(); size += size / 8 + 1) {
    const std::size_t first = ids.size() - std::min(size, ids.size());
    changing.remove(std::span(ids).subspan(first));
    ids.resize(first);
    ASSERT_EQ(changing.num_sites(), ids.size());
    expect_equal_to_a_build();
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << ids.size() << " sites left";
  }
}

TEST(dynamic_renumbering, changes_nothing_projected) { change_many(Model::projected); }
TEST(dynamic_renumbering, changes_nothing_weighted) { change_many(Model::weighted); }

}  // namespace
}  // namespace rondel::test
