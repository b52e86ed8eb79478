// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/result_names.h"

#include <cstddef>
#include <filesystem>
#include <system_error>

#include "rondel/error.h"
#include "rondel/io.h"

namespace rondel::distributed {

bool are_same_file(const std::string& a, const std::string& b) {
  if (a == b) return true;
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto first = std::filesystem::weakly_canonical(a, error);
  if (error) return false;
  return first == std::filesystem::weakly_canonical(b, error) && !error;
}

void require_npy(const std::string& name) {
  const std::string format = format_of(name);
  if (!format.empty() && format != "npy") throw FileError(name + ": results are .npy files");
}

void require_different(const std::string& sites, const std::vector<std::string>& results) {
  const std::string& faces = results.front();
  if (faces.empty()) throw FileError("the file of the faces has no name");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string& name = results[i];
    if (name.empty()) continue;
    if (are_same_file(sites, name)) throw FileError(name + ": the file of the sites, too");
    if (format_of(name) == "zarr") {
      throw FileError(name +
                      ": Zarr groups are written in Python, by rondel.out_of_core.delaunay; here "
                      "results are .npy files");
    }
    if (i != 0) require_npy(name);
    for (std::size_t j = 0; j < i; ++j) {
      if (!results[j].empty() && are_same_file(results[j], name))
        throw FileError(name + ": the file of another result, too");
    }
  }
}

}  // namespace rondel::distributed
