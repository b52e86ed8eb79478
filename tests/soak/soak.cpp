// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random mixed work for a given time: builds of random size and kind, changes, queries, hulls,
// files. All results are checked, and the memory in use must stay flat.
//
//     soak MINUTES [SEED]

#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "rondel/rondel.h"
#include "support/generators.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

using Clock = std::chrono::steady_clock;

void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

struct Input {
  std::vector<Point> sites;
  Options options;
  Execution execution;
};

bool is_same(const Triangulation& a, const Triangulation& b) {
  return a.dimension() == b.dimension() && std::ranges::equal(a.faces(), b.faces()) &&
         std::ranges::equal(a.neighbors(), b.neighbors()) &&
         std::ranges::equal(a.ghost_faces(), b.ghost_faces()) &&
         std::ranges::equal(a.ring(), b.ring()) && std::ranges::equal(a.hidden(), b.hidden()) &&
         std::ranges::equal(a.duplicates(), b.duplicates());
}

// Kinds whose exact arithmetic takes seconds stay small.
Input random_input(Random& random, std::size_t most) {
  const auto all = generators();
  const bool is_large = random.below(8) == 0;
  const Generator& g = is_large ? generator(random.coin() ? "uniform" : "globe_grid")
                                : all[random.below(all.size())];
  const std::size_t n = is_large ? 1 + random.below(most) : 1 + random.below(60);
  SiteSet set = g.make(n, random.next());
  if (set.sites.empty()) set.sites.push_back({1, 2, 3});
  const bool is_weighted = g.weighted_only || random.coin();
  return {std::move(set.sites),
          {.model = is_weighted ? Model::weighted : Model::projected, .sphere = set.sphere},
          {.threads = static_cast<unsigned>(random.between(1, 4))}};
}

