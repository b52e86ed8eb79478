// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pieces for ParaView: together they are the triangulation.
#include <cstring>
#include <random>

#include "io_support.h"
#include "rondel/delaunay.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

namespace fs = std::filesystem;

SiteTable random_table(std::size_t n, double height = 0) {
  std::mt19937_64 random(3);
  std::normal_distribution<> normal;
  SiteTable table;
  for (std::size_t i = 0; i < n; ++i)
    table.sites.push_back({normal(random), normal(random), normal(random) + height});
  return table;
}

// The numbers of an array in the bytes of a .vtp file, as its head says.
template <class Number>
std::vector<Number> array_of(const std::string& bytes, const std::string& name) {
  const std::size_t at = bytes.find("Name=\"" + name + "\"");
  const std::string offset = "offset=\"";
  const std::size_t place = std::stoull(bytes.substr(bytes.find(offset, at) + offset.size(), 20));
  const char* data = &bytes[bytes.find("\n_") + 2 + place];
  std::uint64_t size = 0;
  std::memcpy(&size, data, 8);
  std::vector<Number> numbers(size / sizeof(Number));
  if (size != 0) std::memcpy(numbers.data(), data + 8, size);
  return numbers;
}

// The faces of all pieces, in their order, by sites; the pieces have the coordinates of these.
std::vector<Triple> faces_of_pieces(const std::string& pvtp, const SiteTable& table,
                                    const Triangulation& t) {
  const std::string index = read_all(pvtp);
  std::vector<Triple> faces;
  const std::string source = "<Piece Source=\"";
  for (std::size_t at = index.find(source); at != std::string::npos; at = index.find(source, at)) {
    at += source.size();
    const std::size_t slash = index.find('/', at);
    const std::string path =
        pvtp.substr(0, pvtp.size() - 5) + index.substr(slash, index.find('"', at) - slash);
    const std::string bytes = read_all(path);
    const auto sites = array_of<std::int64_t>(bytes, "site");
    const auto points = array_of<double>(bytes, "Points");
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Point& p = table.sites[static_cast<std::size_t>(sites[i])];
      EXPECT_EQ(p, (Point{points[3 * i], points[3 * i + 1], points[3 * i + 2]}));
    }
    const auto ghosts = array_of<std::uint8_t>(bytes, "ghost");
    std::size_t i = 0;
    for (const Triple& face : read_triangles(path)) {
      EXPECT_EQ(ghosts[i++] != 0, t.is_ghost(static_cast<Index>(faces.size())));
      Triple by_site;
      for (std::size_t k = 0; k < 3; ++k) by_site[k] = static_cast<Index>(sites[face[k]]);
      faces.push_back(by_site);
    }
  }
  return faces;
}

TEST(write_pvtp, has_a_piece_for_each_million_of_faces) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a & b.pvtp");
  for (const std::size_t size : {300U, 525'000U}) {
    if (size > 300 && is_shortened()) continue;
    const SiteTable table = random_table(size);
    const Triangulation t = delaunay(table.sites);
    write_triangles(path, table, t);
    const std::string index = read_all(path);
    EXPECT_NE(index.find("<Piece Source=\"a &amp; b/piece_0.vtp\"/>"), std::string::npos);
    EXPECT_EQ(index.find("piece_1.vtp") != std::string::npos, t.num_faces() > 1U << 20U);
    EXPECT_TRUE(std::ranges::equal(faces_of_pieces(path, table, t), t.faces()));
  }
}

TEST(write_pvtp, has_all_faces_and_sites) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("mesh.pvtp");
  for (const SiteTable& table :
       {random_table(300), random_table(40, 30), random_table(2), random_table(0)}) {
    const Triangulation t = delaunay(table.sites);
    write_triangles(path, table, t);
    EXPECT_TRUE(std::ranges::equal(faces_of_pieces(path, table, t), t.faces()));
    EXPECT_EQ(directory.num_files(), 2U);
  }
}

TEST(write_pvtp, replaces_pieces_that_were_made_here_and_nothing_else) {
  const TemporaryDirectory directory;
  const SiteTable table = random_table(10);
  const Triangulation t = delaunay(table.sites);
  const std::string path = directory.file("mesh.pvtp");
  const fs::path pieces = directory.file("mesh");
  const auto message = [&] { return message_of([&] { write_triangles(path, table, t); }); };
  fs::create_directory(pieces);
  for (const char* name : {"piece_.vtp", "piece_0.vtp.gz", "piece_x.vtp", "mesh_0.vtp"}) {
    std::ofstream(pieces / name) << "made by rondel";
    EXPECT_EQ(message(),
              pieces.string() + ": '" + name + "' in it is not ours; the folder is not replaced");
    fs::remove(pieces / name);
  }
  std::ofstream(pieces / "piece_0.vtp") << "from elsewhere";
  EXPECT_EQ(message(), pieces.string() + ": it was not made by rondel; the folder is not replaced");
  EXPECT_EQ(directory.num_files(), 1U);
  fs::remove(pieces / "piece_0.vtp");
  EXPECT_EQ(message(), "");
  EXPECT_EQ(message(), "");
  EXPECT_EQ(directory.num_files(), 2U);
}

TEST(write_pvtp, escapes_the_names_of_pieces) {
  const TemporaryDirectory directory;
  const SiteTable table = random_table(20);
  const Triangulation t = delaunay(table.sites);
  for (const auto& [name, escaped] : {std::pair("a\"b", "a&quot;b"), std::pair("<a>", "&lt;a>"),
                                      std::pair("a&&b", "a&amp;&amp;b"), std::pair("a'b", "a'b")}) {
    const std::string path = directory.file(std::string(name) + ".pvtp");
    write_triangles(path, table, t);
    EXPECT_NE(read_all(path).find("<Piece Source=\"" + std::string(escaped) + "/"),
              std::string::npos)
        << read_all(path);
    EXPECT_TRUE(fs::is_directory(directory.file(name)));
  }
}

TEST(write_pvtp, says_what_cannot_be_written) {
  const TemporaryDirectory directory;
  const SiteTable table = random_table(10);
  const Triangulation t = delaunay(table.sites);
  const FileName unnamed(directory.file("mesh"), "pvtp");
  EXPECT_EQ(message_of([&] { write_triangles(unnamed, table, t); }),
            unnamed.path + ": the name of such a file ends in .pvtp");
  const std::string nowhere = directory.file("none/mesh.pvtp");
  EXPECT_EQ(message_of([&] { write_triangles(nowhere, table, t); }),
            nowhere + ": No such file or directory");
  EXPECT_EQ(directory.num_files(), 0U);
}

}  // namespace
}  // namespace rondel::test
