// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sets of points with a known number of sites, which -n must be. The formulas of the numbers are
// those of the library (rondel/point_sets.h).
#include "point_set_kinds.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "command.h"
#include "rondel/error.h"
#include "rondel/point_sets.h"

namespace rondel::cli {
namespace {

using inputs::Input;
using inputs::Kind;
using inputs::Recipe;

// Returns the size whose set has n sites; if there is none, throws UsageError with the nearest
// possible numbers.
template <class CountOf>
std::size_t size_of_count(std::size_t n, std::size_t least, const CountOf& count_of) {
  std::size_t size = least;
  while (count_of(size) < n) ++size;
  if (count_of(size) == n) return size;
  std::string nearest = std::to_string(count_of(size));
  if (size > least) nearest = std::to_string(count_of(size - 1)) + " or " + nearest;
  throw UsageError("-n,--number: this kind has " + nearest + " sites, not " + std::to_string(n));
}

// Returns the sites that make() returns; what the library refuses is an error of the command line.
template <class Make>
Input input_of(const Make& make) {
  Input input;
  try {
    input.sites = make();
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
  return input;
}

// Each of these functions makes the set whose number of sites is recipe.n.
Input icosahedral(const Recipe& recipe) {
  const std::size_t levels =
      size_of_count(recipe.n, 0, [](std::size_t k) { return (std::size_t{10} << (2 * k)) + 2; });
  return input_of([&] { return mesh::icosahedral_points(static_cast<unsigned>(levels)); });
}

Input healpix(const Recipe& recipe) {
  const std::size_t side = size_of_count(recipe.n, 1, [](std::size_t k) { return 12 * k * k; });
  return input_of([&] { return mesh::healpix_points(side); });
}

Input reduced_gaussian(const Recipe& recipe) {
  const std::size_t number =
      size_of_count(recipe.n, 1, [](std::size_t k) { return 4 * k * (k + 9); });
  return input_of([&] { return mesh::reduced_gaussian_points(number); });
}

Input cubed_sphere(const Recipe& recipe) {
  const std::size_t side = size_of_count(recipe.n, 1, [](std::size_t k) { return 6 * k * k; });
  return input_of([&] { return mesh::cubed_sphere_points(side); });
}

// Poisson disks have no number of sites, but a least distance in degrees.
Input poisson(const Recipe& recipe) {
  return input_of([&] {
    return mesh::poisson_disk_points(recipe.angle_deg / inputs::degrees_per_radian, recipe.seed);
  });
}

// The kinds in the order of the help. The last two numbers are the default angle in degrees (0: the
// kind has none), and whether the seed has an effect.
constexpr std::array all_sets{
    Kind{"icosahedral", "corners of a divided icosahedron: 10 * 4^k + 2", &icosahedral, 0, false},
    Kind{"healpix", "centers of HEALPix's pixels, ring by ring: 12 side^2", &healpix, 0, false},
    Kind{"reduced-gaussian", "ECMWF's octahedral grid O(k): 4 k (k + 9)", &reduced_gaussian, 0,
         false},
    Kind{"cubed-sphere", "centers of the equiangular cubed sphere: 6 side^2", &cubed_sphere, 0,
         false},
    Kind{"poisson", "no two nearer than --angle (1), no gap: takes no -n", &poisson, 1},
};

}  // namespace

std::span<const Kind> point_set_kinds() { return all_sets; }

const Kind* find_kind(std::string_view name) {
  const auto at = std::ranges::find(all_sets, name, &Kind::name);
  return at != all_sets.end() ? &*at : inputs::find_kind(name);
}

}  // namespace rondel::cli
