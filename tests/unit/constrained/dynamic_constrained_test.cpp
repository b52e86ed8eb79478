// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random scripts of changes: after every step the triangulation is what constrained_delaunay()
// computes for its sites and constraints, byte by byte.
#include "rondel/dynamic_constrained.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "rondel/constrained.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::test::of_dynamic_constrained {
namespace {

using Ends = std::array<Index, 2>;

// The sites and the constraints by id, kept beside the triangulation.
struct Kept {
  std::map<Index, Point> sites;
  std::map<Index, Ends> constraints;
};

Index some_key(const auto& map, Random& random) {
  return std::next(map.begin(), static_cast<std::ptrdiff_t>(random.below(map.size())))->first;
}

// The arguments of constrained_delaunay() for what is kept.
struct Input {
  explicit Input(const Kept& kept) {
    std::map<Index, Index> position;
    for (const auto& [id, point] : kept.sites) {
      position[id] = static_cast<Index>(sites.size());
      site_ids.push_back(id);
      sites.push_back(point);
    }
    for (const auto& [id, ends] : kept.constraints) {
      constraint_ids.push_back(id);
      constraints.push_back({position.at(ends[0]), position.at(ends[1])});
    }
  }
  std::vector<Index> site_ids;
  std::vector<Index> constraint_ids;
  std::vector<Point> sites;
  std::vector<Ends> constraints;
};

void expect_equal(const ConstrainedTriangulation& found, const ConstrainedTriangulation& expected) {
  const Triangulation& t = found.triangulation;
  const Triangulation& u = expected.triangulation;
  ASSERT_EQ(t.dimension(), u.dimension());
  ASSERT_EQ(t.sites(), u.sites());
  ASSERT_TRUE(std::ranges::equal(t.duplicates(), u.duplicates()));
  ASSERT_TRUE(std::ranges::equal(t.ring(), u.ring()));
  ASSERT_TRUE(std::ranges::equal(t.ghost_faces(), u.ghost_faces()));
  ASSERT_TRUE(std::ranges::equal(t.faces(), u.faces()));
  ASSERT_TRUE(std::ranges::equal(t.neighbors(), u.neighbors()));
  ASSERT_EQ(found.edges, expected.edges);
  ASSERT_EQ(found.sources.offsets, expected.sources.offsets);
  ASSERT_EQ(found.sources.values, expected.sources.values);
  ASSERT_EQ(found.sides, expected.sides);
}

// The edges of a constraint, along its chain, are those that come from it.
void expect_chain(const DynamicConstrainedTriangulation& changing, const ConstrainedSnapshot& now,
                  Index constraint) {
  const std::vector<Index> chain = changing.chain(constraint);
  const auto position = static_cast<Index>(
      std::ranges::lower_bound(now.constraint_ids, constraint) - now.constraint_ids.begin());
  std::vector<Ends> expected;
  for (std::size_t e = 0; e < now.result.edges.size(); ++e) {
    if (!std::ranges::binary_search(now.result.sources[e], position)) continue;
    const auto [a, b] = now.result.edges[e];
    const auto [low, high] = std::minmax(now.site_ids[a], now.site_ids[b]);
    expected.push_back({low, high});
  }
  std::vector<Ends> found;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const auto [low, high] = std::minmax(chain[i - 1], chain[i]);
    found.push_back({low, high});
  }
  std::ranges::sort(found);
  std::ranges::sort(expected);
  ASSERT_EQ(found, expected);
  const auto [first, last] = changing.constraint(constraint);
  ASSERT_EQ(chain.front(), changing.representative(first));
  ASSERT_EQ(chain.back(), changing.representative(last));
}

