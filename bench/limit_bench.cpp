// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// limit_bench KIND N: what no construction of this kind can do without, measured apart for the
// projected model. Their sum is the limit beside which the whole build is judged:
//
//   sort    the spatial order;
//   verify  one conflict test for each edge of the finished triangulation, faces and sites in
//           spatial order, so that the memory is read in the best order there is;
//   write   the arrays of faces and neighbors under the names of the sites, into new memory.

#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "models/projected_points.h"
#include "order/spatial_order.h"
#include "rondel/rondel.h"
#include "system/huge_pages.h"

namespace {

using rondel::Index;
using rondel::Triple;

std::vector<Index> invert(std::span<const Index> order, std::size_t num_sites) {
  std::vector<Index> ranks(num_sites, rondel::no_index);
  for (Index rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

// One test for each edge, in the face of smaller number; the corner across is what the neighbor's
// corners have beyond the two that are shared.
std::size_t count_conflicts(const rondel::models::ProjectedPoints& sites,
                            std::span<const Triple> faces, std::span<const Triple> neighbors) {
  std::size_t conflicts = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto [a, b, c] = faces[f];
    const Triple shared = {b ^ c, c ^ a, a ^ b};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t g = neighbors[f][i];
      if (g < f) continue;
      const Index p = faces[g][0] ^ faces[g][1] ^ faces[g][2] ^ shared[i];
      conflicts += sites.is_in_conflict(a, b, c, p) ? 1 : 0;
    }
  }
  return conflicts;
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
  if (argc < 3) {
    std::fprintf(stderr, "usage: limit_bench KIND N\n");
    return 2;
  }
  const auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10));
  rondel::Options options;
  options.threads = 1;
  const auto triangulation = rondel::delaunay(sites, options);
  const auto sorted = rondel::bench::measure(
      [&] { return rondel::order::spatial_order(sites, options.model, {}, options.threads); });
  const auto& order = sorted.result->order;
  const auto ranks = invert(order, sites.size());
  if (order.size() != sites.size()) {
    std::fprintf(stderr, "limit_bench: the input has duplicates\n");
    return 1;
  }
  std::vector<Triple> faces(triangulation.faces().begin(), triangulation.faces().end());
  for (Triple& face : faces) {
    for (Index& corner : face) corner = ranks[corner];
  }
  const rondel::models::ProjectedPoints points(sites, order, {});
  const auto verified = rondel::bench::measure(
      [&] { return count_conflicts(points, faces, triangulation.neighbors()); });
  if (*verified.result != 0) return 1;
  const auto written =
      rondel::bench::measure([&] { return write_arrays(faces, triangulation.neighbors(), order); });
  rondel::bench::print_json({{"sites", static_cast<double>(sites.size())},
                             {"seconds", sorted.seconds + verified.seconds + written.seconds},
                             {"sort", sorted.seconds},
                             {"verify", verified.seconds},
                             {"write", written.seconds}});
}
