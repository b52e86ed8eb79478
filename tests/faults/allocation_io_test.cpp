// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers and writers without enough memory: std::bad_alloc, no leak, and no file.

#include <string>

#include "faults/failing_files.h"
#include "rondel/delaunay.h"

namespace rondel::test {
namespace {

TEST(allocation_of_files, sites_are_read_or_bad_alloc) {
  for (const auto& file : files_in(corpus / "good")) {
    SCOPED_TRACE(file.string());
    ReadOptions options;
    options.keep_columns = true;
    if (file.stem() == "radius") options.radius = "radius";
    expect_result_or_bad_alloc([&] { return read_sites(file.string(), options).sites; });
  }
}

TEST(allocation_of_files, triangles_are_read_or_bad_alloc) {
  for (const auto& file : files_in(corpus / "good_triangles")) {
    SCOPED_TRACE(file.string());
    expect_result_or_bad_alloc([&] { return read_triangles(file.string()); });
  }
}

TEST(allocation_of_files, are_written_or_bad_alloc) {
  ReadOptions options;
  options.keep_columns = true;
  const SiteTable table = read_sites((corpus / "good" / "features.geojson").string(), options);
  const Execution one{.threads = 1};
  const Triangulation built = delaunay(table.sites, {}, one);
  const Diagram cells = diagram(built);
  for (const char* ending : {".npy", ".off", ".ply", ".obj", ".stl", ".vtp", ".geojson"}) {
    expect_file_or_bad_alloc(ending,
                             [&](const auto& path) { write_triangles(path, table, built, one); });
  }
  for (const char* ending : {".geojson", ".vtp", ".npz"}) {
    expect_file_or_bad_alloc(
        ending, [&](const auto& path) { write_cells(path, table, built, cells, 0.01, one); });
  }
  for (const char* ending : {".csv", ".xyz", ".npy"}) {
    expect_file_or_bad_alloc(ending, [&](const auto& path) {
      write_sites(path, table.sites, table.positions, {}, one);
    });
  }
}

}  // namespace
}  // namespace rondel::test