// The neighbors of a site are those in the faces that are not ghosts.
void expect_neighbors(const DynamicConstrainedTriangulation& changing,
                      const ConstrainedSnapshot& now, Index site) {
  const Triangulation& t = now.result.triangulation;
  if (t.dimension() < 2) return;
  const Index vertex = changing.representative(site);
  std::vector<Index> expected;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (t.is_ghost(f)) continue;
    for (unsigned i = 0; i < 3; ++i) {
      if (now.site_ids[t.faces()[f][i]] != vertex) continue;
      expected.push_back(now.site_ids[t.faces()[f][(i + 1) % 3]]);
      expected.push_back(now.site_ids[t.faces()[f][(i + 2) % 3]]);
    }
  }
  std::ranges::sort(expected);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  std::vector<Index> found = changing.neighbors(site);
  std::ranges::sort(found);
  ASSERT_EQ(found, expected);
}

void expect_equal_to_a_build(const DynamicConstrainedTriangulation& changing, const Kept& kept,
                             const Sphere& sphere) {
  const Input input(kept);
  const ConstrainedSnapshot now = changing.snapshot();
  ASSERT_EQ(now.site_ids, input.site_ids);
  ASSERT_EQ(now.constraint_ids, input.constraint_ids);
  ASSERT_EQ(changing.site_ids(), input.site_ids);
  ASSERT_EQ(changing.constraint_ids(), input.constraint_ids);
  const auto built = constrained_delaunay(input.sites, input.constraints, {.sphere = sphere});
  ASSERT_NO_FATAL_FAILURE(expect_equal(now.result, built));
  ASSERT_EQ(changing.num_sites(), kept.sites.size());
  ASSERT_EQ(changing.num_constraints(), kept.constraints.size());
  ASSERT_EQ(changing.num_vertices(), built.triangulation.num_vertices());
  ASSERT_EQ(changing.num_faces(), built.triangulation.num_faces());
  ASSERT_EQ(changing.dimension(), built.triangulation.dimension());
  if (!kept.constraints.empty()) {
    ASSERT_NO_FATAL_FAILURE(expect_chain(changing, now, kept.constraints.rbegin()->first));
  }
  if (!kept.sites.empty()) {
    ASSERT_NO_FATAL_FAILURE(expect_neighbors(changing, now, kept.sites.rbegin()->first));
  }
}

// True if the build refuses a change, too.
bool is_refused(const Kept& kept, const Sphere& sphere) {
  const Input input(kept);
  try {
    static_cast<void>(constrained_delaunay(input.sites, input.constraints, {.sphere = sphere}));
  } catch (const InvalidInput&) {
    return true;
  }
  return false;
}

class Script {
 public:
  Script(const SiteSet& pool, std::uint64_t seed)
      : pool_(pool), random_(seed), changing_(pool.sphere) {}

  // The share of insertions is that of `growth` in 10, and constraints are half of all changes.
  void run(std::size_t steps, unsigned growth) {
    for (std::size_t step = 0; step < steps; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      const bool is_insertion = random_.below(10) < growth;
      const bool is_constraint = random_.coin();
      ASSERT_NO_FATAL_FAILURE(change(is_insertion, is_constraint));
      ASSERT_NO_FATAL_FAILURE(expect_equal_to_a_build(changing_, kept_, pool_.sphere));
    }
  }

  [[nodiscard]] std::size_t num_refused() const { return num_refused_; }

 private:
  void change(bool is_insertion, bool is_constraint) {
    if (is_insertion && is_constraint && kept_.sites.size() > 1) {
      insert_constraint();
    } else if (is_insertion) {
      const Point& p = pool_.sites[random_.below(pool_.sites.size())];
      const Index id = kept_.sites.empty() || random_.coin()
                           ? changing_.insert(p)
                           : changing_.insert(p, some_key(kept_.sites, random_));
      ASSERT_TRUE(kept_.sites.emplace(id, p).second);
    } else if (is_constraint && !kept_.constraints.empty()) {
      const Index id = some_key(kept_.constraints, random_);
      changing_.remove_constraint(id);
      kept_.constraints.erase(id);
    } else if (!kept_.sites.empty()) {
      remove_site();
    }
  }

  void insert_constraint() {
    const Ends ends = {some_key(kept_.sites, random_), some_key(kept_.sites, random_)};
    try {
      const Index id = changing_.insert_constraint(ends[0], ends[1]);
      ASSERT_TRUE(kept_.constraints.emplace(id, ends).second);
    } catch (const InvalidInput&) {
      ++num_refused_;
      Kept more = kept_;
      more.constraints[no_index - 1] = ends;
      ASSERT_TRUE(is_refused(more, pool_.sphere));
    }
  }

