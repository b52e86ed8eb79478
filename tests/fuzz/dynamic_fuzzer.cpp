// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// DynamicTriangulation: after the steps of a script of changes it is what delaunay() makes of the
// sites that are there, and all that it tells about a site agrees with that.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

constexpr std::size_t max_steps = 48;
constexpr std::size_t max_num_sites = 32;

// What the sites around each vertex must be, by position in the snapshot.
std::map<Index, std::vector<Index>> expected_neighbors(const Triangulation& built) {
  std::map<Index, std::map<Index, Index>> next;
  for (const auto& [a, b, c] : built.faces()) {
    next[a][b] = c;
    next[b][c] = a;
    next[c][a] = b;
  }
  std::map<Index, std::vector<Index>> result;
  for (const auto& [vertex, follows] : next) {
    Index w = follows.begin()->first;
    do {
      result[vertex].push_back(w);
      w = follows.at(w);
    } while (w != follows.begin()->first);
    require(result[vertex].size() == follows.size(), "one cycle around each vertex");
  }
  const auto ring = built.ring();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    std::set<Index> beside = {ring[(i + 1) % ring.size()],
                              ring[(i + ring.size() - 1) % ring.size()]};
    beside.erase(ring[i]);
    result[ring[i]].assign(beside.begin(), beside.end());
  }
  return result;
}

class Script {
 public:
  Script(ByteSource source, Scales scales, std::size_t steps_between, const Options& options)
      : source_(source),
        scales_(scales),
        steps_between_(steps_between),
        options_(options),
        changing_(options) {}

  void run() {
    for (std::size_t n = 1 + source_.below(16); n > 0; --n) add_to_pool();
    for (std::size_t step = 1; step <= max_steps && !source_.is_empty(); ++step) {
      do_step(source_.byte() % 15);
      if (step % steps_between_ == 0) compare();
    }
    compare();
  }

 private:
  void add_to_pool() {
    const Point p = next_site(source_, pool_, scales_);
    const bool has_no_ray = options_.model == Model::projected && p == options_.sphere.center;
    if (!has_no_ray) pool_.push_back(p);
  }

  Point any_site() {
    if (source_.below(8) == 0) add_to_pool();
    if (pool_.empty()) return {options_.sphere.center.x == 1 ? 2.0 : 1.0, 0, 0};
    return pool_[source_.below(pool_.size())];
  }

  Index any_live() {
    return std::next(live_.begin(), static_cast<std::ptrdiff_t>(source_.below(live_.size())))
        ->first;
  }

  std::vector<Index> some_live() {
    std::vector<Index> ids;
    for (std::size_t n = source_.below(live_.size() + 1); n > 0; --n) {
      const Index id = any_live();
      if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
    }
    return ids;
  }

  void put(Index id, const Point& p) {
    require(live_.emplace(id, p).second, "a new site gets an id that is not in use");
  }

  void do_step(unsigned what) {
    if (live_.empty() && what > 4) what = 0;
    if (what <= 5 && live_.size() >= max_num_sites) what = 6;
    switch (what) {
      case 0:
      case 1:
      case 2:
      case 3: {
        const Point p = any_site();
        put(changing_.insert(p), p);
        break;
      }
      case 4:
        insert_range();
        break;
      case 5: {
        const Point p = any_site();
        put(changing_.insert(p, any_live()), p);
        break;
      }
      case 6:
      case 7:
      case 8: {
        const Index id = any_live();
        changing_.remove(id);
        live_.erase(id);
        break;
      }
      case 9:
        remove_range();
        break;
      case 10: {
        const Index id = any_live();
        const Point p = any_site();
        changing_.move(id, p);
        live_[id] = p;
        break;
      }
      case 11:
        move_range();
        break;
      case 12:
        begin_anew();
        break;
      case 13:
        move_all();
        break;
      default:
        refuse_wrong_calls();
    }
  }

  void insert_range() {
    std::vector<Point> points(source_.below(9));
    for (Point& p : points) p = any_site();
    const std::vector<Index> ids = changing_.insert(points);
    require(ids.size() == points.size(), "an id for each site");
    for (std::size_t i = 0; i < ids.size(); ++i) put(ids[i], points[i]);
  }

  void remove_range() {
    const std::vector<Index> ids = some_live();
    changing_.remove(ids);
    for (const Index id : ids) live_.erase(id);
  }

  void move_range() {
    const std::vector<Index> ids = some_live();
    std::vector<Point> to(ids.size());
    for (Point& p : to) p = any_site();
    changing_.move(ids, to);
    for (std::size_t i = 0; i < ids.size(); ++i) live_[ids[i]] = to[i];
  }

  // To anywhere, or by little.
  void move_all() {
    std::vector<Point> to;
    const bool is_near = source_.below(4) != 0;
    for (const auto& [id, point] : live_) {
      to.push_back(is_near ? Point{point.x + 0x1p-9 * point.y, point.y, point.z} : any_site());
    }
    const auto is_refused = [&](const Point& p) {
      return !std::isfinite(p.x) || p == options_.sphere.center;
    };
    if (std::ranges::any_of(to, is_refused)) return;
    changing_.move_all(to);
    std::size_t i = 0;
    for (auto& [id, point] : live_) point = to[i++];
  }

