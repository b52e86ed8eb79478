// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "inputs.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "inputs/kinds.h"
#include "rondel/io.h"

namespace rondel::bench {

std::vector<Point> make_input(const std::string& kind, std::size_t n, std::uint64_t seed) {
  if (kind.ends_with(".csv") || kind.ends_with(".npy")) {
    const SiteTable table = read_sites(kind);
    return {table.sites.begin(), table.sites.end()};
  }
  const std::size_t colon = kind.find(':');
  const inputs::Kind* const found = inputs::find_kind(kind.substr(0, colon));
  if (found == nullptr) throw std::invalid_argument("unknown kind of input: " + kind);
  inputs::Recipe recipe{.n = n, .seed = seed};
  if (colon != std::string::npos) recipe.angle_deg = std::stod(kind.substr(colon + 1));
  return make(*found, recipe).sites;
}

std::uint64_t take_seed(int& argc, char** argv) {
  char** const end = argv + argc;
  char** const at = std::find(argv, end, std::string_view("--seed"));
  if (end - at < 2) return 1;
  const std::uint64_t seed = std::strtoull(at[1], nullptr, 10);
  std::copy(at + 2, end, at);
  argc -= 2;
  return seed;
}

Source::Source(std::string kind, const char* n, std::uint64_t first_seed)
    : kind_(std::move(kind)), n_(std::strtoull(n, nullptr, 10)), seed_(first_seed) {}

}  // namespace rondel::bench