  void remove_site() {
    const Index id = some_key(kept_.sites, random_);
    const bool is_end = std::ranges::any_of(kept_.constraints, [id](const auto& constraint) {
      return constraint.second[0] == id || constraint.second[1] == id;
    });
    Kept less = kept_;
    less.sites.erase(id);
    try {
      changing_.remove(id);
      ASSERT_FALSE(is_end);
      kept_ = less;
    } catch (const CrossingConstraints& error) {
      ++num_refused_;
      ASSERT_FALSE(is_end);
      ASSERT_TRUE(is_refused(less, pool_.sphere));
      for (const Index constraint : error.constraints()) {
        ASSERT_TRUE(kept_.constraints.contains(constraint));
      }
    } catch (const InvalidInput&) {
      ASSERT_TRUE(is_end);
    }
  }

  SiteSet pool_;
  Random random_;
  DynamicConstrainedTriangulation changing_;
  Kept kept_;
  std::size_t num_refused_ = 0;
};

TEST(dynamic_constrained, equals_a_build_after_every_step_for_all_kinds_of_sites) {
  for (const Generator& kind : generators()) {
    if (kind.weighted_only) continue;
    for (const std::size_t n : {6U, 14U, 40U}) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(n));
      const SiteSet pool = kind.make(n, n);
      if (pool.sites.empty()) continue;
      Script script(pool, n);
      const std::size_t steps = scaled(kind.has_long_integers ? 25 : 120);
      ASSERT_NO_FATAL_FAILURE(script.run(steps, 6));
      ASSERT_NO_FATAL_FAILURE(script.run(steps / 2, 3));
    }
  }
}

// Directions of small integers: many sites on each arc, many circles through more than three, and
// sites of other lengths on the same rays.
SiteSet grid(int size, bool is_half, Random& random) {
  SiteSet set;
  for (int x = -size; x <= size; ++x) {
    for (int y = -size; y <= size; ++y) {
      for (int z = is_half ? 0 : -size; z <= size; ++z) {
        if (x != 0 || y != 0 || z != 0) {
          set.sites.push_back({double(x), double(y), double(z)});
        }
      }
    }
  }
  random.shuffle(set.sites);
  return set;
}

TEST(dynamic_constrained, equals_a_build_after_every_step_on_grids) {
  std::size_t num_refused = 0;
  for (std::uint64_t seed = 1; seed <= scaled(30); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    SiteSet pool = grid(1 + static_cast<int>(seed % 2), seed % 3 == 0, random);
    if (seed % 4 == 0) pool.sites.resize(std::min<std::size_t>(pool.sites.size(), 9));
    Script script(pool, seed);
    ASSERT_NO_FATAL_FAILURE(script.run(60, 8));
    ASSERT_NO_FATAL_FAILURE(script.run(60, 5));
    ASSERT_NO_FATAL_FAILURE(script.run(60, 2));
    num_refused += script.num_refused();
  }
  EXPECT_GT(num_refused, scaled(100));
}

// A square around the north pole, its middle and the south pole.
const std::vector<Point> square = {{1, 0, 1},  {0, 1, 1}, {-1, 0, 1},
                                   {0, -1, 1}, {0, 0, 1}, {0, 0, -1}};

