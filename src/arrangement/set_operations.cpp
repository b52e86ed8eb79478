// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sides of all polygons are arranged; faces get the polygons that have them (coverage.h). A
// halfedge whose face has a region, while the face beyond does not, is on the border of the region,
// and borders are joined into rings.
#include "rondel/set_operations.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrangement/combined_each.h"
#include "arrangement/coverage.h"
#include "arrangement/even_odd.h"
#include "arrangement/halfedges.h"
#include "arrangement/ring_arrays.h"
#include "rondel/arrangement.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using arrangement::Coverage;
using arrangement::EdgeOfPolygon;
using arrangement::Halfedges;
using arrangement::KnownPlace;
using arrangement::Owners;

// The sides of the polygons of two operands.
struct Sides {
  std::vector<Point> points;
  std::vector<std::array<Index, 2>> arcs;
  std::vector<Index> polygons;         // of each arc
  std::vector<std::uint8_t> operands;  // of each polygon
  Owners whole;
  std::vector<std::optional<KnownPlace>> known = {};  // of each polygon, or none
  bool are_mended = false;  // the rings of a polygon do not contradict each other

  // Appends the cells of an operand.
  void append(const CellRings& cells, std::uint8_t operand) {
    const auto first_point = static_cast<Index>(points.size());
    points.insert(points.end(), cells.points.begin(), cells.points.end());
    append_cells(cells, 0, cells.num_cells(), operand, [&](Index p) { return first_point + p; });
  }
  // Appends one cell of an operand and the points of its corners alone.
  void append_cell(const CellRings& cells, std::size_t cell, std::uint8_t operand) {
    const auto number = [&](Index p) {
      points.push_back(cells.points[p]);
      return static_cast<Index>(points.size() - 1);
    };
    append_cells(cells, cell, cell + 1, operand, number);
  }
  // Appends the sides of a polygon that is there already.
  void append_rings(const std::vector<std::vector<Point>>& rings, Index polygon) {
    for (const std::vector<Point>& ring : rings) {
      const auto first = static_cast<Index>(points.size());
      points.insert(points.end(), ring.begin(), ring.end());
      for (Index k = 0; k < ring.size(); ++k) {
        arcs.push_back({first + k, k + 1 < ring.size() ? first + k + 1 : first});
        polygons.push_back(polygon);
      }
    }
  }
  // Returns the polygons that have the whole sphere if there is no edge.
  [[nodiscard]] Owners owners_without_edges() const {
    Owners owners = whole;
    for (std::size_t p = 0; p < known.size(); ++p) {
      if (known[p] && known[p]->is_inside) owners[operands[p]].push_back(static_cast<Index>(p));
    }
    return owners;
  }

 private:
  template <class Number>
  void append_cells(const CellRings& cells, std::size_t begin, std::size_t end,
                    std::uint8_t operand, const Number& number) {
    for (std::size_t c = begin; c < end; ++c) {
      if (cells.is_whole(c)) whole[operand].push_back(static_cast<Index>(operands.size()));
      for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
        append_ring(cells.corners_of(r), number);
      }
      operands.push_back(operand);
    }
  }
  template <class Number>
  void append_ring(std::span<const Index> ring, const Number& number) {
    if (ring.empty()) return;
    const Index first = number(ring[0]);
    Index from = first;
    for (std::size_t k = 1; k <= ring.size(); ++k) {
      const Index to = k < ring.size() ? number(ring[k]) : first;
      arcs.push_back({from, to});
      polygons.push_back(static_cast<Index>(operands.size()));
      from = to;
    }
  }
};

