// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of a component are visited depth first, by crossing edges; each face that has been
// visited is left through the edge by which it was entered, so that the owners are again those of the
// face before. A component begins and ends in the sector where the path from the one before it
// arrives.
#include "arrangement/coverage.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "exact/vector.h"
#include "rondel/predicates.h"
#include "system/disjoint_sets.h"
#include "system/parallel.h"

namespace rondel::arrangement {

Coverage::Coverage(const Halfedges& halfedges, const CompressedRows<EdgeOfPolygon>& sides,
                   const std::vector<std::uint8_t>& operands, Owners whole,
                   std::span<const std::optional<KnownPlace>> known, unsigned threads)
    : halfedges_(halfedges),
      sides_(sides),
      operands_(operands),
      whole_(std::move(whole)),
      is_visited_(halfedges.size(), 0),
      is_inside_first_(operands.size(), 0) {
  link_components(threads);
  find_insides(known);
}

void Coverage::visit(const std::function<void(Index, const Owners&)>& visit) {
  begin();
  traverse([&](Index h) { visit(h, owners_); });
}

void Coverage::link_components(unsigned threads) {
  system::DisjointSets components(halfedges_.num_nodes());
  for (Index h = 0; h < halfedges_.size(); h += 2) {
    components.join(halfedges_.origin(h), halfedges_.end(h));
  }
  for (Index node = 0; node < halfedges_.num_nodes(); ++node) {
    if (components[node] != node || halfedges_.around(node).empty()) continue;
    // A path must not lead to the opposite point.
    const bool is_opposite =
        !links_.empty() &&
        is_same_site(halfedges_.point(node), -1.0 * halfedges_.point(links_.back().node));
    const Index first = halfedges_.around(node)[0];
    const Index start = is_opposite ? halfedges_.end(first) : node;
    links_.push_back({start, halfedges_.around(start)[0], no_index, {}});
  }
  if (links_.size() < 2) return;
  std::vector<SpaceBox> boxes;
  boxes.reserve(halfedges_.size() / 2);
  for (Index h = 0; h < halfedges_.size(); h += 2) {
    boxes.push_back(
        box_of(halfedges_.point(halfedges_.origin(h)), halfedges_.point(halfedges_.end(h))));
  }
  const BoxTree tree(boxes, threads);
  constexpr std::size_t grain = 64;
  system::parallel_for(threads, links_.size() - 1, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      ComponentLink& link = links_[k];
      const Index from = link.node;
      const Index to = links_[k + 1].node;
      const Point& p = halfedges_.point(from);
      const Point& q = halfedges_.point(to);
      link.first = halfedges_.sector_towards(from, q);
      links_[k + 1].start = halfedges_.sector_from(to, p);
      tree.visit(box_of(p, q), [&](Index edge) {
        const Index h = 2 * edge;
        const bool has_end = halfedges_.origin(h) == from || halfedges_.end(h) == from ||
                             halfedges_.origin(h) == to || halfedges_.end(h) == to;
        if (!has_end && halfedges_.is_crossed(edge, p, q)) link.crossings.push_back(edge);
      });
    }
  });
}

void Coverage::begin() {
  places_.assign(operands_.size(), no_index);
  owners_ = whole_;
  for (Index p = 0; p < operands_.size(); ++p) {
    if (is_inside_first_[p] != 0) toggle(p);
  }
}

void Coverage::toggle(Index polygon) {
  std::vector<Index>& owners = owners_[operands_[polygon]];
  Index& place = places_[polygon];
  if (place == no_index) {
    place = static_cast<Index>(owners.size());
    owners.push_back(polygon);
  } else {
    owners[place] = owners.back();
    places_[owners[place]] = place;
    owners.pop_back();
    place = no_index;
  }
}

void Coverage::cross(Index edge) {
  for (const EdgeOfPolygon& side : sides_[edge]) toggle(side.polygon);
}

