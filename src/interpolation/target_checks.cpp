// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/target_checks.h"

#include <string>

#include "api/validation.h"
#include "rondel/error.h"

namespace rondel::interpolation {

void require_targets(const PreparedTriangulation& prepared, std::span<const Point> targets,
                     const InterpolationOptions& options) {
  const Triangulation& triangulation = prepared.triangulation();
  if (targets.size() >= no_index) {
    throw InvalidInput(std::to_string(targets.size()) + " targets are too many for one call",
                       no_index);
  }
  api::validate_queries(targets, prepared.center(), true, "target");
  if (options.method > Method::cubic) throw InvalidInput("there is no such method");
  if (prepared.model() == Model::weighted && options.method != Method::nearest) {
    throw InvalidInput("weighted sites have no method but nearest");
  }
  if (options.shared_place == SharedPlace::error && !triangulation.duplicates().empty()) {
    const auto& [site, representative] = triangulation.duplicates().front();
    throw InvalidInput("site " + std::to_string(site) + " is in the place of site " +
                           std::to_string(representative),
                       site);
  }
}

std::size_t num_fields_of(const PreparedTriangulation& prepared, std::string_view name,
                          std::size_t size) {
  const std::size_t num_sites = prepared.num_sites();
  if (num_sites == 0 && size == 0) return 1;
  if (num_sites == 0 || size == 0 || size % num_sites != 0) {
    throw InvalidInput(std::string(name) + " has " + std::to_string(size) +
                           " values, which are no multiple of the " + std::to_string(num_sites) +
                           " sites",
                       size);
  }
  return size / num_sites;
}

void refuse_outside(Index target) {
  if (target == no_index) return;
  throw InvalidInput("target " + std::to_string(target) + " is outside of the sites' faces",
                     target);
}

}  // namespace rondel::interpolation
