// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/crowds.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

#include "exact/vector.h"
#include "order/cube_position.h"
#include "order/place_keys.h"

namespace rondel::order {
namespace {

// Fewer sites of one key than so many are no crowd, fewer than twice as many may be found to be
// none: one key in so many is looked at.
constexpr std::size_t stride = 32;

class Crowds {
 public:
  Crowds(std::span<const Point> sites, std::span<const Index> order, Model model,
         const Point& center)
      : sites_(sites), order_(order), model_(model), center_(center) {}

  std::vector<Index> run() {
    for (std::size_t i = 0; i + stride < order_.size();) {
      const HilbertKey key = key_of(i);
      if (key_of(i + stride) != key) {
        i += stride;
        continue;
      }
      std::size_t begin = i;
      while (begin > 0 && key_of(begin - 1) == key) --begin;
      std::size_t end = i + stride + 1;
      while (end < order_.size() && key_of(end) == key) ++end;
      sort(begin, end);
      i = end;
    }
    return std::move(ranks_);
  }

 private:
  struct Crowded {
    unsigned quadrant;
    int size;  // the longer one of u and v is between 2^size and 2^(size+1)
    HilbertKey key;
    Index rank;
    friend auto operator<=>(const Crowded&, const Crowded&) = default;
  };

  [[nodiscard]] const Point& site(std::size_t rank) const { return sites_[order_[rank]]; }
  [[nodiscard]] HilbertKey key_of(std::size_t rank) const {
    return place_key(site(rank), model_, center_);
  }

  void sort(std::size_t begin, std::size_t end) {
    if (ranks_.empty()) {
      ranks_.resize(order_.size());
      std::iota(ranks_.begin(), ranks_.end(), Index{0});
    }
    const CubeAxes axes = cube_axes(cube_position(site(begin), center_).face);
    std::vector<Crowded> entries;
    entries.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      entries.push_back(entry_of(static_cast<Index>(i), axes));
    }
    std::ranges::sort(entries);
    for (std::size_t i = begin; i < end; ++i) ranks_[i] = entries[i - begin].rank;
  }

  // By quadrant, then by size, then along a curve among places of this size.
  [[nodiscard]] Crowded entry_of(Index rank, const CubeAxes& axes) const {
    const auto d = exact::to_vector(site(rank)) - exact::to_vector(center_);
    const double out = dot(d, exact::to_vector(axes.out));
    double u = dot(d, exact::to_vector(axes.u));
    double v = dot(d, exact::to_vector(axes.v));
    const unsigned quadrant = (u < 0 ? 2U : 0U) + (v < 0 ? 1U : 0U);
    u = std::abs(u);
    v = std::abs(v);
    const double longer = std::max(u, v);
    const bool is_seen = out > 0 && out <= std::numeric_limits<double>::max();  // as rounded
    if (!(longer > 0 && is_seen)) return {quadrant, 0, {}, rank};
    const int exponent_of_out = std::ilogb(out);
    int exponent = std::ilogb(longer);
    const double out_to_one = std::scalbn(out, -exponent_of_out);
    u = std::scalbn(u, -exponent) / out_to_one;
    v = std::scalbn(v, -exponent) / out_to_one;
    if (std::max(u, v) < 1) {
      u *= 2;
      v *= 2;
      --exponent;
    }
    const auto position = [](double x) {
      return static_cast<std::uint64_t>(std::scalbn(x, position_bits - 1));
    };
    return {quadrant, exponent - exponent_of_out, hilbert_key({0, position(u), position(v)}), rank};
  }

  std::span<const Point> sites_;
  std::span<const Index> order_;
  Model model_;
  Point center_;
  std::vector<Index> ranks_;
};

}  // namespace

std::vector<Index> ranks_with_crowds_in_order(std::span<const Point> sites,
                                              std::span<const Index> order, Model model,
                                              const Point& center) {
  return Crowds(sites, order, model, center).run();
}

}  // namespace rondel::order
