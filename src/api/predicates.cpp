// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/predicates.h"

#include "models/with_model.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "predicates/ray_order.h"
#include "system/arithmetic.h"

namespace rondel {

using predicates::FourPoints;

Sign orientation(const Point& a, const Point& b, const Point& c, const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  return predicates::orientation(a, b, c, sphere.center).sign;
}

Sign side_of_circle(const Point& a, const Point& b, const Point& c, const Point& p, Model model,
                    const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  return models::with_model(model, [&]<class T> {
    const FourPoints<T::model> points{{a, b, c, p}, sphere.center};
    return predicates::side(points, 0, 1, 2, 3).sign;
  });
}

bool is_in_conflict(const Point& a, const Point& b, const Point& c, const Point& p, Model model,
                    const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  return models::with_model(model, [&]<class T> {
    const FourPoints<T::model> points{{a, b, c, p}, sphere.center};
    return predicates::conflict(points, 0, 1, 2, 3).sign == Sign::positive;
  });
}

bool is_same_site(const Point& a, const Point& b, Model model, const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  if (a == b) return true;
  if (model == Model::weighted) return false;
  return predicates::are_on_one_ray(a, b, sphere.center);
}

}  // namespace rondel
