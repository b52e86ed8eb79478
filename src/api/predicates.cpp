// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The exact predicates for single calls. Each checks its arguments, which the functions of the
// library do once for all sites, and asks the ladder of predicates/.

#include "rondel/predicates.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>

#include "exact/integer.h"
#include "models/with_model.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "predicates/ray_order.h"
#include "rondel/error.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

using predicates::FourPoints;

// Throws InvalidInput with the first bad position unless the predicates have an answer: there is no
// such sphere, a point is not finite or, for rays, a point is the center.
void require_points(std::initializer_list<Point> points, Model model, const Sphere& sphere) {
  const auto is_finite = [](const Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  if (!is_finite(sphere.center)) throw InvalidInput("the center of the sphere is not finite");
  // No answer depends on the radius, but one that cannot be is a mistake of the caller.
  if (!(sphere.squared_radius > 0) || !std::isfinite(sphere.squared_radius)) {
    throw InvalidInput("the squared radius of the sphere is not positive and finite");
  }
  std::size_t i = 0;
  for (const Point& p : points) {
    if (!is_finite(p)) throw InvalidInput("point " + std::to_string(i) + " is not finite", i);
    if (model == Model::projected && p == sphere.center) {
      throw InvalidInput("point " + std::to_string(i) + " is the center of the sphere", i);
    }
    ++i;
  }
}

// Throws InvalidInput unless a tie can be perturbed: the four points are distinct sites and, in the
// weighted model, the first three are not in line with the center.
void require_distinct_sites(const std::array<Point, 4>& p, Model model, const Sphere& sphere) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (is_same_site(p[i], p[j], model, sphere)) {
        throw InvalidInput(
            "points " + std::to_string(j) + " and " + std::to_string(i) + " are one site", i);
      }
    }
  }
  if (model == Model::projected) return;
  const auto v = exact::scaled_differences({p[0], p[1], p[2], p[3]}, sphere.center);
  const auto are_parallel = [&](std::size_t i, std::size_t j) {
    return is_zero(cross(v[i], v[j]));
  };
  if (are_parallel(0, 1) && are_parallel(1, 2) && are_parallel(2, 0)) {
    throw InvalidInput("the first three points are in line with the center");
  }
}

}  // namespace

Sign orientation(const Point& a, const Point& b, const Point& c, const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  require_points({a, b, c}, Model::weighted, sphere);
  return predicates::orientation(a, b, c, sphere.center).sign;
}

Sign side_of_circle(const Point& a, const Point& b, const Point& c, const Point& p, Model model,
                    const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  require_points({a, b, c, p}, model, sphere);
  return models::with_model(model, [&]<class T> {
    const FourPoints<T::model> points{{a, b, c, p}, sphere.center};
    return predicates::side(points, 0, 1, 2, 3).sign;
  });
}

bool is_in_conflict(const Point& a, const Point& b, const Point& c, const Point& p, Model model,
                    const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  require_points({a, b, c, p}, model, sphere);
  return models::with_model(model, [&]<class T> {
    const FourPoints<T::model> points{{a, b, c, p}, sphere.center};
    const Sign sign = predicates::side(points, 0, 1, 2, 3).sign;
    // Only a tie asks for more than finite points; it is decided by perturbation.
    if (sign != Sign::zero) return sign == Sign::positive;
    require_distinct_sites({a, b, c, p}, model, sphere);
    return predicates::conflict(points, 0, 1, 2, 3).sign == Sign::positive;
  });
}

bool is_same_site(const Point& a, const Point& b, Model model, const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  require_points({a, b}, model, sphere);
  if (a == b) return true;
  // Weighted sites on one ray are circles around one axis with different radii.
  if (model == Model::weighted) return false;
  return predicates::are_on_one_ray(a, b, sphere.center);
}

}  // namespace rondel
