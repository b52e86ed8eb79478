// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sides of all polygons are arranged; faces get the polygons that have them (coverage.h). A
// halfedge whose face has a region, while the face beyond does not, is on the border of the region,
// and borders are joined into rings.
#include "arrangement/set_regions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/halfedges.h"
#include "arrangement/lower_parts.h"
#include "arrangement/region_borders.h"
#include "exact/point_order.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

// Returns the regions with lines, which are sorted by their keys, too.
std::vector<Region> with_lines(std::vector<Region> regions, const Arrangement& arranged,
                               std::span<const KeyedLine> lines) {
  std::vector<Region> result;
  std::size_t next = 0;
  for (const KeyedLine& line : lines) {
    while (next < regions.size() && regions[next].key <= line.key) {
      result.push_back(std::move(regions[next++]));
    }
    if (result.empty() || result.back().key != line.key) result.push_back({line.key, {}});
    std::vector<Point>& points = result.back().lines.emplace_back();
    for (const Index node : line.nodes) points.push_back(arranged.nodes[node]);
  }
  while (next < regions.size()) result.push_back(std::move(regions[next++]));
  return result;
}

// The different corners of rings, sorted, and the index among them of each given one.
struct SortedCorners {
  std::vector<Point> points;
  std::vector<Index> numbers;
};

// Deals corners to buckets of their first coordinate, which threads sort.
class CornerSort {
 public:
  CornerSort(std::span<const Point> given, unsigned threads)
      : given_(given),
        threads_(threads),
        num_buckets_(std::max<std::size_t>(given.size() / corners_per_bucket, 1)) {}

  SortedCorners run() {
    const std::vector<Index> begins = deal();
    std::vector<Index> different(num_buckets_ + 1, 0);  // of each bucket, and then before it
    const auto row_of = [&](std::size_t bucket) {
      return std::span(entries_).subspan(begins[bucket], begins[bucket + 1] - begins[bucket]);
    };
    system::parallel_for(threads_, num_buckets_, buckets_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t bucket = begin; bucket < end; ++bucket) {
                             const auto row = row_of(bucket);
                             std::ranges::sort(row, is_before);
                             for (std::size_t k = 0; k < row.size(); ++k)
                               different[bucket + 1] += is_new(row, k);
                           }
                         });
    system::sum_counts(different);
    SortedCorners result;
    result.points.resize(different.back());
    result.numbers.resize(given_.size());
    system::parallel_for(threads_, num_buckets_, buckets_per_task,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t bucket = begin; bucket < end; ++bucket) {
                             const auto row = row_of(bucket);
                             Index next = different[bucket];
                             for (std::size_t k = 0; k < row.size(); ++k) {
                               if (is_new(row, k) != 0) result.points[next++] = row[k].point;
                               result.numbers[row[k].corner] = next - 1;
                             }
                           }
                         });
    return result;
  }

 private:
  static constexpr std::size_t corners_per_bucket = 256;
  static constexpr std::size_t buckets_per_task = 64;

  struct SortedCorner {
    Point point;
    Index corner;
  };

  static bool is_before(const SortedCorner& a, const SortedCorner& b) {
    return a.point == b.point ? a.corner < b.corner : exact::is_less(a.point, b.point);
  }
  // Returns 1 for the first of equal corners, and otherwise 0.
  static Index is_new(std::span<const SortedCorner> row, std::size_t k) {
    return k == 0 || row[k - 1].point != row[k].point ? 1 : 0;
  }

  // Returns where the entries of each bucket begin. Each step of the arithmetic keeps the order.
  std::vector<Index> deal() {
    entries_.resize(given_.size());
    double least = 0;
    double width = 0;
    if (!given_.empty()) {
      const auto ends = std::ranges::minmax_element(given_, {}, &Point::x);
      least = ends.min->x;
      width = ends.max->x - least;
    }
    constexpr double least_width = 1e-30;
    const double scale = width > least_width ? static_cast<double>(num_buckets_) / width : 0;
    const auto bucket_of = [&](const Point& p) {
      const auto bucket = static_cast<std::size_t>((p.x - least) * scale);
      return std::min(bucket, num_buckets_ - 1);
    };
    system::RowPlaces<Index> places(num_buckets_);
    for (const Point& p : given_) places.count(bucket_of(p));
    places.sum();
    for (Index i = 0; i < given_.size(); ++i) {
      entries_[places.place(bucket_of(given_[i]))] = {given_[i], i};
    }
    return std::move(places).offsets();
  }

  std::span<const Point> given_;
  unsigned threads_;
  std::size_t num_buckets_;
  std::vector<SortedCorner> entries_;
};

constexpr std::size_t rings_per_task = 256;

}  // namespace

