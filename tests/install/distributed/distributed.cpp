// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A client of rondel::distributed: the octahedron by way of files, and an exception that crosses the
// library's border.

#include <rondel/error.h>
#include <rondel/io.h>
#include <rondel/out_of_core.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

int main() {
  const auto folder = std::filesystem::temp_directory_path() / "rondel-client";
  std::filesystem::create_directories(folder);
  const std::string sites = (folder / "sites.npy").string();
  const std::string faces = (folder / "faces.npy").string();
  const std::vector<rondel::Point> points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                             {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  rondel::write_sites(sites, points);
  rondel::OutOfCoreOptions options;
  options.scratch = (folder / "scratch").string();
  rondel::delaunay_file(sites, {faces}, options);
  const std::size_t num_faces = rondel::read_triangles(faces).size();
  int num_caught = 0;
  try {
    options.memory = 0;
    rondel::delaunay_file(sites, {faces}, options);
  } catch (const rondel::InvalidInput&) {
    ++num_caught;
  }
  std::filesystem::remove_all(folder);
  std::printf("%zu faces, %d error\n", num_faces, num_caught);
}
