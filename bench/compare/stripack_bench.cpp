// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// stripack_bench KIND N [csstrid|trmesh]: the Delaunay triangulation of the same sites by STRIPACK
// (Renka, ACM TOMS 23, 1997) as it is in NCAR's library of mathematics.
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

Triangles run_csstrid(std::vector<double>& lat_deg, std::vector<double>& lon_deg) {
  int count = 0;
  int error = 0;
  Triangles triangles;
  triangles.corners.reset(
      c_csstrid(static_cast<int>(lat_deg.size()), lat_deg.data(), lon_deg.data(), &count, &error));
  stop_if(error);
  triangles.count = static_cast<std::size_t>(count);
  return triangles;
}

void measure_csstrid(const std::vector<Point>& sites) {
  constexpr double degrees = 180 / std::numbers::pi;
  std::vector<double> lat_deg;
  std::vector<double> lon_deg;
  for (const Point& p : sites) {
    lat_deg.push_back(degrees * std::atan2(p.z, std::hypot(p.x, p.y)));
    lon_deg.push_back(degrees * std::atan2(p.y, p.x));
  }
  const auto measured = measure([&] { return run_csstrid(lat_deg, lon_deg); });
  std::vector<bool> is_vertex(sites.size(), false);
  for (std::size_t i = 0; i < 3 * measured.result->count; ++i) {
    is_vertex[static_cast<std::size_t>(measured.result->corners[i])] = true;
  }
  print_build(sites.size(), static_cast<std::size_t>(std::ranges::count(is_vertex, true)),
              measured.result->count, measured);
}

// For each node its neighbors as a circular list; that of a node on the boundary ends with a
// negative number.
struct Lists {
  explicit Lists(std::size_t n) : list(6 * n), lptr(6 * n), lend(n) {}
  std::vector<int> list;
  std::vector<int> lptr;
  std::vector<int> lend;
  int lnew = 0;
};

Lists run_trmesh(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& z) {
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

void measure_trmesh(const std::vector<Point>& sites) {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (const Point& p : sites) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  const auto measured = measure([&] { return run_trmesh(x, y, z); });
  const auto entries = static_cast<std::size_t>(measured.result->lnew - 1);
  const auto end = measured.result->list.begin() + measured.result->lnew - 1;
  const auto boundary = static_cast<std::size_t>(
      std::count_if(measured.result->list.begin(), end, [](int node) { return node < 0; }));
  // Euler: V - E + F = 2, the outside being a face where there is a boundary.
  const std::size_t faces = entries / 2 + 2 - sites.size() - (boundary > 0 ? 1 : 0);
  print_build(sites.size(), sites.size(), faces, measured);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: stripack_bench KIND N [csstrid|trmesh]\n");
    return 2;
  }
  const auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10));
  if (argc > 3 && std::string(argv[3]) == "trmesh") {
    measure_trmesh(sites);
  } else {
    measure_csstrid(sites);
  }
}
