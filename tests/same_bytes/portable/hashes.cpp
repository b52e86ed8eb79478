// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "same_bytes/portable/hashes.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <utility>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "same_bytes/portable/file.h"
#include "same_bytes/portable/hash.h"

namespace rondel::test {
namespace {

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
  hash.add(duals.cells.rings.offsets);
  hash.add(duals.cells.rings.values);
  hash.add(duals.cells.points);
  hash.add(duals.areas);
  hash.add(centroids(t));
  return hash.text();
}

void add_lines(const SiteSets::Set& set, Model model, std::vector<std::string>& lines) {
  std::string duals;
  std::set<std::string> seen;
  for (const unsigned threads : {1U, 2U, 5U}) {
    const Triangulation t =
        delaunay(set.sites, {.model = model, .sphere = set.sphere}, {.threads = threads});
    if (seen.empty()) duals = hash_of_duals(t);
    seen.insert(hash_of(t));
  }
  for (const std::string& hash : seen) {
    const std::string kind = model == Model::weighted ? " weighted " : " projected ";
    lines.push_back(set.name + kind + hash + ' ' + duals);
  }
}

std::set<std::string> read_lines(const std::string& path) {
  const File file = open_file(path, "r");
  std::set<std::string> lines;
  std::string line;
  for (int c = std::fgetc(file.get()); c != EOF; c = std::fgetc(file.get())) {
    if (c != '\n') {
      line += static_cast<char>(c);
    } else {
      lines.insert(std::exchange(line, {}));
    }
  }
  return lines;
}

}  // namespace

std::vector<std::string> hash_lines(const SiteSets& sets) {
  std::vector<std::string> lines;
  for (const SiteSets::Set& set : sets.sets) {
    if (!set.is_weighted_only) add_lines(set, Model::projected, lines);
    add_lines(set, Model::weighted, lines);
  }
  return lines;
}

std::size_t num_different(const std::string& expected_path, const std::vector<std::string>& lines) {
  const std::set<std::string> expected = read_lines(expected_path);
  std::size_t result = lines.size() == expected.size() ? 0 : 1;
  for (const std::string& line : lines) {
    if (expected.contains(line)) continue;
    ++result;
    std::printf("not as recorded: %s\n", line.c_str());
  }
  std::printf("%zu results, %zu recorded, %zu different\n", lines.size(), expected.size(), result);
  return result;
}

}  // namespace rondel::test
