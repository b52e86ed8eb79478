// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files written by several threads, and sites that stay in the file.
#include <random>
#include <stdexcept>

#include "io/npy_header.h"
#include "io/parallel_write.h"
#include "io/site_formats.h"
#include "io_support.h"
#include "rondel/delaunay.h"

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
  table.sites = unit_vectors(random_positions(20000));
  std::vector<std::string> expected;
  for (const unsigned threads : thread_counts) {
    Options options;
    options.threads = threads;
    const Triangulation triangulation = delaunay(table.sites, options);
    const Diagram cells = diagram(triangulation, table.sites);
    std::vector<std::string> written;
    for (const char* const ending : {"off", "obj", "ply", "stl", "vtp", "npy", "geojson"}) {
      const std::string name = directory.file(std::string("a.") += ending);
      write_triangles(name, table, triangulation);
      written.push_back(read_all(name));
    }
    for (const char* const ending : {"geojson", "vtp", "npz"}) {
      const std::string name = directory.file(std::string("a.") += ending);
      write_cells(name, table, triangulation, cells);
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
    write_sites(name, sites, positions, {}, 1);
    const std::string expected = read_all(name);
    for (const unsigned threads : thread_counts) {
      write_sites(name, sites, positions, {}, threads);
      EXPECT_TRUE(read_all(name) == expected) << ending << ' ' << threads;
    }
  }
}

// Just as many rows as are not copied.
class LargeNpy : public testing::Test {
 protected:
  static constexpr std::size_t n = std::size_t{1} << 22;

  // A file whose rows are zeros but for the last one.
  [[nodiscard]] std::string write(std::string_view dtype, std::size_t rows,
                                  const Point& last) const {
    const std::string name = directory_.file("a.npy");
    std::ofstream file(name, std::ios::binary);
    file << io::make_npy_header(dtype, std::array<std::uint64_t, 2>{rows, 3});
    file.seekp(static_cast<std::streamoff>((rows - 1) * sizeof(Point)), std::ios::cur);
    file.write(reinterpret_cast<const char*>(&last), sizeof(last));
    return name;
  }

  TemporaryDirectory directory_;
};

TEST_F(LargeNpy, is_mapped) {
  const SiteTable table = read_sites(write("<f8", n, {1, 2, 3}));
  EXPECT_TRUE(table.sites.is_mapped());
  ASSERT_EQ(table.sites.size(), n);
  EXPECT_EQ(table.sites[0], (Point{0, 0, 0}));
  EXPECT_EQ(table.sites[n - 1], (Point{1, 2, 3}));
  EXPECT_EQ(table.where(5), table.name + ": row 5");
}

TEST_F(LargeNpy, stays_mapped_in_copies_of_the_table_only_as_long_as_they_live) {
  SiteTable copy;
  {
    const SiteTable table = read_sites(write("<f8", n, {1, 2, 3}));
    copy = table;
  }
  std::filesystem::remove(directory_.file("a.npy"));
  EXPECT_EQ(copy.sites[n - 1], (Point{1, 2, 3}));
}

TEST_F(LargeNpy, is_copied_if_it_is_smaller_or_in_another_byte_order) {
  EXPECT_FALSE(read_sites(write("<f8", n - 1, {1, 2, 3})).sites.is_mapped());
  EXPECT_FALSE(read_sites(write(">f8", n, {0, 0, 0})).sites.is_mapped());
}

TEST_F(LargeNpy, is_checked_as_any_other) {
  const std::string name = write("<f8", n, {1, std::numeric_limits<double>::infinity(), 3});
  const std::string message = message_of([&] { read_sites(name); });
  EXPECT_TRUE(message.starts_with(name + ": row " + std::to_string(n - 1) + ": ")) << message;
}

}  // namespace
}  // namespace rondel::test
