// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Damaged files are refused or read, but never crash a reader: every file of the corpus with
// random bytes changed, removed, doubled or taken from another file, and cut at every length.
#include <random>

#include "unit/io/support.h"

namespace rondel::test {
namespace {

using namespace std::string_view_literals;

std::string mutate(std::string bytes, const std::string& other, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n == 0 ? 0 : n - 1)(random);
  };
  constexpr std::string_view special = "\"\n\r,\t{}[]()-+.e0129\x00\xFF<>'#_/"sv;
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    const std::size_t position = below(bytes.size());
    const std::size_t length = below(1 + std::min<std::size_t>(16, bytes.size() - position));
    switch (below(4)) {
      case 0:
        if (!bytes.empty()) bytes[position] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.insert(position, 1, special[below(special.size())]);
        break;
      case 2:
        bytes.erase(position, length);
        break;
      default:
        bytes.insert(position, other, below(other.size()), length);
    }
  }
  return bytes;
}

// Reads mutations of all files of a folder; the number of those that were refused.
template <typename Read>
std::size_t refused_mutations(const std::filesystem::path& folder, Read read) {
  constexpr int per_file = 60;
  const TemporaryDirectory directory;
  std::mt19937_64 random(17);
  std::size_t refused = 0;
  std::string other;
  for (const auto& file : files_in(folder)) {
    const std::string bytes = read_all(file);
    const std::string name = "mutated" + file.extension().string();
    for (int i = 0; i < per_file; ++i) {
      const std::string path = directory.with(name, mutate(bytes, other, random));
      if (!message_of([&] { read(path); }).empty()) ++refused;
    }
    for (std::size_t size = 0; size < std::min<std::size_t>(bytes.size(), 200); ++size) {
      const std::string path = directory.with(name, bytes.substr(0, size));
      if (!message_of([&] { read(path); }).empty()) ++refused;
    }
    other = bytes;
  }
  return refused;
}

void read_with_columns(const std::string& path) {
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites(path, options);
  for (const Column& column : table.columns) EXPECT_EQ(column.ends.size(), table.sites.size());
}

TEST(mutated_files, of_sites_crash_no_reader) {
  EXPECT_GT(refused_mutations(corpus / "good", read_with_columns), 500U);
  EXPECT_GT(refused_mutations(corpus / "bad", read_with_columns), 500U);
}

TEST(mutated_files, of_triangles_crash_no_reader) {
  EXPECT_GT(refused_mutations(corpus / "good_triangles", read_triangles), 500U);
  EXPECT_GT(refused_mutations(corpus / "bad_triangles", read_triangles), 500U);
}

}  // namespace
}  // namespace rondel::test
