// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites with small integers as coordinates, and exact questions about them in 128 bits. It shares no
// formula with the library. Ties are decided by the oracle of the perturbation.
//
// index places: sites in one place are one place, whose name is the lowest of them
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "support/integer_oracle.h"
#include "support/oracle.h"

namespace rondel::test {

// \pre coordinates are integers of at most max_for_roots.
class IntegerPlaces {
 public:
  using Arc = std::array<Index, 2>;

  explicit IntegerPlaces(std::span<const Point> sites) : IntegerPlaces(Grouped(sites)) {}

  [[nodiscard]] Index size() const { return static_cast<Index>(rays_.size()); }
  [[nodiscard]] Index name(Index place) const { return names_[place]; }
  [[nodiscard]] Index place(Index site) const { return places_[site]; }

  [[nodiscard]] int orientation(Index a, Index b, Index c) const {
    return sign_of(determinant(rays_[a], rays_[b], rays_[c]));
  }
  // True if two places have an arc: they are not opposite to each other.
  [[nodiscard]] bool has_arc(const Arc& e) const {
    return e[0] != e[1] && normal(e) != IntegerRay{};
  }
  // True if a place lies in the inside of an arc.
  [[nodiscard]] bool is_on(const Arc& e, Index v) const {
    return dot(normal(e), rays_[v]) == 0 && is_between(e, rays_[v]);
  }
  // True if two arcs cross in the inside of both.
  [[nodiscard]] bool do_cross(const Arc& e, const Arc& f) const {
    const IntegerRay x = cross(normal(e), normal(f));
    const IntegerRay opposite = IntegerRay{} - x;
    return (is_between(e, x) && is_between(f, x)) ||
           (is_between(e, opposite) && is_between(f, opposite));
  }
  // Returns the places on an arc with both ends, along it.
  [[nodiscard]] std::vector<Index> chain(const Arc& e) const {
    std::vector<Index> places = {e[0], e[1]};
    for (Index v = 0; v < size(); ++v) {
      if (is_on(e, v)) places.push_back(v);
    }
    std::ranges::sort(places, [&](Index v, Index w) {
      return v != w && dot(cross(rays_[v], rays_[w]), normal(e)) > 0;
    });
    return places;
  }
  // True if p is above the plane of the projections of three places, after the perturbation.
  [[nodiscard]] bool is_above(Index a, Index b, Index c, Index p) const {
    const int side = side_of_circle(rays_[a], rays_[b], rays_[c], rays_[p]);
    return (side != 0 ? side : oracle_.perturbed_side(a, b, c, p)) > 0;
  }
  // Returns a ray inside of a face. Those for different numbers are on a curve that a plane meets
  // at most three times.
  [[nodiscard]] IntegerRay inner_ray(const Triple& face, std::int64_t number) const {
    const std::int64_t square = number * number;
    const std::array<std::int64_t, 3> weights = {7 + number, 11 + square, 13 + square * number};
    IntegerRay sum;
    for (std::size_t i = 0; i < 3; ++i) sum = sum - scaled_ray(rays_[face[i]], -weights[i]);
    return sum;
  }
  // Returns -1 if a ray is outside of a positive face, 1 if inside, 0 if it is in a plane of a side.
  [[nodiscard]] int side_of_face(const Triple& face, const IntegerRay& ray) const {
    int least = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const IntegerRay side = normal({face[i], face[(i + 1) % 3]});
      least = std::min(least, sign_of(dot(side, ray)));
    }
    return least;
  }
  // True if no place lies to the right of an arc, and some do to the left.
  [[nodiscard]] bool is_border(const Arc& e) const {
    bool has_left = false;
    for (Index v = 0; v < size(); ++v) {
      const int side = orientation(e[0], e[1], v);
      if (side < 0 || (v != e[0] && v != e[1] && is_on(e, v))) return false;
      has_left = has_left || side > 0;
    }
    return has_left;
  }

 private:
  // The sites by their places.
  struct Grouped {
    explicit Grouped(std::span<const Point> sites) {
      const auto key = [](const Point& p) { return std::tie(p.x, p.y, p.z); };
      for (Index i = 0; i < sites.size(); ++i) {
        const IntegerRay ray = ray_of(sites[i]);
        Index k = 0;
        while (k < names.size() && !are_on_one_ray(ray_of(speakers[k]), ray)) ++k;
        if (k == names.size()) {
          names.push_back(i);
          speakers.push_back(sites[i]);
        } else if (key(sites[i]) < key(speakers[k])) {
          speakers[k] = sites[i];
        }
        places.push_back(k);
      }
    }
    std::vector<Index> names;
    std::vector<Point> speakers;  // the lexicographically smallest site of each place
    std::vector<Index> places;    // by site
  };

  explicit IntegerPlaces(Grouped&& grouped)
      : oracle_(grouped.speakers, Model::projected, {}),
        names_(std::move(grouped.names)),
        places_(std::move(grouped.places)) {
    for (const Point& p : grouped.speakers) rays_.push_back(ray_of(p));
  }

  static IntegerRay ray_of(const Point& p) {
    return {static_cast<std::int64_t>(p.x), static_cast<std::int64_t>(p.y),
            static_cast<std::int64_t>(p.z)};
  }
  static IntegerRay scaled_ray(const IntegerRay& a, std::int64_t factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
  }
  static IntegerRay cross(const IntegerRay& a, const IntegerRay& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  static std::int64_t dot(const IntegerRay& a, const IntegerRay& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  [[nodiscard]] IntegerRay normal(const Arc& e) const { return cross(rays_[e[0]], rays_[e[1]]); }
  // True if a ray in the plane of an arc is in its inside.
  [[nodiscard]] bool is_between(const Arc& e, const IntegerRay& x) const {
    return dot(cross(rays_[e[0]], x), normal(e)) > 0 && dot(cross(x, rays_[e[1]]), normal(e)) > 0;
  }

  Oracle oracle_;
  std::vector<IntegerRay> rays_;
  std::vector<Index> names_;
  std::vector<Index> places_;
};

}  // namespace rondel::test
