// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf_library.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "io/number.h"
#include "rondel/io.h"
#include "system/dynamic_library.h"

namespace rondel {
namespace io {
namespace {

// Returns the name that set_netcdf_library() has given, or an empty one.
std::string& named_netcdf_library() {
  static std::string name;
  return name;
}

// Loads all functions; returns false if one is missing.
bool load_netcdf(void* library, NetcdfLibrary& netcdf) {
  system::SymbolLoader from(library);
  from.get(netcdf.error_text, "nc_strerror");
  from.get(netcdf.open, "nc_open");
  from.get(netcdf.open_memory, "nc_open_mem");
  from.get(netcdf.close, "nc_close");
  from.get(netcdf.inquire, "nc_inq");
  from.get(netcdf.dimension_ids, "nc_inq_dimids");
  from.get(netcdf.dimension, "nc_inq_dim");
  from.get(netcdf.unlimited_ids, "nc_inq_unlimdims");
  from.get(netcdf.group_ids, "nc_inq_grps");
  from.get(netcdf.group_name, "nc_inq_grpname");
  from.get(netcdf.variable, "nc_inq_var");
  from.get(netcdf.chunks, "nc_inq_var_chunking");
  from.get(netcdf.attribute_name, "nc_inq_attname");
  from.get(netcdf.attribute, "nc_inq_att");
  from.get(netcdf.attribute_text, "nc_get_att_text");
  from.get(netcdf.attribute_strings, "nc_get_att_string");
  from.get(netcdf.attribute_numbers, "nc_get_att_double");
  from.get(netcdf.attribute_integers, "nc_get_att_longlong");
  from.get(netcdf.attribute_naturals, "nc_get_att_ulonglong");
  from.get(netcdf.free_strings, "nc_free_string");
  from.get(netcdf.read_doubles, "nc_get_vara_double");
  from.get(netcdf.read_integers, "nc_get_vara_longlong");
  from.get(netcdf.read_naturals, "nc_get_vara_ulonglong");
  from.get(netcdf.read_text, "nc_get_vara_text");
  from.get(netcdf.read_strings, "nc_get_vara_string");
  from.get(netcdf.create, "nc_create");
  from.get(netcdf.add_dimension, "nc_def_dim");
  from.get(netcdf.add_variable, "nc_def_var");
  from.get(netcdf.put_text, "nc_put_att_text");
  from.get(netcdf.put_numbers, "nc_put_att_double");
  from.get(netcdf.set_chunks, "nc_def_var_chunking");
  from.get(netcdf.set_cache, "nc_set_var_chunk_cache");
  from.get(netcdf.set_deflate, "nc_def_var_deflate");
  from.get(netcdf.set_fill, "nc_def_var_fill");
  from.get(netcdf.end_definitions, "nc_enddef");
  from.get(netcdf.write, "nc_put_vara");
  return from.has_all();
}

}  // namespace

system::Mutex& netcdf_library_lock() {
  static system::Mutex lock;
  return lock;
}

void* netcdf_library_address() {
  static void* const library = system::find_library(
      {.variable = "RONDEL_NETCDF",
       .soname = "libnetcdf.so.",
       .newest = 40,
       .oldest = 11,  // netCDF-C 4.4
       .others = {"libnetcdf.so", "libnetcdf.dylib", "/opt/homebrew/lib/libnetcdf.dylib",
                  "/usr/local/lib/libnetcdf.dylib", "netcdf.dll", "libnetcdf.dll"},
       .preferred = named_netcdf_library()});
  return library;
}

const NetcdfLibrary& netcdf_library() {
  static NetcdfLibrary netcdf{};
  static const bool is_loaded = [] {
    void* const library = netcdf_library_address();
    return library != nullptr && load_netcdf(library, netcdf);
  }();
  if (!is_loaded) {
    const char* const named = std::getenv("RONDEL_NETCDF");
    const std::string why = named == nullptr || *named == '\0'
                                ? "which is not found"
                                : "as which " + in_quotes(named) +
                                      ", the file that RONDEL_NETCDF names, cannot be loaded";
    throw BadValue(
        "netCDF-4 (HDF5) needs the library netCDF-C, " + why +
        ": install libnetcdf19 (Debian), netcdf (Homebrew, conda) or, for Python, netCDF4 (pip); "
        "or name the file of the library by RONDEL_NETCDF");
  }
  return netcdf;
}

void require_netcdf(const NetcdfLibrary& library, int error) {
  if (error != 0) throw BadValue(std::string("netCDF-C says: ") + library.error_text(error));
}

}  // namespace io

// Looks only at regular files and at strings, since a pipe could not be read again.
bool is_netcdf_file(const FileName& file) {
  std::error_code error;
  const bool is_readable_twice =
      file.bytes != nullptr || std::filesystem::is_regular_file(file.path, error);
  if (file.format.empty() && is_readable_twice) {
    try {
      const io::FileBytes bytes(file, true);
      if (io::is_netcdf(bytes.head())) return true;
    } catch (const FileError&) {
      // The reader will report the error.
    }
  }
  return io::has_netcdf_ending(file);
}

std::pair<FileName, std::string> file_and_variable(const FileName& file) {
  std::error_code error;
  if (file.bytes != nullptr || std::filesystem::exists(file.path, error)) return {file, {}};
  // Position 1 is the colon of a drive of Windows, C:.
  for (std::size_t colon = file.path.rfind(':'); colon != std::string::npos && colon >= 2;
       colon = file.path.rfind(':', colon - 1)) {
    FileName before(file.path.substr(0, colon), file.format);
    if (is_netcdf_file(before)) return {std::move(before), file.path.substr(colon + 1)};
  }
  return {file, {}};
}

void set_netcdf_library(const std::string& path) { io::named_netcdf_library() = path; }

}  // namespace rondel