// Returns the polygons of each edge, of which an odd number of rings runs along it.
CompressedRows<EdgeOfPolygon> polygons_of_edges(const Arrangement& arranged,
                                                std::span<const Index> polygons) {
  system::RowPlaces<std::uint64_t> places(arranged.edges.size());
  for (const Index h : arranged.chains.values) places.count(h / 2);
  std::vector<EdgeOfPolygon> all(places.sum());
  for (std::size_t arc = 0; arc < polygons.size(); ++arc) {
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

// A region that is asked for: a polygon of each operand, or no_index. For combine() both are 0.
struct RegionKey {
  Index first;
  Index second;
  friend auto operator<=>(const RegionKey&, const RegionKey&) = default;
};

// Which regions have a face.
class RegionRule {
 public:
  RegionRule(SetOperation operation, bool is_joined)
      : is_joined_(is_joined),
        takes_both_(operation != SetOperation::difference &&
                    operation != SetOperation::symmetric_difference),
        takes_first_(operation != SetOperation::intersection),
        takes_second_(operation == SetOperation::unite ||
                      operation == SetOperation::symmetric_difference) {}

  // Appends the regions that have a face with these owners.
  void append_keys(const Owners& owners, std::vector<RegionKey>& keys) const {
    const auto& [first, second] = owners;
    if (!is_wanted(!first.empty(), !second.empty())) return;
    if (is_joined_) {
      keys.push_back({0, 0});
      return;
    }
    static const std::vector<Index> none = {no_index};
    for (const Index i : first.empty() ? none : first) {
      for (const Index k : second.empty() ? none : second) keys.push_back({i, k});
    }
  }
  // True if the face beyond an edge does not belong to the region, to which the face of the owners
  // belongs. `operands` has the operand of each polygon.
  [[nodiscard]] bool ends_at(const RegionKey& key, const Owners& owners,
                             std::span<const EdgeOfPolygon> edge,
                             const std::vector<std::uint8_t>& operands) const {
    // How many polygons of each operand have the face beyond, and whether those of the key do.
    std::array<std::size_t, 2> counts = {owners[0].size(), owners[1].size()};
    for (const EdgeOfPolygon& side : edge) {
      const std::uint8_t operand = operands[side.polygon];
      const bool is_left =
          std::ranges::find(owners[operand], side.polygon) != owners[operand].end();
      if (!is_joined_ && is_left && (side.polygon == key.first || side.polygon == key.second)) {
        return true;
      }
      counts[operand] += is_left ? static_cast<std::size_t>(-1) : 1;
    }
    if (is_joined_) return !is_wanted(counts[0] != 0, counts[1] != 0);
    return (key.first == no_index && counts[0] != 0) || (key.second == no_index && counts[1] != 0);
  }

 private:
  [[nodiscard]] bool is_wanted(bool is_in_first, bool is_in_second) const {
    if (is_in_first && is_in_second) return takes_both_;
    return (is_in_first && takes_first_) || (is_in_second && takes_second_);
  }

  bool is_joined_;
  bool takes_both_;
  bool takes_first_;
  bool takes_second_;
};

// A halfedge with a region to its left, and not to its right.
struct BorderHalfedge {
  RegionKey key;
  Index halfedge;
  friend auto operator<=>(const BorderHalfedge&, const BorderHalfedge&) = default;
};

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

// A region: its rings of points, or the whole sphere.
struct Region {
  RegionKey key;
  std::vector<std::vector<Point>> rings;
  bool is_whole = false;
};

Region joined_region(const Sides& sides, SetOperation operation, const Execution& execution);

// Returns the sides with some polygons replaced by what they are alone, so that it does not depend on
// the others.
Sides mended(const Sides& sides, const std::vector<Index>& polygons, const Execution& execution) {
  std::vector<Index> places(sides.operands.size(), no_index);  // among those that are replaced
  for (Index k = 0; k < polygons.size(); ++k) places[polygons[k]] = k;
  std::vector<Sides> alone(polygons.size());
  Sides result = sides;
  result.are_mended = true;
  result.arcs.clear();
  result.polygons.clear();
  for (std::size_t arc = 0; arc < sides.arcs.size(); ++arc) {
    const Index polygon = sides.polygons[arc];
    const bool is_replaced = places[polygon] != no_index;
    Sides& target = is_replaced ? alone[places[polygon]] : result;
    if (is_replaced) {
      for (const Index end : sides.arcs[arc]) target.points.push_back(sides.points[end]);
      const auto size = static_cast<Index>(target.points.size());
      target.arcs.push_back({size - 2, size - 1});
    } else {
      target.arcs.push_back(sides.arcs[arc]);
    }
    target.polygons.push_back(is_replaced ? 0 : polygon);
  }
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    alone[k].operands = {0};
    const Region region = joined_region(alone[k], SetOperation::unite, execution);
    if (region.is_whole) result.whole[sides.operands[polygons[k]]].push_back(polygons[k]);
    result.append_rings(region.rings, polygons[k]);
  }
  return result;
}

// Returns the regions that are not empty, sorted by their keys.
std::vector<Region> regions_of(const Sides& sides, const RegionRule& rule,
                               const Execution& execution) {
  const unsigned threads = execution.threads;
  const Arrangement arranged = arrange(sides.points, sides.arcs, execution);
  std::vector<RegionKey> keys_of_first_face;
  std::vector<BorderHalfedge> border;
  const Halfedges halfedges(arranged, threads);
  if (arranged.edges.empty()) {
    rule.append_keys(sides.owners_without_edges(), keys_of_first_face);
  } else {
    const CompressedRows<EdgeOfPolygon> polygons = polygons_of_edges(arranged, sides.polygons);
    Coverage coverage(halfedges, polygons, sides.operands, sides.whole, sides.known, threads);
    if (!sides.are_mended && sides.operands.size() > 1 && !coverage.contradictory().empty()) {
      return regions_of(mended(sides, coverage.contradictory(), execution), rule, execution);
    }
    bool is_first = true;
    std::vector<RegionKey> keys;
    coverage.visit([&](Index h, const Owners& owners) {
      keys.clear();
      rule.append_keys(owners, keys);
      if (is_first) keys_of_first_face = keys;
      is_first = false;
      for (const RegionKey& key : keys) {
        if (rule.ends_at(key, owners, polygons[h / 2], sides.operands)) border.push_back({key, h});
      }
    });
    std::ranges::sort(border);
  }
  std::vector<Region> regions;
  RingWalk walk(halfedges);
  for (std::size_t begin = 0; begin < border.size();) {
    std::size_t end = begin + 1;
    while (end < border.size() && border[end].key == border[begin].key) ++end;
    Region& region = regions.emplace_back(Region{border[begin].key, {}});
    for (const auto& nodes : walk.rings(std::span(border).subspan(begin, end - begin))) {
      std::vector<Point> ring;
      ring.reserve(nodes.size());
      for (const Index node : nodes) ring.push_back(arranged.nodes[node]);
      region.rings.push_back(std::move(ring));
    }
    begin = end;
  }
  // A region without a border is everywhere, so also in the first face.
  for (const RegionKey& key : keys_of_first_face) {
    const auto place = std::ranges::lower_bound(regions, key, {}, &Region::key);
    if (place == regions.end() || place->key != key) regions.insert(place, {key, {}, true});
  }
  return regions;
}

bool is_less(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

// Returns a cell for each region. Points are sorted by their coordinates; a ring begins at its first
// point, and the rings of a cell are sorted.
CellRings cells_of(std::span<const Region> regions) {
  CellRings result;
  for (const Region& region : regions) {
    for (const auto& ring : region.rings) {
      result.points.insert(result.points.end(), ring.begin(), ring.end());
    }
  }
  std::ranges::sort(result.points, is_less);
  result.points.erase(std::unique(result.points.begin(), result.points.end()), result.points.end());
  const auto number_of = [&](const Point& p) {
    return static_cast<Index>(std::ranges::lower_bound(result.points, p, is_less) -
                              result.points.begin());
  };
  for (const Region& region : regions) {
    std::vector<std::vector<Index>> rings;
    rings.reserve(region.rings.size());
    for (const auto& points : region.rings) {
      std::vector<Index> ring;
      ring.reserve(points.size());
      for (const Point& p : points) ring.push_back(number_of(p));
      std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
      rings.push_back(std::move(ring));
    }
    std::ranges::sort(rings);
    if (region.is_whole) result.whole.push_back(static_cast<Index>(result.num_cells()));
    for (const auto& ring : rings) result.append_ring(ring);
    result.end_cell();
  }
  return result;
}

Sides sides_of(const CellRings& first, const CellRings& second) {
  arrangement::validate_rings(first);
  arrangement::validate_rings(second);
  Sides sides;
  sides.append(first, 0);
  sides.append(second, 1);
  return sides;
}

// Returns the one region of a joined result, which may be empty.
Region joined_region(const Sides& sides, SetOperation operation, const Execution& execution) {
  std::vector<Region> regions = regions_of(sides, RegionRule(operation, true), execution);
  return regions.empty() ? Region{} : std::move(regions.front());
}

// Returns a cell for each of `count` operations on a few polygons; sides_at(k) returns the sides of
// those of operation k. Throws InvalidInput with the first operation whose sides are refused.
template <class SidesAt>
CellRings joined_each(std::size_t count, SetOperation operation, const Execution& execution,
                      const SidesAt& sides_at) {
  std::vector<Region> regions(count);
  std::vector<std::string> refusals(count);
  constexpr std::size_t grain = 8;
  // A few large operations are divided themselves.
  const unsigned threads = count < 2 * grain ? execution.threads : 1;
  system::parallel_for(execution.threads, count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      try {
        regions[k] =
            joined_region(sides_at(k), operation, {.threads = threads, .stop = execution.stop});
      } catch (const InvalidInput& error) {
        refusals[k] = error.what();
      }
    }
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (!refusals[k].empty()) throw InvalidInput(refusals[k], k);
  }
  return cells_of(regions);
}

}  // namespace

