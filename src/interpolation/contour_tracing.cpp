// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "interpolation/contour_tracing.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "exact/vector.h"
#include "system/parallel.h"

namespace rondel::interpolation {
namespace {

constexpr std::size_t faces_at_a_time = 8192;

}  // namespace

ContourTracer::ContourTracer(ContourSurface surface, std::span<const double> values,
                             std::span<const double> levels, RegionKind kind,
                             const Execution& execution)
    : surface_(std::move(surface)),
      levels_(levels),
      kind_(kind),
      faces_(surface_, values),
      region_of_(values.size()),
      content_(faces_.size()),
      lowest_(faces_.size()),
      first_piece_(faces_.size() + 1, 0),
      mixed_faces_(num_regions()) {
  find_levels(values, execution.threads);
  find_pieces(execution.threads);
  taken_.resize(first_piece_.back());
  list_mixed_faces();
  if (kind == RegionKind::band) connect();
}

ValueRange ContourTracer::range(std::size_t region) const {
  ValueRange range;
  if (region > 0) range.low = levels_[region - 1];
  if (region < levels_.size() && kind_ == RegionKind::band) range.high = levels_[region];
  return range;
}

void ContourTracer::find_levels(std::span<const double> values, unsigned threads) {
  system::parallel_for(
      threads, values.size(), faces_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (std::isnan(values[i])) continue;
          const auto above = std::ranges::upper_bound(levels_, values[i]);
          region_of_[i] = static_cast<std::uint32_t>(std::distance(levels_.begin(), above));
        }
      });
}

void ContourTracer::find_pieces(unsigned threads) {
  const auto for_each_face = [&](const auto& work) {
    system::parallel_for(threads, faces_.size(), faces_at_a_time, work);
  };
  for_each_face([&](std::size_t begin, std::size_t end) { faces_.find_missing(begin, end); });
  for_each_face([&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) classify(static_cast<Index>(f), first_piece_[f + 1]);
  });
  for (std::size_t f = 0; f < faces_.size(); ++f) first_piece_[f + 1] += first_piece_[f];
}

// A face whose values are all strictly between two levels contains no border except that of the
// surface.
void ContourTracer::classify(Index face, std::uint64_t& num_pieces) {
  if (faces_.is_missing(face)) {
    content_[face] = Content::missing;
    return;
  }
  const auto& [a, b, c] = faces_.corners(face);
  const auto [low, high] = std::minmax({region_of_[a], region_of_[b], region_of_[c]});
  const double least = std::min({faces_.value(a), faces_.value(b), faces_.value(c)});
  bool is_plain = low == high && least > range(low).low;
  for (std::size_t edge = 0; edge < 3 && kind_ == RegionKind::band; ++edge) {
    is_plain = is_plain && faces_.across(face, edge) != no_index;
  }
  content_[face] = is_plain ? Content::plain : Content::mixed;
  lowest_[face] = low;
  num_pieces = high - low + 1;
}

void ContourTracer::list_mixed_faces() {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (content_[f] != Content::mixed) continue;
    const auto face = static_cast<Index>(f);
    for (std::size_t k = lowest_[f]; k <= highest(face); ++k) mixed_faces_[k].push_back(face);
  }
}

// Links lead to pieces of lower numbers, so that one pass at the end leads each piece to the first
// of its part.
void ContourTracer::connect() {
  part_.resize(first_piece_.back());
  for (std::uint64_t i = 0; i < part_.size(); ++i) part_[i] = i;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto face = static_cast<Index>(f);
    if (content_[f] == Content::plain) connect_plain(face);
    if (content_[f] == Content::mixed) connect_mixed(face);
  }
  for (std::uint64_t& part : part_) part = part_[part];
}

void ContourTracer::connect(std::uint64_t a, std::uint64_t b) {
  const auto root = [&](std::uint64_t i) {
    while (part_[i] != i) i = part_[i] = part_[part_[i]];
    return i;
  };
  const auto [low, high] = std::minmax({root(a), root(b)});
  part_[high] = low;
}

void ContourTracer::connect_plain(Index face) {
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Index other = faces_.across(face, edge);
    if (other > face || content_[other] != Content::plain) continue;
    connect(first_piece_[face], first_piece_[other]);
  }
}

void ContourTracer::connect_mixed(Index face) {
  for (std::size_t k = lowest_[face]; k <= highest(face); ++k) {
    const ValueRange values = range(k);
    PieceSide place{face, 0, faces_.piece(face, values)};
    for (place.side = 0; place.side < place.piece.size; ++place.side) {
      if (kind(place, values) != SideKind::inner) continue;
      const Index other = faces_.across(face, place.piece.edge_of(place.side));
      connect(piece_name(face, k), piece_name(other, k));
    }
  }
}

