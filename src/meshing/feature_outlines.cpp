// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files cut polygons at longitude 180. A polygon that crosses it becomes two: one has a side up the
// antimeridian, the other a side down it. The two sides need not have the same corners:
//
//             |   b           The antimeridian is the half of a great circle where y = 0 and x <= 0. A point on it
//      a      |  ^ |          has the number z / (1 - x), the tangent of half its latitude. The sides that go up
//      |  up  v  | v down     (of polygons to the west) and those that go down (to the east) are intervals of that
//      v      |               number; the cuts are the intersections of both.

#include "meshing/feature_outlines.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rondel::meshing {
namespace {

using OutlinePoints = std::vector<Point>;

// True for points of longitude 180 and for the poles.
bool is_on_antimeridian(const Point& p) { return p.y == 0 && p.x <= 0; }

// A point of the antimeridian and its number.
struct MeridianPlace {
  double number;
  Point point;
};
MeridianPlace meridian_place(const Point& p) { return {p.z / (1 - p.x), p}; }

// Disjoint intervals in increasing order.
struct MeridianInterval {
  MeridianPlace low;
  MeridianPlace high;
};
using MeridianIntervals = std::vector<MeridianInterval>;

// Returns the union of intervals as disjoint intervals in increasing order.
MeridianIntervals united(MeridianIntervals all) {
  std::ranges::sort(all, {}, [](const MeridianInterval& one) { return one.low.number; });
  MeridianIntervals result;
  for (const MeridianInterval& one : all) {
    if (result.empty() || result.back().high.number < one.low.number) {
      result.push_back(one);
    } else if (result.back().high.number < one.high.number) {
      result.back().high = one.high;
    }
  }
  return result;
}

// Returns the intersection of two sets of disjoint intervals.
MeridianIntervals common(const MeridianIntervals& a, const MeridianIntervals& b) {
  MeridianIntervals result;
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() && in_b != b.end()) {
    const MeridianPlace low = in_a->low.number < in_b->low.number ? in_b->low : in_a->low;
    const bool a_ends_first = in_a->high.number < in_b->high.number;
    const MeridianPlace high = a_ends_first ? in_a->high : in_b->high;
    if (low.number < high.number) result.push_back({low, high});
    ++(a_ends_first ? in_a : in_b);
  }
  return result;
}

// The parts of the antimeridian along which polygons are cut.
class AntimeridianCut {
 public:
  // Finds the cuts of closed lines, whose last point is their first one.
  explicit AntimeridianCut(const std::vector<OutlinePoints>& closed_lines) {
    MeridianIntervals up;
    MeridianIntervals down;
    for (const OutlinePoints& line : closed_lines) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        if (!is_on_antimeridian(line[k]) || !is_on_antimeridian(line[k + 1])) continue;
        const MeridianPlace from = meridian_place(line[k]);
        const MeridianPlace to = meridian_place(line[k + 1]);
        if (from.number < to.number) up.push_back({from, to});
        if (to.number < from.number) down.push_back({to, from});
      }
    }
    cuts_ = common(united(std::move(up)), united(std::move(down)));
  }

  // Appends what is left of a closed line without the cuts: the line itself to `whole` if it has
  // none, otherwise its pieces to `parts`.
  void append_rest(const OutlinePoints& line, std::vector<OutlinePoints>& whole,
                   std::vector<OutlinePoints>& parts) const {
    std::vector<OutlinePoints> found = {{}};
    for (std::size_t k = 0; k + 1 < line.size(); ++k) append_side(line[k], line[k + 1], found);
    if (found.size() == 1) {
      whole.push_back(line);
      return;
    }
    // A closed line may begin anywhere, so its first and last parts are joined.
    OutlinePoints& last = found.back();
    if (!last.empty() && !found.front().empty()) {
      last.insert(last.end(), found.front().begin() + 1, found.front().end());
      found.front().clear();
    } else if (last.empty()) {
      std::swap(last, found.front());
    }
    for (OutlinePoints& part : found) {
      if (part.size() > 1) parts.push_back(std::move(part));
    }
  }

 private:
  // Appends a side to the last part; after each cut a new part begins.
  void append_side(const Point& from, const Point& to, std::vector<OutlinePoints>& found) const {
    const auto append = [&](const Point& p, const Point& q) {
      if (found.back().empty()) found.back().push_back(p);
      found.back().push_back(q);
    };
    if (from == to) return;  // all positions at a pole are one point
    if (!is_on_antimeridian(from) || !is_on_antimeridian(to)) {
      append(from, to);
      return;
    }
    const double begin = meridian_place(from).number;
    const double end = meridian_place(to).number;
    const bool is_up = begin < end;
    Point at = from;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      const MeridianInterval& cut = cuts_[is_up ? k : cuts_.size() - 1 - k];
      if (cut.high.number <= std::min(begin, end) || cut.low.number >= std::max(begin, end)) {
        continue;
      }
      const MeridianPlace& first = is_up ? cut.low : cut.high;
      const MeridianPlace& second = is_up ? cut.high : cut.low;
      const bool begins_inside = is_up ? first.number > begin : first.number < begin;
      const bool ends_inside = is_up ? second.number < end : second.number > end;
      if (begins_inside) append(at, first.point);
      found.emplace_back();
      at = ends_inside ? second.point : to;
    }
    if (at != to) append(at, to);
  }

  MeridianIntervals cuts_;
};

