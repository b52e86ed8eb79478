// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/lower_parts.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "arrangement/numbering.h"
#include "arrangement/set_regions.h"
#include "exact/vector.h"
#include "rondel/predicates.h"
#include "system/parallel.h"

namespace rondel::arrangement {
namespace {

template <class T>
void sort_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// Removes the keys that the sorted others have.
void erase_keys(std::vector<RegionKey>& keys, std::span<const RegionKey> others) {
  std::erase_if(keys,
                [&](const RegionKey& key) { return std::ranges::binary_search(others, key); });
}

}  // namespace

LowerParts::LowerParts(const Arrangement& arranged, const Halfedges& halfedges,
                       const CompressedRows<EdgeOfPolygon>& polygons, const Sides& sides,
                       const RegionRule& rule, unsigned threads)
    : arranged_(arranged), halfedges_(halfedges), polygons_(polygons), sides_(sides), rule_(rule) {
  collect_lines();
  collect_points();
  for (Index node = 0; node < halfedges.num_nodes(); ++node) {
    if (halfedges.around(node).empty() && !rows_at(points_, node).empty()) {
      lone_.push_back({no_index, node, {}});
    }
  }
  if (halfedges.size() > 0) find_ways(threads);
  faces_.places.assign(halfedges.size(), no_index);
  lone_faces_.places.assign(lone_.size(), no_index);
}

void LowerParts::OwnerRows::set(std::size_t item, const Owners& owners) {
  places[item] = static_cast<Index>(rows[0].size());
  for (std::size_t k = 0; k < 2; ++k) rows[k].append(owners[k]);
}

void LowerParts::collect_lines() {
  for (std::size_t arc = 0; arc < sides_.lines.size(); ++arc) {
    if (sides_.lines[arc] == no_index) continue;
    for (const Index h : arranged_.chains[arc]) {
      lines_.push_back({h / 2, sides_.lines[arc], h % 2 == 0 ? 1 : -1});
    }
  }
  std::ranges::sort(lines_);
  std::size_t size = 0;
  for (const LineOfItem& line : lines_) {
    if (size > 0 && lines_[size - 1].item == line.item &&
        lines_[size - 1].feature == line.feature) {
      lines_[size - 1].sum += line.sum;
    } else {
      lines_[size++] = line;
    }
  }
  lines_.resize(size);
}

// Points have the nodes on their rays.
void LowerParts::collect_points() {
  std::vector<Point> places = arranged_.nodes;
  std::vector<Index> features;
  for (std::size_t arc = 0; arc < sides_.lines.size(); ++arc) {
    const auto [from, to] = sides_.arcs[arc];
    if (sides_.lines[arc] == no_index || !arranged_.chains[arc].empty()) continue;
    places.push_back(sides_.points[from]);
    features.push_back(sides_.lines[arc]);
  }
  if (features.empty()) return;
  const std::size_t num_nodes = arranged_.nodes.size();
  const std::vector<Index> numbers = numbered(places, num_nodes, 1).numbers;
  std::vector<Index> nodes(places.size(), no_index);  // of each number
  for (std::size_t node = 0; node < num_nodes; ++node) {
    nodes[numbers[node]] = static_cast<Index>(node);
  }
  for (std::size_t k = 0; k < features.size(); ++k) {
    points_.push_back({nodes[numbers[num_nodes + k]], features[k], 0});
  }
  sort_unique(points_);
}

// Finds a way to each lone point from the end of an edge that is near to it.
void LowerParts::find_ways(unsigned threads) {
  if (lone_.empty()) return;
  std::vector<SpaceBox> boxes;
  for (Index h = 0; h < halfedges_.size(); h += 2) {
    boxes.push_back(
        box_of(halfedges_.point(halfedges_.origin(h)), halfedges_.point(halfedges_.end(h))));
  }
  const BoxTree tree(boxes, threads);
  constexpr std::size_t grain = 64;
  system::parallel_for(threads, lone_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      LonePoint& lone = lone_[k];
      const Point& place = halfedges_.point(lone.node);
      const Index near = tree.near({place.x, place.y, place.z});
      Index start = halfedges_.origin(2 * near);
      // A way must not lead to the opposite point.
      if (is_same_site(halfedges_.point(start), -1.0 * place)) start = halfedges_.end(2 * near);
      const Point& p = halfedges_.point(start);
      lone.sector = halfedges_.sector_towards(start, place);
      tree.visit(box_of(p, place), [&](Index edge) {
        const bool has_end =
            halfedges_.origin(2 * edge) == start || halfedges_.end(2 * edge) == start;
        if (!has_end && halfedges_.is_crossed(edge, p, place)) lone.crossings.push_back(edge);
      });
    }
  });
  std::ranges::sort(lone_, {}, &LonePoint::sector);
}

