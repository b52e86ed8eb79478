// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "same_bytes/portable/site_sets.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "same_bytes/portable/file.h"

namespace rondel::test {
namespace {

bool read_point(std::FILE* file, Point& point) {
  return std::fscanf(file, "%la %la %la", &point.x, &point.y, &point.z) == 3;
}

}  // namespace

void write_site_sets(const std::string& path, const SiteSets& sets) {
  const File file = open_file(path, "w");
  for (const SiteSets::Set& s : sets.sets) {
    const Point& c = s.sphere.center;
    std::fprintf(file.get(), "%s %zu %d %a %a %a %a\n", s.name.c_str(), s.sites.size(),
                 s.is_weighted_only ? 1 : 0, s.sphere.squared_radius, c.x, c.y, c.z);
    for (const Point& p : s.sites) std::fprintf(file.get(), "%a %a %a\n", p.x, p.y, p.z);
  }
  if (std::fflush(file.get()) != 0) throw std::runtime_error(path + ": cannot be written");
}

SiteSets read_site_sets(const std::string& path) {
  const File file = open_file(path, "r");
  SiteSets result;
  std::array<char, 128> name{};
  std::size_t num_sites = 0;
  int is_weighted_only = 0;
  double squared_radius = 0;
  while (std::fscanf(file.get(), "%127s %zu %d %la", name.data(), &num_sites, &is_weighted_only,
                     &squared_radius) == 4) {
    SiteSets::Set set{.name = name.data(), .sites = std::vector<Point>(num_sites)};
    set.is_weighted_only = is_weighted_only != 0;
    set.sphere.squared_radius = squared_radius;
    bool is_whole = read_point(file.get(), set.sphere.center);
    for (Point& p : set.sites) is_whole = is_whole && read_point(file.get(), p);
    if (!is_whole) throw std::runtime_error(path + ": the set " + set.name + " is not whole");
    result.sets.push_back(std::move(set));
  }
  if (std::feof(file.get()) == 0) throw std::runtime_error(path + ": not a file of sets");
  return result;
}

}  // namespace rondel::test
