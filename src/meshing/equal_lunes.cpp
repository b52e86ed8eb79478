// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/equal_lunes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"

namespace rondel::mesh {
namespace {

using PlaneVector = exact::Vector3<double>;

// Unit vectors have errors of 2 * 2^-53, and the products of their differences with a normal a few
// times that.
constexpr double circle_tolerance = 0x1p-49;
// At the ends of the range cosines vanish by rounding; this replaces them.
constexpr double min_cosine = 0x1p-500;
// Neighbors whose distance differs from 180 degrees by less than this many degrees count as
// opposite.
constexpr double opposite_tolerance = 1e-12;
constexpr int max_bisections = 200;
constexpr int searched_places = 4096;

// A site in the plane of the circle.
struct PlanePlace {
  double x;
  double y;
};

// Returns the normal of the plane of the first site and the site that is nearest to a right angle
// from it.
PlaneVector circle_normal(std::span<const Point> units) {
  const PlaneVector first = exact::to_vector(units[0]);
  PlaneVector best = {0, 0, 0};
  for (const Point& unit : units) {
    const PlaneVector normal = cross(first, exact::to_vector(unit) - first);
    if (dot(normal, normal) > dot(best, best)) best = normal;
  }
  return best;
}

// A product of quotients as m 2^e, so that it neither overflows nor underflows.
class LongProduct {
 public:
  void multiply(double factor) {
    int exponent = 0;
    mantissa_ = std::frexp(mantissa_ * factor, &exponent);
    exponent_ += exponent;
  }
  [[nodiscard]] bool is_above_one() const { return exponent_ > 0; }

 private:
  double mantissa_ = 0.5;
  long exponent_ = 1;
};

// Finds the lengths of the weighted sites.
class Lunes {
 public:
  Lunes(std::span<const Point> units, std::span<const double> areas)
      : order_(units.size()), places_(units.size()), angles_(units.size()), turns_(units.size()) {
    constexpr double degrees = 180 / std::numbers::pi;
    const PlaneVector first = exact::to_vector(units[0]);
    const PlaneVector second = cross(normalized(circle_normal(units)), first);
    std::vector<PlanePlace> given;
    std::vector<double> at;
    for (const Point& unit : units) {
      const PlaneVector q = exact::to_vector(unit);
      given.push_back({dot(first, q), dot(second, q)});
      at.push_back(degrees * exact::argument(given.back().y, given.back().x));
    }
    std::iota(order_.begin(), order_.end(), Index{0});
    std::ranges::stable_sort(order_, {}, [&](Index i) { return at[i]; });
    double turn = 0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      if (k > 0) turn += 0.5 * degrees * areas[order_[k]];
      places_[k] = given[order_[k]];
      angles_[k] = at[order_[k]];
      turns_[k] = turn;
    }
    set_range();
  }

  [[nodiscard]] LuneWeights weights() const {
    LuneWeights found;
    found.are_all_tried = is_opposite_ || gap(widest_) < 180;
    const std::optional<double> start = is_opposite_ ? start_if_in_range() : solution();
    if (!start) return found;
    std::vector<double> result(places_.size());
    // The product begins after the widest gap, whose quotient may be free.
    const std::size_t n = places_.size();
    double weight = 1;
    for (std::size_t i = 1; i <= n; ++i) {
      const std::size_t k = (widest_ + i) % n;
      result[order_[k]] = weight;
      weight *= quotient(k, *start);
    }
    const double least = *std::ranges::min_element(result);
    const double most = *std::ranges::max_element(result);
    if (!(least > 0x1p-400 && most < 0x1p400)) return found;
    for (double& one : result) one /= least;
    found.lengths = std::move(result);
    return found;
  }

 private:
  // Returns the angle from place k to the next one, in degrees.
  [[nodiscard]] double gap(std::size_t k) const {
    return k + 1 < angles_.size() ? angles_[k + 1] - angles_[k] : angles_[0] + 360 - angles_[k];
  }

