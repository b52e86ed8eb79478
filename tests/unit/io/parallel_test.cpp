// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files written by several threads, and sites that stay in the file.
#include <random>
#include <stdexcept>

#include "io/npy_header.h"
#include "io/parallel_write.h"
#include "io/site_formats.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

constexpr unsigned thread_counts[] = {1, 2, 3, 7, 16};

TEST(write_in_parallel, writes_all_texts_in_order) {
  const TemporaryDirectory directory;
  const std::string name = directory.file("a.txt");
  for (const std::size_t count : {0U, 1U, 99U, 100U, 101U, 20033U}) {
    std::string expected;
    for (std::size_t i = 0; i < count; ++i) expected += std::to_string(i) + "\n";
    for (const unsigned threads : thread_counts) {
      std::size_t reported = 0;
      io::AtomicFile file(name);
      io::write_in_parallel(
          file, threads, count, 100,
          [](std::string& text, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) text += std::to_string(i) + "\n";
          },
          [&](std::size_t done) {
            EXPECT_GT(done, reported);
            reported = done;
          });
      file.commit();
      EXPECT_EQ(reported, count);
      EXPECT_EQ(read_all(name), expected) << threads;
    }
  }
}

TEST(write_in_parallel, leaves_no_file_when_a_text_cannot_be_made) {
  const TemporaryDirectory directory;
  const std::string name = directory.file("a.txt");
  for (const unsigned threads : thread_counts) {
    const auto write = [&] {
      io::AtomicFile file(name);
      io::write_in_parallel(file, threads, 5000, 10,
                            [](std::string& text, std::size_t begin, std::size_t) {
                              if (begin == 4000) throw std::runtime_error("4000");
                              text += "text";
                            });
      file.commit();
    };
    EXPECT_THROW(write(), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(name));
  }
}

#if !defined(_WIN32)
// A device that takes nothing: the first write fails, while other texts are being made.
TEST(write_in_parallel, says_what_failed_when_the_disk_is_full) {
  for (const unsigned threads : thread_counts) {
    const auto write = [&] {
      io::AtomicFile file("/dev/full");
      io::write_in_parallel(
          file, threads, 5000, 10,
          [](std::string& text, std::size_t, std::size_t) { text.append(100'000, 'x'); });
      file.commit();
    };
    EXPECT_EQ(thrown_message<FileError>(write), "/dev/full: No space left on device") << threads;
  }
}
#endif

std::vector<LonLat> random_positions(std::size_t n) {
  std::mt19937_64 random(6);
  std::vector<LonLat> positions(n);
  for (LonLat& position : positions) {
    position.lon_deg = std::uniform_real_distribution<>(-180, 180)(random);
    position.lat_deg = std::uniform_real_distribution<>(-90, 90)(random);
  }
  return positions;
}

TEST(write_triangles, and_cells_have_the_same_bytes_for_any_number_of_threads) {
  const TemporaryDirectory directory;
  SiteTable table;
  table.sites = unit_vectors(random_positions(is_shortened() ? 9000U : 20000U));
  std::vector<std::string> expected;
  for (const unsigned threads : thread_counts) {
    if (is_shortened() && threads != 1 && threads != 3) continue;
    const Execution execution{.threads = threads};
    const Triangulation triangulation = delaunay(table.sites, {}, execution);
    const Diagram cells = diagram(triangulation, execution);
    std::vector<std::string> written;
    for (const char* const ending : {"off", "obj", "ply", "stl", "vtp", "npy", "geojson"}) {
      const std::string name = directory.file(std::string("a.") += ending);
      write_triangles(name, table, triangulation, execution);
      written.push_back(read_all(name));
    }
    for (const char* const ending : {"geojson", "vtp", "npz"}) {
      const std::string name = directory.file(std::string("a.") += ending);
      write_cells(name, table, triangulation, cells, 0.01, execution);
      written.push_back(read_all(name));
    }
    if (expected.empty()) expected = written;
    EXPECT_TRUE(written == expected) << threads;
  }
}

TEST(write_sites, has_the_same_bytes_for_any_number_of_threads) {
  const TemporaryDirectory directory;
  const auto positions = random_positions(20000);
  const auto sites = unit_vectors(positions);
  for (const char* const ending : {"csv", "tsv", "xyz", "npy"}) {
    const std::string name = directory.file(std::string("a.") += ending);
    write_sites(name, sites, positions, {}, {.threads = 1});
    const std::string expected = read_all(name);
    for (const unsigned threads : thread_counts) {
      write_sites(name, sites, positions, {}, {.threads = threads});
      EXPECT_TRUE(read_all(name) == expected) << ending << ' ' << threads;
    }
  }
}

}  // namespace
}  // namespace rondel::test
