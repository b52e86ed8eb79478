// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "interpolation/contour_tracing.h"
#include "system/hash.h"

namespace rondel::interpolation {
namespace {

// Returns false only if all points of the line differ; compares hashes.
bool may_repeat(std::span<const Point> line) {
  std::vector<std::uint64_t> hashes(line.size());
  std::ranges::transform(line, hashes.begin(), [](const Point& p) { return system::hash_of(p); });
  std::ranges::sort(hashes);
  return std::ranges::adjacent_find(hashes) != hashes.end();
}

// Appends a line unless it has too few points: a closed one has three, an open one two.
void append_line(std::span<const Point> line, bool is_closed, TracedLines& out) {
  if (line.size() < (is_closed ? 3U : 2U)) return;
  out.lines.append(line);
  out.is_closed.push_back(is_closed ? 1 : 0);
}

}  // namespace

void append_simple_lines(std::span<const Point> line, bool is_closed, TracedLines& out) {
  if (!may_repeat(line)) {
    append_line(line, is_closed, out);
    return;
  }
  const auto key = [](const Point& p) { return std::tuple(p.x, p.y, p.z); };
  std::map<std::tuple<double, double, double>, std::size_t> places;
  std::vector<Point> open;
  for (const Point& p : line) {
    const auto [place, is_new] = places.try_emplace(key(p), open.size());
    if (is_new) {
      open.push_back(p);
      continue;
    }
    const std::size_t first = place->second;
    append_line(std::span(open).subspan(first), true, out);
    while (open.size() > first + 1) {
      places.erase(key(open.back()));
      open.pop_back();
    }
  }
  append_line(open, is_closed, out);
}

}  // namespace rondel::interpolation
