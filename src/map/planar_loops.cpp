// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/planar_loops.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <utility>

#include "map/map_plane.h"
#include "system/hash.h"

namespace rondel::map {
namespace {

bool is_lower(const LonLat& p, const LonLat& q) { return InPlane()(p, q); }

// The sides at a position that more than one side leaves.
struct Star {
  std::vector<LonLat> out;  // the beginnings of sides that reach the position
  std::vector<LonLat> in;   // beginnings of lines that reach it
};
using Stars = std::map<LonLat, Star, InPlane>;

Stars stars_of(std::span<const DirectedLine> lines) {
  std::vector<LonLat> starts;
  starts.reserve(lines.size());
  for (const DirectedLine& line : lines) starts.push_back(line.from);
  std::ranges::sort(starts, InPlane());
  Stars stars;
  for (std::size_t i = 1; i < starts.size(); ++i) {
    if (starts[i] == starts[i - 1]) stars[starts[i]];
  }
  if (stars.empty()) return stars;
  for (const DirectedLine& line : lines) {
    if (const auto star = stars.find(line.from); star != stars.end())
      star->second.out.push_back(line.to);
    if (const auto star = stars.find(line.to); star != stars.end())
      star->second.in.push_back(line.from);
  }
  return stars;
}

// A side at a position, seen from the position: its other end.
struct SideRay {
  LonLat end;
  bool leaves = false;
};

std::vector<SideRay> rays_around(const LonLat& at, const Star& star) {
  std::vector<SideRay> rays;
  for (const LonLat& end : star.out) rays.push_back({end, true});
  for (const LonLat& end : star.in) rays.push_back({end, false});
  std::ranges::stable_sort(
      rays, [&](const SideRay& x, const SideRay& y) { return is_before_around(at, x.end, y.end); });
  return rays;
}

// Maps a position and the one before it to the one after it. A side that reaches the position is
// continued by the first side clockwise from it, across the region.
std::map<std::pair<LonLat, LonLat>, LonLat,
         bool (*)(const std::pair<LonLat, LonLat>&, const std::pair<LonLat, LonLat>&)>
turns_at(const Stars& stars) {
  using Key = std::pair<LonLat, LonLat>;  // a position, and the one before it
  std::map<Key, LonLat, bool (*)(const Key&, const Key&)> turns([](const Key& x, const Key& y) {
    return x.first == y.first ? is_lower(x.second, y.second) : is_lower(x.first, y.first);
  });
  for (const auto& [at, star] : stars) {
    const std::vector<SideRay> rays = rays_around(at, star);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const SideRay& before = rays[i == 0 ? rays.size() - 1 : i - 1];
      if (!rays[i].leaves && before.leaves) turns.emplace(Key{at, rays[i].end}, before.end);
    }
  }
  return turns;
}

// Splits a loop into simple loops, one for each part between two visits of a position.
void append_simple(const Loop& loop, std::vector<Loop>& found) {
  std::map<LonLat, std::size_t, InPlane> places;
  Loop open;
  for (const LonLat& position : loop) {
    const auto [place, is_new] = places.try_emplace(position, open.size());
    if (is_new) {
      open.push_back(position);
      continue;
    }
    const auto first = open.begin() + static_cast<std::ptrdiff_t>(place->second);
    found.emplace_back(first, open.end());
    std::for_each(first + 1, open.end(), [&](const LonLat& p) { places.erase(p); });
    open.erase(first + 1, open.end());
  }
  found.push_back(std::move(open));
}

// Returns the numbers of both ends of a line, the lower end first.
std::array<double, 4> ends_of(const DirectedLine& line) {
  const auto [low, high] = std::minmax(line.from, line.to, InPlane());
  return {low.lon_deg, low.lat_deg, high.lon_deg, high.lat_deg};
}

// Returns lines, ascending, among them all that have both ends in common with another line. They share
// a bit of a hash, which few others do by chance: one of 8 at most.
std::vector<std::size_t> lines_that_may_share_ends(std::span<const DirectedLine> lines) {
  const int shift = 61 - static_cast<int>(std::bit_width(lines.size()));
  std::vector<std::uint64_t> hashes;
  hashes.reserve(lines.size());
  for (const DirectedLine& line : lines) {
    std::uint64_t hash = 0;
    for (const double number : ends_of(line)) hash = system::mixed(hash, system::bits_of(number));
    hashes.push_back(hash * system::golden_multiplier >> shift);
  }
  std::vector<bool> is_seen(std::size_t{1} << (64 - shift), false);
  std::vector<bool> is_shared(is_seen.size(), false);
  for (const std::uint64_t hash : hashes) {
    if (is_seen[hash]) is_shared[hash] = true;
    is_seen[hash] = true;
  }
  std::vector<std::size_t> sharing;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_shared[hashes[i]]) sharing.push_back(i);
  }
  return sharing;
}

}  // namespace

