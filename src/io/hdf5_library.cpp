// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_library.h"

#include <algorithm>
#include <array>

#include "io/netcdf_library.h"
#include "system/dynamic_library.h"

namespace rondel::io {
namespace {

// Loads all functions; returns false if one is missing. Where systems look for a symbol in the
// libraries that a library needs, those of HDF5 are found by netCDF-C.
bool load_hdf5(void* library, Hdf5Library& hdf5) {
  system::SymbolLoader from(library);
  from.get(hdf5.object_ids, "H5Fget_obj_ids");
  from.get(hdf5.file_name, "H5Fget_name");
  from.get(hdf5.open_array, "H5Dopen2");
  from.get(hdf5.close_array, "H5Dclose");
  from.get(hdf5.properties, "H5Dget_create_plist");
  from.get(hdf5.close_properties, "H5Pclose");
  from.get(hdf5.chunk, "H5Pget_chunk");
  from.get(hdf5.num_filters, "H5Pget_nfilters");
  from.get(hdf5.filter, "H5Pget_filter2");
  from.get(hdf5.type, "H5Dget_type");
  from.get(hdf5.close_type, "H5Tclose");
  from.get(hdf5.copy_type, "H5Tcopy");
  from.get(hdf5.native_type, "H5Tget_native_type");
  from.get(hdf5.is_same_type, "H5Tequal");
  from.get(hdf5.type_order, "H5Tget_order");
  from.get(hdf5.set_type_order, "H5Tset_order");
  from.get(hdf5.space, "H5Dget_space");
  from.get(hdf5.close_space, "H5Sclose");
  from.get(hdf5.rank, "H5Sget_simple_extent_ndims");
  from.get(hdf5.lengths, "H5Sget_simple_extent_dims");
  from.get(hdf5.num_chunks, "H5Dget_num_chunks");
  from.get(hdf5.chunk_place, "H5Dget_chunk_info");
  from.get(hdf5.set_lengths, "H5Dset_extent");
  from.get(hdf5.write_chunk, "H5Dwrite_chunk");
  system::SymbolLoader newer(library);
  newer.get(hdf5.for_each_chunk, "H5Dchunk_iter");
  return from.has_all();
}

// Returns the file of this name among those that are open; a negative number if there is none.
Hdf5Id open_file_named(const Hdf5Library& hdf5, const std::string& name) {
  constexpr std::size_t most_files = 1024;
  std::array<Hdf5Id, most_files> files{};
  const std::ptrdiff_t count =
      hdf5.object_ids(hdf5_all_files, hdf5_files, files.size(), files.data());
  std::string found(name.size() + 2, '\0');
  for (std::ptrdiff_t f = 0; f < std::min<std::ptrdiff_t>(count, most_files); ++f) {
    const Hdf5Id file = files[static_cast<std::size_t>(f)];
    const std::ptrdiff_t length = hdf5.file_name(file, found.data(), found.size());
    if (length == static_cast<std::ptrdiff_t>(name.size()) && found.starts_with(name)) return file;
  }
  return -1;
}

}  // namespace

Hdf5Id open_hdf5_array(const Hdf5Library& hdf5, const std::string& file, const std::string& name) {
  const Hdf5Id id = open_file_named(hdf5, file);
  if (id < 0) return id;
  const Hdf5Id array = hdf5.open_array(id, ('/' + name).c_str(), hdf5_default);
  if (array >= 0) return array;
  // A variable with the name of a dimension that is no coordinate of it has this name in HDF5.
  std::string other = '/' + name;
  other.insert(other.rfind('/') + 1, "_nc4_non_coord_");
  return hdf5.open_array(id, other.c_str(), hdf5_default);
}

std::vector<std::uint64_t> lengths_of(const Hdf5Library& hdf5, Hdf5Id array) {
  const Hdf5Object space(hdf5.space(array), hdf5.close_space);
  const int rank = space.is_open() ? hdf5.rank(space.id()) : -1;
  if (rank <= 0) return {};
  std::vector<unsigned long long> lengths(static_cast<std::size_t>(rank), 0);
  if (hdf5.lengths(space.id(), lengths.data(), nullptr) < 0) return {};
  return {lengths.begin(), lengths.end()};
}

const Hdf5Library* hdf5_library() {
  static Hdf5Library hdf5{};
  static const bool is_loaded = [] {
    void* const netcdf = netcdf_library_address();
    return netcdf != nullptr && load_hdf5(netcdf, hdf5);
  }();
  return is_loaded ? &hdf5 : nullptr;
}

}  // namespace rondel::io
