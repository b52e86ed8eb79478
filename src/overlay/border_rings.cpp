// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/border_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "exact/angles.h"
#include "exact/point_order.h"
#include "exact/vector.h"
#include "map/ring_area.h"
#include "order/sorts.h"
#include "overlay/measure.h"
#include "overlay/region_area.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "system/hash.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t keys_per_block = 256;
// The area of a clockwise ring that is taken for rounding, in multiples of area_of_rounding().
constexpr double of_holes = 8;

// A directed side between two points, which are named by their places in the list of points.
struct NamedSide {
  Index from;
  Index to;
  friend auto operator<=>(const NamedSide&, const NamedSide&) = default;
};

// The sides that begin in each point, by their keys.
class SidesFromPoints {
 public:
  struct Begun {
    Index key;
    Index place;  // in the rows of all keys
  };

  SidesFromPoints() = default;
  SidesFromPoints(std::vector<Index> offsets, std::vector<Begun> sides)
      : offsets_(std::move(offsets)), sides_(std::move(sides)) {}

  // Returns the place of the first side of a key that begins in a point, or no_index.
  [[nodiscard]] Index first(Index point, std::size_t key) const {
    const auto own = std::span(sides_).subspan(offsets_[point], size_at(point));
    constexpr std::size_t few = 8;
    auto side = own.begin();
    if (own.size() > few) {
      side = std::ranges::lower_bound(own, key, {}, &Begun::key);
    } else {
      while (side != own.end() && side->key < key) ++side;
    }
    return side != own.end() && side->key == key ? side->place : no_index;
  }

 private:
  [[nodiscard]] std::size_t size_at(Index point) const {
    return offsets_[point + std::size_t{1}] - offsets_[point];
  }

  std::vector<Index> offsets_;
  std::vector<Begun> sides_;
};

// All points in the order of their coordinates, and the sides of each key in compressed rows,
// ascending by their beginnings.
struct Named {
  std::vector<Point> points;
  CompressedRows<NamedSide> links;
  SidesFromPoints begun;
};

// Returns the numbers of points in the order of their coordinates, those of equal ones ascending.
std::vector<Index> in_order(std::span<const Point> points) {
  const auto is_before = [&](Index a, Index b) {
    if (exact::is_less(points[a], points[b])) return true;
    return a < b && !exact::is_less(points[b], points[a]);
  };
  order::KeyedIndices sorted;
  sorted.indices.resize(points.size());
  std::iota(sorted.indices.begin(), sorted.indices.end(), Index{0});
  constexpr std::size_t few = 256;
  if (points.size() <= few) {
    std::ranges::sort(sorted.indices, is_before);
    return std::move(sorted.indices);
  }
  // Keys do not decrease with the first coordinate, and few points have the same one.
  constexpr int key_bits = 33;
  sorted.keys.reserve(points.size());
  for (const Point& p : points) {
    sorted.keys.push_back(static_cast<std::uint64_t>((std::clamp(p.x, -1.5, 1.5) + 1.5) * 0x1p31));
  }
  order::radix_sort(sorted, key_bits);
  for (std::size_t first = 0; first < points.size();) {
    std::size_t end = first + 1;
    while (end < points.size() && sorted.keys[end] == sorted.keys[first]) ++end;
    if (end - first > 1) {
      const auto begin = sorted.indices.begin();
      std::sort(begin + static_cast<std::ptrdiff_t>(first),
                begin + static_cast<std::ptrdiff_t>(end), is_before);
    }
    first = end;
  }
  return std::move(sorted.indices);
}

// Replaces the ends of sides by the places of equal points in the order of coordinates.
Named named(std::span<const Point> points, std::span<const KeyedSide> sides, std::size_t num_keys) {
  if (points.size() >= no_index || sides.size() >= no_index) {
    throw InvalidInput("there are too many corners");
  }
  Named result;
  std::vector<Index> names(points.size());
  for (const Index p : in_order(points)) {
    if (result.points.empty() || !(result.points.back() == points[p])) {
      result.points.push_back(points[p]);
    }
    names[p] = static_cast<Index>(result.points.size() - 1);
  }
  // Sides are dealt by their keys, by their beginnings, and by their keys again.
  system::RowPlaces<Index> of_keys(num_keys);
  for (const KeyedSide& side : sides) of_keys.count(side.key);
  std::vector<Index> by_key(of_keys.sum());
  for (Index s = 0; s < sides.size(); ++s) by_key[of_keys.place(sides[s].key)] = s;
  system::RowPlaces<Index> of_points(result.points.size());
  for (const KeyedSide& side : sides) of_points.count(names[side.from]);
  std::vector<Index> by_point(of_points.sum());
  for (const Index s : by_key) by_point[of_points.place(names[sides[s].from])] = s;

  system::RowPlaces links(num_keys);
  for (const KeyedSide& side : sides) links.count(side.key);
  result.links.values.resize(links.sum());
  std::vector<SidesFromPoints::Begun> begun;
  begun.reserve(sides.size());
  for (const Index s : by_point) {
    const auto& [key, from, to] = sides[s];
    const std::uint64_t place = links.place(key);
    result.links.values[place] = {names[from], names[to]};
    begun.push_back({key, static_cast<Index>(place)});
  }
  result.links.offsets = std::move(links).offsets();
  result.begun = {std::move(of_points).offsets(), std::move(begun)};
  return result;
}

