// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each site that ends no constraint is an arc to itself for arrange(), so that it is a node and divides the others, as
// ends of arcs do.

#include "constrained/split_constraints.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "rondel/arrangement.h"
#include "system/distinct.h"
#include "system/hash.h"

namespace rondel::constrained {
namespace {

// Returns for each node the first site with its coordinates; nodes without one, which are different,
// are appended to the points.
std::vector<Index> sites_at(const std::vector<Point>& nodes, std::vector<Point>& points) {
  std::vector<Point> places;  // different ones: of the sites, then of other nodes
  std::vector<Index> at_places;
  places.reserve(points.size());
  at_places.reserve(points.size());
  system::KnownValues<Point> known(places, points.size());
  const auto site_at = [&](const Point& point, std::size_t otherwise) {
    const Index place = known.number(point, system::hash_of(point));
    if (place == at_places.size()) at_places.push_back(static_cast<Index>(otherwise));
    return at_places[place];
  };
  for (std::size_t i = 0; i < points.size(); ++i) (void)site_at(points[i], i);
  std::vector<Index> sites;
  sites.reserve(nodes.size());
  for (const Point& node : nodes) {
    sites.push_back(site_at(node, points.size()));
    if (sites.back() == points.size()) points.push_back(node);
  }
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
  split.ends.reserve(arrangement.edges.size());
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