double doubled_loop_area(std::span<const LonLat> loop) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const LonLat& o = loop.front();
    area += (loop[i].lon_deg - o.lon_deg) * (loop[i + 1].lat_deg - o.lat_deg) -
            (loop[i + 1].lon_deg - o.lon_deg) * (loop[i].lat_deg - o.lat_deg);
  }
  return area;
}

bool has_touching(std::span<const Loop> loops) {
  std::vector<LonLat> positions;
  for (const Loop& loop : loops) positions.insert(positions.end(), loop.begin(), loop.end());
  std::ranges::sort(positions, InPlane());
  return std::ranges::adjacent_find(positions) != positions.end();
}

void cancel_opposite(std::vector<DirectedLine>& lines) {
  const auto key = [&](std::size_t i) { return ends_of(lines[i]); };
  std::vector<std::size_t> order = lines_that_may_share_ends(lines);
  std::ranges::stable_sort(order, {}, key);
  std::vector<bool> is_gone(lines.size(), false);
  std::vector<std::size_t> kept;
  for (auto at = order.begin(); at != order.end();) {
    const auto ends = key(*at);
    kept.clear();
    for (; at != order.end() && key(*at) == ends; ++at) {
      const std::size_t line = *at;
      if (!kept.empty() && !(lines[kept.back()] == lines[line])) {
        is_gone[line] = true;
        is_gone[kept.back()] = true;
        kept.pop_back();
      } else {
        kept.push_back(line);
      }
    }
  }
  std::size_t i = 0;
  std::erase_if(lines, [&](const DirectedLine&) { return is_gone[i++]; });
}

std::vector<SideWedge> unpaired_sides(std::span<const DirectedLine> lines) {
  std::vector<SideWedge> wedges;
  for (const auto& [at, star] : stars_of(lines)) {
    const std::vector<SideRay> rays = rays_around(at, star);
    std::vector<SideWedge> here;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const SideRay& next = rays[i + 1 == rays.size() ? 0 : i + 1];
      here.push_back({at, rays[i].end, next.end, rays[i].leaves != next.leaves});
    }
    if (std::ranges::all_of(here, &SideWedge::is_paired)) continue;
    wedges.insert(wedges.end(), here.begin(), here.end());
  }
  return wedges;
}

std::vector<Loop> traced_loops(std::span<const DirectedLine> lines) {
  const auto turns = turns_at(stars_of(lines));
  std::vector<DirectedLine> sorted(lines.begin(), lines.end());
  std::ranges::sort(sorted, [](const DirectedLine& x, const DirectedLine& y) {
    return x.from == y.from ? is_lower(x.to, y.to) : is_lower(x.from, y.from);
  });
  std::vector<bool> is_used(sorted.size(), false);
  const auto find = [&](const LonLat& from, const LonLat* to) {
    auto line = std::ranges::lower_bound(sorted, from, InPlane(), &DirectedLine::from);
    while (to != nullptr && !(line->to == *to)) ++line;
    return static_cast<std::size_t>(line - sorted.begin());
  };
  std::vector<Loop> found;
  for (std::size_t first = 0; first < sorted.size(); ++first) {
    Loop loop;
    for (std::size_t i = first; !is_used[i];) {
      is_used[i] = true;
      loop.push_back(sorted[i].from);
      const auto turn = turns.find({sorted[i].to, sorted[i].from});
      i = find(sorted[i].to, turn == turns.end() ? nullptr : &turn->second);
    }
    if (!loop.empty()) append_simple(loop, found);
  }
  return found;
}

PolygonsOfLoops polygons_of_loops(std::vector<Loop> loops, unsigned threads) {
  PolygonsOfLoops result;
  const auto first_hole = std::stable_partition(
      loops.begin(), loops.end(), [](const Loop& loop) { return is_counterclockwise(loop); });
  const auto num_outer = static_cast<std::size_t>(first_hole - loops.begin());
  const std::vector<std::size_t> owners = owners_of(loops, num_outer, threads);
  std::vector<std::size_t> places(num_outer);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (owners[i] == misplaced) {
      result.misplaced.push_back(loops[i]);
    } else if (i < num_outer) {
      places[i] = result.polygons.size();
      result.polygons.emplace_back();
      result.polygons.back().rings.push_back(std::move(loops[i]));
    } else if (owners[owners[i]] != misplaced) {
      result.polygons[places[owners[i]]].rings.push_back(std::move(loops[i]));
    }
  }
  for (PolygonWithHoles& polygon : result.polygons) {
    for (Loop& ring : polygon.rings) ring.push_back(ring.front());
  }
  return result;
}

}  // namespace rondel::map
