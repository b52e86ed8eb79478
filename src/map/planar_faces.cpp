// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/planar_faces.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "map/map_plane.h"

namespace rondel::map {
namespace {

using RegionCounts = std::vector<NodedLine::RegionCount>;

// Returns counts + sign * more.
RegionCounts added(const RegionCounts& counts, const RegionCounts& more, int sign) {
  RegionCounts sum;
  auto count = counts.begin();
  auto other = more.begin();
  while (count != counts.end() || other != more.end()) {
    if (other == more.end() || (count != counts.end() && count->region < other->region)) {
      sum.push_back(*count++);
    } else if (count == counts.end() || other->region < count->region) {
      sum.push_back({other->region, sign * other->count});
      ++other;
    } else {
      const int both = count->count + sign * other->count;
      if (both != 0) sum.push_back({count->region, both});
      ++count;
      ++other;
    }
  }
  return sum;
}

// Returns the region with the largest positive count, the first one of several, or no_region.
std::size_t region_of_counts(const RegionCounts& counts) {
  std::size_t region = no_region;
  int most = 0;
  for (const auto& [own, count] : counts) {
    if (count <= most) continue;
    most = count;
    region = own;
  }
  return region;
}

// True if line x is below line y just to the east of a longitude that both have.
bool is_lower_line(const NodedLine& x, const NodedLine& y) {
  for (const LonLat& end : {x.from, x.to}) {
    if (end.lon_deg < y.from.lon_deg || end.lon_deg > y.to.lon_deg) continue;
    const Sign side = side_of_line(y.from, y.to, end);
    if (side != Sign::zero) return side == Sign::negative;
  }
  for (const LonLat& end : {y.from, y.to}) {
    if (end.lon_deg < x.from.lon_deg || end.lon_deg > x.to.lon_deg) continue;
    const Sign side = side_of_line(x.from, x.to, end);
    if (side != Sign::zero) return side == Sign::positive;
  }
  return false;
}

}  // namespace

PlanarFaces::PlanarFaces(std::span<const NodedLine> lines) : lines_(lines) {
  sort_around_positions();
  find_faces();
  list_by_longitude();
  count_all();
  give_to_lost();
}

const LonLat& PlanarFaces::start_of(std::size_t halfedge) const {
  const NodedLine& line = lines_[halfedge / 2];
  return halfedge % 2 == 0 ? line.from : line.to;
}

void PlanarFaces::sort_around_positions() {
  order_.resize(2 * lines_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::sort(order_, [&](std::size_t g, std::size_t h) {
    const LonLat& p = start_of(g);
    const LonLat& q = start_of(h);
    return p == q ? is_before_around(p, end_of(g), end_of(h)) : InPlane()(p, q);
  });
}

// Links the halfedges of faces: at the end of a halfedge, its face continues with the next halfedge
// clockwise from the one that leads back.
void PlanarFaces::find_faces() {
  next_.resize(order_.size());
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t past = first;
    while (past < order_.size() && start_of(order_[past]) == start_of(order_[first])) ++past;
    for (std::size_t i = first; i < past; ++i)
      next_[order_[i] ^ 1U] = order_[i == first ? past - 1 : i - 1];
    first = past;
  }
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  faces_.assign(order_.size(), none);
  for (std::size_t halfedge = 0; halfedge < faces_.size(); ++halfedge) {
    if (faces_[halfedge] != none) continue;
    for (std::size_t h = halfedge; faces_[h] == none; h = next_[h]) faces_[h] = firsts_.size();
    firsts_.push_back(halfedge);
  }
}

// Counts how often the sides of each region go around each face. In the order of halfedges, the
// westernmost position of a connected set of lines (the southernmost of several) comes before the
// others of the set, and after a line below it, which starts before it. So the face around the set
// is counted when the set is reached.
void PlanarFaces::count_all() {
  counts_.resize(firsts_.size());
  is_counted_.assign(firsts_.size(), false);
  regions_.assign(firsts_.size(), no_region);
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t past = first;
    while (past < order_.size() && start_of(order_[past]) == start_of(order_[first])) ++past;
    if (!is_counted_[faces_[order_[first]]]) {
      const std::size_t outer = outer_halfedge(first, past);
      count_from(faces_[outer], counts_below(start_of(outer)));
    }
    first = past;
  }
}

// Returns the halfedge at the westernmost position of a connected set that has the outer face to
// its left. All lines there lead to the east or straight up, so it is the last one
// counterclockwise.
std::size_t PlanarFaces::outer_halfedge(std::size_t first, std::size_t past) const {
  std::size_t outer = order_[first];
  for (std::size_t i = first + 1; i < past; ++i) {
    if (side_of_line(start_of(outer), end_of(outer), end_of(order_[i])) == Sign::positive)
      outer = order_[i];
  }
  return outer;
}

void PlanarFaces::count_from(std::size_t face, Counts counts) {
  std::vector<std::size_t> open = {face};
  counts_[face] = std::move(counts);
  is_counted_[face] = true;
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    regions_[here] = region_of_counts(counts_[here]);
    std::size_t halfedge = firsts_[here];
    do {
      const std::size_t beyond = faces_[halfedge ^ 1U];
      if (!is_counted_[beyond]) {
        is_counted_[beyond] = true;
        counts_[beyond] =
            added(counts_[here], lines_[halfedge / 2].counts, halfedge % 2 == 0 ? -1 : 1);
        open.push_back(beyond);
      }
      halfedge = next_[halfedge];
    } while (halfedge != firsts_[here]);
  }
}

void PlanarFaces::give_to_lost() {
  std::size_t num_regions = 0;
  for (const NodedLine& line : lines_)
    num_regions = std::max(num_regions, line.counts.back().region + 1);
  std::vector<std::size_t> num_faces(num_regions);
  for (const std::size_t region : regions_) {
    if (region != no_region) ++num_faces[region];
  }
  const std::vector<std::size_t> had = num_faces;
  for (std::size_t face = 0; face < regions_.size(); ++face) {
    std::size_t& region = regions_[face];
    for (const auto& [lost, count] : counts_[face]) {
      if (had[lost] > 0) continue;
      if (region != no_region && (num_faces[region] == 1 || had[region] == 0)) break;
      if (region != no_region) --num_faces[region];
      region = lost;
      ++num_faces[lost];
    }
  }
}

// Returns the counts of the face just below a position, slightly to the east of it.
PlanarFaces::Counts PlanarFaces::counts_below(const LonLat& position) const {
  std::optional<std::size_t> highest;
  for (const std::size_t i : lists_[list_at(position.lon_deg)]) {
    const NodedLine& line = lines_[i];
    if (line.from.lon_deg > position.lon_deg || line.to.lon_deg <= position.lon_deg) continue;
    if (side_of_line(line.from, line.to, position) != Sign::positive) continue;
    if (!highest || is_lower_line(lines_[*highest], line)) highest = i;
  }
  return highest ? counts_[faces_[2 * *highest]] : Counts();
}

void PlanarFaces::list_by_longitude() {
  constexpr std::size_t most = 1 << 16;
  constexpr std::size_t lines_in_a_list = 8;
  lists_.resize(std::clamp<std::size_t>(lines_.size() / lines_in_a_list, 1, most));
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto& [from, to, counts] = lines_[i];
    if (from.lon_deg == to.lon_deg) continue;
    for (std::size_t list = list_at(from.lon_deg); list <= list_at(to.lon_deg); ++list)
      lists_[list].push_back(i);
  }
}

std::size_t PlanarFaces::list_at(double lon_deg) const {
  return part_of_longitudes(lon_deg, lists_.size());
}

}  // namespace rondel::map
