// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of results, for each kind of sites of tests/support, each good file of tests/corpus/io and
// the stations of data/, in both models, with 1, 2 and 5 threads.
//
//     same_bytes EXPECTED                    compares with the hashes that are recorded, and tells
//                                            what differs
//     same_bytes EXPECTED --update           records those of this build
//     same_bytes EXPECTED --write-sets SETS  writes the sites, for same_bytes_of on another machine

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "same_bytes/portable/hashes.h"
#include "same_bytes/portable/site_sets.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

const std::filesystem::path source = RONDEL_SOURCE_DIR;

void add_set(const std::string& name, const SiteSet& set, bool is_weighted_only, SiteSets& sets) {
  sets.sets.push_back({name, set.sites, set.sphere, is_weighted_only});
}

SiteSets make_sets() {
  SiteSets sets;
  for (const Generator& g : generators()) {
    add_set(std::string(g.name), g.make(40, 1), g.weighted_only, sets);
  }
  // So many that they are built by blocks; the last by more than one.
  for (const char* name :
       {"uniform", "clustered", "globe_grid", "patch_and_globe", "one_ulp_apart"}) {
    add_set(std::string(name) + "_10000", generator(name).make(10'000, 1), false, sets);
  }
  add_set("uniform_60000", generator("uniform").make(60'000, 1), false, sets);

  std::set<std::filesystem::path> files = {source / "data" / "stations.csv"};
  for (const auto& entry :
       std::filesystem::directory_iterator(source / "tests" / "corpus" / "io" / "good")) {
    files.insert(entry.path());
  }
  for (const auto& file : files) {
    sets.sets.push_back(
        {.name = file.filename().string(), .sites = read_sites(file.string()).sites});
  }
  return sets;
}

void record(const std::string& path, const std::vector<std::string>& lines) {
  std::ofstream file(path);
  for (const std::string& line : lines) file << line << '\n';
}

int run(const std::vector<std::string>& arguments) {
  const SiteSets sets = make_sets();
  const std::string& expected = arguments[0];
  if (arguments.size() == 3) {
    write_site_sets(arguments[2], sets);
  } else if (arguments.size() == 2) {
    record(expected, hash_lines(sets));
  } else {
    return num_different(expected, hash_lines(sets)) == 0 ? 0 : 1;
  }
  return 0;
}

bool is_usage(const std::vector<std::string>& arguments) {
  switch (arguments.size()) {
    case 1:
      return true;
    case 2:
      return arguments[1] == "--update";
    default:
      return arguments.size() == 3 && arguments[1] == "--write-sets";
  }
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!rondel::test::is_usage(arguments)) {
    std::fputs("usage: same_bytes EXPECTED [--update | --write-sets SETS]\n", stderr);
    return 2;
  }
  try {
    return rondel::test::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "same_bytes: %s\n", error.what());
    return 1;
  }
}
