// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// constrained_bench N CONSTRAINTS [THREADS] [--seed S]: measures the constrained triangulation of
// uniform sites beside delaunay() of the same sites. Each constraint joins two random sites in a
// square of the cube around the sphere, up to four in each square, so that none cross. Prints
// medians, and nanoseconds for each edge that the constraints cross, as one JSON object.
//
// constrained_bench SITES.npy EDGES.csv [THREADS]: does the same for sites and constraints of files,
// as compare/gshhg.py writes them, turned by another angle each time. Constraints that cross others
// are left out.
//
// constrained_bench --changes N CONSTRAINTS [--seed S]: measures single changes of a
// DynamicConstrainedTriangulation of the same sites and constraints: new sites, which then go
// again, beside those of a DynamicTriangulation; and all constraints, which go and come again, both
// in random order. Prints microseconds for each change as one JSON object.
//
// constrained_bench --curves K: measures one constraint between two curves of K sites each, whose
// curvature grows along them, so that each face beside the constraint cuts off one site.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "constraints.h"
#include "inputs.h"
#include "inputs/random.h"
#include "measure.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/dynamic_constrained.h"

namespace {

using rondel::Index;
using rondel::Point;
using rondel::bench::median;
using rondel::bench::random_constraints;
using rondel::bench::seconds_of;
using Edge = std::array<Index, 2>;

constexpr int repetitions = 5;

std::vector<Edge> edges_of(const rondel::Triangulation& triangulation) {
  std::vector<Edge> edges;
  for (const auto& [a, b, c] : triangulation.faces()) {
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      if (from < to) edges.push_back({from, to});
    }
  }
  std::ranges::sort(edges);
  return edges;
}

// Returns how many edges the constraints have removed: at least those that they cross.
std::size_t num_crossed(const rondel::Triangulation& before, const rondel::Triangulation& after) {
  std::vector<Edge> gone;
  std::ranges::set_difference(edges_of(before), edges_of(after), std::back_inserter(gone));
  return gone.size();
}

struct Input {
  std::vector<Point> sites;
  std::vector<Edge> constraints;
};

// Measures inputs, of which make(i) returns the i-th one.
template <class Make>
void run(unsigned threads, const Make& make) {
  const rondel::Execution execution{.threads = threads};
  std::vector<double> plain;
  std::vector<double> constrained;
  std::size_t crossed = 0;
  std::size_t num_sites = 0;
  std::size_t num_constraints = 0;
  for (int i = 0; i < repetitions; ++i) {
    const auto [sites, constraints] = make(i);
    rondel::Triangulation before;
    rondel::ConstrainedTriangulation after;
    plain.push_back(
        seconds_of([&] { before = delaunay(rondel::Sites::view(sites), {}, execution); }));
    constrained.push_back(seconds_of([&] {
      after = constrained_delaunay(rondel::Sites::view(sites), constraints, {}, execution);
    }));
    crossed = num_crossed(before, after.triangulation);
    num_sites = sites.size();
    num_constraints = constraints.size();
  }
  const double more = median(constrained) - median(plain);
  std::printf(R"({"sites": %zu, "constraints": %zu, "threads": %u, "crossed": %zu, )", num_sites,
              num_constraints, threads, crossed);
  std::printf(R"("delaunay_seconds": %.4f, "constrained_seconds": %.4f, )", median(plain),
              median(constrained));
  std::printf(R"("ns_per_crossed_edge": %.1f})"
              "\n",
              more / static_cast<double>(std::max<std::size_t>(crossed, 1)) * 1e9);
}

std::vector<Edge> read_edges(const char* name) {
  std::ifstream file(name);
  std::vector<Edge> edges;
  char comma = 0;
  for (Edge edge{}; file >> edge[0] >> comma >> edge[1];) edges.push_back(edge);
  return edges;
}

void run_files(const char* sites_name, const char* edges_name, unsigned threads) {
  Input input = {rondel::bench::make_input(sites_name, 0), read_edges(edges_name)};
  const std::size_t num_given = input.constraints.size();
  for (bool has_crossing = true; has_crossing;) {
    try {
      rondel::constrained_delaunay(rondel::Sites::view(input.sites), input.constraints);
      has_crossing = false;
    } catch (const rondel::CrossingConstraints& crossing) {
      input.constraints.erase(input.constraints.begin() + crossing.constraints()[1]);
    }
  }
  std::fprintf(stderr, "%zu constraints are left out\n", num_given - input.constraints.size());
  run(threads, [&](int i) {
    Input turned = input;
    const double cosine = std::cos(0.7 * i);
    const double sine = std::sin(0.7 * i);
    for (Point& p : turned.sites) p = {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z};
    return turned;
  });
}

// Returns the microseconds of each of `size` changes, make(0), make(1) ...
template <class Make>
double microseconds_of(std::size_t size, const Make& make) {
  const double seconds = seconds_of([&] {
    for (std::size_t i = 0; i < size; ++i) make(i);
  });
  return seconds / static_cast<double>(size) * 1e6;
}