TEST(dynamic_constrained, names_what_it_refuses_and_changes_nothing) {
  DynamicConstrainedTriangulation changing(square, std::vector<Ends>{{0, 2}, {1, 4}});
  const auto expect_refusal = [&](const std::string& message, const auto& call) {
    EXPECT_EQ(thrown_message<InvalidInput>(call), message);
    ASSERT_NO_FATAL_FAILURE(
        expect_equal(changing.snapshot().result,
                     constrained_delaunay(square, std::vector<Ends>{{0, 2}, {1, 4}})));
  };
  expect_refusal("site 9 does not exist", [&] { changing.remove(9); });
  expect_refusal("site 4 is an end of constraint 1", [&] { changing.remove(4); });
  expect_refusal("site 9 does not exist", [&] { changing.insert({1, 1, 1}, 9); });
  expect_refusal("constraint 2 does not exist", [&] { changing.remove_constraint(2); });
  expect_refusal("constraint 2 does not exist", [&] { static_cast<void>(changing.chain(2)); });
  expect_refusal("the constraint begins and ends at site 3",
                 [&] { changing.insert_constraint(3, 3); });
  expect_refusal("the constraint joins sites 4 and 5, which are opposite to each other",
                 [&] { changing.insert_constraint(4, 5); });
  EXPECT_EQ(thrown_index([&] { changing.insert_constraint(9, 0); }), 0U);
  EXPECT_EQ(thrown_index([&] { changing.insert_constraint(0, 9); }), 1U);
}

TEST(dynamic_constrained, names_constraints_that_cross) {
  std::vector<Point> sites = square;
  sites[4] = {0.2, 0.1, 1};
  DynamicConstrainedTriangulation changing(sites, std::vector<Ends>{{0, 2}});
  try {
    changing.insert_constraint(3, 1);
    FAIL() << "nothing was thrown";
  } catch (const CrossingConstraints& error) {
    EXPECT_EQ(error.constraints(), (Ends{0, 1}));
    EXPECT_NEAR(error.place().lat_deg, 90, 1e-12);
  }
  EXPECT_EQ(changing.num_constraints(), 1U);
  EXPECT_EQ(changing.insert_constraint(0, 4), 1U);
}

TEST(dynamic_constrained, a_site_divides_constraints_and_lets_them_unite) {
  std::vector<Point> sites = square;
  sites.erase(sites.begin() + 4);
  DynamicConstrainedTriangulation changing(sites, std::vector<Ends>{{2, 0}});
  const Index middle = changing.insert({0, 0, 3});
  EXPECT_EQ(changing.chain(0), (std::vector<Index>{2, middle, 0}));
  // A second one passes the site along another arc.
  const Index other = changing.insert_constraint(1, 3);
  EXPECT_EQ(changing.chain(other), (std::vector<Index>{1, middle, 3}));
  EXPECT_THROW(changing.remove(middle), CrossingConstraints);
  changing.remove_constraint(other);
  changing.remove(middle);
  EXPECT_EQ(changing.chain(0), (std::vector<Index>{2, 0}));
  EXPECT_EQ(changing.neighbors(0).size(), 4U);
}

TEST(dynamic_constrained, the_order_of_changes_does_not_matter) {
  for (std::uint64_t seed = 1; seed <= scaled(10); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    SiteSet pool = grid(1, seed % 2 == 0, random);
    const DynamicConstrainedTriangulation first(pool.sites, {});
    // Constraints that do not cross, from an object that tells which ones do.
    DynamicConstrainedTriangulation all(pool.sites, {});
    std::vector<Ends> constraints;
    for (int k = 0; k < 40; ++k) {
      const Ends ends = {static_cast<Index>(random.below(pool.sites.size())),
                         static_cast<Index>(random.below(pool.sites.size()))};
      try {
        all.insert_constraint(ends[0], ends[1]);
        constraints.push_back(ends);
      } catch (const InvalidInput&) {
        continue;
      }
    }
    // The constraints in another order, between sites that come in between, and others that go.
    DynamicConstrainedTriangulation changing(pool.sites, {});
    std::vector<Index> order(constraints.size());
    for (Index i = 0; i < order.size(); ++i) order[i] = i;
    random.shuffle(order);
    std::vector<Index> more;
    for (const Index i : order) {
      more.push_back(changing.insert(random_direction(random)));
      changing.insert_constraint(constraints[i][0], constraints[i][1]);
    }
    random.shuffle(more);
    for (const Index id : more) changing.remove(id);
    EXPECT_EQ(changing.snapshot().result.edges, all.snapshot().result.edges);
    EXPECT_TRUE(std::ranges::equal(changing.snapshot().result.triangulation.faces(),
                                   all.snapshot().result.triangulation.faces()));
    for (const Index id : changing.constraint_ids()) changing.remove_constraint(id);
    EXPECT_TRUE(std::ranges::equal(changing.snapshot().result.triangulation.faces(),
                                   first.snapshot().result.triangulation.faces()));
  }
}

