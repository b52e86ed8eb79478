// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstddef>

#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"
#include "system/prefetch.h"
#include "system/wide_vectors.h"

namespace rondel::exact {
namespace {

using exact::SplitPoint;

// Sites at a time. What the loop reads and writes lies in arrays of one number each, which the
// first cache holds.
constexpr std::size_t batch_size = 64;
using Numbers = double[batch_size];

struct Lanes {
  alignas(64) Numbers x, y, z;
  alignas(64) Numbers x_hi, y_hi, z_hi;
  alignas(64) Numbers x_lo, y_lo, z_lo;
  alignas(64) Numbers squares;
};

inline void find_unit_vector(Lanes& lanes, std::size_t j, const Point& center) {
  const auto d = exact::difference({lanes.x[j], lanes.y[j], lanes.z[j]}, center);
  const exact::DoubleDouble square = exact::squared_norm(d);
  const SplitPoint u = exact::scaled_to_unit(d, square);
  lanes.x_hi[j] = u.hi.x;
  lanes.y_hi[j] = u.hi.y;
  lanes.z_hi[j] = u.hi.z;
  lanes.x_lo[j] = u.lo.x;
  lanes.y_lo[j] = u.lo.y;
  lanes.z_lo[j] = u.lo.z;
  lanes.squares[j] = square.hi;
}

}  // namespace

void unit_vectors(std::span<const Point> sites, std::span<const Index> order, const Point& center,
                  SplitPoint* result) {
  Lanes lanes;
  for (std::size_t begin = 0; begin < order.size(); begin += batch_size) {
    const std::size_t count = std::min(batch_size, order.size() - begin);
    for (std::size_t j = 0; j < batch_size; ++j) {
      const std::size_t k = begin + std::min(j, count - 1);
      if (k + system::prefetch_distance < order.size())
        system::prefetch(&sites[order[k + system::prefetch_distance]]);
      const Point& p = sites[order[k]];
      lanes.x[j] = p.x;
      lanes.y[j] = p.y;
      lanes.z[j] = p.z;
    }
    system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
      for (std::size_t j = 0; j < batch_size; ++j) find_unit_vector(lanes, j, center);
    });
    for (std::size_t j = 0; j < count; ++j) {
      result[begin + j] = exact::is_moderate(lanes.squares[j])
                              ? SplitPoint{{lanes.x_hi[j], lanes.y_hi[j], lanes.z_hi[j]},
                                           {lanes.x_lo[j], lanes.y_lo[j], lanes.z_lo[j]}}
                              : exact::unit_vector(sites[order[begin + j]], center);
    }
  }
}

}  // namespace rondel::exact