void run_changes(std::size_t n, std::size_t wanted, std::uint64_t seed) {
  const auto sites = rondel::bench::make_input("uniform", n, seed);
  std::vector<Edge> constraints = random_constraints(sites, wanted);
  const auto more = rondel::bench::make_input("uniform", n / 8, ~seed);
  rondel::inputs::Random random(seed);
  rondel::DynamicConstrainedTriangulation changing(sites, constraints);
  rondel::DynamicTriangulation plain(sites);
  std::vector<Index> ids(more.size());
  std::vector<Index> plain_ids(more.size());
  const double plain_insert =
      microseconds_of(more.size(), [&](std::size_t i) { plain_ids[i] = plain.insert(more[i]); });
  const double insert =
      microseconds_of(more.size(), [&](std::size_t i) { ids[i] = changing.insert(more[i]); });
  random.shuffle(ids);
  random.shuffle(plain_ids);
  const double plain_remove =
      microseconds_of(more.size(), [&](std::size_t i) { plain.remove(plain_ids[i]); });
  const double remove =
      microseconds_of(more.size(), [&](std::size_t i) { changing.remove(ids[i]); });
  std::vector<Index> order(constraints.size());
  for (Index i = 0; i < order.size(); ++i) order[i] = i;
  random.shuffle(order);
  const double remove_constraint =
      microseconds_of(order.size(), [&](std::size_t i) { changing.remove_constraint(order[i]); });
  random.shuffle(constraints);
  const double insert_constraint = microseconds_of(constraints.size(), [&](std::size_t i) {
    changing.insert_constraint(constraints[i][0], constraints[i][1]);
  });
  std::printf(R"({"sites": %zu, "constraints": %zu, "insert_us": %.3f, "remove_us": %.3f, )",
              sites.size(), constraints.size(), insert, remove);
  std::printf(R"("insert_constraint_us": %.3f, "remove_constraint_us": %.3f, )", insert_constraint,
              remove_constraint);
  std::printf(R"("plain_insert_us": %.3f, "plain_remove_us": %.3f})"
              "\n",
              plain_insert, plain_remove);
}

// Returns sites along two arcs of spirals, from the first site to the second one.
std::vector<Point> curves(std::size_t size) {
  std::vector<Point> sites = {{1, -0.2, 0}, {1, 0.2, 0}};
  for (std::size_t i = 1; i <= size; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(size + 1);
    const double height = t * (1 - t) * (1 + 2 * t * t);
    sites.push_back({1, 0.4 * t - 0.2, 0.1 * height});
    sites.push_back({1, 0.4 * t - 0.2, -0.08 * height});
  }
  return sites;
}

void run_curves(std::size_t size) {
  const std::vector<Point> sites = curves(size);
  const std::vector<Edge> constraint = {{0, 1}};
  const rondel::Execution execution{.threads = 1};
  const double plain = seconds_of([&] { delaunay(rondel::Sites::view(sites), {}, execution); });
  const double constrained = seconds_of(
      [&] { constrained_delaunay(rondel::Sites::view(sites), constraint, {}, execution); });
  std::printf(R"({"sites": %zu, "delaunay_seconds": %.4f, "constrained_seconds": %.4f})"
              "\n",
              sites.size(), plain, constrained);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  const bool has_changes = argc > 1 && std::strcmp(argv[1], "--changes") == 0;
  const bool has_curves = argc > 1 && std::strcmp(argv[1], "--curves") == 0;
  if (argc < (has_changes ? 4 : 3)) {
    std::fprintf(stderr,
                 "usage: constrained_bench N CONSTRAINTS [THREADS] [--seed S]\n"
                 "       constrained_bench SITES.npy EDGES.csv [THREADS]\n"
                 "       constrained_bench --changes N CONSTRAINTS [--seed S]\n"
                 "       constrained_bench --curves K\n");
    return 2;
  }
  rondel::bench::keep_freed_memory();
  if (has_curves) {
    run_curves(static_cast<std::size_t>(std::atoll(argv[2])));
    return 0;
  }
  if (has_changes) {
    run_changes(static_cast<std::size_t>(std::atoll(argv[2])),
                static_cast<std::size_t>(std::atoll(argv[3])), seed);
    return 0;
  }
  const unsigned threads = argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1;
  if (std::string_view(argv[1]).ends_with(".npy")) {
    run_files(argv[1], argv[2], threads);
    return 0;
  }
  const auto n = static_cast<std::size_t>(std::atoll(argv[1]));
  const auto wanted = static_cast<std::size_t>(std::atoll(argv[2]));
  run(threads, [&](int i) {
    Input input = {rondel::bench::make_input("uniform", n, seed + static_cast<unsigned>(i)), {}};
    input.constraints = random_constraints(input.sites, wanted);
    return input;
  });
  return 0;
}
