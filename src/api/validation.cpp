// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "api/validation.h"

#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <string>

#include "rondel/error.h"
#include "system/parallel.h"

namespace rondel::api {
namespace {

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Whether all sites are finite and, in the projected model, none is the center. Faster than to ask
// for each: a coordinate that is not finite makes its sum NaN, and nothing branches.
bool are_valid(std::span<const Point> sites, const Options& options) {
  constexpr std::size_t grain = std::size_t{1} << 16;
  const Point center = options.sphere.center;
  const bool is_projected = options.model == Model::projected;
  std::atomic<bool> are_valid = true;
  system::parallel_for(options.threads, sites.size(), grain, [&](std::size_t i, std::size_t end) {
    Point sum;
    bool is_center = false;
    for (; i < end; ++i) {
      const Point& p = sites[i];
      sum = {sum.x + 0 * p.x, sum.y + 0 * p.y, sum.z + 0 * p.z};
      is_center |= (p.x == center.x) & (p.y == center.y) & (p.z == center.z);
    }
    if (sum != Point{} || (is_projected && is_center)) are_valid = false;
  });
  return are_valid;
}

std::string coordinates(const Point& p) {
  return "(" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + ")";
}

}  // namespace

std::string text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

void validate(std::span<const Point> sites, const Options& options) {
  const Sphere& sphere = options.sphere;
  if (!is_finite(sphere.center)) {
    throw InvalidInput("the center " + coordinates(sphere.center) + " of the sphere is not finite",
                       0);
  }
  if (!(sphere.squared_radius > 0) || !std::isfinite(sphere.squared_radius)) {
    throw InvalidInput(
        "the squared radius " + text(sphere.squared_radius) + " of the sphere is not positive", 0);
  }
  if (sites.size() > max_sites) {
    throw InvalidInput(std::to_string(sites.size()) + " sites are more than the " +
                           std::to_string(max_sites) + " that one triangulation can hold",
                       max_sites);
  }
  if (are_valid(sites, options)) return;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!is_finite(sites[i])) {
      throw InvalidInput(
          "site " + std::to_string(i) + ": " + coordinates(sites[i]) + " is not finite", i);
    }
    if (options.model == Model::projected && sites[i] == sphere.center) {
      throw InvalidInput("site " + std::to_string(i) + ": " + coordinates(sites[i]) +
                             " is the center of the sphere and has no projection",
                         i);
    }
  }
}

void validate_queries(std::span<const Point> queries, const Point& center, bool are_rays) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (!is_finite(queries[i])) {
      throw InvalidInput(
          "query " + std::to_string(i) + ": " + coordinates(queries[i]) + " is not finite", i);
    }
    if (are_rays && queries[i] == center) {
      throw InvalidInput("query " + std::to_string(i) + ": " + coordinates(queries[i]) +
                             " is the center of the sphere and has no direction",
                         i);
    }
  }
}

}  // namespace rondel::api
