// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/predicates.h"

#include "predicates/orientation.h"
#include "predicates/perturbation.h"
#include "predicates/ray_order.h"
#include "predicates/side_of_circle.h"
#include "predicates/side_of_plane.h"
#include "system/arithmetic.h"

namespace rondel::inline v0 {

Sign orientation(const Point& a, const Point& b, const Point& c, const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  return predicates::orientation_ladder(a, b, c, sphere.center).sign;
}

Sign side_of_circle(const Point& a, const Point& b, const Point& c, const Point& p, Model model,
                    const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  if (model == Model::projected) {
    return predicates::side_of_circle_ladder(a, b, c, p, sphere.center).sign;
  }
  using exact::to_vector;
  const Sign sign =
      predicates::side_of_plane_filter(to_vector(a), to_vector(b), to_vector(c), to_vector(p));
  return sign != Sign::zero ? sign : predicates::side_of_plane_ladder(a, b, c, p).sign;
}

bool is_in_conflict(const Point& a, const Point& b, const Point& c, const Point& p, Model model,
                    const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  const Sign sign = side_of_circle(a, b, c, p, model, sphere);
  if (sign != Sign::zero) return sign == Sign::positive;
  return predicates::is_in_conflict_perturbed(a, b, c, p, model, sphere.center);
}

bool is_same_site(const Point& a, const Point& b, Model model, const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  if (a == b) return true;
  if (model == Model::weighted) return false;
  return predicates::are_on_one_ray(a, b, sphere.center);
}

}  // namespace rondel::inline v0
