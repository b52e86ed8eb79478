// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/weighted_site.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "exact/vector.h"

namespace rondel::mesh {
namespace {

using exact::DoubleDouble;

// Turning by an angle moves walls as much as lengthening by this part of the spacing times the
// angle does. A coordinate that is smaller than that part of the length is not changed, since it
// would turn too far.
constexpr double turn_part = 0.25;
// If the last bit of a coordinate changes the length by less than this part of what the last bit of
// the largest coordinate does, the coordinate is rounded; for the others some steps each way are
// tried, and more if there is only one.
constexpr double fine_part = 1.0 / 16;
constexpr int max_steps = 6;
constexpr int max_steps_of_one = 64;
// Two weights may differ by this part without being scaled.
constexpr double little = 0x1p-46;

// Returns the largest power of two that is at most |x|.
double power_below(double x) {
  constexpr std::uint64_t exponent_bits = 0x7ff0'0000'0000'0000;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & exponent_bits);
}

// Returns weight - |p|, computed from the exact difference of the squares.
double missing_length(const std::array<double, 3>& p, const DoubleDouble& weight) {
  const DoubleDouble square = exact::two_product(weight.hi, weight.hi);
  DoubleDouble rest = {square.hi, square.lo + 2 * weight.hi * weight.lo};
  for (const double x : p) {
    const DoubleDouble part = exact::two_product(x, x);
    const DoubleDouble sum = exact::two_sum(rest.hi, -part.hi);
    rest = {sum.hi, rest.lo + sum.lo - part.lo};
  }
  return (rest.hi + rest.lo) / (2 * weight.hi);
}

// By coordinate, the largest first: its last bit, and the change of the length by it; 0 if the
// coordinate is not to be changed.
struct LastBits {
  std::array<double, 3> sizes;
  std::array<double, 3> lengths;
};

// Numbers of last bits by which the coordinates change.
struct BitSteps {
  std::array<double, 3> counts;
  double turn;  // upper bound of the turn
  double cost;  // error of the length, plus the turn
};

// Returns the steps with these counts for the second and third coordinate; where a coordinate's
// bits are fine, it is rounded instead.
BitSteps rounded_steps(double missing, const LastBits& bits, double turn_cost, int second,
                       int third) {
  BitSteps steps{{0, static_cast<double>(second), static_cast<double>(third)}, 0, 0};
  double rest = missing - second * bits.lengths[1] - third * bits.lengths[2];
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = bits.lengths[k];
    if (length > 0 && (k == 0 || length < fine_part * bits.lengths[0])) {
      const double count = std::floor(rest / length + 0.5);
      rest -= count * length;
      steps.counts[k] += count;
    }
    steps.turn += std::abs(steps.counts[k]) * bits.sizes[k];
  }
  steps.cost = std::abs(rest) + turn_cost * steps.turn;
  return steps;
}

// Returns the steps with the least cost; tries combinations for the two smaller coordinates.
BitSteps best_steps(double missing, const LastBits& bits, double turn_cost) {
  const auto is_tried = [&](std::size_t k) {
    return bits.lengths[k] >= fine_part * bits.lengths[0];
  };
  const int max_second = !is_tried(1) ? 0 : (bits.lengths[2] > 0 ? max_steps : max_steps_of_one);
  const int max_third = is_tried(2) ? max_steps : 0;
  BitSteps best = rounded_steps(missing, bits, turn_cost, 0, 0);
  for (int i = -max_second; i <= max_second; ++i) {
    for (int j = -max_third; j <= max_third; ++j) {
      const BitSteps steps = rounded_steps(missing, bits, turn_cost, i, j);
      if (steps.cost < best.cost) best = steps;
    }
  }
  return best;
}

}  // namespace

Point weighted_site(const Point& near, const DoubleDouble& weight, double spacing) {
  std::array<double, 3> p = {near.x, near.y, near.z};
  double missing = missing_length(p, weight);
  if (!(std::abs(missing) < little * weight.hi)) {
    const double factor = weight.hi / norm(exact::to_vector(near));
    for (double& x : p) x *= factor;
    missing = missing_length(p, weight);
  }
  const std::array<double, 3> q = p;
  std::array<std::size_t, 3> axes = {0, 1, 2};
  std::ranges::stable_sort(axes, std::greater(), [&](std::size_t k) { return std::abs(q[k]); });
  LastBits bits{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double coordinate = std::abs(q[axes[k]]);
    if (coordinate < turn_part * spacing * weight.hi) continue;
    bits.sizes[k] = 0x1p-52 * power_below(coordinate);
    bits.lengths[k] = bits.sizes[k] * (coordinate / weight.hi);
  }
  const BitSteps steps = best_steps(missing, bits, turn_part * spacing);
  // The steps are counted away from the center, so that mirrored points get mirrored results.
  for (std::size_t k = 0; k < 3; ++k) {
    p[axes[k]] += std::copysign(bits.sizes[k], q[axes[k]]) * steps.counts[k];
  }
  return {p[0], p[1], p[2]};
}

}  // namespace rondel::mesh
