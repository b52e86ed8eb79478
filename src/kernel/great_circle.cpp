// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "kernel/great_circle.h"

#include <algorithm>
#include <array>
#include <utility>

#include "predicates/orientation.h"
#include "predicates/perturbation.h"
#include "predicates/turn.h"

namespace rondel::kernel {
namespace {

std::array<double, 3> coordinates(const Point& p) { return {p.x, p.y, p.z}; }

// An axis along which the plane of two points and the center is not seen edge on.
unsigned view_axis(const Point& a, const Point& b, const Point& center) {
  unsigned axis = 0;
  while (axis < 2 && predicates::turn(center, a, b, axis) == Sign::zero) ++axis;
  return axis;
}

// A plane through the center, seen along one axis: exact orientations of its points.
class PlaneView {
 public:
  PlaneView(std::span<const Point> points, unsigned axis, const Point& center)
      : points_(points), center_(center), axis_(axis) {}

  // Sign of the cross product of two points seen from the center.
  [[nodiscard]] Sign turn(Index i, Index j) const { return turn(center_, points_[i], points_[j]); }

  // Orientation of three raised points; zero when they are in line with the center.
  [[nodiscard]] Sign raised_orientation(Index a, Index b, Index c) const {
    const Sign sign = turn(points_[a], points_[b], points_[c]);
    if (sign != Sign::zero) return sign;
    std::array<std::array<Index, 3>, 3> rotations = {{{a, b, c}, {b, c, a}, {c, a, b}}};
    std::ranges::sort(rotations, [this](const auto& r, const auto& s) {
      return predicates::is_lexicographically_less(points_[r[0]], points_[s[0]]);
    });
    for (const auto& r : rotations) {
      if (const Sign change = turn(r[1], r[2]); change != Sign::zero) return -change;
    }
    return Sign::zero;
  }

  // The order of raised points along the first axis of the view.
  [[nodiscard]] bool is_before(Index i, Index j) const {
    const double a = coordinates(points_[i])[u()];
    const double b = coordinates(points_[j])[u()];
    if (a != b) return a < b;
    const double origin = coordinates(center_)[u()];
    if (a == origin) return coordinates(points_[i])[v()] < coordinates(points_[j])[v()];
    return a < origin ? predicates::is_lexicographically_less(points_[i], points_[j])
                      : predicates::is_lexicographically_less(points_[j], points_[i]);
  }

 private:
  [[nodiscard]] std::size_t u() const { return (axis_ + 1) % 3; }
  [[nodiscard]] std::size_t v() const { return (axis_ + 2) % 3; }

  [[nodiscard]] Sign turn(const Point& origin, const Point& a, const Point& b) const {
    return predicates::turn(origin, a, b, axis_);
  }

  std::span<const Point> points_;
  Point center_;
  unsigned axis_;
};

// By angle from the first point: itself, one side, its antipode, the other side.
std::vector<Index> sort_by_angle(Index size, const PlaneView& view) {
  std::vector<std::pair<int, Index>> sectors(size);
  for (Index i = 0; i < size; ++i) {
    constexpr std::array<int, 3> sector_of_turn = {3, 2, 1};
    const int sector =
        sector_of_turn[static_cast<std::size_t>(static_cast<int>(view.turn(0, i)) + 1)];
    sectors[i] = {i == 0 ? 0 : sector, i};
  }
  std::ranges::sort(sectors, [&view](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return a.second != b.second && view.turn(a.second, b.second) == Sign::positive;
  });
  std::vector<Index> ring(size);
  std::ranges::transform(sectors, ring.begin(), [](const auto& s) { return s.second; });
  return ring;
}

// Andrew's monotone chain (Inf. Process. Lett. 9, 1979) on the raised points.
std::vector<Index> convex_polygon(Index size, const PlaneView& view) {
  std::vector<Index> sorted(size);
  for (Index i = 0; i < size; ++i) sorted[i] = i;
  std::ranges::sort(sorted, [&view](Index i, Index j) { return view.is_before(i, j); });
  std::vector<Index> ring;
  const auto append_chain = [&](const auto& begin, const auto& end) {
    const std::size_t base = ring.size();
    for (auto it = begin; it != end; ++it) {
      while (ring.size() >= base + 2 &&
             view.raised_orientation(ring[ring.size() - 2], ring.back(), *it) != Sign::positive) {
        ring.pop_back();
      }
      ring.push_back(*it);
    }
    ring.pop_back();
  };
  append_chain(sorted.begin(), sorted.end());
  append_chain(sorted.rbegin(), sorted.rend());
  std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
  return ring;
}

// Points on one line through the center, whose order along the line is lexicographic.
std::vector<Index> ends_of_line(std::span<const Point> points, Model model) {
  const auto less = [&points](Index i, Index j) {
    return predicates::is_lexicographically_less(points[i], points[j]);
  };
  std::vector<Index> all(points.size());
  for (Index i = 0; i < points.size(); ++i) all[i] = i;
  if (model == Model::projected || all.size() <= 2) return all;
  const auto [first, last] = std::ranges::minmax(all, less);
  return {std::min(first, last), std::max(first, last)};
}

}  // namespace

std::vector<Index> find_span(std::span<const Point> points, const Point& center) {
  std::vector<Index> span;
  const auto size = static_cast<Index>(points.size());
  for (Index i = 0; i < size && span.size() < 3; ++i) {
    const bool is_new =
        span.empty() ? points[i] != center
        : span.size() == 1
            ? !predicates::are_collinear(center, points[span[0]], points[i])
            : predicates::orientation(points[span[0]], points[span[1]], points[i], center).sign !=
                  Sign::zero;
    if (is_new) span.push_back(i);
  }
  return span;
}

std::vector<Index> ring_of_great_circle(std::span<const Point> points, std::span<const Index> span,
                                        Model model, const Point& center) {
  if (span.size() < 2) return ends_of_line(points, model);
  const PlaneView view(points, view_axis(points[span[0]], points[span[1]], center), center);
  const auto size = static_cast<Index>(points.size());
  return model == Model::projected ? sort_by_angle(size, view) : convex_polygon(size, view);
}

}  // namespace rondel::kernel