// Removes sides from a point to itself, and pairs of opposite sides. The rest is sorted.
void cancel(std::vector<NamedSide>& links) {
  std::erase_if(links, [](const NamedSide& link) { return link.from == link.to; });
  const auto ends = [](const NamedSide& link) { return std::minmax(link.from, link.to); };
  std::ranges::sort(links, [&](const NamedSide& a, const NamedSide& b) {
    return std::tuple<std::pair<Index, Index>, Index>(ends(a), a.from) <
           std::tuple<std::pair<Index, Index>, Index>(ends(b), b.from);
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < links.size();) {
    std::size_t end = k;
    std::size_t num_upwards = 0;
    while (end < links.size() && ends(links[end]) == ends(links[k])) {
      if (links[end].from < links[end].to) ++num_upwards;
      ++end;
    }
    const auto [low, high] = ends(links[k]);
    const std::size_t num_downwards = end - k - num_upwards;
    const NamedSide left =
        num_upwards > num_downwards ? NamedSide{low, high} : NamedSide{high, low};
    const std::size_t num_left =
        std::max(num_upwards, num_downwards) - std::min(num_upwards, num_downwards);
    for (std::size_t i = 0; i < num_left; ++i) links[kept++] = left;
    k = end;
  }
  links.resize(kept);
  std::ranges::sort(links);
}

// Returns the angle at p, from 0 to 2 pi, by which the direction to q is clockwise of the direction
// to `back`.
double clockwise_angle(const Point& p, const Point& back, const Point& q) {
  const Point to_back = back - p;
  const Point to_q = q - p;
  const double sine = dot(p, cross(to_q, to_back));
  const double cosine = dot(to_back, to_q) - dot(p, to_back) * dot(p, to_q);
  const double angle = exact::argument(std::abs(sine), cosine);
  return sine < 0 ? 2 * std::numbers::pi - angle : angle;
}

// Traces the rings of one region after another.
class RingMaker {
 public:
  explicit RingMaker(const Named& all) : points_(all.points), all_(all) {}

  // Returns the rings of the region with this key, in order. Precondition: as many sides end in
  // each point as begin there.
  std::vector<std::vector<Index>> operator()(std::size_t key) {
    key_ = key;
    links_.assign(all_.links[key].begin(), all_.links[key].end());
    rings_.clear();
    const bool is_plain = find_next();
    if (!is_plain) {
      std::ranges::sort(links_);
      cancel(links_);
    }
    is_used_.assign(links_.size(), 0);
    for (std::size_t k = 0; k < links_.size(); ++k) {
      if (is_used_[k] != 0) continue;
      if (is_plain) {
        follow_plainly(k);
      } else {
        follow(k);
      }
    }
    std::erase_if(rings_, [&](const std::vector<Index>& ring) { return is_rounding(ring); });
    for (std::vector<Index>& ring : rings_) {
      std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
    }
    std::ranges::sort(rings_);
    return std::move(rings_);
  }

 private:
  // Finds for each side the one that begins where it ends. Returns false if two sides begin in one
  // point or one is the reverse of another; otherwise no side cancels.
  bool find_next() {
    const auto first = static_cast<Index>(all_.links.offsets[key_]);
    next_.clear();
    next_.reserve(links_.size());
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const auto [from, to] = links_[k];
      if (from == to || (k + 1 < links_.size() && links_[k + 1].from == from)) return false;
      Index next = all_.begun.first(to, key_);
      if (next != no_index) {
        next -= first;
        if (links_[next].to == from) return false;
      }
      next_.push_back(next);
    }
    return true;
  }

  // Does the same as follow() where find_next() has found that at most one side begins in a point.
  void follow_plainly(std::size_t first) {
    path_.clear();
    for (std::size_t k = first;; k = next_[k]) {
      is_used_[k] = 1;
      path_.push_back(links_[k].from);
      if (links_[k].to == path_.front()) {
        cut(path_.begin());
        return;
      }
      if (next_[k] == no_index || is_used_[next_[k]] != 0) {
        refuse_if_wide(path_);
        return;
      }
    }
  }

  // Follows sides from one on until the path closes. If the path meets one of its points again, the
  // loop is cut off as a ring of its own.
  void follow(std::size_t first) {
    path_.clear();
    std::size_t k = first;
    for (;;) {
      is_used_[k] = 1;
      path_.push_back(links_[k].from);
      const Index at = links_[k].to;
      if (at == path_.front()) {
        cut(path_.begin());
        return;
      }
      if (is_crowded(at)) cut(std::ranges::find(path_, at));
      k = next_after(links_[k]);
      if (k == links_.size()) {
        refuse_if_wide(path_);
        return;
      }
    }
  }
  // Throws InvalidInput for a path that does not close, unless it is no wider than rounding.
  void refuse_if_wide(const std::vector<Index>& path) {
    if (path.size() < 3 || is_rounding(path)) return;
    throw InvalidInput("the sides around region " + std::to_string(key_) + " do not close", key_);
  }
  // Cuts the end of the path off as a ring.
  void cut(std::vector<Index>::iterator begin) {
    if (std::distance(begin, path_.end()) > 2) rings_.emplace_back(begin, path_.end());
    path_.erase(begin, path_.end());
  }

  [[nodiscard]] std::size_t first_link_from(Index p) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(links_, p, {}, &NamedSide::from) -
                                    links_.begin());
  }
  // True if several sides begin in a point.
  [[nodiscard]] bool is_crowded(Index p) const {
    const std::size_t k = first_link_from(p);
    return k + 1 < links_.size() && links_[k + 1].from == p;
  }
  // Returns the side that continues the border of the region: the first unused one clockwise from
  // the way back, or links_.size().
  [[nodiscard]] std::size_t next_after(const NamedSide& link) const {
    std::size_t best = links_.size();
    double least = 0;
    for (std::size_t k = first_link_from(link.to); k < links_.size() && links_[k].from == link.to;
         ++k) {
      if (is_used_[k] != 0) continue;
      const double angle =
          clockwise_angle(points_[link.to], points_[link.from], points_[links_[k].to]);
      if (best == links_.size() || angle < least) {
        best = k;
        least = angle;
      }
    }
    return best;
  }

  [[nodiscard]] bool is_rounding(const std::vector<Index>& ring) {
    border_.clear();
    for (const Index p : ring) border_.push_back(points_[p]);
    return overlay::is_rounding(border_);
  }

  const std::vector<Point>& points_;
  const Named& all_;
  std::size_t key_ = 0;
  std::vector<NamedSide> links_;
  std::vector<Index> next_;  // of plain sides: the one that begins where each ends, or no_index
  std::vector<std::uint8_t> is_used_;
  std::vector<Index> path_;
  std::vector<Point> border_;
  std::vector<std::vector<Index>> rings_;
};

}  // namespace

