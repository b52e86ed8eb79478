// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/windings.h"

#include <algorithm>

#include "map/map_plane.h"

namespace rondel::map {
namespace {

DirectedLine eastward(const DirectedLine& line) {
  return line.from.lon_deg < line.to.lon_deg ? line : DirectedLine{line.to, line.from};
}

// Whether line x is below line y, both eastward, where both are: the sign of an end of one that lies beside the other.
bool is_below(const DirectedLine& x, const DirectedLine& y) {
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
  return false;  // the same line
}

}  // namespace

Windings::Windings(std::span<const DirectedLine> lines) : lines_(lines) {
  constexpr std::size_t most = 1 << 14;
  lists_.resize(std::clamp<std::size_t>(lines.size() / 8, 1, most));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto [west, east] = std::minmax(lines[i].from.lon_deg, lines[i].to.lon_deg);
    for (std::size_t list = list_at(west); list <= list_at(east); ++list) lists_[list].push_back(i);
  }
}

std::size_t Windings::list_at(double lon_deg) const {
  const double share = (lon_deg + 180) / 360;
  const auto list = static_cast<std::size_t>(share * static_cast<double>(lists_.size()));
  return std::min(list, lists_.size() - 1);
}

// The windings are counted along the meridian just east of the western end of the line; beside a meridian, just east of it
// and just west of it, just above its southern end.
std::pair<int, int> Windings::beside(const DirectedLine& line) const {
  const bool is_upright = line.from.lon_deg == line.to.lon_deg;
  const double west = std::min(line.from.lon_deg, line.to.lon_deg);
  const LonLat south = line.from.lat_deg < line.to.lat_deg ? line.from : line.to;
  const DirectedLine own = eastward(line);
  int below = 0;       // just east of that meridian, sum over the lines below
  int below_west = 0;  // just west of it
  int same = 0;        // the lines that are the same as this one
  for (const std::size_t i : lists_[list_at(west)]) {
    const DirectedLine& other = lines_[i];
    const int step = other.from.lon_deg < other.to.lon_deg ? 1 : -1;
    const DirectedLine east = eastward(other);
    if (east.from.lon_deg == east.to.lon_deg) continue;
    if (is_upright) {
      if (east.from.lon_deg > west || east.to.lon_deg < west) continue;
      if (side_of_line(east.from, east.to, south) == Sign::negative) continue;
      if (east.to.lon_deg > west) below += step;
      if (east.from.lon_deg < west) below_west += step;
    } else {
      if (east.from.lon_deg > west || east.to.lon_deg <= west) continue;
      if (east == own) {
        same += step;
      } else if (is_below(east, own)) {
        below += step;
      }
    }
  }
  if (is_upright) {
    return line.from.lat_deg < line.to.lat_deg ? std::pair(below_west, below)
                                               : std::pair(below, below_west);
  }
  const bool leads_east = line.from.lon_deg < line.to.lon_deg;
  return leads_east ? std::pair(below + same, below) : std::pair(below, below + same);
}

}  // namespace rondel::map
