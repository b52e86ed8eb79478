// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/delaunay.h"

#include "api/build.h"
#include "api/validation.h"
#include "system/arithmetic.h"

namespace rondel {

Triangulation delaunay(std::span<const Point> sites, const Options& options) {
  const system::ArithmeticScope arithmetic;
  if (options.model == Model::projected) {
    api::validate(options, sites.size());
  } else {
    api::validate(sites, options);
  }
  return api::build(sites, options);
}

Triangulation delaunay(std::span<const double> xyz, const Options& options) {
  return delaunay(api::as_points(xyz), options);
}

}  // namespace rondel
