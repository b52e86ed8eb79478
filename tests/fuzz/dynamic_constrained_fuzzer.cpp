// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// DynamicConstrainedTriangulation: after the steps of a script of changes it is what
// constrained_delaunay() makes of the sites and constraints that are there, and what it refuses
// changes nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/constrained.h"
#include "rondel/dynamic_constrained.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

using Edge = std::array<Index, 2>;

constexpr std::size_t max_steps = 64;
constexpr std::size_t max_num_sites = 24;

class ConstrainedScript {
 public:
  ConstrainedScript(ByteSource source, Scales scales, std::size_t steps_between,
                    const Sphere& sphere)
      : source_(source),
        scales_(scales),
        steps_between_(steps_between),
        sphere_(sphere),
        changing_(sphere) {}

  void run() {
    for (std::size_t n = 1 + source_.below(16); n > 0; --n) add_to_pool();
    for (std::size_t step = 1; step <= max_steps && !source_.is_empty(); ++step) {
      do_step(source_.byte() % 16);
      if (step % steps_between_ == 0) compare();
    }
    compare();
  }

 private:
  void add_to_pool() {
    const Point p = next_site(source_, pool_, scales_);
    if (!(p == sphere_.center)) pool_.push_back(p);
  }

  Point any_site() {
    if (source_.below(8) == 0) add_to_pool();
    if (pool_.empty()) return {sphere_.center.x == 1 ? 2.0 : 1.0, 0, 0};
    return pool_[source_.below(pool_.size())];
  }

  Index any_id(const auto& map) {
    return std::next(map.begin(), static_cast<std::ptrdiff_t>(source_.below(map.size())))->first;
  }

  void do_step(unsigned what) {
    if (live_.empty() || (what < 7 && live_.size() < max_num_sites)) {
      insert_site();
    } else if (what < 11) {
      insert_constraint();
    } else if (what < 13) {
      remove_constraint();
    } else if (what < 15) {
      remove_site();
    } else {
      refuse_wrong_calls();
    }
  }

  void insert_site() {
    const Point p = any_site();
    const bool has_hint = !live_.empty() && source_.below(2) == 0;
    const Index id = has_hint ? changing_.insert(p, any_id(live_)) : changing_.insert(p);
    require(live_.emplace(id, p).second, "a new site gets an id that is not in use");
  }

  void insert_constraint() {
    const Edge ends = {any_id(live_), any_id(live_)};
    try {
      const Index id = changing_.insert_constraint(ends[0], ends[1]);
      require(constraints_.emplace(id, ends).second, "a new constraint gets an id of its own");
    } catch (const InvalidInput&) {
      auto more = constraints_;
      more[no_index - 1] = ends;
      require(is_refused(live_, more), "a build refuses the constraint, too");
    }
  }

  void remove_constraint() {
    if (constraints_.empty()) return;
    const Index id = any_id(constraints_);
    changing_.remove_constraint(id);
    constraints_.erase(id);
  }

  void remove_site() {
    const Index id = any_id(live_);
    const bool is_end = std::ranges::any_of(constraints_, [id](const auto& constraint) {
      return constraint.second[0] == id || constraint.second[1] == id;
    });
    if (is_end) {
      refuse(0, [&] { changing_.remove(id); });
      return;
    }
    auto fewer = live_;
    fewer.erase(id);
    try {
      changing_.remove(id);
      live_ = fewer;
    } catch (const CrossingConstraints& error) {
      const auto [first, second] = error.constraints();
      require(constraints_.contains(first) && constraints_.contains(second) && first < second,
              "constraints are named by their ids");
      require(is_refused(fewer, constraints_), "a build refuses what is left, too");
    }
  }

  // The comparison that follows shows that they have changed nothing.
  void refuse_wrong_calls() {
    const Index id = any_id(live_);
    const Index dead = live_.rbegin()->first + 1;
    const Index no_constraint = constraints_.empty() ? 0 : constraints_.rbegin()->first + 1;
    const Point p = any_site();
    const Point bad = {p.x, INFINITY, p.z};
    refuse(0, [&] { changing_.insert(bad); });
    refuse(0, [&] { changing_.insert(p, dead); });
    refuse(0, [&] { changing_.remove(dead); });
    refuse(0, [&] { changing_.insert_constraint(dead, id); });
    refuse(1, [&] { changing_.insert_constraint(id, dead); });
    refuse(0, [&] { changing_.insert_constraint(id, id); });
    refuse(0, [&] { changing_.remove_constraint(no_constraint); });
    refuse(0, [&] { static_cast<void>(changing_.chain(no_constraint)); });
    refuse(0, [&] { static_cast<void>(changing_.neighbors(dead)); });
    require(!changing_.contains(dead) && !changing_.contains_constraint(no_constraint),
            "other ids are not contained");
  }