bool is_rounding(std::span<const Point> ring) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) length += rough_length(ring[k], ring[k + 1]);
  length += rough_length(ring.back(), ring.front());
  const double rounding = area_of_rounding(length);
  if (map::is_surely_larger(ring, of_holes * rounding)) return false;
  const RingArea area = area_of_ring(ring);
  return area.is_nothing() || (area.area <= rounding && area.area >= -of_holes * rounding);
}

CellRings rings_around(std::span<const KeyedArc> arcs, std::size_t num_keys, unsigned threads) {
  if (arcs.size() >= no_index / 2) throw InvalidInput("there are too many corners");
  std::vector<Point> ends;
  std::vector<KeyedSide> sides;
  ends.reserve(2 * arcs.size());
  sides.reserve(arcs.size());
  for (const KeyedArc& arc : arcs) {
    const auto from = static_cast<Index>(ends.size());
    sides.push_back({arc.key, from, from + 1});
    ends.push_back(arc.from);
    ends.push_back(arc.to);
  }
  return rings_around(ends, sides, num_keys, threads);
}

CellRings rings_around(std::span<const Point> points, std::span<const KeyedSide> sides,
                       std::size_t num_keys, unsigned threads) {
  const Named all = named(points, sides, num_keys);
  std::vector<std::vector<std::vector<Index>>> rings(num_keys);
  system::parallel_for(threads, num_keys, keys_per_block, [&](std::size_t begin, std::size_t end) {
    RingMaker make(all);
    for (std::size_t key = begin; key < end; ++key) rings[key] = make(key);
  });
  CellRings result;
  std::vector<Index> new_names(all.points.size(), no_index);
  for (const auto& of_key : rings) {
    for (const std::vector<Index>& ring : of_key) {
      for (const Index p : ring) new_names[p] = 0;
      result.append_ring(ring);
    }
    result.end_cell();
  }
  for (std::size_t p = 0; p < all.points.size(); ++p) {
    if (new_names[p] == no_index) continue;
    new_names[p] = static_cast<Index>(result.points.size());
    result.points.push_back(all.points[p]);
  }
  for (Index& corner : result.corners) corner = new_names[corner];
  return result;
}

void ArcBalance::add(std::span<const KeyedArc> arcs) {
  const auto hash = [](const Point& p, const Point& q) {
    return system::hash_of(q, system::hash_of(p));
  };
  for (const auto& [key, from, to] : arcs) sum_ += hash(from, to) - hash(to, from);
}

bool is_nothing(std::span<const KeyedArc> arcs) {
  ArcBalance balance;
  balance.add(arcs);
  if (!balance.may_be_nothing()) return false;
  using Ends = std::tuple<double, double, double, double, double, double>;
  std::vector<Ends> there;
  std::vector<Ends> back;
  for (const auto& [key, p, q] : arcs) {
    there.emplace_back(p.x, p.y, p.z, q.x, q.y, q.z);
    back.emplace_back(q.x, q.y, q.z, p.x, p.y, p.z);
  }
  std::ranges::sort(there);
  std::ranges::sort(back);
  return there == back;
}

}  // namespace rondel::overlay
