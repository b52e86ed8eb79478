// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "unit/constrained/constrained_oracle.h"

#include <algorithm>

namespace rondel::test {
namespace {

using Ray = IntegerVector;

int sign_of_volume(const Ray& a, const Ray& b, const Ray& c) { return sgn(determinant(a, b, c)); }

Ray negative(const Ray& a) { return {-a[0], -a[1], -a[2]}; }

Ray sum(const Ray& a, const Ray& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

bool is_zero(const Ray& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

// A ray of the plane of a and b is strictly between them.
bool is_between(const Ray& a, const Ray& b, const Ray& x) {
  const Ray normal = cross(a, b);
  return dot(cross(a, x), normal) > 0 && dot(cross(x, b), normal) > 0;
}

// A ray lies in the inside of an arc.
bool is_inside(const Ray& a, const Ray& b, const Ray& x) {
  return sign_of_volume(a, b, x) == 0 && is_between(a, b, x);
}

// Two arcs cross in the inside of both; the ray where they do, or zero.
Ray crossing(const Ray& a, const Ray& b, const Ray& c, const Ray& d) {
  const Ray x = cross(cross(a, b), cross(c, d));
  if (is_zero(x)) return x;
  for (const Ray& y : {x, negative(x)}) {
    if (is_between(a, b, y) && is_between(c, d, y)) return y;
  }
  return {};
}

}  // namespace

ConstrainedOracle::ConstrainedOracle(std::span<const Point> sites)
    : oracle_(sites, Model::projected, {}) {}

bool ConstrainedOracle::has_arc(const Ends& ends) const {
  return !is_zero(cross(ray(ends[0]), ray(ends[1])));
}

bool ConstrainedOracle::do_cross(const Ends& e, const Ends& f) const {
  const Ray x = crossing(ray(e[0]), ray(e[1]), ray(f[0]), ray(f[1]));
  if (is_zero(x)) return false;
  for (Index v = 0; v < size(); ++v) {
    if (is_zero(cross(ray(v), x)) && dot(ray(v), x) > 0) return false;
  }
  return true;
}

// Returns a ray in each part of the inside of the arc ab, which planes divide.
std::vector<Ray> ConstrainedOracle::samples(const Ray& a, const Ray& b,
                                            const std::vector<Ray>& normals) const {
  const Ray normal = cross(a, b);
  std::vector<Ray> places;
  for (const Ray& other : normals) {
    const Ray x = cross(normal, other);
    for (const Ray& y : {x, negative(x)}) {
      if (!is_zero(y) && is_between(a, b, y)) places.push_back(y);
    }
  }
  std::ranges::sort(places,
                    [&](const Ray& x, const Ray& y) { return dot(cross(x, y), normal) > 0; });
  places.insert(places.begin(), a);
  places.push_back(b);
  std::vector<Ray> result;
  for (std::size_t i = 1; i < places.size(); ++i) {
    // Places that are one have a sample on a plane, which is one more that is looked at.
    if (!is_zero(cross(places[i - 1], places[i]))) result.push_back(sum(places[i - 1], places[i]));
  }
  return result;
}

bool ConstrainedOracle::is_empty(const Triple& face) const {
  for (Index v = 0; v < size(); ++v) {
    if (std::ranges::find(face, v) != face.end()) continue;
    bool is_in = true;
    for (std::size_t i = 0; i < 3; ++i) {
      is_in = is_in && sign_of_volume(ray(face[i]), ray(face[(i + 1) % 3]), ray(v)) >= 0;
    }
    if (is_in) return false;
  }
  return true;
}

bool ConstrainedOracle::is_passed(const Triple& face, std::span<const Ends> constraints) const {
  std::vector<Ray> normals;
  for (std::size_t i = 0; i < 3; ++i) {
    normals.push_back(cross(ray(face[i]), ray(face[(i + 1) % 3])));
  }
  for (const auto& [p, q] : constraints) {
    for (const Ray& x : samples(ray(p), ray(q), normals)) {
      if (std::ranges::all_of(normals, [&](const Ray& n) { return dot(n, x) > 0; })) return true;
    }
  }
  return false;
}

// The site v, beyond the edge ab of an empty face, sees a part of the edge that is no constraint.
bool ConstrainedOracle::is_seen_through(Index a, Index b, Index v,
                                        std::span<const Ends> constraints) const {
  std::vector<Ray> normals;
  for (Index w = 0; w < size(); ++w) normals.push_back(cross(ray(v), ray(w)));
  for (const Ray& x : samples(ray(a), ray(b), normals)) {
    const bool is_blocked = std::ranges::any_of(constraints, [&](const Ends& ends) {
      const Ray& p = ray(ends[0]);
      const Ray& q = ray(ends[1]);
      return is_inside(p, q, x) || !is_zero(crossing(p, q, ray(v), x));
    });
    if (!is_blocked) return true;
  }
  return false;
}

bool ConstrainedOracle::is_seen(const Triple& face, std::span<const Ends> constraints) const {
  for (Index v = 0; v < size(); ++v) {
    if (std::ranges::find(face, v) != face.end()) continue;
    if (oracle_.perturbed_side(face[0], face[1], face[2], v) <= 0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = face[i];
      const Index b = face[(i + 1) % 3];
      if (sign_of_volume(ray(a), ray(b), ray(v)) < 0 && is_seen_through(a, b, v, constraints)) {
        return true;
      }
    }
  }
  return false;
}

std::vector<Triple> ConstrainedOracle::faces(std::span<const Ends> constraints) const {
  std::vector<Triple> result;
  for (Index a = 0; a < size(); ++a) {
    for (Index b = a + 1; b < size(); ++b) {
      for (Index c = a + 1; c < size(); ++c) {
        const Triple face = {a, b, c};
        if (b == c || sign_of_volume(ray(a), ray(b), ray(c)) <= 0) continue;
        if (is_empty(face) && !is_passed(face, constraints) && !is_seen(face, constraints)) {
          result.push_back(face);
        }
      }
    }
  }
  return result;
}

std::vector<std::array<Index, 3>> ConstrainedOracle::pieces(
    std::span<const Ends> constraints) const {
  std::vector<std::array<Index, 3>> result;
  for (Index i = 0; i < constraints.size(); ++i) {
    const auto [p, q] = constraints[i];
    const Ray normal = cross(ray(p), ray(q));
    std::vector<Index> chain = {p, q};
    for (Index v = 0; v < size(); ++v) {
      if (is_inside(ray(p), ray(q), ray(v))) chain.push_back(v);
    }
    std::ranges::sort(chain,
                      [&](Index v, Index w) { return dot(cross(ray(v), ray(w)), normal) > 0; });
    for (std::size_t k = 1; k < chain.size(); ++k) {
      result.push_back({std::min(chain[k - 1], chain[k]), std::max(chain[k - 1], chain[k]), i});
    }
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace rondel::test