// Joins parts that end where others begin into lines, which are closed if they return to their
// beginning.
class PartJoin {
 public:
  explicit PartJoin(std::vector<OutlinePoints> parts) : parts_(std::move(parts)) {
    std::vector<std::pair<std::array<double, 3>, std::size_t>> starts;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      starts.emplace_back(key(parts_[i].front()), i);
    }
    std::ranges::sort(starts);
    std::vector<char> is_used(starts.size(), 0);
    next_.assign(parts_.size(), none);
    has_previous_.assign(parts_.size(), 0);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      auto at = std::ranges::lower_bound(starts, std::pair(key(parts_[i].back()), std::size_t{0}));
      const auto number = [&] { return static_cast<std::size_t>(at - starts.begin()); };
      while (at != starts.end() && at->first == key(parts_[i].back()) && is_used[number()] != 0) {
        ++at;
      }
      if (at == starts.end() || at->first != key(parts_[i].back())) continue;
      is_used[number()] = 1;
      next_[i] = at->second;
      has_previous_[at->second] = 1;
    }
  }

  // Appends open chains first, each from its begin; what is left are closed chains.
  void append_all(std::vector<OutlinePoints>& lines) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (has_previous_[i] == 0) append_chain(i, lines);
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!parts_[i].empty()) append_chain(i, lines);
    }
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static std::array<double, 3> key(const Point& p) { return {p.x, p.y, p.z}; }

  // Appends the line that begins with this part.
  void append_chain(std::size_t first, std::vector<OutlinePoints>& lines) {
    OutlinePoints line = std::exchange(parts_[first], {});
    for (std::size_t i = next_[first]; i != none && !parts_[i].empty(); i = next_[i]) {
      line.insert(line.end(), parts_[i].begin() + 1, parts_[i].end());
      parts_[i].clear();
    }
    lines.push_back(std::move(line));
  }

  std::vector<OutlinePoints> parts_;
  std::vector<std::size_t> next_;
  std::vector<char> has_previous_;
};

}  // namespace

std::vector<std::vector<Point>> outlines_of(const FeatureTable& features) {
  std::vector<OutlinePoints> lines;
  std::vector<OutlinePoints> closed;
  const CompressedRows<Point>& given = features.lines.rows;
  for (std::size_t i = 0; i < given.size(); ++i) {
    OutlinePoints line(given[i].begin(), given[i].end());
    const bool is_closed = line.size() > 3 && line.front() == line.back();
    (is_closed ? closed : lines).push_back(std::move(line));
  }
  const CellRings& cells = features.polygons;
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    OutlinePoints ring;
    for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
      ring.push_back(cells.points[cells.corners[k]]);
    }
    if (ring.empty()) continue;
    ring.emplace_back(ring.front());
    closed.push_back(std::move(ring));
  }
  const AntimeridianCut cut(closed);
  std::vector<OutlinePoints> parts;
  for (const OutlinePoints& line : closed) cut.append_rest(line, lines, parts);
  PartJoin join(std::move(parts));
  join.append_all(lines);
  return lines;
}

}  // namespace rondel::meshing
