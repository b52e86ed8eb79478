// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/planar_loops.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "exact/argument.h"
#include "map/arc.h"

namespace rondel::map {
namespace {

struct InPlane {
  bool operator()(const LonLat& p, const LonLat& q) const {
    return p.lon_deg != q.lon_deg ? p.lon_deg < q.lon_deg : p.lat_deg < q.lat_deg;
  }
};

bool has_touching(std::span<const Loop> loops) {
  std::vector<LonLat> positions;
  for (const Loop& loop : loops) positions.insert(positions.end(), loop.begin(), loop.end());
  std::ranges::sort(positions, InPlane());
  return std::ranges::adjacent_find(positions) != positions.end();
}

// The sides of loops by their first position, without those in both directions.
class Sides {
 public:
  explicit Sides(std::span<const Loop> loops) {
    for (const Loop& loop : loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        add(loop[k], loop[k + 1 == loop.size() ? 0 : k + 1]);
      }
    }
  }

  // Takes the loops out, one after the other; empty at the end.
  [[nodiscard]] Loop take_loop() {
    Loop loop;
    while (!ends_.empty() && ends_.begin()->second.empty()) ends_.erase(ends_.begin());
    if (ends_.empty()) return loop;
    const LonLat first = ends_.begin()->first;
    const LonLat second = ends_.begin()->second.back();
    ends_.begin()->second.pop_back();
    loop.push_back(first);
    LonLat before = first;
    for (LonLat here = second; !(here == first && !has_inner_turn(before, here, second));) {
      loop.push_back(here);
      const LonLat next = take_next(before, here);
      before = here;
      here = next;
    }
    return loop;
  }

 private:
  void add(const LonLat& from, const LonLat& to) {
    const auto back = ends_.find(to);
    if (back != ends_.end()) {
      const auto same = std::ranges::find(back->second, from);
      if (same != back->second.end()) {
        back->second.erase(same);
        return;
      }
    }
    ends_[from].push_back(to);
  }

  // How far clockwise, seen from `here`, one turns from `before` to `after`: that is through the region.
  static double turn(const LonLat& before, const LonLat& here, const LonLat& after) {
    const double back =
        exact::argument(before.lat_deg - here.lat_deg, before.lon_deg - here.lon_deg);
    const double out = exact::argument(after.lat_deg - here.lat_deg, after.lon_deg - here.lon_deg);
    const double angle = back - out;
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  }

  // Whether the loop, back at its first position, has to go on first.
  [[nodiscard]] bool has_inner_turn(const LonLat& before, const LonLat& here,
                                    const LonLat& after) const {
    const auto ends = ends_.find(here);
    if (ends == ends_.end()) return false;
    const double most = turn(before, here, after);
    return std::ranges::any_of(ends->second,
                               [&](const LonLat& end) { return turn(before, here, end) < most; });
  }

  LonLat take_next(const LonLat& before, const LonLat& here) {
    std::vector<LonLat>& ends = ends_[here];
    const auto nearest = std::ranges::min_element(
        ends, {}, [&](const LonLat& end) { return turn(before, here, end); });
    const LonLat next = *nearest;
    ends.erase(nearest);
    return next;
  }

  std::map<LonLat, std::vector<LonLat>, InPlane> ends_;
};

}  // namespace

std::vector<Loop> separated_loops(std::vector<Loop> loops) {
  if (!has_touching(loops)) return loops;
  std::vector<Loop> found;
  Sides sides(loops);
  for (Loop loop = sides.take_loop(); !loop.empty(); loop = sides.take_loop()) {
    for (Loop& part : simple_loops(loop)) found.push_back(std::move(part));
  }
  return found;
}

double doubled_loop_area(std::span<const LonLat> loop) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const LonLat& o = loop.front();
    area += (loop[i].lon_deg - o.lon_deg) * (loop[i + 1].lat_deg - o.lat_deg) -
            (loop[i + 1].lon_deg - o.lon_deg) * (loop[i].lat_deg - o.lat_deg);
  }
  return area;
}

