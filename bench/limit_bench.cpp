// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// limit_bench KIND N [--seed S]: measures separately the parts that no construction of this kind
// can avoid, for the projected model. Their sum is the limit with which the whole build is
// compared:
//
//   sort    the spatial order;
//   verify  one conflict test for each edge of the finished triangulation, faces and sites in
//           spatial order, so that the memory is read in the best order there is;
//   write   the arrays of faces and neighbors, with sites instead of ranks, into new memory.

#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include "inputs.h"
#include "kernel/conflict_test.h"
#include "measure.h"
#include "models/projected_points.h"
#include "order/spatial_order.h"
#include "rondel/rondel.h"
#include "system/large_arrays.h"

namespace {

using rondel::Index;
using rondel::Triple;

auto sort(std::span<const rondel::Point> sites, const rondel::Options& options) {
  return rondel::order::spatial_order(sites, options.model, {}, 1);
}

std::vector<Index> invert(std::span<const Index> order, std::size_t num_sites) {
  std::vector<Index> ranks(num_sites, rondel::no_index);
  for (Index rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

// Does one test for each edge, in the face of the smaller number; the corner across the edge is the
// neighbor's corner that is not shared.
std::size_t count_conflicts(rondel::kernel::ConflictTest<rondel::models::ProjectedPoints>& test,
                            std::span<const Triple> faces, std::span<const Triple> neighbors) {
  std::size_t conflicts = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto [a, b, c] = faces[f];
    const Triple shared = {b ^ c, c ^ a, a ^ b};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t g = neighbors[f][i];
      if (g < f) continue;
      const Index p = faces[g][0] ^ faces[g][1] ^ faces[g][2] ^ shared[i];
      conflicts += test.is_in_conflict(faces[f], p) ? 1 : 0;
    }
  }
  return conflicts;
}

// A finished triangulation whose sites are numbered by their ranks.
struct Finished {
  std::vector<rondel::Point> sites;
  rondel::Triangulation triangulation;
  std::vector<Index> order;
  std::vector<Triple> faces;
};

Finished finish(std::vector<rondel::Point> sites, const rondel::Options& options) {
  Finished finished;
  finished.sites = std::move(sites);
  finished.triangulation = rondel::delaunay(finished.sites, options, {.threads = 1});
  finished.order = sort(finished.sites, options).order;
  if (finished.order.size() != finished.sites.size()) {
    std::fprintf(stderr, "limit_bench: the input has duplicates\n");
    std::exit(1);
  }
  const auto ranks = invert(finished.order, finished.sites.size());
  const auto faces = finished.triangulation.faces();
  finished.faces.assign(faces.begin(), faces.end());
  for (Triple& face : finished.faces) {
    for (Index& corner : face) corner = ranks[corner];
  }
  return finished;
}

struct Arrays {
  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
};

Arrays write_arrays(std::span<const Triple> faces, std::span<const Triple> neighbors,
                    std::span<const Index> names) {
  Arrays arrays;
  rondel::system::reserve_large(arrays.faces, faces.size());
  for (const Triple& f : faces) arrays.faces.push_back({names[f[0]], names[f[1]], names[f[2]]});
  rondel::system::reserve_large(arrays.neighbors, neighbors.size());
  arrays.neighbors.assign(neighbors.begin(), neighbors.end());
  return arrays;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: limit_bench KIND N [--seed S]\n");
    return 2;
  }
  rondel::bench::Source source(argv[1], argv[2], seed);
  rondel::Options options;
  const auto make = [&] { return finish(source.next(), options); };
  using rondel::bench::measure;
  const auto sorted = measure([&] { return source.next(); },
                              [&](const auto& sites) { return sort(sites, options); });
  const auto verified = measure(make, [](const Finished& t) {
    rondel::models::ProjectedPoints points(t.sites, t.order, {});
    rondel::kernel::ConflictTest test(points);
    return count_conflicts(test, t.faces, t.triangulation.neighbors());
  });
  if (*verified.result != 0) return 1;
  const auto written = measure(make, [](const Finished& t) {
    return write_arrays(t.faces, t.triangulation.neighbors(), t.order);
  });
  rondel::bench::print_json({{"sites", static_cast<double>(sorted.input->size())},
                             {"seconds", sorted.seconds + verified.seconds + written.seconds},
                             {"sort", sorted.seconds},
                             {"verify", verified.seconds},
                             {"write", written.seconds}});
}
