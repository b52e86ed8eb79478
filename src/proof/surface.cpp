// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proof/surface.h"

#include <algorithm>
#include <string>
#include <utility>

namespace rondel::proof {
namespace {

Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }

bool have_same_corners(Triple f, Triple g) {
  std::ranges::sort(f);
  std::ranges::sort(g);
  return f == g;
}

}  // namespace

Surface::Surface(std::size_t num_sites, std::span<const Triple> triangles)
    : triangles_(triangles), corner_of_(num_sites, no_index) {
  flaw_ = read_corners(num_sites);
  if (flaw_.empty()) flaw_ = match_edges();
  if (flaw_.empty()) flaw_ = follow_stars();
  if (flaw_.empty()) flaw_ = reach_all_faces();
  if (flaw_.empty()) flaw_ = count_euler();
}

std::string Surface::read_corners(std::size_t num_sites) {
  // Euler's formula bounds the faces; the bound also keeps 3*face + i in an Index.
  if (triangles_.size() > 2 * num_sites) {
    return "there are " + text(triangles_.size()) + " faces, but " + text(num_sites) +
           " sites have at most 2n-4";
  }
  for (Index h = 0; h < 3 * triangles_.size(); ++h) {
    const Index site = apex(h);
    if (site >= num_sites) {
      return "face " + text(h / 3) + " has corner " + text(site) + ", but there are " +
             text(num_sites) + " sites";
    }
    if (site == apex(next(h))) {
      return "face " + text(h / 3) + " has corner " + text(site) + " twice";
    }
    num_vertices_ += corner_of_[site] == no_index ? 1 : 0;
    corner_of_[site] = h;
  }
  return {};
}

// Sorts the halfedges into one bucket for each lower endpoint, 4 bytes a halfedge.
std::string Surface::match_edges() {
  const auto num_halfedges = static_cast<Index>(3 * triangles_.size());
  const auto lower = [&](Index h) { return std::min(origin(h), target(h)); };
  std::vector<Index> end(corner_of_.size() + 1, 0);
  for (Index h = 0; h < num_halfedges; ++h) ++end[lower(h) + 1];
  for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  std::vector<Index> bucketed(num_halfedges);
  for (Index h = 0; h < num_halfedges; ++h) bucketed[end[lower(h)]++] = h;

  opposite_.assign(num_halfedges, no_index);
  const std::span<Index> all(bucketed);
  std::size_t begin = 0;
  for (std::size_t site = 0; site + 1 < end.size(); begin = end[site++]) {
    std::string flaw = match_bucket(all.subspan(begin, end[site] - begin));
    if (!flaw.empty()) return flaw;
  }
  return {};
}

std::string Surface::match_bucket(std::span<Index> bucket) {
  const auto upper = [&](Index h) { return std::max(origin(h), target(h)); };
  std::ranges::sort(bucket, {}, [&](Index h) { return std::pair(upper(h), h); });
  for (std::size_t i = 0; i < bucket.size();) {
    std::size_t j = i + 1;
    while (j < bucket.size() && upper(bucket[j]) == upper(bucket[i])) ++j;
    if (j - i != 2 || origin(bucket[i]) == origin(bucket[i + 1])) {
      return describe_edge(bucket.subspan(i, j - i));
    }
    opposite_[bucket[i]] = bucket[i + 1];
    opposite_[bucket[i + 1]] = bucket[i];
    i = j;
  }
  return {};
}

std::string Surface::describe_edge(std::span<const Index> halfedges) const {
  const Index h = halfedges[0];
  const std::string edge =
      "edge " + text(std::min(origin(h), target(h))) + "-" + text(std::max(origin(h), target(h)));
  const std::string first = text(h / 3);
  if (halfedges.size() == 1) return edge + " belongs to face " + first + " only";
  for (const Index other : halfedges.subspan(1)) {
    if (origin(other) == origin(h) && have_same_corners(face(other / 3), face(h / 3))) {
      return "faces " + first + " and " + text(other / 3) + " are the same";
    }
  }
  const std::string second = text(halfedges[1] / 3);
  if (halfedges.size() > 2) {
    return edge + " belongs to " + text(halfedges.size()) + " faces, among them " + first + ", " +
           second + " and " + text(halfedges[2] / 3);
  }
  return "faces " + first + " and " + second + " run along " + edge +
         " in the same direction: one of them is reversed";
}

Index Surface::next_corner(Index h) const { return next(opposite_[next(h)]); }

std::string Surface::follow_stars() const {
  std::vector<Index> num_corners(corner_of_.size(), 0);
  for (const Triple& corners : triangles_) {
    for (const Index site : corners) ++num_corners[site];
  }
  for (Index site = 0; site < corner_of_.size(); ++site) {
    if (!is_vertex(site)) continue;
    Index in_cycle = 0;
    Index h = corner_of_[site];
    do {
      ++in_cycle;
      h = next_corner(h);
    } while (h != corner_of_[site]);
    if (in_cycle != num_corners[site]) {
      return "the surface is pinched at site " + text(site) + ": its " + text(num_corners[site]) +
             " faces form more than one cycle";
    }
  }
  return {};
}

std::string Surface::reach_all_faces() const {
  if (triangles_.empty()) return {};
  std::vector<bool> is_reached(triangles_.size(), false);
  std::vector<Index> stack{0};
  is_reached[0] = true;
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index g = opposite_[h] / 3;
      if (is_reached[g]) continue;
      is_reached[g] = true;
      stack.push_back(g);
    }
  }
  const auto missed = std::ranges::find(is_reached, false);
  if (missed == is_reached.end()) return {};
  return "the surface is not connected: no path over edges leads from face 0 to face " +
         text(static_cast<std::size_t>(missed - is_reached.begin()));
}

std::string Surface::count_euler() const {
  if (triangles_.empty() || num_vertices() + num_faces() == num_edges() + 2) return {};
  return "V - E + F is not 2: " + text(num_vertices()) + " vertices, " + text(num_edges()) +
         " edges, " + text(num_faces()) + " faces";
}

std::vector<Index> Surface::link(Index vertex) const {
  std::vector<Index> ring;
  Index h = corner_of_[vertex];
  do {
    ring.push_back(origin(h));
    h = next_corner(h);
  } while (h != corner_of_[vertex]);
  return ring;
}

}  // namespace rondel::proof
