// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_sites, write_triangles, write_cells, write_file against read_sites and read_triangles: what
// is written is read back with the same bits. Files live in a folder of the temporary directory.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/io.h"

namespace rondel::fuzz {
namespace {

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("rondel-round-trip-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

void test_sites(const Folder& folder, const SiteTable& table) {
  if (table.sites.empty()) return;
  for (const char* name : {"s.csv", "s.tsv", "s.xyz", "s.npy"}) {
    const std::string path = folder.file(name);
    write_sites(path, table.sites);
    require(read_sites(path).sites == table.sites, std::string("sites survive ") + name);
  }
}

void test_positions(const Folder& folder, const SiteTable& table) {
  if (table.positions.empty()) return;
  for (const char* name : {"p.csv", "p.tsv", "p.npy"}) {
    const std::string path = folder.file(name);
    write_sites(path, table.sites, table.positions);
    const SiteTable back = read_sites(path);
    require(back.positions == table.positions && back.sites == table.sites,
            std::string("positions survive ") + name);
  }
}

void test_circles(const Folder& folder, const SiteTable& table) {
  if (table.radii_deg.empty()) return;
  const auto sites = polar_points(table.positions, table.radii_deg);
  ReadOptions options;
  options.radius = "radius";
  for (const char* name : {"r.csv", "r.tsv"}) {
    const std::string path = folder.file(name);
    write_sites(path, sites, table.positions, table.radii_deg);
    const SiteTable back = read_sites(path, options);
    require(back.radii_deg == table.radii_deg && back.sites == sites,
            std::string("circles survive ") + name);
  }
  write_sites(folder.file("r.npy"), sites, table.positions, table.radii_deg);
  require(read_sites(folder.file("r.npy")).sites == sites, "circles survive as points");
}

void test_triangles(const Folder& folder, const SiteTable& table, const Triangulation& t) {
  for (const char* name : {"t.npy", "t.off", "t.ply", "t.obj", "t.vtp"}) {
    const std::string path = folder.file(name);
    write_triangles(path, table, t);
    if (t.num_faces() == 0) continue;
    require(std::ranges::equal(read_triangles(path), t.faces()),
            std::string("triangles survive ") + name);
  }
  write_triangles(folder.file("t.geojson"), table, t);
  try {
    write_triangles(folder.file("t.stl"), table, t);
  } catch (const FileError& error) {
    require(std::string(error.what()).ends_with("does not fit the 32-bit floats of .stl"),
            "only .stl has a limited range");
  }
}

void test_cells(const Folder& folder, const SiteTable& table, const Triangulation& t) {
  Diagram diagram;
  diagram.cells = cells(t, table.sites);
  diagram.areas = areas(t, table.sites, diagram.cells);
  for (const char* name : {"c.geojson", "c.vtp", "c.npz"}) {
    write_cells(folder.file(name), table, t, diagram, 1.0);
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  static const fuzz::Folder folder;
  fuzz::ByteSource source(data, size);
  SiteTable table;
  table.name = "sites";
  if (source.byte() % 2 == 0) {
    table.sites = fuzz::all_sites(source, 12);
    fuzz::remove_center(table.sites.owned(), {});
  } else {
    while (!source.is_empty() && table.sites.size() < 12) {
      table.positions.push_back({source.small() * 1.5 + source.byte() / 256.0,
                                 source.small() % 90 + source.small() / 128.0});
      table.sites.owned().push_back(unit_vector(table.positions.back()));
      table.radii_deg.push_back(source.byte() * 0.35);
    }
  }
  const Triangulation t = delaunay(table.sites);
  fuzz::test_sites(folder, table);
  fuzz::test_positions(folder, table);
  fuzz::test_circles(folder, table);
  fuzz::test_triangles(folder, table, t);
  fuzz::test_cells(folder, table, t);
  return 0;
}
