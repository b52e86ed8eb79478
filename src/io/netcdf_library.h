// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The library netCDF-C, which is loaded when a netCDF-4 file is to be read or written; Rondel is
// built and runs without it. The members are functions of its C interface, whose binary form is the
// same since netCDF-C 4.4.
//
// in    the name of a library, or those that the system finds
// out   pointers to its functions, which return 0 or the number of an error
#pragma once

#include <cstddef>
#include <mutex>

#include "system/mutex.h"

namespace rondel::io {

struct NetcdfLibrary {
  const char* (*error_text)(int);
  int (*open)(const char*, int, int*);
  int (*open_memory)(const char*, int, std::size_t, void*, int*);
  int (*close)(int);
  int (*inquire)(int, int*, int*, int*, int*);
  int (*dimension_ids)(int, int*, int*, int);
  int (*dimension)(int, int, char*, std::size_t*);
  int (*unlimited_ids)(int, int*, int*);
  int (*group_ids)(int, int*, int*);
  int (*group_name)(int, char*);
  int (*variable)(int, int, char*, int*, int*, int*, int*);
  int (*chunks)(int, int, int*, std::size_t*);
  int (*attribute_name)(int, int, int, char*);
  int (*attribute)(int, int, const char*, int*, std::size_t*);
  int (*attribute_text)(int, int, const char*, char*);
  int (*attribute_strings)(int, int, const char*, char**);
  int (*attribute_numbers)(int, int, const char*, double*);
  int (*attribute_integers)(int, int, const char*, long long*);
  int (*attribute_naturals)(int, int, const char*, unsigned long long*);
  int (*free_strings)(std::size_t, char**);
  int (*read_doubles)(int, int, const std::size_t*, const std::size_t*, double*);
  int (*read_integers)(int, int, const std::size_t*, const std::size_t*, long long*);
  int (*read_naturals)(int, int, const std::size_t*, const std::size_t*, unsigned long long*);
  int (*read_text)(int, int, const std::size_t*, const std::size_t*, char*);
  int (*read_strings)(int, int, const std::size_t*, const std::size_t*, char**);
  int (*create)(const char*, int, int*);
  int (*add_dimension)(int, const char*, std::size_t, int*);
  int (*add_variable)(int, const char*, int, int, const int*, int*);
  int (*put_text)(int, int, const char*, std::size_t, const char*);
  int (*put_numbers)(int, int, const char*, int, std::size_t, const double*);
  int (*set_chunks)(int, int, int, const std::size_t*);
  int (*set_cache)(int, int, std::size_t, std::size_t, float);
  int (*set_deflate)(int, int, int, int, int);
  int (*set_fill)(int, int, int, const void*);
  int (*end_definitions)(int);
  int (*write)(int, int, const std::size_t*, const std::size_t*, const void*);
};

// Calls of the library must hold this lock, since netCDF-C is not thread-safe.
system::Mutex& netcdf_library_lock();

// Returns the library that the environment variable RONDEL_NETCDF or set_netcdf_library() names, or
// else the newest one that the system finds. Throws BadValue if there is none.
const NetcdfLibrary& netcdf_library();

// Returns the address by which its symbols are found; null if there is none.
void* netcdf_library_address();

// Throws BadValue with the library's message if `error` is the number of an error.
void require_netcdf(const NetcdfLibrary& library, int error);

// Constants of the interface.
inline constexpr int netcdf_largest_name = 256;
inline constexpr int netcdf_most_dimensions = 1024;
inline constexpr int netcdf_whole_file = -1;  // stands for the file in place of a variable that has
                                              // an attribute
inline constexpr int netcdf_string_type = 12;
inline constexpr std::size_t netcdf_unlimited = 0;    // the size of a dimension that may grow
inline constexpr int netcdf_in_chunks = 0;            // a way in which variables are stored
inline constexpr int netcdf_create_netcdf4 = 0x1000;  // replaces a file of that name

}  // namespace rondel::io
