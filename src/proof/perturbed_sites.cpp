// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proof/perturbed_sites.h"

#include <algorithm>
#include <tuple>

#include "models/with_model.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "proof/sites_by_place.h"

namespace rondel::proof {
namespace {

// The places as the ladder of one model reads them. Raw points of one place have directions within
// rounding of each other, so any will do.
template <Model m>
struct Source {
  static constexpr Model model = m;

  const PerturbedSites& sites;

  [[nodiscard]] const Point& point(Index a) const { return sites.point(a); }
  [[nodiscard]] const Point& center() const { return sites.center(); }
  [[nodiscard]] const predicates::Vector& direction(Index a) const { return sites.direction(a); }
  [[nodiscard]] exact::SplitPoint split(Index a) const {
    return exact::unit_vector(point(a), center());
  }
};

}  // namespace

PerturbedSites::PerturbedSites(std::span<const Point> sites, const SitesByPlace& places,
                               Model model, const Sphere& sphere)
    : sites_(sites), places_(places), model_(model), sphere_(sphere) {
  if (model == Model::projected) {
    directions_.reserve(sites.size());
    for (const Point& p : sites) {
      directions_.push_back(exact::to_vector(exact::unit_vector(p, sphere.center).hi));
    }
  }
  find_frame();
}

// Two vectors are dependent iff each axis is in one plane with them.
bool PerturbedSites::are_dependent(Index a, Index b) const {
  for (const unsigned axis : {0U, 1U, 2U}) {
    const Point on_axis = axis_point(sphere_.center, axis);
    if (predicates::orientation(point(a), point(b), on_axis, center()).sign != Sign::zero) {
      return false;
    }
  }
  return true;
}

// Independent vectors are not collinear as points, so a fourth point off their plane
// exists iff the hull is not flat.
void PerturbedSites::find_frame() {
  const auto n = static_cast<Index>(sites_.size());
  const auto find = [&](auto&& is_wanted) {
    for (Index i = 0; i < n; ++i) {
      if (places_.first[i] == i && is_wanted(i)) return i;
    }
    return no_index;
  };
  if (n == 0) return;
  const bool has_two = find([](Index i) { return i > 0; }) != no_index;
  dimension_ = has_two ? 1 : 0;
  const Index a = find([&](Index i) { return sites_[i] != center(); });
  if (a == no_index) return;
  const Index b = find([&](Index i) { return !are_dependent(a, i); });
  if (b == no_index) return;
  const Index c = find([&](Index i) { return oriented(a, b, i) != Sign::zero; });
  if (c == no_index) return;
  dimension_ = 2;
  const Index d =
      find([&](Index i) { return i != a && i != b && i != c && side(a, b, c, i) != Sign::zero; });
  frame_ = {a, b, c, d};
}

Sign PerturbedSites::oriented(Index a, Index b, Index c) const {
  return predicates::orientation(point(a), point(b), point(c), center()).sign;
}

Sign PerturbedSites::side(Index a, Index b, Index c, Index d) const {
  return models::with_model(model_, [&]<class T> {
    const Source<T::model> source{*this};
    return predicates::side(source, a, b, c, d).sign;
  });
}

bool PerturbedSites::is_conflict(Index a, Index b, Index c, Index d) const {
  return models::with_model(model_, [&]<class T> {
    const Source<T::model> source{*this};
    return predicates::conflict(source, a, b, c, d).sign == Sign::positive;
  });
}

bool PerturbedSites::are_in_line_with_center(Index a, Index b, Index c) const {
  return are_dependent(a, b) && are_dependent(b, c) && are_dependent(c, a);
}

bool PerturbedSites::are_in_plane_with_center(Index a, Index b, Index c, Index d) const {
  return oriented(a, b, c) == Sign::zero && oriented(a, b, d) == Sign::zero &&
         oriented(a, c, d) == Sign::zero && oriented(b, c, d) == Sign::zero;
}

bool PerturbedSites::is_above(Index a, Index b, Index c, Index d) const {
  const Sign exact = side(a, b, c, d);
  if (exact != Sign::zero) return exact == Sign::positive;
  if (!are_in_plane_with_center(a, b, c, d)) return is_conflict(a, b, c, d);
  // Even permutations, which keep the sign: one of them starts with a triple that has a side.
  const std::array<std::array<Index, 4>, 4> even{
      {{a, b, c, d}, {b, a, d, c}, {c, d, a, b}, {d, c, b, a}}};
  for (const auto& [i, j, k, l] : even) {
    const Sign inner = side_of_inner({i, j, k});
    if (inner == Sign::negative) return is_conflict(i, j, k, l);
    if (inner == Sign::positive) return !is_conflict(j, i, k, l);
  }
  return false;
}

// The side of g with respect to the plane of a triple that has one plane with the center. Collinear
// corners span a plane when they are raised from the center: raising x of (x, y, z) moves
// det(x, y, z, g) in the direction of -det(y, z, g), the lexicographically smallest corner
// most. Zero when they are in line with the center.
Sign PerturbedSites::side_of_inner(const std::array<Index, 3>& triple) const {
  const auto& [a, b, c] = triple;
  for (const Index inner : frame_) {
    if (inner == no_index || std::ranges::find(triple, inner) != triple.end()) continue;
    const Sign s = side(a, b, c, inner);
    if (s != Sign::zero) return s;
  }
  std::array<std::array<Index, 3>, 3> raised{{{a, b, c}, {b, c, a}, {c, a, b}}};
  std::ranges::sort(raised, {}, [&](const std::array<Index, 3>& turn) {
    const Point& p = point(turn[0]);
    return std::tuple(p.x, p.y, p.z);
  });
  for (const auto& [x, y, z] : raised) {
    for (const Index inner : independent()) {
      const Sign s = oriented(y, z, inner);
      if (s != Sign::zero) return s == Sign::positive ? Sign::negative : Sign::positive;
    }
  }
  return Sign::zero;
}

}  // namespace rondel::proof
