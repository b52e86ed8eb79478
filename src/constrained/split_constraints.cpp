// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each site that ends no constraint is an arc to itself for arrange(), so that it is a node and divides the others, as
// ends of arcs do.

#include "constrained/split_constraints.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "rondel/arrangement.h"

namespace rondel::constrained {
namespace {

auto coordinates(const Point& p) { return std::tie(p.x, p.y, p.z); }

// Returns for each node a site with its coordinates; nodes without one are appended to the points.
std::vector<Index> sites_at(const std::vector<Point>& nodes, std::vector<Point>& points) {
  std::vector<Index> sorted(points.size());
  for (Index i = 0; i < sorted.size(); ++i) sorted[i] = i;
  const auto of_site = [&](Index i) { return coordinates(points[i]); };
  std::ranges::sort(sorted, {}, of_site);
  std::vector<Index> sites;
  sites.reserve(nodes.size());
  std::vector<Point> added;
  for (const Point& node : nodes) {
    const auto found = std::ranges::lower_bound(sorted, coordinates(node), {}, of_site);
    if (found != sorted.end() && points[*found] == node) {
      sites.push_back(*found);
    } else {
      sites.push_back(static_cast<Index>(points.size() + added.size()));
      added.push_back(node);
    }
  }
  points.insert(points.end(), added.begin(), added.end());
  return sites;
}

}  // namespace

SplitConstraints split_constraints(const Sites& sites,
                                   std::span<const std::array<Index, 2>> constraints,
                                   const Execution& execution) {
  std::vector<Point> points(sites.points().begin(), sites.points().end());
  std::vector<std::array<Index, 2>> arcs(constraints.begin(), constraints.end());
  std::vector<std::uint8_t> is_end(points.size(), 0);
  for (const auto& ends : constraints) {
    for (const Index site : ends) is_end[site] = 1;
  }
  for (Index i = 0; i < points.size(); ++i) {
    if (is_end[i] == 0) arcs.push_back({i, i});
  }
  const Arrangement arrangement = arrange(points, arcs, execution);

  SplitConstraints split;
  const std::vector<Index> at = sites_at(arrangement.nodes, points);
  for (const auto& [a, b] : arrangement.edges) split.ends.push_back({at[a], at[b]});
  std::vector<std::pair<Index, Index>> sources;  // edge, constraint
  for (Index i = 0; i < constraints.size(); ++i) {
    for (const Index h : arrangement.chains[i]) sources.emplace_back(h / 2, i);
  }
  std::ranges::sort(sources);
  auto source = sources.begin();
  for (Index e = 0; e < split.ends.size(); ++e) {
    for (; source != sources.end() && source->first == e; ++source) {
      split.sources.values.push_back(source->second);
    }
    split.sources.end_row();
  }
  split.sites = Sites(std::move(points));
  return split;
}

}  // namespace rondel::constrained