std::string_view name_of(SetOperation operation) noexcept {
  switch (operation) {
    case SetOperation::unite:
      return "union";
    case SetOperation::intersection:
      return "intersection";
    case SetOperation::difference:
      return "difference";
    case SetOperation::symmetric_difference:
      return "symmetric_difference";
    case SetOperation::identity:
      return "identity";
  }
  return {};
}

CellRings combine(const CellRings& first, const CellRings& second, SetOperation operation,
                  const Execution& execution) {
  const system::Call call(execution);
  const Sides sides = sides_of(first, second);
  return cells_of(std::vector{joined_region(sides, operation, execution)});
}

RegionPieces overlay_pieces(const CellRings& first, const CellRings& second, SetOperation operation,
                            const Execution& execution) {
  const system::Call call(execution);
  const Sides sides = sides_of(first, second);
  const std::vector<Region> regions = regions_of(sides, RegionRule(operation, false), execution);
  RegionPieces result{cells_of(regions), {}, {}};
  for (const Region& region : regions) {
    result.cells.push_back(region.key.first);
    const Index second_key = region.key.second;
    result.regions.push_back(
        second_key == no_index ? no_index : second_key - static_cast<Index>(first.num_cells()));
  }
  return result;
}

CellRings unite(const CellRings& polygons, const Execution& execution) {
  return combine(polygons, {}, SetOperation::unite, execution);
}

