// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of results, for each kind of sites of tests/support, each good file of tests/corpus/io and
// the stations of data/, in both models, with 1, 2 and 5 threads.
//
//     same_bytes EXPECTED            compares with the hashes that are recorded, and tells what
//     differs same_bytes EXPECTED --update   records those of this build
//
// A line is: name, model, hash of the triangulation, hash of its duals.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/io.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

const std::filesystem::path source = RONDEL_SOURCE_DIR;

// FNV-1a (Fowler, Noll, Vo), on words of four bytes.
class Hash {
 public:
  template <class T>
  void add(std::span<const T> values) {
    static_assert(sizeof(T) % sizeof(std::uint32_t) == 0);
    add_word(values.size());
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    for (std::size_t i = 0; i < values.size_bytes(); i += sizeof(std::uint32_t)) {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes + i, sizeof word);
      add_word(word);
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 0x0000'0100'0000'01b3U; }

  [[nodiscard]] std::string text() const {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx",
                  static_cast<unsigned long long>(value_));  // NOLINT(google-runtime-int)
    return digits.data();
  }

 private:
  std::uint64_t value_ = 0xcbf2'9ce4'8422'2325U;
};

std::string hash_of(const Triangulation& t) {
  Hash hash;
  hash.add_word(static_cast<std::uint64_t>(t.dimension() + 1));
  hash.add(t.faces());
  hash.add(t.neighbors());
  hash.add(t.ghost_faces());
  hash.add(t.ring());
  hash.add(t.duplicates());
  hash.add(t.hidden());
  return hash.text();
}

std::string hash_of_duals(const Triangulation& t) {
  const Diagram duals = diagram(t);
  Hash hash;
  hash.add(duals.cells.offsets);
  hash.add(duals.cells.rings);
  hash.add(duals.cells.points);
  hash.add(duals.areas);
  hash.add(centroids(t));
  return hash.text();
}

class Lines {
 public:
  void add(const std::string& name, std::span<const Point> sites, const Sphere& sphere,
           bool is_weighted_only) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (is_weighted_only && model == Model::projected) continue;
      std::string duals;
      std::set<std::string> seen;
      for (const unsigned threads : {1U, 2U, 5U}) {
        const Triangulation t =
            delaunay(sites, {.model = model, .sphere = sphere}, {.threads = threads});
        if (seen.empty()) duals = hash_of_duals(t);
        seen.insert(hash_of(t));
      }
      for (const std::string& hash : seen) {
        const std::string kind = model == Model::weighted ? " weighted " : " projected ";
        lines_.push_back(name + kind + hash + ' ' + duals);
      }
    }
  }

  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

std::vector<std::string> compute() {
  Lines lines;
  for (const Generator& g : generators()) {
    const SiteSet set = g.make(40, 1);
    lines.add(std::string(g.name), set.sites, set.sphere, g.weighted_only);
  }
  // So many that they are built by blocks; the last by more than one.
  for (const char* name :
       {"uniform", "clustered", "globe_grid", "patch_and_globe", "one_ulp_apart"}) {
    const SiteSet set = generator(name).make(10'000, 1);
    lines.add(std::string(name) + "_10000", set.sites, set.sphere, false);
  }
  const SiteSet many = generator("uniform").make(60'000, 1);
  lines.add("uniform_60000", many.sites, many.sphere, false);

  std::set<std::filesystem::path> files = {source / "data" / "stations.csv"};
  for (const auto& entry :
       std::filesystem::directory_iterator(source / "tests" / "corpus" / "io" / "good")) {
    files.insert(entry.path());
  }
  for (const auto& file : files) {
    lines.add(file.filename().string(), read_sites(file.string()).sites, {}, false);
  }
  return lines.lines();
}

std::vector<std::string> read_lines(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

int run(const std::string& path, bool is_update) {
  const std::vector<std::string> actual = compute();
  if (is_update) {
    std::ofstream file(path);
    for (const std::string& line : actual) file << line << '\n';
    return 0;
  }
  const std::vector<std::string> expected = read_lines(path);
  const std::set<std::string> wanted(expected.begin(), expected.end());
  std::size_t num_different = actual.size() == expected.size() ? 0 : 1;
  for (const std::string& line : actual) {
    if (wanted.contains(line)) continue;
    ++num_different;
    std::printf("not as recorded: %s\n", line.c_str());
  }
  std::printf("%zu results, %zu recorded, %zu different\n", actual.size(), expected.size(),
              num_different);
  return num_different == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rondel::test

int main(int argc, char** argv) {
  const bool is_update = argc == 3 && std::string(argv[2]) == "--update";
  if (argc != 2 && !is_update) {
    std::fputs("usage: same_bytes EXPECTED [--update]\n", stderr);
    return 2;
  }
  try {
    return rondel::test::run(argv[1], is_update);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "same_bytes: %s\n", error.what());
    return 1;
  }
}