  // The arguments of a build.
  struct Arguments {
    std::vector<Index> ids;
    std::vector<Point> sites;
    std::vector<Edge> constraints;
  };
  static Arguments arguments_of(const std::map<Index, Point>& live,
                                const std::map<Index, Edge>& constraints) {
    Arguments arguments;
    std::map<Index, Index> position;
    for (const auto& [id, point] : live) {
      position[id] = static_cast<Index>(arguments.ids.size());
      arguments.ids.push_back(id);
      arguments.sites.push_back(point);
    }
    for (const auto& [id, ends] : constraints) {
      arguments.constraints.push_back({position.at(ends[0]), position.at(ends[1])});
    }
    return arguments;
  }

  [[nodiscard]] bool is_refused(const std::map<Index, Point>& live,
                                const std::map<Index, Edge>& constraints) const {
    const Arguments arguments = arguments_of(live, constraints);
    try {
      constrained_delaunay(arguments.sites, arguments.constraints, {.sphere = sphere_});
    } catch (const InvalidInput&) {
      return true;
    }
    return false;
  }

  void compare() const {
    const Arguments arguments = arguments_of(live_, constraints_);
    const auto built =
        constrained_delaunay(arguments.sites, arguments.constraints, {.sphere = sphere_});
    const ConstrainedSnapshot now = changing_.snapshot();
    const Triangulation& t = now.result.triangulation;
    const Triangulation& u = built.triangulation;
    require(now.site_ids == arguments.ids && changing_.site_ids() == arguments.ids,
            "the ids are those in use");
    require(now.constraint_ids == changing_.constraint_ids() &&
                changing_.num_constraints() == constraints_.size(),
            "the constraints are those in use");
    require(t.sites() == arguments.sites, "the sites are where they were put");
    require(t.dimension() == u.dimension() && changing_.dimension() == u.dimension(),
            "the same dimension");
    require(std::ranges::equal(t.duplicates(), u.duplicates()), "the same duplicates");
    require(std::ranges::equal(t.ring(), u.ring()), "the same ring");
    require(std::ranges::equal(t.faces(), u.faces()), "the same faces");
    require(std::ranges::equal(t.neighbors(), u.neighbors()), "the same neighbors of faces");
    require(std::ranges::equal(t.ghost_faces(), u.ghost_faces()), "the same ghost faces");
    require(now.result.edges == built.edges && now.result.sides == built.sides &&
                now.result.sources.offsets == built.sources.offsets &&
                now.result.sources.values == built.sources.values,
            "the same constrained edges");
    require(changing_.num_sites() == u.num_sites() && changing_.num_faces() == u.num_faces() &&
                changing_.num_vertices() == u.num_vertices(),
            "the same numbers");
    require(changing_.sphere().center == sphere_.center, "the sphere stays");
    for (const auto& [id, ends] : constraints_) {
      require(changing_.contains_constraint(id) && changing_.constraint(id) == ends,
              "a constraint keeps its sites");
      const std::vector<Index> chain = changing_.chain(id);
      require(chain.front() == changing_.representative(ends[0]) &&
                  chain.back() == changing_.representative(ends[1]),
              "a chain leads from end to end");
      for (std::size_t i = 1; i < chain.size(); ++i) {
        const std::vector<Index> around = changing_.neighbors(chain[i - 1]);
        require(std::ranges::find(around, chain[i]) != around.end(), "a chain goes along edges");
      }
    }
    for (const auto& [id, point] : live_) {
      require(changing_.contains(id) && changing_.site(id) == point, "a site keeps its place");
    }
  }

  ByteSource source_;
  Scales scales_;
  std::size_t steps_between_;  // from one comparison to the next
  Sphere sphere_;
  DynamicConstrainedTriangulation changing_;
  std::vector<Point> pool_;
  std::map<Index, Point> live_;        // by id
  std::map<Index, Edge> constraints_;  // by id
};

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t steps_between = 1 + source.below(4);
  const Sphere sphere = fuzz::next_sphere(source, scales);
  fuzz::ConstrainedScript(source, scales, steps_between, sphere).run();
  return 0;
}
