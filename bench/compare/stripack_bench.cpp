// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// stripack_bench KIND N [csstrid|trmesh]: measures the Delaunay triangulation of the same sites by
// STRIPACK (Renka, ACM TOMS 23, 1997) as it is in NCAR's mathematical library.
//
//   csstrid  its function for users: from latitudes and longitudes in degrees to a list of
//            triangles. The search for the neighbors of each triangle takes most of its time.
//   trmesh   STRIPACK's own routine below it, from unit vectors to linked lists of neighbors, no
//            triangles: favors the peer.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "inputs.h"
#include "measure.h"

extern "C" {
#include <ncarg/ngmath.h>

// SUBROUTINE TRMESH (N,X,Y,Z, LIST,LPTR,LEND,LNEW,NEAR,NEXT,DIST,IER)
void cstrmesh_(const int* n, const double* x, const double* y, const double* z, int* list,
               int* lptr, int* lend, int* lnew, int* near, int* next, double* dist, int* error);
}

namespace {

using rondel::Point;
using rondel::bench::Counts;
using rondel::bench::measure;
using rondel::bench::print_build;

void stop_if(int error) {
  if (error == 0) return;
  std::fprintf(stderr, "error %d%s\n", error,
               error == -2 ? ", the first three sites are on a great circle"
                           : (error > 0 ? ", this site is a duplicate" : ""));
  std::exit(1);
}

struct Free {
  void operator()(int* p) const { std::free(p); }
};

struct Triangles {
  std::unique_ptr<int[], Free> corners;
  std::size_t count = 0;
};

struct Positions {
  explicit Positions(const std::vector<Point>& sites) {
    constexpr double degrees = 180 / std::numbers::pi;
    for (const Point& p : sites) {
      lat_deg.push_back(degrees * std::atan2(p.z, std::hypot(p.x, p.y)));
      lon_deg.push_back(degrees * std::atan2(p.y, p.x));
    }
  }
  std::vector<double> lat_deg;
  std::vector<double> lon_deg;
};

Triangles run_csstrid(Positions& at) {
  int count = 0;
  int error = 0;
  Triangles triangles;
  triangles.corners.reset(c_csstrid(static_cast<int>(at.lat_deg.size()), at.lat_deg.data(),
                                    at.lon_deg.data(), &count, &error));
  stop_if(error);
  triangles.count = static_cast<std::size_t>(count);
  return triangles;
}

Counts count_triangles(const Positions& at, const Triangles& triangles) {
  std::vector<bool> is_vertex(at.lat_deg.size(), false);
  for (std::size_t i = 0; i < 3 * triangles.count; ++i) {
    is_vertex[static_cast<std::size_t>(triangles.corners[i])] = true;
  }
  return {is_vertex.size(), static_cast<std::size_t>(std::ranges::count(is_vertex, true)),
          triangles.count};
}

struct Coordinates {
  explicit Coordinates(const std::vector<Point>& sites) {
    for (const Point& p : sites) {
      x.push_back(p.x);
      y.push_back(p.y);
      z.push_back(p.z);
    }
  }
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
};

// For each node its neighbors as a circular list; the list of a node on the boundary ends with a
// negative number.
struct Lists {
  explicit Lists(std::size_t n) : list(6 * n), lptr(6 * n), lend(n) {}
  std::vector<int> list;
  std::vector<int> lptr;
  std::vector<int> lend;
  int lnew = 0;
};

Lists run_trmesh(const Coordinates& at) {
  const auto& [x, y, z] = at;
  Lists lists(x.size());
  const int n = static_cast<int>(x.size());
  std::vector<int> near(x.size());
  std::vector<int> next(x.size());
  std::vector<double> dist(x.size());
  int error = 0;
  cstrmesh_(&n, x.data(), y.data(), z.data(), lists.list.data(), lists.lptr.data(),
            lists.lend.data(), &lists.lnew, near.data(), next.data(), dist.data(), &error);
  stop_if(error);
  return lists;
}

Counts count_lists(const Coordinates& at, const Lists& lists) {
  const auto entries = static_cast<std::size_t>(lists.lnew - 1);
  const auto end = lists.list.begin() + lists.lnew - 1;
  const auto boundary = static_cast<std::size_t>(
      std::count_if(lists.list.begin(), end, [](int node) { return node < 0; }));
  const std::size_t n = at.x.size();
  // By Euler, V - E + F = 2, where the outside is a face if there is a boundary.
  return {n, n, entries / 2 + 2 - n - (boundary > 0 ? 1 : 0)};
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: stripack_bench KIND N [csstrid|trmesh] [--seed S]\n");
    return 2;
  }
  rondel::bench::Source source(argv[1], argv[2], seed);
  if (argc > 3 && std::string(argv[3]) == "trmesh") {
    print_build(measure([&] { return Coordinates(source.next()); }, run_trmesh, count_lists));
  } else {
    print_build(measure([&] { return Positions(source.next()); }, run_csstrid, count_triangles));
  }
}
