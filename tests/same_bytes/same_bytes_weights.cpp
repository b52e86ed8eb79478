// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of weights of every method, gradients, values of a field and its contours, for each kind of
// sites of tests/support, with 1, 2 and 5 threads.
//
//     same_bytes_weights EXPECTED              compares with the hashes that are recorded, and tells
//                                              what differs
//     same_bytes_weights EXPECTED --update     records those of this build

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/interpolate.h"
#include "same_bytes/portable/hash.h"
#include "same_bytes/recorded.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

constexpr std::array methods = {
    std::pair{Method::nearest, "nearest"}, std::pair{Method::linear, "linear"},
    std::pair{Method::laplace, "laplace"}, std::pair{Method::sibson, "sibson"},
    std::pair{Method::hermite, "hermite"}, std::pair{Method::cubic, "cubic"}};

std::string hash_of(const Weights& weights) {
  Hash hash;
  hash.add(weights.offsets);
  hash.add(weights.columns);
  hash.add(weights.values);
  hash.add_word(weights.num_columns);
  return hash.text();
}

// What differs between turns of threads is there twice.
using Found = std::set<std::string>;

std::string hash_of_contours(const Triangulation& triangulation, const std::vector<double>& field,
                             unsigned threads) {
  const std::array levels = {-0.5, 0.0, 0.25};
  const Isolines lines = isolines(triangulation, field, levels, {.threads = threads});
  const Bands areas = bands(triangulation, field, levels, {.threads = threads});
  Hash hash;
  hash.add(lines.lines.rows.offsets);
  hash.add(lines.lines.rows.values);
  hash.add(areas.bands.rows.offsets);
  hash.add(areas.rings().offsets);
  hash.add(areas.rings().values);
  return hash.text();
}

// Not where nothing is: such values are not the same bits everywhere.
std::string hash_of_values(const std::vector<double>& values) {
  Hash hash;
  for (const double value : values) {
    if (value == value) hash.add(std::span(&value, 1));
  }
  return hash.text();
}

void add_lines(const std::string& name, const SiteSet& set, std::vector<std::string>& lines) {
  const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
  const Point& center = set.sphere.center;
  std::vector<Point> targets;
  std::vector<double> field;
  Random random(7);
  for (const Point& site : set.sites) {
    const Point direction = random.direction();
    targets.push_back(center + direction);
    if (random.below(4) == 0) targets.push_back(site);
    // Of the place in the set, so that even the smallest has contours.
    field.push_back(direction.x);
  }
  const Triangulation& faces = triangulation;
  for (std::size_t f = 0; f < faces.num_faces() && targets.size() < 2 * set.sites.size(); ++f) {
    const Triple& face = faces.faces()[f];
    const Point sum = (set.sites[face[0]] - center) + (set.sites[face[1]] - center);
    if (sum != Point{}) targets.push_back(center + sum);
  }
  // Of the hugest sites some are beyond the range of doubles.
  std::erase_if(targets, [](const Point& p) {
    return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
  });
  const Interpolator interpolator(triangulation);
  const auto record = [&](const char* what, const auto& hash_with) {
    Found found;
    for (const unsigned threads : {1U, 2U, 5U}) found.insert(hash_with(threads));
    for (const std::string& hash : found) lines.push_back(name + ' ' + what + ' ' + hash);
  };
  for (const auto& [method, text] : methods) {
    // Values first: with gradients that no rows have been made of.
    record((std::string("values-") + text).c_str(), [&, m = method](unsigned threads) {
      return hash_of_values(
          Interpolator(triangulation).values(field, targets, {.method = m}, {.threads = threads}));
    });
    record(text, [&, m = method](unsigned threads) {
      return hash_of(interpolator.weights(targets, {.method = m}, {.threads = threads}));
    });
  }
  record("gradient", [&](unsigned threads) {
    return hash_of(Interpolator(triangulation).gradient({}, {.threads = threads}));
  });
  record("contours",
         [&](unsigned threads) { return hash_of_contours(triangulation, field, threads); });
}

std::vector<std::string> all_lines() {
  std::vector<std::string> lines;
  for (const Generator& g : generators()) {
    if (!g.weighted_only) add_lines(std::string(g.name), g.make(40, 1), lines);
  }
  for (const char* name : {"uniform", "globe_grid", "one_ulp_apart"}) {
    add_lines(std::string(name) + "_10000", generator(name).make(10'000, 1), lines);
  }
  return lines;
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  return rondel::test::compare_or_record("same_bytes_weights", rondel::test::all_lines, argc, argv);
}
