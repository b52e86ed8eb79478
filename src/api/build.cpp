// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps of a build: leave out weighted sites that are strictly inside the hull of others, sort the
// rest into the spatial order, which finds duplicates, triangulate, add the sites that were left
// out as hidden, and find a face above each hidden site.

#include "api/build.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "api/triangulation_impl.h"
#include "api/validation.h"
#include "bulk/triangulate.h"
#include "hidden/hidden_faces.h"
#include "hidden/inner_sites.h"
#include "order/spatial_order.h"
#include "rondel/error.h"
#include "system/gather.h"
#include "system/parallel.h"

namespace rondel::api {
namespace {

using Clock = std::chrono::steady_clock;

// Returns wall time in seconds.
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Returns the sites to insert, in increasing order, when others can be left out because they are
// strictly inside the hull; an empty vector if all sites are to be inserted.
std::vector<Index> find_rest(std::span<const Point> sites, const Options& options,
                             const hidden::InnerPoint* inner) {
  if (options.model != Model::weighted) return {};
  if (!hidden::has_many_inner_sites(sites, options.sphere.center)) return {};
  hidden::InnerPoint found;
  if (inner == nullptr) {
    found = hidden::find_inner_point(sites);
    inner = &found;
  }
  if (!inner->is_inside) return {};
  auto rest = hidden::rest_without_inner_sites(sites, *inner);
  return rest.size() < sites.size() ? std::move(rest) : std::vector<Index>();
}

// Returns the spatial order. Rays are validated when they are read anyway, as memory is slow;
// weighted sites were validated before. Throws InvalidInput with the first site that is not valid.
order::SpatialOrder order_valid(std::span<const Point> sites, const system::Job& options,
                                const system::SiteCopies& copies) {
  order::SitesCheck check;
  if (options.model == Model::projected) {
    check = [&options](std::span<const Point> some) {
      if (!are_valid(some, options)) throw InvalidInput("a site is not valid", 0);
    };
  }
  try {
    return order::spatial_order(sites, options.model, options.sphere.center, options.threads, check,
                                copies);
  } catch (const InvalidInput&) {
    validate(sites, options);  // names the first one
    throw;
  }
}

// The triangulation of sites[rest[0]], sites[rest[1]], ... becomes that of all sites. As `rest` is
// increasing, what is sorted by site remains so.
void add_inner_sites(std::span<const Point> sites, std::span<const Index> rest,
                     TriangulationArrays& arrays) {
  for (Triple& face : arrays.faces) {
    for (Index& corner : face) corner = rest[corner];
  }
  for (Hidden& h : arrays.hidden) h.site = rest[h.site];
  for (Duplicate& d : arrays.duplicates) d = {rest[d.site], rest[d.representative]};

  // The sites that were left out are the complement of `rest`; each is hidden, or a duplicate of
  // another one of them.
  std::vector<Index> inner;
  inner.reserve(sites.size() - rest.size());
  auto next = rest.begin();
  for (Index i = 0; i < sites.size(); ++i) {
    if (next != rest.end() && *next == i) {
      ++next;
    } else {
      inner.push_back(i);
    }
  }
  const auto duplicates = order::find_duplicates(sites, inner);
  arrays.hidden.reserve(arrays.hidden.size() + inner.size() - duplicates.size());
  const auto outer_hidden = static_cast<std::ptrdiff_t>(arrays.hidden.size());
  auto duplicate = duplicates.begin();
  for (const Index i : inner) {
    if (duplicate != duplicates.end() && duplicate->site == i) {
      ++duplicate;
    } else {
      arrays.hidden.push_back({i, no_index});
    }
  }
  // Both parts are sorted by site, so merging sorts the whole.
  std::ranges::inplace_merge(arrays.hidden, arrays.hidden.begin() + outer_hidden, {},
                             &Hidden::site);
  const auto outer_duplicates = static_cast<std::ptrdiff_t>(arrays.duplicates.size());
  arrays.duplicates.insert(arrays.duplicates.end(), duplicates.begin(), duplicates.end());
  std::ranges::inplace_merge(arrays.duplicates, arrays.duplicates.begin() + outer_duplicates, {},
                             &Duplicate::site);
}

// Builds; the parts have the order only if it is kept.
Parts parts_of(std::span<const Point> sites, const system::Job& options,
               const hidden::InnerPoint* inner, bool keeps_order) {
  Parts parts;
  BuildReport& report = parts.report;
  report.threads = system::num_threads(options.threads);
  const auto start = Clock::now();
  system::announce(options, "order", 0);
  const auto rest = find_rest(sites, options, inner);
  const auto rest_points = system::gather(sites, rest);
  const std::span<const Point> inserted = rest.empty() ? sites : rest_points;
  // The copies have as much memory as the faces, which are written over them later.
  LargeVector<Triple> copies(inserted.size() < bulk::min_copied_sites ? 0 : 2 * inserted.size());
  auto order = order_valid(inserted, options, system::SiteCopies(std::span(copies)));
  if (order.order.size() < inserted.size() / 2) copies = {};  // too much for the faces
  report.order_seconds = seconds_since(start);

  const auto order_end = Clock::now();
  if (keeps_order) parts.order = order.order;
  auto built = bulk::triangulate(inserted, std::move(order.order), order.renamed, options,
                                 std::move(copies));
  built.arrays.num_sites = sites.size();
  built.arrays.duplicates = std::move(order.duplicates);
  if (!rest.empty()) add_inner_sites(sites, rest, built.arrays);
  hidden::assign_hidden_faces(sites, options.sphere.center, built.arrays, options.threads);
  system::announce(options, "triangulate", 1);
  report.triangulate_seconds = seconds_since(order_end);
  report.rungs = built.tally;
  report.builder = built.arrays.dimension < 2 ? Builder::ring : built.builder;
  parts.arrays = std::move(built.arrays);
  parts.renamed = std::move(order.renamed);
  return parts;
}

}  // namespace

Triangulation build(Sites all_sites, const system::Job& options, const hidden::InnerPoint* inner) {
  Parts parts = parts_of(all_sites.points(), options, inner, false);
  return make_triangulation(std::move(all_sites), std::move(parts.arrays), options, parts.report);
}

Parts build_parts(std::span<const Point> sites, const system::Job& options) {
  return parts_of(sites, options, nullptr, true);
}

std::span<const Point> as_points(std::span<const double> xyz) {
  if (xyz.size() % 3 != 0) {
    throw InvalidInput("an array of points has length " + std::to_string(xyz.size()) +
                           ", which is not a multiple of 3",
                       xyz.size() - xyz.size() % 3);
  }
  // The one place where numbers are read as points without a copy: compilers lay out points so.
  static_assert(sizeof(Point) == 3 * sizeof(double) && alignof(Point) == alignof(double));
  static_assert(std::is_trivially_copyable_v<Point> && std::is_standard_layout_v<Point>);
  return {reinterpret_cast<const Point*>(xyz.data()), xyz.size() / 3};
}

}  // namespace rondel::api
