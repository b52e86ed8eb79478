// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations by way of files: what is written is what delaunay() finds in memory.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "io/binary.h"
#include "rondel/out_of_core.h"
#include "support/temporary_files.h"
#include "unit/distributed/support.h"

namespace rondel::test {
namespace {

constexpr std::uint64_t no_limit = std::uint64_t{1} << 40;

// Whole numbers as an array of this type.
std::string npy_bytes(std::span<const Point> points, const std::string& type, bool is_by_columns) {
  const std::string order = is_by_columns ? "True" : "False";
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': (" +
                       std::to_string(points.size()) + ", 3), }";
  header.append(117 - header.size(), ' ');
  header += '\n';
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  bytes += header;
  const auto number = [&](double value) {
    std::array<char, 8> room{};
    const std::endian endian = type[0] == '<' ? std::endian::little : std::endian::big;
    const char* end = type == "<f4"    ? io::store(static_cast<float>(value), room.data(), endian)
                      : type[1] == 'f' ? io::store(value, room.data(), endian)
                      : type.back() == '2'
                          ? io::store(static_cast<std::int16_t>(value), room.data(), endian)
                          : io::store(static_cast<std::int32_t>(value), room.data(), endian);
    bytes.append(room.data(), static_cast<std::size_t>(end - room.data()));
  };
  if (is_by_columns) {
    for (double Point::*coordinate : {&Point::x, &Point::y, &Point::z}) {
      for (const Point& p : points) number(p.*coordinate);
    }
  } else {
    for (const Point& p : points) {
      number(p.x);
      number(p.y);
      number(p.z);
    }
  }
  return bytes;
}

class distributed_files : public testing::TestWithParam<Generator> {};

TEST_P(distributed_files, as_in_memory) {
  const Generator& generator = GetParam();
  const std::size_t size = generator.has_long_integers ? 60 : 600;
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    const SiteSet set = generator.make(size, 1);
    const FileCase files(set.sites, {.model = model, .sphere = set.sphere});
    for (const std::uint64_t bucket : {40U, 250U, 10000U}) {
      if (bucket == 250 && is_shortened()) continue;
      SCOPED_TRACE(bucket);
      const distributed::RunLimits limits = {bucket, no_limit, no_limit, 100};
      files.compare(files.run(limits));
    }
  }
}

// Rows and faces with numbers that need 64 bits.
TEST_P(distributed_files, of_64_bits) {
  const Generator& generator = GetParam();
  const SiteSet set = generator.make(generator.has_long_integers ? 30 : 100, 2);
  const FileCase files(set.sites, {.model = Model::weighted, .sphere = set.sphere});
  for (const std::uint64_t first : {(std::uint64_t{1} << 32U) - 50, std::uint64_t{1} << 40U}) {
    files.compare(files.run({20, no_limit, no_limit, 64, first}), first);
  }
}

INSTANTIATE_TEST_SUITE_P(generators, distributed_files, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

// Of n copies of few places there is one bucket with more sites than it may have.
TEST(distributed_crowds, copies_are_kept_once) {
  std::vector<Point> sites;
  Random random(3);
  const Point place = {12, 34, 1e15 + 56};
  for (int i = 0; i < 500; ++i) {
    // In one place all, some of other lengths; or close to it, or elsewhere.
    const double length = i % 3 == 0 ? 3 : i % 3 == 1 ? 5 : 1;
    sites.push_back(i % 50 == 7 ? random.direction() : length * place);
    const auto digit = [&] { return static_cast<double>(random.below(5)); };
    if (i % 10 == 8) sites.back() = length * (place + Point{digit(), digit(), 0});
  }
  for (const Model model : {Model::projected, Model::weighted}) {
    const FileCase files(sites, {.model = model});
    files.compare(files.run({100, 50, no_limit, 30}));
  }
}

TEST(distributed_files_once, of_the_usual_limits_and_threads) {
  const FileCase files(generator("uniform").make(20000, 5).sites, {});
  const TemporaryDirectory& folder = files.folder();
  OutOfCoreOptions options;
  options.scratch = folder.file("scratch");
  files.compare(delaunay_file(folder.file("sites.npy"), files.files(), options));
}

// Of copies on one ray the lowest index names the place, and its point counts for areas; which are so
// close that another one, known to as many bits, gives others.
TEST(distributed_files_once, of_copies_of_other_lengths) {
  Random random(9);
  std::vector<Point> sites;
  for (int i = 0; i < 300; ++i) {
    const auto digit = [&] { return static_cast<double>(random.below(100)); };
    const Point ray = {digit(), digit(), 1e15 + digit()};
    for (const double length : {3.0, 1.0, 5.0})
      sites.push_back((i % 2 == 0 ? length : 6 - length) * ray);
  }
  const FileCase files(sites, {});
  for (const std::uint64_t bucket : {50U, 10000U})
    files.compare(files.run({bucket, no_limit, no_limit, 30}));
}

// What write_triangles() would write, byte by byte; and no other file.
TEST(distributed_files_once, have_the_bytes_of_those_in_memory) {
  const FileCase files(generator("uniform").make(2000, 5).sites, {});
  files.run({300, no_limit, no_limit, 500});
  const SiteTable table = read_sites(files.folder().file("sites.npy"));
  const Triangulation triangulation = delaunay(table.sites);
  const std::string expected = files.folder().file("expected.npy");
  write_triangles(expected, table, triangulation);
  EXPECT_TRUE(read_all(files.files().faces) == read_all(expected));
}

TEST(distributed_files_once, of_longitudes_and_latitudes) {
  const FileCase files({{1, 0, 0}}, {});
  std::vector<LonLat> positions;
  Random random(5);
  for (int i = 0; i < 500; ++i)
    positions.push_back({180 * random.signed_unit(), 90 * random.signed_unit()});
  std::vector<Point> sites;
  for (const LonLat& p : positions) sites.push_back(unit_vector(p));
  const std::string path = files.folder().file("positions.npy");
  write_sites(path, sites, positions);
  OutOfCoreOptions options;
  options.scratch = files.folder().file("scratch");
  const std::string faces = files.folder().file("f.npy");
  delaunay_file(path, {faces}, options);
  EXPECT_TRUE(rows_of(faces).numbers == numbers_of(delaunay(sites).faces()));
}

// A bucket with one place, and others, with the usual limits.
TEST(distributed_files_once, of_few_sites) {
  for (const std::size_t size : {1U, 2U, 5U, 40U}) {
    Random random(size);
    std::vector<Point> sites;
    for (std::size_t i = 0; i < size; ++i)
      sites.push_back(random_near(random, {0.2, 0.1, 0.9}, size == 40 ? 1 : 1e-12));
    const FileCase files(sites, {});
    OutOfCoreOptions options;
    options.scratch = files.folder().file("scratch");
    files.compare(delaunay_file(files.folder().file("sites.npy"), files.files(), options));
  }
}

TEST(distributed_files_once, without_sites) {
  const FileCase files({}, {});
  files.compare(files.run({100, 50, no_limit, 30}));
}

// The same in the order of the file and by columns, of integers and of floats.
TEST(distributed_files_once, of_every_layout) {
  const FileCase files({{1, 0, 0}}, {});
  std::vector<Point> sites;
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Point p = 100.0 * random.direction();
    sites.push_back({std::round(p.x), std::round(p.y), std::round(p.z)});
  }
  const auto expected = numbers_of(delaunay(sites).faces());
  for (const char* type : {"<f8", ">f8", "<f4", "<i2", ">i4"}) {
    for (const bool is_by_columns : {false, true}) {
      SCOPED_TRACE(std::string(type) + (is_by_columns ? " by columns" : ""));
      const std::string path =
          files.folder().with("layout.npy", npy_bytes(sites, type, is_by_columns));
      const std::string faces = files.folder().file("f.npy");
      const io::NpyRows rows(path, false);
      OutOfCoreOptions options;
      options.scratch = files.folder().file("scratch");
      distributed::run(rows, {faces}, options, {50, no_limit, no_limit, 70}, {{}, {.threads = 1}});
      EXPECT_TRUE(rows_of(faces).numbers == expected);
    }
  }
}

}  // namespace
}  // namespace rondel::test
