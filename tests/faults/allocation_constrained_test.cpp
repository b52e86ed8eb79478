// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Changes of a DynamicConstrainedTriangulation without enough memory: std::bad_alloc, no leak, and
// the sites, the constraints and their triangulation are what they were before the change; then the
// change succeeds.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "faults/failing_allocation.h"
#include "rondel/constrained.h"
#include "rondel/dynamic_constrained.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using Constraints = std::vector<std::array<Index, 2>>;

struct ConstrainedChange {
  std::string name;
  void (*make)(DynamicConstrainedTriangulation& changing);
};

// Sites 0 to 3 are on one great circle, 4 and 5 beside it; site 6 is a duplicate of site 1, with
// other coordinates, and site 7 is free.
const std::vector<Point> few_sites = {{1, 0, 0}, {2, 1, 0},  {1, 2, 0},   {0, 1, 0},
                                      {1, 1, 1}, {1, 1, -1}, {1, 0.5, 0}, {-1, -1, 0.5}};
const Constraints few_constraints = {{0, 3}, {4, 2}};

const std::vector<ConstrainedChange> constrained_changes = {
    {"insert",
     [](auto& changing) {
       changing.insert({-1, 0, 0});
     }},
    {"insert_on_a_constraint",
     [](auto& changing) {
       changing.insert({1, 1, 0}, 4);
     }},
    {"insert_duplicate",
     [](auto& changing) {
       changing.insert({0.5, 0.25, 0});
     }},
    {"remove", [](auto& changing) { changing.remove(7); }},
    {"remove_from_a_constraint",
     [](auto& changing) {
       changing.remove(6);
       changing.remove(1);
     }},
    {"remove_duplicate", [](auto& changing) { changing.remove(1); }},
    {"insert_constraint", [](auto& changing) { changing.insert_constraint(5, 1); }},
    {"insert_crossing_edges", [](auto& changing) { changing.insert_constraint(4, 7); }},
    {"remove_constraint", [](auto& changing) { changing.remove_constraint(0); }},
};

bool is_equal(const ConstrainedSnapshot& a, const ConstrainedSnapshot& b) {
  return a.site_ids == b.site_ids && a.constraint_ids == b.constraint_ids &&
         a.result.triangulation.sites() == b.result.triangulation.sites() &&
         std::ranges::equal(a.result.triangulation.faces(), b.result.triangulation.faces()) &&
         a.result.edges == b.result.edges && a.result.sides == b.result.sides &&
         a.result.sources.values == b.result.sources.values;
}

TEST(allocation_of_constrained_change, leaves_all_as_it_was) {
  // What oneTBB keeps from its first use on.
  static_cast<void>(DynamicConstrainedTriangulation(few_sites, few_constraints).snapshot());
  for (const ConstrainedChange& change : constrained_changes) {
    SCOPED_TRACE(change.name);
    DynamicConstrainedTriangulation expected(few_sites, few_constraints);
    change.make(expected);
    fail_each_allocation([&](std::size_t n, Shortage shortage) {
      DynamicConstrainedTriangulation changing(few_sites, few_constraints);
      ConstrainedSnapshot before = changing.snapshot();
      bool is_done = false;
      FailingAllocation failing(n, shortage);
      try {
        change.make(changing);
        is_done = true;
      } catch (const std::bad_alloc&) {  // as it should be
      }
      const bool has_failed = failing.stop();
      EXPECT_TRUE(has_failed || is_done) << "threw without a reason";
      if (!is_done) {
        // Of two changes the first one may have been made.
        const bool is_first_done = changing.num_sites() + 1 == before.site_ids.size();
        if (!is_first_done) {
          EXPECT_TRUE(is_equal(changing.snapshot(), before));
          change.make(changing);
        } else {
          changing.remove(1);
        }
      }
      EXPECT_TRUE(is_equal(changing.snapshot(), expected.snapshot()));
      return has_failed;
    });
  }
}

// A site comes off the great circle of all others, and goes again: the hull is made and given up.
TEST(allocation_of_constrained_change, leaves_sites_on_a_great_circle) {
  // What oneTBB keeps from its first use on.
  static_cast<void>(DynamicConstrainedTriangulation(few_sites, few_constraints).snapshot());
  const std::vector<Point> circle(few_sites.begin(), few_sites.begin() + 4);
  const Constraints constraints = {{0, 3}};
  fail_each_allocation([&](std::size_t n, Shortage shortage) {
    DynamicConstrainedTriangulation changing(circle, constraints);
    const ConstrainedSnapshot before = changing.snapshot();
    Index added = no_index;
    FailingAllocation failing(n, shortage);
    try {
      added = changing.insert({1, 1, 1});
      changing.remove(added);
    } catch (const std::bad_alloc&) {  // as it should be
    }
    const bool has_failed = failing.stop();
    if (changing.num_sites() > circle.size()) changing.remove(added);
    EXPECT_TRUE(is_equal(changing.snapshot(), before));
    return has_failed;
  });
}

}  // namespace
}  // namespace rondel::test