void LowerParts::see(Index h, const Owners& owners) {
  faces_.set(h, owners);
  for (auto k = std::ranges::lower_bound(lone_, h, {}, &LonePoint::sector);
       k != lone_.end() && k->sector == h; ++k) {
    Owners beyond = owners;
    for (const Index edge : k->crossings) {
      for (const EdgeOfPolygon& side : polygons_[edge]) {
        std::vector<Index>& row = beyond[sides_.operands[side.polygon]];
        const auto place = std::ranges::find(row, side.polygon);
        if (place == row.end()) {
          row.push_back(side.polygon);
        } else {
          row.erase(place);
        }
      }
    }
    lone_faces_.set(static_cast<std::size_t>(k - lone_.begin()), beyond);
  }
}

void LowerParts::see_only_face(const Owners& owners) {
  for (std::size_t k = 0; k < lone_.size(); ++k) lone_faces_.set(k, owners);
}

std::span<const LowerParts::LineOfItem> LowerParts::rows_at(std::span<const LineOfItem> all,
                                                            Index item) {
  const auto first = std::ranges::lower_bound(all, item, {}, &LineOfItem::item);
  auto last = first;
  while (last != all.end() && last->item == item) ++last;
  return {first, last};
}

void LowerParts::append(const LineOfItem& line, Owners& owners) const {
  owners[sides_.operands[line.feature]].push_back(line.feature);
}

void LowerParts::join(const OwnerRow& row, Owners& owners) const {
  for (std::size_t k = 0; k < 2; ++k) {
    owners[k].insert(owners[k].end(), row[k].begin(), row[k].end());
  }
}

void LowerParts::keys_of_face(Index h, std::vector<RegionKey>& keys) const {
  const OwnerRow row = faces_[h];
  rule_.append_keys(
      {std::vector(row[0].begin(), row[0].end()), std::vector(row[1].begin(), row[1].end())}, keys);
}

// Finds the edges of regions, and the regions at each edge.
void LowerParts::find_edges() {
  Owners owners;
  std::vector<RegionKey> keys;
  std::vector<RegionKey> of_faces;
  std::size_t next = 0;
  for (Index edge = 0; edge < arranged_.edges.size(); ++edge) {
    for (std::vector<Index>& row : owners) row.clear();
    join(faces_[std::size_t{2} * edge], owners);
    join(faces_[2 * edge + 1], owners);
    for (; next < lines_.size() && lines_[next].item == edge; ++next) append(lines_[next], owners);
    for (std::vector<Index>& row : owners) sort_unique(row);
    keys.clear();
    of_faces.clear();
    rule_.append_keys(owners, keys);
    keys_of_face(2 * edge, of_faces);
    keys_of_face(2 * edge + 1, of_faces);
    sort_unique(of_faces);
    erase_keys(keys, of_faces);
    for (const RegionKey& key : keys) edges_.push_back({key, edge});
    of_faces.insert(of_faces.end(), keys.begin(), keys.end());
    std::ranges::sort(of_faces);
    present_.append(of_faces);
  }
  std::ranges::sort(edges_);
}

