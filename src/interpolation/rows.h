// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the rows of many targets: combines what the location decides with what a kernel returns,
// and handles targets that have no value.
//
// in    targets, a kernel, what to do outside
// out   one row for each target, given to a sink (sinks.h)
// index targets; vertices by spatial rank
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "exact/unit_vector.h"
#include "interpolation/linear.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "query/batch.h"
#include "rondel/interpolate.h"
#include "system/prefetch.h"
#include "system/stage_progress.h"

namespace rondel::interpolation {

// The lowest index of all targets without a value, which several threads may report.
class FirstOutside {
 public:
  void add(Index target) {
    std::uint64_t first = first_;
    while (target < first && !first_.compare_exchange_weak(first, target)) {
    }
  }
  // Returns no_index if all targets have values.
  [[nodiscard]] Index get() const { return static_cast<Index>(first_.load()); }

 private:
  std::atomic<std::uint64_t> first_ = no_index;
};

// A lower bound of r. In a face next to which the center lies, smaller values of r are hardly more
// than rounding errors; natural neighbors beyond 90 degrees can make r negative.
constexpr double min_r = 0x1p-20;

// Divides the weights by r = u.(sum of w_i x_i) = 1 - sum of w_i |x_i - u|^2 / 2, or clears the row
// if r is too small.
inline void make_homogeneous(const PreparedTriangulation& prepared, const exact::SplitPoint& u,
                             Row& row) {
  double lacking = 0;
  for (const auto& [v, weight] : row) {
    const Vec s = step(u, prepared.unit(v));
    lacking += weight * dot(s, s);
  }
  const double r = 1 - lacking / 2;
  if (!(r >= min_r)) row.clear();
  for (WeightedVertex& share : row) share.weight /= r;
}
// Clears the row if its weights, which the kernel has divided by r, are too large.
inline void make_homogeneous(const PreparedTriangulation& /*prepared*/,
                             const exact::SplitPoint& /*u*/, GradientRow& row) {
  const bool is_sound = std::ranges::all_of(
      row, [](const GradientShare& share) { return std::abs(share.weight) <= 1 / min_r; });
  if (!is_sound) row.clear();
}

// Rows of one entry: the nearest vertex.
class NearestRows {
 public:
  using RowType = Row;
  static constexpr std::size_t group = 1;

  explicit NearestRows(const PreparedTriangulation& prepared) : prepared_(prepared) {}
  void begin() const {}
  void expect(std::size_t /*lane*/, const Point& p, const exact::SplitPoint& /*u*/,
              query::Cursor& cursor) {
    nearest_ = prepared_.engine().nearest(p, cursor);
  }
  void operator()(std::size_t /*lane*/, Index /*target*/, query::Cursor& /*cursor*/,
                  Row& row) const {
    row.push_back({nearest_, 1});
  }

 private:
  const PreparedTriangulation& prepared_;
  Index nearest_ = no_index;
};

// The number of targets that a kernel computes at once.
template <class K>
inline constexpr std::size_t group_of = 1;
template <GroupKernel K>
inline constexpr std::size_t group_of<K> = K::group;

// The rows of a kernel. `Finder` has locate(point, cursor) and nearest(point, cursor), which answer
// with ranks, as the engine of the triangulation has.
template <class K, class Finder = query::Engine>
class KernelRows {
 public:
  using RowType = std::conditional_t<Kernel<K>, Row, GradientRow>;
  static constexpr std::size_t group = group_of<K>;

  KernelRows(const PreparedTriangulation& prepared, const Finder& finder,
             const InterpolationOptions& options, FirstOutside& outside, K kernel)
      : prepared_(prepared),
        finder_(finder),
        options_(options),
        outside_(outside),
        kernel_(std::move(kernel)) {}

