// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "same_bytes/portable/hashes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <set>
#include <span>
#include <utility>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "same_bytes/portable/file.h"

namespace rondel::test {
namespace {

// The number of a result that is stored there: an integer, or the bits of a double.
template <class Number>
Number number_at(const char* bytes) {
  Number number = 0;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

// FNV-1a (Fowler, Noll, Vo), on words of four bytes; of a number of eight bytes the lower word first.
class Hash {
 public:
  template <class T>
  void add(std::span<const T> values) {
    add_word(values.size());
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    if constexpr (alignof(T) == alignof(std::uint32_t)) {
      for (std::size_t i = 0; i < values.size_bytes(); i += sizeof(std::uint32_t)) {
        add_word(number_at<std::uint32_t>(bytes + i));
      }
    } else {
      static_assert(alignof(T) == alignof(std::uint64_t));
      for (std::size_t i = 0; i < values.size_bytes(); i += sizeof(std::uint64_t)) {
        const auto number = number_at<std::uint64_t>(bytes + i);
        add_word(number & 0xffff'ffffU);
        add_word(number >> 32U);
      }
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