Sides mended(const Sides& sides, const std::vector<Index>& polygons, const Execution& execution) {
  std::vector<Index> places(sides.operands.size(), no_index);  // among those that are replaced
  for (Index k = 0; k < polygons.size(); ++k) places[polygons[k]] = k;
  std::vector<Sides> alone(polygons.size());
  Sides result = sides;
  result.are_mended = true;
  result.arcs.clear();
  result.polygons.clear();
  result.lines.clear();
  for (std::size_t arc = 0; arc < sides.arcs.size(); ++arc) {
    const Index polygon = sides.polygons[arc];
    const bool is_replaced = polygon != no_index && places[polygon] != no_index;
    Sides& target = is_replaced ? alone[places[polygon]] : result;
    if (is_replaced) {
      for (const Index end : sides.arcs[arc]) target.points.push_back(sides.points[end]);
      const auto size = static_cast<Index>(target.points.size());
      target.arcs.push_back({size - 2, size - 1});
    } else {
      target.arcs.push_back(sides.arcs[arc]);
      if (!sides.lines.empty()) target.lines.push_back(sides.lines[arc]);
    }
    target.polygons.push_back(is_replaced ? 0 : polygon);
  }
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    alone[k].operands = {0};
    const Region region =
        joined_region(alone[k], SetOperation::unite, RegionParts::areas, execution);
    if (region.is_whole) result.whole[sides.operands[polygons[k]]].push_back(polygons[k]);
    result.append_rings(region.rings, polygons[k]);
  }
  if (!sides.lines.empty()) result.lines.resize(result.arcs.size(), no_index);
  return result;
}

std::vector<Region> regions_of(const Sides& sides, const RegionRule& rule, RegionParts parts,
                               const Execution& execution) {
  const unsigned threads = execution.threads;
  const Arrangement arranged = arrange(sides.points, sides.arcs, execution);
  std::vector<RegionKey> keys_of_first_face;
  std::vector<BorderHalfedge> border;
  const Halfedges halfedges(arranged, threads);
  const CompressedRows<EdgeOfPolygon> polygons = polygons_of_edges(arranged, sides.polygons);
  std::optional<LowerParts> lower;
  if (parts == RegionParts::all) {
    lower.emplace(arranged, halfedges, polygons, sides, rule, threads);
  }
  if (arranged.edges.empty()) {
    const Owners owners = sides.owners_without_edges();
    rule.append_keys(owners, keys_of_first_face);
    if (lower) lower->see_only_face(owners);
  } else {
    Coverage coverage(halfedges, polygons, sides.operands, sides.whole, sides.known, threads);
    const bool do_others_divide = sides.operands.size() > 1 || !sides.lines.empty();
    if (!sides.are_mended && do_others_divide && !coverage.contradictory().empty()) {
      return regions_of(mended(sides, coverage.contradictory(), execution), rule, parts, execution);
    }
    bool is_first = true;
    std::vector<RegionKey> keys;
    coverage.visit([&](Index h, const Owners& owners) {
      if (lower) lower->see(h, owners);
      keys.clear();
      rule.append_keys(owners, keys);
      if (is_first) keys_of_first_face = keys;
      is_first = false;
      for (const RegionKey& key : keys) {
        if (rule.ends_at(key, owners, polygons[h / 2], sides.operands)) border.push_back({key, h});
      }
    });
    std::ranges::sort(border);
  }
  std::vector<Region> regions = bordered_regions(arranged, halfedges, border);
  // A region without a border is everywhere, so also in the first face.
  for (const RegionKey& key : keys_of_first_face) {
    const auto place = std::ranges::lower_bound(regions, key, {}, &Region::key);
    if (place == regions.end() || place->key != key) regions.insert(place, {key, {}, true});
  }
  return lower ? with_lines(std::move(regions), arranged, lower->lines()) : regions;
}

Region joined_region(const Sides& sides, SetOperation operation, RegionParts parts,
                     const Execution& execution) {
  std::vector<Region> regions = regions_of(sides, RegionRule(operation, true), parts, execution);
  return regions.empty() ? Region{} : std::move(regions.front());
}

CellRings cells_of(std::span<const Region> regions, unsigned threads) {
  std::vector<const std::vector<Point>*> rings;
  std::vector<std::size_t> begins(regions.size() + 1, 0);  // the rings of each region
  for (std::size_t k = 0; k < regions.size(); ++k) {
    for (const auto& ring : regions[k].rings) rings.push_back(&ring);
    begins[k + 1] = rings.size();
  }
  const std::vector<std::uint64_t> offsets =
      system::offsets_of(rings.size(), [&](std::size_t r) { return rings[r]->size(); });
  std::vector<Point> corners;
  corners.reserve(offsets.back());
  for (const auto* ring : rings) corners.insert(corners.end(), ring->begin(), ring->end());
  SortedCorners sorted = CornerSort(corners, threads).run();

  std::vector<std::vector<Index>> numbers(rings.size());
  system::parallel_for(
      threads, rings.size(), rings_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
          const auto row =
              std::span(sorted.numbers).subspan(offsets[r], offsets[r + 1] - offsets[r]);
          numbers[r].assign(row.begin(), row.end());
          std::rotate(numbers[r].begin(), std::ranges::min_element(numbers[r]), numbers[r].end());
        }
      });
  CellRings result;
  result.points = std::move(sorted.points);
  result.corners.reserve(corners.size());
  for (std::size_t k = 0; k < regions.size(); ++k) {
    if (regions[k].is_whole) result.whole.push_back(static_cast<Index>(result.num_cells()));
    const auto own = std::span(numbers).subspan(begins[k], begins[k + 1] - begins[k]);
    std::ranges::sort(own);
    for (const auto& ring : own) result.append_ring(ring);
    result.end_cell();
  }
  return result;
}

}  // namespace rondel::arrangement