  // Call begin(), then expect() for up to `group` targets, then operator() for each of them.
  void begin() {
    if constexpr (GroupKernel<K>) kernel_.begin();
  }
  void expect(std::size_t lane, const Point& p, const exact::SplitPoint& u, query::Cursor& cursor) {
    LocatedTarget& place = places_[lane];
    place = {p, u, finder_.locate(p, cursor)};
    if (has_weights(place)) place.location = prepared_.flat_faces().location_of(place);
    if constexpr (GroupKernel<K>) {
      if (has_weights(place)) kernel_.expect(lane, place);
    }
  }
  void operator()(std::size_t lane, Index target, query::Cursor& cursor, RowType& row) {
    const LocatedTarget& place = places_[lane];
    if (place.location.where == Where::vertex) {
      row.push_back({place.location.sites[0], 1});
      return;
    }
    if (has_weights(place)) {
      if constexpr (GroupKernel<K>) {
        kernel_(lane, place, row);
      } else {
        kernel_(place, row);
      }
      if constexpr (!Kernel<K>) make_finite(place, row);
    }
    if (options_.normalization == Normalization::homogeneous) {
      make_homogeneous(prepared_, place.unit, row);
    }
    if (row.empty()) answer_outside(target, place.point, cursor, row);
  }

 private:
  // True if the kernel decides: the target is not at a vertex, and not outside.
  static bool has_weights(const LocatedTarget& place) {
    return place.location.where == Where::edge || place.location.where == Where::face;
  }

  // Where sites are so close that products of slopes leave the range of doubles, replaces the row
  // by linear weights.
  void make_finite(const LocatedTarget& place, GradientRow& row) const {
    double sum = 0;
    for (const GradientShare& share : row) {
      sum += share.weight + (share.slope.x + share.slope.y + share.slope.z);
    }
    if (std::isfinite(sum)) return;
    row.clear();
    Row flat;
    LinearKernel{prepared_}(place, flat);
    for (const auto& [vertex, weight] : flat) row.push_back({vertex, weight, {}});
  }

  void answer_outside(Index target, const Point& p, query::Cursor& cursor, RowType& row) {
    if (options_.outside == Outside::nearest) {
      row.push_back({finder_.nearest(p, cursor), 1});
    } else if (options_.outside == Outside::error) {
      outside_.add(target);
    }
  }

  const PreparedTriangulation& prepared_;
  const Finder& finder_;
  const InterpolationOptions& options_;
  FirstOutside& outside_;
  K kernel_;
  std::array<LocatedTarget, group> places_;
};

// Computes the rows of all targets in parallel. make_rows() and make_sink() are called for each
// range of targets; sink.expect(target) comes some time before sink.take(target, u, row), and
// sink.finish() at the end of the range. Precondition: there is a vertex.
template <class MakeRows, class MakeSink>
void for_each_row(const PreparedTriangulation& prepared, std::span<const Point> targets,
                  const Execution& execution, const MakeRows& make_rows,
                  const MakeSink& make_sink) {
  constexpr std::size_t batch_size = 256;
  system::StageProgress progress(execution.progress, "interpolate",
                                 system::num_pieces(targets.size(), query::queries_per_piece));
  const auto answer_range = [&](std::span<const Index> range, query::Cursor& cursor) {
    auto rows = make_rows();
    auto sink = make_sink();
    typename decltype(rows)::RowType row;
    std::vector<exact::SplitPoint> units(std::min(batch_size, range.size()));
    constexpr std::size_t group = decltype(rows)::group;
    static_assert(batch_size % group == 0);
    for (std::size_t k = 0; k < range.size(); k += group) {
      const std::size_t in_batch = k % batch_size;
      if (in_batch == 0) {
        const auto batch = range.subspan(k, std::min(batch_size, range.size() - k));
        exact::unit_vectors(targets, batch, prepared.center(), units.data());
      }
      const auto members = range.subspan(k, std::min(group, range.size() - k));
      rows.begin();
      for (std::size_t lane = 0; lane < members.size(); ++lane) {
        rows.expect(lane, targets[members[lane]], units[in_batch + lane], cursor);
      }
      for (std::size_t lane = 0; lane < members.size(); ++lane) {
        const std::size_t ahead = k + lane + system::prefetch_distance;
        if (ahead < range.size()) sink.expect(range[ahead]);
        row.clear();
        rows(lane, members[lane], cursor, row);
        sink.take(members[lane], units[in_batch + lane], row);
      }
    }
    sink.finish();
    progress.step();
  };
  query::for_each_range(
      targets, prepared.model(), prepared.center(), execution.threads,
      [&prepared](const Point& p) { return prepared.near(p); }, answer_range);
}

}  // namespace rondel::interpolation