void build(Random& random) {
  const Input in = random_input(random, 60'000);
  const Triangulation built = delaunay(in.sites, in.options, in.execution);
  const CheckReport report = check(in.sites, built.faces(), in.options);
  require(report.is_valid, report.reason.c_str());
  require(is_same(built, delaunay(in.sites, in.options, {.threads = 5})),
          "threads change the result");
  if (in.sites.size() > 1000) return;
  const Diagram duals = diagram(built);
  double sum = 0;
  for (const double area : duals.areas) sum += area;
  if (built.num_vertices() > 0) require(std::abs(sum - 12.566370614359172) < 1e-9, "areas");
}

void change(Random& random) {
  const Input in = random_input(random, 3000);
  DynamicTriangulation changing(in.options);
  std::vector<Index> live;
  const std::size_t steps = std::min<std::size_t>(in.sites.size() * 2, 400);
  for (std::size_t step = 0; step < steps; ++step) {
    const Point& p = in.sites[random.below(in.sites.size())];
    const std::size_t i = live.empty() ? 0 : random.below(live.size());
    const std::size_t what = random.below(8);
    if (live.empty() || what < 4) {
      live.push_back(changing.insert(p));
    } else if (what < 6) {
      changing.move(live[i], p);
    } else {
      changing.remove(live[i]);
      live[i] = live.back();
      live.pop_back();
    }
  }
  const std::vector<Index> more = changing.insert(in.sites);
  const Snapshot now = changing.snapshot();
  require(is_same(now.triangulation, delaunay(now.triangulation.sites(), in.options)), "changes");
  changing.remove(more);
  require(changing.num_sites() == live.size(), "number of sites after changes");
}

void ask(Random& random) {
  const Input in = random_input(random, 20'000);
  const Triangulation built = delaunay(in.sites, in.options);
  const Locator locator(built);
  std::vector<Point> queries(50);
  const Point& center = in.options.sphere.center;
  for (Point& q : queries) {
    q = center + random_direction(random);
    if (q == center) q = in.sites[random.below(in.sites.size())];  // the center is very far
    if (q == center) return;
  }
  const std::vector<Index> nearest = locator.nearest(queries, in.execution);
  const std::vector<Location> places = locator.locate(queries, in.execution);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    require(locator.nearest(queries[i]) == nearest[i], "nearest in a range");
    require(locator.locate(queries[i]) == places[i], "locate in a range");
    if (nearest[i] == no_index) return;  // nothing but the center is a site
    require(locator.k_nearest(queries[i], 3).front() == nearest[i], "k_nearest");
    const double distance = locator.distance(queries[i], nearest[i]);
    const auto other = static_cast<Index>(random.below(in.sites.size()));
    const bool is_near = locator.distance(queries[i], other) < distance - 1e-12;
    require(in.options.model == Model::weighted || !is_near, "nearest");
  }
}

void hull(Random& random) {
  const Input in = random_input(random, 20'000);
  const Triangulation built = convex_hull(in.sites, in.execution);
  require(is_same(built, convex_hull(in.sites, {.threads = 5})), "threads change the hull");
  if (built.dimension() < 2) return;
  const CheckReport report =
      check(in.sites, built.faces(), {.model = Model::weighted, .sphere = built.sphere()});
  require(report.is_valid, report.reason.c_str());
}

void round_trip(Random& random) {
  const TemporaryDirectory folder;
  const Input in = random_input(random, 20'000);
  constexpr std::array site_endings = {".csv", ".tsv", ".xyz", ".npy"};
  const std::string sites = folder.file("sites") + site_endings[random.below(site_endings.size())];
  write_sites(sites, in.sites, {}, {}, in.execution);
  const SiteTable table = read_sites(sites);
  require(std::ranges::equal(table.sites, in.sites), "sites from a file");
  const Triangulation built = delaunay(table.sites, in.options);
  constexpr std::array face_endings = {".npy", ".off", ".ply", ".obj", ".vtp"};
  const std::string faces = folder.file("faces") + face_endings[random.below(face_endings.size())];
  write_triangles(faces, table, built);
  require(std::ranges::equal(read_triangles(faces), built.faces()), "triangles from a file");
  write_cells(folder.file("cells.npz"), table, built, diagram(built));
}

std::size_t memory_in_use() {
  ::malloc_trim(0);
  return ::mallinfo2().uordblks + ::mallinfo2().hblkhd;
}

// Bytes of the process that are in memory.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages >> pages;
  return pages * 4096;
}

void run(double minutes, std::uint64_t seed) {
  constexpr std::array works = {&build, &change, &ask, &hull, &round_trip};
  constexpr std::size_t warm_up = 200;                // what is made once and kept, for threads
  constexpr std::size_t room = std::size_t{1} << 20;  // for what threads keep for themselves
  const auto end = Clock::now() + std::chrono::duration<double>(60 * minutes);
  std::array<std::size_t, works.size()> counts{};
  std::size_t first_memory = 0;
  std::size_t first_resident = 0;
  std::size_t last_resident = 0;
  std::size_t rounds = 0;
  for (; Clock::now() < end || rounds <= warm_up; ++rounds) {
    Random random(seed + rounds);
    const std::size_t k = random.below(works.size());
    ++counts[k];
    try {
      works[k](random);
    } catch (const std::exception& error) {
      throw std::runtime_error("round with seed " + std::to_string(seed + rounds) + ", work " +
                               std::to_string(k) + ": " + error.what());
    }
    const std::size_t memory = memory_in_use();
    last_resident = resident();
    if (rounds < warm_up) continue;
    if (rounds == warm_up) {
      first_memory = memory;
      first_resident = last_resident;
    }
    require(memory <= first_memory + room, "the memory in use has grown");
  }
  std::printf("%zu rounds: %zu builds, %zu of changes, %zu of queries, %zu hulls, %zu of files\n",
              rounds, counts[0], counts[1], counts[2], counts[3], counts[4]);
  std::printf("memory in use: %zu kB after %zu rounds, %zu kB now; resident: %zu and %zu kB\n",
              first_memory / 1024, warm_up, memory_in_use() / 1024, first_resident / 1024,
              last_resident / 1024);
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fputs("usage: soak MINUTES [SEED]\n", stderr);
    return 2;
  }
  try {
    rondel::test::run(std::strtod(argv[1], nullptr),
                      argc == 3 ? std::strtoull(argv[2], nullptr, 10) : 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 1;
  }
}
