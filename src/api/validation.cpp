// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks of arguments. All sites are tested at once without branches; only if that fails, they are
// tested one by one for the message.

#include "api/validation.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "rondel/error.h"
#include "system/message_text.h"
#include "system/wide_vectors.h"

namespace rondel::api {
namespace {

using system::shortest_text;

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Returns "(x, y, z)" in the shortest digits that read back as the same doubles.
std::string coordinates(const Point& p) {
  return "(" + shortest_text(p.x) + ", " + shortest_text(p.y) + ", " + shortest_text(p.z) + ")";
}

// Throws InvalidInput for the first of the points that is not finite or, where points are rays, the
// center. `word` and `first` name it: "site 7" for point i if first + i is 7. `what_center_lacks`
// ends the message about the center.
void validate_each(const char* word, std::span<const Point> points, const Point& center,
                   bool are_rays, const char* what_center_lacks, std::uint64_t first = 0) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto refuse = [&](const std::string& flaw) {
      throw InvalidInput(std::string(word) + " " + std::to_string(first + i) + ": " +
                             coordinates(points[i]) + " is " + flaw,
                         static_cast<std::size_t>(first + i));
    };
    if (!is_finite(points[i])) refuse("not finite");
    if (are_rays && points[i] == center) {
      refuse(std::string("the center of the sphere and has no ") + what_center_lacks);
    }
  }
}

}  // namespace

void validate(const Options& options, std::size_t num_sites) {
  const Sphere& sphere = options.sphere;
  if (!is_finite(sphere.center)) {
    throw InvalidInput("the center " + coordinates(sphere.center) + " of the sphere is not finite",
                       0);
  }
  if (!(sphere.squared_radius > 0) || !std::isfinite(sphere.squared_radius)) {
    throw InvalidInput("the squared radius " + shortest_text(sphere.squared_radius) +
                           " of the sphere is not positive",
                       0);
  }
  if (num_sites > max_sites) {
    throw InvalidInput(std::to_string(num_sites) + " sites are more than the " +
                           std::to_string(max_sites) + " that one triangulation can hold",
                       max_sites);
  }
}

// The loop has no branches, so that it becomes vector code. NaN fails the comparison with the
// largest double, and so do infinities.
bool are_valid(std::span<const Point> sites, const Options& options) {
  constexpr double largest = std::numeric_limits<double>::max();
  const Point center = options.sphere.center;
  std::uint64_t are_finite = 1;
  std::uint64_t is_center = 0;
  system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
    const auto bit = [](bool condition) { return static_cast<std::uint64_t>(condition); };
    std::uint64_t finite = 1;
    std::uint64_t same = 0;
    for (const Point& p : sites) {
      finite &= bit(std::abs(p.x) <= largest) & bit(std::abs(p.y) <= largest) &
                bit(std::abs(p.z) <= largest);
      same |= bit(p.x == center.x) & bit(p.y == center.y) & bit(p.z == center.z);
    }
    are_finite = finite;
    is_center = same;
  });
  return are_finite != 0 && (options.model == Model::weighted || is_center == 0);
}

void validate(std::span<const Point> sites, const Options& options) {
  validate(options, sites.size());
  validate_some(sites, options, 0);
}

void validate_some(std::span<const Point> sites, const Options& options, std::uint64_t first) {
  if (are_valid(sites, options)) return;
  validate_each("site", sites, options.sphere.center, options.model == Model::projected,
                "projection", first);
}

void validate_queries(std::span<const Point> queries, const Point& center, bool are_rays,
                      const char* word) {
  validate_each(word, queries, center, are_rays, "direction");
}

}  // namespace rondel::api
