// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The library HDF5, which netCDF-C has loaded. It is asked where the values of a variable are in a
// file, and given chunks that are compressed already. The members are functions of its C interface,
// whose binary form is the same since HDF5 1.10.5.
//
// in    netCDF-C
// out   pointers to functions of HDF5
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rondel::io {

// The number of an open object; negative after an error.
using Hdf5Id = std::int64_t;

// Takes where a chunk begins, the filters that were left out, its place in the file and its size there;
// returns 0 to go on.
using Hdf5ChunkVisitor = int (*)(const unsigned long long*, unsigned, std::uint64_t,
                                 unsigned long long, void*);

struct Hdf5Library {
  std::ptrdiff_t (*object_ids)(Hdf5Id, unsigned, std::size_t, Hdf5Id*);
  std::ptrdiff_t (*file_name)(Hdf5Id, char*, std::size_t);
  Hdf5Id (*open_array)(Hdf5Id, const char*, Hdf5Id);
  int (*close_array)(Hdf5Id);
  Hdf5Id (*properties)(Hdf5Id);
  int (*close_properties)(Hdf5Id);
  int (*chunk)(Hdf5Id, int, unsigned long long*);
  int (*num_filters)(Hdf5Id);
  int (*filter)(Hdf5Id, unsigned, unsigned*, std::size_t*, unsigned*, std::size_t, char*,
                unsigned*);
  Hdf5Id (*type)(Hdf5Id);
  int (*close_type)(Hdf5Id);
  Hdf5Id (*copy_type)(Hdf5Id);
  Hdf5Id (*native_type)(Hdf5Id, int);
  int (*is_same_type)(Hdf5Id, Hdf5Id);
  int (*type_order)(Hdf5Id);
  int (*set_type_order)(Hdf5Id, int);
  Hdf5Id (*space)(Hdf5Id);
  int (*close_space)(Hdf5Id);
  int (*rank)(Hdf5Id);
  int (*lengths)(Hdf5Id, unsigned long long*, unsigned long long*);
  int (*num_chunks)(Hdf5Id, Hdf5Id, unsigned long long*);
  int (*chunk_place)(Hdf5Id, Hdf5Id, unsigned long long, unsigned long long*, unsigned*,
                     std::uint64_t*, unsigned long long*);
  // Null before HDF5 1.12.3.
  int (*for_each_chunk)(Hdf5Id, Hdf5Id, Hdf5ChunkVisitor, void*);
  int (*set_lengths)(Hdf5Id, const unsigned long long*);
  int (*write_chunk)(Hdf5Id, Hdf5Id, unsigned, const unsigned long long*, std::size_t, const void*);
};

// Returns the library; null if netCDF-C is not found, or the HDF5 that it uses is older.
const Hdf5Library* hdf5_library();

// An object of HDF5 that is open as long as this one lives. The lock of netCDF-C is held at its end.
class Hdf5Object {
 public:
  Hdf5Object(Hdf5Id id, int (*close)(Hdf5Id)) : id_(id), close_(close) {}
  ~Hdf5Object() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Object(const Hdf5Object&) = delete;
  Hdf5Object& operator=(const Hdf5Object&) = delete;

  [[nodiscard]] bool is_open() const { return id_ >= 0; }
  [[nodiscard]] Hdf5Id id() const { return id_; }

 private:
  Hdf5Id id_;
  int (*close_)(Hdf5Id);
};

// Opens an array of a file that netCDF-C has open under this name; returns a negative number if there
// is none. Precondition: the lock of netCDF-C is held.
Hdf5Id open_hdf5_array(const Hdf5Library& hdf5, const std::string& file, const std::string& name);

// Returns the lengths of an array; none after an error. Precondition: as above.
std::vector<std::uint64_t> lengths_of(const Hdf5Library& hdf5, Hdf5Id array);

// Constants of the interface.
inline constexpr Hdf5Id hdf5_all_files = 0x1f;  // in place of a file
inline constexpr unsigned hdf5_files = 1;       // a kind of objects
inline constexpr Hdf5Id hdf5_default = 0;       // properties
inline constexpr int hdf5_little_endian = 0;
inline constexpr int hdf5_big_endian = 1;
inline constexpr int hdf5_deflate = 1;  // filters
inline constexpr int hdf5_shuffle = 2;

}  // namespace rondel::io