// Sites on both sides of a long arc, which bend towards it, away from it, or are random; and
// constraints that end near to it, along which the corridor of its removal touches itself.
TEST(dynamic_constrained, a_long_constraint_goes_and_comes_back) {
  Random random(17);
  for (const int form : {0, 1, 2}) {
    SCOPED_TRACE("form " + std::to_string(form));
    std::vector<Point> sites = {{1, -1, 0}, {1, 1, 0}};
    for (int i = 0; i < 300; ++i) {
      const double y = 1.9 * random.unit() - 0.95;
      const double height = form == 0   ? 1e-3 + y * y
                            : form == 1 ? 1.2 - y * y
                                        : 1e-3 + 0.1 * random.unit();
      sites.push_back({1, y, i % 2 == 0 ? height : -height});
    }
    DynamicConstrainedTriangulation changing(sites, {});
    std::vector<Ends> others;
    for (int i = 0; i < 100; ++i) {
      const auto first = static_cast<Index>(2 + random.below(300));
      const auto second = static_cast<Index>(2 + random.below(300));
      if (sites[first].z * sites[second].z < 0) continue;
      try {
        changing.insert_constraint(first, second);
        others.push_back({first, second});
      } catch (const InvalidInput&) {
        continue;
      }
    }
    EXPECT_GT(others.size(), 10U);
    const auto free = constrained_delaunay(sites, others);
    for (int times = 0; times < 2; ++times) {
      const Index arc = changing.insert_constraint(0, 1);
      std::size_t num_crossed = 0;
      for (const Triple& face : free.triangulation.faces()) {
        const auto is_left = [&](Index v) { return sites[v].z > 0; };
        num_crossed += is_left(face[0]) != is_left(face[1]) ? 1 : 0;
      }
      EXPECT_GT(num_crossed, 30U);
      changing.remove_constraint(arc);
      ASSERT_NO_FATAL_FAILURE(expect_equal(changing.snapshot().result, free));
    }
  }
}

TEST(dynamic_constrained, equals_a_build_with_thousands_of_sites) {
  const SiteSet set = generator("uniform").make(4'000, 3);
  Random random(3);
  Kept kept;
  std::vector<Ends> none;
  DynamicConstrainedTriangulation changing(set.sites, none);
  for (Index i = 0; i < set.sites.size(); ++i) kept.sites[i] = set.sites[i];
  for (int k = 0; k < 300; ++k) {
    const Ends ends = {some_key(kept.sites, random), some_key(kept.sites, random)};
    try {
      kept.constraints[changing.insert_constraint(ends[0], ends[1])] = ends;
    } catch (const InvalidInput&) {
      continue;
    }
  }
  EXPECT_GT(kept.constraints.size(), 10U);
  for (int k = 0; k < 2'500; ++k) {
    const Index id = some_key(kept.sites, random);
    try {
      changing.remove(id);
      kept.sites.erase(id);
    } catch (const InvalidInput&) {
      const Point p = random_direction(random);
      kept.sites[changing.insert(p)] = p;
    }
  }
  ASSERT_NO_FATAL_FAILURE(expect_equal_to_a_build(changing, kept, {}));
  while (kept.constraints.size() > 5) {
    const Index id = some_key(kept.constraints, random);
    changing.remove_constraint(id);
    kept.constraints.erase(id);
  }
  ASSERT_NO_FATAL_FAILURE(expect_equal_to_a_build(changing, kept, {}));
  const Input input(kept);
  EXPECT_EQ(check_constrained(input.sites, input.constraints,
                              changing.snapshot().result.triangulation.faces())
                .reason,
            "");
}

}  // namespace
}  // namespace rondel::test::of_dynamic_constrained