CellRings combine_pairs(const CellRings& first, const CellRings& second,
                        std::span<const std::array<Index, 2>> pairs, SetOperation operation,
                        const Execution& execution) {
  const system::Call call(execution);
  arrangement::validate_rings(first);
  arrangement::validate_rings(second);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    if (a >= first.num_cells() || b >= second.num_cells()) {
      throw InvalidInput("a polygon of a pair does not exist", k);
    }
  }
  return joined_each(pairs.size(), operation, execution, [&](std::size_t k) {
    Sides sides;
    sides.append_cell(first, pairs[k][0], 0);
    sides.append_cell(second, pairs[k][1], 1);
    return sides;
  });
}

CellRings repaired(const CellRings& polygons, const Execution& execution) {
  const system::Call call(execution);
  arrangement::validate_rings(polygons);
  return joined_each(polygons.num_cells(), SetOperation::unite, execution, [&](std::size_t cell) {
    Sides sides;
    sides.append_cell(polygons, cell, 0);
    return sides;
  });
}

namespace arrangement {

CellRings extracted(const CellRings& cells, std::size_t begin, std::size_t end) {
  CellRings result;
  for (std::size_t c = begin; c < end; ++c) {
    if (cells.is_whole(c)) result.whole.push_back(static_cast<Index>(result.num_cells()));
    for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
      for (const Index p : cells.corners_of(r)) {
        result.corners.push_back(static_cast<Index>(result.points.size()));
        result.points.push_back(cells.points[p]);
      }
      result.end_ring();
    }
    result.end_cell();
  }
  return result;
}

CellRings combined_each(std::size_t count, const std::function<Operands(std::size_t)>& operands_of,
                        SetOperation operation, const Execution& execution) {
  return joined_each(count, operation, execution, [&](std::size_t i) {
    const Operands operands = operands_of(i);
    return sides_of(operands.first, operands.second);
  });
}

CellRings even_odd_union(const CellRings& polygons,
                         std::span<const std::optional<KnownPlace>> known,
                         const Execution& execution) {
  Sides sides;
  sides.append(polygons, 0);
  sides.known.assign(known.begin(), known.end());
  return cells_of(std::vector{joined_region(sides, SetOperation::unite, execution)});
}

}  // namespace arrangement
}  // namespace rondel
