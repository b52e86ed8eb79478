// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "python_libraries.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "process.h"
#include "rondel/io.h"

namespace rondel::cli {
namespace {

namespace fs = std::filesystem;

// Returns what is in a folder, in the order of names; nothing if it cannot be read.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  std::ranges::sort(entries);
  return entries;
}

// Returns the folders of packages of an environment.
std::vector<fs::path> package_folders(const fs::path& environment) {
  std::vector<fs::path> folders = {environment / "Lib" / "site-packages"};  // on Windows
  for (const fs::path& entry : entries_of(environment / "lib")) {
    if (!entry.filename().string().starts_with("python")) continue;
    for (const char* const name : {"site-packages", "dist-packages"}) {
      folders.push_back(entry / name);
    }
  }
  return folders;
}

// Returns the library in an environment; an empty path if it has none.
fs::path netcdf_in(const fs::path& environment) {
  for (const fs::path& folder : package_folders(environment)) {
    // The wheels of netCDF4 for Linux, macOS and Windows.
    for (const fs::path& part :
         {folder / "netcdf4.libs", folder / "netCDF4.libs", folder / "netCDF4" / ".dylibs"}) {
      for (const fs::path& entry : entries_of(part)) {
        const std::string name = entry.filename().string();
        if (name.starts_with("libnetcdf") || name.starts_with("netcdf-")) return entry;
      }
    }
  }
  std::error_code error;
  if (!fs::is_directory(environment / "conda-meta", error)) return {};
  for (const char* const name :
       {"lib/libnetcdf.so", "lib/libnetcdf.dylib", "Library/bin/netcdf.dll"}) {
    if (fs::is_regular_file(environment / name, error)) return environment / name;
  }
  return {};
}

}  // namespace

void use_netcdf_of_python(const std::string& program) {
  const fs::path executable = path_of_executable(program);
  if (executable.empty()) return;
  const fs::path library = netcdf_in(executable.parent_path().parent_path());
  if (!library.empty()) set_netcdf_library(library.string());
}

}  // namespace rondel::cli