  // From a snapshot, or from its sites.
  void begin_anew() {
    const Snapshot now = changing_.snapshot();
    changing_ = source_.below(2) == 0
                    ? DynamicTriangulation(now.triangulation)
                    : DynamicTriangulation(now.triangulation.sites().points(), options_);
    live_.clear();
    const Sites& sites = now.triangulation.sites();
    for (std::size_t i = 0; i < sites.size(); ++i) put(static_cast<Index>(i), sites[i]);
  }

  // The comparison that follows shows that they have changed nothing.
  void refuse_wrong_calls() {
    const Index id = any_live();
    const Index dead = live_.rbegin()->first + 1;
    const Point p = any_site();
    const Point bad = {p.x, INFINITY, p.z};
    refuse(0, [&] { changing_.insert(bad); });
    refuse(0, [&] { changing_.insert(p, dead); });
    refuse(1, [&] { changing_.insert(std::vector<Point>{p, bad, bad}); });
    refuse(0, [&] { changing_.remove(dead); });
    refuse(1, [&] { changing_.remove(std::vector<Index>{id, dead, id}); });
    refuse(1, [&] { changing_.remove(std::vector<Index>{id, id, dead}); });
    refuse(0, [&] { changing_.move(dead, p); });
    refuse(0, [&] { changing_.move(id, bad); });
    refuse(1, [&] { changing_.move(std::vector<Index>{id}, std::vector<Point>{p, p}); });
    refuse(live_.size(), [&] { changing_.move_all(std::vector<Point>(live_.size() + 1, p)); });
    refuse(0, [&] { static_cast<void>(changing_.neighbors(dead)); });
  }

  void compare() const {
    const Snapshot now = changing_.snapshot();
    std::vector<Index> ids;
    std::vector<Point> sites;
    for (const auto& [id, point] : live_) {
      ids.push_back(id);
      sites.push_back(point);
    }
    require(now.ids == ids && changing_.ids() == ids, "the ids are those in use");
    require(now.triangulation.sites() == sites, "the sites are where they were put");
    const Triangulation built = delaunay(sites, options_);
    const Triangulation& t = now.triangulation;
    require(changing_.model() == options_.model && t.model() == options_.model &&
                changing_.sphere().center == options_.sphere.center &&
                changing_.sphere().squared_radius == options_.sphere.squared_radius,
            "the model and the sphere stay");
    require(t.num_sites() == built.num_sites(), "the same number of sites");
    require(t.dimension() == built.dimension(), "the same dimension");
    require(std::ranges::equal(t.duplicates(), built.duplicates()), "the same duplicates");
    require(std::ranges::equal(t.ring(), built.ring()), "the same ring");
    require(std::ranges::equal(t.faces(), built.faces()), "the same faces");
    require(std::ranges::equal(t.neighbors(), built.neighbors()), "the same neighbors of faces");
    require(std::ranges::equal(t.ghost_faces(), built.ghost_faces()), "the same ghost faces");
    require(std::ranges::equal(t.hidden(), built.hidden()), "the same hidden sites");
    require(changing_.num_sites() == built.num_sites() &&
                changing_.dimension() == built.dimension() &&
                changing_.num_vertices() == built.num_vertices() &&
                changing_.num_faces() == built.num_faces(),
            "the same numbers");
    compare_sites(ids, sites, built);
  }

  void compare_sites(const std::vector<Index>& ids, const std::vector<Point>& sites,
                     const Triangulation& built) const {
    std::vector<Index> lowest(ids.size());
    for (Index i = 0; i < ids.size(); ++i) lowest[i] = i;
    for (const Duplicate& d : built.duplicates()) lowest[d.site] = d.representative;
    const auto expected = expected_neighbors(built);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto around = expected.find(lowest[i]);
      std::vector<Index> neighbors;
      if (around != expected.end()) {
        for (const Index w : around->second) neighbors.push_back(ids[w]);
      }
      require(changing_.contains(ids[i]), "a site in use is contained");
      require(changing_.site(ids[i]) == sites[i], "a site is where it was put");
      require(changing_.representative(ids[i]) == ids[lowest[i]], "the same representative");
      require(changing_.is_vertex(ids[i]) == (around != expected.end()), "the same vertices");
      require(changing_.neighbors(ids[i]) == neighbors, "the same neighbors, in their order");
    }
    require(!changing_.contains(ids.empty() ? 0 : ids.back() + 1), "other ids are not contained");
  }

  ByteSource source_;
  Scales scales_;
  std::size_t steps_between_;  // from one comparison to the next
  Options options_;
  DynamicTriangulation changing_;
  std::vector<Point> pool_;
  std::map<Index, Point> live_;  // by id
};

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  Options options;
  options.model = source.byte() % 2 == 0 ? Model::weighted : Model::projected;
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t steps_between = 1 + source.below(4);
  options.sphere = fuzz::next_sphere(source, scales);
  fuzz::Script(source, scales, steps_between, options).run();
  return 0;
}
