// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "api/validation.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "rondel/error.h"

namespace rondel::api {
namespace {

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
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

void validate(const Options& options, std::size_t num_sites) {
  const Sphere& sphere = options.sphere;
  if (!is_finite(sphere.center)) {
    throw InvalidInput("the center " + coordinates(sphere.center) + " of the sphere is not finite",
                       0);
  }
  if (!(sphere.squared_radius > 0) || !std::isfinite(sphere.squared_radius)) {
    throw InvalidInput(
        "the squared radius " + text(sphere.squared_radius) + " of the sphere is not positive", 0);
  }
  if (num_sites > max_sites) {
    throw InvalidInput(std::to_string(num_sites) + " sites are more than the " +
                           std::to_string(max_sites) + " that one triangulation can hold",
                       max_sites);
  }
}

// A coordinate that is not finite makes its sum NaN.
bool are_valid(std::span<const Point> sites, const Options& options) {
  const Point center = options.sphere.center;
  Point sum;
  bool is_center = false;
  for (const Point& p : sites) {
    sum = {sum.x + 0 * p.x, sum.y + 0 * p.y, sum.z + 0 * p.z};
    is_center |= (p.x == center.x) & (p.y == center.y) & (p.z == center.z);
  }
  return sum == Point{} && (options.model == Model::weighted || !is_center);
}

void validate(std::span<const Point> sites, const Options& options) {
  validate(options, sites.size());
  if (are_valid(sites, options)) return;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!is_finite(sites[i])) {
      throw InvalidInput(
          "site " + std::to_string(i) + ": " + coordinates(sites[i]) + " is not finite", i);
    }
    if (options.model == Model::projected && sites[i] == options.sphere.center) {
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
