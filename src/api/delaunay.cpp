// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// delaunay(): validates the arguments, and builds. Rays are validated while they are sorted
// (build.cpp), as that reads them anyway; weighted sites are validated here.

#include "rondel/delaunay.h"

#include <utility>

#include "api/build.h"
#include "api/validation.h"
#include "system/job.h"

namespace rondel {

Triangulation delaunay(Sites sites, const Options& options, const Execution& execution) {
  const system::Call call(execution);
  if (options.model == Model::projected) {
    api::validate(options, sites.size());
  } else {
    api::validate(sites.points(), options);
  }
  return api::build(std::move(sites), {options, execution});
}

Triangulation delaunay(std::span<const double> xyz, const Options& options,
                       const Execution& execution) {
  return delaunay(Sites(api::as_points(xyz)), options, execution);
}

}  // namespace rondel