std::size_t ContourTracer::region_without_border() const {
  if (content_.empty()) return num_regions();
  for (std::size_t f = 0; f < content_.size(); ++f) {
    const bool is_at_gap =
        content_[f] == Content::missing || faces_.is_at_border(static_cast<Index>(f));
    if (is_at_gap) return num_regions();
  }
  std::vector<std::uint64_t> sizes(part_.size(), 0);
  for (const std::uint64_t part : part_) ++sizes[part];
  const auto largest =
      static_cast<std::uint64_t>(std::distance(sizes.begin(), std::ranges::max_element(sizes)));
  const auto past = std::ranges::upper_bound(first_piece_, largest);
  const auto face = static_cast<Index>(std::distance(first_piece_.begin(), past) - 1);
  return lowest_[face] + static_cast<std::size_t>(largest - first_piece_[face]);
}

ContourTracer::SideKind ContourTracer::kind(const PieceSide& place, const ValueRange& range) const {
  const std::size_t edge = place.piece.edge_of(place.side);
  if (edge == 3) return SideKind::line;
  const Index other = faces_.across(place.face, edge);
  if (other == no_index) return SideKind::rim;
  return faces_.has_piece(other, range) ? SideKind::inner : SideKind::line;
}

void ContourTracer::cross(PieceSide& place, const ValueRange& range) const {
  const std::size_t edge = place.piece.edge_of(place.side);
  const Index other = faces_.across(place.face, edge);
  const std::size_t twin = faces_.twin(place.face, edge, other);
  place = {other, 0, faces_.piece(other, range)};
  while (place.piece.edge_of(place.side) != twin) ++place.side;
}

void ContourTracer::go_on(PieceSide& place, const ValueRange& range) const {
  place.side = place.piece.next(place.side);
  while (kind(place, range) == SideKind::inner) {
    cross(place, range);
    place.side = place.piece.next(place.side);
  }
}

void ContourTracer::go_back(PieceSide& place, const ValueRange& range) const {
  place.side = place.piece.previous(place.side);
  while (kind(place, range) == SideKind::inner) {
    cross(place, range);
    place.side = place.piece.previous(place.side);
  }
}

bool ContourTracer::take(const PieceSide& place, std::size_t region) {
  std::uint8_t& sides = taken_[piece_name(place.face, region)];
  const auto bit = static_cast<std::uint8_t>(1U << place.side);
  const bool is_new = (sides & bit) == 0;
  sides |= bit;
  return is_new;
}

TracedLines ContourTracer::rings(std::size_t region) {
  TracedLines out;
  const ValueRange values = range(region);
  std::vector<Point> ring;
  for (const Index face : mixed_faces_[region]) {
    const ContourPiece piece = faces_.piece(face, values);
    for (std::size_t side = 0; side < piece.size; ++side) {
      PieceSide place{face, side, piece};
      if (kind(place, values) == SideKind::inner) continue;
      ring.clear();
      while (take(place, region)) {
        ring.push_back(point(place.piece.corners[place.side]));
        go_on(place, values);
      }
      append_simple_lines(ring, true, out);
      out.component.resize(out.lines.size(), part_[piece_name(face, region)]);
    }
  }
  return out;
}

// Follows a line to its end, or around. A line with an end is also followed back to its beginning.
TracedLines ContourTracer::lines(std::size_t region) {
  TracedLines out;
  const ValueRange values = range(region);
  std::vector<Point> line;
  for (const Index face : mixed_faces_[region]) {
    const ContourPiece piece = faces_.piece(face, values);
    for (std::size_t side = 0; side < piece.size; ++side) {
      const PieceSide first{face, side, piece};
      if (kind(first, values) != SideKind::line || !take(first, region)) continue;
      line.assign({point(piece.corners[side])});
      PieceSide place = first;
      const auto last_point = [&] {
        line.push_back(point(place.piece.corners[place.piece.next(place.side)]));
      };
      last_point();
      bool is_rim = false;
      for (go_on(place, values);; go_on(place, values)) {
        is_rim = kind(place, values) == SideKind::rim;
        if (is_rim || !take(place, region)) break;
        last_point();
      }
      if (is_rim) {
        place = first;
        std::ranges::reverse(line);
        for (go_back(place, values); kind(place, values) == SideKind::line;
             go_back(place, values)) {
          take(place, region);
          line.push_back(point(place.piece.corners[place.side]));
        }
        std::ranges::reverse(line);
      } else {
        line.pop_back();  // the first point, which comes again
      }
      append_simple_lines(line, !is_rim, out);
    }
  }
  return out;
}

Point ContourTracer::direction(Index site) const {
  const auto& representatives = surface_.representatives;
  const auto first_site =
      representatives.empty() ? representatives.end() : representatives.find(site);
  const Index place = first_site == representatives.end() ? site : first_site->second;
  return normalized(scaled(surface_.sites[place] - surface_.center));
}

// Returns the direction of a point on the chord between the two sites. Its share of the chord grows
// with the level, whatever is rounded.
Point ContourTracer::point(const PieceCorner& corner) const {
  const Point low = direction(corner.lower);
  if (corner.upper == no_index) return low;
  const double begin = faces_.value(corner.lower);
  const double end = faces_.value(corner.upper);
  const double share = std::isfinite(end - begin)
                           ? (corner.level - begin) / (end - begin)
                           : (corner.level / 2 - begin / 2) / (end / 2 - begin / 2);
  const Point place = low + share * (direction(corner.upper) - low);
  return place == Point{} ? low : normalized(place);
}

}  // namespace rondel::interpolation