std::vector<Loop> simple_loops(const Loop& loop) {
  std::vector<Loop> found;
  const auto add = [&](Loop part) {
    if (part.size() >= 3 && doubled_loop_area(part) != 0) found.push_back(std::move(part));
  };
  if (!has_touching({&loop, 1})) {
    add(loop);
    return found;
  }
  std::map<LonLat, std::size_t, InPlane> places;
  Loop open;
  for (const LonLat& position : loop) {
    const auto [place, is_new] = places.try_emplace(position, open.size());
    if (is_new) {
      open.push_back(position);
      continue;
    }
    const auto first = open.begin() + static_cast<std::ptrdiff_t>(place->second);
    add({first, open.end()});
    std::for_each(first + 1, open.end(), [&](const LonLat& p) { places.erase(p); });
    open.erase(first + 1, open.end());
  }
  add(std::move(open));
  return found;
}

HoleOwners::HoleOwners(std::span<const Loop> outer) : outer_(outer), doubled_areas_(outer.size()) {
  std::ranges::transform(outer, doubled_areas_.begin(), doubled_loop_area);
  if (outer.size() == 1) return;
  constexpr std::size_t most = 1 << 16;
  constexpr std::size_t sides_in_a_list = 8;
  std::size_t count = 0;
  for (const Loop& ring : outer) count += ring.size();
  lists_.resize(std::clamp<std::size_t>(count / sides_in_a_list, 1, most));
  for (std::size_t i = 0; i < outer.size(); ++i) {
    for (std::size_t k = 0; k < outer[i].size(); ++k) {
      const OuterSide side{i, k};
      const auto [west, east] = std::minmax({begin_of(side).lon_deg, end_of(side).lon_deg});
      for (std::size_t list = list_at(west); list <= list_at(east); ++list) {
        lists_[list].push_back(side);
      }
    }
  }
}

std::size_t HoleOwners::owner_of(const Loop& hole) const {
  constexpr double slack_deg = merge_distance * degrees_per_radian;  // the hole may touch its ring
  const auto largest = std::ranges::max_element(doubled_areas_);
  auto owner = static_cast<std::size_t>(std::distance(doubled_areas_.begin(), largest));
  if (lists_.empty()) return owner;
  const double hole_area = std::abs(doubled_loop_area(hole));
  const LonLat place = *std::ranges::min_element(hole, {}, &LonLat::lat_deg);
  double nearest = -std::numeric_limits<double>::infinity();
  for (const OuterSide& side : lists_[list_at(place.lon_deg)]) {
    const LonLat& p = begin_of(side);
    const LonLat& q = end_of(side);
    if ((p.lon_deg > place.lon_deg) == (q.lon_deg > place.lon_deg)) continue;
    if (doubled_areas_[side.ring] < hole_area) continue;
    const double share = (place.lon_deg - p.lon_deg) / (q.lon_deg - p.lon_deg);
    const double lat = std::lerp(p.lat_deg, q.lat_deg, share);
    if (lat > place.lat_deg + slack_deg || lat <= nearest) continue;
    nearest = lat;
    owner = side.ring;
  }
  return owner;
}

const LonLat& HoleOwners::begin_of(const OuterSide& side) const {
  return outer_[side.ring][side.side];
}

const LonLat& HoleOwners::end_of(const OuterSide& side) const {
  const Loop& ring = outer_[side.ring];
  return ring[side.side + 1 == ring.size() ? 0 : side.side + 1];
}

std::size_t HoleOwners::list_at(double lon_deg) const {
  const double share = (lon_deg + 180) / 360;
  const auto list = static_cast<std::size_t>(share * static_cast<double>(lists_.size()));
  return std::min(list, lists_.size() - 1);
}

}  // namespace rondel::map