// Moves counterclockwise from one sector of a node to another one.
void Coverage::turn(Index node, Index from, Index to) {
  const std::span<const Index> row = halfedges_.around(node);
  auto k = static_cast<std::size_t>(std::ranges::find(row, from) - row.begin());
  while (row[k] != to) {
    k = k + 1 == row.size() ? 0 : k + 1;
    cross(row[k] / 2);
  }
}

// Calls visit(h) for each halfedge, while the current face is that of h.
template <class Visit>
void Coverage::traverse(const Visit& visit) {
  std::ranges::fill(is_visited_, std::uint8_t{0});
  for (const ComponentLink& link : links_) {
    traverse_component(link.start, visit);
    if (link.first == no_index) continue;
    turn(link.node, link.start, link.first);
    for (const Index edge : link.crossings) cross(edge);
  }
}

// Begins and ends at the face of a halfedge.
template <class Visit>
void Coverage::traverse_component(Index start, const Visit& visit) {
  // A face under way: the halfedge through which it was entered, and the next one to look at.
  struct FaceUnderWay {
    Index entry;
    Index next;
  };
  std::vector<FaceUnderWay> frames;
  const auto enter = [&](Index entry) {
    Index h = entry;
    do {
      is_visited_[h] = 1;
      visit(h);
      h = halfedges_.next(h);
    } while (h != entry);
    frames.push_back({entry, entry});
  };
  enter(start);
  for (;;) {
    const Index h = frames.back().next;
    const Index beyond = Halfedges::twin(h);
    frames.back().next = halfedges_.next(h);
    const bool is_last = frames.back().next == frames.back().entry;
    const Index entry = frames.back().entry;
    if (is_visited_[beyond] == 0) {
      // The face is left for good when its last halfedge has been looked at. It stays on the stack,
      // since the way back leads through it.
      if (is_last) frames.back().next = no_index;
      cross(h / 2);
      enter(beyond);
      continue;
    }
    if (!is_last) continue;
    // Back through the entries of all faces that are done.
    Index left = entry;
    for (;;) {
      frames.pop_back();
      if (frames.empty()) return;
      cross(left / 2);
      if (frames.back().next != no_index) break;
      left = frames.back().entry;
    }
  }
}

// Finds which polygons have the face where a traversal begins. Where no place is known, the interior
// of a polygon is to the left of its sides.
void Coverage::find_insides(std::span<const std::optional<KnownPlace>> known) {
  contradictory_ = decide_by_sides();
  std::erase_if(contradictory_, [&](Index p) { return p < known.size() && known[p]; });
  std::vector<KnownSector> sectors = outsides_of(contradictory_);
  std::vector<Index> all(known.size());
  std::iota(all.begin(), all.end(), Index{0});
  const std::vector<std::vector<Index>> edges = edges_of(all);
  for (Index p = 0; p < known.size(); ++p) {
    if (!known[p]) continue;
    if (edges[p].empty()) {
      is_inside_first_[p] = static_cast<std::uint8_t>(known[p]->is_inside);
    } else {
      sectors.push_back(sector_at(p, edges[p], *known[p]));
    }
  }
  if (!sectors.empty()) decide_by_sectors(std::move(sectors));
}

// Decides by the majority of a polygon's edges, and returns the polygons whose edges disagree.
std::vector<Index> Coverage::decide_by_sides() {
  std::vector<std::array<Index, 2>> votes(operands_.size(), {0, 0});
  begin();
  traverse([&](Index h) {
    for (const EdgeOfPolygon& side : sides_[h / 2]) {
      const bool is_left_inside = (side.sum > 0) == (h % 2 == 0);
      ++votes[side.polygon][is_left_inside != is_inside(side.polygon) ? 1 : 0];
    }
  });
  std::vector<Index> undecided;
  for (std::size_t p = 0; p < votes.size(); ++p) {
    is_inside_first_[p] = static_cast<std::uint8_t>(votes[p][1] > votes[p][0]);
    if (votes[p][0] != 0 && votes[p][1] != 0) undecided.push_back(static_cast<Index>(p));
  }
  return undecided;
}

