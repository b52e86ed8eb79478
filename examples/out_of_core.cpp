// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites from a file to triangles in a file, with a limit on memory.

#include <rondel/error.h>
#include <rondel/io.h>
#include <rondel/out_of_core.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

// A spiral with nearly equal distances.
std::vector<rondel::Point> some_sites(int n) {
  std::vector<rondel::Point> sites;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n;
    const double angle = 2.399963229728653 * i;
    sites.push_back(
        {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z});
  }
  return sites;
}

}  // namespace

int main() {
  const auto folder = std::filesystem::temp_directory_path() / "rondel-out-of-core";
  std::filesystem::create_directories(folder);
  const std::string sites = (folder / "sites.npy").string();
  rondel::write_sites(sites, some_sites(100000));

  rondel::OutOfCoreOptions options;
  options.memory = std::uint64_t{200} << 20;
  options.scratch = (folder / "work").string();
  options.resume = true;  // goes on with what there is, if there is something
  rondel::OutOfCoreFiles files;
  files.faces = (folder / "faces.npy").string();
  files.areas = (folder / "areas.npy").string();
  const rondel::OutOfCoreReport report = rondel::delaunay_file(sites, files, options);

  std::printf("%llu sites, %llu triangles\n", static_cast<unsigned long long>(report.num_sites),
              static_cast<unsigned long long>(report.num_faces));
  std::filesystem::remove_all(folder);
}