  // Sets low_ and high_ such that all cosines have the right signs for p_0 between them.
  void set_range() {
    const std::size_t n = angles_.size();
    for (std::size_t k = 1; k < n; ++k) {
      if (gap(k) > gap(widest_)) widest_ = k;
    }
    is_opposite_ = std::abs(gap(widest_) - 180) <= opposite_tolerance;
    const bool is_wide = !is_opposite_ && gap(widest_) > 180;
    for (std::size_t k = 0; k < n; ++k) {
      if (k == widest_ && is_opposite_) continue;
      const bool is_widest = k == widest_ && is_wide;
      const double from_next = angles_[k] + gap(k) - 90 - turns_[k];
      const double from_this = angles_[k] + 90 - turns_[k];
      const double low = is_widest ? from_this : from_next;
      const double high = is_widest ? from_next : from_this;
      if (low > low_) {
        low_ = low;
        falls_at_low_ = !is_widest;
      }
      if (high < high_) {
        high_ = high;
        falls_at_high_ = !is_widest;
      }
    }
  }

  // Returns the quotient w_{k+1} / w_k of the header, for p_0 = `start` in degrees.
  [[nodiscard]] double quotient(std::size_t k, double start) const {
    const auto [sine, cosine] = exact::sine_cosine_of_degrees(start + turns_[k]);
    const PlanePlace& here = places_[k];
    const PlanePlace& next = places_[(k + 1) % places_.size()];
    return std::max(std::abs(cosine * here.x + sine * here.y), min_cosine) /
           std::max(std::abs(cosine * next.x + sine * next.y), min_cosine);
  }

  // True if the product of all quotients is above 1.
  [[nodiscard]] bool is_above_one(double start) const {
    LongProduct product;
    for (std::size_t k = 0; k < places_.size(); ++k) product.multiply(quotient(k, start));
    return product.is_above_one();
  }

  // Returns p_0 in case 2 of the header, if the cosines have the right signs there.
  [[nodiscard]] std::optional<double> start_if_in_range() const {
    const double start = angles_[widest_] + 90 - turns_[widest_];
    if (start > low_ && start < high_) return start;
    return std::nullopt;
  }

  // Returns p_0 in the cases 1 and 3, by bisection.
  [[nodiscard]] std::optional<double> solution() const {
    if (!(low_ < high_)) return std::nullopt;
    // Where the product falls, it is large near the low end and small near the high end.
    const bool above_at_low = falls_at_low_;
    const bool above_at_high = !falls_at_high_;
    double low = low_;
    double high = high_;
    if (above_at_low == above_at_high) {
      const double step = (high_ - low_) / searched_places;
      int at = 1;
      while (at < searched_places && is_above_one(low_ + at * step) == above_at_low) ++at;
      if (at == searched_places) return std::nullopt;
      high = low_ + at * step;
    }
    for (int i = 0; i < max_bisections; ++i) {
      const double middle = 0.5 * (low + high);
      if (!(middle > low && middle < high)) break;
      (is_above_one(middle) == above_at_low ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  std::vector<Index> order_;        // sites around the circle
  std::vector<PlanePlace> places_;  // in that order
  std::vector<double> angles_;      // f, in degrees
  std::vector<double> turns_;       // p - p_0, in degrees
  std::size_t widest_ = 0;          // the place after which the widest gap comes
  bool is_opposite_ = false;        // the two places at that gap are opposite
  // The range of p_0 in degrees, and whether the product falls from infinity at its low end, or to
  // 0 at its high end.
  double low_ = -1000;
  double high_ = 1000;
  bool falls_at_low_ = true;
  bool falls_at_high_ = true;
};

}  // namespace

bool lie_on_great_circle(std::span<const Point> units) {
  const PlaneVector first = exact::to_vector(units[0]);
  const PlaneVector normal = circle_normal(units);
  const double length = norm(normal);
  return std::ranges::all_of(units, [&](const Point& unit) {
    return std::abs(dot(normal, exact::to_vector(unit) - first)) <= circle_tolerance * length;
  });
}

LuneWeights lune_weights(std::span<const Point> units, std::span<const double> areas) {
  return Lunes(units, areas).weights();
}

}  // namespace rondel::mesh