// Returns the edges of each of these polygons, and no edges of others.
std::vector<std::vector<Index>> Coverage::edges_of(const std::vector<Index>& polygons) const {
  std::vector<std::vector<Index>> edges(operands_.size());
  std::vector<std::uint8_t> is_asked(operands_.size(), 0);
  for (const Index p : polygons) is_asked[p] = 1;
  for (Index edge = 0; edge < sides_.size(); ++edge) {
    for (const EdgeOfPolygon& side : sides_[edge]) {
      if (is_asked[side.polygon] != 0) edges[side.polygon].push_back(edge);
    }
  }
  return edges;
}

// Decides polygons in a hemisphere: the point opposite to the mean of their nodes is outside.
std::vector<Coverage::KnownSector> Coverage::outsides_of(const std::vector<Index>& polygons) const {
  const std::vector<std::vector<Index>> edges = edges_of(polygons);
  std::vector<KnownSector> known;
  for (const Index p : polygons) {
    Point mean = {};
    for (const Index edge : edges[p]) {
      mean = mean + halfedges_.point(halfedges_.origin(2 * edge)) +
             halfedges_.point(halfedges_.end(2 * edge));
    }
    const Point middle = normalized(mean);
    constexpr double least_cosine = 1e-9;
    const bool is_in_hemisphere = std::ranges::all_of(edges[p], [&](Index edge) {
      return dot(middle, halfedges_.point(halfedges_.origin(2 * edge))) > least_cosine &&
             dot(middle, halfedges_.point(halfedges_.end(2 * edge))) > least_cosine;
    });
    if (is_in_hemisphere) known.push_back(sector_at(p, edges[p], {-1.0 * middle, middle, false}));
  }
  return known;
}

// Follows a path from a corner of a polygon to a place. `edges` has the polygon's edges, and there
// must be one.
Coverage::KnownSector Coverage::sector_at(Index polygon, std::span<const Index> edges,
                                          const KnownPlace& known) const {
  std::vector<Index> nodes;
  for (const Index edge : edges) {
    nodes.insert(nodes.end(), {halfedges_.origin(2 * edge), halfedges_.end(2 * edge)});
  }
  const auto is_at = [&](const Point& place) {
    return [&](Index node) { return is_same_site(halfedges_.point(node), place); };
  };
  const auto here = std::ranges::find_if(nodes, is_at(known.place));
  if (here != nodes.end()) {
    return {halfedges_.sector_towards(*here, known.towards), polygon, known.is_inside};
  }
  // No path leads to the opposite point.
  const Point opposite = -1.0 * known.place;
  const Index start = *std::ranges::find_if_not(nodes, is_at(opposite));
  const auto num_crossings = std::ranges::count_if(edges, [&](Index edge) {
    return halfedges_.origin(2 * edge) != start && halfedges_.end(2 * edge) != start &&
           halfedges_.is_crossed(edge, halfedges_.point(start), known.place);
  });
  return {halfedges_.sector_towards(start, known.place), polygon,
          known.is_inside != (num_crossings % 2 != 0)};
}

void Coverage::decide_by_sectors(std::vector<KnownSector> known) {
  std::ranges::sort(known, {}, &KnownSector::sector);
  begin();
  const std::vector<std::uint8_t> before = is_inside_first_;
  traverse([&](Index h) {
    for (auto k = std::ranges::lower_bound(known, h, {}, &KnownSector::sector);
         k != known.end() && k->sector == h; ++k) {
      const bool is_right = is_inside(k->polygon) == k->is_inside;
      is_inside_first_[k->polygon] = before[k->polygon] ^ static_cast<std::uint8_t>(!is_right);
    }
  });
}

}  // namespace rondel::arrangement