// Finds the nodes of regions that are at no edge or face of them.
void LowerParts::find_points(std::vector<KeyedLine>& found) {
  Owners owners;
  std::vector<RegionKey> keys;
  std::vector<RegionKey> present;
  const auto take = [&](Index node) {
    for (const LineOfItem& point : rows_at(points_, node)) append(point, owners);
    for (std::vector<Index>& row : owners) sort_unique(row);
    keys.clear();
    rule_.append_keys(owners, keys);
    sort_unique(present);
    erase_keys(keys, present);
    for (const RegionKey& key : keys) found.push_back({key, {node}});
  };
  const auto clear = [&] {
    for (std::vector<Index>& row : owners) row.clear();
    present.clear();
  };
  for (Index node = 0; node < halfedges_.num_nodes(); ++node) {
    if (halfedges_.around(node).empty()) continue;
    clear();
    for (const Index h : halfedges_.around(node)) {
      join(faces_[h], owners);
      for (const LineOfItem& line : rows_at(lines_, h / 2)) append(line, owners);
      const auto row = present_[h / 2];
      present.insert(present.end(), row.begin(), row.end());
    }
    take(node);
  }
  for (std::size_t k = 0; k < lone_.size(); ++k) {
    clear();
    join(lone_faces_[k], owners);
    rule_.append_keys(owners, present);
    take(lone_[k].node);
  }
}

bool LowerParts::is_backwards(const RegionKey& key, std::span<const Index> chain) const {
  std::array<int, 2> sums = {0, 0};
  for (const Index h : chain) {
    for (const LineOfItem& line : rows_at(lines_, h / 2)) {
      const std::uint8_t operand = sides_.operands[line.feature];
      const Index feature = operand == 0 ? key.first : key.second;
      if (!rule_.is_joined() && line.feature != feature) continue;
      sums[operand] += h % 2 == 0 ? line.sum : -line.sum;
    }
  }
  return sums[0] != 0 ? sums[0] < 0 : sums[1] < 0;
}

// Joins the edges of a region into lines.
void LowerParts::join_edges(std::span<const KeyedEdge> edges, std::vector<KeyedLine>& found) const {
  std::vector<std::pair<Index, Index>> starts;  // a node, and a halfedge from it
  for (const KeyedEdge& part : edges) {
    for (const Index h : {2 * part.edge, 2 * part.edge + 1}) {
      starts.emplace_back(halfedges_.origin(h), h);
    }
  }
  std::ranges::sort(starts);
  std::vector<std::uint8_t> is_taken(starts.size(), 0);
  const auto at = [&](Index node) {
    return std::ranges::lower_bound(starts, std::pair(node, Index{0}));
  };
  const auto degree = [&](Index node) {
    auto last = at(node);
    const auto first = last;
    while (last != starts.end() && last->first == node) ++last;
    return last - first;
  };
  const auto place_of = [&](Index h) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(starts, std::pair(halfedges_.origin(h), h)) - starts.begin());
  };
  const auto walk = [&](Index start) {
    std::vector<Index> chain;
    for (Index h = start;;) {
      chain.push_back(h);
      is_taken[place_of(h)] = is_taken[place_of(Halfedges::twin(h))] = 1;
      const Index node = halfedges_.end(h);
      if (node == halfedges_.origin(start) || degree(node) != 2) break;
      const auto row = at(node);
      h = row->second == Halfedges::twin(h) ? (row + 1)->second : row->second;
    }
    std::vector<Index> nodes = {halfedges_.origin(start)};
    for (const Index h : chain) nodes.push_back(halfedges_.end(h));
    if (is_backwards(edges.front().key, chain)) std::ranges::reverse(nodes);
    found.push_back({edges.front().key, std::move(nodes)});
  };
  for (std::size_t k = 0; k < starts.size(); ++k) {
    if (is_taken[k] == 0 && degree(starts[k].first) != 2) walk(starts[k].second);
  }
  for (std::size_t k = 0; k < starts.size(); ++k) {
    if (is_taken[k] == 0) walk(starts[k].second);
  }
}

std::vector<KeyedLine> LowerParts::lines() {
  find_edges();
  std::vector<KeyedLine> found;
  for (std::size_t begin = 0; begin < edges_.size();) {
    std::size_t end = begin + 1;
    while (end < edges_.size() && edges_[end].key == edges_[begin].key) ++end;
    join_edges(std::span(edges_).subspan(begin, end - begin), found);
    begin = end;
  }
  find_points(found);
  std::ranges::sort(found, [](const KeyedLine& a, const KeyedLine& b) {
    if (a.key != b.key) return a.key < b.key;
    const bool is_point = a.nodes.size() == 1;
    if (is_point != (b.nodes.size() == 1)) return !is_point;
    return a.nodes < b.nodes;
  });
  return found;
}

}  // namespace rondel::arrangement
