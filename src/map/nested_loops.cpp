// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "map/map_plane.h"
#include "map/planar_loops.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

using Ring = std::span<const LonLat>;

constexpr std::size_t loops_per_task = 64;

// Lists the sides of all loops by longitude, to find those above a position.
class SidesByLongitude {
 public:
  explicit SidesByLongitude(std::span<const std::vector<LonLat>> loops) : loops_(loops) {
    constexpr std::size_t most = 1 << 16;
    constexpr std::size_t sides_in_a_list = 8;
    std::size_t count = 0;
    for (const auto& loop : loops) count += loop.size();
    lists_.resize(std::clamp<std::size_t>(count / sides_in_a_list, 1, most));
    for (std::size_t i = 0; i < loops.size(); ++i) {
      for (std::size_t k = 0; k < loops[i].size(); ++k) {
        const auto [p, q] = ends(i, k);
        const auto [west, east] = std::minmax(p.lon_deg, q.lon_deg);
        for (std::size_t list = list_at(west); list <= list_at(east); ++list) {
          lists_[list].emplace_back(i, k);
        }
      }
    }
  }

  // Finds the loops that have a position inside (inside[i] is true), and those that have it as a
  // corner (`touched`, for which `inside` means nothing).
  void find_around(const LonLat& p, std::map<std::size_t, bool>& inside,
                   std::set<std::size_t>& touched) const {
    for (const auto& [i, k] : lists_[list_at(p.lon_deg)]) {
      const auto [a, b] = ends(i, k);
      if (a == p || b == p) touched.insert(i);
      if ((a.lon_deg > p.lon_deg) == (b.lon_deg > p.lon_deg)) continue;
      const Sign side = b.lon_deg > a.lon_deg ? side_of_line(a, b, p) : side_of_line(b, a, p);
      if (side == Sign::positive) inside[i] = !inside[i];
    }
  }

 private:
  [[nodiscard]] std::array<LonLat, 2> ends(std::size_t i, std::size_t k) const {
    const Ring loop = loops_[i];
    return {loop[k], loop[k + 1 == loop.size() ? 0 : k + 1]};
  }
  [[nodiscard]] std::size_t list_at(double lon_deg) const {
    return part_of_longitudes(lon_deg, lists_.size());
  }

  std::span<const std::vector<LonLat>> loops_;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> lists_;
};

// True if the direction to d comes between those to a and b, counterclockwise around the position
// `at`.
bool is_in_turn(const LonLat& at, const LonLat& a, const LonLat& d, const LonLat& b) {
  const bool after_a = is_before_around(at, a, d);
  const bool before_b = is_before_around(at, d, b);
  return is_before_around(at, a, b) ? after_a && before_b : after_a || before_b;
}

// True if a side from a corner of a loop to `end` begins inside of the loop.
bool begins_inside(Ring loop, const LonLat& corner, const LonLat& end) {
  const auto k = static_cast<std::size_t>(std::ranges::find(loop, corner) - loop.begin());
  const LonLat& before = loop[k == 0 ? loop.size() - 1 : k - 1];
  const LonLat& after = loop[k + 1 == loop.size() ? 0 : k + 1];
  return is_counterclockwise(loop) ? is_in_turn(corner, after, end, before)
                                   : is_in_turn(corner, before, end, after);
}

// Returns the loops around loop `self`. Its southernmost corner decides; for a loop that has this
// corner too, the next corner that it has not; for a loop that has all corners, a side.
std::set<std::size_t> loops_around(const SidesByLongitude& sides,
                                   std::span<const std::vector<LonLat>> loops, std::size_t self) {
  const Ring loop = loops[self];
  std::set<std::size_t> around;
  std::set<std::size_t> open;
  const auto south =
      static_cast<std::size_t>(std::ranges::min_element(loop, {}, &LonLat::lat_deg) - loop.begin());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    std::map<std::size_t, bool> inside;
    std::set<std::size_t> touched;
    sides.find_around(loop[(south + k) % loop.size()], inside, touched);
    for (const auto& [i, is_inside] : inside) {
      if (is_inside && i != self && !touched.contains(i) && (k == 0 || open.contains(i)))
        around.insert(i);
    }
    touched.erase(self);
    std::set<std::size_t> left;
    for (const std::size_t i : touched) {
      if (k == 0 || open.contains(i)) left.insert(i);
    }
    open = std::move(left);
    if (open.empty()) break;
  }
  for (const std::size_t i : open) {
    if (begins_inside(loops[i], loop[0], loop[1])) around.insert(i);
  }
  return around;
}

double area_of_loop(Ring loop) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const LonLat& o = loop.front();
    area += (loop[i].lon_deg - o.lon_deg) * (loop[i + 1].lat_deg - o.lat_deg) -
            (loop[i + 1].lon_deg - o.lon_deg) * (loop[i].lat_deg - o.lat_deg);
  }
  return std::abs(area);
}

}  // namespace

std::vector<std::size_t> owners_of(std::span<const std::vector<LonLat>> loops,
                                   std::size_t num_outer, unsigned threads) {
  std::vector<std::size_t> owners(loops.size(), misplaced);
  if (loops.size() == 1) {
    if (num_outer == 1) owners[0] = 0;
    return owners;
  }
  std::vector<double> sizes(loops.size());
  std::ranges::transform(loops, sizes.begin(), [](Ring loop) { return area_of_loop(loop); });
  const SidesByLongitude sides(loops);
  const auto owner_of = [&](std::size_t i) {
    int depth = 0;
    std::size_t smallest = misplaced;
    for (const std::size_t other : loops_around(sides, loops, i)) {
      depth += other < num_outer ? 1 : -1;
      if (other < num_outer && (smallest == misplaced || sizes[other] < sizes[smallest]))
        smallest = other;
    }
    if (i < num_outer) return depth == 0 ? i : misplaced;
    return depth == 1 ? smallest : misplaced;
  };
  system::parallel_for(threads, loops.size(), loops_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) owners[i] = owner_of(i);
                       });
  return owners;
}

}  // namespace rondel::map
