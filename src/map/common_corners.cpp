// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/common_corners.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "exact/vector.h"
#include "map/arc.h"
#include "order/along_the_curve.h"
#include "rondel/compressed_rows.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::map {
namespace {

bool is_before_in_space(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

// Knows which points are joined by an arc of a ring in this direction.
class OutgoingArcs {
 public:
  explicit OutgoingArcs(const CellRings& cells) {
    system::RowPlaces places(cells.points.size());
    for (const Index from : cells.corners) places.count(from);
    ends_.values.resize(places.sum());
    for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
      for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
        const std::uint64_t next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
        ends_.values[places.place(cells.corners[k])] = cells.corners[next];
      }
    }
    ends_.offsets = std::move(places).offsets();
  }

  [[nodiscard]] bool has(Index from, Index to) const {
    const std::span<const Index> ends = ends_[from];
    return std::ranges::find(ends, to) != ends.end();
  }

 private:
  CompressedRows<Index> ends_;  // a row for each point
};

}  // namespace

bool CommonCorners::ArcsInSpace::operator()(const RingArc& a, const RingArc& b) const {
  return a.from == b.from ? is_before_in_space(a.to, b.to) : is_before_in_space(a.from, b.from);
}

// The box of an arc: that of its chord, widened by the largest distance of the arc from the chord.
struct CommonCorners::ArcBox {
  std::array<double, 3> low{};
  std::array<double, 3> high{};

  static ArcBox around(const RingArc& arc) {
    ArcBox box;
    const Point chord = arc.to - arc.from;
    const double room =
        dot(chord, chord) / 4 + merge_distance;  // the arc is at most |chord|^2 / 4 above the chord
    const std::array<double, 3> p{arc.from.x, arc.from.y, arc.from.z};
    const std::array<double, 3> q{arc.to.x, arc.to.y, arc.to.z};
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(p[k], q[k]) - room;
      box.high[k] = std::max(p[k], q[k]) + room;
    }
    return box;
  }

  static ArcBox joined(const ArcBox& a, const ArcBox& b) {
    ArcBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(a.low[k], b.low[k]);
      box.high[k] = std::max(a.high[k], b.high[k]);
    }
    return box;
  }

  [[nodiscard]] bool has(const Point& p) const {
    return low[0] <= p.x && p.x <= high[0] && low[1] <= p.y && p.y <= high[1] && low[2] <= p.z &&
           p.z <= high[2];
  }
};

// A tree of boxes: level 0 has the boxes of the arcs, level 1 those of the arcs 2i and 2i + 1, and
// so on. Arcs that follow each other are near each other, so the boxes are small.
class CommonCorners::ArcBoxes {
 public:
  explicit ArcBoxes(std::span<const RingArc> arcs) {
    std::vector<ArcBox>& first = levels_.emplace_back();
    for (const RingArc& arc : arcs) first.push_back(ArcBox::around(arc));
    while (levels_.back().size() > 1) {
      const std::vector<ArcBox>& below = levels_.back();
      std::vector<ArcBox> level;
      for (std::size_t i = 0; i < below.size(); i += 2) {
        level.push_back(i + 1 < below.size() ? ArcBox::joined(below[i], below[i + 1]) : below[i]);
      }
      levels_.push_back(std::move(level));
    }
  }

  // Calls `report` with the number of each arc whose box contains the point.
  template <class Report>
  void find(const Point& p, const Report& report) const {
    if (!levels_.front().empty()) find(p, levels_.size() - 1, 0, report);
  }

 private:
  template <class Report>
  void find(const Point& p, std::size_t level, std::size_t i, const Report& report) const {
    if (!levels_[level][i].has(p)) return;
    if (level == 0) {
      report(i);
      return;
    }
    for (std::size_t k = 2 * i; k < std::min(2 * i + 2, levels_[level - 1].size()); ++k)
      find(p, level - 1, k, report);
  }

  std::vector<std::vector<ArcBox>> levels_;
};

std::vector<CommonCorners::RingArc> CommonCorners::unmatched_arcs(const CellRings& cells,
                                                                  std::span<const Point> points,
                                                                  unsigned threads) {
  const OutgoingArcs outgoing(cells);
  std::vector<RingArc> arcs;
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
      const std::uint64_t next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
      const Index from = cells.corners[k];
      const Index to = cells.corners[next];
      if (!outgoing.has(to, from)) arcs.push_back({points[from], points[to]});
    }
  }
  // Several points may have the same coordinates, so arcs are compared by coordinates once more.
  std::vector<RingArc> sorted = arcs;
  std::ranges::sort(sorted, ArcsInSpace());
  std::erase_if(arcs, [&](const RingArc& arc) {
    return arc.from == arc.to ||
           std::ranges::binary_search(sorted, RingArc{arc.to, arc.from}, ArcsInSpace());
  });
  sort_along_curve(arcs, threads);
  return arcs;
}

// Sorts arcs along a space-filling curve, since ArcBoxes needs neighbors to follow each other,
// while cells come in any order.
void CommonCorners::sort_along_curve(std::vector<RingArc>& arcs, unsigned threads) {
  std::vector<Index> indices(arcs.size());
  std::iota(indices.begin(), indices.end(), Index{0});
  const order::KeyedIndices order = order::along_the_curve(
      std::move(indices), Model::projected, {}, threads, [&](Index i) { return arcs[i].from; });
  std::vector<RingArc> sorted;
  sorted.reserve(arcs.size());
  for (const Index i : order.indices) sorted.push_back(arcs[i]);
  arcs = std::move(sorted);
}

CommonCorners::CommonCorners(const CellRings& cells, std::span<const Point> points,
                             unsigned threads) {
  const std::vector<RingArc> arcs = unmatched_arcs(cells, points, threads);
  std::vector<Point> corners;
  for (const RingArc& arc : arcs) {
    corners.push_back(arc.from);
    corners.push_back(arc.to);
  }
  std::ranges::sort(corners, is_before_in_space);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const ArcBoxes boxes(arcs);
  std::vector<std::vector<std::size_t>> found(corners.size());
  system::parallel_for(threads, corners.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Point& corner = corners[c];
      boxes.find(corner, [&](std::size_t i) {
        const auto& [p, q] = arcs[i];
        if (distance(corner, p) <= merge_distance || distance(corner, q) <= merge_distance) return;
        const std::optional<Point> foot = foot_on_arc(corner, p, q);
        if (foot && distance(*foot, corner) <= merge_distance) found[c].push_back(i);
      });
    }
  });
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (const std::size_t i : found[c]) {
      std::vector<Point>& inner = inner_[arcs[i]];
      if (std::ranges::find(inner, corners[c]) == inner.end()) inner.push_back(corners[c]);
    }
  }
  for (auto& inner : inner_) {
    const Point& from = inner.first.from;
    std::ranges::stable_sort(inner.second, {}, [&](const Point& p) { return distance(from, p); });
  }
}

void CommonCorners::append_ring(std::span<const Index> corners, std::span<const Point> points,
                                std::vector<Point>& out) const {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point& from = points[corners[k]];
    const Point& to = points[corners[k + 1 < corners.size() ? k + 1 : 0]];
    out.push_back(from);
    const auto inner = inner_.empty() ? inner_.end() : inner_.find({from, to});
    if (inner != inner_.end()) out.insert(out.end(), inner->second.begin(), inner->second.end());
  }
}

}  // namespace rondel::map
