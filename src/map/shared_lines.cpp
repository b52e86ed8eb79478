// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/shared_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rondel::map {
namespace {

bool is_on_border(const LonLat& p) {
  return std::abs(p.lon_deg) == 180 || std::abs(p.lat_deg) == 90;
}

}  // namespace

LonLat SharedLines::place(LonLat position) const {
  for (auto found = merged_.find(position); found != merged_.end();
       found = merged_.find(position)) {
    position = found->second;
  }
  return position;
}

std::optional<LonLat> SharedLines::division_of(const LonLat& a, const LonLat& b) const {
  const auto found = divisions_.find(std::minmax(a, b, InPlane()));
  if (found == divisions_.end()) return std::nullopt;
  const LonLat position = place(found->second);
  return position == a || position == b ? std::nullopt : std::optional(position);
}

bool SharedLines::leads_back(const LonLat& a, const LonLat& b, const LonLat& position) const {
  std::vector<DirectedLine> sides;
  for (const LonLat& end : {a, b}) {
    Descent descent;
    append_line(end, position, descent, sides);
  }
  return std::ranges::any_of(sides, [&](const DirectedLine& side) {
    return (side.from == a && side.to == b) || (side.from == b && side.to == a);
  });
}

bool SharedLines::is_current(const LonLat& a, const LonLat& b) const {
  if (merged_.contains(a) || merged_.contains(b)) return false;
  const std::optional<LonLat> position = division_of(a, b);
  return !position || leads_back(a, b, *position);
}

bool SharedLines::divide(const LonLat& a, const LonLat& b, const LonLat& at) {
  if (at == a || at == b || !is_current(a, b)) return false;
  const LonLat position = place(at);
  if (position == a || position == b) return false;
  if (leads_back(a, b, position)) {
    return merge(distance_in_plane(a, position) < distance_in_plane(b, position) ? a : b, position);
  }
  divisions_.insert_or_assign(std::minmax(a, b, InPlane()), position);
  return true;
}

bool SharedLines::merge(const LonLat& a, const LonLat& b) {
  LonLat kept = place(a);
  LonLat gone = place(b);
  if (kept == gone || !are_near_in_plane(kept, gone)) return false;
  if (is_on_border(kept) == is_on_border(gone) ? InPlane()(gone, kept) : is_on_border(gone))
    std::swap(kept, gone);
  if (is_on_border(gone) && std::abs(gone.lon_deg) != std::abs(kept.lon_deg)) return false;
  merged_.emplace(gone, kept);
  return true;
}

// Appends the parts of a line. After positions have been merged, the divisions of a line may lead
// back to it; such a line is appended undivided, since the lines between go back on themselves.
void SharedLines::append_line(const LonLat& a, const LonLat& b, Descent& descent,
                              std::vector<DirectedLine>& out) const {
  if (a == b) return;
  const std::optional<LonLat> position = division_of(a, b);
  const Ends ends = std::minmax(a, b, InPlane());
  if (!position || descent.budget == 0 ||
      std::ranges::find(descent.path, ends) != descent.path.end()) {
    out.push_back({a, b});
    return;
  }
  --descent.budget;
  descent.path.push_back(ends);
  append_line(a, *position, descent, out);
  append_line(*position, b, descent, out);
  descent.path.pop_back();
}

// Appends the sides so that a line and its reverse are divided alike.
void SharedLines::append_sides(const Loop& loop, std::vector<DirectedLine>& out) const {
  if (loop.empty()) return;
  LonLat before = place(loop.back());
  for (const LonLat& position : loop) {
    const LonLat here = place(position);
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    Descent descent;
    if (InPlane()(before, here)) {
      append_line(before, here, descent, out);
    } else {
      append_line(here, before, descent, out);
      std::for_each(out.begin() + first, out.end(),
                    [](DirectedLine& line) { std::swap(line.from, line.to); });
      std::reverse(out.begin() + first, out.end());
    }
    before = here;
  }
}

}  // namespace rondel::map
