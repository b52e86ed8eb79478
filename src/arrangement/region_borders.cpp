// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/region_borders.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

// Joins the halfedges around a region into simple rings.
class RingWalk {
 public:
  explicit RingWalk(const Halfedges& halfedges)
      : halfedges_(halfedges),
        is_left_(halfedges.size(), 0),
        places_(halfedges.num_nodes(), no_index) {}

  // Returns rings of nodes.
  std::vector<std::vector<Index>> rings(std::span<const BorderHalfedge> border) {
    rings_.clear();
    for (const BorderHalfedge& part : border) is_left_[part.halfedge] = 1;
    for (const BorderHalfedge& part : border) {
      if (is_left_[part.halfedge] == 1) walk(part.halfedge);
    }
    for (const BorderHalfedge& part : border) is_left_[part.halfedge] = 0;
    return std::move(rings_);
  }

 private:
  // Walks around a part of the region. Where the way comes back to a node, the part of it since
  // then is a ring.
  void walk(Index start) {
    Index h = start;
    do {
      is_left_[h] = 2;
      add(halfedges_.origin(h));
      Index following = halfedges_.next(h);
      while (is_left_[following] == 0) following = halfedges_.next(Halfedges::twin(following));
      h = following;
    } while (h != start);
    cut(0);
  }
  void add(Index node) {
    if (places_[node] != no_index) cut(places_[node]);
    places_[node] = static_cast<Index>(path_.size());
    path_.push_back(node);
  }
  void cut(std::size_t begin) {
    const auto first = path_.begin() + static_cast<std::ptrdiff_t>(begin);
    rings_.emplace_back(first, path_.end());
    for (const Index node : rings_.back()) places_[node] = no_index;
    path_.erase(first, path_.end());
  }

  const Halfedges& halfedges_;
  std::vector<std::uint8_t> is_left_;  // 0: no border, 1: border, 2: border that is in a ring
  std::vector<Index> places_;          // of each node, on the path
  std::vector<Index> path_;
  std::vector<std::vector<Index>> rings_;
};

}  // namespace

CompressedRows<EdgeOfPolygon> polygons_of_edges(const Arrangement& arranged,
                                                std::span<const Index> polygons) {
  system::RowPlaces<std::uint64_t> places(arranged.edges.size());
  for (std::size_t arc = 0; arc < polygons.size(); ++arc) {
    if (polygons[arc] == no_index) continue;
    for (const Index h : arranged.chains[arc]) places.count(h / 2);
  }
  std::vector<EdgeOfPolygon> all(places.sum());
  for (std::size_t arc = 0; arc < polygons.size(); ++arc) {
    if (polygons[arc] == no_index) continue;
    for (const Index h : arranged.chains[arc]) {
      all[places.place(h / 2)] = {polygons[arc], h % 2 == 0 ? 1 : -1};
    }
  }
  const std::vector<std::uint64_t> offsets = std::move(places).offsets();
  CompressedRows<EdgeOfPolygon> result;
  result.offsets.reserve(offsets.size());
  result.values.reserve(all.size());
  for (std::size_t edge = 0; edge < arranged.edges.size(); ++edge) {
    const auto row = std::span(all).subspan(offsets[edge], offsets[edge + 1] - offsets[edge]);
    std::ranges::sort(row, {}, &EdgeOfPolygon::polygon);
    for (std::size_t k = 0; k < row.size();) {
      EdgeOfPolygon sum = {row[k].polygon, 0};
      for (; k < row.size() && row[k].polygon == sum.polygon; ++k) sum.sum += row[k].sum;
      if (sum.sum % 2 != 0) result.values.push_back(sum);
    }
    result.end_row();
  }
  return result;
}

std::vector<Region> bordered_regions(const Arrangement& arranged, const Halfedges& halfedges,
                                     std::span<const BorderHalfedge> border) {
  std::vector<Region> regions;
  RingWalk walk(halfedges);
  for (std::size_t begin = 0; begin < border.size();) {
    std::size_t end = begin + 1;
    while (end < border.size() && border[end].key == border[begin].key) ++end;
    Region& region = regions.emplace_back(Region{border[begin].key, {}});
    for (const auto& nodes : walk.rings(border.subspan(begin, end - begin))) {
      std::vector<Point> ring;
      ring.reserve(nodes.size());
      for (const Index node : nodes) ring.push_back(arranged.nodes[node]);
      region.rings.push_back(std::move(ring));
    }
    begin = end;
  }
  return regions;
}

}  // namespace rondel::arrangement
